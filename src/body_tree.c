/* The wide tree: two levels of the binary one in each of its own. */
#include "body_tree.h"

#include "body.h"

enum {
	/* leaves are full but for the last; a wide node has four children but above two leaves,
	 * so that two nodes go to three leaves at most */
	BLOCKS_MAX = BODY_TRIANGLES_MAX / LANES + 1,
	NEAR_NODES_MAX = 2 * BLOCKS_MAX / 3 + 2,
};

static const float beyond_m = 1e9f;
static const float slack_m = 1e-6f; /* more than rounding takes from a box within 100 m */

struct near_tree *near_tree_init(struct arena *arena)
{
	struct near_tree *tree = ARENA_ARRAY(arena, struct near_tree, 1);
	tree->node = ARENA_ARRAY(arena, struct near_node, NEAR_NODES_MAX);
	tree->block = ARENA_ARRAY(arena, struct near_block, BLOCKS_MAX);
	return tree;
}

static void set_lane(struct lanes3 *wide, int lane, struct v3 p)
{
	wide->x[lane] = p.x;
	wide->y[lane] = p.y;
	wide->z[lane] = p.z;
}

static int add_block(struct near_tree *tree, const struct bvh_node *leaf, const int *slot,
		     const struct triangle *triangle, const struct v3 *position_m)
{
	MUST(tree->block_count < BLOCKS_MAX && leaf->count <= LANES);
	struct near_block *block = &tree->block[tree->block_count];
	for (int k = 0; k < LANES; k++) {
		int t = slot[leaf->first + int_min(k, leaf->count - 1)];
		const int *v = triangle[t].v;
		struct v3 a = position_m[v[0]];
		set_lane(&block->a_m, k, a);
		set_lane(&block->ab_m, k, v3_sub(position_m[v[1]], a));
		set_lane(&block->ac_m, k, v3_sub(position_m[v[2]], a));
		block->triangle[k] = t;
	}
	return tree->block_count++;
}

static void set_box(struct near_node *wide, int lane, const struct bvh_node *node)
{
	struct v3 centre = v3_lerp(node->low_m, node->high_m, 0.5f);
	struct v3 half = v3_sub(node->high_m, centre), below = v3_sub(centre, node->low_m);
	half = (struct v3){float_max(half.x, below.x) + slack_m,
			   float_max(half.y, below.y) + slack_m,
			   float_max(half.z, below.z) + slack_m};
	set_lane(&wide->centre_m, lane, centre);
	set_lane(&wide->half_m, lane, half);
}

/* The binary nodes that become the children of one wide node: the larger is opened first. */
static int gather(const struct bvh_node *node, int root, int child[LANES])
{
	int count = 0;
	child[count++] = root;
	for (int k = 0; k < count && count < LANES;) {
		const struct bvh_node *at = &node[child[k]];
		if (at->count > 0 || (k == 0 && count == 3)) {
			k++;
			continue;
		}
		child[k] = at->first;
		child[count++] = at->first + 1;
	}
	return count;
}

/* Breadth first: child[0] of a waiting node holds its binary root. */
void near_tree_build(struct near_tree *tree, const struct bvh_node *node, const int *slot,
		     const struct triangle *triangle, const struct v3 *position_m)
{
	tree->block_count = 0;
	tree->node_count = 1;
	tree->node[0].child[0] = 0;
	for (int n = 0; n < tree->node_count; n++) {
		struct near_node *wide = &tree->node[n];
		int child[LANES], count = gather(node, wide->child[0], child);
		for (int k = 0; k < LANES; k++) {
			if (k >= count) {
				set_lane(&wide->centre_m, k,
					 (struct v3){beyond_m, beyond_m, beyond_m});
				set_lane(&wide->half_m, k, (struct v3){0.0f, 0.0f, 0.0f});
				wide->child[k] = 0;
				continue;
			}
			const struct bvh_node *at = &node[child[k]];
			set_box(wide, k, at);
			if (at->count > 0) {
				wide->child[k] = ~add_block(tree, at, slot, triangle, position_m);
				continue;
			}
			MUST(tree->node_count < NEAR_NODES_MAX);
			wide->child[k] = tree->node_count;
			tree->node[tree->node_count++].child[0] = child[k];
		}
	}
}
