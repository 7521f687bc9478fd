/* Shared between garment_refine*.c only. */
#ifndef GARMENT_REFINE_PRIVATE_H
#define GARMENT_REFINE_PRIVATE_H

#include "garment_refine.h"

struct refine_scratch {
	int *base_of;    /* per garment vertex: base vertex, -1 */
	int *edge_first; /* per garment vertex + 1, while edges are paired */
	int *edge;       /* 3 * triangle + corner */
	/* the change: */
	uint8_t *depth;  /* per base triangle */
	uint8_t *places; /* per base triangle: bit p: there is a vertex at place p */
	int *first;      /* per base triangle: its first vertex */
	int *to;         /* per base vertex: its new number */
	int *place, *weld;
	struct v2 *rest_m;
	struct seam_pair *pair;
};

static inline int next_edge(int edge)
{
	return edge % 3 == 2 ? edge - 2 : edge + 1;
}

static inline int previous_edge(int edge)
{
	return edge % 3 == 0 ? edge + 2 : edge - 1;
}

/* Edge e of the base runs from edge_start(e) to edge_start(next_edge(e)). */
static inline int edge_start(const struct garment *garment, int edge)
{
	return garment->base[edge / 3].v[edge % 3];
}

static inline int edge_start_welded(const struct refiner *refiner, const struct garment *garment,
				    int edge)
{
	return garment->weld[refiner->now[edge_start(garment, edge)]];
}

#endif
