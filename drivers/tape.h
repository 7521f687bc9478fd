/* Tapes: recorded raw input as hid-recorder text, so that hid-tools plays them too.
 *
 *   # kitsuke-tape 1            what only we need stands in comments:
 *   # board 1920 1080           size of the screen the pen was mapped to
 *   # budget 260000             work units a frame
 *   # frames 2700               the tape's length in frames of 1/60 s
 *   # tablet 0 203.2 127.0    size in mm of device 0, where its descriptor does not tell it
 *   # mount 180 1 1920 1080 90   how the tablets lie: turn, pen display, panel, the picture's turn
 *   # cross 9612 5390 9600 5400   a cross of the display's calibration (pen_mount.h)
 *   # display 0              device 0 is the screen
 *   # vendor 0 uclogic-2 50800 31750 8191   its maker's protocol, and its ranges of x, y, pressure
 *   D: 0
 *   R: 234 05 0d 09 02 ...      report descriptor
 *   N: name   P: phys   I: bus vid pid
 *   E: 000001.230000 10 02 e0 ...
 *   # unplug 0 at 000002.000000
 *   # hash 4338e97ce0e20eaa   of the state at the end, where the station recorded its own visit
 *
 * An event at time t belongs to frame floor(t * 60).
 */
#ifndef TAPE_H
#define TAPE_H

#include "input.h"
#include "pen_mount.h"
#include "pen_vendor.h"

enum { TAPE_DEVICES_MAX = 8, TAPE_DESCRIPTOR_MAX = 4096 };

struct tape_device {
	bool used;
	char name[128];
	int bus, vendor, product;
	float width_mm, height_mm; /* 0: not stated on the tape */
	bool display;              /* it is the screen */
	struct pen_vendor speaks;  /* its maker's protocol; PEN_BY_DESCRIPTOR: not stated */
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
	struct pen_mount mount;
	int frame_count; /* stated, or one more than the last event's frame + 60 */
	size_t event_count;
	struct tape_event *event; /* in order of time */
	uint8_t *bytes;
	void *memory;
};

/* Reads a tape: hid-recorder text, old variants too, or usbhid-dump text, where the device's number
 * is the interface's, times count from the first report, and most have no descriptors. On a fault
 * returns false with "line N: what; remedy" in fault and nothing to free. Memory comes from malloc:
 * loading is not the frame loop; tape_free gives it back. Any bytes are safe. */
bool tape_read(struct tape *tape, const char *text, size_t size, char fault[200]);
void tape_free(struct tape *tape);

/* Collects the events of one frame, from *cursor on; more than FRAME_REPORTS_MAX wait for the next
 * frame, and so does what a device sends after it was unplugged in this one. Returns a bit set of
 * the devices unplugged in this frame: read the reports first, then unplug. */
unsigned tape_frame(const struct tape *tape, int frame, size_t *cursor,
		    struct frame_reports *reports);

/* The first microsecond of a frame. */
int64_t tape_frame_us(int frame);

/* The lines of a tape. Each call writes one line with its end and a 0 after it, and returns the
 * length; `line` must hold TAPE_LINE_MAX bytes.
 *
 * tape_write_head: part 0, 1, ... until it returns 0 gives the comments on top; budget and frames
 * are left out when 0. tape_write_device: likewise the lines D, R, N, P, I of a device,
 * its size and its maker's protocol.
 * tape_write_select: the events that follow are this device's. */
enum { TAPE_LINE_MAX = 3 * TAPE_DESCRIPTOR_MAX + 64 };
int tape_write_head(char *line, const struct tape *tape, int part);
int tape_write_device(char *line, int device, const struct tape_device *description, int part);
int tape_write_select(char *line, int device);
int tape_write_event(char *line, int64_t time_us, int size, const uint8_t *bytes);
int tape_write_unplug(char *line, int64_t time_us, int device);
int tape_write_end(char *line, int frames, uint64_t hash);

#endif
