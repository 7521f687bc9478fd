/* The body to be dressed: a closed triangle mesh with everything that finds its surface quickly.
 * Metres, +Y up, feet at y = 0, facing +Z, so that the wearer's left is +X. */
#ifndef BODY_H
#define BODY_H

#include "arena.h"
#include "body_landmark.h"
#include "bone.h"
#include "garment.h"
#include "vec.h"

/* A point farther from the body than this is only known to be so. */
#define BODY_NEAR_M 0.06f

struct bvh_node {
	struct v3 low_m, high_m;
	int first; /* first triangle slot (leaf) or left child; the right child follows it */
	int count; /* triangles in a leaf, 0 in an inner node */
};

/* A ball that no surface reaches into. */
struct ball {
	struct v3 centre_m;
	float radius_m;
};

struct body {
	int vertex_count;
	struct v3 *position_m;
	struct v3 *normal; /* angle-weighted, outward */
	int triangle_count;
	struct triangle *triangle;
	struct v3 *face_normal;
	int *neighbour;  /* 3 per triangle: across the edge v[k] v[k+1]; -1 at a rim */
	int *star_first; /* per vertex + 1: its triangles are star[star_first[v] ..] */
	int *star;
	uint8_t *part; /* per triangle: enum body_part */
	int node_count;
	struct bvh_node *node;
	int *node_triangle; /* slots */
	struct near_tree *near;
	struct prism *prism;       /* per triangle (body_look.h) */
	struct ball *clear;        /* per triangle: on its middle, without surface in it */
	struct ball *corner_clear; /* per vertex */
	int bone_count; /* spine from the pelvis up, neck, head, limbs; collar-bones and hips last
			 */
	struct bone bone[BODY_BONES_MAX];
	struct landmark_line landmark[LANDMARK_COUNT];
	struct v3 low_m, high_m;
	uint64_t hash;                /* of positions and triangles: names the body in a journal */
	struct body_scratch *scratch; /* owned by body_*.c */
};

struct body_hit {
	int triangle;
	struct v3 point_m;
	struct v3 normal; /* smooth, outward: angle-weighted and interpolated */
	float distance_m; /* nearest queries: signed, negative inside. rays: along the ray */
};

void body_init(struct body *body, struct arena *arena);

/* Takes a mesh (copied; it may already lie in the body's own position_m and triangle pools, as the
 * mannequin's does, so copy with memmove). Returns NULL or what is wrong with it in words (empty,
 * an index out of range, not finite, too many for the pools, an open or non-manifold edge, no
 * volume). Builds normals, neighbours, stars and the tree. Does not find parts: see
 * body_find_parts. */
const char *body_build(struct body *body, const struct v3 *position_m, int vertex_count,
		       const struct triangle *triangle, int triangle_count);

/* Builds the mannequin of this house into the body (generator: body_mannequin.c). */
const char *body_build_mannequin(struct body *body);

/* Head, arms, legs, bones and landmarks for any standing figure (S19); on four feet the forelegs
 * are arms. Arms or legs that lie in one with the trunk, as under a robe, are part of it. Returns
 * false when neither were found, or no head: then everything is trunk and there are no bones. */
bool body_find_parts(struct body *body);

/* Bones from elsewhere take the place of those found: every triangle goes to the bone that is
 * nearest inside the body, and landmarks follow. Radii of 0 are measured. Returns NULL, or what is
 * wrong with bone *at (nothing has changed then). */
const char *body_give_bones(struct body *body, const struct bone_list *bones, int *at);

/* Exact nearest surface point. `parts` is a bit set of enum body_part to consider; 0 means all. */
void body_nearest(const struct body *body, struct v3 point_m, unsigned parts, struct body_hit *hit);

/* The same, quicker when triangle `from` is known to lie near (-1: none). */
void body_nearest_from(const struct body *body, struct v3 point_m, unsigned parts, int from,
		       struct body_hit *hit);

/* The nearest point found by walking downhill from triangle `from` over stars, at most `steps_max`
 * steps (S17). Local: may be stuck on another limb; the caller refreshes by body_nearest. Returns
 * the triangles looked at. */
int body_walk(const struct body *body, struct v3 point_m, int from, int steps_max,
	      struct body_hit *hit);

/* What is known of a point that moves, from look to look. */
struct body_track {
	int triangle;   /* that holds its nearest point; -1: never looked */
	unsigned parts; /* that were asked for */
	struct v3 at_m; /* where it was looked up */
	float least_m;  /* no surface was nearer to it there; */
	float off_m;    /* and the one found was so much farther at most */
};

/* The nearest point within BODY_NEAR_M of a point that moves: a walk from the last one, and the
 * exact query where nothing proves that the walk has found it. A ball without surface in it
 * (body.clear) and the last look prove how near another surface can be at most: no nearer than the
 * ball's rim, or than it was before the point moved. What is found is so right to 0.9 mm
 * (track->off_m says how well). Farther points are looked up, to a tenth of their distance, when
 * they have gone a quarter of it; until then the hit stays as it is and false is returned.
 * hit->normal is the direction of the distance. Adds the triangles looked at to *units. */
bool body_track(const struct body *body, struct v3 point_m, unsigned parts,
		struct body_track *track, struct body_hit *hit, long *units);

/* How far a point looked up may go from there until it is to be looked up again because it is far;
 * 0 or less within BODY_NEAR_M, where that is the caller's to say. */
float body_track_idle_m(const struct body_track *track);

/* Do the balls without surface that rest on triangle t hold the whole way between two points? */
bool body_clear_between(const struct body *body, int t, struct v3 a_m, struct v3 b_m);

/* First hit of a ray with a front face (or, with `back`, the last hit with a back face: laser
 * mode's other side). Direction of any length; distance in units of it. False: no hit. */
bool body_ray(const struct body *body, struct v3 origin_m, struct v3 direction,
	      struct body_hit *hit);
bool body_ray_back(const struct body *body, struct v3 origin_m, struct v3 direction,
		   struct body_hit *hit);

/* The first hit with a back face: where a ray from inside leaves the body. */
bool body_ray_out(const struct body *body, struct v3 origin_m, struct v3 direction,
		  struct body_hit *hit);

/* Does an edge of cloth pass so near to a bone of the part (a limb or head and neck) that it must
 * be inside, whatever its ends do? Then *push_m is the way that brings it out of the bone's core:
 * to the side of `outward` (the sum of the surface's unit normals at the edge's ends), or, when the
 * two cancel, to the side on which it lies. */
bool body_bone_crossed(const struct body *body, enum body_part part, struct v3 a_m, struct v3 b_m,
		       struct v3 outward, struct v3 *push_m);

/* Does the segment pass through the surface? */
bool body_segment_hits(const struct body *body, struct v3 a_m, struct v3 b_m, struct body_hit *hit);

#endif
