/* What stands behind a command's name: options with and without a value, and files. */
#ifndef OPTIONS_H
#define OPTIONS_H

#include "base.h"

enum { OPTION_FILES_MAX = 64 };

struct option_value {
	const char *name; /* "--obj"; NULL ends the list */
	bool *set;        /* an option without a value; NULL: it has one */
	const char **text;
	long *number;
};

/* Reads argv[1..]; words that do not begin with "--" are files. False: a line about the command
 * line at fault has gone to stderr. "--" ends the options. */
bool options_read(int argc, char **argv, const struct option_value *known,
		  const char *files[OPTION_FILES_MAX], int *file_count);

#endif
