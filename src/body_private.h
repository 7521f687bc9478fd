/* Shared between the body's own files only. */
#ifndef BODY_PRIVATE_H
#define BODY_PRIVATE_H

#include "body_landmark_private.h"
#include "body_parts.h"

enum { TREE_STACK_MAX = 64 }; /* twice the depth of a median tree of all triangles that fit */

struct body_scratch {
	struct v3 *centre_m; /* per triangle, while the tree is built */
	int *fill;           /* per vertex, while stars are built */
	struct parts_scratch *parts;
	struct landmark_scratch *landmarks;
};

/* The vertex normals interpolated at a point of triangle t. */
struct v3 body_smooth_normal(const struct body *body, int t, struct v3 point_m);

#endif
