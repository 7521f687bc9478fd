/* Coarse levels: hierarchical position-based dynamics (Mueller 2008). A coarse level is a choice of
 * particles, its nodes, and limits between neighbouring nodes: no two may be farther apart in space
 * than the way through the cloth. What the limits move the nodes by is handed on to the particles
 * between them. Tension so passes through the whole cloth in one sweep, and cloth that is not taut
 * is left alone. */
#include "cloth_private.h"

/* Spacing of the nodes of each level, in edges of the mesh. */
static const float spacing_edges[LEVELS] = {3.0f, 9.0f};
static const float spread_share = 1.6f; /* a node moves cloth within so many spacings */
static const float link_share = 1.8f;   /* and is linked with nodes within so many */

/* ---- ways through the cloth ----
 *
 * Fast marching with unfolding: the distance of a corner beyond an edge whose ends are known is
 * that of the edge's unfolded source, which is exact on flat cloth and over seams (Reimers 2004).
 */

struct march {
	struct cloth *cloth;
	struct cloth_scratch *s;
	int heap_count;
	float limit_m;
};

static bool before(const struct cloth_scratch *s, int a, int b)
{
	return s->way_m[a] < s->way_m[b] || (s->way_m[a] == s->way_m[b] && a < b);
}

static void heap_put(struct cloth_scratch *s, int at, int v)
{
	s->heap[at] = v;
	s->heap_at[v] = at;
}

static void heap_up(struct cloth_scratch *s, int at)
{
	int v = s->heap[at];
	while (at > 0 && before(s, v, s->heap[(at - 1) / 2])) {
		heap_put(s, at, s->heap[(at - 1) / 2]);
		at = (at - 1) / 2;
	}
	heap_put(s, at, v);
}

static int heap_pop(struct march *march)
{
	struct cloth_scratch *s = march->s;
	int top = s->heap[0], v = s->heap[--march->heap_count], at = 0;
	for (;;) {
		int child = 2 * at + 1;
		if (child >= march->heap_count)
			break;
		if (child + 1 < march->heap_count && before(s, s->heap[child + 1], s->heap[child]))
			child++;
		if (!before(s, s->heap[child], v))
			break;
		heap_put(s, at, s->heap[child]);
		at = child;
	}
	if (march->heap_count > 0)
		heap_put(s, at, v);
	s->heap_at[top] = HEAP_DONE;
	return top;
}

static void offer(struct march *march, int v, float way_m)
{
	struct cloth_scratch *s = march->s;
	if (s->way_of[v] != s->way_now) {
		s->way_of[v] = s->way_now;
		s->heap_at[v] = HEAP_NEW;
		s->way_m[v] = march->limit_m;
	}
	if (s->heap_at[v] == HEAP_DONE || way_m >= s->way_m[v])
		return;
	s->way_m[v] = way_m;
	if (s->heap_at[v] == HEAP_NEW)
		heap_put(s, march->heap_count++, v);
	heap_up(s, s->heap_at[v]);
}

/* The way to q past the edge p-r of a flat triangle, from a source that is `at_p` from p and `at_r`
 * from r; beyond the limit where the straight line does not cross the edge. */
static float unfolded_way(struct v2 p, struct v2 r, struct v2 q, float at_p, float at_r)
{
	struct v2 along = v2_sub(r, p), to = v2_sub(q, p);
	float length = v2_length(along), none = 1e9f;
	if (length < 1e-7f)
		return none;
	along = v2_scale(along, 1.0f / length);
	float x = v2_dot(to, along), y = float_abs(v2_cross(along, to));
	float sx = (at_p * at_p - at_r * at_r + length * length) / (2.0f * length);
	float sy = sqrtf(float_max(at_p * at_p - sx * sx, 0.0f));
	float crossing = sx + (x - sx) * sy / float_max(sy + y, 1e-9f);
	if (crossing < 0.0f || crossing > length)
		return none;
	return sqrtf((x - sx) * (x - sx) + (y + sy) * (y + sy));
}

