/* Shared between the files of the wrap only. */
#ifndef DRESS_PRIVATE_H
#define DRESS_PRIVATE_H

#include "body_limb.h"
#include "body_slim.h"
#include "cloth_private.h"
#include "dress.h"

enum {
	PART_NONE = -1,
	TUBE_SECTIONS = 64,
}; /* a home nowhere on the body */

/* A mark as it is laid: steadied, walked in equal steps. On cloth it is flat, z = 0, and has no
 * normals. */
struct mark_line {
	int count;
	float length_m;
	struct v3 point_m[MARK_POINTS_MAX], normal[MARK_POINTS_MAX];
	float along_m[MARK_POINTS_MAX];
};

struct wrap_scratch {
	const struct body *full; /* to be dressed */
	struct slim_body slim;   /* that the garment is laid and sewn round */
	int *rim; /* per vertex: one that stands for all of an opening; -1: on no rim */
	int opening[PART_COUNT];      /* that one, of a tube cut in one with the trunk; -1: none */
	struct v3 toward[PART_COUNT]; /* where the slim limb points so as to pass through */
	int8_t home[PIECES_MAX];      /* enum body_part that the piece belongs to, or PART_NONE */
	struct limb_shape limb[PART_COUNT];
	bool in_tube[PIECES_MAX]; /* it goes round its limb along piece_gather.along */
	float hem_m[PIECES_MAX];  /* how far along */
	float tube_m[PART_COUNT][TUBE_SECTIONS]; /* girths of the cloth from its hem up */
	uint8_t *seeded;                         /* per piece: a mark lies on it */
	struct v3 *sum_m; /* per vertex: predictions of a ring; middles round a seam's */
	int *count;
	int *edge_first;           /* per vertex + 1: triangles on edges whose lower vertex it is */
	int *edge_triangle;        /* triangle * 3 + corner */
	bool from_drape;           /* no marks laid it */
	int partner[MARK_NUMBERS]; /* per cloth mark's number: the body mark's; 0: let go */
	bool mended;               /* marks were let go or swapped */
	bool aiming;               /* marks only aim worn cloth, they don't lay it */
	float off_m;               /* how far it was at the last look */
	bool disagree;             /* the marks were found to pull seams apart */
	int rounds;                /* folds turned back so far */
	bool wide;                 /* pieces are let out once they are on the body */
	struct mark_line on_body, on_cloth;
	struct v3 drawn[MARK_POINTS_MAX];
};

/* The settings of the stages (dress_settings.c): while cloth is laid ring by ring, while seams
 * close, while the body fills the garment, while pleats are blown out, and to come to rest. */
struct cloth_settings wrap_growing(void);
struct cloth_settings wrap_closing(void);
struct cloth_settings wrap_filling(void);
struct cloth_settings wrap_unfolding(void);
struct cloth_settings wrap_settling(void);

/* Puts the triangles under the marks on the body (dress_seed.c). Returns the vertices seeded. */
int wrap_seed(struct wrap *wrap);

/* Says which marks have no partner or run the wrong way. */
void wrap_diagnose_marks(struct wrap *wrap);

/* Gives worn cloth under the marks their places as goals. Returns the vertices that have one. */
int wrap_aim(struct wrap *wrap);

/* Every few sweeps of WRAP_MOVE: is the cloth there, or as near as it comes? (dress_move.c) */
bool wrap_has_moved(struct wrap *wrap);

/* The body's mark that belongs to the cloth's mark of that number; NULL: none. */
const struct body_mark *wrap_partner(const struct wrap *wrap, int number);

/* When pieces stand apart from all that they are sewn to: their marks change places or are let go
 * (dress_mend.c). True: the wrap has to begin anew. */
bool wrap_mend_marks(struct wrap *wrap);

/* Fills scratch->home and the cloth's piece_parts (dress_home.c). */
void wrap_find_homes(struct wrap *wrap);

/* Parts that stay whole while the rest of the body is slim, as bits: a mask needs a face, and a
 * skirt legs with no gap to hang into. */
unsigned wrap_whole_parts(const struct wrap *wrap);

