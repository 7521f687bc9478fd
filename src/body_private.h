/* Shared between the body's own files only. */
#ifndef BODY_PRIVATE_H
#define BODY_PRIVATE_H

#include "body_landmark_private.h"
#include "body_look.h"
#include "body_parts.h"

enum { TREE_STACK_MAX = 64 }; /* twice the depth of a median tree of all triangles that fit */

struct body_scratch {
	struct v3 *centre_m; /* per triangle, while the tree is built */
	int *fill;           /* per vertex, while stars are built */
	float *clear_m;      /* per vertex, while body.clear_m is found */
	struct parts_scratch *parts;
	struct landmark_scratch *landmarks;
};

/* The nearest triangle of all, through the tree, when one is nearer than the best. */
void near_search(const struct body *body, struct v3 p, unsigned parts, struct nearest *best);

/* Does the point lie where the parts asked for end? */
bool near_on_rim(const struct body *body, const struct nearest *nearest, unsigned parts);

/* How far from each triangle a walk can be trusted (body_track.c). */
void body_find_clear(struct body *body);

/* The vertex normals interpolated at a point of triangle t. */
struct v3 body_smooth_normal(const struct body *body, int t, struct v3 point_m);

#endif
