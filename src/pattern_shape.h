/* Changes of an outline that keep its edges what they are: one corner, one edge or the whole is
 * told where to go, and the rest follows. Lengths in mm, places in the piece's own coordinates.
 *
 * Each returns NULL, or why not in words for the visitor; the piece may then be half changed, so
 * give it a copy. Whether the new outline can be cut is piece_fault's question. */
#ifndef PATTERN_SHAPE_H
#define PATTERN_SHAPE_H

#include "pattern.h"

/* The outline point at a corner: the k-th, as edges are counted. */
int piece_corner(const struct piece *piece, int corner);
struct v2 piece_corner_mm(const struct piece *piece, int corner);

/* Larger or smaller by a factor an axis (0.05 to 20) about a place that stays. */
const char *piece_scale(struct piece *piece, struct v2 factor, struct v2 about_mm);

/* The corner moves; both edges that meet there turn and stretch with it, straight ones stay
 * straight. */
const char *piece_move_corner(struct piece *piece, int corner, struct v2 to_mm);

/* The edge bends so that its middle lies there; one that comes out nearly straight is straight. */
const char *piece_bend(struct piece *piece, int edge, struct v2 middle_mm);

/* A new corner at a share of the edge's length: edge becomes edge and edge + 1. */
const char *piece_split(struct piece *piece, int edge, float fraction);

/* The corner goes: two straight edges become one, others one even curve, edge corner - 1. */
const char *piece_join(struct piece *piece, int corner);

/* The edge as long as wanted, stretched from its `fixed` end: 0 its start, 1 its end, else its
 * middle. */
const char *piece_resize_edge(struct piece *piece, int edge, float length_mm, int fixed);

/* ---- pattern_fold.c ---- */

/* Cuts the piece along its axis and lays one half over as the other (side: +1 what lies to the left
 * of the axis' direction stays, -1 the right, 0 the larger). */
const char *piece_fold(struct piece *piece, int side);

struct v2 piece_reflect(const struct piece *piece, struct v2 local_mm);
/* Over the axis; -1: no such corner or edge. One on the axis is its own. */
int piece_other_corner(const struct piece *piece, int corner);
int piece_other_edge(const struct piece *piece, int edge);

/* The nearest place on the axis. */
struct v2 piece_onto_axis(const struct piece *piece, struct v2 local_mm);

/* ---- ready shapes ---- */

/* Between two opposite places, about the origin; four edges, counter-clockwise. */
void piece_rectangle(struct piece *piece, struct v2 size_mm);
void piece_ellipse(struct piece *piece, struct v2 size_mm);

#endif
