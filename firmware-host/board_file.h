/* Board files from disk. */
#ifndef BOARD_FILE_H
#define BOARD_FILE_H

#include "board.h"
#include "store.h"

/* Reads a board file. False: fault says "PATH: line N: what; remedy", and board has the defaults.
 */
bool board_load(struct board *board, const char *path, char fault[FAULT_BYTES]);

#endif
