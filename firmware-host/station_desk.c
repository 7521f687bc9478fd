/* The operator's page at the station: what was set on it, who opens it, and what its keys do. */
#include "station.h"

#include <stdio.h>
#include <stdlib.h>

static const char settings_name[] = "station.board";

/* ---- what was set ---- */

void station_read_settings(struct station *station)
{
	char path[PATH_BYTES_MAX], wrong[200], fault[FAULT_BYTES];
	size_t size;
	station->base = station->board;
	if (!store_join(path, sizeof path, station->folder, settings_name, fault))
		return;
	char *text = store_read(path, &size, fault);
	if (!text)
		return; /* nothing was set yet */
	if (!board_read_over(&station->board, text, size, wrong))
		fprintf(stderr, "kitsuke: %.250s: %s; it is left out\n", path, wrong);
	free(text);
}

static void write_settings(struct station *station)
{
	char path[PATH_BYTES_MAX], text[BOARD_OVER_MAX], fault[FAULT_BYTES];
	int size = board_write_over(&station->base, &station->board, text);
	if (!store_join(path, sizeof path, station->folder, settings_name, fault) ||
	    !store_write(path, text, (size_t)size, fault))
		station_say(fault);
	else
		station_say("service: settings are saved");
}

/* ---- opening and closing ---- */

static void describe_pens(struct station *station, struct pen *pen)
{
	struct tape_device told;
	for (int i = 0; station->live && i < LIVE_TABLETS_MAX; i++) {
		live_device(station->live, i, &told);
		tape_learn(pen, i, &told);
	}
	pen_describe(pen, LIVE_BUTTONS, buttons_descriptor, buttons_descriptor_size);
	pen_describe(pen, LIVE_MOUSE, mouse_descriptor, mouse_descriptor_size);
	pen_describe(pen, LIVE_KEYS, buttons_descriptor, buttons_descriptor_size);
}

bool station_wants_desk(struct station *station)
{
	struct desk *desk = station->desk;
	bool all = station->kind == DISPLAY_WINDOW && !desk->open &&
		   station->kiosk->input.buttons_held == (1 << BUTTON_COUNT) - 1;
	bool asked = station->buttons && buttons_service(station->buttons);
	desk->chord = all ? desk->chord + 1 : 0;
	asked |= desk->chord == DESK_CHORD_FRAMES;
	desk->wanted = asked && !desk->open;
	return asked;
}

/* The mount of the page's own pens; a calibration under way is made without the old one. */
static void mount_desk(struct station *station, bool calibrated)
{
	struct pen_mount mount = station->kiosk->pen.mapping.mount;
	if (!calibrated)
		mount.cross_count = 0;
	pen_mount(&station->desk->pen, &mount);
}

static int crosses_a_side(const struct board *board)
{
	int side = 2;
	while (side * side < board->crosses_asked)
		side++;
	return side;
}

void station_open_desk(struct station *station)
{
	struct desk *desk = station->desk;
	desk->wanted = desk->renew = false;
	desk->open = true;
	desk->frames = 0;
	memset(desk->watch, 0, sizeof desk->watch);
	pen_init(&desk->pen, station->width, station->height);
	mount_desk(station, true);
	describe_pens(station, &desk->pen);
	service_page_open(&desk->page, station->width, station->height, station->kiosk->ui.language,
			  station->board.service_pin, crosses_a_side(&station->board));
	station_show_page(station);
}

/* The visit goes on where it stood, with pens that have nothing behind them. */
static void close_desk(struct station *station)
{
	struct desk *desk = station->desk;
	station->start_us += (int64_t)desk->frames * 1000000 / FRAME_RATE_HZ;
	desk->open = false;
	desk->frames = desk->chord = 0;
	describe_pens(station, &station->kiosk->pen);
	station_mount_pens(station);
	station->cycle = (struct cycle){0};
	station_say("service: the page is closed");
}

/* ---- keys ---- */

static float mm_per_px(const struct station *station)
{
	float width_mm = station->board.display_width_mm;
	return width_mm > 0.0f ? width_mm / (float)station->width
			       : station->kiosk->ui.layout.mm_per_px;
}

static int next_idle_s(int idle_s)
{
	static const int choice[] = {60, 90, 120, 180, 300, 0};
	for (int i = 0; i < COUNT_OF(choice); i++)
		if (choice[i] == idle_s)
			return choice[(i + 1) % COUNT_OF(choice)];
	return choice[0];
}

static void turn_tablet(struct station *station)
{
	station->board.mount.degrees = (station->board.mount.degrees + 90) % 360;
	station_mount_pens(station);
	mount_desk(station, true);
}

static void accept_crosses(struct station *station)
{
	struct pen_mount *mount = &station->board.mount;
	mount->cross_count = station->desk->tried.cross_count;
	memcpy(mount->cross, station->desk->tried.cross, sizeof mount->cross);
	station_mount_pens(station);
	mount_desk(station, true);
	service_page_show(&station->desk->page, SERVICE_HOME);
}

static void do_key(struct station *station, enum service_key key)
{
	struct desk *desk = station->desk;
	struct board *board = &station->board;
	bool sets = true;
	if (key == SERVICE_KEY_LANGUAGE) {
		board->language = (enum board_language)((board->language + 1) % 3);
		desk->page.language = station->kiosk->ui.language = (enum language)board->language;
	} else if (key == SERVICE_KEY_IDLE) {
		board->idle_s = next_idle_s(board->idle_s);
	} else if (key == SERVICE_KEY_TURN) {
		turn_tablet(station);
	} else if (key == SERVICE_KEY_ACCEPT) {
		accept_crosses(station);
	} else {
		sets = false;
	}
	if (sets)
		write_settings(station);
	if (key == SERVICE_KEY_CALIBRATE)
		mount_desk(station, desk->page.view != SERVICE_CROSSES);
	if (key == SERVICE_KEY_REPEAT) {
		desk_calibrate(desk, &station->kiosk->pen.mapping.mount, mm_per_px(station));
		service_page_show(&desk->page, SERVICE_RESULT);
	}
	desk->renew = key == SERVICE_KEY_NEW;
	station_show_page(station);
}

bool station_run_desk(struct station *station, unsigned unplugged)
{
	struct desk *desk = station->desk;
	for (int i = 0; i < LIVE_TABLETS_MAX; i++)
		if (station->plugged >> i & 1) {
			struct tape_device told;
			live_device(station->live, i, &told);
			tape_learn(&desk->pen, i, &told);
		}
	desk_listen(desk, station->reports);
	for (int i = 0; i < PEN_DEVICES_MAX; i++)
		if (unplugged >> i & 1)
			pen_unplugged(&desk->pen, i, &desk->input);
	desk->frames++;
	enum service_key key = service_page_update(&desk->page, &desk->input);
	if (key != SERVICE_KEY_NONE)
		do_key(station, key);
	else if (desk->frames % DESK_REFRESH_FRAMES == 0 && desk->page.view == SERVICE_HOME)
		station_show_page(station);
	bool closes = key == SERVICE_KEY_LEAVE || desk->renew ||
		      desk->page.silent > DESK_IDLE_FRAMES;
	if (closes)
		close_desk(station);
	return closes && desk->renew;
}
