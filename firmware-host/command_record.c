/* kitsuke record --out TAPE: what attached tablets and buttons send, as a tape, until Ctrl-C or for
 * --seconds. Only pens and our buttons are recorded, never keys.
 *
 * kitsuke record --visits: the station itself, which writes beside the journal of each visit the
 * tape that replays to it (station_record.c). */
#include "commands.h"

#include "board_file.h"
#include "buttons.h"
#include "live.h"
#include "options.h"
#include "tape_recorder.h"

#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

static const char usage[] = "usage: kitsuke record --out TAPE [--seconds N] [--board FILE]\n"
			    "       kitsuke record --visits [--board FILE] [--body FILE|mannequin] "
			    "[--journals FOLDER]\n";

struct recorder {
	struct tape_recorder tape;
	struct live *live;
	struct frame_reports reports;
};

static volatile sig_atomic_t stopped;

static void stop(int number)
{
	(void)number;
	stopped = 1;
}

static void device_declare(struct recorder *r, int device)
{
	struct tape_device told;
	live_device(r->live, device, &told);
	if (recorder_device(&r->tape, device, &told))
		fprintf(stderr, "kitsuke record: device %d is %s\n", device, told.name);
	else
		fprintf(stderr,
			"kitsuke record: %s came where another device was; it is left out, record "
			"it on a tape of its own\n",
			told.name);
}

static void collect(struct recorder *r)
{
	r->reports.count = 0;
	struct live_changes changes = live_collect(r->live, &r->reports);
	for (int i = 0; i < PEN_DEVICES_MAX; i++)
		if (changes.plugged >> i & 1)
			device_declare(r, i);
	for (int i = 0; i < r->reports.count; i++)
		recorder_report(&r->tape, &r->reports.report[i]);
	for (int i = 0; i < PEN_DEVICES_MAX; i++)
		if (changes.unplugged >> i & 1 && r->tape.declared[i].used) {
			fprintf(stderr, "kitsuke record: device %d was unplugged\n", i);
			recorder_unplug(&r->tape, i, r->tape.last_us);
		}
}

static void record(struct recorder *r, long seconds, int64_t start_us)
{
	bool terminal = isatty(STDERR_FILENO);
	int64_t shown_us = start_us;
	while (!stopped) {
		int64_t now_us = live_clock_us();
		if (seconds && now_us - start_us >= seconds * INT64_C(1000000))
			break;
		collect(r);
		if (now_us - shown_us >= 1000000) {
			shown_us = now_us;
			fflush(r->tape.out);
			if (terminal)
				fprintf(stderr, "\r%lld s, %ld reports; Ctrl-C ends ",
					(long long)((now_us - start_us) / 1000000), r->tape.events);
		}
		nanosleep(&(struct timespec){0, 4000000}, NULL);
	}
	collect(r);
	if (terminal)
		fputc('\n', stderr);
}

static int finish(struct recorder *r, const char *path, const char *missing)
{
	long lost = live_lost(r->live);
	bool failed = ferror(r->tape.out) != 0;
	failed |= fclose(r->tape.out) != 0;
	if (failed) {
		fprintf(stderr, "kitsuke record: %s: %s; free some space\n", path, strerror(errno));
		return STATUS_MACHINE;
	}
	if (lost)
		fprintf(stderr,
			"kitsuke record: %ld reports came too fast and are not on the tape\n",
			lost);
	if (!r->tape.events) {
		fprintf(stderr, "kitsuke record: nothing came: %s\n", missing);
		return STATUS_MACHINE;
	}
	fprintf(stderr, "kitsuke record: %s: %ld reports\n", path, r->tape.events);
	return STATUS_DONE;
}

/* Tablets, and the buttons where there are any; what is missing is told, and may still come. */
static int record_live(struct recorder *r, const struct board *board, const char *path,
		       long seconds)
{
	char tablets[LIVE_TEXT_MAX], lines[LIVE_TEXT_MAX];
	int64_t start_us = live_clock_us();
	r->live = live_open(board, start_us);
	if (!r->live) {
		fprintf(stderr, "kitsuke record: no thread to read with: %s\n", strerror(errno));
		fclose(r->tape.out);
		return STATUS_MACHINE;
	}
	struct buttons *buttons = buttons_open(board, r->live, start_us);
	nanosleep(&(struct timespec){0, 200000000}, NULL);
	live_text(r->live, tablets);
	fprintf(stderr, "kitsuke record: %s\n", tablets);
	if (buttons) {
		buttons_text(buttons, lines);
		fprintf(stderr, "kitsuke record: %s\n", lines);
	}
	record(r, seconds, start_us);
	live_text(r->live, tablets);
	int status = finish(r, path, tablets);
	buttons_close(buttons);
	live_close(r->live);
	return status;
}

int command_record(int argc, char **argv)
{
	static const struct tape head;
	static struct recorder recorder;
	const char *files[OPTION_FILES_MAX], *out = NULL, *board_path = NULL;
	long seconds = 0;
	const struct option_value known[] = {
		{.name = "--out", .text = &out},
		{.name = "--seconds", .number = &seconds},
		{.name = "--board", .text = &board_path},
		{0},
	};
	struct board board = board_default;
	char fault[FAULT_BYTES];
	int file_count;
	if (argc > 1 && !strcmp(argv[1], "--visits"))
		return command_station(argc, argv);
	if (!options_read(argc, argv, known, files, &file_count) || file_count || !out) {
		fputs(usage, stderr);
		return STATUS_USAGE;
	}
	if (board_path && !board_load(&board, board_path, fault)) {
		fprintf(stderr, "kitsuke record: %s\n", fault);
		return STATUS_INPUT;
	}
	FILE *tape = fopen(out, "w");
	if (!tape) {
		fprintf(stderr, "kitsuke record: %s: %s; name a file that can be written\n", out,
			strerror(errno));
		return STATUS_MACHINE;
	}
	recorder_begin(&recorder.tape, tape, &head);
	struct sigaction action = {.sa_handler = stop};
	sigaction(SIGINT, &action, NULL);
	sigaction(SIGTERM, &action, NULL);
	return record_live(&recorder, &board, out, seconds);
}
