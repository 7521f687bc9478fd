/* Folds turned back, edges pushed out: the help that physics would not give (S18). */
#include "cloth_private.h"
#include "cloth_self.h"

enum {
	SMOOTH_ROUNDS = 20,
	EDGE_SAMPLES = 8,
	LOOK_UNITS = 64, /* an exact query */
	PASS_UNITS = 4,  /* a particle copied out and in, whatever else is done */
	FOLD_UNITS = 8,  /* a triangle's centre walked to the body */
	EDGE_UNITS = 24, /* an edge's way through the tree, where it is short */
};

static const float fold_reach_m = 0.06f; /* a fold matters this near to the body */
static const float fold_near_m = 0.02f;  /* and so near even when it only leans over */
static const float inside_m = 0.0003f;   /* a face's centre may lie so deep */
static const float pierce_max_m = 0.03f; /* the longest thumb that is drawn back under cloth */
static const float pierced_edges =
	3.0f;                        /* longer edges than so many go round a limb, not a thumb */
static const float behind_m = 0.25f; /* cloth this far before a body belongs to it */

static struct v3 face_normal(const struct cloth *cloth, int t)
{
	const int *v = cloth->triangle[t].v;
	const struct v3 *x = cloth->position_m;
	return v3_normalize(v3_cross(v3_sub(x[v[1]], x[v[0]]), v3_sub(x[v[2]], x[v[0]])));
}

/* Does the triangle's outside look at the body that it lies near, and its inside at none? (Cloth of
 * the trunk that hangs under an arm looks at the arm, but its inside still faces the trunk.) */
bool cloth_folded(const struct cloth *cloth, int t)
{
	const int *v = cloth->triangle[t].v;
	if (!triangle_placed(cloth, t) || cloth->contact[v[0]].triangle < 0)
		return false;
	struct v3 centre = {0.0f, 0.0f, 0.0f}, normal = face_normal(cloth, t);
	for (int k = 0; k < 3; k++)
		centre = v3_mad(centre, cloth->position_m[v[k]], 1.0f / 3.0f);
	struct body_hit hit;
	body_walk(cloth->body, centre, cloth->contact[v[0]].triangle, 16, &hit);
	float facing = hit.distance_m < fold_near_m ? -0.25f : -0.5f;
	if (hit.distance_m > fold_reach_m || v3_dot(normal, hit.normal) > facing)
		return false;
	return !body_ray(cloth->body, centre, v3_scale(normal, -1.0f), &hit) ||
	       hit.distance_m > behind_m;
}

static void flag_ring(struct cloth *cloth)
{
	struct cloth_scratch *s = cloth->scratch;
	for (int v = 0; v < cloth->garment->vertex_count; v++)
		for (int i = 2 * cloth->star_first[v];
		     s->flipped[v] == 1 && i < 2 * cloth->star_first[v + 1]; i++)
			if (!s->flipped[cloth->ring[i]] && !cloth->creased[cloth->ring[i]])
				s->flipped[cloth->ring[i]] = 2;
}

/* Laplacian steps on the flagged particles; those at a rim slide along the rim only, because the
 * mean of a rim particle's whole ring would shrink the hem. An inner particle's neighbours come
 * twice in its ring, a rim neighbour once. */
static void smooth(struct cloth *cloth)
{
	struct cloth_scratch *s = cloth->scratch;
	for (int v = 0; v < cloth->garment->vertex_count; v++) {
		int first = 2 * cloth->star_first[v], end = 2 * cloth->star_first[v + 1];
		if (!s->flipped[v] || !is_particle(cloth, v) || first == end)
			continue;
		struct v3 all = {0.0f, 0.0f, 0.0f}, rim = {0.0f, 0.0f, 0.0f};
		int rims = 0;
		for (int i = first; i < end; i++) {
			int times = 0;
			for (int j = first; j < end; j++)
				times += cloth->ring[j] == cloth->ring[i];
			all = v3_add(all, cloth->position_m[cloth->ring[i]]);
			if (times == 1) {
				rim = v3_add(rim, cloth->position_m[cloth->ring[i]]);
				rims++;
			}
		}
		struct v3 to = rims > 0 ? v3_scale(rim, 1.0f / (float)rims)
					: v3_scale(all, 1.0f / (float)(end - first));
		cloth->position_m[v] = to;
		cloth->previous_m[v] = to;
	}
}

