/* From pen samples to gestures: when a contact is long enough to say where it began, the step's
 * tool says what it is; what never moves away from its start is a tap.
 *
 *   contact -> GESTURE_TARGET ---------------------------------> release inside: gesture_target
 *           -> GESTURE_WAIT -> begin -> moves, frame by frame -> end, or tap
 */
#include "tool.h"

enum {
	START_SAMPLES = 6,  /* where a contact began is the mean of so many samples, */
	START_US = 30000,   /* or of so long a time */
	STEADY_SAMPLES = 4, /* the pen now: the mean of the last few */
	CLEAR_FRAMES = FRAME_RATE_HZ,
};

static const float tap_mm = 3.0f;  /* of the screen: what stays within is a tap */
static const float slip_mm = 3.0f; /* a release so far beside a target still counts */

static bool on_sheet(const struct ui *ui)
{
	return rect_holds(ui->layout.right, ui->start_px);
}

static struct v2 mean(const struct v2 *point, int count)
{
	struct v2 sum = {0.0f, 0.0f};
	for (int i = 0; i < count; i++)
		sum = v2_add(sum, point[i]);
	return v2_scale(sum, 1.0f / (float)count);
}

/* ---- what a contact is ---- */

static enum gesture begin(struct tool *tool)
{
	struct ui *ui = tool->ui;
	bool sheet = on_sheet(ui);
	if (ui->eraser && (sheet || ui->step >= STEP_MARK))
		return GESTURE_ERASE;
	switch (ui->step) {
	case STEP_DRAW:
		return sheet ? tool_draw_begin(tool) : GESTURE_TRACKBALL;
	case STEP_SEW:
		return sheet ? tool_sew_begin(tool) : GESTURE_TRACKBALL;
	case STEP_MARK:
		return tool_mark_begin(tool, sheet);
	case STEP_DRESS:
	case STEP_ADJUST:
		return sheet ? GESTURE_IDLE : tool_adjust_begin(tool);
	case STEP_COUNT:
		break;
	}
	return GESTURE_IDLE;
}

static void end(struct tool *tool)
{
	switch (tool->ui->gesture) {
	case GESTURE_PIECE:
	case GESTURE_OVERSKETCH:
	case GESTURE_MOVE:
		tool_draw_end(tool);
		break;
	case GESTURE_MARK_CLOTH:
	case GESTURE_MARK_BODY:
	case GESTURE_MARK_WORN:
		tool_mark_end(tool);
		break;
	case GESTURE_DRAG:
		tool_adjust_end(tool);
		break;
	case GESTURE_ERASE:
		tool_erase(tool, on_sheet(tool->ui), false);
		break;
	case GESTURE_SHAPE:
		tool_shape_end(tool);
		break;
	case GESTURE_SEW:
		tool_sew_end(tool);
		break;
	case GESTURE_IDLE:
		if (tool->ui->step == STEP_SEW && on_sheet(tool->ui))
			tool_sew_end(tool);
		break;
	default:
		break;
	}
}

static void tap(struct tool *tool)
{
	struct ui *ui = tool->ui;
	bool sheet = on_sheet(ui);
	ui->start_px = mean(ui->stroke_px, ui->stroke_count);
	if (ui->gesture == GESTURE_ERASE)
		tool_erase(tool, sheet, true);
	else if (ui->step == STEP_DRAW && sheet)
		tool_draw_tap(tool);
	else if (ui->step == STEP_SEW && sheet)
		tool_sew_tap(tool);
	else if (ui->step == STEP_MARK)
		tool_mark_tap(tool, sheet);
	else if (ui->step >= STEP_DRESS)
		tool_adjust_tap(tool, sheet);
}

/* ---- the contact ---- */

static void contact_begin(struct tool *tool, const struct pen_sample *sample)
{
	struct ui *ui = tool->ui;
	ui->press_us = sample->time_us;
	ui->stroke_count = 0;
	ui->moved = false;
	ui->hold_frames = 0;
	ui->refused.shows = false;
	ui->eraser = sample->eraser || (ui->erase && ui->step == STEP_MARK);
	ui->pressed = layout_hit(&ui->layout, sample->position_px);
	if (ui->pressed != TARGET_NONE)
		ui->gesture = GESTURE_TARGET;
	else if (rect_holds(ui->layout.right, sample->position_px) && sample->barrel)
		ui->gesture = GESTURE_PAN;
	else if (rect_holds(ui->layout.right, sample->position_px) ||
		 rect_holds(ui->layout.left, sample->position_px))
		ui->gesture = GESTURE_WAIT;
	else
		ui->gesture = GESTURE_IDLE;
}

/* A stroke longer than the buffer ends there on its own accord: the rest draws nothing. */
static void note_sample(struct ui *ui, const struct pen_sample *sample)
{
	if (ui->stroke_count < STROKE_SAMPLES_MAX)
		ui->stroke_px[ui->stroke_count++] = sample->position_px;
	int recent = int_min(ui->stroke_count, STEADY_SAMPLES);
	ui->last_us = sample->time_us;
	ui->steady_px = mean(ui->stroke_px + ui->stroke_count - recent, recent);
	if (ui->gesture == GESTURE_WAIT || ui->stroke_count == 1)
		ui->start_px = mean(ui->stroke_px, ui->stroke_count);
	if (v2_distance(ui->start_px, ui->steady_px) > tool_px(ui, tap_mm))
		ui->moved = true;
}

