/* Finding the parts and bones of a body (S19); shared by body_parts*.c only.
 *
 *   mesh -> paths over the surface -> how remote each vertex is -> tips -> limbs, measured as far
 * as armpit and crotch -> names -> limbs cut off -> head cut off at the neck -> bones through the
 *   centres of sections
 */
#ifndef BODY_PARTS_H
#define BODY_PARTS_H

#include "body.h"

enum { LEVELS_MAX = 128, LIMBS_MAX = 24, OWNER_NONE = -1, OWNER_ANY = -2 };

/* A straight way over the surface from one vertex to another: an edge, or a diagonal across one. */
struct link {
	int to;
	float length_m; /* UNREACHED: the diagonal leaves its two triangles */
};

#define UNREACHED 1e30f

/* Where the surface meets one level of a function on it. */
struct contour {
	struct v3 centre_m;
	float girth_m; /* length of the curve; 0: the level meets nothing */
};

/* The middles of sections, from the trunk outward. */
struct path {
	int count;
	struct v3 point_m[LEVELS_MAX + 1];
	float radius_m[LEVELS_MAX + 1]; /* of a circle with the section's girth */
};

struct limb {
	int tip, saddle; /* vertices; the limb joins the rest at the saddle */
	float length_m;  /* from the tip to the cut, over the surface; 0: no limb */
	struct path path;
};

/* What the search needs while it runs. Per vertex, unless said otherwise. */
struct parts_scratch {
	struct link *link; /* 2 * star_first[v] on: first edges, as many as the star has; then as
			      many diagonals */
	float *distance_m; /* over the surface, from where surface_distance started */
	float *nearest_m;  /* to the nearest sample */
	float *remote_m;   /* mean distance to the samples, least value taken off */
	float *height_m;   /* a function whose levels are cut */
	float *share;      /* of the limb that owns the vertex: 0 at the tip, 1 at the cut */
	int8_t *owner;     /* limb, OWNER_NONE: the trunk */
	int *heap, *place; /* vertices by distance; place[v]: in the heap, -1 out of it */
	int *order, *order_swap;
	int *set, *set_tip; /* union-find; the highest vertex of a set's root */
	int limb_count;
	struct limb limb[LIMBS_MAX + 1]; /* the head is limb[LIMBS_MAX] */
	float reach_m;                   /* half the greatest distance between two places */
	float remote_max_m;
	struct contour contour[LEVELS_MAX + 1];
	struct path neck, trunk;
	struct v3 head_end_m; /* where a line from the neck through the middle of the head ends */
};

struct parts_scratch *parts_init(struct arena *arena);

/* ---- body_parts_path.c ---- */

/* Links of every vertex. */
void parts_link(const struct body *body, struct parts_scratch *scratch);
static inline int parts_degree(const struct body *body, int v)
{
	return body->star_first[v + 1] - body->star_first[v];
}

/* distance_m from the vertices where it is 0; every other vertex must hold UNREACHED. */
void parts_distance(const struct body *body, struct parts_scratch *scratch);
void parts_distance_from(const struct body *body, struct parts_scratch *scratch, int v);

/* Fills remote_m, remote_max_m and reach_m. */
void parts_remote(const struct body *body, struct parts_scratch *scratch);

/* ---- body_parts_limb.c ---- */

/* The tips: maxima of remote_m that stand out by `persistence` * remote_max_m, with their saddles.
 */
void parts_tips(const struct body *body, struct parts_scratch *scratch, float persistence);

/* Contours of height_m at level_m * (0 .. count) over the triangles whose corners all have the
 * owner (OWNER_ANY: over all triangles). */
void parts_contours(const struct body *body, struct parts_scratch *scratch, float level_m,
		    int count, int owner);

/* Where a limb is to be cut off, at the armpit or the crotch: its length (0: it is no limb) and
 * path.
 */
void parts_measure_limb(const struct body *body, struct parts_scratch *scratch, int limb);

/* Cuts a measured limb off: owner and share. */
void parts_claim_limb(const struct body *body, struct parts_scratch *scratch, int limb);

/* The path along contours [from, to], either way. */
void parts_path(const struct parts_scratch *scratch, int from, int to, struct path *path);

/* ---- body_parts_name.c ---- */

/* Where the figure stands: what its names are told from. */
struct stance {
	float low_m, height_m, middle_x_m, middle_y_m;
};

struct stance parts_stance(const struct body *body);

/* Which measured limb is which part; -1: none. Legs and arms are named in pairs. The highest vertex
 * near the middle is the head's tip. */
void parts_name(const struct body *body, struct parts_scratch *scratch, const struct stance *stance,
		int limb[PART_COUNT]);

/* ---- body_parts_head.c ---- */

/* Cuts the head off below the neck, seen along the line from chest_m to the middle of the head:
 * owner, the limb's length, and the paths of neck and head. False: there is no neck; with `guess`
 * it is then taken to be where others have it. */
bool parts_cut_head(const struct body *body, struct parts_scratch *scratch, struct v3 chest_m,
		    bool guess);

/* The trunk's path from pelvis_m (between the legs) to neck_m. */
void parts_trunk(const struct body *body, struct parts_scratch *scratch, struct v3 pelvis_m,
		 struct v3 neck_m);

/* ---- body_parts_bone.c ---- */

/* The bones of trunk, head and limbs along their paths. limb[part]: scratch->limb. */
void parts_bones(struct body *body, struct parts_scratch *scratch, const int limb[PART_COUNT]);

#endif
