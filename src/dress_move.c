/* Wrap of a garment that is worn (S9): cloth under the new marks goes to its places on the body,
 * the rest follows in its own shape. Nothing is laid anew. */
#include "dress_private.h"

enum {
	MOVE_SWEEPS_LEAST = 240, /* what the marks pull at needs time to follow */
	MOVE_SWEEPS_MAX = 600,
	LOOK_SWEEPS = 40, /* between two looks at how far it still is */
};

static const float arrived_m = 0.004f;
static const float amiss_m = 0.01f;   /* farther off in the end is worth a word */
static const float gained_m = 0.001f; /* less in LOOK_SWEEPS: it goes no farther */

/* Marked cloth slides straight towards its places, a little in each sweep; contact turns that into
 * a way over the body. */
static struct cloth_settings moving(void)
{
	struct cloth_settings set = cloth_settings_relax();
	set.friction = 0.0f;
	set.grip = 0.0f;
	set.momentum = 0.3f;
	set.step_max_m = 0.004f;
	return set;
}

bool wrap_move(struct wrap *wrap, struct cloth *cloth, const struct marks *marks,
	       const bool fresh[MARK_NUMBERS])
{
	wrap->cloth = cloth;
	wrap->marks = marks;
	wrap->frames = 0;
	wrap->scratch->from_drape = wrap->scratch->mended = false;
	memset(&wrap->diagnoses, 0, sizeof wrap->diagnoses);
	for (int part = 0; part < PART_COUNT; part++)
		wrap->scratch->opening[part] = -1; /* arms stay in the sleeves that they are in */
	for (int number = 0; number < MARK_NUMBERS; number++)
		wrap->scratch->partner[number] = number;
	wrap_diagnose_marks(wrap);
	for (int number = 0; number < MARK_NUMBERS; number++)
		wrap->scratch->partner[number] = fresh[number] ? number : 0;
	memset(cloth->held, 0, (size_t)cloth->garment->vertex_count);
	if (wrap_aim(wrap) == 0)
		return false;
	wrap_mark_error(wrap);
	wrap->scratch->off_m = wrap->mark_error_rms_m;
	wrap->stage = WRAP_MOVE;
	wrap->progress = 0;
	cloth->settings = moving();
	return true;
}

static int first_mark(const struct wrap *wrap)
{
	int number = 1;
	while (number < MARK_NUMBERS - 1 && !wrap_partner(wrap, number))
		number++;
	return number;
}

bool wrap_has_moved(struct wrap *wrap)
{
	if (wrap->progress < MOVE_SWEEPS_LEAST || wrap->progress % LOOK_SWEEPS != 0)
		return false;
	float before_m = wrap->scratch->off_m;
	wrap_mark_error(wrap);
	wrap->scratch->off_m = wrap->mark_error_rms_m;
	if (wrap->mark_error_rms_m < arrived_m)
		return true;
	if (wrap->mark_error_rms_m <= before_m - gained_m && wrap->progress < MOVE_SWEEPS_MAX)
		return false;
	if (wrap->mark_error_rms_m > amiss_m)
		wrap_diagnose(wrap, "mark-not-reached", first_mark(wrap), 0,
			      "The garment came near the new places, not to them: cloth or body "
			      "is in the way of mark %1.");
	return true;
}
