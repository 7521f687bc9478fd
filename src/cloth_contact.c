/* Contact with the body: every particle tracks its own nearest surface point (S17). */
#include "cloth_private.h"

enum {
	WALK_EVERY = 3,   /* sweeps between walks of one particle; the plane serves in between */
	EXACT_EVERY = 16, /* walks between exact queries, which find the way off a wrong limb */
	WALK_STEPS_MAX = 12,
};

static const float near_m = 0.03f;      /* farther cloth can't touch in the next sweeps */
static const float push_max_m = 0.015f; /* deepest step out in one sweep */

static void take_hit(struct contact *contact, struct v3 p, const struct body_hit *hit)
{
	struct v3 away = v3_sub(p, hit->point_m);
	float length = v3_length(away);
	contact->triangle = hit->triangle;
	contact->point_m = hit->point_m;
	contact->distance_m = hit->distance_m;
	contact->normal = hit->normal;
	if (length > 1e-5f)
		contact->normal = v3_scale(away, (hit->distance_m < 0.0f ? -1.0f : 1.0f) / length);
}

void cloth_look(struct cloth *cloth, int v)
{
	struct body_hit hit;
	body_nearest_from(cloth->body, cloth->position_m[v], allowed_parts(cloth, v),
			  cloth->contact[v].triangle, &hit);
	take_hit(&cloth->contact[v], cloth->position_m[v], &hit);
}

/* A walk may end on a part that the piece must not touch yet; then only the exact query will do. */
static long walk(struct cloth *cloth, int v)
{
	struct body_hit hit;
	struct contact *contact = &cloth->contact[v];
	unsigned parts = allowed_parts(cloth, v);
	int looked = body_walk(cloth->body, cloth->position_m[v], contact->triangle, WALK_STEPS_MAX,
			       &hit);
	if (parts && !(parts >> cloth->body->part[hit.triangle] & 1)) {
		cloth_look(cloth, v);
		return looked + 64;
	}
	take_hit(contact, cloth->position_m[v], &hit);
	return looked;
}

static long refresh(struct cloth *cloth, int v)
{
	int turn = cloth->sweep + v;
	if (cloth->contact[v].triangle < 0 || turn % (WALK_EVERY * EXACT_EVERY) == 0) {
		cloth_look(cloth, v);
		return 64;
	}
	return turn % WALK_EVERY == 0 ? walk(cloth, v) : 1;
}

/* Out along the normal, then friction takes a share of the tangential step. */
static void push(struct cloth *cloth, int v)
{
	const struct contact *contact = &cloth->contact[v];
	struct v3 *p = &cloth->position_m[v], n = contact->normal;
	float d = v3_dot(v3_sub(*p, contact->point_m), n);
	if (contact->distance_m > near_m && d > 0.5f * near_m)
		return;
	float out = cloth->settings.offset_m - d;
	if (out <= 0.0f)
		return;
	*p = v3_mad(*p, n, float_min(out, push_max_m));
	struct v3 step = v3_sub(*p, cloth->scratch->start_m[v]);
	step = v3_mad(step, n, -v3_dot(step, n));
	*p = v3_mad(*p, step, -cloth->settings.friction);
}

long cloth_contact(struct cloth *cloth)
{
	long units = 0;
	for (int v = 0; v < cloth->garment->vertex_count; v++) {
		if (!is_particle(cloth, v))
			continue;
		units += refresh(cloth, v);
		push(cloth, v);
	}
	return units;
}

/* A point inside a face, as weights of its corners, stays outside the body too. */
static long push_point(struct cloth *cloth, const int v[3], const float weight[3])
{
	struct v3 p = {0.0f, 0.0f, 0.0f}, *x = cloth->position_m;
	float squares = 0.0f, offset = 0.6f * cloth->settings.offset_m;
	int nearest = 0;
	for (int k = 0; k < 3; k++) {
		p = v3_mad(p, x[v[k]], weight[k]);
		squares += weight[k] * weight[k];
		nearest = weight[k] > weight[nearest] ? k : nearest;
	}
	struct body_hit hit;
	int looked = body_walk(cloth->body, p, cloth->contact[v[nearest]].triangle, WALK_STEPS_MAX,
			       &hit);
	if (hit.distance_m >= offset || hit.distance_m < -near_m)
		return looked;
	struct contact contact;
	take_hit(&contact, p, &hit);
	float out = 0.7f * float_min(offset - hit.distance_m, 0.01f) / squares;
	for (int k = 0; k < 3; k++)
		x[v[k]] = v3_mad(x[v[k]], contact.normal, out * weight[k]);
	return looked;
}

/* Slice `slice` of `slices` of all triangles: midpoints of edges and centres. */
long cloth_contact_faces(struct cloth *cloth, int slice, int slices)
{
	static const float third = 1.0f / 3.0f;
	const float weight[4][3] = {
		{0.5f, 0.5f, 0.0f}, {0.0f, 0.5f, 0.5f}, {0.5f, 0.0f, 0.5f}, {third, third, third}};
	float close_m = 1.15f * cloth->settings.offset_m;
	long units = 0;
	for (int t = slice; t < cloth->garment->triangle_count; t += slices) {
		const int *v = cloth->triangle[t].v;
		if (!triangle_placed(cloth, t))
			continue;
		int close = 0;
		for (int k = 0; k < 3; k++)
			close += cloth->contact[v[k]].triangle >= 0 &&
				 cloth->contact[v[k]].distance_m < close_m;
		for (int i = 0; close >= 2 && i < 4; i++)
			units += push_point(cloth, v, weight[i]);
	}
	return units;
}
