/* An outline that was not taken stays on the sheet for a while, so that the hand sees where. */
#include "tool.h"

static const float point_spacing_mm = 2.0f; /* of the screen */

static bool segments_cross(struct v2 a, struct v2 b, struct v2 c, struct v2 d, struct v2 *at)
{
	struct v2 ab = v2_sub(b, a), cd = v2_sub(d, c), ac = v2_sub(c, a);
	float cross = v2_cross(ab, cd);
	if (float_abs(cross) < 1e-6f)
		return false;
	float t = v2_cross(ac, cd) / cross, s = v2_cross(ac, ab) / cross;
	*at = v2_lerp(a, b, t);
	return t >= 0.0f && t <= 1.0f && s >= 0.0f && s <= 1.0f;
}

/* Of all crossings the one with the longest loop: the ends of a line may overlap, and do no harm.
 */
static bool worst_crossing(const struct v2 *line, int count, struct v2 *at)
{
	int worst = 1;
	for (int i = 0; i + 1 < count; i++)
		for (int k = i + 2; k + 1 < count; k++) {
			struct v2 here;
			int loop = int_min(k - i, count - (k - i));
			if (loop <= worst ||
			    !segments_cross(line[i], line[i + 1], line[k], line[k + 1], &here))
				continue;
			worst = loop;
			*at = here;
		}
	return worst > 1;
}

void stroke_refused(struct tool *tool, const char *reason)
{
	struct ui *ui = tool->ui;
	struct refused *refused = &ui->refused;
	enum text text = text_refusal(reason);
	int count = stroke_smooth(ui);
	tool_notice(tool, text);
	refused->count = stroke_even(ui->smooth_px, count, tool_px(ui, point_spacing_mm),
				     refused->line_mm, REFUSED_POINTS_MAX);
	if (refused->count < 1)
		return;
	struct v2 low = refused->line_mm[0], high = low;
	for (int i = 0; i < refused->count; i++) {
		struct v2 p = refused->line_mm[i] = view_sheet_mm(&ui->view, refused->line_mm[i]);
		low = i ? (struct v2){float_min(low.x, p.x), float_min(low.y, p.y)} : p;
		high = i ? (struct v2){float_max(high.x, p.x), float_max(high.y, p.y)} : p;
	}
	refused->fault = FAULT_OTHER;
	refused->at_mm[0] = refused->line_mm[0];
	refused->at_mm[1] = refused->line_mm[refused->count - 1];
	if (text == TEXT_CROSSES &&
	    worst_crossing(refused->line_mm, refused->count, &refused->at_mm[0])) {
		refused->fault = FAULT_CROSSES;
	} else if (text == TEXT_ENDS_APART || text == TEXT_OVERSKETCH) {
		refused->fault = FAULT_OPEN;
	} else if (text == TEXT_SMALL) {
		refused->fault = FAULT_SMALL;
		refused->at_mm[0] = v2_lerp(low, high, 0.5f);
	}
	refused->shows = true;
	refused->frame = ui->frame;
}