/* Finds the openings of sleeves and trouser legs cut in one with the trunk's pieces (scratch->rim,
 * opening, toward). After wrap_grow_init (dress_opening.c). */
void wrap_find_openings(struct wrap *wrap);

/* Does the rim of the opening go once round the limb's bones? */
bool wrap_in_opening(const struct wrap *wrap, int part);

/* Moves cloth along with limbs that turn back while the slim body grows to a share. */
void wrap_carry(struct wrap *wrap, float share);

/* Fills the cloth's piece_blown once it is sewn: what goes round something, being no disc. Open
 * cloth and a mask would be blown off. */
void wrap_find_blown(struct wrap *wrap);

/* Says which limb is not in its tube, and whether the head is covered (dress_check.c). */
void wrap_check(struct wrap *wrap);

/* Shortens what is too long for its limb, and measures the tubes (dress_gather.c). */
void wrap_gather(struct wrap *wrap);

/* Once the garment is on: what is little too long gets its length back, the rest is reported. */
void wrap_let_out(struct wrap *wrap);

/* How wide the tubes round each limb are cut (dress_tube.c). */
void wrap_measure_tubes(struct wrap *wrap);

/* The place of a vertex, or where it lies in a tube that is wider than its limb. */
struct v3 wrap_widened(const struct wrap *wrap, int v, struct v3 p_m);

/* Makes scratch->on_body, on the surface, and scratch->on_cloth. */
void wrap_body_line(struct wrap *wrap, const struct body_mark *mark);
void wrap_cloth_line(struct wrap *wrap, const struct cloth_mark *mark);

/* Moves sleeves and trouser legs out of the hull of hands and feet, and what hangs on the trunk's
 * cloth without a mark, as a collar does, out of the hull of neck and head. share 0: the body is
 * slim, 1: it is whole. Returns the units spent. */
long wrap_clear_hulls(struct wrap *wrap, float share);

/* Moves what a seam joins across a bone round that bone (dress_close.c). Returns the units spent.
 */
long wrap_close_round(struct wrap *wrap);

/* Every piece meets every part of the body from now on. */
void wrap_meet_all(struct wrap *wrap);

/* The direction away from the bones of the part that was hit. False: it has none. */
bool wrap_outward(const struct body *body, const struct body_hit *hit, struct v3 *out);

/* A step of growth from_m -> to_m bent round the bones of the limb that the piece belongs to, so
 * that cloth goes round a limb however far it grows. Elsewhere to_m itself. */
struct v3 wrap_curl(const struct wrap *wrap, int piece, struct v3 from_m, struct v3 to_m);

/* The number of a mark that laid this piece; 0: none did. */
int wrap_piece_mark(const struct wrap *wrap, int piece);

/* Distances of the marks' cloth from their places on the body, now. */
void wrap_mark_error(struct wrap *wrap);

/* Readies growth, then places one ring of vertices; returns how many (dress_grow.c). */
void wrap_grow_init(struct wrap *wrap);
int wrap_grow_ring(struct wrap *wrap);

/* A line of `count` points drawn by hand, steadied, into `steady` (not the same array). `normal`:
 * of the surface that it was drawn on, or NULL on flat cloth. */
void wrap_steady_line(const struct v3 *point, const struct v3 *normal, int count,
		      struct v3 *steady);
/* The normals along a line of that length, likewise. */
void wrap_steady_normals(const struct v3 *normal, int count, float length_m, struct v3 *steady);

/* Equal steps along a line, from its first point to its last, into walk[MARK_POINTS_MAX]; returns
 * their number. Not the same array. */
int wrap_walk_line(const struct v3 *point, int count, struct v3 *walk);

/* Brings a drape from elsewhere to size, right side out and out of the body (dress_start.c). */
void wrap_mend_start(struct wrap *wrap);

/* Adds a diagnosis; `text` may hold %1 and %2 for the marks' numbers. Full: it is dropped. */
void wrap_diagnose(struct wrap *wrap, const char *kind, int mark_1, int mark_2, const char *text);

#endif
