/* Where the vertices along every outline go: alike on both sides of a seam, as even as may be, and
 * closer together where a piece is narrow or tightly curved.
 *
 * Each group of edges starts with equal segments. Segments that are too long for their place are
 * halved, with their partners across the seam, until all fit. */
#include "garment_private.h"

enum {
	PLAN_FRACTIONS_MAX = 2 * GARMENT_VERTICES_MAX,
	PLAN_PASSES_MAX = 12,
	PLAN_EDGE_MM_MIN = 6,
	PLAN_EDGE_MM_MAX = 40,
	BLOCK = 16, /* segments */
};

#define SHORTEST_MM 3.0f /* for beauty; below, only to keep the samples from crossing */
#define SMALLEST_MM 0.1f
#define ARC_BY_CHORD 1.04f   /* a sixth of a circle */
#define NEIGHBOUR_RATIO 2.2f /* halving gets at most that near to even */
#define WIDTH_BY_LENGTH 0.5f /* about the tangent of 25 degrees */
#define FACING_RATIO 1.5f    /* of segments that face each other, and */
#define GRADING 0.7f         /* so much longer for each unit between them */
#define FULL_SHARE 0.9f      /* of the vertices: the rest is for narrow places */
#define SHARP_COSINE 0.9f    /* 26 degrees: such a corner is narrow, and that's meant */

void plan_init(struct plan *plan, struct arena *arena)
{
	plan->edge = ARENA_ARRAY(arena, struct plan_edge, GARMENT_PIECE_EDGES_MAX);
	plan->group = ARENA_ARRAY(arena, struct plan_group, GARMENT_PIECE_EDGES_MAX);
	plan->fraction = ARENA_ARRAY(arena, float, PLAN_FRACTIONS_MAX);
	plan->fraction_next = ARENA_ARRAY(arena, float, PLAN_FRACTIONS_MAX);
	plan->split = ARENA_ARRAY(arena, uint8_t, PLAN_FRACTIONS_MAX);
	plan->point = ARENA_ARRAY(arena, struct grid_point, GARMENT_VERTICES_MAX);
	plan->point_fraction = ARENA_ARRAY(arena, int, GARMENT_VERTICES_MAX);
	plan->sharp = ARENA_ARRAY(arena, int, GARMENT_VERTICES_MAX + 1);
	plan->box = ARENA_ARRAY(arena, struct grid_box, GARMENT_VERTICES_MAX / BLOCK + 1);
}

/* "piece NAME: reason" */
static const char *piece_reason(char fault[160], const struct piece *piece, const char *reason)
{
	const char *part[] = {"piece ", piece->name, ": ", reason};
	int at = 0;
	for (int k = 0; k < COUNT_OF(part); k++)
		for (int i = 0; part[k][i] != '\0' && at < 159; i++)
			fault[at++] = part[k][i];
	fault[at] = '\0';
	return fault;
}

static const char *list_edges(struct plan *plan, const struct pattern *pattern, char fault[160])
{
	plan->edge_count = 0;
	for (int p = 0; p < PIECES_MAX; p++) {
		const struct piece *piece = &pattern->piece[p];
		plan->edge_first[p] = plan->edge_count;
		if (!piece->used)
			continue;
		const char *reason = piece_fault(piece);
		if (reason)
			return piece_reason(fault, piece, reason);
		int count = piece_edge_count(piece);
		if (plan->edge_count + count > GARMENT_PIECE_EDGES_MAX)
			return "the pattern has too many corners; remove some";
		for (int k = 0; k < count; k++)
			plan->edge[plan->edge_count++] = (struct plan_edge){
				.piece = p,
				.edge = k,
				.group = -1,
				.length_mm = piece_edge_length_mm(piece, k),
			};
	}
	plan->edge_first[PIECES_MAX] = plan->edge_count;
	return plan->edge_count > 0 ? NULL : "there is no piece to make cloth from";
}

