#include "draw_gl.h"

#include <stdio.h>

static const char *const attribute_name[AT_COUNT] = {
	"a_position", "a_normal", "a_material", "a_place", "a_colour", "a_colour_2", "a_fringe",
};

static const char vertex_300[] = "#version 300 es\n"
				 "#define attribute in\n"
				 "#define varying out\n"
				 "precision highp float;\n";
static const char fragment_300[] = "#version 300 es\n"
				   "precision mediump float;\n"
				   "precision mediump sampler2DShadow;\n"
				   "#define varying in\n"
				   "#define texture2D texture\n"
				   "#define SHADOWS 1\n"
				   "out vec4 FRAG;\n";
static const char vertex_100[] = "#version 100\n"
				 "precision highp float;\n";
static const char fragment_100[] = "#version 100\n"
				   "precision mediump float;\n"
				   "#define FRAG gl_FragColor\n";

static bool gl_modern(void)
{
	const char *version = (const char *)glGetString(GL_VERSION);
	return version && !strncmp(version, "OpenGL ES 3", 11);
}

static GLuint shader_make(GLenum kind, const char *lines, const char *source, char fault[200])
{
	bool vertex = kind == GL_VERTEX_SHADER;
	const char *prelude = gl_modern() ? (vertex ? vertex_300 : fragment_300)
					  : (vertex ? vertex_100 : fragment_100);
	const char *parts[3] = {prelude, lines, source};
	GLuint shader = glCreateShader(kind);
	GLint good = GL_FALSE;
	glShaderSource(shader, 3, parts, NULL);
	glCompileShader(shader);
	glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
	if (good)
		return shader;
	glGetShaderInfoLog(shader, 200, NULL, fault);
	glDeleteShader(shader);
	return 0;
}

GLuint gl_program(const char *vertex, const char *fragment, char fault[200])
{
	return gl_program_variant("", vertex, fragment, fault);
}

GLuint gl_program_variant(const char *lines, const char *vertex, const char *fragment,
			  char fault[200])
{
	GLuint v = shader_make(GL_VERTEX_SHADER, lines, vertex, fault);
	GLuint f = v ? shader_make(GL_FRAGMENT_SHADER, lines, fragment, fault) : 0;
	GLuint program = f ? glCreateProgram() : 0;
	GLint good = GL_FALSE;
	if (program) {
		glAttachShader(program, v);
		glAttachShader(program, f);
		for (int i = 0; i < AT_COUNT; i++)
			glBindAttribLocation(program, (GLuint)i, attribute_name[i]);
		glLinkProgram(program);
		glGetProgramiv(program, GL_LINK_STATUS, &good);
		if (!good) {
			glGetProgramInfoLog(program, 200, NULL, fault);
			glDeleteProgram(program);
			program = 0;
		}
	}
	glDeleteShader(v);
	glDeleteShader(f);
	return program;
}

bool gl_software(void)
{
	const char *name = (const char *)glGetString(GL_RENDERER);
	return name && (strstr(name, "llvmpipe") || strstr(name, "softpipe") ||
			strstr(name, "SwiftShader"));
}

GLuint gl_texture(GLenum filter, GLenum wrap)
{
	GLuint texture = 0;
	bool mipmap = filter != GL_NEAREST && filter != GL_LINEAR;
	glGenTextures(1, &texture);
	glBindTexture(GL_TEXTURE_2D, texture);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, (GLint)filter);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, (GLint)(mipmap ? GL_LINEAR : filter));
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, (GLint)wrap);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, (GLint)wrap);
	return texture;
}

void gl_floats(enum attribute attribute, int count, int stride, size_t offset)
{
	glVertexAttribPointer((GLuint)attribute, count, GL_FLOAT, GL_FALSE, stride,
			      (const void *)offset);
}

void gl_bytes(enum attribute attribute, int stride, size_t offset)
{
	glVertexAttribPointer((GLuint)attribute, 4, GL_UNSIGNED_BYTE, GL_TRUE, stride,
			      (const void *)offset);
}

void gl_attributes(unsigned used)
{
	for (int i = 0; i < AT_COUNT; i++) {
		if (used >> i & 1)
			glEnableVertexAttribArray((GLuint)i);
		else
			glDisableVertexAttribArray((GLuint)i);
	}
}

void gl_uniform_colour(GLint place, uint32_t colour)
{
	glUniform3f(place, look_red(colour), look_green(colour), look_blue(colour));
}
