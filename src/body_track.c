/* The nearest point of a point that moves, and where a walk to it can be trusted. */
#include "body_private.h"

enum {
	CLEAR_ROUNDS = 10,
	WALK_STEPS_MAX = 12,
	EXACT_UNITS = 32, /* an exact query takes as long as looking at so many triangles */
};

static const float clear_max_m = 0.08f;
static const float clear_slack_m = 0.00025f; /* how much nearer something else may be */
static const float clear_share = 0.7f;       /* of clear_m is trusted: it is known at samples */
static const float inside_m = 0.002f;        /* a walk in the body is trusted so deep */
static const float track_slack_m = 0.0005f;  /* what a walk may be off by */
static const float far_share = 0.25f;

/* ---- where a walk can be trusted ----
 *
 * A ball that touches the surface at q from outside and holds no other point of it shows that q is
 * nearest to the ball's centre. The largest such ball by shrinking (Ma, Bae and Choi, "3D medial
 * axis point approximation using nearest neighbors and the normal field", Visual Computer 2012);
 * the surface may reach clear_slack_m into it. */
static float clear_above(const struct body *body, struct v3 q, struct v3 n, int t)
{
	float w = clear_max_m;
	struct v3 raised = v3_mad(q, n, clear_slack_m);
	for (int round = 0; round < CLEAR_ROUNDS && w > 2.0f * clear_slack_m; round++) {
		struct v3 centre = v3_mad(q, n, w);
		struct nearest best = nearest_none;
		near_look(body, centre, t, &best);
		near_search(body, centre, 0, &best);
		if (near_signed_m(body, centre, &best) >= w - clear_slack_m)
			return w;
		struct v3 x = v3_sub(best.point_m, raised);
		float height = v3_dot(n, x);
		float smaller = height > 0.0f ? 0.5f * v3_dot(x, x) / height + clear_slack_m : 0.0f;
		w = float_min(smaller, 0.98f * w);
	}
	return 0.0f;
}

/* The least of a triangle's centre and corners. */
void body_find_clear(struct body *body)
{
	float *corner = body->scratch->clear_m;
	for (int v = 0; v < body->vertex_count; v++)
		corner[v] = clear_above(body, body->position_m[v], body->normal[v],
					body->star[body->star_first[v]]);
	for (int t = 0; t < body->triangle_count; t++) {
		const int *v = body->triangle[t].v;
		struct v3 sum = v3_add(v3_add(body->position_m[v[0]], body->position_m[v[1]]),
				       body->position_m[v[2]]);
		float least = float_min(corner[v[0]], float_min(corner[v[1]], corner[v[2]]));
		float centre = clear_above(body, v3_scale(sum, 1.0f / 3.0f), body->face_normal[t],
					   t);
		body->clear_m[t] = clear_share * float_min(least, centre);
	}
}

/* ---- tracking ---- */

static void take(const struct body *body, struct v3 p, const struct nearest *best, unsigned parts,
		 struct body_hit *hit)
{
	float d = near_signed_m(body, p, best), length = float_abs(d);
	struct v3 away = v3_sub(p, best->point_m);
	hit->triangle = best->triangle;
	hit->point_m = best->point_m;
	hit->distance_m = parts && near_on_rim(body, best, parts) ? length + near_rim_m : d;
	hit->normal = length > 1e-5f ? v3_scale(away, 1.0f / d)
				     : body_smooth_normal(body, best->triangle, best->point_m);
}

/* Is what the walk found the nearest there is? */
static bool trusted(const struct body *body, struct body_track *track, const struct nearest *best,
		    float distance_m, unsigned parts)
{
	float length = float_abs(distance_m);
	if (parts && near_on_rim(body, best, parts))
		return false;
	if (length <= body->clear_m[best->triangle] && distance_m > -inside_m)
		track->least_m = float_max(track->least_m, length - track_slack_m);
	return length <= track->least_m + track_slack_m;
}

static bool look_exactly(const struct body *body, struct v3 p, unsigned parts, struct nearest best,
			 struct body_track *track, struct body_hit *hit)
{
	struct nearest walked = best;
	near_search(body, p, parts, &best);
	float least = sqrtf(best.d2);
	*track = (struct body_track){best.triangle, parts, p, least};
	/* where two limbs are equally near a point that changed sides would never rest */
	if (sqrtf(walked.d2) <= least + track_slack_m)
		best = walked;
	take(body, p, &best, parts, hit);
	track->triangle = best.triangle;
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
		return look_exactly(body, point_m, parts, best, track, hit);
	}
	float way = v3_distance(point_m, track->at_m);
	if (track->least_m - way > BODY_NEAR_M) {
		if (way < body_track_idle_m(track))
			return false;
		*units += EXACT_UNITS;
		return look_exactly(body, point_m, parts, best, track, hit);
	}
	track->at_m = point_m;
	track->least_m -= way;
	near_look(body, point_m, track->triangle, &best);
	*units += 1 + near_walk(body, point_m, parts, WALK_STEPS_MAX, &best);
	take(body, point_m, &best, parts, hit);
	track->triangle = best.triangle;
	if (trusted(body, track, &best, hit->distance_m, parts))
		return true;
	*units += EXACT_UNITS;
	return look_exactly(body, point_m, parts, best, track, hit);
}
