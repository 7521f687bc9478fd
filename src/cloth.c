#include "cloth_private.h"
#include "cloth_self.h"

enum { FACE_SLICES = 10 }; /* a frame's sweeps: all faces once a frame */

void cloth_init(struct cloth *cloth, struct arena *arena)
{
	memset(cloth, 0, sizeof *cloth);
	cloth->position_m = ARENA_ARRAY(arena, struct v3, GARMENT_VERTICES_MAX);
	cloth->previous_m = ARENA_ARRAY(arena, struct v3, GARMENT_VERTICES_MAX);
	cloth->contact = ARENA_ARRAY(arena, struct contact, GARMENT_VERTICES_MAX);
	cloth->placed = ARENA_ARRAY(arena, uint8_t, GARMENT_VERTICES_MAX);
	cloth->held = ARENA_ARRAY(arena, uint8_t, GARMENT_VERTICES_MAX);
	cloth->creased = ARENA_ARRAY(arena, uint8_t, GARMENT_VERTICES_MAX);
	cloth->goal_m = ARENA_ARRAY(arena, struct v3, GARMENT_VERTICES_MAX);
	cloth->particle = ARENA_ARRAY(arena, int, GARMENT_VERTICES_MAX);
	cloth->triangle = ARENA_ARRAY(arena, struct triangle, GARMENT_TRIANGLES_MAX);
	cloth->flat = ARENA_ARRAY(arena, struct flat, GARMENT_EDGES_MAX);
	cloth->reach = ARENA_ARRAY(arena, struct reach, REACHES_PER_VERTEX * GARMENT_VERTICES_MAX);
	struct cloth_scratch *s = ARENA_ARRAY(arena, struct cloth_scratch, 1);
	s->rest = ARENA_ARRAY(arena, struct rest, GARMENT_TRIANGLES_MAX);
	s->order = ARENA_ARRAY(arena, int, GARMENT_TRIANGLES_MAX);
	s->start_m = ARENA_ARRAY(arena, struct v3, GARMENT_VERTICES_MAX);
	s->edge_first = ARENA_ARRAY(arena, int, GARMENT_VERTICES_MAX + 2);
	s->edge_triangle = ARENA_ARRAY(arena, int, 3 * GARMENT_TRIANGLES_MAX);
	s->rim_first = ARENA_ARRAY(arena, int, PIECES_MAX + 1);
	s->rim = ARENA_ARRAY(arena, int, 3 * GARMENT_TRIANGLES_MAX);
	s->flipped = ARENA_ARRAY(arena, uint8_t, GARMENT_VERTICES_MAX);
	s->ring_first = ARENA_ARRAY(arena, int, GARMENT_VERTICES_MAX + 2);
	s->ring = ARENA_ARRAY(arena, int, 6 * GARMENT_TRIANGLES_MAX);
	s->smooth_m = ARENA_ARRAY(arena, struct v3, GARMENT_VERTICES_MAX);
	s->edge_owner = ARENA_ARRAY(arena, uint8_t, GARMENT_TRIANGLES_MAX);
	s->stiff = ARENA_ARRAY(arena, uint8_t, GARMENT_VERTICES_MAX);
	s->track = ARENA_ARRAY(arena, struct body_track, GARMENT_VERTICES_MAX);
	s->lift_m = ARENA_ARRAY(arena, float, GARMENT_VERTICES_MAX);
	s->slack_m = ARENA_ARRAY(arena, float, GARMENT_VERTICES_MAX);
	cloth->scratch = s;
	cloth->self = cloth_self_init(arena);
	cloth->settings = cloth_settings_worn();
}

struct cloth_settings cloth_settings_worn(void)
{
	return (struct cloth_settings){
		.shape = 0.9f,
		.shape_passes = 1,
		.flatness = 0.02f,
		.reach = 0.7f,
		.momentum = 0.9f,
		.gravity_m = 20e-6f,
		.friction = 0.2f,
		.grip = 0.5f,
		.offset_m = 0.004f,
		.step_max_m = 0.006f,
		.seam_step_m = 0.0005f,
		.faces = true,
		.thickness_m = 0.002f,
	};
}

struct cloth_settings cloth_settings_relax(void)
{
	struct cloth_settings settings = cloth_settings_worn();
	settings.friction = 0.05f;
	settings.grip = 0.05f;
	settings.flatness = 0.06f;
	settings.shape_passes = 2;
	return settings;
}

void cloth_reset(struct cloth *cloth, const struct garment *garment, const struct body *body)
{
	cloth->garment = garment;
	cloth->body = body;
	cloth->welded = false;
	cloth->worn = false;
	cloth->sweep = 0;
	cloth->flat_count = 0;
	cloth->reach_count = 0;
	cloth->settings = cloth_settings_worn();
	memset(cloth->placed, 0, GARMENT_VERTICES_MAX);
	memset(cloth->held, 0, GARMENT_VERTICES_MAX);
	memset(cloth->creased, 0, GARMENT_VERTICES_MAX);
	memset(cloth->piece_parts, 0, sizeof cloth->piece_parts);
	memset(cloth->piece_drawn, 0, sizeof cloth->piece_drawn);
	memset(cloth->scratch->stiff, 0, GARMENT_VERTICES_MAX);
	memset(cloth->scratch->lift_m, 0, GARMENT_VERTICES_MAX * sizeof(float));
	memset(cloth->scratch->slack_m, 0, GARMENT_VERTICES_MAX * sizeof(float));
	if (!garment)
		return;
	for (int v = 0; v < garment->vertex_count; v++)
		cloth->contact[v] = (struct contact){.triangle = -1};
	cloth_build(cloth);
	cloth_build_reach(cloth);
}

