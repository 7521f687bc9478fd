/* Which protocol of a maker's a tablet speaks, and how it is made to.
 *
 * Neither vendor nor product decide alone: many tablets share them, and some change them on the
 * way. The shape of the report descriptor, the kernel's driver and what the tablet answers to the
 * recipe's steps do; the table of models (pen_models.c) fills in ranges that a tablet does not
 * tell.
 */
#ifndef PEN_IDENTIFY_H
#define PEN_IDENTIFY_H

#include "pen.h"

enum { PEN_SHAPE_REPORTS_MAX = 32, PEN_ANSWER_MAX = 255, PEN_STEPS_MAX = 12 };

/* A report as the descriptor declares it; bytes with the id, 0: none of the kind. */
struct pen_shape_report {
	uint8_t id;
	uint32_t application; /* usage page << 16 | usage of its input's collection */
	int input_bytes, output_bytes, feature_bytes;
};

struct pen_shape {
	int count;
	struct pen_shape_report report[PEN_SHAPE_REPORTS_MAX];
};

/* The reports of a sound descriptor, as many as fit; an unsound one has none. */
void pen_shape_read(struct pen_shape *shape, const uint8_t *descriptor, int size);

/* What is known of a node before anything is sent. */
struct pen_identity {
	int bus, vendor, product;
	const char *driver; /* the kernel's */
	const uint8_t *descriptor;
	int descriptor_size;
};

enum pen_step_kind { PEN_STEP_STRING, PEN_STEP_OUTPUT, PEN_STEP_FEATURE };

/* One thing to ask or to tell. All may be done twice without harm. */
struct pen_step {
	enum pen_step_kind kind;
	bool fallback;        /* only where the answers so far tell no ranges */
	bool wanted;          /* without success here the tablet cannot speak */
	uint8_t string_index; /* PEN_STEP_STRING */
	uint8_t size, bytes[9];
};

struct pen_recipe {
	enum pen_family family; /* or the one that answers decide on */
	int report_bytes;       /* of the pen's report by the descriptor, 0 unknown */
	int output_bytes;       /* outputs are filled up with zeros to so many */
	int step_count;
	struct pen_step step[PEN_STEPS_MAX];
};

/* Answers to string steps, as they came: the descriptor's bytes with its head. */
struct pen_answers {
	int count;
	struct {
		uint8_t string_index;
		int size;
		uint8_t bytes[PEN_ANSWER_MAX];
	} answer[PEN_STEPS_MAX];
};

/* True: `recipe` makes the node speak. False: it has no protocol that we know, or needs none; the
 * reason says which. */
bool pen_identify(const struct pen_identity *identity, struct pen_recipe *recipe, char reason[160]);

/* What the answers mean. False: the reason says what is wrong with them. width_mm, height_mm: what
 * resolution and model tell, or 0. */
bool pen_identify_end(const struct pen_identity *identity, const struct pen_recipe *recipe,
		      const struct pen_answers *answers, struct pen_vendor *vendor, float *width_mm,
		      float *height_mm, char reason[160]);

/* A parameter block of UC-Logic's: string 100 (first version) or 200 (second). Any bytes are safe;
 * what is text, cut off or unbelievable is refused. */
struct pen_block {
	int x_maximum, y_maximum, pressure_maximum, lines_per_inch;
};
bool pen_block_1_read(const uint8_t *bytes, int size, struct pen_block *block, char reason[160]);
bool pen_block_2_read(const uint8_t *bytes, int size, struct pen_block *block, char reason[160]);

/* --- models ----------------------------------------------------------------------------------- */

struct pen_model {
	uint16_t vendor, product;
	uint8_t family;
	uint8_t report_bytes; /* of the pen's report; 0: any */
	uint8_t string_index; /* a string that has these words; 0: none is asked */
	const char *words;
	int x_maximum, y_maximum, pressure_maximum;
	int width_dmm, height_dmm; /* tenths of a millimetre */
};
extern const struct pen_model pen_models[];
extern const int pen_model_count;

bool pen_model_is(const struct pen_model *model, const struct pen_identity *identity,
		  enum pen_family family);

#endif
