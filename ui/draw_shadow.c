/* What the key light sees, as depth: soft shadows of arms on the trunk, of hems on legs. */
#include "draw_private.h"

static const char shadow_vertex_source[] = "uniform mat4 u_clip;\n"
					   "attribute vec3 a_position;\n"
					   "void main() {\n"
					   "  gl_Position = u_clip * vec4(a_position, 1.0);\n"
					   "}\n";
static const char shadow_fragment_source[] = "void main() { FRAG = vec4(1.0); }\n";

bool shadow_open(struct draw *draw, char fault[200])
{
	struct shadow *shadow = &draw->shadow;
	const char *version = (const char *)glGetString(GL_VERSION);
	if (!version || strncmp(version, "OpenGL ES 3", 11))
		return true; /* comparing samplers came with 3.0: without shadows, then */
	shadow->size = gl_software() ? SHADOW_SIZE : SHADOW_SIZE_FINE;
	shadow->program = gl_program(shadow_vertex_source, shadow_fragment_source, fault);
	if (!shadow->program)
		return false;
	shadow->clip = glGetUniformLocation(shadow->program, "u_clip");
	shadow->texture = gl_texture(GL_LINEAR, GL_CLAMP_TO_EDGE);
	glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT16, shadow->size, shadow->size, 0,
		     GL_DEPTH_COMPONENT, GL_UNSIGNED_SHORT, NULL);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
	glGenFramebuffers(1, &shadow->framebuffer);
	glBindFramebuffer(GL_FRAMEBUFFER, shadow->framebuffer);
	glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, shadow->texture,
			       0);
	if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
		shadow->size = 0;
	glBindFramebuffer(GL_FRAMEBUFFER, (GLuint)draw->target);
	return true;
}

void shadow_draw(struct draw *draw)
{
	struct shadow *shadow = &draw->shadow;
	if (!shadow->size)
		return;
	glBindFramebuffer(GL_FRAMEBUFFER, shadow->framebuffer);
	glDisable(GL_SCISSOR_TEST);
	glViewport(0, 0, shadow->size, shadow->size);
	glClear(GL_DEPTH_BUFFER_BIT);
	glEnable(GL_POLYGON_OFFSET_FILL);
	glPolygonOffset(2.0f, 160.0f);
	glUseProgram(shadow->program);
	glUniformMatrix4fv(shadow->clip, 1, GL_FALSE, draw->camera.world_to_light);
	if (draw->body.index_count) { /* its far side lies behind the near one */
		glEnable(GL_CULL_FACE);
		body_cast(draw);
		glDisable(GL_CULL_FACE);
	}
	if (draw->cloth.index_count)
		cloth_cast(draw);
	glDisable(GL_POLYGON_OFFSET_FILL);
	glBindFramebuffer(GL_FRAMEBUFFER, (GLuint)draw->target);
}
