/* Is the garment wide enough? Planes across the bones, and beside the garment's rims, cut the drape
 * into closed curves. A curve's length on the flat cloth is what there is; the girth of the body's
 * section inside it, as a tape measures it, is what is needed. */
#include "measure_private.h"

static const float station_m = 0.04f; /* from plane to plane along a bone */
static const float beside_m = 0.008f; /* from a rim into the cloth: a curve on the rim itself would
					 leave it */
static const float inside_share = 0.9f; /* of a section's points that a curve round it holds: at the
					   crotch a trouser leg holds half of a section */

struct plane {
	struct v3 origin_m, normal, u, v;
};

/* A closed curve's corners in the plane. */
struct curve {
	int count;
	struct v2 *point_m;
	float rest_m;
};

/* How far a section reaches in every direction; its hull's girth is the integral of that over the
 * full turn (Cauchy). */
struct span {
	float far_m[GIRTH_DIRECTIONS];
};

static struct plane plane_across(struct v3 origin_m, struct v3 axis)
{
	struct plane plane = {.origin_m = origin_m, .normal = v3_normalize(axis)};
	struct v3 aside = float_abs(plane.normal.x) < 0.7f ? (struct v3){1.0f, 0.0f, 0.0f}
							   : (struct v3){0.0f, 0.0f, 1.0f};
	plane.u = v3_normalize(v3_cross(plane.normal, aside));
	plane.v = v3_cross(plane.normal, plane.u);
	return plane;
}

static float height(const struct plane *plane, struct v3 point_m)
{
	return v3_dot(v3_sub(point_m, plane->origin_m), plane->normal);
}

static struct v2 flat(const struct plane *plane, struct v3 point_m)
{
	struct v3 d = v3_sub(point_m, plane->origin_m);
	return (struct v2){v3_dot(d, plane->u), v3_dot(d, plane->v)};
}

/* Is the edge from a to b cut? *share says where. */
static bool cuts(float a_m, float b_m, float *share)
{
	if ((a_m < 0.0f) == (b_m < 0.0f))
		return false;
	*share = a_m / (a_m - b_m);
	return true;
}

/* ---- the cloth's curves ---- */

/* Where the plane cuts edge k of triangle t, in space and on the flat piece. */
static bool cut_cloth(const struct cloth *cloth, const struct plane *plane, int t, int k,
		      struct v2 *place_m, struct v2 *rest_m)
{
	const struct garment *garment = cloth->garment;
	const int *v = cloth->triangle[t].v, *r = garment->triangle[t].v;
	int next = (k + 1) % 3;
	struct v3 a = cloth->position_m[v[k]], b = cloth->position_m[v[next]];
	float share;
	if (!cuts(height(plane, a), height(plane, b), &share))
		return false;
	*place_m = flat(plane, v3_lerp(a, b, share));
	*rest_m = v2_lerp(garment->rest_m[r[k]], garment->rest_m[r[next]], share);
	return true;
}

/* Follows the plane through the cloth from triangle to triangle until it is back. False: it comes
 * to a rim, or meets more than two triangles at an edge. */
static bool walk_curve(const struct cloth *cloth, struct measure_scratch *s,
		       const struct plane *plane, int first, struct curve *curve)
{
	int t = first, came_by = -1;
	*curve = (struct curve){.point_m = s->curve_m};
	for (;;) {
		struct v2 place_m[2] = {{0.0f, 0.0f}, {0.0f, 0.0f}}, rest_m[2];
		int edge[2] = {-1, -1}, found = 0;
		for (int k = 0; k < 3 && found < 2; k++)
			if (cut_cloth(cloth, plane, t, k, &place_m[found], &rest_m[found]))
				edge[found++] = s->edge_of[3 * t + k];
		s->cut[t] = 1;
		if (found < 2)
			return false;
		int leave = edge[0] == came_by || came_by < 0 ? 1 : 0;
		curve->rest_m += v2_distance(rest_m[0], rest_m[1]);
		curve->point_m[curve->count++] = place_m[leave];
		came_by = edge[leave];
		if (came_by < 0 || s->edge[came_by].triangle_count != 2)
			return false;
		const int *side = s->edge[came_by].triangle;
		t = side[0] == t ? side[1] : side[0];
		if (t == first)
			return true;
		if (s->cut[t])
			return false;
	}
}

/* Is the point inside the curve? Odd crossings of a ray. */
static bool holds(const struct curve *curve, struct v2 p)
{
	bool inside = false;
	for (int i = 0; i < curve->count; i++) {
		struct v2 a = curve->point_m[i], b = curve->point_m[(i + 1) % curve->count];
		if ((a.y <= p.y) != (b.y <= p.y))
			inside ^= p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y);
	}
	return inside;
}

/* ---- the body's sections ---- */

static bool cut_body(const struct body *body, const struct plane *plane, int t, int k,
		     struct v2 *place_m)
{
	const int *v = body->triangle[t].v;
	struct v3 a = body->position_m[v[k]], b = body->position_m[v[(k + 1) % 3]];
	float share;
	if (!cuts(height(plane, a), height(plane, b), &share))
		return false;
	*place_m = flat(plane, v3_lerp(a, b, share));
	return true;
}

static void widen(struct span *span, const struct v2 direction[GIRTH_DIRECTIONS], struct v2 p)
{
	for (int d = 0; d < GIRTH_DIRECTIONS; d++)
		span->far_m[d] = float_max(span->far_m[d], v2_dot(direction[d], p));
}

/* One section from triangle `first` round: widens *span by it when the curve holds it. False: it
 * lies across the curve. */
