/* ERASE and the pen's other end: a tap takes the nearest thing away, a stroke every line that it
 * crosses. What can be erased is what the step is about. */
#include "tool.h"

static void push_unmark(struct tool *tool, int side, int number)
{
	for (int e = 0; e < tool->edits->count; e++) {
		const struct edit *old = &tool->edits->item[e];
		if (old->kind == EDIT_UNMARK && old->i[0] == side && old->i[1] == number)
			return;
	}
	struct edit *edit = number > 0 ? edit_push(tool->edits, EDIT_UNMARK) : NULL;
	if (!edit)
		return;
	edit->i[0] = side;
	edit->i[1] = number;
}

static void push_simple(struct tool *tool, enum edit_kind kind, int index)
{
	struct edit *edit = index >= 0 ? edit_push(tool->edits, kind) : NULL;
	if (edit)
		edit->i[0] = index;
}

/* On the left a line on the worn cloth lies over one on the body; its number is the cloth's. */
static int pick_worn_mark(const struct tool *tool, struct v2 position_px)
{
	struct worn_hit hit;
	float reach_mm = 0.5f * tool_sheet_mm(tool->ui, 5.0f);
	if (!pick_worn(tool->ui, tool->session, position_px, &hit))
		return 0;
	for (int m = 0; m < MARKS_MAX; m++) {
		const struct cloth_mark *mark = &tool->session->document.marks.cloth[m];
		if (mark->used && mark->piece == hit.piece &&
		    stroke_distance(mark->point_mm, mark->point_count, hit.local_mm) < reach_mm)
			return mark->number;
	}
	return 0;
}

static void erase_mark(struct tool *tool, bool on_sheet, struct v2 at)
{
	int worn = on_sheet ? 0 : pick_worn_mark(tool, at);
	if (on_sheet)
		push_unmark(tool, 0, pick_cloth_mark(tool->ui, tool->session, at));
	else if (worn > 0)
		push_unmark(tool, 0, worn);
	else
		push_unmark(tool, 1, pick_body_mark(tool->ui, tool->session, at));
}

static void erase_marks(struct tool *tool, bool on_sheet, bool tap)
{
	struct v2 line[MARK_POINTS_MAX / 4];
	int count = 0;
	if (tap) {
		erase_mark(tool, on_sheet, tool->ui->start_px);
		return;
	}
	count = stroke_even(tool->ui->smooth_px, stroke_smooth(tool->ui), tool_px(tool->ui, 2.0f),
			    line, COUNT_OF(line));
	for (int i = 0; i < count; i++)
		erase_mark(tool, on_sheet, line[i]);
}

void tool_erase(struct tool *tool, bool on_sheet, bool tap)
{
	struct ui *ui = tool->ui;
	struct v2 at = ui->start_px, sheet_mm = view_sheet_mm(&ui->view, at);
	switch (ui->step) {
	case STEP_DRAW:
		if (on_sheet && tap && ui->drawing == DRAW_POINTS && tool_points_take(tool))
			tool_points_delete(tool);
		else if (on_sheet && tap)
			push_simple(tool, EDIT_DELETE,
				    pattern_pick(&tool->session->document.pattern, sheet_mm, 0));
		break;
	case STEP_SEW:
		if (on_sheet && tap)
			push_simple(tool, EDIT_UNSEW, pick_seam(ui, tool->session, at));
		break;
	case STEP_MARK:
		erase_marks(tool, on_sheet, tap);
		break;
	case STEP_DRESS:
	case STEP_ADJUST:
		if (tap)
			push_simple(tool, EDIT_UNPIN, pick_pin(ui, tool->session, at));
		break;
	case STEP_COUNT:
		break;
	}
}
