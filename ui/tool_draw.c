/* Step 1: outlines. A stroke on empty paper is a new piece, one from edge to edge of the selected
 * piece redraws that stretch, one from within a piece moves it; a tap selects. */
#include "tool.h"

static const float outline_reach_mm = 4.0f; /* of the screen */
static const float end_reach_mm = 8.0f;     /* a line that began there may end so near */
static const float closed_mm = 12.0f;       /* both ends nearer than this: a loop of its own */
static const float copy_gap_mm = 40.0f;     /* of the sheet */

static float outline_distance(const struct ui *ui, const struct piece *piece, struct v2 position_px)
{
	int edge;
	float fraction;
	struct v2 local = piece_from_sheet(piece, view_sheet_mm(&ui->view, position_px));
	return piece_nearest_edge(piece, local, &edge, &fraction);
}

static bool near_outline(const struct ui *ui, const struct session *session, struct v2 position_px,
			 float reach_mm)
{
	return piece_used(session, ui->piece) &&
	       outline_distance(ui, &session->document.pattern.piece[ui->piece], position_px) <=
		       tool_sheet_mm(ui, reach_mm);
}

enum gesture tool_draw_begin(struct tool *tool)
{
	struct ui *ui = tool->ui;
	const struct pattern *pattern = &tool->session->document.pattern;
	int which = 0;
	if (ui->drawing == DRAW_POINTS)
		return tool_points_begin(tool);
	if (ui->drawing != DRAW_PENCIL)
		return shape_begin(tool, GRIP_READY, 0);
	enum grip grip = pick_grip(ui, tool->session, ui->start_px, &which);
	if (grip != GRIP_NONE)
		return shape_begin(tool, grip, which);
	if (near_outline(ui, tool->session, ui->start_px, outline_reach_mm))
		return GESTURE_OVERSKETCH;
	int piece = pattern_pick(pattern, view_sheet_mm(&ui->view, ui->start_px), 0);
	if (piece < 0)
		return GESTURE_PIECE;
	ui->piece = piece;
	ui->move_mm = (struct v2){0.0f, 0.0f};
	return GESTURE_MOVE;
}

/* The stroke on the sheet, in the room that struct ui keeps for it. Not smoothed: the pattern knows
 * best where a corner is. */
static const struct v2 *stroke_on_sheet(struct ui *ui)
{
	for (int i = 0; i < ui->stroke_count; i++)
		ui->smooth_px[i] = view_sheet_mm(&ui->view, ui->stroke_px[i]);
	return ui->smooth_px;
}

static void put_outline(struct edit *edit, const struct piece *piece)
{
	edit->point_count = piece->point_count;
	for (int i = 0; i < piece->point_count; i++) {
		edit->point[i] = (struct v3){piece->point_mm[i].x, piece->point_mm[i].y, 0.0f};
		edit->corner[i] = piece->corner[i];
	}
}

void tool_name_piece(struct tool *tool, struct edit *edit)
{
	int number = 1;
	while (number < PIECES_MAX && tool->session->document.pattern.piece[number - 1].used)
		number++;
	memcpy(edit->name, "piece-", 6);
	edit->name[6] = (char)('0' + number / 10);
	edit->name[7] = (char)('0' + number % 10);
	edit->name[8] = 0;
}

static void new_piece(struct tool *tool)
{
	struct ui *ui = tool->ui;
	struct piece piece;
	memset(&piece, 0, sizeof piece);
	const char *fault = piece_from_stroke(&piece, stroke_on_sheet(ui), ui->stroke_count);
	if (fault) {
		stroke_refused(tool, fault);
		return;
	}
	struct edit *edit = edit_push(tool->edits, EDIT_PIECE);
	if (!edit)
		return;
	tool_name_piece(tool, edit);
	edit->i[0] = ui->swatch;
	edit->f[0] = piece.position_mm.x;
	edit->f[1] = piece.position_mm.y;
	put_outline(edit, &piece);
	ui->select_new = true;
}

static void oversketch(struct tool *tool)
{
	struct ui *ui = tool->ui;
	struct piece piece;
	piece = tool->session->document.pattern.piece[ui->piece];
	const char *fault = piece_oversketch(&piece, stroke_on_sheet(ui), ui->stroke_count);
	if (fault) {
		stroke_refused(tool, fault);
		return;
	}
	struct edit *edit = edit_push(tool->edits, EDIT_OUTLINE);
	if (!edit)
		return;
	edit->i[0] = ui->piece;
	put_outline(edit, &piece);
}

/* A stroke that begins on the selected outline may still be a piece of its own: a loop whose ends
 * meet, or a line that ends elsewhere. */
