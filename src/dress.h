/* Igarashi and Hughes: wrap, surface drag, pins. Each is a resumable job on a cloth. */
#ifndef DRESS_H
#define DRESS_H

#include "cloth.h"
#include "mark.h"

enum { DIAGNOSES_MAX = 16, DIAGNOSIS_BYTES_MAX = 160 };

/* Something a person should know about a drape, with the marks it concerns. */
struct diagnosis {
	char kind[NAME_BYTES_MAX]; /* "no-marks", "no-partner", "lengths-differ", "marks-disagree"
				      ... */
	int mark[2];               /* numbers; 0: none */
	char text[DIAGNOSIS_BYTES_MAX];
};

struct diagnoses {
	int count;
	struct diagnosis item[DIAGNOSES_MAX];
};

enum wrap_stage {
	WRAP_IDLE,
	WRAP_SEED,   /* triangles under the marks go to the body */
	WRAP_GROW,   /* the rest follows ring by ring, continuing the cloth that lies there */
	WRAP_CLOSE,  /* seams pull together, then the marks let go */
	WRAP_WELD,   /* sewn vertices become one */
	WRAP_FILL,   /* the slim body grows into the garment */
	WRAP_UNFOLD, /* folds are turned back */
	WRAP_SETTLE, /* gravity; contact at midpoints and centres; last clean-up */
	WRAP_MOVE,   /* instead of all before WRAP_SETTLE: worn cloth goes to new marks */
	WRAP_DONE,
};

struct wrap {
	enum wrap_stage stage;
	int progress;                             /* sweeps in this stage */
	int frames;                               /* since wrap_start, counted by wrap_advance */
	float mark_error_rms_m, mark_error_max_m; /* right after the wrap */
	struct diagnoses diagnoses;
	struct cloth *cloth;
	const struct marks *marks;
	struct wrap_scratch *scratch; /* owned by dress_wrap.c */
};

void wrap_init(struct wrap *wrap, struct arena *arena);

/* Begins to lay a freshly reset cloth on its body so that equal-numbered marks meet (S8, S13, S14).
 * Returns false, with diagnoses, when no pair of marks exists: the cloth is left untouched. */
bool wrap_start(struct wrap *wrap, struct cloth *cloth, const struct marks *marks);

/* Begins at the end instead: the cloth takes these places (one a garment vertex, finite), from
 * wherever they come, and what is wrong with them is mended: size, sides, cloth inside the body;
 * then seams close, folds turn back, and cloth comes out of cloth. What was done, and what it could
 * not mend, are diagnoses. */
void wrap_from(struct wrap *wrap, struct cloth *cloth, const struct marks *marks,
	       const struct v3 *position_m);

/* Begins to move a worn cloth so that the marks with these numbers meet (S9). False: none has a
 * partner; nothing has changed. */
bool wrap_move(struct wrap *wrap, struct cloth *cloth, const struct marks *marks,
	       const bool fresh[MARK_NUMBERS]);

/* Spends up to `quota` units (at least one sweep) and returns them. Stage WRAP_DONE: cloth->worn.
 */
long wrap_advance(struct wrap *wrap, long quota);

/* A pin holds a garment point where it is (S12). */
struct pin {
	bool used;
	int piece;
	struct v2 point_mm; /* local to the piece */
	struct v3 held_m;
};

/* Who hands the motion on to a particle: the ends of the edge over which the straight way to it
 * comes; from[0] below 0: nobody, it is a corner of the grabbed triangle. */
struct giver {
	int from[2];
	float share; /* 0..1: from[1]'s */
};

/* Surface drag (S11, S15, S16). The graph is built at pen-down; motion is then handed on along it,
 * turned to follow the body's surface, and weakened towards the pins. */
struct drag {
	bool active;
	bool pinned; /* there are pins: what it folds is wanted */
	struct cloth *cloth;
	int triangle; /* grabbed: garment.triangle with barycentric weights */
	float weight[3];
	int order_count;
	int *order;        /* particles by distance from the grabbed point */
	float *distance_m; /* per particle, along the body's surface; below 0: not reached */
	float *share;      /* per particle 0..1: what the pins leave of the motion, r (2 - r) */
	const struct giver *giver;    /* per particle reached */
	int moves;                    /* since the hand took hold */
	struct drag_scratch *scratch; /* the graph while it is built; what each particle hands on */
};

void drag_init(struct drag *drag, struct arena *arena);

/* Takes hold of a point of the worn cloth. Pins (pin_count places, unused ones skipped) block the
 * graph and are sources of zero. Returns units spent. */
long drag_begin(struct drag *drag, struct cloth *cloth, const struct pin *pins, int pin_count,
		int triangle, const float weight[3]);

/* Moves the grabbed point towards target_m (in space; the way is laid along the body's surface), at
 * most DRAG_STEP_MAX_MM in one call, and everything that depends on it. Returns units spent. */
enum { DRAG_STEP_MAX_MM = 12 };
long drag_move(struct drag *drag, struct v3 target_m);
void drag_end(struct drag *drag);

/* Creased cloth rests where a frame found it, but for what pulls more than friction holds; start_m
 * (per vertex): where that was. */
void crease_rest(struct cloth *cloth, const struct v3 *start_m);

/* Where the grabbed point is now. */
struct v3 drag_point(const struct drag *drag);

#endif
