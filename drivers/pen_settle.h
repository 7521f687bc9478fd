/* Contacts that are too short, and lifts that are none. Private to the pen module.
 *
 *              touch             15 ms or 16 reports in touch
 *    OPEN -------------> BEGUN ----------------------------> DOWN
 *     ^  ^                 |                                 |  ^
 *     |  |   lift: chatter |                                 |  |
 *     |  +-----------------+                                 |  |
 *     |          lift, after the pressure had gone           |  |
 *     +------------------------------------------------------+  |
 *     ^                                                      |  |  touch again, within 30 ms and
 *     |                                                      |  |  where a hand can have come
 *     |      30 ms               lift under pressure         v  |
 *     +------------------------------------------------- LIFTED-+
 *
 * What is not decided waits in a queue and is then given as it was, with its own times: nothing is
 * lost of a stroke's beginning, and a split one is joined by where the pen was meanwhile. A hand
 * that lifts a pen takes the pressure off first, and nobody waits for that one: only a contact that
 * breaks off under pressure is doubted. (Of 130 lifts in recordings of real tablets four were
 * taken back within 30 ms, all under 23 % of the pressure or more, and three contacts lasted 10 ms
 * or less.)
 *
 * The reports that a late frame finds waiting count at one moment of it. So many that a quick
 * tablet needs 15 ms for them are a contact whatever their times.
 */
#ifndef PEN_SETTLE_H
#define PEN_SETTLE_H

#include "pen.h"

/* Takes what the last report says; gives what has been decided to `input`. `mm` is where the pen
 * is on the tablet. */
void pen_settle(struct pen *pen, int device, const struct pen_sample *sample, struct v2 mm,
		struct frame_input *input);

/* Time passes without reports. */
void pen_settle_time(struct pen *pen, int device, int64_t now_us, struct frame_input *input);

/* No more doubts: what waits is given as it came. */
void pen_settle_end(struct pen *pen, int device, struct frame_input *input);

#endif