/* plan.edge of a reference, or -1. */
static int edge_index(const struct plan *plan, struct edge_ref ref)
{
	if (ref.piece < 0 || ref.piece >= PIECES_MAX || ref.edge < 0)
		return -1;
	int index = plan->edge_first[ref.piece] + ref.edge;
	return index < plan->edge_first[ref.piece + 1] ? index : -1;
}

static void add_group(struct plan *plan, int seam, int a, int b)
{
	struct plan_group *group = &plan->group[plan->group_count];
	*group = (struct plan_group){.seam = seam, .side_count = b < 0 ? 1 : 2, .side = {a, b}};
	plan->edge[a].group = plan->group_count;
	if (b >= 0)
		plan->edge[b].group = plan->group_count;
	plan->group_count++;
}

static const char *group_edges(struct plan *plan, const struct pattern *pattern)
{
	plan->group_count = 0;
	for (int s = 0; s < SEAMS_MAX; s++) {
		const struct seam *seam = &pattern->seam[s];
		if (!seam->used)
			continue;
		int a = edge_index(plan, seam->a), b = edge_index(plan, seam->b);
		if (a < 0 || b < 0)
			return "a seam leads to an edge that isn't there; take the seam out";
		if (a == b)
			return "an edge is sewn to itself; cut it in two with a corner first";
		if (plan->edge[a].group >= 0 || plan->edge[b].group >= 0)
			return "an edge is sewn twice; take one of its seams out";
		add_group(plan, s, a, b);
		plan->edge[b].backward = !seam->swapped;
	}
	for (int e = 0; e < plan->edge_count; e++)
		if (plan->edge[e].group < 0)
			add_group(plan, -1, e, -1);
	return NULL;
}

static const char too_large[] = "the pattern is too large for its cloth; make it smaller";

/* Even triangles of side h have area A / (0.433 h^2) and by Euler's formula half as many vertices,
 * plus half of those on the outline: V h^2 - (L / 2) h - A / 0.866 = 0. */
static const char *choose_edge(struct plan *plan, const struct pattern *pattern, int vertices)
{
	float area = 0.0f, length = 0.0f;
	for (int p = 0; p < PIECES_MAX; p++)
		if (pattern->piece[p].used)
			area += piece_area_mm2(&pattern->piece[p]);
	for (int e = 0; e < plan->edge_count; e++)
		length += plan->edge[e].length_mm;
	float most = FULL_SHARE * (float)GARMENT_VERTICES_MAX;
	float v = float_clamp((float)vertices, 3.0f, 0.99f * most);
	float root = sqrtf(0.25f * length * length + 4.0f * v * area / 0.8660254f);
	float h = float_clamp((0.5f * length + root) / (2.0f * v), (float)PLAN_EDGE_MM_MIN,
			      (float)PLAN_EDGE_MM_MAX);
	plan->edge_mm = h;
	float expected = area / (0.8660254f * h * h) + 0.5f * length / h;
	return expected <= most ? NULL : too_large;
}

static const char *divide_evenly(struct plan *plan)
{
	plan->fraction_count = 0;
	for (int g = 0; g < plan->group_count; g++) {
		struct plan_group *group = &plan->group[g];
		float length = plan->edge[group->side[0]].length_mm;
		if (group->side_count == 2)
			length = float_max(length, plan->edge[group->side[1]].length_mm);
		float segments = float_max(1.0f, length / plan->edge_mm + 0.5f);
		if (segments > (float)GARMENT_VERTICES_MAX)
			return too_large;
		group->segments = (int)segments;
		group->first = plan->fraction_count;
		if (plan->fraction_count + group->segments + 1 > PLAN_FRACTIONS_MAX)
			return too_large;
		for (int k = 0; k <= group->segments; k++)
			plan->fraction[plan->fraction_count++] = (float)k / (float)group->segments;
	}
	return NULL;
}

