/* The worn garment: positions, normals and shade once a frame, everything flat once a garment. */
#include "draw_private.h"

#include <stddef.h>
#include <stdlib.h>

enum { WEAVE_SIZE = 256, WEAVE_YARNS = 64, GLOW_FRAMES = 24, GLOW_LEVEL = 100 };

static const float weave_width_m = 0.096f; /* 64 yarns of 1.5 mm */
static const float caster_cell_m = 0.026f;

/* Plain weave: over and under, yarns of uneven thickness and shade (slubs), mean brightness one
 * half, which the shader doubles. */
static void weave_make(GLuint *texture)
{
	uint8_t pixel[WEAVE_SIZE][WEAVE_SIZE];
	float yarn[2][WEAVE_YARNS], slub[2][WEAVE_YARNS][8];
	struct scatter scatter = {0x9e3779b9u};
	for (int d = 0; d < 2; d++)
		for (int i = 0; i < WEAVE_YARNS; i++) {
			yarn[d][i] = ((float)scatter_below(&scatter, 1000) / 1000.0f - 0.5f) *
				     0.09f;
			for (int k = 0; k < 8; k++)
				slub[d][i][k] = ((float)scatter_below(&scatter, 1000) / 1000.0f -
						 0.5f) *
						0.12f;
		}
	for (int y = 0; y < WEAVE_SIZE; y++)
		for (int x = 0; x < WEAVE_SIZE; x++) {
			int warp = x / 4, weft = y / 4;
			bool over = (warp + weft) & 1;
			int along = over ? y : x, yarn_at = over ? warp : weft, d = over;
			float across = (float)((over ? x : y) % 4) - 1.5f;
			float t = (float)(along % 32) / 32.0f;
			float thick = slub[d][yarn_at][along / 32] * (1.0f - t) +
				      slub[d][yarn_at][(along / 32 + 1) % 8] * t;
			float value = 0.5f * (1.02f + yarn[d][yarn_at] + thick -
					      0.035f * across * across + (over ? 0.02f : -0.02f));
			pixel[y][x] = (uint8_t)float_clamp(value * 255.0f, 0.0f, 255.0f);
		}
	*texture = gl_texture(GL_LINEAR_MIPMAP_NEAREST, GL_REPEAT);
	glTexImage2D(GL_TEXTURE_2D, 0, GL_LUMINANCE, WEAVE_SIZE, WEAVE_SIZE, 0, GL_LUMINANCE,
		     GL_UNSIGNED_BYTE, pixel);
	glGenerateMipmap(GL_TEXTURE_2D);
}

bool cloth_open(struct draw *draw, char fault[200])
{
	struct draw_cloth *cloth = &draw->cloth;
	size_t vertices = GARMENT_VERTICES_MAX, triangles = GARMENT_TRIANGLES_MAX;
	cloth->vertex = calloc(vertices, sizeof *cloth->vertex);
	cloth->rest = calloc(vertices, sizeof *cloth->rest);
	cloth->index = calloc(triangles * 3, sizeof *cloth->index);
	cloth->normal = calloc(vertices, sizeof *cloth->normal);
	cloth->crease = calloc(vertices, sizeof *cloth->crease);
	cloth->soft = calloc(vertices, sizeof *cloth->soft);
	cloth->born = calloc(vertices, sizeof *cloth->born);
	cloth->seen_rest_m = calloc(vertices, sizeof *cloth->seen_rest_m);
	cloth->seen_triangle = calloc(triangles, sizeof *cloth->seen_triangle);
	cloth->rim = calloc(GARMENT_EDGES_MAX, sizeof *cloth->rim);
	cloth->edge_table = calloc(EDGE_TABLE_SIZE, sizeof *cloth->edge_table);
	cloth->edge_use = calloc(GARMENT_EDGES_MAX * 2, sizeof *cloth->edge_use);
	cloth->stitched = calloc(vertices, 1);
	cloth->seam = calloc(vertices, 1);
	cloth->caster = calloc(vertices, sizeof *cloth->caster);
	glGenBuffers(1, &cloth->caster_indices);
	if (!cloth->soft || !cloth->seam || !cloth->caster || !cloth->stitched || !cloth->vertex ||
	    !cloth->rest || !cloth->index || !cloth->normal || !cloth->crease || !cloth->born ||
	    !cloth->seen_rest_m || !cloth->seen_triangle || !cloth->rim || !cloth->edge_table ||
	    !cloth->edge_use)
		return false;
	glGenBuffers(1, &cloth->moving);
	glGenBuffers(1, &cloth->fixed);
	glGenBuffers(1, &cloth->indices);
	weave_make(&cloth->weave);
	return surface_open(&cloth->program, true, false, fault);
}

