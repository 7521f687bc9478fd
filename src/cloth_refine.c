#include "cloth_refine.h"

#include "cloth_private.h"
#include "cloth_self.h"
#include "garment_refine.h"

enum {
	BUILD_UNITS = 200, /* a vertex's share of the cloth's tables */
	TEST_UNITS = 3,    /* a triangle's edges */
	PAIR_UNITS = 16,   /* a triangle's share of finding what meets at the edges */
};

/* What is refined stays so while its edges would sink with half the distance: else cloth at the
 * limit would change at every look. */
static const float keep_share = 0.5f;
static const float drawn_share = 1.1f; /* longer edges were drawn through by something else */
static const float taut_stretch = 0.25f;
static const float bulge_max = 0.2f;  /* edges: crumpled cloth is no surface to be continued */
static const float out_max_m = 0.05f; /* the thickest limb that a new vertex is taken out of */

/* The largest entry per vertex that is carried over. */
static const size_t entry_bytes = sizeof(struct contact) > sizeof(struct body_track)
					  ? sizeof(struct contact)
					  : sizeof(struct body_track);

struct cloth_refine {
	struct refiner refiner;
	uint8_t *depth;   /* wanted, per base triangle */
	uint8_t *trouble; /* per particle: finer cloth would not help here */
	void *before;     /* per vertex: the array that is carried over */
};

struct cloth_refine *cloth_refine_init(struct arena *arena)
{
	struct cloth_refine *refine = ARENA_ARRAY(arena, struct cloth_refine, 1);
	refiner_init(&refine->refiner, arena);
	refine->depth = ARENA_ARRAY(arena, uint8_t, GARMENT_TRIANGLES_MAX);
	refine->trouble = ARENA_ARRAY(arena, uint8_t, GARMENT_VERTICES_MAX);
	refine->before = arena_take(arena, GARMENT_VERTICES_MAX, entry_bytes);
	return refine;
}

/* ---- which triangles ---- */

bool edge_sinks(struct v3 ab_m, struct v3 inward, float distance_m)
{
	float along_m = v3_dot(ab_m, inward);
	if (along_m <= 0.0f)
		return false; /* cos q > 0 */
	float length = v3_length(ab_m), reach = (distance_m + length) / length;
	float aside_m = sqrtf(float_max(length * length - along_m * along_m, 0.0f));
	return reach * aside_m < length && reach * along_m < length;
}

static bool sinks_at(const struct cloth *cloth, int a, int b, float share)
{
	const struct contact *contact = &cloth->contact[a];
	const struct v3 *x = cloth->position_m;
	float lies_m = cloth->settings.offset_m + layer_lift(cloth, a);
	float distance_m = v3_dot(v3_sub(x[a], contact->point_m), contact->normal);
	return contact->triangle >= 0 &&
	       edge_sinks(v3_sub(x[b], x[a]), v3_scale(contact->normal, -1.0f),
			  share * float_max(distance_m, lies_m));
}

static bool sinks(const struct cloth *cloth, int a, int b, float share)
{
	return cloth->placed[a] && cloth->placed[b] &&
	       (sinks_at(cloth, a, b, share) || sinks_at(cloth, b, a, share));
}

/* Over a blunt edge of the body corners are lifted for the sake of what lies between them, which
 * serves as well as a finer mesh and costs nothing. Over what is thinner, where they look away from
 * each other, no lift helps; nor where the edge is in the body all the same. */
static bool is_lacking(const struct cloth *cloth, int a, int b)
{
	const struct v3 *x = cloth->position_m;
	const int ends[2] = {a, b};
	struct body_hit hit;
	if (!cloth->settings.faces || cloth_pierced(cloth, ends, 2))
		return true;
	body_nearest_from(cloth->body, v3_lerp(x[a], x[b], 0.5f), 0, cloth->contact[a].triangle,
			  &hit);
	return hit.distance_m < 0.0f;
}

/* Does the garment's edge ask for a finer mesh? `fine`: for the one that is. */
static bool asks(const struct cloth *cloth, int v, int w, bool fine)
{
	const struct v2 *rest = cloth->garment->rest_m;
	const struct v3 *x = cloth->position_m;
	int a = cloth->particle[v], b = cloth->particle[w];
	if (!sinks(cloth, a, b, fine ? keep_share : 1.0f) ||
	    v3_distance(x[a], x[b]) > drawn_share * v2_distance(rest[v], rest[w]))
		return false;
	return fine || is_lacking(cloth, a, b);
}

