/* What the visitor put on the figure: marks with their numbers, pins, and what the hand is doing.
 */
#include "draw_private.h"

static const float mark_lift_m = 0.002f, pin_length_m = 0.040f;
static const float ghost_gap_m = 0.27f, ghost_top_m = 0.78f, ghost_margin_px = 18.0f;

/* ---- marks and pins that ride on the garment ---- */

static void ride_find(struct ride *ride, const struct garment *garment, int piece,
		      struct v2 point_mm)
{
	ride->triangle = garment_locate(garment, piece, point_mm, ride->weight);
}

static bool ride_point(const struct draw *draw, const struct session *session,
		       const struct ride *ride, struct v3 *point_m, struct v3 *normal)
{
	if (ride->triangle < 0 || ride->triangle >= session->garment.triangle_count)
		return false;
	const int *v = session->garment.triangle[ride->triangle].v;
	struct v3 p = {0}, n = {0};
	for (int k = 0; k < 3; k++) {
		if (!session->cloth.placed[v[k]])
			return false;
		p = v3_mad(p, draw->cloth.vertex[v[k]].position_m, ride->weight[k]);
		n = v3_mad(n, draw->cloth.vertex[v[k]].normal, ride->weight[k]);
	}
	*point_m = p;
	*normal = v3_normalize(n);
	return true;
}

/* A line in millimetres as places on triangles, no two farther apart than a cell of the mesh. */
static void rides_make(struct draw_marks *own, int slot, const struct cloth_mark *mark,
		       const struct garment *garment)
{
	float length_mm = 0.0f;
	for (int i = 1; i < mark->point_count; i++)
		length_mm += v2_distance(mark->point_mm[i], mark->point_mm[i - 1]);
	float step_mm = float_max(length_mm / (float)(MARK_SAMPLES_MAX - 2), 6.0f);
	float next_mm = 0.0f, at_mm = 0.0f;
	int count = 0;
	for (int i = 1; i < mark->point_count; i++) {
		struct v2 a = mark->point_mm[i - 1], b = mark->point_mm[i];
		float run_mm = v2_distance(a, b);
		while (next_mm <= at_mm + run_mm && run_mm > 0.0f && count < MARK_SAMPLES_MAX) {
			struct v2 at = v2_lerp(a, b, (next_mm - at_mm) / run_mm);
			ride_find(&own->ride[slot][count++], garment, mark->piece, at);
			next_mm += step_mm;
		}
		at_mm += run_mm;
	}
	own->ride_count[slot] = count;
}

/* A body mark may have far points (written by hand): in between, the line follows the surface. */
static void line_make(struct draw_marks *own, int slot, const struct body_mark *mark,
		      const struct body *body)
{
	int count = 0;
	for (int i = 0; i < mark->point_count; i++) {
		struct v3 b = mark->point_m[i], a = mark->point_m[int_max(i - 1, 0)];
		int steps = i ? int_clamp((int)(v3_distance(a, b) / 0.012f), 1, 64) : 1;
		for (int k = 1; k <= steps && count < BODY_LINE_POINTS_MAX; k++) {
			struct body_hit hit = {.point_m = b, .normal = mark->normal[i]};
			if (k < steps)
				body_nearest(body, v3_lerp(a, b, (float)k / (float)steps), 0, &hit);
			own->line_m[slot][count] = hit.point_m;
			own->line_normal[slot][count++] = hit.normal;
		}
	}
	own->line_count[slot] = count;
}

