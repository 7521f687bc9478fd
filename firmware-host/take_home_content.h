/* A visit's document reduced to what a code carries, and that as a journal. */
#ifndef TAKE_HOME_CONTENT_H
#define TAKE_HOME_CONTENT_H

#include "format_code.h"
#include "session.h"

/* The body is the journal's name of it; pieces, seams and marks lose their gaps. */
void content_take(struct code_content *content, const struct document *document, bool wrapped,
		  const char *body);

/* The content as a journal from malloc, which kitsuke dress wears; NULL: no memory. */
char *content_journal(const struct code_content *content, size_t *size);

#endif
