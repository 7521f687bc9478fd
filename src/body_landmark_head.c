/* Landmarks of neck, head and shoulders. */
#include "body_landmark_private.h"

enum { GIRTH_STEPS = 16, FACE_STEPS = 48, EAR_STEPS = 64 };

/* The head's greatest girth, over forehead and the back of the head, lies in this part of the way
 * from the neck's upper end to the crown; the nose in that. */
static const float girth_low = 0.60f, girth_high = 0.75f;
static const float nose_low = 0.15f, nose_high = 0.55f;

/* From its middle a head reaches no farther, in lengths of its bone. */
static const float skull_reach = 1.2f;

/* A crown may be a crest or a helmet's edge. */
static const float skull_lean_max = 0.2f; /* tangent */

/* The collar lies at this share of the neck's length above its base. */
static const float collar_share = 0.15f;

static struct v3 toward(struct v3 from, struct v3 to)
{
	return v3_normalize(v3_sub(to, from));
}

/* The head's own frame: the trunk's, turned to the head's bone. */
static struct frame skull_frame(const struct landmark_scratch *s)
{
	int last = s->head.count - 1;
	struct v3 axis = lean_at_most(toward(s->head.point_m[last - 1], s->head.point_m[last]),
				      s->frame.axis, skull_lean_max);
	return (struct frame){axis, turn_onto(s->frame.front, s->frame.axis, axis),
			      turn_onto(s->frame.side, s->frame.axis, axis)};
}

static struct v3 skull_point(const struct landmark_scratch *s, float share)
{
	int last = s->head.count - 1;
	return v3_lerp(s->head.point_m[last - 1], s->head.point_m[last], share);
}

/* From outside, but not from beyond a raised arm. */
static bool skull_skin(const struct landmark_scratch *s, struct v3 to_m, struct v3 direction,
		       struct body_hit *hit)
{
	int last = s->head.count - 1;
	float far = skull_reach * v3_distance(s->head.point_m[last - 1], s->head.point_m[last]);
	return skin_inward(s->body, to_m, direction, far, hit);
}

/* The section of the skull from outside: mouths do not matter. */
static bool skull_section(struct landmark_scratch *s, const struct frame *frame, float share)
{
	struct body_hit hit;
	return skull_skin(s, skull_point(s, share), frame->front, &hit) &&
	       section_walk(s, &hit, frame->axis);
}

static float keep_round_head(struct landmark_scratch *s, const struct frame *frame)
{
	float best = 0.0f, at = 0.5f * (girth_low + girth_high);
	for (int i = 0; i <= GIRTH_STEPS; i++) {
		float share = girth_low + (girth_high - girth_low) * (float)i / (float)GIRTH_STEPS;
		float girth = skull_section(s, frame, share) ? section_girth(s, frame) : 0.0f;
		if (girth > best) {
			best = girth;
			at = share;
		}
	}
	if (skull_section(s, frame, at))
		sketch_keep_round(s, LANDMARK_ROUND_HEAD, frame);
	return at;
}

/* From the forehead over the crown, down the back of the head and the neck: seen from outside. */
static void keep_head_centre(struct landmark_scratch *s, const struct frame *frame, float forehead)
{
	struct body_hit hit;
	struct v3 middle = skull_point(s, forehead);
	sketch_begin(s);
	for (int i = 0; i <= 2 * FACE_STEPS; i++) {
		float t = (float)i / (float)FACE_STEPS; /* 0 front, 1 up, 2 back and down */
		struct v3 direction = t < 1.0f ? v3_lerp(frame->front, frame->axis, t)
					       : v3_lerp(frame->axis, v3_scale(frame->front, -1.0f),
							 t - 1.0f);
		if (!skull_skin(s, middle, v3_normalize(direction), &hit))
			continue;
		sketch_add(s, hit.point_m);
		if (i == 0 || i == FACE_STEPS)
			sketch_stop(s);
	}
	for (int i = 1; i < FACE_STEPS; i++) {
		float share = (float)i / (float)FACE_STEPS;
		struct v3 at = v3_lerp(middle, s->head.point_m[0], share);
		if (skull_skin(s, at, v3_scale(frame->front, -1.0f), &hit))
			sketch_add(s, hit.point_m);
	}
	sketch_add(s, s->nape_m);
	sketch_stop(s);
	sketch_keep(s, LANDMARK_HEAD_CENTRE);
}