/* The garment's vertex at the centre of a base triangle, which has one. Vertices are sorted by
 * place within a piece. */
static int find_centre(const struct garment *garment, int t, int piece)
{
	int low = garment->piece_first[piece], high = garment->piece_first[piece + 1];
	while (low < high) {
		int middle = low + (high - low) / 2;
		if (garment->place[middle] < REFINE_PLACES * t + REFINE_CENTRE)
			low = middle + 1;
		else
			high = middle;
	}
	return low;
}

/* What the edges of a base triangle ask for, and those of its first refinement, which all have
 * their ends at vertices that stay. A rim or seam is only cut by the second step. */
static int wanted(const struct cloth *cloth, const struct refiner *refiner, int t)
{
	const struct garment *garment = cloth->garment;
	int depth = garment->depth[t], want = 0, at[3];
	for (int k = 0; k < 3; k++)
		at[k] = refiner->now[garment->base[t].v[k]];
	for (int k = 0; k < 3; k++)
		if (asks(cloth, at[k], at[(k + 1) % 3], depth > 0))
			want = int_max(want, refiner_inner(refiner, 3 * t + k) ? 1 : 2);
	if (depth == 0)
		return want;
	int centre = find_centre(garment, t, garment->piece[at[0]]);
	for (int k = 0; k < 3; k++) {
		int other = refiner->across[3 * t + k] / 3;
		if (asks(cloth, centre, at[k], depth > 1))
			want = 2;
		if (refiner_inner(refiner, 3 * t + k) && garment->depth[other] > 0 &&
		    asks(cloth, centre, find_centre(garment, other, garment->piece[at[0]]),
			 depth > 1))
			want = 2;
	}
	return want;
}

/* Cloth that passes through cloth, or is drawn taut over what it has caught on, wants something
 * else than to be finer: there would only be more of it to untangle. */
static void find_trouble(const struct cloth *cloth, uint8_t *trouble)
{
	memset(trouble, 0, (size_t)cloth->garment->vertex_count);
	cloth_flag_crossed(cloth, trouble);
	for (int t = 0; t < cloth->garment->triangle_count; t++)
		for (int k = 0; k < 3; k++)
			if (triangle_placed(cloth, t) && cloth_stretch(cloth, t) > taut_stretch)
				trouble[cloth->triangle[t].v[k]] = 1;
}

static bool in_trouble(const struct cloth *cloth, const struct cloth_refine *refine, int t)
{
	bool found = false;
	for (int k = 0; k < 3; k++) {
		int v = refine->refiner.now[cloth->garment->base[t].v[k]];
		found |= refine->trouble[cloth->particle[v]];
	}
	return found;
}

/* By at most a step from what is. Returns how many triangles change. */
static int choose(const struct cloth *cloth, struct cloth_refine *refine, bool coarsen)
{
	const struct garment *garment = cloth->garment;
	int changes = 0;
	find_trouble(cloth, refine->trouble);
	for (int t = 0; t < garment->base_count; t++) {
		int depth = garment->depth[t], want = 0;
		if (!in_trouble(cloth, refine, t))
			want = wanted(cloth, &refine->refiner, t);
		refine->depth[t] = (uint8_t)int_max(want, coarsen ? depth - 1 : depth);
	}
	refiner_balance(&refine->refiner, garment, refine->depth);
	for (int t = 0; t < garment->base_count; t++)
		changes += refine->depth[t] != garment->depth[t];
	return changes;
}

/* ---- what the cloth knows of its vertices ---- */

/* Entries of vertices that stay; those of new ones are 0. */
static void carry(struct cloth_refine *refine, void *array, size_t size, int count)
{
	unsigned char *entry = array, *before = refine->before;
	MUST(size <= entry_bytes);
	memcpy(before, entry, GARMENT_VERTICES_MAX * size);
	for (int v = 0; v < count; v++, entry += size) {
		int from = refine->refiner.from[v];
		if (from >= 0)
			memcpy(entry, before + (size_t)from * size, size);
		else
			memset(entry, 0, size);
	}
}

