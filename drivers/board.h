/* The board file: what is true of one station and not of the program. Text, a line each:
 *
 *   # comment
 *   key = value
 *
 * `board_text` is a whole board file with every key, its meaning and its default value. */
#ifndef BOARD_H
#define BOARD_H

#include "input.h"
#include "pen_mount.h"

enum {
	BOARD_NAME_MAX = 64,
	BOARD_TEXT_MAX = 64 << 10,
	BOARD_OVER_MAX = 2048,
	BOARD_THREADS_MAX = 8
};

enum { BOARD_PIN_MAX = 8 };

enum board_language { BOARD_BOTH, BOARD_JAPANESE, BOARD_ENGLISH }; /* as in ui.h */

struct board {
	float display_width_mm, display_height_mm;      /* 0: what the display itself says */
	int rotation;                                   /* degrees clockwise: 0, 90, 180, 270 */
	char button_line[BUTTON_COUNT][BOARD_NAME_MAX]; /* GPIO line names; "" for none */
	bool button_active_low; /* pressed pulls the line to ground; a pull-up is asked for */
	long budget_units;      /* solver's work a frame; 0: what the program takes as its own */
	int threads;            /* that move the cloth; 0: as many as the host thinks right */
	int thread_cpus;        /* how many of thread_cpu are given; 0: the system chooses */
	int thread_cpu[BOARD_THREADS_MAX - 1]; /* of the threads beside the frame's own */
	int idle_s; /* without a touch for so long, the station starts anew; 0: never */
	enum board_language language;
	char station[BOARD_NAME_MAX];        /* its name, on the cards that it makes; "": none */
	char service_pin[BOARD_PIN_MAX + 1]; /* digits that open the service page; "": none asked */
	int tablet_vendor, tablet_product;   /* take this tablet only; 0, 0: any */
	float tablet_width_mm, tablet_height_mm; /* 0: what the tablet itself says */
	struct pen_mount
		mount;     /* how it lies; the panel's size and turn are the display's to say */
	bool display_auto; /* whether it is the display is its model's to say */
	int crosses_asked; /* by the service page: 4, 9, 16 or 25 */
	float calibration_rms_px, calibration_worst_px; /* what the crosses' map leaves */
};

extern const struct board board_default;
extern const char board_text[];

/* Reads a board file; keys that it does not name keep their defaults. On a fault returns false with
 * "line N: what; remedy" in fault, and board holds the defaults. Any bytes are safe. */
bool board_read(struct board *board, const char *text, size_t size, char fault[200]);

/* The same on top of what board says already: what the operator set at the station lies over what
 * the exhibitor wrote. On a fault board stays as it was. */
bool board_read_over(struct board *board, const char *text, size_t size, char fault[200]);

/* Writes what the operator can set and `now` has otherwise than `base` as a text for
 * board_read_over; returns its size, with a zero behind it. */
int board_write_over(const struct board *base, const struct board *now, char text[BOARD_OVER_MAX]);

#endif
