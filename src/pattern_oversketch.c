/* Redrawing a stretch of an outline: the stroke is read like any other line and takes the place of
 * the arc of the outline that it runs along. All in the piece's own coordinates. */
#include "pattern_private.h"

enum { COMPARED = 32 }; /* points on a line when two lines are compared */

#define NEAR_MM 40.0f       /* the stroke's ends must be this near to the outline, */
#define NEAR_SHARE 0.03f    /* or this share of its length */
#define CORNER_SHARE 0.012f /* an end this near to a corner means the corner */
#define CORNER_MM 15.0f

/* A place on the outline: `share` of the way from point `after` to the next. */
struct place {
	int after;
	float share;
	struct v2 mm;
};

static int next_point(const struct piece *piece, int i)
{
	return i + 1 < piece->point_count ? i + 1 : 0;
}

static float outline_length(const struct piece *piece)
{
	float length = 0.0f;
	for (int i = 0; i < piece->point_count; i++)
		length += v2_distance(piece->point_mm[i], piece->point_mm[next_point(piece, i)]);
	return length;
}

static float place_near(const struct piece *piece, struct v2 p, struct place *place)
{
	float best = 1e30f;
	for (int i = 0; i < piece->point_count; i++) {
		struct v2 a = piece->point_mm[i];
		struct v2 d = v2_sub(piece->point_mm[next_point(piece, i)], a);
		float squared = float_max(v2_dot(d, d), 1e-12f);
		float share = float_clamp(v2_dot(v2_sub(p, a), d) / squared, 0.0f, 1.0f);
		struct v2 at = v2_add(a, v2_scale(d, share));
		if (v2_distance(p, at) < best) {
			best = v2_distance(p, at);
			*place = (struct place){i, share, at};
		}
	}
	return best;
}

/* An end near a corner is meant to be the corner. */
static void snap_to_corner(const struct piece *piece, float reach, struct place *place)
{
	float best = reach;
	struct v2 p = place->mm;
	for (int i = 0; i < piece->point_count; i++) {
		float distance = v2_distance(piece->point_mm[i], p);
		if (piece->corner[i] && distance < best) {
			best = distance;
			*place = (struct place){i, 0.0f, piece->point_mm[i]};
		}
	}
}

/* The outline counter-clockwise from a to b, as points; returns how many. */
static int arc_points(const struct piece *piece, const struct place *a, const struct place *b,
		      struct v2 arc[OUTLINE_POINTS_MAX + 2])
{
	int count = 0;
	arc[count++] = a->mm;
	bool ahead = a->after == b->after && b->share >= a->share;
	int steps = ahead ? 0
			  : (b->after - a->after + piece->point_count - 1) % piece->point_count + 1;
	for (int k = 0, i = a->after; k < steps; k++) {
		i = next_point(piece, i);
		arc[count++] = piece->point_mm[i];
	}
	arc[count++] = b->mm;
	return count;
}

/* COMPARED points at even distances along a line. */
static void spread(const struct v2 *line, int count, struct v2 out[COMPARED])
{
	float length = 0.0f, passed = 0.0f;
	for (int i = 1; i < count; i++)
		length += v2_distance(line[i - 1], line[i]);
	for (int k = 0, i = 1; k < COMPARED; k++) {
		float wanted = length * (float)k / (float)(COMPARED - 1);
		float step = v2_distance(line[i - 1], line[i]);
		while (i + 1 < count && passed + step < wanted) {
			passed += step;
			i++;
			step = v2_distance(line[i - 1], line[i]);
		}
		float t = step > 0.0f ? float_clamp((wanted - passed) / step, 0.0f, 1.0f) : 0.0f;
		out[k] = v2_lerp(line[i - 1], line[i], t);
	}
}

/* The mean distance of corresponding points of two lines between the same ends. */
static float unlikeness(const struct v2 *a, int a_count, const struct v2 *b, int b_count)
{
	struct v2 p[COMPARED], q[COMPARED];
	spread(a, a_count, p);
	spread(b, b_count, q);
	float sum = 0.0f;
	for (int k = 0; k < COMPARED; k++)
		sum += v2_distance(p[k], q[k]);
	return sum / (float)COMPARED;
}

static void reverse(struct v2 *point, int count)
{
	for (int i = 0, k = count - 1; i < k; i++, k--) {
		struct v2 swap = point[i];
		point[i] = point[k];
		point[k] = swap;
	}
}

/* Adds the outline from b round to a, both corners now, points closer than a millimetre to them
 * left out. */
