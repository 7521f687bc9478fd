/* The order of triangles and vertices that a vertex cache likes. Software renderers shade vertices
 * in batches and remember only the last few hundred: a mesh in scattered order is shaded three
 * times over. Neighbours in space become neighbours in memory (Morton 1966). */
#include "draw_private.h"

static uint32_t spread(uint32_t x)
{
	x &= 0x3ff;
	x = (x | x << 16) & 0x030000ff;
	x = (x | x << 8) & 0x0300f00f;
	x = (x | x << 4) & 0x030c30c3;
	return (x | x << 2) & 0x09249249;
}

static uint32_t morton(struct v3 p, struct v3 low, float cells_per_m)
{
	uint32_t code = 0;
	const float at[3] = {p.x - low.x, p.y - low.y, p.z - low.z};
	for (int i = 0; i < 3; i++)
		code |= spread((uint32_t)int_clamp((int)(at[i] * cells_per_m), 0, 1023)) << i;
	return code;
}

/* Sorts `order` by key, least significant byte first; four passes end where they began. */
static void radix_sort(uint32_t *key, int *order, uint32_t *key_2, int *order_2, int count)
{
	for (int shift = 0; shift < 32; shift += 8) {
		int start[257] = {0};
		for (int i = 0; i < count; i++)
			start[(key[i] >> shift & 255) + 1]++;
		for (int b = 0; b < 256; b++)
			start[b + 1] += start[b];
		for (int i = 0; i < count; i++) {
			int to = start[key[i] >> shift & 255]++;
			key_2[to] = key[i];
			order_2[to] = order[i];
		}
		uint32_t *key_keep = key;
		int *order_keep = order;
		key = key_2;
		order = order_2;
		key_2 = key_keep;
		order_2 = order_keep;
	}
}

void mesh_order(struct mesh_order *mesh, const struct v3 *position_m, int vertex_count,
		const struct triangle *triangle, int triangle_count)
{
	struct v3 low = {1e9f, 1e9f, 1e9f}, high = {-1e9f, -1e9f, -1e9f};
	for (int v = 0; v < vertex_count; v++) {
		struct v3 p = position_m[v];
		low = (struct v3){float_min(low.x, p.x), float_min(low.y, p.y),
				  float_min(low.z, p.z)};
		high = (struct v3){float_max(high.x, p.x), float_max(high.y, p.y),
				   float_max(high.z, p.z)};
		mesh->rank[v] = -1;
	}
	float span = float_max(float_max(high.x - low.x, high.y - low.y), high.z - low.z);
	for (int t = 0; t < triangle_count; t++) {
		mesh->triangle[t] = t;
		mesh->key[t] = morton(position_m[triangle[t].v[0]], low,
				      1023.0f / float_max(span, 1e-6f));
	}
	radix_sort(mesh->key, mesh->triangle, mesh->key_2, mesh->triangle_2, triangle_count);
	int next = 0;
	for (int i = 0; i < triangle_count; i++)
		for (int k = 0; k < 3; k++) {
			int v = triangle[mesh->triangle[i]].v[k];
			if (mesh->rank[v] < 0)
				mesh->rank[v] = next++;
		}
	for (int v = 0; v < vertex_count; v++)
		if (mesh->rank[v] < 0)
			mesh->rank[v] = next++;
}

int mesh_coarsen(struct mesh_order *mesh, const struct v3 *position_m, int vertex_count,
		 float cell_m, struct v3 *coarse_m)
{
	struct v3 low = {1e9f, 1e9f, 1e9f}, sum = {0};
	int clusters = 0, members = 0;
	for (int v = 0; v < vertex_count; v++) {
		struct v3 p = position_m[v];
		low = (struct v3){float_min(low.x, p.x), float_min(low.y, p.y),
				  float_min(low.z, p.z)};
	}
	for (int v = 0; v < vertex_count; v++) {
		mesh->triangle[v] = v;
		mesh->key[v] = morton(position_m[v], low, 1.0f / cell_m);
	}
	radix_sort(mesh->key, mesh->triangle, mesh->key_2, mesh->triangle_2, vertex_count);
	for (int i = 0; i < vertex_count; i++) {
		int v = mesh->triangle[i];
		if (i == 0 || mesh->key[i] != mesh->key[i - 1]) {
			clusters++;
			members = 0;
			sum = (struct v3){0};
		}
		sum = v3_add(sum, position_m[v]);
		members++;
		coarse_m[clusters - 1] = v3_scale(sum, 1.0f / (float)members);
		mesh->rank[v] = clusters - 1;
	}
	return clusters;
}
