/* Nearest points: exact by the tree, warm by walking. */
#include "body_private.h"

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

struct v3 body_smooth_normal(const struct body *body, int t, struct v3 q)
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
	hit->normal = body_smooth_normal(body, n->triangle, n->point);
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

/* A node that waits, with its box's distance. */
struct waiting {
	int node;
	float d2;
};

/* Nearer children first; what has become too far meanwhile is dropped when its turn comes. */
static void search(const struct body *body, struct v3 point_m, unsigned parts, struct nearest *best)
{
	struct waiting stack[TREE_STACK_MAX];
	int depth = 0;
	MUST(body->triangle_count > 0);
	stack[depth++] = (struct waiting){0, box_d2(&body->node[0], point_m)};
	while (depth > 0) {
		struct waiting top = stack[--depth];
		if (top.d2 >= best->d2)
			continue;
		const struct bvh_node *node = &body->node[top.node];
		for (int i = 0; i < node->count; i++) {
			int t = body->node_triangle[node->first + i];
			if (!parts || (parts >> body->part[t] & 1))
				look(body, point_m, t, best);
		}
		if (node->count > 0)
			continue;
		int near = node->first, far = node->first + 1;
		float near_d2 = box_d2(&body->node[near], point_m);
		float far_d2 = box_d2(&body->node[far], point_m);
		MUST(depth + 2 <= TREE_STACK_MAX);
		if (far_d2 < near_d2) {
			stack[depth++] = (struct waiting){near, near_d2};
			stack[depth++] = (struct waiting){far, far_d2};
		} else {
			stack[depth++] = (struct waiting){far, far_d2};
			stack[depth++] = (struct waiting){near, near_d2};
		}
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
