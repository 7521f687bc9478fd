/* Nearest points, exact by the tree and warm by walking; rays. */
#include "body.h"

enum { STACK_MAX = 64 };

/* Which feature of a triangle a nearest point lies on. */
enum feature {
	ON_FACE,
	ON_EDGE,                 /* + k: v[k] v[k+1] */
	ON_VERTEX = ON_EDGE + 3, /* + k */
};

/* Ericson, Real-Time Collision Detection, 5.1.5; with the feature that it lies on. */
static struct v3 nearest_on_triangle(struct v3 p, struct v3 a, struct v3 b, struct v3 c,
				     int *feature)
{
	struct v3 ab = v3_sub(b, a), ac = v3_sub(c, a), ap = v3_sub(p, a);
	float d1 = v3_dot(ab, ap), d2 = v3_dot(ac, ap);
	*feature = ON_VERTEX;
	if (d1 <= 0.0f && d2 <= 0.0f)
		return a;
	struct v3 bp = v3_sub(p, b);
	float d3 = v3_dot(ab, bp), d4 = v3_dot(ac, bp);
	*feature = ON_VERTEX + 1;
	if (d3 >= 0.0f && d4 <= d3)
		return b;
	float vc = d1 * d4 - d3 * d2;
	*feature = ON_EDGE;
	if (vc <= 0.0f && d1 >= 0.0f && d3 <= 0.0f)
		return v3_mad(a, ab, d1 / (d1 - d3));
	struct v3 cp = v3_sub(p, c);
	float d5 = v3_dot(ab, cp), d6 = v3_dot(ac, cp);
	*feature = ON_VERTEX + 2;
	if (d6 >= 0.0f && d5 <= d6)
		return c;
	float vb = d5 * d2 - d1 * d6;
	*feature = ON_EDGE + 2;
	if (vb <= 0.0f && d2 >= 0.0f && d6 <= 0.0f)
		return v3_mad(a, ac, d2 / (d2 - d6));
	float va = d3 * d6 - d5 * d4;
	*feature = ON_EDGE + 1;
	if (va <= 0.0f && d4 - d3 >= 0.0f && d5 - d6 >= 0.0f)
		return v3_mad(b, v3_sub(c, b), (d4 - d3) / ((d4 - d3) + (d5 - d6)));
	*feature = ON_FACE;
	float scale = 1.0f / (va + vb + vc);
	return v3_add(v3_mad(a, ab, vb * scale), v3_scale(ac, vc * scale));
}

struct nearest {
	int triangle, feature;
	struct v3 point;
	float d2;
};

static void look(const struct body *body, struct v3 p, int t, struct nearest *best)
{
	const int *v = body->triangle[t].v;
	int feature;
	struct v3 q = nearest_on_triangle(p, body->position_m[v[0]], body->position_m[v[1]],
					  body->position_m[v[2]], &feature);
	struct v3 d = v3_sub(p, q);
	float d2 = v3_dot(d, d);
	if (d2 < best->d2)
		*best = (struct nearest){t, feature, q, d2};
}

/* The normal that decides the side: of the face, of both faces of an edge, or angle-weighted. */
static struct v3 side_normal(const struct body *body, const struct nearest *n)
{
	if (n->feature >= ON_VERTEX)
		return body->normal[body->triangle[n->triangle].v[n->feature - ON_VERTEX]];
	struct v3 normal = body->face_normal[n->triangle];
	if (n->feature >= ON_EDGE) {
		int across = body->neighbour[3 * n->triangle + n->feature - ON_EDGE];
		normal = v3_add(normal, body->face_normal[across]);
	}
	return normal;
}

static struct v3 smooth_normal(const struct body *body, int t, struct v3 q)
{
	const int *v = body->triangle[t].v;
	struct v3 a = body->position_m[v[0]], b = body->position_m[v[1]],
		  c = body->position_m[v[2]];
	struct v3 n = v3_cross(v3_sub(b, a), v3_sub(c, a));
	float area = v3_dot(n, n);
	if (area < 1e-24f)
		return body->face_normal[t];
	float wa = v3_dot(v3_cross(v3_sub(b, q), v3_sub(c, q)), n) / area;
	float wb = v3_dot(v3_cross(v3_sub(c, q), v3_sub(a, q)), n) / area;
	struct v3 sum = v3_scale(body->normal[v[0]], wa);
	sum = v3_mad(v3_mad(sum, body->normal[v[1]], wb), body->normal[v[2]], 1.0f - wa - wb);
	return v3_normalize(sum);
}

