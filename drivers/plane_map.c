#include "plane_map.h"

#include <stdio.h>

enum { UNKNOWNS = 8 };

const struct plane_map plane_map_identity = {
	{{1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 1.0f}}};

struct v2 plane_map_apply(const struct plane_map *map, struct v2 a)
{
	const float(*m)[3] = map->m;
	float w = m[2][0] * a.x + m[2][1] * a.y + m[2][2];
	float x = m[0][0] * a.x + m[0][1] * a.y + m[0][2];
	float y = m[1][0] * a.x + m[1][1] * a.y + m[1][2];
	/* beyond the horizon no position is right: the nearest finite one */
	w = w < 0.0f ? float_min(w, -1e-6f) : float_max(w, 1e-6f);
	return (struct v2){x / w, y / w};
}

struct plane_map plane_map_join(const struct plane_map *first, const struct plane_map *second)
{
	struct plane_map map;
	for (int i = 0; i < 3; i++)
		for (int k = 0; k < 3; k++)
			map.m[i][k] = second->m[i][0] * first->m[0][k] +
				      second->m[i][1] * first->m[1][k] +
				      second->m[i][2] * first->m[2][k];
	return map;
}

bool plane_map_invert(const struct plane_map *map, struct plane_map *inverse)
{
	double cofactor[3][3], determinant = 0.0, size = 0.0;
	for (int i = 0; i < 3; i++)
		for (int k = 0; k < 3; k++) {
			int i1 = (i + 1) % 3, i2 = (i + 2) % 3, k1 = (k + 1) % 3, k2 = (k + 2) % 3;
			cofactor[i][k] = (double)map->m[i1][k1] * (double)map->m[i2][k2] -
					 (double)map->m[i1][k2] * (double)map->m[i2][k1];
		}
	for (int k = 0; k < 3; k++) {
		double part = (double)map->m[0][k] * cofactor[0][k];
		determinant += part;
		size += part < 0.0 ? -part : part;
	}
	*inverse = plane_map_identity;
	double least = 1e-9 * size;
	if (!(determinant > least || determinant < -least))
		return false;
	for (int i = 0; i < 3; i++)
		for (int k = 0; k < 3; k++)
			inverse->m[i][k] = (float)(cofactor[k][i] / determinant);
	return true;
}

struct plane_map plane_map_fit(struct v2 picture, int degrees, struct v2 panel)
{
	static const float cosines[4] = {1.0f, 0.0f, -1.0f, 0.0f};
	MUST(degrees >= 0 && degrees < 360 && degrees % 90 == 0);
	MUST(picture.x > 0.0f && picture.y > 0.0f && panel.x > 0.0f && panel.y > 0.0f);
	int quarter = degrees / 90;
	float cosine = cosines[quarter], sine = cosines[(quarter + 3) % 4];
	struct v2 turned = quarter & 1 ? (struct v2){picture.y, picture.x} : picture;
	float scale = float_min(panel.x / turned.x, panel.y / turned.y);
	float c = scale * cosine, s = scale * sine;
	float x = 0.5f * (panel.x - c * picture.x + s * picture.y);
	float y = 0.5f * (panel.y - s * picture.x - c * picture.y);
	return (struct plane_map){{{c, -s, x}, {s, c, y}, {0.0f, 0.0f, 1.0f}}};
}

/* ---- calibration ---- */

/* Points to a mean of 0 and a mean distance of about 1 from it: only so do the equations' terms
 * compare. False when they all coincide. */
static bool normal_map(const struct v2 *point, int count, struct plane_map *map)
{
	struct v2 middle = {0};
	float spread = 0.0f;
	for (int i = 0; i < count; i++)
		middle = v2_add(middle, v2_scale(point[i], 1.0f / (float)count));
	for (int i = 0; i < count; i++)
		spread += v2_distance(point[i], middle) / (float)count;
	*map = plane_map_identity;
	if (!(spread > 1e-6f))
		return false;
	float scale = 1.0f / spread;
	map->m[0][0] = map->m[1][1] = scale;
	map->m[0][2] = -scale * middle.x;
	map->m[1][2] = -scale * middle.y;
	return true;
}

/* Adds an equation to the normal equations of the eight unknowns. */
static void equation_add(double sum[UNKNOWNS][UNKNOWNS + 1], const double row[UNKNOWNS + 1])
{
	for (int i = 0; i < UNKNOWNS; i++)
		for (int k = 0; k <= UNKNOWNS; k++)
			sum[i][k] += row[i] * row[k];
}

