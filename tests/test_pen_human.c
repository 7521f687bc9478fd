/* A person's pen, recorded once to see what a tablet sends, dresses the figure: a closed scribble
 * becomes a piece, two strokes become marks, WRAP lays the cloth.
 *
 * The person drew nothing for us. What is the recording's: every report, its time within the
 * contact, the pressure, the wobble of the hand; reports go through the pen module as on any tape.
 * What is ours: which contact is used when (a recording is cut between contacts), where on the
 * screen it lies (each contact is turned, scaled by one factor and moved, so that two points of it
 * come to lie where they are wanted), the steps between, and the button.
 *
 *   test_pen_human [JOURNAL]     writes the visit's journal, for kitsuke dress --picture */
#include "kiosk.h"
#include "table.h"
#include "tape_learn.h"
#include "test.h"
#include "tool.h"

#include <stdio.h>
#include <stdlib.h>

#define RECORDING                                                                                  \
	"../shared/data/hid/bentiss-hid-devices/events/tablet/Wacom_Intuos5_touch_M_056a_0027.hid"

/* Contacts of that recording: a loop whose ends cross, and two nearly straight lines. */
enum { LOOP = 1, LINE_1 = 0, LINE_2 = 2 };

enum {
	WIDTH = 1280,
	HEIGHT = 720,
	CONTACTS_MAX = 64,
	AROUND_US = 60000, /* of hovering that belongs to a contact */
	AWAY_FRAMES = 200, /* then the pen is gone, even if it never said so */
	WRAP_FRAMES = 1500,
	MEASURE_BYTES = 64 << 20,
	BUTTONS = TAPE_DEVICES_MAX - 1, /* the device's number */
};

struct trace {
	int64_t begin_us, end_us;
	int samples;
	struct v2 first_px, last_px, low_px, high_px; /* as the pen module maps them */
};

static struct kiosk kiosk;
static struct tape tape;
static struct trace contact[CONTACTS_MAX];
static int contact_count;
static struct v2 drawn_mm[STROKE_SAMPLES_MAX]; /* the last contact on the sheet */
static int drawn_count;
static FILE *journal; /* where one is wanted */

/* ---- the recording ---- */

static void contact_add(const struct pen_sample *sample, bool begins)
{
	struct v2 at = sample->position_px;
	if (begins && contact_count < CONTACTS_MAX)
		contact[contact_count++] = (struct trace){
			.begin_us = sample->time_us, .first_px = at, .low_px = at, .high_px = at};
	struct trace *c = &contact[contact_count - 1];
	c->end_us = sample->time_us;
	c->last_px = at;
	c->samples++;
	c->low_px = (struct v2){float_min(c->low_px.x, at.x), float_min(c->low_px.y, at.y)};
	c->high_px = (struct v2){float_max(c->high_px.x, at.x), float_max(c->high_px.y, at.y)};
}

static void devices_learn(struct pen *pen)
{
	for (int d = 0; d < TAPE_DEVICES_MAX; d++)
		if (tape.device[d].used)
			tape_learn(pen, d, &tape.device[d]);
}

static void contacts_find(void)
{
	static struct pen pen;
	size_t cursor = 0;
	bool touching = false;
	pen_init(&pen, WIDTH, HEIGHT);
	devices_learn(&pen);
	for (int frame = 0; frame < tape.frame_count; frame++) {
		static struct frame_reports reports;
		struct frame_input input = {0};
		tape_frame(&tape, frame, &cursor, &reports);
		pen_read(&pen, &reports, tape_frame_us(frame + 1), &input);
		for (int s = 0; s < input.sample_count; s++) {
			bool touch = input.sample[s].state == PEN_TOUCH;
			if (touch)
				contact_add(&input.sample[s], !touching);
			touching = touch;
		}
	}
}

/* ---- the visit ---- */

static void advance(void)
{
	kiosk_face(&kiosk);
	kiosk_apply(&kiosk);
	if (journal)
		fwrite(kiosk.journal, 1, (size_t)kiosk.journal_size, journal);
	kiosk_advance(&kiosk);
}

static void frames(int count)
{
	struct frame_reports nothing = {0};
	for (int i = 0; i < count; i++) {
		kiosk_listen(&kiosk, &nothing, 0);
		advance();
	}
}

