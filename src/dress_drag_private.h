/* Shared between the files of the surface drag only. */
#ifndef DRESS_DRAG_PRIVATE_H
#define DRESS_DRAG_PRIVATE_H

#include "dress.h"

enum { NEIGHBOURS_MAX = 6 * GARMENT_TRIANGLES_MAX };

struct heap_item {
	float distance_m;
	int particle;
};

/* What a particle hands on, in one cache line. */
struct hand {
	struct v3 motion_m; /* of the last move */
	float length_m;     /* of the motion */
	struct v3 normal;   /* of the body under it */
	float yield;        /* 0..1: how far it followed lately */
};

struct drag_scratch {
	int *first; /* per particle + 1: its neighbours */
	int *end;   /* per particle: neighbour[first .. end) */
	int *neighbour;
	float *way_m;  /* per neighbour: how far it is along the body */
	float *rest_m; /* per neighbour: how long the edge is on the flat piece */
	struct heap_item *heap;
	int heap_count;
	float *pin_distance_m;
	uint8_t *settled;
	uint8_t *blocked;
	uint8_t *gripped;
	struct hand *hand; /* per particle */
	struct v3 *left_m; /* where the last move left it */
};

/* Who hands the motion on to whom, and what the pins leave of it, seen from a grabbed triangle:
 * fills order, distance_m, share and from of the drag (dress_drag_graph.c). */
void drag_build_graph(struct drag *drag, const struct pin *pins, int pin_count);

#endif