static void flag_folds(struct cloth *cloth, int slice, int slices)
{
	struct cloth_scratch *s = cloth->scratch;
	for (int t = slice; t < cloth->garment->triangle_count; t += slices) {
		const int *v = cloth->triangle[t].v;
		bool wanted = cloth->creased[v[0]] && cloth->creased[v[1]] && cloth->creased[v[2]];
		if (wanted || !cloth_folded(cloth, t))
			continue;
		s->fold_count++;
		for (int k = 0; k < 3; k++)
			s->flipped[v[k]] = 1;
	}
}

int cloth_unfold(struct cloth *cloth, int slice, int slices, long *units)
{
	struct cloth_scratch *s = cloth->scratch;
	if (slice == 0) {
		s->fold_count = 0;
		memset(s->flipped, 0, (size_t)cloth->garment->vertex_count);
	}
	flag_folds(cloth, slice, slices);
	*units += FOLD_UNITS * (cloth->garment->triangle_count / slices);
	if (s->fold_count == 0 || slice < slices - 1)
		return s->fold_count;
	flag_ring(cloth);
	for (int v = 0; v < cloth->garment->vertex_count; v++)
		s->stiff[v] |= s->flipped[v] != 0;
	s->stale = true;
	for (int round = 0; round < SMOOTH_ROUNDS; round++)
		smooth(cloth);
	cloth_self_forget(cloth, s->flipped);
	*units += SMOOTH_ROUNDS * (long)cloth->garment->vertex_count;
	for (int v = 0; v < cloth->garment->vertex_count; v++)
		if (s->flipped[v] && is_particle(cloth, v)) {
			*units += cloth_touch(cloth, v);
			cloth->previous_m[v] = cloth->position_m[v];
		}
	cloth_finish(cloth);
	return s->fold_count;
}

/* ---- edges ---- */

/* Corners keep their momentum: what they are moved by is no motion of theirs. */
static void move_corners(struct cloth *cloth, const int *v, int corners, struct v3 way)
{
	for (int k = 0; k < corners; k++) {
		struct v3 *p = &cloth->position_m[v[k]], before = *p;
		*p = v3_add(*p, way);
		cloth->scratch->lift_m[v[k]] = 0.0f;
		cloth_touch(cloth, v[k]);
		cloth->previous_m[v[k]] = v3_add(cloth->previous_m[v[k]], v3_sub(*p, before));
	}
}

/* What pierces the cloth goes back under it: the corners go to the outside by as much as sticks out
 * at `from`, at once, because the cloth would draw them back from half-way. */
static bool draw_over(struct cloth *cloth, const int *v, int corners, struct v3 from,
		      struct v3 outside)
{
	struct body_hit exit;
	if (!body_segment_hits(cloth->body, from, v3_mad(from, outside, pierce_max_m), &exit))
		return false;
	float out = v3_distance(exit.point_m, from) + cloth->settings.offset_m;
	float longest = pierced_edges * cloth->garment->edge_m;
	for (int k = 0; k < corners; k++)
		if (v3_distance(cloth->position_m[v[k]], cloth->position_m[v[(k + 1) % corners]]) >
		    longest)
			return false;
	move_corners(cloth, v, corners, v3_scale(outside, out));
	return true;
}

/* The deepest of some points between two particles. */
static struct body_hit deepest_between(const struct cloth *cloth, struct v3 a, struct v3 b,
				       struct v3 *at)
{
	struct body_hit hit, deepest = {.distance_m = 1.0f};
	for (int i = 0; i <= EDGE_SAMPLES; i++) {
		struct v3 p = v3_lerp(a, b, (float)i / (float)EDGE_SAMPLES);
		body_nearest(cloth->body, p, 0, &hit);
		if (hit.distance_m < deepest.distance_m) {
			deepest = hit;
			*at = p;
		}
	}
	return deepest;
}

/* Nothing of the body is between two points near particle v: no query is needed. */
static bool clear_between(const struct cloth *cloth, int v, struct v3 a_m, struct v3 b_m)
{
	int under = cloth->contact[v].triangle;
	return under >= 0 && body_clear_between(cloth->body, under, a_m, b_m);
}

