/* The paper's own examples (S21) as visits: raw reports of the pen through the real parser and the
 * whole program to what is worn. tests/hand.c writes the tapes (make tapes). Each is played once
 * and judged while it is played: whatever the hand does, nothing is in the body and nothing tears;
 * and at the end, what moved by how much. */
#include "kiosk.h"
#include "tape.h"
#include "test.h"

#include <stdio.h>

enum {
	SPOTS_MAX = 16,
	LOOK_FRAMES = 6,
	STIR_FRAMES = 60, /* so long after a touch it is looked at */
	FULL_TURN = 360,
	MEASURE_BYTES = 64 << 20,
};

/* A place of a piece, from the middle of its lower edge. */
struct spot {
	int piece;
	float x_mm, up_mm;
};

/* The garment at one time, and where its spots are. */
struct station {
	struct v3 spot_m[SPOTS_MAX];
	struct measure measure;
};

/* The most in any frame that was looked at, from the hand's first touch on. */
struct worst {
	int looks, inside, edges_through, inverted;
	float strain_p95, strain_max;
};

struct visit {
	struct kiosk kiosk;
	struct tape tape;
	void *memory, *measure_memory;
	struct arena arena;
	struct measure_scratch *measurer;
	int wraps, grabs, pins;
	const struct spot *spot;
	int spot_count;
	struct station worn,
		moved; /* before the hand first touched it; before it was wrapped again */
	struct station end;
	struct worst worst;
};

static struct visit visit;

/* ---- playing ---- */

static void measure(struct measure *measure)
{
	measure_garment(measure, &visit.kiosk.session.cloth, visit.measurer);
}

static struct v3 spot_place(const struct spot *spot)
{
	const struct session *session = &visit.kiosk.session;
	const struct piece *piece = &session->document.pattern.piece[spot->piece];
	float left = 1e9f, right = -1e9f, low = 1e9f, weight[3];
	struct v3 point = {0.0f, 0.0f, 0.0f};
	for (int i = 0; i < piece->point_count; i++) {
		left = float_min(left, piece->point_mm[i].x);
		right = float_max(right, piece->point_mm[i].x);
		low = float_min(low, piece->point_mm[i].y);
	}
	struct v2 at = {0.5f * (left + right) + spot->x_mm, low + spot->up_mm};
	int t = garment_locate(&session->garment, spot->piece, at, weight);
	MUST(t >= 0);
	for (int k = 0; k < 3; k++)
		point = v3_mad(point, session->cloth.position_m[session->garment.triangle[t].v[k]],
			       weight[k]);
	return point;
}

static void note(struct station *station)
{
	for (int i = 0; i < visit.spot_count; i++)
		station->spot_m[i] = spot_place(&visit.spot[i]);
	measure(&station->measure);
}

/* Before the edits of a frame are applied. */
static void note_edits(void)
{
	const struct edit_list *edits = &visit.kiosk.edits;
	for (int e = 0; e < edits->count; e++) {
		enum edit_kind kind = edits->item[e].kind;
		bool touch = kind == EDIT_GRAB || kind == EDIT_PIN;
		if (touch && visit.grabs + visit.pins == 0)
			note(&visit.worn);
		if (kind == EDIT_WRAP && visit.wraps == 1)
			note(&visit.moved);
		visit.wraps += kind == EDIT_WRAP;
		visit.grabs += kind == EDIT_GRAB;
		visit.pins += kind == EDIT_PIN;
	}
}

static void look(void)
{
	struct worst *worst = &visit.worst;
	struct measure m;
	measure(&m);
	int inside = m.vertices_inside + m.midpoints_inside + m.centres_inside;
	worst->looks++;
	worst->inside = int_max(worst->inside, inside);
	worst->edges_through = int_max(worst->edges_through, m.edge_crossings_body);
	worst->inverted = int_max(worst->inverted, m.inverted_triangles - m.creased_triangles);
	worst->strain_p95 = float_max(worst->strain_p95, m.strain_p95);
	worst->strain_max = float_max(worst->strain_max, m.strain_max);
}

