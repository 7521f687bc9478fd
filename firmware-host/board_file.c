#include "board_file.h"

#include <stdio.h>
#include <stdlib.h>

bool board_load(struct board *board, const char *path, char fault[FAULT_BYTES])
{
	char wrong[200];
	size_t size;
	*board = board_default;
	char *text = store_read(path, &size, fault);
	if (!text)
		return false;
	bool sound = board_read(board, text, size, wrong);
	free(text);
	if (!sound)
		snprintf(fault, FAULT_BYTES, "%.250s: %s", path, wrong);
	return sound;
}
