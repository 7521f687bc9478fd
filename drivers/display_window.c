/* A desktop window for people without a station: its mouse is the pen, its keys 1, 2, 3 the
 * buttons. Both go the way of every device, as raw reports of a descriptor (pen.h), so that a tape
 * recorded on a desktop is a tape like any other. */
#include "display_private.h"

#include <SDL2/SDL.h>
#include <stdio.h>
#include <stdlib.h>

enum { MOUSE_TIP = 1, MOUSE_BARREL = 2, MOUSE_IN_RANGE = 4, MOUSE_SPAN = 32767, MOUSE_FULL = 2048 };

struct window {
	struct display base;
	SDL_Window *window;
	SDL_GLContext context;
	uint8_t mouse, buttons; /* bits of the last reports */
	int x, y;
	bool lost;
};

static bool window_present(struct display *display)
{
	struct window *window = (struct window *)display;
	SDL_GL_SwapWindow(window->window);
	window->lost = display_context_lost();
	return !window->lost;
}

static enum display_state window_ready(struct display *display)
{
	struct window *window = (struct window *)display;
	if (!window->lost)
		return DISPLAY_READY;
	if (window->context)
		SDL_GL_DeleteContext(window->context);
	window->context = SDL_GL_CreateContext(window->window);
	if (!window->context)
		return DISPLAY_DARK;
	SDL_GL_SetSwapInterval(1);
	window->lost = false;
	display->contexts++;
	return DISPLAY_READY;
}

static struct raw_report *report_take(struct frame_reports *reports, int device, int64_t now_us,
				      int size)
{
	if (reports->count >= FRAME_REPORTS_MAX)
		return NULL;
	struct raw_report *report = &reports->report[reports->count++];
	*report = (struct raw_report){.device = device, .time_us = now_us, .size = size};
	return report;
}

static void mouse_report(const struct window *window, int device, int64_t now_us,
			 struct frame_reports *reports)
{
	struct raw_report *report = report_take(reports, device, now_us, 7);
	if (!report)
		return;
	int x = window->x * MOUSE_SPAN / int_max(window->base.panel_width - 1, 1);
	int y = window->y * MOUSE_SPAN / int_max(window->base.panel_height - 1, 1);
	int pressure = window->mouse & MOUSE_TIP ? MOUSE_FULL : 0;
	const int word[3] = {int_clamp(x, 0, MOUSE_SPAN), int_clamp(y, 0, MOUSE_SPAN), pressure};
	report->bytes[0] = window->mouse;
	for (int i = 0; i < 3; i++) {
		report->bytes[1 + 2 * i] = (uint8_t)(word[i] & 255);
		report->bytes[2 + 2 * i] = (uint8_t)(word[i] >> 8);
	}
}

static void buttons_report(struct window *window, int device, int64_t now_us, uint8_t buttons,
			   struct frame_reports *reports)
{
	struct raw_report *report = buttons == window->buttons
					    ? NULL
					    : report_take(reports, device, now_us, 1);
	if (report) {
		window->buttons = buttons;
		report->bytes[0] = buttons;
	}
}

/* The bit of a key, by its place: layouts move the digits, but not these. */
static uint8_t key_bit(SDL_Scancode code)
{
	switch (code) {
	case SDL_SCANCODE_1:
	case SDL_SCANCODE_KP_1:
		return 1u << BUTTON_WRAP;
	case SDL_SCANCODE_2:
	case SDL_SCANCODE_KP_2:
		return 1u << BUTTON_PIN;
	case SDL_SCANCODE_3:
	case SDL_SCANCODE_KP_3:
		return 1u << BUTTON_RELAX;
	default:
		return 0;
	}
}

