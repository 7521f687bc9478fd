/* Reading tapes: hid-recorder and usbhid-dump text, line by line.
 *
 * The text is walked twice by the same code: once to check it and to count, once to fill memory of
 * just that size. Nothing of a tape is believed: every number has a bound, every fault its line. */
#include "tape.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#define SECOND_US INT64_C(1000000)
#define TAPE_TIME_MAX_US (24 * 3600 * SECOND_US)

/* Clocks that step and devices that are read in turn bring times back by a little. */
#define TIME_BACK_MAX_US SECOND_US

/* The bytes that one usbhid-dump header line announces, until an empty line. */
struct block {
	bool open, descriptor;
	int device, size;
	int64_t time_us;
	uint8_t bytes[TAPE_DESCRIPTOR_MAX];
};

struct reader {
	struct tape *tape;    /* event and bytes are NULL while counting */
	const char *at, *end; /* of the text */
	const char *c, *stop; /* of the line */
	int line;
	int device;
	bool ours;    /* it began with "# kitsuke-tape" */
	bool comment; /* the line before was one: what is indented goes on with it */
	struct block block;
	int dump_bus, dump_address; /* of the first usbhid-dump line */
	bool dump_begun, dump_addressed;
	int64_t dump_start_us, last_us;
	size_t event_count, byte_count;
	char *fault;
};

__attribute__((format(printf, 2, 3))) static bool fault(struct reader *r, const char *what, ...)
{
	char text[160];
	va_list arguments;
	va_start(arguments, what);
	vsnprintf(text, sizeof text, what, arguments);
	va_end(arguments);
	snprintf(r->fault, 200, "line %d: %s", r->line, text);
	return false;
}

/* --- characters ---------------------------------------------------------------------- */

static bool line_next(struct reader *r)
{
	if (r->at == r->end)
		return false;
	const char *newline = memchr(r->at, '\n', (size_t)(r->end - r->at));
	r->c = r->at;
	r->stop = newline ? newline : r->end;
	r->at = newline ? newline + 1 : r->end;
	while (r->stop > r->c && (r->stop[-1] == '\r' || r->stop[-1] == ' '))
		r->stop--;
	r->line++;
	return true;
}

static void skip_blanks(struct reader *r)
{
	while (r->c < r->stop && (*r->c == ' ' || *r->c == '\t'))
		r->c++;
}

static bool skip_text(struct reader *r, const char *text)
{
	size_t size = strlen(text);
	if ((size_t)(r->stop - r->c) < size || memcmp(r->c, text, size))
		return false;
	r->c += size;
	return true;
}

static int digit(char c, int base)
{
	int value = c >= '0' && c <= '9'   ? c - '0'
		    : c >= 'a' && c <= 'f' ? c - 'a' + 10
		    : c >= 'A' && c <= 'F' ? c - 'A' + 10
					   : 99;
	return value < base ? value : -1;
}

/* A number of at most `digits` digits; -1 when there is none. */
static int64_t read_number(struct reader *r, int base, int digits)
{
	skip_blanks(r);
	int64_t value = -1;
	for (; digits > 0 && r->c < r->stop && digit(*r->c, base) >= 0; digits--, r->c++)
		value = (value < 0 ? 0 : value) * base + digit(*r->c, base);
	bool ends = r->c == r->stop || digit(*r->c, base) < 0;
	return ends ? value : -1;
}

/* seconds.fraction to microseconds; -1 when it is none. */
static int64_t read_time_us(struct reader *r)
{
	int64_t seconds = read_number(r, 10, 10), fraction = 0, unit = SECOND_US;
	if (seconds < 0 || !skip_text(r, "."))
		return -1;
	for (; r->c < r->stop && digit(*r->c, 10) >= 0; r->c++) {
		unit /= 10;
		fraction += digit(*r->c, 10) * unit;
	}
	return seconds * SECOND_US + fraction;
}

/* The rest of the line as bytes; -1 when it is no hex or more than `capacity`. */
static int read_bytes(struct reader *r, uint8_t *bytes, int capacity)
{
	int count = 0;
	for (skip_blanks(r); r->c < r->stop; skip_blanks(r)) {
		int64_t byte = read_number(r, 16, 2);
		if (byte < 0 || count == capacity)
			return -1;
		bytes[count++] = (uint8_t)byte;
	}
	return count;
}

