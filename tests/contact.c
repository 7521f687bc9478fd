/* contact OUT.png [FILE.png CAPTION]...: pictures of one size on one sheet. */
#include "picture.h"

#include <cairo.h>
#include <stdio.h>
#include <stdlib.h>

enum { CELL_W = 440 };

/* Cairo's pixels (BGRA in memory on a little-endian machine) as RGBA rows without gaps. */
static uint8_t *pixels(cairo_surface_t *surface, int width, int height)
{
	uint8_t *rgba = malloc((size_t)width * (size_t)height * 4);
	for (int y = 0; rgba && y < height; y++) {
		const uint32_t *row =
			(const uint32_t
				 *)(const void *)(cairo_image_surface_get_data(surface) +
						  (size_t)y *
							  (size_t)cairo_image_surface_get_stride(
								  surface));
		for (int x = 0; x < width; x++)
			for (int k = 0; k < 4; k++)
				rgba[4 * ((size_t)y * (size_t)width + (size_t)x) + (size_t)k] =
					(uint8_t)(k == 3 ? 255 : row[x] >> (16 - 8 * k));
	}
	return rgba;
}

int main(int argc, char **argv)
{
	struct contact_sheet contact;
	char fault[200] = "not enough memory";
	int frames = (argc - 2) / 2, width = 0, height = 0;
	if (argc < 4 || argc % 2 != 0) {
		fputs("usage: contact OUT.png [FILE.png CAPTION]...\n", stderr);
		return 2;
	}
	for (int i = 2; i + 1 < argc; i += 2) {
		cairo_surface_t *surface = cairo_image_surface_create_from_png(argv[i]);
		int w = cairo_image_surface_get_width(surface);
		int h = cairo_image_surface_get_height(surface);
		if (i == 2 && w > 0 && contact_open(&contact, frames, w, h, CELL_W)) {
			width = w;
			height = h;
		}
		uint8_t *rgba = w == width && h == height && w > 0 ? pixels(surface, w, h) : NULL;
		if (!rgba) {
			fprintf(stderr, "contact: %s: can't be shown\n", argv[i]);
			return 1;
		}
		contact_add(&contact, w, h, rgba, argv[i + 1]);
		free(rgba);
		cairo_surface_destroy(surface);
	}
	if (contact_finish(&contact, argv[1], fault))
		return 0;
	fprintf(stderr, "contact: %s\n", fault);
	return 3;
}
