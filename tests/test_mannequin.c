/* The mannequin: a sound mesh, the right size, the same on both sides, and room around its limbs.
 */
#include "body.h"
#include "test.h"

#include <math.h>

enum { EDGES_MAX = 3 * BODY_TRIANGLES_MAX };

static struct body body;

static struct v3 corner(int triangle, int k)
{
	return body.position_m[body.triangle[triangle].v[k % 3]];
}

static void check_closed(void)
{
	int reached = 1, inner = 0;
	static bool seen[BODY_TRIANGLES_MAX];
	static int queue[BODY_TRIANGLES_MAX];
	seen[0] = true;
	for (int i = 0; i < reached; i++) {
		for (int k = 0; k < 3; k++) {
			int next = body.neighbour[3 * queue[i] + k];
			CHECK(next >= 0);
			if (next >= 0 && !seen[next]) {
				seen[next] = true;
				queue[reached++] = next;
			}
		}
		inner += 3;
	}
	CHECK(reached == body.triangle_count);
	CHECK(inner % 2 == 0);
	CHECK(body.vertex_count - inner / 2 + body.triangle_count == 2);
	CHECK(body.triangle_count >= 10000 && body.triangle_count <= 20000);
}

/* Around every vertex there is one fan of triangles. */
static void check_fans(void)
{
	for (int v = 0; v < body.vertex_count; v++) {
		int valence = body.star_first[v + 1] - body.star_first[v];
		int start = body.star[body.star_first[v]], t = start, turned = 0;
		do {
			int k = 0;
			while (k < 2 && body.triangle[t].v[k] != v)
				k++;
			t = body.neighbour[3 * t + k];
			turned++;
		} while (t >= 0 && t != start && turned <= valence);
		CHECK(valence >= 3 && turned == valence);
	}
}

static int by_position(const void *a, const void *b)
{
	return memcmp(a, b, sizeof(struct v3));
}

static void check_symmetry(void)
{
	static struct v3 there[BODY_VERTICES_MAX], image[BODY_VERTICES_MAX];
	int seam = 0;
	for (int v = 0; v < body.vertex_count; v++) {
		struct v3 p = body.position_m[v];
		there[v] = p;
		image[v] = (struct v3){p.x == 0.0f ? 0.0f : -p.x, p.y, p.z};
		seam += p.x == 0.0f;
	}
	qsort(there, (size_t)body.vertex_count, sizeof *there, by_position);
	qsort(image, (size_t)body.vertex_count, sizeof *image, by_position);
	CHECK(memcmp(there, image, (size_t)body.vertex_count * sizeof *there) == 0);
	CHECK(seam > 150);
	for (int t = 0; t < body.triangle_count; t++) {
		float low = fminf(corner(t, 0).x, fminf(corner(t, 1).x, corner(t, 2).x));
		float high = fmaxf(corner(t, 0).x, fmaxf(corner(t, 1).x, corner(t, 2).x));
		CHECK(low >= 0.0f || high <= 0.0f);
	}
}

static void check_size(void)
{
	CHECK_NEAR(body.low_m.y, 0.0, 1e-6);
	CHECK_NEAR(body.high_m.y, 1.70, 1e-5);
	CHECK(body.high_m.x > 0.50f && body.high_m.x < 0.65f);
	CHECK(body.low_m.z > -0.20f && body.high_m.z < 0.20f);
	int on_floor = 0;
	for (int v = 0; v < body.vertex_count; v++)
		on_floor += body.position_m[v].y == 0.0f;
	CHECK(on_floor > 100);
}

static int by_value(const void *a, const void *b)
{
	float x = *(const float *)a, y = *(const float *)b;
	return (x > y) - (x < y);
}

static void check_shapes(void)
{
	static float angle[BODY_TRIANGLES_MAX], edge[EDGES_MAX];
	int edges = 0;
	for (int t = 0; t < body.triangle_count; t++) {
		angle[t] = PI_F;
		for (int k = 0; k < 3; k++) {
			struct v3 ab = v3_sub(corner(t, k + 1), corner(t, k));
			struct v3 ac = v3_sub(corner(t, k + 2), corner(t, k));
			float cosine = v3_dot(ab, ac) / (v3_length(ab) * v3_length(ac));
			angle[t] = fminf(angle[t], angle_acos(cosine));
			edge[edges++] = v3_length(ab);
		}
	}
	qsort(angle, (size_t)body.triangle_count, sizeof *angle, by_value);
	qsort(edge, (size_t)edges, sizeof *edge, by_value);
	CHECK(angle[body.triangle_count / 1000] > 25.0f * PI_F / 180.0f);
	CHECK(angle[0] > 15.0f * PI_F / 180.0f);
	CHECK(edge[0] > 0.004f && edge[edges - 1] < 0.040f);
	CHECK(edge[edges / 100] > 0.006f && edge[edges - edges / 100] < 0.025f);
}

