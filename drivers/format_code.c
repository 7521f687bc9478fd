/* The content of a code, as bytes and back. See format_code.h for the form. */
#include "format_code.h"

#include <stdio.h>

static const int mm_max = 20000; /* nothing lies farther away on a sheet */

/* ---- writing ---- */

struct packer {
	uint8_t *at, *end;
	bool full;
	int per_mm;
};

static void put_byte(struct packer *out, unsigned byte)
{
	if (out->at < out->end)
		*out->at++ = (uint8_t)byte;
	else
		out->full = true;
}

static void put_number(struct packer *out, uint32_t value)
{
	for (; value >= 128; value >>= 7)
		put_byte(out, (value & 127) | 128);
	put_byte(out, value);
}

static uint32_t folded(int32_t value)
{
	return (uint32_t)value << 1 ^ (value < 0 ? UINT32_MAX : 0);
}

static int number_size(uint32_t value)
{
	int size = 1;
	for (; value >= 128; value >>= 7)
		size++;
	return size;
}

static void put_name(struct packer *out, const char *name)
{
	size_t size = 0;
	while (size < NAME_BYTES_MAX - 1 && name[size])
		size++;
	put_number(out, (uint32_t)size);
	for (size_t i = 0; i < size; i++)
		put_byte(out, (unsigned char)name[i]);
}

static int32_t in_steps(float value, int per_unit)
{
	double steps = (double)value * per_unit;
	return (int32_t)(steps < 0.0 ? steps - 0.5 : steps + 0.5);
}

/* What a row's point is expected to be, by those before it. */
static int32_t expected(const int32_t *row, int i, int order)
{
	if (i == 0)
		return 0;
	return order == 1 || i == 1 ? row[i - 1] : 2 * row[i - 1] - row[i - 2];
}

static void put_row(struct packer *out, const int32_t *row, int count)
{
	int size[3] = {0};
	for (int order = 1; order <= 2; order++)
		for (int i = 0; i < count; i++)
			size[order] += number_size(folded(row[i] - expected(row, i, order)));
	int best = size[2] < size[1] ? 2 : 1;
	put_byte(out, (unsigned)best);
	for (int i = 0; i < count; i++)
		put_number(out, folded(row[i] - expected(row, i, best)));
}

static void put_plane(struct packer *out, const struct v2 *point_mm, int count)
{
	int32_t row[OUTLINE_POINTS_MAX];
	for (int axis = 0; axis < 2; axis++) {
		for (int i = 0; i < count; i++)
			row[i] = in_steps(axis ? point_mm[i].y : point_mm[i].x, out->per_mm);
		put_row(out, row, count);
	}
}

static void put_piece(struct packer *out, const struct piece *piece)
{
	uint32_t turn;
	memcpy(&turn, &piece->turn_rad, sizeof turn);
	put_name(out, piece->name);
	put_number(out,
		   (uint32_t)((piece->swatch & 7) | piece->inside_up << 3 | piece->worn_over << 4));
	put_number(out, folded(in_steps(piece->position_mm.x, out->per_mm)));
	put_number(out, folded(in_steps(piece->position_mm.y, out->per_mm)));
	put_number(out, turn);
	put_number(out, (uint32_t)piece->point_count);
	for (int i = 0; i < piece->point_count; i += 8) {
		unsigned bits = 0;
		for (int k = 0; k < 8 && i + k < piece->point_count; k++)
			bits |= (unsigned)piece->corner[i + k] << k;
		put_byte(out, bits);
	}
	put_plane(out, piece->point_mm, piece->point_count);
}

static void put_marks(struct packer *out, const struct code_content *content)
{
	put_number(out, (uint32_t)content->cloth_count);
	for (int m = 0; m < content->cloth_count; m++) {
		const struct cloth_mark *mark = &content->marks.cloth[m];
		put_number(out, (uint32_t)mark->number);
		put_number(out, (uint32_t)mark->piece);
		put_number(out, (uint32_t)mark->point_count);
		put_plane(out, mark->point_mm, mark->point_count);
	}
	put_number(out, (uint32_t)content->body_count);
	for (int m = 0; m < content->body_count; m++) {
		const struct body_mark *mark = &content->marks.body[m];
		int32_t row[3][MARK_POINTS_MAX];
		put_number(out, (uint32_t)mark->number);
		put_number(out, (uint32_t)mark->point_count);
		for (int i = 0; i < mark->point_count; i++) {
			row[0][i] = in_steps(mark->point_m[i].x, 1000 * out->per_mm);
			row[1][i] = in_steps(mark->point_m[i].y, 1000 * out->per_mm);
			row[2][i] = in_steps(mark->point_m[i].z, 1000 * out->per_mm);
		}
		for (int axis = 0; axis < 3; axis++)
			put_row(out, row[axis], mark->point_count);
	}
}

