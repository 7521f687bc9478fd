/* Lines of marks: what is the hand's goes, what is the line's stays. */
#include "dress_private.h"
#include "test.h"

enum { POINTS = 44 };

static struct v3 drawn[POINTS], normal[POINTS], steady[MARK_POINTS_MAX], walk[MARK_POINTS_MAX];

/* From top to bottom over a belly 20 mm deep. */
static void draw_centre(void)
{
	for (int i = 0; i < POINTS; i++) {
		float t = (float)i / (POINTS - 1);
		drawn[i] = (struct v3){0.0f, 1.32f - 0.42f * t, 0.1f + 0.08f * t * (1.0f - t)};
		normal[i] = v3_normalize((struct v3){0.0f, 0.19f * (1.0f - 2.0f * t), 1.0f});
	}
}

static float steadied_aside(void)
{
	float most = 0.0f;
	wrap_steady_line(drawn, normal, POINTS, steady);
	for (int i = 0; i < POINTS; i++)
		most = float_max(most, float_abs(steady[i].x));
	return most;
}

/* A pen that lands 24 mm aside and finds the line after three points. */
static void test_hook(void)
{
	draw_centre();
	for (int i = 0; i < 3; i++)
		drawn[i].x = -0.024f + 0.008f * (float)i;
	CHECK(steadied_aside() < 0.002f);
}

/* A hand that trembles by 6 mm: its line lies within 5 and begins within 0.15 rad, three times
 * what is aimed at. */
static void test_tremor(void)
{
	for (uint32_t seed = 1; seed <= 20; seed++) {
		uint32_t state = seed;
		draw_centre();
		for (int i = 0; i < POINTS; i++) {
			state = state * 1664525u + 1013904223u;
			drawn[i].x = 0.012f * ((float)(state >> 8) / (float)(1 << 24) - 0.5f);
		}
		CHECK(steadied_aside() < 0.005f);
		struct v3 way = v3_sub(steady[4], steady[0]);
		CHECK(float_abs(way.x) < 0.15f * v3_length(way));
	}
}

/* Lines that nobody's hand disturbed, straight or round an arm, stay where they are. */
static void test_clean(void)
{
	draw_centre();
	wrap_steady_line(drawn, normal, POINTS, steady);
	for (int i = 0; i < POINTS; i++)
		CHECK(float_abs(steady[i].x) < 1e-6f && v3_distance(steady[i], drawn[i]) < 0.006f);
	for (int i = 0; i < POINTS; i++) {
		float angle = 0.5f * PI_F * (float)i / (POINTS - 1);
		drawn[i] = (struct v3){0.2f * angle_cos(angle), 0.2f * angle_sin(angle), 0.0f};
	}
	wrap_steady_line(drawn, NULL, POINTS, steady);
	for (int i = 0; i < POINTS; i++)
		CHECK(v3_distance(steady[i], drawn[i]) < 0.006f);
}

/* Equal steps from the first point to the last, whatever the hand did on one spot. */
static void test_walk(void)
{
	draw_centre();
	for (int i = 10; i < 20; i++)
		drawn[i] = v3_add(drawn[10], (struct v3){0.0f, i & 1 ? 0.003f : -0.003f, 0.0f});
	int count = wrap_walk_line(drawn, POINTS, walk);
	CHECK(count > 20 && count < MARK_POINTS_MAX);
	CHECK(v3_distance(walk[0], drawn[0]) == 0.0f);
	CHECK(v3_distance(walk[count - 1], drawn[POINTS - 1]) == 0.0f);
	float step = v3_distance(walk[0], walk[1]);
	for (int i = 1; i + 2 < count; i++)
		CHECK_NEAR(v3_distance(walk[i], walk[i + 1]), step, 1e-4f);
	float last = v3_distance(walk[count - 2], walk[count - 1]);
	CHECK(last > 0.49f * step && last < 1.51f * step);
	/* Everything on one point is still a line. */
	for (int i = 0; i < POINTS; i++)
		drawn[i] = (struct v3){1.0f, 1.0f, 1.0f};
	CHECK(wrap_walk_line(drawn, POINTS, walk) == 2);
}

int main(void)
{
	test_hook();
	test_tremor();
	test_clean();
	test_walk();
	return test_end();
}
