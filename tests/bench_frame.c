/* What a frame costs, stage by stage, on a tape played through the stages of kiosk_frame:
 *
 *   bench_frame [--no-pictures] [TAPE]      the bundled tape when none is named
 *
 * Only frames in which a stage did something count for it. Times are wall time; "cpu" is the
 * processors' time of all threads, which says most on a machine that does other things too. "ref"
 * is that time in units of a fixed kernel measured between the frames of the same run (the shapes
 * of 1,000 triangles restored): it compares machines.
 *
 * "whole frame" is kiosk_frame, without the picture.
 *
 * The drag and the contact of cloth with cloth are measured inside session_advance: the linker
 * sends the calls of drag_move and cloth_self through __wrap_* below (Makefile), so that the core
 * needs no clock. "cloth sweeps" is without both. */
#include "cloth_self.h"
#include "kiosk.h"
#include "snapshot.h"
#include "tape.h"

#include <GLES3/gl3.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum {
	FRAMES_MAX = 20000,
	REF_TRIANGLES = 1000,
	REF_EVERY = 16,    /* frames */
	PICTURES_MAX = 80, /* spread over the tape */
};

static const double budget_us = 1e6 / FRAME_RATE_HZ;

enum stage {
	STAGE_PEN,
	STAGE_FACE,
	STAGE_EDITS,
	STAGE_MESH,
	STAGE_WRAP,
	STAGE_DRAG,
	STAGE_CLOTH,
	STAGE_SELF,
	STAGE_FRAME,
	STAGE_DRAW,
	STAGE_COUNT,
};

static const struct {
	const char *name, *work;
} stages[STAGE_COUNT] = {
	{"pen", "reports"},        {"face", "samples"},       {"edits", "edits"},
	{"mesh job", "units"},     {"wrap job", "units"},     {"drag", "units"},
	{"cloth sweeps", "units"}, {"self-contact", "units"}, {"whole frame", "units"},
	{"draw", "picture"},
};

struct instant {
	double us, cpu_us;
};

struct series {
	int count;
	double work, work_max, cpu_us;
	double us[FRAMES_MAX];
};

struct bench {
	struct kiosk kiosk;
	struct tape tape;
	struct snapshot snapshot;
	struct series stage[STAGE_COUNT], reference;
	bool pictures;
	int frames_a_picture;
};

static struct bench bench;

/* ---- clock ---- */

static double clock_us(clockid_t clock)
{
	struct timespec now;
	clock_gettime(clock, &now);
	return (double)now.tv_sec * 1e6 + (double)now.tv_nsec * 1e-3;
}

static struct instant instant_now(void)
{
	return (struct instant){clock_us(CLOCK_MONOTONIC), clock_us(CLOCK_PROCESS_CPUTIME_ID)};
}

static struct instant since(struct instant start)
{
	struct instant now = instant_now();
	return (struct instant){now.us - start.us, now.cpu_us - start.cpu_us};
}

static void series_add(struct series *series, struct instant spent, double work)
{
	if (series->count == FRAMES_MAX)
		return;
	series->us[series->count++] = spent.us;
	series->cpu_us += spent.cpu_us;
	series->work += work;
	series->work_max = work > series->work_max ? work : series->work_max;
}

/* ---- the drag, caught on its way from session_advance ---- */

static struct instant drag_spent;
static long drag_units;

long __real_drag_move(struct drag *drag, struct v3 target_m);
long __wrap_drag_move(struct drag *drag, struct v3 target_m);

long __wrap_drag_move(struct drag *drag, struct v3 target_m)
{
	struct instant start = instant_now();
	drag_units = __real_drag_move(drag, target_m);
	drag_spent = since(start);
	return drag_units;
}

static struct instant self_spent;
static long self_units;

long __real_cloth_self(struct cloth *cloth);
long __wrap_cloth_self(struct cloth *cloth);

long __wrap_cloth_self(struct cloth *cloth)
{
	struct instant start = instant_now();
	long units = __real_cloth_self(cloth);
	struct instant spent = since(start);
	self_spent.us += spent.us;
	self_spent.cpu_us += spent.cpu_us;
	self_units += units;
	return units;
}

/* ---- the reference ---- */

static struct v3 ref_point[REF_TRIANGLES + 2];

static void reference_reset(void)
{
	for (int i = 0; i < REF_TRIANGLES + 2; i++)
		ref_point[i] = (struct v3){0.011f * (float)(i / 2), 0.010f * (float)(i & 1),
					   0.001f * (float)(i % 7)};
}

