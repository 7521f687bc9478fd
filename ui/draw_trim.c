/* The tailor's lines on the worn garment: seams with their stitches, hems with theirs, and a crisp
 * edge where cloth ends. */
#include "draw_private.h"

enum { EDGE_NONE = -1 };

static const float hem_m = 0.014f, seam_m = 0.005f, stitch_m = 0.013f;

static unsigned edge_slot(int a, int b)
{
	return ((unsigned)a * 2654435761u ^ (unsigned)b * 2246822519u) >> 16;
}

static struct edge_use *edge_find(struct draw_cloth *cloth, int a, int b)
{
	int low = int_min(a, b), high = int_max(a, b);
	for (int e = cloth->edge_table[edge_slot(low, high)]; e != EDGE_NONE;
	     e = cloth->edge_use[e].next)
		if (cloth->edge_use[e].a == low && cloth->edge_use[e].b == high)
			return &cloth->edge_use[e];
	return NULL;
}

/* Counts how many triangles use each edge; `map` names the vertices. Returns the edges found. */
static int edges_count(struct draw_cloth *cloth, const struct garment *garment, const int *map)
{
	int count = 0;
	for (int i = 0; i < EDGE_TABLE_SIZE; i++)
		cloth->edge_table[i] = EDGE_NONE;
	for (int t = 0; t < garment->triangle_count; t++) {
		const int *v = garment->triangle[t].v;
		for (int k = 0; k < 3; k++) {
			int from = v[k], to = v[(k + 1) % 3];
			int a = map ? map[from] : from, b = map ? map[to] : to;
			struct edge_use *edge = edge_find(cloth, a, b);
			if (edge) {
				edge->triangle[1] = t;
				edge->count++;
				continue;
			}
			if (count >= 2 * GARMENT_EDGES_MAX)
				return count;
			unsigned slot = edge_slot(int_min(a, b), int_max(a, b));
			cloth->edge_use[count] = (struct edge_use){
				.a = int_min(a, b),
				.b = int_max(a, b),
				.from = from,
				.to = to,
				.inner = v[(k + 2) % 3],
				.triangle = {t, t},
				.count = 1,
				.next = cloth->edge_table[slot],
			};
			cloth->edge_table[slot] = count++;
		}
	}
	return count;
}

/* Which seam a vertex is part of; the first side of a seam gets the topstitching. */
static void seams_find(struct draw_cloth *cloth, const struct garment *garment)
{
	memset(cloth->stitched, 0, GARMENT_VERTICES_MAX);
	memset(cloth->seam, -1, GARMENT_VERTICES_MAX);
	for (int i = 0; i < garment->pair_count; i++) {
		const struct seam_pair *pair = &garment->pair[i];
		cloth->stitched[pair->a] = 1;
		cloth->seam[pair->a] = cloth->seam[pair->b] = (int8_t)pair->seam;
	}
}

static void rims_find(struct draw_cloth *cloth, const struct session *session)
{
	const struct garment *garment = &session->garment;
	int edges = edges_count(cloth, garment, NULL);
	cloth->rim_count = 0;
	for (int e = 0; e < edges && cloth->rim_count < GARMENT_EDGES_MAX; e++) {
		const struct edge_use *edge = &cloth->edge_use[e];
		if (edge->count == 1)
			cloth->rim[cloth->rim_count++] = (struct rim){edge->from, edge->to,
								      edge->inner, false};
	}
	cloth->edge_count = edges_count(cloth, garment, session->cloth.particle);
	for (int r = 0; r < cloth->rim_count; r++) {
		struct rim *rim = &cloth->rim[r];
		const struct edge_use *edge = edge_find(cloth, session->cloth.particle[rim->a],
							session->cloth.particle[rim->b]);
		rim->sewn = edge && edge->count > 1;
	}
	seams_find(cloth, garment);
	cloth->rims_known = true;
	cloth->rims_welded = session->cloth.welded;
}

/* Thread of the cloth's own colour, lighter; white only on white. */
static uint32_t thread_colour(const struct cloth_fixed *rest)
{
	uint32_t colour = 0;
	for (int k = 0; k < 3; k++)
		colour = colour << 8 |
			 (uint32_t)(rest->outside[k] + (255 - rest->outside[k]) * 5 / 8);
	return colour;
}

/* A whole number of stitches to each edge, so that the next edge goes on where this one ends. */
static void stitches_add(struct draw *draw, struct v3 a_m, struct v3 b_m, uint32_t colour,
			 float alpha)
{
	float length_m = v3_distance(a_m, b_m);
	struct stroke thread = {colour, alpha, 0.8f * draw->px, DASH_STITCH, 1.0f};
	float stitch_px = stitch_m * draw->camera.px_per_m /
			  float_max(v3_distance(draw->camera.eye_m, a_m), 0.1f);
	int stitches = int_max(1, (int)(length_m / stitch_m + 0.5f));
	thread.period = float_max(length_m, 1e-4f) / (float)stitches;
	if (stitch_px < 3.0f) { /* too fine to show: the mean of thread and gap */
		thread.row = DASH_SOLID;
		thread.alpha *= 0.62f;
	}
	ribbons_segment(draw, a_m, b_m, 0.0f, &thread);
}

