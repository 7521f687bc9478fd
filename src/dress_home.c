/* Where each piece belongs: on the trunk, the head or one limb. Marks say so for the pieces that
 * carry them; the others belong where what they are sewn to belongs. Until it has arrived a piece
 * meets only the body parts that it has to do with, and bends round their bones. */
#include "dress_private.h"

enum { TRUNK_BIT = 1 << PART_TRUNK };

static const float curl_radius_least_m = 0.005f; /* nearer to a bone there is no way round it */

/* Points of a piece's marks that lie on each part of the body. */
static void vote(const struct wrap *wrap, int votes[PIECES_MAX][PART_COUNT])
{
	const struct marks *marks = wrap->marks;
	memset(votes, 0, PIECES_MAX * sizeof *votes);
	for (int m = 0; m < MARKS_MAX; m++) {
		const struct cloth_mark *mark = &marks->cloth[m];
		const struct body_mark *on = mark->used ? wrap_partner(wrap, mark->number) : NULL;
		for (int i = 0; on && i < on->point_count; i++) {
			struct body_hit hit;
			body_nearest(wrap->cloth->body, on->point_m[i], 0, &hit);
			votes[mark->piece][wrap->cloth->body->part[hit.triangle]]++;
		}
	}
}

static int most_votes(const int votes[PART_COUNT])
{
	int most = 0;
	for (int part = 1; part < PART_COUNT; part++)
		most = votes[part] > votes[most] ? part : most;
	return votes[most] > 0 ? most : PART_NONE;
}

/* A piece with a mark on a limb belongs there even if it covers more of the trunk. */
static int marked_home(const int votes[PART_COUNT])
{
	int all = 0, limb = PART_ARM_LEFT;
	for (int part = 0; part < PART_COUNT; part++) {
		all += votes[part];
		limb = part >= PART_ARM_LEFT && votes[part] > votes[limb] ? part : limb;
	}
	return 4 * votes[limb] > all ? limb : most_votes(votes);
}

/* One round of handing homes on over seams: a piece without one takes the home to which most of its
 * sewn vertices lead. Returns how many were handed on. */
static int hand_on(struct wrap *wrap)
{
	const struct garment *garment = wrap->cloth->garment;
	int8_t *home = wrap->scratch->home;
	int votes[PIECES_MAX][PART_COUNT], found = 0;
	memset(votes, 0, sizeof votes);
	for (int i = 0; i < 2 * garment->pair_count; i++) {
		const struct seam_pair *pair = &garment->pair[i / 2];
		int from = garment->piece[i & 1 ? pair->b : pair->a];
		int to = garment->piece[i & 1 ? pair->a : pair->b];
		if (home[from] != PART_NONE && home[to] == PART_NONE)
			votes[to][home[from]]++;
	}
	for (int p = 0; p < PIECES_MAX; p++) {
		int part = home[p] == PART_NONE ? most_votes(votes[p]) : PART_NONE;
		if (part == PART_NONE)
			continue;
		home[p] = (int8_t)part;
		found++;
	}
	return found;
}

/* A limb with pieces of its own is theirs alone; every other limb is met by all that lies on the
 * trunk. */
static void allow_parts(struct wrap *wrap)
{
	struct cloth *cloth = wrap->cloth;
	const int8_t *home = wrap->scratch->home;
	unsigned taken = 0;
	for (int p = 0; p < PIECES_MAX; p++)
		if (home[p] >= PART_ARM_LEFT)
			taken |= 1u << home[p];
	unsigned all = (1u << PART_COUNT) - 1;
	for (int p = 0; p < PIECES_MAX; p++) {
		bool limb = home[p] >= PART_ARM_LEFT;
		cloth->piece_parts[p] = limb ? 1u << home[p] | TRUNK_BIT : all & ~taken;
	}
}

void wrap_meet_all(struct wrap *wrap)
{
	for (int p = 0; p < PIECES_MAX; p++)
		wrap->cloth->piece_parts[p] = (1u << PART_COUNT) - 1;
}

void wrap_find_homes(struct wrap *wrap)
{
	int votes[PIECES_MAX][PART_COUNT];
	int8_t *home = wrap->scratch->home;
	vote(wrap, votes);
	for (int p = 0; p < PIECES_MAX; p++)
		home[p] = (int8_t)marked_home(votes[p]);
	while (hand_on(wrap) > 0)
		;
	allow_parts(wrap);
}

static bool lives_on(const struct wrap *wrap, enum body_part first, enum body_part last)
{
	const struct garment *garment = wrap->cloth->garment;
	for (int v = 0; v < garment->vertex_count; v++) {
		int home = wrap->scratch->home[garment->piece[v]];
		if (home >= (int)first && home <= (int)last)
			return true;
	}
	return false;
}

