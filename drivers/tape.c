/* Playing and writing tapes; tape_read.c reads them. */
#include "tape.h"

#include <stdio.h>

#define SECOND_US INT64_C(1000000)

int64_t tape_frame_us(int frame)
{
	return (frame * SECOND_US + FRAME_RATE_HZ - 1) / FRAME_RATE_HZ;
}

unsigned tape_frame(const struct tape *tape, int frame, size_t *cursor,
		    struct frame_reports *reports)
{
	unsigned unplugged = 0;
	reports->count = 0;
	for (; *cursor < tape->event_count; (*cursor)++) {
		const struct tape_event *event = &tape->event[*cursor];
		if (event->time_us * FRAME_RATE_HZ / SECOND_US > frame)
			break;
		if (unplugged & 1u << event->device)
			break;
		if (event->size == 0) {
			unplugged |= 1u << event->device;
			continue;
		}
		if (reports->count == FRAME_REPORTS_MAX)
			break;
		struct raw_report *report = &reports->report[reports->count++];
		report->device = event->device;
		report->time_us = event->time_us;
		report->size = event->size;
		memcpy(report->bytes, tape->bytes + event->offset, (size_t)event->size);
	}
	return unplugged;
}

/* --- writing ------------------------------------------------------------------------- */

static int write_bytes(char *line, const uint8_t *bytes, int size)
{
	static const char digits[] = "0123456789abcdef";
	char *at = line;
	for (int i = 0; i < size; i++) {
		*at++ = ' ';
		*at++ = digits[bytes[i] >> 4];
		*at++ = digits[bytes[i] & 15];
	}
	*at++ = '\n';
	*at = 0;
	return (int)(at - line);
}

/* Which of the comments on top have something to say; `part` counts only those. */
int tape_write_head(char *line, const struct tape *tape, int part)
{
	int index = 0;
	if (part == index++)
		return snprintf(line, TAPE_LINE_MAX, "# kitsuke-tape 1\n");
	if (tape->width_px && part == index++)
		return snprintf(line, TAPE_LINE_MAX, "# board %d %d\n", tape->width_px,
				tape->height_px);
	if (tape->budget_units && part == index++)
		return snprintf(line, TAPE_LINE_MAX, "# budget %ld\n", tape->budget_units);
	const struct pen_mount *mount = &tape->mount;
	if ((mount->degrees || mount->panel_width) && part == index++)
		return snprintf(line, TAPE_LINE_MAX, "# mount %d %d %d %d %d\n", mount->degrees,
				mount->display, mount->panel_width, mount->panel_height,
				mount->rotation);
	for (int i = 0; i < mount->cross_count; i++)
		if (part == index++)
			return snprintf(line, TAPE_LINE_MAX, "# cross %d %d %d %d\n",
					mount->cross[i].seen_x, mount->cross[i].seen_y,
					mount->cross[i].meant_x, mount->cross[i].meant_y);
	if (tape->frame_count && part == index++)
		return snprintf(line, TAPE_LINE_MAX, "# frames %d\n", tape->frame_count);
	return 0;
}

/* What not every device has; `part` counts only what this one has. */
static int write_rare(char *line, int device, const struct tape_device *description, int part)
{
	const struct pen_vendor *vendor = &description->speaks;
	int index = 0;
	if (description->width_mm >= 1.0f && part == index++)
		return snprintf(line, TAPE_LINE_MAX, "# tablet %d %.2f %.2f\n", device,
				(double)description->width_mm, (double)description->height_mm);
	if (description->display && part == index++)
		return snprintf(line, TAPE_LINE_MAX, "# display %d\n", device);
	if (vendor->family != PEN_BY_DESCRIPTOR && part == index++)
		return snprintf(line, TAPE_LINE_MAX, "# vendor %d %s %d %d %d\n", device,
				pen_family_rule(vendor->family)->word, vendor->x_maximum,
				vendor->y_maximum, vendor->pressure_maximum);
	return 0;
}

int tape_write_device(char *line, int device, const struct tape_device *description, int part)
{
	int length;
	switch (part) {
	case 0:
		return tape_write_select(line, device);
	case 1:
		length = snprintf(line, TAPE_LINE_MAX, "R: %d", description->descriptor_size);
		return length + write_bytes(line + length, description->descriptor,
					    description->descriptor_size);
	case 2:
		return snprintf(line, TAPE_LINE_MAX, "N: %s\n", description->name);
	case 3:
		return snprintf(line, TAPE_LINE_MAX, "P: kitsuke/input%d\n", device);
	case 4:
		return snprintf(line, TAPE_LINE_MAX, "I: %x %04x %04x\n",
				(unsigned)description->bus & 0xffff,
				(unsigned)description->vendor & 0xffff,
				(unsigned)description->product & 0xffff);
	}
	return write_rare(line, device, description, part - 5);
}

int tape_write_select(char *line, int device)
{
	return snprintf(line, TAPE_LINE_MAX, "D: %d\n", device);
}

int tape_write_event(char *line, int64_t time_us, int size, const uint8_t *bytes)
{
	int length = snprintf(line, TAPE_LINE_MAX, "E: %06lld.%06lld %d",
			      (long long)(time_us / SECOND_US), (long long)(time_us % SECOND_US),
			      size);
	return length + write_bytes(line + length, bytes, size);
}

int tape_write_unplug(char *line, int64_t time_us, int device)
{
	return snprintf(line, TAPE_LINE_MAX, "# unplug %d at %06lld.%06lld\n", device,
			(long long)(time_us / SECOND_US), (long long)(time_us % SECOND_US));
}

int tape_write_end(char *line, int frames, uint64_t hash)
{
	return snprintf(line, TAPE_LINE_MAX, "# frames %d\n# hash %016llx\n", frames,
			(unsigned long long)hash);
}