/* Six times the signed volume of a tetrahedron. */
static double side(struct v3 a, struct v3 b, struct v3 c, struct v3 p)
{
	double o[3] = {(double)a.x, (double)a.y, (double)a.z};
	double u[3] = {(double)b.x, (double)b.y, (double)b.z};
	double v[3] = {(double)c.x, (double)c.y, (double)c.z};
	double w[3] = {(double)p.x, (double)p.y, (double)p.z};
	for (int k = 0; k < 3; k++) {
		u[k] -= o[k];
		v[k] -= o[k];
		w[k] -= o[k];
	}
	return (u[1] * v[2] - u[2] * v[1]) * w[0] + (u[2] * v[0] - u[0] * v[2]) * w[1] +
	       (u[0] * v[1] - u[1] * v[0]) * w[2];
}

static bool edge_crosses(struct v3 p, struct v3 q, int t)
{
	struct v3 a = corner(t, 0), b = corner(t, 1), c = corner(t, 2);
	if ((side(a, b, c, p) > 0.0) == (side(a, b, c, q) > 0.0))
		return false;
	bool ab = side(p, q, a, b) > 0.0;
	return ab == (side(p, q, b, c) > 0.0) && ab == (side(p, q, c, a) > 0.0);
}

static int shared_corners(int s, int t)
{
	int shared = 0;
	for (int i = 0; i < 9; i++)
		shared += body.triangle[s].v[i / 3] == body.triangle[t].v[i % 3];
	return shared;
}

static bool touches(int t, int vertex)
{
	const int *v = body.triangle[t].v;
	return v[0] == vertex || v[1] == vertex || v[2] == vertex;
}

/* Edges of one triangle, those that don't end on the other, against that other. */
static bool triangles_cross(int s, int t)
{
	for (int k = 0; k < 3; k++) {
		int a = body.triangle[s].v[k], b = body.triangle[s].v[(k + 1) % 3];
		if (!touches(t, a) && !touches(t, b) &&
		    edge_crosses(body.position_m[a], body.position_m[b], t))
			return true;
	}
	return false;
}

struct span {
	struct v3 low, high;
	int triangle;
};

static int by_low_y(const void *a, const void *b)
{
	const struct span *s = a, *t = b;
	return (s->low.y > t->low.y) - (s->low.y < t->low.y);
}

static int count_crossings(void)
{
	static struct span span[BODY_TRIANGLES_MAX];
	int crossings = 0, n = body.triangle_count;
	for (int t = 0; t < n; t++) {
		span[t] = (struct span){corner(t, 0), corner(t, 0), t};
		for (int k = 1; k < 3; k++) {
			struct v3 p = corner(t, k), *l = &span[t].low, *h = &span[t].high;
			*l = (struct v3){fminf(l->x, p.x), fminf(l->y, p.y), fminf(l->z, p.z)};
			*h = (struct v3){fmaxf(h->x, p.x), fmaxf(h->y, p.y), fmaxf(h->z, p.z)};
		}
	}
	qsort(span, (size_t)n, sizeof *span, by_low_y);
	for (int i = 0; i < n; i++) {
		const struct span *s = &span[i];
		for (int j = i + 1; j < n && span[j].low.y <= s->high.y; j++) {
			const struct span *t = &span[j];
			if (t->low.x > s->high.x || t->high.x < s->low.x || t->low.z > s->high.z ||
			    t->high.z < s->low.z || shared_corners(s->triangle, t->triangle) > 1)
				continue;
			crossings += triangles_cross(s->triangle, t->triangle) ||
				     triangles_cross(t->triangle, s->triangle);
		}
	}
	return crossings;
}

/* No fold: the faces across an edge never turn back on each other. */
static void check_folds(void)
{
	float least = 1.0f;
	for (int t = 0; t < body.triangle_count; t++)
		for (int k = 0; k < 3; k++)
			least = fminf(least, v3_dot(body.face_normal[t],
						    body.face_normal[body.neighbour[3 * t + k]]));
	CHECK(least > 0.2f);
}

