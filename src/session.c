#include "session_private.h"
#include "session_undo.h"

enum {
	VERTICES_WANTED = 2400,
	BUDGET_UNITS = 600000,
};

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
	session->drapes = false;
	cloth_reset(&session->cloth, NULL, &session->body);
	const char *fault = garment_start(session->mesher, &session->garment,
					  &session->document.pattern, session->vertices_wanted);
	if (!fault)
		session->job = JOB_MESH;
	return fault;
}

const char *session_mesh(struct session *session)
{
	const char *fault = session_wrap(session);
	session->drapes = !fault;
	return fault;
}

void session_drape(struct session *session, const struct v3 *position_m)
{
	MUST(session->drapes && session->job == JOB_NONE);
	session->drapes = false;
	cloth_reset(&session->cloth, &session->garment, &session->body);
	wrap_from(&session->wrap, &session->cloth, &session->document.marks, position_m);
	session->job = JOB_WRAP;
}

void session_resume(struct session *session, bool wrapping)
{
	if (session->drag.active)
		drag_end(&session->drag);
	session->cloth.fabric = session->document.fabric;
	session->relaxing = false;
	session->job = JOB_NONE;
	session->cloth.settings = cloth_settings_worn();
	session_hold_pins(session);
	session_wake(session);
	if (wrapping)
		session_wrap(session);
}

static void finish_wrap(struct session *session)
{
	for (int i = 0; i < SETTLE_FRAMES_MAX && session->job != JOB_NONE; i++)
		session_advance(session);
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
	session->cloth.fabric = 0;
	session->relaxing = false;
	session->job = JOB_NONE;
	cloth_reset(&session->cloth, NULL, &session->body);
	session->garment.vertex_count = 0;
	session->garment.triangle_count = 0;
	session->garment.pair_count = 0;
	session->garment.base_count = 0;
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
	case EDIT_WORN:
		finish_wrap(session);
		return NULL;
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
		hash_int(hash, piece->worn_over);
		hash_float(hash, piece->position_mm.x);
		hash_float(hash, piece->position_mm.y);
		hash_float(hash, piece->turn_rad);
		if (piece->symmetric) {
			hash_float(hash, piece->axis_mm.x);
			hash_float(hash, piece->axis_mm.y);
			hash_float(hash, piece->axis_rad);
		}
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
		if (seam->even)
			hash_int(hash, 2);
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
	hash_int(&hash, session->document.fabric);
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
