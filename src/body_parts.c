/* Names for what was found, and the order of the search. */
#include "body_parts.h"

#include "body_private.h"

/* Where the figure stands: what its names are told from. */
struct stance {
	float low_m, height_m, middle_x_m, middle_y_m;
};

static struct stance stance_of(const struct body *body)
{
	float sum_x = 0.0f, sum_y = 0.0f, sum = 0.0f;
	for (int t = 0; t < body->triangle_count; t++) {
		const int *v = body->triangle[t].v;
		const struct v3 *p = body->position_m;
		float area = v3_length(
			v3_cross(v3_sub(p[v[1]], p[v[0]]), v3_sub(p[v[2]], p[v[0]])));
		sum_x += area * p[v[0]].x;
		sum_y += area * p[v[0]].y;
		sum += area;
	}
	return (struct stance){body->low_m.y, body->high_m.y - body->low_m.y, sum_x / sum,
			       sum_y / sum};
}

static bool is_foot(const struct body *body, const struct stance *stance, int tip)
{
	return body->position_m[tip].y < stance->low_m + 0.15f * stance->height_m;
}

/* The limb whose tip is high and near the middle; -1: none. */
static int find_head(const struct body *body, const struct parts_scratch *s,
		     const struct stance *stance)
{
	int head = -1;
	float best = stance->middle_y_m;
	for (int l = 0; l < s->limb_count; l++) {
		struct v3 tip = body->position_m[s->limb[l].tip];
		float score = tip.y - 0.8f * float_abs(tip.x - stance->middle_x_m);
		if (score > best) {
			best = score;
			head = l;
		}
	}
	return head;
}

/* Of the feet the longest to each side are the legs; of the other limbs whose tip is well to a
 * side, the arms. The wearer's left is +X. */
static void name_limbs(const struct body *body, const struct parts_scratch *s,
		       const struct stance *stance, int head, int limb[PART_COUNT])
{
	for (int part = 0; part < PART_COUNT; part++)
		limb[part] = -1;
	limb[PART_HEAD] = head;
	for (int l = 0; l < s->limb_count; l++) {
		float side = body->position_m[s->limb[l].tip].x - stance->middle_x_m;
		bool foot = is_foot(body, stance, s->limb[l].tip);
		if (l == head || s->limb[l].length_m == 0.0f ||
		    (!foot && float_abs(side) < 0.1f * stance->height_m))
			continue;
		int part = (foot ? PART_LEG_LEFT : PART_ARM_LEFT) + (side < 0.0f);
		if (limb[part] < 0 || s->limb[l].length_m > s->limb[limb[part]].length_m)
			limb[part] = l;
	}
}

static struct v3 between_bases(const struct parts_scratch *s, int a, int b)
{
	return v3_lerp(s->limb[a].path.point_m[0], s->limb[b].path.point_m[0], 0.5f);
}

/* One attempt with one idea of how far a tip stands out. */
static bool find_limbs(const struct body *body, struct parts_scratch *s,
		       const struct stance *stance, float persistence, int limb[PART_COUNT])
{
	for (int v = 0; v < body->vertex_count; v++) {
		s->owner[v] = OWNER_NONE;
		s->share[v] = UNREACHED;
	}
	parts_tips(body, s, persistence);
	int head = find_head(body, s, stance);
	for (int l = 0; l < s->limb_count; l++)
		if (l != head)
			parts_cut_limb(body, s, l);
	name_limbs(body, s, stance, head, limb);
	for (int part = PART_HEAD; part < PART_COUNT; part++)
		if (limb[part] < 0)
			return false;
	struct v3 chest_m = between_bases(s, limb[PART_ARM_LEFT], limb[PART_ARM_RIGHT]);
	if (!parts_cut_head(body, s, head, chest_m) || s->neck.count == 0)
		return false;
	struct v3 pelvis_m = between_bases(s, limb[PART_LEG_LEFT], limb[PART_LEG_RIGHT]);
	parts_trunk(body, s, pelvis_m, s->neck.point_m[0]);
	return s->trunk.count > 2;
}

/* A triangle belongs where two of its corners do. */
static void label_triangles(struct body *body, const struct parts_scratch *s,
			    const int limb[PART_COUNT])
{
	uint8_t part_of[LIMBS_MAX];
	memset(part_of, PART_TRUNK, sizeof part_of); /* a tail, a bun, a sword */
	for (int part = PART_HEAD; part < PART_COUNT; part++)
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
	static const float persistence[] = {0.16f, 0.12f, 0.20f, 0.25f, 0.09f};
	struct parts_scratch *s = body->scratch->parts;
	int limb[PART_COUNT];
	bool found = false;
	MUST(body->triangle_count > 0);
	memset(body->part, PART_TRUNK, (size_t)body->triangle_count);
	body->bone_count = 0;
	struct stance stance = stance_of(body);
	parts_link(body, s);
	parts_remote(body, s);
	for (int i = 0; i < COUNT_OF(persistence) && !found; i++)
		found = find_limbs(body, s, &stance, persistence[i], limb);
	if (found) {
		label_triangles(body, s, limb);
		parts_bones(body, s, limb);
	}
	body_find_landmarks(body);
	return found;
}
