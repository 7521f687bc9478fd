/* kitsuke dress JOURNAL: a document is run without input devices. */
#include "commands.h"

#include "card_file.h"
#include "character.h"
#include "drape_file.h"
#include "garment_file.h"
#include "journal_file.h"
#include "options.h"
#include "picture.h"
#include "report.h"
#include "snapshot.h"
#include "processor.h"
#include "threads.h"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

enum { PICTURE_WIDTH = 1280, PICTURE_HEIGHT = 720, PROGRESS_FRAMES = 30 };

static const char usage[] =
	"usage: kitsuke dress JOURNAL [--obj FILE] [--glb FILE] [--picture FILE] [--report FILE]\n"
	"                     [--body FILE|mannequin] [--body-obj FILE] [--bones FILE]\n"
	"                     [--bones-out FILE] [--start OBJ] [--card FILE] [--threads N] "
	"[--progress]\n";

struct dresser {
	const char *start; /* a drape that stands for the first wrap */
	const char *card;  /* the picture that visitors take home */
	const char *journal, *obj, *glb, *picture, *report, *body, *body_obj, *bones, *bones_out;
	bool progress;
	long thread_count;
	struct threads threads;
	void *memory;
	struct session *session;
	struct edit *edit;
	struct frame_clock clock;
	char body_name[NAME_BYTES_MAX]; /* empty: no body yet */
	int refused;                    /* edits that a person wrote and the session refused */
	char fault[FAULT_BYTES];
};

static int complain(const struct dresser *dresser, int status)
{
	fprintf(stderr, "kitsuke dress: %s\n", dresser->fault);
	return status;
}

/* ---- start ---- */

static bool dresser_open(struct dresser *dresser)
{
	struct arena arena;
	dresser->memory = malloc(KIOSK_MEMORY_BYTES);
	dresser->session = calloc(1, sizeof *dresser->session);
	dresser->edit = calloc(1, sizeof *dresser->edit);
	if (!dresser->memory || !dresser->session || !dresser->edit ||
	    !frame_clock_open(&dresser->clock)) {
		snprintf(dresser->fault, FAULT_BYTES, "not enough memory to start");
		return false;
	}
	arena_init(&arena, dresser->memory, KIOSK_MEMORY_BYTES);
	session_init(dresser->session, &arena);
	dresser->session->cloth.lanes = processor_lanes();
	dresser->session->cloth.crew = threads_crew(&dresser->threads);
	return true;
}

static void dresser_close(struct dresser *dresser)
{
	frame_clock_close(&dresser->clock);
	free(dresser->edit);
	free(dresser->session);
	free(dresser->memory);
}

/* --body wins over what the journal names; a body that the journal names lies beside it. */
static bool put_body(struct dresser *dresser, const char *name)
{
	char folder[PATH_BYTES_MAX], note[FAULT_BYTES];
	int length = (int)(store_name(dresser->journal) - dresser->journal);
	snprintf(folder, sizeof folder, "%.*s", length ? length : 1,
		 length ? dresser->journal : ".");
	if (!character_load(&dresser->session->body, dresser->body ? dresser->body : name,
			    dresser->body ? NULL : folder, note, dresser->fault))
		return false;
	if (dresser->bones &&
	    !character_read_bones(&dresser->session->body, dresser->bones, dresser->fault))
		return false;
	if (note[0])
		fprintf(stderr, "kitsuke dress: note: %s\n", note);
	snprintf(dresser->body_name, sizeof dresser->body_name, "%s", name);
	return true;
}

/* ---- the run ---- */

static void show_progress(const struct dresser *dresser, bool last)
{
	static const char *const job_name[] = {"moving", "cutting", "wrapping"};
	const struct session *session = dresser->session;
	if (!dresser->progress || (!last && session->frame % PROGRESS_FRAMES != 0))
		return;
	fprintf(stderr, "\r%s: frame %d, %s%s", store_name(dresser->journal), session->frame,
		last ? "done" : job_name[session->job], last ? "        \n" : "    ");
}

static void run_frame(struct dresser *dresser)
{
	frame_clock_begin(&dresser->clock, dresser->session);
	session_advance(dresser->session);
	frame_clock_end(&dresser->clock, dresser->session);
	show_progress(dresser, false);
}

