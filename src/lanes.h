/* Four floats worked on at once, by the compiler's own vectors: SSE2 and NEON have them, and each
 * lane is rounded as a float is, so that the bits are the same everywhere. */
#ifndef LANES_H
#define LANES_H

#include "vec.h"

enum { LANES = 4 };

typedef float lanes __attribute__((vector_size(16)));
typedef int32_t lane_mask __attribute__((vector_size(16))); /* -1: yes, 0: no */

/* Lanes of a (0 to 3) and of b (4 to 7). */
#define LANES_LOW(a, b) __builtin_shufflevector(a, b, 0, 4, 1, 5)
#define LANES_HIGH(a, b) __builtin_shufflevector(a, b, 2, 6, 3, 7)
#define LANES_JOIN(a, b, i, j, k) __builtin_shufflevector(a, b, i, j, k, k)

struct lanes3 {
	lanes x, y, z;
};

static inline lanes lanes_of(float a)
{
	return (lanes){a, a, a, a};
}

static inline lanes lanes_select(lane_mask mask, lanes yes, lanes no)
{
	return (lanes)((mask & (lane_mask)yes) | (~mask & (lane_mask)no));
}

static inline bool lanes_any(lane_mask mask)
{
	uint64_t half[2];
	memcpy(half, &mask, sizeof half);
	return (half[0] | half[1]) != 0;
}

static inline lanes lanes_min(lanes a, lanes b)
{
	return lanes_select(a < b, a, b);
}

static inline lanes lanes_max(lanes a, lanes b)
{
	return lanes_select(a > b, a, b);
}

static inline lanes lanes_above_zero(lanes a)
{
	return (lanes)((a > lanes_of(0.0f)) & (lane_mask)a);
}

static inline lanes lanes_abs(lanes a)
{
	return (lanes)((lane_mask)a & (lane_mask){INT32_MAX, INT32_MAX, INT32_MAX, INT32_MAX});
}

static inline struct lanes3 lanes3_of(struct v3 a)
{
	return (struct lanes3){lanes_of(a.x), lanes_of(a.y), lanes_of(a.z)};
}

static inline struct lanes3 lanes3_sub(struct lanes3 a, struct lanes3 b)
{
	return (struct lanes3){a.x - b.x, a.y - b.y, a.z - b.z};
}

/* a - b s */
static inline struct lanes3 lanes3_less(struct lanes3 a, struct lanes3 b, lanes s)
{
	return (struct lanes3){a.x - b.x * s, a.y - b.y * s, a.z - b.z * s};
}

static inline lanes lanes3_dot(struct lanes3 a, struct lanes3 b)
{
	return a.x * b.x + a.y * b.y + a.z * b.z;
}

/* A vector as it lies in memory; the last lane takes what lies behind it. */
static inline lanes lanes_row(const struct v3 *a)
{
	typedef float loose __attribute__((vector_size(16), aligned(4), may_alias));
	return (lanes) * (const loose *)a;
}

/* x x + y y + z z of four rows. */
static inline lanes lanes_squared_lengths(lanes a, lanes b, lanes c, lanes d)
{
	a *= a;
	b *= b;
	c *= c;
	d *= d;
	lanes xy_01 = LANES_LOW(a, b), xy_23 = LANES_LOW(c, d);
	lanes z_01 = LANES_HIGH(a, b), z_23 = LANES_HIGH(c, d);
	lanes x = __builtin_shufflevector(xy_01, xy_23, 0, 1, 4, 5);
	lanes y = __builtin_shufflevector(xy_01, xy_23, 2, 3, 6, 7);
	lanes z = __builtin_shufflevector(z_01, z_23, 0, 1, 4, 5);
	return x + y + z;
}

#endif
