/* How long the garment job takes: a T-shirt's four pieces at several sizes, or garment files.
 *
 *   bench_mesh [VERTICES] [FILE...] */
#include "format_garment.h"
#include "garment.h"
#include "garment_figures.h"

#include <stdio.h>
#include <time.h>

enum { REPEATS = 9, FILE_BYTES_MAX = 1 << 20 };

static struct pattern pattern;
static struct garment garment;
static struct garment_job *job;

static double now_ms(void)
{
	struct timespec time;
	clock_gettime(CLOCK_MONOTONIC, &time);
	return (double)time.tv_sec * 1e3 + (double)time.tv_nsec * 1e-6;
}

static int compare(const void *a, const void *b)
{
	double x = *(const double *)a, y = *(const double *)b;
	return (x > y) - (x < y);
}

static void bench(const char *name, int vertices)
{
	double ms[REPEATS];
	long units = 0;
	for (int r = 0; r < REPEATS; r++) {
		double start = now_ms();
		const char *fault = garment_start(job, &garment, &pattern, vertices);
		if (fault) {
			printf("%s: %s\n", name, fault);
			return;
		}
		bool done = false;
		for (units = 0; !done;)
			units += garment_advance(job, 1 << 20, &done);
		ms[r] = now_ms() - start;
	}
	qsort(ms, REPEATS, sizeof *ms, compare);
	struct figures figures;
	figures_measure(&figures, &garment);
	printf("%-24.24s %5d vertices %5d triangles  median %6.2f ms, least %6.2f  %7ld units  "
	       "smallest angle %4.1f, mean %4.1f, below 25: %d\n",
	       name, garment.vertex_count, garment.triangle_count, ms[REPEATS / 2], ms[0], units,
	       (double)figures.angle_min_deg, (double)figures.angle_mean_deg, figures.below_25);
}

/* The front of a T-shirt with a curved neck, 600 x 700 mm. */
static void make_shirt(void)
{
	static const struct v2 corner[] = {{240, -330}, {220, 150},  {330, 120},  {370, 235},
					   {90, 300},   {-90, 300},  {-370, 235}, {-330, 120},
					   {-220, 150}, {-240, -330}};
	struct piece *piece = &pattern.piece[0];
	memset(&pattern, 0, sizeof pattern);
	piece->used = true;
	for (int k = 0; k < COUNT_OF(corner); k++) {
		piece->corner[piece->point_count] = true;
		piece->point_mm[piece->point_count++] = corner[k];
		for (int i = 1; k == 4 && i < 20; i++) {
			float angle = PI_F * (float)i / 20.0f;
			piece->point_mm[piece->point_count++] = (struct v2){
				90 * angle_cos(angle), 300 - 60 * angle_sin(angle)};
		}
	}
}

static void bench_file(const char *path, int vertices)
{
	static char text[FILE_BYTES_MAX];
	char fault[200] = "cannot be opened";
	FILE *file = fopen(path, "rb");
	size_t size = file ? fread(text, 1, sizeof text, file) : 0;
	if (file)
		fclose(file);
	if (!file || !format_garment_read(&pattern, text, size, fault)) {
		printf("%s: %s\n", path, fault);
		return;
	}
	const char *name = strrchr(path, '/');
	bench(name ? name + 1 : path, vertices);
}

int main(int argc, char **argv)
{
	static unsigned char memory[8 << 20];
	struct arena arena;
	arena_init(&arena, memory, sizeof memory);
	garment_init(&garment, &arena);
	job = garment_job_init(&arena);
	int vertices = argc > 1 ? atoi(argv[1]) : 0;
	for (int i = 2; i < argc; i++)
		bench_file(argv[i], vertices);
	static const int sizes[] = {600, 1300, 2400, 5000};
	make_shirt();
	for (int k = 0; argc <= 2 && k < COUNT_OF(sizes); k++)
		bench("shirt front", vertices > 0 ? vertices : sizes[k]);
	return 0;
}
