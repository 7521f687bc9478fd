/* A panel sewn to a band much shorter than its edge lies pleated: neither is stretched, measured on
 * the cloth as it is cut. */
#include "cloth_pleat.h"
#include "cloth_private.h"
#include "measure.h"
#include "scene.h"
#include "test.h"

enum { BAND_MM = 200, SWEEPS = 300 };

/* A band above a panel of that width, both flat in front of the body, sewn. */
static void sew(struct scene *scene, int panel_mm)
{
	struct session *session = &scene->session;
	struct cloth *cloth = &session->cloth;
	struct garment *garment = &session->garment;
	char line[3][120];
	snprintf(line[0], sizeof line[0], "piece band 0 0 0 0 0 0 0 1 %d 0 1 %d 60 1 0 60 1",
		 BAND_MM, BAND_MM);
	snprintf(line[1], sizeof line[1], "piece panel 0 0 0 0 0 0 0 1 %d 0 1 %d 300 1 0 300 1",
		 panel_mm, panel_mm);
	snprintf(line[2], sizeof line[2], "sew 0 0 1 2 0");
	for (int i = 0; i < 3; i++)
		MUST(scene_line(scene, line[i]));
	scene_mesh(scene, 600);
	for (int v = 0; v < garment->vertex_count; v++) {
		struct v2 p = garment->rest_m[v];
		bool band = garment->piece[v] == 0;
		float share = band ? 1.0f : (float)BAND_MM / (float)panel_mm;
		cloth->position_m[v] = (struct v3){share * p.x, p.y + (band ? 1.3f : 1.0f), 0.5f};
		cloth->placed[v] = 1;
	}
	cloth_weld(cloth);
	for (int v = 0; v < garment->vertex_count; v++)
		cloth_look(cloth, v);
}

static float strain_after(struct scene *scene)
{
	struct cloth *cloth = &scene->session.cloth;
	struct measure_scratch *measurer = measure_init(&scene->arena);
	struct measure measure;
	cloth->settings.gravity_m = 0.0f;
	for (int i = 0; i < SWEEPS; i++)
		cloth_sweep(cloth);
	cloth_finish(cloth);
	measure_garment(&measure, cloth, measurer);
	return measure.strain_max;
}

static void test_pleated(int panel_mm, float strain)
{
	struct scene *scene = scene_open();
	struct pleats pleats;
	int at = 0;
	sew(scene, panel_mm);
	CHECK(cloth_pleats(&scene->session.garment, &at, &pleats));
	CHECK_NEAR(pleats.share, (float)BAND_MM / (float)panel_mm, 1e-3f);
	CHECK_NEAR(pleats.excess_m, 1e-3f * (float)(panel_mm - BAND_MM), 1e-4f);
	CHECK(!cloth_pleats(&scene->session.garment, &at, &pleats));
	float most = strain_after(scene);
	printf("%d mm on %d mm: strain %.3f\n", panel_mm, BAND_MM, (double)most);
	CHECK(most < strain);
	scene_close(scene);
}

/* A little ease is stretched in, as it is at a sleeve's cap: no rest shape changes. */
static void test_ease(void)
{
	struct scene *scene = scene_open();
	struct pleats pleats;
	int at = 0;
	sew(scene, BAND_MM + 8);
	const struct cloth *cloth = &scene->session.cloth;
	CHECK(!cloth_pleats(cloth->garment, &at, &pleats));
	for (int t = 0; t < cloth->garment->triangle_count; t++) {
		const int *v = cloth->garment->triangle[t].v;
		struct v2 way = v2_sub(cloth->garment->rest_m[v[1]], cloth->garment->rest_m[v[0]]);
		CHECK(v2_distance(cloth_flat_way(cloth, t, v[0], v[1]), way) == 0.0f);
	}
	scene_close(scene);
}

int main(void)
{
	test_pleated(350, 0.25f);
	test_pleated(260, 0.25f);
	test_ease();
	return test_end();
}
