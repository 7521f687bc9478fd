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
static const float grip_m = 0.03f;  /* what the fingers hold */
static const float near_m = 0.03f;  /* cloth nearer to the body than this follows its surface */
static const float loose_m = 0.06f; /* cloth farther from the body than this follows in space */
static const float hand_region_m = 0.08f;
static const float strain_free = 0.10f, strain_most = 0.25f;
static const float yield_fall = 0.5f, yield_rise = 0.03f, yield_spread = 0.2f;

struct heap_item {
	float distance_m;
	int particle;
};

struct drag_scratch {
	int *first; /* per particle + 1: its neighbours */
	int *fill;
	int *neighbour;
	float *rest_m; /* per neighbour: how long the edge is on the flat piece */
	struct heap_item *heap;
	int heap_count;
	float *pin_distance_m;
	uint8_t *settled;
	uint8_t *blocked;
	uint8_t *gripped;
	struct v3 *normal; /* of the body, under each particle */
	struct v3 *left_m; /* where the last move left it */
	float *yield;      /* 0..1: how far it followed lately */
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
	scratch->rest_m = ARENA_ARRAY(arena, float, NEIGHBOURS_MAX);
	scratch->normal = ARENA_ARRAY(arena, struct v3, GARMENT_VERTICES_MAX);
	scratch->left_m = ARENA_ARRAY(arena, struct v3, GARMENT_VERTICES_MAX);
	scratch->yield = ARENA_ARRAY(arena, float, GARMENT_VERTICES_MAX);
	scratch->gripped = ARENA_ARRAY(arena, uint8_t, GARMENT_VERTICES_MAX);
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
				else {
					const int *r = garment->triangle[t].v;
					s->rest_m[s->fill[a]] = float_max(
						v2_distance(garment->rest_m[r[k % 3]],
							    garment->rest_m[r[(k % 3 + 1 + k / 3) %
									      3]]),
						1e-5f);
					s->neighbour[s->fill[a]++] = b;
				}
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
		float ratio = sum > 0.0f ? pin_m[a] / sum : 0.0f;
		drag->share[a] = pin_m[a] < 0.0f ? 1.0f : ratio * (2.0f - ratio);
	}
}

/* The grabbed triangle and what lies within the fingers, but no pin's cloth. */
static void take_grip(struct drag *drag)
{
	struct drag_scratch *s = drag->scratch;
	for (int k = 0; k < drag->order_count; k++) {
		int a = drag->order[k];
		s->gripped[a] = drag->distance_m[a] <= grip_m && !drag->cloth->held[a];
		s->yield[a] = 1.0f;
		s->left_m[a] = drag->cloth->position_m[a];
		drag->motion_m[a] = (struct v3){0.0f, 0.0f, 0.0f};
	}
}