/* A decimal fraction like 203.2, for sizes in mm; -1 when it is none. */
static float read_mm(struct reader *r)
{
	int64_t whole = read_number(r, 10, 4), fraction = 0;
	if (whole < 0)
		return -1.0f;
	if (skip_text(r, ".") && r->c + 1 < r->stop && digit(r->c[0], 10) >= 0 &&
	    digit(r->c[1], 10) >= 0)
		fraction = read_number(r, 10, 2);
	else if (r->c < r->stop && digit(*r->c, 10) >= 0)
		fraction = 10 * read_number(r, 10, 1);
	return fraction < 0 ? -1.0f : (float)whole + (float)fraction / 100.0f;
}

/* --- events -------------------------------------------------------------------------- */

static bool event_add(struct reader *r, int64_t time_us, int device, int size, const uint8_t *bytes)
{
	struct tape *tape = r->tape;
	if (time_us > TAPE_TIME_MAX_US)
		return fault(r, "a time beyond 24 hours; times count from the tape's start");
	if (r->last_us - time_us > TIME_BACK_MAX_US)
		return fault(r, "time goes back by more than a second; sort the events by time");
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
	int64_t time_us = read_time_us(r);
	if (time_us < 0)
		return fault(r, "no time after E:; it reads like E: 000001.230000 2 01 02");
	int64_t size = read_number(r, 10, 6);
	if (size < 1 || size > REPORT_BYTES_MAX)
		return fault(r, "a report has 1 to %d bytes", REPORT_BYTES_MAX);
	if (!r->tape->device[r->device].descriptor_size)
		return fault(r, "an event of device %d, whose descriptor (R:) is not on the tape",
			     r->device);
	int count = read_bytes(r, bytes, REPORT_BYTES_MAX);
	if (count != size)
		return fault(r, "%d bytes were announced, %s stand here; the line is damaged",
			     (int)size, count < 0 ? "something else" : "fewer or more");
	return event_add(r, time_us, r->device, count, bytes);
}

/* --- hid-recorder -------------------------------------------------------------------- */

/* D: n, or D:n in old files */
static bool line_device(struct reader *r)
{
	int64_t device = read_number(r, 10, 3);
	if (device < 0 || device >= TAPE_DEVICES_MAX)
		return fault(r, "a device outside of 0 to %d", TAPE_DEVICES_MAX - 1);
	r->device = (int)device;
	return true;
}

/* R: length bytes */
static bool line_descriptor(struct reader *r)
{
	struct tape_device *device = &r->tape->device[r->device];
	int64_t size = read_number(r, 10, 6);
	if (size < 1 || size > TAPE_DESCRIPTOR_MAX)
		return fault(r, "a report descriptor has 1 to %d bytes", TAPE_DESCRIPTOR_MAX);
	device->used = true;
	device->descriptor_size = read_bytes(r, device->descriptor, TAPE_DESCRIPTOR_MAX);
	if (device->descriptor_size != size) {
		device->descriptor_size = 0;
		return fault(r, "a descriptor of %d bytes was announced, another stands here",
			     (int)size);
	}
	return true;
}

/* N: name */
static bool line_name(struct reader *r)
{
	struct tape_device *device = &r->tape->device[r->device];
	skip_blanks(r);
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
	int64_t bus = read_number(r, 16, 4), vendor = read_number(r, 16, 4),
		product = read_number(r, 16, 4);
	if (bus < 0 || vendor < 0 || product < 0)
		return fault(r, "I: needs bus, vendor and product in hex, like I: 3 056a 00d4");
	struct tape_device *device = &r->tape->device[r->device];
	device->used = true;
	device->bus = (int)bus;
	device->vendor = (int)vendor;
	device->product = (int)product;
	return true;
}

/* --- what only we need --------------------------------------------------------------- */

static bool comment_tablet(struct reader *r)
{
	int64_t device = read_number(r, 10, 3);
	float width_mm = read_mm(r), height_mm = read_mm(r);
	if (device < 0 || device >= TAPE_DEVICES_MAX || width_mm < 1.0f || height_mm < 1.0f)
		return fault(r, "it reads like # tablet 0 203.2 127.0, device, width and height");
	r->tape->device[device].width_mm = width_mm;
	r->tape->device[device].height_mm = height_mm;
	return true;
}

