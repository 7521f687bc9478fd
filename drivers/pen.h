/* Pen tablets and buttons: raw HID reports become pen samples and button masks.
 *
 *   report descriptor --pen_describe--> layouts      (pen_descriptor.c)
 *   maker's protocol  --pen_vendor_set--> a layout   (pen_vendor.h)
 *   raw report        --pen_report_read--> fields    (pen_report.c, pen_vendor_*.c)
 *   fields            --pen_read--> pen sample       (pen.c: contact; pen_filter.c: filter,
 * mapping)
 *
 * All of it is pure: no heap, no clock, no files, src's arithmetic only.
 */
#ifndef PEN_H
#define PEN_H

#include "input.h"
#include "pen_mount.h"
#include "pen_vendor.h"

enum { PEN_DEVICES_MAX = 8, PEN_REPORTS_MAX = 6, DESCRIPTOR_BYTES_MAX = 4096 };

enum {
	PEN_CONTACT_LEAST_US = 15000, /* what is shorter is no contact */
	PEN_MERGE_US = 30000,         /* what breaks off for less goes on */
	PEN_WAITING_MAX = 64,         /* 30 ms at 2000 reports a second */
};

/* A field of a report: where its bits lie and what they mean. size 0: the pen has no such field. */
struct pen_field {
	int bit;  /* from the start of the report, the id byte included */
	int size; /* bits, 1..32 */
	bool is_signed;
	int minimum, maximum; /* logical */
};

/* One input report of a device that carries a pen. */
struct pen_layout {
	struct pen_vendor
		vendor;       /* a family's: its rule reads the report, bits below mean nothing */
	bool leaves_silently; /* nothing may come when the pen leaves, In Range or not */
	bool absolute_mouse;  /* a tablet that calls itself a mouse: button 1 is the tip */
	int report_id;        /* 0: the device has no ids */
	int report_bits;      /* whole report, the id byte included */
	struct pen_field x, y, pressure, tilt_x, tilt_y, twist;
	struct pen_field tip, in_range, invert, eraser, barrel, barrel_2, serial;
	float width_mm, height_mm; /* 0: not stated, or stated unbelievably */
	float tilt_unit_rad;       /* one logical unit of tilt */
};

/* One report's fields as they stand in it, before anything is made of them. */
struct pen_fields {
	int x, y, pressure, tilt_x, tilt_y, twist; /* logical units */
	bool tip, in_range, invert, eraser, barrel, barrel_2;
};

enum device_kind {
	DEVICE_UNKNOWN,
	DEVICE_PEN,
	DEVICE_BUTTONS, /* our own one-byte report: bit per enum button */
};

/* What is not yet decided (pen_settle.h). */
enum pen_doubt {
	PEN_SURE,
	PEN_BEGUN,  /* touching: long enough to be a contact? */
	PEN_LIFTED, /* lifted under pressure: or is it a flicker? */
};

/* One end of a pen: what it shows when nobody presses it. */
struct pen_nib {
	int offset;     /* logical units above the minimum; over 0: worn, replace it */
	int least;      /* the least seen */
	int approaches; /* in a row, with pressure from the start */
};

struct pen_device {
	enum device_kind kind;
	int layout_count;
	struct pen_layout layout[PEN_REPORTS_MAX];
	struct pen_memory memory;
	char reason[160];          /* DEVICE_UNKNOWN: why, in words */
	float width_mm, height_mm; /* as told by pen_resize; 0: what the layout says */
	bool display;              /* it is the panel, whatever the mount says of others */
	uint8_t buttons_held;      /* DEVICE_BUTTONS */
	long dropped;              /* reports too short for their layout */

	/* contact: the last sample as the report had it, and what ends it */
	struct pen_sample heard;
	int64_t last_us;       /* of the last report with a position */
	int64_t silence_us;    /* so long after motion, and the pen is gone */
	bool desktop;          /* our own mouse: nothing to filter, and silence is rest */
	int contact_reports;   /* since the tip went down */
	struct pen_nib nib[2]; /* tip, eraser */

	/* filter */
	struct v2 raw_mm, filtered_mm, speed_mm_s;
	struct v2 suspect_mm; /* a jump that the next report must confirm */
	bool suspected, placed;

