/* What stays sewn, and how, while edges come, go and grow. */
#include "pattern_seams.h"

#include "pattern_shape.h"

#define EVEN_MM 0.05f /* lengths that differ by less are equal */
#define MOVED_MM 0.01f
#define SAME_CORNER_MM 5.0f

/* Side index % 2 of seam index / 2, if that is on the piece. */
static struct edge_ref *seam_side(struct pattern *pattern, int index, int piece)
{
	struct seam *seam = &pattern->seam[index / 2];
	struct edge_ref *side = index % 2 ? &seam->b : &seam->a;
	return seam->used && side->piece == piece ? side : NULL;
}

void pattern_move_seams(struct pattern *pattern, int at, const struct piece *old)
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

const char *pattern_split(struct pattern *pattern, int piece, int edge, float fraction)
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

int piece_corner_near(const struct piece *piece, struct v2 mm)
{
	for (int k = 0; k < piece_edge_count(piece); k++)
		if (v2_distance(piece_corner_mm(piece, k), mm) < SAME_CORNER_MM)
			return k;
	return -1;
}

const char *pattern_join(struct pattern *pattern, int piece, int corner)
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
	other = other >= 0 ? piece_corner_near(&pattern->piece[partner], there) : -1;
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

void pattern_keep_even(struct pattern *pattern, const struct pattern *old)
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
