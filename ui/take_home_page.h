/* The page with the finished card: what stands on it, where, and what the pen does there. It
 * belongs to the visit: frames go on below it, and a tape that opens it closes it again. */
#ifndef TAKE_HOME_PAGE_H
#define TAKE_HOME_PAGE_H

#include "ui.h"

enum take_home_key { TAKE_HOME_BACK, TAKE_HOME_LEAVE, TAKE_HOME_KEYS };

struct take_home_layout {
	struct rect card, qr, station, stick, words;
	struct rect key[TAKE_HOME_KEYS];
};

void take_home_layout(struct take_home_layout *out, const struct layout *layout);

/* Opens the page; counts, so that whoever makes cards knows of it. */
void take_home_open(struct ui *ui);

/* One frame's input while it is open: keys act when the pen is lifted on them; a real button goes
 * back to play. */
void take_home_update(struct ui *ui, const struct frame_input *input);

/* How it went at one place: the station's folder, or a stick. */
enum kept {
	KEPT_NOT, /* not yet; a stick: there is none */
	KEPT_WRITING,
	KEPT,
	KEPT_FULL,
	KEPT_READ_ONLY,
	KEPT_PULLED, /* out while it was written */
	KEPT_FAILED,
	KEPT_COUNT,
};

enum { KEPT_NAME_BYTES = 64 };

struct take_home_page {
	int changed;               /* moves on with everything below */
	bool ready;                /* the card is painted */
	bool failed;               /* and never will be */
	const unsigned char *card; /* cairo's RGB24, as wide as layout.card */
	const uint8_t *qr;         /* as in draw_card.h */
	int qr_modules;
	enum kept station, stick;
	char name[KEPT_NAME_BYTES]; /* of the card's file */
};

#endif