	/* decided: the last sample given, its state, and what waits */
	struct pen_sample last;
	enum pen_state state;
	enum pen_doubt doubt;
	int64_t doubt_us;
	struct v2 lifted_mm; /* where it touched last */
	int waiting_count;
	struct pen_sample waiting[PEN_WAITING_MAX];
	long chatter, merged; /* contacts left out; lifts left out */
};

/* How tablet millimetres become screen pixels: one scale, so that a circle stays a circle. The
 * whole screen can be reached; what is over of the tablet's longer axis stays unused. The desktop's
 * mouse and pen displays go by the panel, the whole of it, and from there by a map to the picture.
 */
struct pen_mapping {
	int width_px, height_px;
	struct pen_mount mount;
	struct plane_map from_panel, from_display; /* display: with its calibration */
};

struct pen {
	struct pen_mapping mapping;
	int touching; /* the device whose tip is down, others must wait; -1: none */
	int64_t contact_least_us, merge_us; /* 0: contacts and lifts are taken as they come */
	struct pen_device device[PEN_DEVICES_MAX];
};

void pen_init(struct pen *pen, int width_px, int height_px);

/* Every tablet lies so from now on; a calibration that can't be used is left out. */
void pen_mount(struct pen *pen, const struct pen_mount *mount);

/* Learns a device from its report descriptor. Any bytes are safe. */
void pen_describe(struct pen *pen, int device, const uint8_t *descriptor, int size);

/* The tablet speaks a protocol of its maker's, in place of or beside what its descriptor says; to
 * be called after pen_describe. PEN_BY_DESCRIPTOR changes nothing. */
void pen_vendor_set(struct pen *pen, int device, const struct pen_vendor *vendor);

/* The layouts of a descriptor with those of a protocol before them; returns their number. */
int pen_layouts_join(struct pen_layout layout[PEN_REPORTS_MAX], int count,
		     const struct pen_vendor *vendor);

/* The tablet's active area in mm, where the descriptor does not tell it or tells it wrong; 0, 0
 * goes back to the descriptor. */
void pen_resize(struct pen *pen, int device, float width_mm, float height_mm);

/* The tablet is the screen: its pen is mapped by the panel, as all are when the mount says so. */
void pen_is_display(struct pen *pen, int device, bool display);

/* Reads a descriptor only: the layouts of every pen report in it; returns their number, 0 with the
 * reason in words when there is no pen. */
int pen_descriptor_read(const uint8_t *descriptor, int size,
			struct pen_layout layout[PEN_REPORTS_MAX], char reason[160]);

/* Is this a well-formed descriptor, be it of a pen or not? */
bool pen_descriptor_sound(const uint8_t *descriptor, int size);

/* The layout that this report has, and its fields; NULL when it is no pen's report or is cut off
 * (*cut_off). memory: the device's, of its reports so far. */
const struct pen_layout *pen_report_read(const struct pen_layout *layout, int layout_count,
					 const uint8_t *bytes, int size, struct pen_memory *memory,
					 struct pen_fields *fields, bool *cut_off);

/* A device went away: a stroke in progress ends with a sample of its own. */
void pen_unplugged(struct pen *pen, int device, struct frame_input *input);

/* One frame's reports to samples and button masks; `now_us` is the frame's end and lets time-outs
 * end strokes that the pen never ended. Adds to input (zeroed by the caller). Every pen report
 * gives one sample, if late by what pen_settle.h decides; while one pen touches, the reports of
 * others are left out. */
void pen_read(struct pen *pen, const struct frame_reports *reports, int64_t now_us,
	      struct frame_input *input);

/* The descriptor of our buttons as a tape device (Button page, three buttons, five bits padding).
 */
extern const uint8_t buttons_descriptor[];
extern const int buttons_descriptor_size;

/* The descriptor of the desktop's mouse as a pen. Seven bytes, little endian, no report id: flags
 * (bit 0 tip, 1 barrel, 2 in range), x and y (0..32767 over the window), pressure (0..4095). */
extern const uint8_t mouse_descriptor[];
extern const int mouse_descriptor_size;

#endif
