/* What came of a wrap: is every limb in the tube that was laid round it, and the head out? Cheap
 * signs of what linking numbers say exactly (measure_loop.c), so that no drape ends wrong in
 * silence. */
#include "dress_private.h"

enum {
	STATIONS = 48,
	SECTORS = 8,       /* round the bones */
	SECTORS_LEAST = 7, /* a tube shows itself in so many */
};

static const float station_m = 0.04f;
static const float crown_m = 0.3f; /* above the head nothing is worn */

/* Is cloth of this limb sewn to cloth of this limb, so as to go round it? */
static bool is_tube(const struct wrap *wrap, int part)
{
	const struct garment *garment = wrap->cloth->garment;
	const int8_t *home = wrap->scratch->home;
	for (int i = 0; wrap->cloth->welded && i < garment->pair_count; i++)
		if (home[garment->piece[garment->pair[i].a]] == part &&
		    home[garment->piece[garment->pair[i].b]] == part)
			return true;
	return false;
}

/* Which eighth round the bones a point lies in. */
static int sector(const struct beside *at, struct v3 p_m)
{
	bool upright = float_abs(at->along.y) > 0.9f;
	struct v3 aside = upright ? (struct v3){1.0f, 0.0f, 0.0f} : (struct v3){0.0f, 1.0f, 0.0f};
	struct v3 u = v3_normalize(v3_cross(at->along, aside)), w = v3_cross(at->along, u);
	struct v3 arm = v3_sub(p_m, at->axis_m);
	float x = v3_dot(arm, u), y = v3_dot(arm, w);
	return (x < 0.0f) | (y < 0.0f) << 1 | (float_abs(x) < float_abs(y)) << 2;
}

/* Stations along the limb that have cloth, and those of them where it shows on all sides. */
static int count_stations(const struct wrap *wrap, int part, int *closed)
{
	const struct cloth *cloth = wrap->cloth;
	uint8_t seen[STATIONS] = {0};
	int stations = 0;
	*closed = 0;
	for (int v = 0; v < cloth->garment->vertex_count; v++) {
		struct beside at;
		if (wrap->scratch->home[cloth->garment->piece[v]] != part || !cloth->placed[v] ||
		    !body_beside(cloth->body, part, cloth->position_m[v], &at) || at.reach_m < 0.0f)
			continue;
		int station = int_min((int)(at.reach_m / station_m), STATIONS - 1);
		seen[station] |= (uint8_t)(1 << sector(&at, cloth->position_m[v]));
	}
	for (int i = 0; i < STATIONS; i++) {
		int sectors = 0;
		for (int k = 0; k < SECTORS; k++)
			sectors += seen[i] >> k & 1;
		stations += sectors > 0;
		*closed += sectors >= SECTORS_LEAST;
	}
	return stations;
}

static int limb_mark(const struct wrap *wrap, int part)
{
	for (int p = 0; p < PIECES_MAX; p++)
		if (wrap->scratch->home[p] == part && wrap_piece_mark(wrap, p))
			return wrap_piece_mark(wrap, p);
	return 0;
}

static void check_limb(struct wrap *wrap, int part)
{
	static const char *const words[PART_COUNT] = {
		[PART_ARM_LEFT] = "The left arm is outside the sleeve that mark %1 lays; draw the "
				  "mark along the arm, shoulder to hand.",
		[PART_ARM_RIGHT] = "The right arm is outside the sleeve that mark %1 lays; draw "
				   "the mark along the arm, shoulder to hand.",
		[PART_LEG_LEFT] = "The left leg is outside the leg that mark %1 lays; draw the "
				  "mark along the leg, hip to foot.",
		[PART_LEG_RIGHT] = "The right leg is outside the leg that mark %1 lays; draw the "
				   "mark along the leg, hip to foot.",
	};
	int closed, stations = is_tube(wrap, part) ? count_stations(wrap, part, &closed) : 0;
	if (stations > 0 && 2 * closed < stations)
		wrap_diagnose(wrap, "limb-outside", limb_mark(wrap, part), 0, words[part]);
}

/* The same of a tube cut in one with the trunk. */
static void check_opening(struct wrap *wrap, int part)
{
	static const char *const words[PART_COUNT] = {
		[PART_ARM_LEFT] = "The left arm is outside its sleeve; cut the sleeve so that it "
				  "points where the arm does, or draw mark %1 anew.",
		[PART_ARM_RIGHT] = "The right arm is outside its sleeve; cut the sleeve so that "
				   "it points where the arm does, or draw mark %1 anew.",
		[PART_LEG_LEFT] = "The left leg is outside its trouser leg; cut it so that it "
				  "points where the leg does, or draw mark %1 anew.",
		[PART_LEG_RIGHT] = "The right leg is outside its trouser leg; cut it so that it "
				   "points where the leg does, or draw mark %1 anew.",
	};
	int opening = wrap->scratch->opening[part];
	int mark = wrap_piece_mark(wrap, wrap->cloth->garment->piece[opening]);
	if (wrap->cloth->welded && !wrap_in_opening(wrap, part))
		wrap_diagnose(wrap, "limb-outside", mark, 0, words[part]);
}

/* Does cloth of the trunk lie between the chest and the crown, across the neck? */
static void check_head(struct wrap *wrap)
{
	const struct cloth *cloth = wrap->cloth;
	const struct bone *neck = NULL;
	for (int b = 0; b < cloth->body->bone_count; b++)
		if (cloth->body->bone[b].part == PART_HEAD && !neck)
			neck = &cloth->body->bone[b];
	if (!neck)
		return;
	struct v3 up = {0.0f, 1.0f, 0.0f};
	float distance_m = crown_m + cloth->body->high_m.y - neck->a_m.y, weight[3];
	int t = cloth_ray(cloth, neck->a_m, up, &distance_m, weight);
	if (t >= 0 && wrap->scratch->home[cloth->garment->triangle_piece[t]] == PART_TRUNK)
		wrap_diagnose(wrap, "head-outside",
			      wrap_piece_mark(wrap, cloth->garment->triangle_piece[t]), 0,
			      "Cloth lies over the head; begin mark %1 at the neck, where the "
			      "collar is to lie.");
}

void wrap_check(struct wrap *wrap)
{
	for (int part = PART_ARM_LEFT; part < PART_COUNT; part++)
		if (wrap->scratch->opening[part] >= 0)
			check_opening(wrap, part);
		else
			check_limb(wrap, part);
	check_head(wrap);
}
