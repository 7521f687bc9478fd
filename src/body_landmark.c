/* The order in which landmarks are found, and pieces of them. */
#include "body_landmark.h"

#include "body_landmark_private.h"
#include "body_private.h"

const char *const landmark_name[LANDMARK_COUNT] = {
#define X(landmark, name, stops) name,
	LANDMARK_TABLE(X)
#undef X
};

const char *const landmark_stops[LANDMARK_COUNT] = {
#define X(landmark, name, stops) stops,
	LANDMARK_TABLE(X)
#undef X
};

static const float neck_lean_max = 0.5f; /* tangent; more is a chin on the chest */
static const float piece_least_m = 0.005f;
static const float aside_step_m = 0.01f; /* the surface is felt for this often on the way aside */

struct landmark_scratch *landmark_init(struct arena *arena)
{
	return ARENA_ARRAY(arena, struct landmark_scratch, 1);
}

enum landmark landmark_find(const char *name)
{
	int i = 0;
	while (i < LANDMARK_COUNT && (strlen(name) != strlen(landmark_name[i]) ||
				      memcmp(name, landmark_name[i], strlen(name)) != 0))
		i++;
	return (enum landmark)i;
}

/* The spine is the first run of trunk bones; neck and head follow it (body.h). */
static bool find_axes(struct landmark_scratch *s)
{
	const struct body *body = s->body;
	s->trunk.count = s->head.count = 0;
	for (int b = 0; b < body->bone_count && body->bone[b].part == PART_TRUNK; b++) {
		if (s->trunk.count == 0)
			chain_add_point(&s->trunk, body->bone[b].a_m);
		if (s->trunk.count < CHAIN_POINTS_MAX)
			chain_add_point(&s->trunk, body->bone[b].b_m);
	}
	for (int b = 0; b < body->bone_count; b++)
		if (body->bone[b].part == PART_HEAD && s->head.count < CHAIN_POINTS_MAX) {
			if (s->head.count == 0)
				chain_add_point(&s->head, body->bone[b].a_m);
			chain_add_point(&s->head, body->bone[b].b_m);
		}
	return s->trunk.count >= 2 && s->head.count >= 3;
}

/* The middle plane goes through the neck and between the hips; the spine is laid into it. */
static void find_frames(struct landmark_scratch *s)
{
	const struct v3 up = {0.0f, 1.0f, 0.0f}, front = {0.0f, 0.0f, 1.0f},
			left = {1.0f, 0.0f, 0.0f};
	struct v3 hip[2] = {s->trunk.point_m[0], s->trunk.point_m[0]};
	for (int b = s->body->bone_count - 1; b >= 0; b--)
		if (s->body->bone[b].part >= PART_LEG_LEFT)
			hip[s->body->bone[b].part - PART_LEG_LEFT] = s->body->bone[b].a_m;
	struct v3 neck_m = s->head.point_m[0];
	struct v3 low = v3_sub(v3_lerp(hip[0], hip[1], 0.5f), s->trunk.point_m[0]);
	low = v3_mad(s->trunk.point_m[0], left, v3_dot(low, left));
	struct v3 axis = v3_normalize(v3_sub(neck_m, low));
	/* from the neck to the crown: a short neck's own bone says little */
	struct v3 neck = v3_normalize(v3_sub(s->head.point_m[s->head.count - 1], neck_m));
	neck = lean_at_most(neck, axis, neck_lean_max);
	s->frame = (struct frame){axis, turn_onto(front, up, axis), turn_onto(left, up, axis)};
	s->head_frame = (struct frame){neck, turn_onto(front, up, neck), turn_onto(left, up, neck)};
	for (int i = 0; i < s->trunk.count; i++) {
		struct v3 *p = &s->trunk.point_m[i];
		*p = v3_mad(*p, s->frame.side, v3_dot(v3_sub(neck_m, *p), s->frame.side));
	}
}

void body_find_landmarks(struct body *body)
{
	struct landmark_scratch *s = body->scratch->landmarks;
	memset(body->landmark, 0, sizeof body->landmark);
	s->body = body;
	if (body->bone_count == 0 || !find_axes(s))
		return;
	find_frames(s);
	if (!landmark_trunk_ends(s))
		return;
	landmark_limbs(s);
	landmark_trunk(s);
	landmark_limb_lines(s);
	landmark_head(s);
}

/* ---- pieces ---- */

static float place_m(const struct landmark_line *line, float stops)
{
	int last = line->stop_count - 1, k = int_clamp((int)stops, 0, last - 1);
	float whole = line->stop_m[last];
	if (line->closed)
		return stops * whole;
	float share = float_clamp(stops - (float)k, 0.0f, 1.0f);
	return line->stop_m[k] + share * (line->stop_m[k + 1] - line->stop_m[k]);
}

/* The point and the direction of the line at an arc length. Points are evenly spaced. */
static struct v3 point_at(const struct landmark_line *line, float along_m, struct v3 *way)
{
	float whole = line->stop_m[line->stop_count - 1], steps = (float)(line->count - 1);
	if (line->closed) {
		while (along_m < 0.0f)
			along_m += whole;
		while (along_m > whole)
			along_m -= whole;
	}
	float at = float_clamp(along_m / whole, 0.0f, 1.0f) * steps;
	int i = int_min((int)at, line->count - 2);
	*way = v3_sub(line->point_m[i + 1], line->point_m[i]);
	return v3_lerp(line->point_m[i], line->point_m[i + 1], at - (float)i);
}

/* Over the surface, at right angles to the line, in steps that follow its bend. */
static struct v3 move_aside(const struct body *body, struct v3 point_m, struct v3 way,
			    float aside_m, struct v3 *normal)
{
	struct body_hit hit;
	float left = float_abs(aside_m), sign = aside_m < 0.0f ? -1.0f : 1.0f;
	body_nearest(body, point_m, 0, &hit);
	while (left > 0.0f) {
		struct v3 aside = v3_normalize(v3_cross(hit.normal, way));
		float step = float_min(left, aside_step_m);
		body_nearest(body, v3_mad(hit.point_m, aside, sign * step), 0, &hit);
		left -= step;
	}
	*normal = hit.normal;
	return hit.point_m;
}

int landmark_cut(const struct body *body, enum landmark landmark, float from, float to,
		 float along_m, float aside_m, struct v3 point_m[MARK_POINTS_MAX],
		 struct v3 normal[MARK_POINTS_MAX])
{
	const struct landmark_line *line = &body->landmark[landmark];
	if (line->count < 2)
		return 0;
	float whole = line->stop_m[line->stop_count - 1];
	float a = place_m(line, from) + along_m, b = place_m(line, to) + along_m;
	if (!line->closed) {
		a = float_clamp(a, 0.0f, whole);
		b = float_clamp(b, 0.0f, whole);
	}
	if (float_abs(b - a) < piece_least_m)
		return 0;
	int count = int_clamp((int)(float_abs(b - a) / whole * (float)line->count) + 2, 8,
			      MARK_POINTS_MAX);
	for (int i = 0; i < count; i++) {
		struct v3 way;
		float at = a + (b - a) * (float)i / (float)(count - 1);
		struct v3 point = point_at(line, at, &way);
		point_m[i] = move_aside(body, point, way, aside_m, &normal[i]);
	}
	return count;
}
