/* Who lies over whom where sheets cross: the majority decides, contact zone by contact zone.
 *
 * A zone is what hangs together of vertices near other sheets. In a zone without crossings every
 * vertex stays on the side where it was seen first. In one with crossings all its pairs vote:
 * sheets that face each other for in front or behind, sheets that face alike (a pleat, an overlap,
 * a garment over another) for which piece is the outer one; the smaller part then comes through.
 * Patches that a closed curve of crossings cuts off vote for the other side: they have come through
 * already. After Baraff, Witkin and Kass, "Untangling Cloth" (SIGGRAPH 2003), which floods whole
 * sheets, and so cannot judge where a curve ends at a rim. */
#include "cloth_self_private.h"
#include "forest.h"

enum { CLEAR_MAJORITY = 3 }; /* two of three voters: a third of them more for than against */

static void join_triangle(struct cloth_self *self, int v, const int corner[3])
{
	for (int k = 0; k < 3; k++) {
		forest_join(self->root, v, corner[k]);
		self->crossed[corner[k]] = 1;
	}
	self->crossed[v] = 1;
}

/* Zones as trees in `root`; `crossed` is 1 for every particle in any. */
static void find_zones(struct cloth *cloth)
{
	struct cloth_self *self = cloth->self;
	int vertices = cloth->garment->vertex_count;
	forest_begin(self->root, vertices);
	for (int v = 0; v < vertices; v++)
		self->crossed[v] = 0;
	for (int v = 0; v < vertices; v++)
		for (int i = 0; i < self->pair_count[v]; i++)
			join_triangle(self, v, cloth->triangle[self_pair(self, v, i) / 4].v);
	for (int i = 0; i < self->crossing_count; i++) {
		if (!self->crossing[i].through)
			continue;
		const int *v = cloth->triangle[self->crossing[i].edge / 3].v;
		const int *w = cloth->triangle[self->crossing[i].triangle].v;
		join_triangle(self, v[self->crossing[i].edge % 3], w);
		join_triangle(self, v[(self->crossing[i].edge % 3 + 1) % 3], w);
	}
	for (int e = 0; e < 3 * cloth->garment->triangle_count; e++) {
		const int *v = cloth->triangle[e / 3].v;
		if (self->crossed[v[e % 3]] && self->crossed[v[(e % 3 + 1) % 3]])
			forest_join(self->root, v[e % 3], v[(e % 3 + 1) % 3]);
	}
}

/* Leaves `crossed` on the particles of zones with crossings only. */
static void keep_crossed_zones(struct cloth *cloth)
{
	struct cloth_self *self = cloth->self;
	int vertices = cloth->garment->vertex_count;
	for (int i = 0; i < self->crossing_count; i++) {
		if (!self->crossing[i].through)
			continue;
		const int *v = cloth->triangle[self->crossing[i].edge / 3].v;
		self->crossed[forest_root(self->root, v[self->crossing[i].edge % 3])] = 2;
	}
	for (int v = 0; v < vertices; v++)
		if (self->crossed[v] == 1)
			self->crossed[v] = self->crossed[forest_root(self->root, v)] == 2 ? 1 : 0;
}

/* What a pair votes about: whether its sheets face alike, and what being in front counts there. 0:
 * nothing can be said (a piece that lies over itself). */
static int ballot(const struct cloth *cloth, int v, int t, struct v3 normal, bool *alike)
{
	const struct garment *garment = cloth->garment;
	int owner = cloth->self->owner[v];
	struct v3 corner[3];
	self_corners(cloth, owner, corner);
	struct v3 own = v3_cross(v3_sub(corner[1], corner[0]), v3_sub(corner[2], corner[0]));
	*alike = v3_dot(own, normal) > 0.0f;
	if (!*alike)
		return 1;
	int a = garment->triangle_piece[owner], b = garment->triangle_piece[t];
	return a < b ? 1 : a > b ? -1 : 0;
}

/* For the side that a pair remembers, for that on which its vertex lies when it knows none: where
 * sheets are pressed into one another the place says little. */
static void vote(struct cloth *cloth, int v, int pair)
{
	struct cloth_self *self = cloth->self;
	int t = pair / 4, root = forest_root(self->root, v);
	struct over over;
	bool alike;
	if (!self_look_over(cloth, cloth->position_m[v], t, &over))
		return;
	int front = ballot(cloth, v, t, over.normal, &alike);
	bool before = pair & SELF_DECIDED ? (pair & SELF_FRONT) != 0 : over.height > 0.0f;
	if (before == (self->trapped[v] || self->trapped[cloth->triangle[t].v[0]]))
		front = -front;
	self->vote[2 * root + alike] += front;
	self->voters[2 * root + alike] += front != 0;
}

/* The pair with the side that its zone has chosen; as it was when it has not. */
static int decide(struct cloth *cloth, int v, int pair)
{
	struct cloth_self *self = cloth->self;
	int t = pair / 4, root = forest_root(self->root, v);
	struct over over;
	bool alike;
	if (!self_look_over(cloth, cloth->position_m[v], t, &over))
		return 4 * t;
	if (self_layer_side(cloth, self->owner[v], t))
		return pair;
	int front = ballot(cloth, v, t, over.normal, &alike) * self->vote[2 * root + alike];
	if (CLEAR_MAJORITY * int_max(front, -front) < self->voters[2 * root + alike])
		return pair;
	return 4 * t + (front > 0 ? SELF_DECIDED + SELF_FRONT : front < 0 ? SELF_DECIDED : 0);
}

void self_judge_zones(struct cloth *cloth)
{
	struct cloth_self *self = cloth->self;
	int vertices = cloth->garment->vertex_count;
	find_zones(cloth);
	keep_crossed_zones(cloth);
	for (int v = 0; v < vertices; v++)
		self->vote[2 * v] = self->vote[2 * v + 1] = self->voters[2 * v] =
			self->voters[2 * v + 1] = 0;
	for (int v = 0; v < vertices; v++)
		for (int i = 0; self->crossed[v] && i < self->pair_count[v]; i++)
			vote(cloth, v, self_pair(self, v, i));
	for (int v = 0; v < vertices; v++)
		for (int i = 0; self->crossed[v] && i < self->pair_count[v]; i++) {
			int *pair = &self->pair[SELF_PAIRS_A_VERTEX * v + i];
			*pair = decide(cloth, v, *pair);
		}
}
