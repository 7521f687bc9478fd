/* The operator's page, from raw reports to what it does: the PIN, the settings' file, calibration
 * and the pictures. KITSUKE_PICTURES=DIR keeps them. */
#include "leaks.h"
#include "picture.h"
#include "snapshot.h"
#include "station.h"
#include "test.h"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

enum { WIDTH = 1920, HEIGHT = 1080 };

struct bench {
	struct station station;
	struct snapshot shot;
	bool seen; /* pictures can be made here */
	char folder[TEST_FOLDER_BYTES];
};

/* The desktop's mouse as a pen: seven bytes, see mouse_descriptor. */
static void report(struct station *station, struct v2 px, bool tip, bool near)
{
	struct raw_report *r = &station->reports->report[station->reports->count++];
	int x = (int)(px.x / (float)(WIDTH - 1) * 32767.0f + 0.5f);
	int y = (int)(px.y / (float)(HEIGHT - 1) * 32767.0f + 0.5f);
	memset(r, 0, sizeof *r);
	r->device = LIVE_MOUSE;
	r->time_us = (int64_t)station_frame(station) * 1000000 / FRAME_RATE_HZ;
	r->size = 7;
	r->bytes[0] = (uint8_t)(tip | near << 2);
	r->bytes[1] = (uint8_t)x;
	r->bytes[2] = (uint8_t)(x >> 8);
	r->bytes[3] = (uint8_t)y;
	r->bytes[4] = (uint8_t)(y >> 8);
	r->bytes[6] = tip ? 8 : 0;
}

/* A touch of five frames and its lifting. True when a visit must begin anew. */
static bool tap(struct bench *bench, struct v2 px)
{
	struct station *station = &bench->station;
	bool anew = false;
	for (int i = 0; i < 9 && station->desk->open; i++) {
		station->reports->count = 0;
		report(station, px, i >= 2 && i < 7, true);
		anew |= station_run_desk(station, 0);
	}
	return anew;
}

static struct v2 middle(const struct bench *bench, enum service_key key)
{
	struct rect r = bench->station.desk->page.key[key];
	CHECK(r.w > 0);
	return (struct v2){(float)r.x + 0.5f * (float)r.w, (float)r.y + 0.5f * (float)r.h};
}

static bool press(struct bench *bench, enum service_key key)
{
	return tap(bench, middle(bench, key));
}

static void picture(struct bench *bench, const char *name)
{
	const char *folder = getenv("KITSUKE_PICTURES");
	char path[PATH_BYTES_MAX], fault[FAULT_BYTES];
	if (!bench->seen)
		return;
	CHECK(draw_service(bench->shot.draw, &bench->station.desk->page, fault));
	display_read(bench->shot.display, bench->shot.rgba);
	if (folder && store_join(path, sizeof path, folder, name, fault))
		CHECK(picture_write_png(path, WIDTH, HEIGHT, bench->shot.rgba, fault));
}

/* The top bar is night, the page below it light. */
static bool bar_is_dark(const struct bench *bench, int y)
{
	const uint8_t *p = bench->shot.rgba + 4 * ((size_t)y * WIDTH + WIDTH / 2);
	return p[0] < 80;
}

static void open_page(struct bench *bench, const char *pin)
{
	snprintf(bench->station.board.service_pin, sizeof bench->station.board.service_pin, "%s",
		 pin);
	station_open_desk(&bench->station);
	CHECK(bench->station.desk->open);
}

static void pin_opens(struct bench *bench)
{
	struct service_page *page = &bench->station.desk->page;
	open_page(bench, "2580");
	CHECK(page->view == SERVICE_PIN);
	picture(bench, "pin.png");
	static const int wrong[] = {2, 5, 8, 1}, right[] = {2, 5, 8, 0};
	for (int i = 0; i < 4; i++)
		press(bench, (enum service_key)(SERVICE_KEY_DIGIT_0 + wrong[i]));
	CHECK(page->view == SERVICE_PIN && page->pin_wrong && !page->typed[0]);
	picture(bench, "pin-wrong.png");
	press(bench, SERVICE_KEY_DIGIT_9);
	CHECK(!page->pin_wrong && strlen(page->typed) == 1);
	press(bench, SERVICE_KEY_BACK);
	CHECK(!page->typed[0]);
	for (int i = 0; i < 4; i++)
		press(bench, (enum service_key)(SERVICE_KEY_DIGIT_0 + right[i]));
	CHECK(page->view == SERVICE_HOME);
	press(bench, SERVICE_KEY_LEAVE);
	CHECK(!bench->station.desk->open);
}

