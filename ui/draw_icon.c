/* Pictograms, each in a square from (-1, -1) to (1, 1), drawn with the source that is set. */
#include "draw_text.h"

struct point {
	double x, y;
};

static void polygon(cairo_t *cr, const struct point *point, int count)
{
	cairo_new_sub_path(cr);
	for (int i = 0; i < count; i++)
		cairo_line_to(cr, point[i].x, point[i].y);
}

static void shirt(cairo_t *cr)
{
	static const struct point right[] = {{0.34, -0.74}, {0.62, -0.66}, {1.0, -0.22},
					     {0.7, 0.06},   {0.52, -0.12}, {0.52, 0.8}};
	cairo_move_to(cr, -0.34, -0.74);
	cairo_curve_to(cr, -0.26, -0.4, 0.26, -0.4, 0.34, -0.74);
	for (int i = 0; i < COUNT_OF(right); i++)
		cairo_line_to(cr, right[i].x, right[i].y);
	for (int i = COUNT_OF(right) - 1; i >= 0; i--)
		cairo_line_to(cr, -right[i].x, right[i].y);
	cairo_close_path(cr);
	cairo_fill(cr);
}

static void pin(cairo_t *cr)
{
	disc(cr, 0.0, -0.4, 0.42);
	cairo_fill(cr);
	cairo_move_to(cr, 0.0, -0.1);
	cairo_line_to(cr, 0.0, 0.86);
	cairo_stroke(cr);
}

static void waves(cairo_t *cr)
{
	for (int i = -1; i <= 1; i += 2) {
		double y = 0.34 * i;
		cairo_move_to(cr, -0.86, y);
		cairo_curve_to(cr, -0.57, y - 0.5, -0.29, y - 0.5, 0.0, y);
		cairo_curve_to(cr, 0.29, y + 0.5, 0.57, y + 0.5, 0.86, y);
	}
	cairo_stroke(cr);
}

static void arrow_head(cairo_t *cr, double x, double y, double dx, double dy)
{
	cairo_move_to(cr, x - 0.36 * dx + 0.36 * dy, y - 0.36 * dy - 0.36 * dx);
	cairo_line_to(cr, x, y);
	cairo_line_to(cr, x - 0.36 * dx - 0.36 * dy, y - 0.36 * dy + 0.36 * dx);
}

/* A line on a front sheet, and the same line on the sheet behind it. */
static void laser(cairo_t *cr)
{
	cairo_move_to(cr, 0.0, -0.9);
	cairo_line_to(cr, 0.0, 0.9);
	arrow_head(cr, 0.0, -0.92, 0.0, -1.0);
	arrow_head(cr, 0.0, 0.92, 0.0, 1.0);
	cairo_stroke(cr);
}

static void eraser(cairo_t *cr)
{
	static const struct point body[] = {
		{-0.7, 0.72}, {-0.9, 0.28}, {0.2, -0.82}, {0.84, -0.3}, {-0.2, 0.72}};
	polygon(cr, body, COUNT_OF(body));
	cairo_close_path(cr);
	cairo_move_to(cr, -0.4, -0.22);
	cairo_line_to(cr, 0.32, 0.24);
	cairo_stroke(cr);
	cairo_move_to(cr, -0.7, 0.72);
	cairo_line_to(cr, 0.9, 0.72);
	cairo_stroke(cr);
}

static void copy(cairo_t *cr)
{
	round_box(cr, -0.8, -0.8, 1.1, 1.1, 0.18);
	cairo_move_to(cr, 0.56, -0.36);
	cairo_line_to(cr, 0.8, -0.36);
	cairo_line_to(cr, 0.8, 0.8);
	cairo_line_to(cr, -0.36, 0.8);
	cairo_line_to(cr, -0.36, 0.56);
	cairo_stroke(cr);
}

/* A sheet whose corner comes over. */
static void turn_over(cairo_t *cr)
{
	static const struct point sheet[] = {
		{0.74, -0.1}, {0.74, -0.74}, {-0.74, -0.74}, {-0.74, 0.74}, {0.1, 0.74}};
	static const struct point corner[] = {{0.74, -0.1}, {0.1, -0.1}, {0.1, 0.74}};
	polygon(cr, sheet, COUNT_OF(sheet));
	cairo_close_path(cr);
	cairo_stroke(cr);
	polygon(cr, corner, COUNT_OF(corner));
	cairo_close_path(cr);
	cairo_fill(cr);
}

