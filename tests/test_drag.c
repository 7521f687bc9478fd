/* Surface drag and pins: a tube turned round the trunk, a T-shirt pulled, fenced in and rolled up,
 * a poncho pulled over the shoulder. Motions in mm. */
#include "scene.h"
#include "test.h"

#include <string.h>

enum { VERTICES = 1000, RECOVER_FRAMES = 120, DRAG_FRAMES_MAX = 60 };

struct figures {
	int inside, inverted;
	float strain_p95;
};

static struct measure_scratch *measurer;

static struct figures figures_of(const struct scene *scene)
{
	struct measure m;
	measure_garment(&m, &scene->session.cloth, measurer);
	return (struct figures){m.vertices_inside, m.inverted_triangles, m.strain_p95};
}

static bool edit(struct scene *scene, enum edit_kind kind, int piece, float x, float y, float z)
{
	memset(&scene->edit, 0, sizeof scene->edit);
	scene->edit.i[0] = piece;
	scene->edit.f[0] = x;
	scene->edit.f[1] = y;
	scene->edit.f[2] = z;
	return scene_edit(scene, kind);
}

static struct v3 place(const struct scene *scene, int piece, float x_mm, float y_mm)
{
	const struct session *session = &scene->session;
	struct v3 point = {0.0f, 0.0f, 0.0f};
	float weight[3];
	int t = garment_locate(&session->garment, piece, (struct v2){x_mm, y_mm}, weight);
	MUST(t >= 0);
	for (int k = 0; k < 3; k++) {
		int particle = session->cloth.triangle[t].v[k];
		point = v3_mad(point, session->cloth.position_m[particle], weight[k]);
	}
	return point;
}

static void frames(struct scene *scene, int count)
{
	for (int i = 0; i < count; i++)
		session_advance(&scene->session);
}

static float mm(float metres)
{
	return metres * 1000.0f;
}

/* The target as the pen gives it: on the body where the cloth lies on it. */
static void pull(struct scene *scene, struct v3 target_m)
{
	struct body_hit hit;
	body_nearest(&scene->session.body, target_m, 0, &hit);
	if (hit.distance_m < 0.03f)
		target_m = v3_mad(hit.point_m, hit.normal, 0.004f);
	CHECK(edit(scene, EDIT_DRAG, 0, target_m.x, target_m.y, target_m.z));
	session_advance(&scene->session);
}

/* From where a point is to `by` (m) beside it within `moving` frames, then `waiting` frames. */
static void drag_by(struct scene *scene, int piece, struct v2 at_mm, struct v3 by, int moving,
		    int waiting)
{
	struct v3 start = place(scene, piece, at_mm.x, at_mm.y);
	CHECK(edit(scene, EDIT_GRAB, piece, at_mm.x, at_mm.y, 0.0f));
	MUST(moving + waiting <= DRAG_FRAMES_MAX);
	for (int i = 1; i <= moving + waiting; i++) {
		float share = i < moving ? (float)i / (float)moving : 1.0f;
		struct v3 before = drag_point(&scene->session.drag);
		pull(scene, v3_mad(start, by, share));
		/* never a jerk: the frame's step and what the sweeps give back at most */
		CHECK(v3_distance(before, drag_point(&scene->session.drag)) < 0.015f);
	}
}

static void release(struct scene *scene)
{
	CHECK(edit(scene, EDIT_RELEASE, 0, 0.0f, 0.0f, 0.0f));
	frames(scene, RECOVER_FRAMES);
}

/* ---- garments ---- */

static bool apply_line(struct scene *scene, const char *line)
{
	char fault[160];
	return journal_read(line, (int)strlen(line), &scene->edit, fault) == JOURNAL_EDIT &&
	       session_apply(&scene->session, &scene->edit);
}

/* A rectangle sewn to itself, laid round the hips as an elliptic tube: its middle in front. RELAX
 * lets the stretch of that shape flow out. */