void cloth_release(struct draw *draw)
{
	struct draw_cloth *cloth = &draw->cloth;
	free(cloth->vertex);
	free(cloth->rest);
	free(cloth->index);
	free(cloth->normal);
	free(cloth->crease);
	free(cloth->soft);
	free(cloth->born);
	free(cloth->seen_rest_m);
	free(cloth->seen_triangle);
	free(cloth->rim);
	free(cloth->edge_table);
	free(cloth->edge_use);
	free(cloth->stitched);
	free(cloth->seam);
	free(cloth->caster);
}

static bool garment_changed(const struct draw_cloth *cloth, const struct session *session)
{
	const struct garment *garment = &session->garment;
	size_t vertices = (size_t)garment->vertex_count,
	       triangles = (size_t)garment->triangle_count;
	if (cloth->vertex_count != garment->vertex_count ||
	    cloth->triangle_count != garment->triangle_count ||
	    memcmp(cloth->seen_rest_m, garment->rest_m, vertices * sizeof *garment->rest_m) ||
	    memcmp(cloth->seen_triangle, garment->triangle, triangles * sizeof *garment->triangle))
		return true;
	for (int p = 0; p < PIECES_MAX; p++)
		if (cloth->swatch[p] != session->document.pattern.piece[p].swatch)
			return true;
	return false;
}

static void colour_bytes(uint8_t out[4], uint32_t colour)
{
	out[0] = (uint8_t)(colour >> 16);
	out[1] = (uint8_t)(colour >> 8);
	out[2] = (uint8_t)colour;
	out[3] = 255;
}

/* On the flat pieces, the first vertex of each cell stands for the others. Pieces are kept apart by
 * laying them on levels of their own. */
static void caster_choose(struct draw *draw, const struct garment *garment)
{
	struct draw_cloth *cloth = &draw->cloth;
	struct mesh_order *order = &draw->order;
	for (int v = 0; v < garment->vertex_count; v++)
		cloth->normal[v] = (struct v3){garment->rest_m[v].x, garment->rest_m[v].y,
					       2.0f * caster_cell_m * (float)garment->piece[v]};
	mesh_coarsen(order, cloth->normal, garment->vertex_count, caster_cell_m, cloth->normal);
	int first = 0;
	for (int i = 0; i < garment->vertex_count; i++) {
		int v = order->triangle[i];
		if (i == 0 || order->rank[v] != order->rank[first])
			first = v;
		cloth->caster[v] = first;
	}
}

static void garment_take(struct draw *draw, const struct session *session)
{
	struct draw_cloth *cloth = &draw->cloth;
	const struct garment *garment = &session->garment;
	const struct piece *piece = session->document.pattern.piece;
	size_t vertices = (size_t)garment->vertex_count,
	       triangles = (size_t)garment->triangle_count;
	memcpy(cloth->seen_rest_m, garment->rest_m, vertices * sizeof *garment->rest_m);
	memcpy(cloth->seen_triangle, garment->triangle, triangles * sizeof *garment->triangle);
	cloth->vertex_count = garment->vertex_count;
	cloth->triangle_count = garment->triangle_count;
	for (int p = 0; p < PIECES_MAX; p++)
		cloth->swatch[p] = piece[p].swatch;
	for (int v = 0; v < garment->vertex_count; v++) {
		struct cloth_fixed *fixed = &cloth->rest[v];
		int swatch = int_clamp(piece[garment->piece[v]].swatch, 0, SWATCHES - 1);
		fixed->place[0] = garment->rest_m[v].x / weave_width_m;
		fixed->place[1] = garment->rest_m[v].y / weave_width_m;
		colour_bytes(fixed->outside, look_outside[swatch]);
		colour_bytes(fixed->inside, look_inside[swatch]);
	}
	glBindBuffer(GL_ARRAY_BUFFER, cloth->fixed);
	glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(vertices * sizeof *cloth->rest), cloth->rest,
		     GL_STATIC_DRAW);
	cloth->placed_count = -1;
	cloth->rims_known = false;
	caster_choose(draw, garment);
}

