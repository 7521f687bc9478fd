/* kitsuke check FILE...: are these files sound? A line for each, and one for each fault. */
#include "commands.h"

#include "board.h"
#include "character.h"
#include "format_bones.h"
#include "format_garment.h"
#include "journal_file.h"
#include "options.h"
#include "pen.h"
#include "session.h"
#include "tape_learn.h"

#include <ctype.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <strings.h>

enum { FAULTS_SHOWN_MAX = 20, HEAD_BYTES = 4096 };

static const char usage[] = "usage: kitsuke check FILE...\n";

/* What all checks work with, taken once. */
struct inspector {
	void *memory;
	struct session *session;
	struct edit *edit;
	char fault[FAULT_BYTES];
};

/* File names and what stands in files may hold anything; a terminal gets to see text. */
static void say(const char *text)
{
	for (; *text; text++)
		putchar(iscntrl((unsigned char)*text) ? '?' : *text);
	putchar('\n');
}

/* "PATH: ..." */
__attribute__((format(printf, 2, 3))) static void say_of(const char *path, const char *form, ...)
{
	char line[FAULT_BYTES];
	int size = snprintf(line, sizeof line, "%.250s: ", path);
	va_list values;
	va_start(values, form);
	vsnprintf(line + size, sizeof line - (size_t)size, form, values);
	va_end(values);
	say(line);
}

static bool fail(const struct inspector *inspector)
{
	say(inspector->fault);
	return false;
}

static bool fail_of(const char *path, const char *fault)
{
	say_of(path, "%s", fault);
	return false;
}

static bool fresh_session(struct inspector *inspector)
{
	struct arena arena;
	if (!inspector->memory)
		inspector->memory = malloc(KIOSK_MEMORY_BYTES);
	if (!inspector->memory) {
		snprintf(inspector->fault, FAULT_BYTES, "not enough memory to look inside");
		return false;
	}
	arena_init(&arena, inspector->memory, KIOSK_MEMORY_BYTES);
	session_init(inspector->session, &arena);
	return true;
}

/* ---- one function for each kind of file ---- */

static bool check_body(struct inspector *inspector, const char *path)
{
	char note[FAULT_BYTES];
	struct body *body = &inspector->session->body;
	if (!fresh_session(inspector) || !character_load(body, path, NULL, note, inspector->fault))
		return fail(inspector);
	say_of(path, "a body, sound: %d vertices, %d triangles, %d bones", body->vertex_count,
	       body->triangle_count, body->bone_count);
	if (note[0])
		say(note);
	return true;
}

/* Can the document take this edit? Only what does not need a worn garment is tried; `trying` ends
 * with the first edit that does. */
static bool try_edit(struct inspector *inspector, const struct journal_file *file, bool *trying)
{
	const struct edit *edit = inspector->edit;
	bool on_paper = edit->kind >= EDIT_PIECE && edit->kind <= EDIT_MARK_CLOTH;
	if (edit->kind == EDIT_BODY || edit->kind == EDIT_BUDGET || edit->kind == EDIT_MARK_BODY ||
	    edit->kind == EDIT_MARK_AT)
		return true;
	*trying = *trying && on_paper;
	if (!*trying || session_apply(inspector->session, edit) || !file->by_hand)
		return true;
	snprintf(inspector->fault, FAULT_BYTES, "%.250s: line %d: %s", file->path, file->line,
		 inspector->session->notice);
	return false;
}

static bool check_journal(struct inspector *inspector, const char *path)
{
	struct journal_file file;
	enum journal_result result;
	int edits = 0, faults = 0;
	bool trying = true;
	if (!fresh_session(inspector) || !journal_file_open(&file, path, inspector->fault))
		return fail(inspector);
	while ((result = journal_file_next(&file, inspector->edit, inspector->fault)) !=
	       JOURNAL_NOTHING) {
		bool sound = result == JOURNAL_EDIT && try_edit(inspector, &file, &trying);
		edits++;
		if (!sound && ++faults <= FAULTS_SHOWN_MAX)
			fail(inspector);
	}
	if (faults > FAULTS_SHOWN_MAX)
		printf("... and %d more\n", faults - FAULTS_SHOWN_MAX);
	if (faults == 0)
		say_of(path, "a journal, sound: %d edits%s", edits,
		       file.torn ? "; its last line is cut off and does not count" : "");
	journal_file_close(&file);
	return faults == 0;
}

static bool check_pattern(struct inspector *inspector, const char *path)
{
	static struct pattern pattern;
	size_t size;
	char wrong[200];
	int pieces = 0, seams = 0;
	char *text = store_read(path, &size, inspector->fault);
	if (!text)
		return fail(inspector);
	bool read = format_garment_read(&pattern, text, size, wrong);
	free(text);
	if (!read)
		return fail_of(path, wrong);
	for (int p = 0; p < PIECES_MAX; p++)
		pieces += pattern.piece[p].used;
	for (int s = 0; s < SEAMS_MAX; s++)
		seams += pattern.seam[s].used;
	say_of(path, "a pattern, sound: %d pieces, %d seams", pieces, seams);
	return true;
}

