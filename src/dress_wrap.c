/* Wrap: the garment is laid on the body so that equal-numbered marks meet (S8, S13, S14). A job of
 * stages; every stage is a number of sweeps with its own settings. wrap_advance is its table of
 * contents. */
#include "cloth_self.h"
#include "cloth_widen.h"
#include "dress_private.h"

enum {
	RING_SWEEPS = 3,
	CLOSE_SWEEPS = 60,
	RELEASE_SWEEPS = 30, /* still closing, but the marks have let go */
	LATE_SWEEPS = 110,   /* the same when seams are late */
	WELD_SWEEPS = 12,
	FILL_STEPS = 9,  /* of the body */
	FILL_SWEEPS = 3, /* a step */
	WIDEN_SWEEPS = 16,
	UNFOLD_ROUNDS = 6,
	UNFOLD_SWEEPS = 16,
	SETTLE_SWEEPS = 64,
	PUSH_ROUNDS = 4,
	LOOK_UNITS = 32, /* an exact query */
};

static const float gap_late_m = 0.02f;   /* seams wider than this need more closing */
static const float gap_held_m = 0.12f;   /* no agreeing marks hold a seam so wide */
static const float gap_agrees_m = 0.06f; /* wider than this before the weld: not to be sewn */

void wrap_init(struct wrap *wrap, struct arena *arena)
{
	memset(wrap, 0, sizeof *wrap);
	struct wrap_scratch *s = ARENA_ARRAY(arena, struct wrap_scratch, 1);
	s->seeded = ARENA_ARRAY(arena, uint8_t, PIECES_MAX);
	s->sum_m = ARENA_ARRAY(arena, struct v3, GARMENT_VERTICES_MAX);
	s->count = ARENA_ARRAY(arena, int, GARMENT_VERTICES_MAX);
	s->rim = ARENA_ARRAY(arena, int, GARMENT_VERTICES_MAX);
	s->edge_first = ARENA_ARRAY(arena, int, GARMENT_VERTICES_MAX + 2);
	s->edge_triangle = ARENA_ARRAY(arena, int, 3 * GARMENT_TRIANGLES_MAX);
	body_slim_init(&s->slim, arena);
	wrap->scratch = s;
}

static void enter(struct wrap *wrap, enum wrap_stage stage, struct cloth_settings settings)
{
	wrap->stage = stage;
	wrap->progress = 0;
	wrap->cloth->settings = settings;
}

/* The cloth meets this body from now on. */
static void turn_to(struct cloth *cloth, const struct body *body)
{
	cloth->body = body;
	for (int v = 0; v < cloth->garment->vertex_count; v++)
		if (is_particle(cloth, v))
			cloth_look(cloth, v);
}

static bool lay_marks(struct wrap *wrap)
{
	wrap->cloth->body = wrap->scratch->full;
	wrap->scratch->rounds = 0;
	wrap->scratch->disagree = false;
	wrap->cloth->settings = wrap_growing();
	if (wrap_seed(wrap) == 0)
		return false;
	wrap_grow_init(wrap);
	wrap_find_openings(wrap);
	if (body_slim_make(&wrap->scratch->slim, wrap->scratch->full, wrap->scratch->limb,
			   wrap_whole_parts(wrap), wrap->scratch->toward))
		turn_to(wrap->cloth, &wrap->scratch->slim.body);
	enter(wrap, WRAP_GROW, wrap_growing());
	return true;
}

static void begin(struct wrap *wrap, struct cloth *cloth, const struct marks *marks)
{
	wrap->cloth = cloth;
	wrap->scratch->full = cloth->body;
	wrap->marks = marks;
	wrap->frames = 0;
	wrap->mark_error_rms_m = wrap->mark_error_max_m = 0.0f;
	memset(&wrap->diagnoses, 0, sizeof wrap->diagnoses);
	wrap->scratch->mended = wrap->scratch->from_drape = wrap->scratch->wide = false;
	for (int part = 0; part < PART_COUNT; part++)
		wrap->scratch->opening[part] = -1;
	for (int number = 0; number < MARK_NUMBERS; number++)
		wrap->scratch->partner[number] = number;
}

