/* Changes of edges that their seams follow. Those that return something return NULL, or why not in
 * words for the visitor; the pattern may then be half changed, so give them a copy. */
#ifndef PATTERN_SEAMS_H
#define PATTERN_SEAMS_H

#include "pattern.h"

/* A new corner on an edge. What was sewn stays sewn: the other edge is divided at the place that
 * lies against this one. */
const char *pattern_split(struct pattern *pattern, int piece, int edge, float fraction);

/* A corner goes, and one seam at most is left on the edge that two become. */
const char *pattern_join(struct pattern *pattern, int piece, int corner);

/* After an outline was drawn anew, each seam on it moves to the edge that lies nearest to the
 * middle of its old one; of two on one edge the earlier stays. */
void pattern_move_seams(struct pattern *pattern, int piece, const struct piece *old);

/* Edges that are sewn evenly become equally long again. The edge that was edited since `old` leads;
 * what follows may lead in its turn. */
void pattern_keep_even(struct pattern *pattern, const struct pattern *old);

/* The corner within 5 mm of a place in the piece's own coordinates; -1: none. */
int piece_corner_near(const struct piece *piece, struct v2 mm);

#endif