static bool walk_section(const struct cloth *cloth, struct measure_scratch *s,
			 const struct plane *plane, int first, const struct curve *curve,
			 struct span *span)
{
	const struct body *body = cloth->body;
	struct span own = *span;
	int count = 0, inside = 0, t = first;
	while (t >= 0 && !s->body_cut[t]) {
		int next = -1;
		struct v2 place_m;
		s->body_cut[t] = 1;
		for (int k = 0; k < 3; k++) {
			if (!cut_body(body, plane, t, k, &place_m))
				continue;
			int across = body->neighbour[3 * t + k];
			if (across >= 0 && !s->body_cut[across])
				next = across;
			widen(&own, s->direction, place_m);
			inside += holds(curve, place_m);
			count++;
		}
		t = next;
	}
	if ((float)inside >= inside_share * (float)count)
		*span = own;
	return (float)inside >= inside_share * (float)count ||
	       (float)inside <= (1.0f - inside_share) * (float)count;
}

/* The girth of all sections inside the curve; 0: there are none, or one lies across it. */
static float body_girth(const struct cloth *cloth, struct measure_scratch *s,
			const struct plane *plane, const struct curve *curve)
{
	struct span span;
	struct v2 place_m;
	float girth_m = 0.0f;
	for (int d = 0; d < GIRTH_DIRECTIONS; d++)
		span.far_m[d] = -1e9f;
	memset(s->body_cut, 0, (size_t)cloth->body->triangle_count);
	for (int t = 0; t < cloth->body->triangle_count; t++) {
		bool cut = cut_body(cloth->body, plane, t, 0, &place_m) ||
			   cut_body(cloth->body, plane, t, 1, &place_m);
		if (cut && !s->body_cut[t] && !walk_section(cloth, s, plane, t, curve, &span))
			return 0.0f;
	}
	if (span.far_m[0] < -1e8f)
		return 0.0f;
	for (int d = 0; d < GIRTH_DIRECTIONS; d++)
		girth_m += span.far_m[d] * 2.0f * PI_F / (float)GIRTH_DIRECTIONS;
	return girth_m;
}

/* ---- planes ---- */

/* The part whose bones pass through the curve; the trunk when several do; -1: none. */
static int part_inside(const struct body *body, const struct plane *plane,
		       const struct curve *curve)
{
	int found = -1;
	for (int b = 0; b < body->bone_count; b++) {
		const struct bone *bone = &body->bone[b];
		float share;
		if (!cuts(height(plane, bone->a_m), height(plane, bone->b_m), &share) ||
		    !holds(curve, flat(plane, v3_lerp(bone->a_m, bone->b_m, share))))
			continue;
		found = found < 0 || found == (int)bone->part ? (int)bone->part : PART_TRUNK;
	}
	return found;
}

static void keep_girth(struct measure *measure, const struct plane *plane, int part, float cloth_m,
		       float body_m)
{
	struct girth *girth = &measure->girth[part];
	if (girth->body_m > 0.0f && cloth_m * girth->body_m >= girth->cloth_m * body_m)
		return;
	*girth = (struct girth){cloth_m, body_m, plane->origin_m};
}

static void cut_at(struct measure *measure, const struct cloth *cloth, struct measure_scratch *s,
		   const struct plane *plane)
{
	struct curve curve;
	struct v2 place_m, rest_m;
	memset(s->cut, 0, (size_t)cloth->garment->triangle_count);
	for (int t = 0; t < cloth->garment->triangle_count; t++) {
		bool cut = cut_cloth(cloth, plane, t, 0, &place_m, &rest_m) ||
			   cut_cloth(cloth, plane, t, 1, &place_m, &rest_m);
		if (!cut || s->cut[t] || !measure_placed(cloth, t) ||
		    !walk_curve(cloth, s, plane, t, &curve))
			continue;
		int part = part_inside(cloth->body, plane, &curve);
		float girth_m = part < 0 ? 0.0f : body_girth(cloth, s, plane, &curve);
		if (girth_m > 0.0f)
			keep_girth(measure, plane, part, curve.rest_m, girth_m);
	}
}

void measure_girth_at_rim(struct measure *measure, const struct cloth *cloth,
			  struct measure_scratch *s, int count)
{
	struct v3 centre = {0.0f, 0.0f, 0.0f}, normal = {0.0f, 0.0f, 0.0f};
	for (int i = 0; i < count; i++)
		centre = v3_mad(centre, s->rim_m[i], 1.0f / (float)count);
	for (int i = 0; i < count; i++)
		normal = v3_add(normal, v3_cross(v3_sub(s->rim_m[i], centre),
						 v3_sub(s->rim_m[(i + 1) % count], centre)));
	normal = v3_normalize(normal);
	for (int side = -1; side <= 1; side += 2) {
		struct plane plane = plane_across(v3_mad(centre, normal, (float)side * beside_m),
						  normal);
		cut_at(measure, cloth, s, &plane);
	}
}

void measure_girths(struct measure *measure, const struct cloth *cloth, struct measure_scratch *s)
{
	for (int b = 0; b < cloth->body->bone_count; b++) {
		const struct bone *bone = &cloth->body->bone[b];
		struct v3 along = v3_sub(bone->b_m, bone->a_m);
		int stations = 1 + (int)(v3_length(along) / station_m);
		for (int i = 0; i < stations; i++) {
			float share = ((float)i + 0.5f) / (float)stations;
			struct plane plane = plane_across(v3_lerp(bone->a_m, bone->b_m, share),
							  along);
			cut_at(measure, cloth, s, &plane);
		}
	}
}
