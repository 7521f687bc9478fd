/* Fullscreen on KMS: GBM buffers with EGL on top, one after another handed to the machine that
 * keeps a picture on the screen (display_kms_machine.c), and the news of cables from udev. */
#include "display_kms.h"
#include "display_private.h"

#include <drm_fourcc.h>
#include <gbm.h>
#include <libudev.h>
#include <stdio.h>
#include <stdlib.h>

enum { EGL_CONFIGS_MAX = 64, NEWS_MAX = 32 };

struct output {
	struct display base;
	struct kms kms;
	const struct kms_card *card;
	struct gbm_device *gbm;
	struct gbm_surface *surface;
	EGLDisplay egl;
	EGLContext context;
	EGLSurface window;
	struct udev *udev;
	struct udev_monitor *monitor;
};

/* ---- framebuffers ---- */

struct framebuffer {
	const struct kms_calls *calls;
	int fd;
	uint32_t id;
};

static void framebuffer_free(struct gbm_bo *bo, void *data)
{
	struct framebuffer *framebuffer = data;
	(void)bo;
	framebuffer->calls->remove_framebuffer(framebuffer->fd, framebuffer->id);
	free(framebuffer);
}

/* A buffer's framebuffer is made when it is first shown and lives as long as the buffer. */
static uint32_t framebuffer_of(const struct output *output, struct gbm_bo *bo)
{
	struct framebuffer *framebuffer = gbm_bo_get_user_data(bo);
	if (framebuffer)
		return framebuffer->id;
	framebuffer = calloc(1, sizeof *framebuffer);
	if (!framebuffer)
		return 0;
	*framebuffer = (struct framebuffer){output->card->calls, output->card->fd, 0};
	if (framebuffer->calls->add_framebuffer(framebuffer->fd, (int)gbm_bo_get_width(bo),
						(int)gbm_bo_get_height(bo),
						gbm_bo_get_handle(bo).u32, gbm_bo_get_stride(bo),
						gbm_bo_get_modifier(bo), &framebuffer->id)) {
		free(framebuffer);
		return 0;
	}
	gbm_bo_set_user_data(bo, framebuffer, framebuffer_free);
	return framebuffer->id;
}

static void *picture_take(void *of, uint32_t *framebuffer)
{
	struct output *output = of;
	if (!eglSwapBuffers(output->egl, output->window) || display_context_lost())
		return NULL;
	struct gbm_bo *bo = gbm_surface_lock_front_buffer(output->surface);
	*framebuffer = bo ? framebuffer_of(output, bo) : 0;
	if (bo && !*framebuffer) {
		gbm_surface_release_buffer(output->surface, bo);
		bo = NULL;
	}
	return bo;
}

static void picture_give(void *of, void *buffer)
{
	gbm_surface_release_buffer(((struct output *)of)->surface, buffer);
}

/* ---- GBM, EGL, GL ---- */

/* The config whose pixels the plane takes: XRGB, or ARGB where a driver has only that. */
static bool config_find(EGLDisplay egl, uint32_t format, EGLConfig *config)
{
	static const EGLint wanted[] = {EGL_SURFACE_TYPE,
					EGL_WINDOW_BIT,
					EGL_RENDERABLE_TYPE,
					EGL_OPENGL_ES3_BIT,
					EGL_RED_SIZE,
					8,
					EGL_GREEN_SIZE,
					8,
					EGL_BLUE_SIZE,
					8,
					EGL_DEPTH_SIZE,
					16,
					EGL_NONE};
	EGLConfig all[EGL_CONFIGS_MAX];
	EGLint count = 0, visual = 0;
	if (!eglChooseConfig(egl, wanted, all, EGL_CONFIGS_MAX, &count))
		return false;
	for (int i = 0; i < count; i++)
		if (eglGetConfigAttrib(egl, all[i], EGL_NATIVE_VISUAL_ID, &visual) &&
		    (uint32_t)visual == format) {
			*config = all[i];
			return true;
		}
	return false;
}

static bool gl_open(struct output *output)
{
	static const uint32_t format[2] = {GBM_FORMAT_XRGB8888, GBM_FORMAT_ARGB8888};
	EGLConfig config = NULL;
	int f = 0;
	output->gbm = gbm_create_device(output->card->fd);
	output->egl = output->gbm ? eglGetPlatformDisplay(EGL_PLATFORM_GBM_KHR, output->gbm, NULL)
				  : EGL_NO_DISPLAY;
	if (output->egl == EGL_NO_DISPLAY || !eglInitialize(output->egl, NULL, NULL))
		return false;
	while (f < 2 && !config_find(output->egl, format[f], &config))
		f++;
	if (f == 2)
		return false;
	output->surface = gbm_surface_create(output->gbm, output->card->mode.hdisplay,
					     output->card->mode.vdisplay, format[f],
					     GBM_BO_USE_SCANOUT | GBM_BO_USE_RENDERING);
	if (!output->surface)
		return false;
	output->context = display_context(output->egl, config);
	if (output->context != EGL_NO_CONTEXT)
		output->window = eglCreatePlatformWindowSurface(output->egl, config,
								output->surface, NULL);
	return output->window != EGL_NO_SURFACE &&
	       eglMakeCurrent(output->egl, output->window, output->window, output->context);
}

