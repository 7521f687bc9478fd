/* The cloth solver: particles that are moved directly, without velocities (S18).
 *
 * One sweep is: momentum and gravity as displacements, seams, coarse levels, triangle shape
 * matching, flatness of edges, pins, a bound on each step, then contact with the body, which has
 * the last word. A sweep's work is fixed by the mesh; nothing iterates until converged.
 */
#ifndef CLOTH_H
#define CLOTH_H

#include "body.h"
#include "crew.h"
#include "garment.h"

/* Where a particle touches or nearly touches the body, kept from sweep to sweep (S17). */
struct contact {
	int triangle; /* body.triangle, -1: never looked */
	struct v3 point_m, normal;
	float distance_m;
};

/* Cloth that is too long for where it lies is gathered in wrinkles too fine for the mesh: past
 * `from_m` along a direction of the flat piece only a share of its length is left. */
struct gather {
	struct v2 along; /* unit vector */
	float from_m;
	float share; /* 1: as it is cut */
};

/* A piece that is let out: across one direction of the flat piece, by shares at knots that follow
 * one another at right angles to it. step_m 0: it is not. */
enum { WIDE_KNOTS = 8 };
struct widening {
	struct v2 across; /* unit vector */
	float from_m, step_m;
	float more[WIDE_KNOTS]; /* 0.2: a fifth wider */
};

struct cloth_settings {
	float shape;        /* 0..1: share of a triangle's way back to its rest shape */
	int shape_passes;   /* over all triangles in one sweep */
	float flatness;     /* 0..1 */
	float shear;        /* 0..1: share of a triangle's shear that counts as a fault */
	float reach;        /* 0..1: share of a taut coarse link's excess taken in one pass */
	float strain_bound; /* a triangle's largest strain after a sweep's shaping; 0: none */
	float momentum;     /* 0..1: share of the last step carried on */
	float gravity_m;    /* displacement a sweep */
	float friction;     /* 0..1: share of tangential motion lost in contact */
	float grip;         /* Coulomb: motion shorter than this times the push is lost wholly */
	float offset_m;     /* cloth stays this far outside the body */
	float step_max_m;   /* bound on a particle's motion in one sweep */
	float seam_step_m;  /* bound on the closing of a seam in one sweep; 0: seams don't pull */
	float attract_m;    /* pull of drawn pieces to a body farther than 35 mm; 0: none */
	float inflate_m;    /* push of blown pieces away from a body nearer than 100 mm; 0: none */
	bool filter_parts;  /* each piece only meets the body parts that piece_parts allows */
	bool faces;         /* also keep edge midpoints and triangle centres outside */
	bool open;          /* folds that are not wanted turn back */
	float thickness_m;  /* cloth stays this far from other cloth; 0: passes through it */
};

struct cloth {
	const struct garment *garment;
	const struct body *body;
	struct v3 *position_m; /* per garment vertex; welded: read through cloth_particle */
	struct v3 *previous_m; /* where the last sweep began: they differ by the momentum */
	struct contact *contact;
	uint8_t *placed; /* the wrap has laid this vertex */
	uint8_t *held;   /* goal_m pulls: 1 softly (marks, the grabbed point), 2 firmly (pins) */
	struct v3 *goal_m;
	uint8_t *creased; /* per vertex: lies in a fold that is wanted */
	bool welded;
	bool apart; /* ... but the sides of the seams have not been joined yet */
	bool built; /* the tables below are this garment's, welded or not; else only cloth_build_on
		       may be called */
	bool worn;  /* a wrap has finished: there is a garment to drag */
	unsigned piece_parts[PIECES_MAX]; /* bit set of enum body_part; 0: all */
	bool piece_drawn[PIECES_MAX];     /* attract_m works on this piece, ... */
	bool piece_blown[PIECES_MAX];     /* ... inflate_m on this one */
	struct gather piece_gather[PIECES_MAX];
	struct widening piece_wide[PIECES_MAX];
	int *particle;             /* per vertex: itself, or weld[] once welded */
	struct triangle *triangle; /* through particle[] */
	int *star_first;           /* per particle + 1: its corners are star[star_first[v] ..], */
	int *star;                 /* triangle * 4 + corner */
	int *ring;      /* 2 per entry of star: the triangle's next particle and the one after */
	int flat_count; /* edges of two triangles */
	struct flat *flat;
	int fabric;        /* fabric_at: what a worn garment is made of */
	int lanes;         /* 1, 4 or 8: numbers that the processor works at once; same bits */
	struct crew *crew; /* NULL: no threads beside the caller's; same bits */
	int sweep;         /* counted for the time-sliced refresh */
	struct cloth_settings settings;
	struct cloth_scratch *scratch; /* owned by cloth_*.c */
	struct cloth_self *self;       /* owned by cloth_self*.c */
	struct cloth_refine *refine;   /* owned by cloth_refine.c */
};

