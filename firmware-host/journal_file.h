/* A journal as a file: edits one after the other, each with the line that it stands on. */
#ifndef JOURNAL_FILE_H
#define JOURNAL_FILE_H

#include "journal.h"
#include "store.h"

struct journal_file {
	const char *path;
	char *text;
	const char *at, *end;
	int line;     /* of the last edit, from 1 */
	bool begun;   /* the header has been seen */
	bool by_hand; /* the last edit's line has no checksum: a person wrote it */
	bool torn;    /* the file ended in the middle of a line, as after a power cut */
};

/* False: the fault names the file. */
bool journal_file_open(struct journal_file *file, const char *path, char fault[FAULT_BYTES]);

/* The next edit. JOURNAL_NOTHING: the end. After JOURNAL_FAULT (the fault says "FILE: line N: ...")
 * reading may go on with the next line. A last line without its end that can't be read is no fault
 * but a power cut: `torn` is set, and all edits before it have been given. */
enum journal_result journal_file_next(struct journal_file *file, struct edit *edit,
				      char fault[FAULT_BYTES]);
void journal_file_close(struct journal_file *file);

#endif
