/* Pens whose reports no descriptor describes: one rule for each maker's protocol.
 *
 *   what a node is  --pen_identify-->      a recipe, or why there is none   (pen_identify.c)
 *   recipe          --pen_setup-->         what the tablet answered         (pen_setup.c)
 *   answers         --pen_identify_end-->  protocol and ranges              (pen_answers.c)
 *   raw report      --pen_family_read-->   fields                           (pen_vendor_*.c)
 *
 * Everything but pen_setup's injected transport is pure. Offsets and ranges are facts of the
 * protocols, as the Linux drivers hid-uclogic and wacom, the DIGImend project and OpenTabletDriver
 * have published them.
 */
#ifndef PEN_VENDOR_H
#define PEN_VENDOR_H

#include "base.h"

enum pen_family {
	PEN_BY_DESCRIPTOR, /* no protocol of a maker's own */
	PEN_UCLOGIC_1,     /* older UC-Logic, Huion, Ugee, Yiynova, XP-Pen */
	PEN_UCLOGIC_2,     /* Huion and Gaomon since 2016, Gen 3 and Giano with it */
	PEN_UGEE_2,        /* XP-Pen, Ugee, Parblo, Xencelabs */
	PEN_PENPARTNER,    /* Wacom PenPartner */
	PEN_GRAPHIRE,      /* Wacom Graphire, Volito, Bamboo of the first generation */
	PEN_BAMBOO,        /* Wacom Bamboo Pen & Touch, Intuos CTH/CTL, One by Wacom */
	PEN_INTUOS,        /* Wacom Intuos 1 to 5, Intuos Pro, Cintiq */
	PEN_INTUOS_PRO_2,  /* Wacom Intuos Pro 2 and its time */
	PEN_INTUOS_PRO_3,  /* Wacom Intuos Pro 3 and its time */
	PEN_DTU,           /* Wacom DTU */
	PEN_DTUS,          /* Wacom DTU-1031 and its time */
	PEN_PL,            /* Wacom PL and early Cintiq */
	PEN_PTU,           /* Wacom PTU-600 */
	PEN_VEIKK,         /* VEIKK, Acepen */
	PEN_FAMILIES,
};

/* What a tablet of one family says of itself; goes on the tape. */
struct pen_vendor {
	enum pen_family family;
	int x_maximum, y_maximum, pressure_maximum;
};

struct pen_layout;
struct pen_fields;

/* What one report leaves to the next. Zero at the start. */
struct pen_memory {
	uint32_t tool;                /* Intuos: which one came near, 0 none */
	int reports_unknown;          /* Intuos: positions before any tool was named */
	bool near;                    /* the last report was in range */
	bool ugee, upright;           /* UC-Logic 1: which way its in-range bit is meant */
	int pressure, tilt_x, tilt_y; /* of the last report that had them */
	bool barrel, barrel_2;
};

enum pen_decoded {
	PEN_DECODED,
	PEN_FOREIGN, /* buttons, touch, a mouse: no pen's report */
	PEN_CUT_OFF,
};

struct pen_family_rule {
	const char *word; /* on tapes */
	const char *name; /* for people */
	int tilt_degrees; /* of the whole range of tilt to one side; 0: none */
	int tilt_maximum; /* logical */
	bool leaves_silently;
	uint8_t default_id; /* a report with this id means that the tablet fell back; 0: none */
	enum pen_decoded (*read)(const uint8_t *bytes, int size, const struct pen_vendor *vendor,
				 struct pen_memory *memory, struct pen_fields *fields);
};

/* PEN_BY_DESCRIPTOR has no rule. */
const struct pen_family_rule *pen_family_rule(enum pen_family family);

/* PEN_FAMILIES: no such word. */
enum pen_family pen_family_named(const char *word, size_t size);

/* Ranges that a tablet can have: what comes from a tape is checked by this. */
bool pen_vendor_sound(const struct pen_vendor *vendor);

/* The ranges of a family's fields as a layout whose bits only its rule can read. */
void pen_vendor_layout(const struct pen_vendor *vendor, struct pen_layout *layout);

/* --- for the families' files ------------------------------------------------------------------ */

static inline int pen_le16(const uint8_t *bytes)
{
	return bytes[0] | bytes[1] << 8;
}

static inline int pen_be16(const uint8_t *bytes)
{
	return bytes[0] << 8 | bytes[1];
}

static inline int pen_le24(const uint8_t *bytes)
{
	return bytes[0] | bytes[1] << 8 | bytes[2] << 16;
}

/* All bits that values up to `maximum` need. */
static inline int pen_bits_of(int maximum)
{
	int bits = 1;
	while (bits < maximum)
		bits = 2 * bits + 1;
	return bits;
}

typedef enum pen_decoded pen_family_reader(const uint8_t *bytes, int size,
					   const struct pen_vendor *vendor,
					   struct pen_memory *memory, struct pen_fields *fields);
pen_family_reader pen_uclogic_1_read, pen_uclogic_2_read, pen_ugee_2_read;
pen_family_reader pen_penpartner_read, pen_graphire_read, pen_bamboo_read;
pen_family_reader pen_intuos_read, pen_intuos_pro_2_read, pen_intuos_pro_3_read;
pen_family_reader pen_dtu_read, pen_dtus_read, pen_pl_read, pen_ptu_read, pen_veikk_read;

#endif