static void lay_tube(struct scene *scene)
{
	struct session *session = &scene->session;
	static struct v3 position_m[GARMENT_VERTICES_MAX];
	static uint8_t placed[GARMENT_VERTICES_MAX];
	bool done = false;
	CHECK(edit(scene, EDIT_CLEAR, 0, 0.0f, 0.0f, 0.0f));
	CHECK(apply_line(scene, "piece tube 0 0 0 0 0 -480 0 1 -480 -220 1 480 -220 1 480 0 1"));
	CHECK(apply_line(scene, "sew 0 0 0 2 0"));
	const char *fault = garment_start(session->mesher, &session->garment,
					  &session->document.pattern, VERTICES);
	MUST(!fault);
	while (!done)
		garment_advance(session->mesher, 100000, &done);
	for (int v = 0; v < session->garment.vertex_count; v++) {
		struct v2 rest = session->garment.rest_m[v];
		float turn = rest.x / 0.960f * 2.0f * PI_F;
		position_m[v] = (struct v3){0.19f * angle_sin(turn), 1.03f + rest.y,
					    0.15f * angle_cos(turn)};
		placed[v] = 1;
	}
	cloth_restore(&session->cloth, &session->garment, &session->body, position_m, placed, true,
		      true);
	CHECK(edit(scene, EDIT_RELAX, 1, 0.0f, 0.0f, 0.0f));
	frames(scene, 40);
	CHECK(edit(scene, EDIT_RELAX, 0, 0.0f, 0.0f, 0.0f));
	frames(scene, 40);
}

struct worn {
	struct v3 position_m[GARMENT_VERTICES_MAX];
	uint8_t placed[GARMENT_VERTICES_MAX];
};

static void keep(const struct scene *scene, struct worn *worn)
{
	const struct cloth *cloth = &scene->session.cloth;
	memcpy(worn->position_m, cloth->position_m, sizeof worn->position_m);
	memcpy(worn->placed, cloth->placed, sizeof worn->placed);
}

/* The T-shirt as it was kept, without pins. */
static void put_back(struct scene *scene, const struct worn *worn)
{
	struct session *session = &scene->session;
	memset(session->document.pin, 0, sizeof session->document.pin);
	cloth_restore(&session->cloth, &session->garment, &session->body, worn->position_m,
		      worn->placed, true, true);
}

/* ---- checks ---- */

static void check_tube_turns(struct scene *scene)
{
	lay_tube(scene);
	struct v3 front = place(scene, 0, 0.0f, -110.0f), back = place(scene, 0, -475.0f, -110.0f);
	struct v3 left = place(scene, 0, 235.0f, -110.0f);
	struct figures before = figures_of(scene);
	drag_by(scene, 0, (struct v2){0.0f, -110.0f}, (struct v3){0.08f, 0.0f, 0.0f}, 10, 10);
	struct figures held = figures_of(scene);
	release(scene);
	struct figures after = figures_of(scene);
	float front_mm = mm(place(scene, 0, 0.0f, -110.0f).x - front.x);
	float back_mm = mm(place(scene, 0, -475.0f, -110.0f).x - back.x);
	float left_mm = mm(place(scene, 0, 235.0f, -110.0f).z - left.z);
	printf("tube: front %.1f back %.1f left %.1f mm; strain p95 %.3f, %.3f held, %.3f after\n",
	       (double)front_mm, (double)back_mm, (double)left_mm, (double)before.strain_p95,
	       (double)held.strain_p95, (double)after.strain_p95);
	CHECK(front_mm > 60.0f);
	CHECK(back_mm < -0.6f * 80.0f);
	CHECK(left_mm < -0.6f * 80.0f);
	CHECK(held.inside == 0 && after.inside == 0 && after.inverted == 0);
	CHECK(held.strain_p95 < before.strain_p95 + 0.03f);
	CHECK(after.strain_p95 < 0.10f);
}

