/* Fullscreen on KMS: GBM buffers, EGL on top, one atomic flip a frame.
 *
 * Nothing here waits without an end. A flip that does not come is asked for again with a full
 * modeset; when that is late too, or the screen or the master's right is gone, present returns
 * false, and the host closes the display and opens one again when there is one.
 */
#include "display_kms.h"
#include "display_private.h"

#include <drm_fourcc.h>
#include <errno.h>
#include <gbm.h>
#include <libudev.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>
#include <xf86drm.h>

enum { FLIP_WAIT_MS = 1000, LOOK_EVERY_FRAMES = 300, EGL_CONFIGS_MAX = 64 };

struct kms {
	struct display base;
	struct kms_card card;
	struct gbm_device *gbm;
	struct gbm_surface *surface;
	struct gbm_bo *shown; /* on the screen now */
	EGLDisplay egl;
	EGLContext context;
	EGLSurface window;
	struct udev *udev;
	struct udev_monitor *monitor;
	bool flipping; /* an event is due */
	int frames, late;
};

/* ---- framebuffers ---- */

struct framebuffer {
	int fd;
	uint32_t id;
};

static void framebuffer_free(struct gbm_bo *bo, void *data)
{
	struct framebuffer *framebuffer = data;
	(void)bo;
	drmModeRmFB(framebuffer->fd, framebuffer->id);
	free(framebuffer);
}

/* A buffer's framebuffer is made when it is first shown and lives as long as the buffer. */
static uint32_t framebuffer_of(struct kms *kms, struct gbm_bo *bo)
{
	struct framebuffer *framebuffer = gbm_bo_get_user_data(bo);
	if (framebuffer)
		return framebuffer->id;
	framebuffer = calloc(1, sizeof *framebuffer);
	if (!framebuffer)
		return 0;
	uint32_t handles[4] = {gbm_bo_get_handle(bo).u32}, offsets[4] = {0};
	uint32_t pitches[4] = {gbm_bo_get_stride(bo)};
	uint64_t modifier = gbm_bo_get_modifier(bo), modifiers[4] = {modifier};
	uint32_t width = gbm_bo_get_width(bo), height = gbm_bo_get_height(bo);
	int failed = -1;
	framebuffer->fd = kms->card.fd;
	if (modifier != DRM_FORMAT_MOD_INVALID && modifier != DRM_FORMAT_MOD_LINEAR)
		failed = drmModeAddFB2WithModifiers(
			kms->card.fd, width, height, DRM_FORMAT_XRGB8888, handles, pitches, offsets,
			modifiers, &framebuffer->id, DRM_MODE_FB_MODIFIERS);
	if (failed)
		failed = drmModeAddFB2(kms->card.fd, width, height, DRM_FORMAT_XRGB8888, handles,
				       pitches, offsets, &framebuffer->id, 0);
	if (failed) {
		free(framebuffer);
		return 0;
	}
	gbm_bo_set_user_data(bo, framebuffer, framebuffer_free);
	return framebuffer->id;
}

/* ---- flips ---- */

static int64_t now_ms(void)
{
	struct timespec now;
	clock_gettime(CLOCK_MONOTONIC, &now);
	return (int64_t)now.tv_sec * 1000 + now.tv_nsec / 1000000;
}

static void flip_done(int fd, unsigned sequence, unsigned seconds, unsigned micros, unsigned crtc,
		      void *data)
{
	struct kms_card *card = data;
	(void)fd, (void)sequence, (void)seconds, (void)micros, (void)crtc;
	((struct kms *)(void *)((char *)card - offsetof(struct kms, card)))->flipping = false;
}

static bool flip_wait(struct kms *kms)
{
	drmEventContext events = {.version = 3, .page_flip_handler2 = flip_done};
	int64_t until_ms = now_ms() + FLIP_WAIT_MS;
	while (kms->flipping) {
		int64_t left_ms = until_ms - now_ms();
		struct pollfd ready = {.fd = kms->card.fd, .events = POLLIN};
		if (left_ms <= 0)
			return false;
		int count = poll(&ready, 1, (int)left_ms);
		if (count < 0 && errno != EINTR)
			return false;
		if (count > 0 && ready.revents & (POLLERR | POLLHUP | POLLNVAL))
			return false;
		if (count > 0)
			drmHandleEvent(kms->card.fd, &events);
	}
	return true;
}

/* Two tries; the second sets the mode again. EBUSY means that an older flip is still under way. */
static bool flip(struct kms *kms, uint32_t framebuffer)
{
	for (int try = 0; try < 2; try++) {
		int64_t until_ms = now_ms() + FLIP_WAIT_MS;
		int result = kms_flip(&kms->card, framebuffer, try > 0);
		while (result == -EBUSY && now_ms() < until_ms) {
			poll(NULL, 0, 2);
			result = kms_flip(&kms->card, framebuffer, try > 0);
		}
		if (result == -EACCES || result == -ENODEV)
			return false;
		kms->flipping = result == 0;
		if (result == 0 && flip_wait(kms))
			return true;
		kms->late++;
	}
	return false;
}

/* ---- the cable ---- */

