/* The edits of an outline (S2), and what follows them: marks, seams, the other half of a symmetric
 * piece, edges that are sewn evenly (S4). */
#include "pattern_seams.h"
#include "pattern_shape.h"
#include "session_private.h"

static struct piece *piece_at(struct document *document, int piece)
{
	return &document->pattern.piece[piece];
}

static void scale_marks(struct marks *marks, int piece, struct v2 factor, struct v2 about_mm)
{
	for (int m = 0; m < MARKS_MAX; m++) {
		struct cloth_mark *mark = &marks->cloth[m];
		for (int i = 0; mark->used && mark->piece == piece && i < mark->point_count; i++) {
			struct v2 d = v2_sub(mark->point_mm[i], about_mm);
			mark->point_mm[i] = (struct v2){about_mm.x + factor.x * d.x,
							about_mm.y + factor.y * d.y};
		}
	}
}

/* A slanted axis survives only what keeps its angles. */
static const char *scale(struct document *document, const struct edit *edit)
{
	struct piece *piece = piece_at(document, edit->i[0]);
	struct v2 factor = {edit->f[0], edit->f[1]}, about = {edit->f[2], edit->f[3]};
	struct v2 d = v2_sub(piece->axis_mm, about);
	float s = angle_sin(piece->axis_rad), c = angle_cos(piece->axis_rad);
	bool square = float_abs(s * c) < 1e-4f || float_abs(factor.x - factor.y) < 1e-6f;
	const char *fault = piece_scale(piece, factor, about);
	if (fault)
		return fault;
	piece->symmetric &= square;
	piece->axis_mm = (struct v2){about.x + factor.x * d.x, about.y + factor.y * d.y};
	scale_marks(&document->marks, edit->i[0], factor, about);
	return NULL;
}

static const char *move_point(struct piece *piece, int corner, struct v2 to_mm)
{
	int other = piece->symmetric ? piece_other_corner(piece, corner) : -1;
	if (other == corner)
		to_mm = piece_onto_axis(piece, to_mm);
	const char *fault = piece_move_corner(piece, corner, to_mm);
	if (fault || other < 0 || other == corner)
		return fault;
	return piece_move_corner(piece, other, piece_reflect(piece, to_mm));
}

static const char *bend(struct piece *piece, int edge, struct v2 middle_mm)
{
	int other = piece->symmetric ? piece_other_edge(piece, edge) : -1;
	if (other == edge)
		middle_mm = piece_onto_axis(piece, middle_mm);
	const char *fault = piece_bend(piece, edge, middle_mm);
	if (fault || other < 0 || other == edge)
		return fault;
	return piece_bend(piece, other, piece_reflect(piece, middle_mm));
}

static const char *split_both(struct pattern *pattern, int at, int edge, float fraction)
{
	struct piece *piece = &pattern->piece[at];
	struct v2 there = piece_reflect(piece, piece_edge_point(piece, edge, fraction));
	const char *fault = pattern_split(pattern, at, edge, fraction);
	if (fault || !piece->symmetric || piece_corner_near(piece, there) >= 0)
		return fault;
	piece_nearest_edge(piece, there, &edge, &fraction);
	return pattern_split(pattern, at, edge, fraction);
}

static const char *join_both(struct pattern *pattern, int at, int corner)
{
	struct piece *piece = &pattern->piece[at];
	struct v2 there = piece_reflect(piece, piece_corner_mm(piece, corner));
	const char *fault = pattern_join(pattern, at, corner);
	int other = piece->symmetric ? piece_corner_near(piece, there) : -1;
	return fault || other < 0 ? fault : pattern_join(pattern, at, other);
}

/* Which half of a symmetric piece was drawn anew: the one that is farther from what it was. */
static int changed_side(const struct piece *piece, const struct piece *old)
{
	float most[2] = {0.0f, 0.0f};
	struct v2 way = {angle_cos(piece->axis_rad), angle_sin(piece->axis_rad)};
	for (int i = 0; i < piece->point_count; i++) {
		struct v2 at = piece->point_mm[i];
		int edge, left = v2_cross(way, v2_sub(at, piece->axis_mm)) > 0.0f;
		float fraction, off = piece_nearest_edge(old, at, &edge, &fraction);
		most[left] = float_max(most[left], off);
	}
	return most[1] >= most[0] ? 1 : -1;
}