static bool check_bones(struct inspector *inspector, const char *path)
{
	struct bone_list bones;
	size_t size;
	char wrong[200];
	char *text = store_read(path, &size, inspector->fault);
	if (!text)
		return fail(inspector);
	bool read = format_bones_read(&bones, text, size, wrong);
	free(text);
	if (!read)
		return fail_of(path, wrong);
	say_of(path, "bones of a body, sound: %d", bones.count);
	return true;
}

static bool check_board(struct inspector *inspector, const char *path)
{
	struct board board;
	size_t size;
	char wrong[200];
	char *text = store_read(path, &size, inspector->fault);
	if (!text)
		return fail(inspector);
	bool read = board_read(&board, text, size, wrong);
	free(text);
	if (!read)
		return fail_of(path, wrong);
	if (board.mount.cross_count)
		say_of(path,
		       "a board, sound; its calibration leaves %.2f px of %d crosses, %.2f px at "
		       "most",
		       (double)board.calibration_rms_px, board.mount.cross_count,
		       (double)board.calibration_worst_px);
	else
		say_of(path, "a board, sound");
	return true;
}

static void say_device(const char *path, const struct tape *tape, int device, struct pen *pen)
{
	static const char *const kind[] = {"unknown", "a pen", "buttons"};
	const struct tape_device *described = &tape->device[device];
	tape_learn(pen, device, described);
	say_of(path, "device %d, %.60s: %s%s%s", device, described->name,
	       kind[pen->device[device].kind], pen->device[device].reason[0] ? ": " : "",
	       pen->device[device].reason);
}

static bool check_tape(struct inspector *inspector, const char *path)
{
	static struct tape tape;
	static struct pen pen;
	size_t size;
	char wrong[200];
	char *text = store_read(path, &size, inspector->fault);
	if (!text)
		return fail(inspector);
	bool read = tape_read(&tape, text, size, wrong);
	free(text);
	if (!read)
		return fail_of(path, wrong);
	say_of(path, "a tape, sound: %zu reports, %d frames", tape.event_count, tape.frame_count);
	pen_init(&pen, 1920, 1080);
	for (int d = 0; d < TAPE_DEVICES_MAX; d++)
		if (tape.device[d].used)
			say_device(path, &tape, d, &pen);
	tape_free(&tape);
	return true;
}

/* ---- which kind is it? ---- */

static bool ends_with(const char *path, const char *extension)
{
	size_t length = strlen(path), tail = strlen(extension);
	return length >= tail && strcasecmp(path + length - tail, extension) == 0;
}

/* Does one of the first lines begin with this? */
static bool line_begins(const char *head, const char *word)
{
	for (const char *line = head; line; line = strchr(line, '\n')) {
		line += *line == '\n';
		if (strncmp(line, word, strlen(word)) == 0)
			return true;
	}
	return false;
}

static bool check_file(struct inspector *inspector, const char *path)
{
	size_t size;
	char head[HEAD_BYTES] = "";
	char *bytes = store_read(path, &size, inspector->fault);
	if (!bytes)
		return fail(inspector);
	memcpy(head, bytes, size < HEAD_BYTES ? size : HEAD_BYTES - 1);
	free(bytes);
	if (line_begins(head, "kitsuke-journal") || ends_with(path, ".kitsuke"))
		return check_journal(inspector, path);
	if (line_begins(head, "# kitsuke-tape") || line_begins(head, "D:") ||
	    line_begins(head, "R:") || line_begins(head, "E:") || ends_with(path, ".hid"))
		return check_tape(inspector, path);
	if (line_begins(head, "kitsuke-bones") || ends_with(path, ".bones"))
		return check_bones(inspector, path);
	if (ends_with(path, ".json"))
		return check_pattern(inspector, path);
	if (ends_with(path, ".board"))
		return check_board(inspector, path);
	if (line_begins(head, "v ") || ends_with(path, ".obj"))
		return check_body(inspector, path);
	return fail_of(path, "what kind of file is this? Known are journals (.kitsuke), tapes "
			     "(.hid), bodies (.obj), bones (.bones), patterns (.json) and boards "
			     "(.board)");
}

int command_check(int argc, char **argv)
{
	struct inspector inspector = {0};
	const struct option_value known[] = {{NULL, NULL, NULL, NULL}};
	const char *files[OPTION_FILES_MAX];
	int count;
	if (!options_read(argc, argv, known, files, &count) || count == 0) {
		fputs(usage, stderr);
		return STATUS_USAGE;
	}
	inspector.session = calloc(1, sizeof *inspector.session);
	inspector.edit = calloc(1, sizeof *inspector.edit);
	int status = inspector.session && inspector.edit ? STATUS_DONE : STATUS_MACHINE;
	for (int i = 0; i < count && status != STATUS_MACHINE; i++)
		if (!check_file(&inspector, files[i]))
			status = STATUS_INPUT;
	free(inspector.session);
	free(inspector.edit);
	free(inspector.memory);
	return status;
}
