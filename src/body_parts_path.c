/* Distances over the surface: Dijkstra on the mesh's edges and on the diagonals across them. */
#include "body_parts.h"

/* Edges alone overestimate by up to 15 %; with the diagonals it is a few percent. */
enum { SAMPLES = 32 };

struct parts_scratch *parts_init(struct arena *arena)
{
	struct parts_scratch *scratch = ARENA_ARRAY(arena, struct parts_scratch, 1);
	scratch->link = ARENA_ARRAY(arena, struct link, 6 * BODY_TRIANGLES_MAX);
	scratch->distance_m = ARENA_ARRAY(arena, float, BODY_VERTICES_MAX);
	scratch->nearest_m = ARENA_ARRAY(arena, float, BODY_VERTICES_MAX);
	scratch->remote_m = ARENA_ARRAY(arena, float, BODY_VERTICES_MAX);
	scratch->height_m = ARENA_ARRAY(arena, float, BODY_VERTICES_MAX);
	scratch->share = ARENA_ARRAY(arena, float, BODY_VERTICES_MAX);
	scratch->owner = ARENA_ARRAY(arena, int8_t, BODY_VERTICES_MAX);
	scratch->heap = ARENA_ARRAY(arena, int, BODY_VERTICES_MAX);
	scratch->place = ARENA_ARRAY(arena, int, BODY_VERTICES_MAX);
	scratch->order = ARENA_ARRAY(arena, int, BODY_VERTICES_MAX);
	scratch->order_swap = ARENA_ARRAY(arena, int, BODY_VERTICES_MAX);
	scratch->set = ARENA_ARRAY(arena, int, BODY_VERTICES_MAX);
	scratch->set_tip = ARENA_ARRAY(arena, int, BODY_VERTICES_MAX);
	return scratch;
}

/* The corner of a triangle at a vertex. */
static int corner_of(const struct triangle *triangle, int v)
{
	return triangle->v[0] == v ? 0 : triangle->v[1] == v ? 1 : 2;
}

/* The way from the corner v of triangle t straight across the opposite edge a-b to the far corner
 * of its neighbour, unfolded into a plane. */
static struct link diagonal(const struct body *body, int t, int k)
{
	const struct v3 *p = body->position_m;
	const int *c = body->triangle[t].v;
	int v = c[k], a = c[(k + 1) % 3], b = c[(k + 2) % 3];
	int across = body->neighbour[3 * t + (k + 1) % 3];
	const int *d = body->triangle[across].v;
	int far = d[0] != a && d[0] != b ? d[0] : d[1] != a && d[1] != b ? d[1] : d[2];
	struct link link = {far, UNREACHED};
	struct v3 along = v3_sub(p[b], p[a]);
	float length = v3_length(along);
	if (length < 1e-9f || far == v)
		return link;
	along = v3_scale(along, 1.0f / length);
	struct v3 to_v = v3_sub(p[v], p[a]), to_far = v3_sub(p[far], p[a]);
	float vx = v3_dot(to_v, along), fx = v3_dot(to_far, along);
	float vy = v3_length(v3_mad(to_v, along, -vx)), fy = v3_length(v3_mad(to_far, along, -fx));
	if (vy + fy < 1e-9f)
		return link;
	float crossing = (vx * fy + fx * vy) / (vy + fy);
	if (crossing > 0.0f && crossing < length)
		link.length_m = sqrtf((vx - fx) * (vx - fx) + (vy + fy) * (vy + fy));
	return link;
}

void parts_link(const struct body *body, struct parts_scratch *scratch)
{
	for (int v = 0; v < body->vertex_count; v++) {
		int first = body->star_first[v], degree = parts_degree(body, v);
		struct link *link = scratch->link + 2 * first;
		for (int i = 0; i < degree; i++) {
			int t = body->star[first + i];
			int k = corner_of(&body->triangle[t], v);
			int next = body->triangle[t].v[(k + 1) % 3];
			link[i].to = next;
			link[i].length_m = v3_distance(body->position_m[v], body->position_m[next]);
			link[degree + i] = diagonal(body, t, k);
		}
	}
}

/* ---- Dijkstra with a binary heap ---- */

