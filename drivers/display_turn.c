#include "display_turn.h"

#include "display_private.h"

#include <GLES2/gl2ext.h>

/* Corners 0..1 of the picture, y down, through the map, to clip space. */
static const char vertex_source[] =
	"attribute vec2 a_corner;\n"
	"uniform mat3 u_place;\n"
	"varying vec2 v_place;\n"
	"void main() {\n"
	"  v_place = vec2(a_corner.x, 1.0 - a_corner.y);\n"
	"  gl_Position = vec4((u_place * vec3(a_corner, 1.0)).xy, 0.0, 1.0);\n"
	"}\n";
static const char fragment_source[] =
	"precision mediump float;\n"
	"uniform sampler2D u_picture;\n"
	"varying highp vec2 v_place;\n"
	"void main() {\n"
	"  gl_FragColor = vec4(texture2D(u_picture, v_place).rgb, 1.0);\n"
	"}\n";

bool turn_target(GLuint *framebuffer, GLuint *colour, GLuint *depth, int width, int height)
{
	GLint largest = 0;
	/* Pixels in the byte order of screens and of cairo: copies need no conversion. */
	GLenum format = display_extension((const char *)glGetString(GL_EXTENSIONS),
					  "GL_EXT_texture_format_BGRA8888")
				? GL_BGRA_EXT
				: GL_RGBA;
	glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
	if (width > largest || height > largest)
		return false;
	glGenTextures(1, colour);
	glBindTexture(GL_TEXTURE_2D, *colour);
	glTexImage2D(GL_TEXTURE_2D, 0, (GLint)format, width, height, 0, format, GL_UNSIGNED_BYTE,
		     NULL);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
	glGenRenderbuffers(1, depth);
	glBindRenderbuffer(GL_RENDERBUFFER, *depth);
	glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, width, height);
	glGenFramebuffers(1, framebuffer);
	glBindFramebuffer(GL_FRAMEBUFFER, *framebuffer);
	glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, *colour, 0);
	glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, *depth);
	return glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
}

static GLuint shader_make(GLenum kind, const char *source)
{
	GLuint shader = glCreateShader(kind);
	glShaderSource(shader, 1, &source, NULL);
	glCompileShader(shader);
	return shader;
}

static bool program_make(struct turn *turn)
{
	GLuint vertex = shader_make(GL_VERTEX_SHADER, vertex_source);
	GLuint fragment = shader_make(GL_FRAGMENT_SHADER, fragment_source);
	GLint good = GL_FALSE;
	turn->program = glCreateProgram();
	glAttachShader(turn->program, vertex);
	glAttachShader(turn->program, fragment);
	glBindAttribLocation(turn->program, 0, "a_corner");
	glLinkProgram(turn->program);
	glGetProgramiv(turn->program, GL_LINK_STATUS, &good);
	glDeleteShader(vertex);
	glDeleteShader(fragment);
	turn->place = glGetUniformLocation(turn->program, "u_place");
	return good;
}

bool turn_open(struct turn *turn, int width, int height, int degrees, int panel_width,
	       int panel_height)
{
	static const float corner[8] = {0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 1.0f, 1.0f, 1.0f};
	*turn = (struct turn){.width = width,
			      .height = height,
			      .panel_width = panel_width,
			      .panel_height = panel_height};
	turn->map = plane_map_fit((struct v2){(float)width, (float)height}, degrees,
				  (struct v2){(float)panel_width, (float)panel_height});
	turn->exact = degrees % 180 ? width == panel_height && height == panel_width
				    : width == panel_width && height == panel_height;
	if (!turn_target(&turn->framebuffer, &turn->colour, &turn->depth, width, height) ||
	    !program_make(turn)) {
		turn_close(turn);
		return false;
	}
	GLint filter = turn->exact ? GL_NEAREST : GL_LINEAR;
	glBindTexture(GL_TEXTURE_2D, turn->colour);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
	glGenBuffers(1, &turn->corners);
	glBindBuffer(GL_ARRAY_BUFFER, turn->corners);
	glBufferData(GL_ARRAY_BUFFER, sizeof corner, corner, GL_STATIC_DRAW);
	return true;
}

void turn_begin(const struct turn *turn)
{
	glBindFramebuffer(GL_FRAMEBUFFER, turn->framebuffer);
}

/* Corner to picture px, by the map to panel px, to clip space with y up; column by column. */
static void place_set(const struct turn *turn)
{
	float w = (float)turn->width, h = (float)turn->height;
	float to_x = 2.0f / (float)turn->panel_width, to_y = -2.0f / (float)turn->panel_height;
	const struct plane_map corner = {{{w, 0.0f, 0.0f}, {0.0f, h, 0.0f}, {0.0f, 0.0f, 1.0f}}};
	const struct plane_map clip = {
		{{to_x, 0.0f, -1.0f}, {0.0f, to_y, 1.0f}, {0.0f, 0.0f, 1.0f}}};
	struct plane_map place = plane_map_join(&corner, &turn->map);
	place = plane_map_join(&place, &clip);
	GLfloat column[9];
	for (int i = 0; i < 3; i++)
		for (int k = 0; k < 3; k++)
			column[3 * k + i] = place.m[i][k];
	glUniformMatrix3fv(turn->place, 1, GL_FALSE, column);
}

void turn_show(const struct turn *turn, GLuint panel)
{
	glBindFramebuffer(GL_FRAMEBUFFER, panel);
	glViewport(0, 0, turn->panel_width, turn->panel_height);
	glDisable(GL_SCISSOR_TEST);
	glDisable(GL_DEPTH_TEST);
	glDisable(GL_BLEND);
	glDisable(GL_CULL_FACE);
	glClearColor(0.0f, 0.0f, 0.0f, 1.0f);
	glClear(GL_COLOR_BUFFER_BIT);
	glUseProgram(turn->program);
	place_set(turn);
	glActiveTexture(GL_TEXTURE0);
	glBindTexture(GL_TEXTURE_2D, turn->colour);
	glBindBuffer(GL_ARRAY_BUFFER, turn->corners);
	glEnableVertexAttribArray(0);
	glVertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, 0, NULL);
	glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

void turn_close(struct turn *turn)
{
	glDeleteFramebuffers(1, &turn->framebuffer);
	glDeleteTextures(1, &turn->colour);
	glDeleteRenderbuffers(1, &turn->depth);
	glDeleteProgram(turn->program);
	glDeleteBuffers(1, &turn->corners);
	*turn = (struct turn){0};
}