static void monitor_open(struct kms *kms)
{
	kms->udev = udev_new();
	kms->monitor = kms->udev ? udev_monitor_new_from_netlink(kms->udev, "kernel") : NULL;
	if (!kms->monitor)
		return;
	udev_monitor_filter_add_match_subsystem_devtype(kms->monitor, "drm", NULL);
	udev_monitor_enable_receiving(kms->monitor);
}

/* No commit ever fails because a screen has gone: one has to look. Any event of the card is a
 * reason to ask the cable; and now and then what the kernel knows, in case an event was lost. */
static bool screen_present(struct kms *kms)
{
	bool changed = false;
	for (int i = 0; kms->monitor && i < 32; i++) {
		struct udev_device *device = udev_monitor_receive_device(kms->monitor);
		if (!device)
			break;
		changed = true;
		udev_device_unref(device);
	}
	if (!changed && kms->frames % LOOK_EVERY_FRAMES)
		return true;
	return kms_present(&kms->card, changed);
}

static bool kms_show(struct display *display)
{
	struct kms *kms = (struct kms *)display;
	kms->frames++;
	if (!eglSwapBuffers(kms->egl, kms->window) || display_context_lost() ||
	    !screen_present(kms))
		return false;
	struct gbm_bo *bo = gbm_surface_lock_front_buffer(kms->surface);
	uint32_t framebuffer = bo ? framebuffer_of(kms, bo) : 0;
	bool shown = framebuffer && flip(kms, framebuffer);
	struct gbm_bo *old = shown ? kms->shown : bo;
	if (old)
		gbm_surface_release_buffer(kms->surface, old);
	if (shown)
		kms->shown = bo;
	return shown;
}

/* ---- opening and closing ---- */

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

static bool gl_open(struct kms *kms)
{
	static const uint32_t format[2] = {GBM_FORMAT_XRGB8888, GBM_FORMAT_ARGB8888};
	EGLConfig config = NULL;
	int f = 0;
	kms->gbm = gbm_create_device(kms->card.fd);
	kms->egl = kms->gbm ? eglGetPlatformDisplay(EGL_PLATFORM_GBM_KHR, kms->gbm, NULL)
			    : EGL_NO_DISPLAY;
	if (kms->egl == EGL_NO_DISPLAY || !eglInitialize(kms->egl, NULL, NULL))
		return false;
	while (f < 2 && !config_find(kms->egl, format[f], &config))
		f++;
	if (f == 2)
		return false;
	kms->surface = gbm_surface_create(kms->gbm, kms->card.mode.hdisplay,
					  kms->card.mode.vdisplay, format[f],
					  GBM_BO_USE_SCANOUT | GBM_BO_USE_RENDERING);
	if (!kms->surface)
		return false;
	kms->context = display_context(kms->egl, config);
	if (kms->context != EGL_NO_CONTEXT)
		kms->window = eglCreatePlatformWindowSurface(kms->egl, config, kms->surface, NULL);
	return kms->window != EGL_NO_SURFACE &&
	       eglMakeCurrent(kms->egl, kms->window, kms->window, kms->context);
}

/* The screen goes dark first, then all buffers, then what they were made from. */
static void kms_end(struct display *display)
{
	struct kms *kms = (struct kms *)display;
	kms_dark(&kms->card);
	if (kms->shown)
		gbm_surface_release_buffer(kms->surface, kms->shown);
	if (kms->egl != EGL_NO_DISPLAY) {
		eglMakeCurrent(kms->egl, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
		if (kms->window != EGL_NO_SURFACE)
			eglDestroySurface(kms->egl, kms->window);
		if (kms->context != EGL_NO_CONTEXT)
			eglDestroyContext(kms->egl, kms->context);
		eglTerminate(kms->egl);
		eglReleaseThread();
	}
	if (kms->surface)
		gbm_surface_destroy(kms->surface);
	if (kms->gbm)
		gbm_device_destroy(kms->gbm);
	udev_monitor_unref(kms->monitor);
	udev_unref(kms->udev);
	kms_close(&kms->card);
	free(kms);
}

static const struct display_verbs kms_verbs = {
	.present = kms_show,
	.close = kms_end,
};

struct display *display_kms_open(int *width, int *height, char fault[200])
{
	struct kms *kms = calloc(1, sizeof *kms);
	if (!kms) {
		snprintf(fault, 200, "no memory for a display");
		return NULL;
	}
	kms->base.verbs = &kms_verbs;
	kms->egl = EGL_NO_DISPLAY;
	kms->context = EGL_NO_CONTEXT;
	kms->window = EGL_NO_SURFACE;
	if (!kms_open(&kms->card, *width, *height, fault)) {
		kms_end(&kms->base);
		return NULL;
	}
	monitor_open(kms);
	if (!gl_open(kms)) {
		snprintf(fault, 200,
			 "%s: no GLES 3.0 on it (EGL error 0x%04x): install Mesa's driver",
			 kms->card.path, (unsigned)eglGetError());
		kms_end(&kms->base);
		return NULL;
	}
	*width = kms->base.width = kms->card.mode.hdisplay;
	*height = kms->base.height = kms->card.mode.vdisplay;
	return &kms->base;
}

bool display_kms_free(char why_not[200])
{
	return kms_free(why_not);
}
