/* Which garment is worn over which: pieces that hang together by seams are one garment. */
#include "garment.h"

static int root_of(int root[PIECES_MAX], int p)
{
	while (root[p] != p)
		p = root[p] = root[root[p]];
	return p;
}

static void join_sewn(const struct pattern *pattern, int root[PIECES_MAX])
{
	for (int p = 0; p < PIECES_MAX; p++)
		root[p] = p;
	for (int s = 0; s < SEAMS_MAX; s++) {
		if (!pattern->seam[s].used)
			continue;
		int a = root_of(root, pattern->seam[s].a.piece);
		int b = root_of(root, pattern->seam[s].b.piece);
		root[int_max(a, b)] = int_min(a, b);
	}
}

void garment_layers(const struct pattern *pattern, int layer[PIECES_MAX])
{
	int root[PIECES_MAX], over[PIECES_MAX] = {0};
	join_sewn(pattern, root);
	for (int p = 0; p < PIECES_MAX; p++)
		if (pattern->piece[p].used)
			over[root_of(root, p)] = int_max(over[root_of(root, p)],
							 pattern->piece[p].worn_over);
	for (int p = 0; p < PIECES_MAX; p++) {
		int own = root_of(root, p);
		layer[p] = 0;
		for (int q = 0; q < PIECES_MAX; q++)
			if (pattern->piece[q].used && root_of(root, q) == q &&
			    (over[q] < over[own] || (over[q] == over[own] && q < own)))
				layer[p]++;
	}
}