static bool is_loop(const struct ui *ui)
{
	float length = stroke_length(ui->stroke_px, ui->stroke_count);
	float gap = v2_distance(ui->start_px, ui->steady_px);
	return gap < tool_px(ui, closed_mm) && length > 6.0f * tool_px(ui, closed_mm);
}

static void push_place(struct tool *tool, const struct piece *piece, struct v2 position_mm,
		       bool inside_up)
{
	struct edit *edit = edit_push(tool->edits, EDIT_PLACE);
	if (!edit)
		return;
	edit->i[0] = (int)(piece - tool->session->document.pattern.piece);
	edit->i[1] = inside_up;
	edit->f[0] = position_mm.x;
	edit->f[1] = position_mm.y;
	edit->f[2] = piece->turn_rad;
}

/* A straight line right across the selected piece, which is symmetric, is its new axis. */
static bool redraw_axis(struct tool *tool)
{
	struct ui *ui = tool->ui;
	const struct piece *piece = &tool->session->document.pattern.piece[int_max(ui->piece, 0)];
	if (!piece_used(tool->session, ui->piece) || !piece->symmetric)
		return false;
	int count = stroke_smooth(ui), inside = 0;
	struct v2 ends[2] = {ui->start_px, ui->steady_px}, local[2];
	float length = v2_distance(ends[0], ends[1]), stray = 0.0f;
	for (int i = 0; i < count; i++) {
		struct v2 mm = view_sheet_mm(&ui->view, ui->smooth_px[i]);
		inside += piece_contains(piece, piece_from_sheet(piece, mm));
		stray = float_max(stray, stroke_distance(ends, 2, ui->smooth_px[i]));
	}
	for (int i = 0; i < 2; i++) {
		local[i] = piece_from_sheet(piece, view_sheet_mm(&ui->view, ends[i]));
		if (piece_contains(piece, local[i]))
			return false;
	}
	if (inside == 0 || stray > 0.04f * length + tool_px(ui, 1.5f))
		return false;
	struct edit *edit = edit_push(tool->edits, EDIT_FOLD);
	if (!edit)
		return true;
	struct v2 middle = v2_lerp(local[0], local[1], 0.5f);
	edit->i[0] = ui->piece;
	edit->i[1] = 1;
	edit->f[0] = middle.x;
	edit->f[1] = middle.y;
	edit->f[2] = shape_snapped_turn(
		angle_atan2(local[1].y - local[0].y, local[1].x - local[0].x));
	return true;
}

void tool_draw_end(struct tool *tool)
{
	struct ui *ui = tool->ui;
	if (ui->gesture == GESTURE_MOVE && piece_used(tool->session, ui->piece)) {
		const struct piece *piece = &tool->session->document.pattern.piece[ui->piece];
		push_place(tool, piece, v2_add(piece->position_mm, ui->move_mm), piece->inside_up);
	} else if (ui->gesture == GESTURE_OVERSKETCH && !is_loop(ui) &&
		   near_outline(ui, tool->session, ui->steady_px, end_reach_mm)) {
		oversketch(tool);
	} else if ((ui->gesture == GESTURE_PIECE || ui->gesture == GESTURE_OVERSKETCH) &&
		   !redraw_axis(tool)) {
		new_piece(tool);
	}
	ui->move_mm = (struct v2){0.0f, 0.0f};
}

void tool_draw_tap(struct tool *tool)
{
	if (tool->ui->drawing == DRAW_POINTS)
		tool_points_tap(tool);
	else
		tool_select_at(tool);
}

void tool_select_at(struct tool *tool)
{
	struct ui *ui = tool->ui;
	ui->corner = -1;
	struct v2 sheet_mm = view_sheet_mm(&ui->view, ui->start_px);
	ui->piece = pattern_pick(&tool->session->document.pattern, sheet_mm, 0);
}

/* ---- buttons ---- */

/* What a box at a shift would cost: first no overlap, then on the visible sheet, then near. */
static float crowding(const struct tool *tool, struct v2 low_mm, struct v2 high_mm)
{
	const struct pattern *pattern = &tool->session->document.pattern;
	struct rect pane = tool->ui->layout.right;
	struct v2 low_px = view_sheet_px(&tool->ui->view, low_mm);
	struct v2 high_px = view_sheet_px(&tool->ui->view, high_mm);
	float cost = 0.0f;
	for (int p = 0; p < PIECES_MAX; p++) {
		struct v2 low, high;
		if (!pattern->piece[p].used)
			continue;
		piece_bounds(&pattern->piece[p], &low, &high);
		bool apart = low.x > high_mm.x || high.x < low_mm.x || low.y > high_mm.y ||
			     high.y < low_mm.y;
		cost += apart ? 0.0f : 2e6f;
	}
	if (!rect_holds(pane, low_px) || !rect_holds(pane, high_px))
		cost += 1e6f;
	return cost;
}

