/* From a sampled outline to even triangles: a hexagonal lattice where there is room, then Delaunay
 * refinement (Chew 1993), then optimal-Delaunay smoothing (Chen and Xu 2004). The outline's own
 * samples are never moved or added to: both sides of a seam rely on them. */
#include "garment_private.h"

enum {
	FILL_COLUMNS_MAX = 4096, /* 20 m at 6 mm */
	FILL_REFINE_PASSES = 6,
	FILL_SMOOTH_PASSES = 8,
	FILL_MEND_PASSES = 4,
};

#define LATTICE_MARGIN 0.65f /* of the spacing: no lattice point closer to the outline */
#define REFINE_QUALITY 0.2f  /* squared sine of 26.6 degrees */
#define REFINE_RADIUS 0.95f  /* of the spacing; an even triangle has 0.58 */

void fill_init(struct fill *fill, struct arena *arena)
{
	fill->parity = ARENA_ARRAY(arena, int, FILL_COLUMNS_MAX + 2);
	fill->shut = ARENA_ARRAY(arena, int, FILL_COLUMNS_MAX + 2);
	fill->awake = ARENA_ARRAY(arena, uint8_t, MESH_POINTS_MAX);
}

static void enter(struct fill *fill, enum fill_stage stage)
{
	fill->stage = stage;
	fill->cursor = 0;
	fill->pass = 0;
	fill->changed = 0;
}

void fill_start(struct fill *fill, struct mesh *mesh, const struct grid_point *boundary, int count,
		float edge_mm, int point_limit)
{
	MUST(count >= 3 && count + MESH_FRAME_POINTS <= point_limit);
	MUST(point_limit <= MESH_POINTS_MAX);
	fill->boundary = boundary;
	fill->boundary_count = count;
	fill->spacing = grid_snap(edge_mm);
	fill->point_limit = point_limit;
	fill->low = fill->high = boundary[0];
	for (int i = 1; i < count; i++) {
		fill->low.x = int_min(fill->low.x, boundary[i].x);
		fill->low.y = int_min(fill->low.y, boundary[i].y);
		fill->high.x = int_max(fill->high.x, boundary[i].x);
		fill->high.y = int_max(fill->high.y, boundary[i].y);
	}
	mesh_reset(mesh, fill->low, fill->high);
	enter(fill, FILL_POINTS);
	fill->stride = 1;
	while (2 * fill->stride < count)
		fill->stride *= 2;
	/* Indices are in outline order; the points themselves come coarse to fine. */
	for (int i = 0; i < count; i++) {
		mesh->point[MESH_FRAME_POINTS + i] = boundary[i];
		mesh->leaving[MESH_FRAME_POINTS + i] = -1;
	}
	mesh->point_count = MESH_FRAME_POINTS + count;
}

/* One outline point: first every stride-th, then those half-way between, so that each walk is
 * short and the triangulation stays balanced. */
static void add_boundary_point(struct fill *fill, struct mesh *mesh, long *units)
{
	int i = fill->cursor;
	int before = i - fill->stride; /* is in already */
	int start = before >= 0 ? mesh->leaving[MESH_FRAME_POINTS + before] : mesh->last;
	mesh_join(mesh, MESH_FRAME_POINTS + i, start, units);
	fill->cursor += fill->pass == 0 ? fill->stride : 2 * fill->stride;
	if (fill->cursor < fill->boundary_count)
		return;
	fill->stride /= 2;
	fill->pass++;
	fill->cursor = fill->stride;
	if (fill->stride == 0)
		enter(fill, FILL_FIX);
}

static void fix_boundary_edge(struct fill *fill, struct mesh *mesh, long *units)
{
	int i = fill->cursor++, next = fill->cursor < fill->boundary_count ? fill->cursor : 0;
	mesh_fix(mesh, MESH_FRAME_POINTS + i, MESH_FRAME_POINTS + next, units);
	if (fill->cursor < fill->boundary_count)
		return;
	mesh_carve(mesh, units);
	enter(fill, FILL_LATTICE);
}

/* The columns of a lattice row lie at x = left + column * spacing. */
struct row {
	int32_t y, left;
	int columns;
};

/* The first column right of x, in 0 .. columns. */
static int column_after(const struct fill *fill, const struct row *row, float x)
{
	float column = (x - (float)row->left) / (float)fill->spacing;
	if (column < 0.0f)
		return 0;
	return column < (float)row->columns ? (int)column + 1 : row->columns;
}