/* The first wrap takes the drape of --start instead of laying the garment by its marks. */
static bool start_drape(struct dresser *dresser)
{
	struct session *session = dresser->session;
	const char *wrong = session_mesh(session);
	if (wrong) {
		snprintf(dresser->fault, FAULT_BYTES, "%.250s: %s", dresser->journal, wrong);
		return false;
	}
	while (session->job != JOB_NONE)
		run_frame(dresser);
	struct v3 *position_m = calloc(GARMENT_VERTICES_MAX, sizeof *position_m);
	bool read = position_m && drape_read(session, dresser->start, position_m, dresser->fault);
	if (read)
		session_drape(session, position_m);
	free(position_m);
	dresser->start = NULL;
	return read;
}

/* STEP, WORN and SETTLE are taken apart into frames, so that each can be timed and shown. */
static bool apply(struct dresser *dresser, const struct edit *edit)
{
	struct session *session = dresser->session;
	if (edit->kind == EDIT_STEP && edit->i[0] >= 1 && edit->i[0] <= STEP_FRAMES_MAX) {
		for (int i = 0; i < edit->i[0]; i++)
			run_frame(dresser);
		return true;
	}
	if (edit->kind == EDIT_WORN || edit->kind == EDIT_SETTLE) {
		bool rests = edit->kind == EDIT_SETTLE;
		for (int i = 0; i < SETTLE_FRAMES_MAX &&
				(rests ? session_busy(session) : session->job != JOB_NONE);
		     i++)
			run_frame(dresser);
		return true;
	}
	return session_apply(session, edit);
}

/* A station's journal holds what was refused too; in one written by hand that is a mistake. */
static void note_refusal(struct dresser *dresser, const struct journal_file *file)
{
	if (!file->by_hand)
		return;
	dresser->refused++;
	fprintf(stderr, "%s%s: line %d: refused: %s\n", dresser->progress ? "\n" : "", file->path,
		file->line, dresser->session->notice);
}

static bool take_edit(struct dresser *dresser, const struct journal_file *file)
{
	const struct edit *edit = dresser->edit;
	if (edit->kind == EDIT_BODY) {
		if (!dresser->body_name[0])
			return put_body(dresser, edit->name);
		if (strcmp(dresser->body_name, edit->name) == 0)
			return true;
		snprintf(dresser->fault, FAULT_BYTES, "%.250s: line %d: the body must be named %s",
			 file->path, file->line, "before the first edit that needs one");
		return false;
	}
	if (!dresser->body_name[0] && edit->kind != EDIT_BUDGET &&
	    !put_body(dresser, CHARACTER_MANNEQUIN))
		return false;
	if (edit->kind == EDIT_WRAP && dresser->start)
		return start_drape(dresser);
	if (!apply(dresser, edit))
		note_refusal(dresser, file);
	return true;
}

static bool run_journal(struct dresser *dresser)
{
	struct journal_file file;
	enum journal_result result = JOURNAL_NOTHING;
	if (!journal_file_open(&file, dresser->journal, dresser->fault))
		return false;
	bool taken = true;
	while (taken &&
	       (result = journal_file_next(&file, dresser->edit, dresser->fault)) == JOURNAL_EDIT)
		taken = take_edit(dresser, &file);
	if (file.torn)
		fprintf(stderr, "%s: line %d: note: cut off in the middle; all before it is kept\n",
			file.path, file.line);
	journal_file_close(&file);
	if (taken && result != JOURNAL_FAULT && !dresser->body_name[0])
		taken = put_body(dresser, CHARACTER_MANNEQUIN);
	show_progress(dresser, true);
	return taken && result != JOURNAL_FAULT;
}

/* ---- what comes out ---- */

