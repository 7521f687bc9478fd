/* What the solver costs and how well it holds: a poncho (a square of 1.25 m with a hole of 12 cm
 * radius for the neck) falls on the mannequin's shoulders.
 *
 *   bench_cloth [VERTICES ...]      2000 8000 when none is named
 *
 * Times are thread CPU time; a frame is ten sweeps, contact included. "kernels": projections a
 * second of each form of the inner loops, on the batches of the draped poncho. "threads": the time
 * that passes in a frame of the draped poncho, the quickest of many taken in turn, so that what
 * else the machine does counts little. */
#include "cloth_private.h"
#include "threads.h"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { SWEEPS = 10, FRAMES = 240, NOTCH_POINTS = 24, LAPS = 200, CREWS = 4, CREW_LAPS = 40 };

static const float side_mm = 1250.0f, hole_mm = 120.0f;

static struct body body;
static struct garment garment;
static struct cloth cloth;
static struct garment_job *job;
static struct pattern pattern;

_Noreturn void must_fail(const char *condition, const char *file, int line)
{
	fprintf(stderr, "%s:%d: %s\n", file, line, condition);
	abort();
}

static double thread_s(void)
{
	struct timespec now;
	clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
	return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Half of the square, y up from the line through the hole; the hole is a notch in the lower edge.
 */
static void add_half(int index)
{
	struct piece *piece = &pattern.piece[index];
	float half = 0.5f * side_mm;
	*piece = (struct piece){.used = true, .name = "half"};
	struct v2 corner[6] = {{hole_mm, 0.0f}, {half, 0.0f},  {half, half},
			       {-half, half},   {-half, 0.0f}, {-hole_mm, 0.0f}};
	for (int i = 0; i < 6; i++) {
		piece->corner[piece->point_count] = true;
		piece->point_mm[piece->point_count++] = corner[i];
	}
	for (int i = NOTCH_POINTS - 1; i > 0; i--) {
		float angle = PI_F * (float)i / NOTCH_POINTS;
		piece->point_mm[piece->point_count++] = (struct v2){hole_mm * angle_cos(angle),
								    hole_mm * angle_sin(angle)};
	}
}

/* Edge 0 of a half is sewn to edge 4 of the other: the shoulders. */
static void sew(void)
{
	memset(&pattern, 0, sizeof pattern);
	add_half(0);
	add_half(1);
	pattern.seam[0] = (struct seam){.used = true, .a = {0, 0}, .b = {1, 4}};
	pattern.seam[1] = (struct seam){.used = true, .a = {0, 4}, .b = {1, 0}};
}

/* The highest place of the body beside the hole. */
static float shoulder_m(void)
{
	float high = -9.0f;
	for (int v = 0; v < body.vertex_count; v++)
		if (float_abs(body.position_m[v].x) > 0.0009f * hole_mm)
			high = float_max(high, body.position_m[v].y);
	return high;
}

static void lay(int vertices)
{
	bool done = false;
	const char *fault = garment_start(job, &garment, &pattern, vertices);
	for (int i = 0; !fault && !done && i < 100000; i++)
		garment_advance(job, 1000000, &done);
	if (fault || !done) {
		fprintf(stderr, "bench_cloth: %s\n", fault ? fault : "never meshed");
		exit(1);
	}
	cloth_reset(&cloth, &garment, &body);
	float height = shoulder_m() + 0.03f;

	for (int v = 0; v < garment.vertex_count; v++) {
		struct v2 p = garment.rest_m[v];
		float sign = garment.piece[v] == 0 ? -1.0f : 1.0f;
		cloth.position_m[v] = (struct v3){sign * p.x, height, sign * p.y};
		cloth.placed[v] = 1;
	}
	cloth_weld(&cloth);
	cloth.worn = true;
}

/* The larger singular value of the deformation, minus 1. */
static void stretches(float *mean, float *most)
{
	double sum = 0.0;
	*most = 0.0f;
	for (int t = 0; t < garment.triangle_count; t++) {
		float strain = cloth_stretch(&cloth, t);
		sum += (double)strain;
		*most = float_max(*most, strain);
	}
	*mean = (float)(sum / garment.triangle_count);
}

static double best_s(double best, double start)
{
	double spent = thread_s() - start;
	return spent < best ? spent : best;
}

/* The best of many laps: on a machine that does other things too, what the kernel can do. */
static void kernels(void)
{
	static const int forms[] = {1, 4, 8};
	struct cloth_scratch *s = cloth.scratch;
	for (int f = 0; f < COUNT_OF(forms); f++) {
		const struct kernel *kernel = kernel_of(forms[f]);
		double shape = 1.0, flat = 1.0;
		for (int lap = 0; lap < LAPS; lap++) {
			double start = thread_s();
			kernel->shape(s->place, s->shape, NULL, s->shape_first[GROUPS_MAX], 0.9f,
				      1.0f, false);
			shape = best_s(shape, start);
			start = thread_s();
			kernel->flatten(s->place, s->bends, NULL, s->bends_first[GROUPS_MAX], 0.02f,
					false);
			flat = best_s(flat, start);
		}
		printf("  %d lanes: %6.1f M triangles/s  %6.1f M edges/s\n", forms[f],
		       1e-6 * garment.triangle_count / shape, 1e-6 * cloth.flat_count / flat);
	}
}

static double passed_s(void)
{
	struct timespec now;
	clock_gettime(CLOCK_MONOTONIC, &now);
	return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void crews(void)
{
	static struct threads threads[CREWS + 1];
	double best[CREWS + 1];
	char fault[FAULT_BYTES];
	for (int count = 1; count <= CREWS; count++) {
		best[count] = 1e9;
		if (!threads_start(&threads[count], count, NULL, fault)) {
			printf("  %s\n", fault);
			return;
		}
	}
	for (int lap = 0; lap < CREW_LAPS; lap++)
		for (int count = 1; count <= CREWS; count++) {
			cloth.crew = threads_crew(&threads[count]);
			double start = passed_s();
			for (int sweep = 0; sweep < SWEEPS; sweep++)
				cloth_sweep(&cloth);
			double spent = passed_s() - start;
			best[count] = spent < best[count] ? spent : best[count];
		}
	cloth.crew = NULL;
	for (int count = 1; count <= CREWS; count++) {
		threads_stop(&threads[count]);
		printf("  %d threads: frame %.2f ms, %.2f times as quick as one\n", count,
		       1e3 * best[count], best[1] / best[count]);
	}
}

static void drape(int vertices)
{
	lay(vertices);
	double worst = 0.0, start = thread_s();
	for (int frame = 0; frame < FRAMES; frame++) {
		double begin = thread_s();
		for (int sweep = 0; sweep < SWEEPS; sweep++)
			cloth_sweep(&cloth);
		cloth_finish(&cloth);
		double spent = thread_s() - begin;
		worst = spent > worst ? spent : worst;
	}
	double frame = (thread_s() - start) / FRAMES;
	float mean, most, low = 9.0f, high = -9.0f;
	stretches(&mean, &most);
	for (int v = 0; v < garment.vertex_count; v++) {
		low = float_min(low, cloth.position_m[v].y);
		high = float_max(high, cloth.position_m[v].y);
	}
	printf("%d vertices: frame %.2f ms, worst %.2f ms, %.1f ns a vertex and sweep; "
	       "stretch %.2f %% mean, %.1f %% most; y %.2f to %.2f m\n",
	       garment.vertex_count, 1e3 * frame, 1e3 * worst,
	       1e9 * frame / SWEEPS / garment.vertex_count, (double)(100.0f * mean),
	       (double)(100.0f * most), (double)low, (double)high);
	crews();
	kernels();
}

int main(int argc, char **argv)
{
	static unsigned char memory[512u << 20];
	struct arena arena;
	arena_init(&arena, memory, sizeof memory);
	body_init(&body, &arena);
	garment_init(&garment, &arena);
	job = garment_job_init(&arena);
	cloth_init(&cloth, &arena);
	if (body_build_mannequin(&body))
		return 1;
	sew();
#ifdef __x86_64__
	cloth.lanes = __builtin_cpu_supports("avx2") ? 8 : 4;
#endif
	for (int i = 1; i < argc; i++)
		drape(atoi(argv[i]));
	if (argc == 1) {
		drape(2000);
		drape(8000);
	}
	return 0;
}