static bool comment_display(struct reader *r)
{
	int64_t device = read_number(r, 10, 3);
	if (device < 0 || device >= TAPE_DEVICES_MAX)
		return fault(r, "it reads like # display 0, the device's number");
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
	int64_t degrees = read_number(r, 10, 3), display = read_number(r, 10, 1);
	int64_t width = read_number(r, 10, 5), height = read_number(r, 10, 5);
	int64_t rotation = read_number(r, 10, 3);
	bool panel = (width == 0 && height == 0) ||
		     (width > 0 && width <= 16384 && height > 0 && height <= 16384);
	if (!quarter(degrees) || display < 0 || display > 1 || !panel || !quarter(rotation))
		return fault(r, "it reads like # mount 180 1 1920 1080 90, the tablet's turn, pen "
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
		number[i] = read_number(r, 10, 7);
		sound &= number[i] >= 0 && number[i] <= 1638400;
	}
	if (!sound)
		return fault(r, "at most 25 crosses, like # cross 9612 5390 9600 5400, in "
				"hundredths of a pixel");
	mount->cross[mount->cross_count++] = (struct pen_cross){(int)number[0], (int)number[1],
								(int)number[2], (int)number[3]};
	return true;
}

/* A tape records one protocol for each device: the one that its reports from there on speak. */
static bool comment_vendor(struct reader *r)
{
	int64_t device = read_number(r, 10, 3);
	skip_blanks(r);
	const char *word = r->c;
	while (r->c < r->stop && *r->c != ' ' && *r->c != '\t')
		r->c++;
	struct pen_vendor speaks = {.family = pen_family_named(word, (size_t)(r->c - word))};
	if (speaks.family == PEN_FAMILIES)
		return fault(r, "a protocol that this program does not know; a newer one may");
	speaks.x_maximum = (int)read_number(r, 10, 8);
	speaks.y_maximum = (int)read_number(r, 10, 8);
	speaks.pressure_maximum = (int)read_number(r, 10, 5);
	if (device < 0 || device >= TAPE_DEVICES_MAX || !pen_vendor_sound(&speaks))
		return fault(r, "it reads like # vendor 0 uclogic-2 50800 31750 8191, device, "
				"protocol, ranges of x, y and pressure");
	r->tape->device[device].speaks = speaks;
	return true;
}

static bool comment_unplug(struct reader *r)
{
	int64_t device = read_number(r, 10, 3);
	skip_blanks(r);
	int64_t time_us = skip_text(r, "at ") ? read_time_us(r) : -1;
	if (device < 0 || device >= TAPE_DEVICES_MAX || time_us < 0)
		return fault(r, "it reads like # unplug 0 at 000002.000000");
	uint8_t none = 0;
	return event_add(r, time_us, (int)device, 0, &none);
}

static bool line_comment(struct reader *r)
{
	struct tape *tape = r->tape;
	skip_blanks(r);
	if (skip_text(r, "kitsuke-tape ")) {
		r->ours = true;
		return read_number(r, 10, 4) == 1 ||
		       fault(r, "this program reads version 1 of kitsuke tapes only");
	}
	if (!r->ours)
		return true;
	if (skip_text(r, "board ")) {
		int64_t width = read_number(r, 10, 5), height = read_number(r, 10, 5);
		if (width < 1 || width > 16384 || height < 1 || height > 16384)
			return fault(r, "a screen is 1 to 16384 pixels wide and high");
		tape->width_px = (int)width;
		tape->height_px = (int)height;
	} else if (skip_text(r, "budget ")) {
		int64_t units = read_number(r, 10, 9);
		if (units < 1)
			return fault(r, "a budget is a number of work units from 1 to 999999999");
		tape->budget_units = (long)units;
	} else if (skip_text(r, "frames ")) {
		int64_t frames = read_number(r, 10, 7);
		if (frames < 1 || frames > TAPE_TIME_MAX_US / SECOND_US * FRAME_RATE_HZ)
			return fault(r, "a tape has at least one frame and at most 24 hours");
		tape->frame_count = (int)frames;
	} else if (skip_text(r, "mount ")) {
		return comment_mount(r);
	} else if (skip_text(r, "cross ")) {
		return comment_cross(r);
	} else if (skip_text(r, "tablet ")) {
		return comment_tablet(r);
	} else if (skip_text(r, "display ")) {
		return comment_display(r);
	} else if (skip_text(r, "vendor ")) {
		return comment_vendor(r);
	} else if (skip_text(r, "unplug ")) {
		return comment_unplug(r);
	}
	return true;
}

/* --- usbhid-dump --------------------------------------------------------------------- */

static bool block_end(struct reader *r)
{
	struct block *block = &r->block;
	struct tape_device *device = &r->tape->device[block->device];
	if (!block->open)
		return true;
	block->open = false;
	if (block->descriptor) {
		device->used = block->size > 0;
		device->descriptor_size = block->size;
		memcpy(device->descriptor, block->bytes, (size_t)block->size);
		return true;
	}
	if (block->size == 0)
		return true;
	if (block->size > REPORT_BYTES_MAX)
		return fault(r, "a report has 1 to %d bytes", REPORT_BYTES_MAX);
	return event_add(r, block->time_us, block->device, block->size, block->bytes);
}

