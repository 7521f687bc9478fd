/* The paper's own examples (S21) as journals on the mannequin: what moved by how much, what it did
 * to the cloth, and that what was put stays put. A journal's `settle` lines are its stations. */
#include "scene.h"
#include "test.h"

enum { STATIONS_MAX = 4, FULL_TURN = 360 };

/* The garment at one station. */
struct station {
	struct v3 position_m[GARMENT_VERTICES_MAX];
	struct measure measure;
};

struct example {
	struct scene *scene;
	struct measure_scratch *measurer;
	int count;
	struct station station[STATIONS_MAX];
	float held_strain_p95; /* the most at the end of a drag */
};

static struct example example;

static void note_station(void)
{
	const struct cloth *cloth = &example.scene->session.cloth;
	MUST(example.count < STATIONS_MAX);
	struct station *at = &example.station[example.count++];
	memcpy(at->position_m, cloth->position_m,
	       (size_t)cloth->garment->vertex_count * sizeof *at->position_m);
	measure_garment(&at->measure, cloth, example.measurer);
	/* nothing is ever in the body */
	CHECK(at->measure.vertices_inside == 0 && at->measure.midpoints_inside == 0);
	CHECK(at->measure.centres_inside == 0 && at->measure.edge_crossings_body == 0);
}

static void note_held(void)
{
	struct measure measure;
	measure_garment(&measure, &example.scene->session.cloth, example.measurer);
	example.held_strain_p95 = float_max(example.held_strain_p95, measure.strain_p95);
}

static void play(const char *name)
{
	static char line[JOURNAL_LINE_MAX];
	char path[80], fault[160];
	struct scene *scene = example.scene;
	snprintf(path, sizeof path, "tests/journals/%s.kitsuke", name);
	FILE *file = fopen(path, "r");
	MUST(file);
	example.count = 0;
	example.held_strain_p95 = 0.0f;
	CHECK(scene_edit(scene, EDIT_CLEAR));
	while (fgets(line, sizeof line, file)) {
		enum journal_result result = journal_read(line, (int)strlen(line), &scene->edit,
							  fault);
		CHECK(result != JOURNAL_FAULT);
		if (result != JOURNAL_EDIT)
			continue;
		enum edit_kind kind = scene->edit.kind;
		if (kind == EDIT_RELEASE)
			note_held();
		CHECK(session_apply(&scene->session, &scene->edit));
		if (kind == EDIT_SETTLE)
			note_station();
	}
	fclose(file);
}

static struct v3 place(int station, int piece, float x_mm, float y_mm)
{
	const struct session *session = &example.scene->session;
	struct v3 point = {0.0f, 0.0f, 0.0f};
	float weight[3];
	int t = garment_locate(&session->garment, piece, (struct v2){x_mm, y_mm}, weight);
	MUST(t >= 0);
	for (int k = 0; k < 3; k++)
		point = v3_mad(point,
			       example.station[station].position_m[session->cloth.triangle[t].v[k]],
			       weight[k]);
	return point;
}

static float moved_mm(int from, int to, int piece, float x_mm, float y_mm)
{
	return 1e3f * v3_distance(place(from, piece, x_mm, y_mm), place(to, piece, x_mm, y_mm));
}

/* The mean angle about the vertical axis by which the garment went from a station to another: with
 * the sun, seen from above, is negative. Particles lie evenly round the body, so what the one
 * gains where the body is flat another loses. */
static float turned_degrees(int from, int to)
{
	const struct cloth *cloth = &example.scene->session.cloth;
	float sum = 0.0f;
	int count = 0;
	for (int v = 0; v < cloth->garment->vertex_count; v++) {
		struct v3 a = example.station[from].position_m[v];
		struct v3 b = example.station[to].position_m[v];
		if (cloth->particle[v] != v)
			continue;
		float turn = angle_atan2(b.x, b.z) - angle_atan2(a.x, a.z);
		turn += turn < -0.5f * PI_F ? 2.0f * PI_F : 0.0f;
		sum += turn;
		count++;
	}
	return sum / (float)count * (0.5f * (float)FULL_TURN / PI_F);
}

