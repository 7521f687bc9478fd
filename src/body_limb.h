/* A limb along its bones. */
#ifndef BODY_LIMB_H
#define BODY_LIMB_H

#include "body.h"

enum {
	LIMB_SECTIONS = 64,
	LIMB_SIDES = 16, /* round the bones */
};

#define LIMB_ENDLESS_M 1e9f
#define LIMB_THIN_SHARE 0.35f /* of a limb's width that a slim body keeps */

/* Where a point lies beside a limb's bones. */
struct beside {
	struct v3 axis_m; /* nearest point of the bones, which go on straight beyond both ends */
	struct v3 along;  /* their direction there */
	float reach_m;    /* from the first bone's start to axis_m, along the bones */
};

struct limb_shape {
	float hull_m[LIMB_SECTIONS][LIMB_SIDES]; /* farthest towards each side; 0: nothing seen */
	float wrist_m; /* reach of the narrow place before hand or foot; or LIMB_ENDLESS_M */
	float end_m;   /* reach of the tip */
};

/* False: the part has no bones. */
bool body_beside(const struct body *body, int part, struct v3 p_m, struct beside *beside);

/* Nearest point of the bones of some parts: bits of enum body_part, 0 means all. p_m itself where
 * there are no bones. */
struct v3 body_nearest_bone(const struct body *body, unsigned parts, struct v3 p_m);

/* Of head (with the neck), arms and legs; the trunk's stays empty. */
void body_measure_limbs(const struct body *body, struct limb_shape limb[PART_COUNT]);

/* How far from the bones the convex hull of the limb's section reaches in the direction of a point:
 * a hand is as wide as a mitten. 0 in a direction along the bones, where no side bounds it. */
float limb_hull(const struct limb_shape *limb, const struct beside *at, struct v3 p_m);

#endif
