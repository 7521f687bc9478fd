#include "fake_card.h"

#include <drm_mode.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>

/* Objects of a card: ids by kind. */
enum { CRTC = 40, CONNECTOR = 50, ENCODER = 60, PLANE = 70, CURSOR = 80, FD = 100 };

/* Properties by name; ids are places + 1. */
static const char *const property_name[] = {
	"CRTC_ID", "link-status", "ACTIVE", "MODE_ID", "FB_ID",  "SRC_X",  "SRC_Y",
	"SRC_W",   "SRC_H",       "CRTC_X", "CRTC_Y",  "CRTC_W", "CRTC_H", "type",
};
enum { P_CRTC = 1, P_LINK, P_ACTIVE, P_MODE, P_FB, P_SRC_X, P_TYPE = 14 };

#define MODE(w, h, hz, kind)                                                                       \
	{                                                                                          \
		.hdisplay = (w), .vdisplay = (h), .vrefresh = (hz), .type = (kind)                 \
	}
const drmModeModeInfo fake_modes[FAKE_MODES] = {
	MODE(1920, 1080, 60, DRM_MODE_TYPE_PREFERRED),
	MODE(1280, 720, 60, 0),
	MODE(1024, 768, 60, 0),
	MODE(800, 600, 60, 0),
	MODE(1366, 768, 60, DRM_MODE_TYPE_PREFERRED), /* another screen's */
	MODE(640, 480, 60, 0),
};

struct fake_card fake[FAKE_CARDS];
int64_t fake_us;

static struct fake_card *card_of(int fd)
{
	struct fake_card *card = &fake[(fd - FD) % FAKE_CARDS];
	MUST(fd >= FD && card->fds > 0 && fd == card->fd);
	return card;
}

void fake_begin(void)
{
	memset(fake, 0, sizeof fake);
	fake_us = 0;
	fake[0].there = true;
	for (int i = 0; i < FAKE_CARDS; i++)
		for (int k = 0; k < FAKE_CONNECTORS; k++)
			fake[i].connector[k].mode_count = 4;
	fake_screen(&fake[0], 0, true, true);
}

void fake_screen(struct fake_card *card, int connector, bool connected, bool told)
{
	card->connector[connector].connected = connected;
	if (told)
		card->connector[connector].known = connected;
}

uint32_t fake_seen(const struct fake_card *card, int *mode)
{
	for (int i = 0; i < FAKE_CONNECTORS; i++) {
		int crtc = (int)card->connector_crtc[i] - CRTC;
		if (!card->connector[i].connected || crtc < 0 || !card->crtc_active[crtc])
			continue;
		*mode = card->blob_mode[card->crtc_mode[crtc] % 64];
		return card->scanned[crtc];
	}
	return 0;
}

bool fake_clean(void)
{
	bool clean = true;
	for (int i = 0; i < FAKE_CARDS; i++) {
		const struct fake_card *c = &fake[i];
		if (c->fds || c->framebuffers || c->dumbs || c->blobs) {
			printf("card %d: %d descriptors, %d framebuffers, %d buffers, %d blobs "
			       "left\n",
			       i, c->fds, c->framebuffers, c->dumbs, c->blobs);
			clean = false;
		}
	}
	return clean;
}

/* ---- time ---- */

/* The blank has come: what is pending is done, and its event may be read. */
static void settle(struct fake_card *card)
{
	if (!card->pending || card->hung || fake_us < card->pending_us)
		return;
	card->pending = false;
	memcpy(card->scanned, card->plane_framebuffer, sizeof card->scanned);
	if (card->pending_event) {
		card->event = true;
		card->event_user = card->pending_user;
	}
	card->pending_event = false;
}

static int64_t clock_ms(void)
{
	return fake_us / 1000;
}

static int wait_event(int fd, int limit_ms)
{
	struct fake_card *card = card_of(fd);
	if (card->unplugged)
		return -ENODEV;
	int64_t until_us = fake_us + (int64_t)limit_ms * 1000;
	if (card->event)
		return 1;
	if (card->pending && card->pending_event && !card->hung && card->pending_us <= until_us) {
		fake_us = fake_us > card->pending_us ? fake_us : card->pending_us;
		settle(card);
	}
	if (card->event)
		return 1;
	fake_us = until_us;
	return 0;
}

static int handle_event(int fd, drmEventContextPtr events)
{
	struct fake_card *card = card_of(fd);
	if (card->event)
		events->page_flip_handler2(fd, 0, 0, 0, CRTC, card->event_user);
	card->event = false;
	return 0;
}

/* ---- descriptors and mastery ---- */

