/* The solver's inner loops, in three forms that give the same bits: one lane (plain C), four lanes
 * (SSE2, NEON, or whatever the compiler makes of a 16-byte vector) and eight (AVX2).
 *
 * Triangles come in batches of eight whose particles are all different, so that the lanes of a
 * batch may be worked out together; a form with fewer lanes takes a batch in parts. The arithmetic
 * of a lane is the same in all: no contraction, no reciprocal estimates, square root and divide. */
#ifndef CLOTH_KERNEL_H
#define CLOTH_KERNEL_H

#include "vec.h"

enum {
	BATCH = 8,        /* constraints in a batch */
	PADS = 3 * BATCH, /* particles of the lanes that fill a batch up */
	KERNEL_LANES_MAX = 8,
};

/* A particle as the kernels see it: one aligned load. w is nobody's. */
struct place {
	_Alignas(16) float x;
	float y, z, w;
};

/* Batches name a particle by its offset in bytes: nothing is left to work out. */
static inline uint32_t place_offset(int slot)
{
	return (uint32_t)slot * (uint32_t)sizeof(struct place);
}

/* Triangles: corners, and the rest shape as two symmetric matrices (11, 12, 22). D is the inverse
 * of the flat edges [u1 u2] in the frame of the grain: metric = D D^T, grain = D [0 1; 1 0] D^T. */
struct shape_batch {
	_Alignas(64) uint32_t at[3][BATCH];
	float metric[3][BATCH];
};

struct shape_grain {
	_Alignas(32) float grain[3][BATCH];
};

/* Two edges that share no particle, each with the far corners of its triangles: flat when sum k[i]
 * x[i] = 0; sum k k = 1. The sums are over whole particles, so that an edge fills four lanes by
 * itself. */
enum { BENDS = 2 };
struct bends {
	_Alignas(64) float k[BENDS][4];
	uint32_t at[BENDS][4];
};

/* The least share of two edges, whatever the setting. */
struct firm {
	float share[BENDS];
};

/* The nodes of a coarse level that move a particle, with their weights. */
enum { SPREAD = 4 };
struct spread {
	uint32_t node[SPREAD]; /* offsets */
	float weight[SPREAD];
};

/* The particles of a sweep in the public arrays: where they are, and where it began. */
#define PLACE_NONE UINT32_MAX
struct particles {
	const uint32_t *at;   /* per vertex: its place, PLACE_NONE: it has none of its own */
	const uint8_t *whole; /* per BATCH vertices: all have one */
	struct v3 *position_m, *previous_m;
};

/* Within so far (squared) of a place a particle neither touches the body nor needs a new look. */
struct quiet {
	struct v3 at_m;
	float way2_m2;
};

struct kernel {
	/* Every triangle goes `share` of its way to its rest shape; `shear` (0..1) of its shear
	 * counts as a fault, the rest is left. Grain NULL: all counts. */
	void (*shape)(struct place *x, const struct shape_batch *batch,
		      const struct shape_grain *grain, int count, float share, float shear,
		      bool backwards);
	/* Every edge goes `share` of its way to flat, or `firm` if that is more; firm NULL: it is
	 * nowhere. */
	void (*flatten)(struct place *x, const struct bends *bends, const struct firm *firm,
			int count, float share, bool backwards);
	/* Every particle moves by the weighted moves of its nodes. */
	void (*spread)(struct place *x, const struct spread *spread, int count,
		       const struct place *move);
	/* The places of `count` vertices from `first` on, a multiple of BATCH, take their
	 * positions, moved on by `momentum` of the last step, at most step_max_m, and by fall_m
	 * downwards; previous_m is where the sweep begins. */
	void (*predict)(struct place *x, const struct particles *particles, int first, int count,
			float momentum, float step_max_m, float fall_m);
	/* The vertices take their places' positions. */
	void (*put_back)(const struct place *x, const struct particles *particles, int first,
			 int count);
	/* No vertex is farther than step_max_m from where the sweep began. */
	void (*bound)(const struct particles *particles, int first, int count, float step_max_m);
	/* Which of BATCH vertices are no longer quiet: a bit each. */
	unsigned (*stirred)(const struct v3 *position_m, const struct quiet *quiet);
};

/* The widest form that has at most `lanes` lanes and that this build knows. */
const struct kernel *kernel_of(int lanes);

extern const struct kernel kernel_1, kernel_4, kernel_8;

#endif
