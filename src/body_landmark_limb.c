/* Landmarks of arms and legs: shoulder point, armpit, wrist, ankle, and the lines between. */
#include "body_landmark_private.h"

enum { GIRTH_STEPS = 24, LINE_STEPS = 64 };

/* The wrist and the ankle are the least girth in this part of the way to the limb's tip; where a
 * limb only tapers, like a toy's, they are at the share after it. */
static const float end_low = 0.55f, end_high = 0.93f, end_else = 0.82f;

/* An elbow or a knee lies in this part of the way to wrist or ankle. */
static const float joint_low = 0.40f, joint_high = 0.62f;

/* Between shin and foot. */
static const float foot_cosine = 0.85f;

/* How far an armhole leans with the arm: 0 upright, 1 half-way to the arm's own direction. */
static const float armhole_lean = 0.35f;

static struct frame frame_at(const struct landmark_scratch *s, const struct limb_line *limb,
			     bool arm, float along_m)
{
	struct v3 axis = chain_axis(&limb->chain, along_m, 0.06f * chain_length(&limb->chain));
	struct v3 rest = arm ? limb->outward : v3_scale(s->frame.axis, -1.0f);
	struct v3 side = arm ? s->frame.axis : limb->outward;
	return (struct frame){axis, turn_onto(s->frame.front, rest, axis),
			      turn_onto(side, rest, axis)};
}

/* ---- centre-lines ---- */

static void chain_of_part(const struct body *body, enum body_part part, struct chain *chain)
{
	chain->count = 0;
	for (int b = 0; b < body->bone_count; b++) {
		if (body->bone[b].part != part || chain->count + 1 >= CHAIN_POINTS_MAX)
			continue;
		if (chain->count == 0)
			chain_add_point(chain, body->bone[b].a_m);
		chain_add_point(chain, body->bone[b].b_m);
	}
}

/* The elbow is where the first bone ends, if that is near the middle; else the middle. */
static float joint_of(const struct chain *chain, float end_m)
{
	float first = chain->count > 2 ? chain->along_m[1] : 0.0f;
	bool sane = first > joint_low * end_m && first < joint_high * end_m;
	return sane ? first : 0.5f * end_m;
}

static float end_of(struct landmark_scratch *s, const struct limb_line *limb, bool arm)
{
	float whole = chain_length(&limb->chain), least = 1e9f, end = end_else * whole;
	int at = -1;
	struct v3 middle = chain_axis(&limb->chain, end_low * whole, 0.05f * whole);
	for (int i = 0; i <= GIRTH_STEPS; i++) {
		float share = end_low + (end_high - end_low) * (float)i / (float)GIRTH_STEPS;
		struct frame frame = frame_at(s, limb, arm, share * whole);
		struct v3 way = chain_axis(&limb->chain, share * whole, 0.02f * whole);
		if (v3_dot(way, middle) < foot_cosine) /* a foot begins */
			break;
		if (!section_round(s, chain_point(&limb->chain, share * whole), &frame))
			continue;
		float girth = section_girth(s, &frame);
		if (girth < least) {
			least = girth;
			at = i;
			end = share * whole;
		}
	}
	return at <= 0 || at == GIRTH_STEPS ? end_else * whole : end;
}

/* Replaces everything of the chain before `from_m` by one point. */
static void begin_chain(struct chain *chain, struct v3 first_m, float from_m)
{
	struct chain old = *chain;
	chain->count = 0;
	chain_add_point(chain, first_m);
	for (int i = 0; i < old.count; i++)
		if (old.along_m[i] > from_m)
			chain_add_point(chain, old.point_m[i]);
}

/* ---- armpit and shoulder point ---- */

/* The section along an arm, through its upper and lower side, begun on one of them near the trunk
 * and walked towards it. */
static bool walk_along(struct landmark_scratch *s, const struct limb_line *arm,
		       const struct frame *frame, float along_m, float side)
{
	struct body_hit hit;
	return skin_outward(s->body, chain_point(&arm->chain, along_m), v3_scale(frame->side, side),
			    &hit) &&
	       section_walk(s, &hit, v3_scale(v3_cross(frame->axis, frame->side), side));
}

/* The point of the section farthest in a direction, within `within_m` of its start. */
static struct v3 farthest(const struct section *section, struct v3 direction, float within_m)
{
	struct v3 best = section->point_m[0];
	float walked = 0.0f;
	for (int i = 1; i < section->count && walked < within_m; i++) {
		struct v3 p = section->point_m[i];
		walked += v3_distance(section->point_m[i - 1], p);
		if (v3_dot(p, direction) > v3_dot(best, direction))
			best = p;
	}
	return best;
}

