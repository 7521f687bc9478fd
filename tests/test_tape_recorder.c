/* A visit with late frames, and with a pen that is pulled out in mid-stroke and plugged in again,
 * recorded as the station does it: the tape replays to the same journal and the same state. And
 * when reports count that were read by the wall's clock. */
#include "kiosk.h"
#include "live.h"
#include "tape_learn.h"
#include "tape_recorder.h"
#include "test.h"

#include <stdio.h>
#include <stdlib.h>

enum {
	TEXT_BYTES = 1 << 20,
	VISIT_US = 14500000, /* of the bundled tape: a front, its copy, two seams */
	OUT_US = 9700000,    /* the pen is pulled out, in mid-stroke */
	IN_US = 10300000,
	LATE_FRAMES = 23, /* each so many frames one is late */
	LATE_US = 180000,
};

/* What a kiosk writes and ends as. */
struct visit {
	struct kiosk kiosk;
	void *memory;
	char journal[TEXT_BYTES];
	int size;
};

static struct visit live, replayed;
static struct tape bundled, made;
static struct tape_recorder recorder;
static struct frame_reports reports;

static void text_load(struct tape *tape, const char *path)
{
	static char text[TEXT_BYTES];
	char fault[200];
	FILE *file = fopen(path, "rb");
	size_t size = file ? fread(text, 1, sizeof text, file) : 0;
	if (file)
		fclose(file);
	bool read = size > 0 && size < sizeof text && tape_read(tape, text, size, fault);
	if (!read)
		fprintf(stderr, "%s: %s\n", path, size ? fault : "no text");
	MUST(read);
}

static void visit_begin(struct visit *visit, long budget_units)
{
	visit->memory = malloc(KIOSK_MEMORY_BYTES);
	MUST(visit->memory);
	kiosk_init(&visit->kiosk, visit->memory, bundled.width_px, bundled.height_px);
	MUST(!body_build_mannequin(&visit->kiosk.session.body));
	body_find_parts(&visit->kiosk.session.body);
	visit->kiosk.session.budget_units = budget_units;
	kiosk_body_named(&visit->kiosk, "mannequin");
}

static void visit_write(struct visit *visit)
{
	int size = visit->kiosk.journal_size;
	MUST(visit->size + size < TEXT_BYTES);
	memcpy(visit->journal + visit->size, visit->kiosk.journal, (size_t)size);
	visit->size += size;
}

static void visit_frame(struct visit *visit, unsigned unplugged)
{
	kiosk_frame(&visit->kiosk, &reports, unplugged);
	visit_write(visit);
}

static uint64_t visit_end(struct visit *visit)
{
	kiosk_finish(&visit->kiosk);
	visit_write(visit);
	return session_hash(&visit->kiosk.session);
}

/* ---- the live visit ---- */

/* What came since the last frame, by the wall's clock; while the pen is out nothing does. */
static void collect(size_t *cursor, int64_t now_us)
{
	reports.count = 0;
	for (; *cursor < bundled.event_count && reports.count < FRAME_REPORTS_MAX; (*cursor)++) {
		const struct tape_event *event = &bundled.event[*cursor];
		if (event->time_us > now_us)
			break;
		if (event->device == 0 && event->time_us >= OUT_US && event->time_us < IN_US)
			continue;
		struct raw_report *report = &reports.report[reports.count++];
		report->device = event->device;
		report->time_us = event->time_us;
		report->size = event->size;
		memcpy(report->bytes, bundled.bytes + event->offset, (size_t)event->size);
	}
}

static uint64_t visit_live(const char *path)
{
	struct kiosk *kiosk = &live.kiosk;
	size_t cursor = 0;
	bool in[2] = {false, false};
	int64_t before_us = 0;
	FILE *out = fopen(path, "w");
	MUST(out);
	visit_begin(&live, 300000);
	struct tape head = {.width_px = bundled.width_px,
			    .height_px = bundled.height_px,
			    .budget_units = 300000};
	recorder_begin(&recorder, out, &head);
	while (before_us < VISIT_US) {
		int64_t now_us = before_us + (kiosk->frame % LATE_FRAMES ? 16667 : LATE_US);
		bool pulled = before_us < OUT_US && now_us >= OUT_US;
		collect(&cursor, pulled ? OUT_US : now_us);
		in[0] &= before_us < IN_US || before_us >= IN_US + LATE_US;
		for (int d = 0; d < 2; d++) {
			if (!in[d])
				tape_learn(&kiosk->pen, d, &bundled.device[d]);
			in[d] = true;
		}
		live_stamp(&reports, kiosk->frame, before_us, now_us);
		for (int i = 0; i < reports.count; i++) {
			int d = reports.report[i].device;
			CHECK(recorder_device(&recorder, d, &bundled.device[d]));
			recorder_report(&recorder, &reports.report[i]);
		}
		if (pulled)
			recorder_unplug(&recorder, 0, tape_frame_us(kiosk->frame));
		in[0] &= !pulled;
		visit_frame(&live, pulled ? 1 : 0);
		before_us = now_us;
	}
	uint64_t hash = visit_end(&live);
	recorder_end(&recorder, kiosk->frame, hash);
	MUST(!fclose(out));
	return hash;
}

