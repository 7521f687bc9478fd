#include "hand_visit.h"

enum { PATH_POINTS_MAX = 1024, RUN_STEPS = 12, DIP_STEPS = 24, WAY_STEPS = 24 };

static const float pull_px_s = 160.0f, mark_px_s = 200.0f;

struct path {
	int count;
	struct v2 point[PATH_POINTS_MAX];
};

static void path_add(struct path *path, struct v2 point)
{
	MUST(path->count < PATH_POINTS_MAX);
	path->point[path->count++] = point;
}

static void path_line(struct path *path, struct v2 to, int steps)
{
	struct v2 from = path->point[path->count - 1];
	for (int i = 1; i <= steps; i++)
		path_add(path, v2_lerp(from, to, (float)i / (float)steps));
}

/* ---- on the sheet ---- */

static void sketch_dip(struct sketch *sketch, float half_width_mm, float dip_mm)
{
	for (int i = 1; i < DIP_STEPS && dip_mm > 0.0f; i++) {
		float angle = PI_F * (1.0f - (float)i / DIP_STEPS);
		sketch->point_mm[sketch->count++] = (struct v2){half_width_mm * angle_cos(angle),
								-dip_mm * angle_sin(angle)};
	}
}

void sketch_make(struct sketch *sketch, const struct v2 *half_mm, int count, float dip_mm)
{
	MUST(2 * count + DIP_STEPS <= SKETCH_POINTS_MAX);
	sketch->count = 0;
	sketch->point_mm[sketch->count++] = (struct v2){-half_mm[0].x, half_mm[0].y};
	sketch_dip(sketch, half_mm[0].x, dip_mm);
	for (int i = 1; i < sketch->count; i++)
		sketch->point_mm[i].y += half_mm[0].y;
	for (int i = 0; i < count; i++)
		sketch->point_mm[sketch->count++] = half_mm[i];
	for (int i = count - 1; i > 0; i--)
		sketch->point_mm[sketch->count++] = (struct v2){-half_mm[i].x, half_mm[i].y};
}

static void bounds(const struct v2 *point, int count, struct v2 *low, struct v2 *high)
{
	*low = *high = point[0];
	for (int i = 1; i < count; i++) {
		*low = (struct v2){float_min(low->x, point[i].x), float_min(low->y, point[i].y)};
		*high = (struct v2){float_max(high->x, point[i].x), float_max(high->y, point[i].y)};
	}
}

static const struct piece *piece_of(const struct hand *hand, int piece)
{
	return &hand->kiosk->session.document.pattern.piece[piece];
}

/* Where a place of the sketch lies on the sheet, by what has become of its outline. */
static struct v2 sheet_mm(const struct hand *hand, const struct sketch *sketch, int at,
			  struct v2 mm)
{
	const struct piece *piece = piece_of(hand, at);
	static struct v2 outline[OUTLINE_POINTS_MAX];
	struct v2 low, high, sketch_low, sketch_high;
	MUST(piece->used);
	for (int i = 0; i < piece->point_count; i++)
		outline[i] = piece_to_sheet(piece, piece->point_mm[i]);
	bounds(outline, piece->point_count, &low, &high);
	bounds(sketch->point_mm, sketch->count, &sketch_low, &sketch_high);
	return (struct v2){0.5f * (low.x + high.x) + mm.x - 0.5f * (sketch_low.x + sketch_high.x),
			   low.y + mm.y - sketch_low.y};
}

static struct v2 sheet_px(const struct hand *hand, const struct sketch *sketch, int piece,
			  struct v2 mm)
{
	return view_sheet_px(&hand->kiosk->ui.view, sheet_mm(hand, sketch, piece, mm));
}

void visit_draw(struct hand *hand, const struct sketch *sketch, struct v2 centre_mm, float speed)
{
	static struct path path;
	const struct view *view = &hand->kiosk->ui.view;
	path.count = 0;
	path_add(&path, view_sheet_px(view, v2_add(centre_mm, sketch->point_mm[0])));
	for (int i = 1; i <= sketch->count; i++) {
		struct v2 to = sketch->point_mm[i % sketch->count];
		bool arc = v2_distance(to, sketch->point_mm[i - 1]) < 40.0f;
		path_line(&path, view_sheet_px(view, v2_add(centre_mm, to)), arc ? 1 : RUN_STEPS);
	}
	hand_stroke(hand, path.point, path.count, speed);
	hand_wait(hand, 0.2f);
}

