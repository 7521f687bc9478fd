#include "cloth_private.h"
#include "cloth_refine.h"
#include "cloth_self.h"
#include "fabric.h"

static const float far_m = 0.035f; /* a body farther than this pulls drawn pieces */
static const float blown_m = 0.1f; /* cloth nearer than this is inflated */

static void init_order(struct cloth_scratch *s, struct arena *arena)
{
	s->ranked = ARENA_ARRAY(arena, int, GARMENT_VERTICES_MAX);
	s->rank = ARENA_ARRAY(arena, int, GARMENT_VERTICES_MAX);
	s->triangles.item = ARENA_ARRAY(arena, int, GARMENT_TRIANGLES_MAX);
	s->face = ARENA_ARRAY(arena, int, GARMENT_TRIANGLES_MAX);
	s->flats.item = ARENA_ARRAY(arena, int, GARMENT_EDGES_MAX);
	s->sorted = ARENA_ARRAY(arena, int, GARMENT_EDGES_MAX);
	s->taken = ARENA_ARRAY(arena, uint64_t, GARMENT_VERTICES_MAX);
	s->key = ARENA_ARRAY(arena, uint16_t, GARMENT_EDGES_MAX);
	s->taken_placed = ARENA_ARRAY(arena, uint8_t, GARMENT_VERTICES_MAX);
	s->slot = ARENA_ARRAY(arena, int, GARMENT_VERTICES_MAX);
	s->slot_vertex = ARENA_ARRAY(arena, int, SLOT_FIRST + GARMENT_VERTICES_MAX);
	s->at = ARENA_ARRAY(arena, uint32_t, GARMENT_VERTICES_MAX + BATCH);
	s->whole = ARENA_ARRAY(arena, uint8_t, GARMENT_VERTICES_MAX / BATCH + 1);
	s->place = ARENA_ARRAY(arena, struct place, SLOT_FIRST + GARMENT_VERTICES_MAX);
	s->shape = ARENA_ARRAY(arena, struct shape_batch, SHAPE_BATCHES_MAX);
	s->grain = ARENA_ARRAY(arena, struct shape_grain, SHAPE_BATCHES_MAX);
	s->bends = ARENA_ARRAY(arena, struct bends, BENDS_MAX);
	s->firm = ARENA_ARRAY(arena, struct firm, BENDS_MAX);
}

static void init_levels(struct cloth_scratch *s, struct arena *arena)
{
	int members = GARMENT_VERTICES_MAX;
	for (int l = 0; l < LEVELS; l++) {
		struct level *level = &s->level[l];
		level->spread = ARENA_ARRAY(arena, struct spread, members);
		level->node = ARENA_ARRAY(arena, int, LEVEL_NODES_MAX);
		level->link = ARENA_ARRAY(arena, struct link, LEVEL_LINKS_MAX);
		level->taut = ARENA_ARRAY(arena, struct link, LEVEL_LINKS_MAX);
		level->start = ARENA_ARRAY(arena, uint32_t, LEVEL_NODES_MAX);
		level->at = ARENA_ARRAY(arena, struct place, LEVEL_NODES_MAX);
		level->move = ARENA_ARRAY(arena, struct place, LEVEL_NODES_MAX);
		members = LEVEL_NODES_MAX;
	}
	s->slot_spread = ARENA_ARRAY(arena, struct spread, SLOT_FIRST + GARMENT_VERTICES_MAX);
	s->member = ARENA_ARRAY(arena, int, GARMENT_VERTICES_MAX);
	s->member_at = ARENA_ARRAY(arena, int, GARMENT_VERTICES_MAX);
	s->node_at = ARENA_ARRAY(arena, int, GARMENT_VERTICES_MAX);
	s->covered = ARENA_ARRAY(arena, uint8_t, GARMENT_VERTICES_MAX);
	s->way_m = ARENA_ARRAY(arena, float, GARMENT_VERTICES_MAX);
	s->way_of = ARENA_ARRAY(arena, int, GARMENT_VERTICES_MAX);
	s->heap = ARENA_ARRAY(arena, uint64_t, GARMENT_VERTICES_MAX);
	s->aside = ARENA_ARRAY(arena, struct aside, 6 * GARMENT_TRIANGLES_MAX);
	s->heap_at = ARENA_ARRAY(arena, int, GARMENT_VERTICES_MAX);
}

