/* The tape of a replay, its devices, and what its pens say; see replay.h. */
#include "replay.h"
#include "tape_learn.h"

#include <stdlib.h>

enum { SCREEN_WIDTH = 1280, SCREEN_HEIGHT = 720 }; /* where the tape does not say */

bool replay_load(struct replay *replay)
{
	size_t size;
	char wrong[200];
	char *text = store_read(replay->tape_path, &size, replay->fault);
	if (!text)
		return false;
	bool read = tape_read(&replay->tape, text, size, wrong);
	free(text);
	if (!read) {
		snprintf(replay->fault, FAULT_BYTES, "%.250s: %s", replay->tape_path, wrong);
		return false;
	}
	replay->cursor = 0;
	replay->frame_count = replay->tape.frame_count;
	if (replay->tape.width_px == 0) {
		replay->tape.width_px = SCREEN_WIDTH;
		replay->tape.height_px = SCREEN_HEIGHT;
	}
	return true;
}

/* A dump of other programs may have neither descriptor nor ids: --descriptor gives the one, and
 * what its reports look like the other. */
static void complete_device(struct replay *replay, int d)
{
	struct tape_device *device = &replay->tape.device[d];
	if (device->descriptor_size)
		return;
	if (replay->descriptor) {
		memcpy(device->descriptor, replay->descriptor, (size_t)replay->descriptor_size);
		device->descriptor_size = replay->descriptor_size;
		device->used = true;
		return;
	}
	device->speaks = tape_guess(&replay->tape, d);
	device->used = device->speaks.family != PEN_BY_DESCRIPTOR;
	if (device->used)
		fprintf(stderr,
			"kitsuke replay: note: %s: device %d has no descriptor; its reports look "
			"like %s with %d x %d units, %d levels\n",
			replay->tape_path, d, pen_family_rule(device->speaks.family)->name,
			device->speaks.x_maximum, device->speaks.y_maximum,
			device->speaks.pressure_maximum + 1);
}

void replay_learn(struct replay *replay, struct pen *pen)
{
	pen_mount(pen, &replay->tape.mount);
	for (int d = 0; d < TAPE_DEVICES_MAX; d++) {
		const struct tape_device *device = &replay->tape.device[d];
		complete_device(replay, d);
		if (!device->used)
			continue;
		tape_learn(pen, d, device);
		if (pen->device[d].kind == DEVICE_UNKNOWN)
			fprintf(stderr, "kitsuke replay: note: %s: device %d is not used: %s\n",
				replay->tape_path, d, pen->device[d].reason);
	}
}

unsigned replay_reports(struct replay *replay, int frame)
{
	unsigned unplugged = tape_frame(&replay->tape, frame, &replay->cursor, replay->reports);
	if (replay->jitter_mm > 0)
		jitter_frame(&replay->jitter, &replay->kiosk->pen, replay->reports);
	return unplugged;
}

/* ---- samples ---- */

static void print_sample(int frame, const struct pen_sample *sample, uint8_t buttons)
{
	static const char *const state[] = {"away", "hover", "touch"};
	printf("{\"frame\": %d, \"time_us\": %lld, \"state\": \"%s\", \"x_px\": %.3f, "
	       "\"y_px\": %.3f, \"pressure\": %.4f, \"tilt_x_rad\": %.4f, \"tilt_y_rad\": %.4f, "
	       "\"eraser\": %s, \"barrel\": %s, \"buttons\": %d}\n",
	       frame, (long long)sample->time_us, state[sample->state],
	       (double)sample->position_px.x, (double)sample->position_px.y,
	       (double)sample->pressure, (double)sample->tilt_rad.x, (double)sample->tilt_rad.y,
	       sample->eraser ? "true" : "false", sample->barrel ? "true" : "false", buttons);
}

/* What the rest of the program would be told. */
void replay_samples(struct replay *replay)
{
	struct pen *pen = &replay->kiosk->pen;
	pen_init(pen, replay->tape.width_px, replay->tape.height_px);
	replay_learn(replay, pen);
	jitter_init(&replay->jitter, (float)replay->jitter_mm, (uint32_t)replay->seed);
	for (int frame = 0; frame < replay->frame_count; frame++) {
		struct frame_input input = {0};
		int64_t now_us = (int64_t)(frame + 1) * 1000000 / FRAME_RATE_HZ;
		unsigned unplugged = replay_reports(replay, frame);
		pen_read(pen, replay->reports, now_us, &input);
		for (int device = 0; device < PEN_DEVICES_MAX; device++)
			if (unplugged >> device & 1)
				pen_unplugged(pen, device, &input);
		for (int s = 0; s < input.sample_count; s++)
			print_sample(frame, &input.sample[s], input.buttons_held);
	}
}
