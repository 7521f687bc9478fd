/* One frame of the picture, from the back to the front. */
#include "draw.h"
#include "draw_notice.h"
#include "draw_private.h"
#include "draw_service.h"
#include "draw_take_home.h"

#include <stdio.h>
#include <stdlib.h>

/* Two triangles a quad, corners in the order 0 1 2 3 of a strip. */
static bool quads_make(struct draw *draw)
{
	int quads = RIBBON_VERTICES_MAX / 4;
	uint16_t *index = malloc((size_t)quads * 6 * sizeof *index);
	if (!index)
		return false;
	for (int i = 0; i < quads; i++) {
		static const int corner[6] = {0, 1, 2, 2, 1, 3};
		for (int k = 0; k < 6; k++)
			index[6 * i + k] = (uint16_t)(4 * i + corner[k]);
	}
	glGenBuffers(1, &draw->quads);
	glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, draw->quads);
	glBufferData(GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)((size_t)quads * 6 * sizeof *index),
		     index, GL_STATIC_DRAW);
	free(index);
	return true;
}

static bool order_open(struct mesh_order *order)
{
	order->triangle = calloc(BODY_TRIANGLES_MAX, sizeof *order->triangle);
	order->triangle_2 = calloc(BODY_TRIANGLES_MAX, sizeof *order->triangle_2);
	order->key = calloc(BODY_TRIANGLES_MAX, sizeof *order->key);
	order->key_2 = calloc(BODY_TRIANGLES_MAX, sizeof *order->key_2);
	order->rank = calloc(BODY_VERTICES_MAX, sizeof *order->rank);
	return order->triangle && order->triangle_2 && order->key && order->key_2 && order->rank;
}

static void order_release(struct mesh_order *order)
{
	free(order->triangle);
	free(order->triangle_2);
	free(order->key);
	free(order->key_2);
	free(order->rank);
}

static bool parts_open(struct draw *draw, char fault[200])
{
	return quads_make(draw) && order_open(&draw->order) && room_open(draw, fault) &&
	       body_open(draw, fault) && cloth_open(draw, fault) && shadow_open(draw, fault) &&
	       ribbons_open(draw, fault) && fringe_open(draw, fault) && sprites_open(draw, fault);
}

struct draw *draw_open(int width, int height, char fault[200])
{
	GLint texture_max = 0;
	struct draw *draw = calloc(1, sizeof *draw);
	fault[0] = 0;
	glGetIntegerv(GL_MAX_TEXTURE_SIZE, &texture_max);
	if (draw && (width > texture_max || height > texture_max)) {
		snprintf(fault, 200, "this GPU draws at most %d x %d pixels: choose a smaller mode",
			 texture_max, texture_max);
		free(draw);
		return NULL;
	}
	if (!draw) {
		snprintf(fault, 200, "no memory to draw with");
		return NULL;
	}
	draw->width = width;
	draw->height = height;
	draw->px = float_max((float)height / 1080.0f, 0.5f);
	draw->marks.stale = true;
	draw->software = gl_software();
	glGetIntegerv(GL_FRAMEBUFFER_BINDING, &draw->target);
	draw->rows = malloc((size_t)width * (size_t)height * 4);
	if (!draw->rows || !parts_open(draw, fault)) {
		if (!fault[0])
			snprintf(fault, 200, "no memory to draw with");
		draw_close(draw);
		return NULL;
	}
	draw->sheet = sheet_open(width, height, fault);
	draw->chrome = draw->sheet ? chrome_open(width, height, fault) : NULL;
	draw->take_home = draw->chrome ? take_home_sheet_open(width, height, fault) : NULL;
	if (!draw->take_home) {
		draw_close(draw);
		return NULL;
	}
	return draw;
}

/* GL objects go with their context; the display closes that next. */
void draw_close(struct draw *draw)
{
	if (!draw)
		return;
	free(draw->rows);
	order_release(&draw->order);
	room_release(draw);
	body_release(draw);
	cloth_release(draw);
	ribbons_release(draw);
	fringe_release(draw);
	sprites_release(draw);
	service_sheet_close(draw->service);
	notice_sheet_close(draw->notice);
	take_home_sheet_close(draw->take_home);
	portrait_release(draw);
	if (draw->sheet)
		sheet_close(draw->sheet);
	if (draw->chrome)
		chrome_close(draw->chrome);
	free(draw);
}

void draw_body_changed(struct draw *draw)
{
	draw->body.stale = true;
	draw->marks.stale = true;
}

void draw_bones(struct draw *draw, bool shown)
{
	draw->bones = shown;
}

/* The pane counts from the top of the screen, GL from the bottom. */
void pane_enter(const struct draw *draw, const struct rect *pane)
{
	int bottom = draw->height - pane->y - pane->h;
	glViewport(pane->x, bottom, pane->w, pane->h);
	glScissor(pane->x, bottom, pane->w, pane->h);
	glEnable(GL_DEPTH_TEST);
	glDepthFunc(GL_LEQUAL);
	glDepthMask(GL_TRUE);
	glDisable(GL_SCISSOR_TEST); /* all of it: a cut-out would be drawn as a quad */
	glClear(GL_DEPTH_BUFFER_BIT);
	glEnable(GL_SCISSOR_TEST);
}

