/* Which triangles of a cloth lie near one another: a hashed grid of their centres, filled by
 * counting sort, so that its order is that of the triangles. */
#include "cloth_self_private.h"
#include "forest.h"

static const float radius_edges =
	0.8f;                          /* larger triangles, in edge lengths, are seen only so far */
static const float sheet_edges = 2.5f; /* so near on one piece, and facing alike, is one sheet */

/* ---- how the cloth hangs together ---- */

/* Pairs the edges of all triangles; edges of three triangles (a seam of three pieces) pair the
 * first two. `first` and `edge` are scratch. */
static void pair_edges(struct cloth *cloth, int *first, int *edge)
{
	struct cloth_self *self = cloth->self;
	int vertices = cloth->garment->vertex_count, count = 3 * cloth->garment->triangle_count;
	memset(first, 0, (size_t)(vertices + 2) * sizeof *first);
	for (int pass = 0; pass < 2; pass++) {
		for (int e = 0; e < count; e++) {
			const int *v = cloth->triangle[e / 3].v;
			int low = int_min(v[e % 3], v[(e % 3 + 1) % 3]);
			if (pass == 0)
				first[low + 2]++;
			else
				edge[first[low + 1]++] = e;
		}
		for (int v = 0; pass == 0 && v < vertices; v++)
			first[v + 2] += first[v + 1];
	}
	for (int e = 0; e < count; e++)
		self->across[e] = -1;
	for (int e = 0; e < count; e++) {
		const int *v = cloth->triangle[e / 3].v;
		int a = v[e % 3], b = v[(e % 3 + 1) % 3], low = int_min(a, b);
		for (int i = first[low]; i < first[low + 1] && self->across[e] < 0; i++) {
			const int *w = cloth->triangle[edge[i] / 3].v;
			int c = w[edge[i] % 3], d = w[(edge[i] % 3 + 1) % 3];
			if (edge[i] != e && self->across[edge[i]] < 0 &&
			    int_max(c, d) == int_max(a, b)) {
				self->across[e] = edge[i];
				self->across[edge[i]] = e;
			}
		}
	}
}

/* Sizes of what hangs together over edges that `cut` (per triangle, a bit an edge; NULL: none) does
 * not bar, per particle. */
static void measure_patches(struct cloth *cloth, const uint8_t *cut, int *size)
{
	int *root = cloth->self->root, vertices = cloth->garment->vertex_count;
	forest_begin(root, vertices);
	for (int e = 0; e < 3 * cloth->garment->triangle_count; e++) {
		const int *v = cloth->triangle[e / 3].v;
		if (!cut || !(cut[e / 3] >> e % 3 & 1))
			forest_join(root, v[e % 3], v[(e % 3 + 1) % 3]);
	}
	memset(size, 0, (size_t)vertices * sizeof *size);
	for (int v = 0; v < vertices; v++)
		if (cloth->particle[v] == v)
			size[forest_root(root, v)]++;
	for (int v = 0; v < vertices; v++)
		size[v] = size[forest_root(root, v)];
}

void self_connect(struct cloth *cloth)
{
	struct cloth_self *self = cloth->self;
	pair_edges(cloth, self->size, self->pair);
	for (int v = 0; v < cloth->garment->vertex_count; v++)
		self->owner[v] = -1;
	for (int t = 0; t < cloth->garment->triangle_count; t++)
		for (int k = 0; k < 3; k++)
			if (self->owner[cloth->triangle[t].v[k]] < 0)
				self->owner[cloth->triangle[t].v[k]] = t;
	measure_patches(cloth, NULL, self->garment_size);
	for (int t = 0; t < cloth->garment->triangle_count; t++) {
		const int *v = cloth->garment->triangle[t].v;
		const struct v2 *rest = cloth->garment->rest_m;
		self->triangle[t].piece = cloth->garment->triangle_piece[t];
		self->triangle[t].rest_m = v2_scale(
			v2_add(v2_add(rest[v[0]], rest[v[1]]), rest[v[2]]), 1.0f / 3.0f);
	}
}

/* A patch that a closed curve of crossings cuts off and that is the smaller part of its garment has
 * come through: its sides are the wrong ones. */
void self_find_patches(struct cloth *cloth)
{
	struct cloth_self *self = cloth->self;
	int vertices = cloth->garment->vertex_count;
	memset(self->trapped, 0, (size_t)vertices);
	if (cloth_crossings(cloth) == 0)
		return;
	memset(self->cut, 0, (size_t)cloth->garment->triangle_count);
	for (int i = 0; i < self->crossing_count; i++) {
		const struct crossing *crossing = &self->crossing[i];
		int e = crossing->edge, f = self->across[e];
		if (!crossing->through)
			continue;
		self->cut[e / 3] |= (uint8_t)(1 << e % 3);
		if (f >= 0)
			self->cut[f / 3] |= (uint8_t)(1 << f % 3);
	}
	measure_patches(cloth, self->cut, self->size);
	for (int v = 0; v < vertices; v++)
		self->trapped[v] = 4 * self->size[v] < self->garment_size[v];
}

