/* Names for limbs. The wearer's left is +X, the front +Z. */
#include "body_parts.h"

/* A limb is worth a name from this share of the body's reach on: more than a finger or a toe. */
static const float length_least = 0.15f;

/* Of two limbs on a side the lower one is the arm and the upper one an ear or a horn, if it is at
 * least this long beside the other. */
static const float length_rival = 0.4f;

static const float foot_height = 0.15f, arm_aside = 0.1f; /* of the body's height */

struct stance parts_stance(const struct body *body)
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

/* High and near the middle: between ears or horns rather than on one of them. */
static int find_crown(const struct body *body, const struct stance *stance)
{
	int crown = 0;
	float best = -1e9f;
	for (int v = 0; v < body->vertex_count; v++) {
		struct v3 p = body->position_m[v];
		float score = p.y - 0.8f * float_abs(p.x - stance->middle_x_m);
		if (score > best) {
			best = score;
			crown = v;
		}
	}
	return crown;
}

static struct v3 base(const struct parts_scratch *s, int l)
{
	return s->limb[l].path.point_m[0];
}

static float side_of(const struct body *body, const struct parts_scratch *s,
		     const struct stance *stance, int l)
{
	return body->position_m[s->limb[l].tip].x - stance->middle_x_m;
}

static bool is_limb(const struct parts_scratch *s, int l)
{
	return s->limb[l].length_m >= length_least * s->reach_m && s->limb[l].path.count > 2;
}

static bool is_foot(const struct body *body, const struct parts_scratch *s,
		    const struct stance *stance, int l)
{
	float height = body->position_m[s->limb[l].tip].y - stance->low_m;
	return height < foot_height * stance->height_m;
}

/* The longest foot of a side. On four feet: the foremost (`front` 1) or the hindmost (-1). */
static int find_foot(const struct body *body, const struct parts_scratch *s,
		     const struct stance *stance, bool right, float front)
{
	int foot = -1;
	for (int l = 0; l < s->limb_count; l++) {
		if (!is_limb(s, l) || !is_foot(body, s, stance, l) ||
		    (side_of(body, s, stance, l) < 0.0f) != right)
			continue;
		bool better = foot < 0 ||
			      (front == 0.0f ? s->limb[l].length_m > s->limb[foot].length_m
					     : front * base(s, l).z > front * base(s, foot).z);
		foot = better ? l : foot;
	}
	return foot;
}

/* The arm of a side among the limbs that are no feet. */
static int find_arm(const struct body *body, const struct parts_scratch *s,
		    const struct stance *stance, bool right)
{
	float sign = right ? -1.0f : 1.0f, longest = 0.0f;
	int arm = -1;
	for (int round = 0; round < 2; round++)
		for (int l = 0; l < s->limb_count; l++) {
			if (!is_limb(s, l) || is_foot(body, s, stance, l) ||
			    sign * side_of(body, s, stance, l) < arm_aside * stance->height_m)
				continue;
			float length = s->limb[l].length_m;
			if (round == 0)
				longest = float_max(longest, length);
			else if (length >= length_rival * longest &&
				 (arm < 0 || base(s, l).y < base(s, arm).y))
				arm = l;
		}
	return arm;
}

static void name_pair(int limb[PART_COUNT], enum body_part part, int left, int right)
{
	bool both = left >= 0 && right >= 0 && left != right;
	limb[part] = both ? left : -1;
	limb[part + 1] = both ? right : -1;
}

void parts_name(const struct body *body, struct parts_scratch *s, const struct stance *stance,
		int limb[PART_COUNT])
{
	int fore[2], hind[2];
	for (int side = 0; side < 2; side++) {
		fore[side] = find_foot(body, s, stance, side == 1, 1.0f);
		hind[side] = find_foot(body, s, stance, side == 1, -1.0f);
	}
	limb[PART_TRUNK] = -1;
	limb[PART_HEAD] = LIMBS_MAX;
	s->limb[LIMBS_MAX] = (struct limb){.tip = find_crown(body, stance)};
	if (fore[0] != hind[0] && fore[1] != hind[1]) {
		name_pair(limb, PART_ARM_LEFT, fore[0], fore[1]);
		name_pair(limb, PART_LEG_LEFT, hind[0], hind[1]);
		return;
	}
	name_pair(limb, PART_ARM_LEFT, find_arm(body, s, stance, false),
		  find_arm(body, s, stance, true));
	name_pair(limb, PART_LEG_LEFT, find_foot(body, s, stance, false, 0.0f),
		  find_foot(body, s, stance, true, 0.0f));
}
