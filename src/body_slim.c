/* A body whose limbs, head and neck are drawn in to their bones, and whose trunk is flat: places,
 * normals and boxes; the rest is shared. */
#include "body_slim.h"

#include "body_limb.h"
#include "body_private.h"
#include "body_tree.h"

static const float flat_share = 0.5f;  /* of the trunk's depth that is left */
static const float root_share = 0.12f; /* of a limb's length, in which it narrows */

void body_slim_init(struct slim_body *slim_body, struct arena *arena)
{
	struct body *slim = &slim_body->body;
	memset(slim_body, 0, sizeof *slim_body);
	slim_body->way = ARENA_ARRAY(arena, struct slim_way, BODY_VERTICES_MAX);
	slim->position_m = ARENA_ARRAY(arena, struct v3, BODY_VERTICES_MAX);
	slim->normal = ARENA_ARRAY(arena, struct v3, BODY_VERTICES_MAX);
	slim->face_normal = ARENA_ARRAY(arena, struct v3, BODY_TRIANGLES_MAX);
	slim->node = ARENA_ARRAY(arena, struct bvh_node, BODY_NODES_MAX);
	slim->near = near_tree_init(arena);
	slim->part = ARENA_ARRAY(arena, uint8_t, BODY_TRIANGLES_MAX);
	slim->prism = ARENA_ARRAY(arena, struct prism, BODY_TRIANGLES_MAX);
	slim->clear = ARENA_ARRAY(arena, struct ball, BODY_TRIANGLES_MAX);
	slim->corner_clear = ARENA_ARRAY(arena, struct ball, BODY_VERTICES_MAX);
}

/* Everything but what the slim body has of its own. */
static void share_mesh(struct body *slim, const struct body *full)
{
	struct body own = *slim;
	*slim = *full;
	slim->position_m = own.position_m;
	slim->normal = own.normal;
	slim->face_normal = own.face_normal;
	slim->node = own.node;
	slim->near = own.near;
	slim->prism = own.prism;
	slim->clear = own.clear;
	slim->corner_clear = own.corner_clear;
	slim->part = own.part;
	memcpy(slim->part, full->part, (size_t)full->triangle_count);
	memcpy(slim->node, full->node, (size_t)full->node_count * sizeof *full->node);
	memset(slim->clear, 0, (size_t)full->triangle_count * sizeof *slim->clear);
	memset(slim->corner_clear, 0, (size_t)full->vertex_count * sizeof *slim->corner_clear);
}

static float length_of(const struct body *body, int part)
{
	float length_m = 0.0f;
	for (int b = 0; b < body->bone_count; b++)
		if ((int)body->bone[b].part == part)
			length_m += v3_distance(body->bone[b].a_m, body->bone[b].b_m);
	return length_m;
}

/* Hands and feet belong to no part that cloth may be asked to touch. */
static void hide(struct body *slim, int v)
{
	for (int i = slim->star_first[v]; i < slim->star_first[v + 1]; i++)
		slim->part[slim->star[i]] = PART_COUNT;
}

/* x of the figure's middle: the spine has it, collar-bones and hips come in pairs. */
static float middle_of(const struct body *body)
{
	float sum_m = 0.0f;
	int count = 0;
	for (int b = 0; b < body->bone_count; b++)
		if (body->bone[b].part == PART_TRUNK) {
			sum_m += body->bone[b].a_m.x;
			count++;
		}
	return sum_m / (float)int_max(count, 1);
}

/* Where a leg's vertex has to be drawn to for its inner side to reach over the middle. */
static struct v3 joined_to(struct v3 p_m, struct v3 axis_m, float middle_m)
{
	float way_m = middle_m - axis_m.x, x = v3_normalize(v3_sub(p_m, axis_m)).x;
	float inner = float_max(way_m > 0.0f ? x : -x, 0.0f);
	return (struct v3){p_m.x + inner * way_m / (1.0f - LIMB_THIN_SHARE), p_m.y, p_m.z};
}

/* The bones of a limb turn from where they point to one direction. */
static void find_turns(struct slim_body *slim, const struct body *full,
		       const struct v3 toward[PART_COUNT])
{
	memset(slim->turn, 0, sizeof slim->turn);
	for (int b = 0; toward && b < full->bone_count; b++) {
		const struct bone *bone = &full->bone[b];
		struct v3 from = v3_normalize(v3_sub(bone->b_m, bone->a_m));
		struct v3 to = toward[bone->part], axis = v3_cross(from, to);
		if (v3_length(axis) < 1e-4f)
			continue;
		slim->turn[b].axis = v3_normalize(axis);
		slim->turn[b].angle_rad = angle_acos(v3_dot(from, to));
	}
}

/* The bone of a limb that reaches so far, if it turns; -1: it does not. */
static int8_t bone_at(const struct slim_body *slim, const struct body *full, int part,
		      float reach_m)
{
	int found = -1;
	for (int b = 0; b < full->bone_count; b++) {
		const struct bone *bone = &full->bone[b];
		if ((int)bone->part != part || (found >= 0 && reach_m <= 0.0f))
			continue;
		reach_m -= v3_distance(bone->a_m, bone->b_m);
		found = b;
	}
	return (int8_t)(found >= 0 && slim->turn[found].angle_rad != 0.0f ? found : -1);
}

