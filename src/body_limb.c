/* A limb along its bones: where a point lies beside them, how wide the limb is there, where hand or
 * foot begin, and the hull of its sections. */
#include "body_limb.h"

static const float section_m = 0.02f;
static const float hand_widening = 1.25f; /* hands and feet are so much wider than wrists */
static const float across_least = 0.3f;   /* cosine: a side farther round bounds nothing */

bool body_beside(const struct body *body, int part, struct v3 p_m, struct beside *beside)
{
	float best = 1e9f, before_m = 0.0f;
	int first = -1, last = -1;
	for (int b = 0; b < body->bone_count; b++)
		if ((int)body->bone[b].part == part && (first < 0 || last == b - 1)) {
			first = first < 0 ? b : first;
			last = b;
		}
	*beside = (struct beside){p_m, {0.0f, 1.0f, 0.0f}, 0.0f};
	for (int b = first; first >= 0 && b <= last; b++) {
		struct v3 a_m = body->bone[b].a_m, step = v3_sub(body->bone[b].b_m, a_m);
		float length = float_max(v3_length(step), 1e-4f);
		struct v3 along = v3_scale(step, 1.0f / length);
		float reach = v3_dot(v3_sub(p_m, a_m), along);
		reach = b > first ? float_max(reach, 0.0f) : reach;
		reach = b < last ? float_min(reach, length) : reach;
		struct v3 q = v3_mad(a_m, along, reach);
		float distance = v3_distance(q, p_m);
		if (distance < best) {
			best = distance;
			*beside = (struct beside){q, along, before_m + reach};
		}
		before_m += length;
	}
	return first >= 0;
}

struct v3 body_nearest_bone(const struct body *body, unsigned parts, struct v3 p_m)
{
	struct v3 nearest = p_m;
	float best = 1e9f;
	for (int b = 0; b < body->bone_count; b++) {
		if (parts && !(parts >> body->bone[b].part & 1))
			continue;
		struct v3 a_m = body->bone[b].a_m, step = v3_sub(body->bone[b].b_m, a_m);
		float t = v3_dot(v3_sub(p_m, a_m), step) / float_max(v3_dot(step, step), 1e-8f);
		struct v3 q = v3_mad(a_m, step, float_clamp(t, 0.0f, 1.0f));
		float distance = v3_distance(q, p_m);
		if (distance >= best)
			continue;
		best = distance;
		nearest = q;
	}
	return nearest;
}

static int section_of(float reach_m)
{
	return (int)float_clamp(reach_m / section_m, 0.0f, (float)(LIMB_SECTIONS - 1));
}

/* Two directions across the bones, to tell sides by. */
static void across(struct v3 along, struct v3 *u, struct v3 *w)
{
	bool upright = float_abs(along.y) > 0.9f;
	struct v3 aside = upright ? (struct v3){1.0f, 0.0f, 0.0f} : (struct v3){0.0f, 1.0f, 0.0f};
	*u = v3_normalize(v3_cross(along, aside));
	*w = v3_cross(along, *u);
}

/* The cosines of a direction `arm` (of any length) with the sides, times its length. */
static void on_sides(const struct beside *at, struct v3 arm, float cosine[LIMB_SIDES])
{
	static const float eighth[LIMB_SIDES / 4] = {0.0f, 0.38268343f, 0.70710678f, 0.92387953f};
	struct v3 u, w;
	across(at->along, &u, &w);
	float x = v3_dot(arm, u), y = v3_dot(arm, w);
	for (int i = 0; i < LIMB_SIDES / 4; i++) {
		float s = eighth[i], c = i == 0 ? 1.0f : eighth[LIMB_SIDES / 4 - i];
		cosine[i] = c * x + s * y;
		cosine[i + LIMB_SIDES / 4] = c * y - s * x;
		cosine[i + LIMB_SIDES / 2] = -cosine[i];
		cosine[i + 3 * LIMB_SIDES / 4] = -cosine[i + LIMB_SIDES / 4];
	}
}