static void marks_follow(struct draw *draw, const struct session *session)
{
	struct draw_marks *own = &draw->marks;
	const struct document *document = &session->document;
	bool all = own->stale;
	for (int i = 0; i < MARKS_MAX; i++) {
		if (all || memcmp(&own->seen.cloth[i], &document->marks.cloth[i],
				  sizeof own->seen.cloth[i])) {
			own->ride_count[i] = 0;
			if (document->marks.cloth[i].used && draw->cloth.vertex_count)
				rides_make(own, i, &document->marks.cloth[i], &session->garment);
		}
		if (all || memcmp(&own->seen.body[i], &document->marks.body[i],
				  sizeof own->seen.body[i])) {
			own->line_count[i] = 0;
			if (document->marks.body[i].used)
				line_make(own, i, &document->marks.body[i], &session->body);
		}
	}
	for (int i = 0; i < PINS_MAX; i++)
		if (document->pin[i].used &&
		    (all || memcmp(&own->seen_pin[i], &document->pin[i], sizeof own->seen_pin[i])))
			ride_find(&own->pin[i], &session->garment, document->pin[i].piece,
				  document->pin[i].point_mm);
	own->seen = document->marks;
	memcpy(own->seen_pin, document->pin, sizeof own->seen_pin);
	own->stale = false;
}

/* White halo, then the line in its mark's colour and dash; doubled from number 6 on. */
static void mark_line(struct draw *draw, const struct v3 *point_m, const struct v3 *normal,
		      int count, int number)
{
	const struct mark_style *style = look_mark_style(number);
	float period_px = style->dash_px[0] + style->dash_px[1] + style->dash_px[2] +
			  style->dash_px[3];
	struct stroke halo = {0xffffff, 0.92f, 5.2f * draw->px, DASH_SOLID, 1.0f};
	struct stroke line = {style->colour, 1.0f, 3.0f * draw->px, DASH_SOLID, 1.0f};
	line.row = (enum dash_row)((number - 1) % MARK_STYLES);
	line.period = float_max(period_px, 1.0f) * draw->px;
	ribbons_line(draw, point_m, normal, count, mark_lift_m, &halo);
	ribbons_line(draw, point_m, normal, count, mark_lift_m, &line);
	if (look_mark_doubled(number)) {
		struct stroke gap = {0xffffff, 1.0f, 0.9f * draw->px, DASH_SOLID, 1.0f};
		ribbons_line(draw, point_m, normal, count, mark_lift_m, &gap);
	}
}

/* A mark on the body that the garment's mark of the same number has come to lie on needs no number
 * of its own. */
static bool partner_worn(const struct draw *draw, const struct session *session, int number)
{
	for (int i = 0; i < MARKS_MAX; i++)
		if (session->document.marks.cloth[i].used &&
		    session->document.marks.cloth[i].number == number)
			return draw->cloth.index_count > 0 && draw->marks.ride_count[i] > 0;
	return false;
}

static void pins_add(struct draw *draw, const struct session *session)
{
	struct stroke shadow = {0x2b2018, 0.30f, 2.2f * draw->px, DASH_SOLID, 1.0f};
	struct stroke steel = {0x6d5a66, 1.0f, 1.5f * draw->px, DASH_SOLID, 1.0f};
	for (int i = 0; i < PINS_MAX; i++) {
		struct v3 point_m, normal;
		if (!session->document.pin[i].used ||
		    !ride_point(draw, session, &draw->marks.pin[i], &point_m, &normal))
			continue;
		/* Pins are put in from above and lie flat: their steel shows from the front. */
		struct v3 lean = v3_normalize((struct v3){normal.x, normal.y + 1.7f, normal.z});
		struct v3 head_m = v3_mad(point_m, lean, pin_length_m);
		ribbons_segment(draw, point_m, v3_mad(point_m, normal, 0.004f), 0.0f, &shadow);
		ribbons_segment(draw, point_m, head_m, 0.0f, &steel);
		sprite_pin(draw, head_m);
	}
}

