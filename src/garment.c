#include "garment.h"
#include "garment_private.h"

enum { NEIGHBOURS_MAX = 96 };

struct garment_job {
	struct garment *garment;
	const struct pattern *pattern;
	struct plan plan;
	struct mesh mesh;
	struct fill fill;
	int piece;    /* being filled; PIECES_MAX: all are */
	bool filling; /* fill belongs to `piece` */
	bool done;
	char fault[160];
};

void garment_init(struct garment *garment, struct arena *arena)
{
	*garment = (struct garment){0};
	garment->rest_m = ARENA_ARRAY(arena, struct v2, GARMENT_VERTICES_MAX);
	garment->piece = ARENA_ARRAY(arena, int, GARMENT_VERTICES_MAX);
	garment->weld = ARENA_ARRAY(arena, int, GARMENT_VERTICES_MAX);
	garment->triangle = ARENA_ARRAY(arena, struct triangle, GARMENT_TRIANGLES_MAX);
	garment->triangle_piece = ARENA_ARRAY(arena, int, GARMENT_TRIANGLES_MAX);
	garment->pair = ARENA_ARRAY(arena, struct seam_pair, SEAM_PAIRS_MAX);
	garment->base = ARENA_ARRAY(arena, struct triangle, GARMENT_TRIANGLES_MAX);
	garment->depth = ARENA_ARRAY(arena, uint8_t, GARMENT_TRIANGLES_MAX);
	garment->place = ARENA_ARRAY(arena, int, GARMENT_VERTICES_MAX);
}

struct garment_job *garment_job_init(struct arena *arena)
{
	struct garment_job *job = ARENA_ARRAY(arena, struct garment_job, 1);
	plan_init(&job->plan, arena);
	mesh_init(&job->mesh, arena);
	fill_init(&job->fill, arena);
	job->done = true;
	return job;
}

const char *garment_start(struct garment_job *job, struct garment *garment,
			  const struct pattern *pattern, int vertices)
{
	garment->vertex_count = garment->triangle_count = garment->pair_count = 0;
	garment->base_count = 0;
	memset(garment->piece_first, 0, sizeof garment->piece_first);
	memset(garment->piece_first_triangle, 0, sizeof garment->piece_first_triangle);
	job->garment = garment;
	job->piece = 0;
	job->filling = false;
	job->done = true;
	const char *fault = plan_make(&job->plan, pattern, vertices, job->fault);
	if (fault)
		return fault;
	garment->edge_m = 0.001f * job->plan.edge_mm;
	garment_layers(pattern, garment->layer);
	job->done = false;
	return NULL;
}

/* How many mesh points this piece may use: what is free, less the outlines still to come. */
static int point_limit(const struct garment_job *job)
{
	const struct plan *plan = &job->plan;
	int waiting = plan->point_count - plan->point_first[job->piece + 1];
	return GARMENT_VERTICES_MAX - job->garment->vertex_count - waiting + MESH_FRAME_POINTS;
}

static void emit_points(struct garment_job *job)
{
	struct garment *garment = job->garment;
	const struct mesh *mesh = &job->mesh;
	for (int i = MESH_FRAME_POINTS; i < mesh->point_count; i++) {
		int v = garment->vertex_count++;
		MUST(v < GARMENT_VERTICES_MAX);
		garment->rest_m[v] = v2_scale(grid_to_mm(mesh->point[i]), 0.001f);
		garment->piece[v] = job->piece;
		garment->weld[v] = v;
	}
}

static void emit_triangles(struct garment_job *job)
{
	struct garment *garment = job->garment;
	const struct mesh *mesh = &job->mesh;
	int shift = garment->piece_first[job->piece] - MESH_FRAME_POINTS;
	for (int half = 0; half < mesh->half_count; half += 3) {
		if (!mesh->inside[half / 3])
			continue;
		int t = garment->triangle_count++;
		MUST(t < GARMENT_TRIANGLES_MAX);
		for (int k = 0; k < 3; k++)
			garment->triangle[t].v[k] = mesh->origin[half + k] + shift;
		garment->triangle_piece[t] = job->piece;
	}
}

