/* Drags along the ways that are hard: over the head, round a limb and down it, of one garment over
 * another, and by more than the cloth gives. Looked at while the hand pulls: nothing is in the
 * body.
 */
#include "scene.h"
#include "test.h"

enum { LOOK_FRAMES = 3 };

struct worst {
	int looks, inside, edges_through;
	float strain_p95;
};

static struct scene *scene;
static struct measure_scratch *measurer;
static struct worst worst;

static void look(void)
{
	struct measure m;
	measure_garment(&m, &scene->session.cloth, measurer);
	worst.looks++;
	worst.inside = int_max(worst.inside,
			       m.vertices_inside + m.midpoints_inside + m.centres_inside);
	worst.edges_through = int_max(worst.edges_through, m.edge_crossings_body);
	worst.strain_p95 = float_max(worst.strain_p95, m.strain_p95);
}

static void frames(int count)
{
	for (int i = 0; i < count; i++) {
		session_advance(&scene->session);
		if (scene->session.drag.active && scene->session.frame % LOOK_FRAMES == 0)
			look();
	}
}

static void wear(const char *journal)
{
	CHECK(scene_edit(scene, EDIT_CLEAR));
	CHECK(scene_play(scene, journal) == 0);
	CHECK(scene_wrap(scene));
	worst = (struct worst){0};
	frames(150);
}

static struct v3 place(int piece, float x_mm, float y_mm)
{
	const struct session *session = &scene->session;
	struct v3 point = {0.0f, 0.0f, 0.0f};
	float weight[3];
	int t = garment_locate(&session->garment, piece, (struct v2){x_mm, y_mm}, weight);
	MUST(t >= 0);
	for (int k = 0; k < 3; k++)
		point = v3_mad(point, session->cloth.position_m[session->garment.triangle[t].v[k]],
			       weight[k]);
	return point;
}

static void grab(int piece, float x_mm, float y_mm)
{
	scene->edit.i[0] = piece;
	scene->edit.f[0] = x_mm;
	scene->edit.f[1] = y_mm;
	CHECK(scene_edit(scene, EDIT_GRAB));
}

/* The hand's target; where the body is near, it lies on it, as a pen's does. */
static void drag_to(struct v3 target_m, int count)
{
	struct body_hit hit;
	body_nearest(&scene->session.body, target_m, 0, &hit);
	if (hit.distance_m < 0.03f)
		target_m = hit.point_m;
	scene->edit.f[0] = target_m.x;
	scene->edit.f[1] = target_m.y;
	scene->edit.f[2] = target_m.z;
	CHECK(scene_edit(scene, EDIT_DRAG));
	frames(count);
}

/* At a pace that the cloth follows: 8 mm a frame. */
static void drag_along(const struct v3 *way_m, int count)
{
	for (int i = 0; i + 1 < count; i++) {
		int steps = 1 + (int)(v3_distance(way_m[i], way_m[i + 1]) / 0.008f);
		for (int step = 1; step <= steps; step++)
			drag_to(v3_lerp(way_m[i], way_m[i + 1], (float)step / (float)steps), 1);
	}
	frames(10);
}

static void let_go(void)
{
	CHECK(scene_edit(scene, EDIT_RELEASE));
	frames(120);
}

static void judge(const char *name, float strain_p95)
{
	struct measure m;
	measure_garment(&m, &scene->session.cloth, measurer);
	printf("%s: in %d looks at most %d inside, %d edges through, strain p95 %.3f; after %d, "
	       "%d, "
	       "%.3f\n",
	       name, worst.looks, worst.inside, worst.edges_through, (double)worst.strain_p95,
	       m.vertices_inside + m.midpoints_inside + m.centres_inside, m.edge_crossings_body,
	       (double)m.strain_p95);
	CHECK(worst.looks > 3 && worst.inside == 0 && worst.edges_through == 0);
	CHECK(worst.strain_p95 < strain_p95);
	CHECK(m.vertices_inside + m.midpoints_inside + m.centres_inside == 0);
	CHECK(m.edge_crossings_body == 0);
}

static float lowest_m(void)
{
	const struct session *session = &scene->session;
	float low = 9.0f;
	for (int v = 0; v < session->garment.vertex_count; v++)
		low = float_min(low, session->cloth.position_m[v].y);
	return low;
}

/* Does the collar go round the neck? */
static bool is_on(void)
{
	struct measure m;
	measure_garment(&m, &scene->session.cloth, measurer);
	return m.head_through_collar;
}

/* A poncho is pulled off over the head, its front and its back in turn, straight up
 * and then aside. */
static void check_over_head(void)
{
	float before_m, high_m = 0.0f;
	int strokes = 0;
	wear("tests/journals/poncho-wide.kitsuke");
	before_m = lowest_m();
	CHECK(is_on());
	for (; strokes < 4 && is_on(); strokes++) {
		int piece = strokes & 1;
		float z = piece == 0 ? 0.25f : -0.25f, y = -150.0f;
		struct v3 way[] = {place(piece, 0.0f, y),
				   {0.0f, 1.55f, z},
				   {0.0f, 1.8f, z},
				   {0.0f, 2.2f, 0.0f},
				   {0.6f, 2.1f, 0.0f}};
		grab(piece, 0.0f, y);
		drag_along(way, COUNT_OF(way));
		high_m = float_max(high_m, lowest_m());
		let_go();
	}
	printf("over the head: off after %d strokes; the lowest of it went from %.2f up to %.2f "
	       "m\n",
	       strokes, (double)before_m, (double)high_m);
	judge("over the head", 0.15f);
	CHECK(!is_on());
	CHECK(high_m > before_m + 0.4f);
}

