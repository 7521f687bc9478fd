/* The pattern as cloth: every piece triangulated, seams sampled alike on both sides.
 *
 *   pattern --garment_start--> job --garment_advance (quota)--> garment
 *
 * Vertices keep their flat rest position for ever (strain and texture are measured against it);
 * `weld` says which vertices are one once the seams are closed. Where two edges of ONE piece are
 * sewn together and come so close that joining them would fold a triangle to a line (the tip of a
 * cone, a strip narrower than two triangles), those samples have no pair and the place stays open.
 */
#ifndef GARMENT_H
#define GARMENT_H

#include "arena.h"
#include "pattern.h"
#include "triangle.h"

struct seam_pair {
	int a, b; /* garment vertices to be joined */
	int seam; /* pattern.seam */
};

struct garment {
	int vertex_count;
	struct v2 *rest_m; /* local piece coordinates in metres, y up */
	int *piece;        /* pattern.piece */
	int *weld;         /* the representative vertex (weld[v] <= v, weld[weld[v]] == weld[v]) */
	int triangle_count;
	struct triangle *triangle;
	int *triangle_piece;
	int pair_count;
	struct seam_pair *pair;
	int piece_first[PIECES_MAX + 1]; /* vertices of piece p: [first[p], first[p + 1]) */
	int piece_first_triangle[PIECES_MAX + 1];
	int layer[PIECES_MAX]; /* of a piece's garment: 0 is worn next to the body */
	float edge_m;          /* the edge length aimed at */

	/* Refined (garment_refine.h), the triangles above are made of these. 0: it is not. */
	int base_count;
	struct triangle *base; /* corners counted among the vertices of which `place` is -1 */
	uint8_t *depth;        /* per base triangle: 0 .. REFINE_DEPTH_MAX */
	int *place; /* per vertex, when refined: REFINE_PLACES * base triangle + where in it; -1: it
		       was there before */
};

void garment_init(struct garment *garment, struct arena *arena);

/* In which order garments are worn, per piece: by the highest worn_over of their pieces, equal ones
 * in the order of their first pieces. Pieces that hang together by seams are one garment. */
void garment_layers(const struct pattern *pattern, int layer[PIECES_MAX]);

/* The triangle of a piece that holds a local point (mm), with barycentric weights; the nearest
 * triangle when the point lies outside by less than the edge length. -1: none. */
int garment_locate(const struct garment *garment, int piece, struct v2 local_mm, float weight[3]);

/* The resumable job. `edge_m` 0 chooses the length so that about `vertices` vertices result. */
struct garment_job; /* opaque: scratch of the mesher */
struct garment_job *garment_job_init(struct arena *arena);

/* Returns NULL or why the pattern can't be meshed (a piece's fault, a seam to nowhere, too many).
 */
const char *garment_start(struct garment_job *job, struct garment *garment,
			  const struct pattern *pattern, int vertices);

/* Spends up to `quota` units (one triangle walked or one point placed is a unit) and returns the
 * units spent; *done becomes true when the garment is complete. */
long garment_advance(struct garment_job *job, long quota, bool *done);

#endif