static void hold_grabbed(struct drag *drag, bool hold)
{
	struct cloth *cloth = drag->cloth;
	for (int k = 0; k < drag->order_count; k++) {
		int particle = drag->order[k];
		if (drag->distance_m[particle] > grip_m)
			break;
		if (!drag->scratch->gripped[particle])
			continue;
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
	take_grip(drag);
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

/* The body's normal under a particle, interpolated between vertices: facets would make the motion
 * jump from particle to particle. The weights are signed areas over the facet. */
static struct v3 normal_under(const struct cloth *cloth, int particle)
{
	const struct contact *contact = &cloth->contact[particle];
	const struct body *body = cloth->body;
	if (contact->triangle < 0)
		return contact->normal;
	const int *v = body->triangle[contact->triangle].v;
	struct v3 n = body->face_normal[contact->triangle], q = contact->point_m;
	struct v3 a = v3_sub(body->position_m[v[0]], q), b = v3_sub(body->position_m[v[1]], q);
	struct v3 c = v3_sub(body->position_m[v[2]], q);
	float weight_a = v3_dot(v3_cross(b, c), n), weight_b = v3_dot(v3_cross(c, a), n);
	float weight_c = v3_dot(v3_cross(a, b), n);
	struct v3 sum = v3_scale(body->normal[v[0]], weight_a);
	sum = v3_mad(v3_mad(sum, body->normal[v[1]], weight_b), body->normal[v[2]], weight_c);
	sum = v3_normalize(sum);
	return v3_dot(sum, n) > 0.0f ? sum : n;
}

/* How far the cloth near the hand is stretched, as a share of what is allowed: 0 none, 1 all. */
static float strain_at_hand(const struct drag *drag)
{
	const struct drag_scratch *s = drag->scratch;
	const struct v3 *x = drag->cloth->position_m;
	float sum = 0.0f;
	int count = 0;
	for (int k = 0; k < drag->order_count; k++) {
		int a = drag->order[k];
		if (drag->distance_m[a] > hand_region_m)
			break;
		for (int i = s->first[a]; i < s->first[a + 1]; i++) {
			float rest = s->rest_m[i];
			float stretch = v3_distance(x[a], x[s->neighbour[i]]) / rest - 1.0f;
			sum += float_max(stretch, 0.0f) * float_max(stretch, 0.0f);
			count++;
		}
	}
	return count > 0 ? sqrtf(sum / (float)count) : 0.0f;
}

/* The pen's pull at the grabbed point: along the surface where the cloth lies on the body, and
 * the weaker the more the cloth there is stretched. */
static struct v3 pull_m(const struct drag *drag, struct v3 target_m)
{
	const struct cloth *cloth = drag->cloth;
	struct v3 pull = v3_sub(target_m, drag_point(drag));
	struct v3 normal = {0.0f, 0.0f, 0.0f};
	float distance_m = 0.0f;
	for (int k = 0; k < 3; k++) {
		int particle = cloth->triangle[drag->triangle].v[k];
		normal = v3_mad(normal, drag->scratch->normal[particle], drag->weight[k]);
		distance_m += drag->weight[k] * cloth->contact[particle].distance_m;
	}
	normal = v3_normalize(normal);
	float away = (distance_m - near_m) / (loose_m - near_m);
	float flat = 1.0f - float_clamp(away, 0.0f, 1.0f);
	pull = v3_mad(pull, normal, -flat * v3_dot(pull, normal));
	float tight = (strain_at_hand(drag) - strain_free) / (strain_most - strain_free);
	float most = (float)DRAG_STEP_MAX_MM * 0.001f * (1.0f - float_clamp(tight, 0.0f, 1.0f));
	float length = v3_length(pull);
	return length > most ? v3_scale(pull, most / length) : pull;
}

/* What the hands say in the mean, turned from their mean tangent plane into the particle's. The
 * mean of vectors that agree keeps their length; where fronts meet that disagree it is shorter. */
static struct v3 handed_on(const struct drag *drag, int k, float *yield)
{
	const struct drag_scratch *s = drag->scratch;
	struct v3 motion = {0.0f, 0.0f, 0.0f}, normal = {0.0f, 0.0f, 0.0f};
	float length = 0.0f;
	*yield = 0.0f;
	for (int i = drag->from_first[k]; i < drag->from_first[k + 1]; i++) {
		int b = drag->from[i];
		motion = v3_mad(motion, drag->motion_m[b], drag->from_share[i]);
		normal = v3_mad(normal, s->normal[b], drag->from_share[i]);
		length += drag->from_share[i] * v3_length(drag->motion_m[b]);
		*yield += drag->from_share[i] * s->yield[b];
	}
	float mean = v3_length(motion);
	if (mean < 1e-9f)
		return motion;
	float keep = float_min(length / mean, 1.0f + 0.2f * mean / length);
	motion = v3_scale(motion, keep);
	return transport(motion, v3_normalize(normal), s->normal[drag->order[k]]);
}

/* A particle that the cloth or the body took back since the last move follows less in the next;
 * one that went along follows more again. */
static void learn_yield(struct drag *drag, int a)
{
	struct drag_scratch *s = drag->scratch;
	struct v3 step = v3_scale(drag->motion_m[a], drag->share[a] * s->yield[a]);
	struct v3 back = v3_sub(s->left_m[a], drag->cloth->position_m[a]);
	float square = v3_dot(step, step);
	float opposed = square > 1e-10f ? float_clamp(v3_dot(back, step) / square, -1.0f, 1.0f)
					: 0.0f;
	s->yield[a] = float_clamp(s->yield[a] * (1.0f - yield_fall * opposed) + yield_rise, 0.0f,
				  1.0f);
}

long drag_move(struct drag *drag, struct v3 target_m)
{
	MUST(drag->active);
	struct cloth *cloth = drag->cloth;
	struct drag_scratch *s = drag->scratch;
	for (int k = 0; k < drag->order_count; k++)
		s->normal[drag->order[k]] = normal_under(cloth, drag->order[k]);
	struct v3 pull = pull_m(drag, target_m);
	for (int k = 0; k < drag->order_count; k++) {
		int a = drag->order[k];
		bool source = drag->distance_m[a] == 0.0f;
		float handed_yield = 1.0f;
		if (!source)
			learn_yield(drag, a);
		drag->motion_m[a] = source ? pull : handed_on(drag, k, &handed_yield);
		if (!source)
			s->yield[a] += yield_spread * (handed_yield - s->yield[a]);
		struct v3 step = v3_scale(drag->motion_m[a], drag->share[a] * s->yield[a]);
		cloth->position_m[a] = v3_add(cloth->position_m[a], step);
		cloth->previous_m[a] = v3_add(cloth->previous_m[a], step);
		s->left_m[a] = cloth->position_m[a];
	}
	hold_grabbed(drag, true);
	return 2 * drag->order_count + drag->from_first[drag->order_count];
}
