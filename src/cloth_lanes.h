/* A thin layer over the compiler's vectors. LANES (1, 4 or 8) is set by the file that includes it.
 *
 * `lanes` holds one number of each of LANES constraints. `rows` holds LANES particles as they lie
 * in memory; turning rows into lanes and back is a transposition. */
#ifndef CLOTH_LANES_H
#define CLOTH_LANES_H

#include "cloth_kernel.h"

#if LANES == 8
#define LANES_TARGET __attribute__((target("avx2")))
#else
#define LANES_TARGET
#endif
/* Loops of a known few rounds, so that their arrays live in registers. */
#ifdef __clang__
#define UNROLL _Pragma("unroll")
#else
#define UNROLL _Pragma("GCC unroll 8")
#endif
#define LANES_INLINE static inline __attribute__((always_inline)) LANES_TARGET

#if LANES > 1 && defined __SSE2__
#include <immintrin.h>
#elif LANES > 1 && defined __aarch64__
#include <arm_neon.h>
#endif

LANES_INLINE struct v3 place_at(const struct place *x, uint32_t at)
{
	const struct place *p = (const struct place *)((const char *)x + at);
	return (struct v3){p->x, p->y, p->z};
}

LANES_INLINE void place_put(struct place *x, uint32_t at, struct v3 p)
{
	*(struct place *)((char *)x + at) = (struct place){p.x, p.y, p.z, 0.0f};
}

#if LANES == 1

typedef float lanes;
typedef struct place row, four;
enum { ROWS = 1, ROW_PLACES = 1 };

LANES_INLINE lanes lanes_all(float value)
{
	return value;
}

LANES_INLINE lanes lanes_load(const float *from)
{
	return *from;
}

LANES_INLINE lanes lanes_sqrt(lanes a)
{
	return sqrtf(a);
}

LANES_INLINE lanes lanes_max(lanes a, lanes b)
{
	return a > b ? a : b;
}

LANES_INLINE lanes lanes_min(lanes a, lanes b)
{
	return a < b ? a : b;
}

LANES_INLINE row row_add(row a, row b)
{
	return (row){a.x + b.x, a.y + b.y, a.z + b.z, a.w + b.w};
}

LANES_INLINE row row_sub(row a, row b)
{
	return (row){a.x - b.x, a.y - b.y, a.z - b.z, a.w - b.w};
}

LANES_INLINE row row_mul(row a, row b)
{
	return (row){a.x * b.x, a.y * b.y, a.z * b.z, a.w * b.w};
}

LANES_INLINE four place_load(const struct place *x, uint32_t at)
{
	return *(const struct place *)((const char *)x + at);
}

LANES_INLINE void place_store(struct place *x, uint32_t at, four a)
{
	*(struct place *)((char *)x + at) = a;
}

LANES_INLINE row row_cut(row r)
{
	return (row){r.x, r.y, r.z, 0.0f};
}

LANES_INLINE void vertices_load(row rows[ROWS], const struct v3 *from)
{
	rows[0] = (row){from->x, from->y, from->z, 0.0f};
}

LANES_INLINE void quiet_load(row rows[ROWS], const struct quiet *from)
{
	rows[0] = (row){from->at_m.x, from->at_m.y, from->at_m.z, from->way2_m2};
}

LANES_INLINE lanes rows_last(const row rows[ROWS])
{
	return rows[0].w;
}

LANES_INLINE void vertices_store(struct v3 *to, const struct place *x, const uint32_t *at)
{
	for (int i = 0; i < BATCH; i++)
		to[i] = place_at(x, at[i]);
}

LANES_INLINE unsigned lanes_below(lanes a, lanes b)
{
	return a < b;
}

LANES_INLINE void rows_to_lanes(const row rows[ROWS], lanes axis[3])
{
	axis[0] = rows[0].x;
	axis[1] = rows[0].y;
	axis[2] = rows[0].z;
}

LANES_INLINE void lanes_to_rows(const lanes axis[3], row rows[ROWS])
{
	rows[0] = (row){axis[0], axis[1], axis[2], 0.0f};
}

#else

typedef float four __attribute__((vector_size(16), may_alias));
typedef float lanes __attribute__((vector_size(4 * LANES), may_alias));
typedef lanes row;
enum { ROWS = 4, ROW_PLACES = LANES / 4 };

LANES_INLINE lanes lanes_all(float value)
{
	return value - (lanes){0.0f};
}

LANES_INLINE lanes lanes_load(const float *from)
{
	return *(const lanes *)from;
}

LANES_INLINE lanes lanes_sqrt(lanes a)
{
#if LANES == 8
	return (lanes)_mm256_sqrt_ps((__m256)a);
#elif defined __SSE2__
	return (lanes)_mm_sqrt_ps((__m128)a);
#elif defined __aarch64__
	return (lanes)vsqrtq_f32((float32x4_t)a);
#else
	for (int i = 0; i < LANES; i++)
		a[i] = sqrtf(a[i]);
	return a;
#endif
}

