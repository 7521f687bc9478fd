/* What a drape is worth, against the exact body. */
#include "measure_private.h"

static const float deep_m = 1e-4f;   /* less is touching */
static const float facing_m = 0.06f; /* beyond, cloth hangs freely and may face anything */
static const float behind_m = 0.25f; /* cloth this far before a body belongs to it */

struct measure_scratch *measure_init(struct arena *arena)
{
	struct measure_scratch *s = ARENA_ARRAY(arena, struct measure_scratch, 1);
	s->edge = ARENA_ARRAY(arena, struct measure_edge, MEASURE_EDGES_MAX);
	s->edge_of = ARENA_ARRAY(arena, int, MEASURE_EDGES_MAX);
	s->star_first = ARENA_ARRAY(arena, int, GARMENT_VERTICES_MAX + 1);
	s->star = ARENA_ARRAY(arena, int, MEASURE_EDGES_MAX);
	s->sort = ARENA_ARRAY(arena, struct sort_item, GARMENT_TRIANGLES_MAX);
	s->walked = ARENA_ARRAY(arena, uint8_t, MEASURE_EDGES_MAX);
	s->loop = ARENA_ARRAY(arena, int, MEASURE_EDGES_MAX + 1);
	s->rim_m = ARENA_ARRAY(arena, struct v3, MEASURE_EDGES_MAX + 1);
	s->cut = ARENA_ARRAY(arena, uint8_t, GARMENT_TRIANGLES_MAX);
	s->body_cut = ARENA_ARRAY(arena, uint8_t, BODY_TRIANGLES_MAX);
	s->curve_m = ARENA_ARRAY(arena, struct v2, GARMENT_TRIANGLES_MAX);
	for (int d = 0; d < GIRTH_DIRECTIONS; d++) {
		float angle = 2.0f * PI_F * (float)d / (float)GIRTH_DIRECTIONS;
		s->direction[d] = (struct v2){angle_cos(angle), angle_sin(angle)};
	}
	return s;
}

static bool item_before(struct sort_item a, struct sort_item b)
{
	return a.key < b.key || (a.key == b.key && a.item < b.item);
}

/* Heap sort. */
void measure_sort(struct sort_item *item, int count)
{
	for (int start = count / 2, end = count; end > 1;) {
		struct sort_item sink;
		if (start > 0) {
			sink = item[--start];
		} else {
			sink = item[--end];
			item[end] = item[0];
		}
		int at = start;
		for (int child = 2 * at + 1; child < end; child = 2 * at + 1) {
			if (child + 1 < end && item_before(item[child], item[child + 1]))
				child++;
			if (!item_before(sink, item[child]))
				break;
			item[at] = item[child];
			at = child;
		}
		item[at] = sink;
	}
}

/* ---- edges ---- */

static void add_edge(struct measure_scratch *s, int t, int k, int a, int b)
{
	int i = s->star_first[int_min(a, b)];
	for (; s->star[i] >= 0; i++) {
		struct measure_edge *edge = &s->edge[s->star[i]];
		if (int_max(edge->a, edge->b) != int_max(a, b))
			continue;
		if (edge->triangle_count < 2)
			edge->triangle[edge->triangle_count] = t;
		edge->triangle_count++;
		s->edge_of[3 * t + k] = s->star[i];
		return;
	}
	s->star[i] = s->edge_count;
	s->edge_of[3 * t + k] = s->edge_count;
	s->edge[s->edge_count++] = (struct measure_edge){a, b, {t, -1}, 1};
}

/* A triangle of which a weld made two corners one is no triangle any more. */
static bool has_area(const struct triangle *triangle)
{
	const int *v = triangle->v;
	return v[0] != v[1] && v[1] != v[2] && v[2] != v[0];
}

/* A particle's bucket has room for every triangle edge of which it is the lower end, so that a
 * search in it meets the edge or a free place. */
static void find_edges(const struct cloth *cloth, struct measure_scratch *s)
{
	const struct garment *garment = cloth->garment;
	memset(s->star_first, 0, (GARMENT_VERTICES_MAX + 1) * sizeof *s->star_first);
	for (int t = 0; t < garment->triangle_count; t++)
		for (int k = 0; k < 3; k++) {
			const int *v = cloth->triangle[t].v;
			s->star_first[int_min(v[k], v[(k + 1) % 3]) + 1]++;
		}
	for (int v = 0; v < garment->vertex_count; v++)
		s->star_first[v + 1] += s->star_first[v];
	for (int i = 0; i < MEASURE_EDGES_MAX; i++) {
		s->star[i] = -1;
		s->edge_of[i] = -1;
	}
	s->edge_count = 0;
	for (int t = 0; t < garment->triangle_count; t++)
		for (int k = 0; k < 3; k++) {
			const int *v = cloth->triangle[t].v;
			if (measure_placed(cloth, t) && has_area(&cloth->triangle[t]))
				add_edge(s, t, k, v[k], v[(k + 1) % 3]);
		}
}

