/* A display in memory: an EGL without any surface, and a framebuffer object in the screen's place.
 * Mesa's surfaceless platform first (software rendering needs nothing else); then EGL's device
 * platform, the way NVIDIA's driver does without a window system. */
#include "display_private.h"

#include <stdio.h>
#include <stdlib.h>

enum { EGL_DEVICES_MAX = 16 };

struct headless {
	struct display base;
	EGLDisplay egl;
	EGLContext context;
	GLuint framebuffer, colour, depth;
	bool lost;
};

static EGLDisplay platform_open(EGLenum platform, void *native)
{
	EGLDisplay egl = eglGetPlatformDisplay(platform, native, NULL);
	if (egl != EGL_NO_DISPLAY && eglInitialize(egl, NULL, NULL))
		return egl;
	return EGL_NO_DISPLAY;
}

static EGLDisplay device_open(void)
{
	PFNEGLQUERYDEVICESEXTPROC query = (PFNEGLQUERYDEVICESEXTPROC)eglGetProcAddress(
		"eglQueryDevicesEXT");
	EGLDeviceEXT device[EGL_DEVICES_MAX];
	EGLint count = 0;
	if (!query || !query(EGL_DEVICES_MAX, device, &count))
		return EGL_NO_DISPLAY;
	for (int i = 0; i < count; i++) {
		EGLDisplay egl = platform_open(EGL_PLATFORM_DEVICE_EXT, device[i]);
		if (egl != EGL_NO_DISPLAY)
			return egl;
	}
	return EGL_NO_DISPLAY;
}

static bool context_open(struct headless *headless)
{
	static const EGLint wanted[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE,
					EGL_OPENGL_ES3_BIT, EGL_NONE};
	EGLConfig config = EGL_NO_CONFIG_KHR;
	EGLint count = 0;
	const char *client = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
	headless->egl = EGL_NO_DISPLAY;
	if (display_extension(client, "EGL_MESA_platform_surfaceless"))
		headless->egl = platform_open(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY);
	if (headless->egl == EGL_NO_DISPLAY)
		headless->egl = device_open();
	if (headless->egl == EGL_NO_DISPLAY)
		return false;
	if (!eglChooseConfig(headless->egl, wanted, &config, 1, &count) || count < 1)
		config = EGL_NO_CONFIG_KHR;
	headless->context = display_context(headless->egl, config);
	return headless->context != EGL_NO_CONTEXT &&
	       eglMakeCurrent(headless->egl, EGL_NO_SURFACE, EGL_NO_SURFACE, headless->context);
}

static bool framebuffer_open(struct headless *headless)
{
	return turn_target(&headless->framebuffer, &headless->colour, &headless->depth,
			   headless->base.panel_width, headless->base.panel_height);
}

static void context_close(struct headless *headless)
{
	if (headless->context != EGL_NO_CONTEXT) {
		glDeleteFramebuffers(1, &headless->framebuffer);
		glDeleteTextures(1, &headless->colour);
		glDeleteRenderbuffers(1, &headless->depth);
		eglMakeCurrent(headless->egl, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
		eglDestroyContext(headless->egl, headless->context);
	}
	if (headless->egl != EGL_NO_DISPLAY)
		eglTerminate(headless->egl);
	eglReleaseThread();
	headless->context = EGL_NO_CONTEXT;
	headless->egl = EGL_NO_DISPLAY;
}

static enum display_state headless_ready(struct display *display)
{
	struct headless *headless = (struct headless *)display;
	if (!headless->lost)
		return DISPLAY_READY;
	context_close(headless);
	if (!context_open(headless) || !framebuffer_open(headless))
		return DISPLAY_DARK;
	headless->lost = false;
	display->panel = headless->framebuffer;
	display->contexts++;
	return DISPLAY_READY;
}

static bool headless_present(struct display *display)
{
	struct headless *headless = (struct headless *)display;
	glFinish();
	headless->lost = display_context_lost();
	return !headless->lost;
}

static void headless_close(struct display *display)
{
	context_close((struct headless *)display);
	free(display);
}

static const struct display_verbs headless_verbs = {
	.ready = headless_ready,
	.present = headless_present,
	.close = headless_close,
};

struct display *display_headless_open(int *width, int *height, char fault[200])
{
	struct headless *headless = calloc(1, sizeof *headless);
	if (!headless) {
		snprintf(fault, 200, "no memory for a display");
		return NULL;
	}
	headless->base = (struct display){.verbs = &headless_verbs,
					  .panel_width = *width,
					  .panel_height = *height,
					  .contexts = 1};
	headless->context = EGL_NO_CONTEXT;
	if (!context_open(headless)) {
		snprintf(fault, 200,
			 "EGL gives no GLES 3.0 context without a display (EGL error 0x%04x); "
			 "install libegl-mesa0 and libgl1-mesa-dri for software rendering",
			 (unsigned)eglGetError());
		headless_close(&headless->base);
		return NULL;
	}
	if (!framebuffer_open(headless)) {
		snprintf(fault, 200, "no framebuffer of %d x %d pixels: ask for a smaller picture",
			 *width, *height);
		headless_close(&headless->base);
		return NULL;
	}
	headless->base.panel = headless->framebuffer;
	return &headless->base;
}
