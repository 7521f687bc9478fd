/* Tapes: recorded raw input as hid-recorder text, so that hid-tools plays them too.
 *
 *   # kitsuke-tape 1            what only we need stands in comments:
 *   # board 1920 1080           size of the screen the pen was mapped to
 *   # budget 260000             work units a frame
 *   # frames 2700               the tape's length in frames of 1/60 s
 *   D: 0
 *   R: 234 05 0d 09 02 ...      report descriptor
 *   N: name   P: phys   I: bus vid pid
 *   E: 000001.230000 10 02 e0 ...
 *   # unplug 0 at 000002.000000
 *
 * An event at time t belongs to frame floor(t * 60).
 */
#ifndef TAPE_H
#define TAPE_H

#include "input.h"

enum { TAPE_DEVICES_MAX = 8, TAPE_DESCRIPTOR_MAX = 4096 };

struct tape_device {
	bool used;
	char name[128];
	int bus, vendor, product;
	int descriptor_size;
	uint8_t descriptor[TAPE_DESCRIPTOR_MAX];
};

struct tape_event {
	int64_t time_us;
	int device;
	int size;      /* 0: the device was unplugged */
	size_t offset; /* into bytes */
};

struct tape {
	struct tape_device device[TAPE_DEVICES_MAX];
	int width_px, height_px; /* 0: not stated */
	long budget_units;       /* 0: not stated */
	int frame_count;         /* stated, or one more than the last event's frame + 60 */
	size_t event_count;
	struct tape_event *event; /* in order of time */
	uint8_t *bytes;
	void *memory;
};

/* Reads a tape (hid-recorder text; usbhid-dump text too, with no descriptors of its own). On a
 * fault returns false with "line N: what; remedy" in fault. Memory comes from malloc: loading is
 * not the frame loop; tape_free gives it back. Any bytes are safe. */
bool tape_read(struct tape *tape, const char *text, size_t size, char fault[200]);
void tape_free(struct tape *tape);

/* Collects the events of one frame, from *cursor on; more than FRAME_REPORTS_MAX wait for the next.
 * Returns a bit set of devices unplugged in this frame. */
unsigned tape_frame(const struct tape *tape, int frame, size_t *cursor,
		    struct frame_reports *reports);

/* One line of a tape. Each returns the length; `line` must hold TAPE_LINE_MAX bytes. */
enum { TAPE_LINE_MAX = 3 * TAPE_DESCRIPTOR_MAX + 64 };
int tape_write_device(char *line, int device, const struct tape_device *description, int part);
int tape_write_event(char *line, int64_t time_us, int size, const uint8_t *bytes);

#endif
