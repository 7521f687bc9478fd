/* Sleeves and trouser legs are tubes round their limb, as wide as they are cut, however thin the
 * limb is; and they go round hand or foot as round a mitten, as collars go round neck and head. */
#include "dress_private.h"

static const float section_m = 0.03f;
static const float edge_longest = 1.5f; /* of the mesh's edge length */

/* Sections of a tube are counted from its hem. */
static int section_of(float up_m)
{
	return (int)float_clamp(up_m / section_m, 0.0f, (float)(TUBE_SECTIONS - 1));
}

/* Adds the piece's width in each section to the girth of the tube round its limb. */
static void add_widths(struct wrap *wrap, int piece)
{
	struct wrap_scratch *s = wrap->scratch;
	const struct garment *garment = wrap->cloth->garment;
	const struct gather *gather = &wrap->cloth->piece_gather[piece];
	float least_m[TUBE_SECTIONS], most_m[TUBE_SECTIONS];
	for (int i = 0; i < TUBE_SECTIONS; i++) {
		least_m[i] = 1e9f;
		most_m[i] = -1e9f;
	}
	s->hem_m[piece] = -1e9f;
	for (int v = garment->piece_first[piece]; v < garment->piece_first[piece + 1]; v++)
		s->hem_m[piece] = float_max(s->hem_m[piece],
					    v2_dot(garment->rest_m[v], gather->along));
	for (int v = garment->piece_first[piece]; v < garment->piece_first[piece + 1]; v++) {
		float at_m = v2_dot(garment->rest_m[v], gather->along);
		float aside_m = v2_cross(gather->along, garment->rest_m[v]);
		int i = section_of(s->hem_m[piece] - at_m);
		least_m[i] = float_min(least_m[i], aside_m);
		most_m[i] = float_max(most_m[i], aside_m);
	}
	for (int i = 0; i < TUBE_SECTIONS; i++)
		s->tube_m[s->home[piece]][i] += float_max(most_m[i] - least_m[i], 0.0f);
}

void wrap_measure_tubes(struct wrap *wrap)
{
	memset(wrap->scratch->tube_m, 0, sizeof wrap->scratch->tube_m);
	for (int p = 0; p < PIECES_MAX; p++)
		if (wrap->scratch->in_tube[p])
			add_widths(wrap, p);
}

/* Of the tube round a limb that the vertex is part of; 0: it is of none. */
static float tube_radius(const struct wrap *wrap, int v)
{
	const struct wrap_scratch *s = wrap->scratch;
	int piece = wrap->cloth->garment->piece[v];
	const struct gather *gather = &wrap->cloth->piece_gather[piece];
	float at_m = v2_dot(wrap->cloth->garment->rest_m[v], gather->along);
	if (!s->in_tube[piece] || at_m < gather->from_m)
		return 0.0f;
	return s->tube_m[s->home[piece]][section_of(s->hem_m[piece] - at_m)] / (2.0f * PI_F);
}

struct v3 wrap_widened(const struct wrap *wrap, int v, struct v3 p_m)
{
	struct beside at;
	float radius_m = tube_radius(wrap, v);
	int home = wrap->scratch->home[wrap->cloth->garment->piece[v]];
	if (radius_m <= 0.0f || !body_beside(wrap->cloth->body, home, p_m, &at))
		return p_m;
	struct v3 arm = v3_sub(p_m, at.axis_m);
	float length = v3_length(arm);
	if (length >= radius_m || length < 1e-6f)
		return p_m;
	return v3_mad(at.axis_m, arm, radius_m / length);
}

/* Out from the bones, to that distance at least. */
static struct v3 clear_by(const struct limb_shape *limb, const struct beside *at, struct v3 p_m,
			  float least_m)
{
	struct v3 arm = v3_sub(p_m, at->axis_m);
	float length = v3_length(arm);
	if (at->reach_m > limb->end_m || length > least_m || length < 1e-6f)
		return p_m;
	return v3_mad(at->axis_m, arm, least_m / length);
}

/* Cloth goes round the hull of hand and foot. */
static struct v3 clear_hand(const struct wrap *wrap, int home, struct v3 p_m, float of_hull)
{
	const struct limb_shape *limb = &wrap->scratch->limb[home];
	struct beside at;
	if (!body_beside(wrap->cloth->body, home, p_m, &at) || at.reach_m < limb->wrist_m)
		return p_m;
	float hull_m = of_hull * limb_hull(limb, &at, p_m);
	return clear_by(limb, &at, p_m, hull_m + wrap->cloth->settings.offset_m);
}

/* So do tubes cut in one with the trunk. */
static struct v3 clear_bare(const struct wrap *wrap, struct v3 p_m, float of_hull)
{
	for (int part = PART_ARM_LEFT; part < PART_COUNT; part++)
		if (wrap->scratch->opening[part] >= 0)
			p_m = clear_hand(wrap, part, p_m, of_hull);
	return p_m;
}

/* A collar goes round the hull of neck and head, and so far from it that an edge between two of its
 * points does: of a thin neck only the points would stay clear. */
static struct v3 clear_neck(const struct wrap *wrap, struct v3 p_m, float of_hull)
{
	const struct limb_shape *head = &wrap->scratch->limb[PART_HEAD];
	struct beside at;
	if (!body_beside(wrap->cloth->body, PART_HEAD, p_m, &at) || at.reach_m < 0.0f)
		return p_m;
	float half_m = 0.5f * edge_longest * wrap->cloth->garment->edge_m;
	float hull_m = of_hull * limb_hull(head, &at, p_m) + wrap->cloth->settings.offset_m;
	return clear_by(head, &at, p_m, sqrtf(hull_m * hull_m + half_m * half_m));
}

long wrap_clear_hulls(struct wrap *wrap, float share)
{
	struct cloth *cloth = wrap->cloth;
	float of_hull = LIMB_THIN_SHARE + share * (1.0f - LIMB_THIN_SHARE);
	for (int v = 0; v < cloth->garment->vertex_count; v++) {
		struct v3 *p = &cloth->position_m[v];
		int piece = cloth->garment->piece[v], home = wrap->scratch->home[piece];
		if (!is_particle(cloth, v))
			continue;
		if (home >= PART_ARM_LEFT)
			*p = clear_hand(wrap, home, *p, of_hull);
		else if (home == PART_TRUNK && !wrap->scratch->seeded[piece])
			*p = clear_neck(wrap, *p, of_hull);
		else if (home == PART_TRUNK)
			*p = clear_bare(wrap, *p, of_hull);
	}
	return cloth->garment->vertex_count;
}