static void check_visit(void)
{
	static const char path[] = "build/test_tape_recorder.hid";
	size_t cursor = 0;
	uint64_t hash = visit_live(path);
	text_load(&made, path);
	remove(path);
	CHECK(made.frame_count == live.kiosk.frame && made.budget_units == 300000);
	CHECK((long)made.event_count == recorder.events + 1);
	visit_begin(&replayed, made.budget_units);
	for (int d = 0; d < 2; d++)
		tape_learn(&replayed.kiosk.pen, d, &made.device[d]);
	for (int frame = 0; frame < made.frame_count; frame++)
		visit_frame(&replayed, tape_frame(&made, frame, &cursor, &reports));
	CHECK(visit_end(&replayed) == hash);
	CHECK(replayed.size == live.size &&
	      !memcmp(replayed.journal, live.journal, (size_t)live.size));
	live.journal[live.size] = 0;
	CHECK(strstr(live.journal, "\npiece ") && strstr(live.journal, "\nsew "));
	tape_free(&made);
}

/* One report of the bundled pen, in a frame of its own; what it says. */
static struct pen_sample say(struct pen *pen, int frame, uint8_t flags, int pressure)
{
	struct frame_input input = {0};
	reports.count = 1;
	reports.report[0] = (struct raw_report){
		.time_us = tape_frame_us(frame),
		.size = 10,
		.bytes = {2, flags, 0, 0x40, 0, 0x40, (uint8_t)pressure, (uint8_t)(pressure >> 8)}};
	pen_read(pen, &reports, tape_frame_us(frame + 1), &input);
	return input.sample_count ? input.sample[input.sample_count - 1] : (struct pen_sample){0};
}

/* A tape describes a device once, the station whenever it is plugged in: both must be the same. */
static void check_forgotten(void)
{
	static struct pen pen[2];
	struct frame_input input = {0};
	for (int i = 0; i < 2; i++) {
		pen_init(&pen[i], 1280, 720);
		tape_learn(&pen[i], 0, &bundled.device[0]);
	}
	for (int frame = 0; frame < 8; frame++) /* a worn nib comes and goes */
		say(&pen[0], frame, frame % 2 ? 0x00 : 0x20, 700);
	CHECK(pen[0].device[0].nib[0].offset == 700);
	pen_unplugged(&pen[0], 0, &input);
	for (int frame = 100; frame < 104; frame++) {
		struct pen_sample after = say(&pen[0], frame, 0x21, 4000);
		struct pen_sample first = say(&pen[1], frame, 0x21, 4000);
		CHECK(after.state == first.state && after.time_us == first.time_us);
		CHECK_NEAR(after.pressure, first.pressure, 0);
	}
	CHECK(pen[0].device[0].heard.state == PEN_TOUCH);
}

/* Another device with the number of one on the tape is left out; the old one is taken again. */
static void check_left_out(void)
{
	struct tape_device other = bundled.device[0];
	struct raw_report report = {.device = 0, .time_us = 10, .size = 1};
	struct tape head = {0};
	char *text;
	size_t size;
	FILE *out = open_memstream(&text, &size);
	MUST(out);
	recorder_begin(&recorder, out, &head);
	recorder_report(&recorder, &report); /* nobody said what it is */
	CHECK(recorder_device(&recorder, 0, &bundled.device[0]));
	recorder_report(&recorder, &report);
	other.descriptor[other.descriptor_size - 1] ^= 1;
	CHECK(!recorder_device(&recorder, 0, &other));
	recorder_report(&recorder, &report);
	recorder_unplug(&recorder, 0, 20);
	CHECK(recorder_device(&recorder, 0, &bundled.device[0]));
	report.time_us = 5; /* earlier than what stands there */
	recorder_report(&recorder, &report);
	MUST(!fclose(out));
	CHECK(recorder.events == 2 && !strstr(text, "unplug"));
	CHECK(strstr(text, "E: 000000.000010 1 00\nE: 000000.000010 1 00\n"));
	free(text);
}

/* ---- when reports count ---- */

static void reports_at(int count, const int64_t *time_us)
{
	reports.count = count;
	for (int i = 0; i < count; i++)
		reports.report[i] = (struct raw_report){.time_us = time_us[i], .size = 1};
}

static void check_stamp(void)
{
	static const int64_t in_time[] = {1000, 5000, 16000}, late[] = {0, 100000, 250000},
			     waited[] = {2000, 3000, 3000, 2500};
	reports_at(3, in_time); /* a frame in its time: as far apart as they were read */
	live_stamp(&reports, 6, 0, 16600);
	CHECK(reports.report[0].time_us == 101000 && reports.report[1].time_us == 105000);
	CHECK(reports.report[2].time_us == 116000);
	reports_at(3, late); /* a quarter of a second in a sixtieth: in proportion */
	live_stamp(&reports, 6, 0, 250000);
	CHECK(reports.report[0].time_us == 100000 && reports.report[2].time_us == 116666);
	CHECK_NEAR(reports.report[1].time_us, 106666, 1);
	reports_at(4, waited); /* read before the last frame ended, and one stamped too late */
	live_stamp(&reports, 6, 12000, 22000);
	CHECK(reports.report[0].time_us == 100000 && reports.report[1].time_us > 100000);
	CHECK(reports.report[2].time_us == reports.report[3].time_us);
	for (int frame = 0; frame < 1000; frame++) { /* never in another frame */
		reports_at(3, late);
		live_stamp(&reports, frame, 0, 200000);
		for (int i = 0; i < 3; i++)
			CHECK(reports.report[i].time_us * FRAME_RATE_HZ / 1000000 == frame);
	}
}

int main(void)
{
	text_load(&bundled, "tests/tapes/tshirt.hid");
	check_stamp();
	check_left_out();
	check_forgotten();
	check_visit();
	tape_free(&bundled);
	free(live.memory);
	free(replayed.memory);
	return test_end();
}
