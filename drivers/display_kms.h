/* A DRM card as one screen: the calls that reach the kernel, what the card is made of, and the
 * machine that keeps a picture on it. */
#ifndef DISPLAY_KMS_H
#define DISPLAY_KMS_H

#include "display.h"

#include <xf86drm.h>
#include <xf86drmMode.h>

/* --- calls ------------------------------------------------------------------------------------ */

/* One property of an atomic commit. */
struct kms_item {
	uint32_t object, property;
	uint64_t value;
};

/* Everything that reaches the kernel or the clock, so that a test can be both. Names and meanings
 * are libdrm's; what libdrm hands out is freed by its own functions, which only free memory.
 * Results are 0 or -errno. */
struct kms_calls {
	int (*open)(const char *path); /* a descriptor */
	void (*close)(int fd);
	int64_t (*clock_ms)(void);
	int (*wait)(int fd, int limit_ms); /* 1: an event to handle; 0: none; -ENODEV: card gone */
	int (*handle_event)(int fd, drmEventContextPtr events);
	int (*is_master)(int fd);
	int (*set_master)(int fd);
	int (*drop_master)(int fd);
	int (*set_client_cap)(int fd, uint64_t capability, uint64_t value);
	drmModeResPtr (*get_resources)(int fd);
	drmModeConnectorPtr (*get_connector)(int fd, uint32_t connector); /* asks the cable */
	drmModeConnectorPtr (*get_connector_current)(int fd, uint32_t connector);
	drmModeEncoderPtr (*get_encoder)(int fd, uint32_t encoder);
	drmModePlaneResPtr (*get_plane_resources)(int fd);
	drmModePlanePtr (*get_plane)(int fd, uint32_t plane);
	drmModeObjectPropertiesPtr (*get_properties)(int fd, uint32_t object, uint32_t type);
	drmModePropertyPtr (*get_property)(int fd, uint32_t property);
	int (*create_blob)(int fd, const void *data, size_t size, uint32_t *id);
	int (*destroy_blob)(int fd, uint32_t id);
	int (*create_dumb)(int fd, int width, int height, uint32_t *handle, uint32_t *pitch);
	int (*destroy_dumb)(int fd, uint32_t handle);
	/* modifier: DRM_FORMAT_MOD_INVALID for none */
	int (*add_framebuffer)(int fd, int width, int height, uint32_t handle, uint32_t pitch,
			       uint64_t modifier, uint32_t *id);
	int (*remove_framebuffer)(int fd, uint32_t id);
	int (*commit)(int fd, const struct kms_item *items, int count, uint32_t flags, void *user);
};

extern const struct kms_calls kms_kernel; /* libdrm and Linux */

/* --- the card --------------------------------------------------------------------------------- */

enum { KMS_MODES_MAX = 128, KMS_CARDS_MAX = 16 };

/* How far the way to a picture has led; see display_kms_machine.c. The order is that way. */
enum kms_state {
	KMS_NO_CARD,
	KMS_NO_MASTER,
	KMS_NO_DISPLAY,
	KMS_MODESET,
	KMS_LOST,
	KMS_RUN,
	KMS_BROKEN,
};

/* Property ids are looked up once; 0: the object has no such property. */
struct kms_card {
	const struct kms_calls *calls;
	int fd; /* -1: closed */
	int number;
	char path[32];
	uint32_t connector, crtc, plane; /* 0: no screen found */
	uint32_t connector_crtc, connector_link;
	uint32_t crtc_active, crtc_mode;
	uint32_t plane_fb, plane_crtc;
	uint32_t plane_rect[8]; /* SRC_X .. SRC_H, CRTC_X .. CRTC_H */
	drmModeModeInfo mode;
	uint32_t mode_blob;
	uint32_t black, black_handle; /* a framebuffer to begin and to end with */
	bool lit;                     /* a modeset has happened */
	uint8_t refused[KMS_MODES_MAX / 8];
};

