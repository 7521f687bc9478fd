#include "format_bones.h"

#include "journal.h"

#include <stdio.h>
#include <stdlib.h>

static const float length_least_m = 0.001f, reach_m = 100.0f;

/* In the order in which a body has them. */
static const struct {
	const char *word;
	enum body_part part;
} words[] = {
	{"spine", PART_TRUNK},         {"neck", PART_HEAD},           {"head", PART_HEAD},
	{"arm-left", PART_ARM_LEFT},   {"arm-right", PART_ARM_RIGHT}, {"leg-left", PART_LEG_LEFT},
	{"leg-right", PART_LEG_RIGHT}, {"girdle", PART_TRUNK},
};

enum { WORD_GIRDLE = COUNT_OF(words) - 1, WORD_BYTES_MAX = 31, VALUES_MAX = 7 };

struct reader {
	const char *at, *end; /* of the line */
	int line;
	int word[BODY_BONES_MAX]; /* of each bone */
	char *fault;
};

static bool fail(const struct reader *in, const char *what)
{
	snprintf(in->fault, 200, "line %d: %s", in->line, what);
	return false;
}

static bool is_blank(char c)
{
	return c == ' ' || c == '\t' || c == '\r';
}

static bool at_end(struct reader *in)
{
	while (in->at < in->end && is_blank(*in->at))
		in->at++;
	return in->at == in->end || *in->at == '#';
}

/* The word's place in the table, COUNT_OF(words) when it is none. */
static int read_word(struct reader *in)
{
	const char *begin = in->at;
	while (in->at < in->end && !is_blank(*in->at))
		in->at++;
	int i = 0;
	size_t size = (size_t)(in->at - begin);
	while (i < COUNT_OF(words) &&
	       (strlen(words[i].word) != size || memcmp(words[i].word, begin, size) != 0))
		i++;
	return i;
}

static bool read_values(struct reader *in, struct bone *bone)
{
	float value[VALUES_MAX] = {0};
	int count = 0;
	while (!at_end(in)) {
		if (count == VALUES_MAX)
			return fail(in, "something follows the bone's radius; remove it");
		if (!number_read(&in->at, in->end, &value[count]) ||
		    (in->at < in->end && !is_blank(*in->at)))
			return fail(in, "a number is wanted: metres, with a point, like 0.25");
		if (!(float_abs(value[count++]) < reach_m))
			return fail(in, "a bone lies more than 100 m away; coordinates are metres");
	}
	if (count < 6)
		return fail(in, "a bone has two ends: x y z x y z in metres");
	bone->a_m = (struct v3){value[0], value[1], value[2]};
	bone->b_m = (struct v3){value[3], value[4], value[5]};
	bone->radius_m = value[6];
	if (v3_distance(bone->a_m, bone->b_m) < length_least_m)
		return fail(in, "the bone's two ends are the same place; a bone is at least 1 mm "
				"long");
	return bone->radius_m >= 0.0f || fail(in, "a radius is not negative");
}

/* Puts the bone behind those of its word. */
static void insert(struct reader *in, struct bone_list *bones, int word, const struct bone *bone)
{
	int i = bones->count++;
	for (; i > 0 && in->word[i - 1] > word; i--) {
		in->word[i] = in->word[i - 1];
		bones->bone[i] = bones->bone[i - 1];
		bones->line[i] = bones->line[i - 1];
	}
	in->word[i] = word;
	bones->bone[i] = *bone;
	bones->line[i] = in->line;
}

static bool read_line(struct reader *in, struct bone_list *bones)
{
	struct bone bone;
	if (at_end(in))
		return true;
	int word = read_word(in);
	if (word == COUNT_OF(words))
		return fail(in, "a bone begins with spine, neck, head, arm-left, arm-right, "
				"leg-left, leg-right or girdle");
	if (bones->count == BODY_BONES_MAX)
		return fail(in, "more than 32 bones; leave the least ones out");
	if (!read_values(in, &bone))
		return false;
	bone.part = words[word].part;
	insert(in, bones, word, &bone);
	return true;
}

static bool is_header(const struct reader *in)
{
	size_t size = strlen(BONES_HEADER) - 1, length = (size_t)(in->end - in->at);
	while (length > 0 && is_blank(in->at[length - 1]))
		length--;
	return length == size && memcmp(in->at, BONES_HEADER, size) == 0;
}

bool format_bones_read(struct bone_list *bones, const char *text, size_t size, char fault[200])
{
	struct reader in = {.fault = fault};
	const char *end = text + size;
	bool headed = false;
	memset(bones, 0, sizeof *bones);
	fault[0] = 0;
	for (const char *line = text; line < end; line = in.end + 1) {
		const char *feed = memchr(line, '\n', (size_t)(end - line));
		in.at = line;
		in.end = feed ? feed : end;
		in.line++;
		if (!headed && !is_header(&in))
			return fail(&in, "a bones file begins with the line `kitsuke-bones 1`");
		if (headed && !read_line(&in, bones))
			return false;
		headed = true;
	}
	in.line = int_max(in.line, 1);
	if (!headed)
		return fail(&in, "the file is empty; a bones file begins with `kitsuke-bones 1`");
	if (bones->count == 0 || in.word[0] != 0)
		return fail(&in, "there is no spine; give at least one `spine` bone");
	return true;
}

/* ---- writing ---- */

/* The spine is the first run of bones of the trunk, the neck the first bone of the head. */
static const char *word_of(const struct bone_list *bones, int b)
{
	enum body_part part = bones->bone[b].part;
	bool first = b == 0 || bones->bone[b - 1].part != part;
	for (int i = 0; i < b && part == PART_TRUNK; i++)
		if (bones->bone[i].part != PART_TRUNK)
			return words[WORD_GIRDLE].word;
	for (int i = 0; i < COUNT_OF(words); i++)
		if (words[i].part == part)
			return words[part == PART_HEAD && !first ? i + 1 : i].word;
	must_fail("a bone of no part", __FILE__, __LINE__);
}

char *format_bones_write(const struct bone_list *bones, size_t *size)
{
	enum { LINE_BYTES = 160 };
	size_t room = strlen(BONES_HEADER) + (size_t)bones->count * LINE_BYTES + 1;
	char *text = malloc(room);
	if (!text)
		return NULL;
	char *out = text + sprintf(text, "%s", BONES_HEADER);
	for (int b = 0; b < bones->count; b++) {
		const struct bone *bone = &bones->bone[b];
		const float value[VALUES_MAX] = {bone->a_m.x,   bone->a_m.y, bone->a_m.z,
						 bone->b_m.x,   bone->b_m.y, bone->b_m.z,
						 bone->radius_m};
		out += sprintf(out, "%-10s", word_of(bones, b));
		for (int i = 0; i < VALUES_MAX; i++) {
			*out++ = ' ';
			out += number_write(out, value[i]);
		}
		*out++ = '\n';
	}
	*out = 0;
	*size = (size_t)(out - text);
	return text;
}
