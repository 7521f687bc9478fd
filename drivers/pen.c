/* Pen reports become pen samples.
 *
 *            in range               tip on, pressure >= 5 %
 *    AWAY ------------> HOVER ----------------------------> TOUCH
 *     ^                 |   ^                                 |
 *     |   out of range, |   |  tip off, or pressure < 1 %     |
 *     |   silence       |   +---------------------------------+
 *     +-----------------+                                     |
 *     |   out of range, silence, unplugged                    |
 *     +-------------------------------------------------------+
 *
 * What real pens do, and what is done about it:
 *   - Some never say that they left, and fast lifts lose the last report, so silence ends a stroke.
 *     But many send nothing while the pen rests (in recordings up to 1.3 s). A hand that moved
 * comes to rest through slower reports: silence after motion is a lost lift and ends the stroke
 * soon, silence after rest is rest, and ends it late.
 *   - A position with both axes outside of their ranges means "near, but I do not know where"
 *     (Windows pen contract): the last position holds, and the clock of silence goes on.
 *   - A worn nib presses all the time (pen_nib.c), a flickering switch does not press: contact
 *     begins when both the switch and 5 % of the pressure agree. The percentages are libinput's.
 *   - Nibs bounce, and contacts break off for a moment: what is too short to be meant is taken out
 *     after this machine (pen_settle.h).
 *   - The first contact reads too hard (the nib hits): pressure may rise by a third of its range a
 *     report, so a stroke begins thin.
 */
#include "pen.h"
#include "pen_filter.h"
#include "pen_settle.h"

#include <stdio.h>

enum {
	SILENCE_RESTING_US = 2000000,
	SILENCE_MOVING_US = 500000,
	SILENCE_MOVING_SHORT_US = 100000, /* without In Range nothing else ends it */
	PRESSURE_RAMP_REPORTS = 3,
};

#define RESTING_MM_S 40.0f
#define PRESSURE_UNKNOWN 0.5f /* of a pen that has none, while it touches */

void pen_init(struct pen *pen, int width_px, int height_px)
{
	MUST(width_px > 0 && height_px > 0);
	*pen = (struct pen){.mapping = {.width_px = width_px, .height_px = height_px},
			    .touching = -1,
			    .contact_least_us = PEN_CONTACT_LEAST_US,
			    .merge_us = PEN_MERGE_US};
}

void pen_mount(struct pen *pen, const struct pen_mount *mount)
{
	MUST(mount->degrees >= 0 && mount->degrees < 360 && mount->degrees % 90 == 0);
	MUST(mount->rotation >= 0 && mount->rotation < 360 && mount->rotation % 90 == 0);
	struct pen_mapping *mapping = &pen->mapping;
	mapping->mount = *mount;
	mapping->from_panel = pen_mount_map(mount, mapping->width_px, mapping->height_px, false);
	mapping->from_display = pen_mount_map(mount, mapping->width_px, mapping->height_px, true);
}

static void device_reset(struct pen *pen, int device)
{
	pen->device[device] = (struct pen_device){0};
	if (pen->touching == device)
		pen->touching = -1;
}

static void layouts_learnt(struct pen_device *d)
{
	d->kind = d->layout_count ? DEVICE_PEN : DEVICE_UNKNOWN;
	bool tells_range = d->layout_count > 0;
	for (int i = 0; i < d->layout_count; i++)
		tells_range &= d->layout[i].in_range.size > 0 && !d->layout[i].leaves_silently;
	d->silence_us = tells_range ? SILENCE_MOVING_US : SILENCE_MOVING_SHORT_US;
}

void pen_describe(struct pen *pen, int device, const uint8_t *descriptor, int size)
{
	MUST(device >= 0 && device < PEN_DEVICES_MAX);
	struct pen_device *d = &pen->device[device];
	device_reset(pen, device);
	if (size == buttons_descriptor_size &&
	    !memcmp(descriptor, buttons_descriptor, (size_t)size)) {
		d->kind = DEVICE_BUTTONS;
		return;
	}
	d->layout_count = pen_descriptor_read(descriptor, size, d->layout, d->reason);
	layouts_learnt(d);
	/* The desktop's mouse is our own: exact, it says when it leaves, and nothing while it
	 * rests. */
	d->desktop = size == mouse_descriptor_size &&
		     !memcmp(descriptor, mouse_descriptor, (size_t)size);
}

/* A protocol's reports come first. What the descriptor says about other reports still holds: a
 * tablet that falls back to its default mode is read on. */
int pen_layouts_join(struct pen_layout layout[PEN_REPORTS_MAX], int count,
		     const struct pen_vendor *vendor)
{
	if (vendor->family == PEN_BY_DESCRIPTOR)
		return count;
	MUST(pen_vendor_sound(vendor) && count >= 0 && count <= PEN_REPORTS_MAX);
	count = int_min(count, PEN_REPORTS_MAX - 1);
	memmove(layout + 1, layout, (size_t)count * sizeof *layout);
	pen_vendor_layout(vendor, &layout[0]);
	return count + 1;
}