void cloth_init(struct cloth *cloth, struct arena *arena)
{
	memset(cloth, 0, sizeof *cloth);
	/* and those that would fill up the last batch */
	cloth->position_m = ARENA_ARRAY(arena, struct v3, GARMENT_VERTICES_MAX + BATCH);
	cloth->previous_m = ARENA_ARRAY(arena, struct v3, GARMENT_VERTICES_MAX + BATCH);
	cloth->contact = ARENA_ARRAY(arena, struct contact, GARMENT_VERTICES_MAX);
	cloth->placed = ARENA_ARRAY(arena, uint8_t, GARMENT_VERTICES_MAX);
	cloth->held = ARENA_ARRAY(arena, uint8_t, GARMENT_VERTICES_MAX);
	cloth->creased = ARENA_ARRAY(arena, uint8_t, GARMENT_VERTICES_MAX);
	cloth->goal_m = ARENA_ARRAY(arena, struct v3, GARMENT_VERTICES_MAX);
	cloth->particle = ARENA_ARRAY(arena, int, GARMENT_VERTICES_MAX);
	cloth->triangle = ARENA_ARRAY(arena, struct triangle, GARMENT_TRIANGLES_MAX);
	cloth->star_first = ARENA_ARRAY(arena, int, GARMENT_VERTICES_MAX + 2);
	cloth->star = ARENA_ARRAY(arena, int, 3 * GARMENT_TRIANGLES_MAX);
	cloth->ring = ARENA_ARRAY(arena, int, 6 * GARMENT_TRIANGLES_MAX);
	cloth->flat = ARENA_ARRAY(arena, struct flat, GARMENT_EDGES_MAX);
	struct cloth_scratch *s = ARENA_ARRAY(arena, struct cloth_scratch, 1);
	s->rest = ARENA_ARRAY(arena, struct rest, GARMENT_TRIANGLES_MAX);
	s->squeeze = ARENA_ARRAY(arena, struct squeeze, GARMENT_VERTICES_MAX);
	s->turn = ARENA_ARRAY(arena, struct turn, GARMENT_TRIANGLES_MAX);
	s->edge_first = ARENA_ARRAY(arena, int, GARMENT_VERTICES_MAX + 2);
	s->edge_triangle = ARENA_ARRAY(arena, int, 3 * GARMENT_TRIANGLES_MAX);
	s->flipped = ARENA_ARRAY(arena, uint8_t, GARMENT_VERTICES_MAX);
	s->smooth_m = ARENA_ARRAY(arena, struct v3, GARMENT_VERTICES_MAX);
	s->across = ARENA_ARRAY(arena, int, 3 * GARMENT_TRIANGLES_MAX);
	s->facing = ARENA_ARRAY(arena, uint8_t, GARMENT_TRIANGLES_MAX);
	s->taut = ARENA_ARRAY(arena, int, GARMENT_TRIANGLES_MAX);
	s->clamped = ARENA_ARRAY(arena, int, GARMENT_TRIANGLES_MAX);
	s->turned = ARENA_ARRAY(arena, uint8_t, GARMENT_TRIANGLES_MAX);
	s->in_patch = ARENA_ARRAY(arena, uint8_t, GARMENT_TRIANGLES_MAX);
	s->patch = ARENA_ARRAY(arena, int, GARMENT_TRIANGLES_MAX);
	s->swung = ARENA_ARRAY(arena, int, GARMENT_VERTICES_MAX);
	s->swung_in = ARENA_ARRAY(arena, int, GARMENT_VERTICES_MAX);
	s->hinge = ARENA_ARRAY(arena, int, HINGES_MAX);
	s->edge_owner = ARENA_ARRAY(arena, uint8_t, GARMENT_TRIANGLES_MAX);
	s->stiff = ARENA_ARRAY(arena, uint8_t, GARMENT_VERTICES_MAX);
	s->track = ARENA_ARRAY(arena, struct body_track, GARMENT_VERTICES_MAX);
	s->quiet = ARENA_ARRAY(arena, struct quiet, GARMENT_VERTICES_MAX + BATCH);
	s->face_quiet = ARENA_ARRAY(arena, struct face_quiet, GARMENT_TRIANGLES_MAX);
	s->lift_m = ARENA_ARRAY(arena, float, GARMENT_VERTICES_MAX);
	s->lift_way = ARENA_ARRAY(arena, struct v3, GARMENT_VERTICES_MAX);
	s->slack_m = ARENA_ARRAY(arena, float, GARMENT_VERTICES_MAX);
	init_order(s, arena);
	init_levels(s, arena);
	cloth->scratch = s;
	cloth->self = cloth_self_init(arena);
	cloth->refine = cloth_refine_init(arena);
	cloth->lanes = 4;
	cloth->settings = cloth_settings_worn();
}