static int card_open(const char *path)
{
	int number = atoi(path + strlen("/dev/dri/card"));
	struct fake_card *card = number < FAKE_CARDS ? &fake[number] : NULL;
	if (!card || !card->there)
		return -ENOENT;
	MUST(card->fds++ == 0);
	card->fd += card->fd ? FAKE_CARDS : FD + number;
	card->unplugged = card->atomic = false;
	card->master = !card->other_master;
	return card->fd;
}

static void card_close(int fd)
{
	struct fake_card *card = card_of(fd);
	card->fds--;
	card->master = card->pending = card->event = false;
	memset(card->plane_framebuffer, 0, sizeof card->plane_framebuffer);
	memset(card->scanned, 0, sizeof card->scanned);
	card->stale_user = NULL;
}

static int is_master(int fd)
{
	return card_of(fd)->master && !card_of(fd)->other_master;
}

static int set_master(int fd)
{
	struct fake_card *card = card_of(fd);
	if (card->other_master)
		return -EBUSY;
	return card->master ? 0 : -EACCES;
}

static int drop_master(int fd)
{
	(void)card_of(fd);
	return 0;
}

static int set_client_cap(int fd, uint64_t capability, uint64_t value)
{
	struct fake_card *card = card_of(fd);
	if (card->no_atomic || !value)
		return -EOPNOTSUPP;
	card->atomic |= capability == DRM_CLIENT_CAP_ATOMIC;
	return 0;
}

/* ---- objects ---- */

static uint32_t *ids(uint32_t first, int count)
{
	uint32_t *list = calloc((size_t)count, sizeof *list);
	MUST(list);
	for (int i = 0; i < count; i++)
		list[i] = first + (uint32_t)i;
	return list;
}

static void *object(size_t size)
{
	void *memory = calloc(1, size);
	MUST(memory);
	return memory;
}

static drmModeResPtr get_resources(int fd)
{
	struct fake_card *card = card_of(fd);
	if (card->unplugged || card->render_only)
		return NULL;
	drmModeResPtr found = object(sizeof *found);
	found->count_connectors = FAKE_CONNECTORS;
	found->connectors = ids(CONNECTOR, FAKE_CONNECTORS);
	found->count_crtcs = FAKE_CRTCS;
	found->crtcs = ids(CRTC, FAKE_CRTCS);
	return found;
}

static drmModeConnectorPtr get_connector_current(int fd, uint32_t id)
{
	struct fake_card *card = card_of(fd);
	const struct fake_connector *connector = &card->connector[id - CONNECTOR];
	if (card->unplugged || card->no_objects)
		return NULL;
	drmModeConnectorPtr found = object(sizeof *found);
	found->connector_id = id;
	found->connection = connector->known ? DRM_MODE_CONNECTED : DRM_MODE_DISCONNECTED;
	found->count_encoders = 1;
	found->encoders = ids(ENCODER + id - CONNECTOR, 1);
	found->count_modes = connector->known ? connector->mode_count : 0;
	found->modes = object(sizeof fake_modes);
	memcpy(found->modes, fake_modes + connector->modes_offset,
	       (size_t)found->count_modes * sizeof *fake_modes);
	if (card->mode_asked)
		found->modes[card->mode_asked - 1].type |= DRM_MODE_TYPE_USERDEF;
	return found;
}

static drmModeConnectorPtr get_connector(int fd, uint32_t id)
{
	struct fake_connector *connector = &card_of(fd)->connector[id - CONNECTOR];
	fake_us += FAKE_PROBE_MS * 1000;
	connector->known = connector->connected;
	return get_connector_current(fd, id);
}

static drmModeEncoderPtr get_encoder(int fd, uint32_t id)
{
	(void)card_of(fd);
	drmModeEncoderPtr found = object(sizeof *found);
	found->encoder_id = id;
	found->possible_crtcs = 3;
	return found;
}

/* A cursor plane stands before each pipe's primary one. */
static drmModePlaneResPtr get_plane_resources(int fd)
{
	if (card_of(fd)->no_objects)
		return NULL;
	drmModePlaneResPtr found = object(sizeof *found);
	found->count_planes = 2 * FAKE_CRTCS;
	found->planes = ids(CURSOR, 2 * FAKE_CRTCS);
	for (int i = 0; i < FAKE_CRTCS; i++)
		found->planes[2 * i + 1] = PLANE + (uint32_t)i;
	return found;
}

static drmModePlanePtr get_plane(int fd, uint32_t id)
{
	(void)card_of(fd);
	drmModePlanePtr found = object(sizeof *found);
	found->plane_id = id;
	found->possible_crtcs = id >= CURSOR ? 3 : 1u << (id - PLANE);
	return found;
}