void wrap_from(struct wrap *wrap, struct cloth *cloth, const struct marks *marks,
	       const struct v3 *position_m)
{
	begin(wrap, cloth, marks);
	wrap->scratch->rounds = 0;
	wrap->scratch->disagree = false;
	wrap->scratch->from_drape = wrap->scratch->mended = true;
	cloth->settings = wrap_growing();
	wrap_find_homes(wrap);
	for (int v = 0; v < cloth->garment->vertex_count; v++) {
		cloth->position_m[v] = position_m[v];
		cloth->placed[v] = 1;
	}
	wrap_mend_start(wrap);
	enter(wrap, WRAP_CLOSE, wrap_closing());
	wrap->progress = CLOSE_SWEEPS + 1;
}

bool wrap_start(struct wrap *wrap, struct cloth *cloth, const struct marks *marks)
{
	begin(wrap, cloth, marks);
	if (!lay_marks(wrap)) {
		wrap_diagnose(wrap, "no-marks", 0, 0,
			      "No mark on the cloth has a partner on the body.");
		wrap->stage = WRAP_IDLE;
		return false;
	}
	return true;
}

static void diagnose_unreached(struct wrap *wrap)
{
	const struct cloth *cloth = wrap->cloth;
	int missing = 0;
	for (int v = 0; v < cloth->garment->vertex_count; v++)
		missing += !cloth->placed[cloth->particle[v]];
	if (missing > 0)
		wrap_diagnose(wrap, "piece-unreached", 0, 0,
			      "Some cloth has no mark and is not sewn to cloth that has one; it "
			      "stays on the sheet.");
}

/* The slim body, at its growing, before the sweeps of the next step. */
static float fill_share(const struct wrap *wrap)
{
	int step = wrap->stage == WRAP_FILL ? 1 + wrap->progress / FILL_SWEEPS : 0;
	return (float)step / (float)FILL_STEPS;
}

/* A sweep; round a slim body cloth stays clear of hands and feet, which it does not meet, and
 * collars of chin and neck. */
static long sweep(struct wrap *wrap)
{
	long units = cloth_sweep(wrap->cloth);
	if (wrap->cloth->body == &wrap->scratch->slim.body)
		units += wrap_clear_hulls(wrap, fill_share(wrap));
	return units;
}

static long grow(struct wrap *wrap)
{
	if (wrap->progress % RING_SWEEPS == 0) {
		int placed = wrap_grow_ring(wrap);
		if (placed == 0) {
			diagnose_unreached(wrap);
			enter(wrap, WRAP_CLOSE, wrap_closing());
			return 1;
		}
		wrap->progress++;
		return sweep(wrap) + 64L * placed;
	}
	wrap->progress++;
	return sweep(wrap);
}

static void release_marks(struct wrap *wrap)
{
	wrap_mark_error(wrap);
	memset(wrap->cloth->held, 0, (size_t)wrap->cloth->garment->vertex_count);
}

/* Pairs of a seam, and how many of them are farther apart than `wide_m`; seam -1: of all seams. */
static int count_pairs(const struct cloth *cloth, int seam, float wide_m, int *wide)
{
	int count = 0;
	*wide = 0;
	for (int i = 0; i < cloth->garment->pair_count; i++) {
		const struct seam_pair *pair = &cloth->garment->pair[i];
		if ((seam >= 0 && pair->seam != seam) || !cloth->placed[pair->a] ||
		    !cloth->placed[pair->b])
			continue;
		count++;
		*wide += v3_distance(cloth->position_m[pair->a], cloth->position_m[pair->b]) >
			 wide_m;
	}
	return count;
}

/* Names the marks on both sides of every seam whose median gap is too wide. */
static void diagnose_gaps(struct wrap *wrap, float wide_m)
{
	const struct garment *garment = wrap->cloth->garment;
	for (int seam = 0; seam < SEAMS_MAX; seam++) {
		int wide, i = 0, count = count_pairs(wrap->cloth, seam, wide_m, &wide);
		if (2 * wide <= count)
			continue;
		while (garment->pair[i].seam != seam)
			i++;
		int a = wrap_piece_mark(wrap, garment->piece[garment->pair[i].a]);
		int b = wrap_piece_mark(wrap, garment->piece[garment->pair[i].b]);
		wrap_diagnose(wrap, "marks-disagree", a, b == a ? 0 : b,
			      a && b && a != b ? "Marks %1 and %2 pull apart what a seam joins."
					       : "A seam can't close; see the marks beside it.");
	}
}

