/* Writes the bundled tape: one visit, from an empty sheet to a T-shirt with a rolled sleeve.
 *
 *   hand TAPE [SEED]
 *
 * Everything goes through the pen and the three buttons, as a visitor would; the hand knows where
 * to draw because it sees the running program's state, as a visitor sees the screen. */
#include "hand.h"

#include <inttypes.h>
#include <stdlib.h>

enum { WIDTH_PX = 1280, HEIGHT_PX = 720, PATH_MAX_POINTS = 1024, FRONT = 0, BACK = 1 };

static const float DRAWING_SPEED = 220.0f; /* pixels a second: with care, as outlines are drawn */

/* The shirt's right half seen from outside, in mm from the pit of the neck, y up; mirrored in x for
 * the other half. Straight runs, but for the neckline. */
static const struct v2 half_shirt_mm[] = {
	{82.0f, 0.0f},     /* neck side */
	{426.0f, -264.0f}, /* sleeve end, above */
	{318.0f, -404.0f}, /* sleeve end, below */
	{242.0f, -344.0f}, /* underarm */
	{250.0f, -680.0f}, /* hem */
};

struct path {
	int count;
	struct v2 point[PATH_MAX_POINTS];
};

static void path_add(struct path *path, struct v2 point)
{
	MUST(path->count < PATH_MAX_POINTS);
	path->point[path->count++] = point;
}

static void path_line(struct path *path, struct v2 to, int steps)
{
	struct v2 from = path->point[path->count - 1];
	for (int i = 1; i <= steps; i++)
		path_add(path, v2_lerp(from, to, (float)i / (float)steps));
}

static struct v2 sheet_px(const struct hand *hand, struct v2 centre_mm, struct v2 mm)
{
	return view_sheet_px(&hand->kiosk->ui.view, v2_add(centre_mm, mm));
}

/* The neckline: an arc of `depth` below the line between the neck's sides. */
static void path_neck(struct path *path, const struct hand *hand, struct v2 centre_mm, float depth)
{
	for (int i = 1; i <= 24; i++) {
		float angle = PI_F * (1.0f - (float)i / 24.0f);
		path_add(path, sheet_px(hand, centre_mm,
					(struct v2){half_shirt_mm[0].x * angle_cos(angle),
						    -depth * angle_sin(angle)}));
	}
}

static void draw_shirt(struct hand *hand, struct v2 centre_mm, float neck_depth)
{
	static struct path path;
	path.count = 0;
	path_add(&path, sheet_px(hand, centre_mm, (struct v2){-half_shirt_mm[0].x, 0.0f}));
	path_neck(&path, hand, centre_mm, neck_depth);
	for (int i = 1; i < COUNT_OF(half_shirt_mm); i++)
		path_line(&path, sheet_px(hand, centre_mm, half_shirt_mm[i]), 12);
	for (int i = COUNT_OF(half_shirt_mm) - 1; i >= 0; i--) {
		struct v2 left = {-half_shirt_mm[i].x, half_shirt_mm[i].y};
		path_line(&path, sheet_px(hand, centre_mm, left), 12);
	}
	hand_stroke(hand, path.point, path.count, DRAWING_SPEED);
	hand_wait(hand, 0.2f);
}

/* Redraws the neckline of the back, which is less deep: over the old line from corner to corner. */
static void redraw_neck(struct hand *hand, struct v2 centre_mm, float neck_depth)
{
	static struct path path;
	path.count = 0;
	path_add(&path, sheet_px(hand, centre_mm, (struct v2){-half_shirt_mm[0].x, 0.0f}));
	path_neck(&path, hand, centre_mm, neck_depth);
	hand_stroke(hand, path.point, path.count, 0.7f * DRAWING_SPEED);
	hand_wait(hand, 0.2f);
}

/* ---- sewing ---- */

static const struct piece *piece_of(const struct hand *hand, int piece)
{
	return &hand->kiosk->session.document.pattern.piece[piece];
}

/* The middle of the edge that runs nearest to a place of the shirt, on the screen. */
static struct v2 edge_px(const struct hand *hand, int at, struct v2 middle_mm)
{
	const struct piece *piece = piece_of(hand, at);
	struct v2 low = {1e9f, 1e9f}, high = {-1e9f, -1e9f};
	for (int i = 0; i < piece->point_count; i++) {
		struct v2 p = piece_to_sheet(piece, piece->point_mm[i]);
		low = (struct v2){float_min(low.x, p.x), float_min(low.y, p.y)};
		high = (struct v2){float_max(high.x, p.x), float_max(high.y, p.y)};
	}
	struct v2 sheet = {0.5f * (low.x + high.x) + middle_mm.x,
			   low.y - half_shirt_mm[COUNT_OF(half_shirt_mm) - 1].y + middle_mm.y};
	int edge;
	float fraction;
	piece_nearest_edge(piece, piece_from_sheet(piece, sheet), &edge, &fraction);
	struct v2 middle = piece_edge_point(piece, edge, 0.5f);
	return view_sheet_px(&hand->kiosk->ui.view, piece_to_sheet(piece, middle));
}

