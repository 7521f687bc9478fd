/* Lines as ribbons of constant width on the screen, smooth at their edges, solid or dashed. */
#include "draw_private.h"

#include <stddef.h>
#include <stdlib.h>

enum { DASH_TEXELS = 128 };

static const char ribbon_vertex_source[] =
	"uniform mat4 u_clip;\n"
	"uniform vec2 u_depth;\n"
	"uniform float u_bias;\n"
	"attribute vec3 a_position;\n"
	"attribute vec4 a_colour, a_place;\n"
	"varying vec4 v_colour, v_place;\n"
	"void main() {\n"
	"  v_colour = a_colour;\n"
	"  v_place = a_place;\n"
	"  gl_Position = u_clip * vec4(a_position, 1.0);\n"
	"  float d = gl_Position.w;\n"
	"  gl_Position.z = (u_depth.x - u_depth.y / max(d - u_bias, 0.05)) * d;\n"
	"}\n";
static const char ribbon_fragment_source[] =
	"uniform sampler2D u_texture;\n"
	"varying vec4 v_colour, v_place;\n"
	"void main() {\n"
	"  float edge = clamp(v_place.w - abs(v_place.z) + 0.5, 0.0, 1.0);\n"
	"  FRAG = v_colour * (edge * texture2D(u_texture, v_place.xy).r);\n"
	"}\n";

/* One row a style: 1 where the pen is down, its period stretched over the row. */
static void dashes_make(struct ribbons *ribbons)
{
	uint8_t pixel[DASH_ROWS][DASH_TEXELS];
	for (int row = 0; row < DASH_ROWS; row++) {
		float dash[4] = {62.0f, 38.0f, 0.0f, 0.0f}; /* stitches, and the line of a drag */
		if (row < MARK_STYLES)
			memcpy(dash, look_mark[row].dash_px, sizeof dash);
		float period = dash[0] + dash[1] + dash[2] + dash[3];
		for (int x = 0; x < DASH_TEXELS; x++) {
			float at = ((float)x + 0.5f) / DASH_TEXELS * period;
			bool down = at < dash[0] ||
				    (at >= dash[0] + dash[1] && at < dash[0] + dash[1] + dash[2]);
			pixel[row][x] = period == 0.0f || down ? 255 : 0;
		}
	}
	ribbons->dashes = gl_texture(GL_LINEAR, GL_REPEAT);
	glTexImage2D(GL_TEXTURE_2D, 0, GL_LUMINANCE, DASH_TEXELS, DASH_ROWS, 0, GL_LUMINANCE,
		     GL_UNSIGNED_BYTE, pixel);
}

bool ribbons_open(struct draw *draw, char fault[200])
{
	struct ribbons *ribbons = &draw->ribbons;
	ribbons->vertex = calloc(RIBBON_VERTICES_MAX, sizeof *ribbons->vertex);
	ribbons->program = gl_program(ribbon_vertex_source, ribbon_fragment_source, fault);
	if (!ribbons->vertex || !ribbons->program)
		return false;
	ribbons->clip = glGetUniformLocation(ribbons->program, "u_clip");
	ribbons->depth = glGetUniformLocation(ribbons->program, "u_depth");
	ribbons->bias = glGetUniformLocation(ribbons->program, "u_bias");
	glGenBuffers(1, &ribbons->vertices);
	dashes_make(ribbons);
	return true;
}

void ribbons_release(struct draw *draw)
{
	free(draw->ribbons.vertex);
}

void ribbons_begin(struct draw *draw)
{
	draw->ribbons.count = 0;
}

static float dash_row(enum dash_row row)
{
	return ((float)row + 0.5f) / (float)DASH_ROWS;
}

static struct ribbon_vertex *quad_take(struct ribbons *ribbons)
{
	if (ribbons->count + 4 > RIBBON_VERTICES_MAX)
		return NULL;
	ribbons->count += 4;
	return ribbons->vertex + ribbons->count - 4;
}

static void colour_take(uint8_t out[4], uint32_t colour, float alpha)
{
	out[0] = (uint8_t)((float)(colour >> 16 & 255) * alpha);
	out[1] = (uint8_t)((float)(colour >> 8 & 255) * alpha);
	out[2] = (uint8_t)((float)(colour & 255) * alpha);
	out[3] = (uint8_t)(255.0f * alpha);
}

/* Metres that one pixel spans at a point. */
static float metres_per_px(const struct camera *camera, struct v3 point_m)
{
	float distance_m = v3_dot(v3_sub(camera->eye_m, point_m), camera->back);
	return float_max(distance_m, 0.05f) / camera->px_per_m;
}