/* Sews when most seams have nearly met. Else the marks contradict the seams: everything stays as
 * open pieces that pull lightly at each other (S10). */
static void end_close(struct wrap *wrap)
{
	struct cloth *cloth = wrap->cloth;
	int wide, count = count_pairs(cloth, -1, gap_agrees_m, &wide);
	if (!wrap->scratch->disagree)
		diagnose_gaps(wrap, gap_held_m);
	if (wrap_mend_marks(wrap)) {
		cloth_reset(cloth, cloth->garment, wrap->scratch->full);
		lay_marks(wrap);
		return;
	}
	if (3 * wide <= count) {
		cloth_sew(cloth);
		enter(wrap, WRAP_WELD, wrap_closing());
		return;
	}
	turn_to(cloth, wrap->scratch->full);
	wrap_let_out(wrap);
	wrap_diagnose(wrap, "not-sewn", 0, 0,
		      "The marks hold sewn edges too far apart; the seams stay open. Redraw the "
		      "marks so that they fit the seams.");
	enter(wrap, WRAP_SETTLE, wrap_settling());
}

/* Some seams have not met yet. */
static bool seams_late(const struct cloth *cloth)
{
	int wide, count = count_pairs(cloth, -1, gap_late_m, &wide);
	return 20 * wide > count;
}

/* The marks let go after a while; seams that they held apart get more time to meet then. */
static long close_up(struct wrap *wrap)
{
	int after = wrap->progress - CLOSE_SWEEPS;
	if (after == 0) {
		int before = wrap->diagnoses.count;
		diagnose_gaps(wrap, gap_held_m);
		wrap->scratch->disagree = wrap->diagnoses.count > before;
		release_marks(wrap);
	}
	if (after == LATE_SWEEPS || (after >= RELEASE_SWEEPS && !seams_late(wrap->cloth))) {
		end_close(wrap);
		return 1;
	}
	wrap->progress++;
	return wrap_close_round(wrap) + sweep(wrap);
}

/* Some sweeps as one cloth. */
static long weld(struct wrap *wrap)
{
	if (wrap->progress == 0)
		cloth_join(wrap->cloth);
	if (wrap->progress++ < WELD_SWEEPS)
		return sweep(wrap);
	enter(wrap, WRAP_FILL, wrap_filling());
	wrap_meet_all(wrap);
	return 1;
}

/* Once the body is whole: what is too narrow for it is let out, and takes its new shape in some
 * sweeps. False: it has, or nothing is too narrow. */
static bool take_width(struct wrap *wrap, long *units)
{
	int after = wrap->progress - (FILL_STEPS - 1) * FILL_SWEEPS - 1;
	if (!wrap->scratch->wide || after > WIDEN_SWEEPS)
		return false;
	if (after == 0)
		cloth_let_out(wrap->cloth);
	*units += after == 0 ? wrap->cloth->garment->triangle_count : sweep(wrap);
	wrap->progress++;
	return true;
}

/* The slim body grows into the garment; it ends as the body itself. */
static long fill(struct wrap *wrap)
{
	struct wrap_scratch *s = wrap->scratch;
	long units = 0;
	if (wrap->cloth->body == s->full) {
		if (take_width(wrap, &units))
			return units;
		wrap_let_out(wrap);
		wrap_find_blown(wrap);
		enter(wrap, WRAP_UNFOLD, wrap_unfolding());
		return 1;
	}
	if (wrap->progress % FILL_SWEEPS == 0) {
		float share = fill_share(wrap);
		wrap_carry(wrap, share);
		if (share < 1.0f)
			body_slim_grow(&s->slim, s->full, share);
		turn_to(wrap->cloth, share < 1.0f ? &s->slim.body : s->full);
		units += s->full->triangle_count +
			 LOOK_UNITS * (long)wrap->cloth->garment->vertex_count;
	}
	wrap->progress++;
	return units + sweep(wrap);
}

