/* Modes and atomic commits of one card. */
#include "display_kms.h"

#include <drm_fourcc.h>
#include <errno.h>

enum { ITEMS_MAX = 20 };

struct items {
	int count;
	struct kms_item item[ITEMS_MAX];
};

static void add(struct items *items, uint32_t object, uint32_t property, uint64_t value)
{
	MUST(items->count < ITEMS_MAX);
	items->item[items->count++] = (struct kms_item){object, property, value};
}

/* ---- commits ---- */

static void plane_add(const struct kms_card *card, struct items *items, uint32_t framebuffer)
{
	uint64_t width = card->mode.hdisplay, height = card->mode.vdisplay;
	const uint64_t rect[8] = {0, 0, width << 16, height << 16, 0, 0, width, height};
	add(items, card->plane, card->plane_fb, framebuffer);
	add(items, card->plane, card->plane_crtc, card->crtc);
	for (int i = 0; i < 8; i++)
		add(items, card->plane, card->plane_rect[i], rect[i]);
}

/* A link that failed its training is marked bad by the kernel until somebody sets the mode and
 * calls it good. */
static void mode_add(const struct kms_card *card, struct items *items)
{
	add(items, card->connector, card->connector_crtc, card->crtc);
	if (card->connector_link)
		add(items, card->connector, card->connector_link, DRM_MODE_LINK_STATUS_GOOD);
	add(items, card->crtc, card->crtc_mode, card->mode_blob);
	add(items, card->crtc, card->crtc_active, 1);
}

static int commit(const struct kms_card *card, uint32_t framebuffer, bool modeset, uint32_t flags,
		  void *user)
{
	struct items items = {0};
	if (modeset)
		mode_add(card, &items);
	plane_add(card, &items, framebuffer);
	flags |= modeset ? DRM_MODE_ATOMIC_ALLOW_MODESET : 0;
	return card->calls->commit(card->fd, items.item, items.count, flags, user);
}

int kms_flip(struct kms_card *card, uint32_t framebuffer, bool modeset, void *user)
{
	return commit(card, framebuffer, modeset,
		      DRM_MODE_ATOMIC_NONBLOCK | DRM_MODE_PAGE_FLIP_EVENT, user);
}

int kms_black(struct kms_card *card)
{
	return commit(card, card->black, true, 0, NULL);
}

void kms_dark(struct kms_card *card)
{
	struct items items = {0};
	if (!card->lit || card->fd < 0)
		return;
	card->lit = false;
	add(&items, card->connector, card->connector_crtc, 0);
	add(&items, card->crtc, card->crtc_mode, 0);
	add(&items, card->crtc, card->crtc_active, 0);
	add(&items, card->plane, card->plane_fb, 0);
	add(&items, card->plane, card->plane_crtc, 0);
	card->calls->commit(card->fd, items.item, items.count, DRM_MODE_ATOMIC_ALLOW_MODESET, NULL);
}

/* ---- modes ---- */

static void black_free(struct kms_card *card)
{
	if (card->black)
		card->calls->remove_framebuffer(card->fd, card->black);
	if (card->black_handle)
		card->calls->destroy_dumb(card->fd, card->black_handle);
	card->black = card->black_handle = 0;
}

/* A zeroed buffer of the mode's size: a mode can be tried before GL knows about it. */
static int black_make(struct kms_card *card)
{
	int width = card->mode.hdisplay, height = card->mode.vdisplay;
	uint32_t pitch = 0;
	int result = card->calls->create_dumb(card->fd, width, height, &card->black_handle, &pitch);
	if (result == 0)
		result = card->calls->add_framebuffer(card->fd, width, height, card->black_handle,
						      pitch, DRM_FORMAT_MOD_INVALID, &card->black);
	return result;
}

void kms_mode_drop(struct kms_card *card)
{
	black_free(card);
	if (card->mode_blob)
		card->calls->destroy_blob(card->fd, card->mode_blob);
	card->mode_blob = 0;
}

/* First as a question, then in earnest: drivers have been seen to say yes to the question only. */
static int mode_try(struct kms_card *card, const drmModeModeInfo *mode)
{
	card->mode = *mode;
	int result = card->calls->create_blob(card->fd, mode, sizeof *mode, &card->mode_blob);
	if (result == 0)
		result = black_make(card);
	if (result == 0)
		result = commit(card, card->black, true, DRM_MODE_ATOMIC_TEST_ONLY, NULL);
	if (result == 0)
		result = kms_black(card);
	card->lit = result == 0;
	if (result)
		kms_mode_drop(card);
	return result;
}

/* The lower the sooner: wanted size, or what the kernel's command line asks for (video=); the
 * screen's own choice; sizes that every screen can show. */
static int mode_rank(const drmModeModeInfo *mode, int width, int height)
{
	static const int usual[3][2] = {{1920, 1080}, {1280, 720}, {1024, 768}};
	if (mode->flags & DRM_MODE_FLAG_INTERLACE)
		return 9;
	if ((mode->hdisplay == width && mode->vdisplay == height) ||
	    mode->type & DRM_MODE_TYPE_USERDEF)
		return 0;
	if (mode->type & DRM_MODE_TYPE_PREFERRED)
		return 1;
	for (int i = 0; i < COUNT_OF(usual); i++)
		if (mode->hdisplay == usual[i][0] && mode->vdisplay == usual[i][1])
			return 2 + i;
	return 8;
}

static bool refused(const struct kms_card *card, int mode)
{
	return card->refused[mode / 8] >> mode % 8 & 1;
}

/* A fault that every mode would meet ends the search. */
static bool hopeless(int result)
{
	return result == -EACCES || result == -EPERM || result == -ENODEV;
}

int kms_mode_light(struct kms_card *card, int width, int height)
{
	drmModeConnector *connector = card->calls->get_connector_current(card->fd, card->connector);
	int count = connector ? int_min(connector->count_modes, KMS_MODES_MAX) : 0;
	int result = -EINVAL;
	for (int rank = 0; rank <= 9 && result && !hopeless(result); rank++)
		for (int i = 0; i < count && result && !hopeless(result); i++) {
			const drmModeModeInfo *mode = &connector->modes[i];
			if (refused(card, i) || mode_rank(mode, width, height) != rank)
				continue;
			result = mode_try(card, mode);
		}
	drmModeFreeConnector(connector);
	return result;
}

void kms_mode_refuse(struct kms_card *card)
{
	drmModeConnector *connector = card->calls->get_connector_current(card->fd, card->connector);
	for (int i = 0; connector && i < int_min(connector->count_modes, KMS_MODES_MAX); i++)
		if (!memcmp(&connector->modes[i], &card->mode, sizeof card->mode))
			card->refused[i / 8] |= (uint8_t)(1 << i % 8);
	drmModeFreeConnector(connector);
}

void kms_mode_forgive(struct kms_card *card)
{
	memset(card->refused, 0, sizeof card->refused);
}
