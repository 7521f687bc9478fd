/* Pen positions: logical units to millimetres, jumps held back, jitter taken out, pixels; and a
 * nib's pressure. Private to the pen module. */
#ifndef PEN_FILTER_H
#define PEN_FILTER_H

#include "pen.h"

/* Millimetres on the tablet from its upper left corner. */
struct v2 pen_place_mm(const struct pen *pen, const struct pen_device *device,
		       const struct pen_layout *layout, const struct pen_fields *fields);

/* Millimetres to screen pixels, kept on the screen. */
struct v2 pen_mm_to_px(const struct pen *pen, const struct pen_device *device,
		       const struct pen_layout *layout, struct v2 mm);

/* Can no hand come from there to here in that time? */
bool pen_jump(struct v2 from_mm, struct v2 to_mm, int64_t dt_us);

/* Is the next position a jump that no hand makes? Then the last one holds until a second report
 * confirms the jump. */
bool pen_jump_held(struct pen_device *device, struct v2 mm, int64_t dt_us);

/* Begins anew at a position: proximity has just begun, or a jump was confirmed. */
void pen_filter_reset(struct pen_device *device, struct v2 mm);

/* The 1-euro filter (Casiez, Roussel and Vogel, CHI 2012), in mm. While the pen moves, the result
 * is at most one report behind. */
struct v2 pen_filter(struct pen_device *device, struct v2 mm, int64_t dt_us);

/* Pressure in logical units above what a worn nib always shows (pen_nib.c), and what is left of the
 * range. `entering`: the pen was away until this report. */
int pen_nib(struct pen_device *device, const struct pen_layout *layout,
	    const struct pen_fields *fields, bool entering, int *range);

#endif