static bool load(const char *name)
{
	static char text[1 << 20];
	char path[80], fault[200];
	snprintf(path, sizeof path, "tests/tapes/%s.hid", name);
	FILE *file = fopen(path, "rb");
	size_t size = file ? fread(text, 1, sizeof text, file) : 0;
	if (file)
		fclose(file);
	return size > 0 && size < sizeof text && tape_read(&visit.tape, text, size, fault);
}

static void open_kiosk(void)
{
	struct kiosk *kiosk = &visit.kiosk;
	kiosk_init(kiosk, visit.memory, visit.tape.width_px, visit.tape.height_px);
	MUST(!body_build_mannequin(&kiosk->session.body));
	body_find_parts(&kiosk->session.body);
	kiosk->session.budget_units = visit.tape.budget_units;
	for (int d = 0; d < TAPE_DEVICES_MAX; d++)
		if (visit.tape.device[d].used)
			pen_describe(&kiosk->pen, d, visit.tape.device[d].descriptor,
				     visit.tape.device[d].descriptor_size);
	visit.wraps = visit.grabs = visit.pins = 0;
	visit.worst = (struct worst){0};
}

static void play(const char *name)
{
	struct kiosk *kiosk = &visit.kiosk;
	size_t cursor = 0;
	MUST(load(name));
	open_kiosk();
	for (int frame = 0; frame < visit.tape.frame_count; frame++) {
		struct frame_reports reports;
		unsigned unplugged = tape_frame(&visit.tape, frame, &cursor, &reports);
		kiosk_listen(kiosk, &reports, unplugged);
		kiosk_face(kiosk);
		note_edits();
		kiosk_apply(kiosk);
		kiosk_advance(kiosk);
		if (visit.grabs > 0 && kiosk->session.untouched_frames < STIR_FRAMES &&
		    frame % LOOK_FRAMES == 0)
			look();
	}
	note(&visit.end);
	tape_free(&visit.tape);
}

/* ---- figures ---- */

/* The mean angle about the vertical axis by which the spots have gone, degrees. */
static float turned(const struct station *from, const struct station *to)
{
	float sum = 0.0f;
	for (int i = 0; i < visit.spot_count; i++) {
		struct v3 a = from->spot_m[i], b = to->spot_m[i];
		float turn = angle_atan2(b.x, b.z) - angle_atan2(a.x, a.z);
		sum += turn + (turn < -0.5f * PI_F ? 2.0f * PI_F : 0.0f);
	}
	return sum / (float)visit.spot_count * (0.5f * (float)FULL_TURN / PI_F);
}

/* Plays a tape. Nothing is ever in the body and the cloth is never stretched more; an edge that
 * comes through it is pushed out within a round of looking at all of them. */
static void visit_once(const char *name, float strain_p95, const struct spot *spot, int count)
{
	MUST(count <= SPOTS_MAX);
	visit.spot = spot;
	visit.spot_count = count;
	const struct worst *worst = &visit.worst;
	const struct measure *end = &visit.end.measure;
	play(name);
	printf("%s: in %d looks at most %d inside, %d edges through, %d facing in, strain p95 "
	       "%.3f, max %.3f\n",
	       name, worst->looks, worst->inside, worst->edges_through, worst->inverted,
	       (double)worst->strain_p95, (double)worst->strain_max);
	printf("%s: at the end strain p95 %.3f, max %.3f, %d facing in, %d creased, %d crossing\n",
	       name, (double)end->strain_p95, (double)end->strain_max, end->inverted_triangles,
	       end->creased_triangles, end->self_intersections);
	CHECK(worst->looks > 10 && worst->inside == 0 && worst->edges_through <= 2);
	CHECK(worst->strain_p95 < strain_p95);
	CHECK(end->vertices_inside == 0 && end->midpoints_inside == 0);
	CHECK(end->centres_inside == 0 && end->edge_crossings_body == 0);
	CHECK(end->strain_p95 < 0.12f);
}

