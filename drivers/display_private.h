/* What the three kinds of display share: a table of verbs, and EGL's context. */
#ifndef DISPLAY_PRIVATE_H
#define DISPLAY_PRIVATE_H

#include "display.h"
#include "display_turn.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>

struct display_verbs {
	enum display_state (*ready)(struct display *display); /* NULL: always */
	const char *(*reason)(const struct display *display); /* NULL: none */
	bool (*present)(struct display *display);
	bool (*input)(struct display *display, int device, int64_t now_us,
		      struct frame_reports *reports);
	void (*close)(struct display *display);
};

/* The first member of each kind's own struct. */
struct display {
	const struct display_verbs *verbs;
	/* the kind's: size in px, framebuffer, contexts made so far; 0 x 0: there is none yet */
	int panel_width, panel_height;
	GLuint panel;
	int contexts;
	/* the door's: the picture, on the panel by the turn when that isn't plain */
	int width, height, degrees;
	struct turn turn;
	int generation, context; /* context: for which the turn was decided; 0: not yet */
	int turn_context;        /* that its objects are in */
};

struct display *display_headless_open(int *width, int *height, char fault[200]);
struct display *display_window_open(int *width, int *height, char fault[200]);
struct display *display_kms_open(int *width, int *height, char fault[200]);

/* A GLES 3.0 context for a display that eglInitialize has accepted. Asks for a context that tells
 * of GPU resets where the driver can. `config` may be EGL_NO_CONFIG_KHR. */
EGLContext display_context(EGLDisplay egl, EGLConfig config);

/* Has the GPU lost our context (reset, hang)? */
bool display_context_lost(void);
bool display_extension(const char *list, const char *name);

#endif
