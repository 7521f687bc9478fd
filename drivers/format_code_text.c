/* A code's text: Base45, checksum, zlib's deflate; and where a card's PNG keeps it. */
#include "format_code.h"

#include <stdio.h>
#include <stdlib.h>
#include <zlib.h>

static const char head[] = "KITSUKE1:";
static const char alphabet[] = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZ $%*+-./:";

enum { HEAD = sizeof head - 1, BYTES_MAX = CODE_TEXT_MAX / 3 * 2 };

static int per_mm_of(int kind)
{
	return kind == 1 ? 10 : kind == 2 ? 100 : 1000;
}

static uint32_t checksum(const uint8_t *bytes, size_t size)
{
	uLong sum = crc32(0, bytes, 1);
	return (uint32_t)crc32(sum, bytes + 5, (uInt)(size - 5));
}

/* ---- writing ---- */

/* Raw deflate by the strategy that makes it shortest; bytes has room for BYTES_MAX. */
static size_t deflate_all(const uint8_t *raw, size_t raw_size, uint8_t *bytes, size_t room)
{
	static const int strategies[] = {Z_DEFAULT_STRATEGY, Z_FILTERED, Z_HUFFMAN_ONLY, Z_FIXED};
	size_t best = 0;
	int best_at = -1;
	for (int k = 0; k <= COUNT_OF(strategies); k++) { /* the last round: the best one again */
		int strategy = strategies[k < COUNT_OF(strategies) ? k : int_max(best_at, 0)];
		z_stream stream = {0};
		if (deflateInit2(&stream, 9, Z_DEFLATED, -15, 9, strategy) != Z_OK)
			return 0;
		stream.next_in = (Bytef *)(uintptr_t)raw;
		stream.avail_in = (uInt)raw_size;
		stream.next_out = bytes;
		stream.avail_out = (uInt)room;
		bool whole = deflate(&stream, Z_FINISH) == Z_STREAM_END;
		size_t size = room - stream.avail_out;
		deflateEnd(&stream);
		if (whole && (best_at < 0 || size < best)) {
			best = size;
			best_at = k;
		}
	}
	return best;
}

static int base45(const uint8_t *bytes, size_t size, char *text, size_t text_size)
{
	size_t at = HEAD, whole = HEAD + size / 2 * 3 + size % 2 * 2 + 2;
	if (whole > text_size)
		return 0;
	memcpy(text, head, HEAD);
	for (size_t i = 0; i < size; i += 2) {
		bool pair = i + 1 < size;
		unsigned value = pair ? bytes[i] * 256u + bytes[i + 1] : bytes[i];
		text[at++] = alphabet[value % 45];
		text[at++] = alphabet[value / 45 % 45];
		if (pair)
			text[at++] = alphabet[value / 2025];
	}
	text[at++] = '.';
	text[at] = 0;
	return (int)at;
}

static bool same_line(const struct v2 *a, const struct v2 *b, int count)
{
	bool same = true;
	for (int i = 0; i < count; i++)
		same &= a[i].x == b[i].x && a[i].y == b[i].y;
	return same;
}

static bool same_numbers(const struct code_content *a, const struct code_content *b)
{
	bool same = true;
	for (int p = 0; p < a->piece_count; p++) {
		const struct piece *one = &a->pattern.piece[p], *other = &b->pattern.piece[p];
		same &= same_line(one->point_mm, other->point_mm, one->point_count) &&
			same_line(&one->position_mm, &other->position_mm, 1);
	}
	for (int m = 0; m < a->cloth_count; m++)
		same &= same_line(a->marks.cloth[m].point_mm, b->marks.cloth[m].point_mm,
				  a->marks.cloth[m].point_count);
	for (int m = 0; m < a->body_count; m++)
		for (int i = 0; i < a->marks.body[m].point_count; i++)
			same &= v3_distance(a->marks.body[m].point_m[i],
					    b->marks.body[m].point_m[i]) == 0.0f;
	return same;
}

