/* Tapes: what is written is read back, what is damaged is refused with its line, and every
 * recording of a real tablet loads. */
#include "pen.h"
#include "table.h"
#include "tape.h"
#include "test.h"

#define DATA "../shared/data/hid/"

static bool read_text(struct tape *tape, const char *text, char fault[200])
{
	return tape_read(tape, text, strlen(text), fault);
}

/* --- round trip ------------------------------------------------------------------------------- */

static int write_parts(char *text, const struct tape *tape)
{
	int size = 0, length;
	for (int part = 0; (length = tape_write_head(text + size, tape, part)) > 0; part++)
		size += length;
	for (int i = 0; i < 2; i++)
		for (int part = 0;
		     (length = tape_write_device(text + size, i, &tape->device[i], part)) > 0;
		     part++)
			size += length;
	return size;
}

static void check_round_trip(void)
{
	static struct tape out, in;
	static char text[8 * TAPE_LINE_MAX];
	char fault[200];
	out = (struct tape){
		.width_px = 1920, .height_px = 1080, .budget_units = 260000, .frame_count = 120};
	out.mount = (struct pen_mount){.degrees = 180,
				       .display = true,
				       .panel_width = 1080,
				       .panel_height = 1920,
				       .rotation = 270,
				       .cross_count = 2,
				       .cross = {{1, 2, 3, 4}, {96012, 0, 1638400, 54000}}};
	out.device[0] = (struct tape_device){true,
					     "Pen of ours",
					     3,
					     0x256c,
					     0x6d,
					     203.2f,
					     127.0f,
					     true,
					     {PEN_UCLOGIC_2, 50800, 31750, 8191},
					     mouse_descriptor_size,
					     {0}};
	memcpy(out.device[0].descriptor, mouse_descriptor, (size_t)mouse_descriptor_size);
	out.device[1] = (struct tape_device){true,
					     "buttons",
					     0x19,
					     0,
					     1,
					     0.0f,
					     0.0f,
					     false,
					     {PEN_BY_DESCRIPTOR, 0, 0, 0},
					     buttons_descriptor_size,
					     {0}};
	memcpy(out.device[1].descriptor, buttons_descriptor, (size_t)buttons_descriptor_size);
	static const uint8_t report[] = {1, 0x20, 0xab}, press[] = {1};
	int size = write_parts(text, &out);
	size += tape_write_select(text + size, 0);
	size += tape_write_event(text + size, 16000, 3, report);
	size += tape_write_event(text + size, 16700, 3, report);
	size += tape_write_select(text + size, 1);
	size += tape_write_event(text + size, 1234567, 1, press);
	size += tape_write_unplug(text + size, 1500000, 0);

	CHECK(tape_read(&in, text, (size_t)size, fault));
	CHECK(in.width_px == 1920 && in.height_px == 1080 && in.budget_units == 260000);
	CHECK(in.frame_count == 120 && in.event_count == 4);
	CHECK(!memcmp(&in.mount, &out.mount, sizeof in.mount));
	CHECK(!strcmp(in.device[0].name, "Pen of ours") && in.device[0].vendor == 0x256c);
	CHECK_NEAR(in.device[0].width_mm, 203.2, 1e-4);
	CHECK(in.device[0].display && !in.device[1].display);
	CHECK_NEAR(in.device[0].height_mm, 127.0, 1e-4);
	CHECK(in.device[0].speaks.family == PEN_UCLOGIC_2);
	CHECK(in.device[0].speaks.x_maximum == 50800 && in.device[0].speaks.y_maximum == 31750);
	CHECK(in.device[0].speaks.pressure_maximum == 8191);
	CHECK(in.device[1].speaks.family == PEN_BY_DESCRIPTOR);
	CHECK(in.device[1].bus == 0x19 && in.device[1].product == 1 && !in.device[2].used);
	CHECK(in.device[1].descriptor_size == buttons_descriptor_size);
	CHECK(!memcmp(in.device[1].descriptor, buttons_descriptor,
		      (size_t)buttons_descriptor_size));
	CHECK(in.event[0].time_us == 16000 && in.event[0].size == 3);
	CHECK(!memcmp(in.bytes + in.event[1].offset, report, 3));
	CHECK(in.event[2].device == 1 && in.event[2].time_us == 1234567);
	CHECK(in.event[3].device == 0 && in.event[3].size == 0 && in.event[3].time_us == 1500000);
	tape_free(&in);
}