/* A strip of triangles, each edge pulled half of the way to its length: the loads, square roots
 * and stores of the solver, but none of its code. */
static void reference_pass(void)
{
	for (int t = 0; t < REF_TRIANGLES; t++) {
		for (int k = 0; k < 3; k++) {
			struct v3 *a = &ref_point[t + k], *b = &ref_point[t + (k + 1) % 3];
			struct v3 edge = v3_sub(*b, *a);
			float length = sqrtf(v3_dot(edge, edge)) + 1e-6f;
			struct v3 move = v3_scale(edge, 0.25f * (1.0f - 0.012f / length));
			*a = v3_add(*a, move);
			*b = v3_sub(*b, move);
		}
	}
}

static void reference_measure(void)
{
	reference_reset();
	struct instant start = instant_now();
	reference_pass();
	series_add(&bench.reference, since(start), 1.0);
}

/* ---- the frames ---- */

static void advance_timed(struct kiosk *kiosk)
{
	enum session_job job = kiosk->session.job;
	drag_spent = (struct instant){0};
	self_spent = (struct instant){0};
	drag_units = self_units = 0;
	struct instant start = instant_now();
	kiosk_advance(kiosk);
	struct instant spent = since(start);
	long units = kiosk->session.frame_units;
	if (job == JOB_MESH) {
		series_add(&bench.stage[STAGE_MESH], spent, (double)units);
	} else if (job == JOB_WRAP) {
		series_add(&bench.stage[STAGE_WRAP], spent, (double)units);
	} else if (units > 0) {
		spent.us -= drag_spent.us + self_spent.us;
		spent.cpu_us -= drag_spent.cpu_us + self_spent.cpu_us;
		units -= drag_units + self_units;
		series_add(&bench.stage[STAGE_CLOTH], spent, (double)units);
		series_add(&bench.stage[STAGE_SELF], self_spent, (double)self_units);
	}
	if (drag_spent.us > 0.0)
		series_add(&bench.stage[STAGE_DRAG], drag_spent, (double)drag_units);
}

/* kiosk_frame, one stage at a time. */
static void frame_timed(struct kiosk *kiosk, const struct frame_reports *reports,
			unsigned unplugged)
{
	struct instant begin = instant_now(), start = begin;
	kiosk_listen(kiosk, reports, unplugged);
	if (reports->count > 0 || unplugged)
		series_add(&bench.stage[STAGE_PEN], since(start), reports->count);
	start = instant_now();
	kiosk_face(kiosk);
	if (kiosk->input.sample_count > 0)
		series_add(&bench.stage[STAGE_FACE], since(start), kiosk->input.sample_count);
	start = instant_now();
	kiosk_apply(kiosk);
	if (kiosk->edits.count > 0)
		series_add(&bench.stage[STAGE_EDITS], since(start), kiosk->edits.count);
	advance_timed(kiosk);
	series_add(&bench.stage[STAGE_FRAME], since(begin), (double)kiosk->session.frame_units);
}

static void draw_timed(struct kiosk *kiosk)
{
	struct instant start = instant_now();
	draw_frame(bench.snapshot.draw, &kiosk->ui, &kiosk->session);
	display_present(bench.snapshot.display);
	series_add(&bench.stage[STAGE_DRAW], since(start), 1.0);
}

static void run(void)
{
	static struct frame_reports reports;
	struct kiosk *kiosk = &bench.kiosk;
	size_t cursor = 0;
	for (int frame = 0; frame < bench.tape.frame_count; frame++) {
		unsigned unplugged = tape_frame(&bench.tape, frame, &cursor, &reports);
		frame_timed(kiosk, &reports, unplugged);
		if (frame % REF_EVERY == 0)
			reference_measure();
		if (bench.pictures && frame % bench.frames_a_picture == 0)
			draw_timed(kiosk);
	}
}

/* ---- the table ---- */

static int by_value(const void *a, const void *b)
{
	double x = *(const double *)a, y = *(const double *)b;
	return (x > y) - (x < y);
}

static double mean_us(const struct series *series)
{
	double sum = 0.0;
	for (int i = 0; i < series->count; i++)
		sum += series->us[i];
	return sum / int_max(series->count, 1);
}

