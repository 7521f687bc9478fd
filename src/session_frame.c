/* One frame: a job by the frame's budget, or the worn cloth until it rests. */
#include "cloth_refine.h"
#include "cloth_self.h"
#include "session_private.h"

enum {
	SWEEPS_A_FRAME_MAX = 10,
	WRAP_SHARE = 3,
	UNFOLD_SLICES = 20, /* frames between unfoldings while RELAX is held */
	REST_FRAMES = 30, /* so many calm frames, and the cloth goes to sleep until it is touched */
	COOL_FRAMES = 90, /* after the last touch momentum begins to fade */
	SLEEP_FRAMES = 300, /* and here the cloth goes to sleep in any case */
	UNFOLDS_MAX = 4,    /* before it may */
	UNTANGLES_MAX = 2,
	REFINES_MAX = 2,
	PUSH_SLICES = 16,
	STILL_SLICES = 8, /* frames a round of looking for folds or of cleaning */
	CLEAN_ROUNDS = 6, /* at most; two when nothing is found */
	CUT_UNITS = 7,    /* a step of the mesher costs as much as so many units */
	PAUSE_FRAMES = 6, /* a pen that rests so long lets the cloth relax under it */
	EASE_FRAMES = 90, /* and so long it relaxes after the last touch */
};

static const float calm_m = 0.00002f; /* particles moved less than this in a frame, in the mean */
static const float ease_least = 0.12f, ease_whole = 0.22f; /* strain_left: friction full, eased */

void session_wake(struct session *session)
{
	session->rest_frames = 0;
	session->untouched_frames = 0;
	session->unfolds = 0;
	session->refines = 0;
	session->still_frames = 0;
	session->asleep = false;
}

/* The cloth's own tables are built in the frames after the last of the mesh. */
static long advance_mesh(struct session *session)
{
	bool done = false;
	struct cloth *cloth = &session->cloth;
	long steps = int_max(1, (int)(session->budget_units / CUT_UNITS));
	long units = CUT_UNITS * garment_advance(session->mesher, steps, &done);
	if (!done || units > 0)
		return units;
	if (!cloth->garment)
		cloth_start(cloth, &session->garment, &session->body);
	if (!cloth->built)
		units = cloth_build_on(cloth, session->budget_units);
	if (!cloth->built)
		return units;
	session->job = session->drapes ? JOB_NONE : JOB_WRAP;
	if (!session->drapes && !wrap_start(&session->wrap, cloth, &session->document.marks))
		session->job = JOB_NONE;
	return units + 1;
}

static long advance_wrap(struct session *session)
{
	/* a share of the budget: the visitor is to see the garment grow */
	long share = session->cloth.built ? WRAP_SHARE : 1;
	long units = wrap_advance(&session->wrap, session->budget_units / share);
	if (session->wrap.stage == WRAP_DONE) {
		session_wake(session);
		session->job = JOB_NONE;
		session->cloth.settings = cloth_settings_worn();
	}
	return units;
}

/* The mean, not the largest: a crease may tremble for ever between two shapes. */
static bool is_calm(const struct session *session)
{
	const struct cloth *cloth = &session->cloth;
	float moved = 0.0f;
	int count = session->garment.vertex_count;
	for (int v = 0; v < count; v++)
		moved += v3_distance(cloth->position_m[v], session->frame_start_m[v]);
	return moved < calm_m * (float)count;
}

static bool touched(const struct session *session)
{
	return session->drag.active || session->relaxing;
}

/* Counts towards sleep. */
static void note_rest(struct session *session)
{
	session->rest_frames = is_calm(session) ? session->rest_frames + 1 : 0;
	session->untouched_frames++;
	if (touched(session))
		session->untouched_frames = 0;
	bool still = session->rest_frames >= REST_FRAMES ||
		     session->untouched_frames >= SLEEP_FRAMES;
	session->still_frames = !touched(session) && still;
	session->clean_found = 0;
}

/* Cloth that came to rest over something thinner than its edges gets finer there, and where it has
 * left such a place it is taken back. True: it has changed. */
static bool refine_still(struct session *session, long *units)
{
	if (session->refines >= REFINES_MAX || !session->cloth.welded ||
	    cloth_refine(&session->cloth, &session->garment, true, units) == 0)
		return false;
	session->refines++;
	session_hold_pins(session);
	return true;
}

/* The last folds are turned back, and the cloth moves once more; also where it still passes through
 * itself, and when it has become finer. */
static void unfold_slice(struct session *session, int slice, long *units)
{
	bool tangled = session->unfolds < UNTANGLES_MAX && cloth_crossings(&session->cloth) > 0;
	bool folded = session->unfolds < UNFOLDS_MAX &&
		      cloth_unfold(&session->cloth, slice, STILL_SLICES, units) > 0;
	if (slice < STILL_SLICES - 1)
		return;
	bool finer = refine_still(session, units);
	if (!tangled && !folded && !finer)
		return;
	session->unfolds += tangled || folded;
	session->rest_frames = session->still_frames = 0;
	session->untouched_frames = COOL_FRAMES;
}

