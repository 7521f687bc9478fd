/* PNG by libpng, scaling by averaging, captions by cairo and Pango. */
#include "picture.h"

#include <errno.h>
#include <pango/pangocairo.h>
#include <png.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

enum { CONTACT_MARGIN = 12, CONTACT_CAPTION_H = 26, CONTACT_COLUMNS = 4 };

/* libpng leaves by longjmp on an error: nothing but its own structs lives across the call. */
static bool png_write(FILE *file, int width, int height, const uint8_t *rgba)
{
	png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
	png_infop info = png ? png_create_info_struct(png) : NULL;
	if (!info || setjmp(png_jmpbuf(png))) {
		png_destroy_write_struct(&png, &info);
		return false;
	}
	png_init_io(png, file);
	png_set_compression_level(png, 4);
	png_set_IHDR(png, info, (png_uint_32)width, (png_uint_32)height, 8, PNG_COLOR_TYPE_RGB,
		     PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
	png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
	png_write_info(png, info);
	png_set_filler(png, 0, PNG_FILLER_AFTER);
	for (int y = 0; y < height; y++)
		png_write_row(png, rgba + (size_t)y * (size_t)width * 4);
	png_write_end(png, info);
	png_destroy_write_struct(&png, &info);
	return true;
}

bool picture_write_png(const char *path, int width, int height, const uint8_t *rgba,
		       char fault[200])
{
	char part[4096];
	if (snprintf(part, sizeof part, "%s.part", path) >= (int)sizeof part) {
		snprintf(fault, 200, "%.80s...: the name is too long for a picture", path);
		return false;
	}
	FILE *file = fopen(part, "wb");
	if (!file) {
		snprintf(fault, 200, "%.120s: can't write a picture: %s", path, strerror(errno));
		return false;
	}
	errno = 0;
	bool written = png_write(file, width, height, rgba);
	written = fclose(file) == 0 && written;
	if (written && rename(part, path) == 0)
		return true;
	snprintf(fault, 200, "%.120s: writing the picture failed: %s", path,
		 errno ? strerror(errno) : "libpng gave up");
	unlink(part);
	return false;
}

bool contact_open(struct contact_sheet *contact, int frames, int width, int height, int cell_w)
{
	MUST(frames > 0 && frames <= CONTACT_FRAMES_MAX && width > 0 && height > 0 && cell_w > 0);
	int columns = int_min(frames, CONTACT_COLUMNS), rows = (frames + columns - 1) / columns;
	int cell_h = int_max(1, (int)((long)cell_w * height / width));
	*contact = (struct contact_sheet){
		.columns = columns,
		.rows = rows,
		.cell_w = cell_w,
		.cell_h = cell_h,
		.width = columns * (cell_w + CONTACT_MARGIN) + CONTACT_MARGIN,
		.height = rows * (cell_h + CONTACT_CAPTION_H + CONTACT_MARGIN) + CONTACT_MARGIN,
	};
	size_t size = (size_t)contact->width * (size_t)contact->height * 4;
	contact->rgba = malloc(size);
	if (contact->rgba)
		memset(contact->rgba, 0xf4, size);
	return contact->rgba != NULL;
}

/* Every cell pixel is the mean of the frame's pixels that it covers. */
static void scale_into(uint8_t *out, int out_stride, int out_w, int out_h, const uint8_t *in,
		       int in_w, int in_h)
{
	for (int y = 0; y < out_h; y++) {
		int y0 = (int)((long)y * in_h / out_h);
		int y1 = int_max(y0 + 1, (int)((long)(y + 1) * in_h / out_h));
		for (int x = 0; x < out_w; x++) {
			int x0 = (int)((long)x * in_w / out_w);
			int x1 = int_max(x0 + 1, (int)((long)(x + 1) * in_w / out_w));
			unsigned sum[3] = {0};
			unsigned area = (unsigned)((y1 - y0) * (x1 - x0));
			for (int v = y0; v < y1; v++)
				for (int u = x0; u < x1; u++)
					for (int c = 0; c < 3; c++)
						sum[c] +=
							in[((size_t)v * (size_t)in_w + (size_t)u) *
								   4 +
							   (size_t)c];
			uint8_t *pixel = out + (size_t)y * (size_t)out_stride + (size_t)x * 4;
			for (int c = 0; c < 3; c++)
				pixel[c] = (uint8_t)(sum[c] / area);
			pixel[3] = 255;
		}
	}
}

/* Drawn in grey on the sheet's own grey, so that cairo's byte order and RGBA agree. */
static void caption_write(struct contact_sheet *contact, int x, int y, const char *caption)
{
	cairo_surface_t *surface = cairo_image_surface_create_for_data(
		contact->rgba + ((size_t)y * (size_t)contact->width + (size_t)x) * 4,
		CAIRO_FORMAT_RGB24, contact->cell_w, CONTACT_CAPTION_H, contact->width * 4);
	cairo_t *cairo = cairo_create(surface);
	PangoLayout *text = pango_cairo_create_layout(cairo);
	PangoFontDescription *font = pango_font_description_from_string("BIZ UDPGothic");
	pango_font_description_set_absolute_size(font, 15 * PANGO_SCALE);
	pango_layout_set_font_description(text, font);
	pango_layout_set_width(text, contact->cell_w * PANGO_SCALE);
	pango_layout_set_ellipsize(text, PANGO_ELLIPSIZE_END);
	pango_layout_set_text(text, caption, -1);
	cairo_set_source_rgb(cairo, 0.2, 0.2, 0.2);
	cairo_move_to(cairo, 2, 4);
	pango_cairo_show_layout(cairo, text);
	g_object_unref(text);
	pango_font_description_free(font);
	cairo_destroy(cairo);
	cairo_surface_destroy(surface);
}

void contact_add(struct contact_sheet *contact, int width, int height, const uint8_t *rgba,
		 const char *caption)
{
	if (contact->count >= contact->columns * contact->rows)
		return;
	int column = contact->count % contact->columns, row = contact->count / contact->columns;
	int x = CONTACT_MARGIN + column * (contact->cell_w + CONTACT_MARGIN);
	int y = CONTACT_MARGIN + row * (contact->cell_h + CONTACT_CAPTION_H + CONTACT_MARGIN);
	uint8_t *cell = contact->rgba + ((size_t)y * (size_t)contact->width + (size_t)x) * 4;
	scale_into(cell, contact->width * 4, contact->cell_w, contact->cell_h, rgba, width, height);
	caption_write(contact, x, y + contact->cell_h, caption);
	contact->count++;
}

bool contact_finish(struct contact_sheet *contact, const char *path, char fault[200])
{
	bool written = !path || picture_write_png(path, contact->width, contact->height,
						  contact->rgba, fault);
	free(contact->rgba);
	*contact = (struct contact_sheet){0};
	return written;
}
