/* Front, side and back of a drape by a depth buffer, without perspective: nothing is smoothed away.
 */
#include "drape.h"

#include "picture.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum {
	VIEWS = 3,
	WIDTH = 440,
	HEIGHT = 760,
	FINE = 2,
	W = VIEWS * WIDTH * FINE,
	H = HEIGHT * FINE
};

struct canvas {
	float *depth;
	uint8_t (*colour)[3];
	double scale, middle_x, middle_y, middle_z; /* pixels a metre */
};

/* Turned so that +z looks at us. */
static struct point turned(const struct canvas *c, struct point p, int view)
{
	double x = p.x - c->middle_x, z = p.z - c->middle_z;
	struct point q = {view == 0   ? x
			  : view == 1 ? -z
				      : -x,
			  p.y - c->middle_y,
			  view == 0   ? z
			  : view == 1 ? x
				      : -z};
	q.x = q.x * c->scale + (view + 0.5) * WIDTH * FINE;
	q.y = 0.5 * H - q.y * c->scale;
	q.z *= c->scale;
	return q;
}

static void fill(struct canvas *c, int view, const struct point p[3], const double colour[3])
{
	double area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x);
	int left = (int)fmax(fmin(fmin(p[0].x, p[1].x), p[2].x), view * WIDTH * FINE);
	int right = (int)fmin(fmax(fmax(p[0].x, p[1].x), p[2].x), (view + 1) * WIDTH * FINE - 1);
	int top = (int)fmax(fmin(fmin(p[0].y, p[1].y), p[2].y), 0);
	int bottom = (int)fmin(fmax(fmax(p[0].y, p[1].y), p[2].y), H - 1);
	if (fabs(area) < 1e-9)
		return;
	for (int y = top; y <= bottom; y++)
		for (int x = left; x <= right; x++) {
			double px = x + 0.5, py = y + 0.5, w[3];
			for (int k = 0; k < 3; k++) {
				struct point a = p[(k + 1) % 3], b = p[(k + 2) % 3];
				w[k] = ((b.x - a.x) * (py - a.y) - (b.y - a.y) * (px - a.x)) / area;
			}
			if (w[0] < 0 || w[1] < 0 || w[2] < 0)
				continue;
			double z = w[0] * p[0].z + w[1] * p[1].z + w[2] * p[2].z;
			size_t at = (size_t)y * W + (size_t)x;
			if (z <= (double)c->depth[at])
				continue;
			c->depth[at] = (float)z;
			for (int k = 0; k < 3; k++)
				c->colour[at][k] = (uint8_t)colour[k];
		}
}

static void draw(struct canvas *c, const struct drape_mesh *mesh, bool cloth)
{
	static const double piece[6][3] = {{110, 170, 190}, {150, 185, 120}, {200, 175, 110},
					   {165, 150, 205}, {120, 190, 165}, {205, 150, 165}};
	static const double skin[3] = {225, 205, 190}, inside[3] = {215, 50, 40};
	for (int t = 0; t < mesh->triangle_count; t++)
		for (int view = 0; view < VIEWS; view++) {
			struct point p[3];
			for (int k = 0; k < 3; k++)
				p[k] = turned(c, mesh->vertex[mesh->corner[t][k]], view);
			struct point n = point_cross(point_sub(p[1], p[0]), point_sub(p[2], p[0]));
			double length = sqrt(point_dot(n, n)) + 1e-12;
			bool away = n.z > 0; /* y points down here */
			const double *base = !cloth ? skin
					     : away ? inside
						    : piece[mesh->group[t] % 6];
			double slope = fabs(n.z) / length, aside = fabs(n.x - n.y) / length;
			double light = 0.45 + 0.5 * slope + 0.05 * aside, colour[3];
			for (int k = 0; k < 3; k++)
				colour[k] = fmin(base[k] * light, 255);
			fill(c, view, p, colour);
		}
}

static bool write_down(const char *path, const struct canvas *c)
{
	char fault[200];
	uint8_t *rgba = malloc((size_t)W * H / FINE / FINE * 4);
	for (int y = 0; y < H / FINE; y++)
		for (int x = 0; x < W / FINE; x++)
			for (int k = 0; k < 4; k++) {
				int sum = 0;
				for (int i = 0; i < FINE * FINE && k < 3; i++)
					sum += c->colour[(size_t)(y * FINE + i / FINE) * W +
							 (size_t)(x * FINE + i % FINE)][k];
				rgba[4 * ((size_t)y * (W / FINE) + (size_t)x) + (size_t)k] =
					(uint8_t)(k == 3 ? 255 : sum / (FINE * FINE));
			}
	bool written = picture_write_png(path, W / FINE, H / FINE, rgba, fault);
	if (!written)
		fprintf(stderr, "drape: %s\n", fault);
	free(rgba);
	return written;
}

static void widen(struct point *low, struct point *high, const struct drape_mesh *mesh)
{
	for (int v = 0; v < mesh->vertex_count; v++) {
		struct point p = mesh->vertex[v];
		*low = (struct point){fmin(low->x, p.x), fmin(low->y, p.y), fmin(low->z, p.z)};
		*high = (struct point){fmax(high->x, p.x), fmax(high->y, p.y), fmax(high->z, p.z)};
	}
}

bool drape_picture(const char *path, const struct drape_mesh *garment,
		   const struct drape_mesh *body)
{
	struct canvas c;
	struct point low = {1e9, 1e9, 1e9}, high = {-1e9, -1e9, -1e9};
	widen(&low, &high, body);
	widen(&low, &high, garment);
	c.middle_x = 0.5 * (low.x + high.x);
	c.middle_y = 0.5 * (low.y + high.y);
	c.middle_z = 0.5 * (low.z + high.z);
	c.scale = fmin(0.95 * H / (high.y - low.y), 0.98 * WIDTH * FINE / (high.x - low.x));
	c.depth = malloc(sizeof *c.depth * W * H);
	c.colour = malloc(sizeof *c.colour * W * H);
	for (size_t i = 0; i < (size_t)W * H; i++) {
		c.depth[i] = -1e9f;
		for (int k = 0; k < 3; k++)
			c.colour[i][k] = 245;
	}
	draw(&c, body, false);
	draw(&c, garment, true);
	bool written = write_down(path, &c);
	free(c.depth);
	free(c.colour);
	return written;
}
