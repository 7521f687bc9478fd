/* kitsuke import CODE: the text of a card's QR code, a file with it, or the card's PNG, becomes a
 * journal again. */
#include "import_code.h"

#include "take_home_content.h"

#include <stdio.h>
#include <stdlib.h>

bool import_is_code(const char *bytes, size_t size)
{
	return code_is_png(bytes, size) || code_begins(bytes, size);
}

/* `name`: what the text is called in a message. */
static char *journal_of(const char *name, const char *text, size_t size, size_t *journal_size,
			char fault[FAULT_BYTES])
{
	char wrong[CODE_FAULT_BYTES];
	struct code_content *content = malloc(sizeof *content);
	snprintf(wrong, sizeof wrong, "not enough memory");
	bool read = content && code_read(content, text, size, wrong);
	char *journal = read ? content_journal(content, journal_size) : NULL;
	if (!journal)
		snprintf(fault, FAULT_BYTES, "%.250s: %s", name,
			 read ? "not enough memory" : wrong);
	free(content);
	return journal;
}

char *import_code(const char *name, const char *bytes, size_t size, size_t *journal_size,
		  char fault[FAULT_BYTES])
{
	char wrong[CODE_FAULT_BYTES];
	if (!code_is_png(bytes, size))
		return journal_of(name, bytes, size, journal_size, fault);
	const char *text = code_in_png(bytes, size, &size, wrong);
	if (text)
		return journal_of(name, text, size, journal_size, fault);
	snprintf(fault, FAULT_BYTES, "%.250s: %s", name, wrong);
	return NULL;
}
