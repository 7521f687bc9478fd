#include "cloth_self_private.h"

static const float beyond = -0.25f;   /* least weight of a corner for a vertex to be watched */
static const float touching = -0.05f; /* ... and to be kept off */
static const float margin_m = 0.005f; /* what a vertex may move beside a sheet within a round */
static const float layered_margin_m = 0.014f; /* and how deep an outer garment is found */
static const float lost_m = 0.016f;           /* deeper, a remembered side means nothing any more */
static const float alike = 0.3f;              /* cosine between sheets that lie on one another */
static const float resting_m = 0.0005f; /* so near to where contact pushes, cloth can't give way */
static const float rub = 0.2f;          /* share of the sliding of sheets on one another lost */

struct cloth_self *cloth_self_init(struct arena *arena)
{
	struct cloth_self *self = ARENA_ARRAY(arena, struct cloth_self, 1);
	self->cell_first = ARENA_ARRAY(arena, int, SELF_CELLS + 2);
	self->cell_item = ARENA_ARRAY(arena, struct self_item, GARMENT_TRIANGLES_MAX);
	self->triangle = ARENA_ARRAY(arena, struct self_triangle, GARMENT_TRIANGLES_MAX);
	self->across = ARENA_ARRAY(arena, int, 3 * GARMENT_TRIANGLES_MAX);
	self->owner = ARENA_ARRAY(arena, int, GARMENT_VERTICES_MAX);
	self->garment_size = ARENA_ARRAY(arena, int, GARMENT_VERTICES_MAX);
	self->pair_count = ARENA_ARRAY(arena, uint8_t, GARMENT_VERTICES_MAX);
	self->pair = ARENA_ARRAY(arena, int, SELF_PAIRS_A_VERTEX *GARMENT_VERTICES_MAX);
	self->stamp = ARENA_ARRAY(arena, int, GARMENT_VERTICES_MAX);
	self->crossing = ARENA_ARRAY(arena, struct crossing, SELF_CROSSINGS_MAX);
	self->cut = ARENA_ARRAY(arena, uint8_t, GARMENT_TRIANGLES_MAX);
	self->crossed = ARENA_ARRAY(arena, uint8_t, GARMENT_VERTICES_MAX);
	self->trapped = ARENA_ARRAY(arena, uint8_t, GARMENT_VERTICES_MAX);
	self->root = ARENA_ARRAY(arena, int, GARMENT_VERTICES_MAX);
	self->vote = ARENA_ARRAY(arena, int, 2 * GARMENT_VERTICES_MAX);
	self->voters = ARENA_ARRAY(arena, int, 2 * GARMENT_VERTICES_MAX);
	self->size = ARENA_ARRAY(arena, int, GARMENT_VERTICES_MAX + 2);
	return self;
}

void cloth_self_build(struct cloth *cloth)
{
	struct cloth_self *self = cloth->self;
	size_t vertices = (size_t)cloth->garment->vertex_count;
	self->looked = false;
	self->layered = false;
	for (int p = 0; p < PIECES_MAX; p++)
		self->layered |= cloth->garment->layer[p] > 0 &&
				 cloth->garment->piece_first[p] <
					 cloth->garment->piece_first[p + 1];
	self->margin_m = self->layered ? layered_margin_m : margin_m;
	self->crossing_count = 0;
	if (!cloth->welded)
		return;
	self_connect(cloth);
	memset(self->pair_count, 0, vertices);
	memset(self->trapped, 0, vertices);
	memset(self->crossed, 0, vertices);
	memset(self->stamp, 0xff, vertices * sizeof *self->stamp);
}

void cloth_self_forget(struct cloth *cloth, const uint8_t *flagged)
{
	for (int v = 0; v < cloth->garment->vertex_count; v++)
		if (flagged[v])
			cloth->self->pair_count[v] = 0;
}

/* ---- sides ---- */

bool self_look_over(const struct cloth *cloth, struct v3 p, int t, struct over *over)
{
	struct v3 corner[3];
	self_corners(cloth, t, corner);
	struct v3 e1 = v3_sub(corner[1], corner[0]), e2 = v3_sub(corner[2], corner[0]);
	struct v3 d = v3_sub(p, corner[0]), n = v3_cross(e1, e2);
	float area2 = v3_dot(n, n);
	if (area2 < 1e-16f)
		return false;
	float w1 = v3_dot(v3_cross(d, e2), n) / area2, w2 = v3_dot(v3_cross(e1, d), n) / area2;
	over->normal = v3_scale(n, 1.0f / sqrtf(area2));
	over->height = v3_dot(d, over->normal);
	over->weight[0] = 1.0f - w1 - w2;
	over->weight[1] = w1;
	over->weight[2] = w2;
	return true;
}