static void carry_all(struct cloth *cloth, struct cloth_refine *refine)
{
	struct cloth_scratch *s = cloth->scratch;
	int count = cloth->garment->vertex_count;
	carry(refine, cloth->position_m, sizeof *cloth->position_m, count);
	carry(refine, cloth->previous_m, sizeof *cloth->previous_m, count);
	carry(refine, cloth->contact, sizeof *cloth->contact, count);
	carry(refine, cloth->placed, sizeof *cloth->placed, count);
	carry(refine, cloth->creased, sizeof *cloth->creased, count);
	carry(refine, s->stiff, sizeof *s->stiff, count);
	carry(refine, s->lift_m, sizeof *s->lift_m, count);
	carry(refine, s->lift_way, sizeof *s->lift_way, count);
	carry(refine, s->track, sizeof *s->track, count);
	memset(s->quiet, 0, (size_t)count * sizeof *s->quiet);
	memset(s->face_quiet, 0, (size_t)cloth->garment->triangle_count * sizeof *s->face_quiet);
	memset(s->slack_m, 0, (size_t)count * sizeof *s->slack_m);
	memset(cloth->held, 0, (size_t)count);
}

/* ---- new vertices ---- */

/* The triangle's own plane in space, continued to a flat point. */
static struct v3 plane_at(const struct cloth *cloth, const int v[3], struct v2 flat)
{
	const struct v2 *rest = cloth->garment->rest_m;
	const struct v3 *x = cloth->position_m;
	struct v2 u = v2_sub(rest[v[1]], rest[v[0]]), w = v2_sub(rest[v[2]], rest[v[0]]);
	struct v2 to = v2_sub(flat, rest[v[0]]);
	float area = float_max(v2_cross(u, w), 1e-10f);
	float along_u = v2_cross(to, w) / area, along_w = v2_cross(u, to) / area;
	struct v3 p = v3_mad(x[v[0]], v3_sub(x[v[1]], x[v[0]]), along_u);
	return v3_mad(p, v3_sub(x[v[2]], x[v[0]]), along_w);
}

/* How far from the plane a neighbour across `edge` lies; nothing where the piece ends. */
static struct v3 rise_across(const struct cloth *cloth, const struct refiner *refiner,
			     const int v[3], int edge)
{
	const struct garment *garment = cloth->garment;
	int other = refiner->across[edge];
	if (!refiner_inner(refiner, edge))
		return (struct v3){0.0f, 0.0f, 0.0f};
	int far = refiner->now[garment->base[other / 3].v[(other + 2) % 3]];
	return v3_sub(cloth->position_m[far], plane_at(cloth, v, garment->rest_m[far]));
}

/* How far above a triangle's centre the surface through the vertices around it lies: 32/81 of the
 * corners, -1/81 and -2/81 of the first and second ring (Labsik and Greiner 2000), less what a flat
 * mesh of this shape would give. */
static struct v3 bulge(const struct cloth *cloth, const struct refiner *refiner, int t)
{
	const struct garment *garment = cloth->garment;
	struct v3 sum = {0.0f, 0.0f, 0.0f};
	int v[3];
	for (int k = 0; k < 3; k++)
		v[k] = refiner->now[garment->base[t].v[k]];
	for (int k = 0; k < 3; k++) {
		int other = refiner->across[3 * t + k], u = other / 3;
		if (!refiner_inner(refiner, 3 * t + k))
			continue;
		sum = v3_mad(sum, rise_across(cloth, refiner, v, 3 * t + k), -1.0f / 81.0f);
		for (int j = 1; j < 3; j++)
			sum = v3_mad(sum, rise_across(cloth, refiner, v, 3 * u + (other + j) % 3),
				     -2.0f / 81.0f);
	}
	float length = v3_length(sum), most = bulge_max * garment->edge_m;
	return length > most ? v3_scale(sum, most / length) : sum;
}

