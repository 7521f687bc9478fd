/* Simulated DRM cards behind display_kms.h's table of calls: connectors, pipes, planes, modes,
 * atomic commits checked as the kernel checks them, flips on a clock that only runs when somebody
 * waits. Whatever the kernel can answer can be injected. */
#ifndef FAKE_CARD_H
#define FAKE_CARD_H

#include "display_kms.h"

enum {
	FAKE_CARDS = 2,
	FAKE_CONNECTORS = 3,
	FAKE_CRTCS = 2,
	FAKE_MODES = 6,
	FAKE_FRAMEBUFFERS = 16,
	FAKE_FRAME_US = 16667,
	FAKE_MODESET_MS = 150, /* what a blocking modeset takes */
	FAKE_PROBE_MS = 80,    /* what asking a cable takes */
	FAKE_HUNG_MS = 2000,   /* until the kernel gives a flip up that hangs */
};

/* What goes wrong with commits: `error` for `count` commits of the kinds in `when`. */
enum fake_when {
	FAKE_TEST = 1,
	FAKE_BLOCKING = 2,
	FAKE_FLIP = 4,
	FAKE_FLIP_MODESET = 8,
	FAKE_ALL = 15,
};

struct fake_fault {
	unsigned when;
	int error;
	int count; /* -1: for ever */
};

struct fake_connector {
	bool connected;   /* is a screen there */
	bool known;       /* does the kernel know: it learns by asking or by an interrupt */
	bool mute;        /* the kernel never learns by itself */
	int modes_offset; /* the first of the screen's modes in fake_modes */
	int mode_count;
};

struct fake_card {
	bool there;       /* has a node */
	bool unplugged;   /* taken out while open: every call fails */
	bool render_only; /* shows no pictures */
	bool no_atomic;
	bool other_master; /* another program holds it */
	bool no_objects;   /* connectors and planes can't be asked for (ENOMEM) */
	struct fake_connector connector[FAKE_CONNECTORS];
	struct fake_fault fault;
	int mode_asked;         /* this - 1 is the mode of the kernel's command line */
	unsigned modes_refused; /* bit per mode: not even TEST_ONLY lets it pass */
	unsigned modes_lied;    /* TEST_ONLY passes, the commit doesn't */
	int events_lost;        /* flips whose event never comes; -1: all */
	bool stale_event;       /* a lost event comes after all, when the next is asked for */
	int event_late_ms;      /* for the next event */
	bool hung;              /* no flip ends: the next one is told EBUSY */
	bool memory_full;       /* no blobs, buffers, framebuffers */

	/* what a client did */
	int fds, fd; /* open ones; the last */
	bool master; /* the fd's */
	bool atomic;
	uint32_t framebuffer[FAKE_FRAMEBUFFERS];
	int framebuffers, dumbs, blobs;
	int blob_mode[64]; /* mode of a blob's id */
	uint32_t crtc_mode[FAKE_CRTCS], crtc_active[FAKE_CRTCS];
	uint32_t connector_crtc[FAKE_CONNECTORS];
	uint32_t plane_framebuffer[FAKE_CRTCS];
	uint32_t scanned[FAKE_CRTCS]; /* what the pipe reads until the blank */
	bool pending, pending_event;  /* a flip until pending_us; with an event */
	int64_t pending_us;
	void *pending_user;
	bool event; /* can be read */
	void *event_user, *stale_user;
	long commits, modesets, tests;
};

extern struct fake_card fake[FAKE_CARDS];
extern int64_t fake_us;
extern const struct kms_calls fake_calls;
extern const drmModeModeInfo fake_modes[FAKE_MODES];

/* One sound card with one screen at 1920 x 1080 on its first connector. */
void fake_begin(void);

/* A screen comes or goes; `told` when the kernel notices (uevent: set kms.changed too). */
void fake_screen(struct fake_card *card, int connector, bool connected, bool told);

/* The framebuffer that is seen, and on which mode; 0: dark. */
uint32_t fake_seen(const struct fake_card *card, int *mode);

/* Everything that was taken has been given back. */
bool fake_clean(void);

#endif
