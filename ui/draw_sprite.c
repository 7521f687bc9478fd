/* Small pictures that face the viewer: numbers of marks, heads of pins, the ring under the pen.
 * They are drawn once by cairo into an atlas. */
#include "draw_private.h"

#include <pango/pangocairo.h>
#include <stddef.h>
#include <stdlib.h>

enum {
	ATLAS_COLUMNS = 8,
	ATLAS_ROWS = 5,
	CELL = 64,
	HALO_CELL = 37,
	RING_CELL = 38,
	PIN_CELL = 39
};

static const char sprite_vertex_source[] = "attribute vec4 a_position, a_colour;\n"
					   "attribute vec2 a_place;\n"
					   "varying vec4 v_colour;\n"
					   "varying vec2 v_place;\n"
					   "void main() {\n"
					   "  v_colour = a_colour;\n"
					   "  v_place = a_place;\n"
					   "  gl_Position = a_position;\n"
					   "}\n";
static const char sprite_fragment_source[] =
	"uniform sampler2D u_texture;\n"
	"varying vec4 v_colour;\n"
	"varying vec2 v_place;\n"
	"void main() { FRAG = texture2D(u_texture, v_place) * v_colour; }\n";

static void paint(cairo_t *cairo, uint32_t colour)
{
	/* The atlas is uploaded as RGBA from cairo's BGRA: red and blue change places here. */
	cairo_set_source_rgb(cairo, (double)look_blue(colour), (double)look_green(colour),
			     (double)look_red(colour));
}

/* A filled circle in the mark's colour with a white rim, its number inside. */
static void number_paint(cairo_t *cairo, int number)
{
	char digits[12];
	g_snprintf(digits, sizeof digits, "%d", number);
	cairo_arc(cairo, 0, 0, 29, 0, 6.2832);
	cairo_set_source_rgb(cairo, 1, 1, 1);
	cairo_fill(cairo);
	cairo_arc(cairo, 0, 0, 24.5, 0, 6.2832);
	paint(cairo, look_mark_style(number)->colour);
	cairo_fill(cairo);
	PangoLayout *text = pango_cairo_create_layout(cairo);
	PangoFontDescription *font = pango_font_description_from_string("BIZ UDPGothic Bold");
	pango_font_description_set_absolute_size(font, (number < 10 ? 36 : 28) * PANGO_SCALE);
	pango_layout_set_font_description(text, font);
	pango_layout_set_text(text, digits, -1);
	PangoRectangle ink;
	pango_layout_get_pixel_extents(text, &ink, NULL);
	cairo_move_to(cairo, -ink.x - 0.5 * ink.width, -ink.y - 0.5 * ink.height);
	cairo_set_source_rgb(cairo, 1, 1, 1);
	pango_cairo_show_layout(cairo, text);
	pango_font_description_free(font);
	g_object_unref(text);
}

/* White, tinted when drawn: a wide one as halo, a narrow one on top. */
static void ring_paint(cairo_t *cairo, double width)
{
	cairo_new_path(cairo);
	cairo_set_line_width(cairo, width);
	cairo_set_source_rgba(cairo, 1, 1, 1, 1);
	cairo_arc(cairo, 0, 0, 26, 0, 6.2832);
	cairo_stroke(cairo);
}

static void pin_paint(cairo_t *cairo)
{
	cairo_pattern_t *ball = cairo_pattern_create_radial(-9, -10, 2, 0, 0, 28);
	uint32_t colour = LOOK_PIN;
	double r = (double)look_red(colour), g = (double)look_green(colour),
	       b = (double)look_blue(colour);
	cairo_pattern_add_color_stop_rgb(ball, 0, 0.55 + 0.45 * b, 0.5 + 0.45 * g, 0.5 + 0.45 * r);
	cairo_pattern_add_color_stop_rgb(ball, 0.45, b, g, r);
	cairo_pattern_add_color_stop_rgb(ball, 1, 0.55 * b, 0.48 * g, 0.55 * r);
	cairo_arc(cairo, 0, 0, 29, 0, 6.2832);
	cairo_set_source_rgba(cairo, 1, 1, 1, 0.95);
	cairo_fill(cairo);
	cairo_arc(cairo, 0, 0, 25, 0, 6.2832);
	cairo_set_source(cairo, ball);
	cairo_fill(cairo);
	cairo_pattern_destroy(ball);
}

static void atlas_make(struct sprites *sprites)
{
	int width = ATLAS_COLUMNS * CELL, height = ATLAS_ROWS * CELL;
	cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_ARGB32, width, height);
	cairo_t *cairo = cairo_create(surface);
	for (int cell = 0; cell < ATLAS_COLUMNS * ATLAS_ROWS; cell++) {
		cairo_identity_matrix(cairo);
		cairo_translate(cairo, (cell % ATLAS_COLUMNS + 0.5) * CELL,
				(cell / ATLAS_COLUMNS + 0.5) * CELL);
		if (cell < MARKS_MAX)
			number_paint(cairo, cell + 1);
		if (cell == RING_CELL)
			ring_paint(cairo, 5.0);
		if (cell == HALO_CELL)
			ring_paint(cairo, 10.0);
		if (cell == PIN_CELL)
			pin_paint(cairo);
	}
	cairo_surface_flush(surface);
	sprites->atlas = gl_texture(GL_LINEAR_MIPMAP_LINEAR, GL_CLAMP_TO_EDGE);
	glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
		     cairo_image_surface_get_data(surface));
	glGenerateMipmap(GL_TEXTURE_2D);
	cairo_destroy(cairo);
	cairo_surface_destroy(surface);
}