static bool settings_have(struct bench *bench, const char *wanted)
{
	char path[PATH_BYTES_MAX], fault[FAULT_BYTES];
	size_t size;
	store_join(path, sizeof path, bench->folder, "station.board", fault);
	char *text = store_read(path, &size, fault);
	bool has = text && strstr(text, wanted);
	free(text);
	return has;
}

/* The page says what the pen under it just sent, and no edit comes of it. */
static void page_tells(struct bench *bench)
{
	struct station *station = &bench->station;
	struct service_page *page = &station->desk->page;
	uint64_t before = session_hash(&station->kiosk->session);
	int frame = station->kiosk->frame;
	open_page(bench, "");
	CHECK(page->view == SERVICE_HOME);
	station_say("a line for the log");
	for (int i = 0; i < 80; i++) {
		desk_time(station->desk, 3000 + 90 * i);
		station->reports->count = 0;
		report(station, (struct v2){600.0f + (float)i, 400.0f}, false, true);
		station_run_desk(station, 0);
	}
	bool bytes = false, rate = false, log = false;
	for (int i = 0; i < page->card[SERVICE_CARD_PENS].count; i++) {
		const char *value = page->card[SERVICE_CARD_PENS].line[i].value;
		bytes |= !strncmp(value, "04 ", 3);
		rate |= !strncmp(value, "60 reports/s", 12) || !strncmp(value, "59 reports/s", 12);
	}
	for (int i = 0; i < page->card[SERVICE_CARD_LOG].count; i++)
		log |= !strcmp(page->card[SERVICE_CARD_LOG].line[i].value, "a line for the log");
	CHECK(bytes && rate && log);
	CHECK(page->check.count == SERVICE_CHECKS);
	CHECK(page->check.line[SERVICE_CHECK_PEN].level == SERVICE_GREEN);
	CHECK(page->check.line[SERVICE_CHECK_STORAGE].level == SERVICE_RED); /* journal -1 */
	picture(bench, "home.png");
	if (bench->seen)
		CHECK(bar_is_dark(bench, 40) && !bar_is_dark(bench, 95));
	CHECK(session_hash(&station->kiosk->session) == before && station->kiosk->frame == frame);
}

static void settings_are_kept(struct bench *bench)
{
	struct station *station = &bench->station;
	struct station again = {.journal = -1};
	press(bench, SERVICE_KEY_LANGUAGE);
	CHECK(station->board.language == BOARD_JAPANESE && settings_have(bench, "language = ja\n"));
	picture(bench, "home-ja.png");
	press(bench, SERVICE_KEY_LANGUAGE);
	picture(bench, "home-en.png");
	press(bench, SERVICE_KEY_IDLE);
	CHECK(station->board.idle_s == 300 && settings_have(bench, "idle_s = 300\n"));
	press(bench, SERVICE_KEY_TURN);
	CHECK(station->board.mount.degrees == 90 && station->desk->pen.mapping.mount.degrees == 90);
	again.board = board_default;
	snprintf(again.folder, sizeof again.folder, "%s", bench->folder);
	station_read_settings(&again);
	CHECK(again.board.idle_s == 300 && again.board.language == BOARD_ENGLISH &&
	      again.board.mount.degrees == 90 && again.base.idle_s == board_default.idle_s);
	for (int i = 0; i < 3; i++)
		press(bench, SERVICE_KEY_TURN);
	press(bench, SERVICE_KEY_LANGUAGE);
	CHECK(!settings_have(bench, "language") && !settings_have(bench, "tablet_rotation"));
}

