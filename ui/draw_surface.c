/* The camera as matrices, and the light on body and cloth.
 *
 * The studio stands still and the figure turns: one soft key from the upper left, a cool edge from
 * behind on the right, sky from above, warm light back from the floor. Nearly all of it is computed
 * at vertices, because a processor may have to do the work of the GPU; a fragment adds shadow,
 * weave and colour. Light is linear (squared colours); the last step takes the root.
 */
#include "draw_private.h"

/* Both surfaces start like this. Depth is moved back by u_bias metres, which keeps the body from
 * showing through cloth that lies on it. */
#define SURFACE_HEAD                                                                               \
	"uniform mat4 u_clip, u_light;\n"                                                          \
	"uniform mat3 u_axes;\n"                                                                   \
	"uniform vec3 u_eye;\n"                                                                    \
	"uniform vec2 u_depth;\n"                                                                  \
	"uniform float u_bias;\n"                                                                  \
	"attribute vec3 a_position, a_normal;\n"                                                   \
	"attribute vec4 a_material;\n"                                                             \
	"varying vec3 v_shadow;\n"                                                                 \
	"#ifdef FRINGE\n"                                                                          \
	"uniform vec2 u_pixel;\n"                                                                  \
	"attribute vec4 a_fringe;\n"                                                               \
	"varying vec2 v_fringe;\n"                                                                 \
	"#endif\n"                                                                                 \
	"const vec3 KEY = vec3(-0.506, 0.643, 0.575);\n"                                           \
	"const vec3 EDGE = vec3(0.770, 0.300, -0.563);\n"                                          \
	"vec4 place(vec3 position) {\n"                                                            \
	"  vec4 clip = u_clip * vec4(position, 1.0);\n"                                            \
	"  clip.z = (u_depth.x - u_depth.y / (clip.w + u_bias)) * clip.w;\n"                       \
	"#ifdef FRINGE\n"                                                                          \
	"  clip.xy += a_fringe.xy * u_pixel * clip.w;\n"                                           \
	"  v_fringe = a_fringe.zw;\n"                                                              \
	"#endif\n"                                                                                 \
	"  v_shadow = (u_light * vec4(position, 1.0)).xyz * 0.5 + 0.5;\n"                          \
	"  return clip;\n"                                                                         \
	"}\n"

/* The share of the key that gets through. */
/* A fringe is a strip one pixel wide along an outline: coverage and the side that is seen come with
 * its vertices (draw_fringe.c). */
#define SHADOW_HEAD                                                                                \
	"#ifdef FRINGE\n"                                                                          \
	"varying vec2 v_fringe;\n"                                                                 \
	"#define FRONT (v_fringe.y > 0.0)\n"                                                       \
	"#define SHOW(colour) vec4(colour, 1.0) * v_fringe.x\n"                                    \
	"#else\n"                                                                                  \
	"#define FRONT gl_FrontFacing\n"                                                           \
	"#define SHOW(colour) vec4(colour, 1.0)\n"                                                 \
	"#endif\n"                                                                                 \
	"#ifdef SHADOWS\n"                                                                         \
	"uniform sampler2DShadow u_shadow;\n"                                                      \
	"uniform float u_strength;\n"                                                              \
	"float lit(vec3 at) { return 1.0 - u_strength * (1.0 - texture(u_shadow, at)); }\n"        \
	"#else\n"                                                                                  \
	"float lit(vec3 at) { return 1.0; }\n"                                                     \
	"#endif\n"

static const char body_vertex_source[] = SURFACE_HEAD
	"varying vec3 v_ambient, v_key;\n"
	"void main() {\n"
	"  gl_Position = place(a_position);\n"
	"  vec3 n = u_axes * a_normal;\n"
	"  float open = a_material.x;\n"
	"  float edge = max(dot(n, EDGE), 0.0);\n"
	"  vec3 sky = mix(vec3(0.19, 0.155, 0.115), vec3(0.36, 0.362, 0.365), 0.5 + 0.5 * "
	"a_normal.y);\n"
	"  v_ambient = (sky + vec3(0.20, 0.22, 0.25) * edge * edge) * open;\n"
	"  float key = max((dot(n, KEY) + 0.18) * 0.847, 0.0);\n"
	"  v_key = vec3(0.83, 0.79, 0.715) * key * (0.55 + 0.45 * open);\n"
	"}\n";

