/* kitsuke import PATTERN --journal FILE: a pattern file becomes a document, with marks (--marks)
 * one that dresses whoever is named; so does what a visitor took home (import_code.c). */
#include "commands.h"

#include "format_code.h"
#include "format_garment.h"
#include "format_marks.h"
#include "format_marks_guess.h"
#include "body_landmark.h"
#include "import_code.h"
#include "journal.h"
#include "options.h"
#include "store.h"

#include <stdio.h>
#include <stdlib.h>

static const char usage[] =
	"usage: kitsuke import PATTERN [--marks FILE|guess] --journal FILE\n"
	"       kitsuke import CARD|CODE --journal FILE\n"
	"CARD: a card's PNG, or a file with the text of its QR code; CODE: that text, quoted\n";

static void put_edit(FILE *out, const struct edit *edit, char line[JOURNAL_LINE_MAX])
{
	fwrite(line, 1, (size_t)journal_write(edit, line), out);
}

/* `number` counts pieces as the journal will: without gaps. */
static void put_pieces(FILE *out, const struct pattern *pattern, int number[PIECES_MAX],
		       struct edit *edit, char line[JOURNAL_LINE_MAX])
{
	for (int p = 0, next = 0; p < PIECES_MAX; p++) {
		number[p] = next;
		if (!pattern->piece[p].used)
			continue;
		edit_draw_piece(edit, &pattern->piece[p]);
		put_edit(out, edit, line);
		next++;
	}
}

static void put_seams(FILE *out, const struct pattern *pattern, const int number[PIECES_MAX],
		      struct edit *edit, char line[JOURNAL_LINE_MAX])
{
	for (int s = 0; s < SEAMS_MAX; s++) {
		const struct seam *seam = &pattern->seam[s];
		if (!seam->used)
			continue;
		memset(edit, 0, sizeof *edit);
		edit->kind = EDIT_SEW;
		edit->i[0] = number[seam->a.piece];
		edit->i[1] = seam->a.edge;
		edit->i[2] = number[seam->b.piece];
		edit->i[3] = seam->b.edge;
		edit->i[4] = seam->swapped;
		put_edit(out, edit, line);
	}
}

static void put_marks(FILE *out, const struct design_marks *marks, const int number[PIECES_MAX],
		      struct edit *edit, char line[JOURNAL_LINE_MAX])
{
	for (int m = 0; m < marks->count; m++) {
		const struct design_mark *mark = &marks->mark[m];
		memset(edit, 0, sizeof *edit);
		edit->kind = EDIT_MARK_CLOTH;
		edit->i[0] = m + 1;
		edit->i[1] = number[mark->piece];
		edit->point_count = mark->point_count;
		for (int i = 0; i < mark->point_count; i++)
			edit->point[i] = (struct v3){mark->point_mm[i].x, mark->point_mm[i].y,
						     0.0f};
		put_edit(out, edit, line);
		memset(edit, 0, sizeof *edit);
		edit->kind = EDIT_MARK_AT;
		memcpy(edit->name, mark->landmark, NAME_BYTES_MAX);
		edit->i[0] = m + 1;
		edit->f[0] = mark->from;
		edit->f[1] = mark->to;
		put_edit(out, edit, line);
	}
}

static void put_word(FILE *out, enum edit_kind kind, struct edit *edit, char line[JOURNAL_LINE_MAX])
{
	memset(edit, 0, sizeof *edit);
	edit->kind = kind;
	put_edit(out, edit, line);
}

/* Marks are there to be worn. */
static void put_wearing(FILE *out, const struct design_marks *marks, const int number[PIECES_MAX],
			struct edit *edit, char line[JOURNAL_LINE_MAX])
{
	put_word(out, EDIT_WRAP, edit, line);
	if (marks->pin_count > 0)
		put_word(out, EDIT_WORN, edit, line);
	for (int p = 0; p < marks->pin_count; p++) {
		memset(edit, 0, sizeof *edit);
		edit->kind = EDIT_PIN;
		edit->i[0] = number[marks->pin[p].piece];
		edit->f[0] = marks->pin[p].point_mm.x;
		edit->f[1] = marks->pin[p].point_mm.y;
		put_edit(out, edit, line);
	}
	put_word(out, EDIT_SETTLE, edit, line);
}

/* The journal as text from malloc; NULL: no memory. */
static char *write_document(const struct pattern *pattern, const struct design_marks *marks,
			    size_t *size)
{
	static struct edit edit;
	static char line[JOURNAL_LINE_MAX];
	int number[PIECES_MAX];
	char *text = NULL;
	FILE *out = open_memstream(&text, size);
	if (!out)
		return NULL;
	fputs(JOURNAL_HEADER, out);
	put_pieces(out, pattern, number, &edit, line);
	put_seams(out, pattern, number, &edit, line);
	put_marks(out, marks, number, &edit, line);
	if (marks->count > 0)
		put_wearing(out, marks, number, &edit, line);
	if (fclose(out) == 0)
		return text;
	free(text);
	return NULL;
}

