#include "pattern_shape.h"

#include "pattern_cubic.h"

#define STEP_MM 8.0f          /* between points of a curve, */
#define FLAT_MM 1.0f          /* a bow below this, */
#define FLAT_SHARE 0.006f     /* or below this share of the chord, is none; */
#define BENT_BACK_SHARE 0.05f /* below this if the middle was laid on the chord */
#define SPLIT_MM 5.0f         /* nearer than this to a corner there is room for no other */
#define ELLIPSE_POINTS_A_EDGE 16

enum { BEND_POINTS_MIN = 8, BEND_POINTS_MAX = 48 };

static const char too_many[] = "the outline has too many points: make it simpler";

/* The inner points of one edge. */
struct inner {
	int count;
	struct v2 mm[OUTLINE_POINTS_MAX];
};

static int next_point(const struct piece *piece, int i)
{
	return i + 1 < piece->point_count ? i + 1 : 0;
}

int piece_corner(const struct piece *piece, int corner)
{
	int first, last;
	piece_edge(piece, corner, &first, &last);
	return first;
}

struct v2 piece_corner_mm(const struct piece *piece, int corner)
{
	return piece->point_mm[piece_corner(piece, corner)];
}

static void take_inner(const struct piece *piece, int edge, struct inner *inner)
{
	int first, last;
	piece_edge(piece, edge, &first, &last);
	inner->count = 0;
	for (int i = next_point(piece, first); i != last; i = next_point(piece, i))
		inner->mm[inner->count++] = piece->point_mm[i];
}

static bool add_point(struct piece *piece, struct v2 mm, bool corner)
{
	if (piece->point_count == OUTLINE_POINTS_MAX)
		return false;
	piece->point_mm[piece->point_count] = mm;
	piece->corner[piece->point_count++] = corner;
	return true;
}

/* One edge gets other inner points; the outline begins at corner 0 afterwards. */
static const char *put_inner(struct piece *piece, int edge, const struct inner *inner)
{
	struct piece made = *piece;
	struct inner kept;
	bool fits = true;
	made.point_count = 0;
	for (int e = 0; e < piece_edge_count(piece); e++) {
		const struct inner *at = inner;
		if (e != edge) {
			take_inner(piece, e, &kept);
			at = &kept;
		}
		fits &= add_point(&made, piece_corner_mm(piece, e), true);
		for (int i = 0; i < at->count; i++)
			fits &= add_point(&made, at->mm[i], false);
	}
	*piece = made;
	return fits ? NULL : too_many;
}

static int edge_before(const struct piece *piece, int edge)
{
	return edge > 0 ? edge - 1 : piece_edge_count(piece) - 1;
}

static int edge_after(const struct piece *piece, int edge)
{
	return edge + 1 < piece_edge_count(piece) ? edge + 1 : 0;
}

/* ---- the whole ---- */

const char *piece_scale(struct piece *piece, struct v2 factor, struct v2 about_mm)
{
	if (!(factor.x >= 0.05f && factor.x <= 20.0f && factor.y >= 0.05f && factor.y <= 20.0f))
		return "a piece grows or shrinks at most twenty times at once";
	for (int i = 0; i < piece->point_count; i++) {
		struct v2 d = v2_sub(piece->point_mm[i], about_mm);
		piece->point_mm[i] = (struct v2){about_mm.x + factor.x * d.x,
						 about_mm.y + factor.y * d.y};
	}
	return NULL;
}

/* ---- corners ---- */

/* The similarity that takes a to a_to and b to b_to. */
static struct v2 carried(struct v2 p, struct v2 a, struct v2 b, struct v2 a_to, struct v2 b_to)
{
	struct v2 chord = v2_sub(b, a), chord_to = v2_sub(b_to, a_to), d = v2_sub(p, a);
	float square = v2_dot(chord, chord);
	if (square < 1e-4f)
		return v2_add(p, v2_sub(a_to, a));
	float along = v2_dot(chord, chord_to) / square, turn = v2_cross(chord, chord_to) / square;
	return v2_add(a_to, (struct v2){along * d.x - turn * d.y, turn * d.x + along * d.y});
}

static void carry_inner(struct piece *piece, int edge, struct v2 a_to, struct v2 b_to)
{
	int first, last;
	piece_edge(piece, edge, &first, &last);
	struct v2 a = piece->point_mm[first], b = piece->point_mm[last];
	for (int i = next_point(piece, first); i != last; i = next_point(piece, i))
		piece->point_mm[i] = carried(piece->point_mm[i], a, b, a_to, b_to);
}