/* Elimination with the largest pivot; false when the points don't determine the map. */
static bool equations_solve(double sum[UNKNOWNS][UNKNOWNS + 1], double unknown[UNKNOWNS])
{
	for (int c = 0; c < UNKNOWNS; c++) {
		int best = c;
		for (int r = c + 1; r < UNKNOWNS; r++) {
			double a = sum[r][c] < 0.0 ? -sum[r][c] : sum[r][c];
			double b = sum[best][c] < 0.0 ? -sum[best][c] : sum[best][c];
			best = a > b ? r : best;
		}
		double pivot = sum[best][c];
		if (!(pivot > 1e-7 || pivot < -1e-7))
			return false;
		for (int k = 0; k <= UNKNOWNS; k++) {
			double keep = sum[c][k];
			sum[c][k] = sum[best][k];
			sum[best][k] = keep;
		}
		for (int r = 0; r < UNKNOWNS; r++) {
			double share = r == c ? 0.0 : sum[r][c] / pivot;
			for (int k = c; k <= UNKNOWNS && share != 0.0; k++)
				sum[r][k] -= share * sum[c][k];
		}
	}
	for (int i = 0; i < UNKNOWNS; i++)
		unknown[i] = sum[i][UNKNOWNS] / sum[i][i];
	return true;
}

/* On normalised points: m is row by row, its last element 1. */
static bool map_solve(const struct v2 *from, const struct v2 *to, int count,
		      const struct plane_map *from_normal, const struct plane_map *to_normal,
		      struct plane_map *map)
{
	double sum[UNKNOWNS][UNKNOWNS + 1] = {{0.0}}, u[UNKNOWNS];
	for (int i = 0; i < count; i++) {
		struct v2 a = plane_map_apply(from_normal, from[i]);
		struct v2 b = plane_map_apply(to_normal, to[i]);
		double x = (double)a.x, y = (double)a.y, X = (double)b.x, Y = (double)b.y;
		equation_add(sum, (double[]){x, y, 1.0, 0.0, 0.0, 0.0, -X * x, -X * y, X});
		equation_add(sum, (double[]){0.0, 0.0, 0.0, x, y, 1.0, -Y * x, -Y * y, Y});
	}
	if (!equations_solve(sum, u))
		return false;
	*map = (struct plane_map){{{(float)u[0], (float)u[1], (float)u[2]},
				   {(float)u[3], (float)u[4], (float)u[5]},
				   {(float)u[6], (float)u[7], 1.0f}}};
	return true;
}

/* A camera's map never turns the plane inside out between its points: the orientation is the same
 * at all of them. The determinant of the derivative has the sign of det / w^3. */
static bool map_folds(const struct plane_map *map, const struct v2 *from, int count)
{
	int sign = 0;
	for (int i = 0; i < count; i++) {
		float w = map->m[2][0] * from[i].x + map->m[2][1] * from[i].y + map->m[2][2];
		int here = w > 0.0f ? 1 : -1;
		if (sign && here != sign)
			return true;
		sign = here;
	}
	return false;
}

bool plane_map_find(const struct v2 *from, const struct v2 *to, int count, struct plane_map *map,
		    float *rms, float *worst, char fault[200])
{
	struct plane_map from_normal, to_normal, from_to, back;
	*map = plane_map_identity;
	*rms = *worst = 0.0f;
	if (count < PLANE_MAP_POINTS_MIN || count > PLANE_MAP_POINTS_MAX) {
		snprintf(fault, 200, "%d points: give %d to %d", count, PLANE_MAP_POINTS_MIN,
			 PLANE_MAP_POINTS_MAX);
		return false;
	}
	if (!normal_map(from, count, &from_normal) || !normal_map(to, count, &to_normal) ||
	    !map_solve(from, to, count, &from_normal, &to_normal, &from_to)) {
		snprintf(fault, 200,
			 "the points coincide or lie on a line: touch crosses in all four corners");
		return false;
	}
	plane_map_invert(&to_normal, &back);
	struct plane_map half = plane_map_join(&from_normal, &from_to);
	*map = plane_map_join(&half, &back);
	if (!plane_map_invert(map, &half) || map_folds(map, from, count)) {
		*map = plane_map_identity;
		snprintf(fault, 200, "the points are out of order: touch the crosses one by one");
		return false;
	}
	float squares = 0.0f;
	for (int i = 0; i < count; i++) {
		float off = v2_distance(plane_map_apply(map, from[i]), to[i]);
		squares += off * off;
		*worst = float_max(*worst, off);
	}
	*rms = sqrtf(squares / (float)count);
	return true;
}
