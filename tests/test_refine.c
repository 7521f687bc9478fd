/* sqrt(3) refinement: the sphere test of S20 by hand; a mesh that stays one whatever is refined and
 * coarsened; what it does for coarse cloth over a thin limb; undo, pins and drags on it. */
#include "cloth_private.h"
#include "cloth_refine.h"
#include "format_garment.h"
#include "garment_figures.h"
#include "garment_refine.h"
#include "scene.h"
#include "session_undo.h"
#include "shapes.h"
#include "test.h"

#include <dirent.h>

#define SEAMS_FOLDER "../shared/data/patterns/seams"

enum {
	CHANGES = 40,
	GARMENT_VERTICES = 900,
	GARMENT_CHANGES = 8,
	FILE_BYTES_MAX = 4 << 20,
	FRAMES_MAX = 4000,
	TUBE_COLUMNS = 96,
	TUBE_SIDES = 32,
	DROP_SWEEPS = 600,
};

/* ---- the test of S20 ---- */

/* An edge of 27 mm that dips `dip_deg` below the tangent at A. */
static bool dips(float dip_deg, float distance_m)
{
	float dip = dip_deg * PI_F / 180.0f;
	struct v3 inward = {0.0f, -1.0f, 0.0f};
	struct v3 ab = {0.027f * angle_cos(dip), -0.027f * angle_sin(dip), 0.0f};
	return edge_sinks(ab, inward, distance_m);
}

static void test_sphere(void)
{
	/* at 4 mm the line cuts the sphere where cos(dip) < 27/31, and its nearest point lies
	 * before B where sin(dip) < 27/31: 29.4 to 60.6 degrees */
	CHECK(!dips(29.0f, 0.004f));
	CHECK(dips(30.0f, 0.004f));
	CHECK(dips(60.0f, 0.004f));
	CHECK(!dips(61.0f, 0.004f));
	/* cos q > 0: away from the body both inequalities hold */
	CHECK(!dips(-45.0f, 0.004f));
	CHECK(!dips(-89.0f, 0.004f));
	/* without the floor under the distance any chord of a convex body would fire */
	CHECK(dips(1.0f, 0.0f));
	CHECK(!dips(1.0f, 0.004f));
	/* farther than (sqrt(2) - 1) L nothing does */
	CHECK(dips(45.0f, 0.0110f));
	CHECK(!dips(45.0f, 0.0113f));
	CHECK(!edge_sinks((struct v3){0.0f, 0.0f, 0.0f}, (struct v3){0.0f, -1.0f, 0.0f}, 0.004f));
}

/* ---- the mesh ---- */

static struct refiner refiner;
static uint8_t depth[GARMENT_TRIANGLES_MAX];

static uint64_t garment_hash(const struct garment *garment)
{
	struct hash hash;
	hash_init(&hash);
	hash_int(&hash, garment->vertex_count);
	for (int v = 0; v < garment->vertex_count; v++) {
		hash_float(&hash, garment->rest_m[v].x);
		hash_float(&hash, garment->rest_m[v].y);
		hash_int(&hash, garment->piece[v]);
		hash_int(&hash, garment->weld[v]);
	}
	for (int t = 0; t < garment->triangle_count; t++) {
		hash_int(&hash, garment->triangle_piece[t]);
		for (int k = 0; k < 3; k++)
			hash_int(&hash, garment->triangle[t].v[k]);
	}
	for (int p = 0; p <= PIECES_MAX; p++) {
		hash_int(&hash, garment->piece_first[p]);
		hash_int(&hash, garment->piece_first_triangle[p]);
	}
	for (int i = 0; i < garment->pair_count; i++) {
		hash_int(&hash, garment->pair[i].a);
		hash_int(&hash, garment->pair[i].b);
		hash_int(&hash, garment->pair[i].seam);
	}
	for (int v = 0; garment->base_count > 0 && v < garment->vertex_count; v++)
		hash_int(&hash, garment->place[v]);
	for (int t = 0; t < garment->base_count; t++) {
		hash_int(&hash, garment->depth[t]);
		hash_int(&hash, garment->base[t].v[0]);
	}
	return hash.value;
}

