/* The report: a drape's figures as JSON with fixed keys, and the clock that some of them need. */
#ifndef REPORT_H
#define REPORT_H

#include "measure.h"
#include "session.h"
#include "store.h"

/* How long frames took. Only the report reads it: no time ever comes back into the session. */
struct frame_clock {
	long count;      /* frames timed; the first FRAME_CLOCK_FRAMES_MAX are kept */
	float *frame_ms; /* of each frame */
	long wrap_frames;
	double wrap_ms; /* of the last wrap, meshing included */
	enum session_job job;
	double begin_ms;
};

enum { FRAME_CLOCK_FRAMES_MAX = 1 << 20 };

bool frame_clock_open(struct frame_clock *clock);
void frame_clock_close(struct frame_clock *clock);

/* Around each frame. */
void frame_clock_begin(struct frame_clock *clock, const struct session *session);
void frame_clock_end(struct frame_clock *clock, const struct session *session);

/* Measures the garment (memory from malloc, given back) and writes the report. `measure` keeps the
 * figures for the caller. */
bool report_write(const struct session *session, struct frame_clock *clock, struct measure *measure,
		  const char *path, char fault[FAULT_BYTES]);

#endif
