/* One door to three kinds of display, and what they share of EGL and GL. */
#include "display.h"
#include "display_private.h"

#include <GLES3/gl3.h>
#include <GLES2/gl2ext.h>
#include <stdio.h>
#include <stdlib.h>

struct display *display_open(enum display_kind kind, int *width, int *height, char fault[200])
{
	MUST(kind == DISPLAY_KMS || (*width > 0 && *height > 0));
	fault[0] = 0;
	switch (kind) {
	case DISPLAY_KMS:
		return display_kms_open(width, height, fault);
	case DISPLAY_WINDOW:
		return display_window_open(width, height, fault);
	case DISPLAY_HEADLESS:
		return display_headless_open(width, height, fault);
	}
	return NULL;
}

static bool plain(const struct display *display)
{
	return display->width == 0 ||
	       (display->degrees == 0 && display->width == display->panel_width &&
		display->height == display->panel_height);
}

void display_turn(struct display *display, int width, int height, int degrees)
{
	MUST(width > 0 && height > 0);
	display->width = width;
	display->height = height;
	display->degrees = degrees;
	display->context = 0;
}

/* The turn of an older context went with it. */
static bool turn_follow(struct display *display)
{
	if (display->context == display->contexts)
		return true;
	if (display->turn.framebuffer && display->turn_context == display->contexts)
		turn_close(&display->turn);
	display->turn = (struct turn){0};
	if (!plain(display) &&
	    !turn_open(&display->turn, display->width, display->height, display->degrees,
		       display->panel_width, display->panel_height))
		return false;
	display->context = display->turn_context = display->contexts;
	display->generation++;
	return true;
}

enum display_state display_ready(struct display *display)
{
	const struct display_verbs *verbs = display->verbs;
	enum display_state state = verbs->ready ? verbs->ready(display) : DISPLAY_READY;
	if (state != DISPLAY_READY)
		return state;
	if (!turn_follow(display))
		return DISPLAY_DARK;
	glBindFramebuffer(GL_FRAMEBUFFER,
			  display->turn.framebuffer ? display->turn.framebuffer : display->panel);
	return DISPLAY_READY;
}

int display_generation(const struct display *display)
{
	return display->generation;
}

void display_size(const struct display *display, int *width, int *height)
{
	*width = display->panel_width;
	*height = display->panel_height;
}

const char *display_reason(const struct display *display)
{
	const char *reason = display->verbs->reason ? display->verbs->reason(display) : "";
	if (!reason[0] && display->contexts && display->context != display->contexts)
		return "the GPU draws no picture of this size: choose a smaller mode";
	return reason;
}

bool display_present(struct display *display)
{
	if (display->turn.framebuffer)
		turn_show(&display->turn, display->panel);
	return display->verbs->present(display);
}

bool display_input(struct display *display, int device, int64_t now_us,
		   struct frame_reports *reports)
{
	return !display->verbs->input || display->verbs->input(display, device, now_us, reports);
}

void display_close(struct display *display)
{
	if (display)
		display->verbs->close(display);
}

/* GL counts rows from the bottom; pictures from the top. Rows are swapped in place. */
void display_read(struct display *display, uint8_t *rgba)
{
	int width = display->width ? display->width : display->panel_width;
	int height = display->height ? display->height : display->panel_height;
	glPixelStorei(GL_PACK_ALIGNMENT, 1);
	glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, rgba);
	for (int top = 0; top < height / 2; top++) {
		uint32_t *a = (uint32_t *)(void *)(rgba + (size_t)top * (size_t)width * 4);
		uint32_t *b = (uint32_t *)(void *)(rgba +
						   (size_t)(height - 1 - top) * (size_t)width * 4);
		for (int x = 0; x < width; x++) {
			uint32_t keep = a[x];
			a[x] = b[x];
			b[x] = keep;
		}
	}
}

/* The environment that a desktop gives its programs; SDL looks at the same. */
bool display_session(void)
{
	const char *wayland = getenv("WAYLAND_DISPLAY"), *x11 = getenv("DISPLAY");
	return (wayland && *wayland) || (x11 && *x11);
}

bool display_extension(const char *list, const char *name)
{
	size_t length = strlen(name);
	while (list && *list) {
		size_t word = strcspn(list, " ");
		if (word == length && !memcmp(list, name, length))
			return true;
		list += word + strspn(list + word, " ");
	}
	return false;
}

EGLContext display_context(EGLDisplay egl, EGLConfig config)
{
	static const EGLint robust[] = {EGL_CONTEXT_MAJOR_VERSION,
					3,
					EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY_EXT,
					EGL_LOSE_CONTEXT_ON_RESET_EXT,
					EGL_CONTEXT_OPENGL_ROBUST_ACCESS_EXT,
					EGL_FALSE,
					EGL_NONE};
	static const EGLint plain[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_NONE};
	EGLContext context = EGL_NO_CONTEXT;
	eglBindAPI(EGL_OPENGL_ES_API);
	if (display_extension(eglQueryString(egl, EGL_EXTENSIONS),
			      "EGL_EXT_create_context_robustness"))
		context = eglCreateContext(egl, config, EGL_NO_CONTEXT, robust);
	if (context == EGL_NO_CONTEXT)
		context = eglCreateContext(egl, config, EGL_NO_CONTEXT, plain);
	return context;
}

bool display_context_lost(void)
{
	static PFNGLGETGRAPHICSRESETSTATUSEXTPROC status;
	static bool looked;
	if (!looked) {
		looked = true;
		if (display_extension((const char *)glGetString(GL_EXTENSIONS),
				      "GL_EXT_robustness"))
			status = (PFNGLGETGRAPHICSRESETSTATUSEXTPROC)eglGetProcAddress(
				"glGetGraphicsResetStatusEXT");
	}
	return status && status() != GL_NO_ERROR;
}
