/* Folds open again. The flatness stencil can't leave a state in which both triangles of an edge lie
 * in one plane, and friction and contact hold most others that look at the body. So hinges with a
 * sign: cloth that faces in turns about the edges where it goes on from cloth that does not, a
 * little in each sweep, towards the side on which it already is; to the outside when it is on none.
 * A patch that lies outside beyond a straight line swings back as a whole, like a page. Elsewhere,
 * in a cuff or a pleat, only the triangles at the line turn, and the fold rolls along the cloth
 * until it leaves it by a rim. Nothing passes through anything on the way. */
#include "cloth_private.h"

enum {
	TURN_TIRES = 4, /* turning for a round costs a triangle so much, and facing out for one
			   gives 1 back */
	TIRED = 240,
	SWING_ROUNDS_MAX = 60, /* a patch that does not get there is looked at again */
	LOOK_UNITS = 1,        /* normals only */
	FOLD_UNITS = 8,        /* an exact look at a triangle that seems to face in */
};

enum facing {
	FACING_SIDE, /* or far from the body: no opinion */
	FACING_OUT,
	FACING_IN,
};

static const float sharp_cosine = 0.5f;  /* between the normals of a sharp bend: less */
static const float straight = 0.9f;      /* least share of a line's ways that lead along it */
static const float turn_most_rad = 0.4f; /* in a sweep */
static const float turn_most_m = 0.004f; /* of the corner beyond the edge */
static const float deep_edges = 6.0f;    /* a patch that does not reach so far rolls */
static const float open_rad = 0.5f;      /* a patch that has swung so near to flat is open */
static const float no_side_rad = 0.02f;  /* from folded flat: it is on neither side */
static const float out_near_m = 0.06f;   /* farther cloth has no opinion */
static const float out_cosine = 0.25f;   /* least, between a normal and the body's, to face out */

static struct v3 normal_of(const struct cloth *cloth, int t)
{
	const int *v = cloth->triangle[t].v;
	const struct v3 *x = cloth->position_m;
	return v3_normalize(v3_cross(v3_sub(x[v[1]], x[v[0]]), v3_sub(x[v[2]], x[v[0]])));
}

/* Beyond doubt, without the roots of the normals' lengths. */
static bool surely_out(const struct cloth *cloth, const int *v, struct v3 outward)
{
	const struct v3 *x = cloth->position_m;
	struct v3 normal = v3_cross(v3_sub(x[v[1]], x[v[0]]), v3_sub(x[v[2]], x[v[0]]));
	float along = v3_dot(normal, outward), lengths2 = v3_dot(normal, normal);
	lengths2 *= v3_dot(outward, outward);
	return along > 0.0f && lengths2 > 1e-20f &&
	       along * along > 1.1f * out_cosine * out_cosine * lengths2;
}

/* Cheap for the many that face out. */
static enum facing facing_of(const struct cloth *cloth, int t, const int *v, long *units)
{
	struct v3 outward = {0.0f, 0.0f, 0.0f};
	float near_m = 1.0f;
	if (!corners_placed(cloth, t))
		return FACING_SIDE;
	*units += LOOK_UNITS;
	for (int k = 0; k < 3; k++) {
		outward = v3_add(outward, cloth->contact[v[k]].normal);
		near_m = float_min(near_m, cloth->contact[v[k]].distance_m);
	}
	if (near_m > out_near_m)
		return FACING_SIDE;
	if (surely_out(cloth, v, outward))
		return FACING_OUT;
	float cosine = v3_dot(normal_of(cloth, t), v3_normalize(outward));
	if (cosine >= 0.0f && cosine < out_cosine)
		return FACING_SIDE;
	if (cosine > 0.0f)
		return FACING_OUT;
	*units += FOLD_UNITS;
	return cloth_folded(cloth, t) ? FACING_IN : FACING_SIDE;
}

/* A crease is wanted. */
static bool is_creased(const struct cloth *cloth, int t)
{
	const int *v = cloth->triangle[t].v;
	return cloth->creased[v[0]] && cloth->creased[v[1]] && cloth->creased[v[2]];
}

/* The patch round triangle t that no sharp bend divides, into s->patch from `first` on. Returns its
 * end. */
static int flood(struct cloth *cloth, int t, int first)
{
	struct cloth_scratch *s = cloth->scratch;
	int end = first;
	s->patch[end++] = t;
	s->in_patch[t] = 1;
	for (int i = first; i < end; i++) {
		struct v3 normal = normal_of(cloth, s->patch[i]);
		for (int k = 0; k < 3; k++) {
			int across = s->across[3 * s->patch[i] + k], u = across / 3;
			if (across < 0 || s->in_patch[u] || !triangle_placed(cloth, u) ||
			    v3_dot(normal, normal_of(cloth, u)) < sharp_cosine)
				continue;
			s->patch[end++] = u;
			s->in_patch[u] = 1;
		}
	}
	return end;
}

