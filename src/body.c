/* The body as a mesh: checks, neighbours, normals, and the tree for exact queries. */
#include "body.h"

#include "body_private.h"
#include "body_tree.h"

enum { LEAF_TRIANGLES = LANES };

void body_init(struct body *body, struct arena *arena)
{
	memset(body, 0, sizeof *body);
	body->position_m = ARENA_ARRAY(arena, struct v3, BODY_VERTICES_MAX);
	body->normal = ARENA_ARRAY(arena, struct v3, BODY_VERTICES_MAX);
	body->triangle = ARENA_ARRAY(arena, struct triangle, BODY_TRIANGLES_MAX);
	body->face_normal = ARENA_ARRAY(arena, struct v3, BODY_TRIANGLES_MAX);
	body->neighbour = ARENA_ARRAY(arena, int, 3 * BODY_TRIANGLES_MAX);
	body->star_first = ARENA_ARRAY(arena, int, BODY_VERTICES_MAX + 1);
	body->star = ARENA_ARRAY(arena, int, 3 * BODY_TRIANGLES_MAX);
	body->part = ARENA_ARRAY(arena, uint8_t, BODY_TRIANGLES_MAX);
	body->node = ARENA_ARRAY(arena, struct bvh_node, BODY_NODES_MAX);
	body->node_triangle = ARENA_ARRAY(arena, int, BODY_TRIANGLES_MAX);
	body->near = near_tree_init(arena);
	body->prism = ARENA_ARRAY(arena, struct prism, BODY_TRIANGLES_MAX);
	body->clear = ARENA_ARRAY(arena, struct ball, BODY_TRIANGLES_MAX);
	body->corner_clear = ARENA_ARRAY(arena, struct ball, BODY_VERTICES_MAX);
	struct body_scratch *scratch = ARENA_ARRAY(arena, struct body_scratch, 1);
	scratch->centre_m = ARENA_ARRAY(arena, struct v3, BODY_TRIANGLES_MAX);
	scratch->fill = ARENA_ARRAY(arena, int, BODY_VERTICES_MAX);
	scratch->parts = parts_init(arena);
	scratch->landmarks = landmark_init(arena);
	body->scratch = scratch;
}

/* ---- checks ---- */

static const char *take_mesh(struct body *body, const struct v3 *position_m, int vertex_count,
			     const struct triangle *triangle, int triangle_count)
{
	body->vertex_count = 0;
	body->triangle_count = 0;
	if (vertex_count < 4 || triangle_count < 4)
		return "the body has no closed surface: it needs at least 4 triangles";
	if (vertex_count > BODY_VERTICES_MAX || triangle_count > BODY_TRIANGLES_MAX)
		return "the body has too many triangles (65536 vertices, 131072 triangles fit); "
		       "simplify it";
	for (int v = 0; v < vertex_count; v++) {
		const struct v3 *p = &position_m[v];
		if (!(float_abs(p->x) < 100.0f && float_abs(p->y) < 100.0f &&
		      float_abs(p->z) < 100.0f))
			return "a vertex lies more than 100 m away or is not a number";
	}
	for (int t = 0; t < triangle_count; t++) {
		const int *v = triangle[t].v;
		for (int k = 0; k < 3; k++)
			if (v[k] < 0 || v[k] >= vertex_count)
				return "a triangle uses a vertex that does not exist";
		if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0])
			return "a triangle uses a vertex twice";
	}
	memmove(body->position_m, position_m, (size_t)vertex_count * sizeof *position_m);
	memmove(body->triangle, triangle, (size_t)triangle_count * sizeof *triangle);
	body->vertex_count = vertex_count;
	body->triangle_count = triangle_count;
	return NULL;
}

static void build_stars(struct body *body)
{
	struct body_scratch *scratch = body->scratch;
	memset(body->star_first, 0, (size_t)(body->vertex_count + 1) * sizeof *body->star_first);
	for (int t = 0; t < body->triangle_count; t++)
		for (int k = 0; k < 3; k++)
			body->star_first[body->triangle[t].v[k] + 1]++;
	for (int v = 0; v < body->vertex_count; v++) {
		body->star_first[v + 1] += body->star_first[v];
		scratch->fill[v] = body->star_first[v];
	}
	for (int t = 0; t < body->triangle_count; t++)
		for (int k = 0; k < 3; k++)
			body->star[scratch->fill[body->triangle[t].v[k]]++] = t;
}

