#include "draw_notice.h"

#include "draw_text.h"

#include <stdio.h>
#include <stdlib.h>

enum { CARD_WIDTH = 900, CARD_HEIGHT = 210, ATTRACT_TOP = 700, RING = 66, EDGE = 12 };

struct notice_sheet {
	struct layer layer;
	struct type *type;
	cairo_surface_t *surface;
	cairo_t *cr;
	double unit;
	int width, height; /* of the screen */
	int seen;          /* what is drawn: language and seconds; -1: nothing */
};

/* What is left of the ring is what is left of the time. */
static void draw_ring(const struct notice_sheet *sheet, double x, double y, int left_s, int whole_s)
{
	double u = sheet->unit, top = -1.5707963267948966, turn = 6.283185307179586;
	char number[16];
	struct style style = {56.0 * u, true, LOOK_INK, ALIGN_CENTRE, 0.0};
	snprintf(number, sizeof number, "%d", left_s);
	disc(sheet->cr, x, y, RING * u);
	cairo_set_line_width(sheet->cr, 12.0 * u);
	ink(sheet->cr, LOOK_GRID, 1.0);
	cairo_stroke(sheet->cr);
	cairo_arc(sheet->cr, x, y, RING * u, top, top + turn * left_s / int_max(whole_s, 1));
	ink(sheet->cr, LOOK_WRAP, 1.0);
	cairo_stroke(sheet->cr);
	draw_text(sheet->cr, sheet->type, number, x, y + 20.0 * u, &style);
}

/* The pen that is wanted: a pencil that points at where it would touch. */
static void draw_pen(const struct notice_sheet *sheet, double x, double y)
{
	disc(sheet->cr, x, y, RING * sheet->unit);
	ink(sheet->cr, LOOK_WRAP, 1.0);
	cairo_fill(sheet->cr);
	ink(sheet->cr, LOOK_PAPER, 1.0);
	draw_icon(sheet->cr, ICON_PENCIL, x, y, 84.0 * sheet->unit);
}

static void draw_card(const struct notice_sheet *sheet, enum language language, int left_s,
		      int whole_s)
{
	static const struct phrase ask = {"まだ遊びますか？ ペンを動かしてね",
					  "Still there? Move the pen to go on"};
	static const struct phrase begin = {"ペンでさわって、服を作ろう",
					    "Touch with the pen and make clothes"};
	cairo_t *cr = sheet->cr;
	double u = sheet->unit, w = sheet->layer.area.w, h = sheet->layer.area.h;
	cairo_set_operator(cr, CAIRO_OPERATOR_SOURCE);
	cairo_set_source_rgba(cr, 0.0, 0.0, 0.0, 0.0);
	cairo_paint(cr);
	cairo_set_operator(cr, CAIRO_OPERATOR_OVER);
	for (int i = EDGE; i > 0; i -= 2) { /* a soft shadow */
		round_box(cr, i * u * 0.5, i * u * 0.7, w - i * u, h - i * u, 26.0 * u);
		ink(cr, LOOK_INK, 0.035);
		cairo_fill(cr);
	}
	round_box(cr, EDGE * u, EDGE * u * 0.5, w - 2 * EDGE * u, h - 2 * EDGE * u, 22.0 * u);
	ink(cr, LOOK_HINT, 1.0);
	cairo_fill_preserve(cr);
	ink(cr, LOOK_HINT_RIM, 1.0);
	cairo_set_line_width(cr, 2.5 * u);
	cairo_stroke(cr);
	double x = 118.0 * u, y = 0.5 * h - 6.0 * u;
	if (left_s > 0)
		draw_ring(sheet, x, y, left_s, whole_s);
	else
		draw_pen(sheet, x, y);
	struct rect text = {(int)(220.0 * u), 0, (int)(w - 250.0 * u), (int)(h - 12.0 * u)};
	struct label label = {37.0 * u, 29.0 * u, LOOK_INK, LOOK_INK_GREY, ALIGN_LEFT};
	draw_phrase(cr, sheet->type, left_s > 0 ? &ask : &begin, language, text, &label);
}

const struct layer *notice_sheet_update(struct notice_sheet *sheet, enum language language,
					int left_s, int whole_s)
{
	struct layer *layer = &sheet->layer;
	int wanted = left_s * 4 + (int)language;
	int top = left_s > 0 ? (sheet->height - layer->area.h) / 2
			     : (int)(ATTRACT_TOP * sheet->unit);
	layer->damage_count = 0;
	layer->area.y = top;
	/* what waits for a visitor leaves the figure free */
	layer->area.x = (sheet->width - layer->area.w) / (left_s > 0 ? 2 : 1);
	if (wanted != sheet->seen) {
		draw_card(sheet, language, left_s, whole_s);
		cairo_surface_flush(sheet->surface);
		layer->damage_count = 1;
		layer->damage[0] = (struct rect){0, 0, layer->area.w, layer->area.h};
	}
	sheet->seen = wanted;
	return layer;
}

struct notice_sheet *notice_sheet_open(int width, int height, char fault[200])
{
	struct type *type = type_open(fault);
	struct notice_sheet *sheet = calloc(1, sizeof *sheet);
	if (!type || !sheet) {
		type_close(type);
		free(sheet);
		return NULL;
	}
	double unit = (double)height / 1080.0;
	struct layer *layer = &sheet->layer;
	layer->area.w = int_min((int)(CARD_WIDTH * unit), width);
	layer->area.h = (int)(CARD_HEIGHT * unit);
	sheet->type = type;
	sheet->unit = unit;
	sheet->width = width;
	sheet->height = height;
	sheet->seen = -1;
	sheet->surface = cairo_image_surface_create(CAIRO_FORMAT_ARGB32, layer->area.w,
						    layer->area.h);
	sheet->cr = cairo_create(sheet->surface);
	if (cairo_status(sheet->cr) != CAIRO_STATUS_SUCCESS) {
		snprintf(fault, 200, "no memory for a notice");
		notice_sheet_close(sheet);
		return NULL;
	}
	layer->pixels = cairo_image_surface_get_data(sheet->surface);
	layer->stride = cairo_image_surface_get_stride(sheet->surface);
	layer->patch_count = 1;
	layer->patch[0] = (struct patch){{0, 0, layer->area.w, layer->area.h}, false};
	return sheet;
}

void notice_sheet_close(struct notice_sheet *sheet)
{
	if (!sheet)
		return;
	cairo_destroy(sheet->cr);
	cairo_surface_destroy(sheet->surface);
	type_close(sheet->type);
	free(sheet);
}