/* A patch between sharp bends faces in as a whole if most of it does that has an opinion, and if
 * enough of it has one. */
static bool all_in(struct cloth *cloth, int first, int end)
{
	struct cloth_scratch *s = cloth->scratch;
	int in = 0, out = 0;
	for (int i = first; i < end; i++) {
		in += s->facing[s->patch[i]] == FACING_IN;
		out += s->facing[s->patch[i]] == FACING_OUT;
	}
	bool all = in > out && 4 * in > end - first;
	for (int i = first; i < end && all; i++)
		s->facing[s->patch[i]] = FACING_IN;
	return all;
}

/* Edges at which triangle t, which faces in, meets cloth that does not. One that has turned for so
 * long is held by something: it is left alone until it has faced out, or the cloth would tremble.
 */
static void list_hinges(struct cloth *cloth, int t)
{
	struct cloth_scratch *s = cloth->scratch;
	int before = s->hinge_count;
	for (int k = 0; k < 3 && s->turned[t] < TIRED && !is_creased(cloth, t); k++) {
		int across = s->across[3 * t + k];
		if (across >= 0 && s->facing[across / 3] != FACING_IN &&
		    triangle_placed(cloth, across / 3) && s->hinge_count < HINGES_MAX)
			s->hinge[s->hinge_count++] = 3 * t + k;
	}
	if (s->hinge_count > before)
		s->turned[t] = (uint8_t)(s->turned[t] + TURN_TIRES);
}

/* What was found in the round becomes folds: patches as a whole, and what faces in by itself. */
static long gather(struct cloth *cloth)
{
	struct cloth_scratch *s = cloth->scratch;
	int count = cloth->garment->triangle_count, first = 0;
	s->open_count = s->hinge_count = s->swing_rounds = 0;
	if (s->facing_in == 0)
		return 0;
	memset(s->in_patch, 0, (size_t)count * sizeof *s->in_patch);
	for (int t = 0; t < count; t++) {
		if (s->facing[t] != FACING_IN || s->in_patch[t])
			continue;
		int end = flood(cloth, t, first), hinges = s->hinge_count;
		bool all = all_in(cloth, first, end);
		for (int i = first; i < end; i++)
			if (s->facing[s->patch[i]] == FACING_IN)
				list_hinges(cloth, s->patch[i]);
		if (s->hinge_count > hinges && s->open_count < FOLDS_MAX)
			s->fold[s->open_count++] = (struct fold){first, all ? end : first, hinges,
								 s->hinge_count};
		first = end;
	}
	return 2L * first;
}

/* ---- in every sweep ---- */

static void move(struct cloth *cloth, int v, struct v3 way)
{
	if (cloth->held[v] < 2)
		cloth->position_m[v] = v3_add(cloth->position_m[v], way);
}

/* The angle about the unit vector `axis` that takes a normal to another. */
static float angle_about(struct v3 axis, struct v3 from, struct v3 to)
{
	return angle_atan2(v3_dot(v3_cross(from, to), axis), v3_dot(from, to));
}

/* A triangle at the line turns about an axis through its centre: its corner beyond the edge goes
 * twice as far as the edge comes to meet it, so that it finds room over the body. */
static void roll(struct cloth *cloth, int hinge)
{
	const struct v3 *x = cloth->position_m;
	int t = hinge / 3, k = hinge % 3;
	const int *v = cloth->triangle[t].v;
	int a = v[k], b = v[(k + 1) % 3], d = v[(k + 2) % 3];
	struct v3 edge = v3_normalize(v3_sub(x[b], x[a])), arm = v3_sub(x[d], x[a]);
	struct v3 onto = normal_of(cloth, cloth->scratch->across[hinge] / 3);
	float angle = angle_about(edge, normal_of(cloth, t), onto);
	if (float_abs(angle) > PI_F - no_side_rad)
		angle = -float_abs(angle);
	arm = v3_mad(arm, edge, -v3_dot(arm, edge));
	float most = float_min(turn_most_rad, turn_most_m / float_max(v3_length(arm), 1e-6f));
	struct v3 way = v3_sub(v3_turn(arm, edge, float_clamp(angle, -most, most)), arm);
	move(cloth, d, v3_scale(way, 2.0f / 3.0f));
	move(cloth, a, v3_scale(way, -1.0f / 3.0f));
	move(cloth, b, v3_scale(way, -1.0f / 3.0f));
}

/* The line of a fold's hinges: through the mean of their middles, along their sum. */
struct line {
	struct v3 through, along, onto; /* onto: the normal of the cloth before it */
	float straight; /* 0..1: share of the ways along the hinges that lead along it */
	float side;     /* -1..1: how far outside of the cloth before it the fold begins */
};

