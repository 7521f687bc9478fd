/* Constrained Delaunay triangulation with exact predicates: insertion by splitting and flipping
 * (Lawson 1977), edges forced in by flipping what crosses them (Sloan 1993). */
#include "garment_private.h"

void mesh_init(struct mesh *mesh, struct arena *arena)
{
	mesh->point = ARENA_ARRAY(arena, struct grid_point, MESH_POINTS_MAX);
	mesh->leaving = ARENA_ARRAY(arena, int, MESH_POINTS_MAX);
	mesh->origin = ARENA_ARRAY(arena, int, MESH_HALVES_MAX);
	mesh->twin = ARENA_ARRAY(arena, int, MESH_HALVES_MAX);
	mesh->fixed = ARENA_ARRAY(arena, uint8_t, MESH_HALVES_MAX);
	mesh->queued = ARENA_ARRAY(arena, uint8_t, MESH_HALVES_MAX);
	mesh->inside = ARENA_ARRAY(arena, uint8_t, MESH_HALVES_MAX / 3);
	mesh->stack = ARENA_ARRAY(arena, int, MESH_HALVES_MAX);
	mesh->crossed = ARENA_ARRAY(arena, int, 2 * MESH_CROSSED_MAX);
}

static int add_triangle(struct mesh *mesh, int a, int b, int c, uint8_t inside)
{
	int half = mesh->half_count;
	MUST(half + 3 <= MESH_HALVES_MAX);
	mesh->half_count += 3;
	mesh->origin[half] = a;
	mesh->origin[half + 1] = b;
	mesh->origin[half + 2] = c;
	for (int k = half; k < half + 3; k++) {
		mesh->twin[k] = -1;
		mesh->fixed[k] = 0;
		mesh->queued[k] = 0;
	}
	mesh->inside[half / 3] = inside;
	return half;
}

static void link_halves(struct mesh *mesh, int a, int b)
{
	mesh->twin[a] = b;
	if (b >= 0)
		mesh->twin[b] = a;
}

void mesh_reset(struct mesh *mesh, struct grid_point low, struct grid_point high)
{
	int32_t x = low.x + (high.x - low.x) / 2, y = low.y + (high.y - low.y) / 2;
	int32_t r = 1 << 24; /* 16 m: a piece reaches 10 m from its origin */
	mesh->point[0] = (struct grid_point){x - 3 * r, y - r};
	mesh->point[1] = (struct grid_point){x + 3 * r, y - r};
	mesh->point[2] = (struct grid_point){x, y + 3 * r};
	mesh->point_count = MESH_FRAME_POINTS;
	mesh->half_count = 0;
	mesh->stack_count = 0;
	mesh->last = add_triangle(mesh, 0, 1, 2, 0);
	for (int i = 0; i < MESH_FRAME_POINTS; i++)
		mesh->leaving[i] = i;
}

static struct grid_point point_at(const struct mesh *mesh, int half)
{
	return mesh->point[mesh->origin[half]];
}

/* Which side of half-edge `half` p lies on: positive inside its triangle. */
static int64_t side_of(const struct mesh *mesh, int half, struct grid_point p)
{
	return grid_orient(point_at(mesh, half), point_at(mesh, mesh_next(half)), p);
}

/* Only reached when a walk went in circles, which fixed edges allow in theory. */
static int locate_slowly(const struct mesh *mesh, struct grid_point p, long *units)
{
	for (int half = 0; half < mesh->half_count; half += 3) {
		*units += 1;
		if (side_of(mesh, half, p) >= 0 && side_of(mesh, half + 1, p) >= 0 &&
		    side_of(mesh, half + 2, p) >= 0)
			return half;
	}
	must_fail("a point outside the triangle around everything", __FILE__, __LINE__);
}

int mesh_locate(const struct mesh *mesh, struct grid_point p, int start, long *units)
{
	int half = start - start % 3, from = -1;
	for (int step = 0; step < mesh->half_count; step++) {
		*units += 1;
		int out = -1;
		for (int k = half; k < half + 3 && out < 0; k++)
			if (k != from && side_of(mesh, k, p) < 0)
				out = k;
		if (out < 0)
			return half;
		MUST(mesh->twin[out] >= 0);
		from = mesh->twin[out];
		half = from - from % 3;
	}
	return locate_slowly(mesh, p, units);
}

