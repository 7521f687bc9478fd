/* What readers ask of a cloth: normals to draw, the triangle under a ray, the strain meter. */
#include "cloth_private.h"

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

/* By the eigenvalues of F^T F. */
float cloth_stretch(const struct cloth *cloth, int t)
{
	const int *v = cloth->triangle[t].v;
	const struct rest *rest = &cloth->scratch->rest[t];
	const struct v3 *x = cloth->position_m;
	struct v3 e1 = v3_sub(x[v[1]], x[v[0]]), e2 = v3_sub(x[v[2]], x[v[0]]);
	struct v3 f1 = v3_mad(v3_scale(e1, rest->inverse[0]), e2, rest->inverse[2]);
	struct v3 f2 = v3_mad(v3_scale(e1, rest->inverse[1]), e2, rest->inverse[3]);
	float a = v3_dot(f1, f1), b = v3_dot(f1, f2), c = v3_dot(f2, f2);
	float root = sqrtf(0.25f * (a - c) * (a - c) + b * b);
	return float_max(sqrtf(0.5f * (a + c) + root) - 1.0f, 0.0f);
}

float cloth_strain_mean(const struct cloth *cloth)
{
	float sum = 0.0f;
	int count = 0;
	for (int t = 0; cloth->garment && t < cloth->garment->triangle_count; t++) {
		if (!triangle_placed(cloth, t))
			continue;
		sum += cloth_stretch(cloth, t);
		count++;
	}
	return count > 0 ? sum / (float)count : 0.0f;
}