/* The only triangle with the directed edge a -> b; -1: none, -2: several. */
static int edge_triangle(const struct body *body, int a, int b)
{
	int found = -1;
	for (int i = body->star_first[a]; i < body->star_first[a + 1]; i++) {
		const int *v = body->triangle[body->star[i]].v;
		for (int k = 0; k < 3; k++)
			if (v[k] == a && v[(k + 1) % 3] == b)
				found = found == -1 ? body->star[i] : -2;
	}
	return found;
}

static const char *find_neighbours(struct body *body)
{
	for (int t = 0; t < body->triangle_count; t++)
		for (int k = 0; k < 3; k++) {
			int a = body->triangle[t].v[k], b = body->triangle[t].v[(k + 1) % 3];
			int across = edge_triangle(body, b, a);
			if (across == -2 || edge_triangle(body, a, b) != t)
				return "an edge has more than two triangles, or two that face "
				       "opposite ways; mend the mesh";
			if (across == -1)
				return "the surface is open: an edge has one triangle only; close "
				       "the holes";
			body->neighbour[3 * t + k] = across;
		}
	return NULL;
}

/* Divergence theorem; in double, since a body stands far from where it balances. */
static double volume_m3(const struct body *body)
{
	double sum = 0.0;
	for (int t = 0; t < body->triangle_count; t++) {
		const int *v = body->triangle[t].v;
		struct v3 c = v3_cross(body->position_m[v[1]], body->position_m[v[2]]);
		sum += (double)v3_dot(body->position_m[v[0]], c) / 6.0;
	}
	return sum;
}

static void turn_inside_out(struct body *body)
{
	for (int t = 0; t < body->triangle_count; t++) {
		int *v = body->triangle[t].v;
		int swap = v[1];
		v[1] = v[2];
		v[2] = swap;
	}
}

/* ---- normals ---- */

/* Angle-weighted vertex normals (Thuermer and Wuethrich 1998; Baerentzen and Aanaes 2005 show that
 * they give the right sign of distance). */
void body_build_normals(struct body *body)
{
	memset(body->normal, 0, (size_t)body->vertex_count * sizeof *body->normal);
	for (int t = 0; t < body->triangle_count; t++) {
		const int *v = body->triangle[t].v;
		const struct v3 *p = body->position_m;
		struct v3 n = v3_normalize(
			v3_cross(v3_sub(p[v[1]], p[v[0]]), v3_sub(p[v[2]], p[v[0]])));
		body->face_normal[t] = n;
		struct v3 edge[3];
		for (int k = 0; k < 3; k++)
			edge[k] = v3_normalize(v3_sub(p[v[(k + 1) % 3]], p[v[k]]));
		for (int k = 0; k < 3; k++) {
			float angle_rad = angle_acos(-v3_dot(edge[k], edge[(k + 2) % 3]));
			body->normal[v[k]] = v3_mad(body->normal[v[k]], n, angle_rad);
		}
	}
	for (int v = 0; v < body->vertex_count; v++)
		body->normal[v] = v3_normalize(body->normal[v]);
}

/* ---- the tree ---- */