static void place_vertex(struct cloth *cloth, const struct refiner *refiner, int v)
{
	const struct garment *garment = cloth->garment;
	int parent[3], place = garment->place[v];
	struct v3 sum = {0.0f, 0.0f, 0.0f};
	refiner_parents(refiner, garment, v, parent);
	cloth->placed[v] = cloth->creased[v] = cloth->scratch->stiff[v] = 1;
	for (int k = 0; k < 3; k++) {
		int p = garment->weld[parent[k]];
		sum = v3_mad(sum, cloth->position_m[p], 1.0f / 3.0f);
		cloth->placed[v] &= cloth->placed[p];
		cloth->creased[v] &= cloth->creased[p];
		cloth->scratch->stiff[v] &= cloth->scratch->stiff[p];
	}
	if (place % REFINE_PLACES == REFINE_CENTRE)
		sum = v3_add(sum, bulge(cloth, refiner, place / REFINE_PLACES));
	cloth->position_m[v] = cloth->previous_m[v] = sum;
}

/* Centres first: the others lie between them. */
static void place_vertices(struct cloth *cloth, const struct refiner *refiner)
{
	const struct garment *garment = cloth->garment;
	for (int pass = 0; pass < 2; pass++)
		for (int v = 0; v < garment->vertex_count; v++)
			if (refiner->from[v] < 0 &&
			    (garment->place[v] % REFINE_PLACES == REFINE_CENTRE) == (pass == 0))
				place_vertex(cloth, refiner, v);
}

/* The middle of an edge that passes through a thin limb may be nearer to the limb's far side; out
 * is where the corners are. */
static void leave_body(struct cloth *cloth, const struct refiner *refiner, int v)
{
	struct v3 out = {0.0f, 0.0f, 0.0f};
	struct body_hit hit;
	int parent[3];
	refiner_parents(refiner, cloth->garment, v, parent);
	for (int k = 0; k < 3; k++)
		out = v3_add(out, cloth->contact[cloth->garment->weld[parent[k]]].normal);
	out = v3_normalize(out);
	struct v3 *p = &cloth->position_m[v];
	cloth->contact[v].triangle = -1;
	cloth_look(cloth, v);
	if (cloth->contact[v].distance_m < 0.0f && v3_dot(out, cloth->contact[v].normal) < 0.0f &&
	    body_segment_hits(cloth->body, *p, v3_mad(*p, out, out_max_m), &hit)) {
		*p = v3_mad(hit.point_m, out, cloth->settings.offset_m);
		cloth_look(cloth, v);
	}
	cloth->previous_m[v] = *p;
	cloth_touch(cloth, v);
	cloth->previous_m[v] = *p;
}

/* What is new comes out of the body, centres first. */
static void find_contacts(struct cloth *cloth, const struct refiner *refiner)
{
	const struct garment *garment = cloth->garment;
	for (int pass = 0; pass < 2; pass++)
		for (int v = 0; v < garment->vertex_count; v++)
			if (refiner->from[v] < 0 && is_particle(cloth, v) &&
			    (garment->place[v] % REFINE_PLACES == REFINE_CENTRE) == (pass == 0))
				leave_body(cloth, refiner, v);
}

static bool any_asks(const struct cloth *cloth)
{
	bool found = false;
	for (int t = 0; t < cloth->garment->triangle_count && !found; t++)
		for (int k = 0; k < 3; k++) {
			const int *v = cloth->garment->triangle[t].v;
			found |= (cloth->scratch->edge_owner[t] >> k & 1) &&
				 asks(cloth, v[k], v[(k + 1) % 3], false);
		}
	return found;
}

int cloth_refine(struct cloth *cloth, struct garment *garment, bool coarsen, long *units)
{
	struct cloth_refine *refine = cloth->refine;
	struct refiner *refiner = &refine->refiner;
	MUST(cloth->garment == garment && cloth->welded);
	*units += TEST_UNITS * (long)garment->triangle_count;
	if (garment->base_count == 0 && !any_asks(cloth))
		return 0;
	refiner_look(refiner, garment);
	int changes = choose(cloth, refine, coarsen);
	*units += PAIR_UNITS * (long)garment->base_count;
	if (changes > 0 && garment_refine(refiner, garment, refine->depth)) {
		carry_all(cloth, refine);
		place_vertices(cloth, refiner);
		cloth_build(cloth);
		find_contacts(cloth, refiner);
		cloth_finish(cloth);
		*units += BUILD_UNITS * (long)garment->vertex_count;
	} else {
		changes = 0;
	}
	refiner_close(garment);
	return changes;
}
