#include "journal_file.h"

#include <stdio.h>
#include <stdlib.h>

bool journal_file_open(struct journal_file *file, const char *path, char fault[FAULT_BYTES])
{
	size_t size;
	memset(file, 0, sizeof *file);
	file->path = path;
	file->text = store_read(path, &size, fault);
	file->at = file->text;
	file->end = file->text ? file->text + size : NULL;
	return file->text != NULL;
}

void journal_file_close(struct journal_file *file)
{
	free(file->text);
	file->text = NULL;
}

static bool has_checksum(const char *line, const char *end)
{
	while (end > line && (end[-1] == ' ' || end[-1] == '\t' || end[-1] == '\r'))
		end--;
	return end - line >= 9 && end[-9] == '*';
}

static enum journal_result fail(const struct journal_file *file, const char *what,
				char fault[FAULT_BYTES])
{
	snprintf(fault, FAULT_BYTES, "%.250s: line %d: %s", file->path, file->line, what);
	return JOURNAL_FAULT;
}

static bool is_header(const char *line, const char *end)
{
	size_t word = strlen("kitsuke-journal");
	return (size_t)(end - line) > word && memcmp(line, JOURNAL_HEADER, word) == 0;
}

/* Only blanks and comments may stand before the header. */
static bool means_something(const char *line, const char *end)
{
	while (line < end && (*line == ' ' || *line == '\t' || *line == '\r'))
		line++;
	return line < end && *line != '#';
}

enum journal_result journal_file_next(struct journal_file *file, struct edit *edit,
				      char fault[FAULT_BYTES])
{
	while (file->at < file->end) {
		char what[160];
		const char *line = file->at;
		const char *end = memchr(line, '\n', (size_t)(file->end - line));
		bool whole = end != NULL;
		end = whole ? end : file->end;
		file->at = whole ? end + 1 : end;
		file->line++;
		file->by_hand = !has_checksum(line, end);
		if (!file->begun && means_something(line, end) && !is_header(line, end)) {
			file->begun = true;
			return fail(file, "a journal begins with \"kitsuke-journal 1\"", fault);
		}
		file->begun = file->begun || means_something(line, end);
		if (end - line >= JOURNAL_LINE_MAX)
			return fail(file, "longer than any edit; this is no journal line", fault);
		enum journal_result result = journal_read(line, (int)(end - line), edit, what);
		if (result == JOURNAL_FAULT && !whole) {
			file->torn = true;
			break;
		}
		if (result == JOURNAL_FAULT)
			return fail(file, what, fault);
		if (result == JOURNAL_EDIT)
			return result;
	}
	return JOURNAL_NOTHING;
}