static bool apply_depths(struct garment *garment)
{
	refiner_look(&refiner, garment);
	refiner_balance(&refiner, garment, depth);
	bool done = garment_refine(&refiner, garment, depth);
	refiner_close(garment);
	return done;
}

/* Rims cut in three have two open edges more; nothing else may be open. */
static int rims_cut(const struct garment *garment)
{
	int cut = 0;
	for (int e = 0; garment->base_count > 0 && e < 3 * garment->base_count; e++)
		cut += refiner.across[e] == REFINE_RIM && garment->depth[e / 3] == REFINE_DEPTH_MAX;
	return cut;
}

static struct figures base;
static struct v2 base_rest_m[GARMENT_VERTICES_MAX];
static int base_vertices;

static void check_mesh(const struct garment *garment)
{
	static struct figures now;
	int kept = 0, seams = 0;
	figures_measure(&now, garment);
	CHECK(now.clockwise == 0);
	CHECK(now.bad_edges == base.bad_edges);
	CHECK(now.collapsed == base.collapsed);
	CHECK(now.euler == base.euler);
	CHECK(now.open_edges == base.open_edges + 2 * rims_cut(garment));
	for (int p = 0; p < PIECES_MAX; p++)
		CHECK_NEAR(now.area_mm2[p], base.area_mm2[p], 1e-6 * base.area_mm2[p]);
	for (int v = 0; v < garment->vertex_count; v++) {
		CHECK(garment->weld[v] <= v && garment->weld[garment->weld[v]] == garment->weld[v]);
		if (garment->base_count > 0 && garment->place[v] >= 0)
			continue;
		CHECK(memcmp(&garment->rest_m[v], &base_rest_m[kept], sizeof *base_rest_m) == 0);
		kept++;
	}
	CHECK(kept == base_vertices);
	for (int i = 0; i < garment->pair_count; i++)
		seams += garment->weld[garment->pair[i].a] != garment->weld[garment->pair[i].b];
	CHECK(seams == 0);
	for (int p = 0; p < PIECES_MAX; p++) {
		for (int v = garment->piece_first[p]; v < garment->piece_first[p + 1]; v++)
			CHECK(garment->piece[v] == p);
		for (int t = garment->piece_first_triangle[p];
		     t < garment->piece_first_triangle[p + 1]; t++)
			CHECK(garment->triangle_piece[t] == p &&
			      garment->piece[garment->triangle[t].v[0]] == p);
	}
}

/* Patches of triangles go up and down at random. */
static void scatter_depths(struct scatter *scatter, int triangles)
{
	int patches = 1 + scatter_below(scatter, 6);
	for (int i = 0; i < patches; i++) {
		int first = scatter_below(scatter, triangles), many = scatter_below(scatter, 60);
		for (int t = first; t < int_min(first + many, triangles); t++)
			depth[t] = (uint8_t)scatter_below(scatter, 3);
	}
}

static void test_changes(struct garment *garment, int changes)
{
	static uint8_t last[GARMENT_TRIANGLES_MAX];
	struct scatter scatter = {12345};
	int triangles = garment->triangle_count, most = 0;
	uint64_t made = garment_hash(garment);
	figures_measure(&base, garment);
	base_vertices = garment->vertex_count;
	memcpy(base_rest_m, garment->rest_m, (size_t)base_vertices * sizeof *base_rest_m);
	memset(depth, 0, sizeof depth);
	for (int i = 0; i < changes; i++) {
		scatter_depths(&scatter, triangles);
		CHECK(apply_depths(garment));
		check_mesh(garment);
		most = int_max(most, garment->vertex_count);
	}
	CHECK(most > base_vertices + 100);

	/* the way there does not matter */
	memcpy(last, depth, sizeof last);
	uint64_t there = garment_hash(garment);
	memset(depth, 0, sizeof depth);
	CHECK(apply_depths(garment));
	CHECK(garment_hash(garment) == made);
	CHECK(garment->base_count == 0);
	memcpy(depth, last, sizeof last);
	CHECK(apply_depths(garment));
	CHECK(garment_hash(garment) == there);
	memset(depth, 0, sizeof depth);
	CHECK(apply_depths(garment));
	CHECK(garment_hash(garment) == made);
}

