#include "take_home_content.h"

#include "character.h"
#include "fabric.h"
#include "journal.h"

#include <stdio.h>
#include <stdlib.h>

/* ---- taking ---- */

static void take_pieces(struct code_content *content, const struct pattern *pattern,
			int number[PIECES_MAX])
{
	for (int p = 0; p < PIECES_MAX; p++) {
		number[p] = content->piece_count;
		if (!pattern->piece[p].used)
			continue;
		struct piece *piece = &content->pattern.piece[content->piece_count++];
		*piece = pattern->piece[p];
		piece->layer = content->piece_count;
		piece->symmetric = false;
		piece->axis_mm = (struct v2){0.0f, 0.0f};
		piece->axis_rad = 0.0f;
	}
}

static void take_seams(struct code_content *content, const struct pattern *pattern,
		       const int number[PIECES_MAX])
{
	for (int s = 0; s < SEAMS_MAX; s++) {
		if (!pattern->seam[s].used)
			continue;
		struct seam *seam = &content->pattern.seam[content->seam_count++];
		*seam = pattern->seam[s];
		seam->a.piece = number[seam->a.piece];
		seam->b.piece = number[seam->b.piece];
		seam->even = false;
	}
}

void content_take(struct code_content *content, const struct document *document, bool wrapped,
		  const char *body)
{
	int number[PIECES_MAX];
	memset(content, 0, sizeof *content);
	content->wrapped = wrapped;
	if (strcmp(body, CHARACTER_MANNEQUIN) != 0)
		snprintf(content->body, sizeof content->body, "%s", body);
	if (document->fabric > 0)
		snprintf(content->fabric, sizeof content->fabric, "%s",
			 fabric_at(document->fabric)->name);
	take_pieces(content, &document->pattern, number);
	take_seams(content, &document->pattern, number);
	for (int m = 0; m < MARKS_MAX; m++) {
		const struct cloth_mark *cloth = &document->marks.cloth[m];
		const struct body_mark *line = &document->marks.body[m];
		if (cloth->used) {
			struct cloth_mark *mark = &content->marks.cloth[content->cloth_count++];
			*mark = *cloth;
			mark->piece = number[cloth->piece];
		}
		if (line->used)
			content->marks.body[content->body_count++] = *line;
	}
}

/* ---- writing ---- */

struct scribe {
	FILE *out;
	struct edit edit;
	char line[JOURNAL_LINE_MAX];
};

static struct edit *edit_new(struct scribe *scribe, enum edit_kind kind)
{
	memset(&scribe->edit, 0, sizeof scribe->edit);
	scribe->edit.kind = kind;
	return &scribe->edit;
}

static void put(struct scribe *scribe)
{
	fwrite(scribe->line, 1, (size_t)journal_write(&scribe->edit, scribe->line), scribe->out);
}

static void put_piece(struct scribe *scribe, const struct piece *piece)
{
	edit_draw_piece(&scribe->edit, piece);
	put(scribe);
}

static void put_layers(struct scribe *scribe, const struct code_content *content)
{
	for (int p = 0; p < content->piece_count; p++) {
		if (content->pattern.piece[p].worn_over == 0)
			continue;
		struct edit *edit = edit_new(scribe, EDIT_LAYER);
		edit->i[0] = p;
		edit->i[1] = content->pattern.piece[p].worn_over;
		put(scribe);
	}
}

static void put_seam(struct scribe *scribe, const struct seam *seam)
{
	struct edit *edit = edit_new(scribe, EDIT_SEW);
	edit->i[0] = seam->a.piece;
	edit->i[1] = seam->a.edge;
	edit->i[2] = seam->b.piece;
	edit->i[3] = seam->b.edge;
	edit->i[4] = seam->swapped;
	put(scribe);
}

static void put_cloth_mark(struct scribe *scribe, const struct cloth_mark *mark)
{
	struct edit *edit = edit_new(scribe, EDIT_MARK_CLOTH);
	edit->i[0] = mark->number;
	edit->i[1] = mark->piece;
	edit->point_count = mark->point_count;
	for (int i = 0; i < mark->point_count; i++)
		edit->point[i] = (struct v3){mark->point_mm[i].x, mark->point_mm[i].y, 0.0f};
	put(scribe);
}

static void put_body_mark(struct scribe *scribe, const struct body_mark *mark)
{
	struct edit *edit = edit_new(scribe, EDIT_MARK_BODY);
	edit->i[0] = mark->number;
	edit->point_count = mark->point_count;
	memcpy(edit->point, mark->point_m, (size_t)mark->point_count * sizeof mark->point_m[0]);
	put(scribe);
}

static void put_word(struct scribe *scribe, enum edit_kind kind, const char *name)
{
	struct edit *edit = edit_new(scribe, kind);
	snprintf(edit->name, sizeof edit->name, "%s", name);
	put(scribe);
}

static void put_content(struct scribe *scribe, const struct code_content *content)
{
	fputs(JOURNAL_HEADER, scribe->out);
	put_word(scribe, EDIT_BODY, content->body[0] ? content->body : CHARACTER_MANNEQUIN);
	for (int p = 0; p < content->piece_count; p++)
		put_piece(scribe, &content->pattern.piece[p]);
	put_layers(scribe, content);
	for (int s = 0; s < content->seam_count; s++)
		put_seam(scribe, &content->pattern.seam[s]);
	if (content->fabric[0])
		put_word(scribe, EDIT_FABRIC, content->fabric);
	for (int m = 0; m < content->cloth_count; m++)
		put_cloth_mark(scribe, &content->marks.cloth[m]);
	for (int m = 0; m < content->body_count; m++)
		put_body_mark(scribe, &content->marks.body[m]);
	if (content->wrapped) {
		put_word(scribe, EDIT_WRAP, "");
		put_word(scribe, EDIT_SETTLE, "");
	}
}

char *content_journal(const struct code_content *content, size_t *size)
{
	char *text = NULL;
	struct scribe *scribe = malloc(sizeof *scribe);
	if (!scribe)
		return NULL;
	scribe->out = open_memstream(&text, size);
	if (!scribe->out) {
		free(scribe);
		return NULL;
	}
	put_content(scribe, content);
	bool written = fclose(scribe->out) == 0;
	free(scribe);
	if (written)
		return text;
	free(text);
	return NULL;
}
