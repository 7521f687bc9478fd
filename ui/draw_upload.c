/* Pictures made on the processor, on their way to the screen: cairo's layers and the backdrop.
 * Changed rectangles go up to a texture. Opaque patches come down as copies (no shader runs: a
 * tenth of the price where the processor draws), translucent ones as quads.
 *
 * GL counts a framebuffer object's rows from below, and so does a plain copy out of a texture. On a
 * display's own buffers the same copy turns the rows over in the driver, which has counted from the
 * top all along. Rows are kept in the order that makes the copy plain (`bottom_up`).
 */
#include "draw_private.h"

#include <GLES2/gl2ext.h>

/* Cairo's bytes are blue, green, red, alpha. Where GL takes them in that order no shader and no
 * copy needs to turn them round; else the rows are turned on their way up. */
static GLenum layer_format(void)
{
	const char *list = (const char *)glGetString(GL_EXTENSIONS);
	return list && strstr(list, "GL_EXT_texture_format_BGRA8888") ? GL_BGRA_EXT : GL_RGBA;
}

bool plate_open(struct draw *draw, struct plate *plate, int width, int height)
{
	*plate = (struct plate){.width = width, .height = height, .format = layer_format()};
	plate->bottom_up = draw->target != 0;
	plate->texture = gl_texture(GL_NEAREST, GL_CLAMP_TO_EDGE);
	glTexImage2D(GL_TEXTURE_2D, 0, (GLint)plate->format, width, height, 0, plate->format,
		     GL_UNSIGNED_BYTE, NULL);
	glGenFramebuffers(1, &plate->framebuffer);
	glBindFramebuffer(GL_READ_FRAMEBUFFER, plate->framebuffer);
	glFramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D,
			       plate->texture, 0);
	plate->copies = glCheckFramebufferStatus(GL_READ_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
	glBindFramebuffer(GL_FRAMEBUFFER, (GLuint)draw->target);
	return plate->texture != 0;
}

static void row_take(uint8_t *out, const uint8_t *in, int pixels, bool swap)
{
	if (!swap) {
		memcpy(out, in, (size_t)pixels * 4);
		return;
	}
	for (int i = 0; i < pixels; i++) {
		out[4 * i] = in[4 * i + 2];
		out[4 * i + 1] = in[4 * i + 1];
		out[4 * i + 2] = in[4 * i];
		out[4 * i + 3] = in[4 * i + 3];
	}
}

void plate_upload(struct draw *draw, struct plate *plate, const uint8_t *pixels, int stride,
		  const struct rect *rect)
{
	MUST(rect->x >= 0 && rect->y >= 0 && rect->x + rect->w <= plate->width &&
	     rect->y + rect->h <= plate->height);
	MUST(rect->w <= draw->width && rect->h <= draw->height);
	for (int y = 0; y < rect->h; y++) {
		int to = plate->bottom_up ? rect->h - 1 - y : y;
		row_take(draw->rows + (size_t)to * (size_t)rect->w * 4,
			 pixels + (size_t)(rect->y + y) * (size_t)stride + (size_t)rect->x * 4,
			 rect->w, plate->format == GL_RGBA);
	}
	int top = plate->bottom_up ? plate->height - rect->y - rect->h : rect->y;
	glBindTexture(GL_TEXTURE_2D, plate->texture);
	glTexSubImage2D(GL_TEXTURE_2D, 0, rect->x, top, rect->w, rect->h, plate->format,
			GL_UNSIGNED_BYTE, draw->rows);
}

void plate_copy(const struct draw *draw, const struct plate *plate, const struct rect *from, int x,
		int y)
{
	if (!plate->copies) {
		plate_quad(draw, plate, from, x, y);
		return;
	}
	int bottom = draw->height - y - from->h, low = from->y, high = from->y + from->h;
	if (plate->bottom_up) {
		low = plate->height - from->y - from->h;
		high = low + from->h;
	} else { /* turned over here, and back by the driver */
		low = from->y + from->h;
		high = from->y;
	}
	glBindFramebuffer(GL_READ_FRAMEBUFFER, plate->framebuffer);
	glBlitFramebuffer(from->x, low, from->x + from->w, high, x, bottom, x + from->w,
			  bottom + from->h, GL_COLOR_BUFFER_BIT, GL_NEAREST);
	glBindFramebuffer(GL_READ_FRAMEBUFFER, (GLuint)draw->target);
}

/* A quad of the whole screen's clip space. */
void plate_quad(const struct draw *draw, const struct plate *plate, const struct rect *from, int x,
		int y)
{
	float screen_w = (float)draw->width, screen_h = (float)draw->height;
	float plate_w = (float)plate->width, plate_h = (float)plate->height;
	float w = (float)from->w, h = (float)from->h;
	float sign = plate->bottom_up ? -1.0f : 1.0f;
	float first = plate->bottom_up ? plate_h - (float)from->y : (float)from->y;
	glBindBuffer(GL_ARRAY_BUFFER, draw->room.quad);
	gl_attributes(1u << AT_PLACE);
	gl_floats(AT_PLACE, 2, 8, 0);
	glUseProgram(draw->room.program);
	glBindTexture(GL_TEXTURE_2D, plate->texture);
	glUniform4f(draw->room.place, 2.0f * w / screen_w, -2.0f * h / screen_h,
		    2.0f * (float)x / screen_w - 1.0f, 1.0f - 2.0f * (float)y / screen_h);
	glUniform4f(draw->room.cut, w / plate_w, sign * h / plate_h, (float)from->x / plate_w,
		    first / plate_h);
	glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

void layer_take(struct draw *draw, struct plate *plate, const struct layer *layer)
{
	if (!plate->texture)
		plate_open(draw, plate, layer->area.w, layer->area.h);
	for (int i = 0; i < layer->damage_count; i++)
		plate_upload(draw, plate, layer->pixels, layer->stride, &layer->damage[i]);
}

void layer_draw(struct draw *draw, const struct plate *plate, const struct layer *layer,
		bool opaque)
{
	if (opaque)
		glDisable(GL_BLEND);
	else
		glEnable(GL_BLEND);
	for (int i = 0; i < layer->patch_count; i++) {
		const struct patch *patch = &layer->patch[i];
		int x = layer->area.x + patch->area.x, y = layer->area.y + patch->area.y;
		if (patch->opaque == opaque && opaque)
			plate_copy(draw, plate, &patch->area, x, y);
		else if (patch->opaque == opaque)
			plate_quad(draw, plate, &patch->area, x, y);
	}
	glDisable(GL_BLEND);
}
