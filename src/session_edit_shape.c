/* The edits of an outline (S2), and what follows them: marks, seams, the other half of a symmetric
 * piece, edges that are sewn evenly (S4). */
#include "pattern_shape.h"
#include "session_private.h"

#define EVEN_MM 0.05f /* lengths that differ by less are equal */
#define MOVED_MM 0.01f
#define SAME_CORNER_MM 5.0f

static const char no_piece[] = "there is no such piece";

static struct piece *piece_at(struct document *document, int piece)
{
	return &document->pattern.piece[piece];
}

/* ---- seams whose edges are counted anew ---- */

/* Side index % 2 of seam index / 2, if that is on the piece. */
static struct edge_ref *seam_side(struct pattern *pattern, int index, int piece)
{
	struct seam *seam = &pattern->seam[index / 2];
	struct edge_ref *side = index % 2 ? &seam->b : &seam->a;
	return seam->used && side->piece == piece ? side : NULL;
}

/* After an outline was drawn anew, each seam on it moves to the edge that lies nearest to the
 * middle of its old one; of two on one edge the earlier stays. */
static void move_seams(struct pattern *pattern, int at, const struct piece *old)
{
	for (int i = 0; i < 2 * SEAMS_MAX; i++) {
		struct edge_ref *side = seam_side(pattern, i, at);
		float fraction;
		if (side)
			piece_nearest_edge(&pattern->piece[at],
					   piece_edge_point(old, side->edge, 0.5f), &side->edge,
					   &fraction);
	}
	for (int i = 0; i < 2 * SEAMS_MAX; i++)
		for (int k = 0; k < i; k++) {
			const struct edge_ref *one = seam_side(pattern, i, at);
			const struct edge_ref *two = seam_side(pattern, k, at);
			if (one && two && one->edge == two->edge)
				pattern->seam[i / 2].used = false;
		}
}

static int seam_on(const struct pattern *pattern, int piece, int edge)
{
	for (int s = 0; s < SEAMS_MAX; s++) {
		const struct seam *seam = &pattern->seam[s];
		if (seam->used && ((seam->a.piece == piece && seam->a.edge == edge) ||
				   (seam->b.piece == piece && seam->b.edge == edge)))
			return s;
	}
	return -1;
}

/* Its side on that edge first. */
static void turn_seam(struct seam *seam, int piece, int edge)
{
	if (seam->a.piece == piece && seam->a.edge == edge)
		return;
	struct edge_ref keep = seam->a;
	seam->a = seam->b;
	seam->b = keep;
}

static const char *insert_corner(struct pattern *pattern, struct edge_ref at, float fraction)
{
	const char *fault = piece_split(&pattern->piece[at.piece], at.edge, fraction);
	for (int i = 0; !fault && i < 2 * SEAMS_MAX; i++) {
		struct edge_ref *side = seam_side(pattern, i, at.piece);
		if (side && side->edge > at.edge)
			side->edge++;
	}
	return fault;
}

/* What was sewn stays sewn: the other edge is divided at the place that lies against this one. */
static const char *split(struct pattern *pattern, int piece, int edge, float fraction)
{
	int s = seam_on(pattern, piece, edge), free_seam = 0;
	if (s < 0)
		return insert_corner(pattern, (struct edge_ref){piece, edge}, fraction);
	while (free_seam < SEAMS_MAX && pattern->seam[free_seam].used)
		free_seam++;
	if (free_seam == SEAMS_MAX)
		return "there are as many seams as fit; remove one first";
	struct seam *one = &pattern->seam[s], *two = &pattern->seam[free_seam];
	turn_seam(one, piece, edge);
	*two = *one;
	const char *fault = insert_corner(pattern, one->a, fraction);
	if (fault)
		return fault;
	two->a.edge++;
	fault = insert_corner(pattern, one->b, one->swapped ? fraction : 1.0f - fraction);
	if (fault)
		return fault;
	two->b.edge += one->swapped;
	one->b.edge += !one->swapped;
	return NULL;
}