void pen_vendor_set(struct pen *pen, int device, const struct pen_vendor *vendor)
{
	MUST(device >= 0 && device < PEN_DEVICES_MAX);
	struct pen_device *d = &pen->device[device];
	if (vendor->family == PEN_BY_DESCRIPTOR || d->kind == DEVICE_BUTTONS)
		return;
	d->layout_count = pen_layouts_join(d->layout, d->layout_count, vendor);
	layouts_learnt(d);
}

void pen_resize(struct pen *pen, int device, float width_mm, float height_mm)
{
	MUST(device >= 0 && device < PEN_DEVICES_MAX);
	bool given = width_mm >= 1.0f && height_mm >= 1.0f;
	pen->device[device].width_mm = given ? width_mm : 0.0f;
	pen->device[device].height_mm = given ? height_mm : 0.0f;
}

void pen_is_display(struct pen *pen, int device, bool display)
{
	MUST(device >= 0 && device < PEN_DEVICES_MAX);
	pen->device[device].display = display;
}

/* --- samples ---------------------------------------------------------------------------------- */

static void sample_give(struct pen *pen, int device, const struct pen_sample *sample,
			struct frame_input *input)
{
	struct pen_device *d = &pen->device[device];
	d->heard = *sample;
	pen_settle(pen, device, sample, d->filtered_mm, input);
}

/* The pen is gone: the last position once more, without contact. */
static void sample_away(struct pen *pen, int device, int64_t time_us, struct frame_input *input)
{
	struct pen_device *d = &pen->device[device];
	struct pen_sample sample = d->heard;
	sample.state = PEN_AWAY;
	sample.time_us = time_us;
	sample.pressure = 0.0f;
	sample.barrel = sample.eraser = false;
	d->placed = d->suspected = false;
	sample_give(pen, device, &sample, input);
}

static void silence_check(struct pen *pen, int device, int64_t now_us, struct frame_input *input)
{
	struct pen_device *d = &pen->device[device];
	if (d->kind != DEVICE_PEN || d->heard.state == PEN_AWAY || d->desktop)
		return;
	bool resting = v2_length(d->speed_mm_s) < RESTING_MM_S;
	int64_t limit_us = resting ? SILENCE_RESTING_US : d->silence_us;
	if (now_us - d->last_us >= limit_us) {
		sample_away(pen, device, d->last_us + limit_us, input);
		pen_settle_end(pen, device, input);
	}
}

/* --- one report ------------------------------------------------------------------------------- */

static bool position_null(const struct pen_layout *layout, const struct pen_fields *f)
{
	bool x_outside = f->x < layout->x.minimum || f->x > layout->x.maximum;
	bool y_outside = f->y < layout->y.minimum || f->y > layout->y.maximum;
	return x_outside && y_outside;
}

/* What the tip's pressure is, of a range. */
struct pressed {
	int value, range; /* range 0: the pen has no pressure */
};

static enum pen_state state_next(const struct pen_device *d, const struct pen_layout *layout,
				 const struct pen_fields *f, const struct pressed *pressed)
{
	if (layout->in_range.size && !f->in_range)
		return PEN_AWAY;
	bool on = f->tip || f->eraser || !layout->tip.size;
	if (!layout->pressure.size)
		return on && layout->tip.size ? PEN_TOUCH : PEN_HOVER;
	int64_t share = d->heard.state == PEN_TOUCH ? 100 : 20;
	bool hard = share * pressed->value >= pressed->range;
	return on && hard ? PEN_TOUCH : PEN_HOVER;
}

static float pressure_next(struct pen_device *d, const struct pressed *pressed)
{
	d->contact_reports = int_min(d->contact_reports + 1, PRESSURE_RAMP_REPORTS);
	if (!pressed->range)
		return PRESSURE_UNKNOWN;
	float pressure = (float)pressed->value / (float)pressed->range;
	float most = (float)d->contact_reports / (float)PRESSURE_RAMP_REPORTS;
	return float_clamp(pressure, 0.0f, most);
}

static float tilt(const struct pen_layout *layout, const struct pen_field *field, int value)
{
	if (!field->size)
		return 0.0f;
	/* 0 to 180 means upright at 90 (two real pens) */
	float middle = field->minimum >= 0 ? 0.5f * ((float)field->minimum + (float)field->maximum)
					   : 0.0f;
	return float_clamp(((float)value - middle) * layout->tilt_unit_rad, -0.5f * PI_F,
			   0.5f * PI_F);
}

/* Where the pen is now, in mm: filtered, or where it was while a jump is not confirmed. */
static struct v2 position_next(const struct pen *pen, struct pen_device *d,
			       const struct pen_layout *layout, const struct pen_fields *f,
			       bool drawing, int64_t dt_us)
{
	struct v2 mm = pen_place_mm(pen, d, layout, f);
	if (!d->placed || d->desktop)
		pen_filter_reset(d, mm);
	else if (drawing && pen_jump_held(d, mm, dt_us))
		return d->filtered_mm;
	return pen_filter(d, mm, dt_us);
}

