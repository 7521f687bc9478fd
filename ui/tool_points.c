/* Points: a corner of the selected piece is pulled where it should be, an edge by its middle into a
 * curve; a tap on an edge makes a corner, a tap on a corner chooses it. The paper moves, too. */
#include "pattern_shape.h"
#include "tool.h"

static const float edge_reach_mm = 4.5f; /* of the screen */
static const float flat_snap_mm = 1.5f;  /* a bow so small is none */

static const struct piece *selected(const struct tool *tool)
{
	return &tool->session->document.pattern.piece[tool->ui->piece];
}

/* The edge of the selected piece under the pen's start, or of any piece, which is selected then. */
static bool take_edge(struct tool *tool, int *edge, float *fraction)
{
	struct ui *ui = tool->ui;
	struct edge_ref found;
	if (piece_used(tool->session, ui->piece)) {
		struct v2 local = piece_from_sheet(selected(tool),
						   view_sheet_mm(&ui->view, ui->start_px));
		if (piece_nearest_edge(selected(tool), local, edge, fraction) <=
		    tool_sheet_mm(ui, edge_reach_mm))
			return true;
	}
	if (!pick_edge(ui, tool->session, ui->start_px, edge_reach_mm, &found, fraction))
		return false;
	ui->piece = found.piece;
	ui->corner = -1;
	*edge = found.edge;
	return true;
}

enum grip points_hover(const struct tool *tool, int *which)
{
	const struct ui *ui = tool->ui;
	float fraction;
	if (!piece_used(tool->session, ui->piece))
		return GRIP_NONE;
	struct v2 local = piece_from_sheet(selected(tool), view_sheet_mm(&ui->view, ui->pen_px));
	*which = pick_corner(ui, selected(tool), ui->pen_px);
	if (*which >= 0)
		return GRIP_CORNER;
	return piece_nearest_edge(selected(tool), local, which, &fraction) <=
			       tool_sheet_mm(ui, edge_reach_mm)
		       ? GRIP_EDGE
		       : GRIP_NONE;
}

enum gesture tool_points_begin(struct tool *tool)
{
	struct ui *ui = tool->ui;
	int edge, corner = -1;
	float fraction;
	if (piece_used(tool->session, ui->piece))
		corner = pick_corner(ui, selected(tool), ui->start_px);
	if (corner < 0 && take_edge(tool, &edge, &fraction)) {
		corner = pick_corner(ui, selected(tool), ui->start_px);
		if (corner < 0)
			return shape_begin(tool, GRIP_EDGE, edge);
	}
	if (corner >= 0) {
		ui->corner = corner;
		return shape_begin(tool, GRIP_CORNER, corner);
	}
	int piece = pattern_pick(&tool->session->document.pattern,
				 view_sheet_mm(&ui->view, ui->start_px), 0);
	if (piece < 0)
		return GESTURE_PAN;
	if (piece != ui->piece)
		ui->corner = -1;
	ui->piece = piece;
	ui->move_mm = (struct v2){0.0f, 0.0f};
	return GESTURE_MOVE;
}

/* Relative to where it was taken hold of, so that nothing leaps to the pen. */
static void move_corner(struct tool *tool, int corner)
{
	struct ui *ui = tool->ui;
	const struct piece *piece = selected(tool);
	struct v2 by = v2_sub(view_sheet_mm(&ui->view, ui->steady_px),
			      view_sheet_mm(&ui->view, ui->start_px));
	struct v2 to = v2_add(piece_to_sheet(piece, piece_corner_mm(piece, corner)), by);
	to = piece_from_sheet(piece, snap_corner(tool, piece, corner, to));
	struct edit edit = {.kind = EDIT_POINT, .i = {ui->piece, corner}};
	edit.f[0] = to.x;
	edit.f[1] = to.y;
	shape_try(tool, &edit);
}

static void bend_edge(struct tool *tool, int edge)
{
	struct ui *ui = tool->ui;
	const struct piece *piece = selected(tool);
	struct v2 by = v2_sub(piece_from_sheet(piece, view_sheet_mm(&ui->view, ui->steady_px)),
			      piece_from_sheet(piece, view_sheet_mm(&ui->view, ui->start_px)));
	struct v2 to = v2_add(piece_edge_point(piece, edge, 0.5f), by);
	struct v2 a = piece_corner_mm(piece, edge);
	struct v2 b = piece_corner_mm(piece, (edge + 1) % piece_edge_count(piece));
	struct v2 chord = v2_normalize(v2_sub(b, a));
	float bow = v2_cross(chord, v2_sub(to, a));
	ui->shaping.guide_count = 0;
	if (float_abs(bow) < tool_sheet_mm(ui, flat_snap_mm)) {
		to = v2_add(a, v2_scale(chord, v2_dot(chord, v2_sub(to, a))));
		ui->shaping.guide_count = 1;
		ui->shaping.guide_mm[0][0] = piece_to_sheet(piece, a);
		ui->shaping.guide_mm[0][1] = piece_to_sheet(piece, b);
	}
	struct edit edit = {.kind = EDIT_BEND, .i = {ui->piece, edge}};
	edit.f[0] = to.x;
	edit.f[1] = to.y;
	shape_try(tool, &edit);
}

void tool_points_move(struct tool *tool)
{
	const struct shaping *shaping = &tool->ui->shaping;
	if (shaping->which >= piece_edge_count(selected(tool)))
		return;
	if (shaping->grip == GRIP_CORNER)
		move_corner(tool, shaping->which);
	else
		bend_edge(tool, shaping->which);
}

bool tool_points_take(struct tool *tool)
{
	struct ui *ui = tool->ui;
	int corner = -1;
	if (piece_used(tool->session, ui->piece))
		corner = pick_corner(ui, selected(tool), ui->start_px);
	if (corner < 0)
		return false;
	ui->corner = corner;
	return true;
}

void tool_points_tap(struct tool *tool)
{
	struct ui *ui = tool->ui;
	int edge;
	float fraction;
	if (tool_points_take(tool))
		return;
	if (!take_edge(tool, &edge, &fraction)) {
		tool_select_at(tool);
		return;
	}
	struct edit *edit = edit_push(tool->edits, EDIT_SPLIT);
	if (!edit)
		return;
	edit->i[0] = ui->piece;
	edit->i[1] = edge;
	edit->f[0] = fraction;
	ui->corner = edge + 1; /* where it will be counted */
}

void tool_points_delete(struct tool *tool)
{
	struct edit *edit = edit_push(tool->edits, EDIT_JOIN);
	if (!edit)
		return;
	edit->i[0] = tool->ui->piece;
	edit->i[1] = tool->ui->corner;
	tool->ui->corner = -1;
}
