/* Landmarks: named lines on any body that has bones, so that a mark can be stated once and found on
 * every body. Each lies on the surface, begins where anatomy says, and has stops on its way: stop 0
 * is its start, the last one its end. A place on a line is given in stops: 0.6 is 60 % of the way
 * from the start to the first stop after it, 1.5 half-way between the next two.
 *
 * The levels and planes are those of tailors (ISO 8559-1, Size designation of clothes: girths by
 * the convex hull of a plane section, as a tape measure lies). */
#ifndef BODY_LANDMARK_H
#define BODY_LANDMARK_H

#include "limits.h"
#include "vec.h"

/*   landmark   name   its stops, the start first */
#define LANDMARK_SIDES(X, SIDE, side)                                                              \
	X(LANDMARK_SIDE_##SIDE, "side-" side, "armpit, waist, hip, ankle")                         \
	X(LANDMARK_SHOULDER_##SIDE, "shoulder-" side, "neck, shoulder point")                      \
	X(LANDMARK_ARM_TOP_##SIDE, "arm-" side "-top", "shoulder point, elbow, wrist")             \
	X(LANDMARK_ARM_UNDER_##SIDE, "arm-" side "-under", "armpit, elbow, wrist")                 \
	X(LANDMARK_ARM_FRONT_##SIDE, "arm-" side "-front", "armhole, elbow, wrist")                \
	X(LANDMARK_ARM_BACK_##SIDE, "arm-" side "-back", "armhole, elbow, wrist")                  \
	X(LANDMARK_LEG_FRONT_##SIDE, "leg-" side "-front", "hip, knee, ankle")                     \
	X(LANDMARK_LEG_BACK_##SIDE, "leg-" side "-back", "hip, knee, ankle")                       \
	X(LANDMARK_LEG_OUTER_##SIDE, "leg-" side "-outer", "hip, knee, ankle")                     \
	X(LANDMARK_LEG_INNER_##SIDE, "leg-" side "-inner", "crotch, knee, ankle")                  \
	X(LANDMARK_ROUND_UPPER_ARM_##SIDE, "round-upper-arm-" side, "front, and round to it")      \
	X(LANDMARK_ROUND_WRIST_##SIDE, "round-wrist-" side, "front, and round to it")              \
	X(LANDMARK_ROUND_THIGH_##SIDE, "round-thigh-" side, "front, and round to it")              \
	X(LANDMARK_ROUND_ANKLE_##SIDE, "round-ankle-" side, "front, and round to it")

#define LANDMARK_TABLE(X)                                                                          \
	X(LANDMARK_FRONT_CENTRE, "front-centre", "neck pit, waist, crotch")                        \
	X(LANDMARK_BACK_CENTRE, "back-centre", "nape, waist, crotch")                              \
	X(LANDMARK_HEAD_CENTRE, "head-centre", "forehead, crown, nape")                            \
	X(LANDMARK_FACE_CENTRE, "face-centre", "forehead, nose, throat")                           \
	X(LANDMARK_EAR_TO_EAR, "ear-to-ear", "right ear, nose, left ear")                          \
	X(LANDMARK_ROUND_HEAD, "round-head", "forehead, and round to it")                          \
	X(LANDMARK_ROUND_NECK, "round-neck", "front, and round to it")                             \
	X(LANDMARK_ROUND_CHEST, "round-chest", "front, and round to it")                           \
	X(LANDMARK_ROUND_WAIST, "round-waist", "front, and round to it")                           \
	X(LANDMARK_ROUND_HIP, "round-hip", "front, and round to it")                               \
	LANDMARK_SIDES(X, LEFT, "left")                                                            \
	LANDMARK_SIDES(X, RIGHT, "right")

enum landmark {
#define X(landmark, name, stops) landmark,
	LANDMARK_TABLE(X)
#undef X
		LANDMARK_COUNT,
};

enum { LANDMARK_STOPS_MAX = 4 };

struct landmark_line {
	int count; /* 0: this body has no such landmark */
	struct v3 point_m[MARK_POINTS_MAX];
	struct v3 normal[MARK_POINTS_MAX]; /* of the surface, outward */
	int stop_count;
	float stop_m[LANDMARK_STOPS_MAX]; /* arc length from the start, rising */
	bool closed;                      /* the last point is the first */
	float girth_m;                    /* closed: of its convex hull */
};

extern const char *const landmark_name[LANDMARK_COUNT];
extern const char *const landmark_stops[LANDMARK_COUNT];

struct body;

/* The landmark of that name; LANDMARK_COUNT: there is none. */
enum landmark landmark_find(const char *name);

/* Draws every landmark that the body's bones allow, into body->landmark. Called whenever bones were
 * found or given; a body without bones has none. */
void body_find_landmarks(struct body *body);

/* The piece of a landmark between two places (in stops; from > to: backwards; past the ends of a
 * closed line: on round it, otherwise clamped), both moved on by `along_m` towards the line's end,
 * and the whole moved `aside_m` over the surface, to the left of the way as seen from outside (the
 * way from start to end, whatever from and to). Returns the points, at most MARK_POINTS_MAX, or 0:
 * no such landmark, or shorter than 5 mm. */
int landmark_cut(const struct body *body, enum landmark landmark, float from, float to,
		 float along_m, float aside_m, struct v3 point_m[MARK_POINTS_MAX],
		 struct v3 normal[MARK_POINTS_MAX]);

#endif