/* Opens /dev/dri/card`number`; false, with a line in fault when there is such a card at all. */
bool kms_card_open(struct kms_card *card, const struct kms_calls *calls, int number,
		   char fault[200]);

/* How far this card leads: KMS_NO_CARD (shows no pictures), KMS_NO_MASTER, KMS_NO_DISPLAY, or
 * KMS_MODESET with connector, pipe and plane found. Less than that puts a line into fault. */
enum kms_state kms_card_examine(struct kms_card *card, char fault[200]);

/* Is our screen still there, with our mode? `probe` asks the cable, which can take 100 ms; else it
 * is what the kernel knows. */
bool kms_card_connected(const struct kms_card *card, bool probe);

/* Lets go of the card; nothing when it is closed. */
void kms_card_close(struct kms_card *card);

/* --- modes and commits ------------------------------------------------------------------------ */

/* Lights the first mode that the card accepts, first as a question (TEST_ONLY), then in earnest:
 * wanted size (0: none) or the kernel's command line's, the screen's own choice, usual sizes, the
 * rest; none that was refused.
 * 0 or the -errno of the last try. */
int kms_mode_light(struct kms_card *card, int width, int height);

/* The mode that is lit is no good after all: the next search leaves it out. */
void kms_mode_refuse(struct kms_card *card);
void kms_mode_forgive(struct kms_card *card);
void kms_mode_drop(struct kms_card *card);

/* Shows a framebuffer from the next vertical blank on; `modeset` sets the mode again as well. An
 * event with `user` follows. */
int kms_flip(struct kms_card *card, uint32_t framebuffer, bool modeset, void *user);

/* Black on the screen, so that what was shown may go. Waits for the blank. */
int kms_black(struct kms_card *card);

/* Turns the screen off. Before any buffer goes: Intel's Type-C ports stay owned otherwise. */
void kms_dark(struct kms_card *card);

/* --- the machine ------------------------------------------------------------------------------ */

/* What the machine needs of GBM, EGL and GL. Buffers are the picture's own. */
struct kms_picture {
	/* for card->mode; generation by generation anew */
	bool (*open)(void *of, const struct kms_card *card, char fault[200]);
	void (*close)(void *of);
	/* The frame that was drawn, and its framebuffer; NULL: GL has lost its context. */
	void *(*take)(void *of, uint32_t *framebuffer);
	void (*give)(void *of, void *buffer); /* may be drawn into again */
};

struct kms;

/* Which commit an event belongs to; later commits make it void. */
struct kms_ticket {
	struct kms *kms;
	bool void_now;
};

struct kms {
	const struct kms_calls *calls;
	const struct kms_picture *picture;
	void *of;
	enum kms_state state;
	struct kms_card card;
	int width, height; /* wanted, 0: any */
	bool changed;      /* something happened to some card: the host sets it */
	bool opened;       /* the picture is */
	int generation;    /* pictures opened so far */
	int64_t due_ms;    /* of the next look or try */

	void *shown, *next;   /* buffers: on the screen, on the way there */
	uint32_t framebuffer; /* of next */
	bool asked;           /* next was committed, its event is due */
	bool again;           /* the next commit sets the mode as well */
	int64_t deadline_ms;  /* of the flip */
	struct kms_ticket ticket[2];
	int ticket_now;

	int rung;   /* of the ladder, for the flip that is late */
	int failed; /* times that reopening brought no flip */
	int lost;   /* tries to get GL back */
	long flips, late, unplugged, reopened;
	char reason[200]; /* why there is no picture */
};

void kms_begin(struct kms *kms, const struct kms_calls *calls, const struct kms_picture *picture,
	       void *of);

/* One step on the way to a picture, or of keeping it: call once a frame. DISPLAY_READY: draw, then
 * kms_show. Waits for a flip two frames at most. */
enum display_state kms_step(struct kms *kms);

/* The frame is drawn: on its way to the screen. False: it was lost. */
bool kms_show(struct kms *kms);

/* Turns the screen off and lets go of everything. */
void kms_end(struct kms *kms);

#endif