static void indices_fill(GLuint buffer, const uint16_t *index, int count)
{
	glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffer);
	glBufferData(GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)((size_t)count * sizeof *index), index,
		     GL_DYNAMIC_DRAW);
}

/* Triangles all of whose corners have been laid on the body. */
static void indices_take(struct draw_cloth *cloth, const struct session *session, int frame)
{
	const struct garment *garment = &session->garment;
	const uint8_t *placed = session->cloth.placed;
	int count = 0;
	for (int v = 0; v < garment->vertex_count; v++) {
		count += placed[v] != 0;
		if (!placed[v])
			cloth->born[v] = -1;
		else if (cloth->born[v] < 0 || cloth->born[v] > frame)
			cloth->born[v] = session->job == JOB_WRAP ? frame : frame - GLOW_FRAMES;
	}
	if (count == cloth->placed_count)
		return;
	cloth->placed_count = count;
	cloth->index_count = 0;
	for (int t = 0; t < garment->triangle_count; t++) {
		const int *v = garment->triangle[t].v;
		if (!placed[v[0]] || !placed[v[1]] || !placed[v[2]])
			continue;
		for (int k = 0; k < 3; k++)
			cloth->index[cloth->index_count++] = (uint16_t)v[k];
	}
	indices_fill(cloth->indices, cloth->index, cloth->index_count);
	cloth->caster_count = 0;
	for (int t = 0; t < garment->triangle_count; t++) {
		const int *v = garment->triangle[t].v;
		int a = cloth->caster[v[0]], b = cloth->caster[v[1]], c = cloth->caster[v[2]];
		if (!placed[a] || !placed[b] || !placed[c] || a == b || b == c || c == a)
			continue;
		cloth->index[cloth->caster_count++] = (uint16_t)a;
		cloth->index[cloth->caster_count++] = (uint16_t)b;
		cloth->index[cloth->caster_count++] = (uint16_t)c;
	}
	indices_fill(cloth->caster_indices, cloth->index, cloth->caster_count);
}

/* How deep a vertex lies in a valley: mean height of its neighbours above its tangent plane. Gives
 * folds their depth, which one key light alone does not. */
static void creases(struct draw_cloth *cloth, const struct session *session)
{
	const struct garment *garment = &session->garment;
	const int *particle = session->cloth.particle;
	const struct v3 *x = session->cloth.position_m;
	memset(cloth->crease, 0, (size_t)garment->vertex_count * sizeof *cloth->crease);
	for (int t = 0; t < garment->triangle_count; t++) {
		if (!laid(session->cloth.placed, &garment->triangle[t]))
			continue;
		for (int k = 0; k < 3; k++) {
			int a = particle[garment->triangle[t].v[k]];
			int b = particle[garment->triangle[t].v[(k + 1) % 3]];
			struct v3 edge = v3_sub(x[b], x[a]);
			cloth->crease[a] += v3_dot(edge, cloth->normal[a]);
			cloth->crease[b] -= v3_dot(edge, cloth->normal[b]);
		}
	}
}

/* A fold is wider than a triangle: each vertex takes half of its height from its neighbours, which
 * takes the speckle out of soft folds. */
static void creases_soften(struct draw_cloth *cloth, const struct session *session)
{
	const struct garment *garment = &session->garment;
	const int *particle = session->cloth.particle;
	memset(cloth->soft, 0, (size_t)garment->vertex_count * sizeof *cloth->soft);
	for (int t = 0; t < garment->triangle_count; t++) {
		if (!laid(session->cloth.placed, &garment->triangle[t]))
			continue;
		const int *v = garment->triangle[t].v;
		int a = particle[v[0]], b = particle[v[1]], c = particle[v[2]];
		float sum = cloth->crease[a] + cloth->crease[b] + cloth->crease[c];
		cloth->soft[a].x += sum;
		cloth->soft[b].x += sum;
		cloth->soft[c].x += sum;
		cloth->soft[a].y += 3.0f;
		cloth->soft[b].y += 3.0f;
		cloth->soft[c].y += 3.0f;
	}
}

static float body_openness(const struct draw *draw, const struct body *body,
			   const struct contact *contact)
{
	if (contact->triangle < 0 || contact->triangle >= body->triangle_count)
		return 1.0f;
	const int *v = body->triangle[contact->triangle].v;
	float open = (draw->body.open_sky[v[0]] + draw->body.open_sky[v[1]] +
		      draw->body.open_sky[v[2]]) /
		     3.0f;
	float far = float_clamp(contact->distance_m * 20.0f, 0.0f, 1.0f);
	return open + (1.0f - open) * far;
}