/* Beyond an edge the neighbour has to agree on the side; beyond a rim there is none. */
static bool has_side(const struct cloth *cloth, struct v3 p, int t, const struct over *over)
{
	for (int k = 0; k < 3; k++) {
		if (over->weight[(k + 2) % 3] >= 0.0f)
			continue;
		int f = cloth->self->across[3 * t + k];
		struct over next;
		if (over->weight[(k + 2) % 3] < beyond || f < 0 ||
		    !self_look_over(cloth, p, f / 3, &next) ||
		    (next.height > 0.0f) != (over->height > 0.0f))
			return false;
	}
	return true;
}

static bool share_corner(const struct triangle *a, const struct triangle *b)
{
	for (int i = 0; i < 9; i++)
		if (a->v[i / 3] == b->v[i % 3])
			return true;
	return false;
}

/* The side known for a triangle or one beside it; 0: none is. */
static int remembered(const struct cloth *cloth, int t, const int *pair, int count)
{
	int side = 0;
	for (int i = 0; i < count; i++) {
		if (!(pair[i] & SELF_DECIDED))
			continue;
		if (pair[i] / 4 == t)
			return pair[i] % 4;
		if (share_corner(&cloth->triangle[pair[i] / 4], &cloth->triangle[t]))
			side = pair[i] % 4;
	}
	return side;
}

/* The outer of two garments belongs in front of the inner one, wherever it lies now. */
int self_layer_side(const struct cloth *cloth, int s, int t)
{
	const struct garment *garment = cloth->garment;
	int own = garment->layer[garment->triangle_piece[s]];
	int other = garment->layer[garment->triangle_piece[t]];
	if (own == other || self_facing(cloth, s, t) <= 0)
		return 0;
	return own > other ? 1 : -1;
}

int self_facing(const struct cloth *cloth, int s, int t)
{
	struct v3 a = cloth->self->triangle[s].normal, b = cloth->self->triangle[t].normal;
	float facing = v3_dot(a, b);
	if (facing * facing < alike * alike * v3_dot(a, a) * v3_dot(b, b))
		return 0;
	return facing > 0.0f ? 1 : -1;
}

/* The same for a vertex; 0 also at a crease, where its triangles do not agree. */
static int vertex_side(const struct cloth *cloth, int v, int t)
{
	int side = self_layer_side(cloth, cloth->self->owner[v], t);
	for (int i = cloth->star_first[v]; side && i < cloth->star_first[v + 1]; i++)
		if (self_facing(cloth, cloth->star[i] >> 2, t) < 0)
			return 0;
	return side;
}

/* On which side of a triangle a vertex belongs: where nothing is known it is the side on which it
 * lies, but where sheets cross that proves nothing. */
static int side_of(const struct cloth *cloth, int v, int t, const struct over *over,
		   const int *before, int before_count)
{
	int side = remembered(cloth, t, before, before_count);
	if (side)
		return side;
	return (over->height > 0.0f ? SELF_FRONT : 0) |
	       (cloth->self->crossed[v] ? 0 : SELF_DECIDED);
}

/* Marks the particle and two rings round it: they can't touch it. */
static void stamp_rings(struct cloth *cloth, int v)
{
	int *stamp = cloth->self->stamp;
	stamp[v] = v;
	for (int i = 2 * cloth->star_first[v]; i < 2 * cloth->star_first[v + 1]; i++) {
		int w = cloth->ring[i];
		if (stamp[w] == v)
			continue;
		for (int j = 2 * cloth->star_first[w]; j < 2 * cloth->star_first[w + 1]; j++)
			stamp[cloth->ring[j]] = v;
	}
}

static bool stamped(const struct cloth *cloth, int v, int t)
{
	const int *w = cloth->triangle[t].v, *stamp = cloth->self->stamp;
	return stamp[w[0]] == v || stamp[w[1]] == v || stamp[w[2]] == v;
}

/* Puts a triangle among the nearest ones, of which there are `count`; returns how many then. */
static int take_nearest(int *pair, float *far_m, int count, int taken, float distance_m)
{
	if (count == SELF_PAIRS_A_VERTEX && far_m[count - 1] <= distance_m)
		return count;
	int at = count < SELF_PAIRS_A_VERTEX ? count++ : count - 1;
	for (; at > 0 && far_m[at - 1] > distance_m; at--) {
		pair[at] = pair[at - 1];
		far_m[at] = far_m[at - 1];
	}
	pair[at] = taken;
	far_m[at] = distance_m;
	return count;
}

