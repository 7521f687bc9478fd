/* Marks by named places: where they land, and what is refused. */
#include "format_garment.h"
#include "format_marks.h"
#include "test.h"

static struct pattern pattern;
static struct garment_places places;
static struct design_marks marks;
static char fault[200];

/* A square, 100 mm, and a triangle beside it; in the file y points down. */
static const char garment[] = "{\"format\":\"garment-seams/1\",\"units\":\"mm\",\"instances\":["
			      "{\"id\":\"front\",\"outline\":[[0,0],[0,100],[100,100],[100,0]],"
			      "\"named_vertices\":{\"0\":[\"a\",\"#0\"],\"1\":[\"b\"],\"2\":[\"c\"]"
			      ",\"3\":[\"d\"],\"9\":[\"e\"],"
			      "\"x\":[\"f\"]}},"
			      "{\"id\":\"sleeve.L\",\"outline\":[[0,0],[0,100],[100,100]],\"named_"
			      "vertices\":{\"0\":[\"top\"],"
			      "\"1\":[\"low\", 5]}}],\"seams\":[]}";

static bool read_marks(const char *text)
{
	bool read = format_marks_read(&marks, &pattern, &places, text, strlen(text), fault);
	CHECK(read == (fault[0] == '\0'));
	return read;
}

static void check_point(int mark, int i, double x, double y)
{
	const struct design_mark *m = &marks.mark[mark];
	struct v2 p = m->point_mm[i < 0 ? m->point_count + i : i];
	CHECK_NEAR(p.x, x, 1e-3);
	CHECK_NEAR(p.y, y, 1e-3);
}

static void test_places(void)
{
	CHECK(places.count == 7); /* 9 is no point, "x" no number, 5 no name */
	CHECK(read_marks("# a comment\n\nfront a b on front-centre\r\n"
			 "front a/d c/b/0.25 on back-centre 1 0.5"));
	CHECK(marks.count == 2);
	CHECK(marks.mark[0].piece == 0 && !strcmp(marks.mark[0].landmark, "front-centre"));
	CHECK(marks.mark[0].from == 0.0f && marks.mark[0].to == 0.0f);
	CHECK(marks.mark[1].from == 1.0f && marks.mark[1].to == 0.5f);
	check_point(0, 0, 0, 0);
	check_point(0, -1, 0, -100);
	check_point(1, 0, 50, 0);
	check_point(1, -1, 75, -100);
}

static void test_ways(void)
{
	CHECK(read_marks("front a/d a/d:down on x")); /* to the far rim */
	check_point(0, -1, 50, -100);
	CHECK(read_marks("front b/c b/c:up on x"));
	check_point(0, -1, 50, 0);
	CHECK(read_marks("front a/c a/c:left on x"));
	check_point(0, 0, 50, -50);
	check_point(0, -1, 0, -50);
	CHECK(read_marks("front a a:down on x")); /* along the rim */
	check_point(0, -1, 0, -100);
	CHECK(read_marks("front a a/b:right on x"));
	check_point(0, -1, 100, -50);
	CHECK(read_marks("front a .. c on x")); /* 200 mm round the corner, not 141 across it */
	int count = marks.mark[0].point_count;
	CHECK(count >= 10);
	for (int i = 0; i + 1 < count; i++) { /* evenly */
		struct v2 *p = &marks.mark[0].point_mm[i];
		CHECK(v2_distance(p[0], p[1]) < 200.0f / (float)(count - 1) + 1e-2f);
		CHECK(p->x < 0.1f || p->x > 99.9f || p->y > -0.1f || p->y < -99.9f);
	}
	CHECK(read_marks("front #0 c on x"));
	check_point(0, -1, 100, -100);
}

/* In the second piece the line begins as far before the cloth as the first part is long. */
static void test_across_pieces(void)
{
	CHECK(read_marks("front a b + sleeve.L top low on arm-left-top 0 2"));
	CHECK(marks.count == 2 && marks.mark[1].piece == 1);
	CHECK(!strcmp(marks.mark[1].landmark, "arm-left-top") && marks.mark[0].to == 2.0f);
	check_point(1, 0, 0, 100);
	check_point(1, -1, 0, -100);
}

static void test_pins(void)
{
	CHECK(read_marks("front a b on x\npin sleeve.L top/low\npin front d"));
	CHECK(marks.count == 1 && marks.pin_count == 2 && marks.pin[0].piece == 1);
	CHECK_NEAR(marks.pin[0].point_mm.y, -50, 1e-3);
	CHECK_NEAR(marks.pin[1].point_mm.x, 100, 1e-3);
}

static void test_refusals(void)
{
	static const char *const bad[] = {
		"",
		"# nothing",
		"front a b",
		"front a b on",
		"front a on x",
		"front a a on x",
		"rear a b on x",
		"front a top on x",
		"front a/b/x c on x",
		"front a/b/7 c on x",
		"front a a:up on x",
		"front a a:away on x",
		"front a a:down:down on x",
		"front .. a b on x",
		"front a b on x 1",
		"front a b on x 1 1",
		"front a b on x 1 2 3",
		"front a b on x -1 2",
		"front a b + on x",
		"front a b on x\npin front",
		"front a b on x\npin front a b",
		"front a b on x\npin rear a",
		"pin front a",
		"front a b on x\nfront a b on",
	};
	for (int i = 0; i < COUNT_OF(bad); i++) {
		if (read_marks(bad[i]))
			fprintf(stderr, "accepted: %s\n", bad[i]);
		CHECK(!read_marks(bad[i]) && !strncmp(fault, "line ", 5));
	}
	CHECK(!strncmp(fault, "line 2: ", 8));
	static char text[4096];
	for (int i = 0; i <= MARKS_MAX; i++)
		strcat(text, "front a b on x\n");
	CHECK(!read_marks(text));
	memset(text, 'x', 2000);
	CHECK(!read_marks(text));
}

int main(void)
{
	CHECK(format_garment_read(&pattern, garment, strlen(garment), fault));
	format_places_read(&places, garment, strlen(garment));
	test_places();
	test_ways();
	test_across_pieces();
	test_pins();
	test_refusals();
	format_places_read(&places, "{", 1);
	CHECK(places.count == 0);
	return test_end();
}