/* Two corners of a quad at one of its ends. */
static void end_make(struct ribbon_vertex *corner, const struct camera *camera, struct v3 point_m,
		     struct v3 side, float along, float alpha, const struct stroke *stroke)
{
	float reach_px = stroke->half_px + 0.6f;
	struct v3 shift_m = v3_scale(side, reach_px * metres_per_px(camera, point_m));
	for (int k = 0; k < 2; k++) {
		float sign = k ? 1.0f : -1.0f;
		corner[k].position_m = v3_mad(point_m, shift_m, sign);
		colour_take(corner[k].colour, stroke->colour, alpha * stroke->alpha);
		corner[k].along = along;
		corner[k].row = dash_row(stroke->row);
		corner[k].across_px = sign * reach_px;
		corner[k].half_px = stroke->half_px;
	}
}

static struct v3 side_of(const struct camera *camera, struct v3 at_m, struct v3 along)
{
	return v3_normalize(v3_cross(v3_sub(camera->eye_m, at_m), along));
}

void ribbons_segment(struct draw *draw, struct v3 a_m, struct v3 b_m, float along_m,
		     const struct stroke *stroke)
{
	const struct camera *camera = &draw->camera;
	struct ribbon_vertex *quad = quad_take(&draw->ribbons);
	if (!quad)
		return;
	struct v3 side = side_of(camera, a_m, v3_sub(b_m, a_m));
	float end_m = along_m + v3_distance(a_m, b_m);
	end_make(quad, camera, a_m, side, along_m / stroke->period, 1.0f, stroke);
	end_make(quad + 2, camera, b_m, side, end_m / stroke->period, 1.0f, stroke);
}

/* 1 where a surface faces the eye, 0 from a grazing view on. */
static float facing(const struct camera *camera, struct v3 point_m, struct v3 normal)
{
	struct v3 to_eye = v3_normalize(v3_sub(camera->eye_m, point_m));
	return float_clamp(v3_dot(normal, to_eye) * 6.0f + 0.6f, 0.0f, 1.0f);
}

void ribbons_line(struct draw *draw, const struct v3 *point_m, const struct v3 *normal, int count,
		  float lift_m, const struct stroke *stroke)
{
	const struct camera *camera = &draw->camera;
	struct v3 last_m = {0}, last_side = {0};
	float along_px = 0.0f, last_alpha = 0.0f;
	for (int i = 0; i < count; i++) {
		struct v3 at_m = normal ? v3_mad(point_m[i], normal[i], lift_m) : point_m[i];
		struct v3 along = v3_sub(point_m[int_min(i + 1, count - 1)],
					 point_m[int_max(i - 1, 0)]);
		struct v3 side = side_of(camera, at_m, along);
		float alpha = normal ? facing(camera, at_m, normal[i]) : 1.0f;
		float start_px = along_px;
		if (i > 0)
			along_px += v3_distance(at_m, last_m) / metres_per_px(camera, at_m);
		struct ribbon_vertex *quad = i > 0 ? quad_take(&draw->ribbons) : NULL;
		if (quad) {
			end_make(quad, camera, last_m, last_side, start_px / stroke->period,
				 last_alpha, stroke);
			end_make(quad + 2, camera, at_m, side, along_px / stroke->period, alpha,
				 stroke);
		}
		last_m = at_m;
		last_side = side;
		last_alpha = alpha;
	}
}

void ribbons_draw(struct draw *draw, float lift_m)
{
	struct ribbons *ribbons = &draw->ribbons;
	const struct camera *camera = &draw->camera;
	int stride = (int)sizeof *ribbons->vertex;
	if (!ribbons->count)
		return;
	glBindBuffer(GL_ARRAY_BUFFER, ribbons->vertices);
	glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)ribbons->count * stride, ribbons->vertex,
		     GL_STREAM_DRAW);
	glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, draw->quads);
	gl_attributes(1u << AT_POSITION | 1u << AT_PLACE | 1u << AT_COLOUR);
	gl_floats(AT_POSITION, 3, stride, offsetof(struct ribbon_vertex, position_m));
	gl_floats(AT_PLACE, 4, stride, offsetof(struct ribbon_vertex, along));
	gl_bytes(AT_COLOUR, stride, offsetof(struct ribbon_vertex, colour));
	glUseProgram(ribbons->program);
	glUniformMatrix4fv(ribbons->clip, 1, GL_FALSE, camera->world_to_clip);
	glUniform2f(ribbons->depth, camera->depth[0], camera->depth[1]);
	glUniform1f(ribbons->bias, lift_m);
	glBindTexture(GL_TEXTURE_2D, ribbons->dashes);
	glEnable(GL_BLEND);
	glDepthMask(GL_FALSE);
	glDrawElements(GL_TRIANGLES, ribbons->count / 4 * 6, GL_UNSIGNED_SHORT, NULL);
	glDepthMask(GL_TRUE);
	glDisable(GL_BLEND);
}