/* ---- the grid ---- */

/* A cell's place along x, and the bucket where its row along x begins: a row's cells lie in
 * neighbouring buckets. */
struct cell {
	int x, row;
};

static int axis_cell(float cell_m, float along_m)
{
	return int_clamp((int)(along_m / cell_m + 0.5f * SELF_ROW), 1, SELF_ROW - 2);
}

static struct cell cell_of(int x, int y, int z)
{
	uint32_t row = (uint32_t)y * 2654435761u ^ (uint32_t)z * 2246822519u;
	return (struct cell){x, (int)((row >> 8) % (SELF_CELLS - SELF_ROW))};
}

/* The mean of a triangle's corners, the farthest corner from it, and its normal. */
static void bound_triangle(struct cloth *cloth, int t, float cap)
{
	struct cloth_self *self = cloth->self;
	struct self_triangle *bound = &self->triangle[t];
	struct v3 corner[3];
	bound->radius_m = -1.0f;
	if (!triangle_placed(cloth, t))
		return;
	self_corners(cloth, t, corner);
	bound->centre_m = v3_scale(v3_add(v3_add(corner[0], corner[1]), corner[2]), 1.0f / 3.0f);
	bound->normal = v3_cross(v3_sub(corner[1], corner[0]), v3_sub(corner[2], corner[0]));
	float d2 = 0.0f;
	for (int k = 0; k < 3; k++) {
		struct v3 d = v3_sub(corner[k], bound->centre_m);
		d2 = float_max(d2, v3_dot(d, d));
	}
	bound->radius_m = float_min(sqrtf(d2), cap);
}

long self_grid(struct cloth *cloth)
{
	struct cloth_self *self = cloth->self;
	int triangles = cloth->garment->triangle_count, *first = self->cell_first;
	float cap = radius_edges * cloth->garment->edge_m;
	self->cell_m = 2.0f * cap + self_reach(cloth);
	memset(first, 0, (SELF_CELLS + 2) * sizeof *first);
	for (int t = 0; t < triangles; t++) {
		struct self_triangle *bound = &self->triangle[t];
		bound_triangle(cloth, t, cap);
		if (bound->radius_m < 0.0f)
			continue;
		struct cell cell = cell_of(axis_cell(self->cell_m, bound->centre_m.x),
					   axis_cell(self->cell_m, bound->centre_m.y),
					   axis_cell(self->cell_m, bound->centre_m.z));
		bound->row = cell.row;
		bound->x = cell.x;
		first[cell.row + cell.x + 2]++;
	}
	for (int b = 0; b < SELF_CELLS; b++)
		first[b + 2] += first[b + 1];
	for (int t = 0; t < triangles; t++) {
		const struct self_triangle *bound = &self->triangle[t];
		if (bound->radius_m >= 0.0f)
			self->cell_item[first[bound->row + bound->x + 1]++] = (struct self_item){
				bound->centre_m, bound->radius_m, t, bound->row};
	}
	return triangles;
}

static bool share_corner(const struct triangle *a, const struct triangle *b)
{
	for (int i = 0; i < 3; i++)
		for (int k = 0; k < 3; k++)
			if (a->v[i] == b->v[k])
				return true;
	return false;
}

/* Parts of one sheet, as most neighbours are: near on the piece and facing alike. */
static bool one_sheet(const struct cloth *cloth, const struct self_triangle *a,
		      const struct self_triangle *b)
{
	float near_m = sheet_edges * cloth->garment->edge_m;
	struct v2 d = v2_sub(a->rest_m, b->rest_m);
	return a->piece == b->piece && v2_dot(d, d) < near_m * near_m &&
	       v3_dot(a->normal, b->normal) > 0.0f;
}

int self_near(const struct cloth *cloth, int t, int near[SELF_NEAR_MAX])
{
	const struct cloth_self *self = cloth->self;
	const struct self_triangle *at = &self->triangle[t];
	float reach = at->radius_m + self_reach(cloth);
	int count = 0, y = axis_cell(self->cell_m, at->centre_m.y) - 1,
	    z = axis_cell(self->cell_m, at->centre_m.z) - 1;
	for (int row = 0; row < 9; row++) {
		struct cell cell = cell_of(at->x - 1, y + row % 3, z + row / 3);
		int begin = self->cell_first[cell.row + cell.x];
		int end = self->cell_first[cell.row + cell.x + 3];
		for (int i = begin; i < end; i++) {
			const struct self_item *item = &self->cell_item[i];
			int u = item->triangle;
			struct v3 d = v3_sub(item->centre_m, at->centre_m);
			float most = reach + item->radius_m;
			if (v3_dot(d, d) < most * most && item->row == cell.row &&
			    !one_sheet(cloth, at, &self->triangle[u]) &&
			    !share_corner(&cloth->triangle[t], &cloth->triangle[u]) &&
			    count < SELF_NEAR_MAX)
				near[count++] = u;
		}
	}
	return count;
}