void cloth_init(struct cloth *cloth, struct arena *arena);

/* Nothing placed, not welded; constraints for this garment on this body. Garment NULL: no cloth. */
void cloth_reset(struct cloth *cloth, const struct garment *garment, const struct body *body);

/* Joins every seam pair at the mean of its sides and rebuilds the constraints. */
void cloth_weld(struct cloth *cloth);

/* The same two over several frames. cloth_build_on builds the constraints in steps, up to `quota`
 * units (or one step), and returns the units spent; `built` says when all is done. The mesh that
 * was built last needs no step. What is sewn is to be joined then: until it is, its sides stay
 * where they are. */
void cloth_start(struct cloth *cloth, const struct garment *garment, const struct body *body);
void cloth_sew(struct cloth *cloth);
void cloth_join(struct cloth *cloth);
long cloth_build_on(struct cloth *cloth, long quota);

/* The same at once, as when piece_gather and piece_wide were changed. */
void cloth_build(struct cloth *cloth);

/* One sweep. Returns the units spent (constraint projections and triangles walked). */
long cloth_sweep(struct cloth *cloth);

/* The settings of everyday relaxation (worn garment, gravity on). */
struct cloth_settings cloth_settings_worn(void);

/* The settings while RELAX is held: less friction, so that strain can flow out. */
struct cloth_settings cloth_settings_relax(void);

/* After the last sweep of a frame: every vertex of a welded cloth takes its particle's position, so
 * that readers may use position_m[v] directly. */
void cloth_finish(struct cloth *cloth);

/* Where a garment vertex lies on its flat piece, as gathers leave it. */
struct v2 cloth_flat_m(const struct cloth *cloth, int v);

/* Takes changed gathers into the rest shapes. */
void cloth_take_gathers(struct cloth *cloth);

/* Largest principal stretch of a triangle minus 1, 0 where it is not stretched (0.02: 2 %). */
float cloth_stretch(const struct cloth *cloth, int triangle);

/* Mean stretch of the placed triangles (0.02: 2 %), of a large cloth by some thousands of them;
 * cheap, for the visitor's meter. */
float cloth_strain_mean(const struct cloth *cloth);

/* Puts a cloth back into an earlier state (undo): constraints for this garment, welded or not, then
 * these positions at rest; contacts are looked up afresh. */
void cloth_restore(struct cloth *cloth, const struct garment *garment, const struct body *body,
		   const struct v3 *position_m, const uint8_t *placed, bool welded, bool worn);

/* Mends folded patches: triangles that face the body turn back with their ring (S18's last clause).
 * Looks at slice `slice` of `slices` of all triangles; slices come in order, and what was found is
 * mended with the last. Returns how many were found since the first; *units grows by the units
 * spent, here and below. */
int cloth_unfold(struct cloth *cloth, int slice, int slices, long *units);

/* Does the triangle's outside look at the body that it lies near? */
bool cloth_folded(const struct cloth *cloth, int triangle);

/* Pushes edges out that pass through the body, by exact queries: slice `slice` of `slices` of all
 * triangles. Returns how many were found. */
int cloth_push_out(struct cloth *cloth, int slice, int slices, long *units);

/* Contact alone, by exact queries, for slice `slice` of `slices` of all particles and triangles;
 * all slices are a round. When a round finds no edge that passes through the body, the cloth may
 * rest. Returns how many were found. */
int cloth_clean(struct cloth *cloth, int slice, int slices, long *units);

/* Outward normals per vertex for drawing, into `normal` (vertex_count). */
void cloth_normals(const struct cloth *cloth, struct v3 *normal);

/* The first triangle that a ray hits among placed cloth, nearer than distance_max; -1: none. */
int cloth_ray(const struct cloth *cloth, struct v3 origin_m, struct v3 direction, float *distance,
	      float weight[3]);

#endif