/* All of it makes three triangles of one; nine are too many: nothing changes. */
static void test_full(struct garment *garment)
{
	int triangles = garment->triangle_count;
	uint64_t made = garment_hash(garment);
	memset(depth, 1, sizeof depth);
	CHECK(apply_depths(garment));
	CHECK(garment->triangle_count == 3 * triangles);
	check_mesh(garment);
	CHECK(9 * triangles > GARMENT_TRIANGLES_MAX);
	uint64_t there = garment_hash(garment);
	memset(depth, 2, sizeof depth);
	CHECK(!apply_depths(garment));
	CHECK(garment_hash(garment) == there);
	memset(depth, 0, sizeof depth);
	CHECK(apply_depths(garment));
	CHECK(garment_hash(garment) == made);
}

static void mesh(struct session *session, int vertices)
{
	bool done = false;
	MUST(!garment_start(session->mesher, &session->garment, &session->document.pattern,
			    vertices));
	while (!done)
		garment_advance(session->mesher, 1 << 20, &done);
}

/* Darts, gores, pleats: whatever the shared garments have. */
static void test_garments(struct session *session)
{
	static char text[FILE_BYTES_MAX];
	char path[400], fault[200];
	int files = 0;
	DIR *folder = opendir(SEAMS_FOLDER);
	for (struct dirent *entry; folder && (entry = readdir(folder)) != NULL;) {
		if (!strstr(entry->d_name, ".json"))
			continue;
		snprintf(path, sizeof path, SEAMS_FOLDER "/%.200s", entry->d_name);
		FILE *file = fopen(path, "rb");
		MUST(file);
		size_t size = fread(text, 1, sizeof text, file);
		fclose(file);
		if (!format_garment_read(&session->document.pattern, text, size, fault))
			continue;
		mesh(session, GARMENT_VERTICES);
		test_changes(&session->garment, GARMENT_CHANGES);
		files++;
	}
	if (folder)
		closedir(folder);
	else
		printf("skip: the T-shirt passed; no garments in " SEAMS_FOLDER "\n");
	CHECK(!folder || files > 10);
}

/* ---- coarse cloth over a thin limb ---- */

/* A ring of such a thickness, 1 m above the ground, its left end below the middle of a square of
 * cloth with edges of 40 mm. */
static void lay_over_tube(struct session *session, float radius_m)
{
	static struct shape tube;
	static const float corner[4][2] = {{-200, -200}, {200, -200}, {200, 200}, {-200, 200}};
	struct piece *piece = &session->document.pattern.piece[0];
	struct garment *garment = &session->garment;
	struct cloth *cloth = &session->cloth;
	shape_torus(&tube, TUBE_COLUMNS, TUBE_SIDES, 0.35f, radius_m);
	for (int v = 0; v < tube.vertex_count; v++)
		tube.position_m[v].y += 1.0f;
	MUST(!body_build(&session->body, tube.position_m, tube.vertex_count, tube.triangle,
			 tube.triangle_count));
	body_find_parts(&session->body);
	memset(&session->document, 0, sizeof session->document);
	*piece = (struct piece){.used = true, .point_count = 4};
	for (int i = 0; i < 4; i++) {
		piece->point_mm[i] = (struct v2){corner[i][0], corner[i][1]};
		piece->corner[i] = true;
	}
	mesh(session, 100);
	cloth_reset(cloth, garment, &session->body);
	for (int v = 0; v < garment->vertex_count; v++) {
		struct v2 p = garment->rest_m[v];
		cloth->position_m[v] = (struct v3){0.35f + p.x, 1.01f + radius_m, -p.y};
		cloth->previous_m[v] = cloth->position_m[v];
		cloth->placed[v] = 1;
	}
	cloth_weld(cloth);
	cloth->worn = true;
}

