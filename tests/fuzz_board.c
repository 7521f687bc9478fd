/* Any text as a board file: values within their ranges, or a fault with its line. */
#include "board.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	struct board board;
	char fault[200];
	if (!board_read(&board, (const char *)data, size, fault)) {
		MUST(!strncmp(fault, "line ", 5));
		return 0;
	}
	MUST(board.rotation % 90 == 0 && board.rotation >= 0 && board.rotation < 360);
	MUST(board.idle_s >= 0 && board.idle_s <= 86400);
	MUST(board.display_width_mm >= 0.0f && board.display_width_mm <= 5000.0f);
	MUST(board.tablet_height_mm >= 0.0f && board.tablet_height_mm <= 5000.0f);
	MUST(board.budget_units >= 0 && board.budget_units <= 9999999);
	for (int i = 0; i < BUTTON_COUNT; i++)
		MUST(memchr(board.button_line[i], 0, BOARD_NAME_MAX));
	return 0;
}
