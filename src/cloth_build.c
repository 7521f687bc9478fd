/* The constraints of a cloth: rest shapes, flatness stencils, neighbours. */
#include "cloth_pleat.h"
#include "cloth_private.h"
#include "cloth_self.h"

enum { SELF_UNITS = 20 }; /* a vertex's share of the tables of cloth_self*.c */

struct v2 cloth_flat_m(const struct cloth *cloth, int v)
{
	const struct gather *gather = &cloth->piece_gather[cloth->garment->piece[v]];
	struct v2 p = cloth->garment->rest_m[v];
	float past_m = float_max(v2_dot(p, gather->along) - gather->from_m, 0.0f);
	return v2_add(p, v2_scale(gather->along, (gather->share - 1.0f) * past_m));
}

static void build_rest(struct cloth *cloth)
{
	const struct garment *garment = cloth->garment;
	struct cloth_scratch *s = cloth->scratch;
	for (int t = 0; t < garment->triangle_count; t++) {
		const int *v = garment->triangle[t].v;
		struct v2 u1 = cloth_flat_way(cloth, t, v[0], v[1]);
		struct v2 u2 = cloth_flat_way(cloth, t, v[0], v[2]);
		float det = v2_cross(u1, u2);
		det = det > 1e-10f ? det : 1e-10f;
		struct v2 d1 = {u2.y / det, -u1.y / det}, d2 = {-u2.x / det, u1.x / det};
		s->rest[t] = (struct rest){
			{d1.x * d1.x + d2.x * d2.x, d1.x * d1.y + d2.x * d2.y,
			 d1.y * d1.y + d2.y * d2.y},
			{2.0f * d1.x * d2.x, d1.x * d2.y + d1.y * d2.x, 2.0f * d1.y * d2.y},
		};
		struct turn *turn = &s->turn[sliced(garment->triangle_count, t)];
		for (int k = 0; k < 3; k++) {
			turn->v[k] = cloth->triangle[t].v[k];
			turn->metric[k] = s->rest[t].metric[k];
		}
	}
}

static void take_particles(struct cloth *cloth)
{
	const struct garment *garment = cloth->garment;
	for (int v = 0; v < garment->vertex_count; v++)
		cloth->particle[v] = cloth->welded ? garment->weld[v] : v;
	for (int t = 0; t < garment->triangle_count; t++)
		for (int k = 0; k < 3; k++)
			cloth->triangle[t].v[k] = cloth->particle[garment->triangle[t].v[k]];
}

/* Every triangle's edge under the lower of its particles. */
static void list_edges(struct cloth *cloth)
{
	struct cloth_scratch *s = cloth->scratch;
	int vertices = cloth->garment->vertex_count, triangles = cloth->garment->triangle_count;
	memset(s->edge_first, 0, (size_t)(vertices + 2) * sizeof *s->edge_first);
	for (int pass = 0; pass < 2; pass++) {
		for (int t = 0; t < triangles; t++)
			for (int k = 0; k < 3; k++) {
				int a = cloth->triangle[t].v[k],
				    b = cloth->triangle[t].v[(k + 1) % 3];
				int low = int_min(a, b);
				if (pass == 0)
					s->edge_first[low + 2]++;
				else
					s->edge_triangle[s->edge_first[low + 1]++] = 3 * t + k;
			}
		for (int v = 0; pass == 0 && v < vertices; v++)
			s->edge_first[v + 2] += s->edge_first[v + 1];
	}
}

static float cotangent(struct v2 at, struct v2 p, struct v2 q)
{
	struct v2 u = v2_sub(p, at), w = v2_sub(q, at);
	float area = float_max(float_abs(v2_cross(u, w)), 1e-10f);
	return float_clamp(v2_dot(u, w) / area, -10.0f, 10.0f);
}

/* Isometric bending (Bergou et al. 2006): weights from the cotangents of both flat triangles. Edge
 * k of triangle t is a -> b with c opposite; of triangle u it is b -> a with d opposite. */
