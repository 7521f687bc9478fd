/* Landmarks of the trunk. Its levels are counted along one axis, from the lowest bone of the spine
 * to the neck. */
#include "body_landmark_private.h"

/* Where levels are looked for, as shares of the way from the crotch to the neck pit. The windows
 * keep a belly from passing for hips, and a body without a waist has one where others do. */
static const float hip_low = 0.08f, hip_high = 0.28f;
static const float waist_low = 0.38f, waist_high = 0.62f;
static const float chest_low = 0.62f;
static const float trunk_arms = 1.2f; /* neck pit to crotch, in lengths from shoulder to wrist */
static const float armpit_margin = 0.03f; /* below the armpit a section holds no arm */

enum { LEVEL_STEPS = 24, SIDE_STEPS = 48 };

static float level_of(const struct landmark_scratch *s, struct v3 point_m)
{
	return v3_dot(s->frame.axis, point_m);
}

/* The trunk's chain where it crosses a level. */
struct v3 trunk_middle(const struct landmark_scratch *s, float level)
{
	const struct chain *c = &s->trunk;
	int i = 0;
	while (i + 2 < c->count && level_of(s, c->point_m[i + 1]) < level)
		i++;
	float a = level_of(s, c->point_m[i]), b = level_of(s, c->point_m[i + 1]);
	float share = b - a > 1e-6f ? (level - a) / (b - a) : 0.0f;
	return v3_lerp(c->point_m[i], c->point_m[i + 1], float_clamp(share, -3.0f, 4.0f));
}

/* Below the spine's end the middle may be in the open, so the front is also asked from outside. */
static bool section_at(struct landmark_scratch *s, float level)
{
	struct body_hit hit;
	struct v3 middle = trunk_middle(s, level);
	return section_round(s, middle, &s->frame) ||
	       (skin_inward(s->body, middle, s->frame.front, s->neck_level - s->crotch_level,
			    &hit) &&
		section_walk(s, &hit, s->frame.axis));
}

/* ---- neck pit, nape, crotch ---- */

/* The section through the middle of the body, begun at the neck pit and going down. */
static bool walk_middle(struct landmark_scratch *s)
{
	struct body_hit hit;
	return skin_outward(s->body, s->head.point_m[0], s->head_frame.front, &hit) &&
	       section_walk(s, &hit, s->frame.side);
}

static int lowest(const struct landmark_scratch *s)
{
	int low = 0;
	for (int i = 1; i < s->section.count; i++)
		if (level_of(s, s->section.point_m[i]) < level_of(s, s->section.point_m[low]))
			low = i;
	return low;
}

bool landmark_trunk_ends(struct landmark_scratch *s)
{
	struct body_hit nape;
	if (!walk_middle(s) ||
	    !skin_outward(s->body, s->head.point_m[0], v3_scale(s->head_frame.front, -1.0f), &nape))
		return false;
	s->neck_pit_m = s->section.point_m[0];
	s->nape_m = nape.point_m;
	s->crotch_m = s->section.point_m[lowest(s)];
	s->crotch_level = level_of(s, s->crotch_m);
	s->neck_level = level_of(s, s->neck_pit_m);
	return s->neck_level - s->crotch_level > 0.01f;
}

/* ---- levels ---- */

/* The level of least (sign -1) or greatest (1) girth between two levels. */
static float level_of_girth(struct landmark_scratch *s, float low, float high, float sign)
{
	float best = -1e9f, level = 0.5f * (low + high);
	for (int i = 0; i <= LEVEL_STEPS; i++) {
		float at = low + (high - low) * (float)i / (float)LEVEL_STEPS;
		if (!section_at(s, at))
			continue;
		float girth = sign * section_girth(s, &s->frame);
		if (girth > best) {
			best = girth;
			level = at;
		}
	}
	return level;
}

static float share_level(const struct landmark_scratch *s, float share)
{
	return s->crotch_level + share * (s->neck_level - s->crotch_level);
}

/* Under a robe the crotch is where arms would reach it. */
static void guess_crotch(struct landmark_scratch *s)
{
	if (s->arm[0].found && !s->leg[0].found)
		s->crotch_level = float_max(s->crotch_level,
					    s->neck_level - trunk_arms * s->arm[0].end_m);
}