/* The sleeve's front pulled up over the arm: what lay on top goes back over it. */
static void check_round_arm(void)
{
	wear("tests/journals/tshirt.kitsuke");
	struct v3 front = place(0, 290.0f, -190.0f), top = place(0, 330.0f, -121.0f);
	struct v3 way[] = {front, v3_lerp(front, top, 0.5f), place(0, 300.0f, -110.0f)};
	grab(0, 290.0f, -190.0f);
	drag_along(way, COUNT_OF(way));
	float up = 1e3f * v3_distance(place(0, 290.0f, -190.0f), front);
	float over = 1e3f * (top.z - place(0, 330.0f, -121.0f).z);
	let_go();
	printf("round the arm: front %.1f mm, top back by %.1f\n", (double)up, (double)over);
	judge("round the arm", 0.25f);
	CHECK(up > 40.0f && over > 10.0f);
}

/* The sleeve's hem pulled down the arm by more than the sleeve gives. */
static void check_down_arm(void)
{
	wear("tests/journals/tshirt.kitsuke");
	struct v3 hem = place(0, 330.0f, -215.0f), inner = place(0, 200.0f, -115.0f);
	struct v3 along = v3_normalize(v3_sub(hem, inner));
	struct v3 way[] = {hem, v3_mad(hem, along, 0.06f)};
	grab(0, 330.0f, -215.0f);
	drag_along(way, COUNT_OF(way));
	float moved = 1e3f * v3_dot(v3_sub(place(0, 330.0f, -215.0f), hem), along);
	let_go();
	printf("down the arm: %.1f mm of 60\n", (double)moved);
	judge("down the arm", 0.25f);
	CHECK(moved > 15.0f);
}

/* Of garments over one another the pen takes the outer one, and that alone goes with it. */
static void check_layers(void)
{
	wear("tests/journals/vest-over-tshirt.kitsuke");
	struct session *session = &scene->session;
	float weight[3], distance_m = 0.0f;
	struct v3 eye = {0.0f, 1.05f, 3.0f}, outer[2], inner[2];
	int t = cloth_ray(&session->cloth, eye, (struct v3){0.0f, 0.0f, -1.0f}, &distance_m,
			  weight);
	MUST(t >= 0);
	const int *v = session->garment.triangle[t].v;
	int piece = session->garment.piece[v[0]];
	CHECK(piece == 2);
	struct v3 start = {0.0f, 1.05f, 3.0f - distance_m};
	struct v3 way[] = {start, v3_add(start, (struct v3){0.06f, 0.0f, 0.0f})};
	outer[0] = place(2, 0.0f, -100.0f);
	inner[0] = place(0, 0.0f, -400.0f);
	struct v2 at = {0.0f, 0.0f};
	for (int k = 0; k < 3; k++)
		at = v2_add(at, v2_scale(session->garment.rest_m[v[k]], 1e3f * weight[k]));
	grab(piece, at.x, at.y);
	drag_along(way, COUNT_OF(way));
	outer[1] = place(2, 0.0f, -100.0f);
	inner[1] = place(0, 0.0f, -400.0f);
	float outer_mm = 1e3f * (outer[1].x - outer[0].x);
	float inner_mm = 1e3f * (inner[1].x - inner[0].x);
	let_go();
	printf("layers: the outer one went %.1f mm, the inner one %.1f\n", (double)outer_mm,
	       (double)inner_mm);
	judge("layers", 0.25f);
	CHECK(outer_mm > 35.0f && float_abs(inner_mm) < 0.4f * outer_mm);
}

/* What a drag has stretched shows on the meter, flows out while the pen pauses, and more of it when
 * the pen has let go; RELAX was never pressed. */
static void check_strain_left(void)
{
	wear("tests/journals/tshirt.kitsuke");
	float rest = scene->session.strain_left, most = 0.0f;
	struct v3 hem = place(0, 0.0f, -640.0f);
	grab(0, 0.0f, -640.0f);
	for (int step = 1; step <= 60; step++) {
		drag_to(v3_add(hem, (struct v3){0.0f, -0.0035f * (float)step, 0.0f}), 1);
		most = float_max(most, scene->session.strain_left);
	}
	float pulled = scene->session.strain_left;
	frames(90);
	float paused = scene->session.strain_left;
	let_go();
	float after = scene->session.strain_left;
	printf("strain left: %.3f, pulled %.3f (most %.3f), paused %.3f, let go %.3f\n",
	       (double)rest, (double)pulled, (double)most, (double)paused, (double)after);
	CHECK(most > rest + 0.05f);
	CHECK(paused < pulled - 0.1f * (pulled - rest));
	CHECK(after < rest + 0.04f);
}

int main(void)
{
	scene = scene_open();
	measurer = measure_init(&scene->arena);
	scene->session.vertices_wanted = 1600;
	check_over_head();
	check_round_arm();
	check_down_arm();
	check_layers();
	check_strain_left();
	scene_close(scene);
	return test_end();
}