static const char *outline(struct document *document, const struct edit *edit)
{
	struct piece *piece = piece_at(document, edit->i[0]);
	struct piece old = *piece;
	session_take_outline(piece, edit);
	const char *fault = piece_fault(piece);
	if (!fault && piece->symmetric)
		fault = piece_fold(piece, changed_side(piece, &old));
	if (!fault)
		pattern_move_seams(&document->pattern, edit->i[0], &old);
	return fault;
}

static const char *fold(struct document *document, const struct edit *edit)
{
	struct piece *piece = piece_at(document, edit->i[0]);
	struct piece old = *piece;
	piece->symmetric = false;
	if (edit->i[1] == 0)
		return NULL;
	if (!session_is_place(edit->f[0], edit->f[1], edit->f[2]))
		return "the axis does not meet the piece";
	piece->axis_mm = (struct v2){edit->f[0], edit->f[1]};
	piece->axis_rad = edit->f[2];
	const char *fault = piece_fold(piece, 0);
	if (!fault)
		pattern_move_seams(&document->pattern, edit->i[0], &old);
	return fault;
}

static const char *set_even(struct document *document, const struct edit *edit)
{
	int s = edit->i[0];
	if (s < 0 || s >= SEAMS_MAX || !document->pattern.seam[s].used)
		return "there is no such seam";
	document->pattern.seam[s].even = edit->i[1] != 0;
	return NULL;
}

/* Which of a piece's corners or edges an edit is about must exist. */
static const char *check_shape(const struct document *document, const struct edit *edit)
{
	int piece = edit->i[0];
	bool counted = edit->kind == EDIT_POINT || edit->kind == EDIT_BEND ||
		       edit->kind == EDIT_SPLIT || edit->kind == EDIT_JOIN;
	bool placed = edit->kind == EDIT_POINT || edit->kind == EDIT_BEND;
	if (piece < 0 || piece >= PIECES_MAX || !document->pattern.piece[piece].used)
		return session_no_piece;
	if (counted &&
	    (edit->i[1] < 0 || edit->i[1] >= piece_edge_count(&document->pattern.piece[piece])))
		return "the piece has no such edge or corner";
	if (placed && !session_is_place(edit->f[0], edit->f[1], 0.0f))
		return "the outline leaves the sheet (10 m from its middle)";
	return NULL;
}

static const char *change(struct document *document, const struct edit *edit)
{
	struct pattern *pattern = &document->pattern;
	struct v2 to = {edit->f[0], edit->f[1]};
	switch (edit->kind) {
	case EDIT_OUTLINE:
		return outline(document, edit);
	case EDIT_SCALE:
		return scale(document, edit);
	case EDIT_POINT:
		return move_point(&pattern->piece[edit->i[0]], edit->i[1], to);
	case EDIT_BEND:
		return bend(&pattern->piece[edit->i[0]], edit->i[1], to);
	case EDIT_SPLIT:
		return split_both(pattern, edit->i[0], edit->i[1], edit->f[0]);
	case EDIT_JOIN:
		return join_both(pattern, edit->i[0], edit->i[1]);
	case EDIT_FOLD:
		return fold(document, edit);
	default:
		must_fail("an edit of a shape", __FILE__, __LINE__);
		return NULL;
	}
}

const char *document_shape(struct document *draft, const struct document *document,
			   const struct edit *edit)
{
	struct pattern *pattern = &draft->pattern;
	*draft = *document;
	if (edit->kind == EDIT_EVEN) {
		const char *wrong = set_even(draft, edit);
		if (!wrong)
			pattern_keep_even(pattern, &document->pattern);
		return wrong;
	}
	const char *fault = check_shape(draft, edit);
	if (!fault)
		fault = change(draft, edit);
	for (int p = 0; !fault && p < PIECES_MAX; p++) {
		const struct piece *is = &pattern->piece[p], *was = &document->pattern.piece[p];
		if (is->used && memcmp(is, was, sizeof *is) != 0)
			fault = piece_fault(is);
	}
	if (!fault)
		pattern_keep_even(pattern, &document->pattern);
	return fault;
}
