#include "snapshot.h"

#include <stdio.h>
#include <stdlib.h>

bool snapshot_open(struct snapshot *snapshot, int width, int height, char fault[FAULT_BYTES])
{
	memset(snapshot, 0, sizeof *snapshot);
	snapshot->width = width;
	snapshot->height = height;
	snapshot->display = display_open(DISPLAY_HEADLESS, &snapshot->width, &snapshot->height,
					 fault);
	if (snapshot->display)
		snapshot->draw = draw_open(snapshot->width, snapshot->height, fault);
	if (snapshot->draw) {
		snapshot->rgba = malloc(4 * (size_t)snapshot->width * (size_t)snapshot->height);
		if (!snapshot->rgba)
			snprintf(fault, FAULT_BYTES, "not enough memory for a picture");
	}
	if (!snapshot->rgba)
		snapshot_close(snapshot);
	return snapshot->rgba != NULL;
}

void snapshot_take(struct snapshot *snapshot, const struct ui *ui, const struct session *session)
{
	draw_frame(snapshot->draw, ui, session);
	display_read(snapshot->display, snapshot->rgba);
	display_present(snapshot->display);
}

void snapshot_close(struct snapshot *snapshot)
{
	if (snapshot->draw)
		draw_close(snapshot->draw);
	if (snapshot->display)
		display_close(snapshot->display);
	free(snapshot->rgba);
	memset(snapshot, 0, sizeof *snapshot);
}
