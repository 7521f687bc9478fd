/* A garment that is too narrow for the body would fight it for ever: it rides up to where the body
 * is thinner and rolls. A tailor lets it out. Here each piece that the body stretches as a whole is
 * widened at rest, in the one direction in which it is stretched and by a share that changes along
 * it as the girths of the body do. Strain is measured on the cloth as cut all the same
 * (measure_strain.c), and the report says `too_small`. */
#include "cloth_widen.h"
#include "cloth_private.h"

static const float worth = 0.08f;  /* mean stretch of a piece that is let out */
static const float spread = 0.05f; /* ... and all over: cloth that is caught somewhere is drawn out
				      there alone, */
static const float caught = 0.2f;  /* where no more than this counts */
static const float kept = 0.05f;   /* what stays as stretch: cloth that just grew round a body is
				      drawn out by as much for a while */

/* A symmetric map of the flat cloth, and the area that it stands for. */
struct mean {
	float xx, xy, yy, area_m2;
};

/* Stretches of triangle t less the identity: the root of F^T F, where F takes the flat cloth as cut
 * to space. Closed form of the 2 x 2 root: (C + det F) / sqrt(trace C + 2 det F). */
static struct mean stretched(const struct cloth *cloth, int t)
{
	const int *flat = cloth->garment->triangle[t].v, *v = cloth->triangle[t].v;
	const struct v2 *rest_m = cloth->garment->rest_m;
	const struct v3 *x = cloth->position_m;
	struct v2 u = v2_sub(rest_m[flat[1]], rest_m[flat[0]]),
		  w = v2_sub(rest_m[flat[2]], rest_m[flat[0]]);
	float det = float_max(v2_cross(u, w), 1e-10f);
	struct v3 p = v3_sub(x[v[1]], x[v[0]]), q = v3_sub(x[v[2]], x[v[0]]);
	struct v3 f_x = v3_scale(v3_sub(v3_scale(p, w.y), v3_scale(q, u.y)), 1.0f / det);
	struct v3 f_y = v3_scale(v3_sub(v3_scale(q, u.x), v3_scale(p, w.x)), 1.0f / det);
	float xx = v3_dot(f_x, f_x), xy = v3_dot(f_x, f_y), yy = v3_dot(f_y, f_y);
	float area = sqrtf(float_max(xx * yy - xy * xy, 0.0f));
	float root = sqrtf(float_max(xx + yy + 2.0f * area, 1e-10f));
	return (struct mean){(xx + area) / root - 1.0f, xy / root, (yy + area) / root - 1.0f, det};
}

static void add(struct mean *mean, struct mean more)
{
	mean->xx += more.xx * more.area_m2;
	mean->xy += more.xy * more.area_m2;
	mean->yy += more.yy * more.area_m2;
	mean->area_m2 += more.area_m2;
}

/* The share of the map along a direction. */
static float along(const struct mean *mean, struct v2 e)
{
	return e.x * e.x * mean->xx + 2.0f * e.x * e.y * mean->xy + e.y * e.y * mean->yy;
}

/* The larger principal value of the mean, and its direction. */
static float principal(const struct mean *mean, struct v2 *direction)
{
	float middle = 0.5f * (mean->xx + mean->yy), half = 0.5f * (mean->xx - mean->yy);
	float root = sqrtf(half * half + mean->xy * mean->xy);
	struct v2 way = half > 0.0f ? (struct v2){half + root, mean->xy}
				    : (struct v2){mean->xy, root - half};
	float length = v2_length(way);
	*direction = length > 0.0f ? v2_scale(way, 1.0f / length) : (struct v2){1.0f, 0.0f};
	return (middle + root) / float_max(mean->area_m2, 1e-10f);
}

/* Where a place of the flat piece lies among the knots: *share from the i-th to the next. */
static int knot_at(const struct widening *wide, struct v2 p_m, float *share)
{
	float off_m = wide->across.x * p_m.y - wide->across.y * p_m.x - wide->from_m;
	float at = float_clamp(off_m / wide->step_m, 0.0f, (float)(WIDE_KNOTS - 1));
	int i = int_min((int)at, WIDE_KNOTS - 2);
	*share = at - (float)i;
	return i;
}

static float more_at(const struct widening *wide, struct v2 p_m)
{
	float share;
	int i = knot_at(wide, p_m, &share);
	return wide->more[i] + share * (wide->more[i + 1] - wide->more[i]);
}

