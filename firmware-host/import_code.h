/* A card's code, read back. */
#ifndef IMPORT_CODE_H
#define IMPORT_CODE_H

#include "store.h"

/* The text of a code, or a picture that may carry one? */
bool import_is_code(const char *bytes, size_t size);

/* The journal from malloc; NULL: the fault begins with the name. */
char *import_code(const char *name, const char *bytes, size_t size, size_t *journal_size,
		  char fault[FAULT_BYTES]);

#endif