/* One step of the piece at hand: begin it, fill it on, or hand it over. */
static long advance_piece(struct garment_job *job, long quota)
{
	struct plan *plan = &job->plan;
	struct garment *garment = job->garment;
	int p = job->piece, count = plan->point_first[p + 1] - plan->point_first[p];
	if (!job->filling) {
		garment->piece_first[p] = garment->vertex_count;
		garment->piece_first_triangle[p] = garment->triangle_count;
		if (count == 0) {
			job->piece++;
			return 1;
		}
		fill_start(&job->fill, &job->mesh, plan->point + plan->point_first[p], count,
			   plan->edge_mm, point_limit(job));
		job->filling = true;
		return count;
	}
	long units = fill_advance(&job->fill, &job->mesh, quota);
	if (job->fill.stage == FILL_DONE) {
		emit_points(job);
		emit_triangles(job);
		units += job->mesh.point_count;
		job->filling = false;
		job->piece++;
	}
	return units;
}

static int weld_root(struct garment *garment, int v)
{
	while (garment->weld[v] != v) {
		garment->weld[v] = garment->weld[garment->weld[v]];
		v = garment->weld[v];
	}
	return v;
}

static void join(struct garment *garment, int a, int b, int seam)
{
	if (a == b)
		return; /* the tip of a dart */
	MUST(garment->pair_count < SEAM_PAIRS_MAX);
	garment->pair[garment->pair_count++] = (struct seam_pair){a, b, seam};
	int root_a = weld_root(garment, a), root_b = weld_root(garment, b);
	garment->weld[int_max(root_a, root_b)] = int_min(root_a, root_b);
}

/* The garment vertex at step k of an edge, counted along the group's fractions. */
static int edge_vertex(const struct garment_job *job, const struct plan_edge *edge, int segments,
		       int k)
{
	const struct plan *plan = &job->plan;
	int first = plan->point_first[edge->piece];
	int count = plan->point_first[edge->piece + 1] - first;
	int i = edge->first - first + (edge->backward ? segments - k : k);
	return job->garment->piece_first[edge->piece] + (i < count ? i : i - count);
}

/* The corners of all triangles of a piece at v; how many there are. */
static int neighbours(const struct garment *garment, int piece, int v, int list[NEIGHBOURS_MAX])
{
	int count = 0;
	for (int t = garment->piece_first_triangle[piece];
	     t < garment->piece_first_triangle[piece + 1]; t++) {
		const int *corner = garment->triangle[t].v;
		if (corner[0] != v && corner[1] != v && corner[2] != v)
			continue;
		for (int k = 0; k < 3 && count < NEIGHBOURS_MAX; k++)
			list[count++] = corner[k];
	}
	return count;
}

/* Where two edges of one piece are sewn together, their samples v and w may be neighbours, or have
 * a neighbour in common: at the tip of a cone, across a narrow strip. Joining them would fold
 * triangles to a line or onto each other (the link condition of Dey et al. 1999), so that such
 * places stay open. The corner that both edges share is no such neighbour. */
static bool too_close(const struct garment *garment, int piece, int v, int w, const int corner[2])
{
	int around_v[NEIGHBOURS_MAX], around_w[NEIGHBOURS_MAX];
	int v_count = neighbours(garment, piece, v, around_v);
	int w_count = neighbours(garment, piece, w, around_w);
	for (int i = 0; i < v_count; i++)
		for (int k = 0; k < w_count; k++)
			if (around_v[i] == around_w[k] && around_v[i] != corner[0] &&
			    around_v[i] != corner[1])
				return true;
	return false;
}

