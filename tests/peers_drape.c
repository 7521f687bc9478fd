/* A frame's price on a poncho: ours against Bullet's, from two thousand to fifty thousand vertices,
 * and the kernels on it. */
#include "cloth_private.h"
#include "peers_poncho.h"
#include "peers_rows.h"
#include "processor.h"

#include <stdio.h>
#include <stdlib.h>

enum { SIZES = 3, PEER_SIZES = 2, LAPS = 40, RUNS = 2 };

static const int vertices_wanted[SIZES] = {2056, 10104, 49608};

static void time_frames(struct drape *drape)
{
	drape->mean_ms = drape->worst_ms = drape->self_mean_ms = 0.0;
	for (int f = 1; f < DRAPE_FRAMES; f++) {
		drape->self_mean_ms += drape->self_ms[f] / (DRAPE_FRAMES - 1);
		drape->mean_ms += drape->ms[f] / (DRAPE_FRAMES - 1);
		drape->worst_ms = drape->ms[f] > drape->worst_ms ? drape->ms[f] : drape->worst_ms;
	}
}

/* Both repeat themselves to the bit, so the least of several runs is the frame without what else
 * the machine did. */
static void keep_least(struct drape *kept, const struct drape *run, bool first)
{
	if (first)
		*kept = *run;
	for (int f = 0; f < DRAPE_FRAMES; f++) {
		kept->ms[f] = run->ms[f] < kept->ms[f] ? run->ms[f] : kept->ms[f];
		kept->self_ms[f] = run->self_ms[f] < kept->self_ms[f] ? run->self_ms[f]
								      : kept->self_ms[f];
	}
}

static void measure(const struct peers_cloth *flat, const struct peers_cloth *end,
		    struct drape *drape)
{
	double sum = 0.0, most = 0.0;
	for (int t = 0; t < flat->triangle_count; t++)
		for (int k = 0; k < 3; k++) {
			int a = flat->triangle[t].v[k], b = flat->triangle[t].v[(k + 1) % 3];
			float rest = v3_distance(flat->position_m[a], flat->position_m[b]);
			float now = v3_distance(end->position_m[a], end->position_m[b]);
			double stretch = (double)float_max(now / rest - 1.0f, 0.0f);
			sum += stretch;
			most = stretch > most ? stretch : most;
		}
	drape->stretch_mean = sum / (3 * flat->triangle_count);
	drape->stretch_max = most;
	drape->low_m = drape->high_m = end->position_m[0].y;
	for (int v = 1; v < end->vertex_count; v++) {
		drape->low_m = float_min(drape->low_m, end->position_m[v].y);
		drape->high_m = float_max(drape->high_m, end->position_m[v].y);
	}
}

static void add(int vertices, const char *what, const char *unit, double figure, double target,
		const char *peer, double peer_figure, double ratio_target)
{
	struct peers_row row = {.unit = unit,
				.figure = figure,
				.target = target,
				.peer = peer,
				.peer_figure = peer_figure,
				.ratio_target = ratio_target};
	snprintf(row.what, sizeof row.what, "%d vertices: %s", vertices, what);
	peers_add(&row);
}

static void add_rows(int vertices, const struct drape *own, const struct drape *bullet)
{
	const struct drape none = {0}, *peer = bullet ? bullet : &none;
	const char *name = bullet ? "Bullet" : NULL;
	add(vertices, "frame", "ms", own->mean_ms, NO_TARGET, name, peer->mean_ms, 10.0);
	add(vertices, "worst frame", "means", own->worst_ms / own->mean_ms, 1.5, name,
	    peer->worst_ms / peer->mean_ms, NO_TARGET);
	add(vertices, "and cloth against cloth", "ms", own->self_mean_ms, NO_TARGET, NULL, 0.0,
	    NO_TARGET);
	add(vertices, "mean stretch at rest", "%", 100.0 * own->stretch_mean, 1.0, name,
	    100.0 * peer->stretch_mean, NO_TARGET);
	add(vertices, "largest stretch at rest", "%", 100.0 * own->stretch_max, 15.0, name,
	    100.0 * peer->stretch_max, NO_TARGET);
	add(vertices, "lowest point at rest", "m", (double)own->low_m, NO_TARGET, name,
	    (double)peer->low_m, NO_TARGET);
	if (bullet && bullet->high_m < 1.2f)
		fprintf(stderr, "peers: Bullet's poncho has fallen off\n");
}

