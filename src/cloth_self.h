/* Cloth against cloth, within a garment and between garments (F1).
 *
 * A vertex near another sheet remembers on which side of it it lies and is kept there, a thickness
 * away; what passes through another sheet all the same is found by exact tests and pulled out along
 * the curve in which the sheets cross. Both searches go round the cloth in slices, one slice each
 * SELF_EVERY sweeps, so that a frame's cost is bounded. Only welded cloth meets itself: pieces that
 * still grow may lie over one another.
 */
#ifndef CLOTH_SELF_H
#define CLOTH_SELF_H

#include "cloth.h"

struct cloth_self *cloth_self_init(struct arena *arena);

/* Forgets sides and crossings and takes the cloth's triangles as they are now (after a weld, a
 * restore). The next sweep looks at the whole cloth. */
void cloth_self_build(struct cloth *cloth);

/* The sweep's part; units spent (triangles looked at, pairs and crossings projected). Does nothing
 * where settings.thickness_m is 0. */
long cloth_self(struct cloth *cloth);

/* After contact: outer garments go where inner ones have left them to be; nothing inner moves.
 * Units spent. */
long cloth_self_order(struct cloth *cloth);

/* Forgets the sides of flagged particles: they were put elsewhere. */
void cloth_self_forget(struct cloth *cloth, const uint8_t *flagged);

/* Edges that passed through other triangles when last looked at. */
int cloth_crossings(const struct cloth *cloth);

/* Sets 1 for the particles of triangles that took part in those; the others stay as they are. */
void cloth_flag_crossed(const struct cloth *cloth, uint8_t *flagged);

/* Looks at the whole cloth at once; units. */
long cloth_self_look(struct cloth *cloth);

#endif
