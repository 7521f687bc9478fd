/* Fairing of a half body: what the lofts leave uneven where they meet is made smooth. */
#ifndef MANNEQUIN_FAIR_H
#define MANNEQUIN_FAIR_H

#include "mannequin_loft.h"

/* Scratch: one entry for each vertex of the sheet, `triangle` one for each triangle. */
struct fair {
	struct v3 *sum, *bend;
	int *valence;
	int *vertex, *triangle; /* those at work */
	int vertex_count, triangle_count;
};

/* A ball in which fairing works, fully in the middle and not at all from its radius on. */
struct fair_spot {
	struct v3 middle_m;
	float radius_m;
	int rounds;
};

/* Minimises bending (the discrete bi-Laplacian, by damped Jacobi steps) inside a spot. Vertices
 * with x = 0 stay there: the sheet is taken to go on as its own mirror image. */
void fair_bend(struct sheet *sheet, struct fair *fair, const struct fair_spot *spot);

/* Evens the triangles out: vertices slide in the surface towards the middle of their neighbours. */
void fair_slide(struct sheet *sheet, struct fair *fair, int rounds);

#endif
