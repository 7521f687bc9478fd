/* Marks that are stated once for a garment's design, whatever its size and whoever wears it: on the
 * cloth between named places of the pieces, on the body along a landmark line. A line of the file
 * is a mark:
 *
 *   # a comment line
 *   front neck/neck_m cfHem on front-centre
 *   front neck shoulder + sleeve.L cap wristLeft/wristRight on arm-left-top 0 0.8
 *   front.R fork .. waistIn on front-centre 1 0
 *
 *   PIECE PLACE PLACE ... on LANDMARK [FROM TO]
 *
 * A blank in a piece's name is written _. A PLACE is a name that the garment's file gives to a
 * point of the outline, or @X,Y in mm; A/B lies halfway between two of them, A/B/0.3 after that
 * share of the way; behind any of these :up, :down, :left or :right means the piece's far rim
 * straight on from there. From place to place the line is straight, or, with `..` between them,
 * follows the outline the shorter way round. Behind a
 * + it goes on in another piece as though both lay end to end. FROM and TO are stops of the
 * landmark's line and shares of the way between them; the whole line if left out; a FROM beyond TO
 * walks it backwards. A line may begin or end beyond the cloth: points meet by their distance from
 * its start.
 *
 *   pin PIECE PLACE
 *
 * holds the cloth there once it is worn. */
#ifndef FORMAT_MARKS_H
#define FORMAT_MARKS_H

#include "pattern.h"

enum { PLACES_MAX = 1024 };

/* A named point of a piece. */
struct garment_place {
	int piece;
	char name[NAME_BYTES_MAX];
	struct v2 point_mm; /* local, y up */
};

struct garment_places {
	int count;
	struct garment_place place[PLACES_MAX];
};

/* The part of a mark that lies in one piece. The points stand evenly along the line. */
struct design_mark {
	int piece;
	int point_count;
	struct v2 point_mm[MARK_POINTS_MAX];
	char landmark[NAME_BYTES_MAX]; /* not checked here: bodies are not known */
	float from, to;                /* stops; both 0: the whole line */
};

struct design_pin {
	int piece;
	struct v2 point_mm;
};

struct design_marks {
	int count;
	struct design_mark mark[MARKS_MAX];
	int pin_count;
	struct design_pin pin[PINS_MAX];
};

/* The names in a garment file (format_garment.h) that format_garment_read has taken: its
 * `named_vertices`. What is not a name is passed over, and so are those beyond PLACES_MAX. */
void format_places_read(struct garment_places *places, const char *text, size_t size);

/* Any bytes are safe. False: `fault` says in which line, what, and what to do. */
bool format_marks_read(struct design_marks *marks, const struct pattern *pattern,
		       const struct garment_places *places, const char *text, size_t size,
		       char fault[200]);

#endif