/* Turns the diagonal of the two triangles at `p` (a -> b, corners c and d) from a b to d c:
 *
 *        c                 c
 *       /p\               /|\
 *      a---b     -->     a | b
 *       \P/               \|/
 *        d                 d
 */
static void flip(struct mesh *mesh, int p)
{
	int q = mesh_next(p), r = mesh_next(q);
	int pp = mesh->twin[p], qq = mesh_next(pp), rr = mesh_next(qq);
	int a = mesh->origin[p], b = mesh->origin[q], c = mesh->origin[r], d = mesh->origin[rr];
	int beyond_q = mesh->twin[q], beyond_qq = mesh->twin[qq];
	mesh->origin[q] = d;
	mesh->origin[qq] = c;
	link_halves(mesh, p, beyond_qq);
	link_halves(mesh, pp, beyond_q);
	link_halves(mesh, q, qq);
	mesh->fixed[p] = mesh->fixed[qq];
	mesh->fixed[pp] = mesh->fixed[q];
	mesh->fixed[q] = mesh->fixed[qq] = 0;
	mesh->leaving[a] = p;
	mesh->leaving[b] = pp;
	mesh->leaving[c] = qq;
	mesh->leaving[d] = q;
}

static bool should_flip(const struct mesh *mesh, int half)
{
	int twin = mesh->twin[half];
	if (twin < 0 || mesh->fixed[half])
		return false;
	return grid_in_circle(point_at(mesh, half), point_at(mesh, mesh_next(half)),
			      point_at(mesh, mesh_previous(half)),
			      point_at(mesh, mesh_previous(twin)));
}

void mesh_push(struct mesh *mesh, int half)
{
	if (mesh->queued[half])
		return;
	mesh->queued[half] = 1;
	mesh->stack[mesh->stack_count++] = half;
}

void mesh_legalize(struct mesh *mesh, long *units)
{
	while (mesh->stack_count > 0) {
		int half = mesh->stack[--mesh->stack_count];
		mesh->queued[half] = 0;
		*units += 1;
		if (!should_flip(mesh, half))
			continue;
		int twin = mesh->twin[half];
		flip(mesh, half);
		mesh_push(mesh, half);
		mesh_push(mesh, mesh_previous(half));
		mesh_push(mesh, twin);
		mesh_push(mesh, mesh_previous(twin));
	}
}

/* The same after inserting the apex of the pushed half-edges: only edges opposite to it can have
 * become wrong. */
static void legalize_around(struct mesh *mesh, long *units)
{
	while (mesh->stack_count > 0) {
		int half = mesh->stack[--mesh->stack_count];
		mesh->queued[half] = 0;
		*units += 1;
		if (!should_flip(mesh, half))
			continue;
		int twin = mesh->twin[half];
		flip(mesh, half);
		mesh_push(mesh, half);
		mesh_push(mesh, mesh_previous(twin));
	}
}

/* a b c with v inside becomes a b v, b c v, c a v. */
static void split_triangle(struct mesh *mesh, int half, int v)
{
	int ab = half, bc = half + 1, ca = half + 2;
	int b = mesh->origin[bc], c = mesh->origin[ca], a = mesh->origin[ab];
	int beyond_bc = mesh->twin[bc], beyond_ca = mesh->twin[ca];
	uint8_t fixed_bc = mesh->fixed[bc], fixed_ca = mesh->fixed[ca];
	uint8_t inside = mesh->inside[half / 3];
	int second = add_triangle(mesh, b, c, v, inside);
	int third = add_triangle(mesh, c, a, v, inside);
	mesh->origin[ca] = v;
	link_halves(mesh, second, beyond_bc);
	link_halves(mesh, third, beyond_ca);
	mesh->fixed[second] = fixed_bc;
	mesh->fixed[third] = fixed_ca;
	mesh->fixed[bc] = mesh->fixed[ca] = 0;
	link_halves(mesh, bc, second + 2);
	link_halves(mesh, second + 1, third + 2);
	link_halves(mesh, third + 1, ca);
	mesh->leaving[v] = ca;
	mesh->leaving[a] = ab;
	mesh->leaving[b] = second;
	mesh->leaving[c] = third;
	mesh_push(mesh, ab);
	mesh_push(mesh, second);
	mesh_push(mesh, third);
}

