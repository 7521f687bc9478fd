/* Walking report descriptors (Device Class Definition for HID 1.11, section 6.2.2); see
 * pen_items.h. */
#include "pen_items.h"

#include <stdio.h>

enum { TYPE_MAIN, TYPE_GLOBAL, TYPE_LOCAL, TYPE_LONG };
enum { MAIN_INPUT = 0x8, MAIN_OUTPUT = 0x9, MAIN_FEATURE = 0xb };

struct item {
	int type, tag, size;
	uint32_t value; /* as it stands */
	int32_t signed_value;
};

static bool refuse(struct items *r, const char *why)
{
	snprintf(r->reason, 160, "byte %d: %s", r->at, why);
	return false;
}

/* The next item, long items included. False at the end or when the item is cut off. */
static bool item_next(struct items *r, struct item *item)
{
	static const int sizes[4] = {0, 1, 2, 4};
	if (r->at >= r->size)
		return false;
	uint8_t prefix = r->bytes[r->at];
	if (prefix == 0xfe) {
		if (r->size - r->at < 3 || r->size - r->at - 3 < r->bytes[r->at + 1])
			return refuse(r, "a long item is cut off");
		*item = (struct item){.type = TYPE_LONG};
		r->at += 3 + r->bytes[r->at + 1];
		return true;
	}
	int size = sizes[prefix & 3];
	if (r->size - r->at - 1 < size)
		return refuse(r, "an item is cut off");
	uint32_t value = 0;
	for (int i = 0; i < size; i++)
		value |= (uint32_t)r->bytes[r->at + 1 + i] << (8 * i);
	int32_t signed_value = (int32_t)value;
	if (size == 1)
		signed_value = (int8_t)value;
	if (size == 2)
		signed_value = (int16_t)value;
	*item = (struct item){prefix >> 2 & 3, prefix >> 4, size, value, signed_value};
	r->at += 1 + size;
	return true;
}

/* --- globals ------------------------------------------------------------------------- */

static bool global_push(struct items *r)
{
	if (r->stack_depth == GLOBAL_STACK_MAX)
		return refuse(r, "more than 4 nested Push items");
	r->stack[r->stack_depth++] = r->global;
	return true;
}

static bool global_pop(struct items *r)
{
	if (!r->stack_depth)
		return refuse(r, "Pop without Push");
	r->global = r->stack[--r->stack_depth];
	return true;
}

static bool global_report_id(struct items *r, uint32_t id)
{
	if (id == 0 || id > 255)
		return refuse(r, "a report id outside of 1 to 255");
	r->ids_used = true;
	r->global.report_id = (int)id;
	return true;
}

static bool global_item(struct items *r, const struct item *item)
{
	struct globals *g = &r->global;
	switch (item->tag) {
	case 0x0:
		g->page = item->value & 0xffff;
		return true;
	case 0x1:
		g->logical_minimum = item->signed_value;
		return true;
	case 0x2:
		g->logical_maximum = item->signed_value;
		g->logical_maximum_raw = item->value;
		return true;
	case 0x3:
		g->physical_minimum = item->signed_value;
		return true;
	case 0x4:
		g->physical_maximum = item->signed_value;
		g->physical_maximum_raw = item->value;
		return true;
	case 0x5: /* a signed nibble; some devices write it as a signed byte */
		g->unit_exponent = (int)(item->value & 15);
		g->unit_exponent -= g->unit_exponent > 7 ? 16 : 0;
		return true;
	case 0x6:
		g->unit = item->value;
		return true;
	case 0x7:
		g->report_size = item->value;
		return item->value <= FIELD_BITS_MAX || refuse(r, "a field of more than 256 bits");
	case 0x8:
		return global_report_id(r, item->value);
	case 0x9:
		g->report_count = item->value;
		return item->value <= USAGES_MAX || refuse(r, "more than 12288 fields at once");
	case 0xa:
		return global_push(r);
	case 0xb:
		return global_pop(r);
	}
	return true;
}

/* --- locals -------------------------------------------------------------------------- */

static bool usage_add(struct items *r, uint32_t first, uint32_t last, bool extended)
{
	if (last < first)
		return refuse(r, "a usage range that ends before it begins");
	if (last - first >= USAGES_MAX - (uint32_t)r->usage_total)
		return refuse(r, "more than 12288 usages");
	if (r->usage_count == USAGE_RANGES_MAX)
		return refuse(r, "more than 256 usages or ranges before one main item");
	r->usage[r->usage_count++] = (struct usage_range){first, last, extended};
	r->usage_total += (int)(last - first) + 1;
	return true;
}

static bool local_item(struct items *r, const struct item *item)
{
	bool extended = item->size == 4;
	switch (item->tag) {
	case 0x0: /* usages between delimiters are alternatives for one control; the first counts */
		if (r->delimiter_depth && r->delimiter_usages++)
			return true;
		return usage_add(r, item->value, item->value, extended);
	case 0x1:
		r->usage_minimum = item->value;
		r->usage_minimum_given = true;
		r->usage_minimum_extended = extended;
		return true;
	case 0x2:
		if (!r->usage_minimum_given || r->delimiter_depth)
			return true;
		r->usage_minimum_given = false;
		return usage_add(r, r->usage_minimum, item->value,
				 extended || r->usage_minimum_extended);
	case 0xa:
		if (item->value ? r->delimiter_depth : !r->delimiter_depth)
			return refuse(r, "delimiters that do not match");
		r->delimiter_depth = item->value ? 1 : 0;
		r->delimiter_usages = 0;
		return true;
	}
	return true;
}