static void picture_close(void *of)
{
	struct output *output = of;
	if (output->egl != EGL_NO_DISPLAY) {
		eglMakeCurrent(output->egl, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
		if (output->window != EGL_NO_SURFACE)
			eglDestroySurface(output->egl, output->window);
		if (output->context != EGL_NO_CONTEXT)
			eglDestroyContext(output->egl, output->context);
		eglTerminate(output->egl);
		eglReleaseThread();
	}
	if (output->surface)
		gbm_surface_destroy(output->surface);
	if (output->gbm)
		gbm_device_destroy(output->gbm);
	output->gbm = NULL;
	output->surface = NULL;
	output->egl = EGL_NO_DISPLAY;
	output->context = EGL_NO_CONTEXT;
	output->window = EGL_NO_SURFACE;
}

static bool picture_open(void *of, const struct kms_card *card, char fault[200])
{
	struct output *output = of;
	output->card = card;
	if (gl_open(output)) {
		output->base.panel_width = card->mode.hdisplay;
		output->base.panel_height = card->mode.vdisplay;
		output->base.contexts++;
		/* screens that come later are asked for the same */
		output->kms.width = card->mode.hdisplay;
		output->kms.height = card->mode.vdisplay;
		return true;
	}
	snprintf(fault, 200, "%s: no GLES 3.0 on it (EGL error 0x%04x): install Mesa's driver",
		 card->path, (unsigned)eglGetError());
	picture_close(output);
	return false;
}

static const struct kms_picture picture = {
	.open = picture_open,
	.close = picture_close,
	.take = picture_take,
	.give = picture_give,
};

/* ---- the display ---- */

static void monitor_open(struct output *output)
{
	output->udev = udev_new();
	output->monitor = output->udev ? udev_monitor_new_from_netlink(output->udev, "kernel")
				       : NULL;
	if (!output->monitor)
		return;
	udev_monitor_filter_add_match_subsystem_devtype(output->monitor, "drm", NULL);
	udev_monitor_enable_receiving(output->monitor);
}

/* Any event of any card is a reason to look; the machine looks now and then anyhow, in case an
 * event was lost. */
static enum display_state output_ready(struct display *display)
{
	struct output *output = (struct output *)display;
	for (int i = 0; output->monitor && i < NEWS_MAX; i++) {
		struct udev_device *device = udev_monitor_receive_device(output->monitor);
		if (!device)
			break;
		output->kms.changed = true;
		udev_device_unref(device);
	}
	return kms_step(&output->kms);
}

static const char *output_reason(const struct display *display)
{
	return ((const struct output *)display)->kms.reason;
}

static bool output_present(struct display *display)
{
	return kms_show(&((struct output *)display)->kms);
}

static void output_close(struct display *display)
{
	struct output *output = (struct output *)display;
	kms_end(&output->kms);
	udev_monitor_unref(output->monitor);
	udev_unref(output->udev);
	free(output);
}

static const struct display_verbs output_verbs = {
	.ready = output_ready,
	.reason = output_reason,
	.present = output_present,
	.close = output_close,
};

/* A card without GL is refused at once; one without a screen is not. */
struct display *display_kms_open(int *width, int *height, char fault[200])
{
	struct output *output = calloc(1, sizeof *output);
	if (!output) {
		snprintf(fault, 200, "no memory for a display");
		return NULL;
	}
	output->base.verbs = &output_verbs;
	output->egl = EGL_NO_DISPLAY;
	output->context = EGL_NO_CONTEXT;
	output->window = EGL_NO_SURFACE;
	kms_begin(&output->kms, &kms_kernel, &picture, output);
	output->kms.width = *width;
	output->kms.height = *height;
	monitor_open(output);
	output_ready(&output->base);
	if (output->kms.state == KMS_NO_CARD || output->kms.state == KMS_LOST) {
		snprintf(fault, 200, "%s", output->kms.reason);
		output_close(&output->base);
		return NULL;
	}
	*width = output->base.panel_width;
	*height = output->base.panel_height;
	return &output->base;
}

bool display_kms_free(bool *taken, char why_not[200])
{
	bool free_one = false;
	*taken = false;
	snprintf(why_not, 200, "no /dev/dri/card*: no display driver");
	for (int i = 0; i < KMS_CARDS_MAX && !free_one; i++) {
		struct kms_card card;
		if (!kms_card_open(&card, &kms_kernel, i, why_not))
			continue;
		enum kms_state state = kms_card_examine(&card, why_not);
		free_one = state >= KMS_NO_DISPLAY;
		*taken |= state == KMS_NO_MASTER;
		kms_card_close(&card);
	}
	return free_one;
}
