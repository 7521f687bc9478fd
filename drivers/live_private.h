/* What live.c (queue, threads) and live_tablet.c (tablets) share. */
#ifndef LIVE_PRIVATE_H
#define LIVE_PRIVATE_H

#include "live_setup.h"

#include <libudev.h>
#include <pthread.h>

enum {
	QUEUE_MAX = 1024,   /* reports: 2 s of a 500 Hz tablet */
	QUEUE_RESERVE = 16, /* kept free for plugging and unplugging */
	SIZE_UNPLUGGED = 0,
	SIZE_PLUGGED = -1,
};

/* What libwacom's data said of the last tablets that were asked about: it is large, and read anew
 * each time. */
enum { MODELS_MAX = 4 };

struct live_model {
	int vendor, product;
	char name[128];
	bool known, display;
	float width_mm, height_mm;
};

struct live_models {
	long asked;
	struct live_model model[MODELS_MAX];
};

const struct live_model *live_model_remembered(struct live_models *models,
					       const struct live_node *node);

struct tablet {
	int fd; /* -1: free */
	bool own;
	char path[64];
	char place[96];
	int layout_count;
	struct pen_layout layout[PEN_REPORTS_MAX];
	struct pen_memory memory;

	bool plugged;        /* the frame loop knows of it */
	bool sets_up;        /* it has a recipe */
	unsigned job;        /* of live_setup.h */
	int usb;             /* the same for the interfaces of one USB device; 0: none */
	int64_t renew_at_us; /* not set up again before */
	int renewals;
	unsigned touch;      /* what the last report said: the tip's, and the other switches */
	int64_t credit_us;   /* of thinning: what it may send at once */
	int64_t credited_us; /* when that was counted */
	char reason[160];    /* why it could not be set up; "" it was, or need not be */
};

struct live {
	pthread_t thread[2]; /* reader, searcher */
	int stop, opened;    /* event descriptors: both threads end; a tablet was opened */
	int64_t start_us;
	struct board board;
	struct udev *udev;
	struct udev_monitor *monitor;
	struct live_node *nodes; /* the searcher's, and: */
	struct live_models models;
	struct live_setup *setup;

	pthread_mutex_t lock; /* for all below */
	struct tablet tablet[LIVE_TABLETS_MAX];
	struct tape_device told[PEN_DEVICES_MAX];
	unsigned jobs;
	int first, count;
	long lost;
	char text[LIVE_TEXT_MAX];
	struct raw_report queue[QUEUE_MAX];
};

/* With live->lock held. */
void live_queue(struct live *live, int device, int size, const uint8_t *bytes);

/* Opens what is new and wanted. */
void live_tablets_search(struct live *live);

/* Takes what one tablet has ready. */
void live_tablet_read(struct live *live, int device);

/* What the thread of live_setup.c found out. */
live_setup_done live_tablet_set_up;

#endif