/* Beside the piece (right, left, below, above, and farther), where it lies free. */
static struct v2 copy_shift(const struct tool *tool, const struct piece *piece)
{
	struct v2 low, high, best = {copy_gap_mm, -copy_gap_mm};
	float best_cost = 1e9f;
	piece_bounds(piece, &low, &high);
	struct v2 size = v2_add(v2_sub(high, low), (struct v2){copy_gap_mm, copy_gap_mm});
	for (int ring = 1; ring <= 4; ring++)
		for (int way = 0; way < 8; way++) {
			static const float dx[8] = {1, -1, 0, 0, 1, -1, 1, -1};
			static const float dy[8] = {0, 0, -1, 1, -1, -1, 1, 1};
			struct v2 shift = {dx[way] * size.x * (float)ring * 0.5f,
					   dy[way] * size.y * (float)ring * 0.5f};
			float cost = crowding(tool, v2_add(low, shift), v2_add(high, shift)) +
				     v2_length(shift);
			if (cost < best_cost) {
				best_cost = cost;
				best = shift;
			}
		}
	return best;
}

/* Turning over mirrors about the local origin, which may lie anywhere: keep the middle in place. */
static void turn_over(struct tool *tool, const struct piece *piece)
{
	struct piece turned;
	struct v2 low, high, turned_low, turned_high;
	turned = *piece;
	turned.inside_up = !piece->inside_up;
	piece_bounds(piece, &low, &high);
	piece_bounds(&turned, &turned_low, &turned_high);
	struct v2 shift = v2_scale(v2_sub(v2_add(low, high), v2_add(turned_low, turned_high)),
				   0.5f);
	push_place(tool, piece, v2_add(piece->position_mm, shift), turned.inside_up);
}

static void push_for_piece(struct tool *tool, enum edit_kind kind, int argument)
{
	struct edit *edit = edit_push(tool->edits, kind);
	if (!edit)
		return;
	edit->i[0] = tool->ui->piece;
	edit->i[1] = argument;
}

/* Symmetric about the middle of its breadth; or no longer. */
static void fold(struct tool *tool, const struct piece *piece)
{
	float low = piece->point_mm[0].x, high = low;
	for (int i = 1; i < piece->point_count; i++) {
		low = float_min(low, piece->point_mm[i].x);
		high = float_max(high, piece->point_mm[i].x);
	}
	struct edit *edit = edit_push(tool->edits, EDIT_FOLD);
	if (!edit)
		return;
	edit->i[0] = tool->ui->piece;
	edit->i[1] = !piece->symmetric;
	edit->f[0] = 0.5f * (low + high);
	edit->f[1] = 0.0f;
	edit->f[2] = 0.5f * PI_F;
}

void tool_draw_target(struct tool *tool, enum target target)
{
	struct ui *ui = tool->ui;
	bool swatch = target >= TARGET_SWATCH_0 && target <= TARGET_SWATCH_7;
	if (target >= TARGET_TOOL_PENCIL && target <= TARGET_TOOL_ROUND) {
		ui->drawing = (enum drawing)(target - TARGET_TOOL_PENCIL);
		ui->corner = -1;
		return;
	}
	if (swatch)
		ui->swatch = (int)target - TARGET_SWATCH_0;
	if (!piece_used(tool->session, ui->piece)) {
		if (!swatch)
			tool_notice(tool, TEXT_NO_PIECE);
		return;
	}
	const struct piece *piece = &tool->session->document.pattern.piece[ui->piece];
	if (swatch) {
		push_for_piece(tool, EDIT_SWATCH, ui->swatch);
	} else if (target == TARGET_TURN_OVER) {
		turn_over(tool, piece);
	} else if (target == TARGET_MIRROR) {
		push_for_piece(tool, EDIT_MIRROR, 0);
	} else if (target == TARGET_FOLD) {
		fold(tool, piece);
	} else if (target == TARGET_DELETE && ui->corner >= 0) {
		tool_points_delete(tool);
	} else if (target == TARGET_DELETE) {
		push_for_piece(tool, EDIT_DELETE, 0);
	} else if (target == TARGET_COPY) {
		struct v2 shift = copy_shift(tool, piece);
		struct edit *edit = edit_push(tool->edits, EDIT_COPY);
		if (!edit)
			return;
		edit->i[0] = ui->piece;
		edit->f[0] = shift.x;
		edit->f[1] = shift.y;
		ui->select_new = true;
	}
}