static void mirror(cairo_t *cr)
{
	static const struct point half[] = {{-0.24, -0.7}, {-0.24, 0.7}, {-0.92, 0.7}};
	static const struct point other[] = {{0.24, -0.7}, {0.24, 0.7}, {0.92, 0.7}};
	polygon(cr, half, COUNT_OF(half));
	cairo_close_path(cr);
	cairo_fill(cr);
	polygon(cr, other, COUNT_OF(other));
	cairo_close_path(cr);
	cairo_stroke(cr);
	cairo_move_to(cr, 0.0, -0.9);
	cairo_line_to(cr, 0.0, 0.9);
	cairo_stroke(cr);
}

static void bin(cairo_t *cr)
{
	static const struct point body[] = {
		{-0.56, -0.46}, {-0.44, 0.86}, {0.44, 0.86}, {0.56, -0.46}};
	polygon(cr, body, COUNT_OF(body));
	cairo_move_to(cr, -0.8, -0.5);
	cairo_line_to(cr, 0.8, -0.5);
	cairo_move_to(cr, -0.26, -0.56);
	cairo_line_to(cr, -0.2, -0.86);
	cairo_line_to(cr, 0.2, -0.86);
	cairo_line_to(cr, 0.26, -0.56);
	cairo_stroke(cr);
}

/* Two edges whose ends change partners. */
static void swap(cairo_t *cr)
{
	cairo_move_to(cr, -0.8, -0.6);
	cairo_curve_to(cr, 0.1, -0.6, -0.1, 0.6, 0.8, 0.6);
	cairo_move_to(cr, -0.8, 0.6);
	cairo_curve_to(cr, 0.1, 0.6, -0.1, -0.6, 0.8, -0.6);
	cairo_stroke(cr);
	arrow_head(cr, 0.9, 0.6, 1.0, 0.0);
	arrow_head(cr, 0.9, -0.6, 1.0, 0.0);
	cairo_stroke(cr);
}

static void hand(cairo_t *cr)
{
	cairo_move_to(cr, -0.62, 0.9);
	cairo_curve_to(cr, -0.7, 0.5, -1.1, 0.3, -0.94, 0.0);
	cairo_curve_to(cr, -0.8, -0.14, -0.6, 0.04, -0.52, 0.2);
	static const double x[] = {-0.52, -0.18, 0.16, 0.5}, top[] = {-0.6, -0.9, -0.86, -0.56};
	for (int i = 0; i < 4; i++) {
		cairo_line_to(cr, x[i], top[i] + 0.16);
		cairo_arc(cr, x[i] + 0.16, top[i] + 0.16, 0.16, 3.14159265, 6.2831853);
		if (i < 3)
			cairo_line_to(cr, x[i] + 0.33, 0.0);
	}
	cairo_curve_to(cr, 0.84, 0.4, 0.74, 0.6, 0.6, 0.9);
	cairo_close_path(cr);
	cairo_stroke(cr);
}

static void again(cairo_t *cr)
{
	cairo_new_sub_path(cr);
	cairo_arc(cr, 0.0, 0.0, 0.74, -0.9, 4.2);
	cairo_stroke(cr);
	arrow_head(cr, -0.3, -0.68, 0.7, -0.7);
	cairo_stroke(cr);
}

static void undo(cairo_t *cr)
{
	cairo_move_to(cr, -0.8, -0.3);
	cairo_line_to(cr, 0.3, -0.3);
	cairo_curve_to(cr, 1.0, -0.3, 1.0, 0.7, 0.3, 0.7);
	cairo_line_to(cr, -0.4, 0.7);
	arrow_head(cr, -0.84, -0.3, -1.0, 0.0);
	cairo_stroke(cr);
}

static void pencil(cairo_t *cr)
{
	static const struct point body[] = {
		{-0.86, 0.86}, {-0.7, 0.3}, {0.46, -0.86}, {0.86, -0.46}, {-0.3, 0.7}};
	polygon(cr, body, COUNT_OF(body));
	cairo_close_path(cr);
	cairo_move_to(cr, 0.2, -0.6);
	cairo_line_to(cr, 0.6, -0.2);
	cairo_stroke(cr);
}