static drmModeObjectPropertiesPtr get_properties(int fd, uint32_t id, uint32_t type)
{
	(void)card_of(fd);
	drmModeObjectPropertiesPtr found = object(sizeof *found);
	found->count_props = COUNT_OF(property_name);
	found->props = ids(1, COUNT_OF(property_name));
	found->prop_values = object(COUNT_OF(property_name) * sizeof *found->prop_values);
	found->prop_values[P_TYPE - 1] = id >= CURSOR ? DRM_PLANE_TYPE_CURSOR
						      : DRM_PLANE_TYPE_PRIMARY;
	MUST(type == DRM_MODE_OBJECT_PLANE || id < ENCODER);
	return found;
}

static drmModePropertyPtr get_property(int fd, uint32_t id)
{
	(void)card_of(fd);
	drmModePropertyPtr found = object(sizeof *found);
	found->prop_id = id;
	snprintf(found->name, sizeof found->name, "%s", property_name[id - 1]);
	return found;
}

/* ---- memory of the card ---- */

static uint32_t next_id;

static int create_blob(int fd, const void *data, size_t size, uint32_t *id)
{
	struct fake_card *card = card_of(fd);
	MUST(size == sizeof *fake_modes);
	if (card->unplugged || card->memory_full)
		return card->unplugged ? -ENODEV : -ENOMEM;
	*id = ++next_id;
	for (int i = 0; i < FAKE_MODES; i++)
		if (((const drmModeModeInfo *)data)->hdisplay == fake_modes[i].hdisplay)
			card->blob_mode[*id % 64] = i;
	card->blobs++;
	return 0;
}

static int destroy_blob(int fd, uint32_t id)
{
	MUST(id);
	card_of(fd)->blobs--;
	return 0;
}

static int create_dumb(int fd, int width, int height, uint32_t *handle, uint32_t *pitch)
{
	struct fake_card *card = card_of(fd);
	MUST(width > 0 && height > 0);
	if (card->unplugged || card->memory_full)
		return card->unplugged ? -ENODEV : -ENOMEM;
	*handle = ++next_id;
	*pitch = (uint32_t)width * 4;
	card->dumbs++;
	return 0;
}

static int destroy_dumb(int fd, uint32_t handle)
{
	MUST(handle);
	card_of(fd)->dumbs--;
	return 0;
}

static int add_framebuffer(int fd, int width, int height, uint32_t handle, uint32_t pitch,
			   uint64_t modifier, uint32_t *id)
{
	struct fake_card *card = card_of(fd);
	MUST(width > 0 && height > 0 && handle && pitch);
	(void)modifier;
	if (card->unplugged || card->memory_full)
		return card->unplugged ? -ENODEV : -ENOMEM;
	MUST(card->framebuffers < FAKE_FRAMEBUFFERS);
	*id = ++next_id;
	card->framebuffer[card->framebuffers++] = *id;
	return 0;
}

/* A framebuffer that is on the screen takes the picture with it. */
static int remove_framebuffer(int fd, uint32_t id)
{
	struct fake_card *card = card_of(fd);
	int i = 0;
	while (i < card->framebuffers && card->framebuffer[i] != id)
		i++;
	MUST(i < card->framebuffers);
	card->framebuffer[i] = card->framebuffer[--card->framebuffers];
	for (int k = 0; k < FAKE_CRTCS; k++)
		if (card->plane_framebuffer[k] == id)
			card->plane_framebuffer[k] = card->scanned[k] = 0;
	return 0;
}

/* ---- commits ---- */

struct wish {
	bool modeset;
	int crtc; /* -1: none is lit */
	uint32_t mode, active, framebuffer, connector, connector_crtc;
};

static struct wish wish_read(const struct kms_item *items, int count)
{
	struct wish wish = {.crtc = -1};
	for (int i = 0; i < count; i++) {
		uint32_t value = (uint32_t)items[i].value, on = items[i].object;
		switch (items[i].property) {
		case P_CRTC:
			if (on < ENCODER) {
				wish.connector = on;
				wish.connector_crtc = value;
				wish.modeset = true;
			} else if (value) {
				wish.crtc = (int)value - CRTC;
			} else {
				wish.crtc = (int)on - PLANE;
			}
			break;
		case P_MODE:
			wish.mode = value;
			break;
		case P_ACTIVE:
			wish.active = value;
			break;
		case P_FB:
			wish.framebuffer = value;
			break;
		default:
			MUST(items[i].property >= P_LINK && items[i].property < P_TYPE);
		}
	}
	MUST(wish.crtc >= 0 && wish.crtc < FAKE_CRTCS);
	return wish;
}

