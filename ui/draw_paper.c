/* The paper under it all: squares of a round size, and a ruler. */
#include "draw_piece.h"

#include <stdio.h>

/* Squares of 10 mm, or of the next round size that does not blur into grey. */
static double grid_mm(double unit, const struct view *view)
{
	static const double size[] = {10, 20, 50, 100, 200, 500, 1000};
	int i = 0;
	while (i < COUNT_OF(size) - 1 && size[i] * (double)view->sheet_px_per_mm < 9.0 * unit)
		i++;
	return size[i];
}

static void grid_lines(cairo_t *cr, const struct view *view, double step_mm, uint32_t colour)
{
	struct rect pane = view->sheet_pane;
	struct v2 low = view_sheet_mm(view, (struct v2){(float)pane.x, (float)(pane.y + pane.h)});
	struct v2 high = view_sheet_mm(view, (struct v2){(float)(pane.x + pane.w), (float)pane.y});
	int first = (int)((double)low.x / step_mm) - 1, last = (int)((double)high.x / step_mm) + 1;
	for (int i = first; i <= last; i++) {
		struct v2 at = view_sheet_px(view, (struct v2){(float)(i * step_mm), 0.0f});
		cairo_rectangle(cr, (double)(int)at.x, pane.y, 1.0, pane.h);
	}
	first = (int)((double)low.y / step_mm) - 1;
	last = (int)((double)high.y / step_mm) + 1;
	for (int i = first; i <= last; i++) {
		struct v2 at = view_sheet_px(view, (struct v2){0.0f, (float)(i * step_mm)});
		cairo_rectangle(cr, pane.x, (double)(int)at.y, pane.w, 1.0);
	}
	ink(cr, colour, 1.0);
	cairo_fill(cr);
}

/* A hundred millimetres of cloth, or the next round length that can be read. */
static void draw_ruler(cairo_t *cr, struct type *type, double u, const struct view *view)
{
	static const int length_mm[] = {100, 200, 500, 1000, 2000};
	double scale = (double)view->sheet_px_per_mm;
	int i = 0;
	while (i < COUNT_OF(length_mm) - 1 && length_mm[i] * scale < 44.0 * u)
		i++;
	struct rect pane = view->sheet_pane;
	double x = pane.x + 40.0 * u, y = pane.y + pane.h - 34.0 * u, w = length_mm[i] * scale;
	cairo_move_to(cr, x, y - 9.0 * u);
	cairo_line_to(cr, x, y + 9.0 * u);
	cairo_move_to(cr, x, y);
	cairo_line_to(cr, x + w, y);
	cairo_move_to(cr, x + w, y - 9.0 * u);
	cairo_line_to(cr, x + w, y + 9.0 * u);
	cairo_set_line_width(cr, 3.0 * u);
	ink(cr, LOOK_INK_GREY, 1.0);
	cairo_stroke(cr);
	char text[16];
	snprintf(text, sizeof text, "%d mm", length_mm[i]);
	struct style style = {19.0 * u, false, LOOK_INK_GREY, ALIGN_LEFT, 0.0};
	draw_text(cr, type, text, x + w + 12.0 * u, y + 7.0 * u, &style);
}

void draw_paper(cairo_t *cr, struct type *type, double unit, const struct view *view)
{
	struct rect pane = view->sheet_pane;
	double step_mm = grid_mm(unit, view);
	ink(cr, LOOK_PAPER, 1.0);
	cairo_paint(cr);
	grid_lines(cr, view, step_mm, colour_mix(LOOK_GRID, LOOK_PAPER, 0.45));
	grid_lines(cr, view, 5.0 * step_mm, LOOK_GRID_50);
	draw_ruler(cr, type, unit, view);
	cairo_rectangle(cr, pane.x, pane.y, 3.0 * unit, pane.h);
	ink(cr, 0xb9ae9a, 1.0);
	cairo_fill(cr);
}
