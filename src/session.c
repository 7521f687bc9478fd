#include "session_private.h"
#include "session_undo.h"

enum {
	SWEEPS_A_FRAME_MAX = 10,
	WRAP_SHARE = 3,
	SWEEPS_BETWEEN_UNFOLDS = 200, /* while RELAX is held */
	VERTICES_WANTED = 2400,
	BUDGET_UNITS = 600000,
	REST_FRAMES = 30, /* so many calm frames, and the cloth sleeps until something touches it */
	COOL_FRAMES = 90, /* after the last touch momentum begins to fade */
	SLEEP_FRAMES = 300, /* and here the cloth sleeps in any case */
	UNFOLDS_MAX = 4,    /* before it may sleep */
	PUSH_SLICES = 16,
	PAUSE_FRAMES = 6, /* a pen that rests so long lets the cloth relax under it */
	EASE_FRAMES = 90, /* and so long it relaxes after the last touch */
};

static const float calm_m = 0.00002f; /* particles moved less than this in a frame, in the mean */
static const float ease_least = 0.12f, ease_whole = 0.22f; /* strain_left: friction full, eased */

void session_init(struct session *session, struct arena *arena)
{
	memset(session, 0, sizeof *session);
	body_init(&session->body, arena);
	garment_init(&session->garment, arena);
	session->mesher = garment_job_init(arena);
	cloth_init(&session->cloth, arena);
	wrap_init(&session->wrap, arena);
	drag_init(&session->drag, arena);
	session->undo = undo_init(arena);
	session->frame_start_m = ARENA_ARRAY(arena, struct v3, GARMENT_VERTICES_MAX);
	session->budget_units = BUDGET_UNITS;
	session->vertices_wanted = VERTICES_WANTED;
	session->rest_frames = REST_FRAMES;
}

void session_wake(struct session *session)
{
	session->rest_frames = 0;
	session->untouched_frames = 0;
	session->unfolds = 0;
}

void session_release(struct session *session)
{
	if (session->drag.active)
		drag_end(&session->drag);
	session_hold_pins(session);
}

/* The triangle's goals are its own shape with the pinned point back at its place, so that it
 * doesn't drift from one hold to the next. */
static void hold_triangle(struct cloth *cloth, int triangle, const float weight[3],
			  struct v3 held_m)
{
	const int *v = cloth->triangle[triangle].v;
	for (int k = 0; k < 3; k++)
		held_m = v3_mad(held_m, cloth->position_m[v[k]], -weight[k]);
	for (int k = 0; k < 3; k++) {
		cloth->held[v[k]] = 2;
		cloth->goal_m[v[k]] = v3_add(cloth->position_m[v[k]], held_m);
	}
}

void session_hold_pins(struct session *session)
{
	struct cloth *cloth = &session->cloth;
	if (!cloth->worn)
		return;
	memset(cloth->held, 0, (size_t)session->garment.vertex_count);
	for (int p = 0; p < PINS_MAX; p++) {
		const struct pin *pin = &session->document.pin[p];
		float weight[3];
		if (!pin->used)
			continue;
		int triangle = garment_locate(&session->garment, pin->piece, pin->point_mm, weight);
		if (triangle >= 0)
			hold_triangle(cloth, triangle, weight, pin->held_m);
	}
}

const char *session_wrap(struct session *session)
{
	session_release(session);
	session->relaxing = false;
	session->job = JOB_NONE;
	cloth_reset(&session->cloth, NULL, &session->body);
	const char *fault = garment_start(session->mesher, &session->garment,
					  &session->document.pattern, session->vertices_wanted);
	if (!fault)
		session->job = JOB_MESH;
	return fault;
}

void session_resume(struct session *session, bool wrapping)
{
	if (session->drag.active)
		drag_end(&session->drag);
	session->relaxing = false;
	session->job = JOB_NONE;
	session->cloth.settings = cloth_settings_worn();
	session_hold_pins(session);
	session_wake(session);
	if (wrapping)
		session_wrap(session);
}

/* ---- one frame ---- */

static long advance_mesh(struct session *session)
{
	bool done = false;
	long units = garment_advance(session->mesher, session->budget_units, &done);
	if (!done)
		return units;
	cloth_reset(&session->cloth, &session->garment, &session->body);
	session->job = JOB_WRAP;
	if (!wrap_start(&session->wrap, &session->cloth, &session->document.marks))
		session->job = JOB_NONE;
	return units;
}