/* A bent line with its corners. */
static void points(cairo_t *cr)
{
	static const struct point corner[] = {{-0.74, 0.6}, {-0.2, -0.66}, {0.74, 0.3}};
	cairo_move_to(cr, corner[0].x, corner[0].y);
	cairo_line_to(cr, corner[1].x, corner[1].y);
	cairo_curve_to(cr, 0.4, -0.8, 0.8, -0.3, corner[2].x, corner[2].y);
	cairo_stroke(cr);
	for (int i = 0; i < COUNT_OF(corner); i++) {
		disc(cr, corner[i].x, corner[i].y, 0.24);
		cairo_fill(cr);
	}
}

/* One half as drawn, the other as its image in dashes. */
static void fold(cairo_t *cr)
{
	static const double dash[2] = {0.2, 0.3};
	static const struct point half[] = {
		{-0.16, -0.6}, {-0.8, -0.3}, {-0.6, 0.66}, {-0.16, 0.66}};
	polygon(cr, half, COUNT_OF(half));
	cairo_close_path(cr);
	cairo_fill(cr);
	cairo_move_to(cr, 0.1, -0.95);
	cairo_line_to(cr, 0.1, 0.95);
	stroke_dashed(cr, dash, 2);
	cairo_move_to(cr, 0.36, -0.6);
	cairo_line_to(cr, 0.96, -0.3);
	cairo_line_to(cr, 0.8, 0.66);
	cairo_line_to(cr, 0.36, 0.66);
	cairo_stroke(cr);
}

/* Two edges with the same ticks. */
static void even(cairo_t *cr)
{
	for (int i = -1; i <= 1; i += 2) {
		cairo_move_to(cr, 0.5 * i, -0.86);
		cairo_line_to(cr, 0.5 * i, 0.86);
		for (int k = -1; k <= 1; k += 2) {
			cairo_move_to(cr, 0.5 * i - 0.26, 0.14 * k);
			cairo_line_to(cr, 0.5 * i + 0.26, 0.14 * k);
		}
	}
	cairo_stroke(cr);
}

static void plus(cairo_t *cr, bool upright)
{
	cairo_move_to(cr, -0.6, 0.0);
	cairo_line_to(cr, 0.6, 0.0);
	if (upright) {
		cairo_move_to(cr, 0.0, -0.6);
		cairo_line_to(cr, 0.0, 0.6);
	}
	cairo_stroke(cr);
}

void draw_icon(cairo_t *cr, enum icon icon, double x, double y, double size)
{
	cairo_save(cr);
	cairo_translate(cr, x, y);
	cairo_scale(cr, 0.5 * size, 0.5 * size);
	cairo_set_line_width(cr, 0.2);
	cairo_set_line_cap(cr, CAIRO_LINE_CAP_ROUND);
	cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
	cairo_new_path(cr);
	switch (icon) {
	case ICON_SHIRT:
		shirt(cr);
		break;
	case ICON_PIN:
		pin(cr);
		break;
	case ICON_WAVES:
		waves(cr);
		break;
	case ICON_LASER:
		laser(cr);
		break;
	case ICON_ERASER:
		eraser(cr);
		break;
	case ICON_COPY:
		copy(cr);
		break;
	case ICON_TURN_OVER:
		turn_over(cr);
		break;
	case ICON_MIRROR:
		mirror(cr);
		break;
	case ICON_BIN:
		bin(cr);
		break;
	case ICON_SWAP:
		swap(cr);
		break;
	case ICON_HAND:
		hand(cr);
		break;
	case ICON_AGAIN:
		again(cr);
		break;
	case ICON_REDO:
		cairo_scale(cr, -1.0, 1.0);
		undo(cr);
		break;
	case ICON_UNDO:
		undo(cr);
		break;
	case ICON_PENCIL:
		pencil(cr);
		break;
	case ICON_POINTS:
		points(cr);
		break;
	case ICON_BOX:
		cairo_rectangle(cr, -0.8, -0.6, 1.6, 1.2);
		cairo_stroke(cr);
		break;
	case ICON_ROUND:
		disc(cr, 0.0, 0.0, 0.76);
		cairo_stroke(cr);
		break;
	case ICON_FOLD:
		fold(cr);
		break;
	case ICON_EVEN:
		even(cr);
		break;
	case ICON_MINUS:
	case ICON_PLUS:
		plus(cr, icon == ICON_PLUS);
		break;
	}
	cairo_restore(cr);
}
