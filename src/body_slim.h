/* A body with its limbs, head and neck drawn in to their bones and a flat trunk, to lay and sew a
 * garment round: no hand catches a cuff, no chin a collar, a seam has no shoulder to climb, and
 * under the arms and between the legs there is room for cloth. It then grows into the garment until
 * it is the body itself. */
#ifndef BODY_SLIM_H
#define BODY_SLIM_H

#include "body_limb.h"

/* Takes memory for places and trees; the rest is the full body's own. */
void body_slim_init(struct body *slim, struct arena *arena);

/* The body with its limbs grown so far: share 0: thin, 1: as they are. `whole`: parts that
 * stay as they are, bits of enum body_part. Triangles and parts are the full body's; no walk on it
 * is trusted (body.clear: balls of radius 0). Hands and feet are of no part (PART_COUNT): who asks
 * for parts does not meet them. False: the body has no limbs, nothing was made. */
bool body_slim_make(struct body *slim, const struct body *full, const struct limb_shape *limb,
		    unsigned whole, float share);

#endif
