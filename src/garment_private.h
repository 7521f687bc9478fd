/* Inside the garment job: boundary samples, the Delaunay mesh of one piece, and their stages. */
#ifndef GARMENT_PRIVATE_H
#define GARMENT_PRIVATE_H

#include "garment.h"
#include "pattern_grid.h"

enum {
	GARMENT_PIECE_EDGES_MAX = GARMENT_VERTICES_MAX, /* every edge costs a vertex at least */
	MESH_FRAME_POINTS = 3,                          /* the triangle around everything */
	MESH_POINTS_MAX = GARMENT_VERTICES_MAX + MESH_FRAME_POINTS,
	MESH_HALVES_MAX = 3 * (2 * MESH_POINTS_MAX + 2),
	MESH_CROSSED_MAX = MESH_HALVES_MAX / 2, /* edges */
};

/* A planar triangulation as half-edges: three in a row are a counter-clockwise triangle, half-edge
 * h runs from origin[h] to origin[mesh_next(h)], twin[h] is its other side (-1: none). */
struct mesh {
	int point_count;
	struct grid_point *point;
	int *leaving; /* per point: a half-edge that starts there */
	int half_count;
	int *origin, *twin;
	uint8_t *fixed;  /* boundary of the piece: never flipped */
	uint8_t *queued; /* is on the stack */
	uint8_t *inside; /* per triangle */
	int stack_count;
	int *stack;
	int *crossed; /* pairs of points: the edges that a new fixed edge crosses */
	int last;     /* half-edge near the last change: where walks start */
};

static inline int mesh_next(int half)
{
	return half % 3 == 2 ? half - 2 : half + 1;
}

static inline int mesh_previous(int half)
{
	return half % 3 == 0 ? half + 2 : half - 1;
}

void mesh_init(struct mesh *mesh, struct arena *arena);

/* One triangle around the box low..high with room to spare. */
void mesh_reset(struct mesh *mesh, struct grid_point low, struct grid_point high);

/* A half-edge of the triangle that holds p, found by walking from `start`. */
int mesh_locate(const struct mesh *mesh, struct grid_point p, int start, long *units);

/* Adds a point by splitting and flipping (Lawson 1977); false when a point or a fixed edge lies
 * there already. *units grows by the triangles walked and flipped. */
bool mesh_add(struct mesh *mesh, struct grid_point p, int start, long *units);

/* The same for a point that is in mesh.point already; no other point may lie there. */
void mesh_join(struct mesh *mesh, int v, int start, long *units);

/* Makes a b an edge and fixes it. No fixed edge may cross it, no point may lie on it. */
void mesh_fix(struct mesh *mesh, int a, int b, long *units);

/* Marks the triangles inside the fixed loop. */
void mesh_carve(struct mesh *mesh, long *units);

/* Restores the Delaunay property of every unfixed edge on the stack and all that follow. */
void mesh_push(struct mesh *mesh, int half);
void mesh_legalize(struct mesh *mesh, long *units);

/* The sampled boundary. Edges are listed piece by piece in outline order. A group is an edge that
 * is not sewn, or the two edges of a seam, which share their fractions. */
struct plan_edge {
	int piece, edge;
	int group;
	bool backward; /* runs against the group's fractions */
	int first;     /* garment vertex of its start */
	float length_mm;
};

struct plan_group {
	int seam; /* pattern.seam, -1 */
	int side_count;
	int side[2];         /* plan.edge */
	int first, segments; /* its segments + 1 fractions in plan.fraction */
};

struct grid_box {
	struct grid_point low, high;
};

struct plan {
	float edge_mm;
	int edge_count;
	struct plan_edge *edge;
	int edge_first[PIECES_MAX + 1];
	int group_count;
	struct plan_group *group;
	int fraction_count;
	float *fraction, *fraction_next; /* 0 .. 1 rising, per group */
	uint8_t *split;                  /* per fraction: the segment that starts there */
	int point_count;                 /* of all pieces */
	int point_first[PIECES_MAX + 1];
	struct grid_point *point; /* piece by piece, in outline order */
	int *point_fraction;      /* the fraction that starts the segment from this point */
	struct grid_box *box;     /* of every block of segments of one piece */
	int *sharp;               /* running count of sharp corners, per point of one piece */
};

void plan_init(struct plan *plan, struct arena *arena);

/* Samples all boundaries. NULL, or why it can't be done, in words (static or in fault). */
const char *plan_make(struct plan *plan, const struct pattern *pattern, int vertices,
		      char fault[160]);

/* Fills a piece with even, well-shaped triangles in bounded steps. */
enum fill_stage {
	FILL_POINTS,  /* boundary points */
	FILL_FIX,     /* boundary edges; then the inside is known */
	FILL_LATTICE, /* a hexagonal lattice inside */
	FILL_REFINE,  /* circumcentres of bad triangles */
	FILL_SMOOTH,  /* points to the middle of their stars, flipping as they go */
	FILL_MEND,    /* the points of what is still bad, one by one */
	FILL_DONE,
};

struct fill {
	enum fill_stage stage;
	int boundary_count;
	const struct grid_point *boundary;
	int32_t spacing; /* aimed edge length */
	int point_limit; /* mesh points at most */
	struct grid_point low, high;
	int cursor, stride, pass;
	int changed;    /* in this pass */
	int *parity;    /* lattice row: outline crossings to the left of a column */
	int *shut;      /* lattice row: segments too near, as differences */
	uint8_t *awake; /* smoothing: the point or a neighbour moved */
};

void fill_init(struct fill *fill, struct arena *arena);

/* `boundary` stays the caller's; boundary point i becomes mesh point MESH_FRAME_POINTS + i. */
void fill_start(struct fill *fill, struct mesh *mesh, const struct grid_point *boundary, int count,
		float edge_mm, int point_limit);
long fill_advance(struct fill *fill, struct mesh *mesh, long quota);

/* Is p in the box of the outline? Points outside it can't be located. */
bool fill_holds(const struct fill *fill, struct grid_point p);

/* garment_smooth.c. Each handles one mesh point or triangle and returns whether it changed
 * anything. */
bool smooth_point(struct fill *fill, struct mesh *mesh, int v, long *units);
bool mend_triangle(struct fill *fill, struct mesh *mesh, int half, long *units);

/* The squared sine of the smallest angle of a triangle; 0 when it is not counter-clockwise. */
float triangle_quality(struct grid_point a, struct grid_point b, struct grid_point c);

/* Is the smallest angle of this triangle a corner of the outline, which no mesh can change? */
bool triangle_forced(const struct mesh *mesh, int half);

#endif
