/* A drape from elsewhere as the start of a wrap: smoothed where it is crumpled, brought to size,
 * turned right side out, moved out of the body as a whole, then patch by patch. What is left is the
 * sweeps' affair. */
#include "dress_private.h"

enum { MOVE_ROUNDS = 8, SMOOTH_ROUNDS = 12, CRUMPLE_ROUNDS = 16 };

static const float unit_ratio = 3.0f;    /* beyond it is the unit of length that is wrong */
static const float size_ratio = 1.12f;   /* less is stretch, which relaxing takes out */
static const float wild_ratio = 1.6f;    /* an edge so much longer or shorter than the others */
static const float wild_share = 0.1f;    /* with so many of them the drape is crumpled */
static const float look_m = 0.15f;       /* a surface so far along a normal is the cloth's own */
static const float facing_m = 0.08f;     /* so near the body it is known which way cloth faces */
static const float deep_m = 0.01f;       /* this deep a vertex is not just touching */
static const float deep_share = 0.03f;   /* with so many of them the whole drape is moved */
static const float loose_weight = 0.02f; /* of cloth outside against cloth inside, while it is */

static struct v3 triangle_normal(const struct cloth *cloth, int t)
{
	const int *v = cloth->garment->triangle[t].v;
	const struct v3 *x = cloth->position_m;
	return v3_cross(v3_sub(x[v[1]], x[v[0]]), v3_sub(x[v[2]], x[v[0]]));
}

static struct v3 centre_of(const struct cloth *cloth, int t)
{
	const int *v = cloth->garment->triangle[t].v;
	const struct v3 *x = cloth->position_m;
	return v3_scale(v3_add(v3_add(x[v[0]], x[v[1]]), x[v[2]]), 1.0f / 3.0f);
}

/* ---- size ---- */

/* How much longer the edges are than on the flat pieces, in the mean. */
static float size_of(const struct cloth *cloth)
{
	const struct garment *garment = cloth->garment;
	float worn = 0.0f, flat = 0.0f;
	for (int e = 0; e < 3 * garment->triangle_count; e++) {
		const int *v = garment->triangle[e / 3].v;
		int a = v[e % 3], b = v[(e % 3 + 1) % 3];
		worn += v3_distance(cloth->position_m[a], cloth->position_m[b]);
		flat += v2_distance(garment->rest_m[a], garment->rest_m[b]);
	}
	return worn / float_max(flat, 1e-6f);
}

static struct v3 mean_place(const struct cloth *cloth)
{
	struct v3 sum = {0.0f, 0.0f, 0.0f};
	float share = 1.0f / (float)cloth->garment->vertex_count;
	for (int v = 0; v < cloth->garment->vertex_count; v++)
		sum = v3_mad(sum, cloth->position_m[v], share);
	return sum;
}

/* Edges much longer or shorter than the others, against the flat pieces: a tangle, no drape. */
static bool is_crumpled(const struct cloth *cloth)
{
	const struct garment *garment = cloth->garment;
	float ratio = size_of(cloth);
	int wild = 0;
	for (int e = 0; e < 3 * garment->triangle_count; e++) {
		const int *v = garment->triangle[e / 3].v;
		int a = v[e % 3], b = v[(e % 3 + 1) % 3];
		float worn = v3_distance(cloth->position_m[a], cloth->position_m[b]);
		float flat = ratio * v2_distance(garment->rest_m[a], garment->rest_m[b]);
		wild += worn > wild_ratio * flat || flat > wild_ratio * worn;
	}
	return (float)wild > wild_share * 3.0f * (float)garment->triangle_count;
}

/* Every sewn vertex goes to the mean of its ring and itself. */
static void smooth_cloth(struct wrap *wrap)
{
	struct cloth *cloth = wrap->cloth;
	const struct garment *garment = cloth->garment;
	struct v3 *sum = wrap->scratch->sum_m;
	int *count = wrap->scratch->count;
	for (int v = 0; v < garment->vertex_count; v++) {
		sum[v] = (struct v3){0.0f, 0.0f, 0.0f};
		count[v] = 0;
	}
	for (int c = 0; c < 9 * garment->triangle_count; c++) {
		const int *v = garment->triangle[c / 9].v;
		int to = garment->weld[v[c % 3]];
		sum[to] = v3_add(sum[to], cloth->position_m[v[c / 3 % 3]]);
		count[to]++;
	}
	for (int v = 0; v < garment->vertex_count; v++)
		if (count[garment->weld[v]] > 0)
			cloth->position_m[v] = v3_scale(sum[garment->weld[v]],
							1.0f / (float)count[garment->weld[v]]);
}