/* Widens [low, high] by where the row crosses the segment a b. */
static void widen(float interval[2], struct v2 a, struct v2 b)
{
	if ((a.y > 0.0f) == (b.y > 0.0f))
		return;
	float x = a.x - a.y * (b.x - a.x) / (b.y - a.y);
	interval[0] = float_min(interval[0], x);
	interval[1] = float_max(interval[1], x);
}

static void widen_by_disc(float interval[2], struct v2 centre, float radius)
{
	float squared = radius * radius - centre.y * centre.y;
	if (squared <= 0.0f)
		return;
	interval[0] = float_min(interval[0], centre.x - sqrtf(squared));
	interval[1] = float_max(interval[1], centre.x + sqrtf(squared));
}

/* What one outline segment does to a row: toggles the inside where it crosses, and shuts the
 * columns nearer than the margin (a capsule's section). */
static void mark_row(struct fill *fill, const struct row *row, struct grid_point p,
		     struct grid_point q)
{
	float margin = LATTICE_MARGIN * (float)fill->spacing;
	struct v2 a = {(float)p.x, (float)(p.y - row->y)}, b = {(float)q.x, (float)(q.y - row->y)};
	if ((a.y > margin && b.y > margin) || (a.y < -margin && b.y < -margin))
		return;
	float interval[2] = {1e30f, -1e30f};
	widen(interval, a, b);
	if (interval[0] <= interval[1])
		fill->parity[column_after(fill, row, interval[0])]++;
	struct v2 along = v2_scale(v2_normalize(v2_sub(b, a)), margin);
	struct v2 across = {-along.y, along.x};
	struct v2 corner[4] = {v2_add(a, across), v2_add(b, across), v2_sub(b, across),
			       v2_sub(a, across)};
	for (int k = 0; k < 4; k++)
		widen(interval, corner[k], corner[(k + 1) % 4]);
	widen_by_disc(interval, a, margin);
	widen_by_disc(interval, b, margin);
	if (interval[0] > interval[1])
		return;
	fill->shut[column_after(fill, row, interval[0])]++;
	fill->shut[column_after(fill, row, interval[1])]--;
}

static void add_lattice_row(struct fill *fill, struct mesh *mesh, long *units)
{
	/* Mirrored about the middle of the piece, so that both halves of a shirt drape alike. */
	int64_t rise = (int64_t)fill->spacing * 887 / 1024; /* half the root of 3 */
	int64_t y = fill->low.y + rise * (fill->cursor + 1);
	if (y > fill->high.y) {
		enter(fill, FILL_REFINE);
		return;
	}
	int32_t width = fill->high.x - fill->low.x, odd = fill->cursor & 1;
	int32_t half_columns = int_min(width / 2 / fill->spacing + 1, FILL_COLUMNS_MAX / 2 - 1);
	struct row row = {.y = (int32_t)y, .columns = 2 * half_columns + 1 + odd};
	row.left = fill->low.x + width / 2 - half_columns * fill->spacing - odd * fill->spacing / 2;
	fill->cursor++;
	memset(fill->parity, 0, (size_t)(row.columns + 1) * sizeof *fill->parity);
	memset(fill->shut, 0, (size_t)(row.columns + 1) * sizeof *fill->shut);
	for (int i = 0; i < fill->boundary_count; i++)
		mark_row(fill, &row, fill->boundary[i],
			 fill->boundary[i + 1 < fill->boundary_count ? i + 1 : 0]);
	*units += fill->boundary_count / 8 + row.columns / 8 + 1;
	int crossings = 0, shut = 0;
	for (int c = 0; c < row.columns; c++) {
		crossings += fill->parity[c];
		shut += fill->shut[c];
		if (!(crossings & 1) || shut > 0 || mesh->point_count >= fill->point_limit)
			continue;
		*units += 1;
		mesh_add(mesh, (struct grid_point){row.left + c * fill->spacing, row.y}, mesh->last,
			 units);
	}
}

/* The circumcentre, or false when it is nowhere near. */
static bool circumcentre(const struct mesh *mesh, int half, struct grid_point *centre,
			 float *radius)
{
	struct grid_point a = mesh->point[mesh->origin[half]];
	struct grid_point b = mesh->point[mesh->origin[half + 1]];
	struct grid_point c = mesh->point[mesh->origin[half + 2]];
	float bx = (float)(b.x - a.x), by = (float)(b.y - a.y);
	float cx = (float)(c.x - a.x), cy = (float)(c.y - a.y);
	float twice = 2.0f * (float)grid_orient(a, b, c);
	if (twice <= 0.0f)
		return false;
	float bb = bx * bx + by * by, cc = cx * cx + cy * cy;
	float x = (cy * bb - by * cc) / twice, y = (bx * cc - cx * bb) / twice;
	*radius = sqrtf(x * x + y * y);
	if (!(*radius < 1.0e7f))
		return false;
	*centre = (struct grid_point){a.x + (int32_t)x, a.y + (int32_t)y};
	return true;
}

