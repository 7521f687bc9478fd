/* A QR code's modules on cairo, whole dots each, with the quiet zone of four around them. */
#ifndef DRAW_QR_H
#define DRAW_QR_H

#include "look.h"

#include <cairo.h>

enum { QR_QUIET = 4 };

/* Into a square of `side` at (x, y): modules of as many whole dots as fit, in its middle. The
 * square must be white. */
static inline void qr_paint(cairo_t *cr, const uint8_t *module, int modules, double x, double y,
			    double side)
{
	int dots = int_max((int)side / (modules + 2 * QR_QUIET), 1);
	int margin = ((int)side - dots * modules) / 2;
	cairo_save(cr);
	cairo_translate(cr, x + margin, y + margin);
	cairo_set_antialias(cr, CAIRO_ANTIALIAS_NONE);
	for (int row = 0; row < modules; row++)
		for (int i = 0; i < modules;) {
			int run = i;
			while (run < modules && module[row * modules + run])
				run++;
			if (run > i)
				cairo_rectangle(cr, i * dots, row * dots, (run - i) * dots, dots);
			i = run + 1;
		}
	cairo_set_source_rgb(cr, 0.08, 0.08, 0.08);
	cairo_fill(cr);
	cairo_restore(cr);
}

#endif
