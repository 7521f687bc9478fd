/* Coarse levels: hierarchical position-based dynamics (Mueller 2008). A coarse level is a choice of
 * particles, its nodes, and limits between neighbouring nodes: no two may be farther apart in space
 * than the way through the cloth. What the limits move the nodes by is handed on to the particles
 * between them. Tension so passes through the whole cloth in one sweep, and cloth that is not taut
 * is left alone. */
#include "cloth_private.h"
#include "lanes.h"

enum { MARCH_UNITS = 30 }; /* a particle passed on the way from a node */

/* Spacing of the nodes of each level, in edges of the mesh. */
static const float spacing_edges[LEVELS] = {3.0f, 9.0f};
static const float spread_share = 1.6f; /* a node moves cloth within so many spacings */
static const float link_share = 1.8f;   /* and is linked with nodes within so many */

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
 * a particle's place among the level's members, -1: none. Returns how many particles it passed. */
static int add_node(struct cloth *cloth, struct level *level, int from, const int *member)
{
	struct cloth_scratch *s = cloth->scratch;
	struct march march;
	float way_m;
	int passed = 0, node = level->node_count++;
	level->node[node] = member[from];
	march_begin(&march, cloth, from, link_share * level->spacing_m);
	for (int v; (v = march_next(&march, &way_m)) >= 0; passed++) {
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
	return passed;
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

/* s->member_at says of every particle which member of the level it is, s->member the reverse. */
static void begin_level(struct cloth *cloth, struct level *level, float spacing, int member_count)
{
	struct cloth_scratch *s = cloth->scratch;
	int vertices = cloth->garment->vertex_count;
	level->spacing_m = spacing * cloth->garment->edge_m;
	level->node_count = level->link_count = 0;
	level->member_count = member_count;
	memset(s->covered, 0, (size_t)vertices);
	for (int v = 0; v < vertices; v++)
		s->node_at[v] = -1;
	for (int m = 0; m < member_count; m++)
		for (int k = 0; k < SPREAD; k++)
			level->spread[m] = (struct spread){{0}, {1e9f, 1e9f, 1e9f, 1e9f}};
}

/* The nodes are the next level's members. */
static void end_level(struct cloth *cloth, struct level *level)
{
	struct cloth_scratch *s = cloth->scratch;
	weigh(level);
	for (int v = 0; v < cloth->garment->vertex_count; v++) {
		s->member_at[v] = s->node_at[v];
		if (s->node_at[v] >= 0)
			s->member[s->node_at[v]] = v;
	}
}

void cloth_begin_levels(struct cloth *cloth)
{
	struct cloth_scratch *s = cloth->scratch;
	size_t vertices = (size_t)cloth->garment->vertex_count;
	memcpy(s->member, s->ranked, (size_t)s->ranked_count * sizeof *s->member);
	memcpy(s->member_at, s->rank, vertices * sizeof *s->member_at);
	memset(s->way_of, 0, vertices * sizeof *s->way_of);
	s->way_now = 0;
	s->build.level = s->build.member = 0;
	begin_level(cloth, &s->level[0], spacing_edges[0], s->ranked_count);
}

bool cloth_build_levels(struct cloth *cloth, long quota, long *units)
{
	struct cloth_scratch *s = cloth->scratch;
	struct build *build = &s->build;
	while (build->level < LEVELS) {
		struct level *level = &s->level[build->level];
		for (; build->member < level->member_count; build->member++) {
			int particle = s->member[build->member];
			if (s->covered[particle] || level->node_count == LEVEL_NODES_MAX)
				continue;
			if (*units >= quota)
				return false;
			*units += MARCH_UNITS *
				  (long)add_node(cloth, level, particle, s->member_at);
		}
		end_level(cloth, level);
		build->member = 0;
		if (++build->level < LEVELS)
			begin_level(cloth, level + 1, spacing_edges[build->level],
				    level->node_count);
	}
	return true;
}

/* ---- whenever cloth is placed ---- */

/* The slot of a node's particle: the level's members, all the way down. */
static int node_slot(const struct cloth_scratch *s, int l, int node)
{
	for (; l >= 0; l--)
		node = s->level[l].node[node];
	return s->slot[s->ranked[node]];
}

/* Links between placed nodes; what unplaced nodes would have moved stays. */
void cloth_take_levels(struct cloth *cloth)
{
	struct cloth_scratch *s = cloth->scratch;
	for (int l = 0; l < LEVELS; l++) {
		struct level *level = &s->level[l];
		level->taut_count = 0;
		for (int i = 0; i < level->link_count; i++)
			if (node_slot(s, l, level->link[i].a) >= 0 &&
			    node_slot(s, l, level->link[i].b) >= 0)
				level->taut[level->taut_count++] = level->link[i];
		for (int n = 0; n < level->node_count; n++)
			level->start[n] = place_offset(int_max(node_slot(s, l, n), 0));
		memset(level->at, 0, (size_t)level->node_count * sizeof *level->at);
		memset(level->move, 0, (size_t)level->node_count * sizeof *level->move);
	}
	for (int slot = SLOT_FIRST; slot < s->slot_count; slot++)
		s->slot_spread[slot] = s->level[0].spread[s->rank[s->slot_vertex[slot]]];
}

/* ---- in every sweep ---- */

/* Nodes are read and written whole: what was written in parts would have to be waited for. */
static bool limit_link(struct place *at, const struct link *link, float half)
{
	lanes *a = (lanes *)&at[link->a], *b = (lanes *)&at[link->b];
	lanes way = *b - *a;
	float squared = way[0] * way[0] + way[1] * way[1] + way[2] * way[2];
	if (squared <= link->length_m * link->length_m)
		return false;
	float length = sqrtf(squared);
	way *= lanes_of(half * (length - link->length_m) / length);
	*a += way;
	*b -= way;
	return true;
}

static bool limit_links(struct level *level, float share)
{
	bool moved = false;
	for (int i = 0; i < level->taut_count; i++)
		moved |= limit_link(level->at, &level->taut[i], 0.5f * share);
	return moved;
}

static struct place place_sub(struct place a, struct place b)
{
	return (struct place){a.x - b.x, a.y - b.y, a.z - b.z, 0.0f};
}

/* Where a node is before anything moved. */
static struct place node_start(const struct cloth_scratch *s, const struct level *level, int node)
{
	return *(const struct place *)((const char *)s->place + level->start[node]);
}

/* ---- pins ----
 *
 * A pinned particle is no node, but what hangs at it hangs at the nodes round it: on every level
 * the limits may move these only so that it stays. */

_Static_assert(GARMENT_VERTICES_MAX % 8 == 0, "held[] is read eight at a time");

enum { PINNED_MAX = 2 * PINS_MAX, HOLDERS = SPREAD * SPREAD };

struct pinned {
	int count, node[HOLDERS];
	float weight[HOLDERS], squares;
};

static void add_holder(struct pinned *pinned, int node, float weight)
{
	int k = 0;
	while (k < pinned->count && pinned->node[k] != node)
		k++;
	if (weight <= 0.0f || k == HOLDERS)
		return;
	if (k == pinned->count) {
		pinned->count++;
		pinned->node[k] = node;
		pinned->weight[k] = 0.0f;
	}
	pinned->weight[k] += weight;
}

/* The nodes that move a member, each by `weight` of its share. */
static void add_holders(struct pinned *pinned, const struct spread *spread, float weight)
{
	for (int k = 0; k < SPREAD; k++)
		add_holder(pinned, (int)(spread->node[k] / sizeof(struct place)),
			   weight * spread->weight[k]);
}

/* The nodes of level l that move particle v. */
static struct pinned hold(const struct cloth_scratch *s, int v, int l)
{
	struct pinned below, pinned = {.count = 0};
	add_holders(&pinned, &s->level[0].spread[s->rank[v]], 1.0f);
	for (int level = 1; level <= l; level++) {
		below = pinned;
		pinned.count = 0;
		for (int k = 0; k < below.count; k++)
			add_holders(&pinned, &s->level[level].spread[below.node[k]],
				    below.weight[k]);
	}
	for (int k = 0; k < pinned.count; k++)
		pinned.squares += pinned.weight[k] * pinned.weight[k];
	return pinned;
}

/* The least moves of the nodes that take back a share of what they move the particle by. */
static void hold_pinned(const struct cloth_scratch *s, const struct level *level,
			const struct pinned *pinned, float taken)
{
	struct place by = {0.0f, 0.0f, 0.0f, 0.0f};
	for (int k = 0; k < pinned->count; k++) {
		struct place way = place_sub(level->at[pinned->node[k]],
					     node_start(s, level, pinned->node[k]));
		by.x += pinned->weight[k] * way.x;
		by.y += pinned->weight[k] * way.y;
		by.z += pinned->weight[k] * way.z;
	}
	for (int k = 0; k < pinned->count; k++) {
		struct place *at = &level->at[pinned->node[k]];
		float share = taken * pinned->weight[k] / pinned->squares;
		at->x -= share * by.x;
		at->y -= share * by.y;
		at->z -= share * by.z;
	}
}

/* Few are held, if any: eight are looked at together. */
static int find_pinned(const struct cloth *cloth, int *pinned)
{
	const struct cloth_scratch *s = cloth->scratch;
	int count = 0, vertices = cloth->garment->vertex_count;
	for (int first = 0; first < vertices; first += 8) {
		uint64_t eight;
		memcpy(&eight, cloth->held + first, sizeof eight);
		for (int v = first; eight && v < int_min(first + 8, vertices); v++)
			if (count < PINNED_MAX && cloth->held[v] > 1 && is_particle(cloth, v) &&
			    s->at[v] != PLACE_NONE)
				pinned[count++] = v;
	}
	return count;
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
	int pinned[PINNED_MAX];
	struct pinned held[PINNED_MAX];
	if (cloth->settings.reach <= 0.0f)
		return 0;
	int pinned_count = find_pinned(cloth, pinned);
	units += pinned_count;
	for (int l = LEVELS - 1; l >= 0; l--)
		for (int n = 0; n < s->level[l].node_count; n++)
			s->level[l].at[n] = node_start(s, &s->level[l], n);
	for (int l = LEVELS - 1; l >= 0; l--) {
		struct level *level = &s->level[l];
		if (moved)
			kernel_of(cloth->lanes)
				->spread(level->at, s->level[l + 1].spread, level->node_count,
					 s->level[l + 1].move);
		for (int i = 0; i < pinned_count; i++)
			held[i] = hold(s, pinned[i], l);
		for (int pass = 0; pass < LEVEL_PASSES; pass++) {
			moved |= limit_links(level, cloth->settings.reach);
			for (int i = 0; i < pinned_count; i++)
				hold_pinned(s, level, &held[i], cloth->settings.reach);
			units += level->taut_count;
		}
		for (int n = 0; n < level->node_count; n++)
			level->move[n] = place_sub(level->at[n], node_start(s, level, n));
	}
	if (!moved)
		return units;
	crew_run(cloth->crew, spread_moves, cloth, loop_parts(s->slot_count - SLOT_FIRST));
	return units + s->slot_count - SLOT_FIRST;
}