/* Everything opaque that was made on the processor, before the first triangle. */
void background_draw(struct draw *draw, const struct ui *ui, const struct session *session)
{
	draw->sheet_layer = sheet_update(draw->sheet, ui, session);
	draw->chrome_layer = chrome_update(draw->chrome, ui, session);
	layer_take(draw, &draw->sheet_plate, draw->sheet_layer);
	layer_take(draw, &draw->chrome_plate, draw->chrome_layer);
	glDisable(GL_SCISSOR_TEST);
	glDisable(GL_DEPTH_TEST);
	glViewport(0, 0, draw->width, draw->height);
	room_copy(draw, &ui->view.pane);
	layer_draw(draw, &draw->sheet_plate, draw->sheet_layer, true);
	layer_draw(draw, &draw->chrome_plate, draw->chrome_layer, true);
}

/* Where processors draw, they fill body and cloth while this one works out the outlines. A GPU of
 * tiles would only have to fetch its tiles again. */
static void surfaces_finish(const struct draw *draw)
{
	if (draw->software)
		glFlush();
}

static void figure_draw(struct draw *draw, const struct ui *ui, const struct session *session)
{
	pane_enter(draw, &ui->view.pane);
	room_draw(draw);
	body_draw(draw);
	cloth_draw(draw);
	surfaces_finish(draw);
	fringe_body_draw(draw, &session->body);
	fringe_cloth_draw(draw, session);
}

void lines_draw(struct draw *draw, const struct ui *ui, const struct session *session)
{
	ribbons_begin(draw);
	sprites_begin(draw);
	trim_add(draw, ui, session);
	ribbons_draw(draw, 0.0035f);
	ribbons_begin(draw);
	marks_add(draw, ui, session);
	ribbons_draw(draw, 0.010f);
	sprites_draw(draw, false);
	ribbons_begin(draw);
	sprites_begin(draw);
	glDisable(GL_DEPTH_TEST);
	hand_add(draw, ui, session);
	if (draw->bones)
		bones_add(draw, &session->body);
	ribbons_draw(draw, 0.0f);
	sprites_draw(draw, true);
}

void overlays_draw(struct draw *draw)
{
	glDisable(GL_DEPTH_TEST);
	glDisable(GL_SCISSOR_TEST);
	glViewport(0, 0, draw->width, draw->height);
	layer_draw(draw, &draw->sheet_plate, draw->sheet_layer, false);
	layer_draw(draw, &draw->chrome_plate, draw->chrome_layer, false);
}

void figure_follow(struct draw *draw, const struct view *view, const struct session *session)
{
	if ((draw->body.stale || draw->body.hash != session->body.hash) &&
	    session->body.vertex_count)
		body_upload(draw, &session->body);
	cloth_upload(draw, session);
	cover_follow(draw, session);
	trim_follow(draw, session);
	camera_make(&draw->camera, view, &session->body);
	shadow_draw(draw);
}

void draw_frame(struct draw *draw, const struct ui *ui, const struct session *session)
{
	glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
	figure_follow(draw, &ui->view, session);
	background_draw(draw, ui, session);
	figure_draw(draw, ui, session);
	lines_draw(draw, ui, session);
	overlays_draw(draw);
}

static void plate_drop(struct plate *plate)
{
	glDeleteFramebuffers(1, &plate->framebuffer);
	glDeleteTextures(1, &plate->texture);
	plate->texture = plate->framebuffer = 0;
}

bool draw_service(struct draw *draw, const struct service_page *page, char fault[200])
{
	if (!draw->service)
		draw->service = service_sheet_open(draw->width, draw->height, fault);
	if (!draw->service)
		return false;
	const struct layer *layer = service_sheet_update(draw->service, page);
	layer_take(draw, &draw->service_plate, layer);
	glDisable(GL_SCISSOR_TEST);
	glDisable(GL_DEPTH_TEST);
	glViewport(0, 0, draw->width, draw->height);
	layer_draw(draw, &draw->service_plate, layer, true);
	return true;
}

void draw_service_end(struct draw *draw)
{
	if (!draw->service)
		return;
	service_sheet_close(draw->service);
	plate_drop(&draw->service_plate);
	draw->service = NULL;
}

bool draw_notice(struct draw *draw, enum language language, int left_s, int whole_s,
		 char fault[200])
{
	if (!draw->notice)
		draw->notice = notice_sheet_open(draw->width, draw->height, fault);
	if (!draw->notice)
		return false;
	const struct layer *layer = notice_sheet_update(draw->notice, language, left_s, whole_s);
	layer_take(draw, &draw->notice_plate, layer);
	glDisable(GL_SCISSOR_TEST);
	glDisable(GL_DEPTH_TEST);
	glViewport(0, 0, draw->width, draw->height);
	layer_draw(draw, &draw->notice_plate, layer, false);
	return true;
}

void draw_notice_end(struct draw *draw)
{
	if (!draw->notice)
		return;
	notice_sheet_close(draw->notice);
	plate_drop(&draw->notice_plate);
	draw->notice = NULL;
}

void draw_take_home(struct draw *draw, const struct ui *ui, const struct take_home_page *page)
{
	const struct layer *layer = take_home_sheet_update(draw->take_home, ui, page);
	layer_take(draw, &draw->take_home_plate, layer);
	glDisable(GL_SCISSOR_TEST);
	glDisable(GL_DEPTH_TEST);
	glViewport(0, 0, draw->width, draw->height);
	layer_draw(draw, &draw->take_home_plate, layer, true);
}

void draw_take_home_end(struct draw *draw)
{
	if (!draw->take_home_plate.texture)
		return;
	plate_drop(&draw->take_home_plate);
	take_home_sheet_again(draw->take_home);
}