static void leaving(struct bench *bench)
{
	struct station *station = &bench->station;
	CHECK(press(bench, SERVICE_KEY_NEW) && !station->desk->open);
	open_page(bench, "");
	bool anew = false;
	for (int i = 0; i <= DESK_IDLE_FRAMES + 1 && station->desk->open; i++) {
		station->reports->count = 0;
		report(station, (struct v2){700.0f, 500.0f}, false, true); /* lies there */
		anew |= station_run_desk(station, 0);
	}
	CHECK(!station->desk->open && !anew);
}

/* A display whose pen is seen 12 px right, 7 px above where it is, and 1 % too small. */
static struct v2 wrongly_seen(struct v2 px)
{
	return (struct v2){12.0f + 0.99f * px.x, 0.99f * px.y - 7.0f + 12.0f};
}

static void crosses_are_taken(struct bench *bench)
{
	struct station *station = &bench->station;
	struct service_page *page = &station->desk->page;
	struct pen_mount *mount = &station->board.mount;
	mount->display = true;
	mount->panel_width = WIDTH;
	mount->panel_height = HEIGHT;
	station_mount_pens(station);
	open_page(bench, "");
	press(bench, SERVICE_KEY_CALIBRATE);
	CHECK(page->view == SERVICE_CROSSES);
	for (int i = 0; i < page->cross_count; i++) {
		CHECK(page->cross == i);
		if (i == 4)
			picture(bench, "crosses.png");
		tap(bench, wrongly_seen(page->crosses[i].meant_px));
	}
	CHECK(page->view == SERVICE_RESULT && page->result_good);
	picture(bench, "result.png");
	press(bench, SERVICE_KEY_ACCEPT);
	CHECK(page->view == SERVICE_HOME && mount->cross_count == page->cross_count);
	CHECK(settings_have(bench, "calibration = "));
	struct v2 at = plane_map_apply(&station->kiosk->pen.mapping.from_display,
				       wrongly_seen((struct v2){500.0f, 300.0f}));
	CHECK_NEAR(at.x, 500.0f, 1.0);
	CHECK_NEAR(at.y, 300.0f, 1.0);
	/* all touches in one place: no map, and nothing to keep */
	struct pen_mount before = *mount;
	press(bench, SERVICE_KEY_CALIBRATE);
	for (int i = 0; i < page->cross_count; i++)
		tap(bench, (struct v2){600.0f, 500.0f});
	CHECK(page->view == SERVICE_RESULT && !page->result_good);
	picture(bench, "result-bad.png");
	press(bench, SERVICE_KEY_ACCEPT);
	CHECK(page->view == SERVICE_RESULT);
	press(bench, SERVICE_KEY_REPEAT);
	CHECK(page->view == SERVICE_CROSSES && page->cross == 0);
	tap(bench, middle(bench, SERVICE_KEY_LEAVE));
	CHECK(page->view == SERVICE_HOME && !memcmp(mount, &before, sizeof before));
	press(bench, SERVICE_KEY_LEAVE);
}

/* As many crosses as the board file says, from corner to corner, each seen on the panel once. */
static void crosses_are_as_many_as_wanted(struct bench *bench)
{
	static const int wanted[] = {4, 9, 16, 25};
	struct station *station = &bench->station;
	struct service_page *page = &station->desk->page;
	for (int w = 0; w < COUNT_OF(wanted); w++) {
		char name[32];
		station->board.crosses_asked = wanted[w];
		open_page(bench, "");
		press(bench, SERVICE_KEY_CALIBRATE);
		CHECK(page->cross_count == wanted[w]);
		struct v2 first = page->crosses[0].meant_px;
		struct v2 last = page->crosses[wanted[w] - 1].meant_px;
		CHECK_NEAR(first.x + last.x, (double)WIDTH, 0.1);
		CHECK_NEAR(first.y + last.y, (double)HEIGHT, 0.1);
		for (int i = 0; i < page->cross_count; i++)
			tap(bench, wrongly_seen(page->crosses[i].meant_px));
		CHECK(page->view == SERVICE_RESULT && page->result_good);
		snprintf(name, sizeof name, "result-%d.png", wanted[w]);
		picture(bench, name);
		press(bench, SERVICE_KEY_ACCEPT);
		CHECK(station->board.mount.cross_count == wanted[w]);
		press(bench, SERVICE_KEY_LEAVE);
	}
	station->board.crosses_asked = 9;
}

