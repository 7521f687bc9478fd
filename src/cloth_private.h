/* Shared between the solver's own files only. */
#ifndef CLOTH_PRIVATE_H
#define CLOTH_PRIVATE_H

#include "cloth.h"

enum { REACHES_PER_VERTEX = 6 };

/* Rest shape of a triangle: the flat corner vectors u1 = b - a, u2 = c - a, and the inverse of the
 * matrix with those columns. */
struct rest {
	float inverse[4]; /* F = [e1 e2] [i0 i1; i2 i3] */
	struct v2 u1, u2;
};

struct cloth_scratch {
	struct rest *rest;      /* per triangle */
	int *order;             /* triangles, scattered: a sweep's direction must not show */
	struct v3 *start_m;     /* where the sweep began */
	int *edge_first;        /* per vertex + 1, while edges are paired */
	int *edge_triangle;     /* triangle * 3 + corner */
	int *rim_first;         /* per piece + 1: its open edges */
	int *rim;               /* triangle * 3 + corner */
	uint8_t *flipped;       /* per particle, while folds are turned back */
	int fold_count;         /* found since the first slice of triangles */
	int *ring_first, *ring; /* neighbours of particles */
	struct v3 *smooth_m;
	uint8_t *edge_owner; /* per triangle: bit k: edge k is looked at here, not in its neighbour
			      */
	uint8_t *stiff;      /* per particle: lay in a fold that was turned back, so bends less */
	struct body_track *track; /* per particle */
	float *lift_m;            /* per particle: above offset_m, for the sake of its faces */
	float *slack_m;           /* per particle: least clearance of its faces in this round */
};

static inline bool triangle_placed(const struct cloth *cloth, int t)
{
	const int *v = cloth->triangle[t].v;
	return cloth->placed[v[0]] && cloth->placed[v[1]] && cloth->placed[v[2]];
}

static inline bool is_particle(const struct cloth *cloth, int v)
{
	return cloth->placed[v] && cloth->particle[v] == v;
}

/* Which parts of the body the particle may touch; 0: all. */
static inline unsigned allowed_parts(const struct cloth *cloth, int v)
{
	return cloth->settings.filter_parts ? cloth->piece_parts[cloth->garment->piece[v]] : 0;
}

/* Rebuilds what hangs on which vertices are one: triangles, flatness, neighbours (cloth_build.c).
 */
void cloth_build(struct cloth *cloth);
void cloth_build_reach(struct cloth *cloth);

/* The parts of a sweep; each returns the units it spent. */
long cloth_shape(struct cloth *cloth);   /* triangles back to their rest shape */
long cloth_flatten(struct cloth *cloth); /* edges to 180 degrees */
long cloth_reach(struct cloth *cloth);   /* long-range limits */
long cloth_contact(struct cloth *cloth); /* vertices out of the body, friction */
long cloth_contact_faces(struct cloth *cloth, int slice, int slices); /* midpoints and centres */

/* Looks the contact of a particle up exactly. */
void cloth_look(struct cloth *cloth, int v);

#endif