/* The points of one edge, its end left to the next edge: one walk along the outline. */
static void place_edge(struct plan *plan, const struct piece *piece, struct plan_edge *edge)
{
	const struct plan_group *group = &plan->group[edge->group];
	int i, last, next;
	piece_edge(piece, edge->edge, &i, &last);
	next = i + 1 < piece->point_count ? i + 1 : 0;
	float passed = 0.0f;
	float length = v2_distance(piece->point_mm[i], piece->point_mm[next]);
	edge->first = plan->point_count;
	for (int k = 0; k < group->segments; k++) {
		int segment = edge->backward ? group->segments - 1 - k : k;
		float fraction = edge->backward ? 1.0f - plan->fraction[group->first + segment + 1]
						: plan->fraction[group->first + segment];
		float wanted = fraction * edge->length_mm;
		while (passed + length < wanted && next != last) {
			passed += length;
			i = next;
			next = i + 1 < piece->point_count ? i + 1 : 0;
			length = v2_distance(piece->point_mm[i], piece->point_mm[next]);
		}
		float share = float_clamp((wanted - passed) / length, 0.0f, 1.0f);
		struct v2 mm = v2_lerp(piece->point_mm[i], piece->point_mm[next], share);
		plan->point[plan->point_count] = grid_from_mm(mm);
		plan->point_fraction[plan->point_count] = group->first + segment;
		plan->point_count++;
	}
}

static const char *place_points(struct plan *plan, const struct pattern *pattern)
{
	int total = 0;
	for (int e = 0; e < plan->edge_count; e++)
		total += plan->group[plan->edge[e].group].segments;
	if (total > GARMENT_VERTICES_MAX)
		return too_large;
	plan->point_count = 0;
	for (int p = 0; p < PIECES_MAX; p++) {
		plan->point_first[p] = plan->point_count;
		for (int e = plan->edge_first[p]; e < plan->edge_first[p + 1]; e++)
			place_edge(plan, &pattern->piece[p], &plan->edge[e]);
	}
	plan->point_first[PIECES_MAX] = plan->point_count;
	return NULL;
}

/* The sampled outline of one piece while it is judged. */
struct loop {
	const struct grid_point *point;
	int count;
	const struct grid_box *box; /* of every BLOCK segments */
	const int *sharp;           /* sharp corners among points 0 .. i, at i + 1 */
};

static struct grid_point loop_point(const struct loop *loop, int i)
{
	return loop->point[i < loop->count ? i : i - loop->count];
}

static float grid_length(struct grid_point a, struct grid_point b)
{
	float x = (float)(b.x - a.x), y = (float)(b.y - a.y);
	return sqrtf(x * x + y * y);
}

static bool is_sharp(struct grid_point before, struct grid_point at, struct grid_point after)
{
	float lengths = grid_length(at, before) * grid_length(at, after);
	return grid_orient(before, at, after) > 0 &&
	       (float)grid_dot(at, before, after) > SHARP_COSINE * lengths;
}

/* Does the shorter way along the outline from segment i to k pass a sharp corner? */
static bool sharp_between(const struct loop *loop, int i, int k)
{
	int low = int_min(i, k), high = int_max(i, k);
	int between = loop->sharp[high + 1] - loop->sharp[low + 1];
	if (2 * (high - low) <= loop->count)
		return between > 0;
	return loop->sharp[loop->count] > between;
}

/* Does segment k, across cloth, come closer to the middle of segment i than a well-shaped triangle
 * on i would reach? Or is it too much shorter for triangles between the two to be even? */
