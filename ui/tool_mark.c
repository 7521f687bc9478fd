/* Step 3: numbered lines on cloth, on the body and on the worn garment; LASER marks both sides at
 * once (S6, S7, S9). */
#include "tool.h"

static const float point_spacing_mm = 1.2f; /* of the screen */
static const float mark_min_mm = 4.0f;      /* of the screen: shorter is no line */

enum gesture tool_mark_begin(struct tool *tool, bool on_sheet)
{
	struct ui *ui = tool->ui;
	struct worn_hit worn;
	struct body_hit body;
	if (on_sheet)
		return GESTURE_MARK_CLOTH;
	if (pick_worn(ui, tool->session, ui->start_px, &worn))
		return GESTURE_MARK_WORN;
	if (pick_body(ui, tool->session, ui->start_px, &body))
		return GESTURE_MARK_BODY;
	return GESTURE_TRACKBALL;
}

/* The lowest number that is free on a side, this frame's edits included. */
static int free_number(const struct tool *tool, int side)
{
	const struct marks *marks = &tool->session->document.marks;
	int number = 1;
	for (; number <= MARKS_MAX + FRAME_EDITS_MAX; number++) {
		bool taken = false;
		for (int m = 0; m < MARKS_MAX; m++)
			taken |= side == 0
					 ? marks->cloth[m].used && marks->cloth[m].number == number
					 : marks->body[m].used && marks->body[m].number == number;
		enum edit_kind kind = side == 0 ? EDIT_MARK_CLOTH : EDIT_MARK_BODY;
		for (int e = 0; e < tool->edits->count; e++)
			taken |= tool->edits->item[e].kind == kind &&
				 tool->edits->item[e].i[0] == number;
		if (!taken)
			break;
	}
	return number;
}

/* The contact's line at even distances. */
static int even_line(struct ui *ui, struct v2 line[MARK_POINTS_MAX])
{
	int count = stroke_smooth(ui);
	return stroke_even(ui->smooth_px, count, tool_px(ui, point_spacing_mm), line,
			   MARK_POINTS_MAX);
}

static bool long_enough(const struct ui *ui, const struct v2 *line, int count)
{
	return count >= 2 && stroke_length(line, count) >= tool_px(ui, mark_min_mm);
}

/* ---- on the sheet ---- */

/* The stretch of the line that lies on a piece; `top` counts only where it is the uppermost. */
static int run_on_piece(const struct tool *tool, int p, bool top, const struct v2 *line, int count,
			int *first)
{
	const struct pattern *pattern = &tool->session->document.pattern;
	bool good[MARK_POINTS_MAX];
	for (int i = 0; i < count; i++) {
		struct v2 sheet_mm = view_sheet_mm(&tool->ui->view, line[i]);
		good[i] = top ? pattern_pick(pattern, sheet_mm, 0) == p
			      : piece_contains(&pattern->piece[p],
					       piece_from_sheet(&pattern->piece[p], sheet_mm));
	}
	return stroke_run(good, count, first);
}

static void push_cloth_mark(struct tool *tool, int p, const struct v2 *line, int count)
{
	const struct piece *piece = &tool->session->document.pattern.piece[p];
	int number = free_number(tool, 0);
	struct edit *edit = edit_push(tool->edits, EDIT_MARK_CLOTH);
	if (!edit)
		return;
	edit->i[0] = number;
	edit->i[1] = p;
	edit->point_count = count;
	for (int i = 0; i < count; i++) {
		struct v2 at = piece_from_sheet(piece, view_sheet_mm(&tool->ui->view, line[i]));
		edit->point[i] = (struct v3){at.x, at.y, 0.0f};
	}
}

/* The next lower piece that has not been `done`, by layer. */
static int next_layer(const struct pattern *pattern, uint32_t done)
{
	int best = -1;
	for (int p = 0; p < PIECES_MAX; p++)
		if (pattern->piece[p].used && !(done >> p & 1) &&
		    (best < 0 || pattern->piece[p].layer > pattern->piece[best].layer))
			best = p;
	return best;
}

/* Without LASER the piece that has most of the line, with it every layer, top first. */
static int mark_sheet(struct tool *tool)
{
	struct ui *ui = tool->ui;
	struct v2 line[MARK_POINTS_MAX];
	int count = even_line(ui, line), best = -1, best_run = 0, best_first = 0, made = 0, first;
	uint32_t done = 0;
	for (int p = next_layer(&tool->session->document.pattern, done); p >= 0;
	     p = next_layer(&tool->session->document.pattern, done)) {
		int run = run_on_piece(tool, p, !ui->laser, line, count, &first);
		done |= (uint32_t)1 << p;
		if (!long_enough(ui, line + first, run))
			continue;
		if (ui->laser) {
			push_cloth_mark(tool, p, line + first, run);
			made++;
		} else if (run > best_run) {
			best = p;
			best_run = run;
			best_first = first;
		}
	}
	if (best >= 0)
		push_cloth_mark(tool, best, line + best_first, best_run);
	return made + (best >= 0);
}

