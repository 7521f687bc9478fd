/* The order in which the solver works: particles by neighbourhood, constraints by colour. */
#include "cloth_private.h"

/* Particles of a strip. Less work is done sooner than handed on, and narrow strips fill their
 * batches badly. */
enum { STRIP_LEAST = 1200 };

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
			for (int i = 2 * cloth->star_first[v]; i < 2 * cloth->star_first[v + 1];
			     i++) {
				int w = cloth->ring[i];
				if (s->rank[w] >= 0)
					continue;
				s->ranked[count] = w;
				s->rank[w] = count++;
			}
		}
	}
	s->ranked_count = count;
}

/* Constraints of a kind: `arity` particles each, `stride` ints apart. */
struct list {
	const int *corner;
	int arity, stride, count;
};

struct span {
	int low, high; /* ranks */
};

static struct span span_of(const struct cloth_scratch *s, const struct list *list, int i)
{
	const int *v = list->corner + (size_t)i * (size_t)list->stride;
	struct span span = {s->rank[v[0]], s->rank[v[0]]};
	for (int k = 1; k < list->arity; k++) {
		span.low = int_min(span.low, s->rank[v[k]]);
		span.high = int_max(span.high, s->rank[v[k]]);
	}
	return span;
}

/* ---- strips ----
 *
 * Ranks in a row are a strip of the cloth, as long as its neighbourhoods. The cloth is cut into
 * strips at least twice as wide as any constraint reaches: a constraint either lies in one strip or
 * crosses one cut and ends within the halves beside it. So all strips may be worked at the same
 * time, and after them all cuts, whoever works them, and the bits are the same. What a strip needs
 * also stays near the processor meanwhile. How many there are is a matter of the mesh alone. */

static int reach_of(const struct cloth_scratch *s, const struct list *list)
{
	int reach = 1;
	for (int i = 0; i < list->count; i++) {
		struct span span = span_of(s, list, i);
		reach = int_max(reach, span.high - span.low);
	}
	return reach;
}

/* Four strips are shared out evenly among one, two or four. */
static int strips_for(int ranks, int reach)
{
	int strips = int_min(ranks / (2 * reach), ranks / STRIP_LEAST);
	strips = int_clamp(strips, 1, STRIPS_MAX);
	return strips >= 4 ? strips / 4 * 4 : strips >= 2 ? 2 : 1;
}

/* Its strip or, behind the strips, its cut. */
static int group_of(const struct cloth_scratch *s, const struct list *list, int i)
{
	struct span span = span_of(s, list, i);
	int low = span.low * 2 * s->strip_count / s->ranked_count;
	int high = span.high * 2 * s->strip_count / s->ranked_count;
	if (low / 2 == high / 2)
		return low / 2;
	MUST(high == low + 1);
	return s->strip_count + low / 2;
}

/* ---- colours ---- */