static void say(const char *name)
{
	for (int i = 0; i < example.count; i++) {
		const struct measure *m = &example.station[i].measure;
		printf("%s %d: strain p95 %.3f, max %.3f; facing in %d, creased %d; crossing "
		       "itself %d\n",
		       name, i, (double)m->strain_p95, (double)m->strain_max, m->inverted_triangles,
		       m->creased_triangles, m->self_intersections);
	}
}

/* A quarter of the way round the trunk by one stroke: the whole skirt follows, is not stretched by
 * it, and stays. */
static void check_skirt(void)
{
	play("skirt-turned");
	say("skirt");
	const struct measure *before = &example.station[0].measure;
	const struct measure *after = &example.station[1].measure;
	float turn = turned_degrees(0, 1);
	printf("skirt: turned by %.1f degrees of 90; strain p95 %.3f held\n", (double)turn,
	       (double)example.held_strain_p95);
	CHECK_NEAR(turn, 90.0f, 4.5f);
	CHECK(example.held_strain_p95 < 0.05f);
	CHECK(after->strain_p95 < before->strain_p95 + 0.01f && after->strain_max < 0.25f);
	CHECK(after->inverted_triangles == 0 && after->self_intersections == 0);
}

/* Worn, rolled up, relaxed, without pins. */
static void check_sleeves(void)
{
	play("sleeves-rolled");
	say("sleeves");
	static const struct {
		int piece;
		float x_mm, y_mm;
	} hem[4] = {{0, 355, -180}, {1, -355, -180}, {0, -355, -180}, {1, 355, -180}};
	for (int i = 0; i < COUNT_OF(hem); i++) {
		float rolled = moved_mm(0, 1, hem[i].piece, hem[i].x_mm, hem[i].y_mm);
		float relaxed = moved_mm(1, 2, hem[i].piece, hem[i].x_mm, hem[i].y_mm);
		float unpinned = moved_mm(2, 3, hem[i].piece, hem[i].x_mm, hem[i].y_mm);
		printf("sleeves: hem up %.1f mm; RELAX moves it by %.1f, no pins by %.1f\n",
		       (double)rolled, (double)relaxed, (double)unpinned);
		CHECK(rolled > 50.0f);
		CHECK(relaxed < 30.0f);
		CHECK(unpinned < 20.0f);
	}
	for (int i = 0; i < example.count; i++) {
		const struct measure *m = &example.station[i].measure;
		CHECK(m->arms_in_sleeves == 2 && m->head_through_collar);
		CHECK(m->inverted_triangles == m->creased_triangles && m->strain_p95 < 0.13f);
	}
}

static void check_poncho(void)
{
	play("poncho");
	say("poncho");
	float front = 1e3f * (place(1, 0, 0.0f, -250.0f).x - place(0, 0, 0.0f, -250.0f).x);
	printf("poncho: its front went %.1f mm aside and stayed\n", (double)front);
	CHECK(front > 15.0f);
	CHECK(example.held_strain_p95 < 0.05f);
	for (int i = 0; i < example.count; i++) {
		const struct measure *m = &example.station[i].measure;
		CHECK(m->head_through_collar && m->strain_p95 < 0.05f);
		/* a hanging corner may turn in by itself */
		CHECK(m->inverted_triangles < m->triangles / 200);
	}
}

static void check_askew(void)
{
	play("askew-righted");
	say("askew");
	float front[2], back[2];
	for (int i = 0; i < 2; i++) {
		front[i] = 1e3f * place(i, 0, 0.0f, -280.0f).x;
		back[i] = 1e3f * place(i, 1, 0.0f, -280.0f).x;
	}
	printf("askew: hem's middle in front %.1f, then %.1f mm aside; behind %.1f, %.1f\n",
	       (double)front[0], (double)front[1], (double)back[0], (double)back[1]);
	CHECK(front[0] > 30.0f && back[0] < -30.0f);
	CHECK(float_abs(front[1]) < 12.0f && float_abs(back[1]) < 12.0f);
	CHECK(example.station[1].measure.strain_p95 < 0.06f);
	CHECK(example.station[1].measure.arms_in_sleeves == 2);
}

int main(void)
{
	example.scene = scene_open();
	example.measurer = measure_init(&example.scene->arena);
	check_skirt();
	check_sleeves();
	check_poncho();
	check_askew();
	scene_close(example.scene);
	return test_end();
}
