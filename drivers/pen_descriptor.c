/* HID report descriptors to pen layouts (Device Class Definition for HID 1.11, section 6.2.2).
 *
 *   bytes --item_next--> items --globals, locals, collections--> main items --fields--> candidates
 *   candidates (one a report id) --candidate_accept--> layouts
 *
 * A descriptor comes from a plug that a visitor could have put there. Every table has a bound, the
 * bounds are those of the Linux kernel (include/linux/hid.h), and what exceeds them is refused.
 *
 * Descriptors lie, and these lies are known from real tablets:
 *   - the logical maximum as a negative number: `26 40 9C` means 40000. It is unsigned when the
 *     minimum is not negative (drivers/hid/hid-core.c does the same);
 *   - sizes in cubic inches, or 20 metres wide: a size that no tablet has counts as not stated;
 *   - Secondary Tip Switch where the second barrel button is meant;
 *   - tablets that call themselves a mouse, with absolute X and Y and Tip Pressure.
 */
#include "pen.h"

#include <stdio.h>

enum {
	GLOBAL_STACK_MAX = 4,
	COLLECTION_DEPTH_MAX = 32,
	USAGE_RANGES_MAX = 256,
	USAGES_MAX = 12288,   /* HID_MAX_USAGES */
	FIELD_BITS_MAX = 256, /* a field of more bits is refused by the kernel */
	REPORT_BITS_MAX = 16384 * 8,
	CANDIDATES_MAX = 32,
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

struct item {
	int type, tag, size; /* type 0 main, 1 global, 2 local, 3 long */
	uint32_t value;      /* as it stands */
	int32_t signed_value;
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

/* What one report id has shown so far. */
struct candidate {
	struct pen_layout layout;
	struct pen_field button; /* button 1: the tip of an absolute mouse */
	struct pen_field button_2;
	struct pen_field secondary_tip;
	bool pen, mouse, relative;
	float x_mm, y_mm;
};

struct reader {
	const uint8_t *bytes;
	int size, at;
	struct globals global;
	struct globals stack[GLOBAL_STACK_MAX];
	int stack_depth;
	struct usage_range usage[USAGE_RANGES_MAX];
	int usage_count;
	int usage_total;
	uint32_t usage_minimum;
	bool usage_minimum_given, usage_minimum_extended;
	int delimiter_depth, delimiter_usages;
	enum role role[COLLECTION_DEPTH_MAX + 1]; /* role[depth] holds for the fields in there */
	int depth;
	bool ids_used;
	uint32_t input_bits[256]; /* by report id, without the id byte */
	struct candidate candidate[CANDIDATES_MAX];
	int candidate_count;
	char *reason;
};

static bool refuse(struct reader *r, const char *why)
{
	snprintf(r->reason, 160, "byte %d: %s", r->at, why);
	return false;
}

/* The next item, long items included. False at the end or when the item is cut off. */
static bool item_next(struct reader *r, struct item *item)
{
	static const int sizes[4] = {0, 1, 2, 4};
	if (r->at >= r->size)
		return false;
	uint8_t prefix = r->bytes[r->at];
	if (prefix == 0xfe) {
		if (r->size - r->at < 3 || r->size - r->at - 3 < r->bytes[r->at + 1])
			return refuse(r, "a long item is cut off");
		*item = (struct item){.type = 3};
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

static bool global_push(struct reader *r)
{
	if (r->stack_depth == GLOBAL_STACK_MAX)
		return refuse(r, "more than 4 nested Push items");
	r->stack[r->stack_depth++] = r->global;
	return true;
}

static bool global_pop(struct reader *r)
{
	if (!r->stack_depth)
		return refuse(r, "Pop without Push");
	r->global = r->stack[--r->stack_depth];
	return true;
}

static bool global_report_id(struct reader *r, uint32_t id)
{
	if (id == 0 || id > 255)
		return refuse(r, "a report id outside of 1 to 255");
	r->ids_used = true;
	r->global.report_id = (int)id;
	return true;
}

static bool global_item(struct reader *r, const struct item *item)
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

static bool usage_add(struct reader *r, uint32_t first, uint32_t last, bool extended)
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

static bool local_item(struct reader *r, const struct item *item)
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

static void locals_clear(struct reader *r)
{
	r->usage_count = r->usage_total = 0;
	r->usage_minimum_given = false;
	r->delimiter_depth = r->delimiter_usages = 0;
}

/* Usage number `index` of the current main item; the last one holds for all further fields. */
static uint32_t usage_at(const struct reader *r, int index)
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

/* The innermost application counts, as it does for the kernel; what lies in it may say more. */
static enum role collection_role(enum role outer, uint32_t type, uint32_t usage)
{
	enum { COLLECTION_APPLICATION = 1 };
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

static bool collection_open(struct reader *r, uint32_t type)
{
	if (r->depth == COLLECTION_DEPTH_MAX)
		return refuse(r, "collections more than 32 deep");
	enum role outer = r->role[r->depth];
	r->role[++r->depth] = collection_role(outer, type, usage_at(r, 0));
	return true;
}

static bool collection_close(struct reader *r)
{
	if (!r->depth)
		return refuse(r, "End Collection without a collection");
	r->depth--;
	return true;
}

/* --- fields -------------------------------------------------------------------------- */

static struct candidate *candidate_at(struct reader *r, int report_id)
{
	for (int i = 0; i < r->candidate_count; i++)
		if (r->candidate[i].layout.report_id == report_id)
			return &r->candidate[i];
	if (r->candidate_count == CANDIDATES_MAX)
		return NULL;
	struct candidate *candidate = &r->candidate[r->candidate_count++];
	*candidate = (struct candidate){.layout.report_id = report_id};
	return candidate;
}

/* A maximum below a minimum that is not negative was meant unsigned. */
static int64_t maximum_meant(int32_t minimum, int32_t maximum, uint32_t raw)
{
	return minimum >= 0 && maximum < minimum ? (int64_t)raw : maximum;
}

static struct pen_field field_here(const struct reader *r, uint32_t bit)
{
	const struct globals *g = &r->global;
	int64_t maximum = maximum_meant(g->logical_minimum, g->logical_maximum,
					g->logical_maximum_raw);
	return (struct pen_field){
		.bit = (int)bit,
		.size = (int)g->report_size,
		.is_signed =
			g->logical_minimum<0, .minimum = g->logical_minimum, .maximum = maximum>
					INT32_MAX
				? INT32_MAX
				: (int)maximum,
	};
}

static float power_of_ten(int exponent)
{
	float power = 1.0f;
	for (int i = 0; i < exponent; i++)
		power *= 10.0f;
	for (int i = 0; i > exponent; i--)
		power /= 10.0f;
	return power;
}

static float physical_range(const struct globals *g)
{
	int64_t maximum = maximum_meant(g->physical_minimum, g->physical_maximum,
					g->physical_maximum_raw);
	return (float)(maximum - g->physical_minimum) * power_of_ten(g->unit_exponent);
}

/* The physical extent of the current field in mm; 0 when the unit is no length. */
static float extent_mm(const struct globals *g)
{
	float mm = g->unit == 0x11 ? 10.0f : g->unit == 0x13 ? 25.4f : 0.0f;
	return physical_range(g) * mm;
}

/* Radians of one logical unit: from the physical range when that is an angle of a pen, else the
 * customs are degrees and hundredths of a degree. */
static float tilt_unit(const struct globals *g, const struct pen_field *field)
{
	float logical = (float)((int64_t)field->maximum - field->minimum);
	float degree = PI_F / 180.0f;
	float unit = g->unit == 0x14 ? degree : g->unit == 0x12 ? 1.0f : 0.0f;
	float range = physical_range(g) * unit;
	if (logical > 0.0f && range > 30.0f * degree && range < 181.0f * degree)
		return range / logical;
	return field->maximum > 1000 ? degree / 100.0f : degree;
}

static void field_once(struct pen_field *slot, struct pen_field field)
{
	if (!slot->size)
		*slot = field;
}

static void field_desktop(struct candidate *c, uint32_t id, struct pen_field field,
			  const struct globals *g)
{
	if (id == 0x30 && !c->layout.x.size) {
		c->layout.x = field;
		c->x_mm = extent_mm(g);
	}
	if (id == 0x31 && !c->layout.y.size) {
		c->layout.y = field;
		c->y_mm = extent_mm(g);
	}
}

static void field_digitizer(struct candidate *c, uint32_t id, struct pen_field field,
			    const struct globals *g, bool wacom)
{
	struct pen_layout *layout = &c->layout;
	switch (id) {
	case 0x30:
		field_once(&layout->pressure, field);
		break;
	case 0x32:
		field_once(&layout->in_range, field);
		break;
	case 0x36: /* Wacom's Sense stays on for as long as the pen is noticed at all */
		if (wacom)
			layout->in_range = field;
		break;
	case 0x3c:
		field_once(&layout->invert, field);
		break;
	case 0x3d:
		if (!layout->tilt_x.size)
			layout->tilt_unit_rad = tilt_unit(g, &field);
		field_once(&layout->tilt_x, field);
		break;
	case 0x3e:
		field_once(&layout->tilt_y, field);
		break;
	case 0x41:
		field_once(&layout->twist, field);
		break;
	case 0x42:
		field_once(&layout->tip, field);
		break;
	case 0x43:
		field_once(&c->secondary_tip, field);
		break;
	case 0x44:
		field_once(&layout->barrel, field);
		break;
	case 0x45:
		field_once(&layout->eraser, field);
		break;
	case 0x5a:
		field_once(&layout->barrel_2, field);
		break;
	case 0x5b:
		field_once(&layout->serial, field);
		break;
	}
}

/* One field of an input report: variable data within a collection that could be a pen's. */
static void field_add(struct reader *r, uint32_t usage, uint32_t bit, bool relative)
{
	uint32_t page = usage >> 16, id = usage & 0xffff;
	struct pen_field field = field_here(r, bit);
	if (field.size < 1 || field.size > 32)
		return;
	struct candidate *c = candidate_at(r, r->global.report_id);
	if (!c)
		return;
	c->pen |= r->role[r->depth] == ROLE_PEN;
	c->mouse |= r->role[r->depth] == ROLE_MOUSE;
	/* Wacom's page has X and Y as 0x130 and 0x131, and the digitizer's ids as they are. */
	bool wacom_axis = page == PAGE_WACOM && (id == 0x130 || id == 0x131);
	if (page == PAGE_DESKTOP || wacom_axis) {
		c->relative |= relative && (id == 0x30 || id == 0x31);
		field_desktop(c, id & 0xff, field, &r->global);
	} else if (page == PAGE_DIGITIZER || page == PAGE_WACOM) {
		field_digitizer(c, id, field, &r->global, page == PAGE_WACOM);
	} else if (page == PAGE_BUTTON && id == 1) {
		field_once(&c->button, field);
	} else if (page == PAGE_BUTTON && id == 2) {
		field_once(&c->button_2, field);
	}
}

static bool input_item(struct reader *r, uint32_t flags)
{
	const struct globals *g = &r->global;
	uint32_t *bits = &r->input_bits[g->report_id];
	uint32_t start = *bits + (r->ids_used ? 8 : 0);
	if (g->report_size * g->report_count > REPORT_BITS_MAX - *bits)
		return refuse(r, "a report of more than 16 KiB");
	*bits += g->report_size * g->report_count;
	bool constant = flags & 1, variable = flags & 2, relative = flags & 4;
	enum role role = r->role[r->depth];
	if (constant || !variable || !r->usage_count || (role != ROLE_PEN && role != ROLE_MOUSE))
		return true;
	/* Only as many fields as there are usages have a meaning of their own. */
	int count = int_min((int)g->report_count, r->usage_total);
	for (int i = 0; i < count; i++)
		field_add(r, usage_at(r, i), start + (uint32_t)i * g->report_size, relative);
	return true;
}

static bool main_item(struct reader *r, const struct item *item)
{
	bool sound = true;
	if (item->tag == 0x8)
		sound = input_item(r, item->value);
	else if (item->tag == 0xa)
		sound = collection_open(r, item->value);
	else if (item->tag == 0xc)
		sound = collection_close(r);
	locals_clear(r);
	return sound;
}

/* --- candidates to layouts ----------------------------------------------------------- */

/* A tablet's size is believed between a playing card and a 40 inch display, with a resolution of at
 * most 10160 lines an inch (twice the finest that is sold). */
static bool size_believable(const struct candidate *c)
{
	const struct pen_layout *l = &c->layout;
	float x_units = (float)l->x.maximum - (float)l->x.minimum;
	float y_units = (float)l->y.maximum - (float)l->y.minimum;
	return c->x_mm >= 50.0f && c->x_mm <= 900.0f && c->y_mm >= 30.0f && c->y_mm <= 600.0f &&
	       x_units / c->x_mm <= 400.0f && y_units / c->y_mm <= 400.0f;
}

static bool axis_sound(const struct pen_field *field)
{
	return field->size && field->maximum > field->minimum && field->size <= 32;
}

static bool candidate_accept(const struct reader *r, struct candidate *c)
{
	struct pen_layout *l = &c->layout;
	if (!axis_sound(&l->x) || !axis_sound(&l->y) || c->relative)
		return false;
	if (l->pressure.maximum <= l->pressure.minimum)
		l->pressure = (struct pen_field){0};
	bool contact = l->tip.size || l->pressure.size || l->in_range.size;
	if (c->mouse && !c->pen) {
		if (!l->pressure.size)
			return false;
		l->absolute_mouse = true;
		l->tip = c->button;
		l->barrel = c->button_2;
	} else if (!c->pen || !contact) {
		return false;
	}
	if (!l->barrel_2.size)
		l->barrel_2 = c->secondary_tip;
	if (!l->tilt_x.size || !l->tilt_y.size)
		l->tilt_x = l->tilt_y = (struct pen_field){0};
	if (size_believable(c)) {
		l->width_mm = c->x_mm;
		l->height_mm = c->y_mm;
	}
	l->report_bits = (int)r->input_bits[l->report_id] + (r->ids_used ? 8 : 0);
	return l->report_bits <= 8 * REPORT_BYTES_MAX;
}

static bool descriptor_walk(struct reader *r)
{
	struct item item;
	while (item_next(r, &item)) { /* every item moves r->at forward */
		bool sound = item.type == 0   ? main_item(r, &item)
			     : item.type == 1 ? global_item(r, &item)
			     : item.type == 2 ? local_item(r, &item)
					      : true;
		if (!sound)
			return false;
	}
	if (r->at < r->size)
		return false;
	if (r->depth)
		return refuse(r, "a collection is not closed");
	return true;
}

int pen_descriptor_read(const uint8_t *descriptor, int size,
			struct pen_layout layout[PEN_REPORTS_MAX], char reason[160])
{
	struct reader r = {.bytes = descriptor, .size = size, .reason = reason};
	if (size < 1 || size > DESCRIPTOR_BYTES_MAX) {
		snprintf(reason, 160, "a report descriptor has 1 to %d bytes, not %d",
			 DESCRIPTOR_BYTES_MAX, size);
		return 0;
	}
	if (!descriptor_walk(&r))
		return 0;
	int count = 0;
	for (int i = 0; i < r.candidate_count && count < PEN_REPORTS_MAX; i++)
		if (candidate_accept(&r, &r.candidate[i]))
			layout[count++] = r.candidate[i].layout;
	snprintf(reason, 160, "%s", count ? "" : "no report with a pen's position and contact");
	return count;
}

bool pen_descriptor_sound(const uint8_t *descriptor, int size)
{
	char reason[160];
	struct reader r = {.bytes = descriptor, .size = size, .reason = reason};
	return size >= 1 && size <= DESCRIPTOR_BYTES_MAX && descriptor_walk(&r);
}
