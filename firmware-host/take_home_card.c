#include "take_home_card.h"

#include <errno.h>
#include <png.h>
#include <qrencode.h>
#include <stdio.h>
#include <stdlib.h>

enum { DOTS_PER_METRE = 11811, QR_VERSION_MAX = 25 };

/* ---- the code ---- */

static QRcode *encode(const char *text, QRecLevel level)
{
	QRinput *input = QRinput_new2(0, level);
	QRcode *code = NULL;
	if (input &&
	    QRinput_append(input, QR_MODE_AN, (int)strlen(text), (const unsigned char *)text) == 0)
		code = QRcode_encodeInput(input);
	if (input)
		QRinput_free(input);
	if (!code || code->version <= QR_VERSION_MAX)
		return code;
	QRcode_free(code);
	return NULL;
}

/* As robust as fits: fingers and bad light spoil some of a print. */
static void make_qr(struct card_made *made)
{
	static const struct {
		QRecLevel level;
		char name;
	} level[] = {{QR_ECLEVEL_M, 'M'}, {QR_ECLEVEL_L, 'L'}};
	QRcode *code = NULL;
	for (int i = 0; i < COUNT_OF(level) && !code; i++) {
		code = encode(made->text, level[i].level);
		made->qr_level = level[i].name;
	}
	if (!code)
		return;
	made->qr_version = code->version;
	made->card.qr_modules = code->width;
	for (int i = 0; i < code->width * code->width; i++)
		made->qr[i] = code->data[i] & 1;
	QRcode_free(code);
}

bool card_begin(struct card_made *made, const struct code_content *content, char fault[FAULT_BYTES])
{
	memset(made, 0, sizeof *made);
	made->card.pattern = &content->pattern;
	made->card.marks = &content->marks;
	made->card.qr = made->qr;
	made->text = malloc(CODE_TEXT_MAX);
	if (!made->text || !code_write(content, made->text, CODE_TEXT_MAX, &made->figures)) {
		snprintf(fault, FAULT_BYTES, "%s",
			 made->text ? "the pattern is none that a code can carry"
				    : "not enough memory for a card");
		card_end(made);
		return false;
	}
	make_qr(made);
	return true;
}

void card_end(struct card_made *made)
{
	free(made->text);
	made->text = NULL;
}

/* ---- the picture ---- */

unsigned char *card_pixels(const struct card_made *made, int width, char fault[FAULT_BYTES])
{
	char wrong[200] = "not enough memory for a card";
	unsigned char *pixels = malloc((size_t)width * (size_t)card_height(width) * 4);
	if (pixels && card_paint(&made->card, pixels, width, wrong))
		return pixels;
	snprintf(fault, FAULT_BYTES, "%s", wrong);
	free(pixels);
	return NULL;
}

static void write_bytes(png_structp png, png_bytep bytes, size_t size)
{
	if (fwrite(bytes, 1, size, png_get_io_ptr(png)) != size)
		png_error(png, "no memory");
}

static void flush_nothing(png_structp png)
{
	(void)png;
}

/* libpng leaves by longjmp on an error: nothing but its own structs lives across the call. */
static bool write_png(FILE *out, unsigned char *pixels, char *code)
{
	png_text text = {.compression = PNG_TEXT_COMPRESSION_NONE,
			 .key = (char *)(uintptr_t) "kitsuke",
			 .text = code,
			 .text_length = strlen(code)};
	png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
	png_infop info = png ? png_create_info_struct(png) : NULL;
	if (!info || setjmp(png_jmpbuf(png))) {
		png_destroy_write_struct(&png, &info);
		return false;
	}
	png_set_write_fn(png, out, write_bytes, flush_nothing);
	png_set_compression_level(png, 4);
	png_set_IHDR(png, info, CARD_WIDTH, CARD_HEIGHT, 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
		     PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
	png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
	png_set_pHYs(png, info, DOTS_PER_METRE, DOTS_PER_METRE, PNG_RESOLUTION_METER);
	png_set_text(png, info, &text, 1);
	png_write_info(png, info);
	png_set_bgr(png);
	png_set_filler(png, 0, PNG_FILLER_AFTER);
	for (int y = 0; y < CARD_HEIGHT; y++)
		png_write_row(png, pixels + (size_t)y * CARD_WIDTH * 4);
	png_write_end(png, NULL);
	png_destroy_write_struct(&png, &info);
	return true;
}

uint8_t *card_png(const struct card_made *made, size_t *size, char fault[FAULT_BYTES])
{
	char *bytes = NULL;
	unsigned char *pixels = card_pixels(made, CARD_WIDTH, fault);
	FILE *out = pixels ? open_memstream(&bytes, size) : NULL;
	if (!pixels)
		return NULL;
	bool written = out && write_png(out, pixels, made->text);
	written = out && fclose(out) == 0 && written;
	free(pixels);
	if (written)
		return (uint8_t *)bytes;
	snprintf(fault, FAULT_BYTES, "not enough memory for a card's PNG");
	free(bytes);
	return NULL;
}
