/* The journal: what is written reads back to the same bits; what is damaged is named. */
#include "journal.h"
#include "test.h"

static void test_numbers(void)
{
	uint32_t state = 1;
	char text[64];
	for (int i = 0; i < 200000; i++) {
		state = state * 1664525u + 1013904223u;
		float value, back = 0.0f;
		memcpy(&value, &state, sizeof value);
		if (value - value != 0.0f)
			continue;
		const char *at = text, *end = text + number_write(text, value);
		bool read = number_read(&at, end, &back);
		CHECK(read && at == end && back == value);
	}
	static const struct {
		const char *text;
		float value;
	} plain[] = {{"0.1", 0.1f}, {"598", 598.0f},   {"-25.5", -25.5f},
		     {"1e9", 1e9f}, {"0.001", 0.001f}, {"0.00012345", 0.00012345f}};
	for (int i = 0; i < COUNT_OF(plain); i++) {
		number_write(text, plain[i].value);
		CHECK(strcmp(text, plain[i].text) == 0);
	}
	static const char *const refused[] = {"", "-", ".", "e5", "nan", "inf", "1e39", "0x"};
	for (int i = 0; i < COUNT_OF(refused); i++) {
		const char *at = refused[i], *end = at + strlen(at);
		float value;
		CHECK(!number_read(&at, end, &value) || at != end);
	}
}

/* An edit with every argument of its form filled in. */
static struct edit sample_edit(enum edit_kind kind)
{
	struct edit edit = {.kind = kind};
	int ints = 0, floats = 0;
	for (const char *form = edit_form[kind]; *form; form++) {
		if (*form == 'n')
			memcpy(edit.name, "front", 6);
		else if (*form == 'i')
			edit.i[ints] = -7 + 3 * ints, ints++;
		else if (*form == 'f')
			edit.f[floats] = 0.1f + (float)floats, floats++;
		else
			edit.point_count = 40;
	}
	for (int i = 0; i < edit.point_count; i++) {
		bool solid = strchr(edit_form[kind], '3') != NULL;
		edit.point[i] = (struct v3){(float)i / 3.0f, 1e-4f * (float)i,
					    solid ? -0.7f : 0.0f};
		edit.corner[i] = strchr(edit_form[kind], 'c') && i % 10 == 0;
	}
	return edit;
}

static bool same_edit(const struct edit *a, const struct edit *b)
{
	bool same = a->kind == b->kind && a->point_count == b->point_count &&
		    strcmp(a->name, b->name) == 0;
	for (int i = 0; i < COUNT_OF(a->i); i++)
		same &= a->i[i] == b->i[i] && a->f[i] == b->f[i];
	for (int i = 0; i < a->point_count; i++)
		same &= a->point[i].x == b->point[i].x && a->point[i].y == b->point[i].y &&
			a->point[i].z == b->point[i].z && a->corner[i] == b->corner[i];
	return same;
}

static void test_every_edit(void)
{
	static char line[JOURNAL_LINE_MAX];
	char fault[160];
	for (int kind = 0; kind < EDIT_KIND_COUNT; kind++) {
		struct edit edit = sample_edit((enum edit_kind)kind), back;
		int size = journal_write(&edit, line);
		CHECK(journal_read(line, size, &back, fault) == JOURNAL_EDIT);
		CHECK(same_edit(&edit, &back));
		line[size / 2] ^= 1; /* any flipped bit is noticed */
		CHECK(journal_read(line, size, &back, fault) == JOURNAL_FAULT);
	}
}

static void test_longest_line(void)
{
	static char line[JOURNAL_LINE_MAX];
	struct edit edit = {.kind = EDIT_MARK_BODY, .point_count = EDIT_POINTS_MAX};
	for (int i = 0; i < EDIT_POINTS_MAX; i++)
		edit.point[i] = (struct v3){-1.23456789e-30f, -9.8765432e-30f, -1.1111111e-30f};
	CHECK(journal_write(&edit, line) < JOURNAL_LINE_MAX);
}

static void test_faults(void)
{
	static const struct {
		const char *line;
		enum journal_result result;
		const char *says;
	} cases[] = {
		{"", JOURNAL_NOTHING, ""},
		{"  \r\n", JOURNAL_NOTHING, ""},
		{"# anything", JOURNAL_NOTHING, ""},
		{"kitsuke-journal 1", JOURNAL_NOTHING, ""},
		{"kitsuke-journal 2", JOURNAL_FAULT, "version"},
		{"wrap", JOURNAL_EDIT, ""},
		{"wrap 3", JOURNAL_FAULT, "after the last argument"},
		{"drag 1 2", JOURNAL_FAULT, "a number is missing"},
		{"drag 1 2 x", JOURNAL_FAULT, "a number is missing"},
		{"step 99999999999", JOURNAL_FAULT, "whole number"},
		{"mark-body 1 0 0", JOURNAL_FAULT, "three numbers"},
		{"mark-body 1", JOURNAL_FAULT, "no points"},
		{"outline 0 1 2 3", JOURNAL_FAULT, "corner"},
		{"iron 1", JOURNAL_FAULT, "unknown word \"iron\""},
		{"wrap *12345678", JOURNAL_FAULT, "checksum"},
	};
	for (int i = 0; i < COUNT_OF(cases); i++) {
		struct edit edit;
		char fault[160];
		CHECK(journal_read(cases[i].line, (int)strlen(cases[i].line), &edit, fault) ==
		      cases[i].result);
		CHECK(strstr(fault, cases[i].says) != NULL);
	}
}

int main(void)
{
	test_numbers();
	test_every_edit();
	test_longest_line();
	test_faults();
	return test_end();
}
