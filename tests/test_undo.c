/* Undo: whole states come back bit for bit, forwards and backwards; a garment too large for
 * UNDO_STATES_MAX of its states costs old ones, never the near ones. */
#include "scene.h"
#include "session_undo.h"
#include "shapes.h"
#include "test.h"

enum { KEPT = 45 };

static struct session *session;

/* A square of cloth before the body, worn. */
static void wear(float half_mm, int vertices)
{
	static const float corner[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
	struct piece *piece = &session->document.pattern.piece[0];
	*piece = (struct piece){.used = true, .point_count = 4};
	for (int i = 0; i < 4; i++) {
		piece->point_mm[i] = (struct v2){half_mm * corner[i][0], half_mm * corner[i][1]};
		piece->corner[i] = true;
	}
	struct garment *garment = &session->garment;
	const char *fault = garment_start(session->mesher, garment, &session->document.pattern,
					  vertices);
	MUST(!fault);
	for (bool done = false; !done;)
		garment_advance(session->mesher, 1 << 20, &done);
	cloth_reset(&session->cloth, garment, &session->body);
	for (int v = 0; v < garment->vertex_count; v++) {
		session->cloth.position_m[v] = (struct v3){garment->rest_m[v].x,
							   garment->rest_m[v].y, 0.2f};
		session->cloth.placed[v] = true;
	}
	session->cloth.worn = true;
}

/* State `number` of a visit: another document and another place of every vertex. */
static uint64_t change(int number)
{
	session->document.pin[0].held_m.x = (float)number;
	for (int v = 0; v < session->garment.vertex_count; v++)
		session->cloth.position_m[v].z = 0.2f + 0.001f * (float)number;
	return session_hash(session);
}

/* Keeps states 0..KEPT-1, goes back as far as there is something, and forward again. Returns how
 * many steps there were. */
static int walk(void)
{
	uint64_t hash[KEPT + 1];
	for (int s = 0; s < KEPT; s++) {
		hash[s] = change(s);
		undo_keep(session);
	}
	hash[KEPT] = change(KEPT);
	int steps = 0;
	for (; undo_back(session); steps++)
		CHECK(session_hash(session) == hash[KEPT - 1 - steps]);
	CHECK(session->undo_count == 0);
	CHECK(session->redo_count == steps);
	for (int s = KEPT - steps + 1; s <= KEPT; s++) {
		CHECK(undo_forward(session));
		CHECK(session_hash(session) == hash[s]);
	}
	CHECK(!undo_forward(session));
	return steps;
}

static void test_small(void)
{
	wear(300.0f, 900);
	CHECK(walk() == UNDO_STATES_MAX - 1);
}

static void test_large(void)
{
	wear(600.0f, 14 * GARMENT_VERTICES_MAX / 16);
	int steps = walk();
	CHECK(steps >= UNDO_STATES_MAX / 2);
	CHECK(steps < UNDO_STATES_MAX - 1);
}

/* What could be redone is forgotten by a new edit, and its room is free again. */
static void test_branch(void)
{
	wear(300.0f, 900);
	for (int round = 0; round < 20; round++) {
		for (int s = 0; s < 10; s++) {
			change(10 * round + s);
			undo_keep(session);
		}
		uint64_t hash = change(-round);
		undo_keep(session);
		for (int s = 0; s < 8; s++)
			CHECK(undo_back(session));
		undo_keep(session);
		CHECK(session->redo_count == 0);
		CHECK(undo_back(session) && undo_forward(session));
		change(-round);
		undo_cancel(session);
		CHECK(session->redo_count == 0);
		CHECK(session_hash(session) != hash);
	}
}

int main(void)
{
	static struct shape shape;
	struct scene *scene = scene_open_empty();
	session = &scene->session;
	shape_box(&shape, 0.3f, 0.3f, 0.1f);
	MUST(!body_build(&session->body, shape.position_m, shape.vertex_count, shape.triangle,
			 shape.triangle_count));
	test_small();
	test_large();
	test_branch();
	scene_close(scene);
	return test_end();
}
