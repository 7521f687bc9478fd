/* The tree for nearest points: boxes four abreast over triangles four abreast. */
#ifndef BODY_TREE_H
#define BODY_TREE_H

#include "arena.h"
#include "lanes.h"
#include "triangle.h"

/* Four boxes. A child below 0 is the block ~child of triangles; empty boxes lie beyond reach. */
struct near_node {
	struct lanes3 centre_m, half_m;
	int child[LANES];
};

/* Four triangles as a corner and the edges from it; the last block repeats one of them. */
struct near_block {
	struct lanes3 a_m, ab_m, ac_m;
	int triangle[LANES];
};

struct near_tree {
	int node_count, block_count;
	struct near_node *node;
	struct near_block *block;
};

struct near_tree *near_tree_init(struct arena *arena);

struct bvh_node;

/* Takes every second level of the binary tree whose leaves hold at most LANES triangles. */
void near_tree_build(struct near_tree *tree, const struct bvh_node *node, const int *slot,
		     const struct triangle *triangle, const struct v3 *position_m);

/* Squared distances of a point to four boxes, to four triangles. */
static inline lanes near_boxes_d2(const struct near_node *node, struct lanes3 p)
{
	struct lanes3 d = lanes3_sub(p, node->centre_m);
	d.x = lanes_above_zero(lanes_abs(d.x) - node->half_m.x);
	d.y = lanes_above_zero(lanes_abs(d.y) - node->half_m.y);
	d.z = lanes_above_zero(lanes_abs(d.z) - node->half_m.z);
	return lanes3_dot(d, d);
}

static inline lanes near_share(lanes along, lanes length2)
{
	lanes t = lanes_above_zero(along / length2);
	return lanes_min(t, lanes_of(1.0f));
}

/* The face where the point's foot lies on it, else the nearest of the three edges. */
static inline lanes near_block_d2(const struct near_block *block, struct lanes3 p)
{
	struct lanes3 ab = block->ab_m, ac = block->ac_m;
	struct lanes3 ap = lanes3_sub(p, block->a_m), bp = lanes3_sub(ap, ab),
		      bc = lanes3_sub(ac, ab);
	lanes d1 = lanes3_dot(ab, ap), d2 = lanes3_dot(ac, ap);
	lanes abab = lanes3_dot(ab, ab), abac = lanes3_dot(ab, ac), acac = lanes3_dot(ac, ac);
	lanes det = abab * acac - abac * abac;
	struct lanes3 to_ab = lanes3_less(ap, ab, near_share(d1, abab));
	struct lanes3 to_ac = lanes3_less(ap, ac, near_share(d2, acac));
	struct lanes3 to_bc = lanes3_less(bp, bc,
					  near_share(lanes3_dot(bc, bp), lanes3_dot(bc, bc)));
	lanes edge = lanes_min(lanes_min(lanes3_dot(to_ab, to_ab), lanes3_dot(to_ac, to_ac)),
			       lanes3_dot(to_bc, to_bc));
	lanes v = (acac * d1 - abac * d2) / det, w = (abab * d2 - abac * d1) / det;
	lanes zero = lanes_of(0.0f);
	lane_mask inside = (v > zero) & (w > zero) & (v + w < lanes_of(1.0f));
	struct lanes3 to_face = lanes3_less(lanes3_less(ap, ab, v), ac, w);
	return lanes_select(inside, lanes3_dot(to_face, to_face), edge);
}

#endif
