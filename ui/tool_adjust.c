/* Steps 4 and 5: the worn garment is dragged along the body, and pinned (S11, S12). */
#include "tool.h"

static const float hang_m =
	0.03f; /* grabbed farther from the body than this: it hangs in the air */
static const float still_m = 0.0002f; /* a pen that moves less says nothing new */

enum gesture tool_adjust_begin(struct tool *tool)
{
	struct ui *ui = tool->ui;
	struct worn_hit worn;
	ui->grabbed = false;
	return pick_worn(ui, tool->session, ui->start_px, &worn) ? GESTURE_DRAG : GESTURE_TRACKBALL;
}

/* Where the pen's ray meets the plane through a point that faces the viewer. */
static struct v3 plane_point(const struct view *view, struct v3 through_m, struct v2 position_px)
{
	struct v3 origin, direction, axis = view->turn.row[2];
	view_ray(view, position_px, &origin, &direction);
	float depth_m = v3_dot(v3_sub(origin, through_m), axis);
	float slope = float_max(-v3_dot(direction, axis), 0.1f);
	return v3_mad(origin, direction, depth_m / slope);
}

static void grab(struct tool *tool)
{
	struct ui *ui = tool->ui;
	struct worn_hit worn;
	struct body_hit body;
	struct edit *edit = NULL;
	if (pick_worn(ui, tool->session, ui->start_px, &worn))
		edit = edit_push(tool->edits, EDIT_GRAB);
	if (!edit) {
		ui->gesture = GESTURE_IDLE;
		return;
	}
	edit->i[0] = worn.piece;
	edit->f[0] = worn.local_mm.x;
	edit->f[1] = worn.local_mm.y;
	body_nearest(&tool->session->body, worn.point_m, 0, &body);
	ui->grab_m = worn.point_m;
	ui->grab_on_body = float_abs(body.distance_m) < hang_m;
	ui->grabbed = true;
	ui->grab_frame = ui->frame;
	if (ui->step != STEP_ADJUST)
		ui_step(ui, STEP_ADJUST);
}

/* Cloth that lies on the body follows its surface under the pen, and keeps its depth beside it;
 * what hangs in the air stays in its plane, unless the body is in the way. */
static struct v3 drag_target(const struct tool *tool)
{
	const struct ui *ui = tool->ui;
	struct body_hit hit;
	struct v3 plane = plane_point(&ui->view, ui->grab_m, ui->steady_px);
	if (!pick_body(ui, tool->session, ui->steady_px, &hit))
		return plane;
	float plane_m = v3_distance(plane, view_eye(&ui->view));
	return ui->grab_on_body || hit.distance_m < plane_m ? hit.point_m : plane;
}

/* At most one EDIT_DRAG a frame, of the last sample. */
void tool_adjust_frame(struct tool *tool)
{
	struct ui *ui = tool->ui;
	if (ui->gesture != GESTURE_DRAG || !ui->moved)
		return;
	if (ui->grabbed && ui->grab_frame < ui->frame && !tool->session->drag.active) {
		ui->grabbed = false; /* a wrap or an undo has let go */
		ui->gesture = GESTURE_IDLE;
	} else if (!ui->grabbed) {
		grab(tool);
	}
	if (!ui->grabbed)
		return;
	struct v3 target = drag_target(tool);
	if (ui->grab_frame < ui->frame && v3_distance(target, ui->grab_m) < still_m)
		return;
	struct edit *edit = edit_push(tool->edits, EDIT_DRAG);
	if (!edit)
		return;
	edit->f[0] = target.x;
	edit->f[1] = target.y;
	edit->f[2] = target.z;
	ui->grab_m = target;
}

void tool_adjust_end(struct tool *tool)
{
	if (tool->ui->gesture == GESTURE_DRAG && tool->ui->grabbed)
		edit_push(tool->edits, EDIT_RELEASE);
	tool->ui->grabbed = false;
}

static void push_pin(struct tool *tool, int piece, struct v2 local_mm)
{
	struct edit *edit = edit_push(tool->edits, EDIT_PIN);
	if (!edit)
		return;
	edit->i[0] = piece;
	edit->f[0] = local_mm.x;
	edit->f[1] = local_mm.y;
}

/* The real button, pressed while the pen points at the garment. */
void tool_adjust_pin_here(struct tool *tool)
{
	struct ui *ui = tool->ui;
	struct worn_hit worn;
	if (ui->pen_state == PEN_AWAY || !rect_holds(ui->layout.left, ui->pen_px))
		return;
	if (pick_worn(ui, tool->session, ui->pen_px, &worn))
		push_pin(tool, worn.piece, worn.local_mm);
}

void tool_adjust_tap(struct tool *tool, bool on_sheet)
{
	struct ui *ui = tool->ui;
	struct worn_hit worn;
	if (!ui->pin_mode)
		return;
	int pin = pick_pin(ui, tool->session, ui->start_px);
	if (pin >= 0) {
		struct edit *edit = edit_push(tool->edits, EDIT_UNPIN);
		if (edit)
			edit->i[0] = pin;
		return;
	}
	if (!on_sheet && pick_worn(ui, tool->session, ui->start_px, &worn)) {
		push_pin(tool, worn.piece, worn.local_mm);
	} else if (on_sheet && tool->session->cloth.worn) {
		const struct pattern *pattern = &tool->session->document.pattern;
		struct v2 sheet_mm = view_sheet_mm(&ui->view, ui->start_px);
		int piece = pattern_pick(pattern, sheet_mm, 0);
		if (piece >= 0)
			push_pin(tool, piece, piece_from_sheet(&pattern->piece[piece], sheet_mm));
	}
}
