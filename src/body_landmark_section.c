/* Plane sections of the surface, and ways through the middle of it. */
#include "body_landmark_private.h"

/* ---- directions and chains ---- */

struct v3 turn_onto(struct v3 v, struct v3 from, struct v3 to)
{
	struct v3 sum = v3_add(from, to);
	float share = 1.0f + v3_dot(from, to);
	if (share < 1e-4f) /* opposite: any half turn does */
		return v3_scale(v, -1.0f);
	struct v3 turned = v3_mad(v, sum, -v3_dot(sum, v) / share);
	return v3_mad(turned, to, 2.0f * v3_dot(from, v));
}

struct v3 lean_at_most(struct v3 direction, struct v3 axis, float lean_max)
{
	float along = v3_dot(direction, axis);
	struct v3 across = v3_mad(direction, axis, -along);
	float lean = v3_length(across);
	if (along > 0.0f && lean <= lean_max * along)
		return direction;
	return v3_normalize(v3_mad(axis, across, lean_max / float_max(lean, 1e-6f)));
}

void chain_add_point(struct chain *chain, struct v3 point_m)
{
	MUST(chain->count < CHAIN_POINTS_MAX);
	int i = chain->count++;
	chain->point_m[i] = point_m;
	chain->along_m[i] =
		i == 0 ? 0.0f : chain->along_m[i - 1] + v3_distance(chain->point_m[i - 1], point_m);
}

float chain_length(const struct chain *chain)
{
	return chain->count > 0 ? chain->along_m[chain->count - 1] : 0.0f;
}

/* Beyond its ends a chain goes straight on. */
struct v3 chain_point(const struct chain *chain, float along_m)
{
	int i = 0;
	while (i + 2 < chain->count && chain->along_m[i + 1] < along_m)
		i++;
	float length = chain->along_m[i + 1] - chain->along_m[i];
	float share = length > 0.0f ? (along_m - chain->along_m[i]) / length : 0.0f;
	return v3_lerp(chain->point_m[i], chain->point_m[i + 1], share);
}

struct v3 chain_axis(const struct chain *chain, float along_m, float window_m)
{
	float length = chain_length(chain);
	float from = float_clamp(along_m - window_m, 0.0f, length - window_m);
	float to = float_clamp(along_m + window_m, window_m, length);
	return v3_normalize(v3_sub(chain_point(chain, to), chain_point(chain, from)));
}

/* ---- to the skin ---- */

bool skin_outward(const struct body *body, struct v3 from_m, struct v3 direction,
		  struct body_hit *hit)
{
	return body_ray_out(body, from_m, direction, hit);
}

bool skin_inward(const struct body *body, struct v3 to_m, struct v3 direction, float far,
		 struct body_hit *hit)
{
	return body_ray(body, v3_mad(to_m, direction, far), v3_scale(direction, -1.0f), hit);
}

/* ---- sections ---- */

struct plane {
	struct v3 point_m, normal;
};

/* Vertices in the plane count as above it, so that every triangle is cut at two edges or none. */
static bool is_above(const struct body *body, const struct plane *plane, int v)
{
	return v3_dot(plane->normal, v3_sub(body->position_m[v], plane->point_m)) >= 0.0f;
}

/* The edge of a triangle on which the walk leaves it: from below to above the plane; -1: not cut.
 */
static int way_out(const struct body *body, const struct plane *plane, int t)
{
	const int *v = body->triangle[t].v;
	bool above[3];
	for (int k = 0; k < 3; k++)
		above[k] = is_above(body, plane, v[k]);
	for (int k = 0; k < 3; k++)
		if (!above[k] && above[(k + 1) % 3])
			return k;
	return -1;
}

/* The triangle itself, or one of those round its corners: a hit may lie on an edge. */
static int first_cut(const struct body *body, const struct plane *plane, int t)
{
	if (way_out(body, plane, t) >= 0)
		return t;
	for (int k = 0; k < 3; k++) {
		int v = body->triangle[t].v[k];
		for (int i = body->star_first[v]; i < body->star_first[v + 1]; i++)
			if (way_out(body, plane, body->star[i]) >= 0)
				return body->star[i];
	}
	return -1;
}

