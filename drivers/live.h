/* Attached tablets and buttons, live: threads read, stamp and queue; the frame loop collects.
 *
 *   hidraw nodes --thread of live.c-------+
 *   makers' protocols --of live_setup.c---+
 *                                         +--> queue --live_collect--> frame_reports
 *   GPIO lines ----thread of buttons.c----+
 *
 * Nothing in the frame loop waits for a device: plugging, unplugging, setting up and searching
 * happen in the threads. A tablet that speaks its maker's protocol is plugged in when it is set up,
 * or when that failed and its descriptor alone must do. What falls back to its default mode is set
 * up again. A full queue drops the newest reports and counts them. */
#ifndef LIVE_H
#define LIVE_H

#include "board.h"
#include "pen_setup.h"
#include "tape_learn.h"

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
	char path[64];            /* /dev/hidraw3 */
	char place[96];           /* where it is plugged in: the same after plugging in again */
	int interface;            /* of the USB device; -1 unknown */
	int usb_bus, usb_address; /* 0: not on USB */
	char driver[32];          /* the kernel's driver, "" unknown */
	struct tape_device told;  /* name, ids, descriptor */
	int layout_count;
	struct pen_layout layout[PEN_REPORTS_MAX];
	bool speaks; /* a maker's protocol, and recipe makes it */
	struct pen_recipe recipe;
	char protocol[160];       /* which, or why none */
	bool readable;            /* we may open it */
	bool usb_writable;        /* and its USB device, where the recipe reads strings */
	char text[LIVE_TEXT_MAX]; /* what it is, or what is missing and the remedy, in a line */
};

struct pen_identity live_node_identity(const struct live_node *node);

/* Size in mm and whether it is a display, as libwacom's data has it: whole inches, and by name and
 * ids only. False: it does not know the tablet. */
bool live_model_find(const struct live_node *node, float *width_mm, float *height_mm,
		     bool *display);

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

/* The reports that the next call of live_collect would begin with; they stay where they are. */
void live_peek(struct live *live, struct frame_reports *reports);

/* Gives a frame's reports the times that they count at, in the program's time: spread over the
 * frame as they were read between two calls of live_collect, at since_us and now_us on the reports'
 * clock. What was read over more time than a frame has is pressed together. */
void live_stamp(struct frame_reports *reports, int frame, int64_t since_us, int64_t now_us);

/* Name, ids, size and descriptor of a device as it was last plugged in. */
void live_device(struct live *live, int device, struct tape_device *told);

/* One line about tablets for the service page: what is there, or what is missing and the remedy. */
void live_text(struct live *live, char text[LIVE_TEXT_MAX]);

/* Reports that were left out: nobody collected for too long, or more than 2000 a second came and
 * this one changed nothing but the place. */
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

/* The same for a tablet that must be set up first where its descriptor says so, through
 * `transport`, which must outlive `live`. Tablets with the same `usb` are interfaces of one. */
int live_attach_setup(struct live *live, int fd, const char *place, int usb,
		      const struct tape_device *told, const struct pen_transport *transport);

#endif