static void print_stage(enum stage stage, double reference_us)
{
	struct series *series = &bench.stage[stage];
	if (series->count == 0) {
		printf("%-13s %6d  never ran on this tape\n", stages[stage].name, 0);
		return;
	}
	qsort(series->us, (size_t)series->count, sizeof series->us[0], by_value);
	double mean = mean_us(series), cpu = series->cpu_us / series->count;
	double worst = series->us[series->count - 1];
	printf("%-13s %6d %9.1f %9.1f %9.1f %9.1f %6.1f%% %6.1f%% %8.2f %9.0f %9.0f %s\n",
	       stages[stage].name, series->count, mean,
	       series->us[(99 * series->count + 99) / 100 - 1], worst, cpu,
	       100.0 * mean / budget_us, 100.0 * worst / budget_us, cpu / reference_us,
	       series->work / series->count, series->work_max, stages[stage].work);
}

static void print_table(const char *tape_path)
{
	struct series *reference = &bench.reference;
	double reference_us = reference->cpu_us / reference->count;
	enum stage last = bench.pictures ? STAGE_DRAW : STAGE_FRAME;
	qsort(reference->us, (size_t)reference->count, sizeof reference->us[0], by_value);
	printf("%s: %d frames, %d vertices; a frame has %.0f us; ref = %.2f us (best %.2f)\n",
	       tape_path, bench.tape.frame_count, bench.kiosk.session.garment.vertex_count,
	       budget_us, reference_us, reference->us[0]);
	printf("%-13s %6s %9s %9s %9s %9s %7s %7s %8s %9s %9s\n", "microseconds", "frames", "mean",
	       "p99", "worst", "cpu", "of it", "worst", "refs", "work", "worst");
	for (enum stage stage = 0; stage <= last; stage++)
		print_stage(stage, reference_us);
	if (bench.pictures)
		printf("draw: every %d. frame, %d x %d, %s\n", bench.frames_a_picture,
		       bench.snapshot.width, bench.snapshot.height,
		       (const char *)glGetString(GL_RENDERER));
}

/* ---- start ---- */

static bool tape_load(const char *path)
{
	char wrong[200], fault[FAULT_BYTES];
	size_t size;
	char *text = store_read(path, &size, fault);
	if (!text) {
		fprintf(stderr, "bench_frame: %s\n", fault);
		return false;
	}
	bool read = tape_read(&bench.tape, text, size, wrong);
	if (!read)
		fprintf(stderr, "bench_frame: %s: %s\n", path, wrong);
	free(text);
	return read;
}

static void start(void *memory)
{
	struct kiosk *kiosk = &bench.kiosk;
	kiosk_init(kiosk, memory, bench.tape.width_px, bench.tape.height_px);
	MUST(!body_build_mannequin(&kiosk->session.body));
	body_find_parts(&kiosk->session.body);
	if (bench.tape.budget_units > 0)
		kiosk->session.budget_units = bench.tape.budget_units;
	for (int d = 0; d < TAPE_DEVICES_MAX; d++) {
		const struct tape_device *device = &bench.tape.device[d];
		if (!device->used)
			continue;
		pen_describe(&kiosk->pen, d, device->descriptor, device->descriptor_size);
		if (device->width_mm > 0.0f)
			pen_resize(&kiosk->pen, d, device->width_mm, device->height_mm);
	}
	char fault[FAULT_BYTES];
	if (bench.pictures &&
	    !snapshot_open(&bench.snapshot, bench.tape.width_px, bench.tape.height_px, fault)) {
		printf("without pictures: %s\n", fault);
		bench.pictures = false;
	}
	bench.frames_a_picture = int_max(1, bench.tape.frame_count / PICTURES_MAX);
	if (bench.pictures) /* what is made once belongs to the start */
		draw_frame(bench.snapshot.draw, &kiosk->ui, &kiosk->session);
}

int main(int argc, char **argv)
{
	const char *path = "tests/tapes/tshirt.hid";
	bench.pictures = true;
	for (int i = 1; i < argc; i++) {
		if (!strcmp(argv[i], "--no-pictures"))
			bench.pictures = false;
		else
			path = argv[i];
	}
	void *memory = malloc(KIOSK_MEMORY_BYTES);
	MUST(memory);
	if (!tape_load(path))
		return EXIT_FAILURE;
	if (bench.tape.width_px == 0) {
		bench.tape.width_px = 1280;
		bench.tape.height_px = 720;
	}
	start(memory);
	run();
	print_table(path);
	if (bench.pictures)
		snapshot_close(&bench.snapshot);
	tape_free(&bench.tape);
	free(memory);
	return EXIT_SUCCESS;
}