/* Particle p's way is known: its neighbours are offered theirs. */
static void pass_on(struct march *march, int p)
{
	struct cloth_scratch *s = march->s;
	const struct cloth *cloth = march->cloth;
	const struct garment *garment = cloth->garment;
	for (int i = cloth->star_first[p]; i < cloth->star_first[p + 1]; i++) {
		int t = cloth->star[i] >> 2, k = cloth->star[i] & 3;
		const int *corner = garment->triangle[t].v, *v = cloth->triangle[t].v;
		for (int side = 1; side < 3; side++) {
			int a = (k + side) % 3, b = (k + 3 - side) % 3;
			struct v2 at = garment->rest_m[corner[k]], to = garment->rest_m[corner[a]];
			offer(march, v[a], s->way_m[p] + v2_distance(at, to));
			if (s->way_of[v[b]] != s->way_now || s->heap_at[v[b]] != HEAP_DONE)
				continue;
			offer(march, v[a],
			      unfolded_way(at, garment->rest_m[corner[b]], to, s->way_m[p],
					   s->way_m[v[b]]));
		}
	}
}

/* ---- building ---- */

/* The nearest nodes of a member, nearest first. */
static void note_node(struct level *level, int member, int node, float way_m)
{
	struct spread *spread = &level->spread[member];
	int at = SPREAD;
	while (at > 0 && way_m < spread->weight[at - 1])
		at--;
	for (int k = SPREAD - 1; k > at; k--) {
		spread->node[k] = spread->node[k - 1];
		spread->weight[k] = spread->weight[k - 1];
	}
	if (at < SPREAD) {
		spread->node[at] = place_offset(node);
		spread->weight[at] = way_m;
	}
}

static void note_link(struct level *level, int a, int b, float length_m)
{
	if (level->link_count < LEVEL_LINKS_MAX)
		level->link[level->link_count++] = (struct link){a, b, length_m};
}

/* Marches from a new node: covers the members near it, and links it with earlier nodes. `member` is
 * a particle's place among the level's members, -1: none. */
static void add_node(struct cloth *cloth, struct level *level, int from, const int *member)
{
	struct cloth_scratch *s = cloth->scratch;
	struct march march = {cloth, s, 0, link_share * level->spacing_m};
	int node = level->node_count++;
	level->node[node] = member[from];
	s->way_now++;
	offer(&march, from, 0.0f);
	while (march.heap_count > 0) {
		int v = heap_pop(&march);
		float way_m = s->way_m[v];
		pass_on(&march, v);
		if (member[v] < 0)
			continue;
		if (way_m < level->spacing_m)
			s->covered[v] = 1;
		if (way_m < spread_share * level->spacing_m)
			note_node(level, member[v], node, way_m);
		if (s->node_at[v] >= 0)
			note_link(level, s->node_at[v], node, way_m);
	}
	s->node_at[from] = node;
}

/* Ways become weights (1 - way / reach)^2, which fade to nothing where a node stops to matter. */
static void weigh(struct level *level)
{
	float reach_m = spread_share * level->spacing_m;
	for (int m = 0; m < level->member_count; m++) {
		struct spread *spread = &level->spread[m];
		float sum = 0.0f;
		for (int k = 0; k < SPREAD; k++) {
			float near = float_max(1.0f - spread->weight[k] / reach_m, 0.0f);
			spread->weight[k] = near * near;
			sum += near * near;
		}
		for (int k = 0; k < SPREAD && sum > 0.0f; k++)
			spread->weight[k] /= sum;
	}
}

static void build_level(struct cloth *cloth, struct level *level, const int *particle,
			int member_count, const int *member)
{
	struct cloth_scratch *s = cloth->scratch;
	int vertices = cloth->garment->vertex_count;
	level->node_count = level->link_count = 0;
	level->member_count = member_count;
	memset(s->covered, 0, (size_t)vertices);
	for (int v = 0; v < vertices; v++)
		s->node_at[v] = -1;
	for (int m = 0; m < member_count; m++)
		for (int k = 0; k < SPREAD; k++)
			level->spread[m] = (struct spread){{0}, {1e9f, 1e9f, 1e9f, 1e9f}};
	for (int m = 0; m < member_count; m++)
		if (!s->covered[particle[m]] && level->node_count < LEVEL_NODES_MAX)
			add_node(cloth, level, particle[m], member);
	weigh(level);
}

void cloth_build_levels(struct cloth *cloth)
{
	struct cloth_scratch *s = cloth->scratch;
	int vertices = cloth->garment->vertex_count, count = s->ranked_count;
	memcpy(s->member, s->ranked, (size_t)count * sizeof *s->member);
	memset(s->way_of, 0, (size_t)vertices * sizeof *s->way_of);
	s->way_now = 0;
	for (int v = 0; v < vertices; v++)
		s->member_at[v] = s->rank[v];
	for (int l = 0; l < LEVELS; l++) {
		struct level *level = &s->level[l];
		level->spacing_m = spacing_edges[l] * cloth->garment->edge_m;
		build_level(cloth, level, s->member, count, s->member_at);
		/* the nodes are the next level's members */
		for (int v = 0; v < vertices; v++)
			s->member_at[v] = s->node_at[v];
		count = level->node_count;
		for (int v = 0; v < vertices; v++)
			if (s->node_at[v] >= 0)
				s->member[s->node_at[v]] = v;
	}
}