static void sew_run(struct hand *hand, int from, float side)
{
	struct v2 middle = v2_lerp(half_shirt_mm[from], half_shirt_mm[from + 1], 0.5f);
	middle.x *= side;
	struct v2 path[2] = {edge_px(hand, FRONT, middle), edge_px(hand, BACK, middle)};
	hand_touch(hand, path[0]);
	hand_wait(hand, 0.1f);
	hand_follow(hand, path, 2, 900.0f);
	hand_wait(hand, 0.15f);
	hand_lift(hand);
}

static void sew_shirt(struct hand *hand)
{
	static const int run[] = {0, 2, 3}; /* shoulder, underarm, side */
	for (int i = 0; i < COUNT_OF(run); i++) {
		sew_run(hand, run[i], 1.0f);
		sew_run(hand, run[i], -1.0f);
	}
}

/* ---- marks ---- */

/* A straight line on a piece, in mm of the shirt. */
static void mark_cloth(struct hand *hand, int at, struct v2 from_mm, struct v2 to_mm)
{
	const struct piece *piece = piece_of(hand, at);
	struct v2 hem = edge_px(hand, at, (struct v2){0.0f, half_shirt_mm[4].y});
	float scale = hand->kiosk->ui.view.sheet_px_per_mm;
	float turn = piece->inside_up ? -1.0f : 1.0f;
	struct v2 origin = {hem.x, hem.y + half_shirt_mm[4].y * scale};
	struct v2 path[2] = {{origin.x + turn * from_mm.x * scale, origin.y - from_mm.y * scale},
			     {origin.x + turn * to_mm.x * scale, origin.y - to_mm.y * scale}};
	hand_stroke(hand, path, 2, 200.0f);
	hand_wait(hand, 0.15f);
}

/* A line on the body as seen from the front: through these places (x, y in metres). */
static void mark_body(struct hand *hand, struct v2 from_m, struct v2 to_m)
{
	static struct path path;
	const struct session *session = &hand->kiosk->session;
	path.count = 0;
	for (int i = 0; i <= 24; i++) {
		struct v2 at = v2_lerp(from_m, to_m, (float)i / 24.0f);
		struct body_hit hit;
		struct v2 px;
		float depth;
		if (body_ray(&session->body, (struct v3){at.x, at.y, 5.0f},
			     (struct v3){0.0f, 0.0f, -1.0f}, &hit) &&
		    view_project(&hand->kiosk->ui.view, hit.point_m, &px, &depth))
			path_add(&path, px);
	}
	hand_stroke(hand, path.point, path.count, 180.0f);
	hand_wait(hand, 0.15f);
}

/* ---- dressing ---- */

static struct v2 worn_px(const struct hand *hand, int at, struct v2 shirt_mm)
{
	const struct session *session = &hand->kiosk->session;
	const struct piece *piece = piece_of(hand, at);
	struct v2 low = {0.0f, 0.0f}, px = {0.0f, 0.0f};
	float left = 1e9f, right = -1e9f, weight[3], depth;
	for (int i = 0; i < piece->point_count; i++) {
		low.y = float_min(low.y, piece->point_mm[i].y);
		left = float_min(left, piece->point_mm[i].x);
		right = float_max(right, piece->point_mm[i].x);
	}
	struct v2 local = {0.5f * (left + right) + shirt_mm.x,
			   low.y - half_shirt_mm[4].y + shirt_mm.y};
	int triangle = garment_locate(&session->garment, at, local, weight);
	struct v3 place = {0.0f, 0.0f, 0.0f};
	for (int k = 0; triangle >= 0 && k < 3; k++) {
		int v = session->garment.triangle[triangle].v[k];
		place = v3_mad(place, session->cloth.position_m[v], weight[k]);
	}
	view_project(&hand->kiosk->ui.view, place, &px, &depth);
	return px;
}

static void pull(struct hand *hand, struct v2 shirt_mm, struct v2 by_px)
{
	struct v2 from = worn_px(hand, FRONT, shirt_mm);
	struct v2 path[2] = {from, v2_add(from, by_px)};
	hand_touch(hand, from);
	hand_follow(hand, path, 2, 160.0f);
	hand_wait(hand, 0.3f);
	hand_lift(hand);
}