/* A body without arms has its armpits where others do. */
static void find_levels(struct landmark_scratch *s)
{
	guess_crotch(s);
	s->armpit_level = share_level(s, 0.8f);
	for (int side = 0; side < 2; side++)
		if (s->arm[side].found)
			s->armpit_level = float_min(s->armpit_level,
						    level_of(s, s->arm[side].inner_m));
	s->armpit_level = float_max(s->armpit_level, share_level(s, 0.5f));
	float highest = s->armpit_level - armpit_margin * (s->neck_level - s->crotch_level);
	s->waist_level = level_of_girth(s, share_level(s, waist_low),
					float_min(share_level(s, waist_high), highest), -1.0f);
	float chest = float_min(share_level(s, chest_low),
				highest - 0.05f * (highest - s->waist_level));
	s->chest_level = level_of_girth(s, chest, highest, 1.0f);
	s->hip_level = level_of_girth(s, share_level(s, hip_low), share_level(s, hip_high), 1.0f);
}

static void keep_rounds(struct landmark_scratch *s)
{
	const struct {
		enum landmark landmark;
		float level;
	} rounds[] = {{LANDMARK_ROUND_CHEST, s->chest_level},
		      {LANDMARK_ROUND_WAIST, s->waist_level},
		      {LANDMARK_ROUND_HIP, s->hip_level}};
	for (int i = 0; i < COUNT_OF(rounds); i++)
		if (section_at(s, rounds[i].level))
			sketch_keep_round(s, rounds[i].landmark, &s->frame);
}

/* ---- down the front, the back and the sides ---- */

/* The first place from `from` on, in steps of `step`, at or below a level. */
static int first_below(const struct landmark_scratch *s, int from, int step, int end, float level)
{
	int i = from;
	while (i != end && level_of(s, s->section.point_m[i]) > level)
		i += step;
	return i;
}

static void keep_centres(struct landmark_scratch *s)
{
	if (!walk_middle(s))
		return;
	int crotch = lowest(s), nape = crotch;
	int waist = first_below(s, 0, 1, crotch, s->waist_level);
	sketch_begin(s);
	sketch_section(s, 0, waist);
	sketch_section(s, waist, crotch);
	sketch_keep(s, LANDMARK_FRONT_CENTRE);
	for (int i = crotch; i < s->section.count; i++)
		if (v3_distance(s->section.point_m[i], s->nape_m) <
		    v3_distance(s->section.point_m[nape], s->nape_m))
			nape = i;
	waist = first_below(s, nape, -1, crotch, s->waist_level);
	sketch_begin(s);
	sketch_section(s, nape, waist);
	sketch_section(s, waist, crotch);
	sketch_keep(s, LANDMARK_BACK_CENTRE);
}

/* Skin to the side at levels falling from `from` to `to`. */
static void sketch_flank(struct landmark_scratch *s, struct v3 outward, float from, float to)
{
	for (int i = 0; i <= SIDE_STEPS; i++) {
		struct body_hit hit;
		float level = from + (to - from) * (float)i / (float)SIDE_STEPS;
		if (skin_outward(s->body, trunk_middle(s, level), outward, &hit))
			sketch_add(s, hit.point_m);
	}
	if (s->sketch.count > 0)
		sketch_stop(s);
}

/* Down the leg: its outer line, from below the hip on. */
static void sketch_leg(struct landmark_scratch *s, const struct limb_line *leg)
{
	for (int i = 0; i <= SIDE_STEPS; i++) {
		struct body_hit hit;
		float along = leg->end_m * (float)i / (float)SIDE_STEPS;
		struct v3 at = chain_point(&leg->chain, along);
		struct v3 axis = chain_axis(&leg->chain, along, 0.1f * leg->end_m);
		struct v3 outer = turn_onto(leg->outward, v3_scale(s->frame.axis, -1.0f), axis);
		if (skin_outward(s->body, at, outer, &hit) &&
		    level_of(s, hit.point_m) < s->crotch_level)
			sketch_add(s, hit.point_m);
	}
	sketch_stop(s);
}

static void keep_sides(struct landmark_scratch *s)
{
	for (int side = 0; side < 2; side++) {
		const struct limb_line *arm = &s->arm[side], *leg = &s->leg[side];
		if (!arm->found || !leg->found)
			continue;
		sketch_begin(s);
		sketch_add(s, arm->inner_m);
		sketch_stop(s);
		sketch_flank(s, arm->outward,
			     s->armpit_level - armpit_margin * (s->neck_level - s->crotch_level),
			     s->waist_level);
		sketch_flank(s, arm->outward, s->waist_level, s->hip_level);
		sketch_leg(s, leg);
		sketch_keep(s, side == 0 ? LANDMARK_SIDE_LEFT : LANDMARK_SIDE_RIGHT);
	}
}

void landmark_trunk(struct landmark_scratch *s)
{
	find_levels(s);
	keep_rounds(s);
	keep_centres(s);
	keep_sides(s);
}
