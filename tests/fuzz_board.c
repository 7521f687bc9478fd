/* Any text as a board file: values within their ranges, or a fault with its line. */
#include "board.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* What the operator's settings are written as brings them back. */
static void over_reads_back(const struct board *board)
{
	struct board again = board_default;
	char text[BOARD_OVER_MAX], fault[200];
	int size = board_write_over(&board_default, board, text);
	MUST(size > 0 && size < BOARD_OVER_MAX &&
	     board_read_over(&again, text, (size_t)size, fault));
	MUST(again.language == board->language && again.idle_s == board->idle_s);
	MUST(again.mount.degrees == board->mount.degrees);
	MUST(again.mount.cross_count == board->mount.cross_count);
	MUST(!memcmp(again.mount.cross, board->mount.cross,
		     (size_t)again.mount.cross_count * sizeof again.mount.cross[0]));
}

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
	MUST(memchr(board.service_pin, 0, sizeof board.service_pin));
	over_reads_back(&board);
	return 0;
}
