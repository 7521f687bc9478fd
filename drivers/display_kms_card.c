/* DRM's objects: which card, connector, pipe and plane; modes; atomic commits. */
#include "display_kms.h"

#include <drm_fourcc.h>
#include <drm_mode.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <unistd.h>
#include <xf86drm.h>

enum { CARDS_MAX = 16, CONNECTORS_MAX = 32 };

/* ---- finding ---- */

static uint32_t property_find(int fd, uint32_t object, uint32_t type, const char *name,
			      uint64_t *value)
{
	uint32_t id = 0;
	drmModeObjectProperties *list = drmModeObjectGetProperties(fd, object, type);
	for (uint32_t i = 0; list && !id && i < list->count_props; i++) {
		drmModePropertyRes *property = drmModeGetProperty(fd, list->props[i]);
		if (property && !strcmp(property->name, name)) {
			id = property->prop_id;
			if (value)
				*value = list->prop_values[i];
		}
		drmModeFreeProperty(property);
	}
	drmModeFreeObjectProperties(list);
	return id;
}

/* The CRTCs that a connector's encoders reach, as bits of the resource list. */
static uint32_t crtcs_of(int fd, const drmModeConnector *connector)
{
	uint32_t mask = 0;
	for (int i = 0; i < connector->count_encoders; i++) {
		drmModeEncoder *encoder = drmModeGetEncoder(fd, connector->encoders[i]);
		mask |= encoder ? encoder->possible_crtcs : 0;
		drmModeFreeEncoder(encoder);
	}
	return mask;
}

static uint32_t primary_plane(int fd, int crtc_index)
{
	uint32_t found = 0;
	drmModePlaneRes *planes = drmModeGetPlaneResources(fd);
	for (uint32_t i = 0; planes && !found && i < planes->count_planes; i++) {
		drmModePlane *plane = drmModeGetPlane(fd, planes->planes[i]);
		uint64_t type = 0;
		if (plane && plane->possible_crtcs >> crtc_index & 1 &&
		    property_find(fd, plane->plane_id, DRM_MODE_OBJECT_PLANE, "type", &type) &&
		    type == DRM_PLANE_TYPE_PRIMARY)
			found = plane->plane_id;
		drmModeFreePlane(plane);
	}
	drmModeFreePlaneResources(planes);
	return found;
}

/* Picks connector, CRTC and plane; leaves the connector (with its modes) to the caller. */
static drmModeConnector *pipe_find(struct kms_card *card, const drmModeRes *resources)
{
	for (int c = 0; c < int_min(resources->count_connectors, CONNECTORS_MAX); c++) {
		drmModeConnector *connector = drmModeGetConnector(card->fd,
								  resources->connectors[c]);
		if (!connector)
			continue;
		uint32_t mask = connector->connection == DRM_MODE_CONNECTED &&
						connector->count_modes
					? crtcs_of(card->fd, connector)
					: 0;
		for (int k = 0; k < resources->count_crtcs; k++) {
			uint32_t plane = mask >> k & 1 ? primary_plane(card->fd, k) : 0;
			if (!plane)
				continue;
			card->connector = connector->connector_id;
			card->crtc = resources->crtcs[k];
			card->plane = plane;
			return connector;
		}
		drmModeFreeConnector(connector);
	}
	return NULL;
}

static bool properties_find(struct kms_card *card)
{
	static const char *const rect_name[8] = {"SRC_X",  "SRC_Y",  "SRC_W",  "SRC_H",
						 "CRTC_X", "CRTC_Y", "CRTC_W", "CRTC_H"};
	int fd = card->fd;
	uint32_t plane = DRM_MODE_OBJECT_PLANE, crtc = DRM_MODE_OBJECT_CRTC;
	bool all = true;
	card->connector_crtc = property_find(fd, card->connector, DRM_MODE_OBJECT_CONNECTOR,
					     "CRTC_ID", NULL);
	card->crtc_active = property_find(fd, card->crtc, crtc, "ACTIVE", NULL);
	card->crtc_mode = property_find(fd, card->crtc, crtc, "MODE_ID", NULL);
	card->plane_fb = property_find(fd, card->plane, plane, "FB_ID", NULL);
	card->plane_crtc = property_find(fd, card->plane, plane, "CRTC_ID", NULL);
	for (int i = 0; i < 8; i++) {
		card->plane_rect[i] = property_find(fd, card->plane, plane, rect_name[i], NULL);
		all = all && card->plane_rect[i];
	}
	return all && card->connector_crtc && card->crtc_active && card->crtc_mode &&
	       card->plane_fb && card->plane_crtc;
}

/* ---- commits ---- */

static void plane_add(const struct kms_card *card, drmModeAtomicReq *request, uint32_t framebuffer)
{
	uint64_t width = card->mode.hdisplay, height = card->mode.vdisplay;
	const uint64_t rect[8] = {0, 0, width << 16, height << 16, 0, 0, width, height};
	drmModeAtomicAddProperty(request, card->plane, card->plane_fb, framebuffer);
	drmModeAtomicAddProperty(request, card->plane, card->plane_crtc, card->crtc);
	for (int i = 0; i < 8; i++)
		drmModeAtomicAddProperty(request, card->plane, card->plane_rect[i], rect[i]);
}

