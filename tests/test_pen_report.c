/* From reports to samples: contact, silence, jumps, pressure, mapping, unplugging, buttons. */
#include "pen.h"
#include "table.h"
#include "test.h"

/* Report 7: flags (tip, barrel, eraser, invert, -, in range), x 0..32000, y 0..18000 on 320 mm x
 * 180 mm, pressure 0..1000, tilt -9000..9000 hundredths of a degree. 12 bytes with the id. */
static const char *pen_hex =
	"050d 0902 a101 8507 0920 a100 0942 0944 0945 093c 1500 2501 7501 9504 8102 9501 8103 0932"
	"8102 9502 8103 0501 6511 550e 7510 9501 0930 3500 46800c 26007d 8102 0931 460807 265046"
	"8102 6500 5500 050d 0930 26e803 8102 6514 550e 36d8dc 462823 16d8dc 262823 093d 8102 093e"
	"8102 c0 c0";

/* The same without In Range. */
static const char *rangeless_hex =
	"050d 0902 a101 8507 0920 a100 0942 0944 0945 093c 1500 2501 7501 9504 8102 9504 8103"
	"0501 6511 550e 7510 9501 0930 3500 46800c 26007d 8102 0931 460807 265046"
	"8102 6500 5500 050d 0930 26e803 8102 6514 550e 36d8dc 462823 16d8dc 262823 093d 8102 093e"
	"8102 c0 c0";

enum { TIP = 1, BARREL = 2, ERASER = 4, INVERT = 8, RANGE = 32 };

static struct pen pen;
static struct frame_reports reports;
static struct frame_input input;

static void describe(int device, const char *hex)
{
	uint8_t bytes[DESCRIPTOR_BYTES_MAX];
	pen_describe(&pen, device, bytes, table_hex(hex, bytes, sizeof bytes));
	CHECK(pen.device[device].kind == DEVICE_PEN);
}

/* Each report's own word; what becomes of contacts in doubt is test_pen_settle.c's. */
static void start(const char *hex)
{
	pen_init(&pen, 1920, 1080);
	pen.contact_least_us = pen.merge_us = 0;
	describe(0, hex);
}

static void put16(uint8_t *bytes, int value)
{
	bytes[0] = (uint8_t)(value & 0xff);
	bytes[1] = (uint8_t)(value >> 8 & 0xff);
}

static void report_add(int device, int64_t time_us, int flags, int x, int y, int pressure)
{
	struct raw_report *report = &reports.report[reports.count++];
	*report = (struct raw_report){.device = device, .time_us = time_us, .size = 12};
	report->bytes[0] = 7;
	report->bytes[1] = (uint8_t)flags;
	put16(report->bytes + 2, x);
	put16(report->bytes + 4, y);
	put16(report->bytes + 6, pressure);
	put16(report->bytes + 8, 1000);
	put16(report->bytes + 10, -2000);
}

static void frame_read(int64_t now_us)
{
	input = (struct frame_input){0};
	pen_read(&pen, &reports, now_us, &input);
	reports.count = 0;
}

/* One report of device 0 in a frame of its own, and its sample. */
static struct pen_sample one(int64_t time_us, int flags, int x, int y, int pressure)
{
	report_add(0, time_us, flags, x, y, pressure);
	frame_read(time_us);
	CHECK(input.sample_count == 1);
	return input.sample[0];
}

static void check_fields(void)
{
	start(pen_hex);
	const struct pen_layout *l = &pen.device[0].layout[0];
	CHECK(l->report_bits == 96 && l->in_range.bit == 13);
	CHECK_NEAR(l->width_mm, 320.0, 0.01);
	CHECK_NEAR(l->height_mm, 180.0, 0.01);
	struct pen_sample s = one(0, RANGE | BARREL | INVERT, 16000, 9000, 0);
	CHECK(s.state == PEN_HOVER && s.barrel && s.eraser);
	CHECK_NEAR(s.position_px.x, 960.0, 0.1);
	CHECK_NEAR(s.position_px.y, 540.0, 0.1);
	CHECK_NEAR(s.tilt_rad.x, 10.0 * 3.14159265 / 180.0, 1e-4);
	CHECK_NEAR(s.tilt_rad.y, -20.0 * 3.14159265 / 180.0, 1e-4);
	/* cut off, foreign and empty reports give nothing */
	report_add(0, 1000, RANGE, 1, 1, 0);
	reports.report[0].size = 11;
	report_add(0, 1000, RANGE, 1, 1, 0);
	reports.report[1].bytes[0] = 8;
	report_add(0, 1000, RANGE, 1, 1, 0);
	reports.report[2].size = 0;
	report_add(5, 1000, RANGE, 1, 1, 0);
	report_add(-1, 1000, RANGE, 1, 1, 0);
	frame_read(1000);
	CHECK(input.sample_count == 0 && pen.device[0].dropped == 1);
}

