/* Which triangles of a cloth lie near one another: a hashed grid of their centres, filled by
 * counting sort, so that its order is that of the triangles. */
#include "cloth_self_private.h"

static const float cell_least_m = 0.01f;
static const float flat_edges = 3.0f;  /* so near on one piece ... */
static const float flat_cosine = 0.3f; /* and facing so much alike, triangles are one sheet */

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

static int root_of(int *root, int v)
{
	while (root[v] != v)
		v = root[v] = root[root[v]];
	return v;
}

/* Sizes of what hangs together over edges that `cut` (per triangle, a bit an edge; NULL: none) does
 * not bar, per particle. */
static void measure_patches(struct cloth *cloth, const uint8_t *cut, int *size)
{
	int *root = cloth->self->root, vertices = cloth->garment->vertex_count;
	for (int v = 0; v < vertices; v++)
		root[v] = v;
	for (int e = 0; e < 3 * cloth->garment->triangle_count; e++) {
		const int *v = cloth->triangle[e / 3].v;
		if (cut && (cut[e / 3] >> e % 3 & 1))
			continue;
		int a = root_of(root, v[e % 3]), b = root_of(root, v[(e % 3 + 1) % 3]);
		root[int_max(a, b)] = int_min(a, b);
	}
	memset(size, 0, (size_t)vertices * sizeof *size);
	for (int v = 0; v < vertices; v++)
		if (cloth->particle[v] == v)
			size[root_of(root, v)]++;
	for (int v = 0; v < vertices; v++)
		size[v] = size[root_of(root, v)];
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
}

/* A patch that a closed curve of crossings cuts off and that is the smaller part of its garment has
 * come through: its sides are the wrong ones. */
void self_find_patches(struct cloth *cloth)
{
	struct cloth_self *self = cloth->self;
	int vertices = cloth->garment->vertex_count;
	memset(self->trapped, 0, (size_t)vertices);
	if (self->crossing_count == 0)
		return;
	memset(self->cut, 0, (size_t)cloth->garment->triangle_count);
	for (int i = 0; i < self->crossing_count; i++) {
		const struct crossing *crossing = &self->crossing[i];
		int e = crossing->edge, f = self->across[e];
		self->cut[e / 3] |= (uint8_t)(1 << e % 3);
		if (f >= 0)
			self->cut[f / 3] |= (uint8_t)(1 << f % 3);
	}
	measure_patches(cloth, self->cut, self->size);
	for (int v = 0; v < vertices; v++)
		self->trapped[v] = 4 * self->size[v] < self->garment_size[v];
}

/* ---- the grid ---- */

static uint32_t cell_key(float cell_m, struct v3 p, int x, int y, int z)
{
	/* 10 bits an axis: 1024 cells of 30 mm are 30 m */
	uint32_t i = (uint32_t)((int)(p.x / cell_m + 512.0f) + x) & 1023u;
	uint32_t j = (uint32_t)((int)(p.y / cell_m + 512.0f) + y) & 1023u;
	uint32_t k = (uint32_t)((int)(p.z / cell_m + 512.0f) + z) & 1023u;
	return i << 20 | j << 10 | k;
}

static uint32_t cell_bucket(uint32_t key)
{
	return (key * 2654435761u >> 16) % SELF_CELLS;
}

/* The mean of a triangle's corners, and the farthest corner from it. */
static void bound_triangles(struct cloth *cloth)
{
	struct cloth_self *self = cloth->self;
	float most = 0.0f, cap = 2.0f * cloth->garment->edge_m;
	struct v3 corner[3];
	for (int t = 0; t < cloth->garment->triangle_count; t++) {
		self->radius_m[t] = -1.0f;
		if (!triangle_placed(cloth, t))
			continue;
		self_corners(cloth, t, corner);
		struct v3 centre = v3_scale(v3_add(v3_add(corner[0], corner[1]), corner[2]),
					    1.0f / 3.0f);
		float d2 = 0.0f;
		for (int k = 0; k < 3; k++) {
			struct v3 d = v3_sub(corner[k], centre);
			d2 = float_max(d2, v3_dot(d, d));
		}
		self->centre_m[t] = centre;
		self->radius_m[t] = float_min(sqrtf(d2), cap);
		most = float_max(most, self->radius_m[t]);
	}
	self->cell_m = float_max(2.0f * most + self_reach(cloth), cell_least_m);
}

long self_grid(struct cloth *cloth)
{
	struct cloth_self *self = cloth->self;
	int triangles = cloth->garment->triangle_count;
	int *first = self->cell_first;
	bound_triangles(cloth);
	memset(first, 0, (SELF_CELLS + 2) * sizeof *first);
	for (int pass = 0; pass < 2; pass++) {
		for (int t = 0; t < triangles; t++) {
			if (self->radius_m[t] < 0.0f)
				continue;
			uint32_t key = cell_key(self->cell_m, self->centre_m[t], 0, 0, 0);
			uint32_t bucket = cell_bucket(key);
			if (pass == 0) {
				first[bucket + 2]++;
			} else {
				self->cell_key[first[bucket + 1]] = key;
				self->cell_item[first[bucket + 1]++] = t;
			}
		}
		for (int b = 0; pass == 0 && b < SELF_CELLS; b++)
			first[b + 2] += first[b + 1];
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

static struct v2 rest_centre(const struct garment *garment, int t)
{
	const int *v = garment->triangle[t].v;
	return v2_scale(
		v2_add(v2_add(garment->rest_m[v[0]], garment->rest_m[v[1]]), garment->rest_m[v[2]]),
		1.0f / 3.0f);
}

/* Parts of one sheet, as most neighbours are: near on the piece and facing alike. */
static bool one_sheet(const struct cloth *cloth, int t, int u)
{
	const struct garment *garment = cloth->garment;
	struct v3 a[3], b[3];
	if (garment->triangle_piece[t] != garment->triangle_piece[u] ||
	    v2_distance(rest_centre(garment, t), rest_centre(garment, u)) >
		    flat_edges * garment->edge_m)
		return false;
	self_corners(cloth, t, a);
	self_corners(cloth, u, b);
	struct v3 n = v3_cross(v3_sub(a[1], a[0]), v3_sub(a[2], a[0]));
	struct v3 m = v3_cross(v3_sub(b[1], b[0]), v3_sub(b[2], b[0]));
	float dot = v3_dot(n, m);
	return dot > 0.0f && dot * dot > flat_cosine * flat_cosine * v3_dot(n, n) * v3_dot(m, m);
}

int self_near(const struct cloth *cloth, int t, int near[SELF_NEAR_MAX])
{
	const struct cloth_self *self = cloth->self;
	struct v3 centre = self->centre_m[t];
	float reach = self->radius_m[t] + self_reach(cloth);
	int count = 0;
	for (int cell = 0; cell < 27; cell++) {
		uint32_t key = cell_key(self->cell_m, centre, cell % 3 - 1, cell / 3 % 3 - 1,
					cell / 9 - 1);
		uint32_t bucket = cell_bucket(key);
		for (int i = self->cell_first[bucket]; i < self->cell_first[bucket + 1]; i++) {
			int u = self->cell_item[i];
			struct v3 d = v3_sub(self->centre_m[u], centre);
			float most = reach + self->radius_m[u];
			if (self->cell_key[i] == key && v3_dot(d, d) < most * most &&
			    !share_corner(&cloth->triangle[t], &cloth->triangle[u]) &&
			    !one_sheet(cloth, t, u) && count < SELF_NEAR_MAX)
				near[count++] = u;
		}
	}
	return count;
}
