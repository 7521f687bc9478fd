/* The nearest surface of points that move with the body: ours with its repair, against Embree. */
#include "body.h"
#include "peers_rows.h"

#include <stdio.h>
#include <stdlib.h>

enum { POINTS = 10000, FRAMES = 60, QUERIES = POINTS * FRAMES };

static const float shell_m = 0.02f, step_m = 0.003f, turn_rad = PI_F / 180.0f;

struct tracks {
	struct body body;
	struct v3 *point_m; /* frame after frame */
	float *exact_m, *own_m, *embree_m;
};

static struct v3 random_way(struct scatter *scatter)
{
	struct v3 way = {(float)(scatter_below(scatter, 2001) - 1000),
			 (float)(scatter_below(scatter, 2001) - 1000),
			 (float)(scatter_below(scatter, 2001) - 1000)};
	return v3_normalize(way);
}

/* A turn by a degree about the vertical, a step of 3 mm anywhere, and back to the outermost 2 cm
 * above the body, where cloth is. */
static struct v3 move(struct tracks *tracks, struct v3 p, struct scatter *scatter, float *exact_m)
{
	float c = angle_cos(turn_rad), s = angle_sin(turn_rad);
	struct v3 q = {c * p.x + s * p.z, p.y, c * p.z - s * p.x};
	struct body_hit hit;
	q = v3_mad(q, random_way(scatter), step_m);
	body_nearest(&tracks->body, q, 0, &hit);
	if (hit.distance_m < 0.0f || hit.distance_m > shell_m) {
		float height = float_clamp(-hit.distance_m, 0.0f, shell_m);
		q = v3_lerp(hit.point_m, q,
			    (hit.distance_m > 0.0f ? shell_m : -height) /
				    float_abs(hit.distance_m));
		body_nearest(&tracks->body, q, 0, &hit);
	}
	*exact_m = float_abs(hit.distance_m);
	return q;
}

/* Points in the order of the body's triangles: neighbours come together, as in cloth. */
static void make_points(struct tracks *tracks)
{
	const struct body *body = &tracks->body;
	struct scatter scatter = {20260101u};
	for (int i = 0; i < POINTS; i++) {
		const int *v = body->triangle[(long)i * body->triangle_count / POINTS].v;
		tracks->point_m[i] = v3_mad(body->position_m[v[0]], body->normal[v[0]],
					    shell_m * (float)scatter_below(&scatter, 1000) / 1e3f);
	}
	for (int i = 0; i < QUERIES; i++) {
		struct v3 from = tracks->point_m[i < POINTS ? i : i - POINTS];
		tracks->point_m[i] = move(tracks, from, &scatter, &tracks->exact_m[i]);
	}
}

static double track_own(struct tracks *tracks)
{
	static struct body_track track[POINTS];
	double ms = 0.0;
	long units = 0;
	for (int i = 0; i < POINTS; i++)
		track[i].triangle = -1;
	for (int f = 0; f < FRAMES; f++) {
		double start = peers_ms();
		for (int i = 0; i < POINTS; i++) {
			struct body_hit hit;
			MUST(body_track(&tracks->body, tracks->point_m[f * POINTS + i], 0,
					&track[i], &hit, &units));
			tracks->own_m[f * POINTS + i] = float_abs(hit.distance_m);
		}
		ms += f > 0 ? peers_ms() - start : 0.0;
	}
	return ms;
}

static int count_off(const struct tracks *tracks, const float *distance_m, float by_m)
{
	int off = 0;
	for (int i = 0; i < QUERIES; i++)
		off += float_abs(distance_m[i] - tracks->exact_m[i]) > by_m;
	return off;
}

static void add_rate(double own_ms, const char *peer, double peer_ms, double ratio_target)
{
	double million = 1e-6 * (QUERIES - POINTS);
	struct peers_row row = {.unit = "M/s",
				.better = MORE,
				.figure = million / own_ms * 1e3,
				.target = NO_TARGET,
				.peer = peer,
				.peer_figure = peer ? million / peer_ms * 1e3 : 0.0,
				.ratio_target = ratio_target};
	snprintf(row.what, sizeof row.what, "nearest surface, repair included");
	peers_add(&row);
}

static void add_off(const struct tracks *tracks, float by_m, double target)
{
	struct peers_row row = {.unit = "1e-5",
				.target = target,
				.figure = 1e5 * count_off(tracks, tracks->own_m, by_m) / QUERIES};
	snprintf(row.what, sizeof row.what, "off by more than %.0f mm", (double)(1000.0f * by_m));
	peers_add(&row);
}

static void tracks_open(struct tracks *tracks, const struct peers_body *body, struct arena *arena)
{
	body_init(&tracks->body, arena);
	MUST(!body_build(&tracks->body, body->position_m, body->vertex_count, body->triangle,
			 body->triangle_count));
	tracks->point_m = calloc(QUERIES, sizeof *tracks->point_m);
	tracks->exact_m = calloc(QUERIES, sizeof *tracks->exact_m);
	tracks->own_m = calloc(QUERIES, sizeof *tracks->own_m);
	tracks->embree_m = calloc(QUERIES, sizeof *tracks->embree_m);
	MUST(tracks->point_m && tracks->exact_m && tracks->own_m && tracks->embree_m);
}

void peers_tracks(const struct peers_body *body, bool with_peers)
{
	static struct tracks tracks;
	struct arena arena;
	void *memory = malloc(KIOSK_MEMORY_BYTES);
	double plain_ms = 0.0, bounded_ms = 0.0;
	MUST(memory);
	arena_init(&arena, memory, KIOSK_MEMORY_BYTES);
	tracks_open(&tracks, body, &arena);
	make_points(&tracks);
	bool peer = with_peers && peer_embree_track(body, tracks.point_m, POINTS, FRAMES, false,
						    tracks.embree_m, &plain_ms);
	MUST(!peer || count_off(&tracks, tracks.embree_m, 1e-4f) == 0);
	if (peer)
		peer_embree_track(body, tracks.point_m, POINTS, FRAMES, true, tracks.embree_m,
				  &bounded_ms);
	MUST(!peer || count_off(&tracks, tracks.embree_m, 1e-4f) == 0);
	double own_ms = track_own(&tracks);
	add_rate(own_ms, peer ? "Embree" : NULL, plain_ms, 10.0);
	if (peer)
		add_rate(own_ms, "Embree bounded", bounded_ms, 8.0);
	add_off(&tracks, 0.001f, 1.0);
	add_off(&tracks, 0.005f, 0.0);
	free(tracks.point_m);
	free(tracks.exact_m);
	free(tracks.own_m);
	free(tracks.embree_m);
	free(memory);
}
