/* The order in which the solver works: particles by neighbourhood, constraints by colour. */
#include "cloth_private.h"

/* ---- once for a mesh ---- */

/* Breadth-first over the mesh (Cuthill and McKee 1969): neighbours get near numbers, so that a
 * sweep walks through memory. */
static void rank_particles(struct cloth *cloth)
{
	struct cloth_scratch *s = cloth->scratch;
	int count = 0, vertices = cloth->garment->vertex_count;
	for (int v = 0; v < vertices; v++)
		s->rank[v] = -1;
	for (int seed = 0; seed < vertices; seed++) {
		if (cloth->particle[seed] != seed || s->rank[seed] >= 0)
			continue;
		s->ranked[count] = seed;
		s->rank[seed] = count++;
		for (int at = s->rank[seed]; at < count; at++) {
			int v = s->ranked[at];
			for (int i = s->ring_first[v]; i < s->ring_first[v + 1]; i++) {
				int w = s->ring[i];
				if (s->rank[w] >= 0)
					continue;
				s->ranked[count] = w;
				s->rank[w] = count++;
			}
		}
	}
	s->ranked_count = count;
}

/* Constraints to be coloured: `arity` particles each, `stride` ints apart. */
struct list {
	const int *corner;
	int arity, stride, count;
};

static int lowest_rank(const struct cloth_scratch *s, const struct list *list, int i)
{
	const int *v = list->corner + (size_t)i * (size_t)list->stride;
	int low = s->rank[v[0]];
	for (int k = 1; k < list->arity; k++)
		low = int_min(low, s->rank[v[k]]);
	return low;
}

/* Counting sort of the constraints by the lowest rank of their particles, into s->sorted. */
static void sort_by_rank(struct cloth *cloth, const struct list *list)
{
	struct cloth_scratch *s = cloth->scratch;
	int *first = s->edge_first, ranks = s->ranked_count;
	memset(first, 0, (size_t)(ranks + 1) * sizeof *first);
	for (int i = 0; i < list->count; i++)
		first[lowest_rank(s, list, i) + 1]++;
	for (int r = 0; r < ranks; r++)
		first[r + 1] += first[r];
	for (int i = 0; i < list->count; i++)
		s->sorted[first[lowest_rank(s, list, i)]++] = i;
}

/* The first colour that none of its particles has yet. Beyond the last one: the last, in which
 * constraints are worked out one by one. */
static int take_colour(uint64_t *taken, const int *v, int arity)
{
	uint64_t all = 0;
	int colour = 0;
	for (int k = 0; k < arity; k++)
		all |= taken[v[k]];
	while (colour < COLOURS - 1 && (all >> colour & 1))
		colour++;
	for (int k = 0; k < arity; k++)
		taken[v[k]] |= (uint64_t)1 << colour;
	return colour;
}

/* Into `order`: constraints by colour, within a colour by neighbourhood. Two of one colour share no
 * particle (but in the last). */
static void colour(struct cloth *cloth, const struct list *list, int *order, int first[COLOURS + 1])
{
	struct cloth_scratch *s = cloth->scratch;
	int place[COLOURS];
	sort_by_rank(cloth, list);
	memset(s->taken, 0, (size_t)cloth->garment->vertex_count * sizeof *s->taken);
	memset(first, 0, (COLOURS + 1) * sizeof *first);
	for (int i = 0; i < list->count; i++) {
		const int *v = list->corner + (size_t)s->sorted[i] * (size_t)list->stride;
		s->colour[i] = (uint8_t)take_colour(s->taken, v, list->arity);
		first[s->colour[i] + 1]++;
	}
	for (int c = 0; c < COLOURS; c++) {
		place[c] = first[c];
		first[c + 1] += first[c];
	}
	for (int i = 0; i < list->count; i++)
		order[place[s->colour[i]]++] = s->sorted[i];
}

void cloth_order(struct cloth *cloth)
{
	struct cloth_scratch *s = cloth->scratch;
	rank_particles(cloth);
	struct list triangles = {cloth->triangle[0].v, 3, 3, cloth->garment->triangle_count};
	struct list flats = {cloth->flat[0].v, 4, sizeof(struct flat) / sizeof(int),
			     cloth->flat_count};
	colour(cloth, &triangles, s->triangle_order, s->triangle_colour);
	colour(cloth, &flats, s->flat_order, s->flat_colour);
	s->stale = true;
}

/* ---- whenever cloth is placed ---- */