/* Two tablets, both at work, each with its own bytes, fields and rate; all of it fits the card. */
static void two_tablets_are_told(struct bench *bench)
{
	static struct tape_device tablet[2];
	const struct tape_device *told[PEN_DEVICES_MAX] = {&tablet[0], &tablet[1]};
	struct station *station = &bench->station;
	struct desk *desk = station->desk;
	const struct service_list *card = &desk->page.card[SERVICE_CARD_PENS];
	open_page(bench, "");
	for (int i = 0; i < 2; i++) {
		tablet[i].vendor = 0x256c;
		tablet[i].product = 0x6d + i;
		snprintf(tablet[i].name, sizeof tablet[i].name, "Tablet Monitor %d", i + 1);
		pen_describe(&desk->pen, i, mouse_descriptor, mouse_descriptor_size);
	}
	for (int i = 0; i < 80; i++) {
		station->reports->count = 0;
		for (int device = 0; device < 2; device++) {
			report(station, (struct v2){400.0f + (float)i, 300.0f}, device, true);
			station->reports->report[station->reports->count - 1].device = device;
		}
		station_run_desk(station, 0);
	}
	desk_show_pens(desk, told);
	int names = 0, bytes = 0;
	for (int i = 0; i < card->count; i++) {
		names += strstr(card->line[i].value, "256c:006") != NULL;
		bytes += !strncmp(card->line[i].value, "04 ", 3);
		bytes += !strncmp(card->line[i].value, "05 ", 3);
	}
	CHECK(card->count == 10 && names == 2 && bytes == 2);
	picture(bench, "two-tablets.png");
	press(bench, SERVICE_KEY_LEAVE);
}

static bool bench_open(struct bench *bench)
{
	struct station *station = &bench->station;
	char fault[FAULT_BYTES];
	test_folder(bench->folder);
	station->journal = -1;
	station->kind = DISPLAY_WINDOW;
	station->board = station->base = board_default;
	station->width = WIDTH;
	station->height = HEIGHT;
	station->memory = malloc(KIOSK_MEMORY_BYTES);
	station->kiosk = calloc(1, sizeof *station->kiosk);
	station->reports = calloc(1, sizeof *station->reports);
	station->desk = calloc(1, sizeof *station->desk);
	if (!station->memory || !station->kiosk || !station->reports || !station->desk)
		return false;
	snprintf(station->folder, sizeof station->folder, "%s", bench->folder);
	kiosk_init(station->kiosk, station->memory, WIDTH, HEIGHT);
	bench->seen = snapshot_open(&bench->shot, WIDTH, HEIGHT, fault);
	station->display = bench->shot.display;
	station->draw = bench->shot.draw;
	station->opened_us = live_clock_us();
	if (station->display)
		display_ready(station->display);
	if (!bench->seen)
		printf("no pictures here: %s\n", fault);
	return station->display;
}

int main(void)
{
	static struct bench bench;
	if (!bench_open(&bench)) {
		rmdir(bench.folder);
		return 77;
	}
	pin_opens(&bench);
	page_tells(&bench);
	settings_are_kept(&bench);
	leaving(&bench);
	crosses_are_taken(&bench);
	crosses_are_as_many_as_wanted(&bench);
	two_tablets_are_told(&bench);
	char path[PATH_BYTES_MAX];
	snprintf(path, sizeof path, "%s/station.board", bench.folder);
	unlink(path);
	rmdir(bench.folder);
	snapshot_close(&bench.shot);
	free(bench.station.desk);
	free(bench.station.reports);
	free(bench.station.kiosk);
	free(bench.station.memory);
	return test_end();
}
