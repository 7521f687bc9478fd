/* Finding landmarks; shared by body_landmark*.c only.
 *
 *   bones -> levels of the trunk, centre-lines of the limbs -> plane sections and rays -> lines
 */
#ifndef BODY_LANDMARK_PRIVATE_H
#define BODY_LANDMARK_PRIVATE_H

#include "body.h"

enum { SECTION_POINTS_MAX = 8192, CHAIN_POINTS_MAX = 8 };

/* Where a plane meets the surface: points in order along normal x outside (about an upward normal:
 * from the front to the wearer's left); the first is where the walk began. Closed, but the last
 * point is not the first. */
struct section {
	int count;
	struct v3 point_m[SECTION_POINTS_MAX];
};

/* A line while it is drawn. */
struct sketch {
	int count;
	struct v3 point_m[SECTION_POINTS_MAX + 1];
	int stop_count;
	int stop[LANDMARK_STOPS_MAX]; /* places in point_m */
};

/* A way through the middle of a limb or of the trunk. */
struct chain {
	int count;
	struct v3 point_m[CHAIN_POINTS_MAX];
	float along_m[CHAIN_POINTS_MAX];
};

/* Directions at a place of a chain: unit, at right angles. Arms: front, and the upper side in
 * `side`. Legs: front, and the outer side. Trunk and head: front, and the wearer's left. */
struct frame {
	struct v3 axis, front, side;
};

struct limb_line {
	bool found;
	struct v3 outward;    /* the wearer's left or right */
	struct chain chain;   /* shoulder point's middle to wrist; hip to ankle */
	float joint_m, end_m; /* elbow or knee; wrist or ankle: along the chain */
	struct v3 inner_m;    /* armpit */
	struct v3 outer_m;    /* shoulder point */
};

struct landmark_scratch {
	struct body *body;
	struct section section;
	struct sketch sketch;
	struct v2 flat[SECTION_POINTS_MAX], hull[2 * SECTION_POINTS_MAX]; /* for girths */
	struct chain trunk, head;
	struct frame frame, head_frame;
	struct v3 neck_pit_m, nape_m, crotch_m;
	/* levels along the trunk's axis, m */
	float crotch_level, hip_level, waist_level, chest_level, armpit_level, neck_level;
	struct limb_line arm[2], leg[2]; /* left, right */
};

struct landmark_scratch *landmark_init(struct arena *arena);

/* ---- body_landmark_section.c ---- */

/* The direction, leaning no farther from the axis than a tangent of `lean_max`. Both unit. */
struct v3 lean_at_most(struct v3 direction, struct v3 axis, float lean_max);

/* v turned as the unit vector `from` must be to become `to`, the short way. */
struct v3 turn_onto(struct v3 v, struct v3 from, struct v3 to);

struct v3 chain_point(const struct chain *chain, float along_m);
float chain_length(const struct chain *chain);
void chain_add_point(struct chain *chain, struct v3 point_m);

/* The direction at a place, evened out over `window_m` to both sides. */
struct v3 chain_axis(const struct chain *chain, float along_m, float window_m);

/* From inside to the skin, and from `far` metres outside to it. */
bool skin_outward(const struct body *body, struct v3 from_m, struct v3 direction,
		  struct body_hit *hit);
bool skin_inward(const struct body *body, struct v3 to_m, struct v3 direction, float far,
		 struct body_hit *hit);

/* The section by the plane through the hit, begun at it. False: too many points, or the plane
 * misses the triangle's neighbourhood. */
bool section_walk(struct landmark_scratch *s, const struct body_hit *start, struct v3 normal);

/* Through `centre_m`, at right angles to the frame's axis, begun in front. */
bool section_round(struct landmark_scratch *s, struct v3 centre_m, const struct frame *frame);

/* Of the section's convex hull, which a tape measure follows. */
float section_girth(struct landmark_scratch *s, const struct frame *frame);
struct v3 section_middle(const struct section *section);
int section_nearest(const struct section *section, struct v3 point_m);

/* ---- body_landmark_sketch.c ---- */

void sketch_begin(struct landmark_scratch *s);
void sketch_add(struct landmark_scratch *s, struct v3 point_m);
void sketch_stop(struct landmark_scratch *s); /* at the last point */

/* Points [from, to] of the section, either way; `stops` adds one at each end (the first only when
 * the sketch is empty). */
void sketch_section(struct landmark_scratch *s, int from, int to);

/* Evens the sketch out, lays it on the surface and keeps it as the landmark. */
void sketch_keep(struct landmark_scratch *s, enum landmark landmark);

/* The whole section as a closed landmark. */
void sketch_keep_round(struct landmark_scratch *s, enum landmark landmark,
		       const struct frame *frame);

/* ---- body_landmark_trunk.c, body_landmark_limb.c, body_landmark_head.c ---- */

/* Neck pit, nape, crotch; then, when the arms are known, levels and lines. */
bool landmark_trunk_ends(struct landmark_scratch *s);
void landmark_trunk(struct landmark_scratch *s);
struct v3 trunk_middle(const struct landmark_scratch *s, float level);
void landmark_limbs(struct landmark_scratch *s);
void landmark_limb_lines(struct landmark_scratch *s);
void landmark_head(struct landmark_scratch *s);

#endif
