/* Parts and bones of a body: what a bones file says. */
#ifndef BONE_H
#define BONE_H

#include "limits.h"
#include "vec.h"

enum body_part {
	PART_TRUNK,
	PART_HEAD, /* with the neck */
	PART_ARM_LEFT,
	PART_ARM_RIGHT,
	PART_LEG_LEFT,
	PART_LEG_RIGHT,
	PART_COUNT,
};

/* A bone is a segment well inside its part. */
struct bone {
	enum body_part part;
	struct v3 a_m, b_m; /* from the trunk outward */
	float radius_m;     /* mean distance to the surface */
};

/* In the order of struct body: spine from the pelvis up, neck, head, arms, legs; collar-bones and
 * hips last, which are bones of the trunk too. */
struct bone_list {
	int count;
	struct bone bone[BODY_BONES_MAX];
	int line[BODY_BONES_MAX]; /* of the file that they come from, from 1 */
};

#endif
