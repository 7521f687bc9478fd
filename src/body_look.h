/* The nearest point on one triangle, and downhill from there. Inline: a walk looks at one or two
 * triangles, and a call costs as much as looking. */
#ifndef BODY_LOOK_H
#define BODY_LOOK_H

#include "body.h"
#include "lanes.h"

/* Which feature of a triangle a nearest point lies on. */
enum feature {
	ON_FACE,
	ON_EDGE,                 /* + k: v[k] v[k+1] */
	ON_VERTEX = ON_EDGE + 3, /* + k */
};

/* What lies over a triangle, as four slopes in one cache line: column[0] x + column[1] y +
 * column[2] z + column[3] are the weights of its corners at a point's foot on its plane, and the
 * height over it. */
struct prism {
	lanes column[4];
};

/* The nearest point found so far (body_near.c). */
struct nearest {
	int triangle, feature;
	struct v3 point_m;
	float d2;
};

static const struct nearest nearest_none = {0, ON_FACE, {0.0f, 0.0f, 0.0f}, 1e18f};
static const float near_rim_m = 0.05f; /* a rim counts as so much farther: it has no side */

static inline bool near_allowed(const struct body *body, int t, unsigned parts)
{
	return !parts || (parts >> body->part[t] & 1);
}

/* Ericson, Real-Time Collision Detection, 5.1.5; with the feature that it lies on. */
static inline __attribute__((always_inline)) struct v3
nearest_on_triangle(struct v3 p, struct v3 a, struct v3 b, struct v3 c, int *feature)
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

/* Takes triangle t when it is nearer. */
static inline void near_look(const struct body *body, struct v3 p, int t, struct nearest *best)
{
	const int *v = body->triangle[t].v;
	int feature;
	struct v3 q = nearest_on_triangle(p, body->position_m[v[0]], body->position_m[v[1]],
					  body->position_m[v[2]], &feature);
	struct v3 d = v3_sub(p, q);
	float d2 = v3_dot(d, d);
	if (!(d2 < best->d2))
		return;
	best->triangle = t;
	best->feature = feature;
	best->point_m = q;
	best->d2 = d2;
}

/* One step downhill: over the edge that holds the nearest point, or round its vertex. Inside a face
 * nothing can be nearer but another sheet of the surface. */
static inline int near_walk(const struct body *body, struct v3 point_m, unsigned parts,
			    int steps_max, struct nearest *best)
{
	int looked = 0;
	for (int step = 0; step < steps_max && best->feature != ON_FACE; step++) {
		int at = best->triangle;
		const int *next = &body->neighbour[3 * at + best->feature - ON_EDGE];
		int count = 1;
		if (best->feature >= ON_VERTEX) {
			int v = body->triangle[at].v[best->feature - ON_VERTEX];
			next = &body->star[body->star_first[v]];
			count = body->star_first[v + 1] - body->star_first[v];
		}
		for (int i = 0; i < count; i++)
			if (next[i] != at && near_allowed(body, next[i], parts)) {
				near_look(body, point_m, next[i], best);
				looked++;
			}
		if (best->triangle == at)
			break;
	}
	return looked;
}

static inline struct v3 prism_normal(const struct prism *prism)
{
	return (struct v3){prism->column[0][3], prism->column[1][3], prism->column[2][3]};
}

/* Beyond edge k of both its triangles: the nearest point lies on it, unless beside its ends. */
static inline bool near_edge(const struct body *body, struct v3 p, int t, int k,
			     struct nearest *best)
{
	const int *v = body->triangle[t].v;
	struct v3 a = body->position_m[v[k]], b = body->position_m[v[k == 2 ? 0 : k + 1]];
	struct v3 ab = v3_sub(b, a), ap = v3_sub(p, a);
	float along = v3_dot(ap, ab), length2 = v3_dot(ab, ab);
	if (!(along > 0.0f && along < length2))
		return false;
	struct v3 q = v3_mad(a, ab, along / length2), d = v3_sub(p, q);
	*best = (struct nearest){t, ON_EDGE + k, q, v3_dot(d, d)};
	return true;
}

/* The nearest point near triangle `from`: over edges to the prism that holds the point, as most
 * points lie in one; else downhill from where that went astray. Returns the triangles looked at. */
static inline int near_descend(const struct body *body, struct v3 p, unsigned parts, int from,
			       int steps_max, struct nearest *best)
{
	int t = from, before = -1, looked = 0;
	while (looked++ < steps_max) {
		const struct prism *prism = &body->prism[t];
		lanes at = prism->column[0] * lanes_of(p.x) + prism->column[1] * lanes_of(p.y) +
			   prism->column[2] * lanes_of(p.z) + prism->column[3];
		float a = at[0], b = at[1], c = at[2];
		if (a >= 0.0f && b >= 0.0f && c >= 0.0f) {
			*best = (struct nearest){t, ON_FACE, v3_mad(p, prism_normal(prism), -at[3]),
						 at[3] * at[3]};
			return looked;
		}
		int edge = a <= b && a <= c ? 1 : b <= c ? 2 : 0; /* opposite the lowest weight */
		int next = body->neighbour[3 * t + edge];
		if (next == before && near_edge(body, p, t, edge, best))
			return looked;
		if (next == before || !near_allowed(body, next, parts))
			break;
		before = t;
		t = next;
	}
	near_look(body, p, t, best);
	return looked + near_walk(body, p, parts, steps_max, best);
}

/* The normal that decides the side: of the face, of both faces of an edge, or angle-weighted. */
static inline struct v3 side_normal(const struct body *body, const struct nearest *n)
{
	if (n->feature >= ON_VERTEX)
		return body->normal[body->triangle[n->triangle].v[n->feature - ON_VERTEX]];
	struct v3 normal = prism_normal(&body->prism[n->triangle]);
	if (n->feature >= ON_EDGE) {
		int across = body->neighbour[3 * n->triangle + n->feature - ON_EDGE];
		normal = v3_add(normal, prism_normal(&body->prism[across]));
	}
	return normal;
}

/* The distance with its sign. */
static inline float near_signed_m(const struct body *body, struct v3 p, const struct nearest *n)
{
	float distance = sqrtf(n->d2);
	return v3_dot(v3_sub(p, n->point_m), side_normal(body, n)) < 0.0f ? -distance : distance;
}

#endif