struct cloth_settings cloth_settings_worn(void)
{
	return (struct cloth_settings){
		.shape = 0.9f,
		.shape_passes = 2,
		.flatness = 0.02f,
		.shear = 1.0f,
		.reach = 1.0f,
		.strain_bound = 0.15f,
		.momentum = 0.9f,
		.gravity_m = 20e-6f,
		.friction = 0.2f,
		.grip = 0.5f,
		.offset_m = 0.004f,
		.step_max_m = 0.006f,
		.seam_step_m = 0.0005f,
		.faces = true,
		.open = true,
		.thickness_m = 0.002f,
	};
}

struct cloth_settings cloth_settings_relax(void)
{
	struct cloth_settings settings = cloth_settings_worn();
	settings.friction = 0.05f;
	settings.grip = 0.05f;
	settings.flatness = 0.06f;
	settings.shape_passes = 3;
	return settings;
}

/* Nothing placed, not welded. */
static void clear(struct cloth *cloth, const struct garment *garment, const struct body *body)
{
	cloth->garment = garment;
	cloth->body = body;
	cloth->welded = cloth->apart = false;
	cloth->worn = false;
	cloth->sweep = 0;
	cloth->settings = cloth_settings_worn();
	memset(cloth->placed, 0, GARMENT_VERTICES_MAX);
	memset(cloth->held, 0, GARMENT_VERTICES_MAX);
	memset(cloth->creased, 0, GARMENT_VERTICES_MAX);
	memset(cloth->piece_parts, 0, sizeof cloth->piece_parts);
	memset(cloth->piece_drawn, 0, sizeof cloth->piece_drawn);
	memset(cloth->piece_blown, 0, sizeof cloth->piece_blown);
	for (int p = 0; p < PIECES_MAX; p++)
		cloth->piece_gather[p] = (struct gather){{0.0f, 1.0f}, 0.0f, 1.0f};
	memset(cloth->piece_wide, 0, sizeof cloth->piece_wide);
	memset(cloth->scratch->stiff, 0, GARMENT_VERTICES_MAX);
	memset(cloth->scratch->lift_m, 0, GARMENT_VERTICES_MAX * sizeof(float));
	memset(cloth->scratch->lift_way, 0, GARMENT_VERTICES_MAX * sizeof(struct v3));
	memset(cloth->scratch->slack_m, 0, GARMENT_VERTICES_MAX * sizeof(float));
	memset(cloth->scratch->quiet, 0, GARMENT_VERTICES_MAX * sizeof(struct quiet));
	for (int v = 0; garment && v < garment->vertex_count; v++)
		cloth->contact[v] = (struct contact){.triangle = -1};
}

void cloth_start(struct cloth *cloth, const struct garment *garment, const struct body *body)
{
	clear(cloth, garment, body);
	if (garment)
		cloth_build_begin(cloth);
}

void cloth_reset(struct cloth *cloth, const struct garment *garment, const struct body *body)
{
	clear(cloth, garment, body);
	if (garment)
		cloth_build(cloth);
}

void cloth_finish(struct cloth *cloth)
{
	for (int v = 0; cloth->welded && !cloth->apart && v < cloth->garment->vertex_count; v++) {
		int particle = cloth->particle[v];
		cloth->position_m[v] = cloth->position_m[particle];
		cloth->previous_m[v] = cloth->previous_m[particle];
		cloth->contact[v] = cloth->contact[particle];
		cloth->placed[v] = cloth->placed[particle];
	}
}