void cloth_upload(struct draw *draw, const struct session *session)
{
	struct draw_cloth *cloth = &draw->cloth;
	const struct garment *garment = &session->garment;
	if (session->job == JOB_MESH || !garment->vertex_count || !session->cloth.garment) {
		cloth->index_count = 0;
		cloth->placed_count = -1;
		return;
	}
	if (garment_changed(cloth, session)) {
		garment_take(draw, session);
		draw->marks.stale = true;
	}
	indices_take(cloth, session, session->frame);
	if (!cloth->index_count)
		return;
	cloth_normals(&session->cloth, cloth->normal);
	creases(cloth, session);
	creases_soften(cloth, session);
	float depth_scale = 0.32f / float_max(garment->edge_m, 0.004f);
	for (int v = 0; v < garment->vertex_count; v++) {
		struct cloth_vertex *vertex = &cloth->vertex[v];
		int p = session->cloth.particle[v];
		float fold = cloth->soft[p].x / float_max(cloth->soft[p].y, 1.0f);
		float valley = float_clamp(fold * depth_scale, -0.35f, 0.52f);
		float open = body_openness(draw, &session->body, &session->cloth.contact[p]);
		open = float_clamp(open * (0.92f - valley), 0.08f, 1.0f);
		int age = session->frame - cloth->born[v];
		int left = int_clamp(GLOW_FRAMES - age, 0, GLOW_FRAMES);
		int glow = GLOW_LEVEL * left * left / (GLOW_FRAMES * GLOW_FRAMES);
		vertex->position_m = session->cloth.position_m[p];
		vertex->normal = cloth->normal[v];
		vertex->material[0] = (uint8_t)(open * 255.0f);
		vertex->material[1] = (uint8_t)int_clamp(glow, 0, 255);
	}
	glBindBuffer(GL_ARRAY_BUFFER, cloth->moving);
	glBufferData(GL_ARRAY_BUFFER,
		     (GLsizeiptr)((size_t)garment->vertex_count * sizeof *cloth->vertex),
		     cloth->vertex, GL_STREAM_DRAW);
}

void cloth_cast(const struct draw *draw)
{
	glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, draw->cloth.caster_indices);
	glBindBuffer(GL_ARRAY_BUFFER, draw->cloth.moving);
	gl_attributes(1u << AT_POSITION);
	gl_floats(AT_POSITION, 3, (int)sizeof(struct cloth_vertex),
		  offsetof(struct cloth_vertex, position_m));
	glDrawElements(GL_TRIANGLES, draw->cloth.caster_count, GL_UNSIGNED_SHORT, NULL);
}

static void cloth_bind(const struct draw *draw)
{
	int stride = (int)sizeof(struct cloth_vertex), fixed = (int)sizeof(struct cloth_fixed);
	gl_attributes(1u << AT_POSITION | 1u << AT_NORMAL | 1u << AT_MATERIAL | 1u << AT_PLACE |
		      1u << AT_COLOUR | 1u << AT_COLOUR_2);
	glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, draw->cloth.indices);
	glBindBuffer(GL_ARRAY_BUFFER, draw->cloth.moving);
	gl_floats(AT_POSITION, 3, stride, offsetof(struct cloth_vertex, position_m));
	gl_floats(AT_NORMAL, 3, stride, offsetof(struct cloth_vertex, normal));
	gl_bytes(AT_MATERIAL, stride, offsetof(struct cloth_vertex, material));
	glBindBuffer(GL_ARRAY_BUFFER, draw->cloth.fixed);
	gl_floats(AT_PLACE, 2, fixed, offsetof(struct cloth_fixed, place));
	gl_bytes(AT_COLOUR, fixed, offsetof(struct cloth_fixed, outside));
	gl_bytes(AT_COLOUR_2, fixed, offsetof(struct cloth_fixed, inside));
}

void cloth_draw(struct draw *draw)
{
	if (!draw->cloth.index_count)
		return;
	cloth_bind(draw);
	surface_use(&draw->cloth.program, draw, 0.0f);
	glBindTexture(GL_TEXTURE_2D, draw->cloth.weave);
	glDrawElements(GL_TRIANGLES, draw->cloth.index_count, GL_UNSIGNED_SHORT, NULL);
}
