/* Shared between the body's own files only. */
#ifndef BODY_PRIVATE_H
#define BODY_PRIVATE_H

#include "body.h"

enum { PART_LEVELS = 128 };

/* Contours of the distance from a limb's tip. */
struct contour {
	float girth_m[PART_LEVELS];
	struct v3 centre_m[PART_LEVELS];
	float step_m; /* level i lies at (i + 0.5) steps */
};

struct body_scratch {
	struct v3 *centre_m; /* per triangle, while the tree is built */
	int *fill;           /* per vertex */

	/* the graph of ways along the surface: edges, and diagonals across them */
	int *way_first; /* per vertex + 1 */
	int *way_to;
	float *way_m;
	int *heap, *heap_place;
	int heap_count;

	float *distance_m, *nearest_m, *mean_m; /* per vertex */
	int *order, *group, *tip_of;            /* per vertex: the sweep of maxima */
	struct contour contour;
};

/* Builds the graph once a body (body_distance.c). */
void body_ways(struct body *body);

/* Distances along the surface from one vertex, into distance_m: Dijkstra on edges and diagonals;
 * within 2 % of the geodesic on even meshes. */
void body_distances(const struct body *body, int from, float *distance_m);

#endif
