/* Maps from plane to plane that keep lines straight: how the picture lies on the panel, how a
 * tablet lies under the hand, and what a calibration found. Pure; src's arithmetic only. */
#ifndef PLANE_MAP_H
#define PLANE_MAP_H

#include "vec.h"

/* (x, y, 1) times this, divided by the third of the result. */
struct plane_map {
	float m[3][3];
};

extern const struct plane_map plane_map_identity;

struct v2 plane_map_apply(const struct plane_map *map, struct v2 a);

/* First `first`, then `second`. */
struct plane_map plane_map_join(const struct plane_map *first, const struct plane_map *second);

/* False: the map has no inverse; *inverse is the identity then. */
bool plane_map_invert(const struct plane_map *map, struct plane_map *inverse);

/* A picture of a size onto a panel of a size, turned clockwise by quarter turns (0, 90, 180, 270),
 * with one scale, as large as fits, in the middle. y points down in both. */
struct plane_map plane_map_fit(struct v2 picture, int degrees, struct v2 panel);

enum { PLANE_MAP_POINTS_MIN = 4, PLANE_MAP_POINTS_MAX = 25 };

/* The map that takes points `from` to points `to`, by least squares over all of them (the direct
 * linear method in normalised coordinates; Hartley and Zisserman, Multiple View Geometry, 4.4).
 * *rms and *worst: what remains, in units of `to`. False, with a line in fault: too few points or
 * too many, points that coincide or lie on a line, or a map that folds the plane over between
 * them. */
bool plane_map_find(const struct v2 *from, const struct v2 *to, int count, struct plane_map *map,
		    float *rms, float *worst, char fault[200]);

#endif