static bool write_picture(struct dresser *dresser)
{
	struct snapshot snapshot;
	const struct frame_input nobody = {0};
	struct ui *ui = calloc(1, sizeof *ui);
	struct edit_list *edits = calloc(1, sizeof *edits);
	bool open = ui && edits &&
		    snapshot_open(&snapshot, PICTURE_WIDTH, PICTURE_HEIGHT, dresser->fault);
	bool written = false;
	if (open) {
		ui_init(ui, snapshot.width, snapshot.height);
		ui_step(ui, dresser->session->cloth.worn ? STEP_ADJUST : STEP_MARK);
		/* a frame without a visitor, in which the sheet grows to hold the pattern */
		ui_update(ui, &nobody, dresser->session, edits);
		snapshot_take(&snapshot, ui, dresser->session);
		written = picture_write_png(dresser->picture, snapshot.width, snapshot.height,
					    snapshot.rgba, dresser->fault);
		snapshot_close(&snapshot);
	}
	free(edits);
	free(ui);
	return written;
}

static int write_results(struct dresser *dresser)
{
	struct session *session = dresser->session;
	struct measure measure;
	if ((dresser->obj || dresser->glb) && !session->cloth.worn) {
		snprintf(dresser->fault, FAULT_BYTES, "%.250s: leaves no garment on the body: %s",
			 dresser->journal,
			 session->notice[0] ? session->notice : "it never finishes a wrap");
		return complain(dresser, STATUS_INPUT);
	}
	if ((dresser->obj || dresser->glb) &&
	    !garment_write(session, dresser->obj, dresser->glb, dresser->fault))
		return complain(dresser, STATUS_MACHINE);
	if (dresser->body_obj &&
	    !character_write_obj(&session->body, dresser->body_obj, dresser->fault))
		return complain(dresser, STATUS_MACHINE);
	if (dresser->bones_out &&
	    !character_write_bones(&session->body, dresser->bones_out, dresser->fault))
		return complain(dresser, STATUS_MACHINE);
	if (dresser->report &&
	    !report_write(session, &dresser->clock, &measure, dresser->report, dresser->fault))
		return complain(dresser, STATUS_MACHINE);
	if (dresser->picture && !write_picture(dresser))
		return complain(dresser, STATUS_MACHINE);
	if (dresser->card && !card_file_write(session, dresser->body_name, dresser->journal,
					      dresser->card, dresser->fault))
		return complain(dresser, STATUS_MACHINE);
	return STATUS_DONE;
}

static int dress(struct dresser *dresser)
{
	if (!dresser_open(dresser))
		return complain(dresser, STATUS_MACHINE);
	if (!run_journal(dresser))
		return complain(dresser, STATUS_INPUT);
	int status = write_results(dresser);
	if (status == STATUS_DONE) {
		printf("hash %016llx\n", (unsigned long long)session_hash(dresser->session));
		status = dresser->refused ? STATUS_INPUT : STATUS_DONE;
	}
	return status;
}

int command_dress(int argc, char **argv)
{
	/* one thread: several side by side use the processors better */
	static struct dresser dresser = {.thread_count = 1};
	const char *files[OPTION_FILES_MAX];
	int count;
	const struct option_value known[] = {
		{"--obj", NULL, &dresser.obj, NULL},
		{"--glb", NULL, &dresser.glb, NULL},
		{"--start", NULL, &dresser.start, NULL},
		{"--picture", NULL, &dresser.picture, NULL},
		{"--report", NULL, &dresser.report, NULL},
		{"--card", NULL, &dresser.card, NULL},
		{"--body", NULL, &dresser.body, NULL},
		{"--body-obj", NULL, &dresser.body_obj, NULL},
		{"--bones", NULL, &dresser.bones, NULL},
		{"--bones-out", NULL, &dresser.bones_out, NULL},
		{"--threads", NULL, NULL, &dresser.thread_count},
		{"--progress", &dresser.progress, NULL, NULL},
		{NULL, NULL, NULL, NULL},
	};
	if (!options_read(argc, argv, known, files, &count) || count != 1) {
		fputs(usage, stderr);
		return STATUS_USAGE;
	}
	dresser.journal = files[0];
	dresser.progress = dresser.progress || isatty(STDERR_FILENO);
	if (!threads_start(&dresser.threads, dresser.thread_count, NULL, dresser.fault))
		return complain(&dresser, STATUS_USAGE);
	int status = dress(&dresser);
	threads_stop(&dresser.threads);
	dresser_close(&dresser);
	return status;
}
