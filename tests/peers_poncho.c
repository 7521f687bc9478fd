/* A square poncho with a neck hole, in two pieces sewn at the middle, laid flat over the shoulders;
 * kitsuke's own frames on it. */
#include "peers_poncho.h"
#include "session_private.h"

#include <stdlib.h>

enum { HALF_MM = 625, NECK_MM = 120, ARC_POINTS = 24 };

static const float height_m = 1.48f; /* above the shoulders, below the head's widest */

static void put(struct piece *piece, float x_mm, float y_mm, bool corner)
{
	piece->corner[piece->point_count] = corner;
	piece->point_mm[piece->point_count++] = (struct v2){x_mm, y_mm};
}

/* Side 1 is the half at x > 0, side -1 the other; both counter-clockwise from a corner of the
 * middle, so that edge 3 is the first part of the middle seam and edge 5 the second. */
static void draw_half(struct piece *piece, float side)
{
	*piece = (struct piece){.used = true, .name = "half"};
	put(piece, 0.0f, -side * HALF_MM, true);
	put(piece, side * HALF_MM, -side * HALF_MM, true);
	put(piece, side * HALF_MM, side * HALF_MM, true);
	put(piece, 0.0f, side * HALF_MM, true);
	for (int i = 0; i <= ARC_POINTS; i++) {
		float angle = PI_F * (0.5f - (float)i / ARC_POINTS);
		put(piece, side * NECK_MM * angle_cos(angle), side * NECK_MM * angle_sin(angle),
		    i == 0 || i == ARC_POINTS);
	}
}

static void sew(struct seam *seam, int a_edge, int b_edge)
{
	*seam = (struct seam){.used = true, .a = {0, a_edge}, .b = {1, b_edge}};
}

void poncho_lay(struct session *session, int vertices)
{
	struct pattern *pattern = &session->document.pattern;
	struct garment *garment = &session->garment;
	struct cloth *cloth = &session->cloth;
	draw_half(&pattern->piece[0], 1.0f);
	draw_half(&pattern->piece[1], -1.0f);
	sew(&pattern->seam[0], 3, 5);
	sew(&pattern->seam[1], 5, 3);
	MUST(!garment_start(session->mesher, garment, pattern, vertices));
	for (bool done = false; !done;)
		garment_advance(session->mesher, 1 << 20, &done);
	cloth_reset(cloth, garment, &session->body);
	for (int v = 0; v < garment->vertex_count; v++) {
		struct v2 p = garment->rest_m[v];
		cloth->position_m[v] = cloth->previous_m[v] = (struct v3){p.x, height_m, -p.y};
		cloth->placed[v] = 1;
	}
	cloth_weld(cloth);
	cloth->worn = true;
	session_wake(session);
}

void poncho_take(const struct session *session, struct peers_cloth *poncho)
{
	const struct cloth *cloth = &session->cloth;
	int vertices = session->garment.vertex_count, triangles = session->garment.triangle_count;
	int *number = calloc((size_t)vertices, sizeof *number);
	*poncho = (struct peers_cloth){.triangle_count = triangles};
	poncho->position_m = calloc((size_t)vertices, sizeof *poncho->position_m);
	poncho->triangle = calloc((size_t)triangles, sizeof *poncho->triangle);
	MUST(number && poncho->position_m && poncho->triangle);
	for (int v = 0; v < vertices; v++) {
		int particle = cloth->particle[v];
		if (particle != v)
			continue;
		number[v] = poncho->vertex_count;
		poncho->position_m[poncho->vertex_count++] = cloth->position_m[v];
	}
	for (int t = 0; t < triangles; t++)
		for (int k = 0; k < 3; k++)
			poncho->triangle[t].v[k] = number[cloth->triangle[t].v[k]];
	free(number);
}

void poncho_free(struct peers_cloth *poncho)
{
	free(poncho->position_m);
	free(poncho->triangle);
}

/* The linker sends cloth_sweep's call of cloth_self here (Makefile). */
static double self_ms;
long __real_cloth_self(struct cloth *cloth);
long __wrap_cloth_self(struct cloth *cloth);

long __wrap_cloth_self(struct cloth *cloth)
{
	double start = peers_ms();
	long units = __real_cloth_self(cloth);
	self_ms += peers_ms() - start;
	return units;
}

/* Awake in every frame: resting cloth costs nothing, and that is not what is asked. */
void poncho_fall(struct session *session, struct drape *drape)
{
	for (int frame = 0; frame < DRAPE_FRAMES; frame++) {
		session_wake(session);
		self_ms = 0.0;
		double start = peers_ms();
		session_advance(session);
		drape->self_ms[frame] = self_ms;
		drape->ms[frame] = peers_ms() - start - self_ms;
	}
}
