/* DRM's objects: which card, connector, pipe and plane. */
#include "display_kms.h"

#include <drm_mode.h>
#include <errno.h>
#include <stdio.h>

enum { CONNECTORS_MAX = 32 };

static uint32_t property_find(const struct kms_card *card, uint32_t object, uint32_t type,
			      const char *name, uint64_t *value)
{
	uint32_t id = 0;
	drmModeObjectProperties *list = card->calls->get_properties(card->fd, object, type);
	for (uint32_t i = 0; list && !id && i < list->count_props; i++) {
		drmModePropertyRes *property = card->calls->get_property(card->fd, list->props[i]);
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
static uint32_t crtcs_of(const struct kms_card *card, const drmModeConnector *connector)
{
	uint32_t mask = 0;
	for (int i = 0; i < connector->count_encoders; i++) {
		drmModeEncoder *encoder = card->calls->get_encoder(card->fd,
								   connector->encoders[i]);
		mask |= encoder ? encoder->possible_crtcs : 0;
		drmModeFreeEncoder(encoder);
	}
	return mask;
}

static uint32_t primary_plane(const struct kms_card *card, int crtc_index)
{
	uint32_t found = 0;
	drmModePlaneRes *planes = card->calls->get_plane_resources(card->fd);
	for (uint32_t i = 0; planes && !found && i < planes->count_planes; i++) {
		drmModePlane *plane = card->calls->get_plane(card->fd, planes->planes[i]);
		uint64_t type = 0;
		if (plane && plane->possible_crtcs >> crtc_index & 1 &&
		    property_find(card, plane->plane_id, DRM_MODE_OBJECT_PLANE, "type", &type) &&
		    type == DRM_PLANE_TYPE_PRIMARY)
			found = plane->plane_id;
		drmModeFreePlane(plane);
	}
	drmModeFreePlaneResources(planes);
	return found;
}

/* Picks connector, CRTC and plane. Asks every cable. */
static bool pipe_find(struct kms_card *card, const drmModeRes *resources)
{
	for (int c = 0; c < int_min(resources->count_connectors, CONNECTORS_MAX); c++) {
		drmModeConnector *connector = card->calls->get_connector(card->fd,
									 resources->connectors[c]);
		if (!connector)
			continue;
		uint32_t mask = connector->connection == DRM_MODE_CONNECTED &&
						connector->count_modes
					? crtcs_of(card, connector)
					: 0;
		for (int k = 0; k < resources->count_crtcs; k++) {
			uint32_t plane = mask >> k & 1 ? primary_plane(card, k) : 0;
			if (!plane)
				continue;
			card->connector = connector->connector_id;
			card->crtc = resources->crtcs[k];
			card->plane = plane;
			break;
		}
		drmModeFreeConnector(connector);
		if (card->plane)
			return true;
	}
	return false;
}

static bool properties_find(struct kms_card *card)
{
	static const char *const rect_name[8] = {"SRC_X",  "SRC_Y",  "SRC_W",  "SRC_H",
						 "CRTC_X", "CRTC_Y", "CRTC_W", "CRTC_H"};
	uint32_t plane = DRM_MODE_OBJECT_PLANE, crtc = DRM_MODE_OBJECT_CRTC;
	bool all = true;
	card->connector_link = property_find(card, card->connector, DRM_MODE_OBJECT_CONNECTOR,
					     "link-status", NULL);
	card->connector_crtc = property_find(card, card->connector, DRM_MODE_OBJECT_CONNECTOR,
					     "CRTC_ID", NULL);
	card->crtc_active = property_find(card, card->crtc, crtc, "ACTIVE", NULL);
	card->crtc_mode = property_find(card, card->crtc, crtc, "MODE_ID", NULL);
	card->plane_fb = property_find(card, card->plane, plane, "FB_ID", NULL);
	card->plane_crtc = property_find(card, card->plane, plane, "CRTC_ID", NULL);
	for (int i = 0; i < 8; i++) {
		card->plane_rect[i] = property_find(card, card->plane, plane, rect_name[i], NULL);
		all = all && card->plane_rect[i];
	}
	return all && card->connector_crtc && card->crtc_active && card->crtc_mode &&
	       card->plane_fb && card->plane_crtc;
}

/* ---- the card ---- */

/* The first who opens a card is its master; after that only asking helps, and only root or who was
 * master before: so the card is opened anew for each try. */
static bool master_take(const struct kms_card *card)
{
	return card->calls->is_master(card->fd) || card->calls->set_master(card->fd) == 0;
}

bool kms_card_open(struct kms_card *card, const struct kms_calls *calls, int number,
		   char fault[200])
{
	*card = (struct kms_card){.calls = calls, .number = number};
	snprintf(card->path, sizeof card->path, "/dev/dri/card%d", number);
	card->fd = calls->open(card->path);
	if (card->fd >= 0)
		return true;
	if (card->fd != -ENOENT)
		snprintf(fault, 200, "%s: %s%s", card->path, strerror(-card->fd),
			 card->fd == -EACCES ? "; add the user to group video" : "");
	card->fd = -1;
	return false;
}

static enum kms_state examine(struct kms_card *card, const drmModeRes *resources, char fault[200])
{
	const struct kms_calls *calls = card->calls;
	if (!resources || resources->count_connectors < 1) {
		snprintf(fault, 200, "%s shows no pictures (a render-only card)", card->path);
		return KMS_NO_CARD;
	}
	if (calls->set_client_cap(card->fd, DRM_CLIENT_CAP_UNIVERSAL_PLANES, 1) ||
	    calls->set_client_cap(card->fd, DRM_CLIENT_CAP_ATOMIC, 1)) {
		snprintf(fault, 200, "%s has no atomic mode setting: use a newer kernel driver",
			 card->path);
		return KMS_NO_CARD;
	}
	if (!master_take(card)) {
		snprintf(fault, 200,
			 "%s belongs to another program: stop the desktop or the splash "
			 "screen that holds it",
			 card->path);
		return KMS_NO_MASTER;
	}
	if (!pipe_find(card, resources)) {
		snprintf(fault, 200, "%s has no screen attached: plug one in, switch it on",
			 card->path);
		return KMS_NO_DISPLAY;
	}
	if (!properties_find(card)) {
		snprintf(fault, 200, "%s lacks properties of atomic mode setting", card->path);
		return KMS_NO_CARD;
	}
	return KMS_MODESET;
}

enum kms_state kms_card_examine(struct kms_card *card, char fault[200])
{
	drmModeRes *resources = card->calls->get_resources(card->fd);
	card->connector = card->crtc = card->plane = 0;
	enum kms_state state = examine(card, resources, fault);
	drmModeFreeResources(resources);
	return state;
}

bool kms_card_connected(const struct kms_card *card, bool probe)
{
	drmModeConnector *connector = probe ? card->calls->get_connector(card->fd, card->connector)
					    : card->calls->get_connector_current(card->fd,
										 card->connector);
	bool found = false;
	if (connector && connector->connection == DRM_MODE_CONNECTED)
		for (int i = 0; i < connector->count_modes && !found; i++)
			found = connector->modes[i].hdisplay == card->mode.hdisplay &&
				connector->modes[i].vdisplay == card->mode.vdisplay;
	drmModeFreeConnector(connector);
	return found;
}

void kms_card_close(struct kms_card *card)
{
	if (card->fd < 0)
		return;
	kms_mode_drop(card);
	card->calls->drop_master(card->fd);
	card->calls->close(card->fd);
	card->fd = -1;
}
