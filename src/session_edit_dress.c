/* The edits on and around the body: marks, wrap, drag, pins, relax (S6 to S12). */
#include "fabric.h"
#include "session_private.h"
#include "session_undo.h"

static bool number_is_sane(int number)
{
	return number >= 1 && number <= 99;
}

/* Which point of a line of `count` points stands at place i of `kept`, both ends included. */
static int thinned(int i, int kept, int count)
{
	return kept == count ? i : i * (count - 1) / (kept - 1);
}

static bool mark_used(const struct marks *marks, int side, int place)
{
	return side == 0 ? marks->cloth[place].used : marks->body[place].used;
}

static int mark_number(const struct marks *marks, int side, int place)
{
	return side == 0 ? marks->cloth[place].number : marks->body[place].number;
}

/* Where a mark with that number stands on a side (0 cloth, 1 body), or else a free place; -1: none.
 */
static int mark_place(const struct marks *marks, int side, int number)
{
	int place = -1;
	for (int m = MARKS_MAX - 1; m >= 0; m--)
		if (!mark_used(marks, side, m))
			place = m;
	for (int m = 0; m < MARKS_MAX; m++)
		if (mark_used(marks, side, m) && mark_number(marks, side, m) == number)
			place = m;
	return place;
}

/* A number drawn again replaces the old line. */
static const char *mark_cloth(struct session *session, const struct edit *edit)
{
	int number = edit->i[0], piece = edit->i[1];
	if (!number_is_sane(number))
		return "marks are numbered from 1 to 99";
	if (piece < 0 || piece >= PIECES_MAX || !session->document.pattern.piece[piece].used)
		return session_no_piece;
	if (edit->point_count < 2)
		return "a mark is a line of at least two points";
	int place = mark_place(&session->document.marks, 0, number);
	if (place < 0)
		return "there are as many marks as fit; erase one first";
	undo_keep(session);
	struct cloth_mark *mark = &session->document.marks.cloth[place];
	mark->used = true;
	mark->number = number;
	mark->piece = piece;
	mark->point_count = int_min(edit->point_count, MARK_POINTS_MAX);
	for (int i = 0; i < mark->point_count; i++) {
		int from = thinned(i, mark->point_count, edit->point_count);
		mark->point_mm[i] = (struct v2){edit->point[from].x, edit->point[from].y};
	}
	return NULL;
}

static const char *mark_body(struct session *session, const struct edit *edit)
{
	int number = edit->i[0];
	if (!number_is_sane(number))
		return "marks are numbered from 1 to 99";
	if (edit->point_count < 2)
		return "a mark is a line of at least two points";
	if (session->body.triangle_count == 0)
		return "there is no body to draw on";
	int place = mark_place(&session->document.marks, 1, number);
	if (place < 0)
		return "there are as many marks as fit; erase one first";
	undo_keep(session);
	struct body_mark *mark = &session->document.marks.body[place];
	mark->used = true;
	mark->number = number;
	mark->point_count = int_min(edit->point_count, MARK_POINTS_MAX);
	for (int i = 0; i < mark->point_count; i++) {
		struct body_hit hit;
		int from = thinned(i, mark->point_count, edit->point_count);
		body_nearest(&session->body, edit->point[from], 0, &hit);
		mark->point_m[i] = hit.point_m;
		mark->normal[i] = hit.normal;
	}
	return NULL;
}

/* A place of a line is worth so many stops that a hand-written number still makes sense. */
static bool places_are_sane(const struct edit *edit)
{
	for (int i = 0; i < 4; i++)
		if (!(float_abs(edit->f[i]) <= 10.0f))
			return false;
	return true;
}

static const char *mark_at(struct session *session, const struct edit *edit)
{
	struct body_mark line = {.used = true, .number = edit->i[0]};
	enum landmark landmark = landmark_find(edit->name);
	if (!number_is_sane(edit->i[0]))
		return "marks are numbered from 1 to 99";
	if (landmark == LANDMARK_COUNT)
		return "there is no landmark of that name; `kitsuke help landmarks` lists them";
	if (!places_are_sane(edit))
		return "FROM and TO count stops, ALONG and ASIDE metres, each within 10";
	if (session->body.landmark[landmark].count == 0)
		return "this body has no such landmark: its bones were not found; give them in a "
		       "file, or draw the mark with mark-body";
	line.point_count = landmark_cut(&session->body, landmark, edit->f[0], edit->f[1],
					edit->f[2], edit->f[3], line.point_m, line.normal);
	if (line.point_count == 0)
		return "nothing is left of the landmark between FROM and TO; set them further "
		       "apart";
	int place = mark_place(&session->document.marks, 1, edit->i[0]);
	if (place < 0)
		return "there are as many marks as fit; erase one first";
	undo_keep(session);
	session->document.marks.body[place] = line;
	return NULL;
}