static void follow(struct tool *tool, struct v2 before_px)
{
	struct ui *ui = tool->ui;
	struct v2 shift_mm = v2_sub(view_sheet_mm(&ui->view, ui->steady_px),
				    view_sheet_mm(&ui->view, before_px));
	switch (ui->gesture) {
	case GESTURE_TRACKBALL:
		view_trackball(&ui->view, before_px, ui->steady_px);
		break;
	case GESTURE_PAN:
		ui->zoomed = true;
		ui->view.sheet_centre_mm = v2_sub(ui->view.sheet_centre_mm, shift_mm);
		break;
	case GESTURE_MOVE:
		ui->move_mm = snap_move(tool, v2_sub(view_sheet_mm(&ui->view, ui->steady_px),
						     view_sheet_mm(&ui->view, ui->start_px)));
		break;
	case GESTURE_SEW:
		tool_sew_move(tool);
		break;
	case GESTURE_SHAPE:
		if (ui->moved)
			tool_shape_move(tool);
		break;
	default:
		break;
	}
}

static bool start_is_known(const struct ui *ui)
{
	return ui->moved || ui->stroke_count >= START_SAMPLES ||
	       (ui->stroke_count >= 3 && ui->last_us - ui->press_us >= START_US);
}

static void contact_move(struct tool *tool, const struct pen_sample *sample)
{
	struct ui *ui = tool->ui;
	struct v2 before_px = ui->steady_px;
	bool first = ui->stroke_count == 0;
	note_sample(ui, sample);
	if (ui->gesture == GESTURE_WAIT && start_is_known(ui))
		ui->gesture = begin(tool);
	if (!first)
		follow(tool, before_px);
}

static void contact_end(struct tool *tool)
{
	struct ui *ui = tool->ui;
	if (ui->gesture == GESTURE_WAIT)
		ui->gesture = begin(tool);
	if (ui->gesture == GESTURE_TARGET) {
		struct rect near = ui->layout.target[ui->pressed];
		int slip = (int)tool_px(ui, slip_mm);
		near = (struct rect){near.x - slip, near.y - slip, near.w + 2 * slip,
				     near.h + 2 * slip};
		if (rect_holds(near, ui->steady_px))
			gesture_target(tool, ui->pressed);
	} else if (ui->moved) {
		end(tool);
	} else if (ui->gesture != GESTURE_PAN || ui->drawing == DRAW_POINTS) {
		tap(tool);
	}
	ui->gesture = GESTURE_NONE;
	ui->pressed = TARGET_NONE;
	ui->stroke_count = 0;
	ui->sew_from.piece = ui->sew_to.piece = -1;
	ui->move_mm = (struct v2){0.0f, 0.0f};
	ui->shaping.shows = false;
	ui->shaping.guide_count = 0;
}

/* ---- what lies under the pen, for highlights ---- */

static void hover(struct tool *tool)
{
	struct ui *ui = tool->ui;
	struct edge_ref edge;
	struct worn_hit worn;
	struct body_hit body;
	ui->hover_target = TARGET_NONE;
	ui->hover_piece = ui->hover_edge = ui->hover_seam = ui->hover_triangle = -1;
	ui->hover_body = false;
	ui->hover_grip = GRIP_NONE;
	if (ui->pen_state != PEN_HOVER)
		return;
	ui->hover_target = layout_hit(&ui->layout, ui->pen_px);
	if (ui->hover_target != TARGET_NONE)
		return;
	if (rect_holds(ui->layout.right, ui->pen_px)) {
		struct v2 sheet_mm = view_sheet_mm(&ui->view, ui->pen_px);
		float fraction;
		ui->hover_piece = pattern_pick(&tool->session->document.pattern, sheet_mm, 0);
		ui->hover_grip = pick_grip(ui, tool->session, ui->pen_px, &ui->hover_which);
		if (ui->step == STEP_DRAW && ui->drawing == DRAW_POINTS)
			ui->hover_grip = points_hover(tool, &ui->hover_which);
		if (ui->step == STEP_SEW &&
		    pick_edge(ui, tool->session, ui->pen_px, 7.0f, &edge, &fraction)) {
			ui->hover_piece = edge.piece;
			ui->hover_edge = edge.edge;
			ui->hover_seam = pick_seam(ui, tool->session, ui->pen_px);
		}
	} else if (rect_holds(ui->layout.left, ui->pen_px) && ui->step >= STEP_MARK) {
		if (pick_worn(ui, tool->session, ui->pen_px, &worn)) {
			ui->hover_triangle = worn.triangle;
			ui->hover_m = worn.point_m;
		} else if (pick_body(ui, tool->session, ui->pen_px, &body)) {
			ui->hover_body = true;
			ui->hover_m = body.point_m;
		}
	}
}

static void hold(struct tool *tool)
{
	struct ui *ui = tool->ui;
	if (ui->gesture != GESTURE_TARGET || ui->pressed != TARGET_CLEAR)
		return;
	if (++ui->hold_frames < CLEAR_FRAMES)
		return;
	edit_push(tool->edits, EDIT_CLEAR);
	ui->gesture = GESTURE_IDLE;
	ui->pressed = TARGET_NONE;
	ui->hold_frames = 0;
	view_init(&ui->view, &ui->layout);
	ui->zoomed = false;
	ui->drawing = DRAW_PENCIL;
	ui_step(ui, STEP_DRAW);
}

void gesture_samples(struct tool *tool, const struct frame_input *input)
{
	struct ui *ui = tool->ui;
	for (int i = 0; i < input->sample_count; i++) {
		const struct pen_sample *sample = &input->sample[i];
		bool touch = sample->state == PEN_TOUCH, touched = ui->pen_state == PEN_TOUCH;
		if (touch && !touched)
			contact_begin(tool, sample);
		if (touch)
			contact_move(tool, sample);
		else if (touched)
			contact_end(tool);
		ui->pen_state = sample->state;
		ui->pen_px = sample->position_px;
		ui->pen_pressure = sample->pressure;
	}
	tool_adjust_frame(tool);
	hold(tool);
	hover(tool);
}