static void check_pull(struct scene *scene, const struct worn *worn, const char *name, struct v3 by,
		       float least_mm)
{
	put_back(scene, worn);
	struct figures before = figures_of(scene);
	struct v3 start = place(scene, 0, 0.0f, -640.0f);
	drag_by(scene, 0, (struct v2){0.0f, -640.0f}, by, 20, 10);
	struct figures held = figures_of(scene);
	float moved_mm = mm(v3_distance(place(scene, 0, 0.0f, -640.0f), start));
	release(scene);
	struct figures after = figures_of(scene);
	printf("%s: moved %.1f mm; strain p95 %.3f, %.3f held, %.3f after; inverted %d, %d, %d\n",
	       name, (double)moved_mm, (double)before.strain_p95, (double)held.strain_p95,
	       (double)after.strain_p95, before.inverted, held.inverted, after.inverted);
	CHECK(moved_mm > least_mm);
	CHECK(held.inside == 0 && after.inside == 0);
	CHECK(held.strain_p95 < 0.20f);
	CHECK(after.strain_p95 < 0.10f);
	CHECK(after.inverted <= before.inverted + scene->session.garment.triangle_count / 50);
}

/* A pen that leaps 80 mm ahead is caught up with softly. */
static void check_tracking(struct scene *scene, const struct worn *worn)
{
	put_back(scene, worn);
	drag_by(scene, 0, (struct v2){0.0f, -640.0f}, (struct v3){0.08f, 0.0f, 0.0f}, 1, 9);
	float lag_mm = mm(
		v3_distance(drag_point(&scene->session.drag), scene->session.drag_target_m));
	printf("tracking: %.1f mm behind after 10 frames\n", (double)lag_mm);
	CHECK(lag_mm < 10.0f);
	CHECK(edit(scene, EDIT_RELEASE, 0, 0.0f, 0.0f, 0.0f));
}

struct spent {
	long units;
	int sweeps;
};

/* What the frame after the pen's touch costs within a budget, and the one after that. */
static void touch(struct scene *scene, const struct worn *worn, long budget, struct spent spent[2])
{
	struct session *session = &scene->session;
	long usual = session->budget_units;
	put_back(scene, worn);
	frames(scene, 5);
	session->budget_units = budget;
	CHECK(edit(scene, EDIT_GRAB, 0, 0.0f, -640.0f, 0.0f));
	for (int i = 0; i < 2; i++) {
		int before = session->cloth.sweep;
		frames(scene, 1);
		spent[i] = (struct spent){session->frame_units, session->cloth.sweep - before};
	}
	CHECK(edit(scene, EDIT_RELEASE, 0, 0.0f, 0.0f, 0.0f));
	session->budget_units = usual;
}

/* That frame pays for the graph: it sweeps the less, but never not at all. */
static void check_units(struct scene *scene, const struct worn *worn)
{
	long vertices = scene->session.garment.vertex_count;
	struct spent least[2], some[2];
	touch(scene, worn, 1, least);
	touch(scene, worn, least[1].units + 5 * vertices, some);
	printf("touch: %ld units, then %ld in frames of one sweep; %d and %d sweeps\n",
	       least[0].units, least[1].units, some[0].sweeps, some[1].sweeps);
	CHECK(least[0].sweeps == 1 && least[1].sweeps == 1);
	CHECK(least[0].units > least[1].units + 8 * vertices);
	CHECK(some[0].sweeps < some[1].sweeps);
}

/* What the pins leave of the motion at a place; -1: the graph does not reach it. */
static float share_at(const struct scene *scene, int piece, float x_mm, float y_mm)
{
	const struct session *session = &scene->session;
	float weight[3], share = 0.0f;
	int t = garment_locate(&session->garment, piece, (struct v2){x_mm, y_mm}, weight);
	MUST(t >= 0);
	for (int k = 0; k < 3; k++) {
		int particle = session->cloth.triangle[t].v[k];
		if (session->drag.distance_m[particle] < 0.0f)
			return -1.0f;
		share += weight[k] * session->drag.share[particle];
	}
	return share;
}

