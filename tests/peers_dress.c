/* What a visitor waits for: the wrap and the pen's first touch, on the bundled T-shirt; and the
 * mesher against CGAL's. */
#include "garment_figures.h"
#include "peers_rows.h"
#include "processor.h"
#include "scene.h"

enum { GRABS = 32, MESHINGS = 9, SHIRT_TRIANGLES = 2000 };

static void add(const char *what, int vertices, const char *unit, double figure, double target)
{
	struct peers_row row = {.unit = unit, .figure = figure, .target = target};
	snprintf(row.what, sizeof row.what, "%d vertices: %s", vertices, what);
	peers_add(&row);
}

/* The time of the wrap's frames, and of the meshing before them. */
static void wrap(struct scene *scene, int vertices, double target_ms)
{
	struct session *session = &scene->session;
	double mesh_ms = 0.0, wrap_ms = 0.0;
	session->vertices_wanted = vertices;
	MUST(scene_edit(scene, EDIT_WRAP));
	while (session->job != JOB_NONE) {
		bool meshing = session->job == JOB_MESH;
		double start = peers_ms();
		session_advance(session);
		*(meshing ? &mesh_ms : &wrap_ms) += peers_ms() - start;
	}
	MUST(session->cloth.worn);
	add("meshing a T-shirt", session->garment.vertex_count, "ms", mesh_ms, NO_TARGET);
	add("wrapping a T-shirt", session->garment.vertex_count, "ms", wrap_ms, target_ms);
}

/* The dearest of many grabs all over the front. */
static void pen_down(struct scene *scene)
{
	double worst = 0.0;
	for (int i = 0; i < GRABS; i++) {
		scene->edit.i[0] = 0;
		scene->edit.f[0] = -200.0f + 50.0f * (float)(i % 8);
		scene->edit.f[1] = -600.0f + 120.0f * (float)(i / 8);
		double start = peers_ms();
		bool held = scene_edit(scene, EDIT_GRAB);
		double ms = peers_ms() - start;
		if (held && scene_edit(scene, EDIT_RELEASE))
			worst = ms > worst ? ms : worst;
	}
	add("pen-down, the dearest", scene->session.garment.vertex_count, "ms", worst, 2.0);
}

void peers_dressing(void)
{
	struct scene *scene = scene_open();
	scene->session.cloth.lanes = processor_lanes();
	MUST(scene_play(scene, "tests/journals/tshirt.kitsuke") == 0);
	wrap(scene, 2000, 60.0);
	wrap(scene, 10000, 400.0);
	pen_down(scene);
	scene_close(scene);
}

/* ---- the mesher ---- */

/* bench_mesh's shirt front: 600 x 700 mm with a curved neck. */
static void draw_shirt(struct pattern *pattern)
{
	static const struct v2 corner[] = {{240, -330}, {220, 150},  {330, 120},  {370, 235},
					   {90, 300},   {-90, 300},  {-370, 235}, {-330, 120},
					   {-220, 150}, {-240, -330}};
	struct piece *piece = &pattern->piece[0];
	*piece = (struct piece){.used = true};
	for (int k = 0; k < COUNT_OF(corner); k++) {
		piece->corner[piece->point_count] = true;
		piece->point_mm[piece->point_count++] = corner[k];
		for (int i = 1; k == 4 && i < 20; i++) {
			float angle = PI_F * (float)i / 20.0f;
			piece->point_mm[piece->point_count++] = (struct v2){
				90 * angle_cos(angle), 300 - 60 * angle_sin(angle)};
		}
	}
}

static int by_time(const void *a, const void *b)
{
	double x = ((const struct mesh_figures *)a)->ms, y = ((const struct mesh_figures *)b)->ms;
	return (x > y) - (x < y);
}

static void mesh_own(struct scene *scene, struct mesh_figures *result)
{
	struct garment *garment = &scene->session.garment;
	struct figures figures;
	double start = peers_ms();
	MUST(!garment_start(scene->session.mesher, garment, &scene->session.document.pattern,
			    SHIRT_TRIANGLES * 11 / 20));
	for (bool done = false; !done;)
		garment_advance(scene->session.mesher, 1 << 20, &done);
	result->ms = peers_ms() - start;
	figures_measure(&figures, garment);
	result->triangles = garment->triangle_count;
	result->angle_min_deg = (double)figures.angle_min_deg;
	result->angle_mean_deg = (double)figures.angle_mean_deg;
}

void peers_meshing(bool with_peers)
{
	struct scene *scene = scene_open();
	struct mesh_figures own[MESHINGS], cgal[MESHINGS];
	bool peer = with_peers;
	draw_shirt(&scene->session.document.pattern);
	for (int i = 0; i < MESHINGS; i++) {
		mesh_own(scene, &own[i]);
		peer = peer && peer_cgal_mesh(own[i].triangles, &cgal[i]);
	}
	qsort(own, MESHINGS, sizeof *own, by_time);
	if (peer)
		qsort(cgal, MESHINGS, sizeof *cgal, by_time);
	const struct mesh_figures none = {0}, *a = &own[MESHINGS / 2],
				  *b = peer ? &cgal[MESHINGS / 2] : &none;
	const char *name = peer ? "CGAL Mesh_2" : NULL;
	struct peers_row row[] = {
		{"shirt front meshed", "ms", LESS, a->ms, 2.0, name, b->ms, NO_TARGET},
		{"its triangles", "", MORE, a->triangles, NO_TARGET, name, b->triangles, NO_TARGET},
		{"its smallest angle", "deg", MORE, a->angle_min_deg, 28.0, name, b->angle_min_deg,
		 NO_TARGET},
		{"its smallest angles' mean", "deg", MORE, a->angle_mean_deg, 52.0, name,
		 b->angle_mean_deg, NO_TARGET},
	};
	for (int i = 0; i < COUNT_OF(row); i++)
		peers_add(&row[i]);
	scene_close(scene);
}
