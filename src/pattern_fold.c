/* A piece that is the same on both sides of an axis, like cloth that was cut on the fold. */
#include "pattern_shape.h"

#define SAME_MM 3.0f        /* two halves that lie so near to each other are one */
#define SMOOTH_COSINE 0.26f /* an outline that meets the axis squarer than 75 degrees is smooth */
#define ON_AXIS_MM 0.5f     /* points so near to the axis are left out, */
#define CORNER_ON_AXIS_MM 4.0f /* and corners */

static struct v2 axis_way(const struct piece *piece)
{
	return (struct v2){angle_cos(piece->axis_rad), angle_sin(piece->axis_rad)};
}

struct v2 piece_onto_axis(const struct piece *piece, struct v2 local_mm)
{
	struct v2 way = axis_way(piece);
	float along = v2_dot(v2_sub(local_mm, piece->axis_mm), way);
	return v2_add(piece->axis_mm, v2_scale(way, along));
}

struct v2 piece_reflect(const struct piece *piece, struct v2 local_mm)
{
	return v2_sub(v2_scale(piece_onto_axis(piece, local_mm), 2.0f), local_mm);
}

int piece_other_corner(const struct piece *piece, int corner)
{
	struct v2 wanted = piece_reflect(piece, piece_corner_mm(piece, corner));
	float best = SAME_MM;
	int other = -1;
	for (int k = 0; k < piece_edge_count(piece); k++) {
		float distance = v2_distance(piece_corner_mm(piece, k), wanted);
		if (distance < best) {
			best = distance;
			other = k;
		}
	}
	return other;
}

int piece_other_edge(const struct piece *piece, int edge)
{
	struct v2 wanted = piece_reflect(piece, piece_edge_point(piece, edge, 0.5f));
	float best = SAME_MM;
	int other = -1;
	for (int e = 0; e < piece_edge_count(piece); e++) {
		float distance = v2_distance(piece_edge_point(piece, e, 0.5f), wanted);
		if (distance < best) {
			best = distance;
			other = e;
		}
	}
	return other;
}

/* ---- folding ---- */

/* How far to the left of the axis. */
static float left_of(const struct piece *piece, struct v2 mm)
{
	return v2_cross(axis_way(piece), v2_sub(mm, piece->axis_mm));
}

/* Twice the area on one side: a triangle from the axis for every stretch of outline there. */
static float area_beside(const struct piece *piece, float side)
{
	float twice = 0.0f;
	for (int i = 0; i < piece->point_count; i++) {
		struct v2 a = piece->point_mm[i];
		struct v2 b = piece->point_mm[i + 1 < piece->point_count ? i + 1 : 0];
		float at_a = side * left_of(piece, a), at_b = side * left_of(piece, b);
		if (at_a <= 0.0f && at_b <= 0.0f)
			continue;
		if (at_a < 0.0f)
			a = v2_lerp(a, b, at_a / (at_a - at_b));
		if (at_b < 0.0f)
			b = v2_lerp(b, a, at_b / (at_b - at_a));
		twice += v2_cross(v2_sub(a, piece->axis_mm), v2_sub(b, piece->axis_mm));
	}
	return twice;
}

/* The half that stays: from where the outline comes over the axis to where it leaves again. */
struct half {
	int count;
	struct v2 mm[OUTLINE_POINTS_MAX];
	bool corner[OUTLINE_POINTS_MAX];
};

static struct v2 crossing(const struct piece *piece, struct v2 a, struct v2 b)
{
	float at_a = left_of(piece, a), at_b = left_of(piece, b);
	return piece_onto_axis(piece, v2_lerp(a, b, at_a / (at_a - at_b)));
}

static void add(struct half *half, struct v2 mm, bool corner)
{
	half->mm[half->count] = mm;
	half->corner[half->count++] = corner;
}