/* Mouse bits after an event; a mouse over the window is a pen in range. */
static uint8_t mouse_after(const SDL_Event *event, uint8_t mouse)
{
	uint8_t bit = 0;
	if (event->type == SDL_MOUSEBUTTONDOWN || event->type == SDL_MOUSEBUTTONUP)
		bit = event->button.button == SDL_BUTTON_LEFT    ? MOUSE_TIP
		      : event->button.button == SDL_BUTTON_RIGHT ? MOUSE_BARREL
								 : 0;
	if (event->type == SDL_WINDOWEVENT && event->window.event == SDL_WINDOWEVENT_LEAVE)
		return mouse & MOUSE_TIP ? mouse : 0;
	if (event->type == SDL_MOUSEBUTTONDOWN)
		return (uint8_t)(mouse | bit | MOUSE_IN_RANGE);
	if (event->type == SDL_MOUSEBUTTONUP)
		return (uint8_t)(mouse & ~bit);
	return event->type == SDL_MOUSEMOTION ? (uint8_t)(mouse | MOUSE_IN_RANGE) : mouse;
}

static bool window_input(struct display *display, int device, int64_t now_us,
			 struct frame_reports *reports)
{
	struct window *window = (struct window *)display;
	SDL_Event event;
	/* What does not fit into this frame's reports stays in SDL's queue for the next. */
	while (reports->count < FRAME_REPORTS_MAX && SDL_PollEvent(&event)) {
		uint8_t mouse = mouse_after(&event, window->mouse), buttons = window->buttons;
		bool moved = event.type == SDL_MOUSEMOTION;
		if (moved) {
			window->x = event.motion.x;
			window->y = event.motion.y;
		} else if (event.type == SDL_KEYDOWN) {
			buttons |= key_bit(event.key.keysym.scancode);
		} else if (event.type == SDL_KEYUP) {
			buttons &= (uint8_t)~key_bit(event.key.keysym.scancode);
		}
		if (event.type == SDL_QUIT ||
		    (event.type == SDL_KEYDOWN && event.key.keysym.sym == SDLK_ESCAPE))
			return false;
		if (moved || mouse != window->mouse) {
			window->mouse = mouse;
			mouse_report(window, device, now_us, reports);
		}
		buttons_report(window, device + 1, now_us, buttons, reports);
	}
	return true;
}

static void window_close(struct display *display)
{
	struct window *window = (struct window *)display;
	if (window->context)
		SDL_GL_DeleteContext(window->context);
	if (window->window)
		SDL_DestroyWindow(window->window);
	SDL_QuitSubSystem(SDL_INIT_VIDEO);
	SDL_Quit();
	free(window);
}

static const struct display_verbs window_verbs = {
	.ready = window_ready,
	.present = window_present,
	.input = window_input,
	.close = window_close,
};

static bool window_make(struct window *window)
{
	if (SDL_Init(SDL_INIT_VIDEO) < 0)
		return false;
	SDL_GL_SetAttribute(SDL_GL_CONTEXT_PROFILE_MASK, SDL_GL_CONTEXT_PROFILE_ES);
	SDL_GL_SetAttribute(SDL_GL_CONTEXT_MAJOR_VERSION, 3);
	SDL_GL_SetAttribute(SDL_GL_CONTEXT_MINOR_VERSION, 0);
	SDL_GL_SetAttribute(SDL_GL_DEPTH_SIZE, 24);
	SDL_GL_SetAttribute(SDL_GL_DOUBLEBUFFER, 1);
	window->window = SDL_CreateWindow("着付け kitsuke", SDL_WINDOWPOS_CENTERED,
					  SDL_WINDOWPOS_CENTERED, window->base.panel_width,
					  window->base.panel_height, SDL_WINDOW_OPENGL);
	window->context = window->window ? SDL_GL_CreateContext(window->window) : NULL;
	if (!window->context)
		return false;
	SDL_GL_SetSwapInterval(1);
	return true;
}

struct display *display_window_open(int *width, int *height, char fault[200])
{
	struct window *window = calloc(1, sizeof *window);
	if (!window) {
		snprintf(fault, 200, "no memory for a window");
		return NULL;
	}
	window->base = (struct display){.verbs = &window_verbs,
					.panel_width = *width,
					.panel_height = *height,
					.contexts = 1};
	if (!window_make(window)) {
		snprintf(fault, 200,
			 "no window (%.120s): start it inside a desktop session with GLES 3.0",
			 SDL_GetError());
		window_close(&window->base);
		return NULL;
	}
	return &window->base;
}
