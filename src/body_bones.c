/* Bones that somebody else has found: the body's parts follow them. */
#include "body.h"

#include "body_private.h"

enum { RADIUS_SAMPLES = 8, TIDY_ROUNDS = 3 };

/* From just under the skin the way to a vertex's bone is free. */
static const float under_skin_m = 0.001f;
static const float girdle_reach = 0.6f;

static struct v3 nearest_on_bone(const struct bone *bone, struct v3 p)
{
	struct v3 along = v3_sub(bone->b_m, bone->a_m);
	float share = v3_dot(v3_sub(p, bone->a_m), along) / v3_dot(along, along);
	return v3_mad(bone->a_m, along, float_clamp(share, 0.0f, 1.0f));
}

/* The collar-bones and the hips reach less far than the limbs that they carry. */
static float reach_of(const struct body *body, int b)
{
	bool limb_before = false;
	for (int i = 0; i < b; i++)
		limb_before |= body->bone[i].part != PART_TRUNK;
	bool girdle = limb_before && body->bone[b].part == PART_TRUNK;
	return (girdle ? girdle_reach : 1.0f) * body->bone[b].radius_m;
}

static float measure_radius(const struct body *body, const struct bone *bone)
{
	float sum = 0.0f;
	for (int i = 0; i <= RADIUS_SAMPLES; i++) {
		struct body_hit hit;
		float share = (float)i / (float)RADIUS_SAMPLES;
		body_nearest(body, v3_lerp(bone->a_m, bone->b_m, share), 0, &hit);
		sum += float_abs(hit.distance_m);
	}
	return sum / (float)(RADIUS_SAMPLES + 1);
}

/* The bone that a vertex belongs to: the nearest, measured in the bone's own radii, that can be
 * seen from under the skin; a hand beside a thigh is nearer to the leg's bone, but through the air.
 */
static enum body_part part_of(const struct body *body, const float reach[BODY_BONES_MAX], int v)
{
	struct v3 p = v3_mad(body->position_m[v], body->normal[v], -under_skin_m);
	bool tried[BODY_BONES_MAX] = {false};
	int nearest = -1;
	for (int round = 0; round < body->bone_count; round++) {
		int best = -1;
		float least = 1e18f;
		for (int b = 0; b < body->bone_count; b++) {
			const struct bone *bone = &body->bone[b];
			float far = v3_distance(p, nearest_on_bone(bone, p)) / reach[b];
			if (!tried[b] && far < least) {
				least = far;
				best = b;
			}
		}
		struct body_hit hit;
		nearest = nearest < 0 ? best : nearest;
		if (!body_segment_hits(body, p, nearest_on_bone(&body->bone[best], p), &hit))
			return body->bone[best].part;
		tried[best] = true;
	}
	return body->bone[nearest].part;
}

/* A triangle becomes what most of its neighbours are. */
static void tidy(struct body *body)
{
	for (int t = 0; t < body->triangle_count; t++) {
		const int *across = body->neighbour + 3 * t;
		uint8_t a = body->part[across[0]], b = body->part[across[1]],
			c = body->part[across[2]];
		if (a == b || a == c)
			body->part[t] = a;
		else if (b == c)
			body->part[t] = b;
	}
}

static void label_by_bones(struct body *body)
{
	uint8_t *of_vertex = (uint8_t *)body->scratch->parts->owner;
	float reach[BODY_BONES_MAX];
	for (int b = 0; b < body->bone_count; b++)
		reach[b] = reach_of(body, b);
	for (int v = 0; v < body->vertex_count; v++)
		of_vertex[v] = (uint8_t)part_of(body, reach, v);
	for (int t = 0; t < body->triangle_count; t++) {
		const int *v = body->triangle[t].v;
		bool two = of_vertex[v[1]] == of_vertex[v[2]];
		body->part[t] = of_vertex[two ? v[1] : v[0]];
	}
	for (int round = 0; round < TIDY_ROUNDS; round++)
		tidy(body);
}

static bool in_box(const struct body *body, struct v3 p)
{
	const struct v3 low = body->low_m, high = body->high_m;
	return p.x >= low.x && p.y >= low.y && p.z >= low.z && p.x <= high.x && p.y <= high.y &&
	       p.z <= high.z;
}

const char *body_give_bones(struct body *body, const struct bone_list *bones, int *at)
{
	for (*at = 0; *at < bones->count; ++*at)
		if (!in_box(body, bones->bone[*at].a_m) || !in_box(body, bones->bone[*at].b_m))
			return "the bone lies outside the body; are its coordinates metres, and "
			       "those of this body?";
	body->bone_count = bones->count;
	memcpy(body->bone, bones->bone, sizeof body->bone);
	for (int b = 0; b < body->bone_count; b++)
		if (body->bone[b].radius_m < under_skin_m)
			body->bone[b].radius_m = float_max(measure_radius(body, &body->bone[b]),
							   under_skin_m);
	label_by_bones(body);
	body_find_landmarks(body);
	return NULL;
}
