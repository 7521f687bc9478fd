/* Where the picture goes: a display on KMS, a desktop window, or memory. One is open at a time. */
#ifndef DISPLAY_H
#define DISPLAY_H

#include "input.h"

enum display_kind {
	DISPLAY_KMS,      /* fullscreen on DRM/KMS through GBM (C2) */
	DISPLAY_WINDOW,   /* a desktop window; its mouse is the pen */
	DISPLAY_HEADLESS, /* surfaceless EGL and a framebuffer object */
};

struct display;

/* Opens a display and makes its GLES context current. width/height: wanted for a window or
 * headless; what came for KMS. NULL with a line in fault (what, and the remedy). */
struct display *display_open(enum display_kind kind, int *width, int *height, char fault[200]);

/* Shows the frame and waits for the flip (KMS, window) or finishes it (headless). False: the
 * display went away; close it, and try to open one again later. */
bool display_present(struct display *display);

/* DISPLAY_WINDOW: adds the mouse as reports of mouse_descriptor (pen.h) on `device`, the buttons'
 * keys (1 wrap, 2 pin, 3 relax) as reports on `device` + 1; returns false when the window was
 * closed. */
bool display_input(struct display *display, int device, int64_t now_us,
		   struct frame_reports *reports);

/* The frame just drawn, 4 bytes a pixel RGBA, top row first; size width * height * 4. Call before
 * display_present. */
void display_read(struct display *display, uint8_t *rgba);
void display_close(struct display *display);

/* Is there a DRM card whose master we could be, a desktop session? */
bool display_kms_free(char why_not[200]);
bool display_session(void);

#endif
