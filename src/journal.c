#include "journal.h"

static uint32_t checksum(const char *text, int size)
{
	uint32_t value = 2166136261u;
	for (int i = 0; i < size; i++)
		value = (value ^ (unsigned char)text[i]) * 16777619u;
	return value;
}

/* ---- writing ---- */

struct writer {
	char *line;
	int size;
};

static void put_char(struct writer *out, char c)
{
	MUST(out->size < JOURNAL_LINE_MAX - 1);
	out->line[out->size++] = c;
}

static void put_text(struct writer *out, const char *text)
{
	for (; *text; text++)
		put_char(out, *text);
}

static void put_number(struct writer *out, float value)
{
	char text[32];
	put_char(out, ' ');
	number_write(text, value);
	put_text(out, text);
}

static void put_int(struct writer *out, int value)
{
	char reversed[12];
	int count = 0;
	unsigned magnitude = value < 0 ? 0u - (unsigned)value : (unsigned)value;
	put_char(out, ' ');
	if (value < 0)
		put_char(out, '-');
	do {
		reversed[count++] = (char)('0' + magnitude % 10);
	} while ((magnitude /= 10) > 0);
	while (count > 0)
		put_char(out, reversed[--count]);
}

/* A name is one word: blanks become '_', an empty one '-'. */
static void put_name(struct writer *out, const char *name)
{
	put_char(out, ' ');
	if (!name[0])
		put_char(out, '-');
	for (int i = 0; i < NAME_BYTES_MAX - 1 && name[i]; i++) {
		unsigned char c = (unsigned char)name[i];
		put_char(out, c <= ' ' || c == 0x7f || c == '*' ? '_' : name[i]);
	}
}

static void put_points(struct writer *out, const struct edit *edit, char form)
{
	for (int i = 0; i < edit->point_count; i++) {
		put_number(out, edit->point[i].x);
		put_number(out, edit->point[i].y);
		if (form == '3')
			put_number(out, edit->point[i].z);
		if (form == 'c')
			put_int(out, edit->corner[i]);
	}
}

int journal_write(const struct edit *edit, char line[JOURNAL_LINE_MAX])
{
	struct writer out = {line, 0};
	int ints = 0, floats = 0;
	put_text(&out, edit_word[edit->kind]);
	for (const char *form = edit_form[edit->kind]; *form; form++) {
		switch (*form) {
		case 'n':
			put_name(&out, edit->name);
			break;
		case 'i':
			put_int(&out, edit->i[ints++]);
			break;
		case 'f':
			put_number(&out, edit->f[floats++]);
			break;
		default:
			put_points(&out, edit, *form);
		}
	}
	uint32_t sum = checksum(line, out.size);
	put_text(&out, " *");
	for (int shift = 28; shift >= 0; shift -= 4)
		put_char(&out, "0123456789abcdef"[sum >> shift & 15]);
	put_char(&out, '\n');
	line[out.size] = 0;
	return out.size;
}

/* ---- reading ---- */

static void say(char fault[160], const char *a, const char *b, const char *c)
{
	int size = 0;
	const char *part[3] = {a, b, c};
	for (int i = 0; i < 3; i++)
		for (const char *p = part[i]; *p && size < 159; p++)
			fault[size++] = (unsigned char)*p < ' ' ? '?' : *p;
	fault[size] = 0;
}