/* A piece of one edge: the corner draws the outline along, less and less on the way round. */
static void pull_loop(struct piece *piece, struct v2 shift)
{
	float length = piece_edge_length_mm(piece, 0), along = 0.0f;
	int first = piece_corner(piece, 0);
	struct v2 before = piece->point_mm[first];
	for (int i = next_point(piece, first); i != first; i = next_point(piece, i)) {
		along += v2_distance(before, piece->point_mm[i]);
		before = piece->point_mm[i];
		float weight = 1.0f - 2.0f * along / float_max(length, 1e-3f);
		piece->point_mm[i] = v2_add(before, v2_scale(shift, weight * weight));
	}
}

const char *piece_move_corner(struct piece *piece, int corner, struct v2 to_mm)
{
	int at = piece_corner(piece, corner), before = edge_before(piece, corner);
	struct v2 from = piece->point_mm[at];
	if (before == corner) {
		pull_loop(piece, v2_sub(to_mm, from));
	} else {
		struct v2 start = piece_corner_mm(piece, before);
		struct v2 end = piece_corner_mm(piece, edge_after(piece, corner));
		carry_inner(piece, before, start, to_mm);
		carry_inner(piece, corner, to_mm, end);
	}
	piece->point_mm[at] = to_mm;
	return NULL;
}

/* ---- bending ---- */

static void sample_edge(const struct piece *piece, int edge, int count, struct inner *inner)
{
	inner->count = count;
	for (int i = 0; i < count; i++)
		inner->mm[i] = piece_edge_point(piece, edge, (float)(i + 1) / (float)(count + 1));
}

static int curve_points(float length_mm)
{
	return int_clamp((int)(length_mm / STEP_MM), BEND_POINTS_MIN, BEND_POINTS_MAX);
}

static bool flat(const struct inner *inner, struct v2 a, struct v2 b, float share)
{
	struct v2 along = v2_normalize(v2_sub(b, a));
	float bow = 0.0f, chord = v2_distance(a, b);
	for (int i = 0; i < inner->count; i++)
		bow = float_max(bow, float_abs(v2_cross(along, v2_sub(inner->mm[i], a))));
	return bow < float_max(FLAT_MM, share * chord);
}

const char *piece_bend(struct piece *piece, int edge, struct v2 middle_mm)
{
	struct inner inner;
	int first, last;
	float length = piece_edge_length_mm(piece, edge), along = 0.0f;
	struct v2 shift = v2_sub(middle_mm, piece_edge_point(piece, edge, 0.5f));
	piece_edge(piece, edge, &first, &last);
	struct v2 a = piece->point_mm[first], b = piece->point_mm[last], before = a;
	take_inner(piece, edge, &inner);
	if (inner.count < BEND_POINTS_MIN)
		sample_edge(piece, edge, curve_points(length + 2.0f * v2_length(shift)), &inner);
	for (int i = 0; i < inner.count; i++) {
		along += v2_distance(before, inner.mm[i]);
		before = inner.mm[i];
		float t = along / float_max(length, 1e-3f);
		inner.mm[i] = v2_add(before, v2_scale(shift, 4.0f * t * (1.0f - t)));
	}
	struct inner middle = {1, {middle_mm}};
	bool back = flat(&middle, a, b, FLAT_SHARE);
	if (first != last && flat(&inner, a, b, back ? BENT_BACK_SHARE : FLAT_SHARE))
		inner.count = 0;
	return put_inner(piece, edge, &inner);
}

/* ---- corners that come and go ---- */

const char *piece_split(struct piece *piece, int edge, float fraction)
{
	struct piece made = *piece;
	float length = piece_edge_length_mm(piece, edge);
	float cut = length * float_clamp(fraction, 0.0f, 1.0f), along = 0.0f;
	if (!(cut >= SPLIT_MM && length - cut >= SPLIT_MM))
		return "too near: there is a corner already";
	struct v2 corner = piece_edge_point(piece, edge, fraction);
	bool fits = true, done = false;
	made.point_count = 0;
	for (int e = 0; e < piece_edge_count(piece); e++) {
		struct inner inner;
		struct v2 before = piece_corner_mm(piece, e);
		take_inner(piece, e, &inner);
		fits &= add_point(&made, before, true);
		for (int i = 0; i < inner.count; i++) {
			along += e == edge ? v2_distance(before, inner.mm[i]) : 0.0f;
			before = inner.mm[i];
			bool past = e == edge && !done && along >= cut;
			if (past)
				fits &= add_point(&made, corner, true);
			done |= past;
			if (e != edge || v2_distance(before, corner) >= 1.0f)
				fits &= add_point(&made, before, false);
		}
		if (e == edge && !done)
			fits &= add_point(&made, corner, true);
	}
	*piece = made;
	return fits ? NULL : too_many;
}