size_t code_pack(const struct code_content *content, int per_mm, uint8_t *raw, size_t raw_size)
{
	struct packer out = {raw, raw + raw_size, false, per_mm};
	put_byte(&out, content->wrapped);
	put_name(&out, content->body);
	put_name(&out, content->fabric);
	put_number(&out, (uint32_t)content->piece_count);
	for (int p = 0; p < content->piece_count; p++)
		put_piece(&out, &content->pattern.piece[p]);
	put_number(&out, (uint32_t)content->seam_count);
	for (int s = 0; s < content->seam_count; s++) {
		const struct seam *seam = &content->pattern.seam[s];
		put_number(&out, (uint32_t)(2 * seam->a.piece + seam->swapped));
		put_number(&out, (uint32_t)seam->a.edge);
		put_number(&out, (uint32_t)seam->b.piece);
		put_number(&out, (uint32_t)seam->b.edge);
	}
	put_marks(&out, content);
	return out.full ? 0 : (size_t)(out.at - raw);
}

/* ---- reading ---- */

struct unpacker {
	const uint8_t *at, *end;
	int per_mm;
	char *fault; /* the first thing that was wrong; "" so far */
};

static void wrong(struct unpacker *in, const char *what, int number)
{
	if (in->fault[0])
		return;
	snprintf(in->fault, CODE_FAULT_BYTES,
		 "the code's content is not sound: %s %d; it was not written by kitsuke, or by a "
		 "newer one",
		 what, number);
	in->at = in->end;
}

static unsigned get_byte(struct unpacker *in)
{
	if (in->at < in->end)
		return *in->at++;
	wrong(in, "it ends too early, byte", 0);
	return 0;
}

static uint32_t get_number(struct unpacker *in)
{
	uint32_t value = 0;
	for (int shift = 0; shift < 35; shift += 7) {
		unsigned byte = get_byte(in);
		if (shift == 28 && byte > 15)
			break;
		value |= (byte & 127) << shift;
		if (byte < 128)
			return value;
	}
	wrong(in, "a number is longer than 32 bits,", 0);
	return 0;
}

static int get_int(struct unpacker *in, int low, int high, const char *what, int number)
{
	uint32_t value = get_number(in);
	if (value >= (uint32_t)low && value <= (uint32_t)high)
		return (int)value;
	wrong(in, what, number);
	return low;
}

static int64_t get_signed(struct unpacker *in)
{
	uint32_t value = get_number(in);
	return (int64_t)(value >> 1) ^ -(int64_t)(value & 1);
}

/* A name is one word of the journal. */
static void get_name(struct unpacker *in, char name[NAME_BYTES_MAX])
{
	int size = get_int(in, 0, NAME_BYTES_MAX - 1, "a name's length", 0);
	memset(name, 0, NAME_BYTES_MAX);
	for (int i = 0; i < size; i++) {
		unsigned byte = get_byte(in);
		if (byte <= ' ' || byte == 0x7f || byte == '*')
			wrong(in, "a name has character", (int)byte);
		name[i] = (char)byte;
	}
}

static float length(int64_t steps, int per_unit)
{
	return (float)((double)steps / per_unit);
}

/* A coordinate that lies too far away is a fault, before sums of them can overflow. */
static void get_row(struct unpacker *in, int32_t *row, int count, const char *what, int number)
{
	int64_t far = (int64_t)mm_max * in->per_mm;
	int order = get_int(in, 1, 2, what, number);
	for (int i = 0; i < count; i++) {
		row[i] = 0;
		int64_t value = expected(row, i, order) + get_signed(in);
		if (value < -far || value > far)
			wrong(in, what, number);
		else
			row[i] = (int32_t)value;
	}
}

static void get_plane(struct unpacker *in, struct v2 *point_mm, int count, const char *what,
		      int number)
{
	int32_t row[2][OUTLINE_POINTS_MAX];
	for (int axis = 0; axis < 2; axis++)
		get_row(in, row[axis], count, what, number);
	for (int i = 0; i < count; i++)
		point_mm[i] = (struct v2){length(row[0][i], in->per_mm),
					  length(row[1][i], in->per_mm)};
}

static float get_place(struct unpacker *in, int number)
{
	int64_t steps = get_signed(in), far = (int64_t)mm_max * in->per_mm;
	if (steps < -far || steps > far)
		wrong(in, "the place of piece", number);
	return length(steps, in->per_mm);
}

