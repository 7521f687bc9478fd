/* Words and shapes on cairo: one typeface, two weights, and the few helpers that bars and sheet
 * share. Drawing only; nothing that can be touched depends on what is measured here. */
#ifndef DRAW_TEXT_H
#define DRAW_TEXT_H

#include "look.h"
#include "text.h"
#include "tool.h"

#include <cairo.h>

struct type;

/* NULL with a line in fault when the typeface is missing. */
struct type *type_open(char fault[200]);
void type_close(struct type *type);

enum align { ALIGN_LEFT, ALIGN_CENTRE };

struct style {
	double size_px;
	bool bold;
	uint32_t colour;
	enum align align;
	double width_max; /* made smaller to fit; 0: any width */
};

/* One line with its baseline at y. Returns its width. */
double draw_text(cairo_t *cr, struct type *type, const char *text, double x, double y,
		 const struct style *style);

/* A phrase in the visitor's language: Japanese bold over English, or one of them alone, centred in
 * height on the rectangle. */
struct label {
	double japanese_px, english_px;
	uint32_t colour, colour_english;
	enum align align;
};
void draw_phrase(cairo_t *cr, struct type *type, const struct phrase *phrase,
		 enum language language, struct rect rect, const struct label *label);

/* ---- cairo in our units ---- */

static inline void ink(cairo_t *cr, uint32_t colour, double alpha)
{
	cairo_set_source_rgba(cr, (double)look_red(colour), (double)look_green(colour),
			      (double)look_blue(colour), alpha);
}

static inline void line_to(cairo_t *cr, struct v2 point)
{
	cairo_line_to(cr, (double)point.x, (double)point.y);
}

static inline void move_to(cairo_t *cr, struct v2 point)
{
	cairo_move_to(cr, (double)point.x, (double)point.y);
}

static inline void disc(cairo_t *cr, double x, double y, double radius)
{
	cairo_new_sub_path(cr);
	cairo_arc(cr, x, y, radius, 0.0, 6.283185307179586);
}

/* Strokes the path in dashes, so long on and off in turn, and leaves whole lines for what follows.
 */
void stroke_dashed(cairo_t *cr, const double *dash, int count);

void round_box(cairo_t *cr, double x, double y, double w, double h, double radius);
void round_rect(cairo_t *cr, struct rect rect, double radius);

/* The smallest rectangle with both in it; an empty one adds nothing. */
struct rect rect_join(struct rect a, struct rect b);
struct rect rect_within(struct rect a, struct rect outer);

/* What a line from a to b covers, with a margin. */
struct rect rect_around(struct v2 a, struct v2 b, double margin);

/* a towards b by t, channel by channel. */
uint32_t colour_mix(uint32_t a, uint32_t b, double t);

/* A mark's number in its filled circle, with a white rim; radius_px of the fill. */
void draw_number(cairo_t *cr, struct type *type, int number, double x, double y, double radius_px,
		 bool paired);

/* The pictograms, drawn into a square of `size` about (x, y) with the current source. */
enum icon {
	ICON_SHIRT,
	ICON_PIN,
	ICON_WAVES,
	ICON_LASER,
	ICON_ERASER,
	ICON_COPY,
	ICON_TURN_OVER,
	ICON_MIRROR,
	ICON_BIN,
	ICON_SWAP,
	ICON_HAND,
	ICON_AGAIN,
	ICON_UNDO,
	ICON_REDO,
	ICON_PENCIL,
	ICON_POINTS,
	ICON_BOX,
	ICON_ROUND,
	ICON_FOLD,
	ICON_EVEN,
	ICON_MINUS,
	ICON_PLUS,
};
void draw_icon(cairo_t *cr, enum icon icon, double x, double y, double size);

#endif
