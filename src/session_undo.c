#include "session_undo.h"

enum {
	PAGE_BYTES = (16 << 10) - (int)sizeof(int), /* 16 kB with its link */
	PAGES = (int)((UNDO_DOCUMENT_BYTES + UNDO_GARMENT_BYTES) / (16 << 10)),
	NO_PAGE = -1,
};

struct page {
	int next; /* undo.page; NO_PAGE: the last of its state, or of the free ones */
	unsigned char bytes[PAGE_BYTES];
};

/* States oldest..newest; `now` is where the present stands among them. All three only grow. A state
 * is a chain of pages out of one stock, so that small garments leave room for many. */
struct undo {
	int oldest, now, newest;
	int first_page[UNDO_STATES_MAX];
	int free_page, free_count;
	struct page *page;
	struct v3 *position_m; /* a state on its way back to the cloth */
	uint8_t *placed, *creased;
	struct gather gather[PIECES_MAX];
	struct widening wide[PIECES_MAX];
};

struct undo *undo_init(struct arena *arena)
{
	struct undo *undo = ARENA_ARRAY(arena, struct undo, 1);
	undo->page = ARENA_ARRAY(arena, struct page, PAGES);
	undo->position_m = ARENA_ARRAY(arena, struct v3, GARMENT_VERTICES_MAX);
	undo->creased = ARENA_ARRAY(arena, uint8_t, GARMENT_VERTICES_MAX);
	undo->placed = ARENA_ARRAY(arena, uint8_t, GARMENT_VERTICES_MAX);
	for (int i = 0; i < PAGES; i++)
		undo->page[i].next = i + 1 < PAGES ? i + 1 : NO_PAGE;
	for (int i = 0; i < UNDO_STATES_MAX; i++)
		undo->first_page[i] = NO_PAGE;
	undo->free_count = PAGES;
	return undo;
}

/* ---- one state as a stream of bytes ---- */

enum direction { COUNTING, WRITING, READING };

struct stream {
	struct undo *undo;
	enum direction direction;
	size_t size; /* passed so far */
	int *link;   /* to the page that comes next */
	struct page *page;
	size_t at; /* in it */
};

static void turn_page(struct stream *stream)
{
	struct undo *undo = stream->undo;
	if (stream->direction == WRITING) {
		int taken = undo->free_page;
		MUST(undo->free_count > 0);
		undo->free_count--;
		undo->free_page = undo->page[taken].next;
		undo->page[taken].next = NO_PAGE;
		*stream->link = taken;
	}
	stream->page = &undo->page[*stream->link];
	stream->link = &stream->page->next;
	stream->at = 0;
}

static void pass(struct stream *stream, void *data, size_t size)
{
	unsigned char *bytes = data;
	stream->size += size;
	while (stream->direction != COUNTING && size > 0) {
		if (!stream->page || stream->at == PAGE_BYTES)
			turn_page(stream);
		size_t room = PAGE_BYTES - stream->at, part = size < room ? size : room;
		unsigned char *kept = stream->page->bytes + stream->at;
		if (stream->direction == WRITING)
			memcpy(kept, bytes, part);
		else
			memcpy(bytes, kept, part);
		stream->at += part;
		bytes += part;
		size -= part;
	}
}

#define PASS(stream, array, count) pass((stream), (array), (size_t)(count) * sizeof *(array))

/* What a state is: document, garment, the cloth's places, and whether a wrap was under way. */
static void pass_state(struct stream *stream, struct session *session, struct v3 *position_m,
		       uint8_t *placed, uint8_t *creased, struct gather *gather,
		       struct widening *wide, bool *wrapping)
{
	struct garment *garment = &session->garment;
	PASS(stream, &session->document, 1);
	PASS(stream, wrapping, 1);
	PASS(stream, &session->cloth.welded, 1);
	PASS(stream, &session->cloth.worn, 1);
	PASS(stream, &garment->vertex_count, 1);
	PASS(stream, &garment->triangle_count, 1);
	PASS(stream, &garment->pair_count, 1);
	PASS(stream, &garment->edge_m, 1);
	PASS(stream, garment->layer, PIECES_MAX);
	PASS(stream, garment->piece_first, PIECES_MAX + 1);
	PASS(stream, garment->piece_first_triangle, PIECES_MAX + 1);
	PASS(stream, garment->rest_m, garment->vertex_count);
	PASS(stream, garment->piece, garment->vertex_count);
	PASS(stream, garment->weld, garment->vertex_count);
	PASS(stream, garment->triangle, garment->triangle_count);
	PASS(stream, garment->triangle_piece, garment->triangle_count);
	PASS(stream, garment->pair, garment->pair_count);
	PASS(stream, &garment->base_count, 1);
	PASS(stream, garment->base, garment->base_count);
	PASS(stream, garment->depth, garment->base_count);
	PASS(stream, garment->place, garment->base_count > 0 ? garment->vertex_count : 0);
	PASS(stream, position_m, garment->vertex_count);
	PASS(stream, placed, garment->vertex_count);
	PASS(stream, creased, garment->vertex_count);
	PASS(stream, gather, PIECES_MAX);
	PASS(stream, wide, PIECES_MAX);
}

