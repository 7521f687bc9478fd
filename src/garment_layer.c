/* Which garment is worn over which: pieces that hang together by seams are one garment. */
#include "forest.h"
#include "garment.h"

static void join_sewn(const struct pattern *pattern, int root[PIECES_MAX])
{
	forest_begin(root, PIECES_MAX);
	for (int s = 0; s < SEAMS_MAX; s++) {
		const struct seam *seam = &pattern->seam[s];
		if (seam->used)
			forest_join(root, seam->a.piece, seam->b.piece);
	}
}

void garment_layers(const struct pattern *pattern, int layer[PIECES_MAX])
{
	int root[PIECES_MAX], over[PIECES_MAX] = {0};
	join_sewn(pattern, root);
	for (int p = 0; p < PIECES_MAX; p++)
		if (pattern->piece[p].used)
			over[forest_root(root, p)] = int_max(over[forest_root(root, p)],
							     pattern->piece[p].worn_over);
	for (int p = 0; p < PIECES_MAX; p++) {
		int own = forest_root(root, p);
		layer[p] = 0;
		for (int q = 0; q < PIECES_MAX; q++)
			if (pattern->piece[q].used && forest_root(root, q) == q &&
			    (over[q] < over[own] || (over[q] == over[own] && q < own)))
				layer[p]++;
	}
}