LANES_INLINE lanes lanes_max(lanes a, lanes b)
{
#if LANES == 8
	return (lanes)_mm256_max_ps((__m256)a, (__m256)b);
#elif defined __SSE2__
	return (lanes)_mm_max_ps((__m128)a, (__m128)b);
#else
	for (int i = 0; i < LANES; i++)
		a[i] = a[i] > b[i] ? a[i] : b[i];
	return a;
#endif
}

LANES_INLINE lanes lanes_min(lanes a, lanes b)
{
#if LANES == 8
	return (lanes)_mm256_min_ps((__m256)a, (__m256)b);
#elif defined __SSE2__
	return (lanes)_mm_min_ps((__m128)a, (__m128)b);
#else
	for (int i = 0; i < LANES; i++)
		a[i] = a[i] < b[i] ? a[i] : b[i];
	return a;
#endif
}

LANES_INLINE row row_add(row a, row b)
{
	return a + b;
}

LANES_INLINE row row_sub(row a, row b)
{
	return a - b;
}

LANES_INLINE row row_mul(row a, row b)
{
	return a * b;
}

LANES_INLINE four place_load(const struct place *x, uint32_t at)
{
	return *(const four *)((const char *)x + at);
}

LANES_INLINE void place_store(struct place *x, uint32_t at, four a)
{
	*(four *)((char *)x + at) = a;
}

/* Four numbers as they lie in the public arrays, on no particular border. */
typedef float loose __attribute__((vector_size(16), aligned(4), may_alias));

/* One after the other: what the last lane carries into the next vertex is written over by it. */
LANES_INLINE void vertices_store(struct v3 *to, const struct place *x, const uint32_t *at)
{
	UNROLL for (int i = 0; i < BATCH - 1; i++) * (loose *)(to + i) = place_load(x, at[i]);
	to[BATCH - 1] = place_at(x, at[BATCH - 1]);
}

/* A vertex with the next one's x after it. */
LANES_INLINE four vertex_load(const struct v3 *from)
{
	return *(const loose *)from;
}

/* The last of a run ends with its own z: what comes next may be another thread's. */
LANES_INLINE four vertex_load_last(const struct v3 *from)
{
	four r = *(const loose *)((const float *)from - 1);
	return __builtin_shufflevector(r, r, 1, 2, 3, 3);
}

LANES_INLINE unsigned lanes_below(lanes a, lanes b)
{
#if LANES == 8
	return (unsigned)_mm256_movemask_ps(_mm256_cmp_ps((__m256)a, (__m256)b, _CMP_LT_OQ));
#elif defined __SSE2__
	return (unsigned)_mm_movemask_ps(_mm_cmplt_ps((__m128)a, (__m128)b));
#else
	unsigned below = 0;
	for (int i = 0; i < LANES; i++)
		below |= (unsigned)(a[i] < b[i]) << i;
	return below;
#endif
}

#endif

#if LANES < 8 /* a row is one place */

LANES_INLINE row row_of(float a, float b)
{
	(void)b;
	return (row){a, a, a, a};
}

LANES_INLINE row row_load(const struct place *x, uint32_t a, uint32_t b)
{
	(void)b;
	return place_load(x, a);
}

LANES_INLINE void row_store(struct place *x, uint32_t a, uint32_t b, row r)
{
	(void)b;
	place_store(x, a, r);
}

LANES_INLINE row row_along(float x, float y, float z)
{
	return (row){x, y, z, 0.0f};
}

LANES_INLINE void rows_load(row rows[ROWS], const struct place *x, const uint32_t *at)
{
	UNROLL for (int i = 0; i < ROWS; i++) rows[i] = place_load(x, at[i]);
}

LANES_INLINE void rows_store(const row rows[ROWS], struct place *x, const uint32_t *at)
{
	UNROLL for (int i = 0; i < ROWS; i++) place_store(x, at[i], rows[i]);
}

#endif

#if LANES == 1

LANES_INLINE void rows_splat(row rows[4], const float *a, const float *b)
{
	UNROLL for (int c = 0; c < 4; c++) rows[c] = row_of(a[c], b[c]);
}

#elif LANES == 4

#define SPLAT(r, c) __builtin_shufflevector(r, r, c, c, c, c)

LANES_INLINE row row_cut(row r)
{
	return __builtin_shufflevector(r, lanes_all(0.0f), 0, 1, 2, 4);
}

LANES_INLINE void vertices_load(row rows[ROWS], const struct v3 *from)
{
	UNROLL for (int i = 0; i < ROWS - 1; i++) rows[i] = vertex_load(from + i);
	rows[ROWS - 1] = vertex_load_last(from + ROWS - 1);
}

LANES_INLINE void quiet_load(row rows[ROWS], const struct quiet *from)
{
	UNROLL for (int i = 0; i < ROWS; i++) rows[i] = *(const loose *)(from + i);
}

#define LOW_PAIRS(a, b) __builtin_shufflevector(a, b, 0, 4, 1, 5)
#define HIGH_PAIRS(a, b) __builtin_shufflevector(a, b, 2, 6, 3, 7)
#define LOW_HALVES(a, b) __builtin_shufflevector(a, b, 0, 1, 4, 5)
#define HIGH_HALVES(a, b) __builtin_shufflevector(a, b, 2, 3, 6, 7)
#define WITH_Z(xy, z, i, k) __builtin_shufflevector(xy, z, i, i + 1, k + 4, k + 4)

