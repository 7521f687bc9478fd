/* The operator's desk: the page on the screen, its own pens, and what is counted for it while it is
 * closed. The visit knows nothing of it. */
#ifndef DESK_H
#define DESK_H

#include "cycle.h"
#include "kiosk.h"
#include "service_page.h"
#include "tape.h"

enum {
	DESK_TIMES = 512,
	DESK_LOG_LINES = 12,
	DESK_LOG_BYTES = 160,
	DESK_REFRESH_FRAMES = 15,               /* a figure that changes faster can't be read */
	DESK_IDLE_FRAMES = 180 * FRAME_RATE_HZ, /* without a moving pen the page closes */
	DESK_CHORD_FRAMES = 5 * FRAME_RATE_HZ,  /* where no GPIO line tells of it */
};

/* What a device sent while the page was open. */
struct desk_watch {
	struct raw_report last; /* with any bytes; size 0: none yet */
	struct pen_memory memory;
	struct pen_fields fields;
	const struct pen_layout *layout; /* NULL: the last was no pen's report */
	int reports, rate_hz;            /* since the second began; of the last second */
};

struct desk {
	bool wanted, open, renew; /* renew: the visit begins anew when the page closes */
	int frames;               /* since it was opened */
	int chord;                /* frames that all buttons have been held */
	long visits, late;        /* since the station was switched on; flips that came late */
	int64_t time_us[DESK_TIMES];
	int time_count;
	struct service_page page;
	struct pen pen;
	struct frame_input input;
	struct desk_watch watch[PEN_DEVICES_MAX];
	struct pen_mount tried; /* with the crosses just taken */
};

/* What the processor did in a frame. */
static inline void desk_time(struct desk *desk, int64_t us)
{
	desk->time_us[desk->time_count++ % DESK_TIMES] = us;
}

/* Milliseconds that a share of the last frames stayed below; 0: none yet. */
float desk_time_ms(const struct desk *desk, float share);

/* The log's last lines, oldest first; NULL behind the last. */
void desk_log(const char *line);
const char *desk_log_line(int index);

/* Reports to the desk's pens and watches. */
void desk_listen(struct desk *desk, const struct frame_reports *reports);

/* The card about pens; told: what the devices say of themselves, NULL where there is none. */
void desk_show_pens(struct desk *desk, const struct tape_device *const told[PEN_DEVICES_MAX]);

/* The crosses taken as a calibration of a picture that lies on the panel by `mount`: into
 * desk->tried, and in words into the page. */
void desk_calibrate(struct desk *desk, const struct pen_mount *mount, float mm_per_px);

#endif