struct workshop {
	struct code_content again;
	uint8_t raw[CODE_RAW_MAX];
	uint8_t bytes[BYTES_MAX];
};

static int write_kind(struct workshop *shop, const struct code_content *content, int kind,
		      char *text, size_t text_size, struct code_figures *figures)
{
	char fault[CODE_FAULT_BYTES];
	int per_mm = per_mm_of(kind);
	size_t raw = code_pack(content, per_mm, shop->raw, sizeof shop->raw);
	if (raw == 0 || !code_unpack(&shop->again, per_mm, shop->raw, raw, fault))
		return 0;
	size_t size = deflate_all(shop->raw, raw, shop->bytes + 5, sizeof shop->bytes - 5);
	if (size == 0)
		return 0;
	shop->bytes[0] = (uint8_t)kind;
	uint32_t sum = checksum(shop->bytes, size + 5);
	for (int i = 0; i < 4; i++)
		shop->bytes[1 + i] = (uint8_t)(sum >> (24 - 8 * i));
	*figures = (struct code_figures){
		.raw_bytes = (int)raw,
		.packed_bytes = (int)size + 5,
		.characters = base45(shop->bytes, size + 5, text, text_size),
		.per_mm = per_mm,
		.exact = same_numbers(content, &shop->again),
	};
	return figures->characters;
}

int code_write(const struct code_content *content, char *text, size_t text_size,
	       struct code_figures *figures)
{
	int length = 0;
	struct workshop *shop = malloc(sizeof *shop);
	memset(figures, 0, sizeof *figures);
	for (int kind = 1; shop && kind <= 3 && length == 0; kind++)
		length = write_kind(shop, content, kind, text, text_size, figures);
	free(shop);
	return length;
}

/* ---- reading ---- */

static bool say(char fault[CODE_FAULT_BYTES], const char *what)
{
	snprintf(fault, CODE_FAULT_BYTES, "%s", what);
	return false;
}

bool code_begins(const char *text, size_t size)
{
	return size >= 7 && memcmp(text, head, 7) == 0;
}

static bool skipped(char c)
{
	return c == '\n' || c == '\r' || c == '\t';
}

/* Three characters become two bytes, and two at the end one. Returns their count, -1: a fault. */
static int unbase45(const char *text, size_t size, uint8_t *bytes, char fault[CODE_FAULT_BYTES])
{
	unsigned value = 0, weight = 1;
	int count = 0, held = 0;
	for (size_t i = HEAD; i < size; i++) {
		const char *found = skipped(text[i]) || !text[i] ? NULL : strchr(alphabet, text[i]);
		if (skipped(text[i]))
			continue;
		if (!found) {
			snprintf(fault, CODE_FAULT_BYTES,
				 "character %zu is none of a code's; copy the whole code as it was "
				 "read, from KITSUKE1: to its full stop",
				 i + 1);
			return -1;
		}
		value += (unsigned)(found - alphabet) * weight;
		weight *= 45;
		if (++held < 3)
			continue;
		if (value > 65535) {
			snprintf(
				fault, CODE_FAULT_BYTES,
				"characters %zu to %zu can't stand side by side in a code; read it "
				"once more",
				i - 1, i + 1);
			return -1;
		}
		bytes[count++] = (uint8_t)(value >> 8);
		bytes[count++] = (uint8_t)value;
		value = 0, weight = 1, held = 0;
	}
	if (held == 1 || value > 255) {
		say(fault,
		    "its end does not fit: a part of the code is missing; read it once more");
		return -1;
	}
	if (held == 2)
		bytes[count++] = (uint8_t)value;
	return count;
}