/* Spreads the knots over the piece, from one end to the other. */
static void place_knots(const struct garment *garment, int piece, struct widening *wide)
{
	float low_m = 1e9f, high_m = -1e9f;
	for (int v = 0; v < garment->vertex_count; v++) {
		struct v2 p = garment->rest_m[v];
		float off_m = wide->across.x * p.y - wide->across.y * p.x;
		if (garment->piece[v] != piece)
			continue;
		low_m = float_min(low_m, off_m);
		high_m = float_max(high_m, off_m);
	}
	wide->from_m = low_m;
	wide->step_m = float_max(high_m - low_m, 1e-4f) / (float)(WIDE_KNOTS - 1);
}

/* What the piece is stretched by at each knot beyond what is kept: a mean over the triangles from
 * the knot before to the one after. */
static void widen(const struct cloth *cloth, int piece, struct widening *wide)
{
	const struct garment *garment = cloth->garment;
	float sum[WIDE_KNOTS] = {0.0f}, area[WIDE_KNOTS] = {0.0f};
	place_knots(garment, piece, wide);
	for (int t = 0; t < garment->triangle_count; t++) {
		const int *v = garment->triangle[t].v;
		if (garment->piece[v[0]] != piece || !triangle_placed(cloth, t))
			continue;
		struct mean mean = stretched(cloth, t);
		struct v2 sides = v2_add(garment->rest_m[v[0]],
					 v2_add(garment->rest_m[v[1]], garment->rest_m[v[2]]));
		float share, more = along(&mean, wide->across);
		int i = knot_at(wide, v2_scale(sides, 1.0f / 3.0f), &share);
		sum[i] += (1.0f - share) * mean.area_m2 * more;
		area[i] += (1.0f - share) * mean.area_m2;
		sum[i + 1] += share * mean.area_m2 * more;
		area[i + 1] += share * mean.area_m2;
	}
	for (int i = 0; i < WIDE_KNOTS; i++)
		wide->more[i] = float_max(sum[i] / float_max(area[i], 1e-10f) - kept, 0.0f);
}

/* Of each piece, and the one that is stretched most; -1: none is so much that it is worth it. */
static int mean_stretches(const struct cloth *cloth, struct mean mean[PIECES_MAX])
{
	float most = worth;
	int found = -1;
	memset(mean, 0, PIECES_MAX * sizeof *mean);
	for (int t = 0; t < cloth->garment->triangle_count; t++)
		if (triangle_placed(cloth, t))
			add(&mean[cloth->garment->triangle_piece[t]], stretched(cloth, t));
	for (int p = 0; p < PIECES_MAX; p++) {
		struct v2 across;
		float more = principal(&mean[p], &across);
		if (more < most)
			continue;
		most = more;
		found = p;
	}
	return found;
}

/* How far a piece is stretched along a direction, if no place counts for more than `caught`. */
static float spread_stretch(const struct cloth *cloth, int piece, struct v2 e)
{
	float sum = 0.0f, area_m2 = 0.0f;
	for (int t = 0; t < cloth->garment->triangle_count; t++) {
		if (cloth->garment->triangle_piece[t] != piece || !triangle_placed(cloth, t))
			continue;
		struct mean mean = stretched(cloth, t);
		sum += mean.area_m2 * float_clamp(along(&mean, e), -caught, caught);
		area_m2 += mean.area_m2;
	}
	return sum / float_max(area_m2, 1e-10f);
}

int cloth_narrow_piece(const struct cloth *cloth)
{
	struct mean mean[PIECES_MAX];
	struct v2 across;
	int piece = mean_stretches(cloth, mean);
	if (piece < 0)
		return -1;
	principal(&mean[piece], &across);
	return spread_stretch(cloth, piece, across) > spread ? piece : -1;
}

void cloth_let_out(struct cloth *cloth)
{
	struct mean mean[PIECES_MAX];
	mean_stretches(cloth, mean);
	for (int p = 0; p < PIECES_MAX; p++) {
		struct widening wide = {.step_m = 0.0f};
		if (principal(&mean[p], &wide.across) >= worth)
			widen(cloth, p, &wide);
		cloth->piece_wide[p] = wide;
	}
	cloth_build_begin(cloth);
}

struct v2 cloth_widened(const struct cloth *cloth, int t, struct v2 way)
{
	const struct garment *garment = cloth->garment;
	const struct widening *wide = &cloth->piece_wide[garment->triangle_piece[t]];
	const int *v = garment->triangle[t].v;
	float more = 0.0f;
	if (wide->step_m == 0.0f)
		return way;
	for (int k = 0; k < 3; k++)
		more += more_at(wide, garment->rest_m[v[k]]) / 3.0f;
	return v2_add(way, v2_scale(wide->across, more * v2_dot(way, wide->across)));
}
