/* Pictures of the station's screen without a display: what a visitor would see, as pixels. */
#ifndef SNAPSHOT_H
#define SNAPSHOT_H

#include "display.h"
#include "draw.h"
#include "store.h"

struct snapshot {
	struct display *display;
	struct draw *draw;
	int width, height;
	uint8_t *rgba; /* of the last snapshot_take, top row first */
};

/* False: the fault says what the machine lacks. */
bool snapshot_open(struct snapshot *snapshot, int width, int height, char fault[FAULT_BYTES]);
void snapshot_take(struct snapshot *snapshot, const struct ui *ui, const struct session *session);
void snapshot_close(struct snapshot *snapshot);

#endif
