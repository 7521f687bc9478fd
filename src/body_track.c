/* The nearest point of a point that moves, and where a walk to it can be trusted. */
#include "body_private.h"

enum {
	CLEAR_ROUNDS = 10,
	WALK_STEPS_MAX = 12,
	EXACT_UNITS = 32, /* an exact query takes as long as looking at so many triangles */
};

static const float clear_max_m = 0.08f;
static const float clear_slack_m = 0.00025f; /* the surface may reach so far into a ball's cap */
static const float trusted_off_m = 0.0009f;  /* what a walk may be off by */
static const float settled_off_m = 0.0005f;  /* ... and be kept where an exact query was made */
static const float far_share = 0.25f, far_found = 0.9f;

/* ---- where a walk can be trusted ----
 *
 * Distance grows no quicker than the point moves: from the centre of a ball that holds no surface,
 * of radius r, the nearest surface to a point at distance s from it is no nearer than r - s. Large
 * balls that touch the surface from outside are so good witnesses for the points between it and
 * their centres. The largest ball by shrinking (Ma, Bae and Choi, "3D medial axis point
 * approximation using nearest neighbors and the normal field", Visual Computer 2012). */
static struct ball clear_above(const struct body *body, struct v3 q, struct v3 n, int t)
{
	float w = clear_max_m;
	struct v3 raised = v3_mad(q, n, clear_slack_m);
	for (int round = 0; round < CLEAR_ROUNDS && w > 2.0f * clear_slack_m; round++) {
		struct v3 centre = v3_mad(q, n, w);
		struct nearest best = nearest_none;
		near_look(body, centre, t, &best);
		near_search(body, centre, 0, 1.0f, &best);
		float radius = near_signed_m(body, centre, &best);
		if (radius >= w - clear_slack_m)
			return (struct ball){centre, radius};
		struct v3 x = v3_sub(best.point_m, raised);
		float height = v3_dot(n, x);
		float smaller = height > 0.0f ? 0.5f * v3_dot(x, x) / height + clear_slack_m : 0.0f;
		w = float_min(smaller, 0.98f * w);
	}
	return (struct ball){q, 0.0f};
}

void body_find_clear(struct body *body)
{
	for (int v = 0; v < body->vertex_count; v++)
		body->corner_clear[v] = clear_above(body, body->position_m[v], body->normal[v],
						    body->star[body->star_first[v]]);
	for (int t = 0; t < body->triangle_count; t++) {
		const int *v = body->triangle[t].v;
		struct v3 sum = v3_add(v3_add(body->position_m[v[0]], body->position_m[v[1]]),
				       body->position_m[v[2]]);
		body->clear[t] = clear_above(body, v3_scale(sum, 1.0f / 3.0f), body->face_normal[t],
					     t);
	}
}

/* No surface is nearer to p. */
static float least_by(const struct ball *ball, struct v3 p)
{
	return ball->radius_m - v3_distance(ball->centre_m, p);
}

/* The best that the balls on a triangle say, once one says `enough`. */
static float least_over(const struct body *body, int t, struct v3 p, float enough)
{
	float least = least_by(&body->clear[t], p);
	for (int k = 0; least < enough && k < 3; k++)
		least = float_max(least, least_by(&body->corner_clear[body->triangle[t].v[k]], p));
	return least;
}

/* A ball holds the whole way between two points in it. */
bool body_clear_between(const struct body *body, int t, struct v3 a_m, struct v3 b_m)
{
	const struct ball *ball = &body->clear[t];
	for (int k = 0; k < 4; k++) {
		if (float_min(least_by(ball, a_m), least_by(ball, b_m)) > clear_slack_m)
			return true;
		if (k < 3)
			ball = &body->corner_clear[body->triangle[t].v[k]];
	}
	return false;
}

/* ---- tracking ---- */

static void take(const struct body *body, struct v3 p, const struct nearest *best, unsigned parts,
		 struct body_hit *hit)
{
	struct v3 away = v3_sub(p, best->point_m), side = side_normal(body, best);
	float length = sqrtf(best->d2), d = v3_dot(away, side) < 0.0f ? -length : length;
	hit->triangle = best->triangle;
	hit->point_m = best->point_m;
	hit->distance_m = parts && near_on_rim(body, best, parts) ? length + near_rim_m : d;
	if (best->feature == ON_FACE)
		hit->normal = side;
	else if (length > 1e-5f)
		hit->normal = v3_scale(away, 1.0f / d);
	else
		hit->normal = body_smooth_normal(body, best->triangle, best->point_m);
}

/* Is what the walk found the nearest there is? */
static bool trusted(const struct body *body, struct body_track *track, const struct nearest *best,
		    struct v3 p, unsigned parts)
{
	float length = sqrtf(best->d2), enough = length - trusted_off_m;
	if (parts && near_on_rim(body, best, parts))
		return false;
	float least = float_max(least_over(body, best->triangle, p, enough), 0.0f);
	track->least_m = float_min(float_max(track->least_m, least), length);
	track->off_m = length - track->least_m;
	return track->off_m <= trusted_off_m;
}

/* Where two limbs are equally near a point that changed sides would never rest. */
static bool look_exactly(const struct body *body, struct v3 p, unsigned parts, struct nearest best,
			 struct body_track *track, struct body_hit *hit)
{
	struct nearest walked = best;
	near_search(body, p, parts, 1.0f, &best);
	float least = sqrtf(best.d2), length = sqrtf(walked.d2);
	if (length <= least + settled_off_m)
		best = walked;
	*track = (struct body_track){best.triangle, parts, p, least, sqrtf(best.d2) - least};
	take(body, p, &best, parts, hit);
	return true;
}

/* What is far need not be found exactly. */
static bool look_far(const struct body *body, struct v3 p, unsigned parts, struct nearest best,
		     struct body_track *track, struct body_hit *hit)
{
	near_search(body, p, parts, far_found, &best);
	float length = sqrtf(best.d2), least = far_found * length;
	if (least <= BODY_NEAR_M)
		return look_exactly(body, p, parts, best, track, hit);
	*track = (struct body_track){best.triangle, parts, p, least, length - least};
	take(body, p, &best, parts, hit);
	return true;
}

float body_track_idle_m(const struct body_track *track)
{
	return float_min(far_share * track->least_m, track->least_m - BODY_NEAR_M);
}

bool body_track(const struct body *body, struct v3 point_m, unsigned parts,
		struct body_track *track, struct body_hit *hit, long *units)
{
	struct nearest best = nearest_none;
	if (track->triangle < 0 || parts != track->parts) {
		*units += EXACT_UNITS;
		return look_far(body, point_m, parts, best, track, hit);
	}
	float way = v3_distance(point_m, track->at_m);
	if (track->least_m - way > BODY_NEAR_M) {
		if (way < body_track_idle_m(track))
			return false;
		*units += EXACT_UNITS;
		near_look(body, point_m, track->triangle, &best);
		return look_far(body, point_m, parts, best, track, hit);
	}
	track->at_m = point_m;
	track->least_m -= way;
	*units += near_descend(body, point_m, parts, track->triangle, WALK_STEPS_MAX, &best);
	track->triangle = best.triangle;
	if (!trusted(body, track, &best, point_m, parts)) {
		*units += EXACT_UNITS;
		return look_exactly(body, point_m, parts, best, track, hit);
	}
	take(body, point_m, &best, parts, hit);
	return true;
}
