/* The figures, by the plainest means: parity of rays for inside, distance to every triangle for
 * depth, the deformation gradient of each triangle for strain. */
#include "drape.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { COLUMNS = 128, AXES = 3 };

/* The body's triangles under the columns of a square grid across one axis, so that a ray along the
 * axis meets few. */
struct columns {
	int axis;
	double low[2], step[2];
	int *first, *triangle;
};

static double coordinate(struct point p, int axis)
{
	return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

static struct columns columns_of[AXES];

static int column(const struct columns *c, struct point p, int side)
{
	double at = (coordinate(p, (c->axis + 1 + side) % 3) - c->low[side]) / c->step[side];
	return at < 0 ? 0 : at >= COLUMNS ? COLUMNS - 1 : (int)at;
}

/* The columns that a triangle or segment of `count` points may touch. */
static void range(const struct columns *c, const struct point *p, int count, int from[2], int to[2])
{
	for (int side = 0; side < 2; side++) {
		from[side] = COLUMNS;
		to[side] = -1;
		for (int i = 0; i < count; i++) {
			int at = column(c, p[i], side);
			from[side] = at < from[side] ? at : from[side];
			to[side] = at > to[side] ? at : to[side];
		}
	}
}

static void corners(const struct drape_mesh *mesh, int t, struct point p[3])
{
	for (int k = 0; k < 3; k++)
		p[k] = mesh->vertex[mesh->corner[t][k]];
}

static void sort_into_columns(struct columns *c, const struct drape_mesh *body, int axis)
{
	c->axis = axis;
	c->first = calloc(COLUMNS * COLUMNS + 2, sizeof *c->first);
	for (int side = 0; side < 2; side++) {
		double low = 1e9, high = -1e9;
		for (int v = 0; v < body->vertex_count; v++) {
			double x = coordinate(body->vertex[v], (axis + 1 + side) % 3);
			low = fmin(low, x);
			high = fmax(high, x);
		}
		c->low[side] = low - 1e-3;
		c->step[side] = (high - low + 2e-3) / COLUMNS;
	}
	for (int pass = 0; pass < 2; pass++) {
		for (int t = 0; t < body->triangle_count; t++) {
			struct point p[3];
			int from[2], to[2];
			corners(body, t, p);
			range(c, p, 3, from, to);
			for (int i = from[0]; i <= to[0]; i++)
				for (int j = from[1]; j <= to[1]; j++) {
					int cell = i * COLUMNS + j;
					if (pass == 0)
						c->first[cell + 2]++;
					else
						c->triangle[c->first[cell + 1]++] = t;
				}
		}
		if (pass == 1)
			break;
		for (int i = 0; i < COLUMNS * COLUMNS; i++)
			c->first[i + 2] += c->first[i + 1];
		c->triangle = malloc(sizeof *c->triangle *
				     (size_t)(c->first[COLUMNS * COLUMNS + 1] + 1));
	}
}

/* Does the segment a b pass through the triangle? Signs of tetrahedra's volumes. */
static bool passes(struct point a, struct point b, const struct point p[3])
{
	struct point d = point_sub(b, a), e[3];
	for (int k = 0; k < 3; k++)
		e[k] = point_sub(p[k], a);
	struct point n = point_cross(point_sub(p[1], p[0]), point_sub(p[2], p[0]));
	double from = point_dot(n, point_sub(a, p[0])), to = point_dot(n, point_sub(b, p[0]));
	if ((from > 0) == (to > 0))
		return false;
	double s0 = point_dot(d, point_cross(e[0], e[1]));
	double s1 = point_dot(d, point_cross(e[1], e[2]));
	double s2 = point_dot(d, point_cross(e[2], e[0]));
	return (s0 > 0 && s1 > 0 && s2 > 0) || (s0 < 0 && s1 < 0 && s2 < 0);
}

/* Inside for two of three axes. */
static bool is_inside(const struct drape_mesh *body, struct point p)
{
	int votes = 0;
	for (int axis = 0; axis < AXES; axis++) {
		const struct columns *c = &columns_of[axis];
		struct point far = p, corner[3];
		*(axis == 0 ? &far.x : axis == 1 ? &far.y : &far.z) += 10.0;
		int cell = column(c, p, 0) * COLUMNS + column(c, p, 1), crossings = 0;
		for (int i = c->first[cell]; i < c->first[cell + 1]; i++) {
			corners(body, c->triangle[i], corner);
			crossings += passes(p, far, corner);
		}
		votes += crossings & 1;
	}
	return votes >= 2;
}

/* Squared distance to a triangle: to its inside, else to its sides. */
static double distance2(struct point p, const struct point t[3])
{
	struct point n = point_cross(point_sub(t[1], t[0]), point_sub(t[2], t[0]));
	double area2 = point_dot(n, n), best = 1e9;
	bool over = area2 > 0;
	for (int k = 0; k < 3; k++) {
		struct point a = t[k], d = point_sub(t[(k + 1) % 3], a), w = point_sub(p, a);
		double s = point_dot(w, d) / fmax(point_dot(d, d), 1e-30);
		struct point gap = point_sub(
			w, point_mix((struct point){0, 0, 0}, d, fmin(fmax(s, 0), 1)));
		best = fmin(best, point_dot(gap, gap));
		over = over && point_dot(point_cross(d, w), n) >= 0;
	}
	double height = point_dot(n, point_sub(p, t[0]));
	return over ? height * height / area2 : best;
}

static void look(struct drape_figures *figures, const struct drape_mesh *body, struct point p,
		 int *inside)
{
	if (!is_inside(body, p))
		return;
	double best = 1e9;
	for (int t = 0; t < body->triangle_count; t++) {
		struct point corner[3];
		corners(body, t, corner);
		best = fmin(best, distance2(p, corner));
	}
	*inside += best > DRAPE_DEEP_M * DRAPE_DEEP_M;
	figures->penetration_mm_max = fmax(figures->penetration_mm_max, 1e3 * sqrt(best));
}

static bool crosses_body(const struct drape_mesh *body, const struct point end[2])
{
	const struct columns *c = &columns_of[2];
	int from[2], to[2];
	range(c, end, 2, from, to);
	for (int i = from[0]; i <= to[0]; i++)
		for (int j = from[1]; j <= to[1]; j++)
			for (int k = c->first[i * COLUMNS + j]; k < c->first[i * COLUMNS + j + 1];
			     k++) {
				struct point corner[3];
				corners(body, c->triangle[k], corner);
				if (passes(end[0], end[1], corner))
					return true;
			}
	return false;
}

/* ---- vertices that lie at one place are one ---- */

static const struct drape_mesh *sorting;

static int by_place(const void *a, const void *b)
{
	return memcmp(&sorting->vertex[*(const int *)a], &sorting->vertex[*(const int *)b],
		      sizeof(struct point));
}

static int *weld(const struct drape_mesh *mesh)
{
	int *order = malloc(sizeof *order * (size_t)mesh->vertex_count);
	int *one = malloc(sizeof *one * (size_t)mesh->vertex_count);
	for (int v = 0; v < mesh->vertex_count; v++)
		order[v] = v;
	sorting = mesh;
	qsort(order, (size_t)mesh->vertex_count, sizeof *order, by_place);
	for (int i = 0; i < mesh->vertex_count; i++)
		one[order[i]] = i > 0 && by_place(&order[i - 1], &order[i]) == 0 ? one[order[i - 1]]
										 : order[i];
	free(order);
	return one;
}

static int root_of(int *root, int v)
{
	while (root[v] != v)
		v = root[v] = root[root[v]];
	return v;
}

static int count_components(const struct drape_mesh *mesh, const int *one)
{
	int *root = malloc(sizeof *root * (size_t)mesh->vertex_count), count = 0;
	for (int v = 0; v < mesh->vertex_count; v++)
		root[v] = v;
	for (int t = 0; t < mesh->triangle_count; t++)
		for (int k = 0; k < 2; k++)
			root[root_of(root, one[mesh->corner[t][k]])] = root_of(
				root, one[mesh->corner[t][k + 1]]);
	bool *seen = calloc((size_t)mesh->vertex_count, sizeof *seen);
	for (int t = 0; t < mesh->triangle_count; t++) {
		int v = root_of(root, one[mesh->corner[t][0]]);
		count += !seen[v];
		seen[v] = true;
	}
	free(seen);
	free(root);
	return count;
}

/* ---- edges, each once ---- */

static int by_ends(const void *a, const void *b)
{
	const int *p = a, *q = b;
	return p[0] != q[0] ? (p[0] > q[0]) - (p[0] < q[0]) : (p[1] > q[1]) - (p[1] < q[1]);
}

static void measure_edges(struct drape_figures *figures, const struct drape_mesh *garment,
			  const struct drape_mesh *body, const int *one)
{
	int count = 0, (*edge)[2] = malloc(sizeof *edge * 3 * (size_t)garment->triangle_count);
	for (int t = 0; t < garment->triangle_count; t++)
		for (int k = 0; k < 3; k++) {
			int a = one[garment->corner[t][k]],
			    b = one[garment->corner[t][(k + 1) % 3]];
			edge[count][0] = a < b ? a : b;
			edge[count++][1] = a < b ? b : a;
		}
	qsort(edge, (size_t)count, sizeof *edge, by_ends);
	for (int e = 0; e < count; e++) {
		struct point end[2] = {garment->vertex[edge[e][0]], garment->vertex[edge[e][1]]};
		if (edge[e][0] == edge[e][1] || (e > 0 && by_ends(edge[e - 1], edge[e]) == 0))
			continue;
		look(figures, body, point_mix(end[0], end[1], 0.5), &figures->midpoints_inside);
		figures->edge_crossings += crosses_body(body, end);
	}
	free(edge);
}

/* ---- strain ---- */

/* The larger singular value of the map from the flat triangle to the one in space, minus 1. */
static double strain(const struct drape_mesh *mesh, int t)
{
	const double *a = mesh->texture[mesh->flat[t][0]], *b = mesh->texture[mesh->flat[t][1]],
		     *c = mesh->texture[mesh->flat[t][2]];
	struct point p[3];
	corners(mesh, t, p);
	double ux = b[0] - a[0], uy = b[1] - a[1], vx = c[0] - a[0], vy = c[1] - a[1];
	double area = ux * vy - uy * vx;
	if (fabs(area) < 1e-12)
		return 0;
	struct point e = point_sub(p[1], p[0]), f = point_sub(p[2], p[0]);
	struct point x = {(e.x * vy - f.x * uy) / area, (e.y * vy - f.y * uy) / area,
			  (e.z * vy - f.z * uy) / area};
	struct point y = {(f.x * ux - e.x * vx) / area, (f.y * ux - e.y * vx) / area,
			  (f.z * ux - e.z * vx) / area};
	double xx = point_dot(x, x), yy = point_dot(y, y), xy = point_dot(x, y);
	return sqrt(0.5 * (xx + yy) + sqrt(0.25 * (xx - yy) * (xx - yy) + xy * xy)) - 1;
}

static int by_value(const void *a, const void *b)
{
	double s = *(const double *)a, t = *(const double *)b;
	return (s > t) - (s < t);
}

static void measure_strain(struct drape_figures *figures, const struct drape_mesh *garment)
{
	double *value = malloc(sizeof *value * (size_t)garment->triangle_count);
	int count = 0;
	for (int t = 0; t < garment->triangle_count; t++)
		if (garment->flat[t][0] >= 0 && garment->flat[t][1] >= 0 &&
		    garment->flat[t][2] >= 0)
			value[count++] = strain(garment, t);
	if (count > 0) {
		qsort(value, (size_t)count, sizeof *value, by_value);
		figures->strain_p95 = value[(95 * count + 99) / 100 - 1];
		figures->strain_max = value[count - 1];
	}
	free(value);
}

void drape_measure(struct drape_figures *figures, const struct drape_mesh *garment,
		   const struct drape_mesh *body)
{
	memset(figures, 0, sizeof *figures);
	for (int axis = 0; axis < AXES; axis++)
		sort_into_columns(&columns_of[axis], body, axis);
	int *one = weld(garment);
	for (int v = 0; v < garment->vertex_count; v++)
		if (one[v] == v)
			look(figures, body, garment->vertex[v], &figures->vertices_inside);
	for (int t = 0; t < garment->triangle_count; t++) {
		struct point p[3];
		corners(garment, t, p);
		look(figures, body, point_mix(p[0], point_mix(p[1], p[2], 0.5), 2.0 / 3.0),
		     &figures->centres_inside);
	}
	measure_edges(figures, garment, body, one);
	measure_strain(figures, garment);
	figures->components = count_components(garment, one);
	free(one);
}
