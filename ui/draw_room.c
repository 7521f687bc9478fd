/* The room: a warm backdrop made once for the pane, and a floor that only holds the soft shadow
 * under the feet. */
#include "draw_private.h"

#include <stdlib.h>

enum { FLOOR_SIZE = 96 };

static const char quad_vertex_source[] =
	"uniform vec4 u_place, u_cut;\n" /* scale, shift */
	"attribute vec2 a_place;\n"
	"varying vec2 v_place;\n"
	"void main() {\n"
	"  v_place = a_place * u_cut.xy + u_cut.zw;\n"
	"  gl_Position = vec4(a_place * u_place.xy + u_place.zw, 0.0, 1.0);\n"
	"}\n";
static const char quad_fragment_source[] =
	"uniform sampler2D u_texture;\n"
	"varying vec2 v_place;\n"
	"void main() { FRAG = texture2D(u_texture, v_place); }\n";
static const char floor_vertex_source[] = "uniform mat4 u_clip;\n"
					  "uniform vec4 u_cut;\n" /* scale, shift */
					  "uniform float u_half;\n"
					  "attribute vec2 a_place;\n"
					  "varying vec2 v_place;\n"
					  "void main() {\n"
					  "  v_place = a_place * u_cut.xy + u_cut.zw;\n"
					  "  vec2 at = (v_place * 2.0 - 1.0) * u_half;\n"
					  "  gl_Position = u_clip * vec4(at.x, 0.0, at.y, 1.0);\n"
					  "}\n";
static const char floor_fragment_source[] =
	"uniform sampler2D u_texture;\n"
	"varying vec2 v_place;\n"
	"void main() {\n"
	"  float shade = texture2D(u_texture, v_place).r;\n"
	"  FRAG = vec4(vec3(0.16, 0.115, 0.07) * shade, shade);\n"
	"}\n";

bool room_open(struct draw *draw, char fault[200])
{
	static const float square[8] = {0, 0, 1, 0, 0, 1, 1, 1};
	struct room *room = &draw->room;
	room->program = gl_program(quad_vertex_source, quad_fragment_source, fault);
	room->floor_program = gl_program(floor_vertex_source, floor_fragment_source, fault);
	room->pixels = malloc((size_t)draw->width * (size_t)draw->height * 4);
	if (!room->program || !room->floor_program || !room->pixels)
		return false;
	room->place = glGetUniformLocation(room->program, "u_place");
	room->cut = glGetUniformLocation(room->program, "u_cut");
	room->floor_clip = glGetUniformLocation(room->floor_program, "u_clip");
	room->floor_half = glGetUniformLocation(room->floor_program, "u_half");
	room->floor_cut = glGetUniformLocation(room->floor_program, "u_cut");
	glGenBuffers(1, &room->quad);
	glBindBuffer(GL_ARRAY_BUFFER, room->quad);
	glBufferData(GL_ARRAY_BUFFER, sizeof square, square, GL_STATIC_DRAW);
	room->floor = gl_texture(GL_LINEAR, GL_CLAMP_TO_EDGE);
	return true;
}

void room_release(struct draw *draw)
{
	free(draw->room.pixels);
}

/* One channel of the backdrop: light falls off round a point above the middle, the floor begins as
 * a soft turn of the wall, and scatter of half a step hides the bands that 8 bits would show. */
static uint8_t backdrop_channel(float light, float dark, float fall, float scatter)
{
	float value = light + (dark - light) * fall;
	return (uint8_t)float_clamp(value * 255.0f + scatter, 0.0f, 255.0f);
}

static void backdrop_make(struct room *room, int width, int height)
{
	struct scatter scatter = {0x2545f491u};
	for (int y = 0; y < height; y++) {
		for (int x = 0; x < width; x++) {
			float u = ((float)x + 0.5f) / (float)width - 0.5f;
			float v = ((float)y + 0.5f) / (float)height - 0.40f;
			float round = float_min((u * u * 1.1f + v * v * 1.35f) * 2.0f, 1.0f);
			float low = float_clamp((((float)y + 0.5f) / (float)height - 0.70f) * 3.4f,
						0.0f, 1.0f);
			float fall = round * (1.0f - 0.30f * low * low * (3.0f - 2.0f * low));
			float noise = (float)(scatter_next(&scatter) >> 8 & 0xffff) / 65536.0f;
			uint8_t *pixel = room->pixels + ((size_t)y * (size_t)width + (size_t)x) * 4;
			pixel[2] = backdrop_channel(look_red(LOOK_ROOM_LIGHT),
						    look_red(LOOK_ROOM_DARK) - 0.03f, fall, noise);
			pixel[1] = backdrop_channel(look_green(LOOK_ROOM_LIGHT),
						    look_green(LOOK_ROOM_DARK) - 0.03f, fall,
						    noise);
			pixel[0] = backdrop_channel(look_blue(LOOK_ROOM_LIGHT),
						    look_blue(LOOK_ROOM_DARK) - 0.03f, fall, noise);
			pixel[3] = 255;
		}
	}
}