static void add_flat(struct cloth *cloth, int at, int across)
{
	const struct garment *garment = cloth->garment;
	int t = at / 3, k = at % 3, u = across / 3, j = across % 3;
	const int *p = garment->triangle[t].v, *q = garment->triangle[u].v;
	const struct v2 *rest = garment->rest_m;
	int a = p[k], b = p[(k + 1) % 3], c = p[(k + 2) % 3];
	int a2 = q[(j + 1) % 3], b2 = q[j], d = q[(j + 2) % 3];
	bool crossed = cloth->particle[b2] != cloth->particle[b]; /* a seam of inconsistent sides */
	if (crossed) {
		int swap = a2;
		a2 = b2;
		b2 = swap;
	}
	float ac = cotangent(rest[a], rest[b], rest[c]),
	      ad = cotangent(rest[a2], rest[b2], rest[d]);
	float bc = cotangent(rest[b], rest[a], rest[c]),
	      bd = cotangent(rest[b2], rest[a2], rest[d]);
	struct flat *flat = &cloth->flat[cloth->flat_count++];
	int corner[4] = {a, b, c, d};
	float weight[4] = {bc + bd, ac + ad, -ac - bc, -ad - bd};
	float squares = 1e-6f;
	for (int i = 0; i < 4; i++)
		squares += weight[i] * weight[i];
	float norm = sqrtf(squares);
	for (int i = 0; i < 4; i++) {
		flat->v[i] = cloth->particle[corner[i]];
		flat->k[i] = weight[i] / norm;
	}
}

static void pair_edges(struct cloth *cloth)
{
	struct cloth_scratch *s = cloth->scratch;
	const struct triangle *triangle = cloth->triangle;
	cloth->flat_count = 0;
	memset(s->edge_owner, 7, (size_t)cloth->garment->triangle_count);
	memset(s->across, 0xff, 3 * (size_t)cloth->garment->triangle_count * sizeof *s->across);
	for (int v = 0; v < cloth->garment->vertex_count; v++)
		for (int i = s->edge_first[v]; i < s->edge_first[v + 1]; i++)
			for (int j = i + 1; j < s->edge_first[v + 1]; j++) {
				int e = s->edge_triangle[i], f = s->edge_triangle[j];
				int e_high = int_max(triangle[e / 3].v[e % 3],
						     triangle[e / 3].v[(e % 3 + 1) % 3]);
				int f_high = int_max(triangle[f / 3].v[f % 3],
						     triangle[f / 3].v[(f % 3 + 1) % 3]);
				if (e_high != f_high || cloth->flat_count == GARMENT_EDGES_MAX)
					continue;
				add_flat(cloth, e, f);
				s->across[e] = f;
				s->across[f] = e;
				s->edge_owner[f / 3] &= (uint8_t) ~(1 << f % 3);
			}
}

/* Every particle's triangles, and its neighbours in them. */
static void build_stars(struct cloth *cloth)
{
	int vertices = cloth->garment->vertex_count, triangles = cloth->garment->triangle_count;
	int *first = cloth->star_first;
	memset(first, 0, (size_t)(vertices + 2) * sizeof *first);
	for (int t = 0; t < triangles; t++)
		for (int k = 0; k < 3; k++)
			first[cloth->triangle[t].v[k] + 2]++;
	for (int v = 0; v < vertices; v++)
		first[v + 2] += first[v + 1];
	for (int t = 0; t < triangles; t++)
		for (int k = 0; k < 3; k++) {
			const int *v = cloth->triangle[t].v;
			int i = first[v[k] + 1]++;
			cloth->star[i] = 4 * t + k;
			cloth->ring[2 * i] = v[(k + 1) % 3];
			cloth->ring[2 * i + 1] = v[(k + 2) % 3];
		}
}

