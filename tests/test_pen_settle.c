/* Contacts in doubt: too short ones, lifts that are none, and that nothing is lost or late by it.
 */
#include "pen.h"
#include "table.h"
#include "test.h"

/* Report 7: flags (tip, -, -, -, -, in range), x 0..32000, y 0..18000 on 320 mm x 180 mm, pressure
 * 0..1000. */
static const char *pen_hex =
	"050d 0902 a101 8507 0920 a100 0942 1500 2501 7501 9501 8102 9504 8103 0932 9501 8102 9502"
	"8103 0501 6511 550e 7510 9501 0930 3500 46800c 26007d 8102 0931 460807 265046 8102 6500"
	"5500 050d 0930 26e803 8102 c0 c0";

enum { TIP = 1, RANGE = 32, STEP_US = 4000, SEEN_MAX = 400 };

static struct pen pen;
static int64_t now_us;
static struct pen_sample seen[SEEN_MAX];
static int seen_count;

static void put16(uint8_t *bytes, int value)
{
	bytes[0] = (uint8_t)(value & 0xff);
	bytes[1] = (uint8_t)(value >> 8 & 0xff);
}

static void start(void)
{
	uint8_t bytes[DESCRIPTOR_BYTES_MAX];
	pen_init(&pen, 1920, 1080);
	pen_describe(&pen, 0, bytes, table_hex(pen_hex, bytes, sizeof bytes));
	CHECK(pen.device[0].kind == DEVICE_PEN);
	now_us = 0;
	seen_count = 0;
}

static void take(const struct frame_input *input)
{
	for (int i = 0; i < input->sample_count && seen_count < SEEN_MAX; i++)
		seen[seen_count++] = input->sample[i];
}

/* A frame with one report, or without any when flags are -1. */
static void send(int flags, int x, int pressure)
{
	static struct frame_reports reports;
	struct frame_input input = {0};
	reports.count = flags >= 0;
	reports.report[0] = (struct raw_report){.time_us = now_us, .size = 8};
	uint8_t *bytes = reports.report[0].bytes;
	bytes[0] = 7;
	bytes[1] = (uint8_t)flags;
	put16(bytes + 2, x);
	put16(bytes + 4, 9000);
	put16(bytes + 6, pressure);
	pen_read(&pen, &reports, now_us, &input);
	take(&input);
	now_us += STEP_US;
}

/* `count` reports, 0.4 mm apart. */
static void move(int flags, int count, int *x, int pressure)
{
	for (int i = 0; i < count; i++, *x += 40)
		send(flags, *x, pressure);
}

static int contacts(void)
{
	int count = 0;
	enum pen_state last = PEN_AWAY;
	for (int i = 0; i < seen_count; i++) {
		count += seen[i].state == PEN_TOUCH && last != PEN_TOUCH;
		last = seen[i].state;
		CHECK(i == 0 || seen[i].time_us >= seen[i - 1].time_us);
		CHECK(seen[i].state == PEN_TOUCH || seen[i].pressure == 0.0f);
	}
	return count;
}

static int touching(void)
{
	int count = 0;
	for (int i = 0; i < seen_count; i++)
		count += seen[i].state == PEN_TOUCH;
	return count;
}

/* Nothing of a stroke's beginning is lost: its first point and its first time are given. */
static void a_contact_keeps_its_beginning(void)
{
	int x = 8000;
	start();
	move(RANGE, 5, &x, 0);
	int64_t down_us = now_us;
	move(RANGE | TIP, 4, &x, 400); /* 12 ms so far */
	CHECK(contacts() == 0 && pen.device[0].state == PEN_HOVER);
	move(RANGE | TIP, 1, &x, 400);
	CHECK(contacts() == 1 && touching() == 5 && seen_count == 10);
	CHECK(seen[5].time_us == down_us && seen[5].state == PEN_TOUCH);
	CHECK(seen[6].position_px.x > seen[5].position_px.x);
	move(RANGE | TIP, 1, &x, 400);
	CHECK(seen_count == 11); /* and from there on nothing waits */
}

static void short_contacts_are_none(void)
{
	int x = 8000;
	start();
	move(RANGE, 5, &x, 0);
	move(RANGE | TIP, 3, &x, 900); /* 8 ms */
	move(RANGE, 5, &x, 0);
	CHECK(contacts() == 0 && seen_count == 13 && pen.device[0].chatter == 1);
	move(0, 1, &x, 0);
	CHECK(seen[seen_count - 1].state == PEN_AWAY);
	/* a pen that sends nothing while it rests is down all the same */
	move(RANGE | TIP, 1, &x, 900);
	for (int i = 0; i < 4; i++)
		send(-1, 0, 0);
	CHECK(contacts() == 1);
}

