/* Shared between the solver's own files only. */
#ifndef CLOTH_PRIVATE_H
#define CLOTH_PRIVATE_H

#include "cloth.h"
#include "cloth_kernel.h"

enum {
	STRIPS_MAX = 32,
	GROUPS_MAX = 2 * STRIPS_MAX - 1, /* of constraints: strips, and the cuts between them */
	COLOURS = 64, /* of a group; the last holds what found no other and is worked singly */
	SINGLES = 64, /* constraints of the last colour that are still worked */
	SHAPE_BATCHES_MAX = GARMENT_TRIANGLES_MAX / BATCH + GROUPS_MAX * COLOURS + SINGLES,
	BENDS_MAX = GARMENT_EDGES_MAX,  /* the last colour's edges may all be alone */
	SLOT_FIRST = STRIPS_MAX * PADS, /* every strip has its own pads */
	SLICES = 10,                    /* a frame's sweeps: all triangles once a frame */
	LEVELS = 2,
	LEVEL_PASSES = 2,
	LEVEL_NODES_MAX = GARMENT_VERTICES_MAX / 8,
	LEVEL_LINKS_MAX = 8 * LEVEL_NODES_MAX,
	HINGES_MAX = GARMENT_VERTICES_MAX, /* edges about which folds open at a time, */
	FOLDS_MAX = 256,                   /* and folds */
};

/* Where a fold was turned back the cloth bends less, or the fold would come again. */
#define FIRM_SHARE 0.3f

/* Rest shape of a triangle; see struct shape_batch. */
struct rest {
	float metric[3], grain[3];
};

/* A symmetric map of the flat cloth, added to the identity: what pleats take up at a place. */
struct squeeze {
	float xx, xy, yy;
};

/* What is looked at of a triangle that has its turn in a sweep. */
struct turn {
	int v[3];
	float metric[3];
};

/* The triangles of a slice lie together in memory: of `count`, where the i-th is. */
static inline int sliced(int count, int i)
{
	return i % SLICES * (count / SLICES) + i / SLICES + int_min(i % SLICES, count % SLICES);
}

/* Edge a-b with the two far corners c and d of its triangles: flat when sum k[i] x[v[i]] = 0; sum k
 * k = 1. */
struct flat {
	int v[4];
	float k[4];
};

/* A corner q of a triangle seen from another, p: how far it is, and where it lies beside the way
 * from p to the third. */
struct aside {
	float length_m, x, y;
};

/* Two nodes, never farther apart than the way through the cloth. */
struct link {
	int a, b;
	float length_m;
};

/* A coarse level. Its nodes are some of its members, which are the nodes of the level below or, of
 * the lowest, the particles by rank. */
struct level {
	float spacing_m;
	int member_count;
	struct spread *spread; /* per member */
	int node_count;
	int *node; /* its member */
	int link_count;
	struct link *link;
	int taut_count; /* links between placed nodes */
	struct link *taut;
	uint32_t *start;         /* per node: its particle's place; a pad: it is not placed */
	struct place *at, *move; /* per node, in a sweep */
};

/* A fold that opens: its hinges, and the patch beyond them if it turns as a whole. */
struct fold {
	int first, end; /* of cloth_scratch.patch */
	int hinge_first, hinge_end;
};

/* The same for a face, by how far its corners moved since it was looked at: up to far_m it has
 * nothing to say to the lifts of its corners, up to near_m only that it needs them. */
struct face_quiet {
	struct v3 at_m[3];
	float far_m, near_m;
};

/* What quiet was found for. */
struct contact_stage {
	float offset_m;
	unsigned piece_parts[PIECES_MAX];
};

/* Constraints of a kind in the order in which they are worked: by group, in a group by colour, in a
 * colour by neighbourhood. */
struct order {
	int *item;
	int first[GROUPS_MAX * COLOURS + 1]; /* in item, of each group's colours */
};

/* How far the tables of a mesh have been built. */
struct build {
	uint64_t mesh_id; /* whose they are; 0: nobody's yet */
	int step;
	int level, member; /* at which the coarse levels are */
};

struct cloth_scratch {
	struct build build;
	struct rest *rest;       /* per triangle */
	struct squeeze *squeeze; /* per vertex (cloth_pleat.c) */
	struct turn *turn;       /* per triangle, sliced */

	/* the order of work (cloth_order.c) */
	int ranked_count; /* particles by neighbourhood */
	int *ranked, *rank;
	int strip_count;
	struct order triangles, flats;
	int *face; /* triangles by group, in a group as they come */
	int face_first[GROUPS_MAX + 1];
	int *sorted;           /* while constraints are coloured */
	uint64_t *taken;       /* per particle: its colours */
	uint16_t *key;         /* per constraint in sorted: COLOURS * group + colour */
	bool stale;            /* the batches are not of this mesh */
	uint8_t *taken_placed; /* cloth.placed when they were filled */
	int slot_count;        /* placed particles as the kernels see them; pads first */
	int *slot;             /* per vertex, -1: not placed */
	int *slot_vertex;
	uint32_t *at;        /* per vertex, and ... */
	uint8_t *whole;      /* ... per BATCH of them, for struct particles */
	bool all_placed;     /* when they were filled */
	struct place *place; /* per slot */
	struct shape_batch *shape;
	struct shape_grain *grain; /* per entry of shape */
	int shape_first[GROUPS_MAX + 1];
	struct bends *bends;
	struct firm *firm; /* per entry of bends */
	bool any_firm;
	int bends_first[GROUPS_MAX + 1], bend_count;

