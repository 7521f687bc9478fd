/* A card in the making: painted, written and kept by a thread of its own, so that no frame waits
 * for a font, a compressor or a slow stick. */
#ifndef TAKE_HOME_H
#define TAKE_HOME_H

#include "stick.h"
#include "take_home_content.h"

struct take_home;

/* Everything that the thread needs; nothing of the session is touched afterwards. */
struct take_home_order {
	struct code_content content;
	unsigned char *portrait[2];   /* from malloc, taken over; NULL: none */
	char folder[PATH_BYTES_MAX];  /* the station's; "" keeps nothing there */
	char journal[PATH_BYTES_MAX]; /* the visit's so far; "": not saved */
	char tail[256];               /* lines of it that are not written yet */
	char station[64], date[64], stem[64];
	int preview_width; /* of the card on the screen, pixels */
	const struct stick_places *places;
};

/* Takes the order (from calloc) over. NULL: fault says why, and the order is freed. */
struct take_home *take_home_start(struct take_home_order *order, char fault[FAULT_BYTES]);

/* What the page shows now; what it points to lives until take_home_free. */
void take_home_look(struct take_home *home, struct take_home_page *page);

/* No longer waits for sticks; take_home_over: its thread has ended. */
void take_home_close(struct take_home *home);
bool take_home_over(struct take_home *home);

/* Waits for the thread. */
void take_home_free(struct take_home *home);

#endif