/* 5 % down, 1 % up, and the switch has its say. */
static void check_contact(void)
{
	static const struct {
		int flags, pressure;
		enum pen_state state;
	} steps[] = {
		{0, 0, PEN_AWAY},
		{RANGE, 0, PEN_HOVER},
		{RANGE | TIP, 49, PEN_HOVER}, /* below 5 % */
		{RANGE, 500, PEN_HOVER},      /* a worn nib: pressed, but no switch */
		{RANGE | TIP, 50, PEN_TOUCH},
		{RANGE | TIP, 20, PEN_TOUCH}, /* within the hysteresis */
		{RANGE | TIP, 10, PEN_TOUCH},
		{RANGE | TIP, 9, PEN_HOVER},
		{RANGE | TIP, 20, PEN_HOVER},
		{RANGE | TIP, 60, PEN_TOUCH},
		{RANGE, 60, PEN_HOVER},
		{RANGE | ERASER | INVERT, 60, PEN_TOUCH},
		{TIP, 900, PEN_AWAY}, /* out of range is out of range */
		{0, 0, PEN_AWAY},
	};
	start(pen_hex);
	for (int i = 0; i < COUNT_OF(steps); i++) {
		struct pen_sample s = one(4000 * i, steps[i].flags, 16000, 9000, steps[i].pressure);
		if (s.state != steps[i].state) {
			fprintf(stderr, "step %d: state %d, expected %d\n", i, (int)s.state,
				(int)steps[i].state);
			test_failures++;
		}
		CHECK(s.state == PEN_TOUCH || s.pressure <= 0.0f);
	}
}

/* A nib that hits hard at first draws no blot. */
static void check_pressure_ramp(void)
{
	start(pen_hex);
	one(0, RANGE, 16000, 9000, 0);
	CHECK_NEAR(one(4000, RANGE | TIP, 16000, 9000, 1000).pressure, 1.0 / 3.0, 1e-6);
	CHECK_NEAR(one(8000, RANGE | TIP, 16000, 9000, 1000).pressure, 2.0 / 3.0, 1e-6);
	CHECK_NEAR(one(12000, RANGE | TIP, 16000, 9000, 1000).pressure, 1.0, 1e-6);
	CHECK_NEAR(one(16000, RANGE | TIP, 16000, 9000, 2000).pressure, 1.0, 1e-6);
	CHECK_NEAR(one(20000, RANGE | TIP, 16000, 9000, 400).pressure, 0.4, 1e-6);
}

/* Draws at 250 mm/s for 200 ms; returns the time of the last report. */
static int64_t draw(void)
{
	int64_t time_us = 0;
	for (int i = 0; i < 50; i++, time_us += 4000)
		one(time_us, RANGE | TIP, 8000 + 100 * i, 9000, 400);
	return time_us - 4000;
}

static void check_silence_after(const char *hex, bool rest, int64_t limit_us)
{
	start(hex);
	int64_t last_us = draw();
	for (int i = 0; rest && i < 50; i++)
		one(last_us += 4000, RANGE | TIP, 8000 + 100 * 49, 9000, 400);
	frame_read(last_us + limit_us - 1);
	CHECK(input.sample_count == 0);
	frame_read(last_us + limit_us);
	CHECK(input.sample_count == 1 && input.sample[0].state == PEN_AWAY);
	CHECK(input.sample[0].time_us == last_us + limit_us && input.sample[0].pressure <= 0.0f);
	frame_read(last_us + 10 * limit_us);
	CHECK(input.sample_count == 0);

	/* The same when both reports come in one late frame: the stroke ends between them. */
	start(hex);
	last_us = draw();
	report_add(0, last_us + 3000000, RANGE | TIP, 20000, 9000, 400);
	frame_read(last_us + 3000000);
	CHECK(input.sample_count == 2 && input.sample[0].state == PEN_AWAY);
	CHECK(input.sample[1].state == PEN_TOUCH);
}

