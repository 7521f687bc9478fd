/* The figure: uploaded once, with the light that its own limbs take from it. */
#include "draw_private.h"

#include <stddef.h>
#include <stdlib.h>

static const float caster_cell_m = 0.022f;

bool body_open(struct draw *draw, char fault[200])
{
	struct draw_body *body = &draw->body;
	body->vertex = calloc(BODY_VERTICES_MAX, sizeof *body->vertex);
	body->index = calloc((size_t)BODY_TRIANGLES_MAX * 3, sizeof *body->index);
	body->open_sky = calloc(BODY_VERTICES_MAX, sizeof *body->open_sky);
	glGenBuffers(1, &body->vertices);
	glGenBuffers(1, &body->indices);
	body->caster_normal = calloc(BODY_VERTICES_MAX, sizeof *body->caster_normal);
	body->caster_open = calloc(BODY_VERTICES_MAX, sizeof *body->caster_open);
	body->open_next = calloc(BODY_VERTICES_MAX, sizeof *body->open_next);
	body->caster_m = calloc(BODY_VERTICES_MAX, sizeof *body->caster_m);
	glGenBuffers(1, &body->caster_vertices);
	glGenBuffers(1, &body->caster_indices);
	body->stale = true;
	return body->vertex && body->caster_m && body->caster_normal && body->caster_open &&
	       body->open_next && body->index && body->open_sky && cover_open(&body->cover) &&
	       surface_open(&body->program, false, false, fault);
}

void body_release(struct draw *draw)
{
	free(draw->body.vertex);
	free(draw->body.index);
	free(draw->body.caster_m);
	free(draw->body.caster_normal);
	free(draw->body.caster_open);
	free(draw->body.open_next);
	free(draw->body.open_sky);
	cover_release(&draw->body.cover);
}

/* How open a place is, from the distance field of the body alone (after Evans, "Fast Approximations
 * for Global Illumination on Dynamic Scenes", 2006): away from a free surface the distance grows as
 * fast as one walks; near another limb it does not. Smooth, with a handful of queries. */
static float openness(const struct body *body, struct v3 position_m, struct v3 direction)
{
	static const float step_m[3] = {0.025f, 0.07f, 0.16f};
	static const float weight[3] = {0.30f, 0.36f, 0.34f};
	float closed = 0.0f;
	for (int i = 0; i < 3; i++) {
		struct body_hit hit;
		body_nearest(body, v3_mad(position_m, direction, step_m[i]), 0, &hit);
		float missing = 1.0f - hit.distance_m / step_m[i];
		closed += weight[i] * float_clamp(missing, 0.0f, 1.0f);
	}
	return 1.0f - closed;
}

/* A coarse body is asked, and its answer spread: the price depends on the size of the figure, not
 * on the fineness of its mesh. Also fills caster_m and order.rank for the caster. */
static void openness_bake(struct draw *draw, const struct body *body)
{
	struct draw_body *own = &draw->body;
	const int *rank = draw->order.rank;
	int count = mesh_coarsen(&draw->order, body->position_m, body->vertex_count, caster_cell_m,
				 own->caster_m);
	memset(own->caster_normal, 0, (size_t)count * sizeof *own->caster_normal);
	for (int v = 0; v < body->vertex_count; v++)
		own->caster_normal[rank[v]] = v3_add(own->caster_normal[rank[v]], body->normal[v]);
	for (int c = 0; c < count; c++) {
		struct v3 normal = v3_normalize(own->caster_normal[c]);
		struct v3 upward = v3_normalize((struct v3){normal.x, normal.y + 0.55f, normal.z});
		float open = 0.6f * openness(body, own->caster_m[c], normal) +
			     0.4f * openness(body, own->caster_m[c], upward);
		/* A free convex surface answers about 0.95; a flat one exactly 1. */
		own->caster_open[c] = float_clamp((open - 0.25f) * 1.45f, 0.12f, 1.0f);
	}
	for (int v = 0; v < body->vertex_count; v++)
		own->open_sky[v] = own->caster_open[rank[v]];
	own->caster_vertex_count = count;
}

/* Each vertex becomes the mean of itself and its triangles' corners: the cells' steps fade. */
static void openness_smooth(struct draw_body *own, const struct body *body)
{
	for (int pass = 0; pass < 3; pass++) {
		for (int v = 0; v < body->vertex_count; v++) {
			float sum = own->open_sky[v];
			int count = 1;
			for (int s = body->star_first[v]; s < body->star_first[v + 1]; s++)
				for (int k = 0; k < 3; k++) {
					sum += own->open_sky[body->triangle[body->star[s]].v[k]];
					count++;
				}
			own->open_next[v] = sum / (float)count;
		}
		memcpy(own->open_sky, own->open_next,
		       (size_t)body->vertex_count * sizeof *own->open_sky);
	}
}