static bool find_shoulder(struct landmark_scratch *s, struct limb_line *arm)
{
	float whole = chain_length(&arm->chain), from = 0.22f * whole;
	struct frame frame = frame_at(s, arm, true, from);
	if (!walk_along(s, arm, &frame, from, -1.0f))
		return false;
	struct v3 inward = v3_normalize(v3_sub(s->frame.axis, frame.axis));
	arm->inner_m = farthest(&s->section, inward, 0.5f * whole);
	if (!walk_along(s, arm, &frame, from, 1.0f))
		return false;
	struct v3 normal = v3_normalize(v3_lerp(arm->outward, frame.axis, armhole_lean));
	int i = 0;
	while (i + 1 < s->section.count &&
	       v3_dot(v3_sub(s->section.point_m[i], arm->inner_m), normal) > 0.0f)
		i++;
	arm->outer_m = s->section.point_m[i];
	return true;
}

static void find_arm(struct landmark_scratch *s, int side)
{
	struct limb_line *arm = &s->arm[side];
	arm->outward = v3_scale(s->frame.side, side == 0 ? 1.0f : -1.0f);
	chain_of_part(s->body, side == 0 ? PART_ARM_LEFT : PART_ARM_RIGHT, &arm->chain);
	arm->found = arm->chain.count >= 2 && find_shoulder(s, arm);
	if (!arm->found)
		return;
	struct v3 joint = v3_lerp(arm->inner_m, arm->outer_m, 0.5f);
	float armhole = v3_distance(arm->inner_m, arm->outer_m), from = 0.0f;
	while (from < 0.3f * chain_length(&arm->chain) &&
	       v3_distance(chain_point(&arm->chain, from), joint) < 0.5f * armhole)
		from += 0.01f * chain_length(&arm->chain);
	begin_chain(&arm->chain, joint, from);
	arm->end_m = end_of(s, arm, true);
	arm->joint_m = joint_of(&arm->chain, arm->end_m);
}

/* Legs begin straight above their first bone, at the crotch's level. */
static void find_leg(struct landmark_scratch *s, int side)
{
	struct limb_line *leg = &s->leg[side];
	leg->outward = v3_scale(s->frame.side, side == 0 ? 1.0f : -1.0f);
	chain_of_part(s->body, side == 0 ? PART_LEG_LEFT : PART_LEG_RIGHT, &leg->chain);
	leg->found = leg->chain.count >= 2;
	if (!leg->found)
		return;
	leg->inner_m = s->crotch_m;
	leg->end_m = end_of(s, leg, false);
	leg->joint_m = joint_of(&leg->chain, leg->end_m);
}

/* Left and right bend at the same share of their way, whatever the two paths say. */
static void even_joints(struct limb_line pair[2])
{
	if (!pair[0].found || !pair[1].found)
		return;
	float share = 0.5f * (pair[0].joint_m / pair[0].end_m + pair[1].joint_m / pair[1].end_m);
	pair[0].joint_m = share * pair[0].end_m;
	pair[1].joint_m = share * pair[1].end_m;
}

void landmark_limbs(struct landmark_scratch *s)
{
	for (int side = 0; side < 2; side++) {
		find_arm(s, side);
		find_leg(s, side);
	}
	even_joints(s->arm);
	even_joints(s->leg);
}

/* ---- lines ---- */

/* From `start` (a point of the skin) along one side of a limb. The first directions lean towards
 * the start, so that a line leaves the armhole, and not the trunk below it. */
static void keep_line(struct landmark_scratch *s, const struct limb_line *limb, bool arm,
		      struct v3 start_m, float front, float side, enum landmark landmark)
{
	sketch_begin(s);
	sketch_add(s, start_m);
	sketch_stop(s);
	struct v3 lean = v3_normalize(v3_sub(start_m, limb->chain.point_m[0]));
	float leaning = 0.25f * limb->end_m;
	for (int i = 1; i <= LINE_STEPS; i++) {
		struct body_hit hit;
		float along = limb->end_m * (float)i / (float)LINE_STEPS;
		float before = limb->end_m * (float)(i - 1) / (float)LINE_STEPS;
		struct frame frame = frame_at(s, limb, arm, along);
		struct v3 straight = v3_add(v3_scale(frame.front, front),
					    v3_scale(frame.side, side));
		struct v3 direction = v3_lerp(lean, straight, float_min(along / leaning, 1.0f));
		if (skin_outward(s->body, chain_point(&limb->chain, along), direction, &hit))
			sketch_add(s, hit.point_m);
		if ((before < limb->joint_m && along >= limb->joint_m) || i == LINE_STEPS)
			sketch_stop(s);
	}
	sketch_keep(s, landmark);
}