/* Sums in vertex order, so that the mean has the same bits everywhere. */
void cloth_join(struct cloth *cloth)
{
	const struct garment *garment = cloth->garment;
	struct v3 *sum = cloth->scratch->smooth_m;
	int *count = cloth->scratch->edge_triangle;
	memset(sum, 0, (size_t)garment->vertex_count * sizeof *sum);
	memset(count, 0, (size_t)garment->vertex_count * sizeof *count);
	for (int v = 0; v < garment->vertex_count; v++) {
		if (!cloth->placed[v])
			continue;
		sum[garment->weld[v]] = v3_add(sum[garment->weld[v]], cloth->position_m[v]);
		count[garment->weld[v]]++;
	}
	for (int v = 0; v < garment->vertex_count; v++) {
		int particle = garment->weld[v];
		if (count[particle] > 0)
			cloth->position_m[v] = v3_scale(sum[particle],
							1.0f / (float)count[particle]);
		cloth->placed[v] = count[particle] > 0;
		cloth->previous_m[v] = cloth->position_m[v];
	}
	cloth->apart = false;
	cloth_finish(cloth);
}

void cloth_sew(struct cloth *cloth)
{
	cloth->welded = cloth->apart = true;
	cloth_build_begin(cloth);
}

void cloth_weld(struct cloth *cloth)
{
	cloth->welded = true;
	cloth_build(cloth);
	cloth_join(cloth);
}

void cloth_restore(struct cloth *cloth, const struct garment *garment, const struct body *body,
		   const struct v3 *position_m, const uint8_t *placed, bool welded, bool worn)
{
	clear(cloth, garment, body);
	memcpy(cloth->position_m, position_m, (size_t)garment->vertex_count * sizeof *position_m);
	memcpy(cloth->previous_m, position_m, (size_t)garment->vertex_count * sizeof *position_m);
	memcpy(cloth->placed, placed, (size_t)garment->vertex_count);
	cloth->worn = worn;
	cloth->welded = welded;
	cloth_build(cloth);
	for (int v = 0; v < garment->vertex_count; v++)
		if (is_particle(cloth, v))
			cloth_look(cloth, v);
	cloth_finish(cloth);
}

/* ---- one sweep ----
 *
 * The particles that are placed move as `place`s (cloth_kernel.h), up to contact, which works on
 * the public arrays. */

static struct v3 place_v3(const struct place *place)
{
	return (struct v3){place->x, place->y, place->z};
}

static void put_place(struct place *place, struct v3 p)
{
	*place = (struct place){p.x, p.y, p.z, 0.0f};
}

static struct particles particles_of(const struct cloth *cloth)
{
	const struct cloth_scratch *s = cloth->scratch;
	return (struct particles){s->at, s->whole, cloth->position_m, cloth->previous_m};
}

static void for_all_vertices(struct cloth *cloth, crew_task *task)
{
	crew_run(cloth->crew, task, cloth, loop_parts(cloth->garment->vertex_count));
}

/* A far body pulls drawn pieces; a near one pushes blown ones away. */
static void drive(struct cloth *cloth, struct loop_part loop)
{
	struct cloth_scratch *s = cloth->scratch;
	const struct cloth_settings *set = &cloth->settings;
	for (int v = loop.first; v < loop.first + loop.count; v++) {
		const struct contact *contact = &cloth->contact[v];
		int piece = cloth->garment->piece[v];
		bool near = contact->distance_m <= blown_m;
		float out_m = near && cloth->piece_blown[piece] ? set->inflate_m : 0.0f;
		if (contact->distance_m > far_m && cloth->piece_drawn[piece])
			out_m -= set->attract_m;
		if (out_m == 0.0f || s->at[v] == PLACE_NONE || contact->triangle < 0)
			continue;
		struct place *place = &s->place[s->slot[v]];
		put_place(place, v3_mad(place_v3(place), contact->normal, out_m));
	}
}

