/* When reports count that were read by the wall's clock; see live.h. */
#include "live.h"

void live_stamp(struct frame_reports *reports, int frame, int64_t since_us, int64_t now_us)
{
	int64_t begin_us = tape_frame_us(frame);
	int64_t last_us = tape_frame_us(frame + 1) - 1 - begin_us, earlier_us = 0;
	/* what had to wait for this frame was read before the last one's end */
	if (reports->count && reports->report[0].time_us < since_us)
		since_us = reports->report[0].time_us;
	int64_t span_us = now_us - since_us;
	for (int i = 0; i < reports->count; i++) {
		struct raw_report *report = &reports->report[i];
		int64_t time_us = report->time_us - since_us;
		if (span_us > last_us)
			time_us = time_us * last_us / span_us;
		time_us = time_us < last_us ? time_us : last_us;
		/* buttons are stamped by the kernel, and come a little late */
		earlier_us = time_us > earlier_us ? time_us : earlier_us;
		report->time_us = begin_us + earlier_us;
	}
}