/* Length of the section by a plane, of what lies within `reach` of the plane's origin. */
static float girth(struct v3 origin, struct v3 normal, float reach)
{
	float sum = 0.0f;
	for (int t = 0; t < body.triangle_count; t++) {
		struct v3 end[3];
		int ends = 0;
		for (int k = 0; k < 3; k++) {
			struct v3 a = corner(t, k), b = corner(t, k + 1);
			float da = v3_dot(v3_sub(a, origin), normal);
			float db = v3_dot(v3_sub(b, origin), normal);
			if ((da < 0.0f) != (db < 0.0f))
				end[ends++] = v3_lerp(a, b, da / (da - db));
		}
		if (ends == 2 && v3_distance(end[0], origin) < reach)
			sum += v3_distance(end[0], end[1]);
	}
	return sum;
}

static void check_girths(void)
{
	const struct v3 up = {0.0f, 1.0f, 0.0f}, arm = {0.645f, -0.764f, 0.0f};
	struct {
		const char *name;
		struct v3 origin, normal;
		float reach, low, high;
	} row[] = {
		{"neck", {0.0f, 1.455f, -0.01f}, up, 0.12f, 0.30f, 0.35f},
		{"chest", {0.0f, 1.245f, 0.0f}, up, 0.19f, 0.82f, 0.90f},
		{"waist", {0.0f, 1.09f, 0.0f}, up, 0.25f, 0.62f, 0.70f},
		{"hip", {0.0f, 0.89f, 0.0f}, up, 0.25f, 0.90f, 0.98f},
		{"upper arm", {0.245f, 1.255f, -0.017f}, arm, 0.08f, 0.23f, 0.29f},
		{"wrist", {0.433f, 1.003f, 0.017f}, arm, 0.06f, 0.12f, 0.17f},
		{"thigh", {0.095f, 0.74f, 0.0f}, up, 0.105f, 0.50f, 0.58f},
		{"calf", {0.110f, 0.34f, -0.02f}, up, 0.10f, 0.30f, 0.38f},
		{"ankle", {0.105f, 0.12f, -0.01f}, up, 0.08f, 0.18f, 0.24f},
	};
	for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
		float length = girth(row[i].origin, row[i].normal, row[i].reach);
		if (getenv("SHOW"))
			printf("%-10s %.3f m\n", row[i].name, (double)length);
		if (!(length >= row[i].low && length <= row[i].high))
			fprintf(stderr, "%s: %.3f m\n", row[i].name, (double)length);
		CHECK(length >= row[i].low && length <= row[i].high);
	}
}

/* Cloth must get between arm and trunk and between the legs. */
static void check_room(void)
{
	float wrist = 1.0f, legs = 1.0f;
	for (int v = 0; v < body.vertex_count; v++) {
		struct v3 p = body.position_m[v];
		if (p.x > 0.30f && p.y < 1.05f)
			for (int u = 0; u < body.vertex_count; u++)
				if (float_abs(body.position_m[u].x) < 0.25f)
					wrist = fminf(wrist, v3_distance(p, body.position_m[u]));
		if (p.x > 0.0f && p.y < 0.55f)
			legs = fminf(legs, 2.0f * p.x);
	}
	if (getenv("SHOW"))
		printf("forearm to trunk %.3f m, between the legs %.3f m\n", (double)wrist,
		       (double)legs);
	CHECK(wrist > 0.06f);
	CHECK(legs > 0.025f);
}

int main(void)
{
	size_t size = (size_t)64 << 20;
	void *memory = malloc(size);
	struct arena arena;
	if (!memory)
		return EXIT_FAILURE;
	arena_init(&arena, memory, size);
	body_init(&body, &arena);
	const char *fault = body_build_mannequin(&body);
	if (fault)
		fprintf(stderr, "%s\n", fault);
	if (getenv("SHOW"))
		printf("hash %016llx\n", (unsigned long long)body.hash);
	CHECK(!fault);
	if (!fault) {
		CHECK(body.hash == 0xcf377cb1dd159790); /* the same bits everywhere */
		check_closed();
		check_fans();
		check_symmetry();
		check_size();
		check_shapes();
		check_folds();
		CHECK(count_crossings() == 0);
		check_girths();
		check_room();
	}
	free(memory);
	return test_end();
}
