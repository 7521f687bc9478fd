/* The quality figures of a drape (the report's keys); exact queries, not the solver's own caches.
 */
#ifndef MEASURE_H
#define MEASURE_H

#include "cloth.h"
#include "dress.h"

enum { LOOPS_MAX = 16 };

/* A boundary loop of the welded garment, and how often a closed curve through each body part's
 * bones passes through it (Gauss's linking number; the sign is the loop's direction round the
 * bones). The curves, each closed beyond the reach of any garment:
 *
 *   trunk, head  from above the crown down through head, neck and spine, out between the legs
 *   arm          from beyond the hand through arm and shoulder, down the spine, out between the
 * legs leg          from below the foot through leg and hip, up the spine, out through the crown
 *
 * So of a T-shirt worn right each sleeve links its arm alone, the collar links the head but no arm,
 * and the hem, through which all have to pass, links everything. A trouser leg links its leg alone.
 * A number that is not nearly whole (a loop through the bones) counts as 0. */
struct loop_link {
	int vertex_count;
	float length_m;
	struct v3 centre_m;
	int linking[PART_COUNT];
};

/* The closed curve of the garment that is tightest round a part of the body, where it rests. */
struct girth {
	float cloth_m; /* its length on the flat cloth */
	float body_m;  /* of the convex hull of the body's section inside it; 0: no curve was found
			*/
	struct v3 at_m;
};

/* A garment with a girth of less than this share of the body's is too small: there strain says
 * nothing about the drape. */
static const float girth_enough = 0.97f;

struct measure {
	int vertices, triangles; /* that were measured: laid by the wrap, welded ones once */
	int vertices_inside;     /* deeper than 0.1 mm */
	int midpoints_inside, centres_inside;
	float penetration_mm_max;
	int edge_crossings_body;
	float strain_p95, strain_max; /* larger principal stretch minus 1; over triangles */
	float compression_p95;        /* 1 minus the smaller one */
	int inverted_triangles; /* their outside looks at the body within 60 mm (by more than 120
				   degrees off its normal), and no body lies behind within 250 mm */
	int creased_triangles;  /* those of them that are folded on purpose (dress_crease.c) */
	int self_intersections; /* pairs of triangles without a common corner that cross */
	float seam_gap_mm_max;
	int loop_count;
	struct loop_link loop[LOOPS_MAX]; /* longest first */
	bool head_through_collar;         /* a loop links the head and no arm */
	int arms_in_sleeves;              /* arms that have a loop which links nothing else */
	int legs_in_legs;
	struct girth girth[PART_COUNT]; /* the trunk's, when bones of several parts are inside */
};

/* Exact queries at every vertex, edge and triangle: far too slow for a frame. */
struct measure_scratch;
struct measure_scratch *measure_init(struct arena *arena);

/* Measures what the wrap has laid; all zero when there is no garment. */
void measure_garment(struct measure *measure, const struct cloth *cloth,
		     struct measure_scratch *scratch);

#endif