static void get_piece(struct unpacker *in, struct piece *piece, int number)
{
	memset(piece, 0, sizeof *piece);
	piece->used = true;
	piece->layer = number + 1;
	get_name(in, piece->name);
	int look = get_int(in, 0, 159, "the colour of piece", number);
	piece->swatch = look & 7;
	piece->inside_up = look >> 3 & 1;
	piece->worn_over = look >> 4;
	piece->position_mm.x = get_place(in, number);
	piece->position_mm.y = get_place(in, number);
	uint32_t turn = get_number(in);
	memcpy(&piece->turn_rad, &turn, sizeof turn);
	if (!(float_abs(piece->turn_rad) <= 100.0f))
		wrong(in, "the turn of piece", number);
	piece->point_count = get_int(in, 3, OUTLINE_POINTS_MAX, "the points of piece", number);
	for (int i = 0; i < piece->point_count; i += 8) {
		unsigned bits = get_byte(in);
		for (int k = 0; k < 8 && i + k < piece->point_count; k++)
			piece->corner[i + k] = bits >> k & 1;
	}
	get_plane(in, piece->point_mm, piece->point_count, "the outline of piece", number);
	const char *fault = in->fault[0] ? NULL : piece_fault(piece);
	if (fault) {
		snprintf(in->fault, CODE_FAULT_BYTES, "piece %d of the code: %s", number, fault);
		in->at = in->end;
	}
}

static void get_edge(struct unpacker *in, const struct code_content *content, int piece,
		     struct edge_ref *ref, int number)
{
	ref->piece = piece;
	ref->edge = 0;
	if (piece >= content->piece_count)
		wrong(in, "no such piece in seam", number);
	else
		ref->edge = get_int(in, 0, piece_edge_count(&content->pattern.piece[piece]) - 1,
				    "no such edge in seam", number);
}

static void get_seam(struct unpacker *in, struct code_content *content, int number)
{
	struct seam *seam = &content->pattern.seam[number];
	uint32_t first = get_number(in);
	seam->used = true;
	seam->swapped = first & 1;
	get_edge(in, content, (int)(first >> 1), &seam->a, number);
	get_edge(in, content, get_int(in, 0, PIECES_MAX - 1, "no such piece in seam", number),
		 &seam->b, number);
}

static void get_cloth_mark(struct unpacker *in, struct code_content *content, int at)
{
	struct cloth_mark *mark = &content->marks.cloth[at];
	mark->used = true;
	mark->number = get_int(in, 1, MARK_NUMBERS - 1, "the number of a mark on cloth,", at);
	mark->piece = get_int(in, 0, int_max(content->piece_count - 1, 0),
			      "no such piece under mark", mark->number);
	if (content->piece_count == 0)
		wrong(in, "no such piece under mark", mark->number);
	mark->point_count = get_int(in, 2, MARK_POINTS_MAX, "the points of mark", mark->number);
	get_plane(in, mark->point_mm, mark->point_count, "the line of mark", mark->number);
}

static void get_body_mark(struct unpacker *in, struct code_content *content, int at)
{
	struct body_mark *mark = &content->marks.body[at];
	int32_t row[3][MARK_POINTS_MAX];
	mark->used = true;
	mark->number = get_int(in, 1, MARK_NUMBERS - 1, "the number of a mark on the body,", at);
	mark->point_count = get_int(in, 2, MARK_POINTS_MAX, "the points of mark", mark->number);
	for (int axis = 0; axis < 3; axis++)
		get_row(in, row[axis], mark->point_count, "the line of mark", mark->number);
	for (int i = 0; i < mark->point_count; i++)
		mark->point_m[i] = (struct v3){length(row[0][i], 1000 * in->per_mm),
					       length(row[1][i], 1000 * in->per_mm),
					       length(row[2][i], 1000 * in->per_mm)};
}

bool code_unpack(struct code_content *content, int per_mm, const uint8_t *raw, size_t raw_size,
		 char fault[CODE_FAULT_BYTES])
{
	struct unpacker in = {raw, raw + raw_size, per_mm, fault};
	memset(content, 0, sizeof *content);
	fault[0] = 0;
	content->wrapped = get_int(&in, 0, 1, "its first byte", 0);
	get_name(&in, content->body);
	get_name(&in, content->fabric);
	content->piece_count = get_int(&in, 0, PIECES_MAX, "the count of pieces", 0);
	for (int p = 0; p < content->piece_count && !fault[0]; p++)
		get_piece(&in, &content->pattern.piece[p], p);
	content->seam_count = get_int(&in, 0, SEAMS_MAX, "the count of seams", 0);
	for (int s = 0; s < content->seam_count && !fault[0]; s++)
		get_seam(&in, content, s);
	content->cloth_count = get_int(&in, 0, MARKS_MAX, "the count of marks", 0);
	for (int m = 0; m < content->cloth_count && !fault[0]; m++)
		get_cloth_mark(&in, content, m);
	content->body_count = get_int(&in, 0, MARKS_MAX, "the count of marks", 0);
	for (int m = 0; m < content->body_count && !fault[0]; m++)
		get_body_mark(&in, content, m);
	if (!fault[0] && in.at != in.end)
		wrong(&in, "bytes left over:", (int)(in.end - in.at));
	return !fault[0];
}