static bool keep_rest(struct piece *made, const struct piece *piece, const struct place *b,
		      const struct place *a)
{
	int steps = (a->after - b->after + piece->point_count) % piece->point_count;
	if (steps == 0 && a->share <= b->share)
		steps = piece->point_count;
	int i = b->after;
	made->point_mm[made->point_count] = b->mm;
	made->corner[made->point_count++] = true;
	for (int k = 0; k < steps; k++) {
		i = next_point(piece, i);
		struct v2 p = piece->point_mm[i];
		if (v2_distance(p, a->mm) < 1.0f || v2_distance(p, b->mm) < 1.0f)
			continue;
		if (made->point_count == OUTLINE_POINTS_MAX)
			return false;
		made->point_mm[made->point_count] = p;
		made->corner[made->point_count++] = piece->corner[i];
	}
	return true;
}

/* Edges keep their numbers where they can: the outline begins where it began, if that is still
 * there.
 */
static void begin_at(struct piece *piece, struct v2 first)
{
	struct piece turned = *piece;
	int start = 0, count = piece->point_count;
	for (int i = 0; i < count; i++)
		if (piece->point_mm[i].x == first.x && piece->point_mm[i].y == first.y)
			start = i;
	for (int i = 0; i < count; i++) {
		turned.point_mm[i] = piece->point_mm[(start + i) % count];
		turned.corner[i] = piece->corner[(start + i) % count];
	}
	*piece = turned;
}

/* A pen that rests where it starts or stops leaves a hook there; what lies within a corner's reach
 * of the ends is taken for the end itself. */
static void drop_hooks(struct piece *made, struct v2 a, struct v2 b)
{
	int kept = 0;
	for (int i = 0; i < made->point_count; i++) {
		struct v2 p = made->point_mm[i];
		if (i > 0 && (v2_distance(p, a) < CORNER_MM || v2_distance(p, b) < CORNER_MM))
			continue;
		made->point_mm[kept] = p;
		made->corner[kept++] = made->corner[i];
	}
	made->point_count = kept;
}

/* The new outline: the trace from a to b, then what is kept from b to a. */
static const char *replace_arc(struct piece *piece, const struct place *a, const struct place *b,
			       const struct trace *trace)
{
	struct runs runs;
	struct piece made = *piece;
	made.point_count = 0;
	runs_find_open(&runs, trace);
	bool fits = outline_add(&made, &runs, trace, a->mm, b->mm);
	drop_hooks(&made, a->mm, b->mm);
	if (!fits || made.point_count == OUTLINE_POINTS_MAX || !keep_rest(&made, piece, b, a))
		return "the outline has too many points: draw it simpler";
	const char *fault = piece_fault(&made);
	if (fault && outline_untangle(&made))
		fault = piece_fault(&made);
	begin_at(&made, piece->point_mm[0]);
	if (!fault)
		*piece = made;
	return fault;
}

const char *piece_oversketch(struct piece *piece, const struct v2 *stroke_mm, int count)
{
	struct trace trace;
	const char *fault = trace_read_open(&trace, stroke_mm, count);
	if (fault)
		return fault;
	for (int i = 0; i < trace.count; i++) {
		trace.raw_mm[i] = piece_from_sheet(piece, trace.raw_mm[i]);
		trace.smooth_mm[i] = piece_from_sheet(piece, trace.smooth_mm[i]);
	}
	struct place a, b;
	float length = outline_length(piece), near_mm = float_max(NEAR_MM, NEAR_SHARE * length);
	if (place_near(piece, trace.smooth_mm[0], &a) > near_mm ||
	    place_near(piece, trace.smooth_mm[trace.count - 1], &b) > near_mm)
		return "begin and end the new line on the outline";
	float reach = float_max(CORNER_MM, CORNER_SHARE * length);
	snap_to_corner(piece, reach, &a);
	snap_to_corner(piece, reach, &b);
	if (v2_distance(a.mm, b.mm) < 5.0f)
		return "begin and end the new line at different places of the outline";
	struct v2 ahead[OUTLINE_POINTS_MAX + 2], behind[OUTLINE_POINTS_MAX + 2];
	int ahead_count = arc_points(piece, &a, &b, ahead);
	int behind_count = arc_points(piece, &b, &a, behind);
	reverse(behind, behind_count);
	if (unlikeness(trace.smooth_mm, trace.count, ahead, ahead_count) <=
	    unlikeness(trace.smooth_mm, trace.count, behind, behind_count))
		return replace_arc(piece, &a, &b, &trace);
	trace_reverse(&trace);
	return replace_arc(piece, &b, &a, &trace);
}