static void finish(const struct body *body, struct v3 p, const struct nearest *n,
		   struct body_hit *hit)
{
	float distance = sqrtf(n->d2);
	hit->triangle = n->triangle;
	hit->point_m = n->point;
	hit->normal = smooth_normal(body, n->triangle, n->point);
	bool inside = v3_dot(v3_sub(p, n->point), side_normal(body, n)) < 0.0f;
	hit->distance_m = inside ? -distance : distance;
}

static float box_d2(const struct bvh_node *node, struct v3 p)
{
	float x = float_max(float_max(node->low_m.x - p.x, p.x - node->high_m.x), 0.0f);
	float y = float_max(float_max(node->low_m.y - p.y, p.y - node->high_m.y), 0.0f);
	float z = float_max(float_max(node->low_m.z - p.z, p.z - node->high_m.z), 0.0f);
	return x * x + y * y + z * z;
}

/* Does the point lie where the parts asked for end? There the surface has no side. */
static bool on_rim(const struct body *body, const struct nearest *n, unsigned parts)
{
	if (n->feature == ON_FACE)
		return false;
	if (n->feature < ON_VERTEX) {
		int across = body->neighbour[3 * n->triangle + n->feature - ON_EDGE];
		return !(parts >> body->part[across] & 1);
	}
	int v = body->triangle[n->triangle].v[n->feature - ON_VERTEX];
	for (int i = body->star_first[v]; i < body->star_first[v + 1]; i++)
		if (!(parts >> body->part[body->star[i]] & 1))
			return true;
	return false;
}

static void search(const struct body *body, struct v3 point_m, unsigned parts, struct nearest *best)
{
	int stack[STACK_MAX], depth = 0;
	MUST(body->triangle_count > 0);
	stack[depth++] = 0;
	while (depth > 0) {
		const struct bvh_node *node = &body->node[stack[--depth]];
		if (box_d2(node, point_m) >= best->d2)
			continue;
		for (int i = 0; i < node->count; i++) {
			int t = body->node_triangle[node->first + i];
			if (!parts || (parts >> body->part[t] & 1))
				look(body, point_m, t, best);
		}
		if (node->count > 0)
			continue;
		float left = box_d2(&body->node[node->first], point_m);
		float right = box_d2(&body->node[node->first + 1], point_m);
		MUST(depth + 2 <= STACK_MAX);
		stack[depth++] = node->first + (left <= right);
		stack[depth++] = node->first + (left > right);
	}
}

void body_nearest_from(const struct body *body, struct v3 point_m, unsigned parts, int from,
		       struct body_hit *hit)
{
	struct nearest best = {0, ON_FACE, {0.0f, 0.0f, 0.0f}, 1e18f};
	if (from >= 0 && (!parts || (parts >> body->part[from] & 1)))
		look(body, point_m, from, &best);
	search(body, point_m, parts, &best);
	finish(body, point_m, &best, hit);
	if (parts && on_rim(body, &best, parts))
		hit->distance_m = sqrtf(best.d2) + 0.05f;
}

void body_nearest(const struct body *body, struct v3 point_m, unsigned parts, struct body_hit *hit)
{
	body_nearest_from(body, point_m, parts, -1, hit);
}

/* One step downhill: over the edge that holds the nearest point, or round its vertex. Inside a face
 * nothing can be nearer but another sheet of the surface. */
int body_walk(const struct body *body, struct v3 point_m, int from, int steps_max,
	      struct body_hit *hit)
{
	struct nearest best = {from, ON_FACE, {0.0f, 0.0f, 0.0f}, 1e18f};
	int looked = 1;
	look(body, point_m, from, &best);
	for (int step = 0; step < steps_max && best.feature != ON_FACE; step++) {
		int at = best.triangle;
		if (best.feature < ON_VERTEX) {
			look(body, point_m, body->neighbour[3 * at + best.feature - ON_EDGE],
			     &best);
			looked++;
		} else {
			int v = body->triangle[at].v[best.feature - ON_VERTEX];
			for (int i = body->star_first[v]; i < body->star_first[v + 1]; i++)
				look(body, point_m, body->star[i], &best);
			looked += body->star_first[v + 1] - body->star_first[v];
		}
		if (best.triangle == at)
			break;
	}
	finish(body, point_m, &best, hit);
	return looked;
}

/* ---- rays ---- */

