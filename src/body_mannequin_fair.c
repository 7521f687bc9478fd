#include "mannequin_fair.h"

/* out = middle of the neighbours minus the vertex, of any vector field that the mirror x -> -x maps
 * to itself. In a fan of triangles each neighbour starts exactly one edge a -> next; at the rim
 * x = 0 the mirrored triangles supply the other half. */
static void laplacian(const struct sheet *sheet, const int *valence, const struct v3 *field,
		      struct v3 *out)
{
	for (int v = 0; v < sheet->vertex_count; v++)
		out[v] = (struct v3){0};
	for (int t = 0; t < sheet->triangle_count; t++) {
		for (int k = 0; k < 3; k++) {
			int a = sheet->triangle[t].v[k], next = sheet->triangle[t].v[(k + 1) % 3];
			out[a] = v3_add(out[a], field[next]);
			if (sheet->position_m[a].x == 0.0f) {
				struct v3 image = field[sheet->triangle[t].v[(k + 2) % 3]];
				image.x = -image.x;
				out[a] = v3_add(out[a], image);
			}
		}
	}
	for (int v = 0; v < sheet->vertex_count; v++) {
		out[v] = v3_sub(v3_scale(out[v], 1.0f / (float)valence[v]), field[v]);
		if (sheet->position_m[v].x == 0.0f)
			out[v].x = 0.0f;
	}
}

static void count_neighbours(const struct sheet *sheet, int *valence)
{
	for (int v = 0; v < sheet->vertex_count; v++)
		valence[v] = 0;
	for (int t = 0; t < sheet->triangle_count; t++)
		for (int k = 0; k < 3; k++) {
			int a = sheet->triangle[t].v[k];
			valence[a] += sheet->position_m[a].x == 0.0f ? 2 : 1;
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
	count_neighbours(sheet, fair->valence);
	for (int round = 0; round < spot->rounds; round++) {
		laplacian(sheet, fair->valence, sheet->position_m, fair->sum);
		laplacian(sheet, fair->valence, fair->sum, fair->bend);
		for (int v = 0; v < sheet->vertex_count; v++)
			sheet->position_m[v] = v3_mad(
				sheet->position_m[v], fair->bend[v],
				-damping * spot_weight(spot, sheet->position_m[v]));
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
		if (sheet->position_m[v].x == 0.0f)
			normal[v].x = 0.0f;
		normal[v] = v3_normalize(normal[v]);
	}
}

void fair_slide(struct sheet *sheet, struct fair *fair, int rounds)
{
	count_neighbours(sheet, fair->valence);
	for (int round = 0; round < rounds; round++) {
		laplacian(sheet, fair->valence, sheet->position_m, fair->sum);
		vertex_normals(sheet, fair->bend);
		for (int v = 0; v < sheet->vertex_count; v++) {
			struct v3 n = fair->bend[v], l = fair->sum[v];
			struct v3 along = v3_mad(l, n, -v3_dot(l, n));
			sheet->position_m[v] = v3_mad(sheet->position_m[v], along, 0.4f);
		}
	}
}
