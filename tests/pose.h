/* The same figure in another pose: arms turned up or down about the shoulders. */
#ifndef POSE_H
#define POSE_H

#include "body.h"
#include "shapes.h"

/* Into the shape. `body` has its parts and landmarks; `arms` is taken from where they are, in rad,
 * positive upward. The turn fades out over a few rings of vertices round the arms. */
static inline void pose_arms(const struct body *body, float arms, struct shape *shape)
{
	enum { ROUNDS = 8 };
	static float weight[BODY_VERTICES_MAX], even[BODY_VERTICES_MAX];
	shape->vertex_count = body->vertex_count;
	shape->triangle_count = body->triangle_count;
	memcpy(shape->position_m, body->position_m,
	       (size_t)body->vertex_count * sizeof *body->position_m);
	memcpy(shape->triangle, body->triangle,
	       (size_t)body->triangle_count * sizeof *body->triangle);
	for (int side = 0; side < 2; side++) {
		int right = side * (LANDMARK_SIDE_RIGHT - LANDMARK_SIDE_LEFT);
		struct v3 top = body->landmark[LANDMARK_ARM_TOP_LEFT + right].point_m[0];
		struct v3 pit = body->landmark[LANDMARK_ARM_UNDER_LEFT + right].point_m[0];
		struct v3 joint = v3_lerp(top, pit, 0.5f), forward = {0.0f, 0.0f, 1.0f};
		memset(weight, 0, sizeof weight);
		for (int t = 0; t < body->triangle_count; t++)
			for (int k = 0; k < 3; k++)
				if (body->part[t] == PART_ARM_LEFT + side)
					weight[body->triangle[t].v[k]] = 1.0f;
		for (int round = 0; round < ROUNDS; round++) {
			for (int v = 0; v < body->vertex_count; v++) {
				int first = body->star_first[v], last = body->star_first[v + 1];
				even[v] = 0.0f;
				for (int i = 3 * first; i < 3 * last; i++)
					even[v] +=
						weight[body->triangle[body->star[i / 3]].v[i % 3]];
				even[v] /= (float)(3 * (last - first));
			}
			memcpy(weight, even, sizeof weight);
		}
		for (int v = 0; v < body->vertex_count; v++) {
			struct v3 *p = &shape->position_m[v];
			float angle = (side == 0 ? arms : -arms) * weight[v];
			*p = v3_add(joint, v3_turn(v3_sub(*p, joint), forward, angle));
		}
	}
}

#endif
