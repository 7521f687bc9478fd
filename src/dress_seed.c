/* The seeds of a wrap: cloth under a mark goes to the mark's partner on the body (S13).
 *
 *   cloth, flat                 body
 *      | s  vertex                 t ^   . p = b(s) + lateral (n x t) + offset n
 *      |---o                         |--o
 *      | lateral                     |  n towards the reader
 *
 * Points correspond by arc length from the start of both lines, so that cloth is laid, not
 * stretched.
 */
#include "dress_private.h"

static const float seed_width = 0.75f;    /* of the mesh's edge length, to each side */
static const float rim_width = 1.5f;      /* the same along a rim, where one side is cloth */
static const float probe_m = 0.03f;       /* skin that has less room before it is a cleft's */
static const float cleft_free_m = 0.008f; /* outside a cleft its sides are farther */
static const float cleft_depth_m = 0.06f;
static const float looks_down = -0.35f; /* y of a normal */
static const float lengths_differ = 0.3f;

/* A garment that is dressed a second time has the same to be said of it. */
static bool is_said(const struct diagnoses *list, const char *kind, int mark_1, int mark_2)
{
	for (int i = 0; i < list->count; i++)
		if (memcmp(list->item[i].kind, kind, strlen(kind) + 1) == 0 &&
		    list->item[i].mark[0] == mark_1 && list->item[i].mark[1] == mark_2)
			return true;
	return false;
}

void wrap_diagnose(struct wrap *wrap, const char *kind, int mark_1, int mark_2, const char *text)
{
	struct diagnoses *list = &wrap->diagnoses;
	if (list->count == DIAGNOSES_MAX || is_said(list, kind, mark_1, mark_2))
		return;
	struct diagnosis *d = &list->item[list->count++];
	memset(d, 0, sizeof *d);
	memcpy(d->kind, kind, (size_t)int_min((int)strlen(kind), NAME_BYTES_MAX - 1));
	d->mark[0] = mark_1;
	d->mark[1] = mark_2;
	int size = 0;
	for (const char *p = text; *p && size < DIAGNOSIS_BYTES_MAX - 3; p++) {
		int number = p[0] == '%' && p[1] == '1'   ? mark_1
			     : p[0] == '%' && p[1] == '2' ? mark_2
							  : -1;
		if (number < 0) {
			d->text[size++] = *p;
			continue;
		}
		if (number >= 10)
			d->text[size++] = (char)('0' + number / 10 % 10);
		d->text[size++] = (char)('0' + number % 10);
		p++;
	}
}

const struct body_mark *wrap_partner(const struct wrap *wrap, int number)
{
	int partner = wrap->scratch->partner[number];
	for (int m = 0; m < MARKS_MAX; m++)
		if (wrap->marks->body[m].used && wrap->marks->body[m].number == partner)
			return &wrap->marks->body[m];
	return NULL;
}

/* A line drawn into a cleft (between the buttocks, under an arm) lies before it, where cloth does,
 * and faces away from the bones: the skin of a cleft faces its other side. */
static void leave_cleft(const struct body *body, struct body_hit *hit)
{
	struct body_hit other;
	struct v3 out, from_m = hit->point_m;
	body_nearest(body, v3_mad(from_m, hit->normal, probe_m), 0, &other);
	if (other.distance_m > 0.5f * probe_m || !wrap_outward(body, hit, &out))
		return;
	hit->normal = out;
	for (float way_m = 0.0f; way_m < cleft_depth_m; way_m += 0.004f) {
		hit->point_m = v3_mad(from_m, out, way_m);
		body_nearest(body, hit->point_m, 0, &other);
		if (other.distance_m > cleft_free_m)
			return;
	}
}

/* Arc lengths of a line's points. */
static void measure_line(struct mark_line *line)
{
	line->along_m[0] = 0.0f;
	for (int i = 1; i < line->count; i++)
		line->along_m[i] = line->along_m[i - 1] +
				   v3_distance(line->point_m[i - 1], line->point_m[i]);
	line->length_m = line->along_m[line->count - 1];
}

