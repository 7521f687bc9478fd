/* The kernel behind display_kms.h's table: libdrm, and what Linux calls wait and time. */
#include "display_kms.h"

#include <drm_fourcc.h>
#include <drm_mode.h>
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <time.h>
#include <unistd.h>

static int card_open(const char *path)
{
	int fd = open(path, O_RDWR | O_CLOEXEC | O_NONBLOCK);
	return fd < 0 ? -errno : fd;
}

static void card_close(int fd)
{
	close(fd);
}

static int64_t clock_ms(void)
{
	struct timespec now;
	clock_gettime(CLOCK_MONOTONIC, &now);
	return (int64_t)now.tv_sec * 1000 + now.tv_nsec / 1000000;
}

static int card_wait(int fd, int limit_ms)
{
	struct pollfd ready = {.fd = fd, .events = POLLIN};
	int count = poll(&ready, 1, limit_ms);
	if (count < 0)
		return errno == EINTR ? 0 : -errno;
	if (count > 0 && ready.revents & (POLLERR | POLLHUP | POLLNVAL))
		return -ENODEV;
	return count;
}

static int create_dumb(int fd, int width, int height, uint32_t *handle, uint32_t *pitch)
{
	struct drm_mode_create_dumb dumb = {
		.width = (uint32_t)width, .height = (uint32_t)height, .bpp = 32};
	if (drmIoctl(fd, DRM_IOCTL_MODE_CREATE_DUMB, &dumb) < 0)
		return -errno;
	*handle = dumb.handle;
	*pitch = dumb.pitch;
	return 0;
}

static int destroy_dumb(int fd, uint32_t handle)
{
	struct drm_mode_destroy_dumb gone = {.handle = handle};
	return drmIoctl(fd, DRM_IOCTL_MODE_DESTROY_DUMB, &gone) < 0 ? -errno : 0;
}

static int add_framebuffer(int fd, int width, int height, uint32_t handle, uint32_t pitch,
			   uint64_t modifier, uint32_t *id)
{
	uint32_t handles[4] = {handle}, pitches[4] = {pitch}, offsets[4] = {0};
	uint64_t modifiers[4] = {modifier};
	uint32_t w = (uint32_t)width, h = (uint32_t)height;
	if (modifier != DRM_FORMAT_MOD_INVALID && modifier != DRM_FORMAT_MOD_LINEAR &&
	    drmModeAddFB2WithModifiers(fd, w, h, DRM_FORMAT_XRGB8888, handles, pitches, offsets,
				       modifiers, id, DRM_MODE_FB_MODIFIERS) == 0)
		return 0;
	return drmModeAddFB2(fd, w, h, DRM_FORMAT_XRGB8888, handles, pitches, offsets, id, 0);
}

static int commit(int fd, const struct kms_item *items, int count, uint32_t flags, void *user)
{
	drmModeAtomicReq *request = drmModeAtomicAlloc();
	int result = request ? 0 : -ENOMEM;
	for (int i = 0; i < count && result >= 0; i++)
		result = drmModeAtomicAddProperty(request, items[i].object, items[i].property,
						  items[i].value);
	if (result >= 0)
		result = drmModeAtomicCommit(fd, request, flags, user);
	drmModeAtomicFree(request);
	return result;
}

const struct kms_calls kms_kernel = {
	.open = card_open,
	.close = card_close,
	.clock_ms = clock_ms,
	.wait = card_wait,
	.handle_event = drmHandleEvent,
	.is_master = drmIsMaster,
	.set_master = drmSetMaster,
	.drop_master = drmDropMaster,
	.set_client_cap = drmSetClientCap,
	.get_resources = drmModeGetResources,
	.get_connector = drmModeGetConnector,
	.get_connector_current = drmModeGetConnectorCurrent,
	.get_encoder = drmModeGetEncoder,
	.get_plane_resources = drmModeGetPlaneResources,
	.get_plane = drmModeGetPlane,
	.get_properties = drmModeObjectGetProperties,
	.get_property = drmModeGetProperty,
	.create_blob = drmModeCreatePropertyBlob,
	.destroy_blob = drmModeDestroyPropertyBlob,
	.create_dumb = create_dumb,
	.destroy_dumb = destroy_dumb,
	.add_framebuffer = add_framebuffer,
	.remove_framebuffer = drmModeRmFB,
	.commit = commit,
};