/* v on the edge a b of a b c and b a d: four triangles around v. */
static void split_edge(struct mesh *mesh, int ab, int v)
{
	int bc = mesh_next(ab), ca = mesh_next(bc), ba = mesh->twin[ab];
	MUST(ba >= 0 && !mesh->fixed[ab]);
	int ad = mesh_next(ba), db = mesh_next(ad);
	int a = mesh->origin[ab], b = mesh->origin[bc];
	int c = mesh->origin[ca], d = mesh->origin[db];
	int beyond_bc = mesh->twin[bc], beyond_db = mesh->twin[db];
	uint8_t fixed_bc = mesh->fixed[bc], fixed_db = mesh->fixed[db];
	int bcv = add_triangle(mesh, b, c, v, mesh->inside[ab / 3]);
	int dbv = add_triangle(mesh, d, b, v, mesh->inside[ba / 3]);
	mesh->origin[bc] = v; /* a v c */
	mesh->origin[ba] = v; /* v a d */
	link_halves(mesh, bcv, beyond_bc);
	link_halves(mesh, dbv, beyond_db);
	mesh->fixed[bcv] = fixed_bc;
	mesh->fixed[dbv] = fixed_db;
	mesh->fixed[bc] = mesh->fixed[db] = 0;
	link_halves(mesh, ab, ba);
	link_halves(mesh, bc, bcv + 1);
	link_halves(mesh, db, dbv + 2);
	link_halves(mesh, bcv + 2, dbv + 1);
	mesh->leaving[v] = bc;
	mesh->leaving[a] = ab;
	mesh->leaving[b] = bcv;
	mesh->leaving[c] = ca;
	mesh->leaving[d] = dbv;
	mesh_push(mesh, ca);
	mesh_push(mesh, bcv);
	mesh_push(mesh, ad);
	mesh_push(mesh, dbv);
}

/* Splits the triangle of `half`, or the edge of it that v lies on. */
static void split_at(struct mesh *mesh, int half, int v, long *units)
{
	struct grid_point p = mesh->point[v];
	int on = -1;
	for (int k = half; k < half + 3; k++) {
		MUST(!grid_same(point_at(mesh, k), p));
		if (side_of(mesh, k, p) == 0)
			on = k;
	}
	if (on >= 0)
		split_edge(mesh, on, v);
	else
		split_triangle(mesh, half, v);
	legalize_around(mesh, units);
	mesh->last = mesh->leaving[v];
}

bool mesh_add(struct mesh *mesh, struct grid_point p, int start, long *units)
{
	int half = mesh_locate(mesh, p, start, units);
	for (int k = half; k < half + 3; k++)
		if (grid_same(point_at(mesh, k), p) || (mesh->fixed[k] && side_of(mesh, k, p) == 0))
			return false;
	MUST(mesh->point_count < MESH_POINTS_MAX);
	mesh->point[mesh->point_count] = p;
	split_at(mesh, half, mesh->point_count++, units);
	return true;
}

void mesh_join(struct mesh *mesh, int v, int start, long *units)
{
	split_at(mesh, mesh_locate(mesh, mesh->point[v], start, units), v, units);
}

/* The half-edge from a to b, or -1. */
static int find_half(const struct mesh *mesh, int a, int b)
{
	int half = mesh->leaving[a];
	for (int k = 0; k < mesh->half_count; k++) {
		if (mesh->origin[mesh_next(half)] == b)
			return half;
		half = mesh->twin[mesh_previous(half)];
		if (half < 0 || half == mesh->leaving[a])
			return -1;
	}
	return -1;
}

/* The half-edge opposite a that the segment a b leaves a's star through. Boundary points lie inside
 * the frame, so that their stars are closed. */
static int first_crossed(const struct mesh *mesh, int a, int b)
{
	struct grid_point pa = mesh->point[a], pb = mesh->point[b];
	int half = mesh->leaving[a];
	for (int k = 0; k < mesh->half_count; k++) {
		int across = mesh_next(half);
		if (grid_orient(pa, pb, point_at(mesh, across)) < 0 &&
		    grid_orient(pa, pb, point_at(mesh, mesh_next(across))) > 0)
			return across;
		half = mesh->twin[mesh_previous(half)];
		MUST(half >= 0 && half != mesh->leaving[a]);
	}
	must_fail("a star without end", __FILE__, __LINE__);
}

