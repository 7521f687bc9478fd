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

static const float unreached_m = 1e9f;
static const float better_m = 1e-6f; /* a way must be this much shorter to be taken */

/* ---- the cloth seen along the body ---- */

/* The way along the body between what lies under two particles: the chord, and what the turn of
 * the normals says that the arc is longer: a/2 / sin(a/2) = 1 + (1 - cos a) / 12. Half the cloth's
 * own length at least, so that a fold over one body point is not free; half as much again at most,
 * where cloth spans a hollow and what lies under it jumps from one side to the other. */
static float way_m(const struct cloth *cloth, int a, int b)
{
	const struct contact *p = &cloth->contact[a], *q = &cloth->contact[b];
	struct v3 cloth_m = v3_sub(cloth->position_m[b], cloth->position_m[a]);
	struct v3 body_m = v3_sub(q->point_m, p->point_m);
	float arc = 1.0f + (1.0f - v3_dot(p->normal, q->normal)) * (1.0f / 12.0f);
	float cloth2 = v3_dot(cloth_m, cloth_m), body2 = v3_dot(body_m, body_m) * arc * arc;
	return sqrtf(float_clamp(body2, 0.25f * cloth2, 2.25f * cloth2));
}

void front_build(struct front *front, const struct cloth *cloth)
{
	int vertices = cloth->garment->vertex_count, triangles = cloth->garment->triangle_count;
	front->cloth = cloth;
	memset(front->first, 0, (size_t)(vertices + 2) * sizeof *front->first);
	for (int t = 0; t < triangles; t++) {
		const int *v = cloth->triangle[t].v;
		bool placed = cloth->placed[v[0]] && cloth->placed[v[1]] && cloth->placed[v[2]];
		for (int k = 0; k < 3; k++) {
			front->first[v[k] + 2] += placed;
			front->way_m[3 * t + k] = placed ? way_m(cloth, v[k], v[(k + 1) % 3])
							 : -1.0f;
		}
	}
	for (int v = 0; v < vertices; v++)
		front->first[v + 2] += front->first[v + 1];
	for (int t = 0; t < triangles; t++)
		for (int k = 0; k < 3 && front->way_m[3 * t] >= 0.0f; k++)
			front->corner[front->first[cloth->triangle[t].v[k] + 1]++] = 4 * t + k;
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
 * fill it: that is a late one as a rule, and no branch of the way down has to be guessed. */
static int heap_pop(struct front *front)
{
	const uint64_t *heap = front->heap;
	int top = (int)(uint32_t)heap[0], at = 0, last = --front->waiting;
	for (int child = 1; child < last; child = 2 * at + 1) {
		child += child + 1 < last && heap[child + 1] < heap[child];
		heap_put(front, at, heap[child]);
		at = child;
	}
	heap_rise(front, at, heap[last]);
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

/* To corner c opposite the edge a-b that the front has passed; lengths ab, bc, ca. In the plane a
 * lies at (0, 0), b at (ab, 0), c above them and the virtual source below. */
static void reach_across(struct front *front, int a, int b, int c, float ab, float bc, float ca)
{
	float from_a = front->distance_m[a], from_b = front->distance_m[b], half = 0.5f / ab;
	float c_x = (ab * ab + ca * ca - bc * bc) * half;
	float source_x = (ab * ab + from_a * from_a - from_b * from_b) * half;
	float c_y2 = ca * ca - c_x * c_x, source_y2 = from_a * from_a - source_x * source_x;
	if (c_y2 > 0.0f && source_y2 >= 0.0f) {
		float source_y = sqrtf(source_y2), x = c_x - source_x, y = sqrtf(c_y2) + source_y;
		float crossing = source_x + x * source_y / y;
		if (crossing >= 0.0f && crossing <= ab) {
			reach(front, c, sqrtf(x * x + y * y), a, b, crossing / ab);
			return;
		}
	}
	if (from_a + ca < from_b + bc)
		reach(front, c, from_a + ca, a, a, 0.0f);
	else
		reach(front, c, from_b + bc, b, b, 0.0f);
}

/* The front has come to a corner: on to the other two of its triangle. */
static void pass(struct front *front, int corner)
{
	static const int after[5] = {0, 1, 2, 0, 1};
	int t = corner >> 2, k = corner & 3, k1 = after[k + 1], k2 = after[k + 2];
	const int *v = front->cloth->triangle[t].v;
	const float *way = &front->way_m[3 * t];
	int a = v[k], b = v[k1], c = v[k2];
	uint8_t state_b = front->state[b], state_c = front->state[c];
	if (state_c == AHEAD && state_b == PASSED)
		reach_across(front, a, b, c, way[k], way[k1], way[k2]);
	else if (state_b == AHEAD && state_c == PASSED)
		reach_across(front, a, c, b, way[k2], way[k1], way[k]);
	else if (state_b == AHEAD && state_c == STOPPED)
		reach(front, b, front->distance_m[a] + way[k], a, a, 0.0f);
	else if (state_c == AHEAD && state_b == STOPPED)
		reach(front, c, front->distance_m[a] + way[k2], a, a, 0.0f);
}

void front_begin(struct front *front, float *distance_m)
{
	int vertices = front->cloth->garment->vertex_count;
	front->distance_m = distance_m;
	front->waiting = 0;
	memset(front->state, AHEAD, (size_t)vertices);
	for (int v = 0; v < vertices; v++)
		distance_m[v] = unreached_m;
}

/* The triangle unrolled: corner 0 at (0, 0), corner 1 at (way, 0). */
void front_add_source(struct front *front, int triangle, const float weight[3])
{
	const int *v = front->cloth->triangle[triangle].v;
	const float *way = &front->way_m[3 * triangle];
	struct v2 corner[3] = {{0.0f, 0.0f}, {way[0], 0.0f}, {0.0f, 0.0f}};
	corner[2].x = (way[0] * way[0] + way[2] * way[2] - way[1] * way[1]) * 0.5f /
		      float_max(way[0], 1e-6f);
	corner[2].y = sqrtf(float_max(way[2] * way[2] - corner[2].x * corner[2].x, 0.0f));
	struct v2 source = {weight[1] * corner[1].x + weight[2] * corner[2].x,
			    weight[2] * corner[2].y};
	for (int k = 0; way[0] >= 0.0f && k < 3; k++)
		reach(front, v[k], v2_distance(source, corner[k]), -1, -1, 0.0f);
}

int front_march(struct front *front, int *order, const uint8_t *blocked)
{
	int count = 0, vertices = front->cloth->garment->vertex_count;
	while (front->waiting > 0) {
		int a = heap_pop(front);
		bool stops = blocked && blocked[a] && front->giver[a].from[0] >= 0;
		front->state[a] = stops ? STOPPED : PASSED;
		if (order)
			order[count] = a;
		count++;
		for (int i = front->first[a]; !stops && i < front->first[a + 1]; i++)
			pass(front, front->corner[i]);
	}
	for (int v = 0; v < vertices; v++)
		if (front->state[v] == AHEAD)
			front->distance_m[v] = -1.0f;
	return count;
}
