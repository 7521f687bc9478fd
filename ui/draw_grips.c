/* What can be taken hold of: the box round the selected piece with its grips, or its points; and
 * beside a shape in the making what it measures. */
#include "draw_piece.h"
#include "pattern_shape.h"

#include <stdio.h>

static const struct v2 no_shift = {0.0f, 0.0f};

static void bead(const struct easel *easel, struct v2 at, double radius, uint32_t fill)
{
	cairo_t *cr = easel->cr;
	double u = easel->unit;
	disc(cr, (double)at.x, (double)at.y, radius * u);
	ink(cr, fill, 1.0);
	cairo_fill_preserve(cr);
	cairo_set_line_width(cr, 2.4 * u);
	ink(cr, LOOK_INK, 1.0);
	cairo_stroke(cr);
}

static uint32_t bead_colour(const struct ui *ui, enum grip grip, int which)
{
	bool held = ui->shaping.shows && ui->shaping.grip == grip && ui->shaping.which == which;
	bool hovered = ui->hover_grip == grip && ui->hover_which == which;
	return held || hovered ? LOOK_HINT_RIM : 0xffffff;
}

static void draw_box(const struct easel *easel, const struct piece *piece)
{
	cairo_t *cr = easel->cr;
	double u = easel->unit, dash[2] = {7.0 * u, 6.0 * u};
	const struct ui *ui = easel->ui;
	cairo_new_path(cr);
	for (int k = 0; k < 4; k++)
		line_to(cr, grip_px(ui, piece, GRIP_SIZE, k));
	cairo_close_path(cr);
	struct v2 top = grip_px(ui, piece, GRIP_WIDTH, 2), turn = grip_px(ui, piece, GRIP_TURN, 0);
	move_to(cr, top);
	line_to(cr, turn);
	cairo_set_line_width(cr, 1.8 * u);
	ink(cr, LOOK_INK_GREY, 0.8);
	stroke_dashed(cr, dash, 2);
	for (int k = 0; k < 4; k++) {
		bead(easel, grip_px(ui, piece, GRIP_SIZE, k), 10.0, bead_colour(ui, GRIP_SIZE, k));
		if (grip_fits(ui, piece, k))
			bead(easel, grip_px(ui, piece, GRIP_WIDTH, k), 7.0,
			     bead_colour(ui, GRIP_WIDTH, k));
	}
	bead(easel, turn, 15.0, bead_colour(ui, GRIP_TURN, 0));
	ink(cr, LOOK_INK, 1.0);
	draw_icon(cr, ICON_AGAIN, (double)turn.x, (double)turn.y, 17.0 * u);
}

/* Corners as large beads, the middles of edges as small ones. */
static void draw_points(const struct easel *easel, const struct piece *piece)
{
	const struct ui *ui = easel->ui;
	for (int e = 0; e < piece_edge_count(piece); e++) {
		struct v2 middle = local_px(easel, piece, piece_edge_point(piece, e, 0.5f),
					    no_shift);
		bead(easel, middle, 5.5, bead_colour(ui, GRIP_EDGE, e));
	}
	for (int k = 0; k < piece_edge_count(piece); k++) {
		struct v2 at = local_px(easel, piece, piece_corner_mm(piece, k), no_shift);
		bool chosen = ui->corner == k;
		bead(easel, at, chosen ? 11.0 : 9.0,
		     chosen ? LOOK_INK : bead_colour(ui, GRIP_CORNER, k));
	}
}

void draw_grips(const struct easel *easel)
{
	const struct ui *ui = easel->ui;
	bool wanted = ui->step == STEP_DRAW && piece_used(easel->session, ui->piece);
	if (!wanted || ui->gesture == GESTURE_MOVE || ui->gesture == GESTURE_PIECE)
		return;
	if (ui->drawing == DRAW_PENCIL)
		draw_box(easel, piece_of(easel, ui->piece));
	else if (ui->drawing == DRAW_POINTS)
		draw_points(easel, piece_of(easel, ui->piece));
}

/* A line of dashes and dots, as a fold has it in drawings. */
void draw_axis(const struct easel *easel, int p)
{
	cairo_t *cr = easel->cr;
	double u = easel->unit, dash[4] = {16.0 * u, 6.0 * u, 2.0 * u, 6.0 * u};
	const struct piece *piece = piece_of(easel, p);
	struct v2 way = {angle_cos(piece->axis_rad), angle_sin(piece->axis_rad)};
	float low = 1e9f, high = -1e9f, over = tool_sheet_mm(easel->ui, 3.0f);
	for (int i = 0; i < piece->point_count; i++) {
		float along = v2_dot(way, v2_sub(piece->point_mm[i], piece->axis_mm));
		low = float_min(low, along);
		high = float_max(high, along);
	}
	struct v2 from = v2_add(piece->axis_mm, v2_scale(way, low - over));
	struct v2 to = v2_add(piece->axis_mm, v2_scale(way, high + over));
	move_to(cr, local_px(easel, piece, from, no_shift));
	line_to(cr, local_px(easel, piece, to, no_shift));
	cairo_set_line_cap(cr, CAIRO_LINE_CAP_ROUND);
	cairo_set_line_width(cr, 5.0 * u);
	ink(cr, 0xffffff, 0.6);
	cairo_stroke_preserve(cr);
	cairo_set_line_width(cr, 2.2 * u);
	ink(cr, LOOK_INK, 0.9);
	stroke_dashed(cr, dash, 4);
}

