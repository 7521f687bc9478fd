/* A pattern as a line of text that a QR code carries: what is needed to cut it out, sew it and put
 * it on once more, and nothing of how the visitor came to it.
 *
 *   KITSUKE1: base45( kind | crc32 | deflate( content ) ) .
 *
 * Base45 (RFC 9285) has the 45 characters of a QR code's alphanumeric mode. kind is a byte: 1, 2, 3
 * for lengths in tenths, hundredths, thousandths of a millimetre. The CRC-32 (zlib's, four bytes,
 * high one first) is of all bytes but itself. The full stop says that nothing was cut off.
 *
 * A tenth of a millimetre is a twentieth of the sheet's pixel on the station's screen, and less
 * than scissors hold; a hand-written pattern in whole tenths comes back bit for bit. Finer ones are
 * taken where an outline is no outline any more when rounded so.
 *
 * Content, numbers as groups of seven bits, low ones first, signed ones folded (0 -1 1 -2 ...):
 *   wrapped; names of body and fabric (empty: the usual ones)
 *   pieces: name, swatch + 8 inside_up + 16 worn_over, place x y, turn (a float's bits),
 *           points, a bit a point for corners, outline x, outline y
 *   seams:  2 piece + swapped, edge, piece, edge
 *   marks on cloth: number, piece, points, x, y       marks on the body: number, points, x, y, z
 * Each list begins with its count. A row of coordinates begins with the order of its prediction: 1,
 * differences from the point before; 2, from where the last two lead.
 *
 * Not carried: undo, pins and drags, symmetry and kept lengths, which shape nothing by themselves.
 */
#ifndef FORMAT_CODE_H
#define FORMAT_CODE_H

#include "mark.h"
#include "pattern.h"

enum {
	CODE_RAW_MAX = 256 << 10,  /* the content of a full pattern stays below */
	CODE_TEXT_MAX = 512 << 10, /* a full pattern's text; a QR code holds 4296 characters */
	CODE_FAULT_BYTES = 200,
};

struct code_content {
	char body[NAME_BYTES_MAX], fabric[NAME_BYTES_MAX]; /* "": the usual one */
	bool wrapped;
	int piece_count; /* pattern.piece[0..], without gaps */
	int seam_count;
	int cloth_count, body_count; /* marks */
	struct pattern pattern;
	struct marks marks;
};

struct code_figures {
	int raw_bytes, packed_bytes, characters;
	int per_mm; /* 10, 100 or 1000 */
	bool exact; /* every number comes back to the same bits */
};

/* Writes the text with a zero behind it; returns its length. 0: it does not fit, or the content is
 * no sound pattern. */
int code_write(const struct code_content *content, char *text, size_t text_size,
	       struct code_figures *figures);

/* Does this begin like a code? */
bool code_begins(const char *text, size_t size);

/* Any bytes are safe; line ends and tabs are skipped, wherever a message has put them. False: fault
 * says where and what to do, and content is no good. */
bool code_read(struct code_content *content, const char *text, size_t size,
	       char fault[CODE_FAULT_BYTES]);

/* The code in a card's PNG: its tEXt chunk of keyword "kitsuke". NULL: fault says why not. */
const char *code_in_png(const void *png, size_t size, size_t *text_size,
			char fault[CODE_FAULT_BYTES]);
bool code_is_png(const void *bytes, size_t size);

/* ---- between format_code.c and format_code_text.c ---- */

/* The content as bytes; 0: no room. */
size_t code_pack(const struct code_content *content, int per_mm, uint8_t *raw, size_t raw_size);
bool code_unpack(struct code_content *content, int per_mm, const uint8_t *raw, size_t raw_size,
		 char fault[CODE_FAULT_BYTES]);

#endif