static bool ray_box(const struct bvh_node *node, struct v3 o, struct v3 inverse, float t_max)
{
	float ax = (node->low_m.x - o.x) * inverse.x, bx = (node->high_m.x - o.x) * inverse.x;
	float ay = (node->low_m.y - o.y) * inverse.y, by = (node->high_m.y - o.y) * inverse.y;
	float az = (node->low_m.z - o.z) * inverse.z, bz = (node->high_m.z - o.z) * inverse.z;
	float near = float_max(float_max(float_min(ax, bx), float_min(ay, by)),
			       float_max(float_min(az, bz), 0.0f));
	float far = float_min(float_min(float_max(ax, bx), float_max(ay, by)),
			      float_min(float_max(az, bz), t_max));
	return near <= far * 1.00001f;
}

/* Moeller and Trumbore; *front says which side was hit. False: missed. */
static bool ray_triangle(const struct body *body, int t, struct v3 o, struct v3 d, float *distance,
			 bool *front)
{
	const int *v = body->triangle[t].v;
	struct v3 a = body->position_m[v[0]];
	struct v3 e1 = v3_sub(body->position_m[v[1]], a), e2 = v3_sub(body->position_m[v[2]], a);
	struct v3 p = v3_cross(d, e2);
	float det = v3_dot(e1, p);
	if (det == 0.0f)
		return false;
	float inverse = 1.0f / det;
	struct v3 s = v3_sub(o, a);
	float u = v3_dot(s, p) * inverse;
	if (!(u >= 0.0f && u <= 1.0f))
		return false;
	struct v3 q = v3_cross(s, e1);
	float w = v3_dot(d, q) * inverse;
	*distance = v3_dot(e2, q) * inverse;
	*front = det > 0.0f;
	return w >= 0.0f && u + w <= 1.0f && *distance >= 0.0f;
}

static float inverse_of(float x)
{
	return float_abs(x) > 1e-12f ? 1.0f / x : x < 0.0f ? -1e12f : 1e12f;
}

enum ray_wanted {
	RAY_FIRST_FRONT,
	RAY_LAST_BACK,
	RAY_FIRST_ANY,
};

static bool cast(const struct body *body, struct v3 o, struct v3 d, float t_max,
		 enum ray_wanted wanted, struct body_hit *hit)
{
	struct v3 inverse = {inverse_of(d.x), inverse_of(d.y), inverse_of(d.z)};
	int stack[STACK_MAX], depth = 0, found = -1;
	float best = wanted == RAY_LAST_BACK ? -1.0f : t_max;
	MUST(body->triangle_count > 0);
	stack[depth++] = 0;
	while (depth > 0) {
		const struct bvh_node *node = &body->node[stack[--depth]];
		if (!ray_box(node, o, inverse, wanted == RAY_LAST_BACK ? t_max : best))
			continue;
		for (int i = 0; i < node->count; i++) {
			int t = body->node_triangle[node->first + i];
			float distance;
			bool front;
			if (!ray_triangle(body, t, o, d, &distance, &front))
				continue;
			bool nearer = distance < best || (distance == best && t < found);
			bool farther = distance > best && distance <= t_max;
			if ((wanted == RAY_FIRST_FRONT && front && nearer) ||
			    (wanted == RAY_FIRST_ANY && nearer) ||
			    (wanted == RAY_LAST_BACK && !front && farther)) {
				best = distance;
				found = t;
			}
		}
		if (node->count > 0)
			continue;
		MUST(depth + 2 <= STACK_MAX);
		stack[depth++] = node->first + 1;
		stack[depth++] = node->first;
	}
	if (found < 0)
		return false;
	hit->triangle = found;
	hit->point_m = v3_mad(o, d, best);
	hit->normal = smooth_normal(body, found, hit->point_m);
	hit->distance_m = best;
	return true;
}

bool body_ray(const struct body *body, struct v3 origin_m, struct v3 direction,
	      struct body_hit *hit)
{
	return cast(body, origin_m, direction, 1e9f, RAY_FIRST_FRONT, hit);
}

bool body_ray_back(const struct body *body, struct v3 origin_m, struct v3 direction,
		   struct body_hit *hit)
{
	return cast(body, origin_m, direction, 1e9f, RAY_LAST_BACK, hit);
}

bool body_segment_hits(const struct body *body, struct v3 a_m, struct v3 b_m, struct body_hit *hit)
{
	return cast(body, a_m, v3_sub(b_m, a_m), 1.0f, RAY_FIRST_ANY, hit);
}