/* A collar or a hood goes on at the neck and is sewn to what is worn there; a mask is not. */
static bool is_mask(const struct wrap *wrap)
{
	const struct garment *garment = wrap->cloth->garment;
	const int8_t *home = wrap->scratch->home;
	for (int i = 0; i < garment->pair_count; i++) {
		int a = home[garment->piece[garment->pair[i].a]];
		int b = home[garment->piece[garment->pair[i].b]];
		if ((a == PART_HEAD) != (b == PART_HEAD))
			return false;
	}
	return lives_on(wrap, PART_HEAD, PART_HEAD);
}

static float trunk_middle_m(const struct body *body)
{
	float low_m = 1e9f, high_m = -1e9f;
	for (int b = 0; b < body->bone_count; b++)
		if (body->bone[b].part == PART_TRUNK) {
			low_m = float_min(low_m, body->bone[b].a_m.y);
			high_m = float_max(high_m, body->bone[b].b_m.y);
		}
	return 0.5f * (low_m + high_m);
}

/* All of it belongs on the trunk, no mark lies on the trunk's upper half, and no leg has an opening
 * of its own. */
static bool is_skirt(const struct wrap *wrap)
{
	float middle_m = trunk_middle_m(wrap->cloth->body);
	for (int m = 0; m < MARKS_MAX; m++) {
		const struct cloth_mark *mark = &wrap->marks->cloth[m];
		const struct body_mark *on = mark->used ? wrap_partner(wrap, mark->number) : NULL;
		for (int i = 0; on && i < on->point_count; i++)
			if (on->point_m[i].y > middle_m)
				return false;
	}
	bool tubes = wrap->scratch->opening[PART_LEG_LEFT] >= 0 ||
		     wrap->scratch->opening[PART_LEG_RIGHT] >= 0;
	return !tubes && !lives_on(wrap, PART_HEAD, PART_LEG_RIGHT);
}

unsigned wrap_whole_parts(const struct wrap *wrap)
{
	unsigned head = 1u << PART_HEAD, legs = 1u << PART_LEG_LEFT | 1u << PART_LEG_RIGHT;
	return (is_mask(wrap) ? head : 0) | (is_skirt(wrap) ? legs : 0);
}

/* Vertices - edges + triangles of each garment, by layer. */
static void count_euler(const struct cloth *cloth, int euler[PIECES_MAX])
{
	const struct garment *garment = cloth->garment;
	memset(euler, 0, PIECES_MAX * sizeof *euler);
	for (int v = 0; v < garment->vertex_count; v++)
		euler[garment->layer[garment->piece[v]]] += is_particle(cloth, v);
	/* three edges a triangle; those of two triangles are one */
	for (int t = 0; t < garment->triangle_count; t++)
		euler[garment->layer[garment->triangle_piece[t]]] -= 2;
	for (int f = 0; f < cloth->flat_count; f++)
		euler[garment->layer[garment->piece[cloth->flat[f].v[0]]]]++;
}

void wrap_find_blown(struct wrap *wrap)
{
	struct cloth *cloth = wrap->cloth;
	int euler[PIECES_MAX];
	bool mask = is_mask(wrap);
	count_euler(cloth, euler);
	for (int p = 0; p < PIECES_MAX; p++)
		cloth->piece_blown[p] = euler[cloth->garment->layer[p]] < 1 &&
					!(mask && wrap->scratch->home[p] == PART_HEAD);
}

/* ---- bones as axes ---- */

bool wrap_outward(const struct body *body, const struct body_hit *hit, struct v3 *out)
{
	struct beside at;
	if (!body_beside(body, body->part[hit->triangle], hit->point_m, &at))
		return false;
	*out = v3_normalize(v3_sub(hit->point_m, at.axis_m));
	return true;
}

struct v3 wrap_curl(const struct wrap *wrap, int piece, struct v3 from_m, struct v3 to_m)
{
	struct beside at;
	int home = wrap->scratch->home[piece];
	if (home < PART_ARM_LEFT || !body_beside(wrap->cloth->body, home, from_m, &at))
		return to_m;
	struct v3 arm = v3_sub(from_m, at.axis_m);
	arm = v3_mad(arm, at.along, -v3_dot(arm, at.along));
	float radius = v3_length(arm);
	if (radius < curl_radius_least_m)
		return to_m;
	struct v3 step = v3_sub(to_m, from_m), out = v3_scale(arm, 1.0f / radius);
	struct v3 round = v3_cross(at.along, out);
	float turn = v3_dot(step, round) / radius;
	struct v3 straight = v3_mad(step, round, -v3_dot(step, round));
	struct v3 beside = v3_add(v3_sub(from_m, at.axis_m), straight);
	return v3_add(at.axis_m, v3_turn(beside, at.along, turn));
}