/* Counting sort of the constraints by the lowest rank of their particles, into s->sorted. */
static void sort_by_rank(struct cloth *cloth, const struct list *list)
{
	struct cloth_scratch *s = cloth->scratch;
	int *first = s->edge_first, ranks = s->ranked_count;
	memset(first, 0, (size_t)(ranks + 1) * sizeof *first);
	for (int i = 0; i < list->count; i++)
		first[span_of(s, list, i).low + 1]++;
	for (int r = 0; r < ranks; r++)
		first[r + 1] += first[r];
	for (int i = 0; i < list->count; i++)
		s->sorted[first[span_of(s, list, i).low]++] = i;
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

/* Two constraints of a group and a colour share no particle (but in the last). Strips share none
 * either, nor do cuts, so that all strips are coloured at once and then all cuts. */
static void colour(struct cloth *cloth, const struct list *list, bool cuts)
{
	struct cloth_scratch *s = cloth->scratch;
	memset(s->taken, 0, (size_t)cloth->garment->vertex_count * sizeof *s->taken);
	for (int i = 0; i < list->count; i++) {
		int group = group_of(s, list, s->sorted[i]);
		const int *v = list->corner + (size_t)s->sorted[i] * (size_t)list->stride;
		if ((group >= s->strip_count) != cuts)
			continue;
		int colour = take_colour(s->taken, v, list->arity);
		s->key[i] = (uint16_t)(COLOURS * group + colour);
	}
}

static void put_in_order(struct cloth *cloth, const struct list *list, struct order *order)
{
	struct cloth_scratch *s = cloth->scratch;
	int keys = GROUPS_MAX * COLOURS, place[GROUPS_MAX * COLOURS];
	sort_by_rank(cloth, list);
	colour(cloth, list, false);
	colour(cloth, list, true);
	memset(order->first, 0, sizeof order->first);
	for (int i = 0; i < list->count; i++)
		order->first[s->key[i] + 1]++;
	for (int key = 0; key < keys; key++) {
		place[key] = order->first[key];
		order->first[key + 1] += order->first[key];
	}
	for (int i = 0; i < list->count; i++)
		order->item[place[s->key[i]]++] = s->sorted[i];
}

/* Triangles by group, for whatever is done to each of them once. */
static void put_faces(struct cloth_scratch *s, const struct list *triangles)
{
	int *first = s->face_first;
	memset(first, 0, sizeof s->face_first);
	for (int t = 0; t < triangles->count; t++)
		first[group_of(s, triangles, t) + 1]++;
	for (int g = 0; g < GROUPS_MAX; g++)
		first[g + 1] += first[g];
	int place[GROUPS_MAX];
	memcpy(place, first, sizeof place);
	for (int t = 0; t < triangles->count; t++)
		s->face[place[group_of(s, triangles, t)]++] = t;
}

void cloth_order(struct cloth *cloth)
{
	struct cloth_scratch *s = cloth->scratch;
	rank_particles(cloth);
	struct list triangles = {cloth->triangle[0].v, 3, 3, cloth->garment->triangle_count};
	struct list flats = {cloth->flat[0].v, 4, sizeof(struct flat) / sizeof(int),
			     cloth->flat_count};
	s->strip_count = strips_for(s->ranked_count,
				    int_max(reach_of(s, &triangles), reach_of(s, &flats)));
	put_in_order(cloth, &triangles, &s->triangles);
	put_in_order(cloth, &flats, &s->flats);
	put_faces(s, &triangles);
	s->stale = true;
}

/* ---- whenever cloth is placed ---- */

/* Every strip's pads are unit triangles: the kernels may work on them, nobody reads them. */
static void fill_pads(struct cloth_scratch *s)
{
	for (int i = 0; i < SLOT_FIRST; i++) {
		int corner = i % PADS / BATCH;
		s->place[i] = (struct place){(float)(corner == 1), (float)(corner == 2), 0.0f,
					     0.0f};
	}
}

static void take_slots(struct cloth *cloth)
{
	struct cloth_scratch *s = cloth->scratch;
	s->slot_count = SLOT_FIRST;
	for (int v = 0; v < cloth->garment->vertex_count; v++)
		s->slot[v] = -1;
	for (int r = 0; r < s->ranked_count; r++) {
		int v = s->ranked[r];
		if (!cloth->placed[v])
			continue;
		s->slot_vertex[s->slot_count] = v;
		s->slot[v] = s->slot_count++;
	}
	s->all_placed = s->slot_count - SLOT_FIRST == s->ranked_count;
	for (int v = 0; v < cloth->garment->vertex_count; v++) {
		s->at[v] = s->slot[v] < 0 ? PLACE_NONE : place_offset(s->slot[v]);
		s->slot[v] = s->slot[cloth->particle[v]];
	}
	for (int first = 0; first < cloth->garment->vertex_count; first += BATCH) {
		s->whole[first / BATCH] = first + BATCH <= cloth->garment->vertex_count;
		for (int v = first; v < first + BATCH; v++)
			s->whole[first / BATCH] &= s->at[v] != PLACE_NONE;
	}
}

static void put_shape(struct cloth_scratch *s, int at, int lane, const struct rest *rest,
		      const int corner[3])
{
	for (int k = 0; k < 3; k++) {
		s->shape[at].at[k][lane] = place_offset(corner[k]);
		s->shape[at].metric[k][lane] = rest->metric[k];
		s->grain[at].grain[k][lane] = rest->grain[k];
	}
}

/* All of a batch's lanes become pads of strip `strip`. */
static void open_shape(struct cloth_scratch *s, int at, int strip)
{
	static const struct rest unit = {{1.0f, 0.0f, 1.0f}, {0.0f, 1.0f, 0.0f}};
	int pad = PADS * strip;
	for (int lane = 0; lane < BATCH; lane++)
		put_shape(s, at, lane, &unit,
			  (int[3]){pad + lane, pad + BATCH + lane, pad + 2 * BATCH + lane});
}

/* A group's triangles of one colour, or singly those of the last, into batches from s->shape[at]
 * on. Returns behind which. */
static int take_colour_shapes(struct cloth *cloth, int key, int at)
{
	struct cloth_scratch *s = cloth->scratch;
	int lane = BATCH, strip = key / COLOURS % s->strip_count;
	bool singly = key % COLOURS == COLOURS - 1;
	for (int i = s->triangles.first[key]; i < s->triangles.first[key + 1]; i++) {
		int t = s->triangles.item[i];
		const int *v = cloth->triangle[t].v;
		if (!triangle_placed(cloth, t))
			continue;
		if ((lane == BATCH || singly) && at < SHAPE_BATCHES_MAX) {
			open_shape(s, at++, strip);
			lane = 0;
		}
		if (lane < BATCH)
			put_shape(s, at - 1, lane++, &s->rest[t],
				  (int[3]){s->slot[v[0]], s->slot[v[1]], s->slot[v[2]]});
	}
	return at;
}

static void take_shapes(struct cloth *cloth)
{
	struct cloth_scratch *s = cloth->scratch;
	for (int g = 0, at = 0; g <= GROUPS_MAX; g++) {
		s->shape_first[g] = at;
		for (int c = 0; g < GROUPS_MAX && c < COLOURS; c++)
			at = take_colour_shapes(cloth, COLOURS * g + c, at);
	}
}

static bool bend_placed(const struct cloth_scratch *s, const struct flat *flat)
{
	const int *v = flat->v;
	return s->slot[v[0]] >= 0 && s->slot[v[1]] >= 0 && s->slot[v[2]] >= 0 && s->slot[v[3]] >= 0;
}

static void put_bend(struct cloth_scratch *s, int at, int edge, const struct flat *flat)
{
	bool firm = s->stiff[flat->v[0]] && s->stiff[flat->v[1]];
	for (int k = 0; k < 4; k++) {
		s->bends[at].at[edge][k] = place_offset(s->slot[flat->v[k]]);
		s->bends[at].k[edge][k] = flat->k[k];
	}
	s->firm[at].share[edge] = firm ? FIRM_SHARE : 0.0f;
	s->any_firm |= firm;
	s->bend_count++;
}

/* Edges of strip `strip`'s pads, which rest. */
static void open_bends(struct cloth_scratch *s, int at, int strip)
{
	for (int edge = 0; edge < BENDS; edge++)
		for (int k = 0; k < 4; k++) {
			s->bends[at].at[edge][k] = place_offset(PADS * strip + 4 * edge + k);
			s->bends[at].k[edge][k] = s->firm[at].share[edge] = 0.0f;
		}
}

/* As take_colour_shapes. */
static int take_colour_bends(struct cloth *cloth, int key, int at)
{
	struct cloth_scratch *s = cloth->scratch;
	int edge = BENDS, strip = key / COLOURS % s->strip_count;
	bool singly = key % COLOURS == COLOURS - 1;
	for (int i = s->flats.first[key]; i < s->flats.first[key + 1]; i++) {
		const struct flat *flat = &cloth->flat[s->flats.item[i]];
		if (!bend_placed(s, flat))
			continue;
		if ((edge == BENDS || singly) && at < BENDS_MAX) {
			open_bends(s, at++, strip);
			edge = 0;
		}
		if (edge < BENDS)
			put_bend(s, at - 1, edge++, flat);
	}
	return at;
}

static void take_bends(struct cloth *cloth)
{
	struct cloth_scratch *s = cloth->scratch;
	s->any_firm = false;
	s->bend_count = 0;
	for (int g = 0, at = 0; g <= GROUPS_MAX; g++) {
		s->bends_first[g] = at;
		for (int c = 0; g < GROUPS_MAX && c < COLOURS; c++)
			at = take_colour_bends(cloth, COLOURS * g + c, at);
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
	take_bends(cloth);
	cloth_take_levels(cloth);
}
