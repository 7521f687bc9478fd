/* The quality figures of a drape (the report's keys); exact queries, not the solver's own caches.
 */
#ifndef MEASURE_H
#define MEASURE_H

#include "cloth.h"
#include "dress.h"

enum { LOOPS_MAX = 16 };

/* A boundary loop of the welded garment and how often each body part's bones pass through it. */
struct loop_link {
	int vertex_count;
	float length_m;
	struct v3 centre_m;
	int linking[PART_COUNT]; /* linking number with the part's bone chain, closed through the
				    trunk and at infinity */
};

struct measure {
	int vertices, triangles;
	int vertices_inside; /* deeper than 0.1 mm */
	int midpoints_inside, centres_inside;
	float penetration_mm_max;
	int edge_crossings_body;
	float strain_p95, strain_max, compression_p95;
	int inverted_triangles; /* facing the body within 60 mm of it */
	int self_intersections; /* pairs of triangles that cross */
	float seam_gap_mm_max;
	int loop_count;
	struct loop_link loop[LOOPS_MAX];
	bool head_through_collar; /* for garments with arms and collar: see ARCHITECTURE */
	int arms_in_sleeves;      /* how many arms pass through a loop that no other part passes */
	int legs_in_legs;
};

struct measure_scratch;
struct measure_scratch *measure_init(struct arena *arena);
void measure_garment(struct measure *measure, const struct cloth *cloth,
		     struct measure_scratch *scratch);

#endif