static void locals_clear(struct items *r)
{
	r->usage_count = r->usage_total = 0;
	r->usage_minimum_given = false;
	r->delimiter_depth = r->delimiter_usages = 0;
}

uint32_t pen_items_usage(const struct items *r, int index)
{
	for (int i = 0; i < r->usage_count; i++) {
		const struct usage_range *range = &r->usage[i];
		int count = (int)(range->last - range->first) + 1;
		bool last = i == r->usage_count - 1;
		if (index < count || last) {
			uint32_t usage = range->first + (uint32_t)int_min(index, count - 1);
			return range->extended ? usage : USAGE(r->global.page, usage);
		}
		index -= count;
	}
	return 0;
}

/* --- collections --------------------------------------------------------------------- */

static enum role application_role(uint32_t usage)
{
	switch (usage) {
	case USAGE(PAGE_DESKTOP, 0x01):
	case USAGE(PAGE_DESKTOP, 0x02):
		return ROLE_MOUSE;
	case USAGE(PAGE_DIGITIZER, 0x01):
	case USAGE(PAGE_DIGITIZER, 0x02):
	case USAGE(PAGE_WACOM, 0x01):
	case USAGE(PAGE_WACOM, 0x02):
		return ROLE_PEN;
	case USAGE(PAGE_DIGITIZER, 0x04):
	case USAGE(PAGE_DIGITIZER, 0x05):
	case USAGE(PAGE_DIGITIZER, 0x0e):
		return ROLE_TOUCH;
	}
	return ROLE_NONE;
}

enum { COLLECTION_APPLICATION = 1 };

/* The innermost application counts, as it does for the kernel; what lies in it may say more. */
static enum role collection_role(enum role outer, uint32_t type, uint32_t usage)
{
	if (type == COLLECTION_APPLICATION)
		return application_role(usage);
	if (outer == ROLE_OUTSIDE || outer == ROLE_TOUCH)
		return outer;
	if (usage == USAGE(PAGE_DIGITIZER, 0x22))
		return ROLE_TOUCH;
	if (usage == USAGE(PAGE_DIGITIZER, 0x20) || usage == USAGE(PAGE_WACOM, 0x20))
		return ROLE_PEN;
	return outer;
}

static bool collection_open(struct items *r, uint32_t type)
{
	if (r->depth == COLLECTION_DEPTH_MAX)
		return refuse(r, "collections more than 32 deep");
	enum role outer = r->role[r->depth];
	if (type == COLLECTION_APPLICATION)
		r->application = pen_items_usage(r, 0);
	r->role[++r->depth] = collection_role(outer, type, pen_items_usage(r, 0));
	return true;
}

static bool collection_close(struct items *r)
{
	if (!r->depth)
		return refuse(r, "End Collection without a collection");
	r->depth--;
	return true;
}

/* --- walking ------------------------------------------------------------------------- */

static bool report_grow(struct items *r, uint32_t bits_of[256])
{
	const struct globals *g = &r->global;
	uint32_t *bits = &bits_of[g->report_id];
	if (g->report_size * g->report_count > REPORT_BITS_MAX - *bits)
		return refuse(r, "a report of more than 16 KiB");
	*bits += g->report_size * g->report_count;
	return true;
}

static bool input_item(struct items *r, uint32_t flags)
{
	r->input_flags = flags;
	r->input_start = r->input_bits[r->global.report_id] + (r->ids_used ? 8 : 0);
	return report_grow(r, r->input_bits);
}

static bool main_item(struct items *r, const struct item *item)
{
	switch (item->tag) {
	case MAIN_INPUT:
		return input_item(r, item->value);
	case MAIN_OUTPUT:
		return report_grow(r, r->output_bits);
	case MAIN_FEATURE:
		return report_grow(r, r->feature_bits);
	case 0xa:
		return collection_open(r, item->value);
	case 0xc:
		return collection_close(r);
	}
	return true;
}

static bool item_apply(struct items *r, const struct item *item)
{
	switch (item->type) {
	case TYPE_MAIN:
		return main_item(r, item);
	case TYPE_GLOBAL:
		return global_item(r, item);
	case TYPE_LOCAL:
		return local_item(r, item);
	}
	return true;
}

void pen_items_init(struct items *items, const uint8_t *bytes, int size, char *reason)
{
	*items = (struct items){.bytes = bytes, .size = size, .reason = reason};
}

enum items_event pen_items_next(struct items *items)
{
	struct item item;
	if (items->input_met)
		locals_clear(items);
	items->input_met = false;
	while (item_next(items, &item)) { /* every item moves items->at forward */
		if (!item_apply(items, &item))
			return ITEMS_FAULT;
		items->input_met = item.type == TYPE_MAIN && item.tag == MAIN_INPUT;
		if (items->input_met)
			return ITEMS_INPUT;
		if (item.type == TYPE_MAIN)
			locals_clear(items);
	}
	if (items->at < items->size)
		return ITEMS_FAULT;
	if (items->depth) {
		refuse(items, "a collection is not closed");
		return ITEMS_FAULT;
	}
	return ITEMS_END;
}