static void mode_add(const struct kms_card *card, drmModeAtomicReq *request)
{
	drmModeAtomicAddProperty(request, card->connector, card->connector_crtc, card->crtc);
	drmModeAtomicAddProperty(request, card->crtc, card->crtc_mode, card->mode_blob);
	drmModeAtomicAddProperty(request, card->crtc, card->crtc_active, 1);
}

static int commit(const struct kms_card *card, uint32_t framebuffer, bool modeset, uint32_t flags)
{
	drmModeAtomicReq *request = drmModeAtomicAlloc();
	if (!request)
		return -ENOMEM;
	if (modeset)
		mode_add(card, request);
	plane_add(card, request, framebuffer);
	int result = drmModeAtomicCommit(card->fd, request,
					 flags | (modeset ? DRM_MODE_ATOMIC_ALLOW_MODESET : 0),
					 (void *)card);
	drmModeAtomicFree(request);
	return result;
}

int kms_flip(struct kms_card *card, uint32_t framebuffer, bool modeset)
{
	return commit(card, framebuffer, modeset,
		      DRM_MODE_ATOMIC_NONBLOCK | DRM_MODE_PAGE_FLIP_EVENT);
}

/* ---- modes ---- */

static void black_free(struct kms_card *card)
{
	if (card->black)
		drmModeRmFB(card->fd, card->black);
	if (card->black_handle) {
		struct drm_mode_destroy_dumb gone = {.handle = card->black_handle};
		drmIoctl(card->fd, DRM_IOCTL_MODE_DESTROY_DUMB, &gone);
	}
	card->black = card->black_handle = 0;
}

/* A zeroed buffer of the mode's size: a mode can be tried before GL knows about it. */
static bool black_make(struct kms_card *card)
{
	struct drm_mode_create_dumb dumb = {
		.width = card->mode.hdisplay, .height = card->mode.vdisplay, .bpp = 32};
	if (drmIoctl(card->fd, DRM_IOCTL_MODE_CREATE_DUMB, &dumb) < 0)
		return false;
	card->black_handle = dumb.handle;
	uint32_t handles[4] = {dumb.handle}, pitches[4] = {dumb.pitch}, offsets[4] = {0};
	return drmModeAddFB2(card->fd, dumb.width, dumb.height, DRM_FORMAT_XRGB8888, handles,
			     pitches, offsets, &card->black, 0) == 0;
}

static void mode_drop(struct kms_card *card)
{
	black_free(card);
	if (card->mode_blob)
		drmModeDestroyPropertyBlob(card->fd, card->mode_blob);
	card->mode_blob = 0;
}

/* First as a question, then in earnest: drivers have been seen to say yes to the question only. */
static bool mode_try(struct kms_card *card, const drmModeModeInfo *mode)
{
	card->mode = *mode;
	if (drmModeCreatePropertyBlob(card->fd, mode, sizeof *mode, &card->mode_blob) == 0 &&
	    black_make(card) && commit(card, card->black, true, DRM_MODE_ATOMIC_TEST_ONLY) == 0 &&
	    commit(card, card->black, true, 0) == 0) {
		card->lit = true;
		return true;
	}
	mode_drop(card);
	return false;
}

/* The lower the sooner: wanted size, the screen's own choice, sizes that every screen can show. */
static int mode_rank(const drmModeModeInfo *mode, int width, int height)
{
	static const int usual[3][2] = {{1920, 1080}, {1280, 720}, {1024, 768}};
	if (mode->flags & DRM_MODE_FLAG_INTERLACE)
		return 9;
	if (mode->hdisplay == width && mode->vdisplay == height)
		return 0;
	if (mode->type & DRM_MODE_TYPE_PREFERRED)
		return 1;
	for (int i = 0; i < COUNT_OF(usual); i++)
		if (mode->hdisplay == usual[i][0] && mode->vdisplay == usual[i][1])
			return 2 + i;
	return 8;
}

static bool mode_light(struct kms_card *card, const drmModeConnector *connector, int width,
		       int height)
{
	for (int rank = 0; rank <= 9; rank++)
		for (int i = 0; i < connector->count_modes; i++)
			if (mode_rank(&connector->modes[i], width, height) == rank &&
			    mode_try(card, &connector->modes[i]))
				return true;
	return false;
}

/* ---- the card ---- */

/* The first who opens a card is its master; after that only asking helps. */
static bool master_take(int fd)
{
	return drmIsMaster(fd) || drmSetMaster(fd) == 0;
}