static long advance_wrap(struct session *session)
{
	/* a share of the budget: the visitor is to see the garment grow */
	long units = wrap_advance(&session->wrap, session->budget_units / WRAP_SHARE);
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

/* Cloth is pinned to be gathered or rolled up: folds are wanted then. */
static bool is_pinned(const struct session *session)
{
	bool pinned = false;
	for (int p = 0; p < PINS_MAX; p++)
		pinned |= session->document.pin[p].used;
	return pinned;
}

/* Counts towards sleep. Before it sleeps the cloth turns its last folds back, and moves once more;
 * then it is cleaned, so that it lies still exactly outside the body. */
static void note_rest(struct session *session)
{
	session->rest_frames = is_calm(session) ? session->rest_frames + 1 : 0;
	session->untouched_frames++;
	if (session->drag.active || session->relaxing)
		session->untouched_frames = 0;
	if (session->untouched_frames >= SLEEP_FRAMES)
		session->rest_frames = REST_FRAMES;
	if (session->rest_frames < REST_FRAMES || session->untouched_frames == 0)
		return;
	if (session->unfolds < UNFOLDS_MAX && !is_pinned(session) &&
	    cloth_unfold(&session->cloth) > 0) {
		session->unfolds++;
		session->rest_frames = 0;
		session->untouched_frames = COOL_FRAMES;
		return;
	}
	cloth_clean(&session->cloth);
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
	long units = 0;
	memcpy(session->frame_start_m, cloth->position_m,
	       (size_t)session->garment.vertex_count * sizeof(struct v3));
	cloth->settings = settings_now(session);
	session->pause_frames++;
	if (session->drag.active)
		units += drag_move(&session->drag, session->drag_target_m);
	for (int sweep = 0; sweep < SWEEPS_A_FRAME_MAX && units < session->budget_units; sweep++) {
		if (session->relaxing && cloth->sweep % SWEEPS_BETWEEN_UNFOLDS == 0)
			cloth_unfold(cloth);
		units += cloth_sweep(cloth);
	}
	cloth_push_out(cloth, session->frame % PUSH_SLICES, PUSH_SLICES);
	cloth_finish(cloth);
	note_rest(session);
	session->strain_left = float_clamp(cloth_strain_mean(cloth) / 0.1f, 0.0f, 1.0f);
	return units;
}

static bool cloth_sleeps(const struct session *session)
{
	return !session->cloth.worn ||
	       (session->rest_frames >= REST_FRAMES && !session->drag.active && !session->relaxing);
}

void session_advance(struct session *session)
{
	long units = 0;
	session->frame++;
	if (session->job == JOB_MESH)
		units = advance_mesh(session);
	else if (session->job == JOB_WRAP)
		units = advance_wrap(session);
	else if (!cloth_sleeps(session))
		units = advance_cloth(session);
	session->frame_units = units;
	session->work_units += units;
}

bool session_busy(const struct session *session)
{
	return session->job != JOB_NONE || !cloth_sleeps(session);
}

static void settle(struct session *session)
{
	for (int i = 0; i < SETTLE_FRAMES_MAX && session_busy(session); i++)
		session_advance(session);
}

/* ---- edits ---- */

static const char *clear(struct session *session)
{
	session_release(session);
	undo_keep(session);
	memset(&session->document, 0, sizeof session->document);
	session->relaxing = false;
	session->job = JOB_NONE;
	cloth_reset(&session->cloth, NULL, &session->body);
	session->garment.vertex_count = 0;
	session->garment.triangle_count = 0;
	session->garment.pair_count = 0;
	return NULL;
}

static const char *step(struct session *session, int frames)
{
	if (frames < 1 || frames > STEP_FRAMES_MAX)
		return "step takes 1 to 1000000 frames";
	for (int i = 0; i < frames; i++)
		session_advance(session);
	return NULL;
}

static const char *set_budget(struct session *session, int units)
{
	if (units < 1000)
		return "a budget is at least 1000 units a frame";
	session->budget_units = units;
	return NULL;
}

static const char *apply(struct session *session, const struct edit *edit)
{
	switch (edit->kind) {
	case EDIT_BODY: /* names the body that the host has built */
		return NULL;
	case EDIT_UNDO:
		return undo_back(session) ? NULL : "there is nothing to undo";
	case EDIT_REDO:
		return undo_forward(session) ? NULL : "there is nothing to redo";
	case EDIT_CLEAR:
		return clear(session);
	case EDIT_BUDGET:
		return set_budget(session, edit->i[0]);
	case EDIT_STEP:
		return step(session, edit->i[0]);
	case EDIT_SETTLE:
		settle(session);
		return NULL;
	default:
		return edit->kind <= EDIT_UNSEW ? session_edit_pattern(session, edit)
						: session_edit_dress(session, edit);
	}
}

bool session_apply(struct session *session, const struct edit *edit)
{
	const char *refusal = apply(session, edit);
	size_t size = refusal ? strlen(refusal) : 0;
	MUST(size < sizeof session->notice);
	memcpy(session->notice, refusal ? refusal : "", size + 1);
	return refusal == NULL;
}

int session_next_mark(const struct session *session, int side)
{
	const struct marks *marks = &session->document.marks;
	uint64_t taken = 0;
	for (int m = 0; m < MARKS_MAX; m++) {
		bool used = side == 0 ? marks->cloth[m].used : marks->body[m].used;
		int number = side == 0 ? marks->cloth[m].number : marks->body[m].number;
		if (used && number < 64)
			taken |= (uint64_t)1 << number;
	}
	int number = 1;
	while (number < 63 && (taken >> number & 1))
		number++;
	return number;
}

/* ---- the hash ---- */

static void hash_pattern(struct hash *hash, const struct pattern *pattern)
{
	for (int p = 0; p < PIECES_MAX; p++) {
		const struct piece *piece = &pattern->piece[p];
		hash_int(hash, piece->used);
		if (!piece->used)
			continue;
		hash_int(hash, piece->inside_up);
		hash_int(hash, piece->swatch);
		hash_int(hash, piece->layer);
		hash_float(hash, piece->position_mm.x);
		hash_float(hash, piece->position_mm.y);
		hash_float(hash, piece->turn_rad);
		for (int i = 0; i < piece->point_count; i++) {
			hash_float(hash, piece->point_mm[i].x);
			hash_float(hash, piece->point_mm[i].y);
			hash_int(hash, piece->corner[i]);
		}
	}
	for (int s = 0; s < SEAMS_MAX; s++) {
		const struct seam *seam = &pattern->seam[s];
		hash_int(hash, seam->used);
		if (!seam->used)
			continue;
		hash_int(hash, seam->swapped);
		hash_int(hash, seam->a.piece * 1000 + seam->a.edge);
		hash_int(hash, seam->b.piece * 1000 + seam->b.edge);
	}
}

static void hash_v3(struct hash *hash, struct v3 point)
{
	hash_float(hash, point.x);
	hash_float(hash, point.y);
	hash_float(hash, point.z);
}

static void hash_marks(struct hash *hash, const struct marks *marks)
{
	for (int m = 0; m < MARKS_MAX; m++) {
		const struct cloth_mark *cloth = &marks->cloth[m];
		const struct body_mark *body = &marks->body[m];
		hash_int(hash, cloth->used ? cloth->number * 100 + cloth->piece : 0);
		for (int i = 0; cloth->used && i < cloth->point_count; i++) {
			hash_float(hash, cloth->point_mm[i].x);
			hash_float(hash, cloth->point_mm[i].y);
		}
		hash_int(hash, body->used ? body->number : 0);
		for (int i = 0; body->used && i < body->point_count; i++)
			hash_v3(hash, body->point_m[i]);
	}
}

uint64_t session_hash(const struct session *session)
{
	struct hash hash;
	hash_init(&hash);
	hash_u32(&hash, (uint32_t)session->body.hash);
	hash_u32(&hash, (uint32_t)(session->body.hash >> 32));
	hash_pattern(&hash, &session->document.pattern);
	hash_marks(&hash, &session->document.marks);
	for (int p = 0; p < PINS_MAX; p++) {
		const struct pin *pin = &session->document.pin[p];
		hash_int(&hash, pin->used);
		if (pin->used)
			hash_v3(&hash, pin->held_m);
	}
	hash_int(&hash, session->frame);
	hash_int(&hash, (int)session->job);
	hash_int(&hash, session->garment.vertex_count);
	for (int v = 0; v < session->garment.vertex_count; v++) {
		hash_int(&hash, session->cloth.placed[v]);
		if (session->cloth.placed[v])
			hash_v3(&hash, session->cloth.position_m[v]);
	}
	return hash.value;
}
