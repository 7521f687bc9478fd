/* Growth: cloth continues the cloth that already lies there, ring by ring (S13; the paper's figure
 * 8, left). A vertex is placed where each placed triangle across an edge, unfolded flat, would have
 * it; several predictions are averaged. */
#include "dress_private.h"

/* Edges by the vertices that they will have once sewn, each under its lower one: cloth grows across
 * seams as it does across any edge. */
void wrap_grow_init(struct wrap *wrap)
{
	struct wrap_scratch *s = wrap->scratch;
	const struct garment *garment = wrap->cloth->garment;
	memset(s->edge_first, 0, (size_t)(garment->vertex_count + 2) * sizeof *s->edge_first);
	for (int pass = 0; pass < 2; pass++) {
		for (int t = 0; t < garment->triangle_count; t++)
			for (int k = 0; k < 3; k++) {
				const int *v = garment->triangle[t].v, *weld = garment->weld;
				int low = int_min(weld[v[k]], weld[v[(k + 1) % 3]]);
				if (pass == 0)
					s->edge_first[low + 2]++;
				else
					s->edge_triangle[s->edge_first[low + 1]++] = 3 * t + k;
			}
		for (int v = 0; pass == 0 && v < garment->vertex_count; v++)
			s->edge_first[v + 2] += s->edge_first[v + 1];
	}
}

/* A piece without a mark is entered over its seams: a vertex takes the place of its sewn twin. */
static int enter_pieces(struct wrap *wrap)
{
	struct cloth *cloth = wrap->cloth;
	const struct garment *garment = cloth->garment;
	int placed = 0;
	for (int i = 0; i < 2 * garment->pair_count; i++) {
		const struct seam_pair *pair = &garment->pair[i / 2];
		int from = i & 1 ? pair->b : pair->a, to = i & 1 ? pair->a : pair->b;
		if (cloth->placed[from] != 1 || cloth->placed[to] ||
		    wrap->scratch->seeded[garment->piece[to]])
			continue;
		cloth->position_m[to] = cloth->previous_m[to] = cloth->position_m[from];
		cloth_look(cloth, to);
		cloth->placed[to] = 2; /* not itself a source in this ring */
		placed++;
	}
	for (int v = 0; v < garment->vertex_count; v++)
		cloth->placed[v] = cloth->placed[v] != 0;
	return placed;
}

/* Where triangle t's corner k would lie if it went on flat from the placed triangle `across` the
 * opposite edge a -> b. */
static struct v3 unfolded(const struct wrap *wrap, int t, int k, int across)
{
	const struct cloth *cloth = wrap->cloth;
	const struct garment *garment = cloth->garment;
	const int *v = garment->triangle[t].v;
	const struct v3 *x = cloth->position_m;
	const int *q = cloth->triangle[across].v, *p = cloth->triangle[t].v;
	int d = v[k], a = v[(k + 1) % 3], b = v[(k + 2) % 3];
	struct v3 normal = v3_normalize(
		v3_cross(v3_sub(x[q[1]], x[q[0]]), v3_sub(x[q[2]], x[q[0]])));
	struct v3 a_m = x[p[(k + 1) % 3]], b_m = x[p[(k + 2) % 3]];
	struct v3 edge = v3_normalize(v3_sub(b_m, a_m));
	struct v2 a_flat = cloth_flat_m(cloth, a);
	struct v2 flat = v2_sub(cloth_flat_m(cloth, b), a_flat);
	float length = v2_length(flat);
	struct v2 u = v2_scale(flat, 1.0f / float_max(length, 1e-6f));
	struct v2 to = v2_sub(cloth_flat_m(cloth, d), a_flat);
	struct v3 middle = v3_lerp(a_m, b_m, 0.5f);
	struct v3 left = v3_normalize(v3_cross(normal, edge));
	struct v3 flat_on = v3_mad(v3_mad(middle, edge, v2_dot(to, u) - 0.5f * length), left,
				   v2_cross(u, to));
	return wrap_curl(wrap, garment->triangle_piece[t], middle, flat_on);
}

/* Does cloth grow from triangle `across` into t? Over a seam only into a piece that no mark laid:
 * the sides of other seams still lie apart. */
static bool continues(const struct wrap *wrap, int t, int across)
{
	const int *piece = wrap->cloth->garment->triangle_piece;
	return across != t && triangle_placed(wrap->cloth, across) &&
	       (piece[across] == piece[t] || !wrap->scratch->seeded[piece[t]]);
}

static void predict_corner(struct wrap *wrap, int t, int k)
{
	struct wrap_scratch *s = wrap->scratch;
	const struct cloth *cloth = wrap->cloth;
	const struct triangle *triangle = cloth->garment->triangle;
	const int *weld = cloth->garment->weld;
	int d = cloth->triangle[t].v[k];
	int a = triangle[t].v[(k + 1) % 3], b = triangle[t].v[(k + 2) % 3];
	int low = int_min(weld[a], weld[b]), high = int_max(weld[a], weld[b]);
	for (int i = s->edge_first[low]; i < s->edge_first[low + 1]; i++) {
		int across = s->edge_triangle[i] / 3, j = s->edge_triangle[i] % 3;
		const int *w = triangle[across].v;
		if (int_max(weld[w[j]], weld[w[(j + 1) % 3]]) != high ||
		    !continues(wrap, t, across))
			continue;
		s->sum_m[d] = v3_add(s->sum_m[d], unfolded(wrap, t, k, across));
		s->count[d]++;
	}
}

int wrap_grow_ring(struct wrap *wrap)
{
	struct wrap_scratch *s = wrap->scratch;
	struct cloth *cloth = wrap->cloth;
	const struct garment *garment = cloth->garment;
	int placed = enter_pieces(wrap);
	memset(s->sum_m, 0, (size_t)garment->vertex_count * sizeof *s->sum_m);
	memset(s->count, 0, (size_t)garment->vertex_count * sizeof *s->count);
	for (int t = 0; t < garment->triangle_count; t++) {
		int missing = -1, count = 0;
		for (int k = 0; k < 3; k++)
			if (!cloth->placed[cloth->triangle[t].v[k]]) {
				missing = k;
				count++;
			}
		if (count == 1)
			predict_corner(wrap, t, missing);
	}
	for (int v = 0; v < garment->vertex_count; v++) {
		if (s->count[v] == 0)
			continue;
		struct v3 place = v3_scale(s->sum_m[v], 1.0f / (float)s->count[v]);
		cloth->position_m[v] = cloth->previous_m[v] = wrap_widened(wrap, v, place);
		cloth->placed[v] = 1;
		cloth_look(cloth, v);
		placed++;
	}
	return placed;
}