static bool card_try(struct kms_card *card, int width, int height, char fault[200])
{
	drmModeRes *resources = drmModeGetResources(card->fd);
	drmModeConnector *connector = NULL;
	bool lit = false;
	if (!resources) {
		snprintf(fault, 200, "%s shows no pictures (a render-only card)", card->path);
	} else if (!master_take(card->fd)) {
		snprintf(fault, 200,
			 "%s belongs to another program: stop the desktop or the splash "
			 "screen that holds it",
			 card->path);
	} else if (drmSetClientCap(card->fd, DRM_CLIENT_CAP_UNIVERSAL_PLANES, 1) ||
		   drmSetClientCap(card->fd, DRM_CLIENT_CAP_ATOMIC, 1)) {
		snprintf(fault, 200, "%s has no atomic mode setting: use a newer kernel driver",
			 card->path);
	} else if (!(connector = pipe_find(card, resources))) {
		snprintf(fault, 200, "%s has no screen attached: plug one in, switch it on",
			 card->path);
	} else if (!properties_find(card)) {
		snprintf(fault, 200, "%s lacks properties of atomic mode setting", card->path);
	} else if (!(lit = mode_light(card, connector, width, height))) {
		snprintf(fault, 200, "%s accepts none of the screen's %d modes", card->path,
			 connector->count_modes);
	}
	drmModeFreeConnector(connector);
	drmModeFreeResources(resources);
	return lit;
}

/* By what it shows, not by its number: boards have separate nodes for drawing and for showing. A
 * fault of a card that can show pictures is told before that of one that can't. */
bool kms_open(struct kms_card *card, int width, int height, char fault[200])
{
	char line[200];
	bool told = false;
	snprintf(fault, 200,
		 "no /dev/dri/card*: the kernel has no display driver for this machine");
	for (int i = 0; i < CARDS_MAX; i++) {
		*card = (struct kms_card){.fd = -1};
		snprintf(card->path, sizeof card->path, "/dev/dri/card%d", i);
		card->fd = open(card->path, O_RDWR | O_CLOEXEC | O_NONBLOCK);
		if (card->fd < 0 && errno == ENOENT)
			continue;
		if (card->fd < 0) {
			snprintf(line, sizeof line, "%s: %s; add the user to group video",
				 card->path, strerror(errno));
		} else if (card_try(card, width, height, line)) {
			return true;
		}
		if (!told || !strstr(line, "render-only"))
			memcpy(fault, line, sizeof line);
		told = true;
		if (card->fd >= 0)
			close(card->fd);
	}
	card->fd = -1;
	return false;
}

void kms_dark(struct kms_card *card)
{
	drmModeAtomicReq *request = card->lit ? drmModeAtomicAlloc() : NULL;
	card->lit = false;
	if (!request)
		return;
	drmModeAtomicAddProperty(request, card->connector, card->connector_crtc, 0);
	drmModeAtomicAddProperty(request, card->crtc, card->crtc_mode, 0);
	drmModeAtomicAddProperty(request, card->crtc, card->crtc_active, 0);
	drmModeAtomicAddProperty(request, card->plane, card->plane_fb, 0);
	drmModeAtomicAddProperty(request, card->plane, card->plane_crtc, 0);
	drmModeAtomicCommit(card->fd, request, DRM_MODE_ATOMIC_ALLOW_MODESET, NULL);
	drmModeAtomicFree(request);
}

void kms_close(struct kms_card *card)
{
	if (card->fd < 0)
		return;
	mode_drop(card);
	drmDropMaster(card->fd);
	close(card->fd);
	card->fd = -1;
}

bool kms_present(const struct kms_card *card, bool probe)
{
	drmModeConnector *connector = probe ? drmModeGetConnector(card->fd, card->connector)
					    : drmModeGetConnectorCurrent(card->fd, card->connector);
	bool found = false;
	if (connector && connector->connection == DRM_MODE_CONNECTED)
		for (int i = 0; i < connector->count_modes && !found; i++)
			found = connector->modes[i].hdisplay == card->mode.hdisplay &&
				connector->modes[i].vdisplay == card->mode.vdisplay;
	drmModeFreeConnector(connector);
	return found;
}

bool kms_free(char why_not[200])
{
	snprintf(why_not, 200, "no /dev/dri/card*: no display driver");
	for (int i = 0; i < CARDS_MAX; i++) {
		char path[32];
		snprintf(path, sizeof path, "/dev/dri/card%d", i);
		int fd = open(path, O_RDWR | O_CLOEXEC);
		if (fd < 0 && errno == ENOENT)
			continue;
		if (fd < 0) {
			snprintf(why_not, 200, "%s: %s", path, strerror(errno));
			continue;
		}
		drmModeRes *resources = drmModeGetResources(fd);
		bool shows = resources && resources->count_connectors > 0;
		bool ours = shows && master_take(fd);
		drmModeFreeResources(resources);
		if (ours)
			drmDropMaster(fd);
		close(fd);
		if (ours)
			return true;
		snprintf(why_not, 200, "%s %s", path,
			 shows ? "belongs to another program" : "shows no pictures");
	}
	return false;
}