/* Rounds of turning folds back, until there are none. */
static long unfold(struct wrap *wrap)
{
	struct cloth *cloth = wrap->cloth;
	struct wrap_scratch *s = wrap->scratch;
	long units = 0;
	if (wrap->progress % UNFOLD_SWEEPS == 0) {
		if (s->rounds++ >= UNFOLD_ROUNDS || cloth_unfold(cloth, 0, 1, &units) == 0) {
			enter(wrap, WRAP_SETTLE, wrap_settling());
			return units + 1;
		}
	}
	wrap->progress++;
	return units + cloth_sweep(cloth);
}

/* What a drape from elsewhere still has wrong with it. */
static void diagnose_left(struct wrap *wrap, bool inside)
{
	if (inside)
		wrap_diagnose(wrap, "start-inside", 0, 0,
			      "Some of the drape still passes through the body; wrap it by marks.");
	if (cloth_crossings(wrap->cloth) > 0)
		wrap_diagnose(wrap, "start-tangled", 0, 0,
			      "The drape still passes through itself in places; press RELAX, or "
			      "wrap it by marks.");
}

/* What the body still stretches when all is at rest is too narrow for it. It has rolled up by then:
 * the garment is dressed once more, and let out as soon as it is on the body. */
static bool is_too_narrow(struct wrap *wrap)
{
	int piece = wrap->scratch->wide ? -1 : cloth_narrow_piece(wrap->cloth);
	if (piece < 0)
		return false;
	wrap->scratch->wide = true;
	int mark = wrap_piece_mark(wrap, piece);
	wrap_diagnose(wrap, "let_out", mark, 0,
		      mark ? "The cloth of mark %1 is too narrow for the body; it was let out."
			   : "Some cloth is too narrow for the body; it was let out.");
	return true;
}

static long settle(struct wrap *wrap)
{
	struct cloth *cloth = wrap->cloth;
	int after = wrap->progress - SETTLE_SWEEPS;
	long units = 0;
	wrap->progress++;
	if (after < 0)
		return cloth_sweep(cloth);
	if (after == 0 && is_too_narrow(wrap)) {
		cloth_reset(cloth, cloth->garment, wrap->scratch->full);
		lay_marks(wrap);
		return cloth->garment->triangle_count;
	}
	if (after < PUSH_ROUNDS && cloth_push_out(cloth, 0, 1, &units) > 0)
		return units + cloth_sweep(cloth);
	wrap_check(wrap);
	if (wrap->scratch->from_drape)
		diagnose_left(wrap, after == PUSH_ROUNDS);
	wrap->stage = WRAP_DONE;
	cloth->worn = true;
	return units + 1;
}

static long move(struct wrap *wrap)
{
	if (wrap_has_moved(wrap)) {
		memset(wrap->cloth->held, 0, (size_t)wrap->cloth->garment->vertex_count);
		enter(wrap, WRAP_SETTLE, wrap_settling());
		return 1;
	}
	wrap->progress++;
	return cloth_sweep(wrap->cloth);
}

static bool is_running(const struct wrap *wrap)
{
	return wrap->stage != WRAP_DONE && wrap->stage != WRAP_IDLE;
}

long wrap_advance(struct wrap *wrap, long quota)
{
	long units = 0;
	wrap->frames++;
	do {
		if (!wrap->cloth->built)
			units += cloth_build_on(wrap->cloth, quota - units);
		else if (wrap->stage == WRAP_GROW)
			units += grow(wrap);
		else if (wrap->stage == WRAP_CLOSE)
			units += close_up(wrap);
		else if (wrap->stage == WRAP_WELD)
			units += weld(wrap);
		else if (wrap->stage == WRAP_FILL)
			units += fill(wrap);
		else if (wrap->stage == WRAP_UNFOLD)
			units += unfold(wrap);
		else if (wrap->stage == WRAP_MOVE)
			units += move(wrap);
		else if (wrap->stage == WRAP_SETTLE)
			units += settle(wrap);
	} while (units < quota && is_running(wrap));
	cloth_finish(wrap->cloth);
	return units;
}
