/* Sheets that pass through one another, and the way out: the curve in which they cross is made
 * shorter until it is gone (Volino and Magnenat-Thalmann, "Resolving Surface Collisions through
 * Intersection Contour Minimization", SIGGRAPH 2006). That needs no memory of where the sheets came
 * from. */
#include "cloth_self_private.h"

static const float watched_m = 0.0012f; /* edges of garments so near to one another are held */
static const float held_m = 0.001f;     /* ... so far apart */
static const float lost_m = 0.016f;     /* deeper, the order of garments means nothing here */
static const float pull_m = 0.0006f;    /* of an edge and a triangle apart in one sweep, at most */

/* Where a segment p q passes through a triangle: the share of the way from p, and weights of the
 * corners. */
struct piercing {
	float at, weight[3];
	struct v3 normal; /* of the triangle, not unit */
};

/* Six times the volume of the tetrahedron a b c d, corners relative to d. */
static float volume6(struct v3 a, struct v3 b, struct v3 c)
{
	return v3_dot(a, v3_cross(b, c));
}

static bool pierces(struct v3 p, struct v3 q, const struct v3 t[3], struct piercing *piercing)
{
	struct v3 normal = v3_cross(v3_sub(t[1], t[0]), v3_sub(t[2], t[0]));
	float side_p = v3_dot(v3_sub(p, t[0]), normal), side_q = v3_dot(v3_sub(q, t[0]), normal);
	if (!((side_p > 0.0f && side_q <= 0.0f) || (side_p < 0.0f && side_q >= 0.0f)))
		return false;
	struct v3 d = v3_sub(q, p), a = v3_sub(t[0], p), b = v3_sub(t[1], p), c = v3_sub(t[2], p);
	float wa = volume6(d, b, c), wb = volume6(d, c, a), wc = volume6(d, a, b);
	if (!((wa >= 0.0f && wb >= 0.0f && wc >= 0.0f) || (wa <= 0.0f && wb <= 0.0f && wc <= 0.0f)))
		return false;
	float sum = wa + wb + wc;
	if (sum == 0.0f)
		return false;
	*piercing = (struct piercing){
		side_p / (side_p - side_q), {wa / sum, wb / sum, wc / sum}, normal};
	return true;
}

static void edge_ends(const struct cloth *cloth, int e, int *a, int *b)
{
	const int *v = cloth->triangle[e / 3].v;
	*a = v[e % 3];
	*b = v[(e % 3 + 1) % 3];
}

/* ---- the search ---- */

static bool has_corner(const struct triangle *triangle, int v)
{
	return triangle->v[0] == v || triangle->v[1] == v || triangle->v[2] == v;
}

/* Where an edge comes lowest over the side of a triangle on which it belongs: the share of the way
 * from its first end, weights of the corners, height. False: it does not pass over it. */
struct lowest {
	float at, height;
	struct over over;
};

static bool look_lowest(const struct cloth *cloth, int e, int t, int side, struct lowest *lowest)
{
	int a, b;
	struct over from, to;
	float begin = 0.0f, end = 1.0f;
	edge_ends(cloth, e, &a, &b);
	if (!self_look_over(cloth, cloth->position_m[a], t, &from) ||
	    !self_look_over(cloth, cloth->position_m[b], t, &to))
		return false;
	for (int k = 0; k < 3; k++) {
		float slope = to.weight[k] - from.weight[k];
		if (float_abs(slope) < 1e-6f && from.weight[k] < 0.0f)
			return false;
		if (slope > 1e-6f)
			begin = float_max(begin, -from.weight[k] / slope);
		if (slope < -1e-6f)
			end = float_min(end, -from.weight[k] / slope);
	}
	if (begin > end)
		return false;
	float sign = (float)side;
	bool falls = sign * (to.height - from.height) < 0.0f;
	float at = falls ? end : begin;
	lowest->at = at;
	lowest->height = sign * (from.height + at * (to.height - from.height));
	lowest->over = from;
	for (int k = 0; k < 3; k++)
		lowest->over.weight[k] += at * (to.weight[k] - from.weight[k]);
	return true;
}

/* The side that both triangles of an edge agree about. At a crease they do not: there the sheet
 * goes round the other one's rim. */
static int edge_side(const struct cloth *cloth, int e, int t)
{
	int f = cloth->self->across[e];
	if (f >= 0 && self_facing(cloth, f / 3, t) < 0)
		return 0;
	return self_layer_side(cloth, e / 3, t);
}

/* An edge belongs to the lower of its triangles. */
void self_find_crossings(struct cloth *cloth, int t, const int *near, int near_count)
{
	struct cloth_self *self = cloth->self;
	struct v3 corner[3];
	struct piercing piercing;
	for (int i = 0; i < near_count; i++) {
		self_corners(cloth, near[i], corner);
		for (int k = 0; k < 3; k++) {
			int e = 3 * t + k, a, b, side;
			struct lowest lowest;
			edge_ends(cloth, e, &a, &b);
			if ((self->across[e] >= 0 && self->across[e] < e) ||
			    has_corner(&cloth->triangle[near[i]], a))
				continue;
			bool through = pierces(cloth->position_m[a], cloth->position_m[b], corner,
					       &piercing);
			side = self->layered ? edge_side(cloth, e, near[i]) : 0;
			if (side && (!look_lowest(cloth, e, near[i], side, &lowest) ||
				     lowest.height < -lost_m))
				side = 0;
			if (!through && !(side && lowest.height < watched_m))
				continue;
			if (self->crossing_count < SELF_CROSSINGS_MAX)
				self->crossing[self->crossing_count++] = (struct crossing){
					e, near[i], (int8_t)side, through};
		}
	}
}