void visit_copy(struct hand *hand)
{
	hand_tap_target(hand, TARGET_COPY);
	hand_tap_target(hand, TARGET_TURN_OVER);
}

void visit_dip(struct hand *hand, const struct sketch *sketch, int piece, float half_width_mm,
	       float dip_mm, float speed)
{
	static struct path path;
	struct sketch dip = {1, {{-half_width_mm, 0.0f}}};
	sketch_dip(&dip, half_width_mm, dip_mm);
	dip.point_mm[dip.count++] = (struct v2){half_width_mm, 0.0f};
	path.count = 0;
	for (int i = 0; i < dip.count; i++) {
		struct v2 mm = {dip.point_mm[i].x, dip.point_mm[i].y + sketch->point_mm[0].y};
		path_add(&path, sheet_px(hand, sketch, piece, mm));
	}
	hand_stroke(hand, path.point, path.count, speed);
	hand_wait(hand, 0.2f);
}

/* The middle of the edge that runs nearest to a place, on the screen. */
static struct v2 edge_px(const struct hand *hand, const struct sketch *sketch, int at, struct v2 mm)
{
	const struct piece *piece = piece_of(hand, at);
	int edge;
	float fraction;
	piece_nearest_edge(piece, piece_from_sheet(piece, sheet_mm(hand, sketch, at, mm)), &edge,
			   &fraction);
	struct v2 middle = piece_edge_point(piece, edge, 0.5f);
	return view_sheet_px(&hand->kiosk->ui.view, piece_to_sheet(piece, middle));
}

void visit_sew(struct hand *hand, const struct sketch *sketch, struct v2 middle_mm)
{
	for (int side = 0; side < 2; side++) {
		struct v2 mm = {side == 0 ? middle_mm.x : -middle_mm.x, middle_mm.y};
		struct v2 path[2] = {edge_px(hand, sketch, FRONT, mm),
				     edge_px(hand, sketch, BACK, mm)};
		hand_touch(hand, path[0]);
		hand_wait(hand, 0.1f);
		hand_follow(hand, path, 2, 900.0f);
		hand_wait(hand, 0.15f);
		hand_lift(hand);
	}
}

void visit_mark_cloth(struct hand *hand, const struct sketch *sketch, int piece, struct v2 from_mm,
		      struct v2 to_mm)
{
	struct v2 path[2] = {sheet_px(hand, sketch, piece, from_mm),
			     sheet_px(hand, sketch, piece, to_mm)};
	hand_stroke(hand, path, 2, mark_px_s);
	hand_wait(hand, 0.15f);
}

/* ---- on the body ---- */

void visit_mark_body(struct hand *hand, struct v2 from_m, struct v2 to_m, float toward_z)
{
	static struct path path;
	const struct session *session = &hand->kiosk->session;
	path.count = 0;
	for (int i = 0; i <= WAY_STEPS; i++) {
		struct v2 at = v2_lerp(from_m, to_m, (float)i / WAY_STEPS);
		struct body_hit hit;
		if (body_ray(&session->body, (struct v3){at.x, at.y, 5.0f * toward_z},
			     (struct v3){0.0f, 0.0f, -toward_z}, &hit))
			path_add(&path, visit_px(hand, hit.point_m));
	}
	hand_stroke(hand, path.point, path.count, mark_px_s);
	hand_wait(hand, 0.15f);
}

struct v2 visit_px(const struct hand *hand, struct v3 place_m)
{
	struct v2 px = {0.0f, 0.0f};
	float depth;
	MUST(view_project(&hand->kiosk->ui.view, place_m, &px, &depth));
	return px;
}

float visit_angle(struct v3 place_m)
{
	return angle_atan2(place_m.x, place_m.z) * 180.0f / PI_F;
}

