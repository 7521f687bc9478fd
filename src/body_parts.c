/* The order of the search, and what comes of it. */
#include "body_parts.h"

#include "body_private.h"

/* How far a tip stands out to be one, as a share of the most remote place. The first that yields a
 * whole figure is taken. */
static const float persistence[] = {0.16f, 0.12f, 0.20f, 0.25f, 0.09f};

static struct v3 between_bases(const struct parts_scratch *s, int a, int b)
{
	return v3_lerp(s->limb[a].path.point_m[0], s->limb[b].path.point_m[0], 0.5f);
}

static bool has_arms(const int limb[PART_COUNT])
{
	return limb[PART_ARM_LEFT] >= 0;
}

static bool has_legs(const int limb[PART_COUNT])
{
	return limb[PART_LEG_LEFT] >= 0;
}

/* Limbs that a robe or the trunk has swallowed are thought to begin where they do on others. */
static void find_middles(const struct body *body, const struct parts_scratch *s,
			 const struct stance *stance, const int limb[PART_COUNT],
			 struct v3 *chest_m, struct v3 *pelvis_m)
{
	struct v3 crown = body->position_m[s->limb[LIMBS_MAX].tip];
	if (has_arms(limb))
		*chest_m = between_bases(s, limb[PART_ARM_LEFT], limb[PART_ARM_RIGHT]);
	if (has_legs(limb))
		*pelvis_m = between_bases(s, limb[PART_LEG_LEFT], limb[PART_LEG_RIGHT]);
	else
		*pelvis_m = (struct v3){chest_m->x, stance->low_m + 0.05f * stance->height_m,
					chest_m->z};
	if (!has_arms(limb))
		*chest_m = v3_lerp(*pelvis_m, crown, 0.5f);
}

/* One attempt with one idea of how far a tip stands out. `whole`: arms, legs and neck must be
 * there; else arms or legs do. */
static bool find_limbs(const struct body *body, struct parts_scratch *s,
		       const struct stance *stance, float stands_out, bool whole,
		       int limb[PART_COUNT])
{
	struct v3 chest_m, pelvis_m;
	for (int v = 0; v < body->vertex_count; v++) {
		s->owner[v] = OWNER_NONE;
		s->share[v] = UNREACHED;
	}
	parts_tips(body, s, stands_out);
	for (int l = 0; l < s->limb_count; l++)
		parts_measure_limb(body, s, l);
	parts_name(body, s, stance, limb);
	if (whole ? !has_arms(limb) || !has_legs(limb) : !has_arms(limb) && !has_legs(limb))
		return false;
	for (int part = PART_ARM_LEFT; part < PART_COUNT; part++)
		if (limb[part] >= 0)
			parts_claim_limb(body, s, limb[part]);
	find_middles(body, s, stance, limb, &chest_m, &pelvis_m);
	if (!parts_cut_head(body, s, chest_m, !whole) || s->neck.count == 0)
		return false;
	parts_trunk(body, s, pelvis_m, s->neck.point_m[0]);
	return s->trunk.count > 2;
}

/* A triangle belongs where two of its corners do. */
static void label_triangles(struct body *body, const struct parts_scratch *s,
			    const int limb[PART_COUNT])
{
	uint8_t part_of[LIMBS_MAX + 1];
	memset(part_of, PART_TRUNK, sizeof part_of); /* a tail, a bun, a sword */
	for (int part = PART_HEAD; part < PART_COUNT; part++)
		if (limb[part] >= 0)
			part_of[limb[part]] = (uint8_t)part;
	for (int t = 0; t < body->triangle_count; t++) {
		uint8_t part[3];
		for (int k = 0; k < 3; k++) {
			int owner = s->owner[body->triangle[t].v[k]];
			part[k] = owner == OWNER_NONE ? PART_TRUNK : part_of[owner];
		}
		body->part[t] = part[1] == part[2] ? part[1] : part[0];
	}
}

bool body_find_parts(struct body *body)
{
	struct parts_scratch *s = body->scratch->parts;
	int limb[PART_COUNT];
	bool found = false;
	MUST(body->triangle_count > 0);
	memset(body->part, PART_TRUNK, (size_t)body->triangle_count);
	body->bone_count = 0;
	struct stance stance = parts_stance(body);
	parts_link(body, s);
	parts_remote(body, s);
	for (int i = 0; i < 2 * COUNT_OF(persistence) && !found; i++)
		found = find_limbs(body, s, &stance, persistence[i % COUNT_OF(persistence)],
				   i < COUNT_OF(persistence), limb);
	if (found) {
		label_triangles(body, s, limb);
		parts_bones(body, s, limb);
	}
	body_find_landmarks(body);
	return found;
}