	/* coarse levels (cloth_level.c) */
	struct level level[LEVELS];
	struct spread *slot_spread;
	int *member, *member_at, *node_at;
	uint8_t *covered;
	float *way_m; /* per particle, from the node that marches */
	int *way_of, way_now;
	uint64_t *heap;
	int *heap_at;
	struct aside *aside; /* per entry of cloth.ring */

	int *edge_first;    /* per vertex + 1, while edges are paired */
	int *edge_triangle; /* triangle * 3 + corner */
	uint8_t *flipped;   /* per particle, while folds are turned back */
	int fold_count;     /* found since the first slice of triangles */
	struct v3 *smooth_m;
	int *across;         /* 3 per triangle: 3 * neighbour + its edge; -1: a rim */
	uint8_t *edge_owner; /* per triangle: bit k: edge k is looked at here, not in its neighbour
			      */
	uint8_t *stiff;      /* per particle: lay in a fold that was turned back, so bends less */

	/* triangles near the bound of strain (cloth_clamp.c): in this round, and to be clamped */
	int *taut, *clamped;
	int next_taut_count, taut_count;

	/* folds that open (cloth_hinge.c) */
	uint8_t *facing, *in_patch; /* per triangle */
	uint8_t *turned;            /* per triangle: rounds since it last faced out */
	int *patch;
	int facing_in; /* triangles, since the first slice */
	int *hinge;    /* 3 * triangle that turns + edge about which */
	int hinge_count;
	struct fold fold[FOLDS_MAX];
	int open_count, swing_rounds;
	int *swung, *swung_in,
		swing; /* particles of the fold that swings; per particle: the last */

	struct body_track *track; /* per particle */
	struct quiet *quiet;      /* per particle */
	struct face_quiet *face_quiet;
	struct contact_stage stage;
	float *lift_m;       /* per particle: above offset_m, for the sake of its faces */
	struct v3 *lift_way; /* per particle: the way it is lifted, a unit vector */
	float *slack_m;      /* per particle: least clearance of its faces in this round */
};

static inline bool triangle_placed(const struct cloth *cloth, int t)
{
	const int *v = cloth->triangle[t].v;
	return cloth->placed[v[0]] && cloth->placed[v[1]] && cloth->placed[v[2]];
}

/* Quicker, where all of the cloth is. */
static inline bool corners_placed(const struct cloth *cloth, int t)
{
	const struct cloth_scratch *s = cloth->scratch;
	return (s->all_placed && !s->stale) || triangle_placed(cloth, t);
}

static inline bool is_particle(const struct cloth *cloth, int v)
{
	return cloth->placed[v] && cloth->particle[v] == v;
}

/* Which parts of the body the particle may touch; 0: all. */
static inline unsigned allowed_parts(const struct cloth *cloth, int v)
{
	return cloth->settings.filter_parts ? cloth->piece_parts[cloth->garment->piece[v]] : 0;
}

/* A garment over others lies that much farther from the body; a pile of more is no thicker. */
static inline float layer_lift(const struct cloth *cloth, int v)
{
	return 0.0025f * (float)int_min(cloth->garment->layer[cloth->garment->piece[v]], 4);
}

/* What hangs on which vertices are one: triangles, flatness, neighbours, order, levels
 * (cloth_build.c calls the others). Begun, it is built in steps by cloth_build_on. */
void cloth_build_begin(struct cloth *cloth);
void cloth_order(struct cloth *cloth);
void cloth_begin_levels(struct cloth *cloth);
bool cloth_build_levels(struct cloth *cloth, long quota, long *units); /* true: all of them */

/* Ways through the cloth from a particle to others, nearest first, up to limit_m (cloth_march.c).
 */
struct march {
	struct cloth *cloth;
	float limit_m;
	int waiting;
};

void march_build(struct cloth *cloth);
void march_begin(struct march *march, struct cloth *cloth, int from, float limit_m);
int march_next(struct march *march, float *way_m); /* -1: there is none */

/* Fills the kernels' batches with what is placed, if that has changed. */
void cloth_take(struct cloth *cloth);
void cloth_take_levels(struct cloth *cloth);

/* The parts of a sweep; each returns the units it spent. */
long cloth_levels(struct cloth *cloth);  /* taut cloth pulls, coarse levels first */
long cloth_shape(struct cloth *cloth);   /* triangles and edges to their rest shapes */
long cloth_hinges(struct cloth *cloth);  /* folds turn back */
long cloth_clamp(struct cloth *cloth);   /* no triangle beyond strain_bound */
long cloth_contact(struct cloth *cloth); /* vertices out of the body, friction */
long cloth_contact_faces(struct cloth *cloth, int slice, int slices); /* midpoints and centres */

/* Corners that look away from each other have the body between them: a thumb, an ear, a thin wrist
 * has come through the cloth, and no way along their own normals leads out. */
bool cloth_pierced(const struct cloth *cloth, const int *v, int corners);

/* How far a particle whose contact is known may move before contact pushes it out. */
float cloth_spare(const struct cloth *cloth, int v);

/* Contact of one particle that was moved. */
long cloth_touch(struct cloth *cloth, int v);

/* Looks the contact of a particle up exactly. */
void cloth_look(struct cloth *cloth, int v);

#endif