static void pen_report(struct pen *pen, const struct raw_report *report, struct frame_input *input)
{
	struct pen_device *d = &pen->device[report->device];
	struct pen_fields f;
	bool cut_off;
	const struct pen_layout *layout = pen_report_read(d->layout, d->layout_count, report->bytes,
							  report->size, &d->memory, &f, &cut_off);
	d->dropped += cut_off ? 1 : 0;
	if (!layout || (pen->touching >= 0 && pen->touching != report->device))
		return;
	silence_check(pen, report->device, report->time_us, input);
	pen_settle_time(pen, report->device, report->time_us, input);
	struct pressed pressed = {0};
	if (layout->pressure.size && (f.in_range || !layout->in_range.size))
		pressed.value = pen_nib(d, layout, &f, d->heard.state == PEN_AWAY, &pressed.range);
	enum pen_state state = state_next(d, layout, &f, &pressed);
	bool null = position_null(layout, &f);
	if (state == PEN_AWAY || (null && !d->placed)) {
		sample_away(pen, report->device, report->time_us, input);
		return;
	}
	struct pen_sample sample = d->heard;
	sample.time_us = report->time_us;
	if (!null) {
		bool drawing = d->heard.state == PEN_TOUCH && state == PEN_TOUCH;
		struct v2 mm = position_next(pen, d, layout, &f, drawing,
					     report->time_us - d->last_us);
		sample.position_px = pen_mm_to_px(pen, d, layout, mm);
		d->last_us = report->time_us;
	}
	if (d->heard.state != PEN_TOUCH && d->doubt != PEN_LIFTED)
		d->contact_reports = 0;
	sample.state = state;
	sample.pressure = state == PEN_TOUCH ? pressure_next(d, &pressed) : 0.0f;
	sample.tilt_rad = (struct v2){tilt(layout, &layout->tilt_x, f.tilt_x),
				      tilt(layout, &layout->tilt_y, f.tilt_y)};
	sample.eraser = f.invert || f.eraser;
	sample.barrel = f.barrel;
	sample_give(pen, report->device, &sample, input);
}

static void buttons_report(struct pen_device *d, const struct raw_report *report,
			   struct frame_input *input)
{
	if (report->size < 1)
		return;
	uint8_t held = report->bytes[0] & ((1 << BUTTON_COUNT) - 1);
	input->buttons_pressed |= (uint8_t)(held & ~d->buttons_held);
	d->buttons_held = held;
}

/* --- frames ----------------------------------------------------------------------------------- */

static void buttons_collect(const struct pen *pen, struct frame_input *input)
{
	input->buttons_held = 0;
	for (int i = 0; i < PEN_DEVICES_MAX; i++)
		input->buttons_held |= pen->device[i].buttons_held;
}

/* What a device did is forgotten with it: plugged in again it is as it was described, live and on
 * a tape, which describes it once. */
static void device_forget(struct pen_device *d)
{
	d->memory = (struct pen_memory){0};
	d->heard = d->last = (struct pen_sample){0};
	d->last_us = d->doubt_us = 0;
	d->contact_reports = 0;
	memset(d->nib, 0, sizeof d->nib);
	d->raw_mm = d->filtered_mm = d->speed_mm_s = d->suspect_mm = d->lifted_mm = (struct v2){0};
	d->suspected = d->placed = false;
	d->state = PEN_AWAY;
	d->buttons_held = 0;
}

void pen_unplugged(struct pen *pen, int device, struct frame_input *input)
{
	MUST(device >= 0 && device < PEN_DEVICES_MAX);
	struct pen_device *d = &pen->device[device];
	if (d->kind == DEVICE_PEN && d->heard.state != PEN_AWAY)
		sample_away(pen, device, d->heard.time_us, input);
	pen_settle_end(pen, device, input);
	device_forget(d);
	buttons_collect(pen, input);
}

void pen_read(struct pen *pen, const struct frame_reports *reports, int64_t now_us,
	      struct frame_input *input)
{
	MUST(reports->count >= 0 && reports->count <= FRAME_REPORTS_MAX);
	for (int i = 0; i < reports->count; i++) {
		const struct raw_report *report = &reports->report[i];
		if (report->device < 0 || report->device >= PEN_DEVICES_MAX)
			continue;
		struct pen_device *d = &pen->device[report->device];
		if (d->kind == DEVICE_BUTTONS)
			buttons_report(d, report, input);
		else if (d->kind == DEVICE_PEN)
			pen_report(pen, report, input);
	}
	for (int i = 0; i < PEN_DEVICES_MAX; i++) {
		silence_check(pen, i, now_us, input);
		pen_settle_time(pen, i, now_us, input);
	}
	buttons_collect(pen, input);
}
