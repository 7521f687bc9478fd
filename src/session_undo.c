#include "session_undo.h"

/* The garment's arrays, the cloth's places, and whether a wrap was under way. */
struct saved {
	struct document document;
	bool wrapping;
	bool welded, worn;
	int vertex_count, triangle_count, pair_count;
	int piece_first[PIECES_MAX + 1];
	int piece_first_triangle[PIECES_MAX + 1];
	float edge_m;
	struct v2 *rest_m;
	int *piece, *weld;
	struct triangle *triangle;
	int *triangle_piece;
	struct seam_pair *pair;
	struct v3 *position_m;
	uint8_t *placed;
};

/* States oldest..newest; `now` is where the present stands among them. All three only grow. */
struct undo {
	int oldest, now, newest;
	struct saved state[UNDO_STATES_MAX];
};

struct undo *undo_init(struct arena *arena)
{
	struct undo *undo = ARENA_ARRAY(arena, struct undo, 1);
	for (int i = 0; i < UNDO_STATES_MAX; i++) {
		struct saved *s = &undo->state[i];
		s->rest_m = ARENA_ARRAY(arena, struct v2, GARMENT_VERTICES_MAX);
		s->piece = ARENA_ARRAY(arena, int, GARMENT_VERTICES_MAX);
		s->weld = ARENA_ARRAY(arena, int, GARMENT_VERTICES_MAX);
		s->triangle = ARENA_ARRAY(arena, struct triangle, GARMENT_TRIANGLES_MAX);
		s->triangle_piece = ARENA_ARRAY(arena, int, GARMENT_TRIANGLES_MAX);
		s->pair = ARENA_ARRAY(arena, struct seam_pair, SEAM_PAIRS_MAX);
		s->position_m = ARENA_ARRAY(arena, struct v3, GARMENT_VERTICES_MAX);
		s->placed = ARENA_ARRAY(arena, uint8_t, GARMENT_VERTICES_MAX);
	}
	return undo;
}

#define COPY(to, from, count) memcpy((to), (from), (size_t)(count) * sizeof *(to))

static void save(struct saved *to, const struct session *session)
{
	const struct garment *garment = &session->garment;
	int vertices = garment->vertex_count, triangles = garment->triangle_count;
	to->document = session->document;
	to->wrapping = session->job != JOB_NONE;
	to->welded = session->cloth.welded;
	to->worn = session->cloth.worn;
	to->vertex_count = vertices;
	to->triangle_count = triangles;
	to->pair_count = garment->pair_count;
	to->edge_m = garment->edge_m;
	COPY(to->piece_first, garment->piece_first, PIECES_MAX + 1);
	COPY(to->piece_first_triangle, garment->piece_first_triangle, PIECES_MAX + 1);
	COPY(to->rest_m, garment->rest_m, vertices);
	COPY(to->piece, garment->piece, vertices);
	COPY(to->weld, garment->weld, vertices);
	COPY(to->triangle, garment->triangle, triangles);
	COPY(to->triangle_piece, garment->triangle_piece, triangles);
	COPY(to->pair, garment->pair, garment->pair_count);
	COPY(to->position_m, session->cloth.position_m, vertices);
	COPY(to->placed, session->cloth.placed, vertices);
}

static void restore(struct session *session, const struct saved *from)
{
	struct garment *garment = &session->garment;
	int vertices = from->vertex_count, triangles = from->triangle_count;
	session->document = from->document;
	garment->vertex_count = vertices;
	garment->triangle_count = triangles;
	garment->pair_count = from->pair_count;
	garment->edge_m = from->edge_m;
	COPY(garment->piece_first, from->piece_first, PIECES_MAX + 1);
	COPY(garment->piece_first_triangle, from->piece_first_triangle, PIECES_MAX + 1);
	COPY(garment->rest_m, from->rest_m, vertices);
	COPY(garment->piece, from->piece, vertices);
	COPY(garment->weld, from->weld, vertices);
	COPY(garment->triangle, from->triangle, triangles);
	COPY(garment->triangle_piece, from->triangle_piece, triangles);
	COPY(garment->pair, from->pair, from->pair_count);
	cloth_restore(&session->cloth, garment, &session->body, from->position_m, from->placed,
		      from->welded, from->worn);
	session_resume(session, from->wrapping);
}

static void count(struct session *session)
{
	const struct undo *undo = session->undo;
	session->undo_count = undo->now - undo->oldest;
	session->redo_count = undo->newest - undo->now;
}

static struct saved *slot(struct undo *undo, int state)
{
	return &undo->state[state % UNDO_STATES_MAX];
}

void undo_keep(struct session *session)
{
	struct undo *undo = session->undo;
	save(slot(undo, undo->now), session);
	undo->now++;
	undo->newest = undo->now;
	undo->oldest = int_max(undo->oldest, undo->newest - (UNDO_STATES_MAX - 1));
	count(session);
}

static bool go(struct session *session, int step)
{
	struct undo *undo = session->undo;
	int to = undo->now + step;
	if (to < undo->oldest || to > undo->newest)
		return false;
	save(slot(undo, undo->now), session);
	undo->now = to;
	restore(session, slot(undo, to));
	count(session);
	return true;
}

bool undo_back(struct session *session)
{
	return go(session, -1);
}

void undo_cancel(struct session *session)
{
	go(session, -1);
	session->undo->newest = session->undo->now;
	count(session);
}

bool undo_forward(struct session *session)
{
	return go(session, 1);
}