/* The body's line without the hand's tremor, laid back onto the surface. */
void wrap_body_line(struct wrap *wrap, const struct body_mark *mark)
{
	struct wrap_scratch *s = wrap->scratch;
	struct mark_line *line = &s->on_body;
	wrap_steady_line(mark->point_m, mark->normal, mark->point_count, s->drawn);
	line->count = wrap_walk_line(s->drawn, mark->point_count, line->point_m);
	for (int i = 0; i < line->count; i++) {
		struct body_hit hit;
		body_nearest(wrap->cloth->body, line->point_m[i], 0, &hit);
		leave_cleft(wrap->cloth->body, &hit);
		s->drawn[i] = hit.normal;
		line->point_m[i] = hit.point_m;
	}
	measure_line(line);
	wrap_steady_normals(s->drawn, line->count, line->length_m, line->normal);
}

/* The cloth's line, likewise. */
void wrap_cloth_line(struct wrap *wrap, const struct cloth_mark *mark)
{
	struct wrap_scratch *s = wrap->scratch;
	struct mark_line *line = &s->on_cloth;
	struct v3 *steady = line->normal; /* it has none: room for a moment */
	for (int i = 0; i < mark->point_count; i++)
		s->drawn[i] = (struct v3){0.001f * mark->point_mm[i].x,
					  0.001f * mark->point_mm[i].y, 0.0f};
	wrap_steady_line(s->drawn, NULL, mark->point_count, steady);
	line->count = wrap_walk_line(steady, mark->point_count, line->point_m);
	measure_line(line);
}

/* Which step of the body's line holds an arc length; *f: how far along the step. */
static int step_at(const struct mark_line *line, float along_m, float *f)
{
	int i = 0;
	while (i + 2 < line->count && line->along_m[i + 1] < along_m)
		i++;
	float length = line->along_m[i + 1] - line->along_m[i];
	*f = (along_m - line->along_m[i]) / float_max(length, 1e-6f);
	return i;
}

/* Cloth that goes round the trunk hangs before places that look down: between the legs, under a
 * belly. */
static bool can_lie(const struct wrap *wrap, int piece, float along_m)
{
	const struct mark_line *line = &wrap->scratch->on_body;
	float f;
	int i = step_at(line, along_m, &f);
	return wrap->scratch->home[piece] != PART_TRUNK || line->normal[i].y > looks_down;
}

/* The place on the body that belongs to arc length and lateral distance on the cloth; beyond the
 * body's line it goes straight on. */
static struct v3 place_on_body(const struct wrap *wrap, float along_m, float lateral_m)
{
	const struct mark_line *line = &wrap->scratch->on_body;
	float f;
	int i = step_at(line, along_m, &f);
	struct v3 a = line->point_m[i], step = v3_sub(line->point_m[i + 1], a);
	struct v3 normal = v3_normalize(
		v3_lerp(line->normal[i], line->normal[i + 1], float_clamp(f, 0.0f, 1.0f)));
	struct v3 left = v3_normalize(v3_cross(normal, step));
	struct v3 place = v3_mad(v3_mad(a, step, f), left, lateral_m);
	return v3_mad(place, normal, wrap->cloth->settings.offset_m);
}

/* Nearest point of the cloth's line: arc length and signed distance (left is positive). */
static float nearest_on_line(const struct mark_line *line, struct v2 p_m, float *along_m,
			     float *lateral_m)
{
	float best = 1e9f;
	*along_m = *lateral_m = 0.0f;
	for (int i = 0; i + 1 < line->count; i++) {
		const struct v3 *from = &line->point_m[i];
		struct v2 a = {from[0].x, from[0].y}, step = {from[1].x - a.x, from[1].y - a.y};
		float length = float_max(v2_length(step), 1e-6f);
		struct v2 u = v2_scale(step, 1.0f / length), w = v2_sub(p_m, a);
		float t = float_clamp(v2_dot(w, u), 0.0f, length);
		float distance = v2_distance(w, v2_scale(u, t));
		if (distance < best) {
			best = distance;
			*along_m = line->along_m[i] + t;
			*lateral_m = v2_cross(u, w);
		}
	}
	return best;
}

/* Has a triangle of the piece been laid, from which cloth can grow? */
static bool can_grow(const struct cloth *cloth, int piece)
{
	const int *first = cloth->garment->piece_first_triangle;
	for (int t = first[piece]; t < first[piece + 1]; t++)
		if (triangle_placed(cloth, t))
			return true;
	return false;
}

