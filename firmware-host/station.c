/* The station: devices in, kiosk_frame, picture out, for as long as it is switched on.
 *
 * Frames are the program's only clock. The loop holds them to 60 a second; when one is late the
 * program's time falls behind the wall's and stays behind, so that nothing ever has to catch up. */
#include "commands.h"

#include "character.h"
#include "options.h"
#include "resident.h"
#include "station.h"
#include "store.h"
#include "tape_learn.h"
#include "threads_board.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

enum {
	FRAME_US = 1000000 / FRAME_RATE_HZ,
	LATE_US = 3 * FRAME_US / 2,
};

static const char usage[] =
	"usage: kitsuke [--board FILE] [--body FILE|mannequin] [--journals FOLDER]\n"
	"               [--bones] [--else-replay TAPE --out DIR]\n";

static volatile sig_atomic_t stopped;

static void stop(int signal_number)
{
	(void)signal_number;
	stopped = 1;
}

/* ---- start ---- */

static bool read_board(struct station *station)
{
	char wrong[200];
	size_t size;
	station->board = station->base = board_default;
	if (!station->board_path)
		return true;
	char *text = store_read(station->board_path, &size, station->fault);
	if (!text)
		return false;
	bool read = board_read(&station->board, text, size, wrong);
	free(text);
	if (!read)
		snprintf(station->fault, FAULT_BYTES, "%.250s: %s", station->board_path, wrong);
	return read;
}

/* Journals go to the folder asked for, or to the user's state folder. */
static void find_folder(struct station *station)
{
	const char *state = getenv("XDG_STATE_HOME"), *home = getenv("HOME");
	char *folder = station->folder;
	size_t size = sizeof station->folder;
	if (station->journals)
		snprintf(folder, size, "%s", station->journals);
	else if (state)
		snprintf(folder, size, "%s/kitsuke", state);
	else
		snprintf(folder, size, "%s/.local/state/kitsuke", home ? home : ".");
	for (char *slash = strchr(folder + 1, '/'); slash; slash = strchr(slash + 1, '/')) {
		*slash = 0;
		mkdir(folder, 0777);
		*slash = '/';
	}
}

