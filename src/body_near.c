/* Nearest points: exact by the tree, warm by walking. */
#include "body_private.h"
#include "body_tree.h"

static const float narrow_m2 = 1e-9f; /* twice the area */

struct v3 body_smooth_normal(const struct body *body, int t, struct v3 q)
{
	const int *v = body->triangle[t].v;
	struct v3 a = body->position_m[v[0]], b = body->position_m[v[1]],
		  c = body->position_m[v[2]];
	struct v3 n = v3_cross(v3_sub(b, a), v3_sub(c, a));
	float area = v3_dot(n, n);
	if (area < 1e-24f)
		return body->face_normal[t];
	float wa = v3_dot(v3_cross(v3_sub(b, q), v3_sub(c, q)), n) / area;
	float wb = v3_dot(v3_cross(v3_sub(c, q), v3_sub(a, q)), n) / area;
	struct v3 sum = v3_scale(body->normal[v[0]], wa);
	sum = v3_mad(v3_mad(sum, body->normal[v[1]], wb), body->normal[v[2]], 1.0f - wa - wb);
	return v3_normalize(sum);
}

static void finish(const struct body *body, struct v3 p, const struct nearest *n,
		   struct body_hit *hit)
{
	hit->triangle = n->triangle;
	hit->point_m = n->point_m;
	hit->normal = body_smooth_normal(body, n->triangle, n->point_m);
	hit->distance_m = near_signed_m(body, p, n);
}

static void set_row(struct prism *prism, int row, struct v3 slope, float at_origin)
{
	prism->column[0][row] = slope.x;
	prism->column[1][row] = slope.y;
	prism->column[2][row] = slope.z;
	prism->column[3][row] = at_origin;
}

/* A triangle too narrow to tell has no prism: all its weights are below 0. */
void body_build_prisms(struct body *body)
{
	for (int t = 0; t < body->triangle_count; t++) {
		const int *v = body->triangle[t].v;
		struct v3 n = body->face_normal[t];
		for (int k = 0; k < 3; k++) {
			struct v3 a = body->position_m[v[(k + 1) % 3]],
				  b = body->position_m[v[(k + 2) % 3]];
			struct v3 inward = v3_cross(n, v3_sub(b, a));
			float height = v3_dot(inward, v3_sub(body->position_m[v[k]], a));
			if (height > narrow_m2) {
				struct v3 slope = v3_scale(inward, 1.0f / height);
				set_row(&body->prism[t], k, slope, -v3_dot(slope, a));
			} else {
				set_row(&body->prism[t], k, (struct v3){0}, -1.0f);
			}
		}
		set_row(&body->prism[t], 3, n, -v3_dot(n, body->position_m[v[0]]));
	}
}

/* Does the point lie where the parts asked for end? There the surface has no side. */
bool near_on_rim(const struct body *body, const struct nearest *n, unsigned parts)
{
	if (n->feature == ON_FACE)
		return false;
	if (n->feature < ON_VERTEX) {
		int across = body->neighbour[3 * n->triangle + n->feature - ON_EDGE];
		return !(parts >> body->part[across] & 1);
	}
	int v = body->triangle[n->triangle].v[n->feature - ON_VERTEX];
	for (int i = body->star_first[v]; i < body->star_first[v + 1]; i++)
		if (!(parts >> body->part[body->star[i]] & 1))
			return true;
	return false;
}

/* A node that waits, with its box's distance. */
struct waiting {
	int node;
	float d2;
};

/* Of four triangles the nearest allowed one is looked at by itself. */
static void look_block(const struct body *body, struct v3 point_m, const struct near_block *block,
		       struct lanes3 p, unsigned parts, struct nearest *best)
{
	lanes d2 = near_block_d2(block, p);
	int least = -1;
	float least_d2 = best->d2;
	for (int k = 0; k < LANES; k++)
		if (d2[k] < least_d2 && near_allowed(body, block->triangle[k], parts)) {
			least_d2 = d2[k];
			least = k;
		}
	if (least >= 0)
		near_look(body, point_m, block->triangle[least], best);
}

/* Nearer children first; what has become too far meanwhile is dropped when its turn comes. */
void near_search(const struct body *body, struct v3 point_m, unsigned parts, float share,
		 struct nearest *best)
{
	const struct near_tree *tree = body->near;
	struct waiting stack[TREE_STACK_MAX];
	struct lanes3 p = lanes3_of(point_m);
	float share2 = share * share;
	int depth = 0;
	MUST(body->triangle_count > 0);
	stack[depth++] = (struct waiting){0, 0.0f};
	while (depth > 0) {
		struct waiting top = stack[--depth];
		if (top.d2 >= share2 * best->d2)
			continue;
		if (top.node < 0) {
			look_block(body, point_m, &tree->block[~top.node], p, parts, best);
			continue;
		}
		const struct near_node *node = &tree->node[top.node];
		lanes d2 = near_boxes_d2(node, p);
		int bottom = depth;
		MUST(depth + LANES <= TREE_STACK_MAX);
		for (int k = 0; k < LANES; k++) {
			if (!(d2[k] < share2 * best->d2))
				continue;
			int at = depth++;
			for (; at > bottom && stack[at - 1].d2 < d2[k]; at--)
				stack[at] = stack[at - 1];
			stack[at] = (struct waiting){node->child[k], d2[k]};
		}
	}
}

void body_nearest_from(const struct body *body, struct v3 point_m, unsigned parts, int from,
		       struct body_hit *hit)
{
	struct nearest best = nearest_none;
	if (from >= 0 && near_allowed(body, from, parts))
		near_look(body, point_m, from, &best);
	near_search(body, point_m, parts, 1.0f, &best);
	finish(body, point_m, &best, hit);
	if (parts && near_on_rim(body, &best, parts))
		hit->distance_m = sqrtf(best.d2) + near_rim_m;
}

void body_nearest(const struct body *body, struct v3 point_m, unsigned parts, struct body_hit *hit)
{
	body_nearest_from(body, point_m, parts, -1, hit);
}

int body_walk(const struct body *body, struct v3 point_m, int from, int steps_max,
	      struct body_hit *hit)
{
	struct nearest best = nearest_none;
	int looked = near_descend(body, point_m, 0, from, steps_max, &best);
	finish(body, point_m, &best, hit);
	return looked;
}