static void widen(struct limb_shape *limb, const struct beside *at, struct v3 p_m)
{
	float cosine[LIMB_SIDES];
	struct v3 arm = v3_sub(p_m, at->axis_m);
	int i = section_of(at->reach_m);
	limb->end_m = float_max(limb->end_m, at->reach_m);
	on_sides(at, arm, cosine);
	for (int k = 0; k < LIMB_SIDES; k++)
		limb->hull_m[i][k] = float_max(limb->hull_m[i][k], cosine[k]);
}

/* By Cauchy's formula: a closed convex curve is as long as pi times its mean width. 0: no vertex.
 */
static float girth_of(const float hull_m[LIMB_SIDES])
{
	float sum_m = 0.0f;
	for (int k = 0; k < LIMB_SIDES; k++)
		sum_m += hull_m[k];
	return sum_m * 2.0f * PI_F / (float)LIMB_SIDES;
}

/* The last narrow place of a limb before it widens into hand or foot; far away where a limb does
 * not widen. */
static void find_wrist(struct limb_shape *limb)
{
	float narrow_m = LIMB_ENDLESS_M;
	int narrow = -1;
	limb->wrist_m = LIMB_ENDLESS_M;
	for (int i = 0; i < LIMB_SECTIONS; i++) {
		float girth_m = girth_of(limb->hull_m[i]);
		if (girth_m <= 0.0f)
			continue;
		if (girth_m <= narrow_m) {
			narrow_m = girth_m;
			narrow = i;
		} else if (girth_m > hand_widening * narrow_m) {
			limb->wrist_m = ((float)narrow + 1.0f) * section_m;
		}
	}
}

/* Takes points of an edge so near to each other that no section between them goes without. */
static void widen_along(const struct body *body, int part, struct limb_shape *limb, struct v3 a_m,
			struct v3 b_m)
{
	int steps = 1 + (int)(v3_distance(a_m, b_m) / (0.5f * section_m));
	for (int i = 0; i < steps; i++) {
		struct beside at;
		struct v3 p_m = v3_lerp(a_m, b_m, (float)i / (float)steps);
		if (body_beside(body, part, p_m, &at))
			widen(limb, &at, p_m);
	}
}

void body_measure_limbs(const struct body *body, struct limb_shape limb[PART_COUNT])
{
	memset(limb, 0, PART_COUNT * sizeof *limb);
	for (int t = 0; t < body->triangle_count; t++)
		for (int k = 0; k < 3 && body->part[t] != PART_TRUNK; k++) {
			const int *v = body->triangle[t].v;
			widen_along(body, body->part[t], &limb[body->part[t]],
				    body->position_m[v[k]], body->position_m[v[(k + 1) % 3]]);
		}
	for (int part = 0; part < PART_COUNT; part++)
		find_wrist(&limb[part]);
}

float limb_hull(const struct limb_shape *limb, const struct beside *at, struct v3 p_m)
{
	float cosine[LIMB_SIDES], least_m = LIMB_ENDLESS_M;
	struct v3 arm = v3_sub(p_m, at->axis_m);
	int i = section_of(at->reach_m);
	float length = float_max(v3_length(arm), 1e-6f);
	on_sides(at, v3_scale(arm, 1.0f / length), cosine);
	for (int k = 0; k < LIMB_SIDES; k++) {
		float wide_m = limb->hull_m[i][k];
		if (i > 0)
			wide_m = float_max(wide_m, limb->hull_m[i - 1][k]);
		if (i + 1 < LIMB_SECTIONS)
			wide_m = float_max(wide_m, limb->hull_m[i + 1][k]);
		if (cosine[k] > across_least)
			least_m = float_min(least_m, wide_m / cosine[k]);
	}
	return least_m < LIMB_ENDLESS_M ? least_m : 0.0f;
}