/* The graph ends at the fence (S12), and half way to it three quarters of the motion are left
 * (S16).
 */
static void check_shares(const struct scene *scene)
{
	for (float y_mm = -340.0f; y_mm < -200.0f; y_mm += 20.0f)
		for (int piece = 0; piece < 2; piece++)
			CHECK(share_at(scene, piece, 0.0f, y_mm) < 0.0f);
	CHECK_NEAR(share_at(scene, 0, 0.0f, -640.0f), 1.0f, 0.02f);
	CHECK_NEAR(share_at(scene, 0, 0.0f, -520.0f), 0.75f, 0.1f);
	float near_pin = share_at(scene, 0, 0.0f, -460.0f);
	CHECK(near_pin > 0.2f && near_pin < 0.65f);
}

/* Pins 47 mm apart all round the waist: what lies above them stays. */
static void check_fence(struct scene *scene, const struct worn *worn)
{
	struct v3 behind[3], pinned[22];
	float most_mm = 0.0f, pin_mm = 0.0f;
	put_back(scene, worn);
	for (int i = 0; i < 22; i++) {
		float x_mm = -235.0f + 47.0f * (float)(i % 11);
		pinned[i] = place(scene, i / 11, x_mm, -400.0f);
		CHECK(edit(scene, EDIT_PIN, i / 11, x_mm, -400.0f, 0.0f));
	}
	for (int i = 0; i < 3; i++)
		behind[i] = place(scene, i / 2, 100.0f * (float)i, -320.0f);
	drag_by(scene, 0, (struct v2){0.0f, -640.0f}, (struct v3){0.08f, 0.0f, 0.0f}, 10, 10);
	check_shares(scene);
	for (int i = 0; i < 3; i++) {
		struct v3 now = place(scene, i / 2, 100.0f * (float)i, -320.0f);
		most_mm = float_max(most_mm, mm(v3_distance(now, behind[i])));
	}
	for (int round = 0; round < 2; round++) {
		for (int i = 0; i < 22; i++) {
			float x_mm = -235.0f + 47.0f * (float)(i % 11);
			struct v3 now = place(scene, i / 11, x_mm, -400.0f);
			pin_mm = float_max(pin_mm, mm(v3_distance(now, pinned[i])));
		}
		if (round == 0)
			release(scene);
	}
	printf("fence: %.1f mm behind it, pins %.1f mm\n", (double)most_mm, (double)pin_mm);
	CHECK(most_mm < 8.0f);
	CHECK(pin_mm < 3.0f);
}

/* Four pins at the shoulder, and the sleeve's hem pushed up the arm. */
static void check_roll_up(struct scene *scene, const struct worn *worn)
{
	static const float pin_mm[4][3] = {{0.0f, 190.0f, -70.0f},
					   {0.0f, 210.0f, -130.0f},
					   {1.0f, -190.0f, -70.0f},
					   {1.0f, -210.0f, -130.0f}};
	struct v3 pinned[4];
	put_back(scene, worn);
	for (int i = 0; i < 4; i++) {
		int piece = (int)pin_mm[i][0];
		pinned[i] = place(scene, piece, pin_mm[i][1], pin_mm[i][2]);
		CHECK(edit(scene, EDIT_PIN, piece, pin_mm[i][1], pin_mm[i][2], 0.0f));
	}
	struct v3 hem = place(scene, 0, 360.0f, -160.0f);
	struct v3 way = v3_sub(place(scene, 0, 170.0f, -60.0f), hem);
	drag_by(scene, 0, (struct v2){360.0f, -160.0f}, v3_scale(v3_normalize(way), 0.09f), 15, 5);
	float held_mm = mm(v3_distance(place(scene, 0, 360.0f, -160.0f), hem));
	release(scene);
	float after_mm = mm(v3_distance(place(scene, 0, 360.0f, -160.0f), hem));
	struct measure m;
	measure_garment(&m, &scene->session.cloth, measurer);
	printf("roll-up: hem %.1f mm, %.1f released; strain p95 %.3f; inverted %d; arms %d\n",
	       (double)held_mm, (double)after_mm, (double)m.strain_p95, m.inverted_triangles,
	       m.arms_in_sleeves);
	CHECK(held_mm > 75.0f);
	CHECK(after_mm > 35.0f);
	CHECK(m.vertices_inside == 0 && m.arms_in_sleeves == 2 && m.strain_p95 < 0.12f);
	CHECK(m.inverted_triangles < scene->session.garment.triangle_count / 15);
	for (int i = 0; i < 4; i++) {
		struct v3 now = place(scene, (int)pin_mm[i][0], pin_mm[i][1], pin_mm[i][2]);
		CHECK(mm(v3_distance(now, pinned[i])) < 3.0f);
	}
}

