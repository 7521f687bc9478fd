/* A trembling hand for tests: every pen point of a recording is moved a little, by a seed. */
#ifndef JITTER_H
#define JITTER_H

#include "pen.h"

struct jitter {
	struct scatter scatter;
	float reach_mm; /* each axis moves by up to this much either way, on the tablet */
};

/* Any seed, 0 too. */
void jitter_init(struct jitter *jitter, float reach_mm, uint32_t seed);

/* Moves the position in each pen report of a frame; reports of other devices stay as they are. */
void jitter_frame(struct jitter *jitter, const struct pen *pen, struct frame_reports *reports);

#endif
