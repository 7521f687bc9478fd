/* Bones: a path through a limb becomes two or three segments that bend where the limb bends. */
#include "body_parts.h"

enum { JOINTS_MAX = 4, SKULL_SAMPLES = 16 };

/* Joints are places on a path, in order, both ends among them. */
struct joints {
	int count;
	int at[JOINTS_MAX];
};

static float distance_to_segment(struct v3 p, struct v3 a, struct v3 b)
{
	struct v3 ab = v3_sub(b, a);
	float length2 = v3_dot(ab, ab);
	float share = length2 > 0.0f ? v3_dot(v3_sub(p, a), ab) / length2 : 0.0f;
	return v3_distance(p, v3_mad(a, ab, float_clamp(share, 0.0f, 1.0f)));
}

static float path_length(const struct path *path, int from, int to)
{
	float length = 0.0f;
	for (int i = from; i < to; i++)
		length += v3_distance(path->point_m[i], path->point_m[i + 1]);
	return length;
}

static float mean_radius(const struct path *path, int from, int to)
{
	float sum = 0.0f;
	for (int i = from; i <= to; i++)
		sum += path->radius_m[i];
	return sum / (float)(to - from + 1);
}

/* The place between two joints that lies farthest from the straight line, among those whose share
 * of the way is within [0.5 - span, 0.5 + span]; the middle of the way when all lie on it. */
static int bend(const struct path *path, int from, int to, float span, float *deviation_m)
{
	float length = path_length(path, from, to), along = 0.0f, middle_off = 2.0f;
	int middle = from, farthest = -1;
	*deviation_m = 0.1f * mean_radius(path, from, to);
	for (int i = from + 1; i < to; i++) {
		along += v3_distance(path->point_m[i - 1], path->point_m[i]);
		float off = length > 0.0f ? float_abs(along / length - 0.5f) : 0.0f;
		if (off < middle_off) {
			middle_off = off;
			middle = i;
		}
		float deviation = distance_to_segment(path->point_m[i], path->point_m[from],
						      path->point_m[to]);
		if (off <= span && deviation > *deviation_m) {
			*deviation_m = deviation;
			farthest = i;
		}
	}
	return farthest >= 0 ? farthest : middle;
}

static void add_joint(struct joints *joints, int place)
{
	int i = joints->count++;
	for (; i > 0 && joints->at[i - 1] > place; i--)
		joints->at[i] = joints->at[i - 1];
	joints->at[i] = place;
}

/* Where the next joint is wanted most. A bone that is still most of the limb gets its joint near
 * its middle (a straight elbow, a knee); else the greatest bend wins, measured in radii. */
static float best_joint(const struct path *path, const struct joints *joints, int *place)
{
	float whole = path_length(path, 0, path->count - 1), most = 0.0f;
	for (int i = 0; i + 1 < joints->count; i++) {
		int from = joints->at[i], to = joints->at[i + 1];
		float deviation_m;
		bool is_long = joints->count > 2 && path_length(path, from, to) > 0.62f * whole;
		int at = bend(path, from, to, is_long ? 0.15f : 0.5f, &deviation_m);
		float want = is_long ? 100.0f : deviation_m / mean_radius(path, from, to);
		if (at > from && at < to && want > most) {
			most = want;
			*place = at;
		}
	}
	return most;
}

/* At least `least` joints when the path has room for them, the ends among them; more where it bends
 * by 0.4 radii. */
static void find_joints(const struct path *path, int least, struct joints *joints)
{
	int place = 0;
	*joints = (struct joints){2, {0, path->count - 1, 0, 0}};
	while (joints->count < JOINTS_MAX) {
		float want = best_joint(path, joints, &place);
		if (want <= 0.0f || (want < 0.4f && joints->count >= least))
			return;
		add_joint(joints, place);
	}
}

static void add_bone(struct body *body, enum body_part part, struct v3 a_m, struct v3 b_m,
		     float radius_m)
{
	MUST(body->bone_count < BODY_BONES_MAX);
	body->bone[body->bone_count++] = (struct bone){
		.part = part, .a_m = a_m, .b_m = b_m, .radius_m = radius_m};
}

static void add_path(struct body *body, enum body_part part, const struct path *path,
		     const struct joints *joints)
{
	for (int i = 0; i + 1 < joints->count; i++) {
		int from = joints->at[i], to = joints->at[i + 1];
		if (to > from)
			add_bone(body, part, path->point_m[from], path->point_m[to],
				 mean_radius(path, from, to));
	}
}

/* Does a section's middle lie at least a share of its radius under the skin? */
static bool is_covered(const struct body *body, const struct path *path, int i, float share)
{
	struct body_hit hit;
	body_nearest(body, path->point_m[i], 0, &hit);
	return hit.distance_m < -share * path->radius_m[i];
}