static void marks_shown(struct draw *draw, const struct session *session)
{
	struct draw_marks *own = &draw->marks;
	struct v3 point_m[MARK_SAMPLES_MAX], normal[MARK_SAMPLES_MAX];
	for (int i = 0; i < MARKS_MAX; i++) {
		int number = session->document.marks.body[i].number, count = own->line_count[i];
		mark_line(draw, own->line_m[i], own->line_normal[i], count, number);
		if (count && !partner_worn(draw, session, number))
			sprite_number(draw, own->line_m[i][0], number);
	}
	ribbons_draw(draw, 0.0f); /* the body lies body_bias_m deeper; cloth on it hides them */
	ribbons_begin(draw);
	for (int i = 0; i < MARKS_MAX; i++) {
		int number = session->document.marks.cloth[i].number, count = 0;
		for (int k = 0; k < own->ride_count[i]; k++)
			if (ride_point(draw, session, &own->ride[i][k], &point_m[count],
				       &normal[count]))
				count++;
		mark_line(draw, point_m, normal, count, number);
		if (count)
			sprite_number(draw, point_m[0], number);
	}
}

void marks_add(struct draw *draw, const struct ui *ui, const struct session *session)
{
	marks_follow(draw, session);
	if (ui->step == STEP_MARK || ui->step == STEP_DRESS)
		marks_shown(draw, session);
	if (draw->cloth.index_count)
		pins_add(draw, session);
}

/* ---- the hand: ring, stroke in progress, line of a drag; over everything ---- */

/* A point of the screen on a plane before the eye: lines keep their width there. */
static struct v3 glass_point(const struct ui *ui, struct v2 position_px)
{
	struct v3 origin_m, direction;
	view_ray(&ui->view, position_px, &origin_m, &direction);
	float along = v3_dot(direction, ui->view.turn.row[2]);
	return v3_mad(origin_m, direction, along < -0.01f ? -1.0f / along : 1.0f);
}

static void stroke_add(struct draw *draw, const struct ui *ui, uint32_t colour)
{
	struct v3 point_m[HAND_POINTS_MAX];
	int count = 0, stride = ui->stroke_count / (HAND_POINTS_MAX - 2) + 1;
	struct v2 last_px = {-100.0f, -100.0f};
	for (int i = 0; i < ui->stroke_count && count < HAND_POINTS_MAX - 1; i += stride) {
		if (v2_distance(ui->stroke_px[i], last_px) < 2.0f)
			continue;
		last_px = ui->stroke_px[i];
		point_m[count++] = glass_point(ui, last_px);
	}
	struct stroke halo = {0xffffff, 0.92f, 5.2f * draw->px, DASH_SOLID, 1.0f};
	struct stroke line = {colour, 1.0f, 3.0f * draw->px, DASH_SOLID, 1.0f};
	ribbons_line(draw, point_m, NULL, count, 0.0f, &halo);
	ribbons_line(draw, point_m, NULL, count, 0.0f, &line);
}

static void pull_add(struct draw *draw, const struct ui *ui, const struct session *session)
{
	struct v2 from_px;
	float depth_m;
	if (!session->drag.active ||
	    !view_project(&ui->view, drag_point(&session->drag), &from_px, &depth_m))
		return;
	struct v3 point_m[2] = {glass_point(ui, from_px), glass_point(ui, ui->pen_px)};
	struct stroke halo = {0xffffff, 0.85f, 3.4f * draw->px, DASH_PULL, 16.0f * draw->px};
	struct stroke line = {LOOK_INK, 1.0f, 1.9f * draw->px, DASH_PULL, 16.0f * draw->px};
	ribbons_line(draw, point_m, NULL, 2, 0.0f, &halo);
	ribbons_line(draw, point_m, NULL, 2, 0.0f, &line);
}

/* Where the ghost's middle is: beside the legs, below the hands, and within the pane. A tall piece
 * stands on the floor. */
static struct v3 ghost_middle(const struct draw *draw, const struct ui *ui, struct v2 size_m)
{
	const struct view *view = &ui->view;
	float px_per_m = draw->camera.px_per_m / view->distance_m;
	float edge_m = (0.5f * (float)view->pane.w - ghost_margin_px * draw->px) / px_per_m;
	float right_m = float_min(ghost_gap_m + float_max(size_m.x, 0.6f), edge_m);
	float top_m = float_max(ghost_top_m, size_m.y);
	struct v3 foot_m = {view->centre_m.x, 0.0f, view->centre_m.z};
	struct v3 middle_m = v3_mad(foot_m, view->turn.row[0], right_m - 0.5f * size_m.x);
	return v3_mad(middle_m, view->turn.row[1], top_m - 0.5f * size_m.y);
}