/* Without a place to write the visit goes on unsaved, and the operator is told. */
static void open_journal(struct station *station)
{
	char *path = station->journal_path, fault[FAULT_BYTES];
	time_t now = time(NULL);
	struct tm parts;
	station->journal = -1;
	station->tape_path[0] = 0;
	gmtime_r(&now, &parts);
	char name[64];
	strftime(name, sizeof name, "visit-%Y%m%d-%H%M%S.kitsuke", &parts);
	if (store_make_folder(station->folder, fault) &&
	    store_join(path, sizeof station->journal_path, station->folder, name, fault)) {
		station->journal = open(path, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
		if (station->journal < 0)
			snprintf(fault, sizeof fault, "%.200s: %s", path, strerror(errno));
	}
	if (station->journal >= 0)
		station_record_begin(station, path);
	else
		fprintf(stderr, "kitsuke: this visit is not saved: %s\n", fault);
}

static void write_journal(struct station *station, const char *bytes, int size)
{
	if (station->journal < 0 || size == 0)
		return;
	if (write(station->journal, bytes, (size_t)size) == size)
		return;
	fprintf(stderr, "kitsuke: saving stops: %s; free some space, then restart\n",
		strerror(errno));
	close(station->journal);
	station->journal = -1;
}

static void learn(struct station *station, int device)
{
	struct tape_device told;
	live_device(station->live, device, &told);
	tape_learn(&station->kiosk->pen, device, &told);
}

/* A visit begins: everything as at switching on, but for the devices. */
static bool begin_visit(struct station *station)
{
	char note[FAULT_BYTES];
	struct kiosk *kiosk = station->kiosk;
	const char *name = station->body ? station->body : CHARACTER_MANNEQUIN;
	kiosk_init(kiosk, station->memory, station->width, station->height);
	kiosk->session.cloth.crew = threads_crew(&station->threads);
	if (!character_load(&kiosk->session.body, name, NULL, note, station->fault))
		return false;
	if (station->board.budget_units > 0)
		kiosk->session.budget_units = station->board.budget_units;
	kiosk_body_named(kiosk, store_name(name));
	kiosk->ui.language = (enum language)station->board.language;
	station->desk->visits++;
	station_mount_pens(station);
	for (int device = 0; station->live && device < LIVE_TABLETS_MAX; device++)
		learn(station, device);
	pen_describe(&kiosk->pen, LIVE_BUTTONS, buttons_descriptor, buttons_descriptor_size);
	pen_describe(&kiosk->pen, LIVE_MOUSE, mouse_descriptor, mouse_descriptor_size);
	pen_describe(&kiosk->pen, LIVE_KEYS, buttons_descriptor, buttons_descriptor_size);
	if (station->draw)
		draw_body_changed(station->draw);
	station->redraw = 0;
	station->start_us = live_clock_us();
	open_journal(station);
	write_journal(station, JOURNAL_HEADER, (int)strlen(JOURNAL_HEADER));
	return true;
}

static bool open_station(struct station *station)
{
	resident_begin();
	station->memory = malloc(KIOSK_MEMORY_BYTES);
	station->kiosk = calloc(1, sizeof *station->kiosk);
	station->reports = malloc(sizeof *station->reports);
	station->desk = calloc(1, sizeof *station->desk);
	if (!station->desk || !station->memory || !station->kiosk || !station->reports) {
		snprintf(station->fault, FAULT_BYTES, "not enough memory");
		return false;
	}
	if (!threads_start_board(&station->threads, &station->board, station->fault) ||
	    !station_open_display(station) || !begin_visit(station))
		return false;
	char text[LIVE_TEXT_MAX];
	station->opened_us = live_clock_us();
	station->live = live_open(&station->board, station->opened_us);
	if (station->live)
		station->buttons = buttons_open(&station->board, station->live, station->opened_us);
	if (station->live) {
		live_text(station->live, text);
		station_say(text);
	}
	if (station->buttons) {
		buttons_text(station->buttons, text);
		station_say(text);
	}
	if (!resident_lock(station->fault))
		station_say(station->fault);
	return true;
}

/* ---- one frame ---- */

static unsigned collect(struct station *station)
{
	unsigned unplugged = 0;
	station->reports->count = 0;
	station->plugged = 0;
	if (station->live) {
		struct live_changes changes = live_collect(station->live, station->reports);
		for (int device = 0; device < LIVE_TABLETS_MAX; device++)
			if (changes.plugged >> device & 1)
				learn(station, device);
		unplugged = changes.unplugged;
		station->plugged = changes.plugged;
	}
	int64_t now_us = live_clock_us() - station->opened_us;
	if (station->kind == DISPLAY_WINDOW && station->display &&
	    !display_input(station->display, LIVE_MOUSE, now_us, station->reports))
		stopped = 1;
	live_stamp(station->reports, station_frame(station), station->collected_us, now_us);
	station->collected_us = now_us;
	if (!station->desk->open)
		station_record_frame(station, unplugged);
	return unplugged;
}

/* Sleeps until the frame's end by the wall's clock, or lets a late frame slow the program down. */
static void pace(struct station *station)
{
	int64_t due_us = station->start_us +
			 (int64_t)station_frame(station) * 1000000 / FRAME_RATE_HZ;
	int64_t early_us = due_us - live_clock_us();
	if (early_us < -LATE_US)
		station->start_us -= early_us + LATE_US;
	/* a display of 60 Hz paces us by itself: leave it its own jitter */
	if (early_us > 2000) {
		struct timespec rest = {0, (long)(early_us - 1000) * 1000};
		nanosleep(&rest, NULL);
	}
}

/* Has the visitor gone, and left something behind? */
static bool visitor_gone(struct station *station)
{
	const struct kiosk *kiosk = station->kiosk;
	return cycle_frame(&station->cycle, &kiosk->input, station->board.idle_s,
			   kiosk->session.undo_count > 0, (float)station->height / 1080.0f);
}

static void end_visit(struct station *station)
{
	kiosk_finish(station->kiosk);
	write_journal(station, station->kiosk->journal, station->kiosk->journal_size);
	station_record_end(station);
	if (station->journal >= 0)
		close(station->journal);
	station->journal = -1;
}

/* Before the operator's page opens, every stroke and every held button ends. */
static void run_visit(struct station *station, unsigned unplugged)
{
	bool opens = station->desk->wanted;
	if (opens) {
		station->reports->count = 0;
		unplugged = (1u << PEN_DEVICES_MAX) - 1;
	}
	kiosk_frame(station->kiosk, station->reports, unplugged);
	write_journal(station, station->kiosk->journal, station->kiosk->journal_size);
	if (opens)
		station_open_desk(station);
}

/* The visitor said so: the station waits for the next one. */
static bool done_with_card(struct station *station)
{
	bool done = station_run_card(station);
	if (done)
		station->cycle = (struct cycle){.state = CYCLE_ATTRACT};
	return done;
}

static bool run(struct station *station)
{
	while (!stopped) {
		bool anew = false;
		int64_t began_us = live_clock_us();
		if (station->desk->wanted)
			station_record_end(station); /* a tape can't say what comes now */
		unsigned unplugged = collect(station);
		if (station->desk->open)
			anew = station_run_desk(station, unplugged);
		else
			run_visit(station, unplugged);
		anew |= done_with_card(station);
		desk_time(station->desk, live_clock_us() - began_us);
		if (!station_show(station))
			return false;
		service_frame(&station->service, live_clock_us());
		pace(station);
		if (station_wants_desk(station))
			station_tell_service(station);
		if (anew || (!station->desk->open && visitor_gone(station))) {
			end_visit(station);
			if (!begin_visit(station))
				return false;
		}
	}
	return true;
}

static void close_station(struct station *station)
{
	service_close(&station->service);
	threads_stop(&station->threads);
	if (station->kiosk)
		end_visit(station);
	station_close_card(station);
	if (station->buttons)
		buttons_close(station->buttons);
	if (station->live)
		live_close(station->live);
	station_close_display(station);
	free(station->desk);
	free(station->reports);
	free(station->kiosk);
	free(station->memory);
}

/* ---- the command ---- */

static bool read_options(struct station *station, int argc, char **argv)
{
	for (int i = 1; i < argc; i++) {
		const struct {
			const char *word;
			const char **value;
		} options[] = {{"--board", &station->board_path},
			       {"--body", &station->body},
			       {"--journals", &station->journals},
			       {"--else-replay", &station->tape},
			       {"--out", &station->out}};
		bool bones = strcmp(argv[i], "--bones") == 0;
		bool visits = strcmp(argv[i], "--visits") == 0, known = bones || visits;
		station->bones |= bones;
		station->record |= visits;
		for (int k = 0; k < COUNT_OF(options) && !known; k++)
			if (strcmp(argv[i], options[k].word) == 0 && i + 1 < argc) {
				*options[k].value = argv[++i];
				known = true;
			}
		if (!known)
			return false;
	}
	return !station->tape == !station->out;
}

static int replay_instead(struct station *station)
{
	char *argv[] = {"replay", (char *)(uintptr_t)station->tape, "--out",
			(char *)(uintptr_t)station->out};
	fprintf(stderr,
		"kitsuke: %s\nkitsuke: so the bundled visit is played without a display; "
		"its pictures go to %s\n",
		station->fault, station->out);
	return command_replay(COUNT_OF(argv), argv);
}

int command_station(int argc, char **argv)
{
	struct station station = {.journal = -1};
	if (!read_options(&station, argc, argv)) {
		fputs(usage, stderr);
		return STATUS_USAGE;
	}
	if (!read_board(&station)) {
		station_say(station.fault);
		return STATUS_INPUT;
	}
	find_folder(&station);
	station_read_settings(&station);
	if (!station_choose_display(&station)) {
		if (station.tape)
			return replay_instead(&station);
		station_say(station.fault);
		return STATUS_MACHINE;
	}
	struct sigaction action = {.sa_handler = stop};
	sigaction(SIGINT, &action, NULL);
	sigaction(SIGTERM, &action, NULL);
	service_open(&station.service);
	bool fine = open_station(&station) && run(&station);
	if (!fine)
		station_say(station.fault);
	close_station(&station);
	return fine ? STATUS_DONE : STATUS_MACHINE;
}
