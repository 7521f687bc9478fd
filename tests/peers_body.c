/* The capsule figure, polygonised by naive surface nets (Gibson 1998) and evened out: a vertex in
 * every cell that the surface passes, four cells around every edge that it crosses. */
#include "peers.h"

#include <math.h>
#include <stdlib.h>

enum { EVEN_ROUNDS = 12 };

static const float cell_m = 0.0139f; /* 24,756 triangles */
static const float blend_m = 0.03f;  /* width of the smooth union's fillets */

static const struct capsule figure[] = {
	{{0.0f, 0.95f, 0.0f}, {0.0f, 1.12f, 0.0f}, 0.140f, 0.125f},
	{{0.0f, 1.12f, 0.0f}, {0.0f, 1.30f, 0.0f}, 0.125f, 0.135f},
	{{-0.14f, 1.36f, 0.0f}, {0.14f, 1.36f, 0.0f}, 0.075f, 0.075f},
	{{0.0f, 1.40f, 0.0f}, {0.0f, 1.59f, 0.01f}, 0.060f, 0.105f},
	{{0.17f, 1.36f, 0.0f}, {0.38f, 1.12f, 0.0f}, 0.055f, 0.042f},
	{{-0.17f, 1.36f, 0.0f}, {-0.38f, 1.12f, 0.0f}, 0.055f, 0.042f},
	{{0.38f, 1.12f, 0.0f}, {0.55f, 0.90f, 0.0f}, 0.042f, 0.034f},
	{{-0.38f, 1.12f, 0.0f}, {-0.55f, 0.90f, 0.0f}, 0.042f, 0.034f},
	{{0.10f, 0.90f, 0.0f}, {0.11f, 0.50f, 0.0f}, 0.095f, 0.060f},
	{{-0.10f, 0.90f, 0.0f}, {-0.11f, 0.50f, 0.0f}, 0.095f, 0.060f},
	{{0.11f, 0.50f, 0.0f}, {0.12f, 0.05f, 0.0f}, 0.060f, 0.045f},
	{{-0.11f, 0.50f, 0.0f}, {-0.12f, 0.05f, 0.0f}, 0.060f, 0.045f},
};

static float capsule_distance(const struct capsule *c, struct v3 p)
{
	struct v3 axis = v3_sub(c->b_m, c->a_m);
	float t = float_clamp(v3_dot(v3_sub(p, c->a_m), axis) / v3_dot(axis, axis), 0.0f, 1.0f);
	return v3_distance(p, v3_mad(c->a_m, axis, t)) -
	       (c->a_radius_m + (c->b_radius_m - c->a_radius_m) * t);
}

static float figure_distance(struct v3 p)
{
	float d = capsule_distance(&figure[0], p);
	for (int i = 1; i < COUNT_OF(figure); i++) {
		float e = capsule_distance(&figure[i], p);
		float h = float_max(blend_m - float_abs(d - e), 0.0f) / blend_m;
		d = float_min(d, e) - 0.25f * blend_m * h * h;
	}
	return d;
}

static struct v3 figure_gradient(struct v3 p)
{
	const float h = 0.0005f;
	struct v3 g = {figure_distance((struct v3){p.x + h, p.y, p.z}) -
			       figure_distance((struct v3){p.x - h, p.y, p.z}),
		       figure_distance((struct v3){p.x, p.y + h, p.z}) -
			       figure_distance((struct v3){p.x, p.y - h, p.z}),
		       figure_distance((struct v3){p.x, p.y, p.z + h}) -
			       figure_distance((struct v3){p.x, p.y, p.z - h})};
	return v3_normalize(g);
}

/* ---- the grid ---- */

struct grid {
	int size[3];
	float cell_m;
	struct v3 low_m;
	float *distance; /* at corners */
	int *vertex;     /* of the cell above a corner; -1 */
};

static int corner_at(const struct grid *grid, int x, int y, int z)
{
	return (z * grid->size[1] + y) * grid->size[0] + x;
}

static struct v3 corner_place(const struct grid *grid, int x, int y, int z)
{
	return v3_mad(grid->low_m, (struct v3){(float)x, (float)y, (float)z}, grid->cell_m);
}

static void grid_fill(struct grid *grid)
{
	const struct v3 low = {-0.65f, -0.05f, -0.25f}, high = {0.65f, 1.80f, 0.25f};
	struct v3 span = v3_scale(v3_sub(high, low), 1.0f / cell_m);
	*grid = (struct grid){
		{(int)span.x + 2, (int)span.y + 2, (int)span.z + 2}, cell_m, low, NULL, NULL};
	size_t count = (size_t)grid->size[0] * (size_t)grid->size[1] * (size_t)grid->size[2];
	grid->distance = calloc(count, sizeof *grid->distance);
	grid->vertex = calloc(count, sizeof *grid->vertex);
	MUST(grid->distance && grid->vertex);
	for (int z = 0; z < grid->size[2]; z++)
		for (int y = 0; y < grid->size[1]; y++)
			for (int x = 0; x < grid->size[0]; x++)
				grid->distance[corner_at(grid, x, y, z)] = figure_distance(
					corner_place(grid, x, y, z));
}

