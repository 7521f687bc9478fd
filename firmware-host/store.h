/* Whole files: read with a limit and a clear fault, written so that a power cut leaves the old file
 * or the new one, never half of one. */
#ifndef STORE_H
#define STORE_H

#include "base.h"

enum {
	FAULT_BYTES = 512, /* "FILE: line N: what; remedy" */
	PATH_BYTES_MAX = 4096,
	STORE_BYTES_MAX = 256 << 20, /* the longest file that any reader takes */
};

/* The file's bytes from malloc with a zero behind them, their count in *size. NULL: fault says
 * "PATH: what; remedy". Only regular files are read: nothing here waits for a pipe. */
char *store_read(const char *path, size_t *size, char fault[FAULT_BYTES]);

/* Writes beside the target, syncs, renames. A device or pipe (/dev/stdout) is written in place. On
 * a fault errno says why too, and what was there is as it was. */
bool store_write(const char *path, const void *bytes, size_t size, char fault[FAULT_BYTES]);

/* Makes a folder; one that exists is fine. */
bool store_make_folder(const char *path, char fault[FAULT_BYTES]);

/* "FOLDER/NAME" into path; a fault when that is too long. */
bool store_join(char *path, size_t path_size, const char *folder, const char *name,
		char fault[FAULT_BYTES]);

/* The part of a path behind its last slash. */
const char *store_name(const char *path);

#endif
