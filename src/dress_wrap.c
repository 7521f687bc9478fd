/* Wrap: the garment is laid on the body so that equal-numbered marks meet (S8, S13, S14). A job of
 * stages; every stage is a number of sweeps with its own settings. wrap_advance is its table of
 * contents. */
#include "dress_private.h"

enum {
	RING_SWEEPS = 3,
	CLOSE_SWEEPS = 80,
	RELEASE_SWEEPS = 30, /* still closing, but the marks have let go */
	WELD_SWEEPS = 25,
	UNFOLD_ROUNDS = 6,
	UNFOLD_SWEEPS = 16,
	SETTLE_SWEEPS = 64,
	PUSH_ROUNDS = 4,
};

static const float gap_agrees_m = 0.06f; /* seams wider than this before the weld: marks disagree */

void wrap_init(struct wrap *wrap, struct arena *arena)
{
	memset(wrap, 0, sizeof *wrap);
	struct wrap_scratch *s = ARENA_ARRAY(arena, struct wrap_scratch, 1);
	s->seeded = ARENA_ARRAY(arena, uint8_t, PIECES_MAX);
	s->sum_m = ARENA_ARRAY(arena, struct v3, GARMENT_VERTICES_MAX);
	s->count = ARENA_ARRAY(arena, int, GARMENT_VERTICES_MAX);
	s->edge_first = ARENA_ARRAY(arena, int, GARMENT_VERTICES_MAX + 2);
	s->edge_triangle = ARENA_ARRAY(arena, int, 3 * GARMENT_TRIANGLES_MAX);
	wrap->scratch = s;
}

/* ---- the settings of each stage (tried on real garments; see the architecture's notes) ---- */

static struct cloth_settings growing(void)
{
	struct cloth_settings set = cloth_settings_worn();
	set.shape_passes = 2;
	set.flatness = 0.1f;
	set.momentum = 0.0f;
	set.gravity_m = 0.0f;
	set.friction = 0.2f;
	set.grip = 0.0f;
	set.filter_parts = true;
	set.faces = false;
	set.attract_m = 0.001f; /* more, and a sleeve is drawn to the front of its arm */
	return set;
}

static struct cloth_settings closing(void)
{
	struct cloth_settings set = growing();
	set.flatness = 0.03f;
	set.momentum = 0.8f;
	set.seam_step_m = 0.003f;
	set.attract_m = 0.0f;
	return set;
}

static struct cloth_settings unfolding(void)
{
	struct cloth_settings set = growing();
	set.flatness = 0.2f;
	set.momentum = 0.3f;
	set.friction = 0.0f;
	set.grip = 0.0f;
	set.offset_m += 0.004f;
	set.filter_parts = false;
	return set;
}

static struct cloth_settings settling(void)
{
	struct cloth_settings set = cloth_settings_worn();
	set.shape_passes = 2;
	return set;
}

/* ---- the stages ---- */

static void enter(struct wrap *wrap, enum wrap_stage stage, struct cloth_settings settings)
{
	wrap->stage = stage;
	wrap->progress = 0;
	wrap->cloth->settings = settings;
}

bool wrap_start(struct wrap *wrap, struct cloth *cloth, const struct marks *marks)
{
	wrap->cloth = cloth;
	wrap->marks = marks;
	wrap->frames = 0;
	wrap->mark_error_rms_m = wrap->mark_error_max_m = 0.0f;
	wrap->scratch->rounds = 0;
	memset(&wrap->diagnoses, 0, sizeof wrap->diagnoses);
	cloth->settings = growing();
	if (wrap_seed(wrap) == 0) {
		wrap_diagnose(wrap, "no-marks", 0, 0,
			      "No mark on the cloth has a partner on the body.");
		wrap->stage = WRAP_IDLE;
		return false;
	}
	wrap_grow_init(wrap);
	enter(wrap, WRAP_GROW, growing());
	return true;
}