bool sprites_open(struct draw *draw, char fault[200])
{
	struct sprites *sprites = &draw->sprites;
	sprites->vertex = calloc((size_t)SPRITES_MAX * 4, sizeof *sprites->vertex);
	sprites->program = gl_program(sprite_vertex_source, sprite_fragment_source, fault);
	glGenBuffers(1, &sprites->vertices);
	atlas_make(sprites);
	return sprites->vertex && sprites->program;
}

void sprites_release(struct draw *draw)
{
	free(draw->sprites.vertex);
}

void sprites_begin(struct draw *draw)
{
	draw->sprites.count = 0;
}

static void sprite_add(struct draw *draw, const float clip[4], float radius_px, int cell,
		       uint32_t colour, float alpha)
{
	struct sprites *sprites = &draw->sprites;
	if (sprites->count >= SPRITES_MAX)
		return;
	struct sprite_vertex *corner = sprites->vertex + 4 * sprites->count++;
	float reach_x = 2.0f * radius_px / (float)draw->camera.pane.w * clip[3];
	float reach_y = 2.0f * radius_px / (float)draw->camera.pane.h * clip[3];
	for (int k = 0; k < 4; k++) {
		float right = (float)(k >> 1), down = (float)(k & 1);
		corner[k].clip[0] = clip[0] + (2.0f * right - 1.0f) * reach_x;
		corner[k].clip[1] = clip[1] + (1.0f - 2.0f * down) * reach_y;
		corner[k].clip[2] = clip[2];
		corner[k].clip[3] = clip[3];
		corner[k].place[0] = ((float)(cell % ATLAS_COLUMNS) + right) / ATLAS_COLUMNS;
		corner[k].place[1] = ((float)(cell / ATLAS_COLUMNS) + down) / ATLAS_ROWS;
		corner[k].colour[0] = (uint8_t)((float)(colour >> 16 & 255) * alpha);
		corner[k].colour[1] = (uint8_t)((float)(colour >> 8 & 255) * alpha);
		corner[k].colour[2] = (uint8_t)((float)(colour & 255) * alpha);
		corner[k].colour[3] = (uint8_t)(255.0f * alpha);
	}
}

void sprite_number(struct draw *draw, struct v3 point_m, int number)
{
	float clip[4];
	camera_clip(&draw->camera, point_m, 0.045f, clip);
	if (clip[3] > 0.05f && number >= 1 && number <= MARKS_MAX)
		sprite_add(draw, clip, 19.0f * draw->px, number - 1, 0xffffff, 1.0f);
}

void sprite_pin(struct draw *draw, struct v3 head_m)
{
	float clip[4];
	camera_clip(&draw->camera, head_m, 0.012f, clip);
	if (clip[3] > 0.05f)
		sprite_add(draw, clip, 12.0f * draw->px, PIN_CELL, 0xffffff, 1.0f);
}

void sprite_ring(struct draw *draw, struct v2 centre_px, float radius_px, uint32_t colour)
{
	const struct rect *pane = &draw->camera.pane;
	float clip[4] = {2.0f * (centre_px.x - (float)pane->x) / (float)pane->w - 1.0f,
			 1.0f - 2.0f * (centre_px.y - (float)pane->y) / (float)pane->h, 0.0f, 1.0f};
	float reach_px = radius_px * 32.0f / 26.0f;
	sprite_add(draw, clip, reach_px, HALO_CELL, 0xffffff, 0.85f);
	sprite_add(draw, clip, reach_px, RING_CELL, colour, 1.0f);
}

void sprites_draw(struct draw *draw, bool over_everything)
{
	struct sprites *sprites = &draw->sprites;
	int stride = (int)sizeof *sprites->vertex;
	if (!sprites->count)
		return;
	glBindBuffer(GL_ARRAY_BUFFER, sprites->vertices);
	glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)sprites->count * 4 * stride, sprites->vertex,
		     GL_STREAM_DRAW);
	glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, draw->quads);
	gl_attributes(1u << AT_POSITION | 1u << AT_PLACE | 1u << AT_COLOUR);
	gl_floats(AT_POSITION, 4, stride, offsetof(struct sprite_vertex, clip));
	gl_floats(AT_PLACE, 2, stride, offsetof(struct sprite_vertex, place));
	gl_bytes(AT_COLOUR, stride, offsetof(struct sprite_vertex, colour));
	glUseProgram(sprites->program);
	glBindTexture(GL_TEXTURE_2D, sprites->atlas);
	glEnable(GL_BLEND);
	glDepthMask(GL_FALSE);
	if (over_everything)
		glDisable(GL_DEPTH_TEST);
	glDrawElements(GL_TRIANGLES, sprites->count * 6, GL_UNSIGNED_SHORT, NULL);
	glEnable(GL_DEPTH_TEST);
	glDepthMask(GL_TRUE);
	glDisable(GL_BLEND);
}
