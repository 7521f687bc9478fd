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

static const float grip_m = 0.045f; /* what the fingers hold */
static const float near_m = 0.03f;  /* cloth nearer to the body than this follows its surface */
static const float loose_m = 0.06f; /* cloth farther from the body than this follows in space */
static const float hand_region_m = 0.08f;
static const float strain_half = 0.4f; /* added near the hand: it pulls half as fast */
static const float yield_fall = 0.5f, yield_rise = 0.03f, yield_spread = 0.2f; /* a move */

void drag_init(struct drag *drag, struct arena *arena)
{
	memset(drag, 0, sizeof *drag);
	drag->order = ARENA_ARRAY(arena, int, GARMENT_VERTICES_MAX);
	drag->distance_m = ARENA_ARRAY(arena, float, GARMENT_VERTICES_MAX);
	drag->share = ARENA_ARRAY(arena, float, GARMENT_VERTICES_MAX);
	struct drag_scratch *scratch = ARENA_ARRAY(arena, struct drag_scratch, 1);
	struct front *front = &scratch->front;
	front->way2_m2 = ARENA_ARRAY(arena, float, 4 * GARMENT_TRIANGLES_MAX);
	front->state = ARENA_ARRAY(arena, uint8_t, GARMENT_VERTICES_MAX);
	front->giver = ARENA_ARRAY(arena, struct giver, GARMENT_VERTICES_MAX);
	front->place = ARENA_ARRAY(arena, int, GARMENT_VERTICES_MAX);
	front->heap = ARENA_ARRAY(arena, uint64_t, GARMENT_VERTICES_MAX);
	scratch->pin_distance_m = ARENA_ARRAY(arena, float, GARMENT_VERTICES_MAX);
	scratch->blocked = ARENA_ARRAY(arena, uint8_t, GARMENT_VERTICES_MAX);
	scratch->gripped = ARENA_ARRAY(arena, uint8_t, GARMENT_VERTICES_MAX);
	scratch->hand = ARENA_ARRAY(arena, struct hand, GARMENT_VERTICES_MAX);
	scratch->near_triangle = ARENA_ARRAY(arena, int, GARMENT_TRIANGLES_MAX);
	scratch->near_stretch = ARENA_ARRAY(arena, float, GARMENT_TRIANGLES_MAX);
	scratch->left_m = ARENA_ARRAY(arena, struct v3, GARMENT_VERTICES_MAX);
	drag->giver = front->giver;
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
		s->hand[a] = (struct hand){.yield = 1.0f};
		s->left_m[a] = drag->cloth->position_m[a];
	}
}

/* Whose corner 0 is near is looked at by that corner, so each triangle once. */
static void list_near(struct drag *drag)
{
	struct drag_scratch *s = drag->scratch;
	const struct cloth *cloth = drag->cloth;
	s->near_count = 0;
	for (int j = 0; j < drag->order_count; j++) {
		int a = drag->order[j];
		if (drag->distance_m[a] > hand_region_m)
			break;
		for (int i = cloth->star_first[a]; i < cloth->star_first[a + 1]; i++) {
			int t = cloth->star[i] >> 2;
			const int *v = cloth->triangle[t].v;
			float b_m = drag->distance_m[v[1]], c_m = drag->distance_m[v[2]];
			if (v[0] != a || b_m < 0.0f || b_m > hand_region_m || c_m < 0.0f ||
			    c_m > hand_region_m)
				continue;
			s->near_stretch[s->near_count] = cloth_stretch(cloth, t);
			s->near_triangle[s->near_count++] = t;
		}
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

long drag_begin(struct drag *drag, struct cloth *cloth, const struct pin *pins, int pin_count,
		int triangle, const float weight[3])
{
	drag->active = true;
	drag->moves = 0;
	drag->cloth = cloth;
	drag->triangle = triangle;
	memcpy(drag->weight, weight, sizeof drag->weight);

	long units = drag_build_graph(drag, pins, pin_count);
	take_grip(drag);
	list_near(drag);
	drag_open_creases(drag);
	hold_grabbed(drag, true);
	return units;
}

void drag_end(struct drag *drag)
{
	MUST(drag->active);
	hold_grabbed(drag, false);
	if (drag->pinned)
		drag_crease(drag);
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

/* How far the drag has stretched the cloth near the hand, at its worst place. */
static float strain_at_hand(const struct drag *drag)
{
	const struct drag_scratch *s = drag->scratch;
	float most = 0.0f;
	for (int i = 0; i < s->near_count; i++) {
		float stretch = cloth_stretch(drag->cloth, s->near_triangle[i]);
		most = float_max(most, stretch - s->near_stretch[i]);
	}
	return most;
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
	float tight = strain_at_hand(drag) / strain_half;
	float most = (float)DRAG_STEP_MAX_MM * 0.001f / (1.0f + tight * tight * tight * tight);
	float length = v3_length(pull);
	return length > most ? v3_scale(pull, most / length) : pull;
}

/* What the givers say in the mean, turned from their mean tangent plane into the particle's. The
 * mean of vectors that agree keeps their length; of those that disagree it is shorter. */
static void hand_on(struct drag *drag, int particle)
{
	const struct hand *from = drag->scratch->hand;
	const struct giver *giver = &drag->giver[particle];
	struct hand mean = {0}, *to = &drag->scratch->hand[particle];
	for (int i = 0; i < 2; i++) {
		const struct hand *b = &from[giver->from[i]];
		float share = i == 1 ? giver->share : 1.0f - giver->share;
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

/* Normals change slowly: after the first move every other particle's is looked up. */
static void look_up_normals(struct drag *drag)
{
	int step = drag->moves == 0 ? 1 : 2;
	for (int k = drag->moves % step; k < drag->order_count; k += step) {
		int a = drag->order[k];
		drag->scratch->hand[a].normal = normal_under(drag->cloth, a);
	}
	drag->moves++;
}

long drag_move(struct drag *drag, struct v3 target_m)
{
	MUST(drag->active);
	struct cloth *cloth = drag->cloth;
	struct drag_scratch *s = drag->scratch;
	look_up_normals(drag);
	struct v3 pull = pull_m(drag, target_m);
	for (int k = 0; k < drag->order_count; k++) {
		int a = drag->order[k];
		struct hand *hand = &s->hand[a];
		if (drag->giver[a].from[0] < 0) {
			hand->motion_m = pull;
			hand->length_m = v3_length(pull);
		} else {
			if (!s->gripped[a])
				learn_yield(drag, a);
			hand_on(drag, a);
		}
		struct v3 step = v3_scale(hand->motion_m, drag->share[a] * hand->yield);
		cloth->position_m[a] = v3_add(cloth->position_m[a], step);
		cloth->previous_m[a] = v3_add(cloth->previous_m[a], step);
		s->left_m[a] = cloth->position_m[a];
	}
	hold_grabbed(drag, true);
	return 4L * drag->order_count;
}