/* A vertex goes to its place at once, or aims at it. */
static void lay(struct wrap *wrap, int v, struct v3 place_m)
{
	struct cloth *cloth = wrap->cloth;
	int at = cloth->particle[v];
	if (!wrap->scratch->aiming)
		place_m = wrap_widened(wrap, v, place_m);
	cloth->goal_m[at] = place_m;
	cloth->held[at] = 1;
	if (wrap->scratch->aiming)
		return;
	cloth->position_m[at] = cloth->previous_m[at] = place_m;
	cloth->placed[at] = 1;
	cloth_look(cloth, at);
}

static int seed_mark(struct wrap *wrap, const struct cloth_mark *mark, const struct body_mark *on,
		     float wide)
{
	struct cloth *cloth = wrap->cloth;
	const struct garment *garment = cloth->garment;
	wrap_body_line(wrap, on);
	wrap_cloth_line(wrap, mark);
	float body_m = wrap->scratch->on_body.length_m, cloth_m = wrap->scratch->on_cloth.length_m;
	float width = wide * garment->edge_m;
	float share = cloth->piece_gather[mark->piece].share;
	int seeds = 0;
	if (wide == seed_width && !wrap->scratch->mended &&
	    float_abs(body_m - cloth_m) > lengths_differ * float_max(body_m, cloth_m))
		wrap_diagnose(
			wrap, "lengths-differ", mark->number, 0,
			"The two lines of mark %1 differ much in length; the cloth is laid from "
			"where both begin.");
	for (int v = garment->piece_first[mark->piece]; v < garment->piece_first[mark->piece + 1];
	     v++) {
		float along_m, lateral_m;
		if (nearest_on_line(&wrap->scratch->on_cloth, garment->rest_m[v], &along_m,
				    &lateral_m) > width ||
		    along_m * share > body_m + width)
			continue;
		if (!can_lie(wrap, mark->piece, along_m * share))
			continue;
		lay(wrap, v, place_on_body(wrap, along_m * share, lateral_m));
		seeds++;
	}
	wrap->scratch->seeded[mark->piece] |= seeds > 0;
	return seeds;
}

static const struct cloth_mark *on_cloth(const struct marks *marks, int number)
{
	for (int m = 0; m < MARKS_MAX; m++)
		if (marks->cloth[m].used && marks->cloth[m].number == number)
			return &marks->cloth[m];
	return NULL;
}

static void diagnose_lonely(struct wrap *wrap)
{
	const struct marks *marks = wrap->marks;
	for (int m = 0; m < MARKS_MAX; m++) {
		int cloth = marks->cloth[m].number, body = marks->body[m].number;
		if (marks->cloth[m].used && !wrap_partner(wrap, cloth))
			wrap_diagnose(wrap, "no-partner", cloth, 0,
				      "Mark %1 on the cloth has no partner on the body.");
		if (marks->body[m].used && !on_cloth(marks, body))
			wrap_diagnose(wrap, "no-partner", body, 0,
				      "Mark %1 on the body has no partner on the cloth.");
	}
}

/* From the first point of a line to its last, as a unit vector. */
static struct v2 cloth_chord(const struct cloth_mark *mark)
{
	return v2_normalize(v2_sub(mark->point_mm[mark->point_count - 1], mark->point_mm[0]));
}

static struct v3 body_chord(const struct body_mark *mark)
{
	return v3_normalize(v3_sub(mark->point_m[mark->point_count - 1], mark->point_m[0]));
}

/* Two marks of one piece that run the same way on the cloth, but opposite ways on the body (or the
 * reverse): one of the four lines was drawn from its wrong end. */
static void diagnose_directions(struct wrap *wrap)
{
	const struct marks *marks = wrap->marks;
	for (int i = 0; i < MARKS_MAX; i++)
		for (int j = i + 1; j < MARKS_MAX; j++) {
			const struct cloth_mark *a = &marks->cloth[i], *b = &marks->cloth[j];
			if (!a->used || !b->used || a->piece != b->piece)
				continue;
			const struct body_mark *on_a = wrap_partner(wrap, a->number);
			const struct body_mark *on_b = wrap_partner(wrap, b->number);
			if (!on_a || !on_b)
				continue;
			float cloth = v2_dot(cloth_chord(a), cloth_chord(b));
			float body = v3_dot(body_chord(on_a), body_chord(on_b));
			if (cloth * body < -0.25f)
				wrap_diagnose(
					wrap, "directions-differ", a->number, b->number,
					"Marks %1 and %2 run alike on one side and opposite "
					"ways on the other; draw one line from its other end.");
		}
}