/* A poncho's front pulled up to the shoulder: its back goes down behind, because the motion turns
 * with the body over the shoulder. */
static void check_over_shoulder(struct scene *scene)
{
	CHECK(edit(scene, EDIT_CLEAR, 0, 0.0f, 0.0f, 0.0f));
	CHECK(scene_play(scene, "tests/journals/poncho-wide.kitsuke") == 0);
	CHECK(scene_wrap(scene));
	frames(scene, 200);
	struct v3 way[9], back = place(scene, 1, -150.0f, -200.0f);
	for (int i = 0; i < COUNT_OF(way); i++)
		way[i] = place(scene, 0, 150.0f, -200.0f + 20.0f * (float)i);
	CHECK(edit(scene, EDIT_GRAB, 0, 150.0f, -200.0f, 0.0f));
	for (int i = 0; i < COUNT_OF(way); i++) {
		CHECK(edit(scene, EDIT_DRAG, 0, way[i].x, way[i].y, way[i].z));
		frames(scene, 4);
	}
	struct figures held = figures_of(scene);
	float up_mm = mm(place(scene, 0, 150.0f, -200.0f).y - way[0].y);
	float down_mm = mm(back.y - place(scene, 1, -150.0f, -200.0f).y);
	printf("over the shoulder: front up %.1f mm, back down %.1f; strain p95 %.3f held\n",
	       (double)up_mm, (double)down_mm, (double)held.strain_p95);
	CHECK(up_mm > 140.0f && down_mm > 50.0f);
	CHECK(held.inside == 0 && held.strain_p95 < 0.05f);
	CHECK(edit(scene, EDIT_RELEASE, 0, 0.0f, 0.0f, 0.0f));
}

int main(void)
{
	static struct worn worn;
	struct scene *scene = scene_open();
	measurer = measure_init(&scene->arena);
	check_tube_turns(scene);
	CHECK(edit(scene, EDIT_CLEAR, 0, 0.0f, 0.0f, 0.0f));
	CHECK(scene_play(scene, "tests/journals/tshirt.kitsuke") == 0);
	scene->session.vertices_wanted = VERTICES;
	CHECK(scene_wrap(scene));
	frames(scene, 60);
	keep(scene, &worn);
	check_pull(scene, &worn, "right", (struct v3){0.10f, 0.0f, 0.0f}, 75.0f);
	check_pull(scene, &worn, "up", (struct v3){0.0f, 0.10f, 0.0f}, 85.0f);
	check_pull(scene, &worn, "down", (struct v3){0.0f, -0.10f, 0.0f}, 15.0f);
	check_tracking(scene, &worn);
	check_units(scene, &worn);
	check_fence(scene, &worn);
	check_roll_up(scene, &worn);
	check_over_shoulder(scene);
	scene_close(scene);
	return test_end();
}
