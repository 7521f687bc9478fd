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
 * headless; what came for KMS. NULL with a line in fault (what, and the remedy). A display on KMS
 * opens without a screen too, as long as there is a card: it takes the one that comes, and
 * width and height are 0. */
struct display *display_open(enum display_kind kind, int *width, int *height, char fault[200]);

/* The picture's own size, and how it is turned on the display, degrees clockwise: 0, 90, 180, 270.
 * It is shown as large as fits (plane_map_fit). Without this call it is as the display is. */
void display_turn(struct display *display, int width, int height, int degrees);

enum display_state {
	DISPLAY_READY, /* draw a frame, then display_present */
	DISPLAY_DARK,  /* nothing to draw on for now: go on without a picture, ask again next frame
			*/
	DISPLAY_GONE,  /* for good: close it */
};

/* Call once before each frame. Keeps the picture on the screen, through cables that are pulled,
 * other programs and GPUs that reset; waits for a flip two frames at most. */
enum display_state display_ready(struct display *display);

/* Counts GL contexts, from 1. When it has changed after display_ready said DISPLAY_READY, whatever
 * was made in GL is gone and must be made anew. */
int display_generation(const struct display *display);

/* The display's own size in px; 0 x 0 while there is none. */
void display_size(const struct display *display, int *width, int *height);

/* Why there is no picture, in words; "" while there is one. */
const char *display_reason(const struct display *display);

/* Shows the frame and waits for the flip (KMS, window) or finishes it (headless). False: the frame
 * was lost, or is late; display_ready knows more. */
bool display_present(struct display *display);

/* DISPLAY_WINDOW: adds the mouse as reports of mouse_descriptor (pen.h) on `device`, the buttons'
 * keys (1 wrap, 2 pin, 3 relax) as reports on `device` + 1; returns false when the window was
 * closed. */
bool display_input(struct display *display, int device, int64_t now_us,
		   struct frame_reports *reports);

/* The frame just drawn, before it is turned, 4 bytes a pixel RGBA, top row first; size width *
 * height * 4. Call before display_present. */
void display_read(struct display *display, uint8_t *rgba);
void display_close(struct display *display);

/* Is there a DRM card that shows pictures and whose master we could be, a desktop session?
 * *taken: there is such a card, but another program holds it. */
bool display_kms_free(bool *taken, char why_not[200]);
bool display_session(void);

#endif
