/* The figure alone, on nothing, larger than the pane it stands in: what the card shows of it. A
 * picture a frame, drawn in the frame's place and fetched frames later, so that nobody waits. */
#include "draw_card.h"
#include "draw_private.h"

#include <stdlib.h>

struct portrait {
	GLuint framebuffer, colour, depth, pixels;
};

static const size_t portrait_bytes = (size_t)PORTRAIT_WIDTH * PORTRAIT_HEIGHT * 4;

static void portrait_drop(struct portrait *portrait)
{
	glDeleteFramebuffers(1, &portrait->framebuffer);
	glDeleteTextures(1, &portrait->colour);
	glDeleteRenderbuffers(1, &portrait->depth);
	glDeleteBuffers(1, &portrait->pixels);
}

static bool portrait_make(struct portrait *portrait)
{
	portrait->colour = gl_texture(GL_NEAREST, GL_CLAMP_TO_EDGE);
	glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, PORTRAIT_WIDTH, PORTRAIT_HEIGHT, 0, GL_RGBA,
		     GL_UNSIGNED_BYTE, NULL);
	glGenRenderbuffers(1, &portrait->depth);
	glBindRenderbuffer(GL_RENDERBUFFER, portrait->depth);
	glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, PORTRAIT_WIDTH,
			      PORTRAIT_HEIGHT);
	glGenFramebuffers(1, &portrait->framebuffer);
	glBindFramebuffer(GL_FRAMEBUFFER, portrait->framebuffer);
	glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D,
			       portrait->colour, 0);
	glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER,
				  portrait->depth);
	glGenBuffers(1, &portrait->pixels);
	glBindBuffer(GL_PIXEL_PACK_BUFFER, portrait->pixels);
	glBufferData(GL_PIXEL_PACK_BUFFER, (GLsizeiptr)portrait_bytes, NULL, GL_STREAM_READ);
	glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
	return glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
}

/* From a little above and beside, as portraits are taken; all of the body in the picture. */
static struct view portrait_view(const struct body *body, float azimuth_rad)
{
	struct layout layout;
	struct view view;
	layout_make(&layout, 1920, 1080, STEP_DRAW, false);
	view_init(&view, &layout);
	float height_m = float_max(body->high_m.y - body->low_m.y, 0.1f);
	view.pane = (struct rect){0, 0, PORTRAIT_WIDTH, PORTRAIT_HEIGHT};
	view.centre_m = v3_lerp(body->low_m, body->high_m, 0.5f);
	view.centre_m.y -= 0.005f * height_m;
	view.distance_m = 2.45f * height_m;
	view_look(&view, azimuth_rad);
	return view;
}

static void figure_alone(struct draw *draw, const struct session *session, const struct view *view)
{
	static struct ui nobody; /* too large for a stack */
	nobody.view = *view;
	nobody.step = STEP_ADJUST;
	nobody.piece = nobody.seam = -1;
	figure_follow(draw, view, session);
	glDisable(GL_SCISSOR_TEST);
	glClearColor(0.0f, 0.0f, 0.0f, 0.0f);
	glClear(GL_COLOR_BUFFER_BIT);
	pane_enter(draw, &view->pane);
	room_draw(draw);
	body_draw(draw);
	cloth_draw(draw);
	fringe_body_draw(draw, &session->body);
	fringe_cloth_draw(draw, session);
	ribbons_begin(draw);
	sprites_begin(draw);
	trim_add(draw, &nobody, session);
	ribbons_draw(draw, 0.0035f);
}

bool draw_portrait(struct draw *draw, const struct session *session, float azimuth_rad)
{
	struct portrait *portrait = draw->portrait ? draw->portrait : calloc(1, sizeof *portrait);
	int width = draw->width, height = draw->height;
	GLint target = draw->target;
	float px = draw->px;
	if (!portrait)
		return false;
	bool made = draw->portrait || portrait_make(portrait);
	draw->portrait = portrait;
	if (made) {
		struct view view = portrait_view(&session->body, azimuth_rad);
		draw->target = (GLint)portrait->framebuffer;
		draw->width = PORTRAIT_WIDTH;
		draw->height = PORTRAIT_HEIGHT;
		draw->px = 1.3f;
		glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
		glBindFramebuffer(GL_FRAMEBUFFER, portrait->framebuffer);
		figure_alone(draw, session, &view);
		glBindBuffer(GL_PIXEL_PACK_BUFFER, portrait->pixels);
		glReadPixels(0, 0, PORTRAIT_WIDTH, PORTRAIT_HEIGHT, GL_RGBA, GL_UNSIGNED_BYTE,
			     NULL);
		glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
	}
	draw->target = target;
	draw->width = width;
	draw->height = height;
	draw->px = px;
	glBindFramebuffer(GL_FRAMEBUFFER, (GLuint)target);
	return made;
}

/* GL's rows begin below, and its bytes are red first. */
static void turn_over(unsigned char *out, const unsigned char *in)
{
	for (int y = 0; y < PORTRAIT_HEIGHT; y++)
		for (int x = 0; x < PORTRAIT_WIDTH; x++) {
			size_t from = (size_t)(PORTRAIT_HEIGHT - 1 - y) * PORTRAIT_WIDTH +
				      (size_t)x;
			const unsigned char *pixel = in + 4 * from;
			*out++ = pixel[2];
			*out++ = pixel[1];
			*out++ = pixel[0];
			*out++ = pixel[3];
		}
}

unsigned char *draw_portrait_fetch(struct draw *draw)
{
	struct portrait *portrait = draw->portrait;
	unsigned char *out = portrait ? malloc(portrait_bytes) : NULL;
	if (!out)
		return NULL;
	glBindBuffer(GL_PIXEL_PACK_BUFFER, portrait->pixels);
	const unsigned char *in = glMapBufferRange(GL_PIXEL_PACK_BUFFER, 0,
						   (GLsizeiptr)portrait_bytes, GL_MAP_READ_BIT);
	if (in)
		turn_over(out, in);
	else
		memset(out, 0, portrait_bytes);
	glUnmapBuffer(GL_PIXEL_PACK_BUFFER);
	glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
	return out;
}

void draw_portrait_end(struct draw *draw)
{
	if (!draw->portrait)
		return;
	portrait_drop(draw->portrait);
	free(draw->portrait);
	draw->portrait = NULL;
}

/* Its objects have gone with their context. */
void portrait_release(struct draw *draw)
{
	free(draw->portrait);
	draw->portrait = NULL;
}
