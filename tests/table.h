/* Tables of test data: comma or tab separated text with a header line, and hex. */
#ifndef TABLE_H
#define TABLE_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TABLE_COLUMNS_MAX = 96 };

struct table {
	char *text;
	int rows, columns;
	char **cell; /* rows + 1 lines of `columns` cells, the header first */
};

static inline char *table_file(const char *path, size_t *size)
{
	FILE *file = fopen(path, "rb");
	if (!file)
		return NULL;
	fseek(file, 0, SEEK_END);
	*size = (size_t)ftell(file);
	rewind(file);
	char *text = malloc(*size + 1);
	if (text)
		text[ *size = fread(text, 1, *size, file)] = 0;
	fclose(file);
	return text;
}

/* Cuts one cell off *at in place; quotes around a cell and doubled quotes within are removed.
 * Returns the character that ended it. */
static inline char table_cut(char **at, char separator, char **cell)
{
	char *in = *at, *out = *at;
	bool quoted = *in == '"';
	in += quoted ? 1 : 0;
	*cell = out;
	for (; *in && (quoted || (*in != separator && *in != '\n')); in++) {
		if (quoted && *in == '"' && in[1] != '"')
			quoted = false;
		else
			*out++ = quoted && *in == '"' ? *in++ : *in; /* "" is one " */
	}
	char end = *in;
	*at = end ? in + 1 : in;
	if (out > *cell && out[-1] == '\r')
		out--;
	*out = 0;
	return end;
}

static inline bool table_read(struct table *table, const char *path, char separator)
{
	size_t size, lines = 1;
	*table = (struct table){.text = table_file(path, &size)};
	if (!table->text)
		return false;
	for (size_t i = 0; i < size; i++)
		lines += table->text[i] == '\n';
	table->cell = calloc(lines * TABLE_COLUMNS_MAX, sizeof(char *));
	char *at = table->text;
	int line = 0;
	for (; table->cell && *at; line++) {
		int column = 0;
		char end = separator, *cell;
		for (; end == separator; column++) {
			end = table_cut(&at, separator, &cell);
			if (column < TABLE_COLUMNS_MAX)
				table->cell[line * TABLE_COLUMNS_MAX + column] = cell;
		}
		table->columns = line ? table->columns : column;
	}
	table->rows = line - 1;
	return table->cell && line;
}

/* The cell under this heading; "" where the row is short. A heading that is not there ends the
 * test: it is the test's own mistake. */
static inline const char *table_cell(const struct table *table, int row, const char *heading)
{
	for (int i = 0; i < table->columns; i++)
		if (!strcmp(table->cell[i], heading)) {
			const char *cell = table->cell[(row + 1) * TABLE_COLUMNS_MAX + i];
			return cell ? cell : "";
		}
	fprintf(stderr, "no column %s\n", heading);
	exit(EXIT_FAILURE);
}

static inline int table_find(const struct table *table, const char *heading, const char *value)
{
	for (int row = 0; row < table->rows; row++)
		if (!strcmp(table_cell(table, row, heading), value))
			return row;
	return -1;
}

/* Hex digits, spaces between bytes allowed, to bytes; returns their number. */
static inline int table_hex(const char *hex, uint8_t *bytes, size_t capacity)
{
	size_t count = 0;
	unsigned byte;
	for (int used; count < capacity && sscanf(hex, " %2x%n", &byte, &used) == 1; hex += used)
		bytes[count++] = (uint8_t)byte;
	return (int)count;
}

#endif
