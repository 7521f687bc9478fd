/* The mesh as it was made, and what meets at its edges. */
#include "garment_refine_private.h"

void refiner_init(struct refiner *refiner, struct arena *arena)
{
	struct refine_scratch *s = ARENA_ARRAY(arena, struct refine_scratch, 1);
	refiner->now = ARENA_ARRAY(arena, int, GARMENT_VERTICES_MAX);
	refiner->across = ARENA_ARRAY(arena, int, 3 * GARMENT_TRIANGLES_MAX);
	refiner->inner = ARENA_ARRAY(arena, uint8_t, GARMENT_TRIANGLES_MAX);
	refiner->from = ARENA_ARRAY(arena, int, GARMENT_VERTICES_MAX);
	s->base_of = ARENA_ARRAY(arena, int, GARMENT_VERTICES_MAX);
	s->edge_first = ARENA_ARRAY(arena, int, GARMENT_VERTICES_MAX + 2);
	s->edge = ARENA_ARRAY(arena, int, 3 * GARMENT_TRIANGLES_MAX);
	s->depth = ARENA_ARRAY(arena, uint8_t, GARMENT_TRIANGLES_MAX);
	s->places = ARENA_ARRAY(arena, uint8_t, GARMENT_TRIANGLES_MAX);
	s->first = ARENA_ARRAY(arena, int, GARMENT_TRIANGLES_MAX);
	s->to = ARENA_ARRAY(arena, int, GARMENT_VERTICES_MAX);
	s->place = ARENA_ARRAY(arena, int, GARMENT_VERTICES_MAX);
	s->weld = ARENA_ARRAY(arena, int, GARMENT_VERTICES_MAX);
	s->rest_m = ARENA_ARRAY(arena, struct v2, GARMENT_VERTICES_MAX);
	s->pair = ARENA_ARRAY(arena, struct seam_pair, SEAM_PAIRS_MAX);
	refiner->scratch = s;
}

static void sort_edges(struct refiner *refiner, const struct garment *garment)
{
	struct refine_scratch *s = refiner->scratch;
	int edges = 3 * garment->base_count;
	memset(s->edge_first, 0, (size_t)(garment->vertex_count + 2) * sizeof *s->edge_first);
	for (int pass = 0; pass < 2; pass++) {
		for (int e = 0; e < edges; e++) {
			int low = int_min(edge_start_welded(refiner, garment, e),
					  edge_start_welded(refiner, garment, next_edge(e)));
			if (pass == 0)
				s->edge_first[low + 2]++;
			else
				s->edge[s->edge_first[low + 1]++] = e;
		}
		for (int v = 0; pass == 0 && v < garment->vertex_count; v++)
			s->edge_first[v + 2] += s->edge_first[v + 1];
	}
}

/* The one other triangle's edge between the same two welded vertices. */
static int find_across(const struct refiner *refiner, const struct garment *garment, int edge)
{
	const struct refine_scratch *s = refiner->scratch;
	int a = edge_start_welded(refiner, garment, edge);
	int b = edge_start_welded(refiner, garment, next_edge(edge)), low = int_min(a, b);
	int across = a == b ? REFINE_KNOT : REFINE_RIM;
	for (int i = s->edge_first[low]; i < s->edge_first[low + 1]; i++) {
		int other = s->edge[i], c = edge_start_welded(refiner, garment, other);
		int d = edge_start_welded(refiner, garment, next_edge(other));
		if (other != edge && int_min(c, d) == low && int_max(c, d) == int_max(a, b))
			across = across == REFINE_RIM ? other : REFINE_KNOT;
	}
	return across;
}

static struct v2 flat_centre(const struct refiner *refiner, const struct garment *garment, int t)
{
	struct v2 sum = {0.0f, 0.0f};
	for (int k = 0; k < 3; k++)
		sum = v2_add(sum, garment->rest_m[refiner->now[garment->base[t].v[k]]]);
	return v2_scale(sum, 1.0f / 3.0f);
}

/* Two triangles of one piece meet here, and the line between their centres passes between the
 * edge's ends. (Beside a very sharp corner it may not.) */
static bool can_turn(const struct refiner *refiner, const struct garment *garment, int edge)
{
	int other = refiner->across[edge];
	if (other < 0 || edge_start(garment, edge) != edge_start(garment, next_edge(other)) ||
	    edge_start(garment, next_edge(edge)) != edge_start(garment, other))
		return false;
	int first = int_min(edge, other), second = int_max(edge, other);
	struct v2 a = garment->rest_m[refiner->now[edge_start(garment, first)]];
	struct v2 b = garment->rest_m[refiner->now[edge_start(garment, second)]];
	struct v2 c = flat_centre(refiner, garment, first / 3);
	struct v2 along = v2_sub(c, flat_centre(refiner, garment, second / 3));
	return v2_cross(along, v2_sub(a, c)) > 0.0f && v2_cross(along, v2_sub(b, c)) < 0.0f;
}

void refiner_look(struct refiner *refiner, struct garment *garment)
{
	struct refine_scratch *s = refiner->scratch;
	if (garment->base_count == 0) {
		garment->base_count = garment->triangle_count;
		memcpy(garment->base, garment->triangle,
		       (size_t)garment->triangle_count * sizeof *garment->base);
		memset(garment->depth, 0, (size_t)garment->triangle_count);
		for (int v = 0; v < garment->vertex_count; v++)
			garment->place[v] = -1;
	}
	refiner->base_vertices = 0;
	for (int v = 0; v < garment->vertex_count; v++) {
		s->base_of[v] = garment->place[v] < 0 ? refiner->base_vertices : -1;
		if (garment->place[v] < 0)
			refiner->now[refiner->base_vertices++] = v;
	}
	sort_edges(refiner, garment);
	for (int e = 0; e < 3 * garment->base_count; e++)
		refiner->across[e] = find_across(refiner, garment, e);
	memset(refiner->inner, 0, (size_t)garment->base_count);
	for (int e = 0; e < 3 * garment->base_count; e++)
		if (can_turn(refiner, garment, e))
			refiner->inner[e / 3] |= (uint8_t)(1 << e % 3);
}

void refiner_close(struct garment *garment)
{
	bool refined = false;
	for (int t = 0; t < garment->base_count; t++)
		refined |= garment->depth[t] > 0;
	if (!refined)
		garment->base_count = 0;
}
