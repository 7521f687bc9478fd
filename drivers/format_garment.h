/* Reads complete garments with their seams: format "garment-seams/1" (JSON).
 *
 *   format     "garment-seams/1"
 *   units      "mm"
 *   instances  list of { id, outline [[x, y] ...] }: y DOWN, counter-clockwise on the screen, the
 *              cloth's outside towards the viewer; mirrored pieces are written out
 *   seams      list of { id, kind, a, b }, a and b { instance, start, end, dir }: the run of the
 *              outline from point start to point end, with (dir 1) or against (-1) the list's
 * order. a.start is sewn to b.start. Kind "closure" (a zip, buttons) stays open.
 *
 * Everything else in the file is ignored. */
#ifndef FORMAT_GARMENT_H
#define FORMAT_GARMENT_H

#include "pattern.h"

/* Fills the pattern (all of it; what was there is gone). Pieces keep the file's coordinates with y
 * turned up, are named after their instance and lie side by side on the sheet. Corners stand where
 * a seam begins or ends and where the outline turns by more than 20 degrees outside a seam.
 * Outlines with more than OUTLINE_POINTS_MAX points are thinned by at most 0.2 mm.
 *
 * False: the file is at fault; `fault` says where, what, and what to do, and the pattern is empty.
 * Any bytes are safe. Memory comes from malloc and is given back before returning. */
bool format_garment_read(struct pattern *pattern, const char *text, size_t size, char fault[200]);

#endif
