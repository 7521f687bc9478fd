/* Sleeves and trouser legs cut in one with front and back: whatever the proportions in which a
 * T-shirt is drawn, the arms end in its sleeves, or the wrap says which one does not. */
#include "dress_private.h"
#include "measure.h"
#include "shirt.h"
#include "test.h"

static void test_proportions(float wide, float tall)
{
	struct scene *scene = shirt_of(wide, tall);
	struct session *session = &scene->session;
	struct measure_scratch *measurer = measure_init(&scene->arena);
	struct measure measure;
	CHECK(scene_wrap(scene));
	measure_garment(&measure, &session->cloth, measurer);
	printf("%.2f x %.2f: arms %d, edges through %d, facing in %d, strain p95 %.3f\n",
	       (double)wide, (double)tall, measure.arms_in_sleeves, measure.edge_crossings_body,
	       measure.inverted_triangles, (double)measure.strain_p95);
	CHECK(measure.arms_in_sleeves == 2 && measure.head_through_collar);
	CHECK(measure.edge_crossings_body == 0 && measure.vertices_inside == 0);
	CHECK(measure.inverted_triangles < 10);
	CHECK(count_diagnoses(&session->wrap, "limb-outside") == 0);
	scene_close(scene);
}

/* A sleeve that lies elsewhere holds no arm, and the wrap says so. */
static void test_outside(void)
{
	struct scene *scene = shirt_of(1.25f, 1.0f);
	struct wrap *wrap = &scene->session.wrap;
	struct cloth *cloth = &scene->session.cloth;
	CHECK(scene_wrap(scene));
	CHECK(wrap_in_opening(wrap, PART_ARM_LEFT) && wrap_in_opening(wrap, PART_ARM_RIGHT));
	for (int v = 0; v < cloth->garment->vertex_count; v++)
		if (cloth->position_m[v].x > 0.2f)
			cloth->position_m[v].z += 0.5f;
	CHECK(!wrap_in_opening(wrap, PART_ARM_LEFT) && wrap_in_opening(wrap, PART_ARM_RIGHT));
	wrap->diagnoses.count = 0;
	wrap_check(wrap);
	CHECK(count_diagnoses(wrap, "limb-outside") == 1);
	scene_close(scene);
}

/* Trousers of two pieces, marked down the middle in front and behind: the legs are in them. */
static void test_trousers(void)
{
	static const char *const journal[] = {
		"piece front 0 0 -470 330 0 -215 0 1 -270 -200 1 -300 -980 1 -40 -980 1 0 -290 1 "
		"40 -980 1 300 -980 1 270 -200 1 215 0 1",
		"piece back 0 1 300 330 0 -215 0 1 -270 -200 1 -300 -980 1 -40 -980 1 0 -290 1 "
		"40 -980 1 300 -980 1 270 -200 1 215 0 1",
		"sew 0 0 1 7 0",
		"sew 0 1 1 6 0",
		"sew 0 3 1 4 0",
		"sew 0 4 1 3 0",
		"sew 0 6 1 1 0",
		"sew 0 7 1 0 0",
		"mark-cloth 1 0 0 -20 0 -230",
		"mark-at 1 front-centre 1 2 0.01 0",
		"mark-cloth 2 1 0 -20 0 -230",
		"mark-at 2 back-centre 1 2 0.01 0",
	};
	struct scene *scene = scene_open();
	struct session *session = &scene->session;
	struct measure_scratch *measurer = measure_init(&scene->arena);
	struct measure measure;
	for (int i = 0; i < COUNT_OF(journal); i++)
		CHECK(scene_line(scene, journal[i]));
	CHECK(scene_wrap(scene));
	measure_garment(&measure, &session->cloth, measurer);
	printf("trousers: edges through %d, facing in %d, crossing %d, strain p95 %.3f\n",
	       measure.edge_crossings_body, measure.inverted_triangles, measure.self_intersections,
	       (double)measure.strain_p95);
	CHECK(wrap_in_opening(&session->wrap, PART_LEG_LEFT));
	CHECK(wrap_in_opening(&session->wrap, PART_LEG_RIGHT));
	CHECK(session->cloth.welded && measure.edge_crossings_body == 0);
	CHECK(measure.vertices_inside == 0 && measure.inverted_triangles < 10);
	CHECK(count_diagnoses(&session->wrap, "limb-outside") == 0);
	scene_close(scene);
}

int main(void)
{
	test_proportions(0.95f, 1.0f);
	test_proportions(1.25f, 1.0f);
	test_proportions(1.5f, 1.0f);
	test_proportions(1.2f, 0.8f);
	test_outside();
	test_trousers();
	return test_end();
}