/* The cubic between the given ends that follows the points best, in so many points. */
static void smooth(struct inner *inner, int count, struct v2 a, struct v2 b)
{
	float length = 0.0f, along = 0.0f;
	struct v2 before = a, handle[2];
	struct cubic_fit fit;
	for (int i = 0; i <= inner->count; i++) {
		struct v2 at = i < inner->count ? inner->mm[i] : b;
		length += v2_distance(before, at);
		before = at;
	}
	before = a;
	cubic_fit_begin(&fit, a, b);
	for (int i = 0; i < inner->count; i++) {
		along += v2_distance(before, inner->mm[i]);
		before = inner->mm[i];
		cubic_fit_add(&fit, along / float_max(length, 1e-3f), before);
	}
	cubic_fit_end(&fit, handle);
	inner->count = count;
	for (int i = 0; i < count; i++)
		inner->mm[i] = cubic_at(a, b, handle, (float)(i + 1) / (float)(count + 1));
}

const char *piece_join(struct piece *piece, int corner)
{
	struct inner inner, after;
	int before = edge_before(piece, corner), at = piece_corner(piece, corner);
	if (piece_edge_count(piece) < 3)
		return "a piece keeps at least two corners";
	take_inner(piece, before, &inner);
	take_inner(piece, corner, &after);
	bool straight = inner.count == 0 && after.count == 0;
	struct v2 a = piece_corner_mm(piece, before);
	struct v2 b = piece_corner_mm(piece, edge_after(piece, corner));
	inner.mm[inner.count++] = piece->point_mm[at];
	for (int i = 0; i < after.count; i++)
		inner.mm[inner.count++] = after.mm[i];
	piece->corner[at] = false;
	int joined = corner > 0 ? corner - 1 : piece_edge_count(piece) - 1;
	/* Edges are counted from the first corner in the list: corner 0's place is taken by 1. */
	float length = piece_edge_length_mm(piece, joined);
	sample_edge(piece, joined, curve_points(length), &inner);
	smooth(&inner, curve_points(length), a, b);
	if (straight || flat(&inner, a, b, FLAT_SHARE))
		inner.count = 0;
	return put_inner(piece, joined, &inner);
}

const char *piece_resize_edge(struct piece *piece, int edge, float length_mm, int fixed)
{
	int end = edge_after(piece, edge);
	float ratio = length_mm / float_max(piece_edge_length_mm(piece, edge), 1e-3f);
	struct v2 a = piece_corner_mm(piece, edge), b = piece_corner_mm(piece, end);
	if (end == edge)
		return "an edge that goes all round keeps its length";
	if (!(ratio > 0.2f && ratio < 5.0f))
		return "the edges differ too much to be made equal";
	struct v2 still = v2_lerp(a, b, fixed == 0 ? 0.0f : fixed == 1 ? 1.0f : 0.5f);
	piece_move_corner(piece, edge, v2_lerp(still, a, ratio));
	piece_move_corner(piece, end, v2_lerp(still, b, ratio));
	return NULL;
}

/* ---- ready shapes ---- */

void piece_rectangle(struct piece *piece, struct v2 size_mm)
{
	static const float corner[4][2] = {
		{-0.5f, -0.5f}, {0.5f, -0.5f}, {0.5f, 0.5f}, {-0.5f, 0.5f}};
	piece->point_count = 0;
	for (int i = 0; i < 4; i++)
		add_point(piece, (struct v2){corner[i][0] * size_mm.x, corner[i][1] * size_mm.y},
			  true);
}

/* Corners at its four extremes, as a round piece drawn by hand has them. */
void piece_ellipse(struct piece *piece, struct v2 size_mm)
{
	int count = 4 * ELLIPSE_POINTS_A_EDGE;
	piece->point_count = 0;
	for (int i = 0; i < count; i++) {
		float angle = 2.0f * PI_F * (float)i / (float)count;
		add_point(piece,
			  (struct v2){0.5f * size_mm.x * angle_cos(angle),
				      0.5f * size_mm.y * angle_sin(angle)},
			  i % ELLIPSE_POINTS_A_EDGE == 0);
	}
}
