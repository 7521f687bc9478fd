/* Edges of cloth against bones: what has come through a thin limb is on the wrong side of its bone,
 * where the nearest surface would keep it (Igarashi and Hughes 2002, section on skinning of limbs).
 */
#include "body.h"

/* An edge nearer to the bone than this share of the limb's mean radius may be inside; limbs are not
 * round, so there the surface itself is asked. */
static const float core_share = 0.75f;

/* Below this length the sum of the ends' normals says nothing: the ends lie on opposite sides. */
static const float outward_least = 0.3f;

/* The nearest points of two segments, as shares of their ways (Ericson, Real-Time Collision
 * Detection, 5.1.9). Both have a length. */
static void nearest_shares(struct v3 p, struct v3 d, struct v3 q, struct v3 e, float *s, float *t)
{
	struct v3 r = v3_sub(p, q);
	float a = v3_dot(d, d), b = v3_dot(d, e), c = v3_dot(d, r), f = v3_dot(e, r),
	      g = v3_dot(e, e), cross = a * g - b * b;
	*s = cross > 1e-12f * a * g ? float_clamp((b * f - c * g) / cross, 0.0f, 1.0f) : 0.5f;
	*t = (b * *s + f) / g;
	if (*t < 0.0f || *t > 1.0f) {
		*t = float_clamp(*t, 0.0f, 1.0f);
		*s = float_clamp((*t * b - c) / a, 0.0f, 1.0f);
	}
}

/* Where the edge should leave to: away from the bone, at right angles to it, to the side of
 * `outward` when that says one. */
static struct v3 way_out(struct v3 axis, struct v3 outward, struct v3 from_bone)
{
	struct v3 out = v3_mad(outward, axis, -v3_dot(outward, axis));
	if (v3_length(out) < outward_least)
		out = v3_mad(from_bone, axis, -v3_dot(from_bone, axis));
	return v3_normalize(out);
}

bool body_bone_crossed(const struct body *body, enum body_part part, struct v3 a_m, struct v3 b_m,
		       struct v3 outward, struct v3 *push_m)
{
	bool crossed = false;
	float deepest_m = 0.0f;
	struct v3 edge = v3_sub(b_m, a_m);
	if (part == PART_TRUNK || !(v3_dot(edge, edge) > 0.0f))
		return false;
	for (int i = 0; i < body->bone_count; i++) {
		const struct bone *bone = &body->bone[i];
		if (bone->part != part)
			continue;
		float s, t, core_m = core_share * bone->radius_m;
		struct v3 way = v3_sub(bone->b_m, bone->a_m);
		nearest_shares(bone->a_m, way, a_m, edge, &s, &t);
		struct v3 from_bone = v3_sub(v3_mad(a_m, edge, t), v3_mad(bone->a_m, way, s));
		if (s <= 0.0f || s >= 1.0f || v3_dot(from_bone, from_bone) >= core_m * core_m)
			continue;
		struct body_hit hit;
		body_nearest(body, v3_mad(a_m, edge, t), 0, &hit);
		if (hit.distance_m >= 0.0f)
			continue;
		struct v3 out = way_out(v3_normalize(way), outward, from_bone);
		float depth_m = bone->radius_m - v3_dot(from_bone, out);
		if (depth_m <= deepest_m)
			continue;
		crossed = true;
		deepest_m = depth_m;
		*push_m = v3_scale(out, depth_m);
	}
	return crossed;
}
