/* The card that a visitor takes home, as cairo paints it: a postcard of 148 x 100 mm at 300 dots an
 * inch, or smaller. Needs no GL and no frame: it is painted in a thread of its own. */
#ifndef DRAW_CARD_H
#define DRAW_CARD_H

#include "session.h"

enum {
	CARD_WIDTH = 1748,
	CARD_HEIGHT = 1181,
	PORTRAIT_WIDTH = 860, /* of the figure, on nothing */
	PORTRAIT_HEIGHT = 1120,
	PORTRAITS = 2, /* from the front, from the back */
	CARD_TEXT_BYTES = 64,
};

/* The first portrait's azimuth: a little from the side, as tailors' drawings are. */
#define PORTRAIT_AZIMUTH 0.38f

struct card {
	const struct pattern *pattern;
	const struct marks *marks;
	unsigned char *portrait[PORTRAITS]; /* cairo's ARGB32, top row first; NULL: none */
	const uint8_t *qr;                  /* qr_modules rows of as many; 1: dark */
	int qr_modules;                     /* 0: the pattern fits in no code */
	char station[CARD_TEXT_BYTES];      /* "": not named */
	char date[CARD_TEXT_BYTES];
	char file[CARD_TEXT_BYTES]; /* the journal's, that lies beside the card */
};

/* Paints `width` x width * CARD_HEIGHT / CARD_WIDTH pixels of cairo's RGB24. False with a line in
 * fault: no typeface, no memory. */
bool card_paint(const struct card *card, unsigned char *pixels, int width, char fault[200]);

static inline int card_height(int width)
{
	return (width * CARD_HEIGHT + CARD_WIDTH / 2) / CARD_WIDTH;
}

#endif