static void wait_for_wrap(struct hand *hand)
{
	for (int i = 0; i < 100; i++) {
		hand_wait(hand, 0.1f);
		if (hand->kiosk->session.job == JOB_NONE)
			return;
	}
}

/* Pins by the real button: the pen hovers over the place, the button is pressed. */
static void pin_at(struct hand *hand, struct v2 shirt_mm)
{
	hand_move(hand, worn_px(hand, FRONT, shirt_mm));
	hand_wait(hand, 0.1f);
	hand_button(hand, BUTTON_PIN, 0.1f);
}

static void say(const struct hand *hand, const char *what)
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
	fprintf(stderr, "%6.2f s  %-12s step %d, %d pieces, %d seams, %d+%d marks, %d pins%s%s\n",
		(double)hand->now_us / 1e6, what, hand->kiosk->ui.step, pieces, seams, cloth, body,
		pins, session->notice[0] ? "; " : "", session->notice);
}

/* The visit: read this first. */
static void visit(struct hand *hand)
{
	hand_wait(hand, 0.3f);
	struct v2 front_mm = {-110.0f, 600.0f};
	draw_shirt(hand, front_mm, 92.0f);
	say(hand, "front");
	hand_tap_target(hand, TARGET_COPY);
	hand_tap_target(hand, TARGET_TURN_OVER);
	struct v2 back_mm = view_sheet_mm(
		&hand->kiosk->ui.view, edge_px(hand, BACK, (struct v2){0.0f, half_shirt_mm[4].y}));
	back_mm.y -= half_shirt_mm[4].y;
	redraw_neck(hand, back_mm, 30.0f);
	say(hand, "back");

	hand_tap_target(hand, TARGET_STEP_SEW);
	sew_shirt(hand);
	say(hand, "sewn");

	hand_tap_target(hand, TARGET_STEP_MARK);
	hand_tap_target(hand, TARGET_LASER);
	mark_body(hand, (struct v2){0.0f, 1.32f}, (struct v2){0.0f, 0.90f});
	hand_tap_target(hand, TARGET_LASER);
	mark_cloth(hand, FRONT, (struct v2){0.0f, -140.0f}, (struct v2){0.0f, -560.0f});
	mark_cloth(hand, BACK, (struct v2){0.0f, -140.0f}, (struct v2){0.0f, -560.0f});
	say(hand, "marked");

	hand_button(hand, BUTTON_WRAP, 0.1f);
	hand_leave(hand);
	wait_for_wrap(hand);
	say(hand, "wrapped");
	hand_wait(hand, 1.5f);

	hand_tap_target(hand, TARGET_STEP_ADJUST);
	pull(hand, (struct v2){60.0f, -640.0f}, (struct v2){24.0f, 5.0f});
	hand_wait(hand, 0.5f);
	say(hand, "hem pulled");

	pin_at(hand, (struct v2){190.0f, -115.0f});
	pin_at(hand, (struct v2){200.0f, -240.0f});
	pull(hand, (struct v2){362.0f, -340.0f}, (struct v2){-16.0f, -24.0f});
	hand_wait(hand, 0.5f);
	say(hand, "sleeve rolled");

	hand_leave(hand);
	hand_button(hand, BUTTON_RELAX, 1.2f);
	hand_wait(hand, 1.5f);
	say(hand, "relaxed");
}

int main(int argc, char **argv)
{
	struct kiosk *kiosk = malloc(sizeof *kiosk);
	struct hand *hand = malloc(sizeof *hand);
	void *memory = malloc(KIOSK_MEMORY_BYTES);
	FILE *tape = argc > 1 ? fopen(argv[1], "wb") : NULL;
	if (!kiosk || !hand || !memory || !tape) {
		fprintf(stderr, "usage: hand TAPE [SEED]\n");
		return EXIT_FAILURE;
	}
	kiosk_init(kiosk, memory, WIDTH_PX, HEIGHT_PX);
	const char *fault = body_build_mannequin(&kiosk->session.body);
	MUST(!fault);
	body_find_parts(&kiosk->session.body);
	hand_begin(hand, kiosk, tape, WIDTH_PX, HEIGHT_PX,
		   argc > 2 ? (uint32_t)strtoul(argv[2], NULL, 10) : 1);
	visit(hand);
	hand_end(hand);
	fprintf(stderr, "%d frames, hash %016" PRIx64 "\n", kiosk->frame,
		session_hash(&kiosk->session));
	return fclose(tape) == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