static void begin_close(struct wrap *wrap)
{
	const struct cloth *cloth = wrap->cloth;
	int missing = 0;
	for (int v = 0; v < cloth->garment->vertex_count; v++)
		missing += !cloth->placed[v];
	if (missing > 0)
		wrap_diagnose(wrap, "piece-unreached", 0, 0,
			      "Some cloth has no mark and is not sewn to cloth that has one; it "
			      "stays on the sheet.");
	enter(wrap, WRAP_CLOSE, closing());
}

static long grow(struct wrap *wrap)
{
	if (wrap->progress % RING_SWEEPS == 0) {
		int placed = wrap_grow_ring(wrap);
		if (placed == 0) {
			begin_close(wrap);
			return 1;
		}
		wrap->progress++;
		return cloth_sweep(wrap->cloth) + 64L * placed;
	}
	wrap->progress++;
	return cloth_sweep(wrap->cloth);
}

static void release_marks(struct wrap *wrap)
{
	wrap_mark_error(wrap);
	memset(wrap->cloth->held, 0, (size_t)wrap->cloth->garment->vertex_count);
}

/* The share of seam pairs that are farther apart than agreeing marks would leave them. */
static bool seams_agree(const struct cloth *cloth)
{
	int wide = 0, count = 0;
	for (int i = 0; i < cloth->garment->pair_count; i++) {
		int a = cloth->garment->pair[i].a, b = cloth->garment->pair[i].b;
		if (!cloth->placed[a] || !cloth->placed[b])
			continue;
		count++;
		wide += v3_distance(cloth->position_m[a], cloth->position_m[b]) > gap_agrees_m;
	}
	return 2 * wide <= count;
}

static void end_close(struct wrap *wrap)
{
	struct cloth *cloth = wrap->cloth;
	if (seams_agree(cloth)) {
		cloth_weld(cloth);
		enter(wrap, WRAP_WELD, closing());
		return;
	}
	wrap_diagnose(wrap, "marks-disagree", 0, 0,
		      "The marks pull sewn edges apart; the seams stay open. Redraw the marks so "
		      "that they fit the seams.");
	enter(wrap, WRAP_SETTLE, settling());
	cloth->settings.seam_step_m = 0.001f;
}

static long close_up(struct wrap *wrap)
{
	if (wrap->progress == CLOSE_SWEEPS)
		release_marks(wrap);
	if (wrap->progress == CLOSE_SWEEPS + RELEASE_SWEEPS) {
		end_close(wrap);
		return 1;
	}
	wrap->progress++;
	return cloth_sweep(wrap->cloth);
}

/* Some sweeps as one cloth, then rounds of turning folds back, until there are none. */
static long weld(struct wrap *wrap)
{
	struct cloth *cloth = wrap->cloth;
	struct wrap_scratch *s = wrap->scratch;
	int after = wrap->progress - WELD_SWEEPS;
	if (after >= 0 && after % UNFOLD_SWEEPS == 0) {
		cloth->settings = unfolding();
		if (s->rounds++ >= UNFOLD_ROUNDS || cloth_unfold(cloth) == 0) {
			enter(wrap, WRAP_SETTLE, settling());
			return cloth->garment->triangle_count;
		}
	}
	wrap->progress++;
	return cloth_sweep(cloth);
}

static long settle(struct wrap *wrap)
{
	struct cloth *cloth = wrap->cloth;
	int after = wrap->progress - SETTLE_SWEEPS;
	wrap->progress++;
	if (after < 0)
		return cloth_sweep(cloth);
	if (after < PUSH_ROUNDS && cloth_push_out(cloth, 0, 1) > 0)
		return cloth_sweep(cloth) + cloth->garment->triangle_count;
	wrap->stage = WRAP_DONE;
	cloth->worn = true;
	return 1;
}

long wrap_advance(struct wrap *wrap, long quota)
{
	long units = 0;
	wrap->frames++;
	while (units < quota && wrap->stage != WRAP_DONE && wrap->stage != WRAP_IDLE) {
		if (wrap->stage == WRAP_GROW)
			units += grow(wrap);
		else if (wrap->stage == WRAP_CLOSE)
			units += close_up(wrap);
		else if (wrap->stage == WRAP_WELD)
			units += weld(wrap);
		else
			units += settle(wrap);
	}
	cloth_finish(wrap->cloth);
	return units;
}
