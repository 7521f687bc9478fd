/* A DRM card as one screen: what display_kms.c shows frames through. */
#ifndef DISPLAY_KMS_H
#define DISPLAY_KMS_H

#include "base.h"

#include <xf86drmMode.h>

/* Property ids are looked up once; 0: the object has no such property. */
struct kms_card {
	int fd;
	char path[32];
	uint32_t connector, crtc, plane;
	uint32_t connector_crtc;
	uint32_t crtc_active, crtc_mode;
	uint32_t plane_fb, plane_crtc;
	uint32_t plane_rect[8]; /* SRC_X .. SRC_H, CRTC_X .. CRTC_H */
	drmModeModeInfo mode;
	uint32_t mode_blob;
	uint32_t black, black_handle; /* a framebuffer to begin with */
	bool lit;                     /* a modeset has happened */
};

/* Finds a card with a connected connector, becomes its master, and lights the first mode that the
 * card accepts: wanted size (0: none), preferred, usual sizes, then the rest. False with a line in
 * fault; nothing stays open then. */
bool kms_open(struct kms_card *card, int width, int height, char fault[200]);

/* Turns the screen off. Before any buffer goes: Intel's Type-C ports stay owned otherwise. */
void kms_dark(struct kms_card *card);

/* Lets go of the card; nothing when it is closed. */
void kms_close(struct kms_card *card);

/* Shows a framebuffer from the next vertical blank on; `modeset` sets the mode again as well.
 * 0 or -errno. An event follows on card->fd. */
int kms_flip(struct kms_card *card, uint32_t framebuffer, bool modeset);

/* Is our screen still there, with our mode? `probe` asks the cable, which can take 100 ms. */
bool kms_present(const struct kms_card *card, bool probe);

/* True when some card could be ours. */
bool kms_free(char why_not[200]);

#endif
