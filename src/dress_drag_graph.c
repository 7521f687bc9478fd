/* The graph of a surface drag: the front marches from the grabbed point, and whoever brought it to
 * a particle hands the motion on to it.
 *
 *   pins: sources of distance zero of a march of their own. With r = d_pin / (d_pin + d_grab) a
 *         particle has the share r (2 - r) of the motion: all at the hand, none at a pin, three
 *         quarters half way between. The graph does not grow through cloth near a pin.
 */
#include "dress_drag_private.h"

/* A vertex's share of the triangles' measuring, and what it costs that a front comes to it. */
enum { MEASURE_UNITS = 3, MARCH_UNITS = 7 };

static const float pin_block_m = 0.025f;
static const float pin_block_edges = 1.5f; /* so that no edge of a coarse mesh leaps over a fence */

/* How far every particle is from the nearest pin. Returns how many the front came to; 0: there is
 * no pin. */
static int march_pins(struct drag *drag, const struct pin *pins, int pin_count)
{
	struct drag_scratch *s = drag->scratch;
	const struct garment *garment = drag->cloth->garment;
	bool pinned = false;
	front_begin(&s->front, s->pin_distance_m);
	for (int p = 0; p < pin_count; p++) {
		float weight[3];
		int triangle = -1;
		if (pins[p].used)
			triangle = garment_locate(garment, pins[p].piece, pins[p].point_mm, weight);
		if (triangle < 0)
			continue;
		front_add_source(&s->front, triangle, weight);
		pinned = true;
	}
	return pinned ? front_march(&s->front, NULL, NULL) : 0;
}

static void block_pins(struct drag *drag)
{
	const struct garment *garment = drag->cloth->garment;
	const float *pin_m = drag->scratch->pin_distance_m;
	float block_m = float_max(pin_block_m, pin_block_edges * garment->edge_m);
	for (int v = 0; v < garment->vertex_count; v++)
		drag->scratch->blocked[v] = pin_m[v] >= 0.0f && pin_m[v] < block_m;
}

static void share_motion(struct drag *drag, bool pinned)
{
	const float *pin_m = drag->scratch->pin_distance_m;
	for (int k = 0; k < drag->order_count; k++) {
		int a = drag->order[k];
		bool free = !pinned || pin_m[a] < 0.0f;
		float sum = free ? 0.0f : pin_m[a] + drag->distance_m[a];
		float ratio = sum > 0.0f ? pin_m[a] / sum : 0.0f;
		drag->share[a] = free ? 1.0f : ratio * (2.0f - ratio);
	}
}

long drag_build_graph(struct drag *drag, const struct pin *pins, int pin_count)
{
	struct drag_scratch *s = drag->scratch;
	front_build(&s->front, drag->cloth);
	int count = march_pins(drag, pins, pin_count);
	bool pinned = count > 0;
	drag->pinned = pinned;
	if (pinned)
		block_pins(drag);
	front_begin(&s->front, drag->distance_m);
	front_add_source(&s->front, drag->triangle, drag->weight);
	drag->order_count = front_march(&s->front, drag->order, pinned ? s->blocked : NULL);
	share_motion(drag, pinned);
	return MEASURE_UNITS * (long)drag->cloth->garment->vertex_count +
	       MARCH_UNITS * (long)(count + drag->order_count);
}
