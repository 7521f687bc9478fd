/* Moving the free points of a mesh to better places. */
#include "garment_private.h"

enum { STAR_MAX = 64, CAVITY_MAX = 32 };

#define STILL 0.02f        /* of the spacing: a shorter move wakes nobody */
#define MEND_QUALITY 0.25f /* squared sine of 30 degrees */

float triangle_quality(struct grid_point a, struct grid_point b, struct grid_point c)
{
	int64_t area = grid_orient(a, b, c);
	if (area <= 0)
		return 0.0f;
	float ab = (float)grid_distance_squared(a, b);
	float bc = (float)grid_distance_squared(b, c);
	float ca = (float)grid_distance_squared(c, a);
	/* The area is half the product of the two longer sides and that sine. */
	float shortest = float_min(ab, float_min(bc, ca));
	float others = shortest == ab ? bc * ca : shortest == bc ? ab * ca : ab * bc;
	return (float)area * (float)area / others;
}

bool triangle_forced(const struct mesh *mesh, int half)
{
	int shortest = half;
	int64_t least = INT64_MAX;
	for (int k = half; k < half + 3; k++) {
		int64_t squared = grid_distance_squared(mesh->point[mesh->origin[k]],
							mesh->point[mesh->origin[mesh_next(k)]]);
		if (squared < least) {
			least = squared;
			shortest = k;
		}
	}
	return mesh->fixed[mesh_next(shortest)] && mesh->fixed[mesh_previous(shortest)];
}

/* The ring of points around v, counter-clockwise; 0 when it is larger than any sound mesh has. */
static int star_of(const struct mesh *mesh, int v, int ring[STAR_MAX])
{
	int count = 0, half = mesh->leaving[v];
	do {
		if (count == STAR_MAX)
			return 0;
		ring[count++] = mesh->origin[mesh_next(half)];
		half = mesh->twin[mesh_previous(half)];
	} while (half != mesh->leaving[v]);
	return count;
}

static bool star_upright(const struct mesh *mesh, const int *ring, int count, struct grid_point p)
{
	for (int i = 0; i < count; i++)
		if (grid_orient(p, mesh->point[ring[i]],
				mesh->point[ring[i + 1 < count ? i + 1 : 0]]) <= 0)
			return false;
	return true;
}

static void flip_around(struct mesh *mesh, int v, long *units)
{
	int half = mesh->leaving[v];
	do {
		mesh_push(mesh, half);
		mesh_push(mesh, mesh_next(half));
		half = mesh->twin[mesh_previous(half)];
	} while (half != mesh->leaving[v]);
	mesh_legalize(mesh, units);
}

/* The mean of the circumcentres of the star, weighted by area: where the piecewise linear
 * interpolation error is least (Chen and Xu 2004, eq. 4.6). Relative to the point itself. */
static struct v2 middle_of_star(const struct mesh *mesh, int v, const int *ring, int count)
{
	struct grid_point p = mesh->point[v];
	struct v2 sum = {0};
	float areas = 0.0f;
	for (int i = 0; i < count; i++) {
		struct grid_point b = mesh->point[ring[i]];
		struct grid_point c = mesh->point[ring[i + 1 < count ? i + 1 : 0]];
		float bx = (float)(b.x - p.x), by = (float)(b.y - p.y);
		float cx = (float)(c.x - p.x), cy = (float)(c.y - p.y);
		float area = bx * cy - by * cx;
		float bb = bx * bx + by * by, cc = cx * cx + cy * cy;
		/* area times the circumcentre: the division cancels */
		sum.x += 0.5f * (cy * bb - by * cc);
		sum.y += 0.5f * (bx * cc - cx * bb);
		areas += area;
	}
	return areas > 0.0f ? v2_scale(sum, 1.0f / areas) : (struct v2){0};
}

bool smooth_point(struct fill *fill, struct mesh *mesh, int v, long *units)
{
	int ring[STAR_MAX];
	int count = star_of(mesh, v, ring);
	fill->awake[v] = 0;
	*units += 1;
	if (count == 0)
		return false;
	struct v2 move = middle_of_star(mesh, v, ring, count);
	float length = v2_length(move), spacing = (float)fill->spacing;
	if (!(length > STILL * spacing))
		return false;
	if (length > spacing)
		move = v2_scale(move, spacing / length);
	struct grid_point from = mesh->point[v];
	for (int tries = 0; tries < 3; tries++, move = v2_scale(move, 0.5f)) {
		struct grid_point to = {from.x + (int32_t)move.x, from.y + (int32_t)move.y};
		if (!star_upright(mesh, ring, count, to))
			continue;
		mesh->point[v] = to;
		flip_around(mesh, v, units);
		fill->awake[v] = 1;
		for (int i = 0; i < count; i++)
			fill->awake[ring[i]] = 1;
		return true;
	}
	return false;
}

static float worst_of_star(const struct mesh *mesh, const int *ring, int count, struct grid_point p)
{
	float worst = 1.0f;
	for (int i = 0; i < count; i++)
		worst = float_min(worst,
				  triangle_quality(p, mesh->point[ring[i]],
						   mesh->point[ring[i + 1 < count ? i + 1 : 0]]));
	return worst;
}

