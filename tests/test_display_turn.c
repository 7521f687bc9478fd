/* A turned picture on a panel: each of its corners lies where the map says, as large as fits; what
 * was lost with a GL context is drawn again from the processor's copies, to the last bit. */
#include "display_private.h"
#include "draw.h"
#include "scene.h"
#include "leaks.h"
#include "test.h"

enum { PANEL_W = 96, PANEL_H = 60, SHOT_W = 640, SHOT_H = 360 };

static uint8_t panel[PANEL_W * PANEL_H * 4];

static void fill(int height, int x, int y, int w, int h, float red, float green, float blue)
{
	glEnable(GL_SCISSOR_TEST);
	glScissor(x, height - y - h, w, h);
	glClearColor(red, green, blue, 1.0f);
	glClear(GL_COLOR_BUFFER_BIT);
	glDisable(GL_SCISSOR_TEST);
}

/* Blue, with red, green and white corners of 8 px: all but the lower right one. */
static void corners_draw(int width, int height)
{
	fill(height, 0, 0, width, height, 0.0f, 0.0f, 1.0f);
	fill(height, 0, 0, 8, 8, 1.0f, 0.0f, 0.0f);
	fill(height, width - 8, 0, 8, 8, 0.0f, 1.0f, 0.0f);
	fill(height, 0, height - 8, 8, 8, 1.0f, 1.0f, 1.0f);
}

static uint32_t panel_at(const struct plane_map *map, float x, float y)
{
	struct v2 at = plane_map_apply(map, (struct v2){x, y});
	int px = (int)at.x, py = PANEL_H - 1 - (int)at.y;
	CHECK(px >= 0 && px < PANEL_W && py >= 0 && py < PANEL_H);
	const uint8_t *p = panel + (int_clamp(py, 0, PANEL_H - 1) * PANEL_W +
				    int_clamp(px, 0, PANEL_W - 1)) *
					   4;
	return (uint32_t)(p[0] << 16 | p[1] << 8 | p[2]);
}

static bool corners_turn(int width, int height, int degrees)
{
	char fault[200];
	int w = PANEL_W, h = PANEL_H;
	struct display *display = display_open(DISPLAY_HEADLESS, &w, &h, fault);
	if (!display) {
		printf("no EGL here: %s\n", fault);
		return false;
	}
	display_turn(display, width, height, degrees);
	CHECK(display_ready(display) == DISPLAY_READY && display_generation(display) == 1);
	corners_draw(width, height);
	CHECK(display_present(display));
	glReadPixels(0, 0, PANEL_W, PANEL_H, GL_RGBA, GL_UNSIGNED_BYTE, panel);
	struct v2 size = {(float)width, (float)height};
	struct plane_map map = plane_map_fit(size, degrees, (struct v2){PANEL_W, PANEL_H});
	CHECK(panel_at(&map, 4.5f, 4.5f) == 0xff0000);
	CHECK(panel_at(&map, size.x - 4.5f, 4.5f) == 0x00ff00);
	CHECK(panel_at(&map, 4.5f, size.y - 4.5f) == 0xffffff);
	CHECK(panel_at(&map, size.x - 4.5f, size.y - 4.5f) == 0x0000ff);
	CHECK(panel_at(&map, 0.5f * size.x, 0.5f * size.y) == 0x0000ff);
	display_close(display);
	return true;
}

/* Clockwise: the picture's upper left corner is then the panel's upper right one. */
static void turns_clockwise(void)
{
	struct v2 size = {40.0f, 30.0f}, quarter = {30.0f, 40.0f};
	const struct v2 corner[4] = {{0, 0}, {30, 0}, {40, 30}, {0, 40}};
	for (int i = 0; i < 4; i++) {
		struct plane_map map = plane_map_fit(size, 90 * i, i & 1 ? quarter : size);
		struct v2 at = plane_map_apply(&map, (struct v2){0.0f, 0.0f});
		CHECK(at.x == corner[i].x && at.y == corner[i].y);
	}
	/* a panel that is too wide leaves bars on both sides, one scale */
	struct plane_map map = plane_map_fit(size, 0, (struct v2){100.0f, 60.0f});
	struct v2 at = plane_map_apply(&map, (struct v2){0.0f, 30.0f});
	CHECK(at.x == 10.0f && at.y == 60.0f);
}

/* ---- a lost context ---- */

static bool lose;

/* The linker sends the displays' question here (Makefile). */
bool __real_display_context_lost(void);
bool __wrap_display_context_lost(void);
bool __wrap_display_context_lost(void)
{
	bool lost = lose;
	lose = false;
	return lost || __real_display_context_lost();
}

static void shoot(struct display *display, struct draw *draw, struct scene *scene,
		  const struct ui *ui, uint8_t *rgba)
{
	draw_frame(draw, ui, &scene->session);
	display_read(display, rgba);
}

static void a_lost_context_is_drawn_again(void)
{
	static uint8_t before[SHOT_W * SHOT_H * 4], after[SHOT_W * SHOT_H * 4];
	char fault[200];
	int w = SHOT_W, h = SHOT_H;
	struct scene *scene = scene_open();
	CHECK(scene_play(scene, "tests/journals/tshirt.kitsuke") == 0 && scene_wrap(scene));
	static struct ui ui;
	ui_init(&ui, w, h);
	struct display *display = display_open(DISPLAY_HEADLESS, &w, &h, fault);
	for (int turned = 0; display && turned < 2; turned++) {
		if (turned)
			display_turn(display, SHOT_W, SHOT_H, 180);
		CHECK(display_ready(display) == DISPLAY_READY);
		int generation = display_generation(display);
		struct draw *draw = draw_open(SHOT_W, SHOT_H, fault);
		CHECK(draw);
		shoot(display, draw, scene, &ui, before);
		lose = true;
		CHECK(!display_present(display));
		CHECK(display_ready(display) == DISPLAY_READY);
		CHECK(display_generation(display) == generation + 1);
		draw_close(draw);
		draw = draw_open(SHOT_W, SHOT_H, fault);
		CHECK(draw);
		shoot(display, draw, scene, &ui, after);
		CHECK(memcmp(before, after, sizeof before) == 0);
		CHECK(display_present(display) && glGetError() == GL_NO_ERROR);
		draw_close(draw);
	}
	display_close(display);
	scene_close(scene);
}

int main(void)
{
	turns_clockwise();
	for (int degrees = 0; degrees < 360; degrees += 90) {
		bool quarter = degrees % 180;
		if (!corners_turn(quarter ? PANEL_H : PANEL_W, quarter ? PANEL_W : PANEL_H,
				  degrees))
			return test_failures ? EXIT_FAILURE : 77;
		corners_turn(PANEL_W, PANEL_W, degrees); /* bars */
		corners_turn(2 * PANEL_W, 2 * PANEL_H, degrees);
	}
	a_lost_context_is_drawn_again();
	return test_end();
}
