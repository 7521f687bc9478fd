/* A stroke that was not taken: its ghost, and a picture of what is wrong at the very place. */
#include "draw_piece.h"

static const float small_mm = 90.0f; /* of the sheet: about so large should it be */

static struct v2 place_px(const struct easel *easel, struct v2 mm)
{
	return view_sheet_px(&easel->ui->view, mm);
}

static void ring(const struct easel *easel, struct v2 at, double radius)
{
	cairo_t *cr = easel->cr;
	disc(cr, (double)at.x, (double)at.y, radius);
	cairo_set_line_width(cr, 9.0 * easel->unit);
	ink(cr, 0xffffff, 0.9);
	cairo_stroke_preserve(cr);
	cairo_set_line_width(cr, 4.5 * easel->unit);
	ink(cr, LOOK_WRAP, 1.0);
	cairo_stroke(cr);
}

/* Where the ends should come together. */
static void draw_gap(const struct easel *easel, struct v2 a, struct v2 b)
{
	cairo_t *cr = easel->cr;
	double u = easel->unit, dots[2] = {0.01, 9.0 * u};
	move_to(cr, a);
	line_to(cr, b);
	cairo_set_line_cap(cr, CAIRO_LINE_CAP_ROUND);
	cairo_set_line_width(cr, 5.0 * u);
	ink(cr, LOOK_WRAP, 1.0);
	stroke_dashed(cr, dots, 2);
	ring(easel, a, 13.0 * u);
	ring(easel, b, 13.0 * u);
}

/* How large it should be at least. */
static void draw_larger(const struct easel *easel, struct v2 at)
{
	cairo_t *cr = easel->cr;
	double u = easel->unit, dash[2] = {8.0 * u, 8.0 * u};
	double radius = (double)(0.5f * small_mm * easel->ui->view.sheet_px_per_mm) + 16.0 * u;
	cairo_set_dash(cr, dash, 2, 0.0);
	ring(easel, at, radius);
	cairo_set_dash(cr, NULL, 0, 0.0);
}

void draw_refused(const struct easel *easel)
{
	cairo_t *cr = easel->cr;
	const struct refused *refused = &easel->ui->refused;
	double u = easel->unit, dash[2] = {14.0 * u, 9.0 * u};
	struct v2 at = place_px(easel, refused->at_mm[0]);
	cairo_new_path(cr);
	for (int i = 0; i < refused->count; i++)
		line_to(cr, place_px(easel, refused->line_mm[i]));
	cairo_set_line_cap(cr, CAIRO_LINE_CAP_BUTT);
	cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
	cairo_set_line_width(cr, 3.4 * u);
	ink(cr, LOOK_INK_GREY, 0.85);
	stroke_dashed(cr, dash, 2);
	if (refused->fault == FAULT_CROSSES)
		ring(easel, at, 24.0 * u);
	else if (refused->fault == FAULT_OPEN)
		draw_gap(easel, at, place_px(easel, refused->at_mm[1]));
	else if (refused->fault == FAULT_SMALL)
		draw_larger(easel, at);
}

struct rect refused_area(const struct easel *easel)
{
	const struct refused *refused = &easel->ui->refused;
	double reach = (double)(small_mm * easel->ui->view.sheet_px_per_mm) + 40.0 * easel->unit;
	struct v2 at = place_px(easel, refused->at_mm[0]);
	struct rect area = rect_around(at, place_px(easel, refused->at_mm[1]), reach);
	for (int i = 0; i < refused->count; i++) {
		at = place_px(easel, refused->line_mm[i]);
		area = rect_join(area, rect_around(at, at, 8.0 * easel->unit));
	}
	return area;
}
