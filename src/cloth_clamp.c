/* A bound on strain. Where contact pushes single particles and friction holds them, shape matching
 * and contact undo each other's work in every sweep, and the strain stays in a few triangles, at a
 * seam's end or over a bone. So after contact these go back to the bound, wholly and without
 * friction, and out of the body again: their neighbours follow, and the strain spreads out. */
#include "cloth_private.h"

enum {
	PASSES = 3,
	LOOK_UNITS = 1,
	CLAMP_UNITS = 2,
};

static const float move_most_m = 0.001f; /* of a corner in a pass */
static const float calm_m = 0.002f;      /* farther in a sweep: it moves */
static const float doubt = 1e-3f;        /* far more than roundings come to */
static const float watch_share = 0.8f;   /* of the bound: from there on a triangle is worked */

static bool is_pinned(const struct cloth *cloth, int v)
{
	return cloth->held[v] > 1;
}

/* Cloth that still moves may be on its way round a limb, and is let go its way. */
static bool is_free(const struct cloth *cloth, int v)
{
	struct v3 step = v3_sub(cloth->position_m[v], cloth->previous_m[v]);
	return !is_pinned(cloth, v) && v3_dot(step, step) < calm_m * calm_m;
}

/* What is clamped slides: friction has no part in it, and no momentum comes of it. Only what hangs
 * at a pin loses the motion that is taken back, or shaping would draw it off the pin by more in
 * every sweep. */
static void move(struct cloth *cloth, int v, struct v3 way, bool hangs)
{
	if (!is_free(cloth, v))
		return;
	cloth->position_m[v] = v3_add(cloth->position_m[v], way);
	if (!hangs)
		cloth->previous_m[v] = v3_add(cloth->previous_m[v], way);
}

/* What rests while a triangle shrinks, as a place along it: the corners that are pinned, or else
 * its centre. *hangs says which. */
static float rest_along(const struct cloth *cloth, const int *p, const float *along, bool *hangs)
{
	float pinned = 0.0f, of_pinned = 0.0f, of_all = 0.0f;
	for (int k = 0; k < 3; k++) {
		of_all += along[k];
		of_pinned += is_pinned(cloth, p[k]) ? along[k] : 0.0f;
		pinned += is_pinned(cloth, p[k]);
	}
	*hangs = pinned > 0.0f;
	return *hangs ? of_pinned / pinned : of_all * (1.0f / 3.0f);
}

/* Takes the larger principal stretch of triangle t back to the bound. With F = [e1 e2] [u1 u2]^-1
 * and v the direction on the flat cloth that F stretches most, the edges change by
 * (bound / stretch - 1) F v (v . u). */
static void clamp(struct cloth *cloth, int t, float bound)
{
	const struct garment *garment = cloth->garment;
	const int *r = garment->triangle[t].v, *p = cloth->triangle[t].v;
	const struct v3 *x = cloth->position_m;
	struct v2 u1 = v2_sub(garment->rest_m[r[1]], garment->rest_m[r[0]]);
	struct v2 u2 = v2_sub(garment->rest_m[r[2]], garment->rest_m[r[0]]);
	struct v3 e1 = v3_sub(x[p[1]], x[p[0]]), e2 = v3_sub(x[p[2]], x[p[0]]);
	float area = float_max(v2_cross(u1, u2), 1e-10f);
	struct v3 fx = v3_scale(v3_mad(v3_scale(e1, u2.y), e2, -u1.y), 1.0f / area);
	struct v3 fy = v3_scale(v3_mad(v3_scale(e2, u1.x), e1, -u2.x), 1.0f / area);
	float xx = v3_dot(fx, fx), yy = v3_dot(fy, fy), xy = v3_dot(fx, fy);
	float half = 0.5f * (xx - yy), root = sqrtf(half * half + xy * xy);
	float most = sqrtf(0.5f * (xx + yy) + root);
	if (most <= bound)
		return;
	struct v2 way = half > 0.0f ? (struct v2){half + root, xy} : (struct v2){xy, root - half};
	way = v2_normalize(way);
	struct v3 back = v3_scale(v3_mad(v3_scale(fx, way.x), fy, way.y), bound / most - 1.0f);
	bool hangs;
	const float along[3] = {0.0f, v2_dot(way, u1), v2_dot(way, u2)};
	float rest = rest_along(cloth, p, along, &hangs), farthest = 1e-9f;
	for (int k = 0; k < 3; k++)
		farthest = float_max(farthest, float_abs(along[k] - rest) * v3_length(back));
	back = v3_scale(back, float_min(1.0f, move_most_m / farthest));
	for (int k = 0; k < 3; k++)
		move(cloth, p[k], v3_scale(back, along[k] - rest), hangs);
}

/* Is cloth_stretch below `least`, beyond doubt? The same sums, but no root: with mean m of the
 * eigenvalues and q the square of what they differ from it, m + sqrt(q) < e where q < (e - m)^2. */
static bool slack(const struct cloth *cloth, const struct turn *turn, float least)
{
	const int *v = turn->v;
	const float *k = turn->metric;
	const struct v3 *x = cloth->position_m;
	struct v3 e1 = v3_sub(x[v[1]], x[v[0]]), e2 = v3_sub(x[v[2]], x[v[0]]);
	float g11 = v3_dot(e1, e1), g12 = v3_dot(e1, e2), g22 = v3_dot(e2, e2);
	float h11 = k[0] * g11 + k[1] * g12, h12 = k[0] * g12 + k[1] * g22;
	float h21 = k[1] * g11 + k[2] * g12, h22 = k[1] * g12 + k[2] * g22;
	float half = 0.5f * (h11 - h22), squared = half * half + h12 * h21;
	float room = (1.0f + least) * (1.0f + least) * (1.0f - doubt) - 0.5f * (h11 + h22);
	return room > 0.0f && squared < room * room;
}

/* Those of a slice that are near the bound. */
static void watch(struct cloth *cloth, int slice, float least)
{
	struct cloth_scratch *s = cloth->scratch;
	int triangles = cloth->garment->triangle_count;
	const struct turn *turn = &s->turn[sliced(triangles, slice)];
	for (int t = slice; t < triangles; t += SLICES, turn++)
		if (!slack(cloth, turn, least) && triangle_placed(cloth, t) &&
		    cloth_stretch(cloth, t) > least)
			s->taut[s->next_taut_count++] = t;
	if (slice < SLICES - 1)
		return;
	s->taut_count = s->next_taut_count;
	memcpy(s->clamped, s->taut, (size_t)s->taut_count * sizeof *s->taut);
	s->next_taut_count = 0;
}

long cloth_clamp(struct cloth *cloth)
{
	struct cloth_scratch *s = cloth->scratch;
	float bound = cloth->settings.strain_bound;
	long units = LOOK_UNITS * (cloth->garment->triangle_count / SLICES);
	if (bound <= 0.0f)
		return 0;
	for (int pass = 0; pass < PASSES; pass++) {
		for (int i = 0; i < s->taut_count; i++) {
			int t = s->clamped[pass & 1 ? s->taut_count - 1 - i : i];
			clamp(cloth, t, 1.0f + bound);
		}
		for (int i = 0; i < 3 * s->taut_count; i++) {
			int v = cloth->triangle[s->clamped[i / 3]].v[i % 3];
			if (is_free(cloth, v))
				units += cloth_touch(cloth, v);
		}
		units += CLAMP_UNITS * (long)s->taut_count;
	}
	watch(cloth, cloth->sweep % SLICES, watch_share * bound);
	return units;
}