/* Unit triangles far from nothing: the kernels may work on them, nobody reads them. */
static void fill_pads(struct cloth_scratch *s)
{
	for (int i = 0; i < PADS; i++)
		s->place[i] = (struct place){(float)(i / BATCH == 1), (float)(i / BATCH == 2), 0.0f,
					     0.0f};
}

static void take_slots(struct cloth *cloth)
{
	struct cloth_scratch *s = cloth->scratch;
	s->slot_count = PADS;
	for (int v = 0; v < cloth->garment->vertex_count; v++)
		s->slot[v] = -1;
	for (int r = 0; r < s->ranked_count; r++) {
		int v = s->ranked[r];
		if (!cloth->placed[v])
			continue;
		s->slot_vertex[s->slot_count] = v;
		s->slot[v] = s->slot_count++;
	}
	for (int v = 0; v < cloth->garment->vertex_count; v++)
		s->slot[v] = s->slot[cloth->particle[v]];
}

static void put_shape(struct shape_batch *batch, int lane, const struct rest *rest,
		      const int corner[3])
{
	for (int k = 0; k < 3; k++) {
		batch->at[k][lane] = place_offset(corner[k]);
		batch->metric[k][lane] = rest->metric[k];
		batch->grain[k][lane] = rest->grain[k];
	}
}

/* A new batch, all of whose lanes are pads. */
static struct shape_batch *open_shape(struct cloth_scratch *s)
{
	static const struct rest unit = {{1.0f, 0.0f, 1.0f}, {0.0f, 1.0f, 0.0f}};
	struct shape_batch *batch = &s->shape[s->shape_count++];
	for (int lane = 0; lane < BATCH; lane++)
		put_shape(batch, lane, &unit, (int[3]){lane, BATCH + lane, 2 * BATCH + lane});
	return batch;
}

static void take_shapes(struct cloth *cloth)
{
	struct cloth_scratch *s = cloth->scratch;
	s->shape_count = 0;
	for (int c = 0; c < COLOURS; c++) {
		struct shape_batch *batch = NULL;
		int lane = BATCH;
		for (int i = s->triangle_colour[c]; i < s->triangle_colour[c + 1]; i++) {
			int t = s->triangle_order[i];
			const int *v = cloth->triangle[t].v;
			if (!triangle_placed(cloth, t))
				continue;
			if (lane == BATCH || c == COLOURS - 1) {
				batch = open_shape(s);
				lane = 0;
			}
			put_shape(batch, lane++, &s->rest[t],
				  (int[3]){s->slot[v[0]], s->slot[v[1]], s->slot[v[2]]});
		}
	}
}

static struct flat_batch *open_flat(struct cloth_scratch *s)
{
	struct flat_batch *batch = &s->flat[s->flat_count++];
	memset(batch, 0, sizeof *batch);
	for (int lane = 0; lane < BATCH; lane++)
		for (int k = 0; k < 4; k++)
			batch->at[lane][k] = place_offset(lane);
	return batch;
}

static void take_flats(struct cloth *cloth)
{
	struct cloth_scratch *s = cloth->scratch;
	s->flat_count = 0;
	for (int c = 0; c < COLOURS; c++) {
		struct flat_batch *batch = NULL;
		int lane = BATCH;
		for (int i = s->flat_colour[c]; i < s->flat_colour[c + 1]; i++) {
			const struct flat *flat = &cloth->flat[s->flat_order[i]];
			const int *v = flat->v;
			if (s->slot[v[0]] < 0 || s->slot[v[1]] < 0 || s->slot[v[2]] < 0 ||
			    s->slot[v[3]] < 0)
				continue;
			if (lane == BATCH || c == COLOURS - 1) {
				batch = open_flat(s);
				lane = 0;
			}
			for (int k = 0; k < 4; k++) {
				batch->at[lane][k] = place_offset(s->slot[v[k]]);
				batch->k[lane][k] = flat->k[k];
			}
			batch->firm[lane++] = s->stiff[v[0]] && s->stiff[v[1]] ? FIRM_SHARE : 0.0f;
		}
	}
}

void cloth_take(struct cloth *cloth)
{
	struct cloth_scratch *s = cloth->scratch;
	size_t vertices = (size_t)cloth->garment->vertex_count;
	if (!s->stale && memcmp(s->taken_placed, cloth->placed, vertices) == 0)
		return;
	memcpy(s->taken_placed, cloth->placed, vertices);
	s->stale = false;
	fill_pads(s);
	take_slots(cloth);
	take_shapes(cloth);
	take_flats(cloth);
	cloth_take_levels(cloth);
}
