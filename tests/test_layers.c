/* Garments over garments: a top over a T-shirt, and the other way round. */
#include "cloth_self.h"
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
	test_refusals();
	return test_end();
}
