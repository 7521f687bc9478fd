/* Ways along the body's surface. */
#include "body_private.h"

static const float no_way_m = 1e9f;

/* The straight way from c over edge a b to d when both triangles lie in one plane; no_way_m when it
 * would pass beside the edge. */
static float diagonal_m(struct v3 a, struct v3 b, struct v3 c, struct v3 d)
{
	struct v3 edge = v3_sub(b, a);
	float length = v3_length(edge);
	if (length < 1e-9f)
		return no_way_m;
	struct v3 u = v3_scale(edge, 1.0f / length), ac = v3_sub(c, a), ad = v3_sub(d, a);
	float cx = v3_dot(ac, u), dx = v3_dot(ad, u);
	float cy = v3_length(v3_mad(ac, u, -cx)), dy = v3_length(v3_mad(ad, u, -dx));
	if (cy + dy < 1e-9f)
		return no_way_m;
	float crossing = cx + (dx - cx) * cy / (cy + dy);
	if (crossing < 0.0f || crossing > length)
		return no_way_m;
	return sqrtf((cx - dx) * (cx - dx) + (cy + dy) * (cy + dy));
}

/* Every half-edge t, k gives two ways: its own, and the diagonal from its far corner. */
void body_ways(struct body *body)
{
	struct body_scratch *s = body->scratch;
	const struct v3 *p = body->position_m;
	memset(s->way_first, 0, (size_t)(body->vertex_count + 2) * sizeof *s->way_first);
	for (int pass = 0; pass < 2; pass++) {
		for (int t = 0; t < body->triangle_count; t++)
			for (int k = 0; k < 3; k++) {
				const int *v = body->triangle[t].v;
				int a = v[k], b = v[(k + 1) % 3], c = v[(k + 2) % 3];
				if (pass == 0) {
					s->way_first[a + 2]++;
					s->way_first[c + 2]++;
					continue;
				}
				const int *w = body->triangle[body->neighbour[3 * t + k]].v;
				int d = w[0] != a && w[0] != b   ? w[0]
					: w[1] != a && w[1] != b ? w[1]
								 : w[2];
				int i = s->way_first[a + 1]++, j = s->way_first[c + 1]++;
				s->way_to[i] = b;
				s->way_m[i] = v3_distance(p[a], p[b]);
				s->way_to[j] = d;
				s->way_m[j] = diagonal_m(p[a], p[b], p[c], p[d]);
			}
		for (int v = 0; pass == 0 && v < body->vertex_count; v++)
			s->way_first[v + 2] += s->way_first[v + 1];
	}
}

/* ---- an indexed heap ---- */

static bool nearer(const float *distance_m, int a, int b)
{
	return distance_m[a] < distance_m[b] || (distance_m[a] == distance_m[b] && a < b);
}

static void heap_put(struct body_scratch *s, int at, int vertex)
{
	s->heap[at] = vertex;
	s->heap_place[vertex] = at;
}

static void heap_rise(struct body_scratch *s, const float *distance_m, int vertex)
{
	int at = s->heap_place[vertex];
	while (at > 0 && nearer(distance_m, vertex, s->heap[(at - 1) / 2])) {
		heap_put(s, at, s->heap[(at - 1) / 2]);
		at = (at - 1) / 2;
	}
	heap_put(s, at, vertex);
}

static int heap_pop(struct body_scratch *s, const float *distance_m)
{
	int top = s->heap[0], last = s->heap[--s->heap_count], at = 0;
	for (int child = 1; child < s->heap_count; child = 2 * at + 1) {
		if (child + 1 < s->heap_count &&
		    nearer(distance_m, s->heap[child + 1], s->heap[child]))
			child++;
		if (!nearer(distance_m, s->heap[child], last))
			break;
		heap_put(s, at, s->heap[child]);
		at = child;
	}
	heap_put(s, at, last);
	return top;
}

void body_distances(const struct body *body, int from, float *distance_m)
{
	struct body_scratch *s = body->scratch;
	for (int v = 0; v < body->vertex_count; v++) {
		distance_m[v] = no_way_m;
		s->heap_place[v] = -1;
	}
	distance_m[from] = 0.0f;
	s->heap_count = 1;
	heap_put(s, 0, from);
	while (s->heap_count > 0) {
		int a = heap_pop(s, distance_m);
		for (int i = s->way_first[a]; i < s->way_first[a + 1]; i++) {
			int b = s->way_to[i];
			float d = distance_m[a] + s->way_m[i];
			if (d >= distance_m[b])
				continue;
			bool fresh = distance_m[b] == no_way_m;
			distance_m[b] = d;
			if (fresh)
				heap_put(s, s->heap_count++, b);
			heap_rise(s, distance_m, b);
		}
	}
}