/* A late frame's reports all count at one moment: a tap is one all the same. */
static void late_taps_are_taps(void)
{
	int x = 8000;
	start();
	move(RANGE, 5, &x, 0);
	int64_t frame_us = now_us;
	for (int i = 0; i < 26; i++) { /* 130 ms of a quick hand */
		now_us = frame_us;
		send(RANGE | TIP, x, 400);
	}
	now_us = frame_us;
	move(RANGE, 5, &x, 0);
	CHECK(contacts() == 1 && touching() == 26 && pen.device[0].chatter == 0);
}

/* A switch that flickers under pressure, and a report out of range in the middle of a stroke. */
static void split_contacts_are_joined(void)
{
	static const struct {
		int flags, pressure;
	} gap[] = {{RANGE, 500}, {RANGE, 0}, {0, 0}, {0, 500}};
	for (int i = 0; i < COUNT_OF(gap); i++) {
		int x = 8000;
		start();
		move(RANGE | TIP, 10, &x, 500);
		move(gap[i].flags, 4, &x, gap[i].pressure);
		move(RANGE | TIP, 10, &x, 500);
		CHECK(contacts() == 1 && seen_count == 24 && touching() == 24);
		CHECK(pen.device[0].merged == 1);
		CHECK_NEAR(seen[14].pressure, 0.5, 1e-6); /* no thin place */
		CHECK_NEAR(seen[12].pressure, 0.5, 1e-6);
		if (gap[i].flags) /* where the pen was meanwhile */
			CHECK(seen[12].position_px.x > seen[10].position_px.x);
	}
}

static void true_lifts_are_lifts(void)
{
	int x = 8000;
	start();
	move(RANGE | TIP, 10, &x, 500);
	int64_t lifted_us = now_us;
	move(RANGE, 7, &x, 0);
	CHECK(pen.device[0].state == PEN_TOUCH);
	move(RANGE, 2, &x, 0); /* 30 ms are over */
	CHECK(pen.device[0].state == PEN_HOVER && touching() == 10 && seen_count == 19);
	CHECK(seen[10].state == PEN_HOVER && seen[10].time_us == lifted_us);
	move(RANGE | TIP, 10, &x, 500);
	CHECK(contacts() == 2 && pen.device[0].merged == 0);
	/* the pressure was gone already: no doubt, no delay */
	move(RANGE | TIP, 1, &x, 100);
	move(RANGE, 1, &x, 0);
	CHECK(pen.device[0].state == PEN_HOVER);
	/* silence after a lift */
	start();
	move(RANGE | TIP, 10, &x, 500);
	move(RANGE, 1, &x, 0);
	for (int i = 0; i < 8; i++)
		send(-1, 0, 0);
	CHECK(pen.device[0].state == PEN_HOVER);
}

/* Nobody's hand is 100 mm away in 10 ms: that is another stroke. */
static void far_away_is_another_stroke(void)
{
	int x = 4000;
	start();
	move(RANGE | TIP, 10, &x, 500);
	move(0, 3, &x, 0);
	x += 16000;
	move(RANGE | TIP, 10, &x, 500);
	CHECK(contacts() == 2 && pen.device[0].merged == 0);
}

static void unplugging_ends_all_doubts(void)
{
	struct frame_input input = {0};
	int x = 4000;
	start();
	move(RANGE | TIP, 10, &x, 500);
	move(RANGE, 1, &x, 0);
	pen_unplugged(&pen, 0, &input);
	take(&input);
	CHECK(pen.device[0].state == PEN_AWAY && pen.device[0].doubt == PEN_SURE);
	CHECK(pen.touching == -1 && contacts() == 1 && touching() == 10);
}

/* Any order of reports: as many samples as reports, no contact shorter than its least, none split
 * under pressure. */
static void any_order(void)
{
	uint32_t random = 7;
	for (int round = 0; round < 300; round++) {
		int x = 8000, sent = 0;
		start();
		for (int i = 0; i < 40; i++) {
			random = random * 1664525u + 1013904223u;
			int flags = (int[]){0, RANGE, RANGE | TIP, RANGE | TIP}[random >> 30];
			int count = 1 + (int)(random >> 8) % 9;
			count = sent + count > 300 ? 0 : count;
			move(flags, count, &x, flags & TIP ? 100 + (int)(random >> 12) % 900 : 0);
			sent += count;
		}
		for (int i = 0; i < 600; i++)
			send(-1, 0, 0);
		CHECK(seen_count >= sent && seen[seen_count - 1].state == PEN_AWAY);
		contacts();
		int64_t down_us = 0;
		for (int i = 1; i < seen_count; i++) {
			bool touch = seen[i].state == PEN_TOUCH;
			bool before = seen[i - 1].state == PEN_TOUCH;
			if (touch && !before)
				down_us = seen[i].time_us;
			if (!touch && before)
				CHECK(seen[i].time_us - down_us >= PEN_CONTACT_LEAST_US);
		}
	}
}

int main(void)
{
	a_contact_keeps_its_beginning();
	short_contacts_are_none();
	late_taps_are_taps();
	split_contacts_are_joined();
	true_lifts_are_lifts();
	far_away_is_another_stroke();
	unplugging_ends_all_doubts();
	any_order();
	return test_end();
}
