/* Two drapes to look on: the bundled T-shirt as it is wrapped and settles, and a poncho of 1.25 m
 * that falls on the shoulders. `look` is called at the end of every frame. */
#ifndef DRAPES_H
#define DRAPES_H

#include "scene.h"

typedef void drape_look(void *context, const struct cloth *cloth);

enum { DRAPE_FRAMES_MAX = 3000, PONCHO_NECK_POINTS = 20, PONCHO_SWEEPS_A_FRAME = 10 };

static inline void drape_shirt(struct scene *scene, drape_look *look, void *context)
{
	struct session *session = &scene->session;
	MUST(scene_play(scene, "tests/journals/tshirt.kitsuke") == 0);
	MUST(scene_edit(scene, EDIT_WRAP));
	for (int f = 0; f < DRAPE_FRAMES_MAX && session_busy(session); f++) {
		session_advance(session);
		if (session->job != JOB_MESH)
			look(context, &session->cloth);
	}
}

/* Half a square with half the neck's hole, seen from outside; its upper edges are sewn. */
static inline void poncho_half(struct piece *piece)
{
	static const struct v2 corner[] = {{-625.0f, -625.0f}, {625.0f, -625.0f}, {625.0f, 0.0f},
					   {120.0f, 0.0f},     {-120.0f, 0.0f},   {-625.0f, 0.0f}};
	*piece = (struct piece){.used = true};
	for (int c = 0; c < COUNT_OF(corner); c++) {
		piece->corner[piece->point_count] = true;
		piece->point_mm[piece->point_count++] = corner[c];
		for (int i = 1; c == 3 && i < PONCHO_NECK_POINTS; i++) {
			float a = PI_F * (float)i / (float)PONCHO_NECK_POINTS;
			piece->point_mm[piece->point_count++] = (struct v2){120.0f * angle_cos(a),
									    -120.0f * angle_sin(a)};
		}
	}
}

static inline void drape_poncho(struct scene *scene, int vertices, int frames, drape_look *look,
				void *context)
{
	struct session *session = &scene->session;
	struct pattern *pattern = &session->document.pattern;
	struct garment *garment = &session->garment;
	struct cloth *cloth = &session->cloth;
	bool done = false;
	memset(pattern, 0, sizeof *pattern);
	poncho_half(&pattern->piece[0]);
	poncho_half(&pattern->piece[1]);
	pattern->seam[0] = (struct seam){.used = true, .a = {0, 2}, .b = {1, 4}};
	pattern->seam[1] = (struct seam){.used = true, .a = {0, 4}, .b = {1, 2}};
	MUST(!garment_start(session->mesher, garment, pattern, vertices));
	while (!done)
		garment_advance(session->mesher, 1 << 20, &done);
	cloth_reset(cloth, garment, &session->body);
	for (int v = 0; v < garment->vertex_count; v++) {
		struct v2 p = garment->rest_m[v];
		float side = garment->piece[v] == 0 ? 1.0f : -1.0f;
		cloth->position_m[v] = (struct v3){side * p.x, 1.5f, -side * p.y};
		cloth->previous_m[v] = cloth->position_m[v];
		cloth->placed[v] = 1;
	}
	cloth_weld(cloth);
	cloth->worn = true;
	for (int f = 0; f < frames; f++) {
		for (int sweep = 0; sweep < PONCHO_SWEEPS_A_FRAME; sweep++)
			cloth_sweep(cloth);
		cloth_finish(cloth);
		look(context, cloth);
	}
}

#endif
