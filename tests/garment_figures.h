/* What tests and benchmarks look at in a meshed garment. */
#ifndef GARMENT_FIGURES_H
#define GARMENT_FIGURES_H

#include "garment.h"

#include <math.h>
#include <stdlib.h>

struct figures {
	int clockwise;                       /* triangles without positive area */
	int bad_edges;                       /* welded edges with more than two triangles */
	int collapsed;                       /* triangles that the weld makes a line */
	int euler;                           /* of the welded surface */
	int open_edges;                      /* welded edges with one triangle */
	float angle_min_deg, angle_mean_deg; /* of each triangle's smallest angle */
	int below_25, below_30;
	double area_mm2[PIECES_MAX];
	float edge_shortest_mm, edge_longest_mm;
};

static inline int figures_compare(const void *a, const void *b)
{
	uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
	return (x > y) - (x < y);
}

static inline float figures_angle_deg(struct v2 a, struct v2 b, struct v2 c)
{
	struct v2 p = v2_sub(b, a), q = v2_sub(c, a);
	return 57.2957795f * atan2f(fabsf(v2_cross(p, q)), v2_dot(p, q));
}

static inline void figures_triangle(struct figures *figures, const struct garment *garment, int t)
{
	const int *v = garment->triangle[t].v;
	struct v2 p[3];
	float least = 180.0f;
	for (int k = 0; k < 3; k++)
		p[k] = v2_scale(garment->rest_m[v[k]], 1000.0f);
	for (int k = 0; k < 3; k++) {
		least = fminf(least, figures_angle_deg(p[k], p[(k + 1) % 3], p[(k + 2) % 3]));
		float length = v2_distance(p[k], p[(k + 1) % 3]);
		figures->edge_shortest_mm = fminf(figures->edge_shortest_mm, length);
		figures->edge_longest_mm = fmaxf(figures->edge_longest_mm, length);
		if (garment->weld[v[k]] == garment->weld[v[(k + 1) % 3]])
			figures->collapsed++;
	}
	float area = 0.5f * v2_cross(v2_sub(p[1], p[0]), v2_sub(p[2], p[0]));
	figures->clockwise += !(area > 0.0f);
	figures->area_mm2[garment->triangle_piece[t]] += (double)area;
	figures->angle_min_deg = fminf(figures->angle_min_deg, least);
	figures->angle_mean_deg += least / (float)garment->triangle_count;
	figures->below_25 += least < 25.0f;
	figures->below_30 += least < 30.0f;
}

static inline void figures_measure(struct figures *figures, const struct garment *garment)
{
	static uint64_t edge[3 * GARMENT_TRIANGLES_MAX];
	*figures = (struct figures){.angle_min_deg = 180.0f, .edge_shortest_mm = 1e9f};
	int count = 0, edges = 0, vertices = 0;
	for (int t = 0; t < garment->triangle_count; t++) {
		figures_triangle(figures, garment, t);
		for (int k = 0; k < 3; k++) {
			int a = garment->weld[garment->triangle[t].v[k]];
			int b = garment->weld[garment->triangle[t].v[(k + 1) % 3]];
			edge[count++] = (uint64_t)int_min(a, b) << 32 | (uint64_t)int_max(a, b);
		}
	}
	qsort(edge, (size_t)count, sizeof *edge, figures_compare);
	for (int i = 0, k; i < count; i = k) {
		for (k = i; k < count && edge[k] == edge[i]; k++)
			;
		edges++;
		figures->bad_edges += k - i > 2;
		figures->open_edges += k - i == 1;
	}
	for (int v = 0; v < garment->vertex_count; v++)
		vertices += garment->weld[v] == v;
	figures->euler = vertices - edges + garment->triangle_count;
}

#endif