static const char *unmark(struct session *session, const struct edit *edit)
{
	struct marks *marks = &session->document.marks;
	int side = edit->i[0] != 0, place = mark_place(marks, side, edit->i[1]);
	if (place < 0 || !mark_used(marks, side, place))
		return "there is no mark with that number";
	undo_keep(session);
	if (side == 0)
		marks->cloth[place].used = false;
	else
		marks->body[place].used = false;
	return NULL;
}

/* Is there a number on both sides? */
static bool marks_pair(const struct marks *marks)
{
	for (int a = 0; a < MARKS_MAX; a++)
		for (int b = 0; marks->cloth[a].used && b < MARKS_MAX; b++)
			if (marks->body[b].used && marks->body[b].number == marks->cloth[a].number)
				return true;
	return false;
}

/* Shapes and seams; where pieces lie on the sheet does not matter. */
static uint64_t hash_shapes(const struct pattern *pattern)
{
	struct hash hash;
	hash_init(&hash);
	for (int p = 0; p < PIECES_MAX; p++) {
		const struct piece *piece = &pattern->piece[p];
		hash_int(&hash, piece->used);
		for (int i = 0; piece->used && i < piece->point_count; i++) {
			hash_float(&hash, piece->point_mm[i].x);
			hash_float(&hash, piece->point_mm[i].y);
			hash_int(&hash, piece->corner[i]);
		}
	}
	for (int s = 0; s < SEAMS_MAX; s++) {
		const struct seam *seam = &pattern->seam[s];
		hash_int(&hash, seam->used);
		if (!seam->used)
			continue;
		hash_int(&hash, seam->swapped);
		hash_int(&hash, seam->a.piece * 1000 + seam->a.edge);
		hash_int(&hash, seam->b.piece * 1000 + seam->b.edge);
	}
	return hash.value;
}

/* Both lines of a pair of marks. */
static uint64_t hash_pair(const struct cloth_mark *cloth, const struct body_mark *body)
{
	struct hash hash;
	hash_init(&hash);
	hash_int(&hash, cloth->piece);
	for (int i = 0; i < cloth->point_count; i++) {
		hash_float(&hash, cloth->point_mm[i].x);
		hash_float(&hash, cloth->point_mm[i].y);
	}
	for (int i = 0; i < body->point_count; i++) {
		hash_float(&hash, body->point_m[i].x);
		hash_float(&hash, body->point_m[i].y);
		hash_float(&hash, body->point_m[i].z);
	}
	return hash.value;
}

static struct worn_as worn_as_of(const struct document *document)
{
	const struct marks *marks = &document->marks;
	struct worn_as now = {.pattern = hash_shapes(&document->pattern)};
	for (int a = 0; a < MARKS_MAX; a++)
		for (int b = 0; marks->cloth[a].used && b < MARKS_MAX; b++)
			if (marks->body[b].used && marks->body[b].number == marks->cloth[a].number)
				now.mark[marks->cloth[a].number] = hash_pair(&marks->cloth[a],
									     &marks->body[b]);
	return now;
}

/* A garment that is worn, and only marks are new: it moves (S9). */
static bool move_garment(struct session *session, const struct worn_as *now)
{
	const struct worn_as *before = &session->document.worn_as;
	bool fresh[MARK_NUMBERS], any = false;
	for (int number = 0; number < MARK_NUMBERS; number++) {
		fresh[number] = now->mark[number] && now->mark[number] != before->mark[number];
		any |= fresh[number];
	}
	if (!any || !session->cloth.worn || session->job != JOB_NONE ||
	    now->pattern != before->pattern ||
	    !wrap_move(&session->wrap, &session->cloth, &session->document.marks, fresh))
		return false;
	session->job = JOB_WRAP;
	return true;
}

/* A pattern that can't be meshed leaves everything as it was, the worn garment included. */
static const char *wrap_garment(struct session *session)
{
	struct worn_as now;
	if (!marks_pair(&session->document.marks))
		return "draw a line on the cloth and its partner on the body first";
	session_release(session);
	undo_keep(session);
	memset(session->document.pin, 0, sizeof session->document.pin);
	now = worn_as_of(&session->document);
	const char *fault = move_garment(session, &now) ? NULL : session_wrap(session);
	if (fault)
		undo_cancel(session);
	else
		session->document.worn_as = now;
	return fault;
}

