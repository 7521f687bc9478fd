/* The three hardware buttons: GPIO lines to one-byte reports of buttons_descriptor (pen.h).
 *
 *   chip with the line's name --request--> edges, levels --buttons_level--> mask --> queue
 */
#ifndef BUTTONS_H
#define BUTTONS_H

#include "live.h"

enum {
	BUTTONS_DEBOUNCE_US = 10000,
	BUTTONS_LOCK_US = 200000,     /* between two presses of one button: hammering is one */
	BUTTONS_STUCK_US = 30000000,  /* nobody pins or relaxes for so long: it is jammed */
	BUTTONS_SERVICE_US = 5000000, /* all three for so long: the operator */
};

/* --- levels to masks, pure -------------------------------------------------------------------- */

struct buttons_state {
	int64_t debounce_us; /* 0: the kernel debounces */
	uint8_t level;       /* pressed as the lines say now */
	uint8_t held;        /* pressed as reported */
	uint8_t ignored;     /* pressed from the start, or stuck: they wait for a release */
	uint8_t stuck;
	bool service; /* told already */
	long edges[BUTTON_COUNT],
		presses[BUTTON_COUNT]; /* more than two edges a press: it bounces */
	int64_t changed_us[BUTTON_COUNT];
	int64_t pressed_us[BUTTON_COUNT]; /* as reported last */
};

/* Takes the levels found when the lines were opened: what is held then is no press. */
void buttons_begin(struct buttons_state *state, uint8_t level, int64_t debounce_us);

/* A line changed. */
void buttons_level(struct buttons_state *state, enum button button, bool pressed, int64_t time_us);

/* True when the mask to report has changed by now; it is in state->held then. */
bool buttons_settle(struct buttons_state *state, int64_t now_us);

/* Is a change still waiting for its debounce time, or a press for the lock's end? */
bool buttons_unsettled(const struct buttons_state *state);

/* True once when all buttons have been held for BUTTONS_SERVICE_US. */
bool buttons_chord(struct buttons_state *state, int64_t now_us);

/* Events are numbered from 1 on: does this one leave some out? The kernel has then dropped them,
 * and the line's level has the last word. */
bool buttons_gap(uint32_t *last, uint32_t number);

/* --- live ------------------------------------------------------------------------------------- */

struct buttons;

/* A chip that has one of our lines or could have. */
struct buttons_chip {
	char path[64], name[64], label[64];
	int line_count;
	int offset[BUTTON_COUNT]; /* -1: the line's name is not on this chip */
};

/* Lists the GPIO chips that may be opened; *refused counts those that may not. */
int buttons_chips_find(const struct board *board, struct buttons_chip *chips, int capacity,
		       int *refused);

/* Starts a thread that finds the lines by name, reports their edges on LIVE_BUTTONS, and finds them
 * again when a chip went away and came back. NULL: the board names no line, or no thread. */
struct buttons *buttons_open(const struct board *board, struct live *live, int64_t start_us);
void buttons_close(struct buttons *buttons);

/* True once when the operator held all buttons. */
bool buttons_service(struct buttons *buttons);

/* Levels, presses and edges so far; all 0 before a line is found. */
void buttons_look(struct buttons *buttons, struct buttons_state *state);

/* One line for the service page: what is there, or what is missing or stuck and the remedy. */
void buttons_text(struct buttons *buttons, char text[LIVE_TEXT_MAX]);

#endif
