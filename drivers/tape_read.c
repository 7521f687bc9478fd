/* Reading tapes: the whole, events, and hid-recorder's lines; see tape_reader.h. */
#include "tape_reader.h"

#include <stdio.h>
#include <stdlib.h>

/* Clocks that step and devices that are read in turn bring times back by a little. */
#define TIME_BACK_MAX_US SECOND_US

/* --- events ---------------------------------------------------------------------- */

bool reader_event(struct reader *r, int64_t time_us, int device, int size, const uint8_t *bytes)
{
	struct tape *tape = r->tape;
	if (time_us > TAPE_TIME_MAX_US)
		return reader_fault(r, "a time beyond 24 hours; times count from the tape's start");
	if (r->last_us - time_us > TIME_BACK_MAX_US)
		return reader_fault(
			r, "time goes back by more than a second; sort the events by time");
	r->last_us = time_us = time_us > r->last_us ? time_us : r->last_us;
	if (tape->event) {
		tape->event[r->event_count] = (struct tape_event){time_us, device, size,
								  r->byte_count};
		memcpy(tape->bytes + r->byte_count, bytes, (size_t)size);
	}
	r->event_count++;
	r->byte_count += (size_t)size;
	return true;
}

/* E: seconds.fraction length bytes */
static bool line_event(struct reader *r)
{
	uint8_t bytes[REPORT_BYTES_MAX];
	int64_t time_us = reader_time_us(r);
	if (time_us < 0)
		return reader_fault(r, "no time after E:; it reads like E: 000001.230000 2 01 02");
	int64_t size = reader_number(r, 10, 6);
	if (size < 1 || size > REPORT_BYTES_MAX)
		return reader_fault(r, "a report has 1 to %d bytes", REPORT_BYTES_MAX);
	if (!r->tape->device[r->device].descriptor_size)
		return reader_fault(
			r, "an event of device %d, whose descriptor (R:) is not on the tape",
			r->device);
	int count = reader_bytes(r, bytes, REPORT_BYTES_MAX);
	if (count != size)
		return reader_fault(r,
				    "%d bytes were announced, %s stand here; the line is damaged",
				    (int)size, count < 0 ? "something else" : "fewer or more");
	return reader_event(r, time_us, r->device, count, bytes);
}

/* --- hid-recorder -------------------------------------------------------------------- */

/* D: n, or D:n in old files */
static bool line_device(struct reader *r)
{
	int64_t device = reader_number(r, 10, 3);
	if (device < 0 || device >= TAPE_DEVICES_MAX)
		return reader_fault(r, "a device outside of 0 to %d", TAPE_DEVICES_MAX - 1);
	r->device = (int)device;
	return true;
}

/* R: length bytes */
static bool line_descriptor(struct reader *r)
{
	struct tape_device *device = &r->tape->device[r->device];
	int64_t size = reader_number(r, 10, 6);
	if (size < 1 || size > TAPE_DESCRIPTOR_MAX)
		return reader_fault(r, "a report descriptor has 1 to %d bytes",
				    TAPE_DESCRIPTOR_MAX);
	device->used = true;
	device->descriptor_size = reader_bytes(r, device->descriptor, TAPE_DESCRIPTOR_MAX);
	if (device->descriptor_size != size) {
		device->descriptor_size = 0;
		return reader_fault(r,
				    "a descriptor of %d bytes was announced, another stands here",
				    (int)size);
	}
	return true;
}

/* N: name */
static bool line_name(struct reader *r)
{
	struct tape_device *device = &r->tape->device[r->device];
	reader_blanks(r);
	size_t size = (size_t)(r->stop - r->c);
	size = size < sizeof device->name ? size : sizeof device->name - 1;
	memcpy(device->name, r->c, size);
	device->name[size] = 0;
	device->used = true;
	return true;
}

/* I: bus vendor product, in hex */
static bool line_ids(struct reader *r)
{
	int64_t bus = reader_number(r, 16, 4), vendor = reader_number(r, 16, 4),
		product = reader_number(r, 16, 4);
	if (bus < 0 || vendor < 0 || product < 0)
		return reader_fault(r,
				    "I: needs bus, vendor and product in hex, like I: 3 056a 00d4");
	struct tape_device *device = &r->tape->device[r->device];
	device->used = true;
	device->bus = (int)bus;
	device->vendor = (int)vendor;
	device->product = (int)product;
	return true;
}

/* --- the whole tape ------------------------------------------------------------------ */

static bool line_read(struct reader *r)
{
	bool hex_begins = r->c < r->stop && (*r->c == ' ' || reader_digit(*r->c, 16) >= 0) &&
			  !memchr(r->c, ':', (size_t)(r->stop - r->c));
	if (r->block.open && hex_begins)
		return reader_block_bytes(r);
	if (!reader_block_end(r))
		return false;
	if (r->comment && r->c < r->stop && *r->c == ' ')
		return true;
	reader_blanks(r);
	if (r->c == r->stop)
		return true;
	r->comment = reader_skip(r, "#");
	if (r->comment)
		return reader_comment(r);
	if (reader_digit(*r->c, 10) >= 0)
		return reader_block_begin(r);
	if (reader_skip(r, "D:"))
		return line_device(r);
	if (reader_skip(r, "R:"))
		return line_descriptor(r);
	if (reader_skip(r, "N:"))
		return line_name(r);
	if (reader_skip(r, "P:"))
		return true;
	if (reader_skip(r, "I:"))
		return line_ids(r);
	if (reader_skip(r, "E:"))
		return line_event(r);
	/* What usbhid-dump says before and after. */
	if (reader_skip(r, "Starting dumping") || reader_skip(r, "with ") ||
	    reader_skip(r, "No more"))
		return true;
	return reader_fault(r, "unknown line; tapes are hid-recorder or usbhid-dump text");
}

static bool text_read(struct reader *r, struct tape *tape, const char *text, size_t size,
		      char *fault_text)
{
	*r = (struct reader){.tape = tape, .at = text, .end = text + size, .fault = fault_text};
	while (reader_line(r))
		if (!line_read(r))
			return false;
	return reader_block_end(r);
}

bool tape_read(struct tape *tape, const char *text, size_t size, char fault_text[200])
{
	static const struct tape empty;
	struct reader *r = malloc(sizeof *r);
	*tape = empty;
	fault_text[0] = 0;
	bool sound = r && text_read(r, tape, text, size, fault_text);
	if (sound && r->event_count == 0)
		sound = reader_fault(r, "no event (E: or STREAM) up to here; is this a tape?");
	if (sound) {
		size_t events_size = r->event_count * sizeof *tape->event;
		*tape = empty;
		tape->memory = malloc(events_size + r->byte_count);
		tape->event = tape->memory;
		tape->bytes = (uint8_t *)tape->memory + events_size;
		sound = tape->memory && text_read(r, tape, text, size, fault_text);
	}
	if (sound) {
		tape->event_count = r->event_count;
		if (!tape->frame_count)
			tape->frame_count = (int)(r->last_us * FRAME_RATE_HZ / SECOND_US) + 61;
	} else {
		if (!fault_text[0])
			snprintf(fault_text, 200, "line 1: not enough memory for this tape");
		tape_free(tape);
	}
	free(r);
	return sound;
}

void tape_free(struct tape *tape)
{
	static const struct tape empty;
	free(tape->memory);
	*tape = empty;
}