/* The triangles beside which v is watched from now on: the nearest ones when there are too many. */
static void renew_pairs(struct cloth *cloth, int v, const int *near, int near_count)
{
	struct cloth_self *self = cloth->self;
	int *pair = &self->pair[SELF_PAIRS_A_VERTEX * v], before[SELF_PAIRS_A_VERTEX];
	int before_count = self->pair_count[v], count = 0;
	float far_m[SELF_PAIRS_A_VERTEX], reach = self_reach(cloth);
	struct v3 p = cloth->position_m[v];
	struct over over;
	memcpy(before, pair, sizeof before);
	self->pair_count[v] = 0;
	if (near_count == 0)
		return;
	stamp_rings(cloth, v);
	for (int i = 0; i < near_count; i++) {
		int t = near[i];
		if (stamped(cloth, v, t) || !self_look_over(cloth, p, t, &over) ||
		    float_abs(over.height) > reach || !has_side(cloth, p, t, &over))
			continue;
		int order = self->layered ? vertex_side(cloth, v, t) : 0;
		if (!order && float_abs(over.height) > cloth->settings.thickness_m + margin_m)
			continue;
		int side = order ? SELF_DECIDED | (order > 0 ? SELF_FRONT : 0)
				 : side_of(cloth, v, t, &over, before, before_count);
		count = take_nearest(pair, far_m, count, 4 * t + side, float_abs(over.height));
	}
	self->pair_count[v] = (uint8_t)count;
}

/* ---- keeping apart ---- */

static int layer_of(const struct cloth *cloth, int v)
{
	return cloth->garment->layer[cloth->garment->piece[v]];
}

/* 0 or 1: does the particle give way in a direction? Pins do not, nor what lies on the body. */
static float gives_way(const struct cloth *cloth, int v, struct v3 way)
{
	const struct contact *contact = &cloth->contact[v];
	if (cloth->held[v] > 1)
		return 0.0f;
	return contact->triangle >= 0 && v3_dot(way, contact->normal) < 0.0f &&
			       cloth_spare(cloth, v) < resting_m
		       ? 0.0f
		       : 1.0f;
}

void self_part(struct cloth *cloth, const struct sheet_point *a, const struct sheet_point *b,
	       struct v3 away, bool outer_only)
{
	const struct sheet_point *points[2] = {a, b};
	int outer = int_max(layer_of(cloth, a->v[0]), layer_of(cloth, b->v[0]));
	float share[2][3], sum = 0.0f;
	for (int pass = 0; sum == 0.0f && pass < 2; pass++) /* if none gives way, all do */
		for (int i = 0; i < 2; i++)
			for (int k = 0; k < points[i]->count; k++) {
				int v = points[i]->v[k];
				float w = points[i]->weight[k], give = 1.0f;
				struct v3 way = v3_scale(away, i == 0 ? w : -w);
				if (outer_only)
					give = layer_of(cloth, v) == outer ? 1.0f : 0.0f;
				else if (pass == 0)
					give = gives_way(cloth, v, way);
				share[i][k] = give * w;
				sum += share[i][k] * w;
			}
	for (int i = 0; sum > 0.0f && i < 2; i++)
		for (int k = 0; k < points[i]->count; k++) {
			struct v3 *x = &cloth->position_m[points[i]->v[k]];
			float by = (i == 0 ? share[i][k] : -share[i][k]) / sum;
			*x = v3_mad(*x, away, by);
		}
}

/* Sheets that rub lose some of their sliding. */
static void rub_sheets(struct cloth *cloth, int v, const int *w, const struct over *over)
{
	struct v3 *x = cloth->position_m;
	const struct v3 *start = cloth->previous_m;
	struct v3 slide = v3_sub(x[v], start[v]);
	float sum = 1.0f;
	for (int k = 0; k < 3; k++) {
		slide = v3_mad(slide, v3_sub(x[w[k]], start[w[k]]), -over->weight[k]);
		sum += over->weight[k] * over->weight[k];
	}
	slide = v3_mad(slide, over->normal, -v3_dot(slide, over->normal));
	x[v] = v3_mad(x[v], slide, -rub / sum);
	for (int k = 0; k < 3; k++)
		x[w[k]] = v3_mad(x[w[k]], slide, over->weight[k] * rub / sum);
}

/* Puts v a thickness away from a triangle on its side. */
static void keep_apart(struct cloth *cloth, int v, int pair, bool outer_only)
{
	const int *w = cloth->triangle[pair / 4].v;
	struct over over;
	if (!(pair & SELF_DECIDED) || !self_look_over(cloth, cloth->position_m[v], pair / 4, &over))
		return;
	float sign = pair & SELF_FRONT ? 1.0f : -1.0f, height = sign * over.height;
	float lack = cloth->settings.thickness_m - height;
	if (lack <= 0.0f || height < -lost_m || over.weight[0] < touching ||
	    over.weight[1] < touching || over.weight[2] < touching)
		return;
	struct sheet_point a = {1, {v}, {1.0f}},
			   b = {3,
				{w[0], w[1], w[2]},
				{over.weight[0], over.weight[1], over.weight[2]}};
	if (!outer_only)
		rub_sheets(cloth, v, w, &over);
	self_part(cloth, &a, &b, v3_scale(over.normal, sign * lack), outer_only);
}