static const char *remove_corner(struct pattern *pattern, int piece, int corner)
{
	int last = piece_edge_count(&pattern->piece[piece]) - 1;
	const char *fault = piece_join(&pattern->piece[piece], corner);
	for (int i = 0; !fault && i < 2 * SEAMS_MAX; i++) {
		struct edge_ref *side = seam_side(pattern, i, piece);
		if (side && corner == 0)
			side->edge = side->edge == 0 ? last - 1 : side->edge - 1;
		else if (side && side->edge >= corner)
			side->edge--;
	}
	return fault;
}

/* Two seams that were one before a corner was made: the corner on their other side; -1: none. */
static int across(const struct pattern *pattern, const struct seam *before,
		  const struct seam *after)
{
	const struct piece *other = &pattern->piece[before->b.piece];
	const struct edge_ref *first = before->swapped ? &before->b : &after->b;
	const struct edge_ref *second = before->swapped ? &after->b : &before->b;
	bool one = before->b.piece == after->b.piece && before->swapped == after->swapped &&
		   (first->edge + 1) % piece_edge_count(other) == second->edge;
	return one ? second->edge : -1;
}

static int corner_near(const struct piece *piece, struct v2 mm)
{
	for (int k = 0; k < piece_edge_count(piece); k++)
		if (v2_distance(piece_corner_mm(piece, k), mm) < SAME_CORNER_MM)
			return k;
	return -1;
}

/* One seam at most is left on the edge that two become. */
static const char *join(struct pattern *pattern, int piece, int corner)
{
	int edges = piece_edge_count(&pattern->piece[piece]);
	int before = seam_on(pattern, piece, (corner + edges - 1) % edges);
	int after = seam_on(pattern, piece, corner);
	if (before < 0 || after < 0 || before == after) {
		if (before >= 0 && before == after)
			pattern->seam[after].used = false;
		return remove_corner(pattern, piece, corner);
	}
	struct seam *one = &pattern->seam[before], *two = &pattern->seam[after];
	turn_seam(one, piece, (corner + edges - 1) % edges);
	turn_seam(two, piece, corner);
	int other = across(pattern, one, two), partner = one->b.piece;
	struct v2 there = {0.0f, 0.0f};
	if (other >= 0)
		there = piece_corner_mm(&pattern->piece[partner], other);
	two->used = false;
	const char *fault = remove_corner(pattern, piece, corner);
	other = other >= 0 ? corner_near(&pattern->piece[partner], there) : -1;
	return fault || other < 0 ? fault : remove_corner(pattern, partner, other);
}

/* ---- edges that are sewn evenly ---- */

static float edge_length(const struct pattern *pattern, struct edge_ref edge)
{
	return piece_edge_length_mm(&pattern->piece[edge.piece], edge.edge);
}

/* What an edge was before: an edge of the old piece with the same corners counts. */
static bool edge_changed(const struct pattern *pattern, const struct pattern *old,
			 struct edge_ref edge)
{
	const struct piece *was = &old->piece[edge.piece];
	return edge.edge >= piece_edge_count(was) ||
	       float_abs(edge_length(pattern, edge) - piece_edge_length_mm(was, edge.edge)) >
		       EVEN_MM;
}

static bool end_moved(const struct pattern *pattern, const struct pattern *old,
		      struct edge_ref edge, bool last)
{
	const struct piece *is = &pattern->piece[edge.piece], *was = &old->piece[edge.piece];
	int edges = piece_edge_count(is), k = last ? (edge.edge + 1) % edges : edge.edge;
	return k >= piece_edge_count(was) ||
	       v2_distance(piece_corner_mm(is, k), piece_corner_mm(was, k)) > MOVED_MM;
}

/* The end of `follower` that lies against the end of `leader` that stayed: 0 start, 1 end, 2 both
 * or none did. */
static int still_end(const struct pattern *pattern, const struct pattern *old,
		     const struct seam *seam, struct edge_ref leader)
{
	bool start = end_moved(pattern, old, leader, false);
	bool end = end_moved(pattern, old, leader, true);
	if (start == end)
		return 2;
	bool start_stays = !start;
	return seam->swapped ? (start_stays ? 0 : 1) : (start_stays ? 1 : 0);
}

