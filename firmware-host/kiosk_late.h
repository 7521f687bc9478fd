/* Late sampling: the picture shows where the pen is when it is drawn, not where it was when the
 * frame began. What the pen does meanwhile belongs to the next frame; here only the picture sees
 * it.
 *
 *   collect, kiosk_frame (up to a frame's time), peek, kiosk_late_show, draw, kiosk_late_hide
 */
#ifndef KIOSK_LATE_H
#define KIOSK_LATE_H

#include "kiosk.h"

struct kiosk_late {
	struct pen pen; /* a copy that hears of it */
	struct frame_input input;
	int stroke_count; /* the face as it is in truth */
	struct v2 pen_px;
};

/* The pen's ring and the ink of its stroke go on to the last of these reports; nothing begins or
 * ends by them. Stamped as reports of the next frame. */
void kiosk_late_show(struct kiosk_late *late, struct kiosk *kiosk,
		     const struct frame_reports *reports);

/* Everything as it was, bit for bit: call before the next frame. */
void kiosk_late_hide(const struct kiosk_late *late, struct kiosk *kiosk);

#endif
