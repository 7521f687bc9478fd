/* Exact plane geometry. Millimetres are snapped to a grid of 1/1024 mm, on which the questions
 * "which side?" and "inside this circle?" have exact integer answers, the same on every machine.
 *
 * Ranges: coordinates within +-2^26 (65 m), so that differences fit 2^27, an orientation 2^55 and
 * the in-circle determinant 2^112. */
#ifndef PATTERN_GRID_H
#define PATTERN_GRID_H

#include "vec.h"

enum { GRID_PER_MM = 1024 };

struct grid_point {
	int32_t x, y;
};

__extension__ typedef __int128 int128;

/* Nearest grid point; |mm| must stay below 60,000. */
static inline int32_t grid_snap(float mm)
{
	float scaled = mm * (float)GRID_PER_MM;
	return (int32_t)(scaled + (scaled >= 0.0f ? 0.5f : -0.5f));
}

static inline struct grid_point grid_from_mm(struct v2 mm)
{
	return (struct grid_point){grid_snap(mm.x), grid_snap(mm.y)};
}

static inline struct v2 grid_to_mm(struct grid_point p)
{
	return (struct v2){(float)p.x / (float)GRID_PER_MM, (float)p.y / (float)GRID_PER_MM};
}

static inline bool grid_same(struct grid_point a, struct grid_point b)
{
	return a.x == b.x && a.y == b.y;
}

/* Twice the signed area of a b c: positive when c lies to the left of a -> b. */
static inline int64_t grid_orient(struct grid_point a, struct grid_point b, struct grid_point c)
{
	return (int64_t)(b.x - a.x) * (c.y - a.y) - (int64_t)(b.y - a.y) * (c.x - a.x);
}

static inline int64_t grid_dot(struct grid_point a, struct grid_point b, struct grid_point c)
{
	return (int64_t)(b.x - a.x) * (c.x - a.x) + (int64_t)(b.y - a.y) * (c.y - a.y);
}

static inline int64_t grid_distance_squared(struct grid_point a, struct grid_point b)
{
	int64_t x = b.x - a.x, y = b.y - a.y;
	return x * x + y * y;
}

/* Is d strictly inside the circle through the counter-clockwise triangle a b c? (Guibas and Stolfi
 * 1985, InCircle.) */
static inline bool grid_in_circle(struct grid_point a, struct grid_point b, struct grid_point c,
				  struct grid_point d)
{
	int64_t ax = a.x - d.x, ay = a.y - d.y;
	int64_t bx = b.x - d.x, by = b.y - d.y;
	int64_t cx = c.x - d.x, cy = c.y - d.y;
	int128 sum = (int128)(ax * ax + ay * ay) * (bx * cy - by * cx);
	sum += (int128)(bx * bx + by * by) * (cx * ay - cy * ax);
	sum += (int128)(cx * cx + cy * cy) * (ax * by - ay * bx);
	return sum > 0;
}

/* Do the closed segments a b and c d share a point? */
bool grid_segments_meet(struct grid_point a, struct grid_point b, struct grid_point c,
			struct grid_point d);

#endif
