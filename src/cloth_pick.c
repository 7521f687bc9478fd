/* What readers ask of a cloth: normals to draw, the triangle under a ray, the strain meter. */
#include "cloth_private.h"

enum { MEAN_TRIANGLES = 4096 };

void cloth_normals(const struct cloth *cloth, struct v3 *normal)
{
	const struct garment *garment = cloth->garment;
	if (!garment)
		return;
	memset(normal, 0, (size_t)garment->vertex_count * sizeof *normal);
	for (int t = 0; t < garment->triangle_count; t++) {
		if (!triangle_placed(cloth, t))
			continue;
		const int *v = cloth->triangle[t].v;
		const struct v3 *x = cloth->position_m;
		struct v3 area = v3_cross(v3_sub(x[v[1]], x[v[0]]), v3_sub(x[v[2]], x[v[0]]));
		for (int k = 0; k < 3; k++)
			normal[v[k]] = v3_add(normal[v[k]], area);
	}
	for (int v = 0; v < garment->vertex_count; v++)
		if (cloth->particle[v] == v)
			normal[v] = v3_normalize(normal[v]);
	for (int v = 0; v < garment->vertex_count; v++)
		normal[v] = normal[cloth->particle[v]];
}

/* Moeller and Trumbore, both sides. */
int cloth_ray(const struct cloth *cloth, struct v3 origin_m, struct v3 direction, float *distance,
	      float weight[3])
{
	int found = -1;
	for (int t = 0; cloth->garment && t < cloth->garment->triangle_count; t++) {
		if (!triangle_placed(cloth, t))
			continue;
		const int *v = cloth->triangle[t].v;
		const struct v3 *x = cloth->position_m;
		struct v3 e1 = v3_sub(x[v[1]], x[v[0]]), e2 = v3_sub(x[v[2]], x[v[0]]);
		struct v3 p = v3_cross(direction, e2), s = v3_sub(origin_m, x[v[0]]);
		float det = v3_dot(e1, p);
		if (det == 0.0f)
			continue;
		struct v3 q = v3_cross(s, e1);
		float u = v3_dot(s, p) / det, w = v3_dot(direction, q) / det;
		float d = v3_dot(e2, q) / det;
		if (!(u >= 0.0f && w >= 0.0f && u + w <= 1.0f && d >= 0.0f) ||
		    (found >= 0 && d >= *distance))
			continue;
		found = t;
		*distance = d;
		weight[0] = 1.0f - u - w;
		weight[1] = u;
		weight[2] = w;
	}
	return found;
}

/* By the eigenvalues of F^T F, which are those of the rest metric times the edges' dot products. */
float cloth_stretch(const struct cloth *cloth, int t)
{
	const int *v = cloth->triangle[t].v;
	const float *k = cloth->scratch->rest[t].metric;
	const struct v3 *x = cloth->position_m;
	struct v3 e1 = v3_sub(x[v[1]], x[v[0]]), e2 = v3_sub(x[v[2]], x[v[0]]);
	float g11 = v3_dot(e1, e1), g12 = v3_dot(e1, e2), g22 = v3_dot(e2, e2);
	float h11 = k[0] * g11 + k[1] * g12, h12 = k[0] * g12 + k[1] * g22;
	float h21 = k[1] * g11 + k[2] * g12, h22 = k[1] * g12 + k[2] * g22;
	float half = 0.5f * (h11 - h22);
	float root = sqrtf(float_max(half * half + h12 * h21, 0.0f));
	return float_max(sqrtf(0.5f * (h11 + h22) + root) - 1.0f, 0.0f);
}

float cloth_strain_mean(const struct cloth *cloth)
{
	float sum = 0.0f;
	int count = 0, triangles = cloth->garment ? cloth->garment->triangle_count : 0;
	int stride = 1 + triangles / MEAN_TRIANGLES;
	for (int t = 0; t < triangles; t += stride) {
		if (!triangle_placed(cloth, t))
			continue;
		sum += cloth_stretch(cloth, t);
		count++;
	}
	return count > 0 ? sum / (float)count : 0.0f;
}
