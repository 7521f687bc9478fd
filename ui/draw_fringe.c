/* Soft outlines without multisampling. Along every edge where a surface turns away from the eye, or
 * ends, lies a strip one pixel wide in the surface's own light, whose coverage falls from one to
 * nothing. It costs what the outline costs; four samples a pixel would cost a software renderer
 * four times the picture.
 */
#include "draw_private.h"

#include <stddef.h>
#include <stdlib.h>

static const float fringe_px = 1.15f;

bool fringe_open(struct draw *draw, char fault[200])
{
	struct fringe *fringe = &draw->fringe;
	fringe->vertex = calloc(FRINGE_VERTICES_MAX, sizeof *fringe->vertex);
	fringe->facing = calloc(BODY_TRIANGLES_MAX, 1);
	glGenBuffers(1, &fringe->vertices);
	return fringe->vertex && fringe->facing &&
	       surface_open(&fringe->body, false, true, fault) &&
	       surface_open(&fringe->cloth, true, true, fault);
}

void fringe_release(struct draw *draw)
{
	free(draw->fringe.vertex);
	free(draw->fringe.facing);
}

/* The screen direction of a vector of the world, in pixels, y up; zero when it points at the eye.
 */
static struct v2 screen_direction(const struct camera *camera, struct v3 v)
{
	const float *m = camera->world_to_axes;
	struct v2 d = {m[0] * v.x + m[3] * v.y + m[6] * v.z, m[1] * v.x + m[4] * v.y + m[7] * v.z};
	return v2_normalize(d);
}

static struct fringe_vertex *segment_take(struct fringe *fringe)
{
	if (fringe->count + 4 > FRINGE_VERTICES_MAX)
		return NULL;
	fringe->count += 4;
	return fringe->vertex + fringe->count - 4;
}

/* Both corners at one end of a segment, from the surface's vertex in corner[0]. */
static void end_finish(struct fringe_vertex corner[2], struct v2 outward)
{
	corner[0].shift_px[0] = corner[0].shift_px[1] = 0.0f;
	corner[0].cover = 1.0f;
	corner[1] = corner[0];
	corner[1].shift_px[0] = outward.x * fringe_px;
	corner[1].shift_px[1] = outward.y * fringe_px;
	corner[1].cover = 0.0f;
}

static void fringe_show(struct draw *draw, const struct surface_program *program, bool cloth,
			float bias_m)
{
	struct fringe *fringe = &draw->fringe;
	int stride = (int)sizeof *fringe->vertex;
	if (!fringe->count)
		return;
	glBindBuffer(GL_ARRAY_BUFFER, fringe->vertices);
	glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)fringe->count * stride, fringe->vertex,
		     GL_STREAM_DRAW);
	glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, draw->quads);
	gl_attributes(1u << AT_POSITION | 1u << AT_NORMAL | 1u << AT_MATERIAL | 1u << AT_FRINGE |
		      (cloth ? 1u << AT_PLACE | 1u << AT_COLOUR | 1u << AT_COLOUR_2 : 0));
	gl_floats(AT_POSITION, 3, stride, offsetof(struct fringe_vertex, position_m));
	gl_floats(AT_NORMAL, 3, stride, offsetof(struct fringe_vertex, normal));
	gl_floats(AT_FRINGE, 4, stride, offsetof(struct fringe_vertex, shift_px));
	gl_floats(AT_PLACE, 2, stride, offsetof(struct fringe_vertex, place));
	gl_bytes(AT_MATERIAL, stride, offsetof(struct fringe_vertex, material));
	gl_bytes(AT_COLOUR, stride, offsetof(struct fringe_vertex, colour));
	gl_bytes(AT_COLOUR_2, stride, offsetof(struct fringe_vertex, colour_2));
	surface_use(program, draw, bias_m);
	glBindTexture(GL_TEXTURE_2D, draw->cloth.weave);
	glEnable(GL_BLEND);
	glDepthMask(GL_FALSE);
	glDrawElements(GL_TRIANGLES, fringe->count / 4 * 6, GL_UNSIGNED_SHORT, NULL);
	glDepthMask(GL_TRUE);
	glDisable(GL_BLEND);
}

static void body_end(struct draw *draw, const struct body *body, struct fringe_vertex corner[2],
		     int vertex)
{
	const struct body_cover *cover = &draw->body.cover;
	corner[0] = (struct fringe_vertex){
		.position_m = body->position_m[vertex],
		.normal = body->normal[vertex],
		.side = 1.0f,
		.material = {cover->material[4 * cover->drawn_as[vertex]]},
	};
	end_finish(corner, screen_direction(&draw->camera, body->normal[vertex]));
}

