/* The little of GL that drawing needs: programs, textures, buffers, one stream of vertices. */
#ifndef DRAW_GL_H
#define DRAW_GL_H

#include "look.h"

#include <GLES3/gl3.h>

/* Every program takes its attributes from these places. */
enum attribute {
	AT_POSITION,
	AT_NORMAL,
	AT_MATERIAL, /* bytes: what the shader makes of them */
	AT_PLACE,    /* texture coordinates and the like */
	AT_COLOUR,
	AT_COLOUR_2,
	AT_FRINGE,
	AT_COUNT,
};

/* Compiles and links; 0 with the compiler's own words in fault. Sources are written in the words of
 * GLSL 1.00 with FRAG for the result, and become 3.00 by a prelude when `modern`. */
GLuint gl_program(const char *vertex, const char *fragment, char fault[200]);

/* The same with lines (#define ...) before both sources. */
GLuint gl_program_variant(const char *lines, const char *vertex, const char *fragment,
			  char fault[200]);

/* True for the renderers that draw on the processor. */
bool gl_software(void);

/* An empty 2D texture; filters are GL_NEAREST, GL_LINEAR or a mipmap filter. */
GLuint gl_texture(GLenum filter, GLenum wrap);

/* Where a vertex attribute lies in the buffer that is bound. */
void gl_floats(enum attribute attribute, int count, int stride, size_t offset);
void gl_bytes(enum attribute attribute, int stride, size_t offset); /* 4, as 0..1 */
void gl_attributes(unsigned used); /* bit set: these and no others */

void gl_uniform_colour(GLint place, uint32_t colour);

#endif
