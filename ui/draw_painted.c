#include "draw_painted.h"

#include <stdio.h>

bool painted_open(struct painted *painted, struct rect area, bool opaque, char fault[200])
{
	struct layer *layer = &painted->layer;
	memset(painted, 0, sizeof *painted);
	painted->type = type_open(fault);
	if (!painted->type)
		return false;
	painted->surface = cairo_image_surface_create(
		opaque ? CAIRO_FORMAT_RGB24 : CAIRO_FORMAT_ARGB32, area.w, area.h);
	painted->cr = cairo_create(painted->surface);
	if (cairo_status(painted->cr) != CAIRO_STATUS_SUCCESS) {
		snprintf(fault, 200, "no memory for a layer of %d x %d", area.w, area.h);
		painted_close(painted);
		return false;
	}
	layer->area = area;
	layer->pixels = cairo_image_surface_get_data(painted->surface);
	layer->stride = cairo_image_surface_get_stride(painted->surface);
	layer->patch_count = 1;
	layer->patch[0] = (struct patch){{0, 0, area.w, area.h}, opaque};
	return true;
}

void painted_close(struct painted *painted)
{
	cairo_destroy(painted->cr);
	cairo_surface_destroy(painted->surface);
	type_close(painted->type);
}

void painted_clear(const struct painted *painted)
{
	cairo_t *cr = painted->cr;
	cairo_set_operator(cr, CAIRO_OPERATOR_SOURCE);
	cairo_set_source_rgba(cr, 0.0, 0.0, 0.0, 0.0);
	cairo_paint(cr);
	cairo_set_operator(cr, CAIRO_OPERATOR_OVER);
}

void painted_damage(struct painted *painted)
{
	struct layer *layer = &painted->layer;
	cairo_surface_flush(painted->surface);
	layer->damage_count = 1;
	layer->damage[0] = (struct rect){0, 0, layer->area.w, layer->area.h};
}
