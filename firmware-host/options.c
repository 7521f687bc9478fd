#include "options.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>

static const struct option_value *find(const struct option_value *known, const char *word)
{
	for (; known->name; known++)
		if (strcmp(known->name, word) == 0)
			return known;
	return NULL;
}

static bool read_number(const char *word, long *number)
{
	char *end;
	errno = 0;
	*number = strtol(word, &end, 10);
	return errno == 0 && end != word && *end == 0 && *number >= 0;
}

bool options_read(int argc, char **argv, const struct option_value *known,
		  const char *files[OPTION_FILES_MAX], int *file_count)
{
	bool only_files = false;
	*file_count = 0;
	for (int i = 1; i < argc; i++) {
		if (only_files || strncmp(argv[i], "--", 2) != 0) {
			if (*file_count == OPTION_FILES_MAX) {
				fprintf(stderr, "kitsuke %s: more than %d files\n", argv[0],
					OPTION_FILES_MAX);
				return false;
			}
			files[(*file_count)++] = argv[i];
			continue;
		}
		only_files = argv[i][2] == 0;
		const struct option_value *option = find(known, argv[i]);
		if (only_files)
			continue;
		if (!option) {
			fprintf(stderr, "kitsuke %s: unknown option %s\n", argv[0], argv[i]);
			return false;
		}
		if (option->set) {
			*option->set = true;
			continue;
		}
		const char *value = i + 1 < argc ? argv[++i] : NULL;
		if (!value || (option->number && !read_number(value, option->number))) {
			fprintf(stderr, "kitsuke %s: %s needs a %s\n", argv[0], option->name,
				option->number ? "whole number" : "value");
			return false;
		}
		if (option->text)
			*option->text = value;
	}
	return true;
}
