/* Contact with the body: every particle tracks its own nearest surface point (S17). */
#include "cloth_private.h"

enum {
	WALK_EVERY = 3,      /* sweeps between walks of one particle; the plane serves in between */
	WALK_FAR_EVERY = 12, /* the same for a particle that can't touch soon */
	EXACT_EVERY = 96,    /* sweeps between exact queries, which find the way off a wrong limb */
	EXACT_WRAP_EVERY = 48,
	WALK_STEPS_MAX = 12,
};

static const float near_m = 0.03f;         /* farther cloth can't touch in the next sweeps */
static const float far_m = 0.08f;          /* farther cloth can't touch within WALK_FAR_EVERY */
static const float push_max_m = 0.015f;    /* deepest step out in one sweep */
static const float stay_m = 0.0005f;       /* another limb must be this much nearer to be taken */
static const float lift_max_m = 0.015f;    /* highest a particle is lifted for its faces */
static const float lift_slack_m = 0.0015f; /* faces this clear let their corners down again */

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

/* The exact query has the word only where it finds something clearly nearer: where two limbs are
 * equally near, a particle that changes sides would never rest. */
static long check(struct cloth *cloth, int v)
{
	long looked = walk(cloth, v);
	struct contact before = cloth->contact[v];
	float walked = float_abs(before.distance_m);
	cloth_look(cloth, v);
	if (float_abs(cloth->contact[v].distance_m) > walked - stay_m)
		cloth->contact[v] = before;
	return looked + 64;
}

static long refresh(struct cloth *cloth, int v)
{
	int turn = cloth->sweep + v;
	int exact_every = cloth->worn ? EXACT_EVERY : EXACT_WRAP_EVERY;
	int walk_every = cloth->contact[v].distance_m > far_m ? WALK_FAR_EVERY : WALK_EVERY;
	if (cloth->contact[v].triangle < 0) {
		cloth_look(cloth, v);
		return 64;
	}
	if (turn % exact_every == 0)
		return check(cloth, v);
	return turn % walk_every == 0 ? walk(cloth, v) : 1;
}

/* Out along the normal. Friction: Coulomb's, so that cloth that hangs can rest (a step shorter than
 * grip times the push is lost wholly), and a share of what is left. */
static void push(struct cloth *cloth, int v)
{
	const struct contact *contact = &cloth->contact[v];
	struct v3 *p = &cloth->position_m[v], n = contact->normal;
	float d = v3_dot(v3_sub(*p, contact->point_m), n);
	if (contact->distance_m > near_m && d > 0.5f * near_m)
		return;
	float out = cloth->settings.offset_m + cloth->scratch->lift_m[v] - d;
	if (out <= 0.0f)
		return;
	*p = v3_mad(*p, n, float_min(out, push_max_m));
	struct v3 step = v3_sub(*p, cloth->scratch->start_m[v]);
	step = v3_mad(step, n, -v3_dot(step, n));
	float length = v3_length(step), held = cloth->settings.grip * out;
	float lost = length > held ? cloth->settings.friction : 1.0f;
	if (length > held)
		lost += (1.0f - lost) * held / length;
	*p = v3_mad(*p, step, -lost);
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

/* ---- faces ----
 *
 * A point inside a face stays outside the body by lifting the face's corners: a lift is kept from
 * sweep to sweep, so that cloth over an edge of the body rests and is not pushed and dropped. */

/* How much a point of a face, as weights of its corners, lacks; its corners are lifted by it. */
static long lift_point(struct cloth *cloth, const int v[3], const float weight[3])
{
	struct cloth_scratch *s = cloth->scratch;
	struct v3 p = {0.0f, 0.0f, 0.0f};
	float squares = 0.0f, offset = 0.5f * cloth->settings.offset_m;
	int nearest = 0;
	for (int k = 0; k < 3; k++) {
		p = v3_mad(p, cloth->position_m[v[k]], weight[k]);
		squares += weight[k] * weight[k];
		nearest = weight[k] > weight[nearest] ? k : nearest;
	}
	struct body_hit hit;
	int looked = body_walk(cloth->body, p, cloth->contact[v[nearest]].triangle, WALK_STEPS_MAX,
			       &hit);
	float lack = offset - hit.distance_m;
	for (int k = 0; k < 3; k++)
		if (weight[k] > 0.0f)
			s->slack_m[v[k]] = float_min(s->slack_m[v[k]], -lack);
	if (lack <= 0.0f || hit.distance_m < -near_m)
		return looked;
	for (int k = 0; k < 3; k++) {
		const struct contact *contact = &cloth->contact[v[k]];
		float height = v3_dot(v3_sub(cloth->position_m[v[k]], contact->point_m),
				      contact->normal);
		float lift = height + 0.7f * lack * weight[k] / squares - cloth->settings.offset_m;
		if (weight[k] > 0.0f && lift > s->lift_m[v[k]])
			s->lift_m[v[k]] = float_min(lift, lift_max_m);
	}
	return looked;
}

static bool near_body(const struct cloth *cloth, const int v[3])
{
	float margin = cloth->settings.offset_m + 0.001f;
	bool near = false;
	for (int k = 0; k < 3; k++) {
		const struct contact *contact = &cloth->contact[v[k]];
		if (contact->triangle < 0)
			return false;
		near |= contact->distance_m < margin + cloth->scratch->lift_m[v[k]];
	}
	return near;
}

/* Corners whose faces were clear in the whole last round come down by a fifth. */
static void lower_lifts(struct cloth *cloth)
{
	struct cloth_scratch *s = cloth->scratch;
	for (int v = 0; v < cloth->garment->vertex_count; v++) {
		if (s->slack_m[v] > lift_slack_m)
			s->lift_m[v] *= 0.8f;
		s->slack_m[v] = 1.0f;
	}
}

/* Slice `slice` of `slices` of all triangles: three points of every edge, and the centre. Edges of
 * two triangles are looked at in the first. */
long cloth_contact_faces(struct cloth *cloth, int slice, int slices)
{
	static const float third[3] = {1.0f / 3.0f, 1.0f / 3.0f, 1.0f / 3.0f};
	long units = 0;
	if (slice == 0)
		lower_lifts(cloth);
	for (int t = slice; t < cloth->garment->triangle_count; t += slices) {
		const int *v = cloth->triangle[t].v;
		if (!triangle_placed(cloth, t) || !near_body(cloth, v))
			continue;
		units += lift_point(cloth, v, third);
		for (int k = 0; k < 3; k++)
			for (int i = 1; (cloth->scratch->edge_owner[t] >> k & 1) && i < 4; i++) {
				float weight[3] = {0.0f, 0.0f, 0.0f};
				weight[k] = 1.0f - 0.25f * (float)i;
				weight[(k + 1) % 3] = 0.25f * (float)i;
				units += lift_point(cloth, v, weight);
			}
	}
	return units;
}