static int fault_take(struct fake_card *card, uint32_t flags)
{
	bool flip = flags & DRM_MODE_PAGE_FLIP_EVENT;
	bool modeset = flags & DRM_MODE_ATOMIC_ALLOW_MODESET;
	unsigned kind = flags & DRM_MODE_ATOMIC_TEST_ONLY ? FAKE_TEST
			: !flip                           ? FAKE_BLOCKING
			: modeset                         ? FAKE_FLIP_MODESET
							  : FAKE_FLIP;
	if (!(card->fault.when & kind) || card->fault.count == 0)
		return 0;
	card->fault.count -= card->fault.count > 0;
	return card->fault.error;
}

static int wish_check(const struct fake_card *card, const struct wish *wish, uint32_t flags)
{
	bool known = wish->framebuffer == 0;
	for (int i = 0; i < card->framebuffers; i++)
		known |= card->framebuffer[i] == wish->framebuffer;
	MUST(known);
	if (!wish->modeset)
		return card->crtc_active[wish->crtc] ? 0 : -EINVAL;
	if (!(flags & DRM_MODE_ATOMIC_ALLOW_MODESET))
		return -EINVAL;
	int mode = card->blob_mode[wish->mode % 64];
	bool lied = card->modes_lied >> mode & 1 && !(flags & DRM_MODE_ATOMIC_TEST_ONLY);
	return wish->mode && (lied || card->modes_refused >> mode & 1) ? -EINVAL : 0;
}

static void wish_apply(struct fake_card *card, const struct wish *wish)
{
	card->plane_framebuffer[wish->crtc] = wish->framebuffer;
	if (!wish->modeset)
		return;
	card->connector_crtc[wish->connector - CONNECTOR] = wish->connector_crtc;
	card->crtc_mode[wish->crtc] = wish->mode;
	card->crtc_active[wish->crtc] = wish->active;
	card->modesets++;
}

static void flip_begin(struct fake_card *card, void *user)
{
	card->pending = card->pending_event = true;
	card->pending_us = (fake_us / FAKE_FRAME_US + 1) * FAKE_FRAME_US +
			   (int64_t)card->event_late_ms * 1000;
	card->pending_user = user;
	card->event_late_ms = 0;
	if (card->stale_user) {
		card->event = true;
		card->event_user = card->stale_user;
		card->stale_user = NULL;
	}
	if (card->events_lost) {
		card->pending_event = false;
		card->stale_user = card->stale_event ? user : NULL;
		card->stale_event = false;
		card->events_lost -= card->events_lost > 0;
	}
}

static int commit(int fd, const struct kms_item *items, int count, uint32_t flags, void *user)
{
	struct fake_card *card = card_of(fd);
	MUST(card->atomic);
	if (card->unplugged)
		return -ENODEV;
	if (!is_master(fd))
		return -EACCES;
	settle(card);
	int error = fault_take(card, flags);
	if (error)
		return error;
	struct wish wish = wish_read(items, count);
	if (card->pending && flags & DRM_MODE_ATOMIC_NONBLOCK)
		return -EBUSY;
	error = wish_check(card, &wish, flags);
	card->commits++;
	card->tests += flags & DRM_MODE_ATOMIC_TEST_ONLY ? 1 : 0;
	if (error || flags & DRM_MODE_ATOMIC_TEST_ONLY)
		return error;
	if (!(flags & DRM_MODE_ATOMIC_NONBLOCK)) {
		fake_us += (card->hung ? FAKE_HUNG_MS : FAKE_MODESET_MS) * 1000;
		card->pending_event &= !card->hung;
		card->pending &= !card->hung;
		settle(card);
	}
	wish_apply(card, &wish);
	if (flags & DRM_MODE_PAGE_FLIP_EVENT)
		flip_begin(card, user);
	else
		memcpy(card->scanned, card->plane_framebuffer, sizeof card->scanned);
	return 0;
}

const struct kms_calls fake_calls = {
	.open = card_open,
	.close = card_close,
	.clock_ms = clock_ms,
	.wait = wait_event,
	.handle_event = handle_event,
	.is_master = is_master,
	.set_master = set_master,
	.drop_master = drop_master,
	.set_client_cap = set_client_cap,
	.get_resources = get_resources,
	.get_connector = get_connector,
	.get_connector_current = get_connector_current,
	.get_encoder = get_encoder,
	.get_plane_resources = get_plane_resources,
	.get_plane = get_plane,
	.get_properties = get_properties,
	.get_property = get_property,
	.create_blob = create_blob,
	.destroy_blob = destroy_blob,
	.create_dumb = create_dumb,
	.destroy_dumb = destroy_dumb,
	.add_framebuffer = add_framebuffer,
	.remove_framebuffer = remove_framebuffer,
	.commit = commit,
};
