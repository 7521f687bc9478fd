/* Meshes with known answers: box, sphere, torus, spiked star. Built into static storage. */
#ifndef SHAPES_H
#define SHAPES_H

#include "body.h"

enum { SHAPE_VERTICES_MAX = 70000, SHAPE_TRIANGLES_MAX = 140000 };

struct shape {
	int vertex_count, triangle_count;
	struct v3 position_m[SHAPE_VERTICES_MAX];
	struct triangle triangle[SHAPE_TRIANGLES_MAX];
};

static inline int shape_vertex(struct shape *shape, float x, float y, float z)
{
	shape->position_m[shape->vertex_count] = (struct v3){x, y, z};
	return shape->vertex_count++;
}

static inline void shape_triangle(struct shape *shape, int a, int b, int c)
{
	shape->triangle[shape->triangle_count++] = (struct triangle){{a, b, c}};
}

/* Half edges x, y, z about the origin. */
static inline void shape_box(struct shape *shape, float x, float y, float z)
{
	static const int face[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
				       {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
	shape->vertex_count = shape->triangle_count = 0;
	for (int v = 0; v < 8; v++)
		shape_vertex(shape, v & 1 ? x : -x, v & 2 ? y : -y, v & 4 ? z : -z);
	for (int f = 0; f < 6; f++) {
		shape_triangle(shape, face[f][0], face[f][1], face[f][2]);
		shape_triangle(shape, face[f][0], face[f][2], face[f][3]);
	}
}

/* Rings of latitude about the Y axis; `radius_of` may vary the radius. */
static inline void shape_globe(struct shape *shape, int rings, int columns,
			       float (*radius_of)(int ring, int column))
{
	shape->vertex_count = shape->triangle_count = 0;
	int south = shape_vertex(shape, 0.0f, -radius_of(0, 0), 0.0f);
	for (int r = 1; r < rings; r++)
		for (int c = 0; c < columns; c++) {
			float latitude = PI_F * ((float)r / (float)rings - 0.5f);
			float longitude = 2.0f * PI_F * (float)c / (float)columns;
			float radius = radius_of(r, c);
			float flat = radius * angle_cos(latitude);
			shape_vertex(shape, flat * angle_sin(longitude),
				     radius * angle_sin(latitude), flat * angle_cos(longitude));
		}
	int north = shape_vertex(shape, 0.0f, radius_of(rings, 0), 0.0f);
	for (int c = 0; c < columns; c++) {
		int d = (c + 1) % columns, top = 1 + (rings - 2) * columns;
		shape_triangle(shape, south, 1 + d, 1 + c);
		shape_triangle(shape, north, top + c, top + d);
		for (int r = 0; r + 2 < rings; r++) {
			int low = 1 + r * columns, high = low + columns;
			shape_triangle(shape, low + c, low + d, high + d);
			shape_triangle(shape, low + c, high + d, high + c);
		}
	}
}

/* About the Y axis: a circle of radius `around`, as thick as twice `tube`. */
static inline void shape_torus(struct shape *shape, int columns, int sides, float around,
			       float tube)
{
	shape->vertex_count = shape->triangle_count = 0;
	for (int c = 0; c < columns; c++)
		for (int s = 0; s < sides; s++) {
			float u = 2.0f * PI_F * (float)c / (float)columns;
			float w = 2.0f * PI_F * (float)s / (float)sides;
			float flat = around + tube * angle_cos(w);
			shape_vertex(shape, flat * angle_sin(u), tube * angle_sin(w),
				     flat * angle_cos(u));
		}
	for (int c = 0; c < columns; c++)
		for (int s = 0; s < sides; s++) {
			int d = (c + 1) % columns * sides, next = (s + 1) % sides;
			shape_triangle(shape, c * sides + s, d + s, d + next);
			shape_triangle(shape, c * sides + s, d + next, c * sides + next);
		}
}

/* A number in [-1, 1]. */
static inline float shape_random(struct scatter *scatter)
{
	return (float)scatter_below(scatter, 2000001) * 1e-6f - 1.0f;
}

static inline struct v3 shape_random_point(struct scatter *scatter, float size)
{
	struct v3 p;
	p.x = size * shape_random(scatter);
	p.y = size * shape_random(scatter);
	p.z = size * shape_random(scatter);
	return p;
}

#endif