static void mend_crumples(struct wrap *wrap)
{
	if (!is_crumpled(wrap->cloth))
		return;
	for (int round = 0; round < CRUMPLE_ROUNDS; round++)
		smooth_cloth(wrap);
	wrap_diagnose(wrap, "start-crumpled", 0, 0,
		      "The drape was crumpled; it was smoothed before it was laid.");
}

/* A wrong unit scales about the origin; a wrong size about the garment's own middle. */
static void mend_size(struct wrap *wrap)
{
	struct cloth *cloth = wrap->cloth;
	float ratio = size_of(cloth);
	if (!(ratio > 1e-6f) || (ratio < size_ratio && ratio > 1.0f / size_ratio))
		return;
	bool unit = ratio > unit_ratio || ratio < 1.0f / unit_ratio;
	struct v3 about = unit ? (struct v3){0.0f, 0.0f, 0.0f} : mean_place(cloth);
	for (int v = 0; v < cloth->garment->vertex_count; v++)
		cloth->position_m[v] = v3_mad(about, v3_sub(cloth->position_m[v], about),
					      1.0f / ratio);
	wrap_diagnose(wrap, "start-scaled", 0, 0,
		      unit ? "The drape is not in metres; it was brought to the pattern's size."
			   : "The drape's size is not the pattern's; it was brought to that.");
}

/* ---- sides ---- */

/* Area near the body that faces out, less what faces in. */
static float facing_out(const struct cloth *cloth)
{
	float sum = 0.0f;
	for (int t = 0; t < cloth->garment->triangle_count; t++) {
		struct body_hit hit;
		body_nearest(cloth->body, centre_of(cloth, t), 0, &hit);
		if (float_abs(hit.distance_m) < facing_m)
			sum += v3_dot(triangle_normal(cloth, t), hit.normal);
	}
	return sum;
}

/* A drape that was mirrored faces in; one that was turned inside out has its left on the right. The
 * mirror image is right for both. */
static void mend_sides(struct wrap *wrap)
{
	struct cloth *cloth = wrap->cloth;
	if (facing_out(cloth) >= 0.0f)
		return;
	float twice = cloth->body->low_m.x + cloth->body->high_m.x;
	for (int v = 0; v < cloth->garment->vertex_count; v++)
		cloth->position_m[v].x = twice - cloth->position_m[v].x;
	wrap_diagnose(wrap, "start-mirrored", 0, 0,
		      "The drape was inside out or mirrored; it was mirrored back.");
}

/* ---- out of the body ---- */

/* How far a point has to go along the cloth's outward normal to lie on the body's surface below it;
 * below 0: it is outside. False: there is no surface of the body near along the normal. */
static bool way_out(const struct cloth *cloth, struct v3 p, struct v3 normal, float *way_m)
{
	struct body_hit hit;
	if (!body_ray(cloth->body, v3_mad(p, normal, look_m), v3_scale(normal, -1.0f), &hit) ||
	    hit.distance_m > 2.0f * look_m)
		return false;
	*way_m = look_m - hit.distance_m + cloth->settings.offset_m;
	return true;
}

/* Sums of the least squares that seek a shift s with n.s = way: n n^T (six numbers) and n way. */
struct fit {
	float xx, xy, xz, yy, yz, zz;
	struct v3 right;
};

static void add_to_fit(struct fit *fit, struct v3 n, float way_m, float weight)
{
	fit->xx += weight * n.x * n.x;
	fit->xy += weight * n.x * n.y;
	fit->xz += weight * n.x * n.z;
	fit->yy += weight * n.y * n.y;
	fit->yz += weight * n.y * n.z;
	fit->zz += weight * n.z * n.z;
	fit->right = v3_mad(fit->right, n, weight * way_m);
}

/* Cramer's rule; the small diagonal keeps a shift that nothing asks for at zero. */
static struct v3 solve_fit(const struct fit *fit)
{
	float small = 1e-3f * (fit->xx + fit->yy + fit->zz) + 1e-9f;
	struct v3 a = {fit->xx + small, fit->xy, fit->xz}, b = {fit->xy, fit->yy + small, fit->yz},
		  c = {fit->xz, fit->yz, fit->zz + small}, r = fit->right;
	float det = v3_dot(a, v3_cross(b, c));
	return (struct v3){v3_dot(r, v3_cross(b, c)) / det, v3_dot(a, v3_cross(r, c)) / det,
			   v3_dot(a, v3_cross(b, r)) / det};
}

