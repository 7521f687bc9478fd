/* The graph of a surface drag: Dijkstra over the cloth's edges, each as long as the way between the
 * BODY points under its ends, so that wrinkles of the cloth don't count.
 *
 *   pins: sources of distance zero in a second search. With r = d_pin / (d_pin + d_grab) a particle
 *         has the share r (2 - r) of the motion: all at the hand, none at a pin, three quarters
 * half way between. The graph does not grow through cloth near a pin.
 */
#include "dress_drag_private.h"

static const float pin_block_m = 0.025f;
static const float pin_block_edges = 1.5f; /* so that no edge of a coarse mesh leaps over a fence */

/* The way along the body between what lies under two particles. Half the cloth's own length at
 * least, so that a fold over one body point is not free; half as much again at most, where cloth
 * spans a hollow and what lies under it jumps from one side to the other. */
static float way_m(const struct cloth *cloth, int a, int b)
{
	const struct contact *p = &cloth->contact[a], *q = &cloth->contact[b];
	float cloth_m = v3_distance(cloth->position_m[a], cloth->position_m[b]);
	if (p->triangle < 0 || q->triangle < 0)
		return cloth_m;
	return float_clamp(v3_distance(p->point_m, q->point_m), 0.5f * cloth_m, 1.5f * cloth_m);
}

static void add_edge(struct drag_scratch *s, const struct cloth *cloth, int a, int b, float rest_m)
{
	for (int i = s->first[a]; i < s->end[a]; i++)
		if (s->neighbour[i] == b)
			return;
	float length_m = way_m(cloth, a, b);
	const int from[2] = {a, b};
	for (int k = 0; k < 2; k++) {
		int at = s->end[from[k]]++;
		s->neighbour[at] = from[1 - k];
		s->rest_m[at] = rest_m;
		s->way_m[at] = length_m;
	}
}

/* Every edge of every placed triangle, from both its ends. */
static void build_neighbours(struct drag_scratch *s, const struct cloth *cloth)
{
	const struct garment *garment = cloth->garment;
	memset(s->first, 0, (size_t)(garment->vertex_count + 1) * sizeof *s->first);
	for (int t = 0; t < garment->triangle_count; t++)
		for (int k = 0; k < 3; k++)
			s->first[cloth->triangle[t].v[k] + 1] += 2;
	for (int v = 0; v < garment->vertex_count; v++) {
		s->first[v + 1] += s->first[v];
		s->end[v] = s->first[v];
	}
	for (int t = 0; t < garment->triangle_count; t++) {
		const int *v = cloth->triangle[t].v, *flat = garment->triangle[t].v;
		if (!cloth->placed[v[0]] || !cloth->placed[v[1]] || !cloth->placed[v[2]])
			continue;
		for (int k = 0; k < 3; k++) {
			int next = (k + 1) % 3;
			float rest_m = v2_distance(garment->rest_m[flat[k]],
						   garment->rest_m[flat[next]]);
			add_edge(s, cloth, v[k], v[next], float_max(rest_m, 1e-5f));
		}
	}
}

/* Ties go to the lower particle, so that the order is the same everywhere. */
static bool before(struct heap_item a, struct heap_item b)
{
	return a.distance_m < b.distance_m ||
	       (a.distance_m == b.distance_m && a.particle < b.particle);
}

static void heap_push(struct drag_scratch *s, float distance_m, int particle)
{
	struct heap_item item = {distance_m, particle};
	MUST(s->heap_count < NEIGHBOURS_MAX);
	int at = s->heap_count++;
	while (at > 0 && before(item, s->heap[(at - 1) / 2])) {
		s->heap[at] = s->heap[(at - 1) / 2];
		at = (at - 1) / 2;
	}
	s->heap[at] = item;
}

static struct heap_item heap_pop(struct drag_scratch *s)
{
	struct heap_item top = s->heap[0], last = s->heap[--s->heap_count];
	int at = 0;
	for (int child = 1; child < s->heap_count; child = 2 * at + 1) {
		if (child + 1 < s->heap_count && before(s->heap[child + 1], s->heap[child]))
			child++;
		if (!before(s->heap[child], last))
			break;
		s->heap[at] = s->heap[child];
		at = child;
	}
	s->heap[at] = last;
	return top;
}

/* Dijkstra from the queue's sources. `distance_m` holds 0 at sources and -1 elsewhere; the settled
 * particles go to `order` when given. Returns their number. */
