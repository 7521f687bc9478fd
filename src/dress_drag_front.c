/* Distance over the cloth, measured along the BODY's surface, and who hands the motion on: a front
 * that marches from triangle to triangle.
 *
 * A triangle of the cloth is taken as long as the ways between the body points under its corners,
 * so that wrinkles don't count. Once the front has passed two corners, the third is as far as from
 * a virtual source, the point in the triangle's plane that is right for both (Novotni and Klein
 * 2002; Melvaer and Reimers 2012, "Geodesic polar coordinates on polygonal meshes"). On a surface
 * that can be unrolled this is exact, which the sum of edges that Dijkstra takes never is. Where
 * the straight way leaves the triangle sideways the way along its edge counts.
 */
#include "dress_drag_private.h"
#include "lanes.h"

static const float unreached_m = 1e9f;
static const float better_m = 1e-6f; /* a way must be this much shorter to be taken */

/* ---- the cloth seen along the body ---- */

/* x + y + z of the products of three rows with others. */
static lanes dots(const lanes a[3], const lanes b[3])
{
	lanes p = a[0] * b[0], q = a[1] * b[1], r = a[2] * b[2];
	lanes low = LANES_LOW(p, q), high = LANES_HIGH(p, q); /* x x y y; z z */
	return LANES_JOIN(low, r, 0, 1, 4) + LANES_JOIN(low, r, 2, 3, 5) +
	       LANES_JOIN(high, r, 0, 1, 6);
}

/* From every corner to the next. */
static void to_next(lanes way[3], const lanes at[3])
{
	for (int k = 0; k < 3; k++)
		way[k] = at[k == 2 ? 0 : k + 1] - at[k];
}

static lanes row_of(struct v3 a)
{
	return (lanes){a.x, a.y, a.z};
}

/* The ways along the body between what lies under a triangle's corners, squared: the chord, and
 * what the turn of the normals says that the arc is longer: a/2 / sin(a/2) = 1 + (1 - cos a) / 12.
 * Half the cloth's own length at least, so that a fold over one body point is not free; half as
 * much again at most, where cloth spans a hollow and what lies under it jumps from one side to the
 * other. */
static lanes ways2(const struct cloth *cloth, const int *v)
{
	lanes place[3], under[3], normal[4], cloth_m[3], body_m[3];
	for (int k = 0; k < 3; k++) {
		place[k] = row_of(cloth->position_m[v[k]]);
		under[k] = row_of(cloth->contact[v[k]].point_m);
		normal[k] = row_of(cloth->contact[v[k]].normal);
	}
	normal[3] = normal[0];
	to_next(cloth_m, place);
	to_next(body_m, under);
	lanes one = lanes_of(1.0f);
	lanes arc = one + (one - dots(normal, normal + 1)) * lanes_of(1.0f / 12.0f);
	lanes cloth2 = dots(cloth_m, cloth_m), body2 = dots(body_m, body_m) * arc * arc;
	lanes least = lanes_of(0.25f) * cloth2, most = lanes_of(2.25f) * cloth2;
	return lanes_min(lanes_max(body2, least), most);
}

void front_build(struct front *front, const struct cloth *cloth)
{
	front->cloth = cloth;
	for (int t = 0; t < cloth->garment->triangle_count; t++) {
		lanes way2 = ways2(cloth, cloth->triangle[t].v);
		memcpy(&front->way2_m2[4 * t], &way2, sizeof way2);
	}
}

/* ---- particles that wait, the nearest on top ---- */

/* A distance's bits above a particle's number: of floats that are not negative the bits are ordered
 * as they are, and ties go to the lower particle. */
static uint64_t key_of(float distance_m, int particle)
{
	uint32_t bits;
	memcpy(&bits, &distance_m, sizeof bits);
	return (uint64_t)bits << 32 | (uint32_t)particle;
}

static void heap_put(struct front *front, int at, uint64_t key)
{
	front->heap[at] = key;
	front->place[(uint32_t)key] = at;
}

static void heap_rise(struct front *front, int at, uint64_t key)
{
	for (; at > 0 && key < front->heap[(at - 1) / 2]; at = (at - 1) / 2)
		heap_put(front, at, front->heap[(at - 1) / 2]);
	heap_put(front, at, key);
}

/* The hole goes down to the bottom by the lesser children, without a look at the key that is to
 * fill it: that is a late one as a rule, and no branch of the way down has to be guessed. Behind
 * the last key stands one that is less than none. */
static int heap_pop(struct front *front)
{
	uint64_t *heap = front->heap;
	int top = (int)(uint32_t)heap[0], at = 0, last = --front->waiting;
	uint64_t key = heap[last];
	heap[last] = UINT64_MAX;
	for (int child = 1; child < last; child = 2 * at + 1) {
		child += heap[child + 1] < heap[child];
		heap_put(front, at, heap[child]);
		at = child;
	}
	heap_rise(front, at, key);
	return top;
}

/* ---- the march ---- */

