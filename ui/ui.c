#include "ui.h"
#include "take_home_page.h"
#include "tool.h"

enum { NOTICE_FRAMES = 4 * FRAME_RATE_HZ, REFUSED_FRAMES = 6 * FRAME_RATE_HZ };

static const float zoom_step = 1.6f;

void ui_init(struct ui *ui, int width, int height)
{
	memset(ui, 0, sizeof *ui);
	layout_make(&ui->layout, width, height, STEP_DRAW, false);
	view_init(&ui->view, &ui->layout);
	ui->piece = ui->seam = ui->corner = -1;
	ui->sew_from.piece = ui->sew_to.piece = -1;
	ui->hover_piece = ui->hover_edge = ui->hover_seam = ui->hover_triangle = -1;
}

void ui_step(struct ui *ui, enum step step)
{
	ui->step = step;
	ui->erase = false;
	ui->corner = -1;
	ui->pin_toggled &= step >= STEP_DRESS;
	layout_make(&ui->layout, ui->layout.width, ui->layout.height, step, ui->left_handed);
}

void tool_notice(struct tool *tool, enum text text)
{
	tool->ui->notice = (int)text;
	tool->ui->notice_frame = tool->ui->frame;
}

/* ---- what can be done now ---- */

static bool marks_pair(const struct marks *marks)
{
	for (int a = 0; a < MARKS_MAX; a++)
		for (int b = 0; marks->cloth[a].used && b < MARKS_MAX; b++)
			if (marks->body[b].used && marks->body[b].number == marks->cloth[a].number)
				return true;
	return false;
}

static bool any_marks(const struct marks *marks)
{
	for (int m = 0; m < MARKS_MAX; m++)
		if (marks->cloth[m].used || marks->body[m].used)
			return true;
	return false;
}

static uint32_t pieces_used(const struct pattern *pattern)
{
	uint32_t used = 0;
	for (int p = 0; p < PIECES_MAX; p++)
		used |= (uint32_t)pattern->piece[p].used << p;
	return used;
}

static uint64_t seams_used(const struct pattern *pattern)
{
	uint64_t used = 0;
	for (int s = 0; s < SEAMS_MAX; s++)
		used |= (uint64_t)pattern->seam[s].used << s;
	return used;
}

static bool seam_selected(const struct ui *ui, const struct session *session)
{
	return ui->seam >= 0 && session->document.pattern.seam[ui->seam].used;
}

bool ui_useful(const struct ui *ui, const struct session *session, enum target target)
{
	switch (target) {
	case TARGET_UNDO:
		return session->undo_count > 0;
	case TARGET_REDO:
		return session->redo_count > 0;
	case TARGET_CLEAR:
		return pieces_used(&session->document.pattern) != 0 ||
		       any_marks(&session->document.marks);
	case TARGET_COPY:
	case TARGET_TURN_OVER:
	case TARGET_MIRROR:
	case TARGET_FOLD:
		return piece_used(session, ui->piece);
	case TARGET_DELETE:
		return ui->step == STEP_SEW ? seam_selected(ui, session)
					    : piece_used(session, ui->piece);
	case TARGET_SWAP:
	case TARGET_EVEN:
		return seam_selected(ui, session);
	case TARGET_ZOOM_OUT:
		return ui->zoomed;
	case TARGET_FINISH:
		return pieces_used(&session->document.pattern) != 0;
	case TARGET_ERASE:
		return any_marks(&session->document.marks);
	case TARGET_WRAP:
		return marks_pair(&session->document.marks);
	case TARGET_PIN:
	case TARGET_RELAX:
		return session->cloth.worn && session->job == JOB_NONE;
	default:
		return true;
	}
}

/* ---- targets ---- */

static void press_wrap(struct tool *tool)
{
	if (!marks_pair(&tool->session->document.marks)) {
		tool_notice(tool, TEXT_NO_PAIR);
		return;
	}
	edit_push(tool->edits, EDIT_WRAP);
	ui_step(tool->ui, STEP_DRESS);
}

static void press_history(struct tool *tool, enum edit_kind kind, int steps)
{
	if (steps > 0)
		edit_push(tool->edits, kind);
}