static struct measure_scratch *measure_scratch;
static struct measure measure;

/* The paper's own contact, of vertices alone. Returns edges through the tube, and midpoints and
 * centres inside it. */
static int drop(struct session *session, float radius_m, bool refine)
{
	struct cloth *cloth = &session->cloth;
	long units = 0;
	lay_over_tube(session, radius_m);
	cloth->settings.faces = false;
	for (int sweep = 1; sweep <= DROP_SWEEPS; sweep++) {
		cloth_sweep(cloth);
		if (refine && sweep % 100 == 0 && sweep < DROP_SWEEPS)
			cloth_refine(cloth, &session->garment, false, &units);
	}
	cloth_finish(cloth);
	measure_garment(&measure, cloth, measure_scratch);
	printf("vertices alone, tube of %.0f mm, %s: %d triangles, %d edges through, %d midpoints "
	       "and %d centres inside\n",
	       1e3 * (double)radius_m, refine ? "refined" : "as made",
	       session->garment.triangle_count, measure.edge_crossings_body,
	       measure.midpoints_inside, measure.centres_inside);
	return measure.edge_crossings_body + measure.midpoints_inside + measure.centres_inside;
}

static void test_drop(struct session *session)
{
	static const float radius_m[] = {0.015f, 0.020f, 0.025f, 0.030f};
	for (int i = 0; i < COUNT_OF(radius_m); i++) {
		CHECK(drop(session, radius_m[i], false) > 10);
		CHECK(drop(session, radius_m[i], true) == 0);
		CHECK(session->garment.triangle_count < 2 * 208);
	}
}

/* Session and all: faces are kept out too, so that nothing is inside, but coarse cloth stretches
 * over the tube and stands off. */
static void settle(struct session *session, bool refine)
{
	lay_over_tube(session, 0.012f);
	session->frame = 0;
	session_apply(session, &(struct edit){.kind = EDIT_RELEASE}); /* wakes it */
	for (int f = 0; f < FRAMES_MAX && session_busy(session); f++) {
		session->refines = refine ? session->refines : 99;
		session_advance(session);
	}
	CHECK(!session_busy(session));
	measure_garment(&measure, &session->cloth, measure_scratch);
	printf("tube of 12 mm, %s: %d triangles, strain %.3f, at most %.3f, %d frames\n",
	       refine ? "refined" : "as made", session->garment.triangle_count,
	       (double)measure.strain_p95, (double)measure.strain_max, session->frame);
	CHECK(measure.vertices_inside == 0);
	CHECK(measure.edge_crossings_body == 0);
}

static void test_settle(struct session *session)
{
	settle(session, false);
	float strain = measure.strain_p95;
	CHECK(session->garment.base_count == 0);
	settle(session, true);
	uint64_t hash = session_hash(session);
	CHECK(measure.strain_p95 < 0.6f * strain);
	CHECK(session->garment.base_count == 208);
	CHECK(session->garment.triangle_count < 3 * 208);
	settle(session, true);
	CHECK(session_hash(session) == hash);
}

/* ---- a refined garment is a garment ---- */

static bool apply(struct session *session, struct edit edit)
{
	return session_apply(session, &edit);
}