/* Where the face stands out most, as a share of the skull's bone. */
static float nose_share(struct landmark_scratch *s, const struct frame *frame)
{
	float best = -1e9f, at = 0.5f * (nose_low + nose_high);
	for (int i = 0; i <= GIRTH_STEPS; i++) {
		struct body_hit hit;
		float share = nose_low + (nose_high - nose_low) * (float)i / (float)GIRTH_STEPS;
		struct v3 middle = skull_point(s, share);
		if (!skull_skin(s, middle, frame->front, &hit))
			continue;
		float out = v3_dot(v3_sub(hit.point_m, middle), frame->front);
		if (out > best) {
			best = out;
			at = share;
		}
	}
	return at;
}

static void keep_face(struct landmark_scratch *s, const struct frame *frame, float forehead,
		      float nose)
{
	sketch_begin(s);
	for (int i = 0; i <= FACE_STEPS; i++) {
		struct body_hit hit;
		float share = forehead * (1.0f - (float)i / (float)FACE_STEPS);
		if (skull_skin(s, skull_point(s, share), frame->front, &hit))
			sketch_add(s, hit.point_m);
		if (s->sketch.count == 0)
			return;
		float next = forehead * (1.0f - (float)(i + 1) / (float)FACE_STEPS);
		if (i == 0 || (share >= nose && next < nose) || i == FACE_STEPS)
			sketch_stop(s);
	}
	sketch_keep(s, LANDMARK_FACE_CENTRE);
}

/* From the wearer's right to the left over the nose, at half the depth of the head beside the ears.
 */
static void keep_ears(struct landmark_scratch *s, const struct frame *frame, float nose)
{
	struct v3 middle = skull_point(s, nose);
	sketch_begin(s);
	for (int i = 0; i <= EAR_STEPS; i++) {
		struct body_hit hit;
		float angle = PI_F * (float)i / (float)EAR_STEPS;
		struct v3 direction = v3_add(v3_scale(frame->side, -angle_cos(angle)),
					     v3_scale(frame->front, angle_sin(angle)));
		if (skull_skin(s, middle, direction, &hit))
			sketch_add(s, hit.point_m);
		if (s->sketch.count == 0)
			return;
		if (i == 0 || i == EAR_STEPS / 2 || i == EAR_STEPS)
			sketch_stop(s);
	}
	sketch_keep(s, LANDMARK_EAR_TO_EAR);
}

/* ---- neck and shoulders ---- */

static void keep_shoulder(struct landmark_scratch *s, const struct frame *neck, struct v3 base_m,
			  int side)
{
	const struct limb_line *arm = &s->arm[side];
	struct body_hit hit;
	if (!arm->found ||
	    !skin_outward(s->body, base_m, v3_scale(neck->side, side == 0 ? 1.0f : -1.0f), &hit))
		return;
	struct v3 out = v3_normalize(v3_sub(arm->outer_m, hit.point_m));
	if (!section_walk(s, &hit, v3_normalize(v3_cross(s->frame.axis, out))))
		return;
	sketch_begin(s);
	sketch_section(s, 0, section_nearest(&s->section, arm->outer_m));
	sketch_keep(s, side == 0 ? LANDMARK_SHOULDER_LEFT : LANDMARK_SHOULDER_RIGHT);
}

static void keep_neck(struct landmark_scratch *s)
{
	struct v3 base = v3_lerp(s->head.point_m[0], s->head.point_m[1], collar_share);
	if (section_round(s, base, &s->head_frame))
		sketch_keep_round(s, LANDMARK_ROUND_NECK, &s->head_frame);
	for (int side = 0; side < 2; side++)
		keep_shoulder(s, &s->head_frame, base, side);
}

void landmark_head(struct landmark_scratch *s)
{
	struct frame skull = skull_frame(s);
	keep_neck(s);
	float forehead = keep_round_head(s, &skull);
	float nose = nose_share(s, &skull);
	keep_head_centre(s, &skull, forehead);
	keep_face(s, &skull, forehead, nose);
	keep_ears(s, &skull, nose);
}
