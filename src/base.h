/* What every file may rely on: assertions that stay on, counting, clamping, the state hash. */
#ifndef BASE_H
#define BASE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* A broken promise of our own stops the machine in every configuration: an unattended station is
 * better restarted than wrong. The program that links src/ supplies must_fail; it never returns. */
_Noreturn void must_fail(const char *condition, const char *file, int line);
#define MUST(condition) ((condition) ? (void)0 : must_fail(#condition, __FILE__, __LINE__))

#define COUNT_OF(array) ((int)(sizeof(array) / sizeof((array)[0])))

static inline int int_min(int a, int b)
{
	return a < b ? a : b;
}

static inline int int_max(int a, int b)
{
	return a > b ? a : b;
}

static inline int int_clamp(int value, int low, int high)
{
	return value < low ? low : value > high ? high : value;
}

static inline float float_min(float a, float b)
{
	return a < b ? a : b;
}

static inline float float_max(float a, float b)
{
	return a > b ? a : b;
}

static inline float float_clamp(float value, float low, float high)
{
	return value < low ? low : value > high ? high : value;
}

static inline float float_abs(float value)
{
	return value < 0.0f ? -value : value;
}

/* FNV-1a, 64 bit. Hash fields, never padded structs; floats by their bits with -0 taken as 0. */
struct hash {
	uint64_t value;
};

static inline void hash_init(struct hash *hash)
{
	hash->value = 14695981039346656037u;
}

static inline void hash_u32(struct hash *hash, uint32_t word)
{
	for (int i = 0; i < 4; i++) {
		hash->value ^= (word >> (8 * i)) & 0xffu;
		hash->value *= 1099511628211u;
	}
}

static inline void hash_int(struct hash *hash, int value)
{
	hash_u32(hash, (uint32_t)value);
}

static inline void hash_float(struct hash *hash, float value)
{
	uint32_t bits;
	value = value == 0.0f ? 0.0f : value;
	memcpy(&bits, &value, sizeof bits);
	hash_u32(hash, bits);
}

/* A small generator for places that need scatter (orders, samples). Seeded by constants only. */
struct scatter {
	uint32_t state; /* never 0 */
};

static inline uint32_t scatter_next(struct scatter *scatter)
{
	uint32_t x = scatter->state;
	x ^= x << 13;
	x ^= x >> 17;
	x ^= x << 5;
	return scatter->state = x;
}

static inline int scatter_below(struct scatter *scatter, int bound)
{
	return (int)((uint64_t)scatter_next(scatter) * (uint32_t)bound >> 32);
}

#endif
