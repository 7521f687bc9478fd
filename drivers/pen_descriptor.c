/* HID report descriptors to pen layouts (Device Class Definition for HID 1.11, section 6.2.2).
 *
 *   bytes --pen_items_next--> input items --field_add--> candidates, one a report id
 *   candidates --candidate_accept--> layouts
 *
 * A descriptor comes from a plug that a visitor could have put there, and descriptors lie. These
 * lies are known from real tablets:
 *   - the maximum as a negative number: `26 40 9C` means 40000. It is unsigned when the minimum is
 *     not negative (drivers/hid/hid-core.c does the same);
 *   - sizes in cubic inches, or 20 metres wide: a size that no tablet has counts as not stated;
 *   - Secondary Tip Switch where the second barrel button is meant;
 *   - tablets that call themselves a mouse, with absolute X and Y and Tip Pressure.
 */
#include "pen_items.h"

#include <stdio.h>

enum { CANDIDATES_MAX = 32 };

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
	struct items items;
	struct candidate candidate[CANDIDATES_MAX];
	int candidate_count;
};

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

static struct pen_field field_here(const struct globals *g, uint32_t bit)
{
	int64_t maximum = maximum_meant(g->logical_minimum, g->logical_maximum,
					g->logical_maximum_raw);
	bool negative = g->logical_minimum < 0;
	int bounded = maximum > INT32_MAX ? INT32_MAX : (int)maximum;
	return (struct pen_field){
		.bit = (int)bit,
		.size = (int)g->report_size,
		.is_signed = negative,
		.minimum = g->logical_minimum,
		.maximum = bounded,
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
	const struct globals *g = &r->items.global;
	enum role role = r->items.role[r->items.depth];
	struct pen_field field = field_here(g, bit);
	if (field.size < 1 || field.size > 32)
		return;
	struct candidate *c = candidate_at(r, g->report_id);
	if (!c)
		return;
	c->pen |= role == ROLE_PEN;
	c->mouse |= role == ROLE_MOUSE;
	/* Wacom's page has X and Y as 0x130 and 0x131, and the digitizer's ids as they are. */
	bool wacom_axis = page == PAGE_WACOM && (id == 0x130 || id == 0x131);
	if (page == PAGE_DESKTOP || wacom_axis) {
		c->relative |= relative && (id == 0x30 || id == 0x31);
		field_desktop(c, id & 0xff, field, g);
	} else if (page == PAGE_DIGITIZER || page == PAGE_WACOM) {
		field_digitizer(c, id, field, g, page == PAGE_WACOM);
	} else if (page == PAGE_BUTTON && id == 1) {
		field_once(&c->button, field);
	} else if (page == PAGE_BUTTON && id == 2) {
		field_once(&c->button_2, field);
	}
}

static void input_add(struct reader *r)
{
	const struct items *items = &r->items;
	bool constant = items->input_flags & 1, variable = items->input_flags & 2;
	enum role role = items->role[items->depth];
	if (constant || !variable || (role != ROLE_PEN && role != ROLE_MOUSE))
		return;
	/* Only as many fields as there are usages have a meaning of their own, and a report with
	 * more bits than we take is no pen's: a hostile descriptor makes little work. */
	int count = int_min((int)items->global.report_count, items->usage_total);
	count = int_min(count, 8 * REPORT_BYTES_MAX);
	if (items->input_start >= 8 * REPORT_BYTES_MAX || items->global.report_size == 0)
		return;
	for (int i = 0; i < count; i++)
		field_add(r, pen_items_usage(items, i),
			  items->input_start + (uint32_t)i * items->global.report_size,
			  items->input_flags & 4);
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
	if (r->items.ids_used && !l->report_id)
		return false;
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
	l->report_bits = (int)r->items.input_bits[l->report_id] + (r->items.ids_used ? 8 : 0);
	return l->report_bits <= 8 * REPORT_BYTES_MAX;
}

static bool size_sound(int size, char reason[160])
{
	bool sound = size >= 1 && size <= DESCRIPTOR_BYTES_MAX;
	snprintf(reason, 160, "a report descriptor has 1 to %d bytes, not %d", DESCRIPTOR_BYTES_MAX,
		 size);
	return sound;
}

int pen_descriptor_read(const uint8_t *descriptor, int size,
			struct pen_layout layout[PEN_REPORTS_MAX], char reason[160])
{
	struct reader r = {.candidate_count = 0};
	enum items_event event;
	if (!size_sound(size, reason))
		return 0;
	pen_items_init(&r.items, descriptor, size, reason);
	while ((event = pen_items_next(&r.items)) == ITEMS_INPUT)
		input_add(&r);
	if (event == ITEMS_FAULT)
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
	struct items items;
	enum items_event event = ITEMS_INPUT;
	char reason[160];
	if (!size_sound(size, reason))
		return false;
	pen_items_init(&items, descriptor, size, reason);
	while (event == ITEMS_INPUT)
		event = pen_items_next(&items);
	return event == ITEMS_END;
}