static float axis_of(struct v3 p, int axis)
{
	return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

static void grow(struct v3 *low, struct v3 *high, struct v3 p)
{
	*low = (struct v3){float_min(low->x, p.x), float_min(low->y, p.y), float_min(low->z, p.z)};
	*high = (struct v3){float_max(high->x, p.x), float_max(high->y, p.y),
			    float_max(high->z, p.z)};
}

static void bound_node(const struct body *body, struct bvh_node *node, int first, int count)
{
	node->low_m = (struct v3){1e9f, 1e9f, 1e9f};
	node->high_m = (struct v3){-1e9f, -1e9f, -1e9f};
	for (int i = first; i < first + count; i++)
		for (int k = 0; k < 3; k++) {
			int v = body->triangle[body->node_triangle[i]].v[k];
			grow(&node->low_m, &node->high_m, body->position_m[v]);
		}
}

/* Ties by number, so that the tree is the same everywhere. */
static bool centre_before(const struct v3 *centre, int a, int b, int axis)
{
	float pa = axis_of(centre[a], axis), pb = axis_of(centre[b], axis);
	return pa < pb || (pa == pb && a < b);
}

/* Hoare's selection: item[middle] gets its place in the order along the axis. */
static void select_middle(int *item, int count, int middle, const struct v3 *centre, int axis)
{
	int low = 0, high = count - 1;
	while (low < high) {
		int pivot = item[(low + high) / 2], i = low, j = high;
		while (i <= j) {
			while (centre_before(centre, item[i], pivot, axis))
				i++;
			while (centre_before(centre, pivot, item[j], axis))
				j--;
			if (i <= j) {
				int swap = item[i];
				item[i++] = item[j];
				item[j--] = swap;
			}
		}
		if (middle <= j)
			high = j;
		else if (middle >= i)
			low = i;
		else
			return;
	}
}

static int longest_axis(const int *item, int count, const struct v3 *centre)
{
	struct v3 low = {1e9f, 1e9f, 1e9f}, high = {-1e9f, -1e9f, -1e9f};
	for (int i = 0; i < count; i++)
		grow(&low, &high, centre[item[i]]);
	struct v3 size = v3_sub(high, low);
	return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
}

/* Half of the triangles, but whole leaves of them: full leaves are fewer. */
static int middle_of(int count)
{
	int leaves = (count + LEAF_TRIANGLES - 1) / LEAF_TRIANGLES;
	return leaves / 2 * LEAF_TRIANGLES;
}

/* Median splits, breadth first: node n's triangles are slots [first, first + count) while it waits.
 */
static void build_tree(struct body *body)
{
	struct body_scratch *scratch = body->scratch;
	for (int t = 0; t < body->triangle_count; t++) {
		const int *v = body->triangle[t].v;
		struct v3 sum = v3_add(v3_add(body->position_m[v[0]], body->position_m[v[1]]),
				       body->position_m[v[2]]);
		scratch->centre_m[t] = v3_scale(sum, 1.0f / 3.0f);
		body->node_triangle[t] = t;
	}
	body->node_count = 1;
	body->node[0].first = 0;
	body->node[0].count = body->triangle_count;
	for (int n = 0; n < body->node_count; n++) {
		struct bvh_node *node = &body->node[n];
		int first = node->first, count = node->count;
		bound_node(body, node, first, count);
		if (count <= LEAF_TRIANGLES)
			continue;
		int *item = body->node_triangle + first, half = middle_of(count);
		select_middle(item, count, half, scratch->centre_m,
			      longest_axis(item, count, scratch->centre_m));
		MUST(body->node_count + 2 <= BODY_NODES_MAX);
		node->first = body->node_count;
		node->count = 0;
		body->node[body->node_count].first = first;
		body->node[body->node_count++].count = half;
		body->node[body->node_count].first = first + half;
		body->node[body->node_count++].count = count - half;
	}
	near_tree_build(body->near, body->node, body->node_triangle, body->triangle,
			body->position_m);
	body->low_m = body->node[0].low_m;
	body->high_m = body->node[0].high_m;
}

void body_refit(struct body *body)
{
	for (int n = body->node_count - 1; n >= 0; n--) {
		struct bvh_node *node = &body->node[n];
		if (node->count > 0) {
			bound_node(body, node, node->first, node->count);
			continue;
		}
		const struct bvh_node *child = &body->node[node->first];
		node->low_m = child[0].low_m;
		node->high_m = child[0].high_m;
		grow(&node->low_m, &node->high_m, child[1].low_m);
		grow(&node->low_m, &node->high_m, child[1].high_m);
	}
	near_tree_build(body->near, body->node, body->node_triangle, body->triangle,
			body->position_m);
	body->low_m = body->node[0].low_m;
	body->high_m = body->node[0].high_m;
}

static uint64_t hash_mesh(const struct body *body)
{
	struct hash hash;
	hash_init(&hash);
	for (int v = 0; v < body->vertex_count; v++) {
		hash_float(&hash, body->position_m[v].x);
		hash_float(&hash, body->position_m[v].y);
		hash_float(&hash, body->position_m[v].z);
	}
	for (int t = 0; t < body->triangle_count; t++)
		for (int k = 0; k < 3; k++)
			hash_int(&hash, body->triangle[t].v[k]);
	return hash.value;
}

const char *body_build(struct body *body, const struct v3 *position_m, int vertex_count,
		       const struct triangle *triangle, int triangle_count)
{
	const char *fault = take_mesh(body, position_m, vertex_count, triangle, triangle_count);
	if (!fault) {
		build_stars(body);
		fault = find_neighbours(body);
	}
	double volume = fault ? 0.0 : volume_m3(body);
	if (!fault && volume > -1e-6 && volume < 1e-6)
		fault = "the body has no volume; is it flat, or half of it inside out?";
	if (fault) {
		body->vertex_count = 0;
		body->triangle_count = 0;
		return fault;
	}
	if (volume < 0.0) {
		turn_inside_out(body);
		find_neighbours(body);
	}
	body_build_normals(body);
	body_build_prisms(body);
	build_tree(body);
	body_find_clear(body);
	memset(body->part, PART_TRUNK, (size_t)body->triangle_count);
	body->bone_count = 0;
	memset(body->landmark, 0, sizeof body->landmark);
	body->hash = hash_mesh(body);
	return NULL;
}
