/* Where cairo's pictures meet GL: a layer is a picture in memory, drawn by cairo where it changed,
 * uploaded where it changed, and shown as a few rectangles. Helpers of draw.h; nobody else's.
 *
 *   sheet    the right pane, opaque: paper, grid, pieces, seams, marks, the stroke being drawn
 *   chrome   bars, buttons, hint, view buttons: whatever lies over both panes
 *
 * In the left pane all that moves with the camera (marks, their numbers, pins, hover ring, the
 * stroke being drawn) is drawn by GL and is no business of a layer.
 */
#ifndef DRAW_LAYER_H
#define DRAW_LAYER_H

#include "ui.h"

enum { LAYER_DAMAGE_MAX = 16, LAYER_PATCHES_MAX = 32 };

/* A rectangle of a layer that is on the screen now. Opaque ones cost half as much to draw. */
struct patch {
	struct rect area; /* in layer pixels */
	bool opaque;
};

struct layer {
	struct rect area;      /* of the screen, fixed at open: area.w x area.h pixels */
	unsigned char *pixels; /* cairo's ARGB32: premultiplied, native byte order */
	int stride;            /* bytes a row */
	int damage_count;      /* rectangles to upload, in layer pixels; 0: nothing changed */
	struct rect damage[LAYER_DAMAGE_MAX];
	int patch_count;
	struct patch patch[LAYER_PATCHES_MAX]; /* drawn in this order */
};

struct sheet;
struct chrome;

/* Memory, fonts and surfaces for a screen size; the first update damages everything. NULL with a
 * line in fault (a font is missing, no memory). */
struct sheet *sheet_open(int width, int height, char fault[200]);
struct chrome *chrome_open(int width, int height, char fault[200]);

/* Redraws what changed since the last call, and returns the layer with its damage and patches. It
 * stays valid until the next call. */
const struct layer *sheet_update(struct sheet *sheet, const struct ui *ui,
				 const struct session *session);
const struct layer *chrome_update(struct chrome *chrome, const struct ui *ui,
				  const struct session *session);
void sheet_close(struct sheet *sheet);
void chrome_close(struct chrome *chrome);

#endif