/* Takes the tip off a limb as far as its sections part, as a hand's do into fingers: their middle
 * then lies in the open or just under the skin. */
static void trim_hand(const struct body *body, struct path *path)
{
	for (int i = path->count / 2; i < path->count; i++)
		if (!is_covered(body, path, i, 0.2f)) {
			path->count = i;
			return;
		}
}

/* The lowest sections of the trunk may hold its seat alone, since the legs are left out. */
static void trim_seat(const struct body *body, struct path *path)
{
	int first = 0;
	while (first < path->count / 3 && !is_covered(body, path, first, 0.4f))
		first++;
	path->count -= first;
	memmove(path->point_m, path->point_m + first, (size_t)path->count * sizeof *path->point_m);
	memmove(path->radius_m, path->radius_m + first,
		(size_t)path->count * sizeof *path->radius_m);
}

static void add_whole(struct body *body, enum body_part part, const struct path *path)
{
	struct joints ends = {2, {0, int_max(path->count - 1, 0), 0, 0}};
	add_path(body, part, path, &ends);
}

/* From the spine to where a limb's first bone begins: collar-bones and hips. */
static void add_girdle(struct body *body, struct v3 from_m, const struct path *limb)
{
	if (limb->count > 0)
		add_bone(body, PART_TRUNK, from_m, limb->point_m[0], limb->radius_m[0]);
}

/* Left and right have as many bones as the side that bends more. */
static void add_limbs(struct body *body, const struct path *left, const struct path *right,
		      enum body_part part_left, enum body_part part_right)
{
	struct joints a, b;
	find_joints(left, 3, &a);
	find_joints(right, a.count, &b);
	find_joints(left, b.count, &a);
	add_path(body, part_left, left, &a);
	add_path(body, part_right, right, &b);
}

/* Spine and neck meet: the trunk's highest sections lean to the back, where shoulders are, or hang
 * low, where a chest stands out; they are left out. */
static void join_neck(struct path *trunk, const struct path *neck)
{
	trunk->count -= trunk->count / 8;
	if (neck->count > 0)
		trunk->point_m[trunk->count - 1] = neck->point_m[0];
}

/* The crown's last sections are too near to it. */
static void trim_crown(const struct body *body, struct path *path)
{
	while (path->count > 3 && !is_covered(body, path, path->count - 1, 0.2f))
		path->count--;
}

static bool is_inside(const struct body *body, struct v3 a_m, struct v3 b_m)
{
	bool inside = true;
	for (int i = 0; i <= SKULL_SAMPLES && inside; i++) {
		struct body_hit hit;
		struct v3 p = v3_lerp(a_m, b_m, (float)i / (float)SKULL_SAMPLES);
		body_nearest(body, p, 0, &hit);
		inside = hit.distance_m < 0.0f;
	}
	return inside;
}

/* From the neck through the middle of the head: sections near the crown say little, since a crest
 * or a helmet's edge may be the highest. Where a throat is hollow their way goes round it. */
static void add_skull(struct body *body, const struct parts_scratch *s, struct path *path)
{
	struct v3 from_m = path->point_m[0];
	for (float share = 0.95f; share > 0.5f; share -= 0.05f) {
		struct v3 to_m = v3_lerp(from_m, s->head_end_m, share);
		if (!is_inside(body, from_m, to_m))
			continue;
		add_bone(body, PART_HEAD, from_m, to_m, mean_radius(path, 0, path->count - 1));
		return;
	}
	trim_crown(body, path);
	add_whole(body, PART_HEAD, path);
}

void parts_bones(struct body *body, struct parts_scratch *s, const int limb[PART_COUNT])
{
	struct path *trunk = &s->trunk, *path[PART_COUNT] = {NULL};
	struct joints joints;
	for (int part = PART_HEAD; part < PART_COUNT; part++)
		path[part] = limb[part] < 0 ? NULL : &s->limb[limb[part]].path;
	trim_seat(body, trunk);
	join_neck(trunk, &s->neck);
	body->bone_count = 0;
	find_joints(trunk, 3, &joints);
	add_path(body, PART_TRUNK, trunk, &joints);
	add_whole(body, PART_HEAD, &s->neck);
	add_skull(body, s, path[PART_HEAD]);
	for (int part = PART_ARM_LEFT; part < PART_COUNT; part += 2) {
		if (!path[part])
			continue;
		trim_hand(body, path[part]);
		trim_hand(body, path[part + 1]);
		add_limbs(body, path[part], path[part + 1], (enum body_part)part,
			  (enum body_part)(part + 1));
	}
	for (int part = PART_ARM_LEFT; part < PART_COUNT; part++)
		if (path[part])
			add_girdle(body,
				   trunk->point_m[part < PART_LEG_LEFT ? trunk->count - 1 : 0],
				   path[part]);
}