static const char body_fragment_source[] = SHADOW_HEAD
	"varying vec3 v_ambient, v_key, v_shadow;\n"
	"void main() {\n"
	"  vec3 light = v_ambient + v_key * lit(v_shadow);\n"
	"  FRAG = SHOW(sqrt(vec3(0.815, 0.742, 0.632) * light));\n"
	"}\n";

/* a_material of cloth: openness to the sky, glow of the growing front. v_side carries what flips
 * its sign with the side that is seen: key and sky. */
static const char cloth_vertex_source[] = SURFACE_HEAD
	"attribute vec2 a_place;\n"
	"attribute vec4 a_colour, a_colour_2;\n"
	"varying vec4 v_light;\n" /* key, up, openness, sheen */
	"varying vec3 v_outside, v_inside;\n"
	"varying vec3 v_place;\n"
	"void main() {\n"
	"  gl_Position = place(a_position);\n"
	"  vec3 n = u_axes * a_normal;\n"
	"  vec3 to_eye = normalize(u_eye - a_position);\n"
	"  float grazing = 1.0 - abs(dot(a_normal, to_eye));\n"
	"  v_light = vec4(dot(n, KEY), a_normal.y, a_material.x,\n"
	"                 grazing * grazing * grazing * 0.30 * a_material.x);\n"
	"  v_outside = a_colour.rgb * a_colour.rgb;\n"
	"  v_inside = a_colour_2.rgb * a_colour_2.rgb;\n"
	"  v_place = vec3(a_place, a_material.y);\n"
	"}\n";

static const char cloth_fragment_source[] = SHADOW_HEAD
	"uniform sampler2D u_weave;\n"
	"varying vec4 v_light;\n"
	"varying vec3 v_outside, v_inside, v_place, v_shadow;\n"
	"void main() {\n"
	"  float side = FRONT ? 1.0 : -1.0;\n"
	"  vec3 colour = FRONT ? v_outside : v_inside;\n"
	"  float open = FRONT ? v_light.z : v_light.z * 0.72;\n"
	"  float key = max((v_light.x * side + 0.12) * 0.893, 0.0) * lit(v_shadow);\n"
	"  vec3 sky = mix(vec3(0.17, 0.145, 0.12), vec3(0.40, 0.41, 0.42),\n"
	"                 0.5 + 0.5 * v_light.y * side);\n"
	"  float weave = texture2D(u_weave, v_place.xy).r * 2.0;\n"
	"  vec3 light = sky * open + vec3(1.02, 0.97, 0.88) * key * (0.5 + 0.5 * open);\n"
	"  colour = colour * light * weave + v_light.w * (0.3 + colour);\n"
	"  colour += vec3(0.95, 0.62, 0.25) * v_place.z;\n"
	"  FRAG = SHOW(sqrt(colour));\n"
	"}\n";

bool surface_open(struct surface_program *surface, bool cloth, bool fringe, char fault[200])
{
	GLuint program = gl_program_variant(
		fringe ? "#define FRINGE\n" : "", cloth ? cloth_vertex_source : body_vertex_source,
		cloth ? cloth_fragment_source : body_fragment_source, fault);
	if (!program)
		return false;
	*surface = (struct surface_program){
		.program = program,
		.clip = glGetUniformLocation(program, "u_clip"),
		.axes = glGetUniformLocation(program, "u_axes"),
		.light = glGetUniformLocation(program, "u_light"),
		.eye = glGetUniformLocation(program, "u_eye"),
		.depth = glGetUniformLocation(program, "u_depth"),
		.bias = glGetUniformLocation(program, "u_bias"),
		.shadow = glGetUniformLocation(program, "u_shadow"),
		.weave = glGetUniformLocation(program, "u_weave"),
		.pixel = glGetUniformLocation(program, "u_pixel"),
		.strength = glGetUniformLocation(program, "u_strength"),
	};
	return true;
}