static bool narrow(const struct loop *loop, int i, int k, float length)
{
	struct grid_point a = loop->point[i], b = loop_point(loop, i + 1);
	struct grid_point c = loop->point[k], d = loop_point(loop, k + 1);
	struct v2 middle = {0.5f * (float)(b.x - a.x), 0.5f * (float)(b.y - a.y)};
	struct v2 from = {(float)(c.x - a.x), (float)(c.y - a.y)};
	struct v2 along = {(float)(d.x - c.x), (float)(d.y - c.y)};
	float squared = v2_dot(along, along);
	if (squared <= 0.0f)
		return false;
	float share = float_clamp(v2_dot(v2_sub(middle, from), along) / squared, 0.0f, 1.0f);
	struct v2 nearest = v2_add(from, v2_scale(along, share));
	float distance = v2_distance(nearest, middle), graded = sqrtf(squared) * FACING_RATIO;
	if (distance >= WIDTH_BY_LENGTH * length && length <= graded + GRADING * distance)
		return false;
	return v2_cross(middle, nearest) > 0.0f && v2_cross(along, v2_sub(middle, from)) > 0.0f &&
	       !sharp_between(loop, i, k);
}

enum verdict { FITS, TOO_LONG, CROSSES };

static bool out_of_reach(const struct grid_box *box, int32_t x, int32_t y, int32_t reach)
{
	return box->high.x < x - reach || box->low.x > x + reach || box->high.y < y - reach ||
	       box->low.y > y + reach;
}

static struct grid_box box_of(struct grid_point c, struct grid_point d)
{
	return (struct grid_box){{int_min(c.x, d.x), int_min(c.y, d.y)},
				 {int_max(c.x, d.x), int_max(c.y, d.y)}};
}

/* A box round each block of segments: most of an outline is far from most of it. */
static void find_boxes(const struct loop *loop, struct grid_box *box)
{
	for (int i = 0; i < loop->count; i++) {
		struct grid_box of = box_of(loop->point[i], loop_point(loop, i + 1));
		struct grid_box *all = &box[i / BLOCK];
		if (i % BLOCK == 0)
			*all = of;
		all->low = box_of(all->low, of.low).low;
		all->high = box_of(all->high, of.high).high;
	}
}

static enum verdict judge_against_all(const struct loop *loop, int i, float length)
{
	struct grid_point a = loop->point[i], b = loop_point(loop, i + 1);
	int32_t x = a.x + (b.x - a.x) / 2, y = a.y + (b.y - a.y) / 2;
	int32_t reach = (int32_t)(length / GRADING) + 2;
	enum verdict verdict = FITS;
	for (int k = 0; k < loop->count; k++) {
		if (k % BLOCK == 0 && out_of_reach(&loop->box[k / BLOCK], x, y, reach)) {
			k += BLOCK - 1;
			continue;
		}
		struct grid_point c = loop->point[k], d = loop_point(loop, k + 1);
		struct grid_box box = box_of(c, d);
		if (out_of_reach(&box, x, y, reach))
			continue;
		int apart = k > i ? k - i : i - k;
		if (apart <= 1 || apart == loop->count - 1)
			continue;
		if (grid_segments_meet(a, b, c, d))
			return CROSSES;
		if (verdict == FITS && narrow(loop, i, k, length))
			verdict = TOO_LONG;
	}
	return verdict;
}

static enum verdict judge_segment(const struct loop *loop, int i, float arc)
{
	struct grid_point before = loop_point(loop, i + loop->count - 1);
	struct grid_point a = loop->point[i], b = loop_point(loop, i + 1);
	struct grid_point after = loop_point(loop, i + 2);
	float length = grid_length(a, b);
	if (loop->count < 3 || grid_same(a, b))
		return CROSSES;
	if (grid_orient(a, b, after) == 0 && grid_dot(b, a, after) > 0)
		return CROSSES;
	enum verdict verdict = judge_against_all(loop, i, length);
	if (verdict != FITS)
		return verdict;
	float shorter = float_min(grid_length(before, a), grid_length(b, after));
	return arc > ARC_BY_CHORD * length || length > NEIGHBOUR_RATIO * shorter ? TOO_LONG : FITS;
}

