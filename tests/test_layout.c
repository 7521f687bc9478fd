/* Every target of every step on every shape of screen: on the screen, apart from each other, large
 * enough to touch, and hit where it is drawn. */
#include "test.h"
#include "ui.h"

static const int screen[][2] = {
	{1920, 1080}, {1280, 720},  {800, 480},   {640, 360},
	{1024, 768},  {1080, 1920}, {3840, 2160}, {320, 180},
};

static bool inside(struct rect a, struct rect outer)
{
	return a.x >= outer.x && a.y >= outer.y && a.x + a.w <= outer.x + outer.w &&
	       a.y + a.h <= outer.y + outer.h;
}

static bool apart(struct rect a, struct rect b)
{
	return a.w == 0 || b.w == 0 || a.x + a.w <= b.x || b.x + b.w <= a.x || a.y + a.h <= b.y ||
	       b.y + b.h <= a.y;
}

static void check_targets(const struct layout *l)
{
	struct rect whole = {0, 0, l->width, l->height};
	for (int i = 1; i < TARGET_COUNT; i++) {
		struct rect a = l->target[i];
		if (a.w == 0)
			continue;
		CHECK(inside(a, whole));
		CHECK(apart(a, l->hint) && apart(a, l->meter));
		for (int k = i + 1; k < TARGET_COUNT; k++)
			CHECK(apart(a, l->target[k]));
		struct v2 first = {(float)a.x, (float)a.y};
		struct v2 last = {(float)(a.x + a.w) - 0.5f, (float)(a.y + a.h) - 0.5f};
		CHECK(layout_hit(l, first) == (enum target)i);
		CHECK(layout_hit(l, last) == (enum target)i);
		CHECK(layout_hit(l, (struct v2){first.x - 0.5f, first.y}) != (enum target)i);
		CHECK(layout_hit(l, (struct v2){first.x, last.y + 0.5f}) != (enum target)i);
		/* Nothing smaller than 9 mm is touched; other shapes lose a little to air. */
		if (l->width * 9 == l->height * 16 && l->width >= 640) {
			CHECK((float)a.w * l->mm_per_px >= 9.0f);
			CHECK((float)a.h * l->mm_per_px >= 9.0f);
		}
	}
}

static void check_panes(const struct layout *l)
{
	CHECK(l->left.x == 0 && l->left.x + l->left.w == l->right.x);
	CHECK(l->right.x + l->right.w == l->width && l->bar.w == l->width);
	CHECK(l->bar.y == 0 && l->bar.h == l->left.y && l->left.y == l->right.y);
	CHECK(l->left.h == l->right.h && l->left.y + l->left.h == l->bottom.y);
	CHECK(l->bottom.y + l->bottom.h == l->height && l->bottom.w == l->width);
	CHECK(inside(l->hint, l->right));
	for (int i = 0; i < 3; i++)
		CHECK(inside(l->target[TARGET_WRAP + i], l->bottom) &&
		      inside(l->target[TARGET_VIEW_FRONT + i], l->left));
}

/* What a step shows, and that the rest is nowhere. */
static void check_steps(void)
{
	static const enum target tool[] = {TARGET_COPY,  TARGET_DELETE, TARGET_SWAP,
					   TARGET_LASER, TARGET_ERASE,  TARGET_SWATCH_0};
	static const bool shown[STEP_COUNT][6] = {
		[STEP_DRAW] = {true, true, false, false, false, true},
		[STEP_SEW] = {false, true, true, false, false, false},
		[STEP_MARK] = {false, false, false, true, true, false},
	};
	struct layout l;
	for (int step = 0; step < STEP_COUNT; step++) {
		layout_make(&l, 1280, 720, (enum step)step, false);
		for (int i = 0; i < COUNT_OF(tool); i++)
			CHECK((l.target[tool[i]].w > 0) == shown[step][i]);
		CHECK((l.meter.w > 0) == (step >= STEP_DRESS));
		for (int i = TARGET_STEP_DRAW; i <= TARGET_VIEW_BACK; i++)
			CHECK(l.target[i].w > 0);
	}
}

static void check_hands(void)
{
	struct layout right, left;
	layout_make(&right, 1920, 1080, STEP_DRAW, false);
	layout_make(&left, 1920, 1080, STEP_DRAW, true);
	for (int i = TARGET_WRAP; i <= TARGET_RELAX; i++)
		CHECK(memcmp(&right.target[i], &left.target[i], sizeof left.target[i]) == 0);
	CHECK(right.target[TARGET_SWATCH_0].x > left.target[TARGET_SWATCH_0].x);
	CHECK(right.target[TARGET_VIEW_BACK].x < left.target[TARGET_VIEW_BACK].x);
}

int main(void)
{
	struct layout l;
	for (int i = 0; i < COUNT_OF(screen); i++)
		for (int step = 0; step < STEP_COUNT; step++)
			for (int hand = 0; hand < 2; hand++) {
				layout_make(&l, screen[i][0], screen[i][1], (enum step)step, hand);
				check_targets(&l);
				check_panes(&l);
			}
	check_steps();
	check_hands();
	return test_end();
}