static void check_silence(void)
{
	check_silence_after(rangeless_hex, false, 100000);
	check_silence_after(pen_hex, false, 500000);
	check_silence_after(rangeless_hex, true, 2000000);
	check_silence_after(pen_hex, true, 2000000);

	/* the desktop's mouse is held still for as long as anyone likes */
	pen_init(&pen, 1920, 1080);
	pen_describe(&pen, 0, mouse_descriptor, mouse_descriptor_size);
	reports = (struct frame_reports){1, {{0, 0, 7, {7, 0, 0x40, 0, 0x40, 0xff, 0x0f}}}};
	frame_read(0);
	CHECK(input.sample_count == 1 && input.sample[0].state == PEN_TOUCH);
	CHECK(input.sample[0].barrel);
	frame_read(60000000);
	CHECK(input.sample_count == 0);
	/* several moves in one frame carry one time: all are taken as they are */
	reports = (struct frame_reports){2,
					 {{0, 0, 7, {5, 0, 0x10, 0, 0x10, 0xff, 0x0f}},
					  {0, 0, 7, {5, 0, 0x70, 0, 0x70, 0xff, 0x0f}}}};
	frame_read(60000000);
	CHECK(input.sample_count == 2);
	CHECK_NEAR(input.sample[0].position_px.x, 240.0, 0.1);
	CHECK_NEAR(input.sample[1].position_px.x, 1680.0, 0.1);
}

static void check_null_position(void)
{
	start(pen_hex);
	CHECK(one(0, RANGE, 0xffff, 0xffff, 0).state == PEN_AWAY);
	one(4000, RANGE | TIP, 16000, 9000, 400);
	struct pen_sample s = one(8000, RANGE | TIP, 0xffff, 0xffff, 400);
	CHECK(s.state == PEN_TOUCH);
	CHECK_NEAR(s.position_px.x, 960.0, 0.1);
	/* one axis outside is a pen at the rim */
	CHECK_NEAR(one(12000, RANGE, 0xffff, 9000, 0).position_px.x, 1919.0, 3.0);
	/* and positions that never come back are silence */
	start(pen_hex);
	one(0, RANGE | TIP, 16000, 9000, 400);
	for (int i = 1; i < 100; i++) {
		report_add(0, 30000 * i, RANGE | TIP, 0xffff, 0xffff, 400);
		frame_read(30000 * i);
	}
	CHECK(pen.device[0].state == PEN_AWAY);
}

/* One wild report moves nothing; a second in the same place is believed. */
static void check_jump(void)
{
	start(pen_hex);
	one(0, RANGE | TIP, 16000, 9000, 400);
	one(4000, RANGE | TIP, 16000, 9000, 400);
	CHECK_NEAR(one(8000, RANGE | TIP, 2000, 2000, 400).position_px.x, 960.0, 0.1);
	CHECK_NEAR(one(12000, RANGE | TIP, 16010, 9000, 400).position_px.x, 960.0, 1.0);
	CHECK_NEAR(one(16000, RANGE | TIP, 2000, 2000, 400).position_px.x, 960.0, 1.0);
	CHECK_NEAR(one(20000, RANGE | TIP, 2010, 2000, 400).position_px.x, 120.6, 0.2);
	/* hovering, nothing is drawn: the position is taken as it comes */
	start(pen_hex);
	one(0, RANGE, 16000, 9000, 0);
	CHECK_NEAR(one(4000, RANGE, 2000, 2000, 0).position_px.x, 120.0, 5.0);
}

/* Jitter at rest shrinks; in motion the position is at most one report behind. */
static void check_filter(void)
{
	start(pen_hex);
	float least = 1e9f, most = 0.0f;
	for (int i = 0; i < 500; i++) {
		int noise = i * 7919 % 21 - 10; /* +-0.1 mm */
		float x = one(4000 * i, RANGE | TIP, 16000 + noise, 9000, 400).position_px.x;
		least = i < 50 || x > least ? least : x;
		most = i < 50 || x < most ? most : x;
	}
	CHECK((most - least) / 6.0f < 0.12f); /* mm; raw 0.2 */

	static const int speeds_mm_s[] = {20, 50, 200, 1000};
	for (int i = 0; i < COUNT_OF(speeds_mm_s); i++) {
		start(pen_hex);
		int step = speeds_mm_s[i] * 4 / 10; /* units of 0.01 mm in 4 ms */
		for (int k = 0; k < 60; k++) {
			int x = 2000 + k * step;
			float px = one(4000 * k, RANGE | TIP, x, 9000, 400).position_px.x;
			float behind_mm = (float)x / 100.0f - px / 6.0f;
			CHECK(behind_mm < float_max((float)step / 100.0f, 0.1f) + 0.01f);
			CHECK(behind_mm > -0.02f);
		}
	}
}