/* ---- inside ---- */

/* How deep a point lies in the body; 0 outside. `near` is a vertex whose contact helps. */
static float look(const struct cloth *cloth, struct v3 point_m, int near, struct body_hit *hit)
{
	body_nearest_from(cloth->body, point_m, 0, cloth->contact[near].triangle, hit);
	return float_max(-hit->distance_m, 0.0f);
}

static void count_depth(struct measure *measure, float depth_m, int *inside)
{
	*inside += depth_m > deep_m;
	measure->penetration_mm_max = float_max(measure->penetration_mm_max, depth_m * 1e3f);
}

static void measure_vertices(struct measure *measure, const struct cloth *cloth)
{
	struct body_hit hit;
	for (int v = 0; v < cloth->garment->vertex_count; v++) {
		if (!cloth->placed[v] || cloth->particle[v] != v)
			continue;
		measure->vertices++;
		count_depth(measure, look(cloth, cloth->position_m[v], v, &hit),
			    &measure->vertices_inside);
	}
}

static void measure_edges(struct measure *measure, const struct cloth *cloth,
			  const struct measure_scratch *s)
{
	struct body_hit hit;
	for (int e = 0; e < s->edge_count; e++) {
		struct v3 a = cloth->position_m[s->edge[e].a], b = cloth->position_m[s->edge[e].b];
		count_depth(measure, look(cloth, v3_lerp(a, b, 0.5f), s->edge[e].a, &hit),
			    &measure->midpoints_inside);
		measure->edge_crossings_body += body_segment_hits(cloth->body, a, b, &hit);
	}
}

/* Does the outside of a triangle look at the body near it, and its inside at none? Cloth of the
 * trunk that hangs under an arm looks at the arm too, but has the trunk behind it; a crease that
 * goes into the armpit stands about square to the body. */
static bool is_inverted(const struct cloth *cloth, struct v3 centre, struct v3 normal,
			const struct body_hit *nearest)
{
	struct body_hit behind;
	if (nearest->distance_m > facing_m || v3_dot(normal, nearest->normal) > -0.5f)
		return false;
	return !body_ray(cloth->body, centre, v3_scale(normal, -1.0f), &behind) ||
	       behind.distance_m > behind_m;
}

static void measure_faces(struct measure *measure, const struct cloth *cloth)
{
	struct body_hit hit;
	for (int t = 0; t < cloth->garment->triangle_count; t++) {
		if (!measure_placed(cloth, t))
			continue;
		const int *v = cloth->triangle[t].v;
		struct v3 a = cloth->position_m[v[0]], b = cloth->position_m[v[1]],
			  c = cloth->position_m[v[2]];
		struct v3 centre = v3_scale(v3_add(v3_add(a, b), c), 1.0f / 3.0f);
		measure->triangles++;
		count_depth(measure, look(cloth, centre, v[0], &hit), &measure->centres_inside);
		struct v3 normal = v3_normalize(v3_cross(v3_sub(b, a), v3_sub(c, a)));
		if (!is_inverted(cloth, centre, normal, &hit))
			continue;
		measure->inverted_triangles++;
		measure->creased_triangles += cloth->creased[v[0]] && cloth->creased[v[1]] &&
					      cloth->creased[v[2]];
	}
}

static void measure_seams(struct measure *measure, const struct cloth *cloth)
{
	const struct garment *garment = cloth->garment;
	for (int i = 0; i < garment->pair_count; i++) {
		int a = garment->pair[i].a, b = garment->pair[i].b;
		if (!cloth->placed[a] || !cloth->placed[b])
			continue;
		float gap_m = v3_distance(measure_position(cloth, a), measure_position(cloth, b));
		measure->seam_gap_mm_max = float_max(measure->seam_gap_mm_max, gap_m * 1e3f);
	}
}

void measure_garment(struct measure *measure, const struct cloth *cloth, struct measure_scratch *s)
{
	memset(measure, 0, sizeof *measure);
	if (!cloth->garment || !cloth->body)
		return;
	find_edges(cloth, s);
	measure_vertices(measure, cloth);
	measure_edges(measure, cloth, s);
	measure_faces(measure, cloth);
	measure_seams(measure, cloth);
	measure_strain(measure, cloth, s);
	measure_self(measure, cloth, s);
	measure_loops(measure, cloth, s);
	measure_girths(measure, cloth, s);
}
