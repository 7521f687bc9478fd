/* The journal: edits as text, one a line. Save file, undo history, script, fixture, crash report.
 *
 *   kitsuke-journal 1
 *   # a comment
 *   mark-cloth 1 0 0 250 0 -250        *7c9e2f01
 *
 * A line may end in a checksum: '*' and 8 hex digits, FNV-1a (32 bit) of everything before the
 * blanks in front of it. Lines written by the station have one; lines written by hand need none.
 */
#ifndef JOURNAL_H
#define JOURNAL_H

#include "edit.h"

enum { JOURNAL_LINE_MAX = 32 * 1024 };

#define JOURNAL_HEADER "kitsuke-journal 1\n"

/* Writes one edit as a line with checksum and newline; returns its length without the final zero.
 * MUST fit in JOURNAL_LINE_MAX. Numbers are written so that reading gives the same bits. */
int journal_write(const struct edit *edit, char line[JOURNAL_LINE_MAX]);

enum journal_result {
	JOURNAL_EDIT,    /* *edit holds it */
	JOURNAL_NOTHING, /* blank, comment or the header */
	JOURNAL_FAULT,   /* *fault says what is wrong, in words with the remedy */
};

/* Reads one line of `size` bytes (no newline needed). Any bytes are safe. */
enum journal_result journal_read(const char *line, int size, struct edit *edit, char fault[160]);

/* Text <-> float for journal, board and tape: shortest form that reads back to the same bits. */
int number_write(char *out, float value);

/* Reads a decimal number (sign, digits, point, exponent) from [*text, end); advances *text. False:
 * not a number, or not finite in float. Correctly rounded for up to 9 significant digits and
 * |exponent| <= 22, within 1 ulp otherwise. */
bool number_read(const char **text, const char *end, float *value);

#endif
