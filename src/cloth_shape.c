/* The shape-keeping parts of a sweep (S18). */
#include "cloth_private.h"

/* The nearest rotation of a triangle's deformation gradient F (3x2), column by column, by the
 * closed form R = F S^-1, S = sqrt(F^T F) = (C + sqrt(det C) I) / sqrt(tr C + 2 sqrt(det C)), C =
 * F^T F. False for a triangle that has collapsed. */
static bool polar(struct v3 f1, struct v3 f2, struct v3 *r1, struct v3 *r2)
{
	float a = v3_dot(f1, f1), b = v3_dot(f1, f2), c = v3_dot(f2, f2);
	float det = sqrtf(float_max(a * c - b * b, 1e-10f));
	float trace = sqrtf(a + c + 2.0f * det);
	float s11 = (a + det) / trace, s12 = b / trace, s22 = (c + det) / trace;
	float s_det = s11 * s22 - s12 * s12;
	if (trace < 1e-4f || s_det < 1e-5f)
		return false;
	float scale = 1.0f / s_det;
	*r1 = v3_scale(v3_sub(v3_scale(f1, s22), v3_scale(f2, s12)), scale);
	*r2 = v3_scale(v3_sub(v3_scale(f2, s11), v3_scale(f1, s12)), scale);
	return true;
}

static void shape_triangle(struct cloth *cloth, int t, float share)
{
	const int *v = cloth->triangle[t].v;
	const struct rest *rest = &cloth->scratch->rest[t];
	struct v3 *x = cloth->position_m;
	struct v3 e1 = v3_sub(x[v[1]], x[v[0]]), e2 = v3_sub(x[v[2]], x[v[0]]);
	struct v3 f1 = v3_mad(v3_scale(e1, rest->inverse[0]), e2, rest->inverse[2]);
	struct v3 f2 = v3_mad(v3_scale(e1, rest->inverse[1]), e2, rest->inverse[3]);
	struct v3 r1, r2;
	if (!polar(f1, f2, &r1, &r2))
		return;
	struct v3 g1 = v3_mad(v3_scale(r1, rest->u1.x), r2, rest->u1.y);
	struct v3 g2 = v3_mad(v3_scale(r1, rest->u2.x), r2, rest->u2.y);
	/* the centre stays: corner a moves by the difference of the means */
	struct v3 d = v3_scale(v3_sub(v3_add(e1, e2), v3_add(g1, g2)), 1.0f / 3.0f);
	x[v[0]] = v3_mad(x[v[0]], d, share);
	x[v[1]] = v3_mad(x[v[1]], v3_add(d, v3_sub(g1, e1)), share);
	x[v[2]] = v3_mad(x[v[2]], v3_add(d, v3_sub(g2, e2)), share);
}

/* Gauss-Seidel in scattered order, forwards and backwards in turn. */
long cloth_shape(struct cloth *cloth)
{
	int count = cloth->garment->triangle_count;
	const int *order = cloth->scratch->order;
	for (int pass = 0; pass < cloth->settings.shape_passes; pass++)
		for (int i = 0; i < count; i++) {
			int t = (cloth->sweep + pass) & 1 ? order[i] : order[count - 1 - i];
			if (triangle_placed(cloth, t))
				shape_triangle(cloth, t, cloth->settings.shape);
		}
	return (long)count * cloth->settings.shape_passes;
}

/* Where a fold was turned back the cloth bends less, or the fold would come again. */
static const float stiff_flatness = 0.3f;

long cloth_flatten(struct cloth *cloth)
{
	const uint8_t *stiff = cloth->scratch->stiff;
	float flatness = cloth->settings.flatness;
	struct v3 *x = cloth->position_m;
	if (flatness <= 0.0f)
		return 0;
	for (int i = 0; i < cloth->flat_count; i++) {
		const struct flat *flat = &cloth->flat[i];
		const int *v = flat->v;
		if (!cloth->placed[v[0]] || !cloth->placed[v[1]] || !cloth->placed[v[2]] ||
		    !cloth->placed[v[3]])
			continue;
		struct v3 bend = v3_scale(x[v[0]], flat->k[0]);
		for (int k = 1; k < 4; k++)
			bend = v3_mad(bend, x[v[k]], flat->k[k]);
		bool firm = stiff[v[0]] && stiff[v[1]] && flatness < stiff_flatness;
		bend = v3_scale(bend, (firm ? stiff_flatness : flatness) / flat->k_norm);
		for (int k = 0; k < 4; k++)
			x[v[k]] = v3_mad(x[v[k]], bend, -flat->k[k]);
	}
	return cloth->flat_count;
}

long cloth_reach(struct cloth *cloth)
{
	struct v3 *x = cloth->position_m;
	float half = 0.5f * cloth->settings.reach;
	if (half <= 0.0f)
		return 0;
	for (int i = 0; i < cloth->reach_count; i++) {
		const struct reach *reach = &cloth->reach[i];
		int a = cloth->particle[reach->a], b = cloth->particle[reach->b];
		if (!cloth->placed[a] || !cloth->placed[b])
			continue;
		struct v3 d = v3_sub(x[b], x[a]);
		float length = v3_length(d);
		if (length <= reach->length_m)
			continue;
		d = v3_scale(d, half * (length - reach->length_m) / length);
		x[a] = v3_add(x[a], d);
		x[b] = v3_sub(x[b], d);
	}
	return cloth->reach_count;
}