static const char *take_half(const struct piece *piece, float side, struct half *half)
{
	int count = piece->point_count, entry = -1, crossings = 0;
	for (int i = 0; i < count; i++) {
		bool here = side * left_of(piece, piece->point_mm[i]) > 0.0f;
		bool next = side * left_of(piece, piece->point_mm[(i + 1) % count]) > 0.0f;
		crossings += here != next;
		entry = !here && next ? i : entry;
	}
	if (crossings != 2)
		return crossings == 0 ? "the axis does not meet the piece"
				      : "the axis meets the outline more than twice";
	struct v2 before = piece->point_mm[entry];
	half->count = 0;
	for (int k = 1; k < count; k++) {
		int i = (entry + k) % count;
		struct v2 at = piece->point_mm[i];
		bool inside = side * left_of(piece, at) > 0.0f;
		if (k == 1)
			add(half, crossing(piece, before, at), false);
		if (!inside) {
			add(half, crossing(piece, before, at), false);
			return NULL;
		}
		before = at;
		if (side * left_of(piece, at) > (piece->corner[i] ? CORNER_ON_AXIS_MM : ON_AXIS_MM))
			add(half, at, piece->corner[i]);
	}
	add(half, crossing(piece, before, piece->point_mm[entry]), false);
	return NULL;
}

/* The two points on the axis are corners where the outline does not cross it squarely. */
static void corner_on_axis(const struct piece *piece, struct half *half, int at, int next)
{
	struct v2 way = v2_normalize(v2_sub(half->mm[next], half->mm[at]));
	half->corner[at] = float_abs(v2_dot(way, axis_way(piece))) > SMOOTH_COSINE;
}

/* From the axis on: how far the run without a corner reaches away from it. */
static float run_reach(const struct piece *piece, const struct half *half, int at, int step)
{
	float reach = 0.0f;
	for (int i = at + step; i > 0 && i < half->count - 1 && !half->corner[i]; i += step)
		reach = float_max(reach, float_abs(left_of(piece, half->mm[i])));
	return reach;
}

/* Without a corner on the axis both halves go on into each other: a straight edge is laid square to
 * the axis, a curve loses its slope there, less and less farther away. */
static void meet_squarely(const struct piece *piece, struct half *half, int at, int step)
{
	struct v2 way = axis_way(piece), d = v2_sub(half->mm[at + step], half->mm[at]);
	float reach = 0.6f * run_reach(piece, half, at, step);
	float off = float_abs(left_of(piece, half->mm[at + step]));
	if (half->corner[at])
		return;
	if (reach <= off) {
		half->mm[at] = piece_onto_axis(piece, half->mm[at + step]);
		return;
	}
	float slope = v2_dot(d, way) / off;
	for (int i = at + step; i > 0 && i < half->count - 1 && !half->corner[i]; i += step) {
		float x = float_abs(left_of(piece, half->mm[i])) / reach;
		if (x >= 1.0f)
			break;
		float shift = slope * reach * x * (1.0f - x) * (1.0f - x);
		half->mm[i] = v2_sub(half->mm[i], v2_scale(way, shift));
	}
}

static void begin_with_corner(struct piece *piece)
{
	struct piece turned = *piece;
	int start = 0, count = piece->point_count;
	while (start < count - 1 && !piece->corner[start])
		start++;
	for (int i = 0; i < count; i++) {
		turned.point_mm[i] = piece->point_mm[(start + i) % count];
		turned.corner[i] = piece->corner[(start + i) % count];
	}
	*piece = turned;
}

const char *piece_fold(struct piece *piece, int side)
{
	struct half half;
	float way = side != 0                                               ? (float)side
		    : area_beside(piece, 1.0f) >= area_beside(piece, -1.0f) ? 1.0f
									    : -1.0f;
	const char *fault = take_half(piece, way, &half);
	if (fault)
		return fault;
	int last = half.count - 1;
	if (last < 2 || 2 * last > OUTLINE_POINTS_MAX)
		return last < 2 ? "too small: the axis leaves nothing of the piece"
				: "the outline has too many points: make it simpler";
	corner_on_axis(piece, &half, 0, 1);
	corner_on_axis(piece, &half, last, last - 1);
	meet_squarely(piece, &half, 0, 1);
	meet_squarely(piece, &half, last, -1);
	piece->point_count = 0;
	for (int i = 0; i < 2 * last; i++) {
		int at = i <= last ? i : 2 * last - i;
		struct v2 mm = half.mm[at];
		piece->point_mm[i] = i <= last ? mm : piece_reflect(piece, mm);
		piece->corner[i] = half.corner[at];
	}
	piece->point_count = 2 * last;
	if (piece_edge_count(piece) == 0)
		piece->corner[0] = piece->corner[last] = true;
	begin_with_corner(piece);
	piece->symmetric = true;
	return NULL;
}
