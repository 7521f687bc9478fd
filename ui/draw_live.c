/* What follows the pen on the sheet: its ring, the edge it would take, the piece it moves. */
#include "draw_piece.h"
#include "tool.h"

int next_cloth_number(const struct session *session)
{
	int number = 1;
	for (int m = 0; m < MARKS_MAX; m++)
		for (int k = 0; k < MARKS_MAX; k++)
			number += session->document.marks.cloth[k].used &&
				  session->document.marks.cloth[k].number == number;
	return number;
}

/* The start of an outline is where it wants to end. */
static void draw_start(const struct easel *easel)
{
	const struct ui *ui = easel->ui;
	cairo_t *cr = easel->cr;
	double u = easel->unit;
	float gap = v2_distance(ui->start_px, ui->steady_px);
	float length = ui->stroke_count > 40 ? gap : 1e9f;
	bool near = length < tool_px(ui, 12.0f);
	disc(cr, (double)ui->start_px.x, (double)ui->start_px.y, (near ? 15.0 : 10.0) * u);
	ink(cr, near ? LOOK_RELAX : 0xffffff, near ? 0.35 : 0.8);
	cairo_fill_preserve(cr);
	cairo_set_line_width(cr, 3.0 * u);
	ink(cr, near ? LOOK_RELAX : LOOK_INK_GREY, 1.0);
	cairo_stroke(cr);
}

static void draw_sewing(const struct easel *easel)
{
	const struct ui *ui = easel->ui;
	cairo_t *cr = easel->cr;
	double u = easel->unit, dash[2] = {9.0 * u, 8.0 * u};
	struct edge_ref from = {ui->sew_from.piece, ui->sew_from.edge};
	struct edge_ref to = {ui->sew_to.piece, ui->sew_to.edge};
	if (!piece_used(easel->session, from.piece))
		return;
	draw_edge_glow(easel, from, LOOK_HINT_RIM);
	if (piece_used(easel->session, to.piece)) {
		draw_edge_glow(easel, to, LOOK_HINT_RIM);
		draw_zip(easel, from, to, false, 1.0);
		draw_lengths(easel, from, to, false);
		return;
	}
	move_to(cr, ui->start_px);
	line_to(cr, ui->steady_px);
	cairo_set_line_cap(cr, CAIRO_LINE_CAP_ROUND);
	cairo_set_line_width(cr, 4.0 * u);
	ink(cr, LOOK_INK, 1.0);
	stroke_dashed(cr, dash, 2);
}

/* The pen's ring: as large as what it would reach, in the colour of what it would do. */
static void draw_ring(const struct easel *easel)
{
	const struct ui *ui = easel->ui;
	cairo_t *cr = easel->cr;
	double u = easel->unit, x = (double)ui->pen_px.x, y = (double)ui->pen_px.y;
	uint32_t colour = LOOK_INK;
	if (ui->step == STEP_MARK && !ui->erase && !ui->eraser) {
		int number = next_cloth_number(easel->session);
		colour = look_mark_style(number)->colour;
		draw_number(cr, easel->type, number, x + 26.0 * u, y - 24.0 * u, 12.0 * u, true);
	} else if (ui->pin_mode) {
		colour = LOOK_PIN;
	}
	double radius = ui->step == STEP_DRAW && ui->hover_piece < 0 ? 5.0 * u : 12.0 * u;
	disc(cr, x, y, radius);
	cairo_set_line_width(cr, 5.0 * u);
	ink(cr, 0xffffff, 0.9);
	cairo_stroke(cr);
	disc(cr, x, y, radius);
	cairo_set_line_width(cr, 2.4 * u);
	ink(cr, colour, 1.0);
	cairo_stroke(cr);
}

bool pen_hovers(const struct ui *ui)
{
	return ui->pen_state == PEN_HOVER && ui->hover_target == TARGET_NONE &&
	       rect_holds(ui->layout.right, ui->pen_px);
}

