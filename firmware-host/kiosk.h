/* The machine without its devices: raw reports in, a state and a journal out. The station, replay
 * and the tests all run this; only where the reports come from differs. */
#ifndef KIOSK_H
#define KIOSK_H

#include "journal.h"
#include "pen.h"
#include "ui.h"

struct kiosk {
	struct arena arena;
	struct pen pen;
	struct ui ui;
	struct session session;
	struct frame_input input;
	struct edit_list edits;
	int frame;     /* frames run */
	int steps;     /* frames since the last line of the journal */
	char *journal; /* this frame's lines; the host writes them where it likes */
	int journal_size;
	char journal_line[JOURNAL_LINE_MAX];
};

/* Takes memory of KIOSK_MEMORY_BYTES (limits.h) for everything and seals it. The body must be built
 * next: kiosk->session.body. */
void kiosk_init(struct kiosk *kiosk, void *memory, int width_px, int height_px);

/* Names the body in the journal; call when it has been built. */
void kiosk_body_named(struct kiosk *kiosk, const char *name);

/* One frame, from bytes on the wire to a picture to draw. `unplugged` is a bit set of devices.
 * Read this function first. */
void kiosk_frame(struct kiosk *kiosk, const struct frame_reports *reports, unsigned unplugged);

/* Its stages, in this order, for whoever times them one by one (tests/bench_frame.c). */
void kiosk_listen(struct kiosk *kiosk, const struct frame_reports *reports, unsigned unplugged);
void kiosk_face(struct kiosk *kiosk);
void kiosk_apply(struct kiosk *kiosk);
void kiosk_advance(struct kiosk *kiosk);

/* Ends the journal: the frames since the last line. */
void kiosk_finish(struct kiosk *kiosk);

#endif
