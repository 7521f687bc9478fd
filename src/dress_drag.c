/* Surface drag (Igarashi and Hughes, "Clothing Manipulation", section on dragging).
 *
 * At pen-down a graph is built from the grabbed point outward: Dijkstra over the cloth's edges,
 * each as long as the way between the BODY points under its ends, so that wrinkles of the cloth
 * don't count. In every move the pen's vector is handed on along that graph; from particle to
 * particle it turns with the body's tangent plane (the least rotation that takes one normal to the
 * next), which is what makes the back of a skirt go left when its front is dragged right.
 *
 *   pins: sources of distance zero in a second search. A particle's share of the motion is
 *         d_pin / (d_pin + d_grab); the graph does not grow through cloth within 25 mm of a pin.
 */
#include "dress.h"

enum { NEIGHBOURS_MAX = 6 * GARMENT_TRIANGLES_MAX };

static const float pin_block_m = 0.025f;
static const float loose_m = 0.06f; /* cloth farther from the body than this follows in space */

struct heap_item {
	float distance_m;
	int particle;
};

struct drag_scratch {
	int *first; /* per particle + 1: its neighbours */
	int *fill;
	int *neighbour;
	struct heap_item *heap;
	int heap_count;
	float *pin_distance_m;
	uint8_t *settled;
	uint8_t *blocked;
};

void drag_init(struct drag *drag, struct arena *arena)
{
	memset(drag, 0, sizeof *drag);
	drag->order = ARENA_ARRAY(arena, int, GARMENT_VERTICES_MAX);
	drag->distance_m = ARENA_ARRAY(arena, float, GARMENT_VERTICES_MAX);
	drag->share = ARENA_ARRAY(arena, float, GARMENT_VERTICES_MAX);
	drag->from_first = ARENA_ARRAY(arena, int, GARMENT_VERTICES_MAX + 1);
	drag->from = ARENA_ARRAY(arena, int, NEIGHBOURS_MAX);
	drag->from_share = ARENA_ARRAY(arena, float, NEIGHBOURS_MAX);
	drag->motion_m = ARENA_ARRAY(arena, struct v3, GARMENT_VERTICES_MAX);
	struct drag_scratch *scratch = ARENA_ARRAY(arena, struct drag_scratch, 1);
	scratch->first = ARENA_ARRAY(arena, int, GARMENT_VERTICES_MAX + 1);
	scratch->fill = ARENA_ARRAY(arena, int, GARMENT_VERTICES_MAX);
	scratch->neighbour = ARENA_ARRAY(arena, int, NEIGHBOURS_MAX);
	scratch->heap = ARENA_ARRAY(arena, struct heap_item, NEIGHBOURS_MAX);
	scratch->pin_distance_m = ARENA_ARRAY(arena, float, GARMENT_VERTICES_MAX);
	scratch->settled = ARENA_ARRAY(arena, uint8_t, GARMENT_VERTICES_MAX);
	scratch->blocked = ARENA_ARRAY(arena, uint8_t, GARMENT_VERTICES_MAX);
	drag->scratch = scratch;
}

/* ---- the graph: neighbours, queue, search ---- */

/* Every directed edge of every placed triangle; inner edges come twice, which the search ignores.
 */