/* Turn, one scale and shift that bring a to b's place and c to d's. */
struct placing {
	struct v2 from, to, turn;
};

static struct placing placing_of(struct v2 from_a, struct v2 from_b, struct v2 to_a, struct v2 to_b)
{
	struct v2 f = v2_sub(from_b, from_a), t = v2_sub(to_b, to_a);
	float square = v2_dot(f, f);
	MUST(square > 0.0f);
	struct v2 turn = {v2_dot(f, t) / square, (f.x * t.y - f.y * t.x) / square};
	return (struct placing){from_a, to_a, turn};
}

static struct v2 placed(const struct placing *p, struct v2 at)
{
	struct v2 d = v2_sub(at, p->from);
	return v2_add(p->to, (struct v2){p->turn.x * d.x - p->turn.y * d.y,
					 p->turn.x * d.y + p->turn.y * d.x});
}

/* What the tape holds of one contact, from *event on, in this frame. */
static void reports_next(struct frame_reports *reports, size_t *event, int64_t begin_us,
			 int64_t end_us, int64_t start_us)
{
	reports->count = 0;
	for (; *event < tape.event_count && reports->count < FRAME_REPORTS_MAX; (*event)++) {
		const struct tape_event *e = &tape.event[*event];
		int64_t time_us = e->time_us - begin_us + start_us;
		if (e->time_us > end_us || time_us >= tape_frame_us(kiosk.frame + 1))
			return;
		struct raw_report *report = &reports->report[reports->count++];
		*report = (struct raw_report){e->device, time_us, e->size, {0}};
		memcpy(report->bytes, tape.bytes + e->offset, (size_t)e->size);
	}
}

static void samples_place(const struct placing *placing)
{
	for (int s = 0; s < kiosk.input.sample_count; s++) {
		struct pen_sample *sample = &kiosk.input.sample[s];
		sample->position_px = placed(placing, sample->position_px);
		if (sample->state == PEN_TOUCH && drawn_count < STROKE_SAMPLES_MAX)
			drawn_mm[drawn_count++] = view_sheet_mm(&kiosk.ui.view,
								sample->position_px);
	}
}

/* The recorded reports of one contact, from now on, and of the hover round it. */
static void draw(int number, const struct placing *placing)
{
	static struct frame_reports reports;
	const struct trace *c = &contact[number];
	int64_t begin_us = c->begin_us - AROUND_US, end_us = c->end_us + AROUND_US;
	int64_t start_us = tape_frame_us(kiosk.frame);
	size_t event = 0;
	drawn_count = 0;
	while (event < tape.event_count && tape.event[event].time_us < begin_us)
		event++;
	while (event < tape.event_count && tape.event[event].time_us <= end_us) {
		reports_next(&reports, &event, begin_us, end_us, start_us);
		kiosk_listen(&kiosk, &reports, 0);
		samples_place(placing);
		advance();
	}
	frames(AWAY_FRAMES);
}

static void press_wrap(void)
{
	struct frame_reports reports = {.count = 1};
	reports.report[0] = (struct raw_report){
		BUTTONS, tape_frame_us(kiosk.frame), 1, {1 << BUTTON_WRAP}};
	kiosk_listen(&kiosk, &reports, 0);
	advance();
	frames(WRAP_FRAMES);
}

static struct v2 figure_px(float x_m, float y_m, float z_m)
{
	struct v2 px = {0, 0};
	float depth;
	MUST(view_project(&kiosk.ui.view, (struct v3){x_m, y_m, z_m}, &px, &depth));
	return px;
}

static struct v2 sheet_px(float x_mm, float y_mm)
{
	return view_sheet_px(&kiosk.ui.view, (struct v2){x_mm, y_mm});
}

/* ---- what came of it ---- */

/* The outline is the person's line, at samples 13 mm apart, its ends left out where they cross. */
static void check_piece(void)
{
	const struct piece *piece = &kiosk.session.document.pattern.piece[0];
	float worst_mm = 0.0f;
	CHECK(piece->used && !kiosk.session.document.pattern.piece[1].used);
	for (int i = 0; i < piece->point_count; i++) {
		struct v2 at = v2_add(piece->point_mm[i], piece->position_mm);
		worst_mm = float_max(worst_mm, stroke_distance(drawn_mm, drawn_count, at));
	}
	printf("the piece: %d points, at most %.1f mm from the line of %d samples\n",
	       piece->point_count, (double)worst_mm, drawn_count);
	CHECK(drawn_count == contact[LOOP].samples && worst_mm < 20.0f);
}

