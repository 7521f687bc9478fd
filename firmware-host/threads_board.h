/* The crew that a board's file asks for. */
#ifndef THREADS_BOARD_H
#define THREADS_BOARD_H

#include "board.h"
#include "threads.h"

/* Auto: one for each processor that is named, or for each there is but one, which is left to the
 * picture and the system. */
bool threads_start_board(struct threads *threads, const struct board *board,
			 char fault[FAULT_BYTES]);

#endif
