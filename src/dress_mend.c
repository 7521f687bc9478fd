/* Marks that contradict the seams: the pieces that they lay stand apart from all that they are sewn
 * to. Two such pieces on the left and the right of the body had their marks swapped; any other is
 * better laid by its seams. The wrap then begins anew, once. */
#include "dress_private.h"

static const float apart_m = 0.06f;
static const float astray_share = 0.8f; /* of a piece's sewn vertices that stand apart */

/* Per piece: do nearly all vertices sewn to other pieces stand apart? Returns how many pieces. */
static int find_astray(const struct wrap *wrap, bool astray[PIECES_MAX])
{
	const struct cloth *cloth = wrap->cloth;
	const struct garment *garment = cloth->garment;
	int sewn[PIECES_MAX] = {0}, apart[PIECES_MAX] = {0}, count = 0;
	for (int i = 0; i < garment->pair_count; i++) {
		int a = garment->pair[i].a, b = garment->pair[i].b;
		if (garment->piece[a] == garment->piece[b] || !cloth->placed[a] ||
		    !cloth->placed[b])
			continue;
		bool wide = v3_distance(cloth->position_m[a], cloth->position_m[b]) > apart_m;
		sewn[garment->piece[a]]++;
		sewn[garment->piece[b]]++;
		apart[garment->piece[a]] += wide;
		apart[garment->piece[b]] += wide;
	}
	for (int p = 0; p < PIECES_MAX; p++) {
		astray[p] = sewn[p] > 0 && wrap_piece_mark(wrap, p) &&
			    (float)apart[p] > astray_share * (float)sewn[p];
		count += astray[p];
	}
	return count;
}

static bool are_opposite(int a, int b)
{
	return (a == PART_ARM_LEFT && b == PART_ARM_RIGHT) ||
	       (a == PART_ARM_RIGHT && b == PART_ARM_LEFT) ||
	       (a == PART_LEG_LEFT && b == PART_LEG_RIGHT) ||
	       (a == PART_LEG_RIGHT && b == PART_LEG_LEFT);
}

/* The only two pieces astray lie on opposite limbs, with a mark each: the marks change places. */
static bool swap_back(struct wrap *wrap, const bool astray[PIECES_MAX])
{
	int found[2] = {-1, -1}, count = 0, *partner = wrap->scratch->partner;
	for (int p = 0; p < PIECES_MAX; p++)
		if (astray[p] && count++ < 2)
			found[count - 1] = p;
	if (count != 2 ||
	    !are_opposite(wrap->scratch->home[found[0]], wrap->scratch->home[found[1]]))
		return false;
	int a = wrap_piece_mark(wrap, found[0]), b = wrap_piece_mark(wrap, found[1]), swap;
	swap = partner[a];
	partner[a] = partner[b];
	partner[b] = swap;
	wrap_diagnose(wrap, "marks-swapped", a, b,
		      "Marks %1 and %2 were swapped, left for right; each piece was laid where "
		      "its seams want it.");
	return true;
}

static void ignore_marks(struct wrap *wrap, const bool astray[PIECES_MAX])
{
	for (int m = 0; m < MARKS_MAX; m++) {
		const struct cloth_mark *mark = &wrap->marks->cloth[m];
		if (!mark->used || !astray[mark->piece] || !wrap_partner(wrap, mark->number))
			continue;
		wrap->scratch->partner[mark->number] = 0;
		wrap_diagnose(wrap, "mark-ignored", mark->number, 0,
			      "Mark %1 holds its piece away from all that it is sewn to; the "
			      "piece was laid by its seams instead.");
	}
}

static int marked_pieces(const struct wrap *wrap)
{
	int count = 0;
	for (int p = 0; p < PIECES_MAX; p++)
		count += wrap_piece_mark(wrap, p) != 0;
	return count;
}

bool wrap_mend_marks(struct wrap *wrap)
{
	bool astray[PIECES_MAX];
	int count = find_astray(wrap, astray);
	if (wrap->scratch->mended || count == 0 || count == marked_pieces(wrap))
		return false;
	wrap->scratch->mended = true;
	if (!swap_back(wrap, astray))
		ignore_marks(wrap, astray);
	return true;
}
