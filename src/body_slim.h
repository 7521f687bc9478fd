/* A body with its limbs, head and neck drawn in to their bones and a flat trunk, to lay and sew a
 * garment round: no hand catches a cuff, no chin a collar, a seam has no shoulder to climb, and
 * under the arms and between the legs there is room for cloth. Arms may point where the garment's
 * sleeves do. It then grows into the garment until it is the body itself. */
#ifndef BODY_SLIM_H
#define BODY_SLIM_H

#include "body_limb.h"

/* How a vertex is drawn in. */
struct slim_way {
	struct v3 axis_m; /* nearest point of its limb's bones, to which it goes; of a joined leg's
			     inner side: a place beyond the middle between both legs */
	float middle_m;   /* z of the trunk's bones, to which it goes; its own: it stays */
	float in;         /* 0..1: share of the way to its limb's bones; below 0: it has none */
	int8_t bone;      /* that it turns with; -1: it stays */
};

/* A bone of a limb that points elsewhere while the body is slim. */
struct slim_turn {
	struct v3 axis;
	float angle_rad; /* of the slim body; 0: none */
	struct v3 at_m;  /* where the bone begins now */
};

struct slim_body {
	struct body body;     /* as it is now */
	struct slim_way *way; /* per vertex */
	struct slim_turn turn[BODY_BONES_MAX];
	float share; /* grown so far */
};

/* Takes memory for places and trees; the rest is the full body's own. */
void body_slim_init(struct slim_body *slim, struct arena *arena);

/* The full body at its thinnest. `toward`: which way a limb points, straight from its joint, as a
 * unit vector for each part; (0, 0, 0), or NULL for all: as it is. `whole`: parts that are not
 * drawn in, bits of enum body_part; legs that are whole are joined, their inner sides meeting, so
 * that a skirt lies on both as on one. Triangles and parts are the full body's; no walk on it is
 * trusted (body.clear: balls of radius 0). Hands and feet are of no part (PART_COUNT): who asks for
 * parts does not meet them. False: the body has no limbs, nothing was made. */
bool body_slim_make(struct slim_body *slim, const struct body *full, const struct limb_shape *limb,
		    unsigned whole, const struct v3 toward[PART_COUNT]);

/* The same grown so far: share 0: thin, 1: as it is. */
void body_slim_grow(struct slim_body *slim, const struct body *full, float share);

/* Where a point that lies nearest to triangle `triangle` goes when the body grows to a share, so as
 * not to be left behind by a limb that turns. */
struct v3 body_slim_carry(const struct slim_body *slim, const struct body *full, int triangle,
			  struct v3 p_m, float share);

#endif