/* --- frames ----------------------------------------------------------------------------------- */

static void check_frames(void)
{
	static struct tape tape;
	static struct frame_reports reports;
	char fault[200];
	size_t cursor = 0;
	CHECK(read_text(&tape,
			"# kitsuke-tape 1\nR: 1 00\n"
			"E: 0.0 1 01\nE: 0.016666 1 02\nE: 0.016667 1 03\n"
			"# unplug 0 at 0.017\nE: 0.018 1 04\nE: 2.000000 1 05\n",
			fault));
	CHECK(tape.frame_count == 120 + 61);
	CHECK(tape_frame(&tape, 0, &cursor, &reports) == 0 && reports.count == 2);
	CHECK(reports.report[1].bytes[0] == 2 && reports.report[1].time_us == 16666);
	CHECK(tape_frame(&tape, 1, &cursor, &reports) == 1 && reports.count == 1);
	CHECK(tape_frame(&tape, 2, &cursor, &reports) == 0 && reports.count == 1);
	CHECK(reports.report[0].bytes[0] == 4);
	CHECK(tape_frame(&tape, 119, &cursor, &reports) == 0 && reports.count == 0);
	CHECK(tape_frame(&tape, 120, &cursor, &reports) == 0 && reports.count == 1);
	tape_free(&tape);

	static char flood[100 * 20];
	int size = snprintf(flood, sizeof flood, "R: 1 00\n");
	for (int i = 0; i < 100; i++)
		size += snprintf(flood + size, sizeof flood - (size_t)size, "E: 0.0 1 %02x\n", i);
	CHECK(read_text(&tape, flood, fault));
	cursor = 0;
	tape_frame(&tape, 0, &cursor, &reports);
	CHECK(reports.count == FRAME_REPORTS_MAX);
	tape_frame(&tape, 1, &cursor, &reports);
	CHECK(reports.count == 100 - FRAME_REPORTS_MAX && reports.report[0].bytes[0] == 64);
	tape_free(&tape);
}

/* --- variants and damage ---------------------------------------------------------------------- */

static void check_variants(void)
{
	static struct tape tape;
	char fault[200];
	CHECK(read_text(
		&tape,
		"# 027:0 -> 056A:00D0 / Wacom\r\nD:1\r\nR: 2 05 0d \r\nN: a\r\nI: 3 056A 00D0\r\n"
		"# SET_REPORT (Feature) ID: 02 -> 02 02 (length 2)\r\n"
		"E: 0.000000 2 02 0f \r\nE: 1.5 2 02 0E\r\n",
		fault));
	CHECK(tape.event_count == 2 && tape.event[1].time_us == 1500000);
	CHECK(tape.event[1].device == 1 && tape.device[1].vendor == 0x56a);
	tape_free(&tape);

	CHECK(read_text(&tape,
			"Starting dumping interrupt transfer stream\nwith 1 minute timeout.\n\n"
			"002:004:001:DESCRIPTOR         1536019347.000000\n 05 0D\n 09 02\n\n"
			"002:004:001:STREAM             1536019347.135589\n 01 C0 1D\n 07 F2\n\n"
			"002:004:002:STREAM             1536019347.138576\n 05 C0\n"
			"002:004:000:Interrupt transfer timed out\n",
			fault));
	CHECK(tape.event_count == 2 && tape.event[0].size == 5 && tape.event[1].size == 2);
	CHECK(tape.event[0].time_us == 0 && tape.event[1].time_us == 2987);
	CHECK(tape.event[0].device == 1 && tape.event[1].device == 2);
	CHECK(tape.device[1].descriptor_size == 4 && tape.device[1].descriptor[2] == 9);
	tape_free(&tape);

	CHECK(read_text(&tape, "000:STREAM   1281177908.280276\n 02 77 13 37\n", fault));
	CHECK(tape.event_count == 1 && tape.event[0].size == 4);
	tape_free(&tape);
}

