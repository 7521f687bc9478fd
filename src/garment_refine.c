/* The refined mesh, made of the base and its depths. */
#include "garment_refine_private.h"

/* ---- depths ---- */

void refiner_balance(const struct refiner *refiner, const struct garment *garment, uint8_t *depth)
{
	for (int e = 0; e < 3 * garment->base_count; e++)
		if (depth[e / 3] == REFINE_DEPTH_MAX && refiner->across[e] >= 0 &&
		    depth[refiner->across[e] / 3] == 0)
			depth[refiner->across[e] / 3] = 1;
}

/* Both steps are done along this edge. */
static bool is_fine(const struct refiner *refiner, int edge)
{
	const uint8_t *depth = refiner->scratch->depth;
	int other = refiner->across[edge];
	if (other == REFINE_KNOT)
		return false;
	return depth[edge / 3] == REFINE_DEPTH_MAX ||
	       (other >= 0 && depth[other / 3] == REFINE_DEPTH_MAX);
}

static bool is_turned(const struct refiner *refiner, int edge)
{
	const uint8_t *depth = refiner->scratch->depth;
	return refiner_inner(refiner, edge) && depth[edge / 3] > 0 &&
	       depth[refiner->across[edge] / 3] > 0;
}

static uint8_t places_of(const struct refiner *refiner, int t)
{
	int places = refiner->scratch->depth[t] > 0 ? 1 << REFINE_CENTRE : 0;
	for (int k = 0; k < 3; k++) {
		if (!is_fine(refiner, 3 * t + k))
			continue;
		places |= 1 << (REFINE_NEAR + k);
		if (!is_turned(refiner, 3 * t + k))
			places |= 1 << (REFINE_FAR + k);
	}
	return (uint8_t)places;
}

/* Vertices before a place. */
static int places_before(int places, int place)
{
	int count = 0;
	for (int p = 0; p < place; p++)
		count += places >> p & 1;
	return count;
}

static int triangles_of(const struct refiner *refiner, int t)
{
	int count = 0;
	if (refiner->scratch->depth[t] == 0)
		return 1;
	for (int k = 0; k < 3; k++) /* along each edge, and at its start */
		count += 1 + is_fine(refiner, 3 * t + k) +
			 is_fine(refiner, previous_edge(3 * t + k));
	return count;
}

/* Takes the depths, if there is room for what they make. */
static bool plan(struct refiner *refiner, const struct garment *garment, const uint8_t *depth)
{
	struct refine_scratch *s = refiner->scratch;
	int vertices = refiner->base_vertices, triangles = 0;
	memcpy(s->depth, depth, (size_t)garment->base_count);
	for (int t = 0; t < garment->base_count; t++) {
		s->places[t] = places_of(refiner, t);
		vertices += places_before(s->places[t], REFINE_PLACES);
		triangles += triangles_of(refiner, t);
	}
	return vertices <= GARMENT_VERTICES_MAX && triangles <= GARMENT_TRIANGLES_MAX;
}

/* ---- vertices ---- */

static int vertex_at(const struct refine_scratch *s, int t, int place)
{
	return s->first[t] + places_before(s->places[t], place);
}

/* The vertex beside an edge towards its start, and towards its end. */
static int near_start(const struct refine_scratch *s, int edge)
{
	return vertex_at(s, edge / 3, REFINE_NEAR + edge % 3);
}

static int near_end(const struct refiner *refiner, int edge)
{
	if (is_turned(refiner, edge))
		return near_start(refiner->scratch, refiner->across[edge]);
	return vertex_at(refiner->scratch, edge / 3, REFINE_FAR + edge % 3);
}

static int centre(const struct refine_scratch *s, int t)
{
	return vertex_at(s, t, REFINE_CENTRE);
}

void refiner_parents(const struct refiner *refiner, const struct garment *garment, int v,
		     int parent[3])
{
	const struct refine_scratch *s = refiner->scratch;
	int t = s->place[v] / REFINE_PLACES, place = s->place[v] % REFINE_PLACES;
	if (place == REFINE_CENTRE) {
		for (int k = 0; k < 3; k++)
			parent[k] = s->to[garment->base[t].v[k]];
		return;
	}
	int edge = 3 * t + (place - REFINE_NEAR) % 3;
	int a = s->to[edge_start(garment, edge)], b = s->to[edge_start(garment, next_edge(edge))];
	bool turned = is_turned(refiner, edge), far = place >= REFINE_FAR;
	parent[0] = far ? b : a;
	parent[1] = turned ? centre(s, t) : a;
	parent[2] = turned ? centre(s, refiner->across[edge] / 3) : b;
}

