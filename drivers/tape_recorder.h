/* A tape in the making: devices, reports and unplugging, as lines of a file.
 *
 * A tape says once what a device is, and a device stands on it from its first report on. Another
 * device that gets the number of one on the tape can't be told from it: it is left out. */
#ifndef TAPE_RECORDER_H
#define TAPE_RECORDER_H

#include "tape.h"

#include <stdio.h>

struct tape_recorder {
	FILE *out;
	char line[TAPE_LINE_MAX];
	struct tape_device declared[TAPE_DEVICES_MAX]; /* as they stand on the tape */
	bool left_out[TAPE_DEVICES_MAX];
	int device; /* selected on the tape; -1: none */
	long events;
	int64_t last_us;
};

/* Writes the comments on top. out must be closed by the caller, who also looks for its errors. */
void recorder_begin(struct tape_recorder *recorder, FILE *out, const struct tape *head);

/* What the device of this number is from now on. False: it is left out. */
bool recorder_device(struct tape_recorder *recorder, int device, const struct tape_device *told);

/* Times never go back on a tape. What is left out, or was never declared, is not written. */
void recorder_report(struct tape_recorder *recorder, const struct raw_report *report);
void recorder_unplug(struct tape_recorder *recorder, int device, int64_t time_us);

/* The tape's length, and the state at its end. */
void recorder_end(struct tape_recorder *recorder, int frames, uint64_t hash);

#endif