/* ---- the stock of pages ---- */

static int *state_pages(struct undo *undo, int state)
{
	return &undo->first_page[state % UNDO_STATES_MAX];
}

static void drop(struct undo *undo, int state)
{
	int *first = state_pages(undo, state);
	while (*first != NO_PAGE) {
		int page = *first;
		*first = undo->page[page].next;
		undo->page[page].next = undo->free_page;
		undo->free_page = page;
		undo->free_count++;
	}
}

/* The states from..to stay; of the others the oldest goes first, then what could be redone last. */
static void make_room(struct undo *undo, size_t size, int from, int to)
{
	int pages = (int)((size + PAGE_BYTES - 1) / PAGE_BYTES);
	while (undo->free_count < pages) {
		MUST(undo->oldest < from || undo->newest > to);
		if (undo->oldest < from)
			drop(undo, undo->oldest++);
		else
			drop(undo, undo->newest--);
	}
}

/* Saves the present as state `now`; state `next` will be wanted after it. */
static void save(struct session *session, int next)
{
	struct undo *undo = session->undo;
	struct cloth *cloth = &session->cloth;
	bool wrapping = session->job != JOB_NONE;
	struct stream stream = {.undo = undo};
	pass_state(&stream, session, cloth->position_m, cloth->placed, cloth->creased,
		   cloth->piece_gather, cloth->piece_wide, &wrapping);
	drop(undo, undo->now);
	make_room(undo, stream.size, int_min(undo->now, next), int_max(undo->now, next));
	stream.direction = WRITING;
	stream.link = state_pages(undo, undo->now);
	pass_state(&stream, session, cloth->position_m, cloth->placed, cloth->creased,
		   cloth->piece_gather, cloth->piece_wide, &wrapping);
}

static void restore(struct session *session)
{
	struct undo *undo = session->undo;
	struct cloth *cloth = &session->cloth;
	bool wrapping = false;
	struct stream stream = {.undo = undo, .direction = READING};
	stream.link = state_pages(undo, undo->now);
	pass_state(&stream, session, undo->position_m, undo->placed, undo->creased, undo->gather,
		   undo->wide, &wrapping);
	cloth_restore(cloth, &session->garment, &session->body, undo->position_m, undo->placed,
		      cloth->welded, cloth->worn);
	memcpy(cloth->creased, undo->creased, (size_t)session->garment.vertex_count);
	memcpy(cloth->piece_gather, undo->gather, sizeof undo->gather);
	memcpy(cloth->piece_wide, undo->wide, sizeof undo->wide);
	cloth_build(cloth);
	session_resume(session, wrapping);
}

/* ---- back and forward ---- */

static void count(struct session *session)
{
	const struct undo *undo = session->undo;
	session->undo_count = undo->now - undo->oldest;
	session->redo_count = undo->newest - undo->now;
}

/* What could be redone is forgotten. */
static void cut(struct undo *undo)
{
	while (undo->newest > undo->now)
		drop(undo, undo->newest--);
}

void undo_keep(struct session *session)
{
	struct undo *undo = session->undo;
	cut(undo);
	if (undo->now - undo->oldest == UNDO_STATES_MAX - 1)
		drop(undo, undo->oldest++);
	save(session, undo->now + 1);
	undo->now++;
	undo->newest = undo->now;
	count(session);
}

static bool go(struct session *session, int step)
{
	struct undo *undo = session->undo;
	int to = undo->now + step;
	if (to < undo->oldest || to > undo->newest)
		return false;
	save(session, to);
	undo->now = to;
	restore(session);
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
	cut(session->undo);
	count(session);
}

bool undo_forward(struct session *session)
{
	return go(session, 1);
}