static void check_marks(void)
{
	const struct marks *marks = &kiosk.session.document.marks;
	int cloth = 0, body = 0;
	for (int m = 0; m < MARKS_MAX; m++) {
		cloth += marks->cloth[m].used;
		body += marks->body[m].used;
	}
	CHECK(cloth == 1 && body == 1);
}

static void check_drape(void)
{
	void *memory = malloc(MEASURE_BYTES);
	struct arena arena;
	struct measure m;
	MUST(memory);
	arena_init(&arena, memory, MEASURE_BYTES);
	measure_garment(&m, &kiosk.session.cloth, measure_init(&arena));
	printf("the drape: %d vertices, strain p95 %.3f, max %.3f, %d inside, %d edges through, "
	       "%d facing in, %d crossing\n",
	       m.vertices, (double)m.strain_p95, (double)m.strain_max, m.vertices_inside,
	       m.edge_crossings_body, m.inverted_triangles, m.self_intersections);
	CHECK(kiosk.session.cloth.worn && m.vertices > 500);
	CHECK(m.vertices_inside == 0 && m.midpoints_inside == 0 && m.centres_inside == 0);
	CHECK(m.edge_crossings_body == 0 && m.inverted_triangles == 0);
	CHECK(m.self_intersections == 0 && m.strain_p95 < 0.05f);
	free(memory);
}

/* ---- the test ---- */

static bool recording_load(void)
{
	size_t size = 0;
	char wrong[200];
	FILE *there = fopen(RECORDING, "rb");
	if (!there)
		return false;
	fclose(there);
	char *text = table_file(RECORDING, &size);
	bool read = tape_read(&tape, text, size, wrong);
	CHECK(read);
	free(text);
	return read;
}

static void visit_begin(void *memory)
{
	kiosk_init(&kiosk, memory, WIDTH, HEIGHT);
	MUST(!body_build_mannequin(&kiosk.session.body));
	body_find_parts(&kiosk.session.body);
	kiosk.session.budget_units = 6000000;
	kiosk_body_named(&kiosk, "mannequin");
	devices_learn(&kiosk.pen);
	pen_describe(&kiosk.pen, BUTTONS, buttons_descriptor, buttons_descriptor_size);
	frames(2);
}

static void visit(void)
{
	const struct trace *loop = &contact[LOOP], *one = &contact[LINE_1], *two = &contact[LINE_2];
	struct v2 middle = v2_scale(v2_add(loop->low_px, loop->high_px), 0.5f);
	struct v2 right = {loop->high_px.x, middle.y};
	struct placing placing = placing_of(middle, right, sheet_px(0.0f, 0.0f),
					    sheet_px(260.0f, 0.0f));
	draw(LOOP, &placing);
	check_piece();
	ui_step(&kiosk.ui, STEP_MARK);
	placing = placing_of(one->first_px, one->last_px, sheet_px(-150.0f, 60.0f),
			     sheet_px(150.0f, 60.0f));
	draw(LINE_1, &placing);
	placing = placing_of(two->first_px, two->last_px, figure_px(-0.15f, 1.3f, 0.12f),
			     figure_px(0.15f, 1.3f, 0.12f));
	draw(LINE_2, &placing);
	check_marks();
	press_wrap();
	check_drape();
}

int main(int argc, char **argv)
{
	if (!recording_load()) {
		printf("skip: no recording at " RECORDING "\n");
		return test_failures ? EXIT_FAILURE : 77;
	}
	contacts_find();
	CHECK(contact_count == 10 && contact[LOOP].samples > 100);
	journal = argc > 1 ? fopen(argv[1], "w") : NULL;
	if (journal)
		fputs(JOURNAL_HEADER, journal);
	void *memory = malloc(KIOSK_MEMORY_BYTES);
	MUST(memory);
	visit_begin(memory);
	visit();
	if (journal) {
		kiosk_finish(&kiosk);
		fwrite(kiosk.journal, 1, (size_t)kiosk.journal_size, journal);
		fclose(journal);
	}
	free(memory);
	tape_free(&tape);
	return test_end();
}
