/* Sleeves cut in one with front and back, as in a T-shirt drawn in a minute, and trouser legs. Flat
 * on the chest sleeves stand off to where they are cut, and arms that hang lower would pass below
 * them. So the limbs of the slim body point where the tubes do while it is laid and sewn, and take
 * them along when they turn back. */
#include "dress_private.h"
#include "forest.h"

/* From a limb's joint to its opening, of the limb's length: out (an arm's) or down (a leg's) at
 * least, and at most. */
static const float reach_least = 0.15f;
static const float reach_most = 2.0f;
static const float beside_least =
	0.5f; /* of a hip joint's way from the middle: not a skirt's hem */

/* ---- openings: rims of the garment as it is sewn ---- */

/* Has this edge of a triangle, low-high once sewn, no triangle beyond it? */
static bool is_rim(const struct wrap *wrap, int low, int high)
{
	const struct wrap_scratch *s = wrap->scratch;
	const struct garment *garment = wrap->cloth->garment;
	int count = 0;
	for (int i = s->edge_first[low]; i < s->edge_first[low + 1]; i++) {
		const int *v = garment->triangle[s->edge_triangle[i] / 3].v;
		int k = s->edge_triangle[i] % 3;
		int a = garment->weld[v[k]], b = garment->weld[v[(k + 1) % 3]];
		count += int_max(a, b) == high;
	}
	return count == 1;
}

/* Fills scratch->rim: one vertex that stands for all of an opening, for each of its vertices; -1:
 * the vertex is on no rim. */
static void find_rims(struct wrap *wrap)
{
	const struct garment *garment = wrap->cloth->garment;
	int *rim = wrap->scratch->rim;
	for (int v = 0; v < garment->vertex_count; v++)
		rim[v] = -1;
	for (int i = 0; i < 3 * garment->triangle_count; i++) {
		const int *v = garment->triangle[i / 3].v, k = i % 3;
		int a = garment->weld[v[k]], b = garment->weld[v[(k + 1) % 3]];
		if (!is_rim(wrap, int_min(a, b), int_max(a, b)))
			continue;
		rim[a] = rim[a] < 0 ? a : forest_root(rim, a);
		rim[b] = rim[b] < 0 ? b : forest_root(rim, b);
		rim[rim[b]] = rim[a];
	}
	for (int v = 0; v < garment->vertex_count; v++)
		if (rim[garment->weld[v]] >= 0)
			rim[v] = forest_root(rim, garment->weld[v]);
}

/* ---- where flat cloth stands ---- */

/* Flat cloth under a mark: a point of the piece there and on the body, and what its axes become. */
struct flat_frame {
	bool known;
	struct v2 from_m, u;
	struct v3 to_m, along, left;
};

static struct flat_frame frame_of(const struct cloth_mark *mark, const struct body_mark *on)
{
	struct v3 normal = {0.0f, 0.0f, 0.0f};
	for (int i = 0; i < on->point_count; i++)
		normal = v3_add(normal, on->normal[i]);
	struct v2 way = v2_sub(mark->point_mm[mark->point_count - 1], mark->point_mm[0]);
	struct v3 along = v3_normalize(v3_sub(on->point_m[on->point_count - 1], on->point_m[0]));
	return (struct flat_frame){
		true,  v2_scale(mark->point_mm[0], 0.001f),  v2_normalize(way), on->point_m[0],
		along, v3_normalize(v3_cross(normal, along))};
}

static void find_frames(const struct wrap *wrap, struct flat_frame frame[PIECES_MAX])
{
	memset(frame, 0, PIECES_MAX * sizeof *frame);
	for (int m = 0; m < MARKS_MAX; m++) {
		const struct cloth_mark *mark = &wrap->marks->cloth[m];
		const struct body_mark *on = mark->used ? wrap_partner(wrap, mark->number) : NULL;
		if (on && mark->point_count > 1 && on->point_count > 1 &&
		    wrap->scratch->home[mark->piece] == PART_TRUNK && !frame[mark->piece].known)
			frame[mark->piece] = frame_of(mark, on);
	}
}

static struct v3 flat_place(const struct flat_frame *frame, struct v2 rest_m)
{
	struct v2 way = v2_sub(rest_m, frame->from_m);
	struct v3 p_m = v3_mad(frame->to_m, frame->along, v2_dot(frame->u, way));
	return v3_mad(p_m, frame->left, v2_cross(frame->u, way));
}

