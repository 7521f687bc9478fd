/* Seams whose one side is pleated, or gathered, onto the other. */
#ifndef CLOTH_PLEAT_H
#define CLOTH_PLEAT_H

#include "cloth.h"

struct pleats {
	int first, end; /* of garment.pair: the seam's */
	int side;       /* 0: the a's are the longer side, 1: the b's */
	float share;    /* of the longer side's length that is left, below 1 */
	float excess_m; /* and what is taken up */
};

/* The next seam with pleats from garment.pair[*at] on, which goes past it. False: there is none. */
bool cloth_pleats(const struct garment *garment, int *at, struct pleats *pleats);

/* Finds where cloth is squeezed. */
void cloth_build_pleats(struct cloth *cloth);

/* From one corner of triangle t to another at rest, as gathers, pleats and letting out leave it. */
struct v2 cloth_flat_way(const struct cloth *cloth, int t, int from, int to);

#endif