struct v3 visit_round(const struct hand *hand, float degrees, float y_m)
{
	struct body_hit hit;
	float s = angle_sin(degrees * PI_F / 180.0f), c = angle_cos(degrees * PI_F / 180.0f);
	MUST(body_ray(&hand->kiosk->session.body, (struct v3){0.35f * s, y_m, 0.35f * c},
		      (struct v3){-s, 0.0f, -c}, &hit));
	return hit.point_m;
}

/* ---- the worn garment ---- */

void visit_rest(struct hand *hand, float seconds_max)
{
	for (float s = 0.0f; s < seconds_max && session_busy(&hand->kiosk->session); s += 0.1f)
		hand_wait(hand, 0.1f);
}

void visit_wrap(struct hand *hand)
{
	hand_button(hand, BUTTON_WRAP, 0.1f);
	hand_leave(hand);
	for (int i = 0; i < 100 && hand->kiosk->session.job != JOB_NONE; i++)
		hand_wait(hand, 0.1f);
	visit_rest(hand, 2.5f);
}

struct v3 visit_place(const struct hand *hand, const struct sketch *sketch, int at, struct v2 mm)
{
	const struct session *session = &hand->kiosk->session;
	struct v2 local = piece_from_sheet(piece_of(hand, at), sheet_mm(hand, sketch, at, mm));
	struct v3 place = {0.0f, 0.0f, 0.0f};
	float weight[3];
	int triangle = garment_locate(&session->garment, at, local, weight);
	MUST(triangle >= 0);
	for (int k = 0; k < 3; k++) {
		int v = session->garment.triangle[triangle].v[k];
		place = v3_mad(place, session->cloth.position_m[v], weight[k]);
	}
	return place;
}

static void pull_px(struct hand *hand, const struct v2 *path, int count)
{
	hand_touch(hand, path[0]);
	hand_follow(hand, path, count, pull_px_s);
	hand_wait(hand, 0.4f);
	hand_lift(hand);
	hand_wait(hand, 0.2f);
}

void visit_pull(struct hand *hand, const struct v3 *way_m, int count)
{
	struct v2 path[WAY_STEPS + 1];
	MUST(count <= COUNT_OF(path));
	for (int i = 0; i < count; i++)
		path[i] = visit_px(hand, way_m[i]);
	pull_px(hand, path, count);
}

void visit_pull_by(struct hand *hand, struct v3 from_m, struct v2 by_px)
{
	struct v2 from = visit_px(hand, from_m), path[2] = {from, v2_add(from, by_px)};
	pull_px(hand, path, 2);
}

void visit_pull_round(struct hand *hand, float y_m, float from_degrees, float to_degrees)
{
	struct v3 way[WAY_STEPS + 1];
	for (int i = 0; i <= WAY_STEPS; i++) {
		float share = (float)i / WAY_STEPS;
		way[i] = visit_round(hand, from_degrees + share * (to_degrees - from_degrees), y_m);
	}
	visit_pull(hand, way, WAY_STEPS + 1);
}

void visit_pin(struct hand *hand, struct v3 place_m)
{
	hand_move(hand, visit_px(hand, place_m));
	hand_wait(hand, 0.1f);
	hand_button(hand, BUTTON_PIN, 0.1f);
}

/* ---- */

void visit_say(const struct hand *hand, const char *what)
{
	const struct session *session = &hand->kiosk->session;
	int pieces = 0, seams = 0, cloth = 0, body = 0, pins = 0;
	for (int i = 0; i < PIECES_MAX; i++)
		pieces += session->document.pattern.piece[i].used;
	for (int i = 0; i < SEAMS_MAX; i++)
		seams += session->document.pattern.seam[i].used;
	for (int i = 0; i < MARKS_MAX; i++) {
		cloth += session->document.marks.cloth[i].used;
		body += session->document.marks.body[i].used;
	}
	for (int i = 0; i < PINS_MAX; i++)
		pins += session->document.pin[i].used;
	fprintf(stderr, "%6.2f s  %-14s step %d, %d pieces, %d seams, %d+%d marks, %d pins%s%s\n",
		(double)hand->now_us / 1e6, what, hand->kiosk->ui.step, pieces, seams, cloth, body,
		pins, session->notice[0] ? "; " : "", session->notice);
}