void cloth_finish(struct cloth *cloth)
{
	for (int v = 0; cloth->welded && v < cloth->garment->vertex_count; v++) {
		int particle = cloth->particle[v];
		cloth->position_m[v] = cloth->position_m[particle];
		cloth->previous_m[v] = cloth->previous_m[particle];
		cloth->contact[v] = cloth->contact[particle];
		cloth->placed[v] = cloth->placed[particle];
	}
}

/* Sums in vertex order, so that the mean has the same bits everywhere. */
void cloth_weld(struct cloth *cloth)
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
	cloth->welded = true;
	cloth_build(cloth);
	cloth_finish(cloth);
}

void cloth_restore(struct cloth *cloth, const struct garment *garment, const struct body *body,
		   const struct v3 *position_m, const uint8_t *placed, bool welded, bool worn)
{
	cloth_reset(cloth, garment, body);
	memcpy(cloth->position_m, position_m, (size_t)garment->vertex_count * sizeof *position_m);
	memcpy(cloth->previous_m, position_m, (size_t)garment->vertex_count * sizeof *position_m);
	memcpy(cloth->placed, placed, (size_t)garment->vertex_count);
	cloth->worn = worn;
	cloth->welded = welded;
	if (welded)
		cloth_build(cloth);
	for (int v = 0; v < garment->vertex_count; v++)
		if (is_particle(cloth, v))
			cloth_look(cloth, v);
	cloth_finish(cloth);
}

/* ---- one sweep ---- */

/* Momentum, gravity and the pull of a far body. */
static void predict(struct cloth *cloth)
{
	const struct cloth_settings *set = &cloth->settings;
	for (int v = 0; v < cloth->garment->vertex_count; v++) {
		if (!is_particle(cloth, v))
			continue;
		struct v3 *p = &cloth->position_m[v];
		cloth->scratch->start_m[v] = *p;
		struct v3 step = v3_scale(v3_sub(*p, cloth->previous_m[v]), set->momentum);
		float length = v3_length(step);
		if (length > set->step_max_m)
			step = v3_scale(step, set->step_max_m / length);
		*p = v3_add(*p, step);
		p->y -= set->gravity_m;
		const struct contact *contact = &cloth->contact[v];
		if (set->attract_m > 0.0f && cloth->piece_drawn[cloth->garment->piece[v]] &&
		    contact->triangle >= 0 && contact->distance_m > 0.035f)
			*p = v3_mad(*p, contact->normal, -set->attract_m);
	}
}

/* Both sides of a seam go half the way towards each other, at most seam_step_m in a sweep. */
static long close_seams(struct cloth *cloth)
{
	float most = cloth->settings.seam_step_m;
	if (cloth->welded || most <= 0.0f)
		return 0;
	for (int i = 0; i < cloth->garment->pair_count; i++) {
		int a = cloth->garment->pair[i].a, b = cloth->garment->pair[i].b;
		if (a == b || !cloth->placed[a] || !cloth->placed[b])
			continue;
		struct v3 half = v3_scale(v3_sub(cloth->position_m[b], cloth->position_m[a]), 0.5f);
		float length = v3_length(half);
		if (length > most)
			half = v3_scale(half, most / length);
		cloth->position_m[a] = v3_add(cloth->position_m[a], half);
		cloth->position_m[b] = v3_sub(cloth->position_m[b], half);
	}
	return cloth->garment->pair_count;
}

static void pull_held(struct cloth *cloth)
{
	for (int v = 0; v < cloth->garment->vertex_count; v++)
		if (cloth->held[v] && is_particle(cloth, v))
			cloth->position_m[v] = v3_lerp(cloth->position_m[v], cloth->goal_m[v],
						       cloth->held[v] > 1 ? 0.9f : 0.5f);
}

/* No particle goes farther than step_max_m in a sweep, so that none can pass through a limb. */
static void bound_steps(struct cloth *cloth)
{
	float most = cloth->settings.step_max_m;
	for (int v = 0; v < cloth->garment->vertex_count; v++) {
		if (!is_particle(cloth, v))
			continue;
		struct v3 start = cloth->scratch->start_m[v];
		struct v3 step = v3_sub(cloth->position_m[v], start);
		float length = v3_length(step);
		if (length > most)
			cloth->position_m[v] = v3_mad(start, step, most / length);
	}
}

static void remember(struct cloth *cloth)
{
	for (int v = 0; v < cloth->garment->vertex_count; v++)
		if (is_particle(cloth, v))
			cloth->previous_m[v] = cloth->scratch->start_m[v];
}

long cloth_sweep(struct cloth *cloth)
{
	long units = cloth->garment->vertex_count;
	predict(cloth);
	units += close_seams(cloth);
	units += cloth_reach(cloth);
	units += cloth_shape(cloth);
	units += cloth_flatten(cloth);
	pull_held(cloth);
	units += cloth_self(cloth);
	bound_steps(cloth);
	if (cloth->settings.faces)
		units += cloth_contact_faces(cloth, cloth->sweep % FACE_SLICES, FACE_SLICES);
	units += cloth_contact(cloth);
	remember(cloth);
	cloth->sweep++;
	return units;
}