/* Moves a point uphill in its star's worst angle: eight directions, ever shorter steps. */
static bool climb(struct fill *fill, struct mesh *mesh, int v, long *units)
{
	static const int8_t way[8][2] = {{1, 0}, {0, 1},  {-1, 0},  {0, -1},
					 {1, 1}, {-1, 1}, {-1, -1}, {1, -1}};
	int ring[STAR_MAX];
	int count = star_of(mesh, v, ring);
	if (count == 0)
		return false;
	struct grid_point at = mesh->point[v];
	float best = worst_of_star(mesh, ring, count, at);
	bool moved = false;
	for (int32_t step = fill->spacing / 4; step > fill->spacing / 64; step /= 2) {
		for (int k = 0; k < 8; k++) {
			struct grid_point to = {at.x + way[k][0] * step, at.y + way[k][1] * step};
			float quality = worst_of_star(mesh, ring, count, to);
			*units += 1;
			if (quality <= best)
				continue;
			best = quality;
			at = to;
			moved = true;
			k = -1; /* again from here; quality rises each time, steps are finite */
		}
	}
	if (!moved)
		return false;
	mesh->point[v] = at;
	flip_around(mesh, v, units);
	return true;
}

/* Which triangles a point would replace (Bowyer 1981, Watson 1981): those whose circles hold it, as
 * far as the outline lets it see. */
struct cavity {
	int count;
	int half[CAVITY_MAX]; /* a half-edge of each */
};

static bool cavity_has(const struct cavity *cavity, int half)
{
	for (int i = 0; i < cavity->count; i++)
		if (cavity->half[i] / 3 == half / 3)
			return true;
	return false;
}

static bool cavity_grow(struct cavity *cavity, const struct mesh *mesh, struct grid_point p)
{
	for (int i = 0; i < cavity->count; i++) {
		int first = cavity->half[i] - cavity->half[i] % 3;
		for (int k = first; k < first + 3; k++) {
			int twin = mesh->twin[k];
			if (mesh->fixed[k] || twin < 0 || cavity_has(cavity, twin) ||
			    !grid_in_circle(mesh->point[mesh->origin[twin]],
					    mesh->point[mesh->origin[mesh_next(twin)]],
					    mesh->point[mesh->origin[mesh_previous(twin)]], p))
				continue;
			if (cavity->count == CAVITY_MAX)
				return false;
			cavity->half[cavity->count++] = twin;
		}
	}
	return true;
}

/* The worst triangle that adding p near `half` would make; 0 when it can't be added. */
static float worst_if_added(const struct mesh *mesh, struct grid_point p, int half, long *units)
{
	int at = mesh_locate(mesh, p, half, units);
	struct cavity cavity = {.count = 1, .half = {at}};
	if (!mesh->inside[at / 3] || !cavity_grow(&cavity, mesh, p) || !cavity_has(&cavity, half))
		return 0.0f;
	float worst = 1.0f;
	for (int i = 0; i < cavity.count; i++) {
		int first = cavity.half[i] - cavity.half[i] % 3;
		for (int k = first; k < first + 3; k++) {
			if (!mesh->fixed[k] && cavity_has(&cavity, mesh->twin[k]))
				continue;
			worst = float_min(
				worst, triangle_quality(p, mesh->point[mesh->origin[k]],
							mesh->point[mesh->origin[mesh_next(k)]]));
		}
	}
	*units += cavity.count;
	return worst;
}

/* Some triangles between outline points no moving of points can cure: a new point near them can.
 * Tries places on the lines from each corner through the middle of the opposite side. */
static bool add_cure(struct fill *fill, struct mesh *mesh, int half, float quality, long *units)
{
	struct grid_point best = {0};
	float best_quality = quality;
	for (int side = half; side < half + 3; side++) {
		struct grid_point a = mesh->point[mesh->origin[side]];
		struct grid_point b = mesh->point[mesh->origin[mesh_next(side)]];
		struct grid_point c = mesh->point[mesh->origin[mesh_previous(side)]];
		int32_t x = a.x + (b.x - a.x) / 2, y = a.y + (b.y - a.y) / 2;
		for (int k = -2; k <= 8; k++) {
			struct grid_point p = {x + (x - c.x) / 8 * k, y + (y - c.y) / 8 * k};
			if (!fill_holds(fill, p))
				continue;
			float worst = worst_if_added(mesh, p, half, units);
			if (worst > best_quality) {
				best_quality = worst;
				best = p;
			}
		}
	}
	if (best_quality <= quality || mesh->point_count >= fill->point_limit ||
	    !mesh_add(mesh, best, half, units))
		return false;
	climb(fill, mesh, mesh->point_count - 1, units);
	return true;
}

bool mend_triangle(struct fill *fill, struct mesh *mesh, int half, long *units)
{
	if (!mesh->inside[half / 3])
		return false;
	int corner[3] = {mesh->origin[half], mesh->origin[half + 1], mesh->origin[half + 2]};
	float quality = triangle_quality(mesh->point[corner[0]], mesh->point[corner[1]],
					 mesh->point[corner[2]]);
	if (quality >= MEND_QUALITY)
		return false;
	bool changed = false;
	for (int k = 0; k < 3; k++)
		if (corner[k] >= MESH_FRAME_POINTS + fill->boundary_count)
			changed |= climb(fill, mesh, corner[k], units);
	if (changed || triangle_forced(mesh, half))
		return changed;
	return add_cure(fill, mesh, half, quality, units);
}