/* Momentum, gravity, and what a body does at a distance. */
static void predict(void *context, int part)
{
	struct cloth *cloth = context;
	const struct cloth_settings *set = &cloth->settings;
	struct loop_part loop = loop_part(cloth->garment->vertex_count, part);
	struct particles particles = particles_of(cloth);
	kernel_of(cloth->lanes)
		->predict(cloth->scratch->place, &particles, loop.first, loop.count, set->momentum,
			  set->step_max_m, set->gravity_m);
	if (set->attract_m > 0.0f || set->inflate_m > 0.0f)
		drive(cloth, loop);
}

/* Both sides of a seam go half the way towards each other, at most seam_step_m in a sweep. */
static long close_seams(struct cloth *cloth)
{
	struct cloth_scratch *s = cloth->scratch;
	float most = cloth->settings.seam_step_m;
	if (cloth->welded || most <= 0.0f)
		return 0;
	for (int i = 0; i < cloth->garment->pair_count; i++) {
		const struct seam_pair *pair = &cloth->garment->pair[i];
		if (pair->a == pair->b || s->slot[pair->a] < 0 || s->slot[pair->b] < 0)
			continue;
		struct place *a = &s->place[s->slot[pair->a]], *b = &s->place[s->slot[pair->b]];
		struct v3 half = v3_scale(v3_sub(place_v3(b), place_v3(a)), 0.5f);
		float length = v3_length(half);
		if (length > most)
			half = v3_scale(half, most / length);
		put_place(a, v3_add(place_v3(a), half));
		put_place(b, v3_sub(place_v3(b), half));
	}
	return cloth->garment->pair_count;
}

static bool any_held(const struct cloth *cloth, struct loop_part loop)
{
	uint8_t any = 0;
	for (int v = loop.first; v < loop.first + loop.count; v++)
		any |= cloth->held[v];
	return any;
}

/* Held particles go to their goals. */
static void pull_held(struct cloth *cloth, struct loop_part loop)
{
	struct cloth_scratch *s = cloth->scratch;
	for (int v = loop.first; v < loop.first + loop.count; v++) {
		if (!cloth->held[v] || s->at[v] == PLACE_NONE)
			continue;
		struct place *place = &s->place[s->slot[v]];
		float share = cloth->held[v] > 1 ? 0.9f : 0.5f;
		put_place(place, v3_lerp(place_v3(place), cloth->goal_m[v], share));
	}
}

/* Into the public arrays again. */
static void put_back(void *context, int part)
{
	struct cloth *cloth = context;
	struct loop_part loop = loop_part(cloth->garment->vertex_count, part);
	struct particles particles = particles_of(cloth);
	if (any_held(cloth, loop))
		pull_held(cloth, loop);
	kernel_of(cloth->lanes)
		->put_back(cloth->scratch->place, &particles, loop.first, loop.count);
}

/* No particle goes farther than step_max_m in a sweep, so that none can pass through a limb. */
static void bound_steps(void *context, int part)
{
	struct cloth *cloth = context;
	struct loop_part loop = loop_part(cloth->garment->vertex_count, part);
	struct particles particles = particles_of(cloth);
	kernel_of(cloth->lanes)
		->bound(&particles, loop.first, loop.count, cloth->settings.step_max_m);
}

static long sweep(struct cloth *cloth)
{
	long units = cloth->garment->vertex_count;
	MUST(cloth->built);
	cloth_take(cloth);
	for_all_vertices(cloth, predict);
	units += close_seams(cloth);
	units += cloth_levels(cloth);
	units += cloth_shape(cloth);
	for_all_vertices(cloth, put_back);
	if (cloth->settings.open)
		units += cloth_hinges(cloth);
	units += cloth_self(cloth);
	for_all_vertices(cloth, bound_steps);
	if (cloth->settings.faces)
		units += cloth_contact_faces(cloth, cloth->sweep % SLICES, SLICES);
	units += cloth_contact(cloth);
	units += cloth_clamp(cloth);
	units += cloth_self_order(cloth);
	cloth->sweep++;
	return units;
}

/* A wrap is the same for every fabric; worn cloth shows what it is made of. */
long cloth_sweep(struct cloth *cloth)
{
	struct cloth_settings stage = cloth->settings;
	if (cloth->worn)
		cloth->settings = fabric_settings(&stage, cloth->fabric);
	long units = sweep(cloth);
	cloth->settings = stage;
	return units;
}