/* The part of the floor that is shaded at all, with the texel beside it that filtering reaches. */
static void floor_bound(struct room *room, uint8_t shade[FLOOR_SIZE][FLOOR_SIZE])
{
	int low[2] = {FLOOR_SIZE, FLOOR_SIZE}, high[2] = {0, 0};
	for (int z = 0; z < FLOOR_SIZE; z++)
		for (int x = 0; x < FLOOR_SIZE; x++) {
			if (!shade[z][x])
				continue;
			low[0] = int_min(low[0], int_max(x - 1, 0));
			low[1] = int_min(low[1], int_max(z - 1, 0));
			high[0] = int_max(high[0], int_min(x + 2, FLOOR_SIZE));
			high[1] = int_max(high[1], int_min(z + 2, FLOOR_SIZE));
		}
	for (int k = 0; k < 2; k++) {
		room->floor_part[k] = (float)low[k] / (float)FLOOR_SIZE;
		room->floor_part[2 + k] = (float)int_max(high[k] - low[k], 0) / (float)FLOOR_SIZE;
	}
}

/* The shadow under the feet: every body vertex near the floor darkens the texels below it, the
 * lower the darker and the narrower; higher ones (up to the knee) only tint. */
void room_floor_changed(struct draw *draw, const struct body *body)
{
	float sum[FLOOR_SIZE][FLOOR_SIZE];
	uint8_t shade[FLOOR_SIZE][FLOOR_SIZE];
	struct room *room = &draw->room;
	float half_m = 0.5f * v3_distance(body->low_m, body->high_m);
	half_m = float_max(half_m * 0.72f, 0.2f);
	float cells_per_m = (float)FLOOR_SIZE / (2.0f * half_m), reach_m = 0.55f;
	memset(sum, 0, sizeof sum);
	for (int i = 0; i < body->vertex_count; i++) {
		struct v3 p = body->position_m[i];
		float height_m = float_max(p.y, 0.0f);
		if (height_m > reach_m)
			continue;
		float radius_m = 0.05f + 0.75f * height_m;
		float weight = 0.0016f / (radius_m * radius_m);
		int cell_x = (int)((p.x + half_m) * cells_per_m);
		int cell_z = (int)((p.z + half_m) * cells_per_m);
		int reach = (int)(radius_m * cells_per_m) + 1;
		for (int z = int_max(cell_z - reach, 1);
		     z <= int_min(cell_z + reach, FLOOR_SIZE - 2); z++)
			for (int x = int_max(cell_x - reach, 1);
			     x <= int_min(cell_x + reach, FLOOR_SIZE - 2); x++) {
				float dx = ((float)x + 0.5f) / cells_per_m - half_m - p.x;
				float dz = ((float)z + 0.5f) / cells_per_m - half_m - p.z;
				float q = 1.0f - (dx * dx + dz * dz) / (radius_m * radius_m);
				sum[z][x] += q > 0.0f ? weight * q * q : 0.0f;
			}
	}
	for (int z = 0; z < FLOOR_SIZE; z++)
		for (int x = 0; x < FLOOR_SIZE; x++) {
			float s = sum[z][x] * 2400.0f / (float)int_max(body->vertex_count, 1);
			shade[z][x] = (uint8_t)(165.0f * s / (1.0f + s));
		}
	room->floor_half_m = half_m;
	floor_bound(room, shade);
	glBindTexture(GL_TEXTURE_2D, room->floor);
	glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
	glTexImage2D(GL_TEXTURE_2D, 0, GL_LUMINANCE, FLOOR_SIZE, FLOOR_SIZE, 0, GL_LUMINANCE,
		     GL_UNSIGNED_BYTE, shade);
	glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
}

void room_copy(struct draw *draw, const struct rect *pane)
{
	struct plate *plate = &draw->room.backdrop;
	struct rect all = {0, 0, int_min(pane->w, draw->width), int_min(pane->h, draw->height)};
	if (plate->width != all.w || plate->height != all.h) {
		if (plate->texture)
			glDeleteTextures(1, &plate->texture);
		if (plate->framebuffer)
			glDeleteFramebuffers(1, &plate->framebuffer);
		plate_open(draw, plate, all.w, all.h);
		backdrop_make(&draw->room, all.w, all.h);
		plate_upload(draw, plate, draw->room.pixels, all.w * 4, &all);
	}
	plate_copy(draw, plate, &all, pane->x, pane->y);
}

void room_draw(struct draw *draw)
{
	struct room *room = &draw->room;
	if (draw->camera.eye_m.y <= 0.0f)
		return;
	glDisable(GL_DEPTH_TEST);
	glEnable(GL_BLEND);
	glBindBuffer(GL_ARRAY_BUFFER, room->quad);
	gl_attributes(1u << AT_PLACE);
	gl_floats(AT_PLACE, 2, 8, 0);
	glUseProgram(room->floor_program);
	glUniformMatrix4fv(room->floor_clip, 1, GL_FALSE, draw->camera.world_to_clip);
	glUniform1f(room->floor_half, room->floor_half_m);
	glUniform4f(room->floor_cut, room->floor_part[2], room->floor_part[3], room->floor_part[0],
		    room->floor_part[1]);
	glBindTexture(GL_TEXTURE_2D, room->floor);
	glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
	glDisable(GL_BLEND);
	glEnable(GL_DEPTH_TEST);
}