/* The worn triangle under a point of a piece; -1 with the reason. */
static int worn_triangle(const struct session *session, const struct edit *edit, float weight[3],
			 const char **why)
{
	if (!session->cloth.worn || session->job != JOB_NONE) {
		*why = "nothing is worn yet; press WRAP first";
		return -1;
	}
	int triangle = -1;
	if (edit->i[0] >= 0 && edit->i[0] < PIECES_MAX)
		triangle = garment_locate(&session->garment, edit->i[0],
					  (struct v2){edit->f[0], edit->f[1]}, weight);
	*why = triangle < 0 ? "there is no cloth at that place" : NULL;
	return triangle;
}

static int used_pins(const struct session *session)
{
	int count = 0;
	for (int p = 0; p < PINS_MAX; p++)
		count += session->document.pin[p].used;
	return count;
}

static const char *grab(struct session *session, const struct edit *edit)
{
	const char *why;
	float weight[3];
	int triangle = worn_triangle(session, edit, weight, &why);
	if (triangle < 0)
		return why;
	session_release(session);
	undo_keep(session);
	session->edit_units += drag_begin(&session->drag, &session->cloth, session->document.pin,
					  used_pins(session) > 0 ? PINS_MAX : 0, triangle, weight);
	session->drag_target_m = drag_point(&session->drag);
	return NULL;
}

static const float pause_m = 0.002f; /* a pen that pauses trembles no farther than this */

static const char *drag(struct session *session, const struct edit *edit)
{
	if (!session->drag.active)
		return "nothing is held; grab the cloth first";
	struct v3 target = {edit->f[0], edit->f[1], edit->f[2]};
	if (!(v3_length(target) < 100.0f))
		return "the target is too far away";
	session->drag_target_m = target;
	if (v3_distance(target, session->pause_at_m) > pause_m) {
		session->pause_at_m = target;
		session->pause_frames = 0;
	}
	return NULL;
}

static struct v3 point_on(const struct cloth *cloth, int triangle, const float weight[3])
{
	struct v3 point = {0};
	for (int k = 0; k < 3; k++)
		point = v3_mad(point, cloth->position_m[cloth->garment->triangle[triangle].v[k]],
			       weight[k]);
	return point;
}

static const char *pin(struct session *session, const struct edit *edit)
{
	const char *why;
	float weight[3];
	int triangle = worn_triangle(session, edit, weight, &why);
	if (triangle < 0)
		return why;
	for (int p = 0; p < PINS_MAX; p++) {
		struct pin *at = &session->document.pin[p];
		if (at->used)
			continue;
		undo_keep(session);
		*at = (struct pin){true, edit->i[0], {edit->f[0], edit->f[1]}, {0.0f, 0.0f, 0.0f}};
		at->held_m = point_on(&session->cloth, triangle, weight);
		session_hold_pins(session);
		return NULL;
	}
	return "there are as many pins as fit; take one out first";
}

static const char *unpin(struct session *session, const struct edit *edit)
{
	int p = edit->i[0];
	if (p < 0 || p >= PINS_MAX || !session->document.pin[p].used)
		return "there is no such pin";
	undo_keep(session);
	session->document.pin[p].used = false;
	session_hold_pins(session);
	return NULL;
}

static const char *relax(struct session *session, const struct edit *edit)
{
	bool on = edit->i[0] != 0;
	if (on && !session->cloth.worn)
		return "nothing is worn yet; press WRAP first";
	if (on && !session->relaxing)
		undo_keep(session);
	session->relaxing = on;
	return NULL;
}

static const char *choose_fabric(struct session *session, const struct edit *edit)
{
	int fabric = fabric_named(edit->name);
	if (fabric < 0)
		return "no such fabric: kitsuke help journal names them";
	undo_keep(session);
	session->document.fabric = session->cloth.fabric = fabric;
	return NULL;
}

static const char *apply(struct session *session, const struct edit *edit)
{
	switch (edit->kind) {
	case EDIT_MARK_CLOTH:
		return mark_cloth(session, edit);
	case EDIT_MARK_BODY:
		return mark_body(session, edit);
	case EDIT_MARK_AT:
		return mark_at(session, edit);
	case EDIT_UNMARK:
		return unmark(session, edit);
	case EDIT_WRAP:
		return wrap_garment(session);
	case EDIT_GRAB:
		return grab(session, edit);
	case EDIT_DRAG:
		return drag(session, edit);
	case EDIT_RELEASE:
		session_release(session);
		return NULL;
	case EDIT_PIN:
		return pin(session, edit);
	case EDIT_UNPIN:
		return unpin(session, edit);
	case EDIT_RELAX:
		return relax(session, edit);
	case EDIT_FABRIC:
		return choose_fabric(session, edit);
	default:
		must_fail("an edit around the body", __FILE__, __LINE__);
		return NULL;
	}
}

const char *session_edit_dress(struct session *session, const struct edit *edit)
{
	const char *refusal = apply(session, edit);
	if (!refusal)
		session_wake(session);
	return refusal;
}