/* ---- the visits ---- */

/* Moved up by new marks, then turned a quarter of the way round the trunk. */
static void check_skirt(void)
{
	static const struct spot spot[] = {{0, 0, 430},    {0, 0, 60},   {0, 150, 200},
					   {0, -150, 200}, {1, 0, 60},   {1, 150, 200},
					   {1, -150, 200}, {0, 250, 60}, {0, -250, 60}};
	visit_once("skirt", 0.25f, spot, COUNT_OF(spot));
	float up = 1e3f * (visit.worn.spot_m[0].y - visit.moved.spot_m[0].y);
	float turn = turned(&visit.worn, &visit.end);
	printf("skirt: new marks move it up by %.1f mm of 60; turned by %.1f degrees of 90\n",
	       (double)up, (double)turn);
	CHECK(up > 25.0f && up < 70.0f);
	CHECK_NEAR(turn, 90.0f, 15.0f);
	CHECK(visit.end.measure.inverted_triangles == 0);
	CHECK(visit.end.measure.self_intersections == 0);
}

/* Rolled up against pins, and still rolled up after RELAX. */
static void check_sleeves(void)
{
	static const struct spot hem[] = {
		{0, 365, 346}, {0, -365, 346}, {1, 365, 346}, {1, -365, 346}};
	visit_once("sleeves", 0.25f, hem, COUNT_OF(hem));
	const struct measure *end = &visit.end.measure;
	for (int i = 0; i < COUNT_OF(hem); i++) {
		float up = 1e3f * v3_distance(visit.worn.spot_m[i], visit.end.spot_m[i]);
		printf("sleeves: hem moved by %.1f mm\n", (double)up);
		CHECK(up > 40.0f);
	}
	CHECK(visit.pins == 16 && end->arms_in_sleeves == 2 && end->head_through_collar);
	/* what looks at the arm is the roll; at its rim a triangle may that was not folded */
	CHECK(end->inverted_triangles <= end->creased_triangles + 8);
}

static void check_poncho(void)
{
	static const struct spot spot[] = {{0, 0, 60}, {0, 150, 200}, {0, -150, 200},
					   {1, 0, 60}, {1, 150, 200}, {1, -150, 200}};
	visit_once("poncho", 0.08f, spot, COUNT_OF(spot));
	float turn = turned(&visit.worn, &visit.end);
	printf("poncho: turned by %.1f degrees\n", (double)turn);
	CHECK(turn > 15.0f && turn < 70.0f);
	CHECK(visit.end.measure.head_through_collar);
	/* a hanging corner may turn in by itself */
	CHECK(visit.end.measure.inverted_triangles < visit.end.measure.triangles / 40);
}

static void check_askew(void)
{
	static const struct spot hem[] = {{0, 0, 40}, {1, 0, 40}};
	visit_once("askew", 0.08f, hem, COUNT_OF(hem));
	for (int i = 0; i < COUNT_OF(hem); i++) {
		float before = 1e3f * visit.worn.spot_m[i].x, after = 1e3f * visit.end.spot_m[i].x;
		printf("askew: hem's middle %s %.1f, then %.1f mm aside\n",
		       i == 0 ? "in front" : "behind", (double)before, (double)after);
		CHECK(float_abs(before) > 25.0f && float_abs(after) < 15.0f);
	}
	CHECK(visit.end.measure.arms_in_sleeves == 2 && visit.end.measure.head_through_collar);
	CHECK(visit.end.measure.inverted_triangles == 0);
}

int main(void)
{
	visit.memory = malloc(KIOSK_MEMORY_BYTES);
	visit.measure_memory = malloc(MEASURE_BYTES);
	MUST(visit.memory && visit.measure_memory);
	arena_init(&visit.arena, visit.measure_memory, MEASURE_BYTES);
	visit.measurer = measure_init(&visit.arena);
	check_skirt();
	check_sleeves();
	check_poncho();
	check_askew();
	free(visit.measure_memory);
	free(visit.memory);
	return test_end();
}
