/* kitsuke record --out TAPE: what attached tablets and buttons send, as a tape, until Ctrl-C or for
 * --seconds. Only pens and our buttons are recorded, never keys. */
#include "commands.h"

#include "board_file.h"
#include "buttons.h"
#include "live.h"
#include "options.h"
#include "tape.h"

#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

static const char usage[] = "usage: kitsuke record --out TAPE [--seconds N] [--board FILE]\n";

struct recorder {
	FILE *out;
	struct live *live;
	struct frame_reports reports;
	char line[TAPE_LINE_MAX];
	struct tape_device declared[PEN_DEVICES_MAX]; /* as they stand on the tape */
	bool left_out[PEN_DEVICES_MAX];
	int device; /* selected on the tape; -1: none */
	long events;
	int64_t last_us;
};

static volatile sig_atomic_t stopped;

static void stop(int number)
{
	(void)number;
	stopped = 1;
}

static void line_write(struct recorder *r, int length)
{
	fwrite(r->line, 1, (size_t)length, r->out);
}

static bool same_device(const struct tape_device *a, const struct tape_device *b)
{
	return a->speaks.family == b->speaks.family && a->speaks.x_maximum == b->speaks.x_maximum &&
	       a->speaks.y_maximum == b->speaks.y_maximum &&
	       a->descriptor_size == b->descriptor_size &&
	       !memcmp(a->descriptor, b->descriptor, (size_t)a->descriptor_size);
}

/* A tape says once what a device is. */
static void device_declare(struct recorder *r, int device)
{
	struct tape_device told;
	live_device(r->live, device, &told);
	struct tape_device *declared = &r->declared[device];
	r->left_out[device] = declared->used && !same_device(declared, &told);
	if (r->left_out[device])
		fprintf(stderr,
			"kitsuke record: %s came where another device was; it is left out, record "
			"it on a tape of its own\n",
			told.name);
	else
		fprintf(stderr, "kitsuke record: device %d is %s\n", device, told.name);
	if (declared->used || r->left_out[device])
		return;
	*declared = told;
	for (int part = 0, length; (length = tape_write_device(r->line, device, &told, part)) > 0;
	     part++)
		line_write(r, length);
	r->device = device;
}

static void report_write(struct recorder *r, const struct raw_report *report)
{
	if (r->left_out[report->device] || !r->declared[report->device].used)
		return;
	if (r->device != report->device)
		line_write(r, tape_write_select(r->line, report->device));
	r->device = report->device;
	r->last_us = report->time_us > r->last_us ? report->time_us : r->last_us;
	line_write(r, tape_write_event(r->line, r->last_us, report->size, report->bytes));
	r->events++;
}

static void collect(struct recorder *r)
{
	r->reports.count = 0;
	struct live_changes changes = live_collect(r->live, &r->reports);
	for (int i = 0; i < PEN_DEVICES_MAX; i++)
		if (changes.plugged >> i & 1)
			device_declare(r, i);
	for (int i = 0; i < r->reports.count; i++)
		report_write(r, &r->reports.report[i]);
	for (int i = 0; i < PEN_DEVICES_MAX; i++)
		if (changes.unplugged >> i & 1 && r->declared[i].used) {
			fprintf(stderr, "kitsuke record: device %d was unplugged\n", i);
			line_write(r, tape_write_unplug(r->line, r->last_us, i));
		}
}

static void record(struct recorder *r, long seconds, int64_t start_us)
{
	static const struct tape head;
	line_write(r, tape_write_head(r->line, &head, 0));
	bool terminal = isatty(STDERR_FILENO);
	int64_t shown_us = start_us;
	while (!stopped) {
		int64_t now_us = live_clock_us();
		if (seconds && now_us - start_us >= seconds * INT64_C(1000000))
			break;
		collect(r);
		if (now_us - shown_us >= 1000000) {
			shown_us = now_us;
			fflush(r->out);
			if (terminal)
				fprintf(stderr, "\r%lld s, %ld reports; Ctrl-C ends ",
					(long long)((now_us - start_us) / 1000000), r->events);
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
	bool failed = ferror(r->out) != 0;
	failed |= fclose(r->out) != 0;
	if (failed) {
		fprintf(stderr, "kitsuke record: %s: %s; free some space\n", path, strerror(errno));
		return STATUS_MACHINE;
	}
	if (lost)
		fprintf(stderr,
			"kitsuke record: %ld reports came too fast and are not on the tape\n",
			lost);
	if (!r->events) {
		fprintf(stderr, "kitsuke record: nothing came: %s\n", missing);
		return STATUS_MACHINE;
	}
	fprintf(stderr, "kitsuke record: %s: %ld reports\n", path, r->events);
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
		fclose(r->out);
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
	if (!options_read(argc, argv, known, files, &file_count) || file_count || !out) {
		fputs(usage, stderr);
		return STATUS_USAGE;
	}
	if (board_path && !board_load(&board, board_path, fault)) {
		fprintf(stderr, "kitsuke record: %s\n", fault);
		return STATUS_INPUT;
	}
	recorder = (struct recorder){.out = fopen(out, "w"), .device = -1};
	if (!recorder.out) {
		fprintf(stderr, "kitsuke record: %s: %s; name a file that can be written\n", out,
			strerror(errno));
		return STATUS_MACHINE;
	}
	struct sigaction action = {.sa_handler = stop};
	sigaction(SIGINT, &action, NULL);
	sigaction(SIGTERM, &action, NULL);
	return record_live(&recorder, &board, out, seconds);
}