static void test_handling(struct session *session)
{
	struct garment *garment = &session->garment;
	int vertices = garment->vertex_count;
	uint64_t hash = session_hash(session), mesh = garment_hash(garment);
	CHECK(apply(session, (struct edit){.kind = EDIT_PIN, .f = {10.0f, 5.0f}}));
	CHECK(apply(session, (struct edit){.kind = EDIT_GRAB, .f = {-60.0f, 30.0f}}));
	struct v3 to = drag_point(&session->drag);
	for (int f = 0; f < 40; f++) {
		to.z -= 0.004f;
		CHECK(apply(session, (struct edit){.kind = EDIT_DRAG, .f = {to.x, to.y, to.z}}));
		session_advance(session);
		CHECK(garment->vertex_count == vertices); /* never in the hand */
	}
	CHECK(apply(session, (struct edit){.kind = EDIT_RELEASE}));
	while (session_busy(session))
		session_advance(session);
	measure_garment(&measure, &session->cloth, measure_scratch);
	CHECK(measure.vertices_inside == 0);
	CHECK(session_hash(session) != hash);
	uint64_t moved = garment_hash(garment);
	int frame = session->frame;
	CHECK(apply(session, (struct edit){.kind = EDIT_UNDO}));
	CHECK(apply(session, (struct edit){.kind = EDIT_UNDO}));
	CHECK(garment_hash(garment) == mesh);
	session->frame = 0;
	CHECK(apply(session, (struct edit){.kind = EDIT_REDO}));
	CHECK(apply(session, (struct edit){.kind = EDIT_REDO}));
	CHECK(garment_hash(garment) == moved);
	session->frame = frame;
}

/* Away from the body nothing sinks: the mesh is what it was, and no vertex of it has moved. */
static void test_coarsen(struct session *session)
{
	static struct v3 kept[GARMENT_VERTICES_MAX];
	struct garment *garment = &session->garment;
	struct cloth *cloth = &session->cloth;
	long units = 0;
	int count = 0, rounds = 0;
	lay_over_tube(session, 0.012f);
	uint64_t made = garment_hash(garment);
	settle(session, true);
	uint64_t refined = garment_hash(garment);
	CHECK(refined != made);
	undo_keep(session);
	for (int v = 0; v < garment->vertex_count; v++) {
		cloth->position_m[v].y += 1.0f;
		cloth_look(cloth, v);
		if (garment->place[v] < 0)
			kept[count++] = cloth->position_m[v];
	}
	while (cloth_refine(cloth, garment, true, &units) > 0)
		rounds++;
	CHECK(rounds == REFINE_DEPTH_MAX);
	CHECK(garment->base_count == 0);
	CHECK(garment_hash(garment) == made);
	CHECK(memcmp(kept, cloth->position_m, (size_t)count * sizeof *kept) == 0);
	memset(garment->base, 0, GARMENT_TRIANGLES_MAX * sizeof *garment->base);
	CHECK(undo_back(session));
	CHECK(garment_hash(garment) == refined);
}

/* Cloth that lies on the skin of something large: the distance has a floor, so that no chord fires.
 */
static void test_floor(struct session *session)
{
	struct cloth *cloth = &session->cloth;
	struct body_hit hit;
	long units = 0;
	lay_over_tube(session, 0.250f);
	for (int v = 0; v < session->garment.vertex_count; v++) {
		body_nearest(&session->body, cloth->position_m[v], 0, &hit);
		cloth->position_m[v] = v3_mad(hit.point_m, hit.normal, 0.0002f);
		cloth_look(cloth, v);
	}
	CHECK(cloth_refine(cloth, &session->garment, true, &units) == 0);
}

int main(void)
{
	struct scene *scene = scene_open();
	measure_scratch = measure_init(&scene->arena);
	refiner_init(&refiner, &scene->arena);
	test_sphere();
	MUST(scene_play(scene, "tests/journals/tshirt.kitsuke") == 0);
	MUST(!session_mesh(&scene->session));
	while (scene->session.job != JOB_NONE)
		session_advance(&scene->session);
	test_changes(&scene->session.garment, CHANGES);
	test_full(&scene->session.garment);
	test_garments(&scene->session);
	test_drop(&scene->session);
	test_settle(&scene->session);
	test_handling(&scene->session);
	test_coarsen(&scene->session);
	test_floor(&scene->session);
	scene_close(scene);
	return test_end();
}