/* Both ends of an edge that passes through the body go out by what its deepest sample lacks. */
static bool push_edge(struct cloth *cloth, int a, int b, struct v3 outside)
{
	const struct v3 *x = cloth->position_m;
	const int ends[2] = {a, b};
	struct body_hit hit;
	struct v3 at = x[a];
	if (clear_between(cloth, a, x[a], x[b]) || clear_between(cloth, b, x[a], x[b]))
		return false;
	if (!body_segment_hits(cloth->body, x[a], x[b], &hit))
		return false;
	struct body_hit deepest = deepest_between(cloth, x[a], x[b], &at);
	if (cloth_pierced(cloth, ends, 2) && draw_over(cloth, ends, 2, at, outside))
		return true;
	float lack = 0.75f * cloth->settings.offset_m - deepest.distance_m;
	move_corners(cloth, ends, 2, v3_scale(deepest.normal, float_clamp(lack, 0.001f, 0.006f)));
	return true;
}

/* The same for a face whose centre lies in the body. */
static bool push_face(struct cloth *cloth, const int *v, struct v3 outside)
{
	const struct v3 *x = cloth->position_m;
	struct v3 centre = v3_scale(v3_add(v3_add(x[v[0]], x[v[1]]), x[v[2]]), 1.0f / 3.0f);
	struct body_hit hit;
	for (int k = 0; k < 3; k++)
		if (clear_between(cloth, v[k], centre, centre))
			return false;
	body_nearest_from(cloth->body, centre, 0, cloth->contact[v[0]].triangle, &hit);
	if (hit.distance_m > -inside_m)
		return false;
	if (cloth_pierced(cloth, v, 3) && draw_over(cloth, v, 3, centre, outside))
		return true;
	float lack = 0.75f * cloth->settings.offset_m - hit.distance_m;
	move_corners(cloth, v, 3, v3_scale(hit.normal, float_clamp(lack, 0.001f, 0.006f)));
	return true;
}

/* Where the face's outside is. A creased face may look at the body; then that is behind it. */
static struct v3 face_outside(const struct cloth *cloth, int t)
{
	const int *v = cloth->triangle[t].v;
	struct v3 normal = face_normal(cloth, t);
	bool creased = cloth->creased[v[0]] && cloth->creased[v[1]] && cloth->creased[v[2]];
	bool turned = creased && v3_dot(normal, cloth->contact[v[0]].normal) < 0.0f;
	return turned ? v3_scale(normal, -1.0f) : normal;
}

int cloth_push_out(struct cloth *cloth, int slice, int slices, long *units)
{
	int found = 0;
	float close_m = 2.0f * cloth->garment->edge_m;
	for (int t = slice; t < cloth->garment->triangle_count; t += slices) {
		const int *v = cloth->triangle[t].v;
		bool close = false;
		for (int k = 0; triangle_placed(cloth, t) && k < 3; k++) {
			if (cloth->contact[v[k]].distance_m > close_m)
				continue;
			close = true;
			found += push_edge(cloth, v[k], v[(k + 1) % 3], face_outside(cloth, t));
			*units += EDGE_UNITS;
		}
		if (close) {
			found += push_face(cloth, v, face_outside(cloth, t));
			*units += LOOK_UNITS;
		}
	}
	if (found > 0)
		cloth_finish(cloth);
	return found;
}

int cloth_clean(struct cloth *cloth, int slice, int slices, long *units)
{
	int count = cloth->garment->vertex_count;
	for (int v = 0; v < count; v++)
		cloth->previous_m[v] = cloth->position_m[v];
	for (int v = slice; v < count; v += slices)
		if (is_particle(cloth, v)) {
			cloth_look(cloth, v);
			*units += LOOK_UNITS;
		}
	*units += cloth_contact_faces(cloth, slice, slices);
	int found = cloth_push_out(cloth, slice, slices, units);
	*units += cloth_contact(cloth);
	*units += cloth_self_order(cloth);
	*units += PASS_UNITS * (long)count;
	cloth_finish(cloth);
	return found;
}
