/* Shared between measure*.c only. */
#ifndef MEASURE_PRIVATE_H
#define MEASURE_PRIVATE_H

#include "measure.h"

enum {
	MEASURE_EDGES_MAX = 3 * GARMENT_TRIANGLES_MAX,
	GIRTH_DIRECTIONS = 64, /* the girth of a circle comes out 0.04 % too large */
};

/* An edge of the garment as it is sewn: one edge where two pieces meet. */
struct measure_edge {
	int a, b;           /* particles, in the direction of the first triangle */
	int triangle[2];    /* the first two that have it */
	int triangle_count; /* 1: a rim */
};

struct sort_item {
	float key;
	int item;
};

struct measure_scratch {
	int edge_count;
	struct measure_edge *edge;
	int *edge_of;           /* 3 per triangle: its edge v[k] v[k+1]; -1: none */
	int *star_first, *star; /* per particle + 1: edges under their lower particle */
	struct sort_item *sort;
	uint8_t *walked;         /* per edge: lies on a loop already */
	int *loop;               /* particles along the loop being walked */
	struct v3 *rim_m;        /* their places */
	uint8_t *cut, *body_cut; /* per triangle of cloth and body: the plane's walk was there */
	struct v2 *curve_m;      /* a walk's corners in the plane */
	struct v2 direction[GIRTH_DIRECTIONS]; /* once round */
};

/* Where vertex v of cloth->triangle lies; welded vertices share their particle's place. */
static inline struct v3 measure_position(const struct cloth *cloth, int v)
{
	return cloth->position_m[cloth->particle[v]];
}

/* Cloth that the wrap has not reached is not measured. */
static inline bool measure_placed(const struct cloth *cloth, int t)
{
	const int *v = cloth->triangle[t].v;
	return cloth->placed[v[0]] && cloth->placed[v[1]] && cloth->placed[v[2]];
}

/* Rising keys, equal ones by item. */
void measure_sort(struct sort_item *item, int count);

/* The parts of measure_garment. */
void measure_strain(struct measure *measure, const struct cloth *cloth,
		    struct measure_scratch *scratch);
void measure_self(struct measure *measure, const struct cloth *cloth,
		  struct measure_scratch *scratch);
void measure_girths(struct measure *measure, const struct cloth *cloth,
		    struct measure_scratch *scratch);
void measure_loops(struct measure *measure, const struct cloth *cloth,
		   struct measure_scratch *scratch);

/* Girths beside the rim of `count` points in scratch->rim_m. */
void measure_girth_at_rim(struct measure *measure, const struct cloth *cloth,
			  struct measure_scratch *scratch, int count);

/* Whether two triangles with no common corner pass through one another. */
bool measure_triangles_cross(const struct v3 a[3], const struct v3 b[3]);

/* The linking number of two closed polygons, as a real number: a whole one but for rounding. */
float measure_linking(const struct v3 *a, int a_count, const struct v3 *b, int b_count);

/* The closed curve that runs through a part's bones: measure.h describes its way. Returns the
 * number of points, 0 for a body without bones there. */
enum { CHAIN_MAX = BODY_BONES_MAX + 16 };
int measure_chain(const struct body *body, enum body_part part, struct v3 point_m[CHAIN_MAX]);

#endif
