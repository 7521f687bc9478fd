/* Shared between the files of the surface drag only. */
#ifndef DRESS_DRAG_PRIVATE_H
#define DRESS_DRAG_PRIVATE_H

#include "dress.h"

/* A particle, as the front sees it; bits, so that two at once are one comparison. */
enum { AHEAD = 1, PASSED = 2, STOPPED = 4, NO_CLOTH = 8 };

/* The march of distance over the cloth (dress_drag_front.c). */
struct front {
	const struct cloth *cloth;
	float *way2_m2; /* 4 per triangle: squared way along the body from corner k to the next */
	uint8_t *state;
	struct giver *giver; /* per particle */
	float *distance_m;   /* of the march under way */
	int *place;          /* per particle that waits: in the heap */
	uint64_t *heap;      /* of keys: distance, then particle */
	int waiting;
};

/* What a particle hands on, in one cache line. */
struct hand {
	struct v3 motion_m; /* of the last move */
	float length_m;     /* of the motion */
	struct v3 normal;   /* of the body under it */
	float yield;        /* 0..1: how far it followed lately */
};

struct drag_scratch {
	struct front front;
	float *pin_distance_m;
	uint8_t *blocked;
	uint8_t *gripped;
	struct hand *hand; /* per particle */
	struct v3 *left_m; /* where the last move left it */
	int near_count;
	int *near_triangle;  /* round the hand: their stretch slows it */
	float *near_stretch; /* when the hand took hold */
};

/* Measures the cloth's triangles along the body. */
void front_build(struct front *front, const struct cloth *cloth);

/* A march: begin, sources, march. `distance_m` (per particle) is filled, -1 where the front did not
 * come; so are the front's givers, and `order`, when given, with the particles by distance. The
 * front does not go on from `blocked` particles but for those at the source. Returns how many
 * particles it came to. */
void front_begin(struct front *front, float *distance_m);
void front_add_source(struct front *front, int triangle, const float weight[3]);
int front_march(struct front *front, int *order, const uint8_t *blocked);

/* Folds in the reach of the drag become creases; creases within a hand's span of the grabbed point
 * are opened (dress_crease.c). */
void drag_crease(struct drag *drag);
void drag_open_creases(struct drag *drag);

/* Who hands the motion on to whom, and what the pins leave of it, seen from the grabbed point:
 * fills order, distance_m, giver and share of the drag (dress_drag_graph.c). Returns units spent.
 */
long drag_build_graph(struct drag *drag, const struct pin *pins, int pin_count);

#endif