/* ---- which opening is a limb's ---- */

struct limb {
	bool leg;
	struct v3 joint_m;
	float length_m;
	float middle_m; /* x of the figure's middle, */
	float out;      /* and -1 or 1: to the limb's side of it */
};

static bool find_limb(const struct body *body, int part, struct limb *limb)
{
	*limb = (struct limb){.leg = part >= PART_LEG_LEFT,
			      .middle_m = 0.5f * (body->low_m.x + body->high_m.x)};
	for (int b = 0; b < body->bone_count; b++) {
		const struct bone *bone = &body->bone[b];
		if ((int)bone->part != part)
			continue;
		if (limb->length_m == 0.0f)
			limb->joint_m = bone->a_m;
		limb->length_m += v3_distance(bone->a_m, bone->b_m);
	}
	limb->out = limb->joint_m.x > limb->middle_m ? 1.0f : -1.0f;
	return limb->length_m > 0.0f;
}

/* No piece of its own goes round this limb. */
static bool is_bare(const struct wrap *wrap, int part)
{
	for (int p = 0; p < PIECES_MAX; p++)
		if (wrap->scratch->home[p] == part)
			return false;
	return true;
}

/* The middles of the openings, where flat cloth has them, at the vertices that stand for them: sums
 * in sum_m, their numbers in count. */
static void sum_rims(struct wrap *wrap, const struct flat_frame frame[PIECES_MAX])
{
	struct wrap_scratch *s = wrap->scratch;
	const struct garment *garment = wrap->cloth->garment;
	memset(s->sum_m, 0, (size_t)garment->vertex_count * sizeof *s->sum_m);
	memset(s->count, 0, (size_t)garment->vertex_count * sizeof *s->count);
	for (int v = 0; v < garment->vertex_count; v++) {
		const struct flat_frame *on = &frame[garment->piece[v]];
		if (s->rim[v] < 0 || !on->known)
			continue;
		struct v3 *sum = &s->sum_m[s->rim[v]];
		*sum = v3_add(*sum, flat_place(on, garment->rest_m[v]));
		s->count[s->rim[v]]++;
	}
}

/* How far along the limb's side of the figure a place is; 0 and below: it is not there. */
static float reach_of(const struct limb *limb, struct v3 at_m)
{
	float beside_m = limb->out * (at_m.x - limb->middle_m);
	float joint_m = limb->out * (limb->joint_m.x - limb->middle_m);
	if (limb->leg)
		return beside_m > beside_least * joint_m ? limb->joint_m.y - at_m.y : 0.0f;
	return beside_m - joint_m;
}

/* The opening that is farthest along, no farther than the limb could ever reach; -1: none is. */
static int find_opening(const struct wrap *wrap, const struct limb *limb, struct v3 *middle_m)
{
	const struct wrap_scratch *s = wrap->scratch;
	float far_m = reach_least * limb->length_m;
	int found = -1;
	*middle_m = limb->joint_m;
	for (int v = 0; v < wrap->cloth->garment->vertex_count; v++) {
		if (s->rim[v] != v || s->count[v] == 0)
			continue;
		struct v3 at_m = v3_scale(s->sum_m[v], 1.0f / (float)s->count[v]);
		struct v3 way = v3_sub(at_m, limb->joint_m);
		way.z = 0.0f;
		if (reach_of(limb, at_m) < far_m || v3_length(way) > reach_most * limb->length_m)
			continue;
		far_m = reach_of(limb, at_m);
		*middle_m = at_m;
		found = v;
	}
	return found;
}

/* Where the limb's bones are, so far from its joint. */
static struct v3 on_limb(const struct body *body, int part, float reach_m)
{
	struct v3 at_m = {0.0f, 0.0f, 0.0f};
	for (int b = 0; b < body->bone_count; b++) {
		const struct bone *bone = &body->bone[b];
		if ((int)bone->part != part || reach_m < 0.0f)
			continue;
		float length_m = float_max(v3_distance(bone->a_m, bone->b_m), 1e-4f);
		at_m = v3_lerp(bone->a_m, bone->b_m, float_min(reach_m / length_m, 1.0f));
		reach_m -= length_m;
	}
	return at_m;
}