static void buffer_fill(GLenum target, GLuint buffer, size_t size, const void *data)
{
	glBindBuffer(target, buffer);
	glBufferData(target, (GLsizeiptr)size, data, GL_STATIC_DRAW);
}

static void caster_upload(struct draw *draw, const struct body *body)
{
	struct draw_body *own = &draw->body;
	own->caster_count = 0;
	for (int t = 0; t < body->triangle_count; t++) {
		const int *v = body->triangle[t].v, *rank = draw->order.rank;
		int a = rank[v[0]], b = rank[v[1]], c = rank[v[2]];
		if (a == b || b == c || c == a)
			continue;
		own->index[own->caster_count++] = (uint16_t)a;
		own->index[own->caster_count++] = (uint16_t)b;
		own->index[own->caster_count++] = (uint16_t)c;
	}
	buffer_fill(GL_ARRAY_BUFFER, own->caster_vertices,
		    (size_t)own->caster_vertex_count * sizeof *own->caster_m, own->caster_m);
	buffer_fill(GL_ELEMENT_ARRAY_BUFFER, own->caster_indices,
		    (size_t)own->caster_count * sizeof *own->index, own->index);
}

void body_upload(struct draw *draw, const struct body *body)
{
	struct draw_body *own = &draw->body;
	MUST(body->vertex_count <= BODY_VERTICES_MAX);
	openness_bake(draw, body);
	openness_smooth(own, body);
	caster_upload(draw, body);
	mesh_order(&draw->order, body->position_m, body->vertex_count, body->triangle,
		   body->triangle_count);
	for (int i = 0; i < body->vertex_count; i++) {
		struct body_vertex *vertex = &own->vertex[draw->order.rank[i]];
		vertex->position_m = body->position_m[i];
		vertex->normal = body->normal[i];
	}
	own->index_count = 3 * body->triangle_count;
	for (int i = 0; i < body->triangle_count; i++)
		for (int k = 0; k < 3; k++) {
			int v = body->triangle[draw->order.triangle[i]].v[k];
			own->index[3 * i + k] = (uint16_t)draw->order.rank[v];
		}
	buffer_fill(GL_ARRAY_BUFFER, own->vertices,
		    (size_t)body->vertex_count * sizeof *own->vertex, own->vertex);
	buffer_fill(GL_ELEMENT_ARRAY_BUFFER, own->indices,
		    (size_t)own->index_count * sizeof *own->index, own->index);
	cover_changed(draw, body);
	room_floor_changed(draw, body);
	own->hash = body->hash;
	own->stale = false;
}

static void body_bind(const struct draw *draw)
{
	int stride = (int)sizeof(struct body_vertex);
	glBindBuffer(GL_ARRAY_BUFFER, draw->body.vertices);
	glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, draw->body.indices);
	gl_attributes(1u << AT_POSITION | 1u << AT_NORMAL | 1u << AT_MATERIAL);
	gl_floats(AT_POSITION, 3, stride, offsetof(struct body_vertex, position_m));
	gl_floats(AT_NORMAL, 3, stride, offsetof(struct body_vertex, normal));
	glBindBuffer(GL_ARRAY_BUFFER, draw->body.cover.materials);
	gl_bytes(AT_MATERIAL, 4, 0);
}

void body_cast(const struct draw *draw)
{
	glBindBuffer(GL_ARRAY_BUFFER, draw->body.caster_vertices);
	glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, draw->body.caster_indices);
	gl_attributes(1u << AT_POSITION);
	gl_floats(AT_POSITION, 3, (int)sizeof(struct v3), 0);
	glDrawElements(GL_TRIANGLES, draw->body.caster_count, GL_UNSIGNED_SHORT, NULL);
}

void body_draw(struct draw *draw)
{
	if (!draw->body.index_count)
		return;
	body_bind(draw);
	surface_use(&draw->body.program, draw, body_bias_m);
	glEnable(GL_CULL_FACE);
	glDrawElements(GL_TRIANGLES, draw->body.index_count, GL_UNSIGNED_SHORT, NULL);
	glDisable(GL_CULL_FACE);
}
