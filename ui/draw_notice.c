#include "draw_notice.h"

#include "draw_painted.h"

#include <stdio.h>
#include <stdlib.h>

enum { CARD_WIDTH = 900, CARD_HEIGHT = 210, ATTRACT_TOP = 700, RING = 66, EDGE = 12 };

struct notice_sheet {
	struct painted painted;
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
	disc(sheet->painted.cr, x, y, RING * u);
	cairo_set_line_width(sheet->painted.cr, 12.0 * u);
	ink(sheet->painted.cr, LOOK_GRID, 1.0);
	cairo_stroke(sheet->painted.cr);
	cairo_arc(sheet->painted.cr, x, y, RING * u, top,
		  top + turn * left_s / int_max(whole_s, 1));
	ink(sheet->painted.cr, LOOK_WRAP, 1.0);
	cairo_stroke(sheet->painted.cr);
	draw_text(sheet->painted.cr, sheet->painted.type, number, x, y + 20.0 * u, &style);
}

/* The pen that is wanted: a pencil that points at where it would touch. */
static void draw_pen(const struct notice_sheet *sheet, double x, double y)
{
	disc(sheet->painted.cr, x, y, RING * sheet->unit);
	ink(sheet->painted.cr, LOOK_WRAP, 1.0);
	cairo_fill(sheet->painted.cr);
	ink(sheet->painted.cr, LOOK_PAPER, 1.0);
	draw_icon(sheet->painted.cr, ICON_PENCIL, x, y, 84.0 * sheet->unit);
}

static void draw_card(const struct notice_sheet *sheet, enum language language, int left_s,
		      int whole_s)
{
	static const struct phrase ask = {"まだ遊びますか？ ペンを動かしてね",
					  "Still there? Move the pen to go on"};
	static const struct phrase begin = {"ペンでさわって、服を作ろう",
					    "Touch with the pen and make clothes"};
	cairo_t *cr = sheet->painted.cr;
	double u = sheet->unit, w = sheet->painted.layer.area.w, h = sheet->painted.layer.area.h;
	painted_clear(&sheet->painted);
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
	draw_phrase(cr, sheet->painted.type, left_s > 0 ? &ask : &begin, language, text, &label);
}

const struct layer *notice_sheet_update(struct notice_sheet *sheet, enum language language,
					int left_s, int whole_s)
{
	struct layer *layer = &sheet->painted.layer;
	int wanted = left_s * 4 + (int)language;
	int top = left_s > 0 ? (sheet->height - layer->area.h) / 2
			     : (int)(ATTRACT_TOP * sheet->unit);
	layer->damage_count = 0;
	layer->area.y = top;
	/* what waits for a visitor leaves the figure free */
	layer->area.x = (sheet->width - layer->area.w) / (left_s > 0 ? 2 : 1);
	if (wanted != sheet->seen) {
		draw_card(sheet, language, left_s, whole_s);
		painted_damage(&sheet->painted);
	}
	sheet->seen = wanted;
	return layer;
}

struct notice_sheet *notice_sheet_open(int width, int height, char fault[200])
{
	struct notice_sheet *sheet = calloc(1, sizeof *sheet);
	if (!sheet) {
		snprintf(fault, 200, "no memory for a notice");
		return NULL;
	}
	sheet->unit = (double)height / 1080.0;
	sheet->width = width;
	sheet->height = height;
	sheet->seen = -1;
	struct rect area = {0, 0, int_min((int)(CARD_WIDTH * sheet->unit), width),
			    (int)(CARD_HEIGHT * sheet->unit)};
	if (!painted_open(&sheet->painted, area, false, fault)) {
		free(sheet);
		return NULL;
	}
	return sheet;
}

void notice_sheet_close(struct notice_sheet *sheet)
{
	if (!sheet)
		return;
	painted_close(&sheet->painted);
	free(sheet);
}
