/* The soft shade that cloth lays on the body beside its edges: under a hem, in a cuff, at a collar.
 * A body vertex is shaded by how far along the surface the nearest cloth lies. The cloth's own
 * contacts say where it lies; from there distances spread vertex by vertex over the next
 * centimetres, so that the price depends on the garment and not on the figure. */
#include "draw_private.h"

#include <stdlib.h>

/* Cloth farther off than gap_m lays no shade; a quarter of its gap counts like a way. */
static const float gap_m = 0.09f, reach_m = 0.065f, depth = 0.85f;

bool cover_open(struct body_cover *cover)
{
	cover->material = calloc(BODY_VERTICES_MAX, 4);
	cover->drawn_as = calloc(BODY_VERTICES_MAX, sizeof *cover->drawn_as);
	cover->distance_m = calloc(BODY_VERTICES_MAX, sizeof *cover->distance_m);
	cover->waiting = calloc(BODY_VERTICES_MAX, 1);
	cover->queue = calloc(COVER_QUEUE, sizeof *cover->queue);
	glGenBuffers(1, &cover->materials);
	return cover->material && cover->drawn_as && cover->distance_m && cover->waiting &&
	       cover->queue;
}

void cover_release(struct body_cover *cover)
{
	free(cover->material);
	free(cover->drawn_as);
	free(cover->distance_m);
	free(cover->waiting);
	free(cover->queue);
}

/* A vertex of the body, nearer to cloth than was known: it waits to tell its neighbours. */
struct spread {
	struct body_cover *cover;
	int head, waiting;
};

static void spread_to(struct spread *spread, int vertex, float distance_m)
{
	struct body_cover *cover = spread->cover;
	if (distance_m >= cover->distance_m[vertex])
		return;
	cover->distance_m[vertex] = distance_m;
	if (cover->waiting[vertex])
		return;
	cover->waiting[vertex] = 1;
	cover->queue[(spread->head + spread->waiting++) % COVER_QUEUE] = vertex;
}

static void spread_from(struct spread *spread, const struct body *body, int vertex)
{
	float distance_m = spread->cover->distance_m[vertex];
	for (int s = body->star_first[vertex]; s < body->star_first[vertex + 1]; s++)
		for (int k = 0; k < 3; k++) {
			int next = body->triangle[body->star[s]].v[k];
			float step_m = v3_distance(body->position_m[vertex],
						   body->position_m[next]);
			spread_to(spread, next, distance_m + step_m);
		}
}

static void distances_find(struct body_cover *cover, const struct session *session, bool worn)
{
	const struct body *body = &session->body;
	struct spread spread = {cover, 0, 0};
	for (int v = 0; v < body->vertex_count; v++)
		cover->distance_m[v] = reach_m;
	for (int v = 0; worn && v < session->garment.vertex_count; v++) {
		const struct contact *contact = &session->cloth.contact[session->cloth.particle[v]];
		if (!session->cloth.placed[v] || contact->triangle < 0 ||
		    contact->triangle >= body->triangle_count || contact->distance_m > gap_m)
			continue;
		for (int k = 0; k < 3; k++) {
			int corner = body->triangle[contact->triangle].v[k];
			float away_m = v3_distance(contact->point_m, body->position_m[corner]);
			spread_to(&spread, corner, away_m + 0.25f * contact->distance_m);
		}
	}
	while (spread.waiting > 0) {
		int vertex = cover->queue[spread.head];
		spread.head = (spread.head + 1) % COVER_QUEUE;
		spread.waiting--;
		cover->waiting[vertex] = 0;
		spread_from(&spread, body, vertex);
	}
}

static void materials_take(struct draw *draw, const struct body *body)
{
	struct body_cover *cover = &draw->body.cover;
	for (int v = 0; v < body->vertex_count; v++) {
		float near = 1.0f - cover->distance_m[v] / reach_m;
		float open = draw->body.open_sky[v] * (1.0f - depth * near);
		cover->material[4 * cover->drawn_as[v]] = (uint8_t)(open * 255.0f);
	}
	glBindBuffer(GL_ARRAY_BUFFER, cover->materials);
	glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)body->vertex_count * 4, cover->material,
		     GL_DYNAMIC_DRAW);
}

void cover_changed(struct draw *draw, const struct body *body)
{
	struct body_cover *cover = &draw->body.cover;
	for (int v = 0; v < body->vertex_count; v++) {
		cover->drawn_as[v] = draw->order.rank[v];
		cover->distance_m[v] = reach_m;
	}
	cover->sweep = -1;
	cover->worn = false;
	materials_take(draw, body);
}

/* Follows the cloth every second frame, which is enough for a soft shade. */
void cover_follow(struct draw *draw, const struct session *session)
{
	struct body_cover *cover = &draw->body.cover;
	bool worn = draw->cloth.index_count > 0, growing = session->job == JOB_WRAP;
	int sweep = worn ? session->cloth.sweep + (growing ? session->frame : 0) : 0;
	bool due = worn && sweep != cover->sweep && session->frame % 2 == 0;
	if (!draw->body.index_count || (worn == cover->worn && !due))
		return;
	cover->worn = worn;
	cover->sweep = sweep;
	distances_find(cover, session, worn);
	materials_take(draw, &session->body);
}
