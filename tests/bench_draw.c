/* What a frame costs, part by part: build/release/tests/bench_draw [sweeps a frame]. A T-shirt of
 * about 5,000 vertices on the mannequin, in memory. Milliseconds: wall time, the best and the
 * middle of FRAMES frames, and the processors' time of all threads (the middle), which says most on
 * a machine that does other things too. Each part is finished before the next begins. */
#include "display.h"
#include "draw_private.h"
#include "scene.h"

#include <time.h>

enum { FRAMES = 60, VERTICES = 5000, PARTS_MAX = 12 };

struct part {
	const char *name;
	double ms[FRAMES], cpu_ms[FRAMES];
};

struct bench {
	struct draw *draw;
	struct ui ui;
	struct session *session;
	struct part part[PARTS_MAX];
	int part_count, frame;
	double mark_ms, mark_cpu_ms;
};

static double now_ms(clockid_t clock)
{
	struct timespec now;
	clock_gettime(clock, &now);
	return (double)now.tv_sec * 1e3 + (double)now.tv_nsec / 1e6;
}

static void lap(struct bench *bench, int part, const char *name)
{
	glFinish();
	double ms = now_ms(CLOCK_MONOTONIC), cpu_ms = now_ms(CLOCK_PROCESS_CPUTIME_ID);
	bench->part[part].name = name;
	bench->part[part].ms[bench->frame] = ms - bench->mark_ms;
	bench->part[part].cpu_ms[bench->frame] = cpu_ms - bench->mark_cpu_ms;
	bench->part_count = int_max(bench->part_count, part + 1);
	bench->mark_ms = now_ms(CLOCK_MONOTONIC);
	bench->mark_cpu_ms = now_ms(CLOCK_PROCESS_CPUTIME_ID);
}

/* draw_frame's stages, one at a time. */
static void frame_in_parts(struct bench *bench)
{
	struct draw *draw = bench->draw;
	const struct ui *ui = &bench->ui;
	const struct session *session = bench->session;
	glFinish();
	bench->mark_ms = now_ms(CLOCK_MONOTONIC);
	bench->mark_cpu_ms = now_ms(CLOCK_PROCESS_CPUTIME_ID);
	cloth_upload(draw, session);
	cover_follow(draw, session);
	trim_follow(draw, session);
	camera_make(&draw->camera, &ui->view, &session->body);
	lap(bench, 0, "cloth upload");
	shadow_draw(draw);
	lap(bench, 1, "shadow map");
	background_draw(draw, ui, session);
	lap(bench, 2, "background");
	pane_enter(draw, &ui->view.pane);
	room_draw(draw);
	lap(bench, 3, "floor");
	body_draw(draw);
	lap(bench, 4, "body");
	cloth_draw(draw);
	lap(bench, 5, "cloth");
	fringe_body_draw(draw, &session->body);
	fringe_cloth_draw(draw, session);
	lap(bench, 6, "outlines");
	lines_draw(draw, ui, session);
	lap(bench, 7, "seams and marks");
	overlays_draw(draw);
	lap(bench, 8, "overlays");
}

static int by_value(const void *a, const void *b)
{
	double x = *(const double *)a, y = *(const double *)b;
	return (x > y) - (x < y);
}

static void print_part(struct part *part)
{
	qsort(part->ms, FRAMES, sizeof part->ms[0], by_value);
	qsort(part->cpu_ms, FRAMES, sizeof part->cpu_ms[0], by_value);
	printf("  %-24s %7.2f %7.2f %7.2f\n", part->name, part->ms[0], part->ms[FRAMES / 2],
	       part->cpu_ms[FRAMES / 2]);
}

static void whole_frames(struct bench *bench, struct display *display, int sweeps, bool turning)
{
	struct part part = {.name = sweeps ? "whole frame with sweeps" : "whole frame"};
	for (int i = 0; i < FRAMES; i++) {
		double start_ms = now_ms(CLOCK_MONOTONIC);
		double start_cpu_ms = now_ms(CLOCK_PROCESS_CPUTIME_ID);
		for (int k = 0; k < sweeps; k++)
			cloth_sweep(&bench->session->cloth);
		if (turning)
			view_look(&bench->ui.view, 0.05f * (float)i);
		draw_frame(bench->draw, &bench->ui, bench->session);
		display_present(display);
		part.ms[i] = now_ms(CLOCK_MONOTONIC) - start_ms;
		part.cpu_ms[i] = now_ms(CLOCK_PROCESS_CPUTIME_ID) - start_cpu_ms;
	}
	print_part(&part);
}

static int bench_size(struct scene *scene, int width, int height, int sweeps)
{
	static struct bench bench;
	char fault[200];
	struct display *display = display_open(DISPLAY_HEADLESS, &width, &height, fault);
	bench = (struct bench){.session = &scene->session};
	bench.draw = display ? draw_open(width, height, fault) : NULL;
	if (!bench.draw) {
		printf("no picture: %s\n", fault);
		return 77;
	}
	ui_init(&bench.ui, width, height);
	ui_step(&bench.ui, STEP_DRESS);
	view_look(&bench.ui.view, 0.4f);
	draw_frame(bench.draw, &bench.ui, bench.session);
	for (bench.frame = 0; bench.frame < FRAMES; bench.frame++)
		frame_in_parts(&bench);
	printf("%d x %d, %s, %d vertices\n  %-24s %7s %7s %7s\n", width, height,
	       (const char *)glGetString(GL_RENDERER), bench.session->garment.vertex_count,
	       "ms a frame", "best", "middle", "cpu");
	for (int i = 0; i < bench.part_count; i++)
		print_part(&bench.part[i]);
	whole_frames(&bench, display, 0, false);
	whole_frames(&bench, display, sweeps, true);
	draw_close(bench.draw);
	display_close(display);
	return 0;
}

int main(int count, char **words)
{
	int sweeps = count > 1 ? atoi(words[1]) : 10;
	struct scene *scene = scene_open();
	scene->session.vertices_wanted = VERTICES;
	if (scene_play(scene, "tests/journals/tshirt.kitsuke") || !scene_wrap(scene)) {
		printf("tests/journals/tshirt.kitsuke does not wrap: %s\n", scene->session.notice);
		return EXIT_FAILURE;
	}
	int result = bench_size(scene, 1280, 720, sweeps);
	if (!result)
		result = bench_size(scene, 1920, 1080, sweeps);
	scene_close(scene);
	return result;
}
