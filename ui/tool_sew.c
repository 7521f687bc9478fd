/* Step 2: a stroke from edge to edge sews them; a tap on a seam's edge or letter selects it. */
#include "tool.h"

static const float from_reach_mm = 7.0f, to_reach_mm = 9.0f; /* of the screen */

enum gesture tool_sew_begin(struct tool *tool)
{
	struct ui *ui = tool->ui;
	struct edge_ref edge;
	float fraction;
	ui->sew_to.piece = ui->sew_to.edge = -1;
	if (!pick_edge(ui, tool->session, ui->start_px, from_reach_mm, &edge, &fraction))
		return GESTURE_IDLE;
	ui->seam = -1; /* one zip at a time */
	ui->sew_from.piece = edge.piece;
	ui->sew_from.edge = edge.edge;
	return GESTURE_SEW;
}

void tool_sew_move(struct tool *tool)
{
	struct ui *ui = tool->ui;
	struct edge_ref edge;
	float fraction;
	bool found = pick_edge(ui, tool->session, ui->steady_px, to_reach_mm, &edge, &fraction);
	bool same = found && edge.piece == ui->sew_from.piece && edge.edge == ui->sew_from.edge;
	ui->sew_to.piece = found && !same ? edge.piece : -1;
	ui->sew_to.edge = found && !same ? edge.edge : -1;
}

/* Its place counts as empty from here on: what is sewn there next is new. */
static void push_unsew(struct tool *tool, int seam)
{
	struct edit *edit = seam >= 0 ? edit_push(tool->edits, EDIT_UNSEW) : NULL;
	if (!edit)
		return;
	edit->i[0] = seam;
	tool->ui->seams_seen &= ~((uint64_t)1 << seam);
}

static void push_sew(struct tool *tool, struct edge_ref a, struct edge_ref b, bool swapped)
{
	struct edit *edit = edit_push(tool->edits, EDIT_SEW);
	if (!edit)
		return;
	edit->i[0] = a.piece;
	edit->i[1] = a.edge;
	edit->i[2] = b.piece;
	edit->i[3] = b.edge;
	edit->i[4] = swapped;
	tool->ui->select_new = true;
}

/* An edge has one seam: sewing it anew undoes the old one. */
void tool_sew_end(struct tool *tool)
{
	struct ui *ui = tool->ui;
	const struct pattern *pattern = &tool->session->document.pattern;
	struct edge_ref a = {ui->sew_from.piece, ui->sew_from.edge};
	struct edge_ref b = {ui->sew_to.piece, ui->sew_to.edge};
	if (ui->gesture != GESTURE_SEW || !piece_used(tool->session, a.piece)) {
		tool_notice(tool, TEXT_SEW_ENDS);
		return;
	}
	if (!piece_used(tool->session, b.piece)) {
		tool_notice(tool, TEXT_SELF_SEAM);
		return;
	}
	int of_a = seam_of_edge(pattern, a), of_b = seam_of_edge(pattern, b);
	if (of_a >= 0 && of_a == of_b) {
		ui->seam = of_a;
		return;
	}
	push_unsew(tool, of_a);
	push_unsew(tool, of_b);
	push_sew(tool, a, b, false);
}

void tool_sew_tap(struct tool *tool)
{
	tool->ui->seam = pick_seam(tool->ui, tool->session, tool->ui->start_px);
}

void tool_sew_target(struct tool *tool, enum target target)
{
	struct ui *ui = tool->ui;
	if (ui->seam < 0 || !tool->session->document.pattern.seam[ui->seam].used) {
		tool_notice(tool, TEXT_NO_SEAM);
		return;
	}
	const struct seam *seam = &tool->session->document.pattern.seam[ui->seam];
	if (target == TARGET_EVEN) {
		struct edit *edit = edit_push(tool->edits, EDIT_EVEN);
		if (edit) {
			edit->i[0] = ui->seam;
			edit->i[1] = !seam->even;
		}
		return;
	}
	push_unsew(tool, ui->seam);
	if (target == TARGET_SWAP)
		push_sew(tool, seam->a, seam->b, !seam->swapped);
}
