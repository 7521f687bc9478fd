/* Any text as a tape: read and played to its end, or refused with a line. */
#include "tape.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	static struct tape tape;
	static struct frame_reports reports;
	char fault[200];
	if (!tape_read(&tape, (const char *)data, size, fault)) {
		MUST(!strncmp(fault, "line ", 5) && !tape.memory);
		return 0;
	}
	size_t cursor = 0;
	for (size_t i = 0; i <= tape.event_count && cursor < tape.event_count; i++) {
		int64_t time_us = tape.event[cursor].time_us;
		tape_frame(&tape, (int)(time_us * FRAME_RATE_HZ / 1000000), &cursor, &reports);
	}
	MUST(cursor == tape.event_count);
	tape_free(&tape);
	return 0;
}