/* ---- whenever cloth is placed ---- */

static bool node_placed(const struct cloth *cloth, int l, int node)
{
	const struct cloth_scratch *s = cloth->scratch;
	for (; l >= 0; l--)
		node = s->level[l].node[node];
	return cloth->placed[s->ranked[node]];
}

/* Links between placed nodes; what unplaced nodes would have moved stays. */
void cloth_take_levels(struct cloth *cloth)
{
	struct cloth_scratch *s = cloth->scratch;
	for (int l = 0; l < LEVELS; l++) {
		struct level *level = &s->level[l];
		level->taut_count = 0;
		for (int i = 0; i < level->link_count; i++)
			if (node_placed(cloth, l, level->link[i].a) &&
			    node_placed(cloth, l, level->link[i].b))
				level->taut[level->taut_count++] = level->link[i];
		memset(level->at, 0, (size_t)level->node_count * sizeof *level->at);
		memset(level->move, 0, (size_t)level->node_count * sizeof *level->move);
	}
	for (int slot = SLOT_FIRST; slot < s->slot_count; slot++)
		s->slot_spread[slot] = s->level[0].spread[s->rank[s->slot_vertex[slot]]];
}

/* ---- in every sweep ---- */

static bool limit_links(struct level *level, float share)
{
	bool moved = false;
	float half = 0.5f * share;
	for (int i = 0; i < level->taut_count; i++) {
		const struct link *link = &level->taut[i];
		struct place *a = &level->at[link->a], *b = &level->at[link->b];
		float x = b->x - a->x, y = b->y - a->y, z = b->z - a->z;
		float squared = x * x + y * y + z * z;
		if (squared <= link->length_m * link->length_m)
			continue;
		float length = sqrtf(squared), part = half * (length - link->length_m) / length;
		*a = (struct place){a->x + x * part, a->y + y * part, a->z + z * part, 0.0f};
		*b = (struct place){b->x - x * part, b->y - y * part, b->z - z * part, 0.0f};
		moved = true;
	}
	return moved;
}

static struct place place_sub(struct place a, struct place b)
{
	return (struct place){a.x - b.x, a.y - b.y, a.z - b.z, 0.0f};
}

/* Where the nodes are before anything moved: the level's members, all the way down. */
static struct place node_start(const struct cloth_scratch *s, int l, int node)
{
	for (; l >= 0; l--)
		node = s->level[l].node[node];
	int slot = s->slot[s->ranked[node]];
	return s->place[int_max(slot, 0)];
}

static void spread_moves(void *context, int part)
{
	struct cloth *cloth = context;
	struct cloth_scratch *s = cloth->scratch;
	struct loop_part slots = loop_part(s->slot_count - SLOT_FIRST, part);
	int first = SLOT_FIRST + slots.first;
	kernel_of(cloth->lanes)
		->spread(s->place + first, s->slot_spread + first, slots.count, s->level[0].move);
}

long cloth_levels(struct cloth *cloth)
{
	struct cloth_scratch *s = cloth->scratch;
	long units = 0;
	bool moved = false;
	if (cloth->settings.reach <= 0.0f)
		return 0;
	for (int l = LEVELS - 1; l >= 0; l--)
		for (int n = 0; n < s->level[l].node_count; n++)
			s->level[l].at[n] = node_start(s, l, n);
	for (int l = LEVELS - 1; l >= 0; l--) {
		struct level *level = &s->level[l];
		if (moved)
			kernel_of(cloth->lanes)
				->spread(level->at, s->level[l + 1].spread, level->node_count,
					 s->level[l + 1].move);
		for (int pass = 0; pass < LEVEL_PASSES; pass++) {
			moved |= limit_links(level, cloth->settings.reach);
			units += level->taut_count;
		}
		for (int n = 0; n < level->node_count; n++)
			level->move[n] = place_sub(level->at[n], node_start(s, l, n));
	}
	if (!moved)
		return units;
	crew_run(cloth->crew, spread_moves, cloth, loop_parts(s->slot_count - SLOT_FIRST));
	return units + s->slot_count - SLOT_FIRST;
}
