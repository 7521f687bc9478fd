/* A body with its limbs, head and neck drawn in to their bones and a flat trunk, to lay and sew a
 * garment round: no hand catches a cuff, no chin a collar, a seam has no shoulder to climb, and
 * under the arms and between the legs there is room for cloth. It then grows into the garment until
 * it is the body itself. */
#ifndef BODY_SLIM_H
#define BODY_SLIM_H

#include "body_limb.h"

/* How a vertex is drawn in. */
struct slim_way {
	struct v3 axis_m; /* nearest point of its limb's bones, to which it goes; of a joined leg's
			     inner side: a place beyond the middle between both legs */
	float middle_m;   /* z of the trunk's bones, to which it goes; its own: it stays */
	float in;         /* 0..1: share of the way to its limb's bones; below 0: it has none */
};

struct slim_body {
	struct body body;     /* as it is now */
	struct slim_way *way; /* per vertex */
};

/* Takes memory for places and trees; the rest is the full body's own. */
void body_slim_init(struct slim_body *slim, struct arena *arena);

/* The full body at its thinnest. `whole`: parts that are not drawn in, bits of enum body_part; legs
 * that are whole are joined, their inner sides meeting, so that a skirt lies on both as on one.
 * Triangles and parts are the full body's; no walk on it is trusted (body.clear: balls of radius
 * 0). Hands and feet are of no part (PART_COUNT): who asks for parts does not meet them. False: the
 * body has no limbs, nothing was made. */
bool body_slim_make(struct slim_body *slim, const struct body *full, const struct limb_shape *limb,
		    unsigned whole);

/* The same grown so far: share 0: thin, 1: as it is. */
void body_slim_grow(struct slim_body *slim, const struct body *full, float share);

#endif