static void check_damage(void)
{
	static const struct {
		const char *text, *fault;
	} cases[] = {
		{"", "line 0: no event"},
		{"R: 1 00\n", "line 1: no event"},
		{"hello", "line 1: unknown line"},
		{"\n\nE: 0.0 1 00\n", "line 3: an event of device 0"},
		{"R: 2 05\n", "line 1: a descriptor of 2 bytes"},
		{"R: 1 05 06\n", "line 1: a descriptor of 1 bytes"},
		{"R: 5000 05\n", "line 1: a report descriptor has 1 to 4096"},
		{"R: 1 0g\n", "line 1: a descriptor"},
		{"R: 1 00\nE: 0.0 2 00\n", "line 2: 2 bytes were announced"},
		{"R: 1 00\nE: 0.0 1 000\n", "line 2: 1 bytes were announced"},
		{"R: 1 00\nE: 1 1 00\n", "line 2: no time"},
		{"R: 1 00\nE: -1.0 1 00\n", "line 2: no time"},
		{"R: 1 00\nE: 99999999999.0 1 00\n", "line 2: no time"},
		{"R: 1 00\nE: 100000.0 1 00\n", "line 2: a time beyond 24 hours"},
		{"R: 1 00\nE: 0.0 193 00\n", "line 2: a report has 1 to 192"},
		{"R: 1 00\nE: 5.0 1 00\nE: 3.0 1 00\n", "line 3: time goes back"},
		{"D: 8\n", "line 1: a device outside of 0 to 7"},
		{"I: 3 056a\n", "line 1: I: needs"},
		{"# kitsuke-tape 2\n", "line 1: this program reads version 1"},
		{"# kitsuke-tape 1\n# board 0 5\n", "line 2: a screen"},
		{"# kitsuke-tape 1\n# frames 0\n", "line 2: a tape has"},
		{"# kitsuke-tape 1\n# budget x\n", "line 2: a budget"},
		{"# kitsuke-tape 1\n# unplug 0\n", "line 2: it reads like # unplug"},
		{"# kitsuke-tape 1\n# tablet 0 200\n", "line 2: it reads like # tablet"},
		{"# kitsuke-tape 1\n# vendor 0 uclogic-2 50800 31750\n",
		 "line 2: it reads like # vendor"},
		{"# kitsuke-tape 1\n# vendor 9 uclogic-2 50800 31750 8191\n",
		 "line 2: it reads like # vendor"},
		{"# kitsuke-tape 1\n# vendor 0 uclogic-2 50800 99999999 8191\n",
		 "line 2: it reads like # vendor"},
		{"# kitsuke-tape 1\n# vendor 0 telepathy 50800 31750 8191\n",
		 "line 2: a protocol that this"},
		{"001:002:000:STREAM 1.0\n 01\n\n001:003:000:STREAM 1.1\n 01\n",
		 "line 4: a second device"},
		{"009:STREAM 1.0\n 01\n", "line 1: an interface"},
		{"000:STREAM 1.0\n 0x\n", "line 2: no hex"},
		{"12345\n", "line 1: unknown line"},
	};
	for (int i = 0; i < COUNT_OF(cases); i++) {
		struct tape tape;
		char fault[200];
		bool sound = read_text(&tape, cases[i].text, fault);
		if (sound || strncmp(fault, cases[i].fault, strlen(cases[i].fault))) {
			fprintf(stderr, "case %d: %s, expected \"%s\"\n", i,
				sound ? "was read" : fault, cases[i].fault);
			test_failures++;
		}
		tape_free(&tape);
	}
}

/* --- recordings of real tablets --------------------------------------------------------------- */

static int check_recordings(void)
{
	static struct table recordings;
	static struct tape tape;
	int loaded = 0;
	if (!table_read(&recordings, DATA "recordings.csv", ','))
		return 0;
	for (int row = 0; row < recordings.rows; row++) {
		char path[512], fault[200];
		size_t size;
		snprintf(path, sizeof path, DATA "%s", table_cell(&recordings, row, "data_path"));
		char *text = table_file(path, &size);
		if (!text)
			continue;
		bool sound = tape_read(&tape, text, size, fault);
		long expected = strtol(table_cell(&recordings, row, "reports"), NULL, 10);
		if (!sound || (long)tape.event_count != expected) {
			fprintf(stderr, "%s: %s %zu events, expected %ld\n", path,
				sound ? "" : fault, tape.event_count, expected);
			test_failures++;
		}
		loaded++;
		tape_free(&tape);
		free(text);
	}
	return loaded;
}

int main(void)
{
	check_round_trip();
	check_frames();
	check_variants();
	check_damage();
	if (check_recordings() == 0) {
		printf("skip: no recordings at " DATA "\n");
		return test_failures ? EXIT_FAILURE : 77;
	}
	return test_end();
}
