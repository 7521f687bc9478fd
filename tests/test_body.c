/* The body's mesh: what is refused and why; nearest points, walks and rays against answers that are
 * known in closed form or found by trying every triangle. */
#include "shapes.h"
#include "test.h"

#include <math.h>

static struct body body;
static struct shape shape;

static const char *build(void)
{
	return body_build(&body, shape.position_m, shape.vertex_count, shape.triangle,
			  shape.triangle_count);
}

static float radius_round(int ring, int column)
{
	(void)ring, (void)column;
	return 0.5f;
}

/* Spikes: alternate vertices lie three times farther out, so that edges and vertices are sharp,
 * convex and concave. */
static float radius_spiked(int ring, int column)
{
	return (ring + column) % 2 ? 0.6f : 0.2f;
}

/* ---- what is refused ---- */

static void spoil_empty(void)
{
	shape.vertex_count = shape.triangle_count = 0;
}

static void spoil_index(void)
{
	shape.triangle[3].v[1] = shape.vertex_count;
}

static void spoil_negative(void)
{
	shape.triangle[3].v[1] = -1;
}

static void spoil_twice(void)
{
	shape.triangle[3].v[1] = shape.triangle[3].v[2];
}

static void spoil_nan(void)
{
	shape.position_m[4].y = NAN;
}

static void spoil_infinite(void)
{
	shape.position_m[4].z = -INFINITY;
}

static void spoil_far(void)
{
	shape.position_m[4].x = 3e7f;
}

static void spoil_open(void)
{
	shape.triangle_count--;
}

static void spoil_fin(void)
{
	int v = shape_vertex(&shape, 3.0f, 0.0f, 0.0f);
	shape_triangle(&shape, 0, 1, v);
}

static void spoil_one_turned(void)
{
	struct triangle *t = &shape.triangle[5];
	*t = (struct triangle){{t->v[0], t->v[2], t->v[1]}};
}

static void spoil_flat(void)
{
	for (int v = 0; v < shape.vertex_count; v++)
		shape.position_m[v].z = 0.0f;
}

static void spoil_many(void)
{
	shape.vertex_count = BODY_VERTICES_MAX + 1;
}

static void test_faults(void)
{
	static const struct {
		void (*spoil)(void);
		const char *words;
	} cases[] = {{spoil_empty, "no closed surface"},
		     {spoil_index, "does not exist"},
		     {spoil_negative, "does not exist"},
		     {spoil_twice, "twice"},
		     {spoil_nan, "not a number"},
		     {spoil_infinite, "not a number"},
		     {spoil_far, "100 m"},
		     {spoil_open, "open"},
		     {spoil_fin, "more than two"},
		     {spoil_one_turned, "opposite ways"},
		     {spoil_flat, "no volume"},
		     {spoil_many, "too many"}};
	for (int i = 0; i < COUNT_OF(cases); i++) {
		shape_box(&shape, 0.5f, 0.8f, 0.3f);
		cases[i].spoil();
		const char *fault = build();
		CHECK(fault && strstr(fault, cases[i].words));
		if (fault && !strstr(fault, cases[i].words))
			fprintf(stderr, "case %d says: %s\n", i, fault);
		CHECK(body.triangle_count == 0);
	}
}

/* ---- what is built ---- */

static void test_structure(void)
{
	shape_globe(&shape, 40, 60, radius_round);
	CHECK(!build());
	CHECK(body.vertex_count == shape.vertex_count);
	for (int v = 0; v < body.vertex_count; v++) {
		struct v3 out = v3_normalize(body.position_m[v]);
		CHECK(v3_dot(out, body.normal[v]) > 0.999f);
		for (int i = body.star_first[v]; i < body.star_first[v + 1]; i++) {
			const int *c = body.triangle[body.star[i]].v;
			CHECK(c[0] == v || c[1] == v || c[2] == v);
		}
	}
	CHECK(body.star_first[body.vertex_count] == 3 * body.triangle_count);
	for (int t = 0; t < body.triangle_count; t++)
		for (int k = 0; k < 3; k++) {
			const int *other = &body.neighbour[3 * body.neighbour[3 * t + k]];
			CHECK(other[0] == t || other[1] == t || other[2] == t);
		}
}

