#include "play.h"

#include "store.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

void play_complain(const char *what, ...)
{
	va_list arguments;
	va_start(arguments, what);
	vfprintf(stderr, what, arguments);
	va_end(arguments);
	fputc('\n', stderr);
	exit(1);
}

void play_fail(const char *what)
{
	play_complain("%s: %s", what, strerror(errno));
}

int64_t play_clock_us(void)
{
	struct timespec now;
	clock_gettime(CLOCK_MONOTONIC, &now);
	return (int64_t)now.tv_sec * 1000000 + now.tv_nsec / 1000;
}

void play_sleep_until(int64_t time_us)
{
	struct timespec until = {time_us / 1000000, (long)(time_us % 1000000) * 1000};
	while (time_us > 0 &&
	       clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, NULL) == EINTR)
		;
}

void play_tape_load(struct tape *tape, const char *path)
{
	char fault[FAULT_BYTES], wrong[200];
	size_t size;
	char *text = store_read(path, &size, fault);
	if (!text)
		play_complain("%s", fault);
	if (!tape_read(tape, text, size, wrong))
		play_complain("%s: %s", path, wrong);
	free(text);
}
