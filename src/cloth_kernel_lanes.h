/* The kernels' bodies, written once; cloth_kernel_1.c, _4.c and _8.c compile them. */
#include "cloth_lanes.h"

/* A collapsed triangle has no plane; below this determinant of F^T F it counts as a needle, which
 * keeps the closed form finite. */
static const float det_least = 1e-6f;
static const float shear_most = 0.9f; /* of f1 f2, for the same reason */

LANES_INLINE lanes dot(const lanes a[3], const lanes b[3])
{
	return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* M with which the rest shape, turned as the triangle is turned, is E M: E = [e1 e2] the edges, G
 * their dot products.
 *
 * F = E D; its nearest rotation is F S^-1, S = sqrt(F^T F). In closed form, with d = sqrt(det F^T
 * F) and t = sqrt(tr F^T F + 2 d): S = (F^T F + d I) / t, det S = d (Franca 1989). So S^-1 = ((tr
 * F^T F
 * + d) I - F^T F) / (t d), and since D [u1 u2] = I all of D but K = D D^T falls out of M = D S^-1
 * [u1 u2]: with H = K G, tr F^T F = tr H, det F^T F = det H, and M = ((tr H + d) I - H) / (t d). */
LANES_INLINE void shape_matrix(const lanes g[3], const lanes k[3], lanes m[4])
{
	lanes h11 = k[0] * g[0] + k[1] * g[1], h12 = k[0] * g[1] + k[1] * g[2];
	lanes h21 = k[1] * g[0] + k[2] * g[1], h22 = k[1] * g[1] + k[2] * g[2];
	lanes d = lanes_sqrt(lanes_max(h11 * h22 - h12 * h21, lanes_all(det_least)));
	lanes t = lanes_sqrt((h11 + d) + (h22 + d));
	lanes scale = 1.0f / (t * d);
	m[0] = (h22 + d) * scale;
	m[1] = h12 * scale;
	m[2] = h21 * scale;
	m[3] = (h11 + d) * scale;
}

/* What corners 1 and 2 move by, with the centre at rest: corner 0 moves by minus their sum. (The
 * matrix has its mixed terms with the other sign.) */
LANES_INLINE void shape_moves(const lanes e1[3], const lanes e2[3], const lanes m[4], float share,
			      lanes move_1[3], lanes move_2[3])
{
	lanes third = lanes_all(share * (1.0f / 3.0f));
	lanes p11 = (m[0] - 1.0f) * third, p12 = m[1] * third;
	lanes p21 = m[2] * third, p22 = (m[3] - 1.0f) * third;
	lanes c11 = p11 + p11 + p12, c21 = p21 + p21 + p22;
	lanes c12 = p12 + p12 + p11, c22 = p22 + p22 + p21;
	UNROLL for (int k = 0; k < 3; k++)
	{
		move_1[k] = e1[k] * c11 - e2[k] * c21;
		move_2[k] = e2[k] * c22 - e1[k] * c12;
	}
}

/* Allowed shear turns the rest shape: D T^-1 for D, T = [1 q; q 1], 2 q the allowed part of f1 f2;
 * to first order K - 2 q D [0 1; 1 0] D^T. */
LANES_INLINE void allow_shear(lanes k[3], const struct shape_grain *batch, int from,
			      const lanes g[3], lanes allow)
{
	lanes grain[3];
	UNROLL for (int i = 0; i < 3; i++) grain[i] = lanes_load(batch->grain[i] + from);
	lanes mixed = grain[1] * g[1];
	lanes shear = allow * ((grain[0] * g[0] + mixed) + (mixed + grain[2] * g[2]));
	shear = lanes_max(lanes_min(shear, lanes_all(shear_most)), lanes_all(-shear_most));
	UNROLL for (int i = 0; i < 3; i++) k[i] = k[i] - shear * grain[i];
}

LANES_INLINE void shape_part(struct place *x, const struct shape_batch *batch,
			     const struct shape_grain *grain, int from, float share, float shear)
{
	row x0[ROWS], x1[ROWS], x2[ROWS], e1[ROWS], e2[ROWS];
	rows_load(x0, x, batch->at[0] + from);
	rows_load(x1, x, batch->at[1] + from);
	rows_load(x2, x, batch->at[2] + from);
	UNROLL for (int i = 0; i < ROWS; i++)
	{
		e1[i] = row_sub(x1[i], x0[i]);
		e2[i] = row_sub(x2[i], x0[i]);
	}
	lanes a[3], b[3], g[3], metric[3], m[4], move_1[3], move_2[3];
	rows_to_lanes(e1, a);
	rows_to_lanes(e2, b);
	g[0] = dot(a, a);
	g[1] = dot(a, b);
	g[2] = dot(b, b);
	UNROLL for (int k = 0; k < 3; k++) metric[k] = lanes_load(batch->metric[k] + from);
	if (grain)
		allow_shear(metric, grain, from, g, lanes_all(0.5f * (1.0f - shear)));
	shape_matrix(g, metric, m);
	shape_moves(a, b, m, share, move_1, move_2);
	lanes_to_rows(move_1, e1);
	lanes_to_rows(move_2, e2);
	UNROLL for (int i = 0; i < ROWS; i++)
	{
		x0[i] = row_sub(x0[i], row_add(e1[i], e2[i]));
		x1[i] = row_add(x1[i], e1[i]);
		x2[i] = row_add(x2[i], e2[i]);
	}
	rows_store(x0, x, batch->at[0] + from);
	rows_store(x1, x, batch->at[1] + from);
	rows_store(x2, x, batch->at[2] + from);
}

LANES_TARGET static void shape(struct place *x, const struct shape_batch *batch,
			       const struct shape_grain *grain, int count, float share, float shear,
			       bool backwards)
{
	for (int i = 0; i < count; i++) {
		int now = backwards ? count - 1 - i : i;
		for (int from = 0; from < BATCH; from += LANES)
			if (grain)
				shape_part(x, &batch[now], &grain[now], from, share, shear);
			else
				shape_part(x, &batch[now], NULL, from, share, shear);
	}
}

LANES_INLINE row mix(const row p[4], const row k[4])
{
	return row_add(row_add(row_mul(p[0], k[0]), row_mul(p[1], k[1])),
		       row_add(row_mul(p[2], k[2]), row_mul(p[3], k[3])));
}

/* As many edges as a row has places. */
LANES_INLINE void flatten_part(struct place *x, const struct bends *bends, int from, row share)
{
	const uint32_t *at = bends->at[from], *next = bends->at[BENDS - 1];
	row k[4], p[4];
	rows_splat(k, bends->k[from], bends->k[BENDS - 1]);
	UNROLL for (int c = 0; c < 4; c++) p[c] = row_load(x, at[c], next[c]);
	row fault = row_mul(mix(p, k), share);
	UNROLL for (int c = 0; c < 4; c++)
		row_store(x, at[c], next[c], row_sub(p[c], row_mul(fault, k[c])));
}

LANES_TARGET static void flatten(struct place *x, const struct bends *bends,
				 const struct firm *firm, int count, float share, bool backwards)
{
	for (int i = 0; i < count; i++) {
		int now = backwards ? count - 1 - i : i;
		for (int from = 0; from < BENDS; from += ROW_PLACES) {
			row most = row_of(share, share);
			if (firm)
				most = row_of(float_max(firm[now].share[from], share),
					      float_max(firm[now].share[BENDS - 1], share));
			flatten_part(x, &bends[now], from, most);
		}
	}
}

/* A place and, if a row has two, the next one. */
LANES_INLINE void spread_part(struct place *x, const struct spread *spread, int next,
			      const struct place *move)
{
	row w[4], p[4];
	rows_splat(w, spread[0].weight, spread[next].weight);
	UNROLL for (int c = 0; c < 4; c++)
		p[c] = row_load(move, spread[0].node[c], spread[next].node[c]);
	row_store(x, 0, place_offset(next), row_add(row_load(x, 0, place_offset(next)), mix(p, w)));
}

LANES_TARGET static void spread_moves(struct place *x, const struct spread *spread, int count,
				      const struct place *move)
{
	for (int i = 0; i + ROW_PLACES <= count; i += ROW_PLACES)
		spread_part(x + i, spread + i, ROW_PLACES - 1, move);
	if (count % ROW_PLACES > 0)
		spread_part(x + count - 1, spread + count - 1, 0, move);
}

/* ---- particles in the public arrays ----
 *
 * A row of vertices as they lie there has the next one's x in its last lane. */

LANES_INLINE lanes squared_length(const row rows[ROWS])
{
	lanes axis[3];
	rows_to_lanes(rows, axis);
	return dot(axis, axis);
}

LANES_TARGET static void predict_one(struct place *x, const struct particles *particles, int v,
				     float momentum, float step_max_m, float fall_m)
{
	struct v3 p = particles->position_m[v];
	struct v3 step = v3_scale(v3_sub(p, particles->previous_m[v]), momentum);
	float squared = v3_dot(step, step);
	if (particles->at[v] == PLACE_NONE)
		return;
	if (squared > step_max_m * step_max_m)
		step = v3_scale(step, step_max_m / sqrtf(squared));
	particles->previous_m[v] = p;
	place_put(x, particles->at[v],
		  (struct v3){p.x + step.x, p.y + step.y - fall_m, p.z + step.z});
}

/* LANES vertices from v on; false: one of them goes too far. */
LANES_INLINE bool predict_part(struct place *x, const struct particles *particles, int v,
			       float momentum, float step_max_m, row fall)
{
	row p[ROWS], step[ROWS];
	vertices_load(p, particles->position_m + v);
	vertices_load(step, particles->previous_m + v);
	row share = row_of(momentum, momentum);
	UNROLL for (int i = 0; i < ROWS; i++) step[i] = row_mul(row_sub(p[i], step[i]), share);
	if (lanes_below(lanes_all(step_max_m * step_max_m), squared_length(step)))
		return false;
	UNROLL for (int i = 0; i < ROWS; i++)
		step[i] = row_cut(row_sub(row_add(p[i], step[i]), fall));
	rows_store(step, x, particles->at + v);
	memcpy(particles->previous_m + v, particles->position_m + v, LANES * sizeof(struct v3));
	return true;
}

LANES_TARGET static void predict(struct place *x, const struct particles *particles, int first,
				 int count, float momentum, float step_max_m, float fall_m)
{
	row fall = row_along(0.0f, fall_m, 0.0f);
	for (int v = first; v < first + count; v += LANES) {
		int end = int_min(v + LANES, first + count);
		if (!(particles->whole[v / BATCH] &&
		      predict_part(x, particles, v, momentum, step_max_m, fall)))
			for (int i = v; i < end; i++)
				predict_one(x, particles, i, momentum, step_max_m, fall_m);
	}
}

LANES_TARGET static void put_back(const struct place *x, const struct particles *particles,
				  int first, int count)
{
	for (int v = first; v < first + count; v += BATCH) {
		int end = int_min(v + BATCH, first + count);
		if (particles->whole[v / BATCH]) {
			vertices_store(particles->position_m + v, x, particles->at + v);
			continue;
		}
		for (int i = v; i < end; i++)
			if (particles->at[i] != PLACE_NONE)
				particles->position_m[i] = place_at(x, particles->at[i]);
	}
}

LANES_TARGET static void bound_one(const struct particles *particles, int v, float step_max_m)
{
	struct v3 start = particles->previous_m[v];
	struct v3 step = v3_sub(particles->position_m[v], start);
	float squared = v3_dot(step, step);
	if (particles->at[v] != PLACE_NONE && squared > step_max_m * step_max_m)
		particles->position_m[v] = v3_add(start,
						  v3_scale(step, step_max_m / sqrtf(squared)));
}

LANES_INLINE bool within(const struct particles *particles, int v, float step_max_m)
{
	row p[ROWS], step[ROWS];
	vertices_load(p, particles->position_m + v);
	vertices_load(step, particles->previous_m + v);
	UNROLL for (int i = 0; i < ROWS; i++) step[i] = row_sub(p[i], step[i]);
	return !lanes_below(lanes_all(step_max_m * step_max_m), squared_length(step));
}

LANES_TARGET static void bound(const struct particles *particles, int first, int count,
			       float step_max_m)
{
	for (int v = first; v < first + count; v += LANES) {
		int end = int_min(v + LANES, first + count);
		if (!(particles->whole[v / BATCH] && within(particles, v, step_max_m)))
			for (int i = v; i < end; i++)
				bound_one(particles, i, step_max_m);
	}
}

LANES_TARGET static unsigned stirred(const struct v3 *position_m, const struct quiet *quiet)
{
	unsigned quiet_ones = 0;
	for (int from = 0; from < BATCH; from += LANES) {
		row p[ROWS], at[ROWS];
		vertices_load(p, position_m + from);
		quiet_load(at, quiet + from);
		lanes way2 = rows_last(at);
		UNROLL for (int i = 0; i < ROWS; i++) p[i] = row_sub(p[i], at[i]);
		quiet_ones |= lanes_below(squared_length(p), way2) << from;
	}
	return ~quiet_ones & ((1u << BATCH) - 1);
}

#define KERNEL                                                                                     \
	{                                                                                          \
		shape, flatten, spread_moves, predict, put_back, bound, stirred                    \
	}
