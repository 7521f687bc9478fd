/* Pictures as files: a frame as PNG, and many frames as one contact sheet with captions. */
#ifndef PICTURE_H
#define PICTURE_H

#include "base.h"

/* Writes width x height pixels (RGBA, top row first; alpha is ignored) as PNG, through a temporary
 * name, so that no half picture is ever seen. False: fault says what and where. */
bool picture_write_png(const char *path, int width, int height, const uint8_t *rgba,
		       char fault[200]);

enum { CONTACT_FRAMES_MAX = 240, CAPTION_BYTES_MAX = 96 };

/* Frames scaled down into a grid, filled row by row. */
struct contact_sheet {
	int columns, rows, count; /* cells, and how many are filled */
	int cell_w, cell_h;       /* of a scaled frame, pixels */
	int width, height;        /* of the whole sheet */
	uint8_t *rgba;
};

/* For `frames` frames (at most CONTACT_FRAMES_MAX) of width x height; each becomes cell_w wide.
 * False: no memory. */
bool contact_open(struct contact_sheet *contact, int frames, int width, int height, int cell_w);

/* Adds a frame (of the size given to contact_open) with a line of text under it. Frames beyond
 * those asked for are dropped. */
void contact_add(struct contact_sheet *contact, int width, int height, const uint8_t *rgba,
		 const char *caption);

/* Writes the sheet and frees it; path NULL only frees. */
bool contact_finish(struct contact_sheet *contact, const char *path, char fault[200]);

#endif