/* Numbers the vertices of every piece, first its own, then the others by place: both lists are in
 * the same order as before, so that what stays is found by going along. */
static int number_vertices(struct refiner *refiner, struct garment *garment)
{
	struct refine_scratch *s = refiner->scratch;
	int count = 0, b = 0, t = 0, old = 0, old_count = garment->vertex_count;
	for (int p = 0; p < PIECES_MAX; p++) {
		garment->piece_first[p] = count;
		for (; b < refiner->base_vertices && garment->piece[refiner->now[b]] == p; b++) {
			s->place[count] = -1;
			refiner->from[count] = refiner->now[b];
			s->to[b] = count++;
		}
		for (; t < garment->base_count &&
		       garment->piece[refiner->now[garment->base[t].v[0]]] == p;
		     t++) {
			s->first[t] = count;
			for (int place = 0; place < REFINE_PLACES; place++) {
				if (!(s->places[t] >> place & 1))
					continue;
				s->place[count] = REFINE_PLACES * t + place;
				while (old < old_count && garment->place[old] < s->place[count])
					old++;
				bool stays = old < old_count &&
					     garment->place[old] == s->place[count];
				refiner->from[count++] = stays ? old : -1;
			}
		}
	}
	garment->piece_first[PIECES_MAX] = count;
	return count;
}

/* Centres first: the others lie between them. */
static void place_vertices(struct refiner *refiner, const struct garment *garment, int count)
{
	struct refine_scratch *s = refiner->scratch;
	for (int v = 0; v < count; v++)
		if (refiner->from[v] >= 0)
			s->rest_m[v] = garment->rest_m[refiner->from[v]];
	for (int pass = 0; pass < 2; pass++)
		for (int v = 0; v < count; v++) {
			int parent[3];
			if (refiner->from[v] >= 0 ||
			    (s->place[v] % REFINE_PLACES == REFINE_CENTRE) != (pass == 0))
				continue;
			refiner_parents(refiner, garment, v, parent);
			struct v2 sum = v2_add(s->rest_m[parent[0]], s->rest_m[parent[1]]);
			s->rest_m[v] = v2_scale(v2_add(sum, s->rest_m[parent[2]]), 1.0f / 3.0f);
		}
}

/* ---- seams ---- */

/* The seam whose samples two edges across from each other join; -1: none. */
static int seam_of(const struct refiner *refiner, const struct garment *garment, int edge)
{
	int other = refiner->across[edge];
	int a = refiner->now[edge_start(garment, edge)];
	int c = refiner->now[edge_start(garment, other)],
	    d = refiner->now[edge_start(garment, next_edge(other))];
	for (int i = 0; i < garment->pair_count; i++) {
		const struct seam_pair *pair = &garment->pair[i];
		int with = pair->a == a ? pair->b : pair->b == a ? pair->a : -1;
		if (with >= 0 && (with == c || with == d))
			return pair->seam;
	}
	return -1;
}

static void sew_points(struct refiner *refiner, int *pair_count, int seam, int a, int b)
{
	struct refine_scratch *s = refiner->scratch;
	s->weld[int_max(a, b)] = int_min(a, b);
	if (seam >= 0 && *pair_count < SEAM_PAIRS_MAX)
		s->pair[(*pair_count)++] = (struct seam_pair){a, b, seam};
}

/* What was sewn stays so, and so are the points on both sides of a seam's edge. */
static void sew(struct refiner *refiner, struct garment *garment, int count)
{
	struct refine_scratch *s = refiner->scratch;
	int pairs = 0;
	for (int v = 0; v < count; v++)
		s->weld[v] = v;
	for (int b = 0; b < refiner->base_vertices; b++)
		s->weld[s->to[b]] = s->to[s->base_of[garment->weld[refiner->now[b]]]];
	for (int i = 0; i < garment->pair_count; i++) {
		struct seam_pair pair = garment->pair[i];
		if (s->base_of[pair.a] >= 0)
			s->pair[pairs++] = (struct seam_pair){s->to[s->base_of[pair.a]],
							      s->to[s->base_of[pair.b]], pair.seam};
	}
	for (int e = 0; e < 3 * garment->base_count; e++) {
		int other = refiner->across[e];
		if (other < e || !is_fine(refiner, e) || is_turned(refiner, e))
			continue;
		bool along = edge_start_welded(refiner, garment, e) ==
			     edge_start_welded(refiner, garment, other);
		int seam = seam_of(refiner, garment, e);
		int at_start = near_start(s, other), at_end = near_end(refiner, other);
		sew_points(refiner, &pairs, seam, near_start(s, e), along ? at_start : at_end);
		sew_points(refiner, &pairs, seam, near_end(refiner, e), along ? at_end : at_start);
	}
	garment->pair_count = pairs;
	memcpy(garment->pair, s->pair, (size_t)pairs * sizeof *garment->pair);
}