static void sew_group(struct garment_job *job, const struct plan_group *group)
{
	const struct plan_edge *a = &job->plan.edge[group->side[0]];
	const struct plan_edge *b = &job->plan.edge[group->side[1]];
	int last = group->segments, corner[2] = {-1, -1};
	for (int end = 0; end < 2; end++) {
		int v = edge_vertex(job, a, last, end * last);
		if (v == edge_vertex(job, b, last, end * last))
			corner[end] = v;
	}
	for (int k = 0; k <= last; k++) {
		int v = edge_vertex(job, a, last, k), w = edge_vertex(job, b, last, k);
		if (a->piece != b->piece || !too_close(job->garment, a->piece, v, w, corner))
			join(job->garment, v, w, group->seam);
	}
}

static long sew(struct garment_job *job)
{
	struct garment *garment = job->garment;
	const struct plan *plan = &job->plan;
	for (int g = 0; g < plan->group_count; g++)
		if (plan->group[g].side_count == 2)
			sew_group(job, &plan->group[g]);
	for (int v = 0; v < garment->vertex_count; v++)
		garment->weld[v] = weld_root(garment, v);
	return garment->vertex_count + garment->pair_count;
}

long garment_advance(struct garment_job *job, long quota, bool *done)
{
	long units = 0;
	while (units < quota && !job->done) {
		if (job->piece < PIECES_MAX) {
			units += advance_piece(job, quota - units);
			continue;
		}
		job->garment->piece_first[PIECES_MAX] = job->garment->vertex_count;
		job->garment->piece_first_triangle[PIECES_MAX] = job->garment->triangle_count;
		units += sew(job);
		job->done = true;
	}
	*done = job->done;
	return units;
}

/* Barycentric weights of p; their least says how far outside it is. */
static float weigh(struct v2 a, struct v2 b, struct v2 c, struct v2 p, float weight[3])
{
	float area = v2_cross(v2_sub(b, a), v2_sub(c, a));
	if (!(area > 0.0f))
		return -1e30f;
	weight[0] = v2_cross(v2_sub(b, p), v2_sub(c, p)) / area;
	weight[1] = v2_cross(v2_sub(c, p), v2_sub(a, p)) / area;
	weight[2] = 1.0f - weight[0] - weight[1];
	return float_min(weight[0], float_min(weight[1], weight[2]));
}

/* The distance of p from the segment a b, and where on it. */
static float distance_to_side(struct v2 a, struct v2 b, struct v2 p, float *share)
{
	struct v2 d = v2_sub(b, a);
	float squared = v2_dot(d, d);
	*share = squared > 0.0f ? float_clamp(v2_dot(v2_sub(p, a), d) / squared, 0.0f, 1.0f) : 0.0f;
	return v2_distance(p, v2_lerp(a, b, *share));
}

int garment_locate(const struct garment *garment, int piece, struct v2 local_mm, float weight[3])
{
	MUST(piece >= 0 && piece < PIECES_MAX);
	struct v2 p = v2_scale(local_mm, 0.001f);
	int nearest = -1;
	float nearest_m = garment->edge_m;
	for (int t = garment->piece_first_triangle[piece];
	     t < garment->piece_first_triangle[piece + 1]; t++) {
		const int *v = garment->triangle[t].v;
		struct v2 corner[3] = {garment->rest_m[v[0]], garment->rest_m[v[1]],
				       garment->rest_m[v[2]]};
		struct v2 d = v2_sub(corner[0], p);
		if (v2_dot(d, d) > 16.0f * garment->edge_m * garment->edge_m)
			continue; /* no triangle is that large */
		float w[3];
		if (weigh(corner[0], corner[1], corner[2], p, w) >= 0.0f) {
			memcpy(weight, w, sizeof w);
			return t;
		}
		for (int k = 0; k < 3; k++) {
			float share;
			float distance = distance_to_side(corner[k], corner[(k + 1) % 3], p,
							  &share);
			if (distance >= nearest_m)
				continue;
			nearest_m = distance;
			nearest = t;
			weight[k] = 1.0f - share;
			weight[(k + 1) % 3] = share;
			weight[(k + 2) % 3] = 0.0f;
		}
	}
	return nearest;
}
