/* Rays and segments against the surface. */
#include "body_private.h"

static bool ray_box(const struct bvh_node *node, struct v3 o, struct v3 inverse, float t_max)
{
	float ax = (node->low_m.x - o.x) * inverse.x, bx = (node->high_m.x - o.x) * inverse.x;
	float ay = (node->low_m.y - o.y) * inverse.y, by = (node->high_m.y - o.y) * inverse.y;
	float az = (node->low_m.z - o.z) * inverse.z, bz = (node->high_m.z - o.z) * inverse.z;
	float near = float_max(float_max(float_min(ax, bx), float_min(ay, by)),
			       float_max(float_min(az, bz), 0.0f));
	float far = float_min(float_min(float_max(ax, bx), float_max(ay, by)),
			      float_min(float_max(az, bz), t_max));
	return near <= far * 1.00001f;
}

/* A ray seen along itself: the axes are renamed so that it runs mostly along the third one, and
 * sheared so that it runs exactly along it. */
struct ray {
	struct v3 origin, inverse;
	int axis[3];
	float shear[3];
};

static float along_axis(struct v3 p, int axis)
{
	return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

static float inverse_of(float x)
{
	return float_abs(x) > 1e-12f ? 1.0f / x : x < 0.0f ? -1e12f : 1e12f;
}

/* False: the direction is zero. */
static bool ray_init(struct ray *ray, struct v3 o, struct v3 d)
{
	float x = float_abs(d.x), y = float_abs(d.y), z = float_abs(d.z);
	int main = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
	float length = along_axis(d, main);
	if (!(float_abs(length) > 1e-30f))
		return false;
	bool backward = length < 0.0f; /* keeps the sense of rotation */
	ray->origin = o;
	ray->inverse = (struct v3){inverse_of(d.x), inverse_of(d.y), inverse_of(d.z)};
	ray->axis[0] = (main + (backward ? 2 : 1)) % 3;
	ray->axis[1] = (main + (backward ? 1 : 2)) % 3;
	ray->axis[2] = main;
	ray->shear[0] = along_axis(d, ray->axis[0]) / length;
	ray->shear[1] = along_axis(d, ray->axis[1]) / length;
	ray->shear[2] = 1.0f / length;
	return true;
}

static struct v3 shear(const struct ray *ray, struct v3 p)
{
	struct v3 d = v3_sub(p, ray->origin);
	float z = along_axis(d, ray->axis[2]);
	return (struct v3){along_axis(d, ray->axis[0]) - ray->shear[0] * z,
			   along_axis(d, ray->axis[1]) - ray->shear[1] * z, ray->shear[2] * z};
}

/* No ray slips between two triangles: they judge their common edge by the same products. *front
 * says which side was hit. Woop, Benthin and Wald, "Watertight Ray/Triangle Intersection", JCGT
 * 2013. */
static bool ray_triangle(const struct body *body, int t, const struct ray *ray, float *distance,
			 bool *front)
{
	const int *v = body->triangle[t].v;
	struct v3 a = shear(ray, body->position_m[v[0]]), b = shear(ray, body->position_m[v[1]]),
		  c = shear(ray, body->position_m[v[2]]);
	float u = b.x * c.y - b.y * c.x, w = c.x * a.y - c.y * a.x, k = a.x * b.y - a.y * b.x;
	if ((u < 0.0f || w < 0.0f || k < 0.0f) && (u > 0.0f || w > 0.0f || k > 0.0f))
		return false;
	float sum = u + w + k;
	if (sum == 0.0f)
		return false;
	*distance = (u * a.z + w * b.z + k * c.z) / sum;
	*front = sum < 0.0f;
	return *distance >= 0.0f;
}

enum ray_wanted {
	RAY_FIRST_FRONT,
	RAY_FIRST_BACK,
	RAY_LAST_BACK,
	RAY_FIRST_ANY,
};

static bool cast(const struct body *body, struct v3 o, struct v3 d, float t_max,
		 enum ray_wanted wanted, struct body_hit *hit)
{
	struct ray ray;
	int stack[TREE_STACK_MAX], depth = 0, found = -1;
	float best = wanted == RAY_LAST_BACK ? -1.0f : t_max;
	MUST(body->triangle_count > 0);
	if (!ray_init(&ray, o, d))
		return false;
	stack[depth++] = 0;
	while (depth > 0) {
		const struct bvh_node *node = &body->node[stack[--depth]];
		if (!ray_box(node, o, ray.inverse, wanted == RAY_LAST_BACK ? t_max : best))
			continue;
		for (int i = 0; i < node->count; i++) {
			int t = body->node_triangle[node->first + i];
			float distance;
			bool front;
			if (!ray_triangle(body, t, &ray, &distance, &front))
				continue;
			bool nearer = distance < best || (distance == best && t < found);
			bool farther = distance > best && distance <= t_max;
			if ((wanted == RAY_FIRST_FRONT && front && nearer) ||
			    (wanted == RAY_FIRST_BACK && !front && nearer) ||
			    (wanted == RAY_FIRST_ANY && nearer) ||
			    (wanted == RAY_LAST_BACK && !front && farther)) {
				best = distance;
				found = t;
			}
		}
		if (node->count > 0)
			continue;
		MUST(depth + 2 <= TREE_STACK_MAX);
		stack[depth++] = node->first + 1;
		stack[depth++] = node->first;
	}
	if (found < 0)
		return false;
	hit->triangle = found;
	hit->point_m = v3_mad(o, d, best);
	hit->normal = body_smooth_normal(body, found, hit->point_m);
	hit->distance_m = best;
	return true;
}

bool body_ray(const struct body *body, struct v3 origin_m, struct v3 direction,
	      struct body_hit *hit)
{
	return cast(body, origin_m, direction, 1e9f, RAY_FIRST_FRONT, hit);
}

bool body_ray_out(const struct body *body, struct v3 origin_m, struct v3 direction,
		  struct body_hit *hit)
{
	return cast(body, origin_m, direction, 1e9f, RAY_FIRST_BACK, hit);
}

bool body_ray_back(const struct body *body, struct v3 origin_m, struct v3 direction,
		   struct body_hit *hit)
{
	return cast(body, origin_m, direction, 1e9f, RAY_LAST_BACK, hit);
}

bool body_segment_hits(const struct body *body, struct v3 a_m, struct v3 b_m, struct body_hit *hit)
{
	return cast(body, a_m, v3_sub(b_m, a_m), 1.0f, RAY_FIRST_ANY, hit);
}