static double least(double ms, double start)
{
	double now = peers_ms() - start;
	return now < ms ? now : ms;
}

/* Projections a second of the loops that a sweep spends most on, in their quickest lap. */
static void kernels(struct cloth *cloth, int lanes, double shape_target, double flat_target)
{
	struct cloth_scratch *s = cloth->scratch;
	const struct kernel *kernel = kernel_of(lanes);
	double shape_ms = 1e9, flat_ms = 1e9;
	for (int lap = 0; lap < LAPS; lap++) {
		double start = peers_ms();
		kernel->shape(s->place, s->shape, NULL, s->shape_first[GROUPS_MAX], 0.9f, 1.0f,
			      false);
		shape_ms = least(shape_ms, start);
		start = peers_ms();
		kernel->flatten(s->place, s->bends, NULL, s->bends_first[GROUPS_MAX], 0.02f, false);
		flat_ms = least(flat_ms, start);
	}
	struct peers_row row = {.unit = "M/s",
				.better = MORE,
				.target = shape_target,
				.figure = 1e-3 * cloth->garment->triangle_count / shape_ms};
	snprintf(row.what, sizeof row.what, "triangle projections, %d lanes", lanes);
	peers_add(&row);
	row.target = flat_target;
	row.figure = 1e-3 * cloth->flat_count / flat_ms;
	snprintf(row.what, sizeof row.what, "flatness projections, %d lanes", lanes);
	peers_add(&row);
}

static bool drape_peer(const struct session *session, const struct peers_body *body,
		       struct peers_cloth *end, struct drape *best)
{
	static struct drape again;
	for (int run = 0; run < RUNS; run++) {
		poncho_free(end);
		poncho_take(session, end);
		if (!peer_bullet_drape(body, end, &again))
			return false;
		keep_least(best, &again, run == 0);
	}
	return true;
}

static void drape_own(struct session *session, int vertices, int runs, struct peers_cloth *end,
		      struct drape *best)
{
	static struct drape again;
	for (int run = 0; run < runs; run++) {
		poncho_lay(session, vertices);
		poncho_fall(session, &again);
		keep_least(best, &again, run == 0);
	}
	poncho_take(session, end);
}

/* Nanoseconds a vertex and frame. */
static double drape_size(struct session *session, const struct peers_body *body, int size,
			 bool with_peers)
{
	static struct drape own, bullet;
	struct peers_cloth flat = {0}, end = {0}, peer = {0};
	poncho_lay(session, vertices_wanted[size]);
	poncho_take(session, &flat);
	bool peers = with_peers && size < PEER_SIZES && drape_peer(session, body, &peer, &bullet);
	drape_own(session, vertices_wanted[size], size < PEER_SIZES ? RUNS : 1, &end, &own);
	time_frames(&own);
	measure(&flat, &end, &own);
	if (peers) {
		time_frames(&bullet);
		measure(&flat, &peer, &bullet);
	}
	add_rows(flat.vertex_count, &own, peers ? &bullet : NULL);
	double ns = 1e6 * own.mean_ms / flat.vertex_count;
	if (size == 1) {
		if (processor_lanes() == 8)
			kernels(&session->cloth, 8, 150.0, 250.0);
		kernels(&session->cloth, 4, 60.0, 120.0);
	}
	poncho_free(&flat);
	poncho_free(&end);
	poncho_free(&peer);
	return ns;
}

void peers_drapes(const struct peers_body *body, bool with_peers)
{
	struct arena arena;
	struct session *session = calloc(1, sizeof *session);
	void *memory = malloc(KIOSK_MEMORY_BYTES);
	MUST(session && memory);
	arena_init(&arena, memory, KIOSK_MEMORY_BYTES);
	session_init(session, &arena);
	session->cloth.lanes = processor_lanes();
	session->budget_units = 1L << 40; /* always ten sweeps */
	MUST(!body_build(&session->body, body->position_m, body->vertex_count, body->triangle,
			 body->triangle_count));
	body_find_parts(&session->body);
	double least = 1e9, most = 0.0;
	for (int size = 0; size < SIZES; size++) {
		double ns = drape_size(session, body, size, with_peers);
		least = ns < least ? ns : least;
		most = ns > most ? ns : most;
	}
	struct peers_row row = {.what = "price of a vertex, dearest over cheapest",
				.unit = "times",
				.figure = most / least,
				.target = 1.5};
	peers_add(&row);
	free(session);
	free(memory);
}
