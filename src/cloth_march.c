/* Ways through the cloth from one particle, nearest first.
 *
 * Fast marching with unfolding: the distance of a corner beyond an edge whose ends are known is
 * that of the edge's unfolded source, which is exact on flat cloth and over seams (Reimers 2004).
 */
#include "cloth_private.h"
#include "cloth_widen.h"

/* ---- once for a mesh ---- */

/* What an edge p-r of a triangle, `along`, is to its third corner, which lies from p as `to`. */
static struct aside aside_of(struct v2 to, struct v2 along)
{
	float length = v2_length(along);
	struct aside aside = {v2_length(to), 0.0f, 0.0f};
	if (length < 1e-7f)
		return aside;
	along = v2_scale(along, 1.0f / length);
	aside.x = v2_dot(to, along);
	aside.y = float_abs(v2_cross(along, to));
	return aside;
}

void march_build(struct cloth *cloth)
{
	const struct garment *garment = cloth->garment;
	struct cloth_scratch *s = cloth->scratch;
	for (int i = 0; i < 3 * garment->triangle_count; i++) {
		int t = cloth->star[i] >> 2, k = cloth->star[i] & 3;
		const int *v = garment->triangle[t].v;
		struct v2 at = garment->rest_m[v[k]];
		struct v2 next = v2_sub(garment->rest_m[v[(k + 1) % 3]], at),
			  last = v2_sub(garment->rest_m[v[(k + 2) % 3]], at);
		next = cloth_widened(cloth, t, next);
		last = cloth_widened(cloth, t, last);
		s->aside[2 * i] = aside_of(next, last);
		s->aside[2 * i + 1] = aside_of(last, next);
	}
}

/* ---- particles that wait, the nearest on top ---- */

/* A way's bits above a particle's number: of floats that are not negative the bits are ordered as
 * they are, and ties go to the lower particle. */
static uint64_t key_of(float way_m, int particle)
{
	uint32_t bits;
	memcpy(&bits, &way_m, sizeof bits);
	return (uint64_t)bits << 32 | (uint32_t)particle;
}

static void put(struct cloth_scratch *s, int at, uint64_t key)
{
	s->heap[at] = key;
	s->heap_at[(uint32_t)key] = at;
}

static void rise(struct cloth_scratch *s, int at, uint64_t key)
{
	for (; at > 0 && key < s->heap[(at - 1) / 2]; at = (at - 1) / 2)
		put(s, at, s->heap[(at - 1) / 2]);
	put(s, at, key);
}

static int pop(struct march *march)
{
	struct cloth_scratch *s = march->cloth->scratch;
	uint64_t key = s->heap[--march->waiting];
	int top = (int)(uint32_t)s->heap[0], at = 0;
	for (int child = 1; child < march->waiting; child = 2 * at + 1) {
		child += child + 1 < march->waiting && s->heap[child + 1] < s->heap[child];
		if (s->heap[child] > key)
			break;
		put(s, at, s->heap[child]);
		at = child;
	}
	if (march->waiting > 0)
		put(s, at, key);
	return top;
}

/* ---- the march ----
 *
 * s->way_of says 2 * way_now of a particle that waits, 1 more of one whose way is known. */

static void offer(struct march *march, int v, float way_m)
{
	struct cloth_scratch *s = march->cloth->scratch;
	int waits = 2 * s->way_now;
	if (way_m >= (s->way_of[v] == waits ? s->way_m[v] : march->limit_m))
		return;
	if (s->way_of[v] != waits)
		s->heap_at[v] = march->waiting++;
	s->way_of[v] = waits;
	s->way_m[v] = way_m;
	rise(s, s->heap_at[v], key_of(way_m, v));
}

/* The way to q past the edge p-r of a flat triangle, from a source that is `at_p` from p and `at_r`
 * from r; beyond the limit where the straight line does not cross the edge. */
static float unfolded_way(float length, const struct aside *q, float at_p, float at_r)
{
	float none = 1e9f;
	if (length < 1e-7f)
		return none;
	float sx = (at_p * at_p - at_r * at_r + length * length) / (2.0f * length);
	float sy = sqrtf(float_max(at_p * at_p - sx * sx, 0.0f));
	float crossing = sx + (q->x - sx) * sy / float_max(sy + q->y, 1e-9f);
	if (crossing < 0.0f || crossing > length)
		return none;
	return sqrtf((q->x - sx) * (q->x - sx) + (q->y + sy) * (q->y + sy));
}

/* Particle p's way is known: its neighbours are offered theirs. */
static void pass_on(struct march *march, int p)
{
	const struct cloth *cloth = march->cloth;
	const struct cloth_scratch *s = cloth->scratch;
	const int *ring = cloth->ring, *way_of = s->way_of;
	const struct aside *aside = s->aside;
	int first = 2 * cloth->star_first[p], end = 2 * cloth->star_first[p + 1];
	int known = 2 * s->way_now + 1;
	float at_p = s->way_m[p];
	for (int i = first; i < end; i++) {
		int q = ring[i], r = ring[i ^ 1];
		if (way_of[q] == known)
			continue;
		float way_m = at_p + aside[i].length_m;
		if (way_of[r] == known)
			way_m = float_min(way_m, unfolded_way(aside[i ^ 1].length_m, &aside[i],
							      at_p, s->way_m[r]));
		offer(march, q, way_m);
	}
}

void march_begin(struct march *march, struct cloth *cloth, int from, float limit_m)
{
	*march = (struct march){cloth, limit_m, 0};
	cloth->scratch->way_now++;
	offer(march, from, 0.0f);
}

int march_next(struct march *march, float *way_m)
{
	struct cloth_scratch *s = march->cloth->scratch;
	if (march->waiting == 0)
		return -1;
	int v = pop(march);
	s->way_of[v] = 2 * s->way_now + 1;
	*way_m = s->way_m[v];
	pass_on(march, v);
	return v;
}