static long keep_all_apart(struct cloth *cloth)
{
	const struct cloth_self *self = cloth->self;
	long pairs = 0;
	for (int v = 0; v < cloth->garment->vertex_count; v++) {
		for (int i = 0; i < self->pair_count[v]; i++)
			keep_apart(cloth, v, self->pair[SELF_PAIRS_A_VERTEX * v + i], false);
		pairs += self->pair_count[v];
	}
	return pairs;
}

/* ---- the rounds ---- */

static void undecide(struct cloth *cloth, int v, int t)
{
	struct cloth_self *self = cloth->self;
	for (int i = 0; i < self->pair_count[v]; i++) {
		int *pair = &self->pair[SELF_PAIRS_A_VERTEX * v + i];
		if (*pair / 4 == t)
			*pair &= ~SELF_DECIDED;
	}
}

/* Where garments cross and their order says nothing, only the curve of crossing knows the way out:
 * no side is kept against it. */
static void let_pull(struct cloth *cloth)
{
	struct cloth_self *self = cloth->self;
	for (int i = 0; i < self->crossing_count; i++) {
		const struct crossing *crossing = &self->crossing[i];
		int e = crossing->edge, f = self->across[e];
		const int *v = cloth->triangle[e / 3].v, *w = cloth->triangle[crossing->triangle].v;
		if (crossing->side)
			continue;
		undecide(cloth, v[e % 3], crossing->triangle);
		undecide(cloth, v[(e % 3 + 1) % 3], crossing->triangle);
		for (int k = 0; k < 3; k++) {
			undecide(cloth, w[k], e / 3);
			if (f >= 0)
				undecide(cloth, w[k], f / 3);
		}
	}
}

/* After a round: with all crossings known. */
static void judge(struct cloth *cloth)
{
	self_find_patches(cloth);
	if (cloth_crossings(cloth) > 0)
		self_judge_zones(cloth);
	else
		memset(cloth->self->crossed, 0, GARMENT_VERTICES_MAX);
	if (cloth->self->layered)
		let_pull(cloth);
}

/* Slice `slice` of `slices` of all triangles: their crossings, and the pairs of the vertices that
 * they own. */
static long look(struct cloth *cloth, int slice, int slices)
{
	struct cloth_self *self = cloth->self;
	int near[SELF_NEAR_MAX];
	long units = 0;
	self_forget_crossings(cloth, slice, slices);
	for (int t = slice; t < cloth->garment->triangle_count; t += slices) {
		if (self->triangle[t].radius_m < 0.0f)
			continue;
		int count = self_near(cloth, t, near);
		self_find_crossings(cloth, t, near, count);
		for (int k = 0; k < 3; k++) {
			int v = cloth->triangle[t].v[k];
			if (self->owner[v] == t)
				renew_pairs(cloth, v, near, count);
		}
		units += 4 + count;
	}
	if (slice == slices - 1)
		judge(cloth);
	return units;
}

long cloth_self_look(struct cloth *cloth)
{
	cloth->self->looked = true;
	return self_grid(cloth) + look(cloth, 0, 1);
}

long cloth_self(struct cloth *cloth)
{
	long units = 0;
	if (!cloth->welded || cloth->settings.thickness_m <= 0.0f)
		return 0;
	if (!cloth->self->looked)
		units += cloth_self_look(cloth);
	units += keep_all_apart(cloth);
	units += self_pull_crossings(cloth);
	if (cloth->sweep % SELF_EVERY == 0) /* now that what can be kept apart is */
		units += self_grid(cloth) +
			 look(cloth, cloth->sweep / SELF_EVERY % SELF_SLICES, SELF_SLICES);
	return units;
}

long cloth_self_order(struct cloth *cloth)
{
	const struct cloth_self *self = cloth->self;
	if (!cloth->welded || cloth->settings.thickness_m <= 0.0f || !self->layered)
		return 0;
	long units = 0;
	for (int v = 0; v < cloth->garment->vertex_count; v++)
		for (int i = 0; i < self->pair_count[v]; i++) {
			int pair = self_pair(self, v, i);
			if (layer_of(cloth, v) ==
			    cloth->garment->layer[cloth->garment->triangle_piece[pair / 4]])
				continue;
			keep_apart(cloth, v, pair, true);
			units++;
		}
	units += self_hold_order(cloth);
	return units + cloth_contact(cloth);
}