/* ---- on the body ---- */

enum side { SIDE_FRONT, SIDE_BACK };

/* Which points of the line lie on the surface, unbroken: a leap in depth from one point to the next
 * (from an arm to the trunk behind it) parts the line. */
static int run_on_body(const struct tool *tool, enum side side, const struct v2 *line, int count,
		       struct v3 point_m[MARK_POINTS_MAX], int *first)
{
	const struct view *view = &tool->ui->view;
	bool good[MARK_POINTS_MAX];
	float leap_m = 0.03f + 6.0f * tool_px(tool->ui, point_spacing_mm) * view->distance_m /
				       (view->focal * (float)view->pane.h);
	for (int i = 0; i < count; i++) {
		struct body_hit hit;
		struct worn_hit worn;
		good[i] = pick_body_side(tool->ui, tool->session, line[i], side == SIDE_BACK, &hit);
		if (side == SIDE_FRONT && pick_worn(tool->ui, tool->session, line[i], &worn))
			good[i] = false;
		if (good[i])
			point_m[i] = hit.point_m;
		/* The far side of a leap begins a run of its own, one point later. */
		if (i > 0 && good[i] && good[i - 1] &&
		    v3_distance(point_m[i], point_m[i - 1]) > leap_m)
			good[i] = false;
	}
	return stroke_run(good, count, first);
}

static bool mark_body_side(struct tool *tool, enum side side, const struct v2 *line, int count)
{
	struct v3 point_m[MARK_POINTS_MAX];
	int first, run = run_on_body(tool, side, line, count, point_m, &first);
	if (!long_enough(tool->ui, line + first, run))
		return false;
	int number = free_number(tool, 1);
	struct edit *edit = edit_push(tool->edits, EDIT_MARK_BODY);
	if (!edit)
		return false;
	edit->i[0] = number;
	edit->point_count = run;
	for (int i = 0; i < run; i++) {
		const struct v3 *at = point_m + first;
		edit->point[i] = at[i];
		if (i > 0 && i < run - 1) /* picking adds the mesh's facets: 1 2 1 */
			edit->point[i] = v3_lerp(at[i], v3_lerp(at[i - 1], at[i + 1], 0.5f), 0.5f);
	}
	return true;
}

static int mark_body(struct tool *tool)
{
	struct v2 line[MARK_POINTS_MAX];
	int count = even_line(tool->ui, line);
	int made = mark_body_side(tool, SIDE_FRONT, line, count);
	if (tool->ui->laser && tool->session->body.triangle_count > 0)
		made += mark_body_side(tool, SIDE_BACK, line, count);
	return made;
}

/* ---- on the worn garment: the line belongs to the cloth (S9) ---- */

static int mark_worn(struct tool *tool)
{
	struct v2 line[MARK_POINTS_MAX], local_mm[MARK_POINTS_MAX];
	int piece[MARK_POINTS_MAX];
	int count = even_line(tool->ui, line), best = 0, best_first = 0, best_piece = -1;
	for (int i = 0; i < count; i++) {
		struct worn_hit hit;
		bool on = pick_worn(tool->ui, tool->session, line[i], &hit);
		piece[i] = on ? hit.piece : -1;
		local_mm[i] = on ? hit.local_mm : (struct v2){0.0f, 0.0f};
	}
	for (int i = 0, start = 0; i <= count; i++) {
		if (i < count && piece[i] == piece[start])
			continue;
		if (piece[start] >= 0 && i - start > best) {
			best = i - start;
			best_first = start;
			best_piece = piece[start];
		}
		start = i;
	}
	struct edit *edit = NULL;
	int number = free_number(tool, 0);
	if (long_enough(tool->ui, line + best_first, best))
		edit = edit_push(tool->edits, EDIT_MARK_CLOTH);
	if (!edit)
		return 0;
	edit->i[0] = number;
	edit->i[1] = best_piece;
	edit->point_count = best;
	for (int i = 0; i < best; i++)
		edit->point[i] = (struct v3){local_mm[best_first + i].x, local_mm[best_first + i].y,
					     0.0f};
	return 1;
}

void tool_mark_end(struct tool *tool)
{
	switch (tool->ui->gesture) {
	case GESTURE_MARK_CLOTH:
		if (mark_sheet(tool) == 0)
			tool_notice(tool, TEXT_OFF_CLOTH);
		break;
	case GESTURE_MARK_BODY:
		if (mark_body(tool) == 0)
			tool_notice(tool, TEXT_OFF_BODY);
		break;
	case GESTURE_MARK_WORN:
		if (mark_worn(tool) == 0)
			tool_notice(tool, TEXT_OFF_CLOTH);
		break;
	default:
		break;
	}
}

/* A tap draws nothing; on the sheet it chooses the piece, as in step 1. */
void tool_mark_tap(struct tool *tool, bool on_sheet)
{
	if (on_sheet)
		tool_draw_tap(tool);
}