void self_forget_crossings(struct cloth *cloth, int slice, int slices)
{
	struct cloth_self *self = cloth->self;
	int kept = 0;
	for (int i = 0; i < self->crossing_count; i++)
		if (self->crossing[i].edge / 3 % slices != slice)
			self->crossing[kept++] = self->crossing[i];
	self->crossing_count = kept;
}

/* ---- the pull ---- */

/* The direction in which the curve of crossing goes on from edge e into the triangle that has it
 * with `corner` opposite. */
static struct v3 curve_direction(const struct cloth *cloth, int e, struct v3 along, struct v3 n)
{
	int a, b, c = cloth->triangle[e / 3].v[(e % 3 + 2) % 3];
	edge_ends(cloth, e, &a, &b);
	struct v3 origin = cloth->position_m[a];
	struct v3 inward = v3_sub(cloth->position_m[c], origin);
	inward = v3_mad(inward, along, -v3_dot(inward, along));
	struct v3 face = v3_cross(along, inward);
	struct v3 curve = v3_normalize(v3_cross(n, face));
	return v3_dot(curve, inward) < 0.0f ? v3_scale(curve, -1.0f) : curve;
}

/* The paper's gradient: G = sum R - 2 (E.R) / (E.N) N over the edge's triangles. */
static struct v3 gradient(const struct cloth *cloth, int e, struct v3 normal)
{
	int a, b, f = cloth->self->across[e];
	edge_ends(cloth, e, &a, &b);
	struct v3 along = v3_normalize(v3_sub(cloth->position_m[b], cloth->position_m[a]));
	struct v3 curve = curve_direction(cloth, e, along, normal);
	if (f >= 0)
		curve = v3_add(curve, curve_direction(cloth, f, along, normal));
	float slope = v3_dot(along, normal);
	if (float_abs(slope) < 0.1f)
		slope = slope < 0.0f ? -0.1f : 0.1f;
	return v3_mad(curve, normal, -2.0f * v3_dot(along, curve) / slope);
}

static void hold(struct cloth *cloth, const struct crossing *crossing, bool outer_only)
{
	int a, b;
	const int *v = cloth->triangle[crossing->triangle].v;
	struct lowest lowest;
	if (!look_lowest(cloth, crossing->edge, crossing->triangle, crossing->side, &lowest))
		return;
	float lack = held_m - lowest.height;
	if (lack <= 0.0f || lowest.height < -lost_m)
		return;
	edge_ends(cloth, crossing->edge, &a, &b);
	const float *w = lowest.over.weight;
	struct sheet_point on_edge = {2, {a, b}, {1.0f - lowest.at, lowest.at}};
	struct sheet_point on_face = {3, {v[0], v[1], v[2]}, {w[0], w[1], w[2]}};
	self_part(cloth, &on_edge, &on_face,
		  v3_scale(lowest.over.normal, (float)crossing->side * lack), outer_only);
}

long self_hold_order(struct cloth *cloth)
{
	const struct cloth_self *self = cloth->self;
	for (int i = 0; i < self->crossing_count; i++)
		if (self->crossing[i].side)
			hold(cloth, &self->crossing[i], true);
	return 2L * self->crossing_count;
}

static bool pull(struct cloth *cloth, const struct crossing *crossing)
{
	int a, b;
	const int *v = cloth->triangle[crossing->triangle].v;
	struct v3 *x = cloth->position_m, corner[3];
	struct piercing piercing;
	edge_ends(cloth, crossing->edge, &a, &b);
	self_corners(cloth, crossing->triangle, corner);
	if (!pierces(x[a], x[b], corner, &piercing))
		return false;
	struct v3 step = gradient(cloth, crossing->edge, v3_normalize(piercing.normal));
	step = v3_scale(step, pull_m / sqrtf(v3_dot(step, step) + 0.01f));
	float s = piercing.at, edge = 0.5f / ((1.0f - s) * (1.0f - s) + s * s), face = 0.0f;
	x[a] = v3_mad(x[a], step, edge * (1.0f - s));
	x[b] = v3_mad(x[b], step, edge * s);
	for (int k = 0; k < 3; k++)
		face += piercing.weight[k] * piercing.weight[k];
	for (int k = 0; k < 3; k++)
		x[v[k]] = v3_mad(x[v[k]], step, -0.5f * piercing.weight[k] / face);
	return true;
}

long self_pull_crossings(struct cloth *cloth)
{
	const struct cloth_self *self = cloth->self;
	for (int i = 0; i < self->crossing_count; i++)
		if (self->crossing[i].side)
			hold(cloth, &self->crossing[i], false);
		else
			pull(cloth, &self->crossing[i]);
	return 4L * self->crossing_count;
}

int cloth_crossings(const struct cloth *cloth)
{
	int count = 0;
	for (int i = 0; i < cloth->self->crossing_count; i++)
		count += cloth->self->crossing[i].through;
	return count;
}

void cloth_flag_crossed(const struct cloth *cloth, uint8_t *flagged)
{
	for (int i = 0; i < cloth->self->crossing_count; i++) {
		const struct crossing *crossing = &cloth->self->crossing[i];
		for (int k = 0; k < 3; k++) {
			flagged[cloth->triangle[crossing->edge / 3].v[k]] = 1;
			flagged[cloth->triangle[crossing->triangle].v[k]] = 1;
		}
	}
}
