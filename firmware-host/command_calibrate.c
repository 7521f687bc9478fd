/* kitsuke calibrate: how much of the solver's work this machine does in a millisecond.
 *
 * Work is counted in units, so that a visit is the same on every machine; how many of them fit a
 * frame is the machine's affair and stands in its board file. */
#include "commands.h"

#include "board.h"
#include "character.h"
#include "journal.h"
#include "options.h"
#include "processor.h"
#include "session.h"
#include "store.h"
#include "threads_board.h"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum {
	ROUNDS = 3, /* the quickest counts: what else the machine does only makes it slower */
	HOLD_FRAMES = 60,
	WRAP_FRAMES_MAX = 3600,
	BUDGET_STEP = 1000,
	LINE_BYTES = 40,
};

/* Of a frame; the picture, the face and the system have the rest. */
static const double solver_share = 0.5;

static const char usage[] = "usage: kitsuke calibrate [BOARD]\n";

/* A T-shirt cut in one with its sleeves, and a line down each side. */
static const char *const shirt[] = {
	"piece front 0 0 -470 330 0  -372 -151 1  -296 -293 1  -240 -258 1  -248 -670 1  "
	"248 -670 1  240 -258 1  296 -293 1  372 -151 1  78 0 1  39 -80 0  -39 -80 0  -78 0 1",
	"piece back 0 1 300 330 0  -372 -151 1  -296 -293 1  -240 -258 1  -248 -670 1  "
	"248 -670 1  240 -258 1  296 -293 1  372 -151 1  78 0 1  39 -26 0  -39 -26 0  -78 0 1",
	"sew 0 7 1 9 0",
	"sew 0 9 1 7 0",
	"sew 0 5 1 1 0",
	"sew 0 1 1 5 0",
	"sew 0 4 1 2 0",
	"sew 0 2 1 4 0",
	"mark-cloth 1 0  0 -130  0 -530",
	"mark-body 1  0 1.33 0.2  0 1.23 0.2  0 1.13 0.2  0 1.03 0.2  0 0.93 0.2",
	"mark-cloth 2 1  0 -130  0 -530",
	"mark-body 2  0 1.33 -0.2  0 1.23 -0.2  0 1.13 -0.2  0 1.03 -0.2  0 0.93 -0.2",
	"wrap",
};

enum kind { CUTTING, WRAPPING, MOVING, DRAGGING, RELAXING, CLEANING, KIND_COUNT };

static const char *const kind_name[KIND_COUNT] = {"cutting",  "wrapping", "moving",
						  "dragging", "relaxing", "cleaning"};

struct work {
	int frames;
	long units;
	double ns, worst_ns;
};

struct calibration {
	struct board board;
	struct threads threads;
	void *memory;
	struct session *session;
	struct edit *edit;
	struct work work[KIND_COUNT]; /* of this round */
	struct work best[KIND_COUNT];
	char fault[FAULT_BYTES];
};

/* What this thread takes, so that what else the machine does is not counted; where others help it,
 * the time that passes is all that can be measured. */
static double now_ns(const struct calibration *calibration)
{
	struct timespec now;
	clock_gettime(calibration->threads.count > 1 ? CLOCK_MONOTONIC : CLOCK_THREAD_CPUTIME_ID,
		      &now);
	return (double)now.tv_sec * 1e9 + (double)now.tv_nsec;
}

static enum kind kind_now(const struct session *session)
{
	if (session->job != JOB_NONE)
		return session->job == JOB_MESH ? CUTTING : WRAPPING;
	if (session->drag.active)
		return DRAGGING;
	if (session->relaxing)
		return RELAXING;
	return session->still_frames > 0 ? CLEANING : MOVING;
}

static void advance(struct calibration *calibration)
{
	struct work *work = &calibration->work[kind_now(calibration->session)];
	double start = now_ns(calibration);
	session_advance(calibration->session);
	double ns = now_ns(calibration) - start;
	work->frames++;
	work->units += calibration->session->frame_units;
	work->ns += ns;
	work->worst_ns = ns > work->worst_ns ? ns : work->worst_ns;
}

static bool take(struct calibration *calibration, const char *line)
{
	return journal_read(line, (int)strlen(line), calibration->edit, calibration->fault) ==
		       JOURNAL_EDIT &&
	       session_apply(calibration->session, calibration->edit);
}

/* One visit: cut, wrapped, at rest; dragged at the hem, relaxed. */
static void visit(struct calibration *calibration)
{
	struct session *session = calibration->session;
	char line[80];
	memset(calibration->work, 0, sizeof calibration->work);
	MUST(take(calibration, "clear"));
	for (int i = 0; i < COUNT_OF(shirt); i++)
		MUST(take(calibration, shirt[i]));
	for (int i = 0; i < WRAP_FRAMES_MAX && session_busy(session); i++)
		advance(calibration);
	MUST(take(calibration, "grab 0 0 -600"));
	struct v3 hand = drag_point(&session->drag);
	for (int i = 1; i <= HOLD_FRAMES; i++) {
		snprintf(line, sizeof line, "drag %.4f %.4f %.4f",
			 (double)hand.x + 0.001 * (double)i, (double)hand.y, (double)hand.z);
		MUST(take(calibration, line));
		advance(calibration);
	}
	MUST(take(calibration, "release") && take(calibration, "relax 1"));
	for (int i = 0; i < HOLD_FRAMES; i++)
		advance(calibration);
	MUST(take(calibration, "relax 0"));
}

static double ns_a_unit(const struct work *work)
{
	return work->ns / (double)(work->units > 0 ? work->units : 1);
}

