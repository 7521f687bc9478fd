/* Shared between the body's own files only. */
#ifndef BODY_PRIVATE_H
#define BODY_PRIVATE_H

#include "body_landmark_private.h"
#include "body_look.h"
#include "body_parts.h"
#include "lanes.h"

enum { BODY_NODES_MAX = 2 * (BODY_TRIANGLES_MAX / LANES + 1) };

enum { TREE_STACK_MAX = 64 }; /* twice the depth of a median tree of all triangles that fit */

struct body_scratch {
	struct v3 *centre_m; /* per triangle, while the tree is built */
	int *fill;           /* per vertex, while stars are built */
	struct parts_scratch *parts;
	struct landmark_scratch *landmarks;
};

/* The nearest triangle of all, through the tree, when one is nearer than the best. What is not
 * nearer than `share` of the best need not be found: 1 for an exact query. */
void near_search(const struct body *body, struct v3 p, unsigned parts, float share,
		 struct nearest *best);

/* Does the point lie where the parts asked for end? */
bool near_on_rim(const struct body *body, const struct nearest *nearest, unsigned parts);

void body_build_normals(struct body *body);

/* Fits the trees' boxes to places that have changed. */
void body_refit(struct body *body);

/* body.prism; then, with the tree, the balls by which a walk can be trusted (body_track.c). */
void body_build_prisms(struct body *body);
void body_find_clear(struct body *body);

/* The vertex normals interpolated at a point of triangle t. */
struct v3 body_smooth_normal(const struct body *body, int t, struct v3 point_m);

#endif