/* Marks the segments of one piece that must be halved. Returns how many cross others. */
static int judge_piece(struct plan *plan, int p)
{
	int first = plan->point_first[p], count = plan->point_first[p + 1] - first;
	struct loop loop = {plan->point + first, count, plan->box, plan->sharp};
	find_boxes(&loop, plan->box);
	plan->sharp[0] = 0;
	for (int i = 0; i < count; i++)
		plan->sharp[i + 1] = plan->sharp[i] + is_sharp(loop_point(&loop, i + count - 1),
							       loop.point[i],
							       loop_point(&loop, i + 1));
	int crossing = 0;
	for (int e = plan->edge_first[p]; e < plan->edge_first[p + 1]; e++) {
		const struct plan_edge *edge = &plan->edge[e];
		int segments = plan->group[edge->group].segments;
		for (int k = 0; k < segments; k++) {
			int i = edge->first - first + k, f = plan->point_fraction[first + i];
			float arc_mm = edge->length_mm *
				       (plan->fraction[f + 1] - plan->fraction[f]);
			enum verdict verdict = judge_segment(&loop, i, arc_mm * (float)GRID_PER_MM);
			crossing += verdict == CROSSES;
			float shortest = verdict == CROSSES ? SMALLEST_MM : SHORTEST_MM;
			plan->split[f] |= verdict != FITS && arc_mm > shortest;
		}
	}
	return crossing;
}

/* Halves the marked segments. Returns how many, or -1 when there is no room. */
static int halve_marked(struct plan *plan)
{
	int count = 0, halved = 0;
	for (int g = 0; g < plan->group_count; g++) {
		struct plan_group *group = &plan->group[g];
		int first = count;
		for (int k = 0; k <= group->segments; k++) {
			int f = group->first + k;
			if (count + 2 > PLAN_FRACTIONS_MAX)
				return -1;
			plan->fraction_next[count++] = plan->fraction[f];
			if (k == group->segments || !plan->split[f])
				continue;
			plan->fraction_next[count++] = 0.5f *
						       (plan->fraction[f] + plan->fraction[f + 1]);
			halved++;
		}
		group->first = first;
		group->segments = count - first - 1;
	}
	memcpy(plan->fraction, plan->fraction_next, (size_t)count * sizeof *plan->fraction);
	plan->fraction_count = count;
	return halved;
}

/* Halves until every segment fits its place. */
static const char *divide_further(struct plan *plan, const struct pattern *pattern, char fault[160])
{
	for (int pass = 0; pass < PLAN_PASSES_MAX; pass++) {
		const char *reason = place_points(plan, pattern);
		if (reason)
			return reason;
		memset(plan->split, 0, (size_t)plan->fraction_count);
		int crossing_piece = -1;
		for (int p = 0; p < PIECES_MAX; p++)
			if (pattern->piece[p].used && judge_piece(plan, p) > 0)
				crossing_piece = p;
		int halved = pass + 1 < PLAN_PASSES_MAX ? halve_marked(plan) : 0;
		if (halved < 0)
			return too_large;
		if (halved == 0)
			return crossing_piece < 0
				       ? NULL
				       : piece_reason(
						 fault, &pattern->piece[crossing_piece],
						 "parts of the outline lie too close together");
	}
	return NULL;
}

static const char *check_pairs(const struct plan *plan)
{
	int pairs = 0;
	for (int g = 0; g < plan->group_count; g++)
		if (plan->group[g].side_count == 2)
			pairs += plan->group[g].segments + 1;
	return pairs <= SEAM_PAIRS_MAX ? NULL : "the seams are too long for their cloth";
}

const char *plan_make(struct plan *plan, const struct pattern *pattern, int vertices,
		      char fault[160])
{
	const char *reason = list_edges(plan, pattern, fault);
	if (!reason)
		reason = group_edges(plan, pattern);
	if (reason)
		return reason;
	reason = choose_edge(plan, pattern, vertices);
	if (!reason)
		reason = divide_evenly(plan);
	if (!reason)
		reason = divide_further(plan, pattern, fault);
	return reason ? reason : check_pairs(plan);
}