static void keep_best(struct calibration *calibration, bool first)
{
	for (int k = 0; k < KIND_COUNT; k++)
		if (first || ns_a_unit(&calibration->work[k]) < ns_a_unit(&calibration->best[k]))
			calibration->best[k] = calibration->work[k];
}

static void print_table(const struct calibration *calibration)
{
	fprintf(stderr, "threads: %d\n", calibration->threads.count);
	fprintf(stderr, "%-10s %7s %14s %13s %13s %9s\n", "", "frames", "units a frame",
		"ms a frame", "worst frame", "ns a unit");
	for (int k = 0; k < KIND_COUNT; k++) {
		const struct work *work = &calibration->best[k];
		int frames = int_max(work->frames, 1);
		fprintf(stderr, "%-10s %7d %14.0f %13.2f %13.2f %9.1f\n", kind_name[k],
			work->frames, (double)work->units / frames, 1e-6 * work->ns / frames,
			1e-6 * work->worst_ns, ns_a_unit(work));
	}
}

/* What the dearest kind of work allows. */
static long budget_units(const struct calibration *calibration)
{
	double dearest = 1.0;
	for (int k = 0; k < KIND_COUNT; k++)
		dearest = ns_a_unit(&calibration->best[k]) > dearest
				  ? ns_a_unit(&calibration->best[k])
				  : dearest;
	long units = (long)(solver_share * 1e9 / FRAME_RATE_HZ / dearest);
	return units / BUDGET_STEP * BUDGET_STEP;
}

/* ---- the board file ---- */

/* The line of a board file that says `budget`, or its end. */
static const char *budget_line(const char *text)
{
	for (const char *line = text; *line;) {
		const char *word = line + strspn(line, " \t");
		size_t length = strcspn(word, " \t=\n");
		if (length == strlen("budget") && strncmp(word, "budget", length) == 0)
			return line;
		line += strcspn(line, "\n");
		line += *line == '\n';
	}
	return text + strlen(text);
}

/* A sound board file's text, to be freed; NULL with a fault. */
static char *read_board(struct board *board, const char *path, size_t *size,
			char fault[FAULT_BYTES])
{
	char wrong[200];
	char *text = store_read(path, size, fault);
	if (!text || board_read(board, text, *size, wrong))
		return text;
	snprintf(fault, FAULT_BYTES, "%.250s: %s", path, wrong);
	free(text);
	return NULL;
}

/* The file as it was, but for this one line. */
static bool write_board(const char *path, const char *text, size_t size, const char *line,
			char fault[FAULT_BYTES])
{
	const char *at = budget_line(text), *after = at + strcspn(at, "\n");
	bool joined = at == text || at[-1] == '\n';
	char *whole = malloc(size + LINE_BYTES);
	MUST(whole);
	int length = snprintf(whole, size + LINE_BYTES, "%.*s%s%s%s", (int)(at - text), text,
			      joined ? "" : "\n", line, *after ? after : "\n");
	bool written = store_write(path, whole, (size_t)length, fault);
	free(whole);
	return written;
}

/* ---- the command ---- */

static bool open_calibration(struct calibration *calibration)
{
	struct arena arena;
	char note[FAULT_BYTES];
	calibration->memory = malloc(KIOSK_MEMORY_BYTES);
	calibration->session = calloc(1, sizeof *calibration->session);
	calibration->edit = calloc(1, sizeof *calibration->edit);
	if (!calibration->memory || !calibration->session || !calibration->edit) {
		snprintf(calibration->fault, FAULT_BYTES, "not enough memory to start");
		return false;
	}
	arena_init(&arena, calibration->memory, KIOSK_MEMORY_BYTES);
	session_init(calibration->session, &arena);
	calibration->session->cloth.lanes = processor_lanes();
	if (!threads_start_board(&calibration->threads, &calibration->board, calibration->fault))
		return false;
	calibration->session->cloth.crew = threads_crew(&calibration->threads);
	return character_load(&calibration->session->body, CHARACTER_MANNEQUIN, NULL, note,
			      calibration->fault);
}

static void measure(struct calibration *calibration)
{
	for (int round = 0; round < ROUNDS; round++) {
		visit(calibration);
		keep_best(calibration, round == 0);
	}
	print_table(calibration);
}

static int complain(const struct calibration *calibration, int status)
{
	fprintf(stderr, "kitsuke calibrate: %s\n", calibration->fault);
	return status;
}

static int calibrate(struct calibration *calibration, const char *board)
{
	char line[LINE_BYTES];
	size_t size = 0;
	char *text = board ? read_board(&calibration->board, board, &size, calibration->fault)
			   : NULL;
	if (board && !text)
		return complain(calibration, STATUS_INPUT);
	if (!open_calibration(calibration)) {
		free(text);
		return complain(calibration, STATUS_MACHINE);
	}
	measure(calibration);
	snprintf(line, sizeof line, "budget = %ld", budget_units(calibration));
	printf("%s\n", line);
	bool written = !text || write_board(board, text, size, line, calibration->fault);
	free(text);
	return written ? STATUS_DONE : complain(calibration, STATUS_MACHINE);
}

int command_calibrate(int argc, char **argv)
{
	static const struct option_value known[] = {{NULL, NULL, NULL, NULL}};
	static struct calibration calibration;
	const char *files[OPTION_FILES_MAX];
	int count;
	if (!options_read(argc, argv, known, files, &count) || count > 1) {
		fputs(usage, stderr);
		return STATUS_USAGE;
	}
	calibration.board = board_default;
	int status = calibrate(&calibration, count ? files[0] : NULL);
	threads_stop(&calibration.threads);
	free(calibration.edit);
	free(calibration.session);
	free(calibration.memory);
	return status;
}
