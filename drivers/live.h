/* Attached tablets and buttons, live: threads read, stamp and queue; the frame loop collects.
 *
 *   hidraw nodes --thread of live.c--+
 *                                        +--> queue --live_collect--> frame_reports
 *   GPIO lines ----thread of buttons.c---+
 *
 * Nothing in the frame loop waits for a device: plugging, unplugging and searching happen in the
 * threads. A full queue drops the newest reports and counts them. */
#ifndef LIVE_H
#define LIVE_H

#include "board.h"
#include "pen.h"
#include "tape.h"

/* Which device number is whose, live and on tapes that we record. */
enum {
	LIVE_TABLETS_MAX = 4, /* devices 0 to 3 */
	LIVE_BUTTONS = 4,     /* GPIO buttons */
	LIVE_MOUSE = 5,       /* the desktop's mouse and keys (display.h) */
	LIVE_KEYS = 6,
	LIVE_DEVICES = 7,
};

/* --- what is attached ------------------------------------------------------------------------- */

enum { LIVE_NODES_MAX = 32, LIVE_TEXT_MAX = 240 };

/* A hidraw node as it is found; nothing is sent to it, and only pens are ever opened. */
struct live_node {
	char path[64];           /* /dev/hidraw3 */
	char place[96];          /* where it is plugged in: the same after plugging in again */
	char driver[32];         /* the kernel's driver, "" unknown */
	struct tape_device told; /* name, ids, descriptor */
	int layout_count;
	struct pen_layout layout[PEN_REPORTS_MAX];
	bool readable;            /* we may open it */
	char text[LIVE_TEXT_MAX]; /* what it is, or what is missing and the remedy, in a line */
};

/* Lists the hidraw nodes, at most `capacity`; returns how many there are. */
int live_nodes_find(struct live_node *nodes, int capacity);

/* --- live ------------------------------------------------------------------------------------- */

struct live;

/* Plugging in this frame, a bit a device. Call pen_describe for what was plugged, then read the
 * reports, then pen_unplugged. */
struct live_changes {
	unsigned plugged, unplugged;
};

/* Starts searching for tablets (the board says which), and goes on until closed. start_us: the
 * moment on CLOCK_MONOTONIC that reports count their time from. NULL: no memory or no thread. */
struct live *live_open(const struct board *board, int64_t start_us);
void live_close(struct live *live);

/* Adds what came since the last call. What does not fit waits for the next frame. */
struct live_changes live_collect(struct live *live, struct frame_reports *reports);

/* Name, ids, size and descriptor of a device as it was last plugged in. */
void live_device(struct live *live, int device, struct tape_device *told);

/* One line about tablets for the service page: what is there, or what is missing and the remedy. */
void live_text(struct live *live, char text[LIVE_TEXT_MAX]);

/* Reports that were lost because nobody collected for too long. */
long live_lost(struct live *live);

/* --- for other sources, and for tests ----------------------------------------------------------
 */

int64_t live_clock_us(void); /* CLOCK_MONOTONIC */

/* Queue a report, with the time since start; queue that a device came or went. */
void live_push(struct live *live, int device, int64_t time_us, int size, const uint8_t *bytes);
void live_plug(struct live *live, int device, const struct tape_device *told);
void live_unplug(struct live *live, int device);

/* Reads an open descriptor like a tablet's hidraw node from now on; a read of 0 bytes or an error
 * is its unplugging. Returns the device, -1: no place. */
int live_attach(struct live *live, int fd, const char *place, const struct tape_device *told);

#endif
