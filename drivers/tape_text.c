/* The characters of a tape: lines, numbers, times; see tape_reader.h. */
#include "tape_reader.h"

#include <stdarg.h>
#include <stdio.h>

bool reader_fault(struct reader *r, const char *what, ...)
{
	char text[160];
	va_list arguments;
	va_start(arguments, what);
	vsnprintf(text, sizeof text, what, arguments);
	va_end(arguments);
	snprintf(r->fault, 200, "line %d: %s", r->line, text);
	return false;
}

bool reader_line(struct reader *r)
{
	if (r->at == r->end)
		return false;
	const char *newline = memchr(r->at, '\n', (size_t)(r->end - r->at));
	r->c = r->at;
	r->stop = newline ? newline : r->end;
	r->at = newline ? newline + 1 : r->end;
	while (r->stop > r->c && (r->stop[-1] == '\r' || r->stop[-1] == ' '))
		r->stop--;
	r->line++;
	return true;
}

void reader_blanks(struct reader *r)
{
	while (r->c < r->stop && (*r->c == ' ' || *r->c == '\t'))
		r->c++;
}

bool reader_skip(struct reader *r, const char *text)
{
	size_t size = strlen(text);
	if ((size_t)(r->stop - r->c) < size || memcmp(r->c, text, size))
		return false;
	r->c += size;
	return true;
}

int reader_digit(char c, int base)
{
	int value = c >= '0' && c <= '9'   ? c - '0'
		    : c >= 'a' && c <= 'f' ? c - 'a' + 10
		    : c >= 'A' && c <= 'F' ? c - 'A' + 10
					   : 99;
	return value < base ? value : -1;
}

int64_t reader_number(struct reader *r, int base, int digits)
{
	reader_blanks(r);
	int64_t value = -1;
	for (; digits > 0 && r->c < r->stop && reader_digit(*r->c, base) >= 0; digits--, r->c++)
		value = (value < 0 ? 0 : value) * base + reader_digit(*r->c, base);
	bool ends = r->c == r->stop || reader_digit(*r->c, base) < 0;
	return ends ? value : -1;
}

int64_t reader_time_us(struct reader *r)
{
	int64_t seconds = reader_number(r, 10, 10), fraction = 0, unit = SECOND_US;
	if (seconds < 0 || !reader_skip(r, "."))
		return -1;
	for (; r->c < r->stop && reader_digit(*r->c, 10) >= 0; r->c++) {
		unit /= 10;
		fraction += reader_digit(*r->c, 10) * unit;
	}
	return seconds * SECOND_US + fraction;
}

int reader_bytes(struct reader *r, uint8_t *bytes, int capacity)
{
	int count = 0;
	for (reader_blanks(r); r->c < r->stop; reader_blanks(r)) {
		int64_t byte = reader_number(r, 16, 2);
		if (byte < 0 || count == capacity)
			return -1;
		bytes[count++] = (uint8_t)byte;
	}
	return count;
}

float reader_mm(struct reader *r)
{
	int64_t whole = reader_number(r, 10, 4), fraction = 0;
	if (whole < 0)
		return -1.0f;
	if (reader_skip(r, ".") && r->c + 1 < r->stop && reader_digit(r->c[0], 10) >= 0 &&
	    reader_digit(r->c[1], 10) >= 0)
		fraction = reader_number(r, 10, 2);
	else if (r->c < r->stop && reader_digit(*r->c, 10) >= 0)
		fraction = 10 * reader_number(r, 10, 1);
	return fraction < 0 ? -1.0f : (float)whole + (float)fraction / 100.0f;
}