static struct line line_of(const struct cloth *cloth, const struct fold *fold)
{
	const struct cloth_scratch *s = cloth->scratch;
	const struct v3 *x = cloth->position_m;
	struct line line;
	memset(&line, 0, sizeof line);
	float lengths = 1e-6f, arms = 1e-6f;
	for (int i = fold->hinge_first; i < fold->hinge_end; i++) {
		int t = s->hinge[i] / 3, k = s->hinge[i] % 3;
		const int *v = cloth->triangle[t].v;
		struct v3 a = x[v[k]], b = x[v[(k + 1) % 3]], d = x[v[(k + 2) % 3]];
		struct v3 normal = normal_of(cloth, s->across[s->hinge[i]] / 3);
		float length = v3_distance(a, b);
		line.along = v3_add(line.along, v3_sub(b, a));
		line.through = v3_mad(line.through, v3_lerp(a, b, 0.5f), length);
		line.onto = v3_add(line.onto, normal);
		line.side += v3_dot(v3_sub(d, a), normal);
		lengths += length;
		arms += v3_distance(a, d);
	}
	line.through = v3_scale(line.through, 1.0f / lengths);
	line.straight = v3_length(line.along) / lengths;
	line.along = v3_normalize(line.along);
	line.side /= arms;
	return line;
}

/* Corners of a fold's triangles, without those of its line, into s->swung; returns how many. */
static int corners_of(struct cloth *cloth, const struct fold *fold)
{
	struct cloth_scratch *s = cloth->scratch;
	int count = 0;
	s->swing++;
	for (int i = fold->hinge_first; i < fold->hinge_end; i++)
		for (int end = 0; end < 2; end++)
			s->swung_in[cloth->triangle[s->hinge[i] / 3].v[(s->hinge[i] + end) % 3]] =
				s->swing;
	for (int i = fold->first; i < fold->end; i++)
		for (int k = 0; k < 3; k++) {
			int v = cloth->triangle[s->patch[i]].v[k];
			if (s->swung_in[v] == s->swing)
				continue;
			s->swung_in[v] = s->swing;
			s->swung[count++] = v;
		}
	return count;
}

/* The farthest of some particles from a line. */
static float reach_of(const struct cloth *cloth, int count, const struct line *line)
{
	float reach = 1e-6f;
	for (int i = 0; i < count; i++) {
		struct v3 arm = v3_sub(cloth->position_m[cloth->scratch->swung[i]], line->through);
		reach = float_max(reach, v3_length(v3_cross(arm, line->along)));
	}
	return reach;
}

/* The patch swings about its line, no corner farther than turn_most_m. False: the line is not
 * straight, or there is no room, or it is open. */
static bool swing(struct cloth *cloth, const struct fold *fold)
{
	struct cloth_scratch *s = cloth->scratch;
	struct line line = line_of(cloth, fold);
	struct v3 normal = {0.0f, 0.0f, 0.0f};
	for (int i = fold->first; i < fold->end; i++)
		normal = v3_add(normal, normal_of(cloth, s->patch[i]));
	float angle = -float_abs(angle_about(line.along, normal, line.onto));
	if (fold->first == fold->end || line.straight < straight || line.side < -no_side_rad ||
	    angle > -open_rad)
		return false;
	int count = corners_of(cloth, fold);
	float reach = reach_of(cloth, count, &line);
	if (reach < deep_edges * cloth->garment->edge_m)
		return false;
	angle = float_max(angle, -turn_most_m / reach);
	for (int i = 0; i < count; i++) {
		int v = s->swung[i];
		struct v3 arm = v3_sub(cloth->position_m[v], line.through);
		struct v3 way = v3_sub(v3_turn(arm, line.along, angle), arm);
		move(cloth, v, way);
		cloth->previous_m[v] = v3_add(cloth->previous_m[v],
					      way); /* no momentum: it would swing past */
	}
	return true;
}

long cloth_hinges(struct cloth *cloth)
{
	struct cloth_scratch *s = cloth->scratch;
	int slice = cloth->sweep % SLICES, triangles = cloth->garment->triangle_count;
	const struct turn *turn = &s->turn[sliced(triangles, slice)];
	long units = 0;
	bool swings = false;
	for (int f = 0; f < s->open_count; f++) {
		const struct fold *fold = &s->fold[f];
		units += fold->end - fold->first + fold->hinge_end - fold->hinge_first;
		if (swing(cloth, fold)) {
			swings = true;
			continue;
		}
		for (int i = fold->hinge_first; i < fold->hinge_end; i++)
			roll(cloth, s->hinge[i]);
	}
	for (int t = slice; t < triangles; t += SLICES, turn++) {
		s->facing[t] = (uint8_t)facing_of(cloth, t, turn->v, &units);
		s->facing_in += s->facing[t] == FACING_IN;
		if (s->facing[t] == FACING_OUT && s->turned[t] > 0)
			s->turned[t]--;
	}
	if (slice == SLICES - 1) {
		if (!swings || s->swing_rounds++ > SWING_ROUNDS_MAX)
			units += gather(cloth);
		s->facing_in = 0;
	}
	return units;
}
