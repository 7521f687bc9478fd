/* Looks at the display behind the station's back.
 *
 *   screen capture PID SHOWN.png   what the display got, through its writeback connector, beside
 * what the program drew; fails when a pixel differs screen alike A.png B.png       fails when the
 * pictures differ by more than a grain screen hold                    is the display's master until
 * it is ended screen mode                    prints the size of the picture that is shown
 *
 * Only the master may ask for a writeback, so capture borrows the station's own open card. */
#include "play.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <png.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>
#include <xf86drm.h>
#include <xf86drmMode.h>

#define CARD "/dev/dri/card0"

enum {
	WRITEBACK_MS = 5000,
	ALIKE_GRAIN = 24,     /* of 255: the sum of a pixel's differences that nobody sees */
	ALIKE_PER_MILLE = 10, /* pixels that may differ by more */
};

/* --- the station's card ----------------------------------------------------------------------- */

/* The program's own open file of the card, as another descriptor of ours. */
static int card_borrow(int pid)
{
	char folder[64], path[400], target[64];
	int process = (int)syscall(SYS_pidfd_open, pid, 0), card = -1;
	snprintf(folder, sizeof folder, "/proc/%d/fd", pid);
	DIR *list = opendir(folder);
	if (process < 0 || !list)
		play_fail(folder);
	for (struct dirent *entry; card < 0 && (entry = readdir(list));) {
		snprintf(path, sizeof path, "%s/%s", folder, entry->d_name);
		ssize_t length = readlink(path, target, sizeof target - 1);
		target[length > 0 ? length : 0] = 0;
		if (!strcmp(target, CARD))
			card = (int)syscall(SYS_pidfd_getfd, process, atoi(entry->d_name), 0);
	}
	closedir(list);
	close(process);
	if (card < 0)
		play_complain("process %d has no display open", pid);
	return card;
}

static void process_hold(int pid)
{
	char path[64], line[256] = "";
	snprintf(path, sizeof path, "/proc/%d/stat", pid);
	kill(pid, SIGSTOP);
	while (!strstr(line, ") T ")) {
		FILE *file = fopen(path, "r");
		if (!file || !fgets(line, sizeof line, file))
			play_fail(path);
		fclose(file);
		play_sleep_until(play_clock_us() + 5000);
	}
	/* a flip under way comes to its end */
	play_sleep_until(play_clock_us() + 100000);
}

/* --- properties ------------------------------------------------------------------------------- */

static uint32_t property(int card, uint32_t object, uint32_t type, const char *name,
			 uint64_t *value)
{
	uint32_t id = 0;
	drmModeObjectProperties *all = drmModeObjectGetProperties(card, object, type);
	for (uint32_t i = 0; all && !id && i < all->count_props; i++) {
		drmModePropertyRes *one = drmModeGetProperty(card, all->props[i]);
		if (one && !strcmp(one->name, name)) {
			id = one->prop_id;
			if (value)
				*value = all->prop_values[i];
		}
		drmModeFreeProperty(one);
	}
	drmModeFreeObjectProperties(all);
	return id;
}

static void set(drmModeAtomicReq *request, int card, uint32_t connector, const char *name,
		uint64_t value)
{
	uint32_t id = property(card, connector, DRM_MODE_OBJECT_CONNECTOR, name, NULL);
	if (!id || drmModeAtomicAddProperty(request, connector, id, value) < 0)
		play_complain("the writeback connector has no %s", name);
}

static uint32_t writeback_find(int card)
{
	drmModeRes *resources = drmModeGetResources(card);
	uint32_t found = 0;
	for (int i = 0; resources && i < resources->count_connectors; i++) {
		drmModeConnector *connector = drmModeGetConnector(card, resources->connectors[i]);
		if (connector && connector->connector_type == DRM_MODE_CONNECTOR_WRITEBACK)
			found = connector->connector_id;
		drmModeFreeConnector(connector);
	}
	drmModeFreeResources(resources);
	if (!found)
		play_complain("the card has no writeback connector");
	return found;
}

/* --- pixels ----------------------------------------------------------------------------------- */

struct pixels {
	uint32_t framebuffer, handle;
	int width, height, pitch;
	const uint8_t *bytes; /* XRGB8888 */
};