/* Would p see a fixed edge of this triangle or of those around it under an obtuse angle? Then it
 * stands too close to the outline. */
static bool encroaches(const struct mesh *mesh, struct grid_point p, int half)
{
	for (int k = half; k < half + 3; k++) {
		int twin = mesh->twin[k];
		int around[3] = {k, twin >= 0 ? mesh_next(twin) : k,
				 twin >= 0 ? mesh_previous(twin) : k};
		for (int e = 0; e < 3; e++) {
			int edge = around[e];
			if (mesh->fixed[edge] &&
			    grid_dot(p, mesh->point[mesh->origin[edge]],
				     mesh->point[mesh->origin[mesh_next(edge)]]) < 0)
				return true;
		}
	}
	return false;
}

bool fill_holds(const struct fill *fill, struct grid_point p)
{
	return p.x >= fill->low.x && p.x <= fill->high.x && p.y >= fill->low.y &&
	       p.y <= fill->high.y;
}

static bool refine_triangle(struct fill *fill, struct mesh *mesh, int half, long *units)
{
	*units += 1;
	struct grid_point centre;
	float radius;
	if (!mesh->inside[half / 3] || !circumcentre(mesh, half, &centre, &radius))
		return false;
	float quality = triangle_quality(mesh->point[mesh->origin[half]],
					 mesh->point[mesh->origin[half + 1]],
					 mesh->point[mesh->origin[half + 2]]);
	if (quality >= REFINE_QUALITY && radius < REFINE_RADIUS * (float)fill->spacing)
		return false;
	if (triangle_forced(mesh, half) || mesh->point_count >= fill->point_limit)
		return false;
	if (!fill_holds(fill, centre))
		return false;
	int at = mesh_locate(mesh, centre, half, units);
	if (!mesh->inside[at / 3] || encroaches(mesh, centre, at))
		return false;
	return mesh_add(mesh, centre, at, units);
}

static void end_pass(struct fill *fill, int passes, enum fill_stage next)
{
	bool again = fill->changed > 0 && fill->pass + 1 < passes;
	fill->cursor = 0;
	fill->changed = 0;
	fill->pass++;
	if (!again)
		enter(fill, next);
}

static void refine_step(struct fill *fill, struct mesh *mesh, long *units)
{
	if (fill->cursor < mesh->half_count) {
		fill->changed += refine_triangle(fill, mesh, fill->cursor, units);
		fill->cursor += 3;
		return;
	}
	end_pass(fill, FILL_REFINE_PASSES, FILL_SMOOTH);
	if (fill->stage == FILL_SMOOTH)
		memset(fill->awake, 1, (size_t)mesh->point_count);
}

static void smooth_step(struct fill *fill, struct mesh *mesh, long *units)
{
	int v = MESH_FRAME_POINTS + fill->boundary_count + fill->cursor;
	if (v < mesh->point_count) {
		fill->cursor++;
		if (fill->awake[v])
			fill->changed += smooth_point(fill, mesh, v, units);
		return;
	}
	*units += 1;
	end_pass(fill, FILL_SMOOTH_PASSES, FILL_MEND);
}

static void mend_step(struct fill *fill, struct mesh *mesh, long *units)
{
	*units += 1;
	if (fill->cursor < mesh->half_count) {
		fill->changed += mend_triangle(fill, mesh, fill->cursor, units);
		fill->cursor += 3;
		return;
	}
	end_pass(fill, FILL_MEND_PASSES, FILL_DONE);
}

long fill_advance(struct fill *fill, struct mesh *mesh, long quota)
{
	long units = 0;
	while (units < quota && fill->stage != FILL_DONE) {
		switch (fill->stage) {
		case FILL_POINTS:
			add_boundary_point(fill, mesh, &units);
			break;
		case FILL_FIX:
			fix_boundary_edge(fill, mesh, &units);
			break;
		case FILL_LATTICE:
			add_lattice_row(fill, mesh, &units);
			break;
		case FILL_REFINE:
			refine_step(fill, mesh, &units);
			break;
		case FILL_SMOOTH:
			smooth_step(fill, mesh, &units);
			break;
		case FILL_MEND:
			mend_step(fill, mesh, &units);
			break;
		case FILL_DONE:
			break;
		}
	}
	return units;
}
