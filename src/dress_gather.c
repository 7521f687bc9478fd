/* Sleeves and trouser legs that are longer than their limb: they are laid, sewn and worn gathered
 * along it, so that they end above hand or foot. A little too much gets its length back once the
 * garment is on, and lies in wrinkles; more would fold over itself at this size of triangles, so it
 * stays gathered, and the report says so. */
#include "dress_private.h"

#define UNDECIDED 0.0f /* share of a piece that may be gathered */

static const float bare_m = 0.015f;     /* above hand or foot */
static const float share_least = 0.6f;  /* what is longer still hangs over the hand */
static const float share_shown = 0.93f; /* less can't be seen in wrinkles */

/* The piece's outermost place along a direction, or against it. */
static float end_of(const struct garment *garment, int piece, struct v2 along)
{
	float end_m = -1e9f;
	for (int v = garment->piece_first[piece]; v < garment->piece_first[piece + 1]; v++)
		end_m = float_max(end_m, v2_dot(garment->rest_m[v], along));
	return end_m;
}

/* How far it still is along the limb's bones to wrist or ankle, below 0: past them. */
static float room(const struct wrap *wrap, int home, struct v3 p_m)
{
	struct beside at;
	if (!body_beside(wrap->cloth->body, home, p_m, &at))
		return LIMB_ENDLESS_M;
	return wrap->scratch->limb[home].wrist_m - at.reach_m;
}

/* Marks a piece as one that may be gathered along its mark. Returns how much of its length has
 * room: 1 or more: all. */
static float measure(struct wrap *wrap, const struct cloth_mark *mark, const struct body_mark *on)
{
	struct wrap_scratch *s = wrap->scratch;
	const struct mark_line *cloth = &s->on_cloth, *body = &s->on_body;
	int home = s->home[mark->piece];
	wrap_body_line(wrap, on);
	wrap_cloth_line(wrap, mark);
	struct v3 first_m = cloth->point_m[0], last_m = cloth->point_m[cloth->count - 1];
	struct v2 begin = {first_m.x, first_m.y}, end = {last_m.x, last_m.y};
	struct v2 along = v2_normalize(v2_sub(end, begin));
	float room_m = room(wrap, home, body->point_m[0]);
	float end_m = room(wrap, home, body->point_m[body->count - 1]);
	if (room_m > 0.5f * LIMB_ENDLESS_M || end_m > room_m)
		return 1.0f; /* it does not run down the limb */
	if (wrap->cloth->piece_gather[mark->piece].share == 1.0f)
		wrap->cloth->piece_gather[mark->piece] = (struct gather){
			along, v2_dot(begin, along), UNDECIDED};
	float cloth_m = cloth->length_m + end_of(wrap->cloth->garment, mark->piece, along) -
			v2_dot(end, along);
	return (body->length_m + end_m - bare_m) / float_max(cloth_m, 1e-3f);
}

/* The seam's direction between pair i and the next, on the sides of two pieces. False: the pair
 * does not join them, or the seam ends there. */
static bool seam_step(const struct garment *garment, int i, int from, int to, struct v2 *a,
		      struct v2 *b)
{
	if (i + 1 == garment->pair_count)
		return false;
	const struct seam_pair *pair = &garment->pair[i], *next = &garment->pair[i + 1];
	bool turned = garment->piece[pair->a] == to;
	int near = turned ? pair->b : pair->a, near_next = turned ? next->b : next->a;
	int far = turned ? pair->a : pair->b, far_next = turned ? next->a : next->b;
	*a = v2_sub(garment->rest_m[near_next], garment->rest_m[near]);
	*b = v2_sub(garment->rest_m[far_next], garment->rest_m[far]);
	return pair->seam == next->seam && garment->piece[near] == from &&
	       garment->piece[far] == to;
}

/* A piece of the limb that has no mark lies as what it is sewn to: along its seams the direction
 * goes over from piece to piece, for it stands to a seam as it stands to its other side. */
static void hand_on(struct wrap *wrap, int from, int to)
{
	const struct garment *garment = wrap->cloth->garment;
	struct gather *gather = wrap->cloth->piece_gather;
	struct v2 sum = {0.0f, 0.0f}, a, b, u = gather[from].along;
	int count = 0;
	for (int i = 0; i < garment->pair_count; i++) {
		if (!seam_step(garment, i, from, to, &a, &b))
			continue;
		struct v2 aside = {-b.y, b.x};
		sum = v2_add(sum,
			     v2_add(v2_scale(b, v2_dot(u, a)), v2_scale(aside, v2_cross(a, u))));
		count++;
	}
	if (count == 0)
		return;
	struct v2 along = v2_normalize(sum);
	float begin_m = -end_of(garment, to, v2_scale(along, -1.0f));
	gather[to] = (struct gather){along, begin_m, UNDECIDED};
}

static void hand_on_all(struct wrap *wrap)
{
	const int8_t *home = wrap->scratch->home;
	const struct gather *gather = wrap->cloth->piece_gather;
	for (int from = 0; from < PIECES_MAX; from++)
		for (int to = 0; to < PIECES_MAX; to++)
			if (home[from] >= PART_ARM_LEFT && home[to] == home[from] &&
			    gather[from].share == UNDECIDED && gather[to].share == 1.0f)
				hand_on(wrap, from, to);
}

void wrap_gather(struct wrap *wrap)
{
	float share[PART_COUNT];
	struct wrap_scratch *s = wrap->scratch;
	struct gather *gather = wrap->cloth->piece_gather;
	for (int part = 0; part < PART_COUNT; part++)
		share[part] = 1.0f;
	for (int m = 0; m < MARKS_MAX; m++) {
		const struct cloth_mark *mark = &wrap->marks->cloth[m];
		const struct body_mark *on = mark->used ? wrap_partner(wrap, mark->number) : NULL;
		int home = s->home[mark->piece];
		if (on && mark->point_count > 1 && on->point_count > 1 && home >= PART_ARM_LEFT)
			share[home] = float_min(share[home], measure(wrap, mark, on));
	}
	hand_on_all(wrap);
	for (int p = 0; p < PIECES_MAX; p++) {
		s->in_tube[p] = gather[p].share == UNDECIDED;
		if (s->in_tube[p])
			gather[p].share = float_max(share[s->home[p]], share_least);
	}
	cloth_take_gathers(wrap->cloth);
	wrap_measure_tubes(wrap);
}

static void say_gathered(struct wrap *wrap)
{
	for (int p = 0; p < PIECES_MAX; p++) {
		int mark = wrap_piece_mark(wrap, p);
		if (mark && wrap->cloth->piece_gather[p].share < 1.0f)
			wrap_diagnose(wrap, "gathered", mark, 0,
				      "The cloth of mark %1 is longer than the limb; it lies "
				      "gathered above hand or foot.");
	}
}

void wrap_let_out(struct wrap *wrap)
{
	struct gather *gather = wrap->cloth->piece_gather;
	for (int p = 0; p < PIECES_MAX; p++)
		if (gather[p].share > share_shown)
			gather[p].share = 1.0f;
	cloth_take_gathers(wrap->cloth);
	say_gathered(wrap);
}
