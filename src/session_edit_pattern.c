/* The edits of the flat pattern: pieces and seams (S2 to S4). */
#include "session_private.h"
#include "session_undo.h"

static bool piece_exists(const struct session *session, int piece)
{
	return piece >= 0 && piece < PIECES_MAX && session->document.pattern.piece[piece].used;
}

const char session_no_piece[] = "there is no such piece";

static int top_layer(const struct pattern *pattern)
{
	int top = 0;
	for (int i = 0; i < PIECES_MAX; i++)
		if (pattern->piece[i].used)
			top = int_max(top, pattern->piece[i].layer);
	return top;
}

void session_take_outline(struct piece *piece, const struct edit *edit)
{
	piece->point_count = edit->point_count;
	for (int i = 0; i < edit->point_count; i++) {
		piece->point_mm[i] = (struct v2){edit->point[i].x, edit->point[i].y};
		piece->corner[i] = edit->corner[i];
	}
}

bool session_is_place(float x_mm, float y_mm, float turn_rad)
{
	return float_abs(x_mm) <= 20000.0f && float_abs(y_mm) <= 20000.0f &&
	       float_abs(turn_rad) <= 100.0f;
}

static const char *add_piece(struct session *session, const struct edit *edit)
{
	struct pattern *pattern = &session->document.pattern;
	int at = pattern_free_piece(&session->document.pattern);
	if (at < 0)
		return "the pattern is full; delete a piece first";
	struct piece piece;
	memset(&piece, 0, sizeof piece);
	piece.used = true;
	memcpy(piece.name, edit->name, NAME_BYTES_MAX);
	piece.swatch = edit->i[0] & 7;
	piece.inside_up = edit->i[1] != 0;
	piece.position_mm = (struct v2){edit->f[0], edit->f[1]};
	piece.turn_rad = edit->f[2];
	piece.layer = top_layer(pattern) + 1;
	session_take_outline(&piece, edit);
	if (!session_is_place(edit->f[0], edit->f[1], edit->f[2]))
		return "the piece lies too far away";
	const char *fault = piece_fault(&piece);
	if (fault)
		return fault;
	undo_keep(session);
	pattern->piece[at] = piece;
	return NULL;
}

/* Tried on a draft first, so that what is refused has changed nothing. */
static const char *change_shape(struct session *session, const struct edit *edit)
{
	const char *fault = document_shape(&session->draft, &session->document, edit);
	if (fault)
		return fault;
	undo_keep(session);
	session->document = session->draft;
	return NULL;
}

static const char *place_piece(struct session *session, const struct edit *edit)
{
	if (!piece_exists(session, edit->i[0]))
		return session_no_piece;
	if (!session_is_place(edit->f[0], edit->f[1], edit->f[2]))
		return "the piece would lie too far away";
	undo_keep(session);
	struct pattern *pattern = &session->document.pattern;
	struct piece *piece = &pattern->piece[edit->i[0]];
	piece->inside_up = edit->i[1] != 0;
	piece->position_mm = (struct v2){edit->f[0], edit->f[1]};
	piece->turn_rad = edit->f[2];
	piece->layer = top_layer(pattern) + 1;
	return NULL;
}

static const char *copy_piece(struct session *session, const struct edit *edit)
{
	if (!piece_exists(session, edit->i[0]))
		return session_no_piece;
	int at = pattern_free_piece(&session->document.pattern);
	if (at < 0)
		return "the pattern is full; delete a piece first";
	struct pattern *pattern = &session->document.pattern;
	struct v2 place = v2_add(pattern->piece[edit->i[0]].position_mm,
				 (struct v2){edit->f[0], edit->f[1]});
	if (!session_is_place(place.x, place.y, 0.0f))
		return "the copy would lie too far away";
	undo_keep(session);
	pattern->piece[at] = pattern->piece[edit->i[0]];
	pattern->piece[at].position_mm = place;
	pattern->piece[at].layer = top_layer(pattern) + 1;
	return NULL;
}

/* The mirror image in x, kept counter-clockwise by walking the outline backwards. Edge k of n
 * becomes edge n - 1 - k because the walk begins at the same corner. */
static const char *mirror_piece(struct session *session, const struct edit *edit)
{
	int at = edit->i[0];
	if (!piece_exists(session, at))
		return session_no_piece;
	undo_keep(session);
	struct pattern *pattern = &session->document.pattern;
	struct piece *piece = &pattern->piece[at];
	struct piece old;
	old = *piece;
	int count = piece->point_count, first, last;
	piece_edge(&old, 0, &first, &last);
	for (int i = 0; i < count; i++) {
		int from = (first - i + count) % count;
		piece->point_mm[i] = (struct v2){-old.point_mm[from].x, old.point_mm[from].y};
		piece->corner[i] = old.corner[from];
	}
	piece->axis_mm.x = -old.axis_mm.x;
	piece->axis_rad = -old.axis_rad;
	int edges = piece_edge_count(&old);
	for (int s = 0; s < SEAMS_MAX; s++) {
		struct seam *seam = &pattern->seam[s];
		if (seam->used && seam->a.piece == at)
			seam->a.edge = edges - 1 - seam->a.edge;
		if (seam->used && seam->b.piece == at)
			seam->b.edge = edges - 1 - seam->b.edge;
		if (seam->used && (seam->a.piece == at) != (seam->b.piece == at))
			seam->swapped = !seam->swapped;
	}
	for (int m = 0; m < MARKS_MAX; m++) {
		struct cloth_mark *mark = &session->document.marks.cloth[m];
		for (int i = 0; mark->used && mark->piece == at && i < mark->point_count; i++)
			mark->point_mm[i].x = -mark->point_mm[i].x;
	}
	return NULL;
}

