/* What stands on the operator's page: everything that the machine knows about itself, and a
 * self-test with what mends it. */
#include "station.h"

#include <stdio.h>
#include <sys/statvfs.h>

enum { DISK_LEAST_MB = 100, DISK_LITTLE_MB = 500 };

static void show_pens(struct station *station)
{
	struct desk *desk = station->desk;
	static struct tape_device told[LIVE_TABLETS_MAX];
	static const struct tape_device mouse = {.used = true, .name = "the desktop's mouse"};
	const struct tape_device *given[PEN_DEVICES_MAX] = {NULL};
	char text[LIVE_TEXT_MAX];
	for (int i = 0; station->live && i < LIVE_TABLETS_MAX; i++) {
		live_device(station->live, i, &told[i]);
		given[i] = told[i].used ? &told[i] : NULL;
	}
	if (station->kind == DISPLAY_WINDOW)
		given[LIVE_MOUSE] = &mouse;
	desk_show_pens(desk, given);
	if (!station->live)
		return;
	live_text(station->live, text);
	service_list_add(&desk->page.card[SERVICE_CARD_PENS], SERVICE_PLAIN, "search", "%s", text);
	service_list_add(&desk->page.card[SERVICE_CARD_PENS],
			 live_lost(station->live) ? SERVICE_AMBER : SERVICE_PLAIN, "dropped",
			 "%ld reports in a full queue", live_lost(station->live));
}

static void show_buttons(struct station *station)
{
	static const char *const name[] = {"WRAP", "PIN", "RELAX"};
	struct service_list *card = &station->desk->page.card[SERVICE_CARD_BUTTONS];
	struct buttons_state state = {0};
	card->count = 0;
	if (!station->buttons) {
		service_list_add(card, SERVICE_PLAIN, "", "the board names no line");
		return;
	}
	buttons_look(station->buttons, &state);
	for (int i = 0; i < BUTTON_COUNT; i++) {
		bool stuck = state.stuck >> i & 1;
		long bounces = state.edges[i] - 2 * state.presses[i];
		service_list_add(card, stuck ? SERVICE_RED : SERVICE_PLAIN, name[i],
				 "%s   %ld presses", state.level >> i & 1 ? "DOWN" : "up",
				 state.presses[i]);
		service_list_add(card, stuck ? SERVICE_RED : SERVICE_PLAIN, " ",
				 stuck ? "STUCK: free it" : "bounces %ld",
				 bounces > 0 ? bounces : 0);
	}
}

static void show_display(struct station *station)
{
	struct service_list *card = &station->desk->page.card[SERVICE_CARD_DISPLAY];
	const char *reason = display_reason(station->display);
	int width, height;
	display_size(station->display, &width, &height);
	card->count = 0;
	service_list_add(card, SERVICE_PLAIN, "driven by",
			 station->kind == DISPLAY_KMS ? "KMS, fullscreen" : "a desktop window");
	service_list_add(card, SERVICE_PLAIN, "mode", "%d x %d", width, height);
	service_list_add(card, SERVICE_PLAIN, "picture", "%d x %d, by %d\302\260", station->width,
			 station->height, station->board.rotation);
	service_list_add(card, reason[0] ? SERVICE_RED : SERVICE_PLAIN, "state", "%s",
			 reason[0] ? reason : "shows the picture");
	service_list_add(card, SERVICE_PLAIN, "flips late", "%ld", station->desk->late);
	service_list_add(card, SERVICE_PLAIN, "GL contexts", "%d",
			 display_generation(station->display));
}

static void show_solver(struct station *station)
{
	struct service_list *card = &station->desk->page.card[SERVICE_CARD_SOLVER];
	const struct session *session = &station->kiosk->session;
	card->count = 0;
	service_list_add(card, SERVICE_PLAIN, "budget", "%ld units a frame", session->budget_units);
	service_list_add(card, SERVICE_PLAIN, "triangles", "%d",
			 session->cloth.worn ? session->garment.triangle_count : 0);
	service_list_add(card, SERVICE_PLAIN, "frame p50", "%.1f ms",
			 (double)desk_time_ms(station->desk, 0.5f));
	service_list_add(card, SERVICE_PLAIN, "frame p99", "%.1f ms",
			 (double)desk_time_ms(station->desk, 0.99f));
	service_list_add(card, SERVICE_PLAIN, "body", "%s",
			 station->body ? store_name(station->body) : "mannequin");
}

static void show_visits(struct station *station)
{
	struct service_list *card = &station->desk->page.card[SERVICE_CARD_VISITS];
	long up_s = (long)((live_clock_us() - station->opened_us) / 1000000);
	int visit_s = station->kiosk->frame / FRAME_RATE_HZ;
	card->count = 0;
	service_list_add(card, SERVICE_PLAIN, "visits", "%ld since the start",
			 station->desk->visits);
	service_list_add(card, SERVICE_PLAIN, "running for", "%ld h %02ld min", up_s / 3600,
			 up_s / 60 % 60);
	service_list_add(card, SERVICE_PLAIN, "this visit", "%d min %02d s", visit_s / 60,
			 visit_s % 60);
	service_list_add(card, SERVICE_PLAIN, "saved in", "%.160s",
			 station->journal >= 0 ? station->folder : "not saved");
}