static struct v3 crossing(const struct body *body, const struct plane *plane, int a, int b)
{
	struct v3 p = body->position_m[a], q = body->position_m[b];
	float height_a = v3_dot(plane->normal, v3_sub(p, plane->point_m));
	float height_b = v3_dot(plane->normal, v3_sub(q, plane->point_m));
	return v3_lerp(p, q, height_a / (height_a - height_b));
}

bool section_walk(struct landmark_scratch *s, const struct body_hit *start, struct v3 normal)
{
	const struct body *body = s->body;
	struct plane plane = {start->point_m, normal};
	int first = first_cut(body, &plane, start->triangle), t = first;
	s->section.count = 0;
	if (first < 0)
		return false;
	if (first == start->triangle)
		s->section.point_m[s->section.count++] = start->point_m;
	do {
		int k = way_out(body, &plane, t);
		MUST(k >= 0);
		if (s->section.count == SECTION_POINTS_MAX)
			return false;
		const int *v = body->triangle[t].v;
		s->section.point_m[s->section.count++] = crossing(body, &plane, v[k],
								  v[(k + 1) % 3]);
		t = body->neighbour[3 * t + k];
	} while (t != first);
	return s->section.count >= 3;
}

bool section_round(struct landmark_scratch *s, struct v3 centre_m, const struct frame *frame)
{
	struct body_hit hit;
	return skin_outward(s->body, centre_m, frame->front, &hit) &&
	       section_walk(s, &hit, frame->axis);
}

struct v3 section_middle(const struct section *section)
{
	struct v3 sum = {0.0f, 0.0f, 0.0f};
	float whole = 0.0f;
	for (int i = 0; i < section->count; i++) {
		struct v3 a = section->point_m[i], b = section->point_m[(i + 1) % section->count];
		float length = v3_distance(a, b);
		sum = v3_mad(sum, v3_lerp(a, b, 0.5f), length);
		whole += length;
	}
	return whole > 0.0f ? v3_scale(sum, 1.0f / whole) : section->point_m[0];
}

int section_nearest(const struct section *section, struct v3 point_m)
{
	int nearest = 0;
	for (int i = 1; i < section->count; i++)
		if (v3_distance(section->point_m[i], point_m) <
		    v3_distance(section->point_m[nearest], point_m))
			nearest = i;
	return nearest;
}

/* ---- girth: Andrew's monotone chain (1979) ---- */

static bool point_before(struct v2 a, struct v2 b)
{
	return a.x < b.x || (a.x == b.x && a.y < b.y);
}

/* Merge sort of s->hull[0 .. count) by x, then y, bottom up, through `swap`. */
static void sort_points(struct v2 *point, struct v2 *swap, int count)
{
	for (int run = 1; run < count; run *= 2) {
		for (int low = 0; low < count; low += 2 * run) {
			int a = low, middle = int_min(low + run, count), b = middle,
			    high = int_min(low + 2 * run, count);
			for (int i = low; i < high; i++) {
				bool left = a < middle &&
					    (b >= high || !point_before(point[b], point[a]));
				swap[i] = left ? point[a++] : point[b++];
			}
		}
		memcpy(point, swap, (size_t)count * sizeof *point);
	}
}

static int hull_add(struct v2 *hull, int count, int least, struct v2 p)
{
	while (count >= least && v2_cross(v2_sub(hull[count - 1], hull[count - 2]),
					  v2_sub(p, hull[count - 2])) <= 0.0f)
		count--;
	hull[count] = p;
	return count + 1;
}

float section_girth(struct landmark_scratch *s, const struct frame *frame)
{
	int count = s->section.count, size = 0;
	for (int i = 0; i < count; i++)
		s->flat[i] = (struct v2){v3_dot(s->section.point_m[i], frame->side),
					 v3_dot(s->section.point_m[i], frame->front)};
	sort_points(s->flat, s->hull, count);
	for (int i = 0; i < count; i++)
		size = hull_add(s->hull, size, 2, s->flat[i]);
	int lower = size + 1;
	for (int i = count - 2; i >= 0; i--)
		size = hull_add(s->hull, size, lower, s->flat[i]);
	float girth = 0.0f;
	for (int i = 0; i + 1 < size; i++)
		girth += v2_distance(s->hull[i], s->hull[i + 1]);
	return girth;
}
