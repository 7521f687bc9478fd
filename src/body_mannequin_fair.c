#include "mannequin_fair.h"

#define EDGE_MAX_M 0.045f /* longer than any edge of the sheet */

static bool on_rim(const struct sheet *sheet, int vertex)
{
	return sheet->position_m[vertex].x == 0.0f;
}

/* Everything that a spot's vertices need: their neighbours and the neighbours of those. */
static void choose(const struct sheet *sheet, struct fair *fair, struct v3 middle_m, float radius_m)
{
	fair->vertex_count = 0;
	fair->triangle_count = 0;
	for (int v = 0; v < sheet->vertex_count; v++) {
		fair->valence[v] = 0;
		if (v3_distance(sheet->position_m[v], middle_m) < radius_m + 2.0f * EDGE_MAX_M)
			fair->vertex[fair->vertex_count++] = v;
	}
	for (int t = 0; t < sheet->triangle_count; t++) {
		float nearest = 1e9f;
		for (int k = 0; k < 3; k++) {
			int v = sheet->triangle[t].v[k];
			float d = v3_distance(sheet->position_m[v], middle_m);
			nearest = float_min(nearest, d);
			fair->valence[v] += on_rim(sheet, v) ? 2 : 1;
		}
		if (nearest < radius_m + EDGE_MAX_M)
			fair->triangle[fair->triangle_count++] = t;
	}
}

/* out = middle of the neighbours minus the vertex, of a vector field that the mirror x -> -x maps
 * to itself. In a fan of triangles each neighbour starts exactly one edge a -> next; at the rim
 * x = 0 the mirrored triangles supply the other half. */
static void laplacian(const struct sheet *sheet, const struct fair *fair, const struct v3 *field,
		      struct v3 *out)
{
	for (int i = 0; i < fair->vertex_count; i++)
		out[fair->vertex[i]] = (struct v3){0};
	for (int i = 0; i < fair->triangle_count; i++) {
		const int *v = sheet->triangle[fair->triangle[i]].v;
		for (int k = 0; k < 3; k++) {
			int a = v[k];
			out[a] = v3_add(out[a], field[v[(k + 1) % 3]]);
			if (on_rim(sheet, a)) {
				struct v3 image = field[v[(k + 2) % 3]];
				image.x = -image.x;
				out[a] = v3_add(out[a], image);
			}
		}
	}
	for (int i = 0; i < fair->vertex_count; i++) {
		int v = fair->vertex[i];
		out[v] = v3_sub(v3_scale(out[v], 1.0f / (float)fair->valence[v]), field[v]);
		if (on_rim(sheet, v))
			out[v].x = 0.0f;
	}
}

static float spot_weight(const struct fair_spot *spot, struct v3 position_m)
{
	float d = v3_distance(position_m, spot->middle_m);
	float t = float_clamp(1.6f * (1.0f - d / spot->radius_m), 0.0f, 1.0f);
	return t * t * (3.0f - 2.0f * t);
}

void fair_bend(struct sheet *sheet, struct fair *fair, const struct fair_spot *spot)
{
	const float damping = 0.22f; /* below 1 / 4, the stable limit */
	choose(sheet, fair, spot->middle_m, spot->radius_m);
	for (int round = 0; round < spot->rounds; round++) {
		laplacian(sheet, fair, sheet->position_m, fair->sum);
		laplacian(sheet, fair, fair->sum, fair->bend);
		for (int i = 0; i < fair->vertex_count; i++) {
			struct v3 *p = &sheet->position_m[fair->vertex[i]];
			float weight = damping * spot_weight(spot, *p);
			*p = v3_mad(*p, fair->bend[fair->vertex[i]], -weight);
		}
	}
}

static void vertex_normals(const struct sheet *sheet, struct v3 *normal)
{
	for (int v = 0; v < sheet->vertex_count; v++)
		normal[v] = (struct v3){0};
	for (int t = 0; t < sheet->triangle_count; t++) {
		const int *v = sheet->triangle[t].v;
		struct v3 a = sheet->position_m[v[0]];
		struct v3 n = v3_cross(v3_sub(sheet->position_m[v[1]], a),
				       v3_sub(sheet->position_m[v[2]], a));
		for (int k = 0; k < 3; k++)
			normal[v[k]] = v3_add(normal[v[k]], n);
	}
	for (int v = 0; v < sheet->vertex_count; v++) {
		if (on_rim(sheet, v))
			normal[v].x = 0.0f;
		normal[v] = v3_normalize(normal[v]);
	}
}

void fair_slide(struct sheet *sheet, struct fair *fair, int rounds)
{
	choose(sheet, fair, (struct v3){0}, 9.0f);
	for (int round = 0; round < rounds; round++) {
		laplacian(sheet, fair, sheet->position_m, fair->sum);
		vertex_normals(sheet, fair->bend);
		for (int v = 0; v < sheet->vertex_count; v++) {
			struct v3 n = fair->bend[v], l = fair->sum[v];
			struct v3 along = v3_mad(l, n, -v3_dot(l, n));
			sheet->position_m[v] = v3_mad(sheet->position_m[v], along, 0.4f);
		}
	}
}