/* A round of cleaning; the cloth sleeps when a second one or the last finds nothing to push out. */
static void clean_slice(struct session *session, int slice, int round, long *units)
{
	session->clean_found += cloth_clean(&session->cloth, slice, STILL_SLICES, units);
	if (slice < STILL_SLICES - 1)
		return;
	session->asleep = (session->clean_found == 0 && round > 0) || round == CLEAN_ROUNDS - 1;
	session->clean_found = 0;
}

/* Before it sleeps the cloth is looked through for folds and then cleaned, so that it lies still
 * exactly outside the body; in slices, so that no frame pays for all of it. */
static long advance_still(struct session *session)
{
	int slice = (session->still_frames - 1) % STILL_SLICES;
	int round = (session->still_frames - 1) / STILL_SLICES;
	long units = 1;
	session->still_frames++;
	if (round == 0)
		unfold_slice(session, slice, &units);
	else
		clean_slice(session, slice, round - 1, &units);
	return units;
}

/* Friction holds cloth that lies easy where it was put; no friction holds cloth that is stretched.
 * The strain that a drag has built up flows out while the pen pauses and after it has let go. */
static void ease_friction(const struct session *session, struct cloth_settings *settings)
{
	struct cloth_settings relax = cloth_settings_relax();
	bool pulling = session->drag.active && session->pause_frames < PAUSE_FRAMES;
	if (pulling || session->untouched_frames >= EASE_FRAMES)
		return;
	float ease = (session->strain_left - ease_least) / (ease_whole - ease_least);
	ease = float_clamp(ease, 0.0f, 1.0f);
	settings->friction += ease * (relax.friction - settings->friction);
	settings->grip += ease * (relax.grip - settings->grip);
}

/* Cloth that nobody touches calms down: creases would tremble for ever under full momentum. */
static struct cloth_settings settings_now(const struct session *session)
{
	if (session->relaxing)
		return cloth_settings_relax();
	struct cloth_settings settings = cloth_settings_worn();
	settings.open = !session->drag.active;
	if (session->drag.active)
		settings.strain_bound = 0.0f; /* what slides by it would not follow the hand */
	int cooling = session->untouched_frames - COOL_FRAMES;
	float warmth = 1.0f - (float)cooling / (float)(SLEEP_FRAMES - COOL_FRAMES);
	settings.momentum *= float_clamp(warmth, 0.0f, 1.0f);
	ease_friction(session, &settings);
	return settings;
}

/* The worn cloth moves by the frame's budget: first the hand, then the cloth's own shape. */
static long advance_cloth(struct session *session)
{
	struct cloth *cloth = &session->cloth;
	long units = session->edit_units;
	session->edit_units = 0;
	cloth->settings = settings_now(session);
	session->pause_frames++;
	if (session->drag.active)
		units += drag_move(&session->drag, session->drag_target_m);
	memcpy(session->frame_start_m, cloth->position_m,
	       (size_t)session->garment.vertex_count * sizeof(struct v3));
	int sweeps = 0;
	do { /* one in any case: contact has the last word on what the hand has moved */
		units += cloth_sweep(cloth);
	} while (++sweeps < SWEEPS_A_FRAME_MAX && units < session->budget_units);
	session->relax_frames = session->relaxing ? session->relax_frames + 1 : 0;
	if (session->relaxing)
		cloth_unfold(cloth, (session->relax_frames - 1) % UNFOLD_SLICES, UNFOLD_SLICES,
			     &units);
	crease_rest(cloth, session->frame_start_m);
	cloth_push_out(cloth, session->frame % PUSH_SLICES, PUSH_SLICES, &units);
	cloth_finish(cloth);
	note_rest(session);
	session->strain_left = float_clamp(cloth_strain_mean(cloth) / 0.1f, 0.0f, 1.0f);
	return units;
}

static bool cloth_sleeps(const struct session *session)
{
	return !session->cloth.worn || (session->asleep && !touched(session));
}

void session_advance(struct session *session)
{
	long units;
	session->frame++;
	if (session->job == JOB_MESH)
		units = advance_mesh(session);
	else if (session->job == JOB_WRAP)
		units = advance_wrap(session);
	else if (cloth_sleeps(session))
		units = 0;
	else if (session->still_frames > 0 && !touched(session))
		units = advance_still(session);
	else
		units = advance_cloth(session);
	session->frame_units = units;
	session->work_units += units;
}

bool session_busy(const struct session *session)
{
	return session->job != JOB_NONE || !cloth_sleeps(session);
}
