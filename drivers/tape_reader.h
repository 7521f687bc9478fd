/* What the files share that read tapes: tape_read.c (the whole, and hid-recorder's lines),
 * tape_comment.c (what only we need), tape_dump.c (usbhid-dump), tape_text.c (characters, numbers).
 *
 * The text is walked twice by the same code: once to check it and to count, once to fill memory of
 * just that size. Nothing of a tape is believed: every number has a bound, every fault its line. */
#ifndef TAPE_READER_H
#define TAPE_READER_H

#include "tape.h"

#define SECOND_US INT64_C(1000000)
#define TAPE_TIME_MAX_US (24 * 3600 * SECOND_US)

/* The bytes that one usbhid-dump header line announces, until an empty line. */
struct block {
	bool open, descriptor;
	int device, size;
	int64_t time_us;
	uint8_t bytes[TAPE_DESCRIPTOR_MAX];
};

struct reader {
	struct tape *tape;    /* event and bytes are NULL while counting */
	const char *at, *end; /* of the text */
	const char *c, *stop; /* of the line */
	int line;
	int device;
	bool ours;    /* it began with "# kitsuke-tape" */
	bool comment; /* the line before was one: what is indented goes on with it */
	struct block block;
	int dump_bus, dump_address; /* of the first usbhid-dump line */
	bool dump_begun, dump_addressed;
	int64_t dump_start_us, last_us;
	size_t event_count, byte_count;
	char *fault;
};

/* Writes "line N: what" into the reader's fault; returns false. */
__attribute__((format(printf, 2, 3))) bool reader_fault(struct reader *r, const char *what, ...);

/* The next line into c and stop, without its end; false: there is none. */
bool reader_line(struct reader *r);

/* Within the line, from c on. */
void reader_blanks(struct reader *r);
bool reader_skip(struct reader *r, const char *text);
int reader_digit(char c, int base); /* -1: it is none */

/* A number of at most `digits` digits; -1 when there is none. */
int64_t reader_number(struct reader *r, int base, int digits);

/* seconds.fraction to microseconds; -1 when it is none. */
int64_t reader_time_us(struct reader *r);

/* The rest of the line as bytes; -1 when it is no hex or more than `capacity`. */
int reader_bytes(struct reader *r, uint8_t *bytes, int capacity);

/* A decimal fraction like 203.2, for sizes in mm; -1 when it is none. */
float reader_mm(struct reader *r);

/* Adds an event, or counts it; times that go back a little are the last one's. */
bool reader_event(struct reader *r, int64_t time_us, int device, int size, const uint8_t *bytes);

/* A comment, behind its #. */
bool reader_comment(struct reader *r);

/* usbhid-dump: the line that begins a block, a line of its bytes, its end where one is open. */
bool reader_block_begin(struct reader *r);
bool reader_block_bytes(struct reader *r);
bool reader_block_end(struct reader *r);

#endif
