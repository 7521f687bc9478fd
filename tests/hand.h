/* A hand that writes tapes: moves a pen over a tablet as people do and presses the buttons, while
 * the very program that will play the tape runs beside it, so that the hand sees what it does.
 *
 * The motion: slow starts and ends, slower in bends, tremor of 8 to 11 Hz, pressure that
 * rises and falls within 40 ms, a tilt that drifts; reports every few ms as the tablet sends them.
 */
#ifndef HAND_H
#define HAND_H

#include "kiosk.h"
#include "tape.h"

#include <stdio.h>

enum { HAND_PATH_MAX = 4096 };

struct hand {
	struct kiosk *kiosk;
	FILE *tape;
	struct pen_layout layout;
	struct frame_reports reports;
	int64_t now_us;
	int interval_us; /* between reports */
	struct v2 at_px; /* where the hand means to be */
	bool near, touching;
	int selected;   /* device that the tape's events are for */
	uint8_t held;   /* buttons */
	float pressure; /* 0..1 now */
	struct scatter random;
	float phase[4]; /* of the tremor */
	float drift;
};

/* Writes the tape's head and starts. The kiosk must have been initialised and have its body. */
void hand_begin(struct hand *hand, struct kiosk *kiosk, FILE *tape, int interval_us, uint32_t seed);
void hand_end(struct hand *hand);

/* Does nothing for a while; the pen stays where it is (near) or away. */
void hand_wait(struct hand *hand, float seconds);

/* Takes the pen out of the tablet's range. */
void hand_leave(struct hand *hand);

/* Moves through the air. */
void hand_move(struct hand *hand, struct v2 to_px);

/* Moves to the first point, touches, follows the path at about `speed` pixels a second, lifts. */
void hand_stroke(struct hand *hand, const struct v2 *path_px, int count, float speed);

/* The parts of a stroke, for those that wait or press buttons with the pen down. */
void hand_touch(struct hand *hand, struct v2 at_px);
void hand_follow(struct hand *hand, const struct v2 *path_px, int count, float speed);
void hand_lift(struct hand *hand);

void hand_tap(struct hand *hand, struct v2 at_px);
void hand_tap_target(struct hand *hand, enum target target);

/* A real button: down, held for so long, up. */
void hand_button(struct hand *hand, enum button button, float seconds);
void hand_button_down(struct hand *hand, enum button button, bool down);

#endif
