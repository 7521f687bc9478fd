/* A visitor comes, draws, and goes without a word. Whoever moves the pen is there; a pen that lies
 * on the tablet, however much it reports, is nobody.
 *
 *             idle_s - countdown        countdown over
 *   VISIT ------------------> COUNTDOWN --------------> a new visit, ATTRACT
 *    ^  ^                         |                                    |
 *    |  +-------------------------+  the pen moves, a button           |
 *    +-----------------------------------------------------------------+  touch, button
 */
#ifndef CYCLE_H
#define CYCLE_H

#include "input.h"

enum { CYCLE_COUNTDOWN_S = 15 };

enum cycle_state { CYCLE_VISIT, CYCLE_COUNTDOWN, CYCLE_ATTRACT };

struct cycle {
	enum cycle_state state;
	int still;  /* frames without a visitor */
	int left_s; /* of the countdown */
	struct v2 still_px;
	enum pen_state pen;
};

/* One frame. idle_s: the board's, the countdown included; 0: never. begun: there is something that
 * a visitor made. px: one pixel at 1080 lines. True: the visit is over, and a new one must begin.
 */
bool cycle_frame(struct cycle *cycle, const struct frame_input *input, int idle_s, bool begun,
		 float px);

#endif
