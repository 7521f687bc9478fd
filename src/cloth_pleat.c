/* Seams whose sides differ much in length: the longer side is pleated, or gathered, onto the
 * shorter. Pleats are finer than the mesh, so the rest shapes of the triangles near the seam are
 * squeezed along it: wholly at the seam, and less and less into the cloth, where the pleats open.
 */
#include "cloth_pleat.h"
#include "cloth_private.h"
#include "cloth_widen.h"

static const float pleated_share =
	0.93f;                     /* of the longer side; above it is ease, which stretches */
static const float open_m = 1e-4f; /* pleats that are worth opening */

/* Lengths of both sides of a seam on the flat cloth. */
static void measure_sides(const struct garment *garment, int first, int end, float length_m[2])
{
	length_m[0] = length_m[1] = 0.0f;
	for (int i = first; i + 1 < end; i++) {
		const struct seam_pair *pair = &garment->pair[i], *next = &garment->pair[i + 1];
		length_m[0] += v2_distance(garment->rest_m[pair->a], garment->rest_m[next->a]);
		length_m[1] += v2_distance(garment->rest_m[pair->b], garment->rest_m[next->b]);
	}
}

/* Refined cloth has the pairs of its base first, seam by seam; what came later lies between them.
 */
static bool of_base(const struct garment *garment, int i)
{
	return i < garment->pair_count &&
	       (garment->base_count == 0 || garment->place[garment->pair[i].a] < 0);
}

bool cloth_pleats(const struct garment *garment, int *at, struct pleats *pleats)
{
	while (of_base(garment, *at)) {
		int first = *at, seam = garment->pair[first].seam;
		float length_m[2];
		while (of_base(garment, *at) && garment->pair[*at].seam == seam)
			(*at)++;
		measure_sides(garment, first, *at, length_m);
		int side = length_m[1] > length_m[0];
		float share = length_m[!side] / float_max(length_m[side], open_m);
		*pleats = (struct pleats){first, *at, side, share,
					  length_m[side] - length_m[!side]};
		if (*at - first > 1 && share < pleated_share && share > 0.0f)
			return true;
	}
	return false;
}

static int on_side(const struct seam_pair *pair, int side)
{
	return side ? pair->b : pair->a;
}

/* The squeeze at a place as near to a pleated stretch a -> b, if it is stronger than what is known.
 * Pleats open as fast as their cloth is wide: the seam's excess away from it they are gone. */
static void squeeze_at(struct squeeze *squeeze, struct v2 p, struct v2 a, struct v2 b,
		       const struct pleats *pleats)
{
	struct v2 way = v2_sub(b, a);
	float length_m = v2_length(way);
	if (length_m < 1e-6f)
		return;
	struct v2 along = v2_scale(way, 1.0f / length_m);
	float at_m = float_clamp(v2_dot(v2_sub(p, a), along), 0.0f, length_m);
	float off_m = v2_distance(p, v2_add(a, v2_scale(along, at_m)));
	float less = (pleats->share - 1.0f) * (1.0f - off_m / pleats->excess_m);
	if (less >= squeeze->xx + squeeze->yy)
		return;
	*squeeze = (struct squeeze){less * along.x * along.x, less * along.x * along.y,
				    less * along.y * along.y};
}

static void squeeze_piece(struct cloth *cloth, const struct pleats *pleats)
{
	const struct garment *garment = cloth->garment;
	const struct v2 *rest_m = garment->rest_m;
	struct v2 low = {1e9f, 1e9f}, high = {-1e9f, -1e9f};
	for (int i = pleats->first; i < pleats->end; i++) {
		struct v2 p = rest_m[on_side(&garment->pair[i], pleats->side)];
		low = (struct v2){float_min(low.x, p.x), float_min(low.y, p.y)};
		high = (struct v2){float_max(high.x, p.x), float_max(high.y, p.y)};
	}
	int piece = garment->piece[on_side(&garment->pair[pleats->first], pleats->side)];
	for (int v = 0; v < garment->vertex_count; v++) {
		struct v2 p = rest_m[v];
		if (garment->piece[v] != piece || p.x < low.x - pleats->excess_m ||
		    p.x > high.x + pleats->excess_m || p.y < low.y - pleats->excess_m ||
		    p.y > high.y + pleats->excess_m)
			continue;
		for (int i = pleats->first; i + 1 < pleats->end; i++)
			squeeze_at(&cloth->scratch->squeeze[v], p,
				   rest_m[on_side(&garment->pair[i], pleats->side)],
				   rest_m[on_side(&garment->pair[i + 1], pleats->side)], pleats);
	}
}

void cloth_build_pleats(struct cloth *cloth)
{
	struct pleats pleats;
	struct squeeze *squeeze = cloth->scratch->squeeze;
	memset(squeeze, 0, (size_t)cloth->garment->vertex_count * sizeof *squeeze);
	for (int at = 0; cloth->welded && cloth_pleats(cloth->garment, &at, &pleats);)
		squeeze_piece(cloth, &pleats);
}

struct v2 cloth_flat_way(const struct cloth *cloth, int t, int from, int to)
{
	const struct squeeze *squeeze = cloth->scratch->squeeze;
	const int *v = cloth->garment->triangle[t].v;
	struct v2 way = v2_sub(cloth_flat_m(cloth, to), cloth_flat_m(cloth, from));
	struct squeeze sum = {0.0f, 0.0f, 0.0f};
	for (int k = 0; k < 3; k++) {
		sum.xx += squeeze[v[k]].xx;
		sum.xy += squeeze[v[k]].xy;
		sum.yy += squeeze[v[k]].yy;
	}
	struct v2 less = {sum.xx * way.x + sum.xy * way.y, sum.xy * way.x + sum.yy * way.y};
	return cloth_widened(cloth, t, v2_add(way, v2_scale(less, 1.0f / 3.0f)));
}