static void pixels_map(int card, struct pixels *p)
{
	struct drm_mode_map_dumb map = {.handle = p->handle};
	size_t size = (size_t)p->pitch * (size_t)p->height;
	if (drmIoctl(card, DRM_IOCTL_MODE_MAP_DUMB, &map))
		play_fail("mapping a picture");
	void *bytes = mmap(NULL, size, PROT_READ, MAP_SHARED, card, (off_t)map.offset);
	if (bytes == MAP_FAILED)
		play_fail("mapping a picture");
	p->bytes = bytes;
}

/* What the first plane shows, and on which CRTC. */
static struct pixels shown_find(int card, uint32_t *crtc)
{
	struct pixels p = {0};
	drmModePlaneRes *planes = drmModeGetPlaneResources(card);
	for (uint32_t i = 0; planes && !p.framebuffer && i < planes->count_planes; i++) {
		drmModePlane *plane = drmModeGetPlane(card, planes->planes[i]);
		if (plane && plane->fb_id) {
			p.framebuffer = plane->fb_id;
			*crtc = plane->crtc_id;
		}
		drmModeFreePlane(plane);
	}
	drmModeFreePlaneResources(planes);
	drmModeFB2 *fb = p.framebuffer ? drmModeGetFB2(card, p.framebuffer) : NULL;
	if (!fb)
		play_complain("the display shows no picture");
	p.width = (int)fb->width;
	p.height = (int)fb->height;
	p.pitch = (int)fb->pitches[0];
	p.handle = fb->handles[0];
	drmModeFreeFB2(fb);
	return p;
}

static struct pixels picture_make(int card, int width, int height)
{
	struct drm_mode_create_dumb dumb = {
		.width = (uint32_t)width, .height = (uint32_t)height, .bpp = 32};
	struct pixels p = {.width = width, .height = height};
	if (drmIoctl(card, DRM_IOCTL_MODE_CREATE_DUMB, &dumb))
		play_fail("a picture for the writeback");
	p.handle = dumb.handle;
	p.pitch = (int)dumb.pitch;
	if (drmModeAddFB(card, dumb.width, dumb.height, 24, 32, dumb.pitch, dumb.handle,
			 &p.framebuffer))
		play_fail("a picture for the writeback");
	return p;
}

static void picture_end(int card, struct pixels *p)
{
	struct drm_mode_destroy_dumb gone = {.handle = p->handle};
	drmModeRmFB(card, p->framebuffer);
	drmIoctl(card, DRM_IOCTL_MODE_DESTROY_DUMB, &gone);
}

static const uint8_t *pixel(const struct pixels *p, int x, int y)
{
	return p->bytes + (size_t)y * (size_t)p->pitch + (size_t)x * 4;
}

static int pixels_differ(const struct pixels *a, const struct pixels *b)
{
	int count = 0;
	if (a->width != b->width || a->height != b->height)
		play_complain("%d x %d was drawn, %d x %d is shown", a->width, a->height, b->width,
			      b->height);
	for (int y = 0; y < a->height; y++)
		for (int x = 0; x < a->width; x++)
			count += memcmp(pixel(a, x, y), pixel(b, x, y), 3) != 0;
	return count;
}

static bool blank(const struct pixels *p)
{
	for (int y = 0; y < p->height; y++)
		for (int x = 0; x < p->width; x++)
			if (memcmp(pixel(p, x, y), pixel(p, 0, 0), 3))
				return false;
	return true;
}

static void pixels_write(const struct pixels *p, const char *path)
{
	png_image image = {.version = PNG_IMAGE_VERSION,
			   .width = (png_uint_32)p->width,
			   .height = (png_uint_32)p->height,
			   .format = PNG_FORMAT_BGR};
	uint8_t *bgr = malloc((size_t)p->width * (size_t)p->height * 3), *to = bgr;
	for (int y = 0; bgr && y < p->height; y++)
		for (int x = 0; x < p->width; x++, to += 3)
			memcpy(to, pixel(p, x, y), 3);
	if (!bgr || !png_image_write_to_file(&image, path, 0, bgr, 0, NULL))
		play_complain("%s: %s", path, bgr ? image.message : "no memory");
	free(bgr);
}

/* --- writeback -------------------------------------------------------------------------------- */

