/* The flat pattern: pieces of cloth with a front and a back, and the seams between their edges.
 *
 * A piece lives in its own coordinates: millimetres, y up, seen from its OUTSIDE, outline
 * counter-clockwise. On the sheet it is placed by a turn and a shift, mirrored in x first when it
 * lies inside up; turning a piece over therefore never changes its shape. An edge is the run of
 * outline points from one corner to the next, counter-clockwise; edge k starts at the k-th corner.
 */
#ifndef PATTERN_H
#define PATTERN_H

#include "limits.h"
#include "vec.h"

struct piece {
	bool used;
	bool inside_up;
	int swatch;    /* index into the swatch table of the face */
	int layer;     /* drawn and picked from high to low */
	int worn_over; /* garments are worn in rising order of this */
	char name[NAME_BYTES_MAX];
	struct v2 position_mm; /* of the local origin on the sheet */
	float turn_rad;
	int point_count;
	struct v2 point_mm[OUTLINE_POINTS_MAX]; /* local */
	bool corner[OUTLINE_POINTS_MAX];        /* edges run from corner to corner */
	bool symmetric; /* about its axis; what happens to one half happens to the other */
	struct v2 axis_mm;
	float axis_rad; /* of the axis' direction, local */
};

/* One side of a seam: the index of an edge in a piece. */
struct edge_ref {
	int piece; /* pattern.piece */
	int edge;
};

/* a sewn to b. Along an orientable surface the start of one counter-clockwise edge meets the END of
 * the other; `swapped` seams join start to start. Unequal lengths ease in proportion. */
struct seam {
	bool used;
	bool swapped;
	struct edge_ref a, b;
	bool even; /* both edges are kept equally long while one is edited */
};

struct pattern {
	struct piece piece[PIECES_MAX];
	struct seam seam[SEAMS_MAX];
};

struct v2 piece_to_sheet(const struct piece *piece, struct v2 local_mm);
struct v2 piece_from_sheet(const struct piece *piece, struct v2 sheet_mm);

int piece_edge_count(const struct piece *piece);

/* Outline indices of an edge's ends; walk i = first; i != last; i = (i + 1) % point_count. A piece
 * with one corner has one edge that ends where it starts: first == last. */
void piece_edge(const struct piece *piece, int edge, int *first, int *last);
float piece_edge_length_mm(const struct piece *piece, int edge);

/* The point at a fraction 0..1 of the edge's arc length. */
struct v2 piece_edge_point(const struct piece *piece, int edge, float fraction);
float piece_area_mm2(const struct piece *piece); /* positive: counter-clockwise */
bool piece_contains(const struct piece *piece, struct v2 local_mm);

/* The edge nearest to a local point; returns the distance in mm. */
float piece_nearest_edge(const struct piece *piece, struct v2 local_mm, int *edge, float *fraction);

/* Why a piece can't be cut out of cloth: NULL when it can. Checks at least 3 points and one corner,
 * finite coordinates within +-10 m, no edge of zero length, area of at least 100 mm2,
 * counter-clockwise, no self-crossing. */
const char *piece_fault(const struct piece *piece);

/* An index that no piece has; -1: the pattern is full. */
int pattern_free_piece(const struct pattern *pattern);

/* The uppermost piece (layer) under a sheet point, or -1. `skip` is a bit set of pieces to pass. */
int pattern_pick(const struct pattern *pattern, struct v2 sheet_mm, uint32_t skip);

/* A freehand loop (sheet mm, any direction, open or closed) becomes an outline: resampled,
 * corners found, runs between them smoothed to straight lines or even curves, counter-clockwise as
 * seen on the sheet, first point a corner. Writes point_mm, corner and point_count (local origin at
 * the centroid; position_mm set). Returns NULL or why the stroke makes no piece.
 * Works for a hand that trembles by 20 mm (sheet) from sample to sample. */
const char *piece_from_stroke(struct piece *piece, const struct v2 *stroke_mm, int count);

/* Redraws a stretch of the outline: the stroke (sheet mm) must begin and end near the outline; the
 * stretch between, on the side that the stroke follows more closely, is replaced by it. Corners at
 * both ends stay or are made. Returns NULL or why not. */
const char *piece_oversketch(struct piece *piece, const struct v2 *stroke_mm, int count);

#endif
