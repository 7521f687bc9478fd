/* Displays: what is drawn is what is read, top row first; refusals say why; the mouse is a pen. */
#include "display.h"
#include "pen.h"
#include "leaks.h"
#include "test.h"

#include <GLES3/gl3.h>
#include <SDL2/SDL.h>
#include <unistd.h>

enum { WIDTH = 40, HEIGHT = 30 };

static void fill(int x, int y, int w, int h, float red, float green, float blue)
{
	glEnable(GL_SCISSOR_TEST);
	glScissor(x, HEIGHT - y - h, w, h);
	glClearColor(red, green, blue, 1.0f);
	glClear(GL_COLOR_BUFFER_BIT);
	glDisable(GL_SCISSOR_TEST);
}

static bool pixel_is(const uint8_t *rgba, int x, int y, int red, int green, int blue)
{
	const uint8_t *p = rgba + (y * WIDTH + x) * 4;
	return p[0] == red && p[1] == green && p[2] == blue;
}

static bool headless_reads_what_was_drawn(void)
{
	uint8_t rgba[WIDTH * HEIGHT * 4];
	char fault[200];
	int width = WIDTH, height = HEIGHT;
	struct display *display = display_open(DISPLAY_HEADLESS, &width, &height, fault);
	if (!display) {
		printf("no EGL here: %s\n", fault);
		return false;
	}
	fill(0, 0, WIDTH, HEIGHT, 0.0f, 0.0f, 1.0f);
	fill(0, 0, WIDTH, 1, 1.0f, 0.0f, 0.0f);
	fill(7, 20, 3, 2, 0.0f, 1.0f, 0.0f);
	display_read(display, rgba);
	CHECK(pixel_is(rgba, 0, 0, 255, 0, 0) && pixel_is(rgba, WIDTH - 1, 0, 255, 0, 0));
	CHECK(pixel_is(rgba, 0, 1, 0, 0, 255) && pixel_is(rgba, 0, HEIGHT - 1, 0, 0, 255));
	CHECK(pixel_is(rgba, 7, 20, 0, 255, 0) && pixel_is(rgba, 9, 21, 0, 255, 0));
	CHECK(pixel_is(rgba, 6, 20, 0, 0, 255) && pixel_is(rgba, 7, 22, 0, 0, 255));
	CHECK(display_present(display));
	struct frame_reports reports = {0};
	CHECK(display_input(display, 0, 0, &reports) && reports.count == 0);
	display_close(display);
	return true;
}

/* A display opens again after it was closed, as after a lost one. */
static void headless_opens_again(void)
{
	char fault[200];
	for (int i = 0; i < 3; i++) {
		int width = WIDTH, height = HEIGHT;
		struct display *display = display_open(DISPLAY_HEADLESS, &width, &height, fault);
		CHECK(display && display_present(display));
		display_close(display);
	}
}

static void refusals_say_why(void)
{
	char fault[200] = "";
	int width = 1 << 20, height = 16;
	CHECK(!display_open(DISPLAY_HEADLESS, &width, &height, fault));
	CHECK(strstr(fault, "smaller"));
	width = height = 0;
	if (access("/dev/dri/card0", F_OK) != 0) {
		CHECK(!display_open(DISPLAY_KMS, &width, &height, fault));
		CHECK(strstr(fault, "/dev/dri"));
		fault[0] = 0;
		bool taken = true;
		CHECK(!display_kms_free(&taken, fault) && fault[0] && !taken);
	}
}

static void push_mouse(uint32_t type, int x, int y, uint8_t button)
{
	SDL_Event event = {.type = type};
	if (type == SDL_MOUSEMOTION) {
		event.motion.x = x;
		event.motion.y = y;
	} else {
		event.button.button = button;
	}
	SDL_PushEvent(&event);
}

static void push_key(uint32_t type, SDL_Scancode code, SDL_Keycode key)
{
	SDL_Event event = {.type = type};
	event.key.keysym.scancode = code;
	event.key.keysym.sym = key;
	SDL_PushEvent(&event);
}

static int word_at(const struct raw_report *report, int byte)
{
	return report->bytes[byte] | report->bytes[byte + 1] << 8;
}

/* SDL's offscreen driver stands in for a desktop: real window code, real event queue. */
static void mouse_and_keys_become_reports(void)
{
	char fault[200];
	int width = 641, height = 361;
	struct frame_reports reports = {0};
	setenv("SDL_VIDEODRIVER", "offscreen", 1);
	struct display *display = display_open(DISPLAY_WINDOW, &width, &height, fault);
	if (!display) {
		fprintf(stderr, "window not tested: %s\n", fault);
		return;
	}
	display_input(display, 3, 0, &reports);
	reports.count = 0;
	push_mouse(SDL_MOUSEMOTION, 320, 180, 0);
	push_mouse(SDL_MOUSEBUTTONDOWN, 0, 0, SDL_BUTTON_LEFT);
	push_mouse(SDL_MOUSEMOTION, 640, 360, 0);
	push_mouse(SDL_MOUSEBUTTONUP, 0, 0, SDL_BUTTON_LEFT);
	push_key(SDL_KEYDOWN, SDL_SCANCODE_2, SDLK_2);
	push_key(SDL_KEYUP, SDL_SCANCODE_2, SDLK_2);
	CHECK(display_input(display, 3, 1234, &reports));
	CHECK(reports.count == 6);
	const struct raw_report *r = reports.report;
	CHECK(r[0].device == 3 && r[0].size == 7 && r[0].time_us == 1234);
	CHECK(r[0].bytes[0] == 4 && r[1].bytes[0] == 5 && r[2].bytes[0] == 5 && r[3].bytes[0] == 4);
	CHECK(word_at(&r[0], 1) == 16383 && word_at(&r[0], 3) == 16383 && word_at(&r[0], 5) == 0);
	CHECK(word_at(&r[2], 1) == 32767 && word_at(&r[2], 3) == 32767 && word_at(&r[2], 5) > 0);
	CHECK(r[4].device == 4 && r[4].size == 1 && r[4].bytes[0] == 1 << BUTTON_PIN);
	CHECK(r[5].device == 4 && r[5].bytes[0] == 0);
	CHECK(display_present(display));
	push_key(SDL_KEYDOWN, SDL_SCANCODE_ESCAPE, SDLK_ESCAPE);
	CHECK(!display_input(display, 3, 0, &reports));
	display_close(display);
}

int main(void)
{
	if (!headless_reads_what_was_drawn())
		return test_failures ? EXIT_FAILURE : 77;
	headless_opens_again();
	refusals_say_why();
	mouse_and_keys_become_reports();
	return test_end();
}