/* A body that is inside out as a whole is turned; its hash is that of the sound one. */
static void test_turned(void)
{
	shape_globe(&shape, 8, 12, radius_round);
	CHECK(!build());
	uint64_t hash = body.hash;
	for (int t = 0; t < shape.triangle_count; t++) {
		int *v = shape.triangle[t].v;
		int swap = v[1];
		v[1] = v[2];
		v[2] = swap;
	}
	CHECK(!build());
	CHECK(body.hash == hash);
	struct body_hit hit;
	body_nearest(&body, (struct v3){0.0f, 0.0f, 0.0f}, 0, &hit);
	CHECK(hit.distance_m < -0.4f);
	shape.position_m[5].x += 1e-4f;
	CHECK(!build());
	CHECK(body.hash != hash);
}

/* ---- nearest points ---- */

static double box_distance(struct v3 p, double x, double y, double z)
{
	double dx = fabs((double)p.x) - x, dy = fabs((double)p.y) - y, dz = fabs((double)p.z) - z;
	double ox = fmax(dx, 0.0), oy = fmax(dy, 0.0), oz = fmax(dz, 0.0);
	return sqrt(ox * ox + oy * oy + oz * oz) + fmin(fmax(dx, fmax(dy, dz)), 0.0);
}

static void test_box(void)
{
	struct scatter scatter = {12345};
	struct body_hit hit;
	shape_box(&shape, 0.5f, 0.8f, 0.3f);
	CHECK(!build());
	/* however the faces are split into triangles, each counts by its angle */
	for (int v = 0; v < 8; v++)
		CHECK_NEAR(v3_dot(body.normal[v],
				  (struct v3){v & 1 ? 1.0f : -1.0f, v & 2 ? 1.0f : -1.0f,
					      v & 4 ? 1.0f : -1.0f}),
			   1.7320508, 1e-5);
	for (int i = 0; i < 5000; i++) {
		struct v3 p = shape_random_point(&scatter, 1.2f);
		body_nearest(&body, p, 0, &hit);
		CHECK_NEAR(hit.distance_m, box_distance(p, 0.5, 0.8, 0.3), 2e-6);
		CHECK_NEAR(v3_distance(p, hit.point_m), float_abs(hit.distance_m), 2e-6);
	}
	/* straight off a vertex, an edge and a face */
	body_nearest(&body, (struct v3){0.6f, 0.9f, 0.4f}, 0, &hit);
	CHECK_NEAR(hit.distance_m, 0.17320508, 1e-6);
	body_nearest(&body, (struct v3){0.6f, 0.9f, 0.0f}, 0, &hit);
	CHECK_NEAR(hit.distance_m, 0.14142136, 1e-6);
	body_nearest(&body, (struct v3){0.49f, 0.7f, 0.2f}, 0, &hit);
	CHECK_NEAR(hit.distance_m, -0.01, 1e-6);
}

/* ---- the truth, by trying every triangle in double ---- */

struct d3 {
	double x, y, z;
};

static struct d3 d3_of(struct v3 a, struct v3 b)
{
	return (struct d3){(double)b.x - (double)a.x, (double)b.y - (double)a.y,
			   (double)b.z - (double)a.z};
}

static double d3_dot(struct d3 a, struct d3 b)
{
	return a.x * b.x + a.y * b.y + a.z * b.z;
}

