/* Every change of the document is one edit out of one table (S2 to S12). The journal is a list of
 * edits; nothing else changes state.
 *
 * The last column of the table is the line's form in the journal, a letter an argument:
 *   n name   i whole number   f number   2 points x y   3 points x y z   c points x y with corners
 * Numbers go to i[] and f[] in order, points to point[] (2D: z = 0), corners to corner[].
 */
#ifndef EDIT_H
#define EDIT_H

#include "limits.h"
#include "vec.h"

/*   kind         word          form       arguments */
#define EDIT_TABLE(X)                                                                              \
	X(EDIT_BODY, "body", "n")         /* name of the body: "mannequin" or a file's name */     \
	X(EDIT_PIECE, "piece", "niifffc") /* name swatch inside_up x y turn_rad outline */         \
	X(EDIT_OUTLINE, "outline", "ic")  /* piece, its new outline */                             \
	X(EDIT_SCALE, "scale", "iffff")   /* piece, factors x y, about x y */                      \
	X(EDIT_POINT, "point", "iiff")    /* piece corner, where it goes */                        \
	X(EDIT_BEND, "bend", "iiff")      /* piece edge, where its middle goes */                  \
	X(EDIT_SPLIT, "split", "iif")     /* piece edge, share of its length: a corner there */    \
	X(EDIT_JOIN, "join", "ii")        /* piece corner: it goes, its edges become one */        \
	X(EDIT_FOLD, "fold", "iifff")     /* piece, 1 symmetric 0 not, axis x y rad */             \
	X(EDIT_PLACE, "place", "iifff")   /* piece inside_up x y turn_rad */                       \
	X(EDIT_COPY, "copy", "iff")       /* piece, shift x y on the sheet */                      \
	X(EDIT_MIRROR, "mirror", "i")     /* piece: its shape becomes its mirror image */          \
	X(EDIT_DELETE, "delete", "i")     /* piece, with its seams and marks */                    \
	X(EDIT_SWATCH, "swatch", "ii")    /* piece swatch */                                       \
	X(EDIT_LAYER, "layer", "ii")      /* piece, 0..9: its garment is worn over lower ones */   \
	X(EDIT_SEW, "sew", "iiiii")       /* piece edge piece edge swapped */                      \
	X(EDIT_EVEN, "even", "ii")        /* seam, 1: its edges are kept equally long */           \
	X(EDIT_UNSEW, "unsew", "i")       /* seam */                                               \
	X(EDIT_MARK_CLOTH, "mark-cloth", "ii2") /* number piece, line in mm */                     \
	X(EDIT_MARK_BODY, "mark-body", "i3")    /* number, line in m: snaps to the surface */      \
	X(EDIT_MARK_AT, "mark-at", "inffff")    /* number landmark from to along aside */          \
	X(EDIT_UNMARK, "unmark", "ii")          /* side (0 cloth, 1 body) number */                \
	X(EDIT_WRAP, "wrap", "")                                                                   \
	X(EDIT_GRAB, "grab", "iff") /* piece x y: the cloth point under the pen */                 \
	X(EDIT_DRAG, "drag", "fff") /* x y z in m: where the pen pulls it */                       \
	X(EDIT_RELEASE, "release", "")                                                             \
	X(EDIT_PIN, "pin", "iff")     /* piece x y */                                              \
	X(EDIT_UNPIN, "unpin", "i")   /* pin */                                                    \
	X(EDIT_RELAX, "relax", "i")   /* 1 on, 0 off */                                            \
	X(EDIT_FABRIC, "fabric", "n") /* name: what the garment is made of (fabric.h) */           \
	X(EDIT_UNDO, "undo", "")                                                                   \
	X(EDIT_REDO, "redo", "")                                                                   \
	X(EDIT_CLEAR, "clear", "")    /* start over; can be undone */                              \
	X(EDIT_BUDGET, "budget", "i") /* work units a frame from here on */                        \
	X(EDIT_STEP, "step", "i")     /* so many frames of solving */                              \
	X(EDIT_WORN, "worn", "")      /* frames until the wrap is done */                          \
	X(EDIT_SETTLE, "settle", "")  /* frames until the wrap is done and the cloth rests */

enum edit_kind {
#define X(kind, word, form) kind,
	EDIT_TABLE(X)
#undef X
		EDIT_KIND_COUNT,
};

struct edit {
	enum edit_kind kind;
	char name[NAME_BYTES_MAX];
	int i[5];
	float f[5];
	int point_count;
	struct v3 point[EDIT_POINTS_MAX];
	bool corner[EDIT_POINTS_MAX];
};

struct edit_list {
	int count;
	struct edit item[FRAME_EDITS_MAX];
};

extern const char *const edit_word[EDIT_KIND_COUNT];
extern const char *const edit_form[EDIT_KIND_COUNT];

/* The next free place, zeroed, with its kind set; NULL when the frame's list is full. */
struct edit *edit_push(struct edit_list *list, enum edit_kind kind);

/* The edit that draws a piece as it is. */
struct piece;
void edit_draw_piece(struct edit *edit, const struct piece *piece);

#endif