void surface_use(const struct surface_program *surface, const struct draw *draw, float bias_m)
{
	const struct camera *camera = &draw->camera;
	glUseProgram(surface->program);
	glUniformMatrix4fv(surface->clip, 1, GL_FALSE, camera->world_to_clip);
	glUniformMatrix4fv(surface->light, 1, GL_FALSE, camera->world_to_light);
	glUniformMatrix3fv(surface->axes, 1, GL_FALSE, camera->world_to_axes);
	glUniform3f(surface->eye, camera->eye_m.x, camera->eye_m.y, camera->eye_m.z);
	glUniform2f(surface->depth, camera->depth[0], camera->depth[1]);
	glUniform1f(surface->bias, bias_m);
	glUniform1f(surface->strength, draw->shadow.size ? 0.82f : 0.0f);
	glUniform2f(surface->pixel, 2.0f / (float)camera->pane.w, 2.0f / (float)camera->pane.h);
	glUniform1i(surface->shadow, 1);
	glUniform1i(surface->weave, 0);
	glActiveTexture(GL_TEXTURE1);
	glBindTexture(GL_TEXTURE_2D, draw->shadow.texture);
	glActiveTexture(GL_TEXTURE0);
}

/* Rows of a 4x4 that takes (p - origin) to x.p, y.p, z.p, each scaled; column-major. */
static void affine(float m[16], struct v3 origin_m, struct v3 x, struct v3 y, struct v3 z)
{
	struct v3 row[3] = {x, y, z};
	for (int r = 0; r < 3; r++) {
		m[r] = row[r].x;
		m[4 + r] = row[r].y;
		m[8 + r] = row[r].z;
		m[12 + r] = -v3_dot(row[r], origin_m);
	}
	m[3] = m[7] = m[11] = 0.0f;
	m[15] = 1.0f;
}

/* The key's view of a ball round the figure: parallel rays along KEY of the shaders. */
static void light_make(struct camera *camera, const struct view *view, const struct body *body)
{
	struct v3 key = m3_apply_transposed(&view->turn, (struct v3){-0.506f, 0.643f, 0.575f});
	struct v3 centre = v3_lerp(body->low_m, body->high_m, 0.5f);
	float radius = 0.5f * v3_distance(body->low_m, body->high_m) + 0.05f;
	struct v3 side = v3_normalize(v3_cross(view->turn.row[1], key));
	struct v3 up = v3_cross(key, side);
	float scale = 1.0f / float_max(radius, 0.1f);
	affine(camera->world_to_light, centre, v3_scale(side, scale), v3_scale(up, scale),
	       v3_scale(key, -scale));
}

void camera_make(struct camera *camera, const struct view *view, const struct body *body)
{
	const struct v3 *row = view->turn.row;
	float near_m = float_max(view->distance_m - 2.5f, 0.1f), far_m = view->distance_m + 2.5f;
	float zoom = 2.0f * view->focal;
	float aspect = (float)view->pane.h / (float)view->pane.w;
	camera->pane = view->pane;
	camera->back = row[2];
	camera->eye_m = v3_mad(view->centre_m, row[2], view->distance_m);
	camera->px_per_m = view->focal * (float)view->pane.h;
	camera->depth[0] = (far_m + near_m) / (far_m - near_m);
	camera->depth[1] = 2.0f * far_m * near_m / (far_m - near_m);
	float *m = camera->world_to_clip;
	affine(m, camera->eye_m, v3_scale(row[0], zoom * aspect), v3_scale(row[1], zoom),
	       v3_scale(row[2], -camera->depth[0]));
	m[14] -= camera->depth[1];
	m[3] = -row[2].x;
	m[7] = -row[2].y;
	m[11] = -row[2].z;
	m[15] = v3_dot(row[2], camera->eye_m);
	for (int r = 0; r < 3; r++) {
		camera->world_to_axes[r] = row[r].x;
		camera->world_to_axes[3 + r] = row[r].y;
		camera->world_to_axes[6 + r] = row[r].z;
	}
	light_make(camera, view, body);
}

void camera_clip(const struct camera *camera, struct v3 p, float lift_m, float clip[4])
{
	const float *m = camera->world_to_clip;
	for (int r = 0; r < 4; r++)
		clip[r] = m[r] * p.x + m[4 + r] * p.y + m[8 + r] * p.z + m[12 + r];
	float nearer_m = float_max(clip[3] - lift_m, 0.05f);
	clip[2] = (camera->depth[0] - camera->depth[1] / nearer_m) * clip[3];
}