/* Nearer to the selected piece, or to the middle of what is seen. */
static void zoom_in(struct tool *tool)
{
	struct ui *ui = tool->ui;
	struct v2 about = ui->view.sheet_centre_mm, low, high;
	if (piece_used(tool->session, ui->piece)) {
		piece_bounds(&tool->session->document.pattern.piece[ui->piece], &low, &high);
		about = v2_lerp(low, high, 0.5f);
	}
	if (!ui->zoomed || v2_distance(about, ui->view.sheet_centre_mm) > 0.0f)
		ui->view.sheet_centre_mm = v2_lerp(ui->view.sheet_centre_mm, about, 0.7f);
	view_sheet_zoom(&ui->view, zoom_step, about);
	ui->zoomed = true;
}

/* All of the pattern again: the paper as it was at first, which grows as far as it must. */
static void zoom_out(struct ui *ui)
{
	struct view first;
	view_init(&first, &ui->layout);
	ui->view.sheet_centre_mm = first.sheet_centre_mm;
	ui->view.sheet_px_per_mm = first.sheet_px_per_mm;
	ui->zoomed = false;
}

void gesture_target(struct tool *tool, enum target target)
{
	struct ui *ui = tool->ui;
	switch (target) {
	case TARGET_STEP_DRAW:
	case TARGET_STEP_SEW:
	case TARGET_STEP_MARK:
	case TARGET_STEP_DRESS:
	case TARGET_STEP_ADJUST:
		ui_step(ui, (enum step)(target - TARGET_STEP_DRAW));
		break;
	case TARGET_UNDO:
		press_history(tool, EDIT_UNDO, tool->session->undo_count);
		break;
	case TARGET_REDO:
		press_history(tool, EDIT_REDO, tool->session->redo_count);
		break;
	case TARGET_LANGUAGE:
		ui->language = (enum language)((ui->language + 1) % (LANGUAGE_ENGLISH + 1));
		break;
	case TARGET_HAND:
		ui->left_handed = !ui->left_handed;
		layout_make(&ui->layout, ui->layout.width, ui->layout.height, ui->step,
			    ui->left_handed);
		break;
	case TARGET_VIEW_FRONT:
	case TARGET_VIEW_SIDE:
	case TARGET_VIEW_BACK:
		view_look(&ui->view, 0.5f * PI_F * (float)(target - TARGET_VIEW_FRONT));
		break;
	case TARGET_LASER:
		ui->laser = !ui->laser;
		ui->erase = false;
		break;
	case TARGET_ERASE:
		ui->erase = !ui->erase;
		break;
	case TARGET_WRAP:
		press_wrap(tool);
		break;
	case TARGET_PIN:
		ui->pin_toggled = !ui->pin_toggled && tool->session->cloth.worn;
		if (!tool->session->cloth.worn)
			tool_notice(tool, TEXT_NOT_WORN);
		else if (ui->step < STEP_DRESS)
			ui_step(ui, STEP_ADJUST);
		break;
	case TARGET_RELAX: /* held, and CLEAR too: what they do happens while they are pressed */
	case TARGET_CLEAR:
	case TARGET_NONE:
	case TARGET_COUNT:
		break;
	case TARGET_SWAP:
	case TARGET_EVEN:
		tool_sew_target(tool, target);
		break;
	case TARGET_ZOOM_IN:
		zoom_in(tool);
		break;
	case TARGET_ZOOM_OUT:
		zoom_out(ui);
		break;
	case TARGET_FINISH:
		if (pieces_used(&tool->session->document.pattern))
			take_home_open(ui);
		else
			tool_notice(tool, TEXT_NOTHING);
		break;
	case TARGET_DELETE:
		if (ui->step == STEP_SEW)
			tool_sew_target(tool, target);
		else
			tool_draw_target(tool, target);
		break;
	default:
		tool_draw_target(tool, target);
		break;
	}
}

/* ---- the three real buttons ---- */

static void hold_relax(struct tool *tool)
{
	struct ui *ui = tool->ui;
	bool wanted = (ui->buttons_held >> BUTTON_RELAX & 1) ||
		      (ui->gesture == GESTURE_TARGET && ui->pressed == TARGET_RELAX);
	bool pressed = wanted && !ui->relax_wanted, tell = wanted != ui->relax_held;
	ui->relax_wanted = wanted;
	if (pressed && !ui_useful(ui, tool->session, TARGET_RELAX))
		tool_notice(tool, TEXT_NOT_WORN);
	if (!tell || (wanted && !(pressed && ui_useful(ui, tool->session, TARGET_RELAX))))
		return;
	struct edit *edit = edit_push(tool->edits, EDIT_RELAX);
	if (!edit)
		return;
	edit->i[0] = wanted;
	ui->relax_held = wanted;
}