static void keep_round(struct landmark_scratch *s, const struct limb_line *limb, bool arm,
		       float along_m, enum landmark landmark)
{
	struct frame frame = frame_at(s, limb, arm, along_m);
	if (section_round(s, chain_point(&limb->chain, along_m), &frame))
		sketch_keep_round(s, landmark, &frame);
}

/* The skin in front of or behind the limb's beginning. */
static struct v3 start_at(struct landmark_scratch *s, const struct limb_line *limb, float sign)
{
	struct body_hit hit;
	struct v3 at = limb->chain.point_m[0];
	return skin_outward(s->body, at, v3_scale(s->frame.front, sign), &hit) ? hit.point_m : at;
}

/* The table holds all landmarks of the left, then those of the right. */
static enum landmark on_side(enum landmark left, int side)
{
	return (enum landmark)((int)left + side * (LANDMARK_SIDE_RIGHT - LANDMARK_SIDE_LEFT));
}

static void keep_arm(struct landmark_scratch *s, int side)
{
	const struct limb_line *arm = &s->arm[side];
	keep_line(s, arm, true, arm->outer_m, 0.0f, 1.0f, on_side(LANDMARK_ARM_TOP_LEFT, side));
	keep_line(s, arm, true, arm->inner_m, 0.0f, -1.0f, on_side(LANDMARK_ARM_UNDER_LEFT, side));
	keep_line(s, arm, true, start_at(s, arm, 1.0f), 1.0f, 0.0f,
		  on_side(LANDMARK_ARM_FRONT_LEFT, side));
	keep_line(s, arm, true, start_at(s, arm, -1.0f), -1.0f, 0.0f,
		  on_side(LANDMARK_ARM_BACK_LEFT, side));
	keep_round(s, arm, true, 0.5f * arm->joint_m, on_side(LANDMARK_ROUND_UPPER_ARM_LEFT, side));
	keep_round(s, arm, true, arm->end_m, on_side(LANDMARK_ROUND_WRIST_LEFT, side));
}

static void keep_leg(struct landmark_scratch *s, int side)
{
	struct limb_line *leg = &s->leg[side];
	struct v3 axis = leg->chain.point_m[0], outer;
	float rise = (s->hip_level - v3_dot(s->frame.axis, axis));
	struct body_hit hit;
	/* the way from the hip's level down to the leg's first bone belongs to its lines */
	struct v3 hip = v3_mad(leg->chain.point_m[0], s->frame.axis, rise);
	struct chain old = leg->chain;
	float before = v3_distance(hip, old.point_m[0]);
	keep_line(s, leg, false, leg->inner_m, 0.0f, -1.0f, on_side(LANDMARK_LEG_INNER_LEFT, side));
	keep_round(s, leg, false, 0.12f * leg->joint_m, on_side(LANDMARK_ROUND_THIGH_LEFT, side));
	keep_round(s, leg, false, leg->end_m, on_side(LANDMARK_ROUND_ANKLE_LEFT, side));
	leg->chain.count = 0;
	chain_add_point(&leg->chain, hip);
	for (int i = 0; i < old.count; i++)
		chain_add_point(&leg->chain, old.point_m[i]);
	leg->joint_m += before;
	leg->end_m += before;
	outer = skin_outward(s->body, trunk_middle(s, s->hip_level), leg->outward, &hit)
			? hit.point_m
			: hip;
	keep_line(s, leg, false, outer, 0.0f, 1.0f, on_side(LANDMARK_LEG_OUTER_LEFT, side));
	keep_line(s, leg, false, start_at(s, leg, 1.0f), 1.0f, 0.0f,
		  on_side(LANDMARK_LEG_FRONT_LEFT, side));
	keep_line(s, leg, false, start_at(s, leg, -1.0f), -1.0f, 0.0f,
		  on_side(LANDMARK_LEG_BACK_LEFT, side));
}

void landmark_limb_lines(struct landmark_scratch *s)
{
	for (int side = 0; side < 2; side++) {
		if (s->arm[side].found)
			keep_arm(s, side);
		if (s->leg[side].found)
			keep_leg(s, side);
	}
}
