/* A dump without a word about its device: whatever its reports are, the guess is none, or a
 * protocol that the pen module takes and that reads them within its ranges. The first byte of a
 * report says how long it is. */
#include "samples.h"
#include "tape_learn.h"

#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

enum { EVENTS_MAX = 512 };

/* The reports of `data`; two devices take turns where the length's upper bit is set. */
static void tape_make(struct tape *tape, const uint8_t *data, size_t size)
{
	static struct tape_event event[EVENTS_MAX];
	static const struct tape empty;
	size_t used = 0;
	*tape = empty;
	tape->event = event;
	/* just as long as it is, so that the sanitizer sees what reads on */
	tape->bytes = malloc(size + 1);
	MUST(tape->bytes);
	for (size_t at = 0; at < size && tape->event_count < EVENTS_MAX;) {
		int device = data[at] >> 7, length = data[at] & 0x7f;
		at++;
		length = (size_t)length < size - at ? length : (int)(size - at);
		memcpy(tape->bytes + used, data + at, (size_t)length);
		event[tape->event_count] = (struct tape_event){(int64_t)tape->event_count * 4000,
							       device, length, used};
		tape->event_count++;
		used += (size_t)length;
		at += (size_t)length;
	}
	uint8_t *exact = realloc(tape->bytes, used ? used : 1);
	tape->bytes = exact ? exact : tape->bytes;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	static struct tape tape;
	static struct pen pen;
	static struct frame_reports reports;
	tape_make(&tape, data, size);
	for (int device = 0; device < 2; device++) {
		struct tape_device told = {.used = true, .speaks = tape_guess(&tape, device)};
		if (told.speaks.family == PEN_BY_DESCRIPTOR)
			continue;
		MUST(pen_vendor_sound(&told.speaks));
		pen_init(&pen, 1280, 720);
		tape_learn(&pen, device, &told);
		MUST(pen.device[device].kind == DEVICE_PEN);
		size_t cursor = 0;
		for (int frame = 0; cursor < tape.event_count; frame++) {
			struct frame_input input = {0};
			tape_frame(&tape, frame, &cursor, &reports);
			pen_read(&pen, &reports, tape_frame_us(frame + 1), &input);
			samples_check(&input, 1280, 720);
		}
	}
	free(tape.bytes);
	return 0;
}