static int search(struct drag_scratch *s, const struct cloth *cloth, float *distance_m, int *order,
		  const uint8_t *blocked)
{
	int count = 0;
	memset(s->settled, 0, (size_t)cloth->garment->vertex_count);
	while (s->heap_count > 0) {
		struct heap_item item = heap_pop(s);
		int a = item.particle;
		if (s->settled[a])
			continue;
		s->settled[a] = 1;
		if (order)
			order[count] = a;
		count++;
		if (blocked && blocked[a] && item.distance_m > 0.0f)
			continue;
		for (int i = s->first[a]; i < s->end[a]; i++) {
			int b = s->neighbour[i];
			float d = item.distance_m + s->way_m[i];
			if (s->settled[b] || (distance_m[b] >= 0.0f && distance_m[b] <= d))
				continue;
			distance_m[b] = d;
			heap_push(s, d, b);
		}
	}
	return count;
}

static void fill_distance(float *distance_m, int count)
{
	for (int i = 0; i < count; i++)
		distance_m[i] = -1.0f;
}

static void add_sources(struct drag_scratch *s, const struct cloth *cloth, float *distance_m,
			int triangle)
{
	for (int k = 0; k < 3; k++) {
		int particle = cloth->triangle[triangle].v[k];
		distance_m[particle] = 0.0f;
		heap_push(s, 0.0f, particle);
	}
}

/* How far every particle is from the nearest pin; -1 everywhere when there is none. */
static void search_pins(struct drag_scratch *s, const struct cloth *cloth, const struct pin *pins,
			int pin_count)
{
	int vertices = cloth->garment->vertex_count;
	fill_distance(s->pin_distance_m, vertices);
	s->heap_count = 0;
	for (int p = 0; p < pin_count; p++) {
		float weight[3];
		int triangle = pins[p].used ? garment_locate(cloth->garment, pins[p].piece,
							     pins[p].point_mm, weight)
					    : -1;
		if (triangle >= 0)
			add_sources(s, cloth, s->pin_distance_m, triangle);
	}
	search(s, cloth, s->pin_distance_m, NULL, NULL);
	float block_m = float_max(pin_block_m, pin_block_edges * cloth->garment->edge_m);
	for (int v = 0; v < vertices; v++)
		s->blocked[v] = s->pin_distance_m[v] >= 0.0f && s->pin_distance_m[v] < block_m;
}

/* Who hands the motion on to each particle: all neighbours nearer to the hand, the more the steeper
 * the distance falls towards them. */
static void link_graph(struct drag *drag)
{
	const struct drag_scratch *s = drag->scratch;
	int links = 0;
	for (int k = 0; k < drag->order_count; k++) {
		int a = drag->order[k];
		float sum = 0.0f;
		drag->from_first[k] = links;
		for (int i = s->first[a]; i < s->end[a]; i++) {
			int b = s->neighbour[i];
			float fall = drag->distance_m[a] - drag->distance_m[b];
			float length = s->way_m[i];
			if (drag->distance_m[b] < 0.0f || fall <= 0.0f ||
			    (s->blocked[b] && drag->distance_m[b] > 0.0f))
				continue;
			drag->from[links] = b;
			drag->from_share[links] = fall / (length * length + 1e-8f);
			sum += drag->from_share[links++];
		}
		for (int i = drag->from_first[k]; i < links; i++)
			drag->from_share[i] /= sum;
	}
	drag->from_first[drag->order_count] = links;
}

static void share_motion(struct drag *drag)
{
	const float *pin_m = drag->scratch->pin_distance_m;
	for (int k = 0; k < drag->order_count; k++) {
		int a = drag->order[k];
		float sum = pin_m[a] + drag->distance_m[a];
		float ratio = sum > 0.0f ? pin_m[a] / sum : 0.0f;
		drag->share[a] = pin_m[a] < 0.0f ? 1.0f : ratio * (2.0f - ratio);
	}
}

void drag_build_graph(struct drag *drag, const struct pin *pins, int pin_count)
{
	struct drag_scratch *s = drag->scratch;
	build_neighbours(s, drag->cloth);
	search_pins(s, drag->cloth, pins, pin_count);
	fill_distance(drag->distance_m, drag->cloth->garment->vertex_count);
	s->heap_count = 0;
	add_sources(s, drag->cloth, drag->distance_m, drag->triangle);
	drag->order_count = search(s, drag->cloth, drag->distance_m, drag->order, s->blocked);
	link_graph(drag);
	share_motion(drag);
}
