/* Comments of a tape: those that say what only we need; see tape_reader.h. */
#include "tape_reader.h"

static bool comment_tablet(struct reader *r)
{
	int64_t device = reader_number(r, 10, 3);
	float width_mm = reader_mm(r), height_mm = reader_mm(r);
	if (device < 0 || device >= TAPE_DEVICES_MAX || width_mm < 1.0f || height_mm < 1.0f)
		return reader_fault(
			r, "it reads like # tablet 0 203.2 127.0, device, width and height");
	r->tape->device[device].width_mm = width_mm;
	r->tape->device[device].height_mm = height_mm;
	return true;
}

static bool comment_display(struct reader *r)
{
	int64_t device = reader_number(r, 10, 3);
	if (device < 0 || device >= TAPE_DEVICES_MAX)
		return reader_fault(r, "it reads like # display 0, the device's number");
	r->tape->device[device].display = true;
	return true;
}

/* A whole turn's quarters. */
static bool quarter(int64_t degrees)
{
	return degrees >= 0 && degrees < 360 && degrees % 90 == 0;
}

static bool comment_mount(struct reader *r)
{
	struct pen_mount *mount = &r->tape->mount;
	int64_t degrees = reader_number(r, 10, 3), display = reader_number(r, 10, 1);
	int64_t width = reader_number(r, 10, 5), height = reader_number(r, 10, 5);
	int64_t rotation = reader_number(r, 10, 3);
	bool panel = (width == 0 && height == 0) ||
		     (width > 0 && width <= 16384 && height > 0 && height <= 16384);
	if (!quarter(degrees) || display < 0 || display > 1 || !panel || !quarter(rotation))
		return reader_fault(
			r, "it reads like # mount 180 1 1920 1080 90, the tablet's turn, pen "
			   "display or not, the panel's pixels, the picture's turn");
	mount->degrees = (int)degrees;
	mount->display = display;
	mount->panel_width = (int)width;
	mount->panel_height = (int)height;
	mount->rotation = (int)rotation;
	return true;
}

static bool comment_cross(struct reader *r)
{
	struct pen_mount *mount = &r->tape->mount;
	int64_t number[4];
	bool sound = mount->cross_count < PLANE_MAP_POINTS_MAX;
	for (int i = 0; i < 4; i++) {
		number[i] = reader_number(r, 10, 7);
		sound &= number[i] >= 0 && number[i] <= 1638400;
	}
	if (!sound)
		return reader_fault(r, "at most 25 crosses, like # cross 9612 5390 9600 5400, in "
				       "hundredths of a pixel");
	mount->cross[mount->cross_count++] = (struct pen_cross){(int)number[0], (int)number[1],
								(int)number[2], (int)number[3]};
	return true;
}

/* A tape records one protocol for each device: the one that its reports from there on speak. */
static bool comment_vendor(struct reader *r)
{
	int64_t device = reader_number(r, 10, 3);
	reader_blanks(r);
	const char *word = r->c;
	while (r->c < r->stop && *r->c != ' ' && *r->c != '\t')
		r->c++;
	struct pen_vendor speaks = {.family = pen_family_named(word, (size_t)(r->c - word))};
	if (speaks.family == PEN_FAMILIES)
		return reader_fault(r,
				    "a protocol that this program does not know; a newer one may");
	speaks.x_maximum = (int)reader_number(r, 10, 8);
	speaks.y_maximum = (int)reader_number(r, 10, 8);
	speaks.pressure_maximum = (int)reader_number(r, 10, 5);
	if (device < 0 || device >= TAPE_DEVICES_MAX || !pen_vendor_sound(&speaks))
		return reader_fault(r,
				    "it reads like # vendor 0 uclogic-2 50800 31750 8191, device, "
				    "protocol, ranges of x, y and pressure");
	r->tape->device[device].speaks = speaks;
	return true;
}

static bool comment_unplug(struct reader *r)
{
	int64_t device = reader_number(r, 10, 3);
	reader_blanks(r);
	int64_t time_us = reader_skip(r, "at ") ? reader_time_us(r) : -1;
	if (device < 0 || device >= TAPE_DEVICES_MAX || time_us < 0)
		return reader_fault(r, "it reads like # unplug 0 at 000002.000000");
	uint8_t none = 0;
	return reader_event(r, time_us, (int)device, 0, &none);
}

bool reader_comment(struct reader *r)
{
	struct tape *tape = r->tape;
	reader_blanks(r);
	if (reader_skip(r, "kitsuke-tape ")) {
		r->ours = true;
		return reader_number(r, 10, 4) == 1 ||
		       reader_fault(r, "this program reads version 1 of kitsuke tapes only");
	}
	if (!r->ours)
		return true;
	if (reader_skip(r, "board ")) {
		int64_t width = reader_number(r, 10, 5), height = reader_number(r, 10, 5);
		if (width < 1 || width > 16384 || height < 1 || height > 16384)
			return reader_fault(r, "a screen is 1 to 16384 pixels wide and high");
		tape->width_px = (int)width;
		tape->height_px = (int)height;
	} else if (reader_skip(r, "budget ")) {
		int64_t units = reader_number(r, 10, 9);
		if (units < 1)
			return reader_fault(
				r, "a budget is a number of work units from 1 to 999999999");
		tape->budget_units = (long)units;
	} else if (reader_skip(r, "frames ")) {
		int64_t frames = reader_number(r, 10, 7);
		if (frames < 1 || frames > TAPE_TIME_MAX_US / SECOND_US * FRAME_RATE_HZ)
			return reader_fault(r,
					    "a tape has at least one frame and at most 24 hours");
		tape->frame_count = (int)frames;
	} else if (reader_skip(r, "mount ")) {
		return comment_mount(r);
	} else if (reader_skip(r, "cross ")) {
		return comment_cross(r);
	} else if (reader_skip(r, "tablet ")) {
		return comment_tablet(r);
	} else if (reader_skip(r, "display ")) {
		return comment_display(r);
	} else if (reader_skip(r, "vendor ")) {
		return comment_vendor(r);
	} else if (reader_skip(r, "unplug ")) {
		return comment_unplug(r);
	}
	return true;
}
