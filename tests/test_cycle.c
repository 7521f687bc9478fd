/* Who is there, who has gone, and what the screen says of it. KITSUKE_PICTURES=DIR keeps pictures.
 */
#include "cycle.h"
#include "leaks.h"
#include "limits.h"
#include "picture.h"
#include "scene.h"
#include "snapshot.h"
#include "test.h"

#include <stdlib.h>

enum { IDLE_S = 60 };

static bool pass(struct cycle *cycle, float x, enum pen_state state, bool begun)
{
	struct frame_input input = {.sample_count = 1};
	input.sample[0].state = state;
	input.sample[0].position_px = (struct v2){x, 100.0f};
	return cycle_frame(cycle, &input, IDLE_S, begun, 1.0f);
}

/* Frames until the state changes, with a pen that lies there and trembles by a pixel. */
static int lie(struct cycle *cycle, bool begun, bool *over)
{
	enum cycle_state state = cycle->state;
	int frames = 0;
	*over = false;
	while (cycle->state == state && frames < 2 * IDLE_S * FRAME_RATE_HZ) {
		*over = pass(cycle, 500.0f + (float)(frames % 2), PEN_HOVER, begun);
		frames++;
	}
	return frames;
}

static void a_visitor_goes(void)
{
	struct cycle cycle = {0};
	bool over;
	pass(&cycle, 100.0f, PEN_TOUCH, true);
	CHECK_NEAR(lie(&cycle, true, &over), (IDLE_S - CYCLE_COUNTDOWN_S) * FRAME_RATE_HZ, 3.0);
	CHECK(cycle.state == CYCLE_COUNTDOWN && cycle.left_s == CYCLE_COUNTDOWN_S && !over);
	CHECK(!pass(&cycle, 540.0f, PEN_HOVER, true)); /* it moves: somebody is there */
	CHECK(cycle.state == CYCLE_VISIT);
	lie(&cycle, true, &over);
	CHECK_NEAR(lie(&cycle, true, &over), CYCLE_COUNTDOWN_S * FRAME_RATE_HZ, 3.0);
	CHECK(over && cycle.state == CYCLE_ATTRACT);
	CHECK(!pass(&cycle, 900.0f, PEN_HOVER, false) && cycle.state == CYCLE_ATTRACT);
	CHECK(!pass(&cycle, 900.0f, PEN_TOUCH, false) && cycle.state == CYCLE_VISIT);
}

/* Nothing made, nothing to lose: no countdown. */
static void nobody_comes(void)
{
	struct cycle cycle = {0};
	struct frame_input none = {0}, button = {.buttons_pressed = 1};
	bool over;
	lie(&cycle, false, &over);
	CHECK(cycle.state == CYCLE_ATTRACT && !over);
	CHECK(!cycle_frame(&cycle, &button, IDLE_S, false, 1.0f) && cycle.state == CYCLE_VISIT);
	for (int i = 0; i < 3 * IDLE_S * FRAME_RATE_HZ; i++)
		CHECK(!cycle_frame(&cycle, &none, 0, true, 1.0f)); /* 0: never */
	CHECK(cycle.state == CYCLE_VISIT);
}

static void keep(struct snapshot *shot, const char *name)
{
	const char *folder = getenv("KITSUKE_PICTURES");
	char path[PATH_BYTES_MAX], fault[FAULT_BYTES];
	display_read(shot->display, shot->rgba);
	if (folder && store_join(path, sizeof path, folder, name, fault))
		CHECK(picture_write_png(path, shot->width, shot->height, shot->rgba, fault));
}

static const uint8_t *at(const struct snapshot *shot, int x, int y)
{
	return shot->rgba + 4 * ((size_t)y * (size_t)shot->width + (size_t)x);
}

/* The card lies over the picture's middle, and nothing of it stays. */
static void card_is_shown(void)
{
	static struct snapshot shot;
	static struct ui ui;
	char fault[FAULT_BYTES];
	if (!snapshot_open(&shot, 1280, 720, fault)) {
		printf("no pictures here: %s\n", fault);
		return;
	}
	struct scene *scene = scene_open();
	ui_init(&ui, shot.width, shot.height);
	snapshot_take(&shot, &ui, &scene->session);
	uint8_t before = at(&shot, 640, 330)[2];
	draw_frame(shot.draw, &ui, &scene->session);
	CHECK(draw_notice(shot.draw, LANGUAGE_BOTH, 9, CYCLE_COUNTDOWN_S, fault));
	keep(&shot, "countdown.png");
	CHECK(at(&shot, 640, 310)[0] == 0xff && at(&shot, 640, 310)[2] == 0xd9);
	draw_frame(shot.draw, &ui, &scene->session);
	CHECK(draw_notice(shot.draw, LANGUAGE_BOTH, 0, CYCLE_COUNTDOWN_S, fault));
	keep(&shot, "attract.png");
	CHECK(at(&shot, 1000, 480)[2] == 0xd9);
	draw_notice_end(shot.draw);
	snapshot_take(&shot, &ui, &scene->session);
	CHECK(at(&shot, 640, 330)[2] == before);
	scene_close(scene);
	snapshot_close(&shot);
}

int main(void)
{
	a_visitor_goes();
	nobody_comes();
	card_is_shown();
	return test_end();
}
