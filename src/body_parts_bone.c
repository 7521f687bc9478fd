/* Bones: a path through a limb becomes two or three segments that bend where the limb bends. */
#include "body_parts.h"

enum { JOINTS_MAX = 4 };

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

/* The first joint is the greatest bend anywhere (elbow or ankle); a bone that is still most of the
 * limb gets its joint near its middle (a straight elbow, a knee); else a bend that shows. */
static void find_joints(const struct path *path, struct joints *joints)
{
	float deviation_m;
	*joints = (struct joints){2, {0, path->count - 1, 0, 0}};
	if (path->count < 3)
		return;
	add_joint(joints, bend(path, 0, path->count - 1, 0.5f, &deviation_m));
	float whole = path_length(path, 0, path->count - 1);
	for (int i = 0; i + 1 < joints->count && joints->count < JOINTS_MAX; i++) {
		int from = joints->at[i], to = joints->at[i + 1];
		bool is_long = path_length(path, from, to) > 0.62f * whole;
		int place = bend(path, from, to, is_long ? 0.15f : 0.5f, &deviation_m);
		if (place > from && (is_long || deviation_m > 0.4f * mean_radius(path, from, to)))
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

void parts_bones(struct body *body, const struct parts_scratch *s, const int limb[PART_COUNT])
{
	const struct path *trunk = &s->trunk;
	struct joints joints;
	body->bone_count = 0;
	find_joints(trunk, &joints);
	add_path(body, PART_TRUNK, trunk, &joints);
	add_whole(body, PART_HEAD, &s->neck);
	add_whole(body, PART_HEAD, &s->limb[limb[PART_HEAD]].path);
	for (int part = PART_ARM_LEFT; part < PART_COUNT; part++) {
		const struct path *path = &s->limb[limb[part]].path;
		find_joints(path, &joints);
		add_path(body, (enum body_part)part, path, &joints);
	}
	for (int part = PART_ARM_LEFT; part < PART_COUNT && trunk->count > 0; part++)
		add_girdle(body, trunk->point_m[part < PART_LEG_LEFT ? trunk->count - 1 : 0],
			   &s->limb[limb[part]].path);
}