void fringe_body_draw(struct draw *draw, const struct body *body)
{
	struct fringe *fringe = &draw->fringe;
	fringe->count = 0;
	for (int t = 0; t < body->triangle_count; t++) {
		struct v3 at_m = body->position_m[body->triangle[t].v[0]];
		fringe->facing[t] = v3_dot(body->face_normal[t], v3_sub(draw->camera.eye_m, at_m)) >
				    0.0f;
	}
	for (int t = 0; t < body->triangle_count; t++) {
		if (!fringe->facing[t])
			continue;
		for (int k = 0; k < 3; k++) {
			int beyond = body->neighbour[3 * t + k];
			if (beyond >= 0 && fringe->facing[beyond])
				continue;
			struct fringe_vertex *corner = segment_take(fringe);
			if (!corner)
				break;
			body_end(draw, body, corner, body->triangle[t].v[k]);
			body_end(draw, body, corner + 2, body->triangle[t].v[(k + 1) % 3]);
		}
	}
	fringe_show(draw, &fringe->body, false, body_bias_m);
}

static void cloth_end(struct draw *draw, struct fringe_vertex corner[2], int vertex, float side,
		      struct v2 outward)
{
	const struct cloth_vertex *moving = &draw->cloth.vertex[vertex];
	const struct cloth_fixed *fixed = &draw->cloth.rest[vertex];
	corner[0] = (struct fringe_vertex){
		.position_m = moving->position_m, .normal = moving->normal, .side = side};
	memcpy(corner[0].place, fixed->place, sizeof fixed->place);
	memcpy(corner[0].material, moving->material, 4);
	memcpy(corner[0].colour, fixed->outside, 4);
	memcpy(corner[0].colour_2, fixed->inside, 4);
	end_finish(corner, outward);
}

/* Away from the cloth on the screen: along the normal where it folds over, along the cloth itself
 * where it ends; in both cases away from the triangle's third corner. */
static struct v2 cloth_outward(const struct draw *draw, int vertex, struct v2 away, bool ends)
{
	struct v2 outward = screen_direction(&draw->camera, draw->cloth.vertex[vertex].normal);
	if (ends)
		return away;
	return v2_dot(outward, away) < 0.0f ? v2_scale(outward, -1.0f) : outward;
}

static void cloth_edge(struct draw *draw, const struct edge_use *edge)
{
	const struct cloth_vertex *vertex = draw->cloth.vertex;
	bool ends = edge->count == 1;
	struct fringe_vertex *corner = segment_take(&draw->fringe);
	if (!corner)
		return;
	struct v3 a_m = vertex[edge->from].position_m, b_m = vertex[edge->to].position_m;
	struct v3 along = v3_normalize(v3_sub(b_m, a_m));
	struct v3 inward = v3_sub(vertex[edge->inner].position_m, a_m);
	inward = v3_mad(inward, along, -v3_dot(inward, along));
	struct v2 away = screen_direction(&draw->camera, v3_scale(inward, -1.0f));
	/* Where cloth folds over, its outside is what one sees when its normal points off the
	 * cloth. */
	struct v2 normal = screen_direction(&draw->camera, vertex[edge->from].normal);
	bool front = ends ? draw->fringe.facing[edge->triangle[0]] : v2_dot(normal, away) > 0.0f;
	float side = front ? 1.0f : -1.0f;
	cloth_end(draw, corner, edge->from, side, cloth_outward(draw, edge->from, away, ends));
	cloth_end(draw, corner + 2, edge->to, side, cloth_outward(draw, edge->to, away, ends));
}

void fringe_cloth_draw(struct draw *draw, const struct session *session)
{
	struct fringe *fringe = &draw->fringe;
	const struct garment *garment = &session->garment;
	const struct cloth_vertex *vertex = draw->cloth.vertex;
	const uint8_t *placed = session->cloth.placed;
	fringe->count = 0;
	if (!draw->cloth.index_count)
		return;
	for (int t = 0; t < garment->triangle_count; t++) {
		const int *v = garment->triangle[t].v;
		struct v3 a_m = vertex[v[0]].position_m;
		struct v3 normal = v3_cross(v3_sub(vertex[v[1]].position_m, a_m),
					    v3_sub(vertex[v[2]].position_m, a_m));
		fringe->facing[t] = v3_dot(normal, v3_sub(draw->camera.eye_m, a_m)) > 0.0f;
	}
	for (int e = 0; e < draw->cloth.edge_count; e++) {
		const struct edge_use *edge = &draw->cloth.edge_use[e];
		bool outline = edge->count == 1 || fringe->facing[edge->triangle[0]] !=
							   fringe->facing[edge->triangle[1]];
		if (outline && placed[edge->from] && placed[edge->to] && placed[edge->inner])
			cloth_edge(draw, edge);
	}
	fringe_show(draw, &fringe->cloth, true, 0.0f);
}