/* The follower as long as the leader, and its other half on a symmetric piece. An outline that
 * could not be cut any more stays as it was: what is too long is eased in. */
static void follow(struct pattern *pattern, const struct pattern *old, const struct seam *seam,
		   struct edge_ref leader, struct edge_ref follower)
{
	struct piece *piece = &pattern->piece[follower.piece];
	struct piece tried = *piece;
	int still = still_end(pattern, old, seam, leader);
	int other = piece->symmetric ? piece_other_edge(piece, follower.edge) : -1;
	float length = edge_length(pattern, leader);
	const char *fault = piece_resize_edge(&tried, follower.edge, length, still);
	if (!fault && other >= 0 && other != follower.edge)
		fault = piece_resize_edge(&tried, other, length, still < 2 ? 1 - still : 2);
	if (!fault && !piece_fault(&tried))
		*piece = tried;
}

/* The edge that was edited leads; what follows may lead in its turn. */
static void keep_even(struct pattern *pattern, const struct pattern *old)
{
	bool done[SEAMS_MAX] = {false};
	for (int pass = 0; pass < SEAMS_MAX; pass++) {
		bool moved = false;
		for (int s = 0; s < SEAMS_MAX; s++) {
			const struct seam *seam = &pattern->seam[s];
			if (!seam->used || !seam->even || done[s] ||
			    float_abs(edge_length(pattern, seam->a) -
				      edge_length(pattern, seam->b)) < EVEN_MM)
				continue;
			bool a = edge_changed(pattern, old, seam->a);
			if (a || !edge_changed(pattern, old, seam->b))
				follow(pattern, old, seam, seam->a, seam->b);
			else
				follow(pattern, old, seam, seam->b, seam->a);
			moved = done[s] = true;
		}
		if (!moved)
			return;
	}
}

/* ---- the edits ---- */

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
	const char *fault = split(pattern, at, edge, fraction);
	if (fault || !piece->symmetric || corner_near(piece, there) >= 0)
		return fault;
	piece_nearest_edge(piece, there, &edge, &fraction);
	return split(pattern, at, edge, fraction);
}

static const char *join_both(struct pattern *pattern, int at, int corner)
{
	struct piece *piece = &pattern->piece[at];
	struct v2 there = piece_reflect(piece, piece_corner_mm(piece, corner));
	const char *fault = join(pattern, at, corner);
	int other = piece->symmetric ? corner_near(piece, there) : -1;
	return fault || other < 0 ? fault : join(pattern, at, other);
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
	piece->point_count = edit->point_count;
	for (int i = 0; i < edit->point_count; i++) {
		piece->point_mm[i] = (struct v2){edit->point[i].x, edit->point[i].y};
		piece->corner[i] = edit->corner[i];
	}
	const char *fault = piece_fault(piece);
	if (!fault && piece->symmetric)
		fault = piece_fold(piece, changed_side(piece, &old));
	if (!fault)
		move_seams(&document->pattern, edit->i[0], &old);
	return fault;
}

static const char *fold(struct document *document, const struct edit *edit)
{
	struct piece *piece = piece_at(document, edit->i[0]);
	struct piece old = *piece;
	piece->symmetric = false;
	if (edit->i[1] == 0)
		return NULL;
	if (!(float_abs(edit->f[0]) <= 20000.0f && float_abs(edit->f[1]) <= 20000.0f &&
	      float_abs(edit->f[2]) <= 100.0f))
		return "the axis does not meet the piece";
	piece->axis_mm = (struct v2){edit->f[0], edit->f[1]};
	piece->axis_rad = edit->f[2];
	const char *fault = piece_fold(piece, 0);
	if (!fault)
		move_seams(&document->pattern, edit->i[0], &old);
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
		return no_piece;
	if (counted &&
	    (edit->i[1] < 0 || edit->i[1] >= piece_edge_count(&document->pattern.piece[piece])))
		return "the piece has no such edge or corner";
	if (placed && !(float_abs(edit->f[0]) <= 20000.0f && float_abs(edit->f[1]) <= 20000.0f))
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
			keep_even(pattern, &document->pattern);
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
		keep_even(pattern, &document->pattern);
	return fault;
}
