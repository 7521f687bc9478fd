/* A card made of a visit's content: its code, the painted picture, the PNG. All of it may run in a
 * thread of its own. */
#ifndef TAKE_HOME_CARD_H
#define TAKE_HOME_CARD_H

#include "draw_card.h"
#include "format_code.h"
#include "store.h"

enum {
	QR_MODULES_MAX = 17 + 4 * 25, /* version 25: four dots a module on the card, 0.34 mm */
};

struct card_made {
	struct card card; /* as painted */
	uint8_t qr[QR_MODULES_MAX * QR_MODULES_MAX];
	int qr_version; /* 0: no code holds it */
	char qr_level;  /* 'Q', 'M' or 'L': a quarter, 15 %, 7 % of it may be spoilt */
	struct code_figures figures;
	char *text; /* the code, from malloc */
};

/* The code of the content. Its card still lacks portraits, names and date. False: the content is
 * no pattern that a code can carry, or no memory. */
bool card_begin(struct card_made *made, const struct code_content *content,
		char fault[FAULT_BYTES]);
void card_end(struct card_made *made);

/* The painted card from malloc, cairo's RGB24; NULL: fault says why. */
unsigned char *card_pixels(const struct card_made *made, int width, char fault[FAULT_BYTES]);

/* The card as a PNG of 300 dots an inch from malloc, with the code in a tEXt chunk for the
 * importer. */
uint8_t *card_png(const struct card_made *made, size_t *size, char fault[FAULT_BYTES]);

#endif