/* As much as a full pattern takes, and not a byte more, however much the code would unfold to. */
static int inflate_all(const uint8_t *bytes, size_t size, uint8_t *raw, size_t room)
{
	z_stream stream = {.next_in = (Bytef *)(uintptr_t)bytes,
			   .avail_in = (uInt)size,
			   .next_out = raw,
			   .avail_out = (uInt)room};
	if (inflateInit2(&stream, -15) != Z_OK)
		return -1;
	bool whole = inflate(&stream, Z_FINISH) == Z_STREAM_END && stream.avail_in == 0;
	int got = (int)(room - stream.avail_out);
	inflateEnd(&stream);
	return whole ? got : -1;
}

static bool read_bytes(struct workshop *shop, struct code_content *content, int count,
		       char fault[CODE_FAULT_BYTES])
{
	uint32_t sum = 0;
	if (count < 6)
		return say(fault, "it is too short for a code; read it once more, all of it");
	for (int i = 0; i < 4; i++)
		sum = sum << 8 | shop->bytes[1 + i];
	if (sum != checksum(shop->bytes, (size_t)count))
		return say(fault, "its checksum does not hold: a character is wrong or missing, "
				  "blanks count; read the code once more");
	int kind = shop->bytes[0];
	if (kind < 1 || kind > 3)
		return say(fault, "it was written by a newer kitsuke; read it with that one");
	int raw = inflate_all(shop->bytes + 5, (size_t)count - 5, shop->raw, sizeof shop->raw);
	if (raw < 0)
		return say(fault, "it unfolds to no pattern of kitsuke's");
	return code_unpack(content, per_mm_of(kind), shop->raw, (size_t)raw, fault);
}

bool code_read(struct code_content *content, const char *text, size_t size,
	       char fault[CODE_FAULT_BYTES])
{
	memset(content, 0, sizeof *content);
	if (!code_begins(text, size))
		return say(fault, "a code begins with KITSUKE1:");
	if (size < HEAD || memcmp(text, head, HEAD) != 0)
		return say(fault, "this code is of another kind than KITSUKE1:; a newer kitsuke "
				  "reads it, if nothing is missing");
	while (size > HEAD && (skipped(text[size - 1]) || text[size - 1] == ' '))
		size--;
	if (text[size - 1] != '.')
		return say(fault,
			   "its end is missing: a code ends with a full stop; copy all of it");
	if (size > CODE_TEXT_MAX)
		return say(fault, "it is longer than any pattern's code");
	struct workshop *shop = malloc(sizeof *shop);
	if (!shop)
		return say(fault, "not enough memory to read a code");
	int count = unbase45(text, size - 1, shop->bytes, fault);
	bool read = count >= 0 && read_bytes(shop, content, count, fault);
	free(shop);
	if (!read)
		memset(content, 0, sizeof *content);
	return read;
}

/* ---- in a picture ---- */

static const uint8_t png_head[8] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};

bool code_is_png(const void *bytes, size_t size)
{
	return size >= sizeof png_head && memcmp(bytes, png_head, sizeof png_head) == 0;
}

/* Chunks are: length of the data (high byte first), four letters, data, CRC-32 of letters and data.
 */
const char *code_in_png(const void *png, size_t size, size_t *text_size,
			char fault[CODE_FAULT_BYTES])
{
	static const char keyword[] = "kitsuke"; /* with its zero */
	const uint8_t *bytes = png;
	for (size_t at = sizeof png_head; size >= 12 && at <= size - 12;) {
		const uint8_t *chunk = bytes + at;
		size_t length = (size_t)chunk[0] << 24 | (size_t)chunk[1] << 16 |
				(size_t)chunk[2] << 8 | chunk[3];
		if (length > size - at - 12)
			break;
		if (memcmp(chunk + 4, "tEXt", 4) == 0 && length > sizeof keyword &&
		    memcmp(chunk + 8, keyword, sizeof keyword) == 0) {
			*text_size = length - sizeof keyword;
			return (const char *)chunk + 8 + sizeof keyword;
		}
		at += length + 12;
	}
	say(fault, "this picture carries no pattern beside what is seen (it was made smaller, or "
		   "taken with a camera): read its QR code with a phone and import that text");
	return NULL;
}