#else /* two fours side by side: lane i beside lane i + 4 */

#define JOIN(a, b) __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7)

LANES_INLINE row row_of(float a, float b)
{
	return (row){a, a, a, a, b, b, b, b};
}

LANES_INLINE row row_load(const struct place *x, uint32_t a, uint32_t b)
{
	return JOIN(place_load(x, a), place_load(x, b));
}

LANES_INLINE void row_store(struct place *x, uint32_t a, uint32_t b, row r)
{
	place_store(x, a, (four)_mm256_castps256_ps128((__m256)r));
	place_store(x, b, (four)_mm256_extractf128_ps((__m256)r, 1));
}

#define SPLAT(r, c) __builtin_shufflevector(r, r, c, c, c, c, 4 + c, 4 + c, 4 + c, 4 + c)

LANES_INLINE row row_along(float x, float y, float z)
{
	return (row){x, y, z, 0.0f, x, y, z, 0.0f};
}

LANES_INLINE row row_cut(row r)
{
	return __builtin_shufflevector(r, lanes_all(0.0f), 0, 1, 2, 8, 4, 5, 6, 8);
}

LANES_INLINE void vertices_load(row rows[ROWS], const struct v3 *from)
{
	UNROLL for (int i = 0; i < ROWS - 1; i++)
		rows[i] = JOIN(vertex_load(from + i), vertex_load(from + i + 4));
	rows[ROWS - 1] = JOIN(vertex_load(from + 3), vertex_load_last(from + 7));
}

LANES_INLINE void quiet_load(row rows[ROWS], const struct quiet *from)
{
	UNROLL for (int i = 0; i < ROWS; i++)
		rows[i] = JOIN(*(const loose *)(from + i), *(const loose *)(from + i + 4));
}

LANES_INLINE void rows_load(row rows[ROWS], const struct place *x, const uint32_t *at)
{
	UNROLL for (int i = 0; i < ROWS; i++) rows[i] = row_load(x, at[i], at[i + 4]);
}

LANES_INLINE void rows_store(const row rows[ROWS], struct place *x, const uint32_t *at)
{
	UNROLL for (int i = 0; i < ROWS; i++) row_store(x, at[i], at[i + 4], rows[i]);
}

#define LOW_PAIRS(a, b) __builtin_shufflevector(a, b, 0, 8, 1, 9, 4, 12, 5, 13)
#define HIGH_PAIRS(a, b) __builtin_shufflevector(a, b, 2, 10, 3, 11, 6, 14, 7, 15)
#define LOW_HALVES(a, b) __builtin_shufflevector(a, b, 0, 1, 8, 9, 4, 5, 12, 13)
#define HIGH_HALVES(a, b) __builtin_shufflevector(a, b, 2, 3, 10, 11, 6, 7, 14, 15)
#define WITH_Z(xy, z, i, k)                                                                        \
	__builtin_shufflevector(xy, z, i, i + 1, k + 8, k + 8, i + 4, i + 5, k + 12, k + 12)

#endif

#if LANES > 1

LANES_INLINE void rows_splat(row rows[4], const float *a, const float *b)
{
	row r = row_load((const struct place *)a, 0, (uint32_t)((const char *)b - (const char *)a));
	rows[0] = SPLAT(r, 0);
	rows[1] = SPLAT(r, 1);
	rows[2] = SPLAT(r, 2);
	rows[3] = SPLAT(r, 3);
}

LANES_INLINE void rows_to_lanes(const row rows[ROWS], lanes axis[3])
{
	lanes xy_01 = LOW_PAIRS(rows[0], rows[1]), xy_23 = LOW_PAIRS(rows[2], rows[3]);
	lanes z_01 = HIGH_PAIRS(rows[0], rows[1]), z_23 = HIGH_PAIRS(rows[2], rows[3]);
	axis[0] = LOW_HALVES(xy_01, xy_23);
	axis[1] = HIGH_HALVES(xy_01, xy_23);
	axis[2] = LOW_HALVES(z_01, z_23);
}

/* The last of every place. */
LANES_INLINE lanes rows_last(const row rows[ROWS])
{
	return HIGH_HALVES(HIGH_PAIRS(rows[0], rows[1]), HIGH_PAIRS(rows[2], rows[3]));
}

LANES_INLINE void lanes_to_rows(const lanes axis[3], row rows[ROWS])
{
	lanes xy_01 = LOW_PAIRS(axis[0], axis[1]), xy_23 = HIGH_PAIRS(axis[0], axis[1]);
	rows[0] = WITH_Z(xy_01, axis[2], 0, 0);
	rows[1] = WITH_Z(xy_01, axis[2], 2, 1);
	rows[2] = WITH_Z(xy_23, axis[2], 0, 2);
	rows[3] = WITH_Z(xy_23, axis[2], 2, 3);
}

#endif

#endif