/* A shorter way to a particle, handed on by `a` and by `b`'s share. */
static void reach(struct front *front, int particle, float distance_m, int a, int b, float share_b)
{
	if (!(distance_m < front->distance_m[particle] - better_m))
		return;
	int at = front->distance_m[particle] < unreached_m ? front->place[particle]
							   : front->waiting++;
	front->distance_m[particle] = distance_m;
	front->giver[particle] = (struct giver){{a, b}, share_b};
	heap_rise(front, at, key_of(distance_m, particle));
}

/* To corner c opposite the edge a-b that the front has passed, over the place of the edge that the
 * straight way crosses, or over the end that is next to it; squares of ab, bc, ca. In the plane a
 * lies at (0, 0), b at (ab, 0), c above them and the virtual source below, all ab times as large.
 */
static void reach_across(struct front *front, int a, int b, int c, float ab2, float bc2, float ca2)
{
	float from_a = front->distance_m[a], from_b = front->distance_m[b];
	float from_a2 = from_a * from_a, from_b2 = from_b * from_b, ab = sqrtf(ab2);
	float c_x = 0.5f * (ab2 + ca2 - bc2), source_x = 0.5f * (ab2 + from_a2 - from_b2);
	float c_y2 = ca2 * ab2 - c_x * c_x, source_y2 = from_a2 * ab2 - source_x * source_x;
	if (!(c_y2 > 0.0f && source_y2 >= 0.0f)) {
		float by_a = from_a + sqrtf(ca2), by_b = from_b + sqrtf(bc2);
		int by = by_a < by_b ? a : b;
		reach(front, c, float_min(by_a, by_b), by, by, 0.0f);
		return;
	}
	float source_y = sqrtf(source_y2), y = sqrtf(c_y2) + source_y;
	float crossing = source_x + (c_x - source_x) * source_y / y;
	crossing = float_max(float_min(crossing, ab2), 0.0f);
	float to = crossing - source_x, on = c_x - crossing;
	float length = sqrtf(to * to + source_y2) + sqrtf(on * on + c_y2);
	reach(front, c, length / ab, a, b, crossing / ab2);
}

/* The front has come to particle a: in each of its triangles on to that of the other two which is
 * ahead, across the edge to the third if the front has passed that. Which one is ahead is a coin's
 * throw, so that is no branch. */
static void pass(struct front *front, int a)
{
	static const int after[5] = {0, 1, 2, 0, 1};
	const struct cloth *cloth = front->cloth;
	for (int i = cloth->star_first[a]; i < cloth->star_first[a + 1]; i++) {
		const int *other = &cloth->ring[2 * i];
		int state = front->state[other[0]], both = state | front->state[other[1]];
		if (both != (AHEAD | PASSED) && both != (AHEAD | STOPPED))
			continue;
		int k = cloth->star[i] & 3, next = state == AHEAD; /* the next corner is ahead */
		const float *way2 = &front->way2_m2[cloth->star[i] - k];
		int b = other[next], c = other[1 - next];
		float ab2 = way2[after[k + 2 * next]], ca2 = way2[after[k + 2 - 2 * next]];
		if (both == (AHEAD | PASSED))
			reach_across(front, a, b, c, ab2, way2[after[k + 1]], ca2);
		else
			reach(front, c, front->distance_m[a] + sqrtf(ca2), a, a, 0.0f);
	}
}

void front_begin(struct front *front, float *distance_m)
{
	const struct cloth *cloth = front->cloth;
	front->distance_m = distance_m;
	front->waiting = 0;
	for (int v = 0; v < cloth->garment->vertex_count; v++) {
		front->state[v] = cloth->placed[v] ? AHEAD : NO_CLOTH;
		distance_m[v] = unreached_m;
	}
}

/* The triangle unrolled: corner 0 at (0, 0), corner 1 at (way, 0). */
void front_add_source(struct front *front, int triangle, const float weight[3])
{
	const int *v = front->cloth->triangle[triangle].v;
	const float *way2 = &front->way2_m2[4 * triangle];
	float way = sqrtf(way2[0]);
	struct v2 corner[3] = {{0.0f, 0.0f}, {way, 0.0f}, {0.0f, 0.0f}};
	if ((front->state[v[0]] | front->state[v[1]] | front->state[v[2]]) & NO_CLOTH)
		return;
	corner[2].x = (way2[0] + way2[2] - way2[1]) * 0.5f / float_max(way, 1e-6f);
	corner[2].y = sqrtf(float_max(way2[2] - corner[2].x * corner[2].x, 0.0f));
	struct v2 source = {weight[1] * corner[1].x + weight[2] * corner[2].x,
			    weight[2] * corner[2].y};
	for (int k = 0; k < 3; k++)
		reach(front, v[k], v2_distance(source, corner[k]), -1, -1, 0.0f);
}

int front_march(struct front *front, int *order, const uint8_t *blocked)
{
	const struct cloth *cloth = front->cloth;
	int count = 0;
	while (front->waiting > 0) {
		int a = heap_pop(front);
		bool stops = blocked && blocked[a] && front->giver[a].from[0] >= 0;
		front->state[a] = stops ? STOPPED : PASSED;
		if (order)
			order[count] = a;
		count++;
		if (!stops)
			pass(front, a);
	}
	for (int v = 0; v < cloth->garment->vertex_count; v++)
		if (front->state[v] & (AHEAD | NO_CLOTH))
			front->distance_m[v] = -1.0f;
	return count;
}
