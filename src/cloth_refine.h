/* Finer cloth where its edges sink into the body, and coarser again where they no longer do (S20).
 */
#ifndef CLOTH_REFINE_H
#define CLOTH_REFINE_H

#include "cloth.h"

struct cloth_refine;
struct cloth_refine *cloth_refine_init(struct arena *arena);

/* The test of S20 at vertex A of the edge AB: does the segment cut the sphere of radius |AB| that
 * touches the body at A's nearest point? `inward` is the unit direction from A to it, distance_m
 * how far it is, never less than the distance at which cloth lies. */
bool edge_sinks(struct v3 ab_m, struct v3 inward, float distance_m);

/* One round for a welded cloth, whose garment this is: every triangle whose edges sink is refined
 * by a step, and with `coarsen` those whose edges have come clear are taken back by one. Returns
 * how many triangles of the mesh as it was made change; then the vertices have other numbers, the
 * constraints are new and nothing is held. When the garment is full
 * nothing changes. *units grows by the units spent. */
int cloth_refine(struct cloth *cloth, struct garment *garment, bool coarsen, long *units);

#endif