static bool is_blank(char c)
{
	return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

struct reader {
	const char *at, *end;
};

/* The next word as [*word, return value); empty at the end of the line. */
static const char *next_word(struct reader *in, const char **word)
{
	while (in->at < in->end && is_blank(*in->at))
		in->at++;
	*word = in->at;
	while (in->at < in->end && !is_blank(*in->at))
		in->at++;
	return in->at;
}

static bool read_float(struct reader *in, float *value)
{
	const char *word, *end = next_word(in, &word);
	return word < end && number_read(&word, end, value) && word == end;
}

static bool read_int(struct reader *in, int *value)
{
	const char *word, *end = next_word(in, &word);
	bool negative = word < end && *word == '-';
	word += negative;
	if (word == end || end - word > 9)
		return false;
	int magnitude = 0;
	for (; word < end; word++) {
		if (*word < '0' || *word > '9')
			return false;
		magnitude = magnitude * 10 + (*word - '0');
	}
	*value = negative ? -magnitude : magnitude;
	return true;
}

static bool read_name(struct reader *in, char name[NAME_BYTES_MAX])
{
	const char *word, *end = next_word(in, &word);
	if (word == end || end - word >= NAME_BYTES_MAX)
		return false;
	memset(name, 0, NAME_BYTES_MAX);
	memcpy(name, word, (size_t)(end - word));
	return true;
}

static bool at_end(struct reader *in)
{
	while (in->at < in->end && is_blank(*in->at))
		in->at++;
	return in->at == in->end;
}

/* Points to the end of the line. */
static const char *read_points(struct reader *in, char form, struct edit *edit)
{
	while (!at_end(in)) {
		if (edit->point_count == EDIT_POINTS_MAX)
			return "more than 512 points; draw the line with fewer";
		struct v3 *point = &edit->point[edit->point_count];
		int corner = 0;
		if (!read_float(in, &point->x) || !read_float(in, &point->y))
			return "a point is not two numbers";
		if (form == '3' && !read_float(in, &point->z))
			return "a point on the body is not three numbers";
		if (form == 'c' && (!read_int(in, &corner) || corner < 0 || corner > 1))
			return "after each outline point comes 1 for a corner or 0";
		edit->corner[edit->point_count++] = corner == 1;
	}
	return edit->point_count > 0 ? NULL : "no points; give at least one";
}

static const char *read_arguments(struct reader *in, struct edit *edit)
{
	int ints = 0, floats = 0;
	for (const char *form = edit_form[edit->kind]; *form; form++) {
		const char *wrong = NULL;
		switch (*form) {
		case 'n':
			wrong = read_name(in, edit->name) ? NULL
							  : "a name of 1 to 31 bytes is missing";
			break;
		case 'i':
			wrong = read_int(in, &edit->i[ints++]) ? NULL : "a whole number is missing";
			break;
		case 'f':
			wrong = read_float(in, &edit->f[floats++]) ? NULL : "a number is missing";
			break;
		default:
			wrong = read_points(in, *form, edit);
		}
		if (wrong)
			return wrong;
	}
	return at_end(in) ? NULL : "something follows after the last argument; remove it";
}

/* Cuts a checksum off the end. False: there is one and it does not hold. */
static bool check_sum(const char *line, int *size)
{
	int end = *size;
	while (end > 0 && is_blank(line[end - 1]))
		end--;
	if (end < 9 || line[end - 9] != '*')
		return true;
	uint32_t stated = 0;
	for (int i = end - 8; i < end; i++) {
		char c = line[i];
		int digit = c >= '0' && c <= '9'   ? c - '0'
			    : c >= 'a' && c <= 'f' ? c - 'a' + 10
						   : -1;
		if (digit < 0)
			return false;
		stated = stated << 4 | (uint32_t)digit;
	}
	end -= 9;
	while (end > 0 && is_blank(line[end - 1]))
		end--;
	*size = end;
	return checksum(line, end) == stated;
}

static bool word_is(const char *word, const char *end, const char *text)
{
	size_t size = (size_t)(end - word);
	return strlen(text) == size && memcmp(word, text, size) == 0;
}

static enum journal_result read_header(struct reader *in, char fault[160])
{
	int version = 0;
	if (read_int(in, &version) && version == 1 && at_end(in))
		return JOURNAL_NOTHING;
	say(fault, "this journal has a version that this kitsuke can't read; ",
	    "open it with the kitsuke that wrote it", "");
	return JOURNAL_FAULT;
}

enum journal_result journal_read(const char *line, int size, struct edit *edit, char fault[160])
{
	fault[0] = 0;
	struct reader in = {line, line + size};
	const char *word, *end = next_word(&in, &word);
	if (word == end || *word == '#')
		return JOURNAL_NOTHING;
	if (word_is(word, end, "kitsuke-journal"))
		return read_header(&in, fault);
	if (!check_sum(line, &size)) {
		say(fault, "the line does not match its checksum: it is damaged; ",
		    "remove the checksum if the change was on purpose", "");
		return JOURNAL_FAULT;
	}
	in.end = line + size;
	for (int kind = 0; kind < EDIT_KIND_COUNT; kind++) {
		if (!word_is(word, end, edit_word[kind]))
			continue;
		memset(edit, 0, sizeof *edit);
		edit->kind = (enum edit_kind)kind;
		const char *wrong = read_arguments(&in, edit);
		if (!wrong)
			return JOURNAL_EDIT;
		say(fault, edit_word[kind], ": ", wrong);
		return JOURNAL_FAULT;
	}
	char shown[32] = {0};
	memcpy(shown, word, (size_t)int_min((int)(end - word), 31));
	say(fault, "unknown word \"", shown, "\"; `kitsuke help journal` lists them");
	return JOURNAL_FAULT;
}
