#include "arena.h"

enum { ARENA_ALIGNMENT = 64 };

void arena_init(struct arena *arena, void *memory, size_t size)
{
	arena->base = memory;
	arena->size = size;
	arena->used = 0;
	arena->sealed = false;
}

void *arena_take(struct arena *arena, size_t count, size_t size)
{
	MUST(!arena->sealed);
	MUST(count <= SIZE_MAX / (size ? size : 1));
	uintptr_t address = (uintptr_t)arena->base + arena->used;
	size_t padding = (size_t)(-address & (ARENA_ALIGNMENT - 1));
	MUST(count * size <= arena->size - arena->used - padding);
	void *memory = arena->base + arena->used + padding;
	arena->used += padding + count * size;
	memset(memory, 0, count * size);
	return memory;
}

void arena_seal(struct arena *arena)
{
	arena->sealed = true;
}
