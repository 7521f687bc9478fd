/* The whole state of one visit, and the two verbs that change it. */
#ifndef SESSION_H
#define SESSION_H

#include "body.h"
#include "dress.h"
#include "edit.h"
#include "garment.h"
#include "measure.h"
#include "pattern.h"

enum {
	STEP_FRAMES_MAX = 1000000, /* in one edit */
	SETTLE_FRAMES_MAX = 1800,
};

enum session_job {
	JOB_NONE,
	JOB_MESH, /* the pattern is being triangulated */
	JOB_WRAP, /* the garment is growing on the body */
};

/* What the worn garment was made of: hashes of the pattern's shapes and seams, and per number of
 * both lines of a mark. So a wrap knows what is new. */
struct worn_as {
	uint64_t pattern;
	uint64_t mark[MARK_NUMBERS];
};

/* What undo brings back (the cloth's state lies beside it). */
struct document {
	struct pattern pattern;
	struct marks marks;
	struct worn_as worn_as;
	struct pin pin[PINS_MAX];
	int fabric; /* fabric_at */
};

struct undo; /* ring of whole states */

/* The draft becomes what the document would be after an edit of a shape (outline, scale, point,
 * bend, split, join, fold, even): marks, seams, the other half of a symmetric piece and evenly sewn
 * edges follow. Returns NULL, or why not; the draft is good for nothing then. The face shows by it
 * what a pen is about to do. */
const char *document_shape(struct document *draft, const struct document *document,
			   const struct edit *edit);

struct session {
	struct document document;
	struct document draft; /* room to try an edit in */
	struct body body;
	struct garment garment;
	struct cloth cloth;
	struct wrap wrap;
	struct drag drag;
	struct v3 drag_target_m;
	struct v3 pause_at_m; /* near here the pen pauses, */
	int pause_frames;     /* so long since it last pulled the cloth somewhere else */
	bool relaxing;        /* RELAX is held */
	enum session_job job;
	bool drapes; /* what is meshed takes its places from elsewhere */
	struct garment_job *mesher;
	struct undo *undo;
	int undo_count, redo_count; /* steps that can be taken */
	int frame;                  /* frames advanced */
	int vertices_wanted;        /* mesh resolution for the next wrap */
	long budget_units;          /* per frame */
	long edit_units;            /* by edits since the last frame: the next one pays */
	long work_units;            /* spent so far */
	long frame_units;           /* spent in the last frame */
	int untouched_frames;       /* since an edit last woke the cloth */
	int unfolds, refines;       /* since then */
	int rest_frames;            /* frames since the cloth last had a reason to move */
	int relax_frames;           /* for which RELAX has been held */
	int still_frames;           /* 0: still moving; else frames of getting ready for sleep */
	int clean_found;            /* edges pushed out in this round of cleaning */
	bool asleep;                /* clean and at rest: until something touches it */
	struct v3 *frame_start_m;   /* the cloth as the frame began, to see whether it rests */
	float strain_left;          /* 0..1 meter: mean stretch of the worn cloth against 10 % */
	char notice[160];           /* why the last edit was refused; empty: it was taken */
};

/* Takes all memory from the arena. Body: none yet; call body_build* on session->body next. */
void session_init(struct session *session, struct arena *arena);

/* Applies one edit. False: refused, and session->notice says why; nothing has changed. STEP and
 * SETTLE advance frames; all others are immediate. */
bool session_apply(struct session *session, const struct edit *edit);

/* A garment from elsewhere instead of a wrap: session_mesh begins to mesh the pattern; once a few
 * frames later job is JOB_NONE, session_drape takes a place for every vertex of session->garment
 * and mends what is wrong with them as a JOB_WRAP. Returns NULL or why the pattern makes no cloth.
 */
const char *session_mesh(struct session *session);
void session_drape(struct session *session, const struct v3 *position_m);

/* One frame: long jobs advance by the budget, or the cloth moves by it. */
void session_advance(struct session *session);

/* True while a job runs or the cloth was touched within the last two seconds. */
bool session_busy(const struct session *session);

/* Document, cloth and pins; not the body's mesh but its hash. */
uint64_t session_hash(const struct session *session);

/* Lowest free mark number on a side (0 cloth, 1 body). */
int session_next_mark(const struct session *session, int side);

#endif