static bool block_bytes(struct reader *r)
{
	struct block *block = &r->block;
	int count = read_bytes(r, block->bytes + block->size, TAPE_DESCRIPTOR_MAX - block->size);
	if (count < 0)
		return fault(r, "no hex bytes, or more than %d; the dump is damaged",
			     TAPE_DESCRIPTOR_MAX);
	block->size += count;
	return true;
}

/* [[bus:]address:]interface:STREAM or :DESCRIPTOR and a time. Other lines of digits and colons are
 * what usbhid-dump tells about time-outs. */
static bool block_begin(struct reader *r)
{
	int64_t number[3] = {0};
	int count = 0;
	for (; count < 3 && r->c < r->stop && digit(*r->c, 10) >= 0; count++) {
		number[count] = read_number(r, 10, 3);
		if (number[count] < 0 || !skip_text(r, ":"))
			return fault(r, "unknown line; tapes are hid-recorder or usbhid-dump text");
	}
	bool stream = skip_text(r, "STREAM"), descriptor = !stream && skip_text(r, "DESCRIPTOR");
	if (!stream && !descriptor)
		return true;
	if (number[count - 1] >= TAPE_DEVICES_MAX)
		return fault(r, "an interface outside of 0 to %d", TAPE_DEVICES_MAX - 1);
	int bus = count == 3 ? (int)number[0] : 0, address = count > 1 ? (int)number[count - 2] : 0;
	if (r->dump_addressed && (bus != r->dump_bus || address != r->dump_address))
		return fault(r,
			     "a second device; record one at a time (usbhid-dump -s BUS:ADDRESS)");
	int64_t time_us = read_time_us(r);
	if (time_us < 0)
		return fault(r, "no time after STREAM or DESCRIPTOR");
	if (stream && !r->dump_begun) {
		r->dump_begun = true;
		r->dump_start_us = time_us;
	}
	r->dump_addressed = true;
	r->dump_bus = bus;
	r->dump_address = address;
	time_us -= r->dump_start_us;
	r->block.open = true;
	r->block.descriptor = descriptor;
	r->block.device = (int)number[count - 1];
	r->block.size = 0;
	r->block.time_us = time_us < 0 ? 0 : time_us;
	return true;
}

/* --- the whole tape ------------------------------------------------------------------ */

static bool line_read(struct reader *r)
{
	bool hex_begins = r->c < r->stop && (*r->c == ' ' || digit(*r->c, 16) >= 0) &&
			  !memchr(r->c, ':', (size_t)(r->stop - r->c));
	if (r->block.open && hex_begins)
		return block_bytes(r);
	if (!block_end(r))
		return false;
	if (r->comment && r->c < r->stop && *r->c == ' ')
		return true;
	skip_blanks(r);
	if (r->c == r->stop)
		return true;
	r->comment = skip_text(r, "#");
	if (r->comment)
		return line_comment(r);
	if (digit(*r->c, 10) >= 0)
		return block_begin(r);
	if (skip_text(r, "D:"))
		return line_device(r);
	if (skip_text(r, "R:"))
		return line_descriptor(r);
	if (skip_text(r, "N:"))
		return line_name(r);
	if (skip_text(r, "P:"))
		return true;
	if (skip_text(r, "I:"))
		return line_ids(r);
	if (skip_text(r, "E:"))
		return line_event(r);
	/* What usbhid-dump says before and after. */
	if (skip_text(r, "Starting dumping") || skip_text(r, "with ") || skip_text(r, "No more"))
		return true;
	return fault(r, "unknown line; tapes are hid-recorder or usbhid-dump text");
}

static bool text_read(struct reader *r, struct tape *tape, const char *text, size_t size,
		      char *fault_text)
{
	*r = (struct reader){.tape = tape, .at = text, .end = text + size, .fault = fault_text};
	while (line_next(r))
		if (!line_read(r))
			return false;
	return block_end(r);
}

bool tape_read(struct tape *tape, const char *text, size_t size, char fault_text[200])
{
	static const struct tape empty;
	struct reader *r = malloc(sizeof *r);
	*tape = empty;
	fault_text[0] = 0;
	bool sound = r && text_read(r, tape, text, size, fault_text);
	if (sound && r->event_count == 0)
		sound = fault(r, "no event (E: or STREAM) up to here; is this a tape?");
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
