/* Garments over garments: a top, a skirt, an open coat over a T-shirt, and the other way round. */
#include "cloth_self.h"
#include "measure.h"
#include "scene.h"
#include "test.h"

/* Mean distance from the body of a garment's cloth round the waist, where both lie close. */
static float waist_m(const struct session *session, int first_piece, int end_piece)
{
	const struct cloth *cloth = &session->cloth;
	float sum = 0.0f;
	int count = 0;
	for (int v = 0; v < session->garment.vertex_count; v++) {
		struct v3 p = cloth->position_m[v];
		struct body_hit hit;
		if (session->garment.piece[v] < first_piece ||
		    session->garment.piece[v] >= end_piece || p.y < 1.0f || p.y > 1.1f)
			continue;
		body_nearest(&session->body, p, 0, &hit);
		sum += hit.distance_m;
		count++;
	}
	CHECK(count > 50);
	return sum / (float)int_max(count, 1);
}

/* `shirt_over`: the shirt is put into a higher layer than the top, which was drawn after it. */
static void test_order(bool shirt_over)
{
	struct scene *scene = scene_open();
	struct session *session = &scene->session;
	CHECK(scene_play(scene, "tests/journals/vest-over-tshirt.kitsuke") == 0);
	if (shirt_over) {
		scene->edit.i[0] = 0;
		scene->edit.i[1] = 1;
		CHECK(scene_edit(scene, EDIT_LAYER));
	}
	CHECK(scene_wrap(scene));
	for (int frame = 0; frame < 90; frame++)
		session_advance(session);
	float shirt_m = waist_m(session, 0, 2), top_m = waist_m(session, 2, 4);
	CHECK(shirt_over ? shirt_m > top_m + 0.001f : top_m > shirt_m + 0.001f);
	CHECK(cloth_crossings(&session->cloth) < 40);
	scene_close(scene);
}

/* Does a ray from p along the unit vector `way` meet the triangle within 30 mm? */
static bool meets(struct v3 p, struct v3 way, const struct v3 corner[3])
{
	struct v3 e1 = v3_sub(corner[1], corner[0]), e2 = v3_sub(corner[2], corner[0]);
	struct v3 across = v3_cross(way, e2), from = v3_sub(p, corner[0]);
	float volume = v3_dot(e1, across), u = v3_dot(from, across) / volume;
	struct v3 aside = v3_cross(from, e1);
	float w = v3_dot(way, aside) / volume, far_m = v3_dot(e2, aside) / volume;
	return volume != 0.0f && u >= 0.0f && w >= 0.0f && u + w <= 1.0f && far_m > 0.0f &&
	       far_m < 0.03f;
}

static bool behind_inner(const struct session *session, int v)
{
	const struct garment *garment = &session->garment;
	const struct v3 *x = session->cloth.position_m;
	struct body_hit hit;
	body_nearest(&session->body, x[v], 0, &hit);
	struct v3 way = v3_normalize(v3_sub(x[v], hit.point_m));
	for (int t = 0; hit.distance_m < 0.06f && t < garment->triangle_count; t++) {
		const int *w = session->cloth.triangle[t].v;
		const struct v3 corner[3] = {x[w[0]], x[w[1]], x[w[2]]};
		if (garment->layer[garment->triangle_piece[t]] <
			    garment->layer[garment->piece[v]] &&
		    v3_distance(x[v], corner[0]) < 0.1f && meets(x[v], way, corner))
			return true;
	}
	return false;
}

/* Vertices of outer garments with inner cloth before them, seen from the body. */
static int behind_inners(const struct session *session)
{
	int count = 0;
	for (int v = 0; v < session->garment.vertex_count; v++)
		count += behind_inner(session, v);
	return count;
}

/* A whole visit: at every `settle` (worn; after a pull at the outer garment; after RELAX) nothing
 * is in the body, and no more than `most` triangles cross or vertices lie behind inner cloth.
 * `shirt_over`: the first piece's garment goes over all others before the wrap; ends there. */
static void test_visit(const char *path, bool shirt_over, int most)
{
	static char line[JOURNAL_LINE_MAX];
	struct scene *scene = scene_open();
	struct session *session = &scene->session;
	struct measure_scratch *measurer = measure_init(&scene->arena);
	struct measure measure;
	char fault[160];
	int settled = 0;
	FILE *file = fopen(path, "r");
	MUST(file);
	while (fgets(line, sizeof line, file) && !(shirt_over && settled > 0)) {
		enum journal_result result = journal_read(line, (int)strlen(line), &scene->edit,
							  fault);
		CHECK(result != JOURNAL_FAULT);
		if (result != JOURNAL_EDIT)
			continue;
		enum edit_kind kind = scene->edit.kind;
		if (shirt_over && kind == EDIT_WRAP) {
			scene->edit.i[0] = 0;
			scene->edit.i[1] = 1;
			CHECK(scene_edit(scene, EDIT_LAYER));
			scene->edit.kind = EDIT_WRAP;
		}
		CHECK(session_apply(session, &scene->edit));
		if (kind != EDIT_SETTLE)
			continue;
		measure_garment(&measure, &session->cloth, measurer);
		int behind = behind_inners(session);
		printf("%s %d: crossing %d, behind inner cloth %d, facing in %d\n", path, settled,
		       measure.self_intersections, behind, measure.inverted_triangles);
		CHECK(measure.vertices_inside == 0 && measure.midpoints_inside == 0);
		CHECK(measure.centres_inside == 0 && measure.edge_crossings_body == 0);
		CHECK(measure.inverted_triangles == 0);
		CHECK(measure.self_intersections <= most && behind <= most);
		settled++;
	}
	fclose(file);
	scene_close(scene);
	CHECK(settled > 0);
}

static void test_refusals(void)
{
	struct scene *scene = scene_open();
	CHECK(scene_play(scene, "tests/journals/tshirt.kitsuke") == 0);
	scene->edit.i[0] = 5;
	scene->edit.i[1] = 1;
	CHECK(!scene_edit(scene, EDIT_LAYER));
	scene->edit.i[0] = 1;
	scene->edit.i[1] = 10;
	CHECK(!scene_edit(scene, EDIT_LAYER));
	scene->edit.i[1] = 9;
	CHECK(scene_edit(scene, EDIT_LAYER));
	CHECK(scene->session.document.pattern.piece[1].worn_over == 9);
	CHECK(scene_edit(scene, EDIT_UNDO));
	CHECK(scene->session.document.pattern.piece[1].worn_over == 0);
	scene_close(scene);
}

int main(void)
{
	test_order(false);
	test_order(true);
	test_visit("tests/journals/skirt-over-tshirt.kitsuke", false, 20);
	test_visit("tests/journals/skirt-over-tshirt.kitsuke", true, 0);
	test_visit("tests/journals/coat-over-tshirt.kitsuke", false, 3);
	test_refusals();
	return test_end();
}