/* Every edge that a b crosses, in order, as pairs of points from right to left. */
static int collect_crossed(struct mesh *mesh, int a, int b, long *units)
{
	int across = first_crossed(mesh, a, b);
	for (int count = 1; count <= MESH_CROSSED_MAX; count++) {
		MUST(!mesh->fixed[across]);
		mesh->crossed[2 * count - 2] = mesh->origin[across];
		mesh->crossed[2 * count - 1] = mesh->origin[mesh_next(across)];
		*units += 1;
		int twin = mesh->twin[across];
		int apex = mesh->origin[mesh_previous(twin)];
		if (apex == b)
			return count;
		int64_t side = grid_orient(mesh->point[a], mesh->point[b], mesh->point[apex]);
		MUST(side != 0);
		across = side < 0 ? mesh_previous(twin) : mesh_next(twin);
	}
	must_fail("a segment that crosses more edges than there are", __FILE__, __LINE__);
}

static bool strictly_convex(const struct mesh *mesh, int half)
{
	struct grid_point a = point_at(mesh, half), b = point_at(mesh, mesh_next(half));
	struct grid_point c = point_at(mesh, mesh_previous(half));
	struct grid_point d = point_at(mesh, mesh_previous(mesh->twin[half]));
	return grid_orient(d, c, a) > 0 && grid_orient(d, c, b) < 0;
}

static bool crosses(const struct mesh *mesh, int a, int b, int c, int d)
{
	if (c == a || c == b || d == a || d == b)
		return false;
	struct grid_point pa = mesh->point[a], pb = mesh->point[b];
	return (grid_orient(pa, pb, mesh->point[c]) > 0) !=
	       (grid_orient(pa, pb, mesh->point[d]) > 0);
}

/* Turns the crossing edges round and round until none crosses a b any more. An edge that can't turn
 * yet (its quadrilateral is not convex) waits for its neighbours; one always can (Sloan 1993). The
 * list keeps the final edges, for the Delaunay property to be restored. */
static void flip_crossed(struct mesh *mesh, int a, int b, int count, long *units)
{
	int open = count;
	long tries = 0;
	for (int k = 0; open > 0; k = k + 1 < count ? k + 1 : 0, tries++) {
		MUST(tries <= 4L * count * count);
		int *pair = &mesh->crossed[2 * k];
		*units += 1;
		if (!crosses(mesh, a, b, pair[0], pair[1]))
			continue;
		int half = find_half(mesh, pair[0], pair[1]);
		MUST(half >= 0);
		if (!strictly_convex(mesh, half))
			continue;
		flip(mesh, half);
		int diagonal = mesh_next(half);
		pair[0] = mesh->origin[diagonal];
		pair[1] = mesh->origin[mesh_next(diagonal)];
		open -= !crosses(mesh, a, b, pair[0], pair[1]);
	}
}

void mesh_fix(struct mesh *mesh, int a, int b, long *units)
{
	*units += 1;
	int half = find_half(mesh, a, b);
	if (half < 0) {
		int count = collect_crossed(mesh, a, b, units);
		flip_crossed(mesh, a, b, count, units);
		half = find_half(mesh, a, b);
		MUST(half >= 0);
		mesh->fixed[half] = mesh->fixed[mesh->twin[half]] = 1;
		for (int k = 0; k < count; k++) {
			int edge = find_half(mesh, mesh->crossed[2 * k], mesh->crossed[2 * k + 1]);
			MUST(edge >= 0);
			mesh_push(mesh, edge);
		}
		mesh_legalize(mesh, units);
		half = find_half(mesh, a, b);
	}
	mesh->fixed[half] = mesh->fixed[mesh->twin[half]] = 1;
}

void mesh_carve(struct mesh *mesh, long *units)
{
	/* The frame lies outside; a fixed edge changes sides. Depth-first over triangles. */
	int triangles = mesh->half_count / 3;
	for (int t = 0; t < triangles; t++)
		mesh->inside[t] = 1;
	int start = mesh->leaving[0] / 3;
	mesh->inside[start] = 0;
	mesh->stack[mesh->stack_count++] = start;
	while (mesh->stack_count > 0) {
		int t = mesh->stack[--mesh->stack_count];
		*units += 1;
		for (int k = 3 * t; k < 3 * t + 3; k++) {
			int twin = mesh->twin[k];
			if (twin < 0 || mesh->fixed[k] || !mesh->inside[twin / 3])
				continue;
			mesh->inside[twin / 3] = 0;
			mesh->stack[mesh->stack_count++] = twin / 3;
		}
	}
}
