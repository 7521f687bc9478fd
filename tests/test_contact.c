/* What the cloth believes of the body, against exact queries of every vertex of every frame; and
 * cloth thrown at a thin arm. */
#include "drapes.h"
#include "test.h"

enum {
	PONCHO_VERTICES = 3000,
	PONCHO_FRAMES = 200,
	THROW_FRAMES = 12,
	QUERIES_PER_MISTAKE = 100000, /* of more than 1 mm; none of 5 mm */
};

static const float throw_m = 0.06f; /* a frame: 3.6 m/s */

struct count {
	const char *name;
	long queries, off_1mm, off_5mm, near_missed;
	double worst_m;
};

static unsigned parts_of(const struct cloth *cloth, int v)
{
	return cloth->settings.filter_parts ? cloth->piece_parts[cloth->garment->piece[v]] : 0;
}

/* Contact works with planes: their distances count. Farther than BODY_NEAR_M nothing is promised
 * but that the cloth knows it to be far. */
static void compare(void *context, const struct cloth *cloth)
{
	struct count *count = context;
	struct body_hit hit;
	for (int v = 0; v < cloth->garment->vertex_count; v++) {
		if (!cloth->placed[v] || cloth->particle[v] != v)
			continue;
		const struct contact *contact = &cloth->contact[v];
		struct v3 p = cloth->position_m[v];
		float known_m = v3_dot(v3_sub(p, contact->point_m), contact->normal);
		body_nearest(cloth->body, p, parts_of(cloth, v), &hit);
		if (hit.distance_m > BODY_NEAR_M) {
			count->near_missed += contact->distance_m < 0.5f * BODY_NEAR_M;
			continue;
		}
		double off = (double)float_abs(known_m - hit.distance_m);
		count->queries++;
		count->off_1mm += off > 1e-3;
		count->off_5mm += off > 5e-3;
		count->worst_m = off > count->worst_m ? off : count->worst_m;
	}
}

static void report(const struct count *count)
{
	printf("%s: %ld of %ld off by more than 1 mm, %ld by 5 mm; worst %.2f mm\n", count->name,
	       count->off_1mm, count->queries, count->off_5mm, 1e3 * count->worst_m);
	CHECK(count->queries > 30000);
	CHECK(count->off_1mm <= count->queries / QUERIES_PER_MISTAKE);
	CHECK(count->off_5mm == 0);
	CHECK(count->near_missed == 0);
}

static void test_drapes(struct scene *scene)
{
	struct count shirt = {.name = "T-shirt"}, poncho = {.name = "poncho"};
	drape_shirt(scene, compare, &shirt);
	report(&shirt);
	drape_poncho(scene, PONCHO_VERTICES, PONCHO_FRAMES, compare, &poncho);
	report(&poncho);
}

/* ---- tunnelling ---- */

static struct v3 forearm(const struct body *body)
{
	struct v3 outermost = {0.0f, 0.0f, 0.0f};
	for (int b = 0; b < body->bone_count; b++) {
		struct v3 middle = v3_lerp(body->bone[b].a_m, body->bone[b].b_m, 0.5f);
		if (body->bone[b].part == PART_ARM_LEFT && middle.x > outermost.x)
			outermost = middle;
	}
	return outermost;
}

/* A patch before the arm, upright; its outside looks the way it came from. */
static void lay_patch(struct scene *scene, struct v3 centre)
{
	struct session *session = &scene->session;
	struct garment *garment = &session->garment;
	struct cloth *cloth = &session->cloth;
	struct pattern *pattern = &session->document.pattern;
	bool done = false;
	memset(pattern, 0, sizeof *pattern);
	pattern->piece[0] = (struct piece){
		.used = true,
		.point_count = 4,
		.point_mm = {{-150.0f, -150.0f},
			     {150.0f, -150.0f},
			     {150.0f, 150.0f},
			     {-150.0f, 150.0f}},
		.corner = {true, true, true, true},
	};
	MUST(!garment_start(session->mesher, garment, pattern, 900));
	while (!done)
		garment_advance(session->mesher, 1 << 20, &done);
	cloth_reset(cloth, garment, &session->body);
	for (int v = 0; v < garment->vertex_count; v++) {
		struct v2 p = garment->rest_m[v];
		cloth->position_m[v] = v3_add(centre, (struct v3){p.x, p.y, 0.12f});
		cloth->previous_m[v] = cloth->position_m[v];
		cloth->placed[v] = 1;
	}
	for (int sweep = 0; sweep < 2; sweep++)
		cloth_sweep(cloth);
}

/* Everything is carried on by throw_m a frame, as a hand would; then one sweep only, as if the
 * budget had ended there. */
static void test_throw(struct scene *scene)
{
	static struct v3 before[GARMENT_VERTICES_MAX];
	struct cloth *cloth = &scene->session.cloth;
	struct body_hit hit;
	int passed = 0, inside = 0, stopped = 0;
	struct v3 arm = forearm(&scene->session.body);
	lay_patch(scene, arm);
	for (int f = 0; f < THROW_FRAMES; f++) {
		memcpy(before, cloth->position_m, sizeof before);
		for (int v = 0; v < cloth->garment->vertex_count; v++)
			cloth->position_m[v].z -= throw_m;
		cloth_sweep(cloth);
		for (int v = 0; v < cloth->garment->vertex_count; v++) {
			struct v3 p = cloth->position_m[v];
			passed += body_segment_hits(cloth->body, before[v], p, &hit);
			body_nearest(cloth->body, p, 0, &hit);
			inside += hit.distance_m < 0.0f;
			stopped += f == THROW_FRAMES - 1 && p.z > arm.z;
		}
	}
	printf("thrown: %d passed, %d inside, %d still before the arm\n", passed, inside, stopped);
	CHECK(passed == 0);
	CHECK(inside == 0);
	CHECK(stopped > 20);
}

int main(void)
{
	struct scene *scene = scene_open();
	test_drapes(scene);
	test_throw(scene);
	scene_close(scene);
	return test_end();
}
