/* Reading garment-seams/1: real garments, and what must be refused. */
#include "format_garment.h"
#include "garment.h"
#include "garment_figures.h"
#include "test.h"

#include <dirent.h>
#include <jansson.h>

#define SEAMS_FOLDER "../shared/data/patterns/seams"

static struct pattern pattern;
static struct garment garment;
static struct garment_job *job;
static char text[1 << 20];
static char fault[200];

static size_t load(const char *path)
{
	FILE *file = fopen(path, "rb");
	if (!file)
		return 0;
	size_t size = fread(text, 1, sizeof text, file);
	fclose(file);
	return size;
}

static const char small[] =
	"{\"format\":\"garment-seams/1\",\"units\":\"mm\",\"instances\":["
	"{\"id\":\"front\",\"outline\":[[0,0],[0,100],[50,100],[100,100],[100,0]]},"
	"{\"id\":\"back\",\"outline\":[[0,0],[0,100],[100,100],[100,0]]}],"
	"\"seams\":[{\"id\":\"side\",\"kind\":\"plain\","
	"\"a\":{\"instance\":\"front\",\"start\":0,\"end\":1,\"dir\":1},"
	"\"b\":{\"instance\":\"back\",\"start\":3,\"end\":2,\"dir\":-1}},"
	"{\"id\":\"zip\",\"kind\":\"closure\","
	"\"a\":{\"instance\":\"front\",\"start\":3,\"end\":4,\"dir\":1},"
	"\"b\":{\"instance\":\"back\",\"start\":0,\"end\":1,\"dir\":1}}]}";

static bool read_changed(const char *what, const char *with)
{
	const char *at = strstr(small, what);
	if (!at)
		return true;
	int before = (int)(at - small);
	int size = snprintf(text, sizeof text, "%.*s%s%s", before, small, with, at + strlen(what));
	bool read = format_garment_read(&pattern, text, (size_t)size, fault);
	CHECK(read == (fault[0] == '\0'));
	CHECK(read || !pattern.piece[0].used);
	return read;
}

static void test_small(void)
{
	CHECK(format_garment_read(&pattern, small, strlen(small), fault));
	const struct piece *front = &pattern.piece[0];
	CHECK(strcmp(front->name, "front") == 0);
	CHECK(piece_area_mm2(front) > 0.0f); /* y is up now */
	CHECK_NEAR(piece_area_mm2(front), 10000, 0.1);
	CHECK(piece_edge_count(front) == 4); /* the point amid an edge is no corner */
	CHECK(pattern.seam[0].used && !pattern.seam[0].swapped);
	CHECK(!pattern.seam[1].used); /* the zip stays open */
	CHECK(pattern.seam[0].a.piece == 0 && pattern.seam[0].b.piece == 1);
	CHECK_NEAR(piece_edge_length_mm(front, pattern.seam[0].a.edge), 100, 1e-3);
	struct v2 start = piece_edge_point(front, pattern.seam[0].a.edge, 0.0f);
	CHECK_NEAR(start.x, 0, 1e-4);
	CHECK_NEAR(start.y, 0, 1e-4);
	/* The start of a meets the end of b's edge: point 3 of the file. */
	struct v2 end = piece_edge_point(&pattern.piece[1], pattern.seam[0].b.edge, 1.0f);
	CHECK_NEAR(end.x, 100, 1e-4);
	CHECK_NEAR(end.y, 0, 1e-4);
}

static void test_refusals(void)
{
	static const char *const change[][2] = {
		{"seams/1", "seams/2"},
		{"\"mm\"", "\"cm\""},
		{"\"back\",\"outline\"", "\"front\",\"outline\""},
		{"[50,100]", "[50]"},
		{"[50,100]", "[50,\"x\"]"},
		{"[50,100]", "[50,1e9]"},
		{"[50,100]", "[50,-10]"},
		{"\"start\":3,\"end\":2", "\"start\":3,\"end\":4"},
		{"\"start\":3,\"end\":2", "\"start\":-1,\"end\":2"},
		{"\"start\":3,\"end\":2", "\"start\":2,\"end\":2"},
		{"\"start\":3,\"end\":2", "\"start\":2.5,\"end\":2"},
		{"\"dir\":-1", "\"dir\":0"},
		{"{\"instance\":\"back\"", "{\"instance\":\"sleeve\""},
		{"[[0,0],[0,100],[100,100],[100,0]]", "[[0,0],[100,0],[100,100],[0,100]]"},
		{"}]}", "}]"},
	};
	for (int i = 0; i < COUNT_OF(change); i++) {
		bool read = read_changed(change[i][0], change[i][1]);
		if (read)
			fprintf(stderr, "change %d was accepted\n", i);
		CHECK(!read);
	}
	CHECK(read_changed("\"seams\":[", "\"seams\":["));
	/* The zip's edges are free: sewing them is allowed. */
	CHECK(read_changed("\"closure\"", "\"plain\""));
	CHECK(pattern.seam[1].used && pattern.seam[1].swapped);
	CHECK(!format_garment_read(&pattern, "", 0, fault));
	CHECK(!format_garment_read(&pattern, "[]", 2, fault));
}

