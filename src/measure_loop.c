/* Which bones pass through which rim of the garment: how one knows that an arm is in its sleeve. */
#include "measure_private.h"

/* ---- linking ---- */

/* The solid angle under which a tetrahedron's face shows, halved, for both triangles of the
 * quadrilateral that the segments a[0] a[1] and b[0] b[1] sweep out. Gauss's integral over the two
 * segments in closed form: Bertolazzi, Ghiloni and Specogna, "Efficient computation of linking
 * number with certification" (2019), equation 8. */
static float segment_linking(struct v3 a0, struct v3 a1, struct v3 b0, struct v3 b1)
{
	struct v3 p = v3_sub(b0, a0), q = v3_sub(b0, a1), r = v3_sub(b1, a1), s = v3_sub(b1, a0);
	float lp = v3_length(p), lq = v3_length(q), lr = v3_length(r), ls = v3_length(s);
	float volume = v3_dot(p, v3_cross(q, r));
	float first = lp * lq * lr + v3_dot(p, q) * lr + v3_dot(q, r) * lp + v3_dot(r, p) * lq;
	float second = lp * ls * lr + v3_dot(p, s) * lr + v3_dot(s, r) * lp + v3_dot(r, p) * ls;
	return angle_atan2(volume, first) + angle_atan2(volume, second);
}

float measure_linking(const struct v3 *a, int a_count, const struct v3 *b, int b_count)
{
	float sum = 0.0f;
	for (int i = 0; i < a_count; i++) {
		float row = 0.0f;
		for (int k = 0; k < b_count; k++)
			row += segment_linking(a[i], a[(i + 1) % a_count], b[k],
					       b[(k + 1) % b_count]);
		sum += row;
	}
	return sum / (2.0f * PI_F);
}

/* ---- bone chains ---- */

struct chain {
	int count;
	struct v3 *point_m;
};

/* Bones that continue one another share a point, which is taken once. */
static void chain_add(struct chain *chain, struct v3 point_m)
{
	if (chain->count > 0 && v3_distance(chain->point_m[chain->count - 1], point_m) < 1e-6f)
		return;
	MUST(chain->count < CHAIN_MAX);
	chain->point_m[chain->count++] = point_m;
}

/* The bones of the part, from trunk to tip; returns how many. */
static int list_bones(const struct body *body, enum body_part part, int bone[BODY_BONES_MAX])
{
	int count = 0;
	for (int b = 0; b < body->bone_count; b++)
		if (body->bone[b].part == part)
			bone[count++] = b;
	return count;
}

/* The spine is the first run of trunk bones (body.h); upward or downward. */
static void add_spine(struct chain *chain, const struct body *body, bool upward)
{
	int count = 0;
	while (count < body->bone_count && body->bone[count].part == PART_TRUNK)
		count++;
	for (int i = 0; i < count; i++) {
		const struct bone *bone = &body->bone[upward ? i : count - 1 - i];
		chain_add(chain, upward ? bone->a_m : bone->b_m);
		chain_add(chain, upward ? bone->b_m : bone->a_m);
	}
}

static void add_outward(struct chain *chain, const struct body *body, enum body_part part)
{
	int bone[BODY_BONES_MAX], count = list_bones(body, part, bone);
	for (int i = 0; i < count; i++) {
		chain_add(chain, body->bone[bone[i]].a_m);
		chain_add(chain, body->bone[bone[i]].b_m);
	}
}

static void add_inward(struct chain *chain, const struct body *body, enum body_part part)
{
	int bone[BODY_BONES_MAX], count = list_bones(body, part, bone);
	for (int i = count - 1; i >= 0; i--) {
		chain_add(chain, body->bone[bone[i]].b_m);
		chain_add(chain, body->bone[bone[i]].a_m);
	}
}

/* From the far end of the chain round to its far start, out of reach of any garment: by a corner
 * that lies square to both. */