/* ---- triangles ---- */

static void put_triangle(struct garment *garment, int piece, int a, int b, int c)
{
	int t = garment->triangle_count++;
	garment->triangle[t] = (struct triangle){{a, b, c}};
	garment->triangle_piece[t] = piece;
}

/* Where an edge is fine, the triangles on it have a vertex each; an edge between two such triangles
 * is turned too, here the one from the centre to the start of the edge. */
static void put_corner(const struct refiner *refiner, struct garment *garment, int piece, int edge)
{
	const struct refine_scratch *s = refiner->scratch;
	int v = s->to[edge_start(garment, edge)], c = centre(s, edge / 3),
	    before = previous_edge(edge);
	bool fine = is_fine(refiner, edge), fine_before = is_fine(refiner, before);
	int a = fine ? near_start(s, edge) : -1;
	int b = fine_before ? near_end(refiner, before) : -1;
	if (fine && fine_before) {
		put_triangle(garment, piece, v, a, b);
		put_triangle(garment, piece, c, b, a);
	} else if (fine) {
		put_triangle(garment, piece, c, v, a);
	} else if (fine_before) {
		put_triangle(garment, piece, v, c, b);
	}
}

static void put_edge(const struct refiner *refiner, struct garment *garment, int piece, int edge)
{
	const struct refine_scratch *s = refiner->scratch;
	int v = s->to[edge_start(garment, edge)], c = centre(s, edge / 3);
	if (is_fine(refiner, edge))
		put_triangle(garment, piece, c, near_start(s, edge), near_end(refiner, edge));
	else if (is_turned(refiner, edge))
		put_triangle(garment, piece, v, centre(s, refiner->across[edge] / 3), c);
	else
		put_triangle(garment, piece, c, v, s->to[edge_start(garment, next_edge(edge))]);
}

static void put_triangles(const struct refiner *refiner, struct garment *garment)
{
	const struct refine_scratch *s = refiner->scratch;
	int t = 0;
	garment->triangle_count = 0;
	for (int p = 0; p < PIECES_MAX; p++) {
		garment->piece_first_triangle[p] = garment->triangle_count;
		for (; t < garment->base_count &&
		       garment->piece[refiner->now[garment->base[t].v[0]]] == p;
		     t++) {
			const int *v = garment->base[t].v;
			if (s->depth[t] == 0)
				put_triangle(garment, p, s->to[v[0]], s->to[v[1]], s->to[v[2]]);
			for (int k = 0; s->depth[t] > 0 && k < 3; k++) {
				put_edge(refiner, garment, p, 3 * t + k);
				put_corner(refiner, garment, p, 3 * t + k);
			}
		}
	}
	garment->piece_first_triangle[PIECES_MAX] = garment->triangle_count;
}

/* ---- the change ---- */

/* The old numbers are needed until here. */
static void take(struct refiner *refiner, struct garment *garment, int count)
{
	const struct refine_scratch *s = refiner->scratch;
	garment->vertex_count = count;
	for (int p = 0; p < PIECES_MAX; p++)
		for (int v = garment->piece_first[p]; v < garment->piece_first[p + 1]; v++)
			garment->piece[v] = p;
	memcpy(garment->rest_m, s->rest_m, (size_t)count * sizeof *s->rest_m);
	memcpy(garment->weld, s->weld, (size_t)count * sizeof *s->weld);
	memcpy(garment->place, s->place, (size_t)count * sizeof *s->place);
	memcpy(garment->depth, s->depth, (size_t)garment->base_count);
	memcpy(refiner->now, s->to, (size_t)refiner->base_vertices * sizeof *s->to);
}

bool garment_refine(struct refiner *refiner, struct garment *garment, const uint8_t *depth)
{
	if (!plan(refiner, garment, depth))
		return false;
	int count = number_vertices(refiner, garment);
	place_vertices(refiner, garment, count);
	sew(refiner, garment, count);
	put_triangles(refiner, garment);
	take(refiner, garment, count);
	return true;
}