/* A half disc of 1502 points, along its arc from the bottom up or from the top down. */
static size_t write_disc(bool upwards)
{
	int size = snprintf(text, sizeof text,
			    "{\"format\":\"garment-seams/1\",\"units\":\"mm\",\"instances\":["
			    "{\"id\":\"disc\",\"outline\":[[0,0]");
	for (int i = 0; i <= 1500; i++) {
		float angle = PI_F * (float)(upwards ? i : 1500 - i) / 1500.0f;
		size += snprintf(text + size, sizeof text - (size_t)size, ",[%.3f,%.3f]",
				 (double)(300.0f * angle_sin(angle)),
				 (double)(300.0f * angle_cos(angle)));
	}
	size += snprintf(text + size, sizeof text - (size_t)size, "]}]}");
	return (size_t)size;
}

/* An outline of more points than a piece may have is thinned, its corners stay. */
static void test_thinning(void)
{
	/* In the file y points down: upwards is counter-clockwise there. */
	size_t size = write_disc(false);
	CHECK(!format_garment_read(&pattern, text, size, fault));
	CHECK(strstr(fault, "clockwise"));
	size = write_disc(true);
	CHECK(format_garment_read(&pattern, text, size, fault));
	CHECK(pattern.piece[0].point_count <= OUTLINE_POINTS_MAX);
	CHECK_NEAR(piece_area_mm2(&pattern.piece[0]), 0.5 * 3.14159265 * 300 * 300, 150);
	CHECK(piece_edge_count(&pattern.piece[0]) == 2);
}

/* Every seam's length against what the file says. */
static void check_lengths(const char *name, const json_t *seams)
{
	int index = 0;
	for (size_t s = 0; s < json_array_size(seams); s++) {
		const json_t *seam = json_array_get(seams, s);
		if (strcmp(json_string_value(json_object_get(seam, "kind")), "closure") == 0)
			continue;
		const struct edge_ref ref[2] = {pattern.seam[index].a, pattern.seam[index].b};
		for (int side = 0; side < 2; side++) {
			const json_t *run = json_object_get(seam, side ? "b" : "a");
			double length = json_number_value(json_object_get(run, "length_mm"));
			float ours = piece_edge_length_mm(&pattern.piece[ref[side].piece],
							  ref[side].edge);
			CHECK_NEAR(ours, length, 0.005 * length);
			CHECK(strcmp(pattern.piece[ref[side].piece].name,
				     json_string_value(json_object_get(run, "instance"))) == 0);
		}
		index++;
	}
	if (index == 0)
		fprintf(stderr, "%s has no seams\n", name);
	CHECK(index > 0);
}

static void check_no_overlap(void)
{
	for (int p = 0; p < PIECES_MAX; p++)
		for (int i = 0; pattern.piece[p].used && i < pattern.piece[p].point_count; i++) {
			struct v2 at = piece_to_sheet(&pattern.piece[p],
						      pattern.piece[p].point_mm[i]);
			CHECK(pattern_pick(&pattern, at, 1u << p) < 0);
		}
}

static void check_mesh(const char *name)
{
	const char *reason = garment_start(job, &garment, &pattern, 2400);
	if (reason)
		fprintf(stderr, "%s: %s\n", name, reason);
	CHECK(!reason);
	bool done = reason != NULL;
	while (!done)
		garment_advance(job, 100000, &done);
	struct figures figures;
	figures_measure(&figures, &garment);
	if (figures.angle_mean_deg < 50.0f || figures.below_25 > 0)
		fprintf(stderr, "%s: mean %.1f, %d below 25\n", name,
			(double)figures.angle_mean_deg, figures.below_25);
	CHECK(figures.clockwise == 0 && figures.bad_edges == 0 && figures.collapsed == 0);
	CHECK(figures.angle_mean_deg >= 50.0f);
	CHECK(figures.below_25 == 0);
}

static int test_real(void)
{
	DIR *folder = opendir(SEAMS_FOLDER);
	int files = 0;
	for (struct dirent *entry; folder && (entry = readdir(folder)) != NULL;) {
		char path[512];
		if (!strstr(entry->d_name, ".json"))
			continue;
		snprintf(path, sizeof path, SEAMS_FOLDER "/%.200s", entry->d_name);
		size_t size = load(path);
		bool read = format_garment_read(&pattern, text, size, fault);
		if (!read)
			fprintf(stderr, "%s: %s\n", entry->d_name, fault);
		CHECK(read);
		json_t *root = json_loadb(text, size, 0, NULL);
		check_lengths(entry->d_name, json_object_get(root, "seams"));
		json_decref(root);
		check_no_overlap();
		check_mesh(entry->d_name);
		files++;
	}
	if (folder)
		closedir(folder);
	return files;
}

int main(void)
{
	static unsigned char memory[8 << 20];
	struct arena arena;
	arena_init(&arena, memory, sizeof memory);
	garment_init(&garment, &arena);
	job = garment_job_init(&arena);
	test_small();
	test_refusals();
	test_thinning();
	int files = test_real();
	if (files == 0 && !test_failures) {
		printf("no garments in " SEAMS_FOLDER ": only our own samples were read\n");
		return 77;
	}
	return test_end();
}