/* Step 1: the selected piece stands beside the figure at its true size, as a drawn line. */
static void ghost_add(struct draw *draw, const struct ui *ui, const struct session *session)
{
	const struct pattern *pattern = &session->document.pattern;
	struct v3 point_m[OUTLINE_POINTS_MAX + 1];
	struct stroke line = {LOOK_INK_GREY, 0.7f, 1.3f * draw->px, DASH_PULL, 14.0f * draw->px};
	if (ui->piece < 0 || ui->piece >= PIECES_MAX || !pattern->piece[ui->piece].used)
		return;
	const struct piece *piece = &pattern->piece[ui->piece];
	struct v2 low = piece->point_mm[0], high = low;
	for (int i = 1; i < piece->point_count; i++) {
		struct v2 p = piece->point_mm[i];
		low = (struct v2){float_min(low.x, p.x), float_min(low.y, p.y)};
		high = (struct v2){float_max(high.x, p.x), float_max(high.y, p.y)};
	}
	struct v2 middle_mm = v2_lerp(low, high, 0.5f);
	struct v2 size_m = v2_scale(v2_sub(high, low), 0.001f);
	struct v3 middle_m = ghost_middle(draw, ui, size_m);
	for (int i = 0; i <= piece->point_count; i++) {
		struct v2 p = v2_sub(piece->point_mm[i % piece->point_count], middle_mm);
		point_m[i] = v3_mad(v3_mad(middle_m, ui->view.turn.row[0], 0.001f * p.x),
				    ui->view.turn.row[1], 0.001f * p.y);
	}
	ribbons_line(draw, point_m, NULL, piece->point_count + 1, 0.0f, &line);
}

static bool in_pane(const struct rect *pane, struct v2 px)
{
	return px.x >= (float)pane->x && px.y >= (float)pane->y &&
	       px.x < (float)(pane->x + pane->w) && px.y < (float)(pane->y + pane->h);
}

void hand_add(struct draw *draw, const struct ui *ui, const struct session *session)
{
	int side = ui->gesture == GESTURE_MARK_WORN ? 0 : 1;
	uint32_t next = look_mark_style(session_next_mark(session, side))->colour;
	if (ui->gesture == GESTURE_MARK_BODY || ui->gesture == GESTURE_MARK_WORN)
		stroke_add(draw, ui, next);
	if (ui->gesture == GESTURE_DRAG)
		pull_add(draw, ui, session);
	if (ui->step == STEP_DRAW)
		ghost_add(draw, ui, session);
	if (ui->pen_state == PEN_AWAY || !in_pane(&ui->view.pane, ui->pen_px))
		return;
	uint32_t colour = ui->step == STEP_MARK && !ui->erase       ? next
			  : ui->step == STEP_ADJUST && ui->pin_mode ? LOOK_PIN
								    : LOOK_INK;
	float radius_px = (ui->pen_state == PEN_TOUCH ? 12.0f : 17.0f) * draw->px;
	sprite_ring(draw, ui->pen_px, radius_px, colour);
}

void bones_add(struct draw *draw, const struct body *body)
{
	static const uint32_t colour[PART_COUNT] = {0x2b2a28, 0x0072b2, 0xd55e00,
						    0x009e73, 0xcc79a7, 0xe69f00};
	for (int i = 0; i < body->bone_count; i++) {
		const struct bone *bone = &body->bone[i];
		struct stroke halo = {0xffffff, 0.9f, 5.0f * draw->px, DASH_SOLID, 1.0f};
		struct stroke line = {colour[bone->part], 1.0f, 3.0f * draw->px, DASH_SOLID, 1.0f};
		ribbons_segment(draw, bone->a_m, bone->b_m, 0.0f, &halo);
		ribbons_segment(draw, bone->a_m, bone->b_m, 0.0f, &line);
	}
}
