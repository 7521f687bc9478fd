/* What `make bench-peers` measures kitsuke and its peers on: one body, one poncho, one clock. */
#ifndef PEERS_H
#define PEERS_H

#include "triangle.h"

#ifdef __cplusplus
struct v3 { /* as vec.h has it, which is C */
	float x, y, z;
};
extern "C" {
#else
#include "vec.h"
#endif

/* A tapered capsule: the hull of two spheres. */
struct capsule {
	struct v3 a_m, b_m;
	float a_radius_m, b_radius_m;
};

struct peers_body {
	int capsule_count, vertex_count, triangle_count;
	const struct capsule *capsule;
	struct v3 *position_m;
	struct triangle *triangle;
};

struct peers_cloth {
	int vertex_count, triangle_count;
	struct v3 *position_m; /* where it starts, and where it rests at last */
	struct triangle *triangle;
};

enum { DRAPE_FRAMES = 300 };

/* A drape of DRAPE_FRAMES frames of 1/60 s: the price of each, and what it came to. */
struct drape {
	double ms[DRAPE_FRAMES];
	double self_ms[DRAPE_FRAMES]; /* and cloth against cloth, which peers leave out */
	double mean_ms, worst_ms;     /* of all frames but the first, which builds tables */
	double self_mean_ms;
	double stretch_mean, stretch_max; /* 0.01: 1 %; edges longer than in the flat poncho */
	float low_m, high_m;
};

/* A figure of 1.7 m: the smooth union of 12 capsules, a closed mesh. The arrays are the caller's to
 * free. */
void peers_make_body(struct peers_body *body);

/* Thread CPU time. */
double peers_ms(void);

/* The peers; one that is not installed returns false.
 *
 * The cloth falls for DRAPE_FRAMES frames; it ends where it rests, and drape->ms is set. */
bool peer_bullet_drape(const struct peers_body *body, struct peers_cloth *cloth,
		       struct drape *drape);

/* Nearest distances of each frame's `count` points in turn, frame after frame, and the time of all
 * frames but the first. `bounded`: a query's radius is what the point's last distance and its step
 * since then allow. */
bool peer_embree_track(const struct peers_body *body, const struct v3 *point_m, int count,
		       int frames, bool bounded, float *distance_m, double *ms);

/* A shirt front of about so many triangles; the time of one meshing and the mesh's angles. */
struct mesh_figures {
	int triangles;
	double ms, angle_min_deg, angle_mean_deg;
};
bool peer_cgal_mesh(int triangles, struct mesh_figures *figures);

#ifdef __cplusplus
}
#endif

#endif
