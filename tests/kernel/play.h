/* What the kernel bench's players share: loading a tape, keeping its time, giving up. */
#ifndef PLAY_H
#define PLAY_H

#include "tape.h"

/* Says why on stderr and ends the program; play_fail adds errno's words. */
__attribute__((format(printf, 1, 2), noreturn)) void play_complain(const char *what, ...);
__attribute__((noreturn)) void play_fail(const char *what);

int64_t play_clock_us(void); /* CLOCK_MONOTONIC */
void play_sleep_until(int64_t time_us);

/* Reads a tape, or gives up. */
void play_tape_load(struct tape *tape, const char *path);

#endif