/* Nothing is known of the new cloth's folds, nor which of its faces rest. */
static void forget_faces(struct cloth *cloth)
{
	struct cloth_scratch *s = cloth->scratch;
	memset(s->facing, 0, (size_t)cloth->garment->triangle_count);
	memset(s->turned, 0, (size_t)cloth->garment->triangle_count);
	memset(s->swung_in, 0, (size_t)cloth->garment->vertex_count * sizeof *s->swung_in);
	memset(s->face_quiet, 0, (size_t)cloth->garment->triangle_count * sizeof *s->face_quiet);
	s->taut_count = s->next_taut_count = 0;
	s->open_count = s->facing_in = s->swing = 0;
}

/* ---- is it the same mesh? ---- */

static uint64_t mix(uint64_t hash, const void *data, size_t size)
{
	const unsigned char *bytes = data;
	for (; size >= sizeof hash; size -= sizeof hash, bytes += sizeof hash) {
		uint64_t word;
		memcpy(&word, bytes, sizeof word);
		hash = (hash ^ word) * 0x9e3779b97f4a7c15u;
		hash ^= hash >> 32;
	}
	for (; size > 0; size--, bytes++)
		hash = (hash ^ *bytes) * 0x9e3779b97f4a7c15u;
	return hash;
}

#define MIX(hash, array, count) mix((hash), (array), (size_t)(count) * sizeof *(array))

/* Of all that the tables hang on; never 0. */
static uint64_t mesh_id(const struct cloth *cloth)
{
	const struct garment *garment = cloth->garment;
	int counts[3] = {garment->vertex_count, garment->triangle_count, cloth->welded};
	uint64_t hash = MIX(1, counts, 3);
	hash = MIX(hash, &garment->edge_m, 1);
	hash = MIX(hash, garment->rest_m, garment->vertex_count);
	hash = MIX(hash, garment->weld, garment->vertex_count);
	hash = MIX(hash, garment->triangle, garment->triangle_count);
	hash = MIX(hash, garment->pair, garment->pair_count);
	hash = MIX(hash, cloth->piece_gather, PIECES_MAX);
	hash = MIX(hash, cloth->piece_wide, PIECES_MAX);
	return hash | 1;
}

/* ---- the steps ---- */

static void build_edges(struct cloth *cloth)
{
	list_edges(cloth);
	pair_edges(cloth);
}

/* Each is done at once; its price is per vertex. */
static const struct {
	void (*build)(struct cloth *cloth);
	int units;
} steps[] = {
	{cloth_build_pleats, 10}, {build_rest, 10},  {build_edges, 40},       {build_stars, 15},
	{march_build, 15},        {cloth_order, 50}, {cloth_begin_levels, 5},
};

void cloth_take_gathers(struct cloth *cloth)
{
	build_rest(cloth);
	cloth->scratch->build.mesh_id = mesh_id(cloth);
	cloth->scratch->stale = true;
}

void cloth_build_begin(struct cloth *cloth)
{
	struct build *build = &cloth->scratch->build;
	uint64_t id = mesh_id(cloth);
	cloth->scratch->stale = true;
	forget_faces(cloth);
	cloth->built = build->step > COUNT_OF(steps) && build->mesh_id == id;
	if (cloth->built) {
		cloth_self_build(cloth);
		return;
	}
	build->mesh_id = id;
	build->step = 0;
	take_particles(cloth);
}

long cloth_build_on(struct cloth *cloth, long quota)
{
	struct build *build = &cloth->scratch->build;
	long units = 0;
	while (build->step < COUNT_OF(steps)) {
		if (units >= quota)
			return units;
		steps[build->step].build(cloth);
		units += (long)steps[build->step].units * cloth->garment->vertex_count;
		build->step++;
	}
	if (units >= quota || !cloth_build_levels(cloth, quota, &units))
		return units;
	build->step++;
	cloth->built = true;
	cloth_self_build(cloth);
	return units + SELF_UNITS * (long)cloth->garment->vertex_count;
}

void cloth_build(struct cloth *cloth)
{
	cloth_build_begin(cloth);
	while (!cloth->built)
		cloth_build_on(cloth, INT32_MAX);
}
