/* Adaptive sqrt(3) refinement of a garment's mesh (Kobbelt 2000; interpolatory after Labsik and
 * Greiner 2000: a vertex that is there keeps its place and its rest coordinates).
 *
 * The refined mesh is a function of the mesh as it was made, the base, and of a depth for each of
 * its triangles, so that it does not matter in which order triangles were refined, and depth 0
 * everywhere is the base again, bit for bit.
 *
 *   depth 1  a triangle gets a vertex at its centre; an edge between two such triangles is turned
 *            to join their centres. A triangle beside one of depth 0 stays split in three
 *   depth 2  the triangles round the centre get a vertex each in the same way. Rims and seams,
 *            which can't be turned, are cut in three, on both sides of a seam alike. Neighbours of
 *            depth 0 become 1
 */
#ifndef GARMENT_REFINE_H
#define GARMENT_REFINE_H

#include "garment.h"

enum {
	REFINE_DEPTH_MAX = 2,
	/* where in a base triangle a vertex was put: */
	REFINE_CENTRE = 0,
	REFINE_NEAR = 1, /* + k: beside edge k, towards its start; on it when it can't be turned */
	REFINE_FAR = 4,  /* + k: on edge k, towards its end */
	REFINE_PLACES = 8,
	/* across an edge of the base: */
	REFINE_RIM = -1,  /* nothing */
	REFINE_KNOT = -2, /* too much: three triangles at one edge. Such an edge stays whole */
};

/* Scratch, and what the last call found. Base vertices are counted among themselves. */
struct refiner {
	int base_vertices;
	int *now;    /* per base vertex: garment vertex */
	int *across; /* 3 per base triangle: 3 * the other + its edge, over seams too; or see above
		      */
	uint8_t *inner; /* per base triangle: bit k: edge k may be turned */
	int *from;      /* per garment vertex: what it was before the change; -1: it is new */
	struct refine_scratch *scratch; /* owned by garment_refine.c */
};

void refiner_init(struct refiner *refiner, struct arena *arena);

/* Finds the base of a garment: itself, when it is not refined. */
void refiner_look(struct refiner *refiner, struct garment *garment);

/* Forgets the base of a garment that is not refined. */
void refiner_close(struct garment *garment);

/* Edge 3 * triangle + k lies within a piece and may be turned. */
static inline bool refiner_inner(const struct refiner *refiner, int edge)
{
	return refiner->inner[edge / 3] >> edge % 3 & 1;
}

/* Raises neighbours of depth 2 to depth 1. */
void refiner_balance(const struct refiner *refiner, const struct garment *garment, uint8_t *depth);

/* After refiner_look: the garment takes these depths (balanced), one for each base triangle. False:
 * it would have too many vertices; nothing has changed then. */
bool garment_refine(struct refiner *refiner, struct garment *garment, const uint8_t *depth);

/* After garment_refine: the vertices whose mean a new vertex is. A centre's come first. */
void refiner_parents(const struct refiner *refiner, const struct garment *garment, int v,
		     int parent[3]);

#endif
