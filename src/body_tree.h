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

lanes near_block_d2(const struct near_block *block, struct lanes3 p);

#endif
