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

static inline const struct piece *piece_of(const struct easel *easel, int piece)
{
	return &shown_document(easel->ui, easel->session)->pattern.piece[piece];
}

/* Pieces that are drawn as they follow the pen, and not where they lay. */
uint32_t lifted_pieces(const struct ui *ui);

static inline struct v2 local_px(const struct easel *easel, const struct piece *piece,
				 struct v2 local_mm, struct v2 shift_mm)
{
	return view_sheet_px(&easel->ui->view, v2_add(piece_to_sheet(piece, local_mm), shift_mm));
}

/* A piece, shifted on the sheet by shift_mm (while it is moved), raised then. */
void draw_piece(const struct easel *easel, int piece, struct v2 shift_mm, bool raised);

/* Its name and which side is up, where they cover no other piece. */
void draw_name(const struct easel *easel, int piece, struct v2 shift_mm);

/* The outline's edge as a current path, moved inwards by `inset` px. */
void path_edge(const struct easel *easel, struct edge_ref edge, double inset);

/* An edge in a glow that says: this one. */
void draw_edge_glow(const struct easel *easel, struct edge_ref edge, uint32_t colour);

/* Threads from edge to edge: which points will meet. */
void draw_zip(const struct easel *easel, struct edge_ref a, struct edge_ref b, bool swapped,
	      double alpha);
/* How long both edges are, and by how much the longer one is eased in. */
void draw_lengths(const struct easel *easel, struct edge_ref a, struct edge_ref b, bool even);
void draw_threads(const struct easel *easel); /* from letter to letter */
/* Seams that touch a lifted piece, or the others. */
void draw_seams(const struct easel *easel, bool lifted);
void draw_pins(const struct easel *easel);

/* The rectangle that a piece with everything on it covers, in screen pixels. */
struct rect piece_area(const struct easel *easel, int piece, struct v2 shift_mm);

/* ---- draw_grips.c ---- */

/* The box round the selected piece, or its points; in step 1. */
void draw_grips(const struct easel *easel);
/* What goes with a shape that the pen is making: guides, measures, a refusal. */
void draw_shaping(const struct easel *easel);
void draw_guides(const struct easel *easel);
struct rect guides_area(const struct easel *easel);
void draw_axis(const struct easel *easel, int piece);
/* Words on a small label about a place, kept within the pane. */
void draw_label(const struct easel *easel, struct v2 at_px, const char *text, uint32_t colour);

/* ---- draw_refused.c ---- */

void draw_refused(const struct easel *easel);
struct rect refused_area(const struct easel *easel);

/* ---- draw_paper.c ---- */

void draw_paper(cairo_t *cr, struct type *type, double unit, const struct view *view);

/* ---- draw_live.c ---- */

/* What draw_live will cover; it draws the gesture in progress, or the ring of a hovering pen. */
struct rect live_extent(const struct easel *easel);
void draw_live(const struct easel *easel);
bool pen_hovers(const struct ui *ui);
int next_cloth_number(const struct session *session);

#endif
