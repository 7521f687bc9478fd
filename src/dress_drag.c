/* Surface drag (Igarashi and Hughes, "Clothing Manipulation", section on dragging).
 *
 * At pen-down a graph is built from the grabbed point outward (dress_drag_graph.c). In every move
 * the pen's vector is handed on along that graph; from particle to particle it turns with the
 * body's tangent plane (the least rotation that takes one normal to the next), which is what makes
 * the back of a skirt go left when its front is dragged right.
 *
 * The drag is as strong as the cloth allows. A particle that the sweeps between two moves took
 * back, because an arm is in the way or its neighbours hold it, follows less in the next (its
 * yield); and the hand slows down when the cloth near it is stretched.
 */
#include "dress_drag_private.h"

static const float grip_m = 0.03f;  /* what the fingers hold */
static const float near_m = 0.03f;  /* cloth nearer to the body than this follows its surface */
static const float loose_m = 0.06f; /* cloth farther from the body than this follows in space */
static const float hand_region_m = 0.08f;
static const float strain_free = 0.13f, strain_most = 0.28f;                   /* near the hand */
static const float yield_fall = 0.5f, yield_rise = 0.03f, yield_spread = 0.2f; /* a move */

void drag_init(struct drag *drag, struct arena *arena)
{
	memset(drag, 0, sizeof *drag);
	drag->order = ARENA_ARRAY(arena, int, GARMENT_VERTICES_MAX);
	drag->distance_m = ARENA_ARRAY(arena, float, GARMENT_VERTICES_MAX);
	drag->share = ARENA_ARRAY(arena, float, GARMENT_VERTICES_MAX);
	drag->from_first = ARENA_ARRAY(arena, int, GARMENT_VERTICES_MAX + 1);
	drag->from = ARENA_ARRAY(arena, int, NEIGHBOURS_MAX);
	drag->from_share = ARENA_ARRAY(arena, float, NEIGHBOURS_MAX);
	struct drag_scratch *scratch = ARENA_ARRAY(arena, struct drag_scratch, 1);
	scratch->first = ARENA_ARRAY(arena, int, GARMENT_VERTICES_MAX + 1);
	scratch->end = ARENA_ARRAY(arena, int, GARMENT_VERTICES_MAX);
	scratch->neighbour = ARENA_ARRAY(arena, int, NEIGHBOURS_MAX);
	scratch->way_m = ARENA_ARRAY(arena, float, NEIGHBOURS_MAX);
	scratch->rest_m = ARENA_ARRAY(arena, float, NEIGHBOURS_MAX);
	scratch->hand = ARENA_ARRAY(arena, struct hand, GARMENT_VERTICES_MAX);
	scratch->left_m = ARENA_ARRAY(arena, struct v3, GARMENT_VERTICES_MAX);
	scratch->gripped = ARENA_ARRAY(arena, uint8_t, GARMENT_VERTICES_MAX);
	scratch->heap = ARENA_ARRAY(arena, struct heap_item, NEIGHBOURS_MAX);
	scratch->pin_distance_m = ARENA_ARRAY(arena, float, GARMENT_VERTICES_MAX);
	scratch->settled = ARENA_ARRAY(arena, uint8_t, GARMENT_VERTICES_MAX);
	scratch->blocked = ARENA_ARRAY(arena, uint8_t, GARMENT_VERTICES_MAX);
	drag->scratch = scratch;
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

/* The grabbed triangle and what lies within the fingers, but no pin's cloth. */
static void take_grip(struct drag *drag)
{
	struct drag_scratch *s = drag->scratch;
	for (int k = 0; k < drag->order_count; k++) {
		int a = drag->order[k];
		s->gripped[a] = drag->distance_m[a] <= grip_m && !drag->cloth->held[a];
		s->hand[a] = (struct hand){.normal = normal_under(drag->cloth, a), .yield = 1.0f};
		s->left_m[a] = drag->cloth->position_m[a];
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
	drag->active = true;
	drag->moves = 0;
	drag->cloth = cloth;
	drag->triangle = triangle;
	memcpy(drag->weight, weight, sizeof drag->weight);

	drag_build_graph(drag, pins, pin_count);
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
		for (int i = s->first[a]; i < s->end[a]; i++) {
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
		normal = v3_mad(normal, drag->scratch->hand[particle].normal, drag->weight[k]);
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
static void hand_on(struct drag *drag, int k)
{
	const struct hand *from = drag->scratch->hand;
	struct hand mean = {0}, *to = &drag->scratch->hand[drag->order[k]];
	for (int i = drag->from_first[k]; i < drag->from_first[k + 1]; i++) {
		const struct hand *b = &from[drag->from[i]];
		float share = drag->from_share[i];
		mean.motion_m = v3_mad(mean.motion_m, b->motion_m, share);
		mean.normal = v3_mad(mean.normal, b->normal, share);
		mean.length_m += share * b->length_m;
		mean.yield += share * b->yield;
	}
	float length = v3_length(mean.motion_m);
	to->yield += yield_spread * (mean.yield - to->yield);
	to->motion_m = mean.motion_m;
	to->length_m = length;
	if (length < 1e-9f)
		return;
	float keep = float_min(mean.length_m / length, 1.0f + 0.2f * length / mean.length_m);
	to->length_m = keep * length;
	to->motion_m = transport(v3_scale(mean.motion_m, keep), v3_normalize(mean.normal),
				 to->normal);
}

/* A particle that the cloth or the body took back since the last move follows less in the next;
 * one that went along follows more again. */
static void learn_yield(struct drag *drag, int a)
{
	struct hand *hand = &drag->scratch->hand[a];
	float scale = drag->share[a] * hand->yield, wanted = scale * hand->length_m, opposed = 0.0f;
	struct v3 back = v3_sub(drag->scratch->left_m[a], drag->cloth->position_m[a]);
	if (wanted > 1e-5f)
		opposed = scale * v3_dot(back, hand->motion_m) / (wanted * wanted);
	float follow = 1.0f - yield_fall * float_clamp(opposed, -1.0f, 1.0f);
	hand->yield = float_clamp(hand->yield * follow + yield_rise, 0.0f, 1.0f);
}

/* Normals change slowly: every other particle's is looked up in a move. */
long drag_move(struct drag *drag, struct v3 target_m)
{
	MUST(drag->active);
	struct cloth *cloth = drag->cloth;
	struct drag_scratch *s = drag->scratch;
	for (int k = drag->moves++ & 1; k < drag->order_count; k += 2)
		s->hand[drag->order[k]].normal = normal_under(cloth, drag->order[k]);
	struct v3 pull = pull_m(drag, target_m);
	for (int k = 0; k < drag->order_count; k++) {
		int a = drag->order[k];
		struct hand *hand = &s->hand[a];
		if (drag->distance_m[a] == 0.0f) {
			hand->motion_m = pull;
			hand->length_m = v3_length(pull);
		} else {
			learn_yield(drag, a);
			hand_on(drag, k);
		}
		struct v3 step = v3_scale(hand->motion_m, drag->share[a] * hand->yield);
		cloth->position_m[a] = v3_add(cloth->position_m[a], step);
		cloth->previous_m[a] = v3_add(cloth->previous_m[a], step);
		s->left_m[a] = cloth->position_m[a];
	}
	hold_grabbed(drag, true);
	return 2 * drag->order_count + drag->from_first[drag->order_count];
}