/* Which part of the body most points of a mark lie on. */
static int mark_part(const struct body *body, const struct body_mark *mark)
{
	int votes[PART_COUNT] = {0}, most = 0;
	for (int i = 0; i < mark->point_count; i++) {
		struct body_hit hit;
		body_nearest(body, mark->point_m[i], 0, &hit);
		votes[body->part[hit.triangle]]++;
	}
	for (int part = 1; part < PART_COUNT; part++)
		most = votes[part] > votes[most] ? part : most;
	return most;
}

/* Pieces that no mark lays on the trunk are drawn to the body while they grow: flat cloth beside a
 * thin limb would tip over to one side of it. Over the hollow of a back the same pull would crumple
 * cloth that lies well. */
static void choose_drawn(struct wrap *wrap)
{
	struct cloth *cloth = wrap->cloth;
	for (int p = 0; p < PIECES_MAX; p++)
		cloth->piece_drawn[p] = true;
	for (int m = 0; m < MARKS_MAX; m++) {
		const struct cloth_mark *mark = &wrap->marks->cloth[m];
		const struct body_mark *on = mark->used ? wrap_partner(wrap, mark->number) : NULL;
		if (on && mark_part(cloth->body, on) == PART_TRUNK)
			cloth->piece_drawn[mark->piece] = false;
	}
}

void wrap_diagnose_marks(struct wrap *wrap)
{
	diagnose_lonely(wrap);
	diagnose_directions(wrap);
}

static int seed_marks(struct wrap *wrap)
{
	int seeds = 0;
	wrap_find_homes(wrap);
	body_measure_limbs(wrap->cloth->body, wrap->scratch->limb);
	if (!wrap->scratch->aiming)
		wrap_gather(wrap);
	for (int m = 0; m < MARKS_MAX; m++) {
		const struct cloth_mark *mark = &wrap->marks->cloth[m];
		const struct body_mark *on = mark->used ? wrap_partner(wrap, mark->number) : NULL;
		if (!on || mark->point_count < 2 || on->point_count < 2)
			continue;
		seeds += seed_mark(wrap, mark, on, seed_width);
		if (!can_grow(wrap->cloth, mark->piece))
			seeds += seed_mark(wrap, mark, on, rim_width);
	}
	return seeds;
}

int wrap_seed(struct wrap *wrap)
{
	wrap->scratch->aiming = false;
	memset(wrap->scratch->seeded, 0, PIECES_MAX);
	int seeds = seed_marks(wrap);
	choose_drawn(wrap);
	if (!wrap->scratch->mended)
		wrap_diagnose_marks(wrap);
	return seeds;
}

int wrap_aim(struct wrap *wrap)
{
	wrap->scratch->aiming = true;
	return seed_marks(wrap);
}

int wrap_piece_mark(const struct wrap *wrap, int piece)
{
	const struct marks *marks = wrap->marks;
	for (int m = 0; m < MARKS_MAX; m++)
		if (marks->cloth[m].used && marks->cloth[m].piece == piece &&
		    wrap_partner(wrap, marks->cloth[m].number))
			return marks->cloth[m].number;
	return 0;
}

void wrap_mark_error(struct wrap *wrap)
{
	const struct cloth *cloth = wrap->cloth;
	float sum = 0.0f, most = 0.0f;
	int count = 0;
	for (int v = 0; v < cloth->garment->vertex_count; v++) {
		if (!cloth->held[v])
			continue;
		struct v3 d = v3_sub(cloth->position_m[v], cloth->goal_m[v]);
		sum += v3_dot(d, d);
		most = float_max(most, v3_length(d));
		count++;
	}
	wrap->mark_error_rms_m = count > 0 ? sqrtf(sum / (float)count) : 0.0f;
	wrap->mark_error_max_m = most;
}