static void build_neighbours(struct drag_scratch *s, const struct cloth *cloth)
{
	const struct garment *garment = cloth->garment;
	memset(s->first, 0, (size_t)(garment->vertex_count + 1) * sizeof *s->first);
	for (int pass = 0; pass < 2; pass++) {
		for (int t = 0; t < garment->triangle_count; t++) {
			const int *v = cloth->triangle[t].v;
			if (!cloth->placed[v[0]] || !cloth->placed[v[1]] || !cloth->placed[v[2]])
				continue;
			for (int k = 0; k < 6; k++) {
				int a = v[k % 3], b = v[(k % 3 + 1 + k / 3) % 3];
				if (pass == 0)
					s->first[a + 1]++;
				else
					s->neighbour[s->fill[a]++] = b;
			}
		}
		if (pass == 1)
			break;
		for (int v = 0; v < garment->vertex_count; v++) {
			s->first[v + 1] += s->first[v];
			s->fill[v] = s->first[v];
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

/* The way along the body between what lies under two particles; loose cloth counts by half its own
 * length at least, so that a fold over one body point is not free. */
static float way_m(const struct cloth *cloth, int a, int b)
{
	const struct contact *p = &cloth->contact[a], *q = &cloth->contact[b];
	float cloth_m = v3_distance(cloth->position_m[a], cloth->position_m[b]);
	if (p->triangle < 0 || q->triangle < 0)
		return cloth_m;
	return float_max(v3_distance(p->point_m, q->point_m), 0.5f * cloth_m);
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
		if (blocked && blocked[a])
			continue;
		for (int i = s->first[a]; i < s->first[a + 1]; i++) {
			int b = s->neighbour[i];
			float d = item.distance_m + way_m(cloth, a, b);
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
	for (int v = 0; v < vertices; v++)
		s->blocked[v] = s->pin_distance_m[v] >= 0.0f && s->pin_distance_m[v] < pin_block_m;
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
		for (int i = s->first[a]; i < s->first[a + 1]; i++) {
			int b = s->neighbour[i];
			float fall = drag->distance_m[a] - drag->distance_m[b];
			float length = way_m(drag->cloth, a, b);
			if (drag->distance_m[b] < 0.0f || fall <= 0.0f || s->blocked[b])
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
		drag->share[a] = pin_m[a] < 0.0f ? 1.0f : sum > 0.0f ? pin_m[a] / sum : 0.0f;
	}
}

static void hold_grabbed(struct drag *drag, bool hold)
{
	struct cloth *cloth = drag->cloth;
	for (int k = 0; k < 3; k++) {
		int particle = cloth->triangle[drag->triangle].v[k];
		cloth->held[particle] = hold;
		cloth->goal_m[particle] = cloth->position_m[particle];
	}
}

void drag_begin(struct drag *drag, struct cloth *cloth, const struct pin *pins, int pin_count,
		int triangle, const float weight[3])
{
	struct drag_scratch *s = drag->scratch;
	drag->active = true;
	drag->cloth = cloth;
	drag->triangle = triangle;
	memcpy(drag->weight, weight, sizeof drag->weight);

	build_neighbours(s, cloth);
	search_pins(s, cloth, pins, pin_count);
	fill_distance(drag->distance_m, cloth->garment->vertex_count);
	s->heap_count = 0;
	add_sources(s, cloth, drag->distance_m, triangle);
	drag->order_count = search(s, cloth, drag->distance_m, drag->order, s->blocked);
	link_graph(drag);
	share_motion(drag);
	hold_grabbed(drag, true);
}

void drag_end(struct drag *drag)
{
	MUST(drag->active);
	hold_grabbed(drag, false);
	drag->active = false;
}

struct v3 drag_point(const struct drag *drag)
{
	struct v3 point = {0.0f, 0.0f, 0.0f};
	for (int k = 0; k < 3; k++) {
		int particle = drag->cloth->triangle[drag->triangle].v[k];
		point = v3_mad(point, drag->cloth->position_m[particle], drag->weight[k]);
	}
	return point;
}

/* ---- the motion ---- */

/* v turned by the least rotation that takes unit vector a to unit vector b:
 * v - (s.v) / (1 + a.b) s + 2 (a.v) b with s = a + b. Opposite vectors have no least rotation. */
static struct v3 transport(struct v3 v, struct v3 a, struct v3 b)
{
	struct v3 sum = v3_add(a, b);
	float one_plus_cosine = 1.0f + v3_dot(a, b), along = v3_dot(a, v);
	if (one_plus_cosine < 1e-3f)
		return v;
	return v3_mad(v3_mad(v, sum, -v3_dot(sum, v) / one_plus_cosine), b, 2.0f * along);
}

static struct v3 normal_under(const struct cloth *cloth, int particle)
{
	return cloth->contact[particle].normal;
}

/* The pen's pull at the grabbed point: along the surface where the cloth lies on the body. */
static struct v3 pull_m(const struct drag *drag, struct v3 target_m)
{
	const struct cloth *cloth = drag->cloth;
	struct v3 pull = v3_sub(target_m, drag_point(drag));
	int nearest = cloth->triangle[drag->triangle].v[0];
	if (cloth->contact[nearest].distance_m < loose_m) {
		struct v3 normal = normal_under(cloth, nearest);
		pull = v3_mad(pull, normal, -v3_dot(pull, normal));
	}
	float length = v3_length(pull), most = (float)DRAG_STEP_MAX_MM * 0.001f;
	return length > most ? v3_scale(pull, most / length) : pull;
}

static struct v3 handed_on(const struct drag *drag, int k)
{
	const struct cloth *cloth = drag->cloth;
	int a = drag->order[k];
	struct v3 motion = {0.0f, 0.0f, 0.0f};
	for (int i = drag->from_first[k]; i < drag->from_first[k + 1]; i++) {
		int b = drag->from[i];
		struct v3 turned = transport(drag->motion_m[b], normal_under(cloth, b),
					     normal_under(cloth, a));
		motion = v3_mad(motion, turned, drag->from_share[i]);
	}
	return motion;
}

long drag_move(struct drag *drag, struct v3 target_m)
{
	MUST(drag->active);
	struct cloth *cloth = drag->cloth;
	struct v3 pull = pull_m(drag, target_m);
	for (int k = 0; k < drag->order_count; k++) {
		int a = drag->order[k];
		bool source = drag->distance_m[a] == 0.0f;
		drag->motion_m[a] = source ? pull : handed_on(drag, k);
		struct v3 step = v3_scale(drag->motion_m[a], drag->share[a]);
		cloth->position_m[a] = v3_add(cloth->position_m[a], step);
		cloth->previous_m[a] = v3_add(cloth->previous_m[a], step);
	}
	hold_grabbed(drag, true);
	return drag->order_count + drag->from_first[drag->order_count];
}
