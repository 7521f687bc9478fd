/* The crew does every part once, and cloth moves by the same bits however many threads it is given.
 */
#include "cloth_private.h"
#include "cloth_self.h"
#include "shapes.h"
#include "test.h"
#include "threads.h"

#include <sched.h>
#include <time.h>

enum { WORKS = 3000, PARTS_MAX = 40, THREADS = 4, VERTICES = 6000, SWEEPS = 40 };

static struct threads threads;

static void start(int count)
{
	char fault[FAULT_BYTES] = "";
	bool started = threads_start(&threads, count, NULL, fault);
	if (!started)
		fprintf(stderr, "%s\n", fault);
	MUST(started);
}

/* ---- the crew ---- */

struct parts {
	int done[PARTS_MAX];
	int extra;
};

static void note(void *context, int part)
{
	struct parts *parts = context;
	parts->done[part] += 1 + parts->extra;
}

/* Many works, some after a rest in which the threads fall asleep: no part is left out, none is done
 * twice, all are done when the work returns. */
static void test_parts(int count)
{
	struct scatter scatter = {99u};
	int wrong = 0;
	start(count);
	for (int work = 0; work < WORKS; work++) {
		struct parts parts = {.extra = work};
		int asked = scatter_below(&scatter, PARTS_MAX + 1);
		if (work % 500 == 0)
			nanosleep(&(struct timespec){0, 3000000}, NULL);
		crew_run(threads_crew(&threads), note, &parts, asked);
		for (int part = 0; part < PARTS_MAX; part++)
			wrong += parts.done[part] != (part < asked ? 1 + work : 0);
	}
	CHECK(wrong == 0);
	threads_stop(&threads);
}

static void test_no_processor(void)
{
	const int cpu[2] = {0, CPU_SETSIZE - 1};
	char fault[FAULT_BYTES] = "";
	CHECK(!threads_start(&threads, 2, cpu, fault));
	CHECK(fault[0]);
	CHECK(!threads_crew(&threads));
	threads_stop(&threads);
}

/* ---- the cloth ---- */

static struct body body;
static struct garment garment;
static struct cloth cloth;
static struct pattern pattern;

static void mesh(struct garment_job *job)
{
	const struct v2 corner[4] = {
		{0.0f, 0.0f}, {900.0f, 0.0f}, {900.0f, 700.0f}, {0.0f, 700.0f}};
	struct piece *piece = &pattern.piece[0];
	bool done = false;
	*piece = (struct piece){.used = true, .point_count = 4, .name = "sheet"};
	for (int i = 0; i < 4; i++) {
		piece->point_mm[i] = corner[i];
		piece->corner[i] = true;
	}
	MUST(!garment_start(job, &garment, &pattern, VERTICES));
	while (!done)
		garment_advance(job, 1000000, &done);
}

/* A sheet over a ball, crumpled: it meets the ball and itself, some triangles are collapsed. */
static void lay(void)
{
	struct scatter scatter = {4711u};
	cloth_reset(&cloth, &garment, &body);
	for (int v = 0; v < garment.vertex_count; v++) {
		struct v2 p = garment.rest_m[v];
		float up = 0.0001f * (float)scatter_below(&scatter, 300);
		cloth.position_m[v] = (struct v3){0.4f * (p.x - 0.45f), 0.2f + up,
						  0.4f * (p.y - 0.35f)};
		cloth.placed[v] = 1;
	}
	cloth_weld(&cloth);
	cloth.worn = true;
}

static uint64_t moved(long *units)
{
	struct hash hash;
	lay();
	*units = 0;
	for (int sweep = 0; sweep < SWEEPS; sweep++)
		*units += cloth_sweep(&cloth);
	hash_init(&hash);
	for (int v = 0; v < garment.vertex_count; v++) {
		hash_float(&hash, cloth.position_m[v].x);
		hash_float(&hash, cloth.position_m[v].y);
		hash_float(&hash, cloth.position_m[v].z);
	}
	return hash.value;
}

static void test_cloth(void)
{
	long units[THREADS + 1];
	uint64_t hash[THREADS + 1];
	for (int count = 1; count <= THREADS; count++) {
		start(count);
		cloth.crew = threads_crew(&threads);
		hash[count] = moved(&units[count]);
		cloth.crew = NULL;
		threads_stop(&threads);
		CHECK(hash[count] == hash[1]);
		CHECK(units[count] == units[1]);
	}
	CHECK(cloth.scratch->strip_count >= 4);
	CHECK(cloth_crossings(&cloth) > 0);
}

static float ball_radius(int ring, int column)
{
	(void)ring, (void)column;
	return 0.18f;
}

int main(void)
{
	static unsigned char memory[192u << 20];
	static struct shape ball;
	struct arena arena;
	arena_init(&arena, memory, sizeof memory);
	body_init(&body, &arena);
	garment_init(&garment, &arena);
	struct garment_job *job = garment_job_init(&arena);
	cloth_init(&cloth, &arena);
	shape_globe(&ball, 40, 60, ball_radius);
	MUST(!body_build(&body, ball.position_m, ball.vertex_count, ball.triangle,
			 ball.triangle_count));
	for (int count = 1; count <= THREADS; count++)
		test_parts(count);
	test_no_processor();
	mesh(job);
	test_cloth();
	return test_end();
}