static void press_buttons(struct tool *tool, const struct frame_input *input)
{
	struct ui *ui = tool->ui;
	bool worn = ui_useful(ui, tool->session, TARGET_PIN);
	ui->buttons_held = input->buttons_held;
	if (input->buttons_pressed >> BUTTON_WRAP & 1)
		press_wrap(tool);
	if (input->buttons_pressed >> BUTTON_PIN & 1) {
		if (!worn)
			tool_notice(tool, TEXT_NOT_WORN);
		else if (ui->step < STEP_DRESS)
			ui_step(ui, STEP_ADJUST);
		tool_adjust_pin_here(tool);
	}
	ui->pin_toggled &= tool->session->cloth.worn;
	ui->pin_mode = worn && (ui->pin_toggled || (ui->buttons_held >> BUTTON_PIN & 1));
	hold_relax(tool);
}

/* ---- what happened since the last frame ---- */

static int lowest_bit(uint64_t bits)
{
	int bit = 0;
	while (bit < 63 && !(bits >> bit & 1))
		bit++;
	return bit;
}

/* A new piece or seam is selected when this hand made it; a selection that is gone is none. */
static void follow_document(struct ui *ui, const struct session *session)
{
	uint32_t pieces = pieces_used(&session->document.pattern);
	uint64_t seams = seams_used(&session->document.pattern);
	if (ui->select_new && (pieces & ~ui->pieces_seen)) {
		ui->piece = lowest_bit(pieces & ~ui->pieces_seen);
		ui->corner = -1;
	}
	if (ui->select_new && (seams & ~ui->seams_seen))
		ui->seam = lowest_bit(seams & ~ui->seams_seen);
	if (ui->piece >= 0 && !(pieces >> ui->piece & 1))
		ui->piece = -1;
	if (ui->piece < 0 ||
	    ui->corner >= piece_edge_count(&session->document.pattern.piece[ui->piece]))
		ui->corner = -1;
	if (ui->seam >= 0 && !(seams >> ui->seam & 1))
		ui->seam = -1;
	ui->select_new = false;
	ui->pieces_seen = pieces;
	ui->seams_seen = seams;
}

static void follow_notice(struct ui *ui, const struct session *session)
{
	if (ui->sent && session->notice[0]) {
		ui->notice = (int)text_refusal(session->notice);
		ui->notice_frame = ui->frame;
	} else if (ui->sent || ui->frame - ui->notice_frame > NOTICE_FRAMES) {
		ui->notice = TEXT_NONE;
	}
	ui->sent = false;
	if (ui->frame - ui->refused.frame > REFUSED_FRAMES)
		ui->refused.shows = false;
}

/* A twin pulses once when it becomes useful. */
static void follow_use(struct ui *ui, const struct session *session)
{
	bool pair = ui_useful(ui, session, TARGET_WRAP);
	bool worn = ui_useful(ui, session, TARGET_RELAX);
	if (pair && !ui->had_pair)
		ui->pulse[TARGET_WRAP] = ui->frame;
	if (worn && !ui->was_worn)
		ui->pulse[TARGET_PIN] = ui->pulse[TARGET_RELAX] = ui->frame;
	ui->had_pair = pair;
	ui->was_worn = worn;
}

/* The paper grows when a piece no longer fits on it, never under a moving pen. */
static void follow_sheet(struct ui *ui, const struct session *session)
{
	const struct pattern *pattern = &session->document.pattern;
	if (ui->gesture != GESTURE_NONE || ui->zoomed)
		return;
	for (int p = 0; p < PIECES_MAX; p++) {
		struct v2 low, high;
		if (!pattern->piece[p].used || pattern->piece[p].point_count < 1)
			continue;
		piece_bounds(&pattern->piece[p], &low, &high);
		view_sheet_show(&ui->view, low, high);
	}
}

void ui_update(struct ui *ui, const struct frame_input *input, const struct session *session,
	       struct edit_list *edits)
{
	struct tool tool = {ui, session, edits};
	int before = edits->count;
	ui->frame++;
	follow_notice(ui, session);
	follow_document(ui, session);
	follow_use(ui, session);
	if (ui->take_home.open) {
		static const struct frame_input nothing;
		press_buttons(&tool, &nothing); /* what was held is let go */
		take_home_update(ui, input);
	} else {
		gesture_samples(&tool, input);
		press_buttons(&tool, input);
	}
	follow_sheet(ui, session);
	ui->sent = edits->count > before;
}