/* ---- the mesh ---- */

static void project(struct v3 *p)
{
	for (int i = 0; i < 3; i++)
		*p = v3_mad(*p, figure_gradient(*p), -figure_distance(*p));
}

static void lay_vertices(const struct grid *grid, struct peers_body *body)
{
	for (int z = 0; z + 1 < grid->size[2]; z++)
		for (int y = 0; y + 1 < grid->size[1]; y++)
			for (int x = 0; x + 1 < grid->size[0]; x++) {
				int inside = 0;
				for (int k = 0; k < 8; k++)
					inside += grid->distance[corner_at(grid, x + (k & 1),
									   y + (k >> 1 & 1),
									   z + (k >> 2))] < 0.0f;
				int *vertex = &grid->vertex[corner_at(grid, x, y, z)];
				*vertex = -1;
				if (inside == 0 || inside == 8)
					continue;
				*vertex = body->vertex_count++;
				struct v3 p = corner_place(grid, x, y, z);
				const struct v3 middle = {0.5f, 0.5f, 0.5f};
				p = v3_mad(p, middle, grid->cell_m);
				project(&p);
				body->position_m[*vertex] = p;
			}
}

/* The four cells around the edge from a corner along an axis. */
static void lay_quad(const struct grid *grid, struct peers_body *body, int corner, int axis,
		     bool leaves)
{
	const int stride[3] = {1, grid->size[0], grid->size[0] * grid->size[1]};
	int u = stride[(axis + 1) % 3], v = stride[(axis + 2) % 3];
	int ring[4] = {grid->vertex[corner - u - v], grid->vertex[corner - v], grid->vertex[corner],
		       grid->vertex[corner - u]};
	struct triangle *t = &body->triangle[body->triangle_count];
	int b = leaves ? 1 : 3, d = leaves ? 3 : 1;
	t[0] = (struct triangle){{ring[0], ring[b], ring[2]}};
	t[1] = (struct triangle){{ring[0], ring[2], ring[d]}};
	body->triangle_count += 2;
}

static void lay_quads(const struct grid *grid, struct peers_body *body)
{
	const int stride[3] = {1, grid->size[0], grid->size[0] * grid->size[1]};
	for (int z = 1; z + 1 < grid->size[2]; z++)
		for (int y = 1; y + 1 < grid->size[1]; y++)
			for (int x = 1; x + 1 < grid->size[0]; x++)
				for (int axis = 0; axis < 3; axis++) {
					int at = corner_at(grid, x, y, z);
					bool in = grid->distance[at] < 0.0f;
					if (in != (grid->distance[at + stride[axis]] < 0.0f))
						lay_quad(grid, body, at, axis, in);
				}
}

/* Every vertex to the mean of its neighbours, then back to the surface. */
static void even_out(struct peers_body *body)
{
	size_t count = (size_t)body->vertex_count;
	struct v3 *sum = calloc(count, sizeof *sum);
	int *times = calloc(count, sizeof *times);
	MUST(sum && times);
	for (int t = 0; t < body->triangle_count; t++)
		for (int k = 0; k < 3; k++) {
			int a = body->triangle[t].v[k], b = body->triangle[t].v[(k + 1) % 3];
			sum[a] = v3_add(sum[a], body->position_m[b]);
			times[a]++;
		}
	for (int v = 0; v < body->vertex_count; v++) {
		struct v3 mean = v3_scale(sum[v], 1.0f / (float)times[v]);
		body->position_m[v] = v3_lerp(body->position_m[v], mean, 0.5f);
		project(&body->position_m[v]);
	}
	free(sum);
	free(times);
}

void peers_make_body(struct peers_body *body)
{
	enum { VERTICES_MAX = 65536 };
	struct grid grid;
	*body = (struct peers_body){.capsule_count = COUNT_OF(figure), .capsule = figure};
	body->position_m = calloc(VERTICES_MAX, sizeof *body->position_m);
	body->triangle = calloc(2 * VERTICES_MAX, sizeof *body->triangle);
	MUST(body->position_m && body->triangle);
	grid_fill(&grid);
	lay_vertices(&grid, body);
	lay_quads(&grid, body);
	free(grid.distance);
	free(grid.vertex);
	for (int round = 0; round < EVEN_ROUNDS; round++)
		even_out(body);
}