static void close_far(struct chain *chain, struct v3 centre_m, float far_m)
{
	struct v3 begin = v3_sub(chain->point_m[0], centre_m);
	struct v3 end = v3_sub(chain->point_m[chain->count - 1], centre_m);
	struct v3 side = v3_cross(v3_normalize(begin), v3_normalize(end));
	if (v3_length(side) < 0.2f)
		side = v3_cross(begin, (struct v3){1.0f, 0.0f, 0.0f});
	if (v3_length(side) < 0.2f)
		side = (struct v3){0.0f, 0.0f, 1.0f};
	chain_add(chain, v3_mad(centre_m, v3_normalize(side), 2.0f * far_m));
}

/* Straight on beyond a hand, straight up from the crown, straight down from foot and pelvis. */
static struct v3 beyond(const struct body *body, enum body_part part, float far_m)
{
	int bone[BODY_BONES_MAX], count = list_bones(body, part, bone);
	const struct bone *last = &body->bone[bone[count - 1]];
	struct v3 out = {0.0f, part == PART_HEAD ? 1.0f : -1.0f, 0.0f};
	if (part == PART_ARM_LEFT || part == PART_ARM_RIGHT)
		out = v3_normalize(v3_sub(last->b_m, last->a_m));
	return v3_mad(last->b_m, out, far_m);
}

int measure_chain(const struct body *body, enum body_part part, struct v3 point_m[CHAIN_MAX])
{
	struct chain chain = {0, point_m};
	bool leg = part == PART_LEG_LEFT || part == PART_LEG_RIGHT;
	enum body_part outer = part == PART_TRUNK ? PART_HEAD : part;
	int bone[BODY_BONES_MAX];
	if (list_bones(body, outer, bone) == 0 || (leg && list_bones(body, PART_HEAD, bone) == 0))
		return 0;
	struct v3 centre_m = v3_lerp(body->low_m, body->high_m, 0.5f);
	float far_m = 6.0f * (body->high_m.y - body->low_m.y);
	chain_add(&chain, beyond(body, outer, far_m));
	add_inward(&chain, body, outer);
	add_spine(&chain, body, leg);
	if (leg) {
		add_outward(&chain, body, PART_HEAD);
		chain_add(&chain, beyond(body, PART_HEAD, far_m));
	} else {
		struct v3 pelvis_m = chain.point_m[chain.count - 1];
		chain_add(&chain, (struct v3){pelvis_m.x, pelvis_m.y - far_m, pelvis_m.z});
	}
	close_far(&chain, centre_m, far_m);
	return chain.count;
}

/* ---- rims ---- */

/* The rim edge that follows `edge` at its end `v`: turning about v from triangle to triangle until
 * there is no next one. -1: the surface there is not a sheet. */
static int next_rim(const struct measure_scratch *s, int edge, int v)
{
	int t = s->edge[edge].triangle[0], from = edge;
	for (int turn = 0; turn < GARMENT_TRIANGLES_MAX; turn++) {
		int other = -1;
		for (int k = 0; k < 3; k++) {
			int e = s->edge_of[3 * t + k];
			if (e >= 0 && e != from && (s->edge[e].a == v || s->edge[e].b == v))
				other = e;
		}
		if (other < 0 || s->edge[other].triangle_count > 2)
			return -1;
		if (s->edge[other].triangle_count == 1)
			return other;
		const int *side = s->edge[other].triangle;
		t = side[0] == t ? side[1] : side[0];
		from = other;
	}
	return -1;
}

/* Walks the rim from an edge; returns the number of vertices in s->loop, 0 when it does not close.
 */
static int walk_rim(struct measure_scratch *s, int first)
{
	int edge = first, at = s->edge[first].b, count = 0;
	s->loop[count++] = s->edge[first].a;
	s->walked[first] = 1;
	for (int step = 0; step < s->edge_count; step++) {
		int next = next_rim(s, edge, at);
		if (next == first)
			return count;
		if (next < 0 || s->walked[next])
			return 0;
		s->walked[next] = 1;
		s->loop[count++] = at;
		at = s->edge[next].a == at ? s->edge[next].b : s->edge[next].a;
		edge = next;
	}
	return 0;
}

