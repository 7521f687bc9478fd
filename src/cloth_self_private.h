/* Shared between cloth_self*.c only. */
#ifndef CLOTH_SELF_PRIVATE_H
#define CLOTH_SELF_PRIVATE_H

#include "cloth_private.h"
#include "cloth_self.h"

enum {
	SELF_EVERY = 10,         /* sweeps between slices: a frame's */
	SELF_SLICES = 8,         /* so that the whole cloth is looked at within 8 frames */
	SELF_PAIRS_A_VERTEX = 8, /* two sheets beside a vertex, and the triangles round a corner */
	SELF_CROSSINGS_MAX = 4096, /* a sleeve through a trunk has some hundred */
	SELF_FRONT = 1,      /* bits of a pair: the vertex belongs in front of the triangle, */
	SELF_DECIDED = 2,    /* and this is known */
	SELF_ROW = 1024,     /* cells along x: 40 m */
	SELF_CELLS = 16384,  /* buckets, SELF_ROW of them the last row's end */
	SELF_NEAR_MAX = 128, /* triangles beside one triangle; crumpled cloth has the rest of
				them next time */
};

/* Edge k of a triangle (3 * triangle + k) and the triangle through which it passes; or, of two
 * garments, is about to. */
struct crossing {
	int edge, triangle;
	int8_t side;  /* of the triangle, where the order of garments says so: 1 in front, -1; 0 */
	bool through; /* it did when last looked at */
};

/* A triangle in the grid; copied, so that a search reads memory in order. */
struct self_item {
	struct v3 centre_m;
	float radius_m;
	int triangle, row;
};

/* What the search has to know of a triangle. */
struct self_triangle {
	struct v3 centre_m, normal; /* not unit */
	float radius_m;             /* below 0: not placed */
	struct v2 rest_m;           /* its centre on the piece */
	int piece, row, x;          /* place in the grid */
};

struct cloth_self {
	/* the grid of triangles (cloth_self_grid.c) */
	float cell_m;
	int *cell_first; /* per cell + 1 */
	struct self_item *cell_item;
	struct self_triangle *triangle;
	int *across;       /* 3 per triangle: 3 * neighbour + its edge; -1: a rim */
	int *owner;        /* per particle: the triangle in whose slice it is looked at */
	int *garment_size; /* per particle: of the sewn garment that it belongs to, in particles */
	/* sides (cloth_self.c) */
	uint8_t *pair_count; /* per particle */
	int *pair;  /* SELF_PAIRS_A_VERTEX each: 4 * triangle + SELF_FRONT + SELF_DECIDED */
	int *stamp; /* per particle: ring of the particle looked at */
	/* crossings (cloth_self_cross.c) */
	int crossing_count;
	struct crossing *crossing;
	uint8_t *cut;     /* per triangle: bit k: edge k passes through another triangle */
	uint8_t *crossed; /* per particle: in a contact zone in which sheets cross */
	uint8_t *trapped; /* per particle: in a patch that has come through another sheet */
	int *root, *size; /* per particle, while patches are found */
	int *vote,
		*voters; /* 2 per particle: of zones, on sheets that face each other, and alike */
	float margin_m;  /* a vertex is watched so far beyond the thickness */
	bool layered;    /* there are garments over garments */
	bool looked;     /* at the whole cloth, once since the build */
};

/* Where a point lies over a triangle: its height above the plane, and the weights of the point
 * below it. */
struct over {
	struct v3 normal;
	float height, weight[3];
};

static inline float self_reach(const struct cloth *cloth)
{
	return cloth->settings.thickness_m + cloth->self->margin_m;
}

static inline void self_corners(const struct cloth *cloth, int t, struct v3 corner[3])
{
	for (int k = 0; k < 3; k++)
		corner[k] = cloth->position_m[cloth->triangle[t].v[k]];
}

static inline int self_pair(const struct cloth_self *self, int v, int i)
{
	return self->pair[SELF_PAIRS_A_VERTEX * v + i];
}

/* False: the triangle has no area. */
bool self_look_over(const struct cloth *cloth, struct v3 p, int t, struct over *over);

/* 1: two triangles face alike, -1: each other or away from each other, 0: neither. */
int self_facing(const struct cloth *cloth, int s, int t);

/* On which side of triangle t the order of garments wants a part of triangle s: 1 in front, -1
 * behind; 0: it says nothing. */
int self_layer_side(const struct cloth *cloth, int s, int t);

/* Moves points of two sheets, as weights of up to three particles each, apart along a unit vector:
 * the first by its share along `away`, the other against it. A particle that would go into the body
 * on which it lies does not give way; with `outer_only` only those of the outer garment do. */
struct sheet_point {
	int count, v[3];
	float weight[3];
};
void self_part(struct cloth *cloth, const struct sheet_point *a, const struct sheet_point *b,
	       struct v3 away, bool outer_only);

/* Sorts all placed triangles into the grid by their centres. */
long self_grid(struct cloth *cloth);

/* Triangles that may touch triangle t and are no neighbours of it; at most SELF_NEAR_MAX. */
int self_near(const struct cloth *cloth, int t, int near[SELF_NEAR_MAX]);

/* Neighbours over edges, owners and garments of the welded cloth. */
void self_connect(struct cloth *cloth);

/* The crossings of triangle t's own edges with the triangles near it. */
void self_find_crossings(struct cloth *cloth, int t, const int *near, int near_count);

/* Before a slice: forgets the crossings that it will look for. After the last: finds trapped
 * patches. */
void self_forget_crossings(struct cloth *cloth, int slice, int slices);
void self_find_patches(struct cloth *cloth);

/* Decides the sides in zones where sheets cross. */
void self_judge_zones(struct cloth *cloth);

/* Pulls every crossing out by a step; edges whose side is known go there. */
long self_pull_crossings(struct cloth *cloth);

/* The latter alone, by moving outer garments only. */
long self_hold_order(struct cloth *cloth);

#endif
