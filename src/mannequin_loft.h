/* Lofts: surfaces through a stack of cross-sections (mannequin_tables.h), and the strips of
 * triangles that are laid along them. Half a body (x >= 0) is built; see body_mannequin.c. */
#ifndef MANNEQUIN_LOFT_H
#define MANNEQUIN_LOFT_H

#include "triangle.h"
#include "vec.h"

enum {
	SECTION_ORDER = 8,
	SECTION_COLUMNS = 7 + 2 * SECTION_ORDER,
	LOFT_ROWS_MAX = 32,
	RING_VERTICES_MAX = 128,
};

/* A section is a ring of points about an origin: at the angle a, the point lies at the distance
 * sum(cosine[m] cos(m a) + sine[m] sin(m a)) in the direction that a and the cone's angle give in
 * a frame whose axis is +Y, pitched about X and then rolled about Z. The angle runs from the front
 * (+Z) to the wearer's left (+X); a cone of 0 is a plane.
 *
 * Columns: origin x y z, pitch, roll, cone, cosine[0 .. SECTION_ORDER], sine[1 .. SECTION_ORDER],
 * in 0.1 mm and 0.1 mrad.
 *
 * A surface point is loft_point(along, angle): `along` in metres from the first section, measured
 * as the mean distance between neighbouring sections. */
struct loft {
	const short (*section)[SECTION_COLUMNS];
	int count;
	bool half; /* symmetric sections: only angles 0 .. pi, and the ends lie at x = 0 */
	float start_m[LOFT_ROWS_MAX]; /* of each section */
};

/* A mesh in the making, in somebody else's arrays. */
struct sheet {
	struct v3 *position_m;
	struct triangle *triangle;
	int vertex_count, triangle_count;
	int vertices_max, triangles_max;
};

/* A line of vertices across a loft: closed (the last is followed by the first) or open. */
struct ring {
	int count;
	bool closed;
	int vertex[RING_VERTICES_MAX];
};

void loft_init(struct loft *loft, const short (*section)[SECTION_COLUMNS], int count, bool half);
float loft_length(const struct loft *loft);
struct v3 loft_point(const struct loft *loft, float along_m, float angle_rad);

int sheet_add(struct sheet *sheet, struct v3 position_m);

/* New vertices along the loft's ring at `along_m`, evenly spread, about `spacing_m` apart. On a
 * closed ring the first one lies `phase` (0 .. 1) of a spacing after the angle 0. */
void ring_lay(struct sheet *sheet, const struct loft *loft, float along_m, float spacing_m,
	      float phase, struct ring *ring);

/* New vertices on the loft's ring between two angles (increasing, beyond 2 pi where it wraps),
 * evenly spread between two vertices that exist already, which come first and last. */
void ring_lay_arc(struct sheet *sheet, const struct loft *loft, float along_m, const float angle[2],
		  const int end[2], float spacing_m, struct ring *ring);

/* The strip of triangles between two rings, outside where `upper` lies further along the loft. */
void ring_stitch(struct sheet *sheet, const struct ring *lower, const struct ring *upper);

/* The fan that closes a loft: `tip` lies beyond the ring, or before it. */
void ring_close(struct sheet *sheet, const struct ring *ring, int tip, bool beyond);

#endif
