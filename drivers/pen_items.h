/* The items of a report descriptor, walked from one input report's fields to the next. Private to
 * the pen module. */
#ifndef PEN_ITEMS_H
#define PEN_ITEMS_H

#include "pen.h"

/* The bounds are those of the Linux kernel (include/linux/hid.h, drivers/hid/hid-core.c), or wider
 * than any real descriptor; what exceeds them is refused. */
enum {
	GLOBAL_STACK_MAX = 4,
	COLLECTION_DEPTH_MAX = 32,
	USAGE_RANGES_MAX = 256,
	USAGES_MAX = 12288,   /* HID_MAX_USAGES */
	FIELD_BITS_MAX = 256, /* a field of more bits is refused by the kernel */
	REPORT_BITS_MAX = 16384 * 8,
};

enum {
	PAGE_DESKTOP = 0x01,
	PAGE_BUTTON = 0x09,
	PAGE_DIGITIZER = 0x0d,
	PAGE_WACOM = 0xff0d, /* the digitizer's numbers on a page of Wacom's own */
};

#define USAGE(page, id) ((uint32_t)(page) << 16 | (uint32_t)(id))

/* What collections say about the fields within. */
enum role {
	ROLE_OUTSIDE, /* no application collection is open: what is in there belongs to nothing */
	ROLE_NONE,
	ROLE_MOUSE, /* Generic Desktop: Mouse, Pointer */
	ROLE_PEN,   /* Digitizer or Pen as an application, a Stylus within any but touch */
	ROLE_TOUCH, /* Touch Screen, Touch Pad, Finger, Configuration: never a pen */
};

struct globals {
	uint32_t page;
	int32_t logical_minimum, logical_maximum;
	uint32_t logical_maximum_raw;
	int32_t physical_minimum, physical_maximum;
	uint32_t physical_maximum_raw;
	uint32_t unit;
	int unit_exponent;
	uint32_t report_size, report_count;
	int report_id;
};

struct usage_range {
	uint32_t first, last;
	bool extended; /* four bytes: the page is part of the usage */
};

struct items {
	const uint8_t *bytes;
	int size, at;
	struct globals global;
	struct globals stack[GLOBAL_STACK_MAX];
	int stack_depth;
	struct usage_range usage[USAGE_RANGES_MAX];
	int usage_count; /* of ranges */
	int usage_total; /* of usages */
	uint32_t usage_minimum;
	bool usage_minimum_given, usage_minimum_extended;
	int delimiter_depth, delimiter_usages;
	enum role role[COLLECTION_DEPTH_MAX + 1]; /* role[depth] holds for the fields in there */
	int depth;
	bool ids_used;
	uint32_t input_bits[256]; /* by report id, without the id byte */
	uint32_t output_bits[256], feature_bits[256];
	uint32_t application; /* usage of the innermost application collection */
	bool input_met;       /* the last call ended at an input item: */
	uint32_t input_flags;
	uint32_t input_start; /* its first bit within the report, the id byte included */
	char *reason;
};

enum items_event {
	ITEMS_INPUT, /* an input item: globals, usages, role and input_ above are its own */
	ITEMS_END,
	ITEMS_FAULT, /* reason says "byte N: what" */
};

/* reason takes 160 bytes and outlives the walk. */
void pen_items_init(struct items *items, const uint8_t *bytes, int size, char *reason);
enum items_event pen_items_next(struct items *items);

/* Usage number `index` of the input item; the last one holds for all further fields. */
uint32_t pen_items_usage(const struct items *items, int index);

#endif