static void rim_add(struct draw *draw, const struct rim *rim, bool welded)
{
	const struct cloth_vertex *vertex = draw->cloth.vertex;
	struct v3 a_m = vertex[rim->a].position_m, b_m = vertex[rim->b].position_m;
	struct v3 normal = v3_normalize(v3_add(vertex[rim->a].normal, vertex[rim->b].normal));
	struct v3 to_eye = v3_sub(draw->camera.eye_m, a_m);
	/* Where the cloth turns away, stitches would crowd into a crawling line: they fade. */
	float facing = v3_dot(normal, v3_normalize(to_eye));
	float alpha = 0.75f * float_clamp((facing - 0.10f) * 3.0f, 0.0f, 1.0f);
	uint32_t colour = thread_colour(&draw->cloth.rest[rim->a]);
	struct v3 along = v3_normalize(v3_sub(b_m, a_m));
	struct v3 inward = v3_sub(vertex[rim->inner].position_m, a_m);
	inward = v3_normalize(v3_mad(inward, along, -v3_dot(inward, along)));
	if (rim->sewn) {
		float shown = float_clamp(float_abs(facing) * 3.0f, 0.0f, 1.0f);
		struct stroke groove = {0x14100c, 0.20f * shown, 0.75f * draw->px, DASH_SOLID,
					1.0f};
		ribbons_segment(draw, a_m, b_m, 0.0f, &groove);
		if (alpha > 0.0f && draw->cloth.stitched[rim->a] && draw->cloth.stitched[rim->b])
			stitches_add(draw, v3_mad(a_m, inward, seam_m), v3_mad(b_m, inward, seam_m),
				     colour, alpha);
		return;
	}
	/* The folded edge of a hem catches light on top and ends in a thin dark line. */
	struct stroke edge = {0x1a1510, 0.42f, 0.7f * draw->px, DASH_SOLID, 1.0f};
	ribbons_segment(draw, a_m, b_m, 0.0f, &edge);
	if (alpha > 0.0f && welded)
		stitches_add(draw, v3_mad(a_m, inward, hem_m), v3_mad(b_m, inward, hem_m), colour,
			     alpha);
}

void trim_follow(struct draw *draw, const struct session *session)
{
	struct draw_cloth *cloth = &draw->cloth;
	if (cloth->index_count &&
	    (!cloth->rims_known || cloth->rims_welded != session->cloth.welded))
		rims_find(cloth, session);
}

/* In step 2 sewn edges light up; the selected seam most. */
static void seam_add(struct draw *draw, const struct rim *rim, int selected)
{
	const struct cloth_vertex *vertex = draw->cloth.vertex;
	int seam = int_min(draw->cloth.seam[rim->a], draw->cloth.seam[rim->b]);
	bool chosen = seam >= 0 && seam == selected;
	struct stroke line = {chosen ? LOOK_WRAP : LOOK_HINT_RIM, 1.0f,
			      (chosen ? 3.2f : 2.4f) * draw->px, DASH_SOLID, 1.0f};
	if (seam >= 0)
		ribbons_segment(draw, vertex[rim->a].position_m, vertex[rim->b].position_m, 0.0f,
				&line);
}

/* While the garment grows its front glows, which also softens the teeth of its last triangles. */
static void front_add(struct draw *draw, const struct session *session)
{
	const struct draw_cloth *cloth = &draw->cloth;
	const struct triangle *triangle = session->garment.triangle;
	struct stroke glow = {0xffd08a, 0.28f, 5.0f * draw->px, DASH_SOLID, 1.0f};
	struct stroke core = {0xfff1d6, 0.85f, 1.6f * draw->px, DASH_SOLID, 1.0f};
	for (int e = 0; e < cloth->edge_count; e++) {
		const struct edge_use *edge = &cloth->edge_use[e];
		if (edge->count < 2 ||
		    laid(session->cloth.placed, &triangle[edge->triangle[0]]) ==
			    laid(session->cloth.placed, &triangle[edge->triangle[1]]))
			continue;
		struct v3 a_m = cloth->vertex[edge->from].position_m;
		struct v3 b_m = cloth->vertex[edge->to].position_m;
		ribbons_segment(draw, a_m, b_m, 0.0f, &glow);
		ribbons_segment(draw, a_m, b_m, 0.0f, &core);
	}
}

void trim_add(struct draw *draw, const struct ui *ui, const struct session *session)
{
	const struct draw_cloth *cloth = &draw->cloth;
	const uint8_t *placed = session->cloth.placed;
	if (!cloth->index_count)
		return;
	if (session->job == JOB_WRAP)
		front_add(draw, session);
	for (int r = 0; r < cloth->rim_count; r++) {
		const struct rim *rim = &cloth->rim[r];
		if (placed[rim->a] && placed[rim->b] && placed[rim->inner])
			rim_add(draw, rim, session->cloth.welded);
		if (ui->step == STEP_SEW && placed[rim->a] && placed[rim->b])
			seam_add(draw, rim, ui->seam);
	}
}
