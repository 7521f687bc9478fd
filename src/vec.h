/* 2- and 3-vectors and the only trigonometry allowed in this program's promises. */
#ifndef VEC_H
#define VEC_H

#include "base.h"

#include <math.h>

struct v2 {
	float x, y;
};

struct v3 {
	float x, y, z;
};

/* Row-major 3x3 rotation: row r is axis r of the rotated frame in the old one. */
struct m3 {
	struct v3 row[3];
};

#define PI_F 3.14159265358979f

static inline struct v2 v2_add(struct v2 a, struct v2 b)
{
	return (struct v2){a.x + b.x, a.y + b.y};
}

static inline struct v2 v2_sub(struct v2 a, struct v2 b)
{
	return (struct v2){a.x - b.x, a.y - b.y};
}

static inline struct v2 v2_scale(struct v2 a, float s)
{
	return (struct v2){a.x * s, a.y * s};
}

static inline float v2_dot(struct v2 a, struct v2 b)
{
	return a.x * b.x + a.y * b.y;
}

/* Twice the signed area of the triangle (0, a, b): positive when b is to the left of a. */
static inline float v2_cross(struct v2 a, struct v2 b)
{
	return a.x * b.y - a.y * b.x;
}

static inline float v2_length(struct v2 a)
{
	return sqrtf(v2_dot(a, a));
}

static inline float v2_distance(struct v2 a, struct v2 b)
{
	return v2_length(v2_sub(a, b));
}

static inline struct v2 v2_lerp(struct v2 a, struct v2 b, float t)
{
	return v2_add(a, v2_scale(v2_sub(b, a), t));
}

/* The unit vector, or zero for a vector shorter than 1e-12. */
static inline struct v2 v2_normalize(struct v2 a)
{
	float length = v2_length(a);
	return length > 1e-12f ? v2_scale(a, 1.0f / length) : (struct v2){0};
}

static inline struct v3 v3_add(struct v3 a, struct v3 b)
{
	return (struct v3){a.x + b.x, a.y + b.y, a.z + b.z};
}

static inline struct v3 v3_sub(struct v3 a, struct v3 b)
{
	return (struct v3){a.x - b.x, a.y - b.y, a.z - b.z};
}

static inline struct v3 v3_scale(struct v3 a, float s)
{
	return (struct v3){a.x * s, a.y * s, a.z * s};
}

/* a + b s */
static inline struct v3 v3_mad(struct v3 a, struct v3 b, float s)
{
	return (struct v3){a.x + b.x * s, a.y + b.y * s, a.z + b.z * s};
}

static inline float v3_dot(struct v3 a, struct v3 b)
{
	return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline struct v3 v3_cross(struct v3 a, struct v3 b)
{
	return (struct v3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static inline float v3_length(struct v3 a)
{
	return sqrtf(v3_dot(a, a));
}

static inline float v3_distance(struct v3 a, struct v3 b)
{
	return v3_length(v3_sub(a, b));
}

static inline struct v3 v3_lerp(struct v3 a, struct v3 b, float t)
{
	return v3_mad(a, v3_sub(b, a), t);
}

/* The unit vector, or zero for a vector shorter than 1e-12. */
static inline struct v3 v3_normalize(struct v3 a)
{
	float length = v3_length(a);
	return length > 1e-12f ? v3_scale(a, 1.0f / length) : (struct v3){0};
}

static inline struct v3 m3_apply(const struct m3 *m, struct v3 a)
{
	return (struct v3){v3_dot(m->row[0], a), v3_dot(m->row[1], a), v3_dot(m->row[2], a)};
}

/* The inverse of m3_apply for a rotation. */
static inline struct v3 m3_apply_transposed(const struct m3 *m, struct v3 a)
{
	return v3_mad(v3_mad(v3_scale(m->row[0], a.x), m->row[1], a.y), m->row[2], a.z);
}

/* Radians; polynomials of our own, absolute error below 3e-6 for |angle| < 100. The C library's
 * differ in the last bit from system to system, which the same-bits promise does not allow. */
float angle_sin(float angle_rad);
float angle_cos(float angle_rad);
float angle_atan2(float y, float x); /* (-pi, pi]; 0 for (0, 0) */
float angle_acos(float cosine);      /* clamps its argument to [-1, 1] */

/* v turned about a unit axis by the right-hand rule (Rodrigues). */
struct v3 v3_turn(struct v3 v, struct v3 axis, float angle_rad);

#endif
