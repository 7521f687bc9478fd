/* See tape_learn.h. */
#include "tape_learn.h"
#include "pen_identify.h"

struct pen_vendor tape_speaks(const struct tape_device *told, float *width_mm, float *height_mm)
{
	static const struct pen_answers none;
	struct pen_identity identity = {
		.bus = told->bus,
		.vendor = told->vendor,
		.product = told->product,
		.descriptor = told->descriptor,
		.descriptor_size = told->descriptor_size,
	};
	struct pen_vendor speaks = {PEN_BY_DESCRIPTOR, 0, 0, 0};
	struct pen_recipe recipe;
	char reason[160];
	*width_mm = *height_mm = 0.0f;
	if (pen_identify(&identity, &recipe, reason))
		pen_identify_end(&identity, &recipe, &none, &speaks, width_mm, height_mm, reason);
	return speaks;
}

/* As a tape has it, in hundredths, so that a size counts the same live and on the tape. */
static float as_written_mm(float mm)
{
	if (!(mm >= 1.0f && mm < 10000.0f))
		return mm;
	int hundredths = (int)(mm * 100.0f + 0.5f);
	return (float)(hundredths / 100) + (float)(hundredths % 100) / 100.0f;
}

void tape_learn(struct pen *pen, int device, const struct tape_device *told)
{
	struct pen_vendor speaks = told->speaks;
	float width_mm = as_written_mm(told->width_mm), height_mm = as_written_mm(told->height_mm);
	float width, height;
	pen_describe(pen, device, told->descriptor, told->descriptor_size);
	if (speaks.family == PEN_BY_DESCRIPTOR) {
		speaks = tape_speaks(told, &width, &height);
		width_mm = width_mm > 0.0f ? width_mm : width;
		height_mm = height_mm > 0.0f ? height_mm : height;
	}
	pen_vendor_set(pen, device, &speaks);
	pen_resize(pen, device, width_mm, height_mm);
	pen_is_display(pen, device, told->display);
}

/* --- dumps without a word about the device ---------------------------------------------------- */

/* Whose reports begin so; only what no other report begins with. */
static enum pen_family form_of(const uint8_t *bytes, int size)
{
	if (size >= 12 && size <= 14 && bytes[0] == 8 && (bytes[1] & 0xf0) == 0x80)
		return PEN_UCLOGIC_2;
	if ((size == 8 || size == 10) && bytes[0] == 7 && bytes[1] & 0x80)
		return PEN_UCLOGIC_1;
	if (size >= 8 && size <= 14 && bytes[0] == 2 && (bytes[1] & 0xf0) == 0xa0)
		return PEN_UGEE_2;
	if (size >= 9 && size <= 13 && bytes[0] == 9 && bytes[1] == 0x41)
		return PEN_VEIKK;
	return PEN_BY_DESCRIPTOR;
}

static void guess_grow(struct pen_vendor *guess, const struct pen_fields *fields)
{
	guess->x_maximum = int_max(guess->x_maximum, fields->x);
	guess->y_maximum = int_max(guess->y_maximum, fields->y);
	guess->pressure_maximum = int_max(guess->pressure_maximum, fields->pressure);
}

struct pen_vendor tape_guess(const struct tape *tape, int device)
{
	struct pen_vendor guess = {PEN_BY_DESCRIPTOR, 100, 100, 1023}, wide = {0};
	long count[PEN_FAMILIES] = {0};
	for (size_t i = 0; i < tape->event_count; i++)
		if (tape->event[i].device == device && tape->event[i].size > 0)
			count[form_of(tape->bytes + tape->event[i].offset, tape->event[i].size)]++;
	for (int i = PEN_BY_DESCRIPTOR + 1; i < PEN_FAMILIES; i++)
		if (count[i] > count[guess.family])
			guess.family = (enum pen_family)i;
	if (guess.family == PEN_BY_DESCRIPTOR)
		return guess;
	struct pen_memory memory = {0};
	wide = (struct pen_vendor){guess.family, (1 << 24) - 1, (1 << 24) - 1, (1 << 14) - 1};
	for (size_t i = 0; i < tape->event_count; i++) {
		const struct tape_event *event = &tape->event[i];
		struct pen_fields fields = {0};
		if (event->device == device && event->size > 0 &&
		    pen_family_rule(guess.family)
				    ->read(tape->bytes + event->offset, event->size, &wide, &memory,
					   &fields) == PEN_DECODED &&
		    fields.in_range)
			guess_grow(&guess, &fields);
	}
	return guess;
}