static void connector_commit(int card, uint32_t connector, uint32_t crtc, uint32_t framebuffer)
{
	int32_t fence = -1;
	drmModeAtomicReq *request = drmModeAtomicAlloc();
	set(request, card, connector, "CRTC_ID", crtc);
	set(request, card, connector, "WRITEBACK_FB_ID", framebuffer);
	if (framebuffer)
		set(request, card, connector, "WRITEBACK_OUT_FENCE_PTR",
		    (uint64_t)(uintptr_t)&fence);
	int result = drmModeAtomicCommit(card, request, DRM_MODE_ATOMIC_ALLOW_MODESET, NULL);
	drmModeAtomicFree(request);
	if (result)
		play_complain("the writeback is refused: %s", strerror(-result));
	struct pollfd done = {fence, POLLIN, 0};
	if (framebuffer && poll(&done, 1, WRITEBACK_MS) != 1)
		play_complain("no picture was written back within %d ms", WRITEBACK_MS);
	if (fence >= 0)
		close(fence);
}

static int capture(int pid, const char *path)
{
	uint32_t crtc = 0;
	int card = card_borrow(pid);
	process_hold(pid);
	struct pixels drawn = shown_find(card, &crtc);
	pixels_map(card, &drawn);
	drmSetClientCap(card, DRM_CLIENT_CAP_WRITEBACK_CONNECTORS, 1);
	uint32_t connector = writeback_find(card);
	struct pixels shown = picture_make(card, drawn.width, drawn.height);
	connector_commit(card, connector, crtc, shown.framebuffer);
	pixels_map(card, &shown);
	int differing = pixels_differ(&drawn, &shown);
	pixels_write(&shown, path);
	connector_commit(card, connector, 0, 0);
	picture_end(card, &shown);
	drmSetClientCap(card, DRM_CLIENT_CAP_WRITEBACK_CONNECTORS, 0);
	kill(pid, SIGCONT);
	printf("%d x %d%s, %d pixels differ from what was drawn\n", drawn.width, drawn.height,
	       blank(&drawn) ? " blank" : "", differing);
	return differing || blank(&drawn);
}

/* --- other commands --------------------------------------------------------------------------- */

static uint8_t *png_load(const char *path, int *width, int *height)
{
	png_image image = {.version = PNG_IMAGE_VERSION};
	if (!png_image_begin_read_from_file(&image, path))
		play_complain("%s: %s", path, image.message);
	image.format = PNG_FORMAT_RGB;
	uint8_t *rgb = malloc(PNG_IMAGE_SIZE(image));
	if (!rgb || !png_image_finish_read(&image, NULL, rgb, 0, NULL))
		play_complain("%s: %s", path, image.message);
	*width = (int)image.width;
	*height = (int)image.height;
	return rgb;
}

static int alike(const char *path_a, const char *path_b)
{
	int size[4], differing = 0;
	uint8_t *a = png_load(path_a, &size[0], &size[1]);
	uint8_t *b = png_load(path_b, &size[2], &size[3]);
	if (size[0] != size[2] || size[1] != size[3])
		play_complain("%s has another size than %s", path_a, path_b);
	int count = size[0] * size[1];
	for (int i = 0; i < count; i++) {
		int sum = 0;
		for (int c = 0; c < 3; c++)
			sum += abs(a[3 * i + c] - b[3 * i + c]);
		differing += sum > ALIKE_GRAIN;
	}
	printf("%d of %d pixels differ\n", differing, count);
	free(a);
	free(b);
	return differing * 1000 > count * ALIKE_PER_MILLE;
}

static int hold(void)
{
	int card = open(CARD, O_RDWR | O_CLOEXEC);
	if (card < 0 || drmSetMaster(card))
		play_fail(CARD);
	puts("held");
	fflush(stdout);
	for (;;)
		pause();
}

static int mode(void)
{
	int card = open(CARD, O_RDWR | O_CLOEXEC);
	drmModeRes *resources = card < 0 ? NULL : drmModeGetResources(card);
	drmModeCrtc *crtc = resources && resources->count_crtcs
				    ? drmModeGetCrtc(card, resources->crtcs[0])
				    : NULL;
	if (!crtc)
		play_fail(CARD);
	if (!crtc->mode_valid)
		play_complain("dark");
	printf("%d x %d\n", crtc->mode.hdisplay, crtc->mode.vdisplay);
	return 0;
}

int main(int argc, char **argv)
{
	const char *word = argc > 1 ? argv[1] : "";
	if (!strcmp(word, "capture") && argc == 4)
		return capture(atoi(argv[2]), argv[3]);
	if (!strcmp(word, "alike") && argc == 4)
		return alike(argv[2], argv[3]);
	if (!strcmp(word, "hold") && argc == 2)
		return hold();
	if (!strcmp(word, "mode") && argc == 2)
		return mode();
	play_complain("usage: screen capture PID PNG | alike PNG PNG | hold | mode");
}