static struct d3 d3_cross(struct d3 a, struct d3 b)
{
	return (struct d3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/* Inside by the winding number (van Oosterom and Strackee's solid angles). */
static bool truly_inside(struct v3 p)
{
	double sum = 0.0;
	for (int t = 0; t < body.triangle_count; t++) {
		const int *v = body.triangle[t].v;
		struct d3 a = d3_of(p, body.position_m[v[0]]), b = d3_of(p, body.position_m[v[1]]),
			  c = d3_of(p, body.position_m[v[2]]);
		double la = sqrt(d3_dot(a, a)), lb = sqrt(d3_dot(b, b)), lc = sqrt(d3_dot(c, c));
		sum += atan2(d3_dot(a, d3_cross(b, c)), la * lb * lc + d3_dot(a, b) * lc +
								d3_dot(b, c) * la +
								d3_dot(c, a) * lb);
	}
	return sum > 3.14159265358979;
}

static double to_segment(struct v3 p, struct v3 a, struct v3 b)
{
	struct d3 ab = d3_of(a, b), ap = d3_of(a, p);
	double t = fmin(fmax(d3_dot(ap, ab) / d3_dot(ab, ab), 0.0), 1.0);
	struct d3 d = {ap.x - t * ab.x, ap.y - t * ab.y, ap.z - t * ab.z};
	return sqrt(d3_dot(d, d));
}

/* The distance to the plane when the foot lies inside all three edges, else to the nearest edge. */
static double to_triangle(struct v3 p, struct v3 a, struct v3 b, struct v3 c)
{
	struct d3 n = d3_cross(d3_of(a, b), d3_of(a, c)), ap = d3_of(a, p);
	if (d3_dot(d3_cross(n, d3_of(a, b)), ap) >= 0.0 &&
	    d3_dot(d3_cross(n, d3_of(b, c)), d3_of(b, p)) >= 0.0 &&
	    d3_dot(d3_cross(n, d3_of(c, a)), d3_of(c, p)) >= 0.0)
		return fabs(d3_dot(n, ap)) / sqrt(d3_dot(n, n));
	return fmin(to_segment(p, a, b), fmin(to_segment(p, b, c), to_segment(p, c, a)));
}

static double true_distance(struct v3 p)
{
	double least = 1e9;
	for (int t = 0; t < body.triangle_count; t++) {
		const int *v = body.triangle[t].v;
		least = fmin(least, to_triangle(p, body.position_m[v[0]], body.position_m[v[1]],
						body.position_m[v[2]]));
	}
	return truly_inside(p) ? -least : least;
}

static void compare_with_truth(int count, float size)
{
	struct scatter scatter = {777};
	struct body_hit hit, warm;
	for (int i = 0; i < count; i++) {
		struct v3 p = shape_random_point(&scatter, size);
		double truth = true_distance(p);
		body_nearest(&body, p, 0, &hit);
		CHECK_NEAR(hit.distance_m, truth, 3e-6);
		body_nearest_from(&body, p, 0, scatter_below(&scatter, body.triangle_count), &warm);
		CHECK_NEAR(warm.distance_m, truth, 3e-6);
		CHECK_NEAR(v3_length(hit.normal), 1.0, 1e-5);
	}
}

static void test_truth(void)
{
	shape_globe(&shape, 9, 10, radius_spiked);
	CHECK(!build());
	compare_with_truth(4000, 0.7f);
	shape_torus(&shape, 24, 12, 0.6f, 0.2f);
	CHECK(!build());
	compare_with_truth(2000, 0.9f);
}

/* ---- walking ---- */

/* On a sphere there is one valley only: a walk from anywhere ends where the exact search does. */
static void test_walk(void)
{
	struct scatter scatter = {4242};
	struct body_hit exact, walked, cut_short;
	shape_globe(&shape, 40, 60, radius_round);
	CHECK(!build());
	for (int i = 0; i < 1000; i++) {
		struct v3 p = shape_random_point(&scatter, 1.0f);
		if (v3_length(p) < 0.55f)
			continue;
		int from = scatter_below(&scatter, body.triangle_count);
		body_nearest(&body, p, 0, &exact);
		int looked = body_walk(&body, p, from, 400, &walked);
		CHECK_NEAR(walked.distance_m, exact.distance_m, 1e-6);
		CHECK(looked >= 1);
		body_walk(&body, p, from, 2, &cut_short);
		CHECK(float_abs(cut_short.distance_m) >= walked.distance_m - 1e-6f);
		CHECK(body_walk(&body, p, walked.triangle, 400, &walked) <= 61);
	}
}

/* ---- tracking ---- */

enum { TRACKS = 600, TRACK_STEPS = 150 };

/* What is believed of points that wander about the figure, through the hollows under the arms and
 * between the legs, is proven: no surface is nearer than least_m, and what was found is no farther
 * than off_m beyond that. */
static void test_tracks(void)
{
	struct scatter scatter = {777};
	struct body_hit exact, hit = {0};
	long units = 0, looks = 0;
	int unproven = 0, off = 0, far_missed = 0;
	CHECK(!body_build_mannequin(&body));
	for (int i = 0; i < TRACKS; i++) {
		int v = scatter_below(&scatter, body.vertex_count);
		float height_m = 0.0005f * (float)scatter_below(&scatter, 100);
		float step_m = 0.001f * (float)(1 + scatter_below(&scatter, 8));
		struct v3 p = v3_mad(body.position_m[v], body.normal[v], height_m);
		struct body_track track = {.triangle = -1};
		for (int step = 0; step < TRACK_STEPS; step++) {
			p = v3_add(p, shape_random_point(&scatter, step_m));
			bool looked = body_track(&body, p, 0, &track, &hit, &units);
			body_nearest(&body, p, 0, &exact);
			float length = float_abs(exact.distance_m);
			far_missed += !looked && length < BODY_NEAR_M;
			if (!looked || length > BODY_NEAR_M)
				continue;
			looks++;
			unproven += length < track.least_m - 1e-6f ||
				    float_abs(hit.distance_m) > track.least_m + track.off_m + 1e-6f;
			off += float_abs(hit.distance_m) > length + 0.001f;
		}
	}
	CHECK(looks > TRACKS * TRACK_STEPS / 2);
	CHECK(unproven == 0);
	CHECK(off == 0);
	CHECK(far_missed == 0);
	CHECK(units < 12 * looks); /* few of them by the exact query */
}

/* ---- rays ---- */

static void test_rays(void)
{
	struct scatter scatter = {99};
	struct body_hit hit;
	shape_torus(&shape, 48, 24, 0.6f, 0.2f);
	CHECK(!build());
	struct v3 far = {-3.0f, 0.0f, 0.0f}, along = {2.0f, 0.0f, 0.0f};
	CHECK(body_ray(&body, far, along, &hit));
	CHECK_NEAR(hit.point_m.x, -0.8, 1e-3);
	CHECK_NEAR(hit.distance_m, 1.1, 1e-3);
	CHECK(hit.normal.x < -0.99f);
	CHECK(body_ray_back(&body, far, along, &hit));
	CHECK_NEAR(hit.point_m.x, 0.8, 1e-3);
	CHECK(hit.normal.x > 0.99f);
	/* from within the tube, the first front face is across the hole */
	CHECK(body_ray(&body, (struct v3){-0.6f, 0.0f, 0.0f}, along, &hit));
	CHECK_NEAR(hit.point_m.x, 0.4, 1e-3);
	CHECK(!body_ray(&body, (struct v3){0.0f, -3.0f, 0.0f}, (struct v3){0.0f, 1.0f, 0.0f},
			&hit));
	CHECK(!body_ray_back(&body, (struct v3){3.0f, 0.0f, 0.0f}, along, &hit));

	struct v3 middle = {0.0f, 0.0f, 0.0f}, tube = {0.6f, 0.0f, 0.0f}, out = {0.9f, 0.0f, 0.0f};
	CHECK(body_segment_hits(&body, middle, tube, &hit));
	CHECK_NEAR(hit.distance_m, 0.4 / 0.6, 1e-3);
	CHECK(body_segment_hits(&body, tube, out, &hit)); /* from inside out counts as well */
	CHECK(!body_segment_hits(&body, middle, (struct v3){0.39f, 0.0f, 0.0f}, &hit));
	CHECK(!body_segment_hits(&body, tube, (struct v3){0.65f, 0.1f, 0.0f}, &hit));
	for (int i = 0; i < 2000; i++) {
		struct v3 a = shape_random_point(&scatter, 1.0f);
		struct v3 b = shape_random_point(&scatter, 1.0f);
		if (truly_inside(a) != truly_inside(b))
			CHECK(body_segment_hits(&body, a, b, &hit));
	}
}

/* Rays aimed exactly at vertices and at points on edges never slip between two triangles. */
static void test_ray_gaps(void)
{
	struct body_hit hit;
	shape_globe(&shape, 12, 16, radius_round);
	CHECK(!build());
	struct v3 eye = {0.013f, 0.02f, -0.007f};
	for (int t = 0; t < body.triangle_count; t++)
		for (int k = 0; k < 3; k++) {
			const int *v = body.triangle[t].v;
			struct v3 a = body.position_m[v[k]], b = body.position_m[v[(k + 1) % 3]];
			for (int i = 0; i < 8; i++) {
				struct v3 to = v3_lerp(a, b, (float)i / 8.0f);
				CHECK(body_ray_back(&body, eye, v3_sub(to, eye), &hit));
				struct v3 outside = v3_scale(to, 3.0f);
				CHECK(body_ray(&body, outside, v3_sub(eye, outside), &hit));
			}
		}
}

int main(void)
{
	static unsigned char memory[64 << 20];
	struct arena arena;
	arena_init(&arena, memory, sizeof memory);
	body_init(&body, &arena);
	arena_seal(&arena);
	test_faults();
	test_structure();
	test_turned();
	test_box();
	test_truth();
	test_walk();
	test_tracks();
	test_rays();
	test_ray_gaps();
	return test_end();
}