static void sift_up(struct parts_scratch *s, int i)
{
	int v = s->heap[i];
	while (i > 0 && s->distance_m[s->heap[(i - 1) / 2]] > s->distance_m[v]) {
		s->heap[i] = s->heap[(i - 1) / 2];
		s->place[s->heap[i]] = i;
		i = (i - 1) / 2;
	}
	s->heap[i] = v;
	s->place[v] = i;
}

static void sift_down(struct parts_scratch *s, int count)
{
	int v = s->heap[0], i = 0;
	for (int child = 1; child < count; child = 2 * i + 1) {
		if (child + 1 < count &&
		    s->distance_m[s->heap[child + 1]] < s->distance_m[s->heap[child]])
			child++;
		if (s->distance_m[s->heap[child]] >= s->distance_m[v])
			break;
		s->heap[i] = s->heap[child];
		s->place[s->heap[i]] = i;
		i = child;
	}
	s->heap[i] = v;
	s->place[v] = i;
}

void parts_distance(const struct body *body, struct parts_scratch *s)
{
	int count = 0;
	for (int v = 0; v < body->vertex_count; v++) {
		s->place[v] = -1;
		if (s->distance_m[v] == 0.0f) {
			s->place[v] = count;
			s->heap[count++] = v; /* all equal: a heap already */
		}
	}
	while (count > 0) {
		int v = s->heap[0];
		s->heap[0] = s->heap[--count];
		if (count > 0)
			sift_down(s, count);
		s->place[v] = -1;
		const struct link *link = s->link + 2 * body->star_first[v];
		for (int i = 0; i < 2 * parts_degree(body, v); i++) {
			int to = link[i].to;
			float distance = s->distance_m[v] + link[i].length_m;
			if (!(distance < s->distance_m[to]))
				continue;
			s->distance_m[to] = distance;
			if (s->place[to] < 0) {
				s->place[to] = count;
				s->heap[count++] = to;
			}
			sift_up(s, s->place[to]);
		}
	}
}

void parts_distance_from(const struct body *body, struct parts_scratch *s, int from)
{
	for (int v = 0; v < body->vertex_count; v++)
		s->distance_m[v] = UNREACHED;
	s->distance_m[from] = 0.0f;
	parts_distance(body, s);
}

static int farthest_vertex(const struct body *body, const float *distance_m)
{
	int farthest = 0;
	for (int v = 1; v < body->vertex_count; v++)
		if (distance_m[v] < UNREACHED &&
		    (distance_m[v] > distance_m[farthest] || distance_m[farthest] >= UNREACHED))
			farthest = v;
	return farthest;
}

/* Vertices apart from the component of the first sample count as least remote. */
static void take_least_off(const struct body *body, struct parts_scratch *s)
{
	float least = UNREACHED;
	for (int v = 0; v < body->vertex_count; v++)
		if (s->nearest_m[v] < UNREACHED)
			least = float_min(least, s->remote_m[v]);
	s->remote_max_m = 0.0f;
	for (int v = 0; v < body->vertex_count; v++) {
		bool reached = s->nearest_m[v] < UNREACHED;
		s->remote_m[v] = reached ? (s->remote_m[v] - least) / (float)SAMPLES : 0.0f;
		s->remote_max_m = float_max(s->remote_max_m, s->remote_m[v]);
	}
}

/* The mean distance to samples that are spread as far apart as possible is greatest at the ends of
 * limbs, whatever the pose (Hilaga et al., Topology Matching, SIGGRAPH 2001). */
void parts_remote(const struct body *body, struct parts_scratch *s)
{
	parts_distance_from(body, s, 0);
	int sample = farthest_vertex(body, s->distance_m);
	for (int v = 0; v < body->vertex_count; v++) {
		s->nearest_m[v] = UNREACHED;
		s->remote_m[v] = 0.0f;
	}
	for (int i = 0; i < SAMPLES; i++) {
		parts_distance_from(body, s, sample);
		if (i == 0)
			s->reach_m = 0.5f * s->distance_m[farthest_vertex(body, s->distance_m)];
		for (int v = 0; v < body->vertex_count; v++) {
			if (s->distance_m[v] >= UNREACHED)
				continue;
			s->remote_m[v] += s->distance_m[v];
			s->nearest_m[v] = float_min(s->nearest_m[v], s->distance_m[v]);
		}
		sample = farthest_vertex(body, s->nearest_m);
	}
	take_least_off(body, s);
}
