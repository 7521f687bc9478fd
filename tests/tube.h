/* A tube of the mesher's triangles, sewn to itself round a cylinder about the Y axis: cloth on
 * which every distance is known. */
#ifndef TUBE_H
#define TUBE_H

#include "scene.h"
#include "shapes.h"

static const float tube_body_m = 0.15f, tube_off_m = 0.004f;

/* From -1 to 1, with a point for each lid. */
static inline void tube_make_cylinder(struct shape *shape, int columns, int rings)
{
	shape->vertex_count = shape->triangle_count = 0;
	for (int r = 0; r < rings; r++)
		for (int c = 0; c < columns; c++) {
			float angle = 2.0f * PI_F * (float)c / (float)columns;
			shape_vertex(shape, tube_body_m * angle_sin(angle),
				     2.0f * (float)r / (float)(rings - 1) - 1.0f,
				     tube_body_m * angle_cos(angle));
		}
	int south = shape_vertex(shape, 0.0f, -1.0f, 0.0f);
	int north = shape_vertex(shape, 0.0f, 1.0f, 0.0f), top = (rings - 1) * columns;
	for (int c = 0; c < columns; c++) {
		int d = (c + 1) % columns;
		shape_triangle(shape, south, d, c);
		shape_triangle(shape, north, top + c, top + d);
		for (int low = 0; low < top; low += columns) {
			shape_triangle(shape, low + c, low + d, low + columns + d);
			shape_triangle(shape, low + c, low + columns + d, low + columns + c);
		}
	}
}

/* All cloth is placed at worn_m, and worn. */
static inline void tube_wear(struct session *session, const struct v3 *worn_m, bool welded)
{
	static uint8_t placed[GARMENT_VERTICES_MAX];
	memset(placed, 1, sizeof placed);
	cloth_restore(&session->cloth, &session->garment, &session->body, worn_m, placed, welded,
		      true);
}

/* The cylinder becomes the session's body, a tube of about so many vertices its garment. */
static inline void tube_lay(struct scene *scene, int vertices)
{
	static const char *line[2] = {"piece tube 0 0 0 0 0 -480 0 1 -480 -400 1 480 -400 1 480 0 "
				      "1",
				      "sew 0 0 0 2 0"};
	static struct shape shape;
	static struct v3 worn_m[GARMENT_VERTICES_MAX];
	struct session *session = &scene->session;
	char fault[160];
	bool done = false;
	tube_make_cylinder(&shape, 240, 60);
	MUST(!body_build(&session->body, shape.position_m, shape.vertex_count, shape.triangle,
			 shape.triangle_count));
	for (int i = 0; i < 2; i++)
		MUST(journal_read(line[i], (int)strlen(line[i]), &scene->edit, fault) ==
			     JOURNAL_EDIT &&
		     session_apply(session, &scene->edit));
	MUST(!garment_start(session->mesher, &session->garment, &session->document.pattern,
			    vertices));
	while (!done)
		garment_advance(session->mesher, 100000, &done);
	for (int v = 0; v < session->garment.vertex_count; v++) {
		struct v2 rest = session->garment.rest_m[v];
		float turn = rest.x / 0.960f * 2.0f * PI_F, out_m = tube_body_m + tube_off_m;
		worn_m[v] = (struct v3){out_m * angle_sin(turn), rest.y, out_m * angle_cos(turn)};
	}
	tube_wear(session, worn_m, true);
}

/* Along the cylinder, by the formula. */
static inline float tube_distance(struct v3 a, struct v3 b)
{
	struct v3 flat_a = v3_normalize((struct v3){a.x, 0.0f, a.z});
	struct v3 flat_b = v3_normalize((struct v3){b.x, 0.0f, b.z});
	float round = tube_body_m * angle_acos(v3_dot(flat_a, flat_b)), up = b.y - a.y;
	return sqrtf(round * round + up * up);
}

#endif
