/* Cairo's layers on the screen: changed rectangles go up to a texture, patches come down as quads.
 */
#include "draw_private.h"

#include <GLES2/gl2ext.h>

/* Cairo's bytes are blue, green, red, alpha. Where GL takes them in that order no shader and no
 * copy needs to turn them round; else the texture does. */
static GLenum layer_format(void)
{
	const char *list = (const char *)glGetString(GL_EXTENSIONS);
	return list && strstr(list, "GL_EXT_texture_format_BGRA8888") ? GL_BGRA_EXT : GL_RGBA;
}

static void upload_size(struct upload *upload, const struct layer *layer)
{
	upload->format = layer_format();
	upload->texture = gl_texture(GL_NEAREST, GL_CLAMP_TO_EDGE);
	glTexImage2D(GL_TEXTURE_2D, 0, (GLint)upload->format, layer->area.w, layer->area.h, 0,
		     upload->format, GL_UNSIGNED_BYTE, NULL);
	if (upload->format == GL_RGBA) {
		glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_R, GL_BLUE);
		glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_B, GL_RED);
	}
}

static void upload_damage(struct upload *upload, const struct layer *layer)
{
	glBindTexture(GL_TEXTURE_2D, upload->texture);
	glPixelStorei(GL_UNPACK_ROW_LENGTH, layer->stride / 4);
	for (int i = 0; i < layer->damage_count; i++) {
		const struct rect *rect = &layer->damage[i];
		MUST(rect->x >= 0 && rect->y >= 0 && rect->x + rect->w <= layer->area.w &&
		     rect->y + rect->h <= layer->area.h);
		glTexSubImage2D(GL_TEXTURE_2D, 0, rect->x, rect->y, rect->w, rect->h,
				upload->format, GL_UNSIGNED_BYTE,
				layer->pixels + (size_t)rect->y * (size_t)layer->stride +
					(size_t)rect->x * 4);
	}
	glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
}

/* A patch as a quad of the whole screen's clip space; layers count rows from the top. */
static void patch_draw(const struct draw *draw, const struct layer *layer, const struct rect *area)
{
	float screen_w = (float)draw->width, screen_h = (float)draw->height;
	float layer_w = (float)layer->area.w, layer_h = (float)layer->area.h;
	float x = (float)(layer->area.x + area->x), y = (float)(layer->area.y + area->y);
	float w = (float)area->w, h = (float)area->h;
	glUniform4f(draw->room.place, 2.0f * w / screen_w, -2.0f * h / screen_h,
		    2.0f * x / screen_w - 1.0f, 1.0f - 2.0f * y / screen_h);
	glUniform4f(draw->room.cut, w / layer_w, h / layer_h, (float)area->x / layer_w,
		    (float)area->y / layer_h);
	glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

void upload_draw(struct draw *draw, struct upload *upload, const struct layer *layer)
{
	if (!upload->texture)
		upload_size(upload, layer);
	upload_damage(upload, layer);
	glBindBuffer(GL_ARRAY_BUFFER, draw->room.quad);
	gl_attributes(1u << AT_PLACE);
	gl_floats(AT_PLACE, 2, 8, 0);
	glUseProgram(draw->room.program);
	for (int i = 0; i < layer->patch_count; i++) {
		if (layer->patch[i].opaque)
			glDisable(GL_BLEND);
		else
			glEnable(GL_BLEND);
		patch_draw(draw, layer, &layer->patch[i].area);
	}
	glDisable(GL_BLEND);
}