static void show_log(struct station *station)
{
	struct service_list *card = &station->desk->page.card[SERVICE_CARD_LOG];
	int count = 0, room = 9;
	card->count = 0;
	while (desk_log_line(count))
		count++;
	for (int i = int_max(count - room, 0); i < count; i++)
		service_list_add(card, SERVICE_PLAIN, "", "%s", desk_log_line(i));
}

/* ---- the self-test ---- */

static void check_pen(struct station *station, struct service_list *check)
{
	const struct pen *pen = &station->desk->pen;
	char text[LIVE_TEXT_MAX] = "no pen: plug a tablet in";
	int pens = 0;
	bool worn = false;
	if (station->live)
		live_text(station->live, text);
	for (int i = 0; i < PEN_DEVICES_MAX; i++) {
		bool mouse = i == LIVE_MOUSE && station->kind != DISPLAY_WINDOW;
		if (pen->device[i].kind != DEVICE_PEN || mouse)
			continue;
		pens++;
		worn |= pen->device[i].nib[0].offset > 0;
	}
	if (worn)
		service_list_add(check, SERVICE_AMBER, "", "the nib is worn: replace it");
	else if (pens)
		service_list_add(check, SERVICE_GREEN, "",
				 pens == 1 ? "%d tablet is read" : "%d tablets are read", pens);
	else
		service_list_add(check, SERVICE_RED, "", "%s", text);
}

static void check_buttons(struct station *station, struct service_list *check)
{
	struct buttons_state state;
	char text[LIVE_TEXT_MAX];
	if (!station->buttons) {
		service_list_add(check, SERVICE_AMBER, "", "no line is named in the board file");
		return;
	}
	buttons_look(station->buttons, &state);
	buttons_text(station->buttons, text);
	bool fine = !state.stuck && !strcmp(text, "buttons: all lines found");
	service_list_add(check, fine ? SERVICE_GREEN : SERVICE_RED, "", "%s",
			 fine ? "all lines found" : text);
}

static void check_storage(struct station *station, struct service_list *check)
{
	struct statvfs disk;
	if (station->journal < 0 || statvfs(station->folder, &disk) != 0) {
		service_list_add(check, SERVICE_RED, "", "can't be written: make %.120s writable",
				 station->folder);
		return;
	}
	long mb = (long)((unsigned long long)disk.f_bavail * disk.f_frsize >> 20);
	enum service_level level = mb < DISK_LEAST_MB    ? SERVICE_RED
				   : mb < DISK_LITTLE_MB ? SERVICE_AMBER
							 : SERVICE_GREEN;
	service_list_add(
		check, level, "",
		level == SERVICE_GREEN ? "%ld MB free" : "%ld MB free: take old visits away", mb);
}

static void check_solver(struct station *station, struct service_list *check)
{
	float ms = desk_time_ms(station->desk, 0.99f), frame_ms = 1000.0f / FRAME_RATE_HZ;
	enum service_level level = ms <= frame_ms          ? SERVICE_GREEN
				   : ms <= 2.0f * frame_ms ? SERVICE_AMBER
							   : SERVICE_RED;
	service_list_add(check, level, "",
			 level == SERVICE_GREEN ? "%.1f of %.1f ms a frame"
						: "%.1f of %.1f ms a frame: run kitsuke calibrate",
			 (double)ms, (double)frame_ms);
}

static void show_checks(struct station *station)
{
	struct service_list *check = &station->desk->page.check;
	const char *reason = display_reason(station->display);
	check->count = 0;
	service_list_add(check, reason[0] ? SERVICE_RED : SERVICE_GREEN, "", "%s",
			 reason[0] ? reason : "shows the picture");
	check_pen(station, check);
	check_buttons(station, check);
	check_storage(station, check);
	check_solver(station, check);
}

/* Is there a tablet that is the screen, by the board file or by what is known of the model? */
static bool pen_display(const struct station *station)
{
	bool display = station->board.mount.display;
	for (int i = 0; i < PEN_DEVICES_MAX; i++) {
		const struct pen_device *d = &station->desk->pen.device[i];
		display |= d->kind == DEVICE_PEN && d->display;
	}
	return display;
}

static void show_keys(struct station *station)
{
	bool display = pen_display(station);
	static const char *const language[] = {"日本語 + EN", "日本語", "English"};
	struct service_page *page = &station->desk->page;
	const struct board *board = &station->board;
	snprintf(page->value[SERVICE_KEY_LANGUAGE], sizeof page->value[0], "%s",
		 language[board->language]);
	snprintf(page->value[SERVICE_KEY_IDLE], sizeof page->value[0],
		 board->idle_s ? "%d s" : "never", board->idle_s);
	snprintf(page->value[SERVICE_KEY_TURN], sizeof page->value[0], "%d\302\260",
		 board->mount.degrees);
	page->dull[SERVICE_KEY_TURN] = display;
	page->dull[SERVICE_KEY_CALIBRATE] = !display;
	snprintf(page->value[SERVICE_KEY_CALIBRATE], sizeof page->value[0], "%s",
		 !display                        ? "no pen display"
		 : board->mount.cross_count == 0 ? "as built"
						 : "done");
}

void station_show_page(struct station *station)
{
	show_pens(station);
	show_buttons(station);
	show_display(station);
	show_solver(station);
	show_visits(station);
	show_log(station);
	show_checks(station);
	show_keys(station);
	station->desk->page.changed++;
}