/* Half of an opening's half width: the mean distance of its vertices from its middle. */
static float half_width(const struct wrap *wrap, const struct flat_frame frame[PIECES_MAX],
			int opening, struct v3 middle_m)
{
	const struct wrap_scratch *s = wrap->scratch;
	const struct garment *garment = wrap->cloth->garment;
	float sum_m = 0.0f;
	for (int v = 0; v < garment->vertex_count; v++) {
		const struct flat_frame *on = &frame[garment->piece[v]];
		if (s->rim[v] == opening && on->known)
			sum_m += v3_distance(flat_place(on, garment->rest_m[v]), middle_m);
	}
	return sum_m / (float)int_max(s->count[opening], 1);
}

/* The direction of a tube, from the limb's joint to the opening's middle; none, (0, 0, 0), when the
 * limb passes near enough to the middle as it is. */
static struct v3 tube_way(const struct wrap *wrap, const struct flat_frame frame[PIECES_MAX],
			  int part, const struct limb *limb, struct v3 middle_m)
{
	struct v3 to = v3_sub(middle_m, limb->joint_m);
	to.z = 0.0f; /* between front and back */
	struct v3 from = v3_sub(on_limb(wrap->scratch->full, part, v3_length(to)), limb->joint_m);
	float aside_m = v3_distance(v3_scale(v3_normalize(from), v3_length(to)), to);
	if (aside_m < 0.5f * half_width(wrap, frame, wrap->scratch->opening[part], middle_m))
		return (struct v3){0.0f, 0.0f, 0.0f};
	return v3_normalize(to);
}

void wrap_find_openings(struct wrap *wrap)
{
	struct wrap_scratch *s = wrap->scratch;
	struct flat_frame frame[PIECES_MAX];
	find_rims(wrap);
	find_frames(wrap, frame);
	sum_rims(wrap, frame);
	for (int part = 0; part < PART_COUNT; part++) {
		struct limb limb;
		struct v3 middle_m;
		s->opening[part] = -1;
		s->toward[part] = (struct v3){0.0f, 0.0f, 0.0f};
		if (part < PART_ARM_LEFT || !is_bare(wrap, part) ||
		    !find_limb(s->full, part, &limb))
			continue;
		s->opening[part] = find_opening(wrap, &limb, &middle_m);
		if (s->opening[part] >= 0)
			s->toward[part] = tube_way(wrap, frame, part, &limb, middle_m);
	}
}

/* The angle round the limb's bones from one point to another. */
static float angle_round(const struct body *body, int part, struct v3 from_m, struct v3 to_m)
{
	struct beside a, b;
	if (!body_beside(body, part, from_m, &a) || !body_beside(body, part, to_m, &b))
		return 0.0f;
	struct v3 u = v3_sub(from_m, a.axis_m), w = v3_sub(to_m, b.axis_m);
	return angle_atan2(v3_dot(v3_cross(u, w), a.along), v3_dot(u, w));
}

bool wrap_in_opening(const struct wrap *wrap, int part)
{
	const struct cloth *cloth = wrap->cloth;
	const struct garment *garment = cloth->garment;
	float round_rad = 0.0f;
	for (int i = 0; i < 3 * garment->triangle_count; i++) {
		const int *v = garment->triangle[i / 3].v, k = i % 3;
		int a = garment->weld[v[k]], b = garment->weld[v[(k + 1) % 3]];
		if (wrap->scratch->rim[a] != wrap->scratch->opening[part] ||
		    !is_rim(wrap, int_min(a, b), int_max(a, b)))
			continue;
		round_rad += angle_round(cloth->body, part, cloth->position_m[a],
					 cloth->position_m[b]);
	}
	return float_abs(round_rad) > PI_F;
}

void wrap_carry(struct wrap *wrap, float share)
{
	struct cloth *cloth = wrap->cloth;
	const struct slim_body *slim = &wrap->scratch->slim;
	bool any = false;
	for (int part = 0; part < PART_COUNT; part++)
		any = any || v3_length(wrap->scratch->toward[part]) > 0.0f;
	if (!any)
		return;
	for (int v = 0; v < cloth->garment->vertex_count; v++) {
		struct body_hit hit;
		if (!is_particle(cloth, v))
			continue;
		body_nearest(&slim->body, cloth->position_m[v], 0, &hit);
		cloth->position_m[v] = body_slim_carry(slim, wrap->scratch->full, hit.triangle,
						       cloth->position_m[v], share);
	}
}
