/* One block of memory, handed out at start, then sealed. Nothing is ever given back. */
#ifndef ARENA_H
#define ARENA_H

#include "base.h"

struct arena {
	unsigned char *base;
	size_t size;
	size_t used;
	bool sealed;
};

void arena_init(struct arena *arena, void *memory, size_t size);

/* Zeroed memory, aligned to 64 bytes. MUST fails when the arena is sealed or full: both are bugs,
 * the sizes are constants (limits.h). */
void *arena_take(struct arena *arena, size_t count, size_t size);
void arena_seal(struct arena *arena);

#define ARENA_ARRAY(arena, type, count) ((type *)arena_take((arena), (size_t)(count), sizeof(type)))

#endif
