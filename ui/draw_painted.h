/* A layer that cairo paints, in memory of its own, and the typeface for its words. */
#ifndef DRAW_PAINTED_H
#define DRAW_PAINTED_H

#include "draw_layer.h"
#include "draw_text.h"

struct painted {
	struct layer layer;
	struct type *type;
	cairo_surface_t *surface;
	cairo_t *cr;
};

/* `area` is where it lies on the screen; all of it is one patch. False with a line in fault (no
 * typeface, no memory), and then nothing is left to close. */
bool painted_open(struct painted *painted, struct rect area, bool opaque, char fault[200]);
void painted_close(struct painted *painted);

/* Everything transparent. */
void painted_clear(const struct painted *painted);

/* The whole layer was painted anew. */
void painted_damage(struct painted *painted);

#endif
