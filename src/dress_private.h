/* Shared between the files of the wrap only. */
#ifndef DRESS_PRIVATE_H
#define DRESS_PRIVATE_H

#include "cloth_private.h"
#include "dress.h"

enum { PART_NONE = -1 }; /* a home nowhere on the body */

struct wrap_scratch {
	int8_t home[PIECES_MAX];   /* enum body_part that the piece belongs to, or PART_NONE */
	float wrist_m[PART_COUNT]; /* cloth goes so far along a limb's bones */
	uint8_t *seeded;           /* per piece: a mark lies on it */
	struct v3 *sum_m;          /* per vertex: predictions of a ring */
	int *count;
	int *edge_first;    /* per vertex + 1: triangles on edges whose lower vertex it is */
	int *edge_triangle; /* triangle * 3 + corner */
	float along_m[MARK_POINTS_MAX];
	bool from_drape;           /* no marks laid it */
	int partner[MARK_NUMBERS]; /* per cloth mark's number: the body mark's; 0: let go */
	bool mended;               /* marks were let go or swapped */
	bool aiming;               /* marks only aim worn cloth, they don't lay it */
	float off_m;               /* how far it was at the last look */
	bool disagree;             /* the marks were found to pull seams apart */
	int rounds;                /* folds turned back so far */
	struct v3 mark_point_m[MARK_POINTS_MAX], mark_normal[MARK_POINTS_MAX];
	struct v3 cloth_line_m[MARK_POINTS_MAX]; /* the cloth's line, flat: z = 0 */
	struct v3 drawn[MARK_POINTS_MAX];
};

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

/* Where a point lies beside a limb's bones. */
struct beside {
	struct v3 axis_m; /* nearest point of the bones, which go on straight beyond both ends */
	struct v3 along;  /* their direction there */
	float reach_m;    /* from the first bone's start to axis_m, along the bones */
};

/* False: the part has no bones. */
bool wrap_beside(const struct body *body, int part, struct v3 p_m, struct beside *beside);

/* Says which limb is not in its tube, and whether the head is covered (dress_check.c). */
void wrap_check(struct wrap *wrap);

/* Finds how far along each limb cloth may go: to wrist or ankle. */
void wrap_measure_limbs(struct wrap *wrap);

/* How far it still is along the limb's bones to wrist or ankle, below 0: past them; 1e9: the piece
 * belongs to no limb, or the limb has neither. */
float wrap_room(const struct wrap *wrap, int piece, struct v3 p_m);

/* The point, or the place above the wrist where its growth stops. */
struct v3 wrap_above_wrist(const struct wrap *wrap, int piece, struct v3 p_m);

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

/* A line of `count` points drawn by hand, steadied, into `steady` (not the same array). length_m 0:
 * measured on the line itself. */
void wrap_steady_line(const struct v3 *point, int count, float length_m, struct v3 *steady);

/* Brings a drape from elsewhere to size, right side out and out of the body (dress_start.c). */
void wrap_mend_start(struct wrap *wrap);

/* Adds a diagnosis; `text` may hold %1 and %2 for the marks' numbers. Full: it is dropped. */
void wrap_diagnose(struct wrap *wrap, const char *kind, int mark_1, int mark_2, const char *text);

#endif