/* ---- beside a shape in the making ---- */

struct rect guides_area(const struct easel *easel)
{
	const struct shaping *shaping = &easel->ui->shaping;
	const struct view *view = &easel->ui->view;
	struct rect area = {0, 0, 0, 0};
	for (int i = 0; i < shaping->guide_count; i++)
		area = rect_join(area, rect_around(view_sheet_px(view, shaping->guide_mm[i][0]),
						   view_sheet_px(view, shaping->guide_mm[i][1]),
						   20.0 * easel->unit));
	return area;
}

void draw_guides(const struct easel *easel)
{
	cairo_t *cr = easel->cr;
	double u = easel->unit, dash[2] = {9.0 * u, 6.0 * u};
	const struct shaping *shaping = &easel->ui->shaping;
	const struct view *view = &easel->ui->view;
	for (int i = 0; i < shaping->guide_count; i++) {
		struct v2 from = view_sheet_px(view, shaping->guide_mm[i][0]);
		struct v2 to = view_sheet_px(view, shaping->guide_mm[i][1]);
		move_to(cr, from);
		line_to(cr, to);
		cairo_set_line_width(cr, 2.4 * u);
		ink(cr, 0x0072b2, 1.0);
		stroke_dashed(cr, dash, 2);
		disc(cr, (double)to.x, (double)to.y, 15.0 * u);
		cairo_set_line_width(cr, 3.0 * u);
		ink(cr, 0x0072b2, 1.0);
		cairo_stroke(cr);
	}
}

void draw_label(const struct easel *easel, struct v2 at, const char *text, uint32_t colour)
{
	cairo_t *cr = easel->cr;
	struct rect pane = easel->ui->layout.right;
	double u = easel->unit, width = (double)strlen(text) * 11.5 * u + 20.0 * u;
	float aside = (float)(0.5 * width + 6.0 * u), below = (float)(23.0 * u);
	at.x = float_clamp(at.x, (float)pane.x + aside, (float)(pane.x + pane.w) - aside);
	at.y = float_clamp(at.y, (float)pane.y + below, (float)(pane.y + pane.h) - below);
	round_box(cr, (double)at.x - 0.5 * width, (double)at.y - 17.0 * u, width, 34.0 * u,
		  9.0 * u);
	ink(cr, colour, 0.92);
	cairo_fill(cr);
	struct style style = {21.0 * u, false, 0xf6f2ea, ALIGN_CENTRE, width - 10.0 * u};
	draw_text(cr, easel->type, text, (double)at.x, (double)at.y + 7.5 * u, &style);
}

static int whole(float value)
{
	return (int)(value + (value < 0.0f ? -0.5f : 0.5f));
}

/* The two edges at a corner, or the one that bends, say how long they are. */
static void label_edges(const struct easel *easel)
{
	const struct shaping *shaping = &easel->ui->shaping;
	const struct piece *piece = piece_of(easel, easel->ui->piece);
	int edges = piece_edge_count(piece);
	for (int i = 0; i < (shaping->grip == GRIP_CORNER ? 2 : 1); i++) {
		int edge = (shaping->which + edges - i) % edges;
		char text[24];
		snprintf(text, sizeof text, "%d mm", whole(piece_edge_length_mm(piece, edge)));
		draw_label(easel,
			   local_px(easel, piece, piece_edge_point(piece, edge, 0.5f), no_shift),
			   text, LOOK_NIGHT);
	}
}

void draw_shaping(const struct easel *easel)
{
	const struct ui *ui = easel->ui;
	const struct shaping *shaping = &ui->shaping;
	char text[40];
	draw_guides(easel);
	if (shaping->grip == GRIP_CORNER || shaping->grip == GRIP_EDGE) {
		label_edges(easel);
		return;
	}
	int p = shaping->grip == GRIP_READY ? 0 : ui->piece;
	while (shaping->grip == GRIP_READY && p < PIECES_MAX - 1 && !(shaping->changed >> p & 1))
		p++;
	struct v2 low, high;
	piece_bounds(piece_of(easel, p), &low, &high);
	struct v2 at = view_sheet_px(&ui->view, v2_lerp(low, high, 0.5f));
	if (shaping->grip == GRIP_TURN)
		snprintf(text, sizeof text, "%d°", whole(shaping->turned_rad * 180.0f / PI_F));
	else
		snprintf(text, sizeof text, "%d x %d mm", whole(shaping->size_mm.x),
			 whole(shaping->size_mm.y));
	draw_label(easel, at, text, LOOK_NIGHT);
}
