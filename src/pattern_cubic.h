/* A cubic (Bezier) curve from a to b by its two handles, which are told from their ends: fitted to
 * points, and drawn. */
#ifndef PATTERN_CUBIC_H
#define PATTERN_CUBIC_H

#include "vec.h"

/* Sums of the least squares. */
struct cubic_fit {
	struct v2 a, b;
	float pp, pq, qq;
	struct v2 p, q;
};

void cubic_fit_begin(struct cubic_fit *fit, struct v2 a, struct v2 b);

/* A point that should lie at u (0 .. 1). */
void cubic_fit_add(struct cubic_fit *fit, float u, struct v2 at);

/* A straight line's when the points say too little. */
void cubic_fit_end(const struct cubic_fit *fit, struct v2 handle[2]);

struct v2 cubic_at(struct v2 a, struct v2 b, const struct v2 handle[2], float u);

#endif
