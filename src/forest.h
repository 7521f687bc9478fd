/* Which of `count` things hang together: each knows one on the way to its group's root, which knows
 * itself. */
#ifndef FOREST_H
#define FOREST_H

#include "base.h"

/* Everything alone. */
static inline void forest_begin(int *root, int count)
{
	for (int i = 0; i < count; i++)
		root[i] = i;
}

/* Ways are halved as they are gone. */
static inline int forest_root(int *root, int i)
{
	while (root[i] != i)
		i = root[i] = root[root[i]];
	return i;
}

/* The lower root stays one. */
static inline void forest_join(int *root, int i, int k)
{
	int a = forest_root(root, i), b = forest_root(root, k);
	root[int_max(a, b)] = int_min(a, b);
}

#endif