/* The changed pieces of the draft, and those that they are sewn to. */
static struct rect shaping_area(const struct easel *easel)
{
	const struct pattern *pattern = &easel->ui->shaping.draft.pattern;
	const struct v2 none = {0.0f, 0.0f};
	uint32_t changed = easel->ui->shaping.changed, drawn = changed;
	struct rect area = {0, 0, 0, 0};
	for (int s = 0; s < SEAMS_MAX; s++) {
		const struct seam *seam = &pattern->seam[s];
		uint32_t a = (uint32_t)1 << seam->a.piece, b = (uint32_t)1 << seam->b.piece;
		if (seam->used && ((a | b) & changed))
			drawn |= a | b;
	}
	for (int p = 0; p < PIECES_MAX; p++)
		if (drawn >> p & 1 && pattern->piece[p].used)
			area = rect_join(area, piece_area(easel, p, none));
	return rect_join(area, guides_area(easel));
}

static void draw_lifted(const struct easel *easel)
{
	const struct v2 none = {0.0f, 0.0f};
	for (int p = 0; p < PIECES_MAX; p++)
		if (easel->ui->shaping.changed >> p & 1 && piece_of(easel, p)->used) {
			draw_piece(easel, p, none, true);
			draw_name(easel, p, none);
		}
	draw_seams(easel, true);
	draw_grips(easel);
	draw_shaping(easel);
}

/* What draw_live will cover. */
struct rect live_extent(const struct easel *easel)
{
	const struct ui *ui = easel->ui;
	const struct v2 none = {0.0f, 0.0f};
	double u = easel->unit;
	struct rect area = {0, 0, 0, 0};
	if (pen_hovers(ui))
		area = rect_around(ui->pen_px, ui->pen_px, 48.0 * u);
	if (pen_hovers(ui) && ui->hover_edge >= 0 && piece_used(easel->session, ui->hover_piece))
		area = rect_join(area, piece_area(easel, ui->hover_piece, none));
	if (ui->gesture == GESTURE_PIECE)
		area = rect_join(area, rect_around(ui->start_px, ui->start_px, 20.0 * u));
	if (ui->gesture == GESTURE_MOVE && piece_used(easel->session, ui->piece))
		area = rect_join(rect_join(area, guides_area(easel)),
				 piece_area(easel, ui->piece, ui->move_mm));
	if (ui->refused.shows)
		area = rect_join(area, refused_area(easel));
	if (ui->shaping.shows)
		area = rect_join(area, shaping_area(easel));
	if (pen_hovers(ui) && ui->hover_grip == GRIP_EDGE)
		area = rect_join(area, piece_area(easel, ui->piece, none));
	if (ui->gesture == GESTURE_SEW && piece_used(easel->session, ui->sew_from.piece)) {
		area = rect_join(area, piece_area(easel, ui->sew_from.piece, none));
		area = rect_join(area, rect_around(ui->start_px, ui->steady_px, 8.0 * u));
		if (piece_used(easel->session, ui->sew_to.piece))
			area = rect_join(area, piece_area(easel, ui->sew_to.piece, none));
	}
	return rect_within(area, ui->layout.right);
}

void draw_live(const struct easel *easel)
{
	const struct ui *ui = easel->ui;
	if (ui->gesture == GESTURE_MOVE && piece_used(easel->session, ui->piece)) {
		draw_piece(easel, ui->piece, ui->move_mm, true);
		draw_name(easel, ui->piece, ui->move_mm);
		draw_guides(easel);
	}
	if (ui->refused.shows)
		draw_refused(easel);
	if (ui->shaping.shows)
		draw_lifted(easel);
	if (ui->gesture == GESTURE_SEW)
		draw_sewing(easel);
	if (ui->gesture == GESTURE_PIECE)
		draw_start(easel);
	if (!pen_hovers(ui))
		return;
	if (ui->hover_edge >= 0 && piece_used(easel->session, ui->hover_piece))
		draw_edge_glow(easel, (struct edge_ref){ui->hover_piece, ui->hover_edge},
			       LOOK_HINT_RIM);
	if (ui->hover_grip == GRIP_EDGE && piece_used(easel->session, ui->piece)) {
		draw_edge_glow(easel, (struct edge_ref){ui->piece, ui->hover_which}, LOOK_HINT_RIM);
		draw_grips(easel);
	}
	draw_ring(easel);
}
