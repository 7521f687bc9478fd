/* A thread of its own that makes tablets speak their makers' protocols, so that neither the frame
 * loop nor the reading of other tablets waits for a device that does not answer. Private to live.c.
 *
 * A job stays with its tablet: what fails is tried again after 1, 2, 4 and 8 seconds, and what a
 * tablet forgets is set up again when live.c asks for it. */
#ifndef LIVE_SETUP_H
#define LIVE_SETUP_H

#include "live.h"

struct live_setup;

/* Called from the thread; `job` tells a tablet from one that had the same number before. */
typedef void live_setup_done(void *context, int device, unsigned job,
			     const struct pen_setup_result *result);

/* NULL: no memory or no thread. */
struct live_setup *live_setup_open(live_setup_done *done, void *context);
void live_setup_close(struct live_setup *setup);

/* Sets up this tablet as soon as possible, by its USB address, or by `transport` where it is not
 * NULL (it must outlive the thread). */
void live_setup_start(struct live_setup *setup, int device, unsigned job,
		      const struct live_node *node, const struct pen_transport *transport);

/* Once more, at once. */
void live_setup_again(struct live_setup *setup, int device);

/* The tablet is gone. Returns at once; a step in progress ends on its own. */
void live_setup_forget(struct live_setup *setup, int device);

#endif