/* A linking number that is far from whole means a rim that touches the bones: counted as unlinked.
 */
static int whole(float linking)
{
	if (!(float_abs(linking) < 1000.0f))
		return 0;
	int nearest = (int)(linking + (linking < 0.0f ? -0.5f : 0.5f));
	return float_abs(linking - (float)nearest) < 0.1f ? nearest : 0;
}

static void link_loop(const struct cloth *cloth, struct measure_scratch *s, int count,
		      struct loop_link *link)
{
	struct v3 *rim_m = s->rim_m;
	struct v3 sum = {0.0f, 0.0f, 0.0f}, chain[CHAIN_MAX];
	*link = (struct loop_link){.vertex_count = count};
	for (int i = 0; i < count; i++) {
		rim_m[i] = cloth->position_m[s->loop[i]];
		sum = v3_add(sum, rim_m[i]);
	}
	for (int i = 0; i < count; i++)
		link->length_m += v3_distance(rim_m[i], rim_m[(i + 1) % count]);
	link->centre_m = v3_scale(sum, 1.0f / (float)count);
	for (int part = 0; part < PART_COUNT; part++) {
		int points = measure_chain(cloth->body, (enum body_part)part, chain);
		if (points > 0)
			link->linking[part] = whole(measure_linking(rim_m, count, chain, points));
	}
}

/* The longest rims are kept, longest first. */
static void keep_loop(struct measure *measure, const struct loop_link *link)
{
	int at = measure->loop_count;
	while (at > 0 && measure->loop[at - 1].length_m < link->length_m)
		at--;
	if (at == LOOPS_MAX)
		return;
	measure->loop_count = int_min(measure->loop_count + 1, LOOPS_MAX);
	for (int i = measure->loop_count - 1; i > at; i--)
		measure->loop[i] = measure->loop[i - 1];
	measure->loop[at] = *link;
}

/* Does the loop hold this limb and nothing else? */
static bool holds_only(const struct loop_link *link, enum body_part part)
{
	for (int p = 0; p < PART_COUNT; p++)
		if ((link->linking[p] != 0) != (p == (int)part))
			return false;
	return true;
}

static int count_limbs(const struct measure *measure, enum body_part left, enum body_part right)
{
	bool in_left = false, in_right = false;
	for (int l = 0; l < measure->loop_count; l++) {
		in_left = in_left || holds_only(&measure->loop[l], left);
		in_right = in_right || holds_only(&measure->loop[l], right);
	}
	return in_left + in_right;
}

void measure_loops(struct measure *measure, const struct cloth *cloth, struct measure_scratch *s)
{
	struct loop_link link;
	memset(s->walked, 0, (size_t)s->edge_count);
	for (int e = 0; e < s->edge_count; e++) {
		if (s->edge[e].triangle_count != 1 || s->walked[e])
			continue;
		int count = walk_rim(s, e);
		if (count == 0)
			continue;
		link_loop(cloth, s, count, &link);
		keep_loop(measure, &link);
		measure_girth_at_rim(measure, cloth, s, count);
	}
	for (int l = 0; l < measure->loop_count; l++) {
		const int *linking = measure->loop[l].linking;
		if (linking[PART_HEAD] != 0 && linking[PART_ARM_LEFT] == 0 &&
		    linking[PART_ARM_RIGHT] == 0)
			measure->head_through_collar = true;
	}
	measure->arms_in_sleeves = count_limbs(measure, PART_ARM_LEFT, PART_ARM_RIGHT);
	measure->legs_in_legs = count_limbs(measure, PART_LEG_LEFT, PART_LEG_RIGHT);
}
