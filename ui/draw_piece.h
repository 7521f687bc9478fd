/* What lies on the sheet: pieces of cloth with their marks, seams with their letters, pins. Each
 * drawing reads the document and the view only, so that a clip is all that damage needs. */
#ifndef DRAW_PIECE_H
#define DRAW_PIECE_H

#include "draw_text.h"

struct cloth_paint; /* woven patterns of every swatch, both sides */

struct cloth_paint *cloth_paint_open(double unit);
void cloth_paint_close(struct cloth_paint *paint);

struct easel {
	cairo_t *cr;
	struct type *type;
	struct cloth_paint *paint;
	const struct ui *ui;
	const struct session *session;
	double unit; /* pixels for a pixel at 1080 lines */
};

/* A piece, shifted on the sheet by shift_mm (while it is moved), raised then. */
void draw_piece(const struct easel *easel, int piece, struct v2 shift_mm, bool raised);

/* The outline's edge as a current path, moved inwards by `inset` px. */
void path_edge(const struct easel *easel, struct edge_ref edge, double inset);

/* An edge in a glow that says: this one. */
void draw_edge_glow(const struct easel *easel, struct edge_ref edge, uint32_t colour);

/* Threads from edge to edge: which points will meet. */
void draw_zip(const struct easel *easel, struct edge_ref a, struct edge_ref b, bool swapped,
	      double alpha);
void draw_seams(const struct easel *easel);
void draw_pins(const struct easel *easel);

/* The rectangle that a piece with everything on it covers, in screen pixels. */
struct rect piece_area(const struct easel *easel, int piece, struct v2 shift_mm);

#endif
