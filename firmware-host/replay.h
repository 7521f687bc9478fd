/* A replay in progress: command_replay.c runs it, replay_tape.c gives it its tape. */
#ifndef REPLAY_H
#define REPLAY_H

#include "jitter.h"
#include "kiosk.h"
#include "picture.h"
#include "report.h"
#include "snapshot.h"
#include "tape.h"

#include <stdio.h>

struct replay {
	const char *tape_path, *out, *body;
	bool no_pictures, samples, progress;
	long pictures_every, jitter_mm, seed;
	uint8_t *descriptor; /* of devices that the tape does not describe */
	int descriptor_size;
	struct crew *crew;
	struct tape tape;
	size_t cursor; /* into the tape's events */
	int frame_count;
	void *memory;
	struct kiosk *kiosk;
	struct frame_reports *reports;
	struct jitter jitter;
	struct frame_clock clock;
	FILE *journal; /* in memory until the end */
	char *journal_text;
	size_t journal_size;
	struct snapshot snapshot;
	struct contact_sheet contact;
	const char *last_word; /* of the last edit, for captions */
	char fault[FAULT_BYTES];
};

/* Reads the tape; false with replay->fault. */
bool replay_load(struct replay *replay);

/* Tells the pen what is on the tape. */
void replay_learn(struct replay *replay, struct pen *pen);

/* A frame's raw input, as the tape has it or as a trembling hand would have made it, into
 * replay->reports. Returns the devices that are unplugged in it. */
unsigned replay_reports(struct replay *replay, int frame);

/* Prints what the pen alone says, a line of JSON a sample. */
void replay_samples(struct replay *replay);

#endif