static const char *delete_piece(struct session *session, const struct edit *edit)
{
	int at = edit->i[0];
	if (!piece_exists(session, at))
		return session_no_piece;
	undo_keep(session);
	struct document *document = &session->document;
	document->pattern.piece[at].used = false;
	for (int s = 0; s < SEAMS_MAX; s++) {
		struct seam *seam = &document->pattern.seam[s];
		if (seam->a.piece == at || seam->b.piece == at)
			seam->used = false;
	}
	for (int m = 0; m < MARKS_MAX; m++)
		if (document->marks.cloth[m].piece == at)
			document->marks.cloth[m].used = false;
	return NULL;
}

static const char *colour_piece(struct session *session, const struct edit *edit)
{
	if (!piece_exists(session, edit->i[0]))
		return session_no_piece;
	undo_keep(session);
	session->document.pattern.piece[edit->i[0]].swatch = edit->i[1] & 7;
	return NULL;
}

static bool edge_exists(const struct session *session, int piece, int edge)
{
	return piece_exists(session, piece) && edge >= 0 &&
	       edge < piece_edge_count(&session->document.pattern.piece[piece]);
}

static bool edge_is_sewn(const struct pattern *pattern, struct edge_ref edge)
{
	for (int s = 0; s < SEAMS_MAX; s++) {
		const struct seam *seam = &pattern->seam[s];
		if (seam->used && ((seam->a.piece == edge.piece && seam->a.edge == edge.edge) ||
				   (seam->b.piece == edge.piece && seam->b.edge == edge.edge)))
			return true;
	}
	return false;
}

static const char *sew(struct session *session, const struct edit *edit)
{
	struct pattern *pattern = &session->document.pattern;
	struct edge_ref a = {edit->i[0], edit->i[1]}, b = {edit->i[2], edit->i[3]};
	if (!edge_exists(session, a.piece, a.edge) || !edge_exists(session, b.piece, b.edge))
		return "there is no such edge";
	if (a.piece == b.piece && a.edge == b.edge)
		return "an edge can't be sewn to itself";
	if (edge_is_sewn(pattern, a) || edge_is_sewn(pattern, b))
		return "that edge is sewn already; undo its seam first";
	for (int s = 0; s < SEAMS_MAX; s++) {
		if (pattern->seam[s].used)
			continue;
		undo_keep(session);
		pattern->seam[s] = (struct seam){
			.used = true, .swapped = edit->i[4] != 0, .a = a, .b = b};
		return NULL;
	}
	return "there are as many seams as fit; remove one first";
}

static const char *unsew(struct session *session, const struct edit *edit)
{
	int s = edit->i[0];
	if (s < 0 || s >= SEAMS_MAX || !session->document.pattern.seam[s].used)
		return "there is no such seam";
	undo_keep(session);
	session->document.pattern.seam[s].used = false;
	return NULL;
}

static const char *set_layer(struct session *session, const struct edit *edit)
{
	if (!piece_exists(session, edit->i[0]))
		return session_no_piece;
	if (edit->i[1] < 0 || edit->i[1] > 9)
		return "garments are worn in layers 0 to 9";
	undo_keep(session);
	session->document.pattern.piece[edit->i[0]].worn_over = edit->i[1];
	return NULL;
}

const char *session_edit_pattern(struct session *session, const struct edit *edit)
{
	switch (edit->kind) {
	case EDIT_PIECE:
		return add_piece(session, edit);
	case EDIT_OUTLINE:
	case EDIT_SCALE:
	case EDIT_POINT:
	case EDIT_BEND:
	case EDIT_SPLIT:
	case EDIT_JOIN:
	case EDIT_FOLD:
	case EDIT_EVEN:
		return change_shape(session, edit);
	case EDIT_PLACE:
		return place_piece(session, edit);
	case EDIT_COPY:
		return copy_piece(session, edit);
	case EDIT_MIRROR:
		return mirror_piece(session, edit);
	case EDIT_DELETE:
		return delete_piece(session, edit);
	case EDIT_SWATCH:
		return colour_piece(session, edit);
	case EDIT_LAYER:
		return set_layer(session, edit);
	case EDIT_SEW:
		return sew(session, edit);
	case EDIT_UNSEW:
		return unsew(session, edit);
	default:
		must_fail("an edit of the pattern", __FILE__, __LINE__);
		return NULL;
	}
}