static float share_inside(const struct cloth *cloth)
{
	int inside = 0;
	for (int v = 0; v < cloth->garment->vertex_count; v++) {
		struct body_hit hit;
		body_nearest(cloth->body, cloth->position_m[v], 0, &hit);
		inside += hit.distance_m < -deep_m;
	}
	return (float)inside / (float)cloth->garment->vertex_count;
}

/* The shift that brings cloth to the surface below it, cloth inside first. */
static struct v3 shift_out(const struct cloth *cloth)
{
	struct fit fit = {0};
	for (int t = 0; t < cloth->garment->triangle_count; t++) {
		struct v3 normal = triangle_normal(cloth, t);
		float area = v3_length(normal), way_m;
		normal = v3_normalize(normal);
		if (way_out(cloth, centre_of(cloth, t), normal, &way_m))
			add_to_fit(&fit, normal, way_m, way_m > 0.0f ? area : loose_weight * area);
	}
	return solve_fit(&fit);
}

static void move_out(struct wrap *wrap)
{
	struct cloth *cloth = wrap->cloth;
	if (share_inside(cloth) < deep_share)
		return;
	for (int round = 0; round < MOVE_ROUNDS; round++) {
		struct v3 shift = shift_out(cloth);
		for (int v = 0; v < cloth->garment->vertex_count; v++)
			cloth->position_m[v] = v3_add(cloth->position_m[v], shift);
	}
	wrap_diagnose(wrap, "start-moved", 0, 0,
		      "Much of the drape lay inside the body; it was moved out as a whole.");
}

/* Each way becomes the mean of its neighbours' among those inside; `inside` counts them. */
static void smooth_ways(const struct garment *garment, struct v3 *way, int *inside, struct v3 *sum)
{
	for (int v = 0; v < garment->vertex_count; v++)
		sum[v] = way[v];
	for (int e = 0; e < 3 * garment->triangle_count; e++) {
		const int *v = garment->triangle[e / 3].v;
		int a = v[e % 3], b = v[(e % 3 + 1) % 3];
		if (inside[a] == 0 || inside[b] == 0)
			continue;
		sum[a] = v3_add(sum[a], way[b]);
		sum[b] = v3_add(sum[b], way[a]);
		inside[a]++;
		inside[b]++;
	}
	for (int v = 0; v < garment->vertex_count; v++) {
		way[v] = v3_scale(sum[v], 1.0f / (float)int_max(inside[v], 1));
		inside[v] = int_min(inside[v], 1);
	}
}

/* What is still inside goes out along its own normals, smoothed over neighbours, so that a patch
 * goes one way: the nearest way would lead some of it out at the back of a limb. */
static void push_patches(struct wrap *wrap)
{
	struct cloth *cloth = wrap->cloth;
	const struct garment *garment = cloth->garment;
	struct v3 *way = wrap->scratch->sum_m, *mean = cloth->goal_m;
	int *inside = wrap->scratch->count;
	cloth_normals(cloth, mean);
	for (int v = 0; v < garment->vertex_count; v++) {
		float way_m = 0.0f;
		struct body_hit hit;
		struct v3 normal = v3_normalize(mean[v]);
		body_nearest(cloth->body, cloth->position_m[v], 0, &hit);
		inside[v] = hit.distance_m < 0.0f &&
			    way_out(cloth, cloth->position_m[v], normal, &way_m);
		way[v] = v3_scale(normal, float_clamp(way_m, 0.0f, look_m));
		if (!inside[v])
			way[v] = (struct v3){0.0f, 0.0f, 0.0f};
	}
	for (int round = 0; round < SMOOTH_ROUNDS; round++)
		smooth_ways(garment, way, inside, mean);
	for (int v = 0; v < garment->vertex_count; v++)
		cloth->position_m[v] = v3_add(cloth->position_m[v], way[v]);
}

void wrap_mend_start(struct wrap *wrap)
{
	struct cloth *cloth = wrap->cloth;
	mend_crumples(wrap);
	mend_size(wrap);
	mend_sides(wrap);
	move_out(wrap);
	push_patches(wrap);
	for (int v = 0; v < cloth->garment->vertex_count; v++) {
		cloth->previous_m[v] = cloth->position_m[v];
		cloth_look(cloth, v);
	}
}