/* One scale in both directions, the screen is covered, what is over lies outside of it. */
static void check_mapping(void)
{
	static const struct {
		float width_mm, height_mm;
		int x, y;
		float x_px, y_px;
	} cases[] = {
		{320, 180, 0, 0, 0, 0},
		{320, 180, 32000, 18000, 1919, 1079},
		{320, 200, 16000, 9000, 960, 540},
		{320, 200, 0, 0, 0, 0},         /* 60 px above the screen */
		{320, 200, 16000, 900, 960, 0}, /* exactly its rim */
		{320, 200, 16000, 1800, 960, 60},
		{200, 100, 16000, 4500, 960, 270}, /* 10.8 px/mm: the height decides */
		{200, 100, 8000, 9000, 420, 540},
	};
	for (int i = 0; i < COUNT_OF(cases); i++) {
		start(pen_hex);
		pen_resize(&pen, 0, cases[i].width_mm, cases[i].height_mm);
		struct pen_sample s = one(0, RANGE, cases[i].x, cases[i].y, 0);
		CHECK_NEAR(s.position_px.x, cases[i].x_px, 0.05);
		CHECK_NEAR(s.position_px.y, cases[i].y_px, 0.05);
	}
}

static void check_unplugged(void)
{
	start(pen_hex);
	draw();
	input = (struct frame_input){0};
	pen_unplugged(&pen, 0, &input);
	CHECK(input.sample_count == 1 && input.sample[0].state == PEN_AWAY && pen.touching == -1);
	input = (struct frame_input){0};
	pen_unplugged(&pen, 0, &input);
	CHECK(input.sample_count == 0);
}

/* While one pen draws, another has no say; afterwards it has. */
static void check_two_pens(void)
{
	start(pen_hex);
	describe(1, rangeless_hex);
	report_add(0, 0, RANGE | TIP, 16000, 9000, 400);
	report_add(1, 1000, TIP, 3000, 3000, 400);
	report_add(0, 4000, RANGE, 16000, 9000, 0);
	report_add(1, 5000, TIP, 3000, 3000, 400);
	frame_read(5000);
	CHECK(input.sample_count == 3 && pen.touching == 1);
	CHECK_NEAR(input.sample[2].position_px.x, 180.0, 0.1);
}

static void buttons_frame(int device, int first, int second)
{
	reports = (struct frame_reports){
		2, {{device, 0, 1, {(uint8_t)first}}, {device, 1, 1, {(uint8_t)second}}}};
	frame_read(10);
}

static void check_buttons(void)
{
	pen_init(&pen, 1920, 1080);
	pen_describe(&pen, 2, buttons_descriptor, buttons_descriptor_size);
	pen_describe(&pen, 3, buttons_descriptor, buttons_descriptor_size);
	buttons_frame(2, 1 << BUTTON_WRAP, 0);
	CHECK(input.buttons_held == 0 && input.buttons_pressed == 1 << BUTTON_WRAP);
	buttons_frame(2, 1 << BUTTON_PIN, 0xff);
	CHECK(input.buttons_held == 7 && input.buttons_pressed == 7);
	buttons_frame(2, 7, 7);
	CHECK(input.buttons_held == 7 && input.buttons_pressed == 0);
	buttons_frame(3, 1, 0);
	CHECK(input.buttons_held == 7);
	pen_unplugged(&pen, 2, &input);
	CHECK(input.buttons_held == 0);
}

/* A frame with more samples than fit keeps the last state. */
static void check_full(void)
{
	start(pen_hex);
	for (int i = 0; i < FRAME_REPORTS_MAX; i++)
		report_add(0, 1000 * i, RANGE | TIP, 16000, 9000, 400);
	input = (struct frame_input){0};
	pen_read(&pen, &reports, 64000, &input);
	CHECK(input.sample_count == FRAME_SAMPLES_MAX);
	pen_unplugged(&pen, 0, &input);
	CHECK(input.sample_count == FRAME_SAMPLES_MAX);
	CHECK(input.sample[FRAME_SAMPLES_MAX - 1].state == PEN_AWAY);
	reports.count = 0;
}

int main(void)
{
	check_fields();
	check_contact();
	check_pressure_ramp();
	check_silence();
	check_null_position();
	check_jump();
	check_filter();
	check_mapping();
	check_unplugged();
	check_two_pens();
	check_buttons();
	check_full();
	return test_end();
}
