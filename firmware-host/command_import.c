/* kitsuke import PATTERN --journal FILE: a pattern file becomes a document. */
#include "commands.h"

#include "format_garment.h"
#include "journal.h"
#include "options.h"
#include "store.h"

#include <stdio.h>
#include <stdlib.h>

static const char usage[] = "usage: kitsuke import PATTERN --journal FILE\n";

static void put_edit(FILE *out, const struct edit *edit, char line[JOURNAL_LINE_MAX])
{
	fwrite(line, 1, (size_t)journal_write(edit, line), out);
}

static void make_piece(struct edit *edit, const struct piece *piece)
{
	memset(edit, 0, sizeof *edit);
	edit->kind = EDIT_PIECE;
	memcpy(edit->name, piece->name, NAME_BYTES_MAX);
	edit->i[0] = piece->swatch;
	edit->i[1] = piece->inside_up;
	edit->f[0] = piece->position_mm.x;
	edit->f[1] = piece->position_mm.y;
	edit->f[2] = piece->turn_rad;
	edit->point_count = piece->point_count;
	for (int i = 0; i < piece->point_count; i++) {
		edit->point[i] = (struct v3){piece->point_mm[i].x, piece->point_mm[i].y, 0.0f};
		edit->corner[i] = piece->corner[i];
	}
}

/* `number` counts pieces as the journal will: without gaps. */
static void put_pieces(FILE *out, const struct pattern *pattern, int number[PIECES_MAX],
		       struct edit *edit, char line[JOURNAL_LINE_MAX])
{
	for (int p = 0, next = 0; p < PIECES_MAX; p++) {
		number[p] = next;
		if (!pattern->piece[p].used)
			continue;
		make_piece(edit, &pattern->piece[p]);
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

/* The journal as text from malloc; NULL: no memory. */
static char *write_document(const struct pattern *pattern, size_t *size)
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
	if (fclose(out) == 0)
		return text;
	free(text);
	return NULL;
}

static int import(const char *path, const char *journal)
{
	static struct pattern pattern;
	size_t size;
	char fault[FAULT_BYTES], wrong[200];
	char *text = store_read(path, &size, fault);
	if (!text) {
		fprintf(stderr, "kitsuke import: %s\n", fault);
		return STATUS_INPUT;
	}
	bool read = format_garment_read(&pattern, text, size, wrong);
	free(text);
	if (!read) {
		fprintf(stderr, "kitsuke import: %s: %s\n", path, wrong);
		return STATUS_INPUT;
	}
	char *document = write_document(&pattern, &size);
	snprintf(fault, sizeof fault, "not enough memory for the journal");
	bool written = document && store_write(journal, document, size, fault);
	free(document);
	if (!written)
		fprintf(stderr, "kitsuke import: %s\n", fault);
	return written ? STATUS_DONE : STATUS_MACHINE;
}

int command_import(int argc, char **argv)
{
	const char *journal = NULL, *files[OPTION_FILES_MAX];
	int count;
	const struct option_value known[] = {{"--journal", NULL, &journal, NULL},
					     {NULL, NULL, NULL, NULL}};
	if (!options_read(argc, argv, known, files, &count) || count != 1 || !journal) {
		fputs(usage, stderr);
		return STATUS_USAGE;
	}
	return import(files[0], journal);
}
