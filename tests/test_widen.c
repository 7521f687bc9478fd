/* Cloth that is too narrow for the body is let out: by what it is stretched and where, in that
 * direction alone; a narrow skirt then lies smooth, and undo knows how wide it was. */
#include "cloth_private.h"
#include "cloth_widen.h"
#include "measure.h"
#include "shirt.h"

enum { SIDE_MM = 300 };

/* A square sheet stretched along a direction: by `low` where it begins across it, by `high` at its
 * end. */
static struct scene *sheet(struct v2 along, float low, float high)
{
	struct scene *scene = scene_open();
	struct session *session = &scene->session;
	struct cloth *cloth = &session->cloth;
	struct garment *garment = &session->garment;
	CHECK(scene_line(scene, "piece sheet 0 0 0 0 0 0 0 1 300 0 1 300 300 1 0 300 1"));
	scene_mesh(scene, 600);
	for (int v = 0; v < garment->vertex_count; v++) {
		struct v2 p = garment->rest_m[v];
		float at_m = v2_dot(p, along) - 0.15f * (along.x + along.y),
		      off_m = along.x * p.y - along.y * p.x;
		float more = low + (high - low) * off_m * 1e3f / (float)SIDE_MM;
		struct v2 q = v2_add(p, v2_scale(along, more * at_m));
		cloth->position_m[v] = (struct v3){q.x, q.y + 1.0f, 0.6f};
		cloth->placed[v] = 1;
	}
	return scene;
}

/* How much wider a triangle is along a direction than it was cut. */
static float wider(const struct cloth *cloth, int t, struct v2 along)
{
	return v2_dot(cloth_widened(cloth, t, along), along) - 1.0f;
}

static void test_where(void)
{
	struct v2 across = {1.0f, 0.0f}, along = {0.0f, 1.0f};
	struct scene *scene = sheet(across, 0.0f, 0.4f);
	struct cloth *cloth = &scene->session.cloth;
	CHECK(cloth_narrow_piece(cloth) == 0);
	cloth_let_out(cloth);
	cloth_build(cloth);
	for (int t = 0; t < cloth->garment->triangle_count; t++) {
		const int *v = cloth->garment->triangle[t].v;
		float high_m = 0.0f;
		for (int k = 0; k < 3; k++)
			high_m += cloth->garment->rest_m[v[k]].y / 3.0f;
		float more = 0.4f * high_m * 1e3f / (float)SIDE_MM;
		CHECK_NEAR(wider(cloth, t, across), float_max(more - 0.05f, 0.0f), 0.06f);
		CHECK_NEAR(wider(cloth, t, along), 0.0f, 0.03f);
	}
	scene_close(scene);
}

static void test_direction(void)
{
	struct v2 way = {0.8f, 0.6f}, aside = {-0.6f, 0.8f};
	struct scene *scene = sheet(way, 0.3f, 0.3f);
	struct cloth *cloth = &scene->session.cloth;
	CHECK(cloth_narrow_piece(cloth) == 0);
	cloth_let_out(cloth);
	for (int t = 0; t < cloth->garment->triangle_count; t++) {
		CHECK_NEAR(wider(cloth, t, way), 0.25f, 1e-3f);
		CHECK_NEAR(wider(cloth, t, aside), 0.0f, 1e-3f);
	}
	scene_close(scene);
}

/* What stretches a little, as it is worn, stays as it is cut. */
static void test_enough(void)
{
	struct scene *scene = sheet((struct v2){1.0f, 0.0f}, 0.06f, 0.06f);
	CHECK(cloth_narrow_piece(&scene->session.cloth) == -1);
	scene_close(scene);
}

/* A T-shirt so much narrower or wider: the one that is let out is stretched, against the cloth as
 * it is cut, and holds both arms like the one that fits. */
static void test_shirt(float wide, bool narrow)
{
	struct scene *scene = shirt_of(wide, 1.0f);
	struct session *session = &scene->session;
	struct measure_scratch *measurer = measure_init(&scene->arena);
	struct measure measure;
	CHECK(scene_wrap(scene));
	measure_garment(&measure, &session->cloth, measurer);
	printf("shirt of %.2f: arms %d, facing in %d, edges through %d, strain p95 %.3f\n",
	       (double)wide, measure.arms_in_sleeves, measure.inverted_triangles,
	       measure.edge_crossings_body, (double)measure.strain_p95);
	CHECK(count_diagnoses(&session->wrap, "let_out") == (narrow ? 1 : 0));
	CHECK(measure.arms_in_sleeves == 2 && measure.vertices_inside == 0);
	CHECK(measure.inverted_triangles < 10 && measure.edge_crossings_body == 0);
	CHECK(narrow == (measure.strain_p95 > 0.25f));
	scene_close(scene);
}

/* What was let out stays so when an edit is taken back and made again. */
static void test_undo(void)
{
	struct scene *scene = shirt_of(0.85f, 1.0f);
	struct cloth *cloth = &scene->session.cloth;
	static struct widening before[PIECES_MAX];
	CHECK(scene_wrap(scene));
	memcpy(before, cloth->piece_wide, sizeof before);
	float strain = cloth_strain_mean(cloth);
	CHECK(before[0].step_m > 0.0f);
	CHECK(scene_edit(scene, EDIT_UNDO) && cloth->piece_wide[0].step_m == 0.0f);
	CHECK(scene_edit(scene, EDIT_REDO));
	CHECK(memcmp(before, cloth->piece_wide, sizeof before) == 0);
	CHECK(cloth_strain_mean(cloth) == strain);
	scene_close(scene);
}

int main(void)
{
	test_where();
	test_direction();
	test_enough();
	test_shirt(0.85f, true);
	test_shirt(1.0f, false);
	test_undo();
	return test_end();
}