/* The last stop of a landmark: as many as its list has commas. */
static float last_stop(enum landmark landmark)
{
	int count = 0;
	for (const char *at = landmark_stops[landmark]; *at; at++)
		count += *at == ',';
	return (float)count;
}

/* Marks without FROM and TO take the whole landmark. */
static bool find_landmarks(struct design_marks *marks, char wrong[200])
{
	for (int m = 0; m < marks->count; m++) {
		struct design_mark *mark = &marks->mark[m];
		enum landmark landmark = landmark_find(mark->landmark);
		if (landmark == LANDMARK_COUNT) {
			snprintf(wrong, 200, "no landmark is called %s; see kitsuke help journal",
				 mark->landmark);
			return false;
		}
		if (mark->from == mark->to) {
			mark->from = 0.0f;
			mark->to = last_stop(landmark);
		}
	}
	return true;
}

/* Marks for a garment without any, printed, so that they can be kept and made better. */
static char *guess_marks(const struct pattern *pattern, const char *garment, size_t garment_size,
			 size_t *size, char fault[FAULT_BYTES])
{
	char *text = malloc(GUESS_BYTES_MAX);
	*size = text ? (size_t)format_marks_guess(text, pattern, garment, garment_size) : 0;
	if (*size > 0) {
		fputs(text, stdout);
		return text;
	}
	snprintf(fault, FAULT_BYTES, "%s",
		 text ? "nothing says where any piece is worn; write a file of marks"
		      : "not enough memory for the marks");
	free(text);
	return NULL;
}

/* The marks of a file, or guessed; none without a path. `garment` is the pattern file's text. */
static bool read_marks(struct design_marks *marks, const char *path, const struct pattern *pattern,
		       const char *garment, size_t garment_size, char fault[FAULT_BYTES])
{
	static struct garment_places places;
	char wrong[200];
	size_t size;
	memset(marks, 0, sizeof *marks);
	if (!path)
		return true;
	char *text = strcmp(path, "guess") == 0
			     ? guess_marks(pattern, garment, garment_size, &size, fault)
			     : store_read(path, &size, fault);
	if (!text)
		return false;
	format_places_read(&places, garment, garment_size);
	bool read = format_marks_read(marks, pattern, &places, text, size, wrong) &&
		    find_landmarks(marks, wrong);
	free(text);
	if (!read)
		snprintf(fault, FAULT_BYTES, "%.250s: %s", path, wrong);
	return read;
}

static bool read_pattern(struct pattern *pattern, struct design_marks *marks, const char *path,
			 const char *marks_path, char fault[FAULT_BYTES])
{
	size_t size;
	char wrong[200];
	char *text = store_read(path, &size, fault);
	if (!text)
		return false;
	bool read = format_garment_read(pattern, text, size, wrong);
	if (!read)
		snprintf(fault, FAULT_BYTES, "%.250s: %s", path, wrong);
	read = read && read_marks(marks, marks_path, pattern, text, size, fault);
	free(text);
	return read;
}

static int write_journal(const char *journal, char *document, size_t size, char fault[FAULT_BYTES])
{
	bool written = document && store_write(journal, document, size, fault);
	free(document);
	if (!written)
		fprintf(stderr, "kitsuke import: %s\n", fault);
	return written ? STATUS_DONE : STATUS_MACHINE;
}

/* What a visitor took home, as a text or a file. -1: it is something else. */
static int import_home(const char *what, const char *journal)
{
	char fault[FAULT_BYTES], *document = NULL;
	size_t size = strlen(what), journal_size;
	bool text = code_begins(what, size);
	char *bytes = text ? NULL : store_read(what, &size, fault);
	if (!text && (!bytes || !import_is_code(bytes, size))) {
		free(bytes);
		return -1;
	}
	document = import_code(text ? "the code" : what, text ? what : bytes, size, &journal_size,
			       fault);
	free(bytes);
	if (document)
		return write_journal(journal, document, journal_size, fault);
	fprintf(stderr, "kitsuke import: %s\n", fault);
	return STATUS_INPUT;
}

static int import(const char *path, const char *marks_path, const char *journal)
{
	static struct pattern pattern;
	static struct design_marks marks;
	size_t size;
	char fault[FAULT_BYTES];
	if (!read_pattern(&pattern, &marks, path, marks_path, fault)) {
		fprintf(stderr, "kitsuke import: %s\n", fault);
		return STATUS_INPUT;
	}
	char *document = write_document(&pattern, &marks, &size);
	snprintf(fault, sizeof fault, "not enough memory for the journal");
	return write_journal(journal, document, size, fault);
}

int command_import(int argc, char **argv)
{
	const char *journal = NULL, *marks = NULL, *files[OPTION_FILES_MAX];
	int count;
	const struct option_value known[] = {{"--journal", NULL, &journal, NULL},
					     {"--marks", NULL, &marks, NULL},
					     {NULL, NULL, NULL, NULL}};
	if (!options_read(argc, argv, known, files, &count) || count != 1 || !journal) {
		fputs(usage, stderr);
		return STATUS_USAGE;
	}
	int status = marks ? -1 : import_home(files[0], journal);
	return status >= 0 ? status : import(files[0], marks, journal);
}
