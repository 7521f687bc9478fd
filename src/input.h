/* What one frame brings from the visitor's hand. */
#ifndef INPUT_H
#define INPUT_H

#include "limits.h"
#include "vec.h"

/* One raw HID input report as the device sent it (report id first where the descriptor has ids). */
struct raw_report {
	int device;      /* index of the device on the tape */
	int64_t time_us; /* since the session's start */
	int size;
	uint8_t bytes[REPORT_BYTES_MAX];
};

struct frame_reports {
	int count;
	struct raw_report report[FRAME_REPORTS_MAX];
};

enum pen_state {
	PEN_AWAY,  /* out of range */
	PEN_HOVER, /* in range, not touching */
	PEN_TOUCH, /* tip pressed */
};

/* One pen position after decoding, filtering and mapping to the screen. */
struct pen_sample {
	enum pen_state state;
	int64_t time_us;
	struct v2 position_px; /* screen pixels, y down */
	float pressure;        /* 0..1 */
	struct v2 tilt_rad;    /* + right, + towards the user; 0 where the pen has none */
	bool eraser;           /* the other end is used */
	bool barrel;           /* first side switch */
};

enum button {
	BUTTON_WRAP,
	BUTTON_PIN,
	BUTTON_RELAX,
	BUTTON_COUNT,
};

struct frame_input {
	int sample_count;
	struct pen_sample sample[FRAME_SAMPLES_MAX];
	uint8_t buttons_held;    /* bit per enum button, at the end of the frame */
	uint8_t buttons_pressed; /* went down during the frame */
};

#endif
