/* Stretch of the cloth, and cloth that passes through itself. */
#include "measure_private.h"

/* ---- strain ---- */

/* The principal stretches of a triangle: the singular values of F, which takes the flat piece to
 * its place in space. With F = [e1 e2] R, their squares are the roots of
 * s^2 - trace(F'F) s + det(F'F). False: the flat triangle has no area. */
static bool principal_stretches(const struct cloth *cloth, int t, float *least, float *most)
{
	const struct garment *garment = cloth->garment;
	const int *r = garment->triangle[t].v, *v = cloth->triangle[t].v;
	struct v2 u1 = v2_sub(garment->rest_m[r[1]], garment->rest_m[r[0]]);
	struct v2 u2 = v2_sub(garment->rest_m[r[2]], garment->rest_m[r[0]]);
	float area = v2_cross(u1, u2);
	if (float_abs(area) < 1e-12f)
		return false;
	struct v3 e1 = v3_sub(cloth->position_m[v[1]], cloth->position_m[v[0]]);
	struct v3 e2 = v3_sub(cloth->position_m[v[2]], cloth->position_m[v[0]]);
	struct v3 fx = v3_scale(v3_mad(v3_scale(e1, u2.y), e2, -u1.y), 1.0f / area);
	struct v3 fy = v3_scale(v3_mad(v3_scale(e2, u1.x), e1, -u2.x), 1.0f / area);
	float xx = v3_dot(fx, fx), yy = v3_dot(fy, fy), xy = v3_dot(fx, fy);
	float mean = 0.5f * (xx + yy), half = 0.5f * (xx - yy);
	float spread = sqrtf(half * half + xy * xy);
	*most = sqrtf(mean + spread);
	*least = sqrtf(float_max(mean - spread, 0.0f));
	return true;
}

/* The value that 95 of 100 do not exceed (nearest rank); sorts. */
static float percentile_95(struct sort_item *item, int count)
{
	if (count == 0)
		return 0.0f;
	measure_sort(item, count);
	return item[(95 * count + 99) / 100 - 1].key;
}

static int list_stretches(const struct cloth *cloth, struct sort_item *item, bool compression)
{
	int count = 0;
	float least, most;
	for (int t = 0; t < cloth->garment->triangle_count; t++) {
		if (!measure_placed(cloth, t) || !principal_stretches(cloth, t, &least, &most))
			continue;
		item[count].key = compression ? 1.0f - least : most - 1.0f;
		item[count++].item = t;
	}
	return count;
}

void measure_strain(struct measure *measure, const struct cloth *cloth, struct measure_scratch *s)
{
	int count = list_stretches(cloth, s->sort, true);
	measure->compression_p95 = percentile_95(s->sort, count);
	count = list_stretches(cloth, s->sort, false);
	measure->strain_p95 = percentile_95(s->sort, count);
	measure->strain_max = count > 0 ? s->sort[count - 1].key : 0.0f;
}

/* ---- self-intersection ---- */

struct d3 {
	double x, y, z;
};

static struct d3 d3_sub(struct v3 a, struct v3 b)
{
	return (struct d3){(double)a.x - (double)b.x, (double)a.y - (double)b.y,
			   (double)a.z - (double)b.z};
}

/* Six times the volume of the tetrahedron; its sign says on which side of a b c the point d lies.
 * In double, since the volumes at stake are a thousandth of a cubic millimetre. */
static double volume6(struct v3 a, struct v3 b, struct v3 c, struct v3 d)
{
	struct d3 p = d3_sub(a, d), q = d3_sub(b, d), r = d3_sub(c, d);
	return p.x * (q.y * r.z - q.z * r.y) + p.y * (q.z * r.x - q.x * r.z) +
	       p.z * (q.x * r.y - q.y * r.x);
}

static bool segment_crosses(struct v3 p, struct v3 q, const struct v3 t[3])
{
	double side_p = volume6(t[0], t[1], t[2], p), side_q = volume6(t[0], t[1], t[2], q);
	if (!((side_p > 0.0 && side_q < 0.0) || (side_p < 0.0 && side_q > 0.0)))
		return false;
	double a = volume6(p, q, t[0], t[1]), b = volume6(p, q, t[1], t[2]),
	       c = volume6(p, q, t[2], t[0]);
	return (a >= 0.0 && b >= 0.0 && c >= 0.0) || (a <= 0.0 && b <= 0.0 && c <= 0.0);
}

bool measure_triangles_cross(const struct v3 a[3], const struct v3 b[3])
{
	for (int k = 0; k < 3; k++)
		if (segment_crosses(a[k], a[(k + 1) % 3], b) ||
		    segment_crosses(b[k], b[(k + 1) % 3], a))
			return true;
	return false;
}

static bool share_corner(const struct triangle *a, const struct triangle *b)
{
	for (int i = 0; i < 3; i++)
		for (int k = 0; k < 3; k++)
			if (a->v[i] == b->v[k])
				return true;
	return false;
}

static void take_corners(const struct cloth *cloth, int t, struct v3 corner[3])
{
	for (int k = 0; k < 3; k++)
		corner[k] = cloth->position_m[cloth->triangle[t].v[k]];
}

static float least_of(float a, float b, float c)
{
	return float_min(a, float_min(b, c));
}

static float most_of(float a, float b, float c)
{
	return float_max(a, float_max(b, c));
}

static bool apart(const struct v3 a[3], const struct v3 b[3])
{
	return least_of(a[0].x, a[1].x, a[2].x) > most_of(b[0].x, b[1].x, b[2].x) ||
	       least_of(b[0].x, b[1].x, b[2].x) > most_of(a[0].x, a[1].x, a[2].x) ||
	       least_of(a[0].z, a[1].z, a[2].z) > most_of(b[0].z, b[1].z, b[2].z) ||
	       least_of(b[0].z, b[1].z, b[2].z) > most_of(a[0].z, a[1].z, a[2].z);
}

/* Sweep and prune along y, the direction in which a garment is longest: triangles in order of their
 * lowest corner, each against those that begin before it ends. */
void measure_self(struct measure *measure, const struct cloth *cloth, struct measure_scratch *s)
{
	int count = 0;
	struct v3 a[3], b[3];
	for (int t = 0; t < cloth->garment->triangle_count; t++) {
		if (!measure_placed(cloth, t))
			continue;
		take_corners(cloth, t, a);
		s->sort[count++] = (struct sort_item){least_of(a[0].y, a[1].y, a[2].y), t};
	}
	measure_sort(s->sort, count);
	for (int i = 0; i < count; i++) {
		const struct triangle *triangle = &cloth->triangle[s->sort[i].item];
		take_corners(cloth, s->sort[i].item, a);
		float high = most_of(a[0].y, a[1].y, a[2].y);
		for (int k = i + 1; k < count && s->sort[k].key <= high; k++) {
			take_corners(cloth, s->sort[k].item, b);
			if (!apart(a, b) &&
			    !share_corner(triangle, &cloth->triangle[s->sort[k].item]))
				measure->self_intersections += measure_triangles_cross(a, b);
		}
	}
}