static void find_ways(struct slim_body *slim, const struct body *full,
		      const struct limb_shape *limb, unsigned whole)
{
	float length_m[PART_COUNT], middle_m = middle_of(full);
	for (int part = 0; part < PART_COUNT; part++)
		length_m[part] = length_of(full, part);
	for (int v = 0; v < full->vertex_count; v++) {
		struct beside at;
		struct v3 p = full->position_m[v];
		int part = full->part[full->star[full->star_first[v]]];
		struct slim_way *way = &slim->way[v];
		bool stays = whole >> part & 1, joined = stays && part >= PART_LEG_LEFT;
		*way = (struct slim_way){p, p.z, -1.0f, -1};
		if (!stays || joined)
			way->middle_m = body_nearest_bone(full, 1u << PART_TRUNK, p).z;
		if (part == PART_TRUNK || (stays && !joined) || !body_beside(full, part, p, &at))
			continue;
		if (!joined && part >= PART_ARM_LEFT && at.reach_m > limb[part].wrist_m)
			hide(&slim->body, v);
		way->axis_m = joined ? joined_to(p, at.axis_m, middle_m) : at.axis_m;
		way->in = float_clamp(at.reach_m / (root_share * length_m[part]), 0.0f, 1.0f);
		way->bone = bone_at(slim, full, part, at.reach_m);
	}
}

/* The trunk loses depth only: shoulders stay as far apart as the arms are. */
static struct v3 place(const struct slim_way *way, struct v3 p_m, float share)
{
	float deep = flat_share + share * (1.0f - flat_share);
	float wide = LIMB_THIN_SHARE + share * (1.0f - LIMB_THIN_SHARE);
	struct v3 flat_m = {p_m.x, p_m.y, way->middle_m + deep * (p_m.z - way->middle_m)};
	if (way->in < 0.0f)
		return flat_m;
	return v3_lerp(flat_m, v3_lerp(way->axis_m, p_m, wide), way->in);
}

/* The turn of a bone of which `share` is left. */
static struct v3 turned(const struct slim_turn *turn, struct v3 arm, float share)
{
	return v3_turn(arm, turn->axis, share * turn->angle_rad);
}

/* Where the bones of turned limbs begin when the body has grown to a share: each at the end of the
 * one before. */
static void pose(const struct slim_body *slim, const struct body *full, float share,
		 struct slim_turn turn[BODY_BONES_MAX])
{
	memcpy(turn, slim->turn, sizeof slim->turn);
	for (int b = 0; b < full->bone_count; b++) {
		const struct bone *bone = &full->bone[b];
		struct v3 moved = {0.0f, 0.0f, 0.0f};
		if (b > 0 && bone[-1].part == bone->part) {
			struct v3 way = v3_sub(bone->a_m, bone[-1].a_m);
			moved = v3_sub(turn[b - 1].at_m, bone[-1].a_m);
			if (turn[b - 1].angle_rad != 0.0f)
				moved = v3_add(
					moved,
					v3_sub(turned(&turn[b - 1], way, 1.0f - share), way));
		}
		turn[b].at_m = v3_add(bone->a_m, moved);
	}
}

/* A point goes with a bone: from where it would be if the bone were not turned. */
static struct v3 with_bone(const struct slim_body *slim, const struct body *full, int v,
			   struct v3 p_m)
{
	const struct slim_way *way = &slim->way[v];
	if (way->bone < 0)
		return p_m;
	const struct slim_turn *turn = &slim->turn[way->bone];
	struct v3 arm = v3_sub(p_m, full->bone[way->bone].a_m);
	struct v3 to_m = v3_add(turn->at_m, turned(turn, arm, 1.0f - slim->share));
	return v3_lerp(p_m, to_m, way->in);
}

struct v3 body_slim_carry(const struct slim_body *slim, const struct body *full, int triangle,
			  struct v3 p_m, float share)
{
	const int *v = full->triangle[triangle].v;
	struct slim_turn then[BODY_BONES_MAX];
	struct v3 way = {0.0f, 0.0f, 0.0f};
	pose(slim, full, share, then);
	for (int k = 0; k < 3; k++) {
		int b = slim->way[v[k]].bone;
		if (b < 0)
			continue;
		struct v3 arm = v3_sub(p_m, slim->turn[b].at_m);
		arm = turned(&slim->turn[b], arm, slim->share - share);
		struct v3 step = v3_sub(v3_add(then[b].at_m, arm), p_m);
		way = v3_mad(way, step, slim->way[v[k]].in);
	}
	return v3_mad(p_m, way, 1.0f / 3.0f);
}

void body_slim_grow(struct slim_body *slim, const struct body *full, float share)
{
	pose(slim, full, share, slim->turn);
	slim->share = share;
	for (int v = 0; v < full->vertex_count; v++)
		slim->body.position_m[v] = with_bone(
			slim, full, v, place(&slim->way[v], full->position_m[v], share));
	for (int b = 0; b < full->bone_count; b++) {
		const struct bone *bone = &full->bone[b];
		struct v3 a_m = slim->turn[b].at_m, way = v3_sub(bone->b_m, bone->a_m);
		struct v3 end_m = v3_add(bone->b_m, v3_sub(a_m, bone->a_m));
		if (slim->turn[b].angle_rad != 0.0f)
			end_m = v3_add(a_m, turned(&slim->turn[b], way, 1.0f - share));
		slim->body.bone[b].a_m = a_m;
		slim->body.bone[b].b_m = end_m;
	}
	body_build_normals(&slim->body);
	body_build_prisms(&slim->body);
	body_refit(&slim->body);
}

bool body_slim_make(struct slim_body *slim, const struct body *full, const struct limb_shape *limb,
		    unsigned whole, const struct v3 toward[PART_COUNT])
{
	if (full->bone_count == 0)
		return false;
	share_mesh(&slim->body, full);
	find_turns(slim, full, toward);
	find_ways(slim, full, limb, whole);
	body_slim_grow(slim, full, 0.0f);
	return true;
}
