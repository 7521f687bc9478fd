/* The items of the chrome: every target, and what else lies on the bars. */
#ifndef DRAW_BUTTON_H
#define DRAW_BUTTON_H

#include "draw_text.h"

enum {
	ITEM_TITLE = TARGET_COUNT,
	ITEM_HINT,
	ITEM_METER,
	ITEM_COUNT,
	PULSE_FRAMES = 54,
};

/* How an item looks now. Everything that its drawing reads, besides the layout and language. */
struct face {
	bool useful; /* would do something */
	bool hover, pressed;
	bool on;        /* chosen: the step, the view, a mode */
	int pulse;      /* frames left */
	int progress;   /* 0..100: held, strain */
	enum text text; /* the hint */
	bool notice;
	int mark[2]; /* numbers that the hint is about; 0: none */
};

struct brush {
	cairo_t *cr;
	struct type *type;
	enum language language;
	double unit;
};

/* Draws an item (enum target, or one of the above) into its rectangle. */
void draw_button(const struct brush *brush, struct rect rect, const struct face *face, int item);

#endif
