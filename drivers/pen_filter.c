/* Positions from logical units to pixels; see pen_filter.h. */
#include "pen_filter.h"

/* A tablet that does not say how large it is counts as this wide: the filter's speeds are then
 * right within a factor of two. */
#define WIDTH_GUESSED_MM 254.0f

/* 1-euro parameters. At rest 3 Hz takes the tremor of a sensor out; at 50 mm/s the cutoff is 53 Hz,
 * a lag of 3 ms, less than a report of the usual 250 Hz. */
#define CUTOFF_REST_HZ 3.0f
#define CUTOFF_PER_SPEED 1.0f /* Hz for each mm/s */
#define SPEED_CUTOFF_HZ 12.0f
#define JITTER_MM 0.1f /* as far as this the result may stay behind at rest */

/* Faster than any hand draws. */
#define JUMP_MM_S 3000.0f
#define JUMP_LEAST_MM 10.0f

static bool is_display(const struct pen_mapping *mapping, const struct pen_device *device)
{
	return !device->desktop && (mapping->mount.display || device->display);
}

/* What a device's positions lie on: the panel for a pen display and for the desktop's mouse, which
 * is never askew; else the picture. */
static struct v2 surface_px(const struct pen_mapping *mapping, const struct pen_device *device)
{
	const struct pen_mount *mount = &mapping->mount;
	if (mount->panel_width > 0 && (is_display(mapping, device) || device->desktop))
		return (struct v2){(float)mount->panel_width, (float)mount->panel_height};
	return (struct v2){(float)mapping->width_px, (float)mapping->height_px};
}

static struct v2 tablet_size_mm(const struct pen *pen, const struct pen_device *device,
				const struct pen_layout *layout)
{
	if (device->width_mm > 0.0f)
		return (struct v2){device->width_mm, device->height_mm};
	if (layout->width_mm > 0.0f)
		return (struct v2){layout->width_mm, layout->height_mm};
	float x_range = (float)((int64_t)layout->x.maximum - layout->x.minimum);
	float y_range = (float)((int64_t)layout->y.maximum - layout->y.minimum);
	/* Equal ranges are no square tablet, they are normalised: take the screen's aspect. */
	if (x_range == y_range) {
		struct v2 surface = surface_px(&pen->mapping, device);
		x_range = surface.x;
		y_range = surface.y;
	}
	return (struct v2){WIDTH_GUESSED_MM, WIDTH_GUESSED_MM * y_range / x_range};
}

static float axis_fraction(const struct pen_field *field, int value)
{
	int64_t inside = int_clamp(value, field->minimum, field->maximum);
	int64_t range = (int64_t)field->maximum - field->minimum;
	return (float)(inside - field->minimum) / (float)range;
}

struct v2 pen_place_mm(const struct pen *pen, const struct pen_device *device,
		       const struct pen_layout *layout, const struct pen_fields *fields)
{
	struct v2 size_mm = tablet_size_mm(pen, device, layout);
	return (struct v2){axis_fraction(&layout->x, fields->x) * size_mm.x,
			   axis_fraction(&layout->y, fields->y) * size_mm.y};
}

static struct v2 on_screen(struct v2 px, struct v2 size_px)
{
	return (struct v2){float_clamp(px.x, 0.0f, size_px.x - 1.0f),
			   float_clamp(px.y, 0.0f, size_px.y - 1.0f)};
}

/* Clockwise by quarter turns, y down. */
static struct v2 turned(struct v2 a, int degrees)
{
	switch (degrees) {
	case 90:
		return (struct v2){-a.y, a.x};
	case 180:
		return (struct v2){-a.x, -a.y};
	case 270:
		return (struct v2){a.y, -a.x};
	default:
		return a;
	}
}

struct v2 pen_mm_to_px(const struct pen *pen, const struct pen_device *device,
		       const struct pen_layout *layout, struct v2 mm)
{
	const struct pen_mapping *mapping = &pen->mapping;
	struct v2 size_mm = tablet_size_mm(pen, device, layout);
	struct v2 size_px = {(float)mapping->width_px, (float)mapping->height_px};
	struct v2 surface = surface_px(mapping, device);
	int degrees = device->desktop ? 0 : mapping->mount.degrees;
	struct v2 from_centre = turned(v2_sub(mm, v2_scale(size_mm, 0.5f)), degrees);
	if (degrees % 180)
		size_mm = (struct v2){size_mm.y, size_mm.x};
	struct v2 scale = {surface.x / size_mm.x, surface.y / size_mm.y};
	/* a display's area is the panel, however exactly its size is told */
	if (!is_display(mapping, device))
		scale.x = scale.y = float_max(scale.x, scale.y);
	struct v2 px = v2_add((struct v2){from_centre.x * scale.x, from_centre.y * scale.y},
			      v2_scale(surface, 0.5f));
	if (device->desktop && mapping->mount.panel_width > 0)
		px = plane_map_apply(&mapping->from_panel, px);
	else if (is_display(mapping, device))
		px = plane_map_apply(&mapping->from_display, px);
	return on_screen(px, size_px);
}

static float seconds(int64_t dt_us)
{
	int64_t bounded = dt_us < 500 ? 500 : dt_us > 100000 ? 100000 : dt_us;
	return (float)bounded * 1e-6f;
}

bool pen_jump(struct v2 from_mm, struct v2 to_mm, int64_t dt_us)
{
	float distance_mm = v2_distance(from_mm, to_mm);
	return distance_mm > JUMP_LEAST_MM && distance_mm > JUMP_MM_S * seconds(dt_us);
}

bool pen_jump_held(struct pen_device *device, struct v2 mm, int64_t dt_us)
{
	if (device->suspected && !pen_jump(device->suspect_mm, mm, dt_us)) {
		device->suspected = false;
		pen_filter_reset(device, mm);
		return false;
	}
	device->suspected = pen_jump(device->raw_mm, mm, dt_us);
	device->suspect_mm = mm;
	return device->suspected;
}

void pen_filter_reset(struct pen_device *device, struct v2 mm)
{
	device->raw_mm = device->filtered_mm = mm;
	device->speed_mm_s = (struct v2){0};
	device->suspected = false;
	device->placed = true;
}

/* The share of the new value in a first-order low pass. */
static float low_pass_share(float cutoff_hz, float dt_s)
{
	float turns = 2.0f * PI_F * cutoff_hz * dt_s;
	return turns / (1.0f + turns);
}

struct v2 pen_filter(struct pen_device *device, struct v2 mm, int64_t dt_us)
{
	float dt_s = seconds(dt_us);
	struct v2 step_mm = v2_sub(mm, device->raw_mm);
	device->raw_mm = mm;
	device->speed_mm_s = v2_lerp(device->speed_mm_s, v2_scale(step_mm, 1.0f / dt_s),
				     low_pass_share(SPEED_CUTOFF_HZ, dt_s));
	float cutoff_hz = CUTOFF_REST_HZ + CUTOFF_PER_SPEED * v2_length(device->speed_mm_s);
	struct v2 filtered = v2_lerp(device->filtered_mm, mm, low_pass_share(cutoff_hz, dt_s));
	/* Never further behind than this report's own way: one report's delay. */
	float behind_mm = v2_distance(filtered, mm);
	float most_mm = float_max(v2_length(step_mm), JITTER_MM);
	if (behind_mm > most_mm)
		filtered = v2_lerp(mm, filtered, most_mm / behind_mm);
	device->filtered_mm = filtered;
	return filtered;
}
