/* The garment job: even triangles, seams sampled alike, the same bits for any quota. */
#include "garment.h"
#include "garment_figures.h"
#include "test.h"

static struct pattern pattern;
static struct garment garment;
static struct garment_job *job;

static struct piece *add_piece(int index, const struct v2 *point_mm, int count)
{
	struct piece *piece = &pattern.piece[index];
	*piece = (struct piece){.used = true, .point_count = count, .name = "cloth"};
	for (int i = 0; i < count; i++) {
		piece->point_mm[i] = point_mm[i];
		piece->corner[i] = true;
	}
	return piece;
}

static uint64_t garment_hash(void)
{
	struct hash hash;
	hash_init(&hash);
	for (int v = 0; v < garment.vertex_count; v++) {
		hash_float(&hash, garment.rest_m[v].x);
		hash_float(&hash, garment.rest_m[v].y);
		hash_int(&hash, garment.weld[v]);
	}
	for (int t = 0; t < garment.triangle_count; t++)
		for (int k = 0; k < 3; k++)
			hash_int(&hash, garment.triangle[t].v[k]);
	return hash.value;
}

static bool mesh_with(int vertices, long quota)
{
	const char *fault = garment_start(job, &garment, &pattern, vertices);
	if (fault)
		fprintf(stderr, "%s\n", fault);
	CHECK(!fault);
	bool done = false;
	for (int k = 0; !fault && !done && k < 10000000; k++)
		garment_advance(job, quota, &done);
	return done;
}

static void check_sound(void)
{
	struct figures figures;
	figures_measure(&figures, &garment);
	CHECK(figures.clockwise == 0);
	CHECK(figures.bad_edges == 0);
	CHECK(figures.collapsed == 0);
	for (int p = 0; p < PIECES_MAX; p++)
		if (pattern.piece[p].used)
			CHECK_NEAR(figures.area_mm2[p], piece_area_mm2(&pattern.piece[p]),
				   0.01f * piece_area_mm2(&pattern.piece[p]));
	for (int v = 0; v < garment.vertex_count; v++)
		CHECK(garment.weld[v] <= v && garment.weld[garment.weld[v]] == garment.weld[v]);
	for (int i = 0; i < garment.pair_count; i++)
		CHECK(garment.weld[garment.pair[i].a] == garment.weld[garment.pair[i].b]);
}

/* Two sheets sewn to a tube. */
static void make_tube(void)
{
	static const struct v2 sheet[] = {{0, 0}, {500, 0}, {500, 700}, {0, 700}};
	memset(&pattern, 0, sizeof pattern);
	add_piece(0, sheet, 4);
	add_piece(3, sheet, 4);
	pattern.seam[1] = (struct seam){true, false, {0, 1}, {3, 3}, false};
	pattern.seam[4] = (struct seam){true, false, {0, 3}, {3, 1}, false};
}

static void test_tube(void)
{
	make_tube();
	CHECK(mesh_with(2400, 5000));
	check_sound();
	CHECK(garment.vertex_count > 2200 && garment.vertex_count < 2600);
	struct figures figures;
	figures_measure(&figures, &garment);
	CHECK(figures.angle_min_deg >= 25.0f);
	CHECK(figures.angle_mean_deg >= 50.0f);
	CHECK(garment_start(job, &garment, &pattern, 1 << 30) == NULL); /* as many as fit */
	CHECK(mesh_with(2400, 5000));
	/* A tube has Euler number 0 once welded. */
	CHECK(figures.euler == 0);
	/* Sides meet bottom to bottom. */
	for (int i = 0; i < garment.pair_count; i++)
		CHECK_NEAR(garment.rest_m[garment.pair[i].a].y, garment.rest_m[garment.pair[i].b].y,
			   1e-5);
}

static void test_quota_changes_nothing(void)
{
	make_tube();
	CHECK(mesh_with(1000, 1));
	uint64_t one = garment_hash();
	CHECK(mesh_with(1000, 1 << 30));
	CHECK(garment_hash() == one);
	pattern.piece[0].point_mm[2].x += 1.0f;
	CHECK(mesh_with(1000, 1 << 30));
	CHECK(garment_hash() != one);
}

/* A wedge of 500 x 400 with a dart of 30 mm from its top. */
static void test_dart(void)
{
	static const struct v2 point[] = {{0, 0},     {500, 0},   {500, 400}, {265, 400},
					  {250, 250}, {235, 400}, {0, 400}};
	memset(&pattern, 0, sizeof pattern);
	add_piece(0, point, 7);
	pattern.seam[0] = (struct seam){true, false, {0, 3}, {0, 4}, false};
	CHECK(mesh_with(600, 1000));
	check_sound();
	struct figures figures;
	figures_measure(&figures, &garment);
	CHECK(figures.euler == 1); /* a disc, still */
	CHECK(figures.angle_min_deg >= 25.0f);
	for (int i = 0; i < garment.pair_count; i++) {
		CHECK(garment.pair[i].a != garment.pair[i].b);
		CHECK_NEAR(garment.rest_m[garment.pair[i].a].y, garment.rest_m[garment.pair[i].b].y,
			   1e-4);
	}
}

/* A cone: neighbouring edges sewn together. No triangle becomes a line. */
static void test_cone(void)
{
	for (int half = 100; half <= 700; half += 200) {
		struct v2 point[] = {{0, 500}, {-(float)half, 0}, {(float)half, 0}};
		memset(&pattern, 0, sizeof pattern);
		add_piece(0, point, 3);
		pattern.seam[0] = (struct seam){true, false, {0, 0}, {0, 2}, false};
		CHECK(mesh_with(500, 1000));
		check_sound();
		CHECK(garment.pair_count > 5);
	}
}

/* Straps and bindings: long, and narrower than an edge. */
static void test_narrow(void)
{
	for (int width = 4; width <= 40; width += 4) {
		struct v2 point[] = {{0, 0},
				     {900, 0},
				     {900, (float)width},
				     {0, (float)width},
				     {-60, 0.5f * (float)width}};
		memset(&pattern, 0, sizeof pattern);
		add_piece(0, point, 4);
		static const struct v2 sheet[] = {{0, 0}, {900, 0}, {900, 700}, {0, 700}};
		add_piece(1, sheet, 4);
		pattern.seam[0] = (struct seam){true, false, {0, 0}, {1, 2}, false};
		CHECK(mesh_with(2000, 1000));
		check_sound();
		struct figures figures;
		figures_measure(&figures, &garment);
		CHECK(figures.angle_min_deg >= 25.0f);
	}
}

static void test_refusals(void)
{
	make_tube();
	pattern.seam[5] = (struct seam){true, false, {0, 1}, {3, 0}, false};
	CHECK(garment_start(job, &garment, &pattern, 1000));
	pattern.seam[5] = (struct seam){true, false, {0, 0}, {0, 0}, false};
	CHECK(garment_start(job, &garment, &pattern, 1000));
	pattern.seam[5] = (struct seam){true, false, {0, 0}, {3, 4}, false};
	CHECK(garment_start(job, &garment, &pattern, 1000));
	pattern.seam[5] = (struct seam){true, false, {0, 0}, {1, 0}, false};
	CHECK(garment_start(job, &garment, &pattern, 1000));
	pattern.seam[5].used = false;
	CHECK(!garment_start(job, &garment, &pattern, 1000));
	struct v2 *corner = &pattern.piece[3].point_mm[1];
	*corner = (struct v2){-100, 900};
	CHECK(garment_start(job, &garment, &pattern, 1000));
	memset(&pattern, 0, sizeof pattern);
	CHECK(garment_start(job, &garment, &pattern, 1000));
	static const struct v2 sail[] = {
		{-9000, -9000}, {9000, -9000}, {9000, 9000}, {-9000, 9000}};
	add_piece(0, sail, 4);
	CHECK(garment_start(job, &garment, &pattern, 1000));
}

static void test_locate(void)
{
	make_tube();
	CHECK(mesh_with(1000, 1000));
	struct scatter scatter = {12345};
	for (int i = 0; i < 500; i++) {
		struct v2 p = {(float)scatter_below(&scatter, 500),
			       (float)scatter_below(&scatter, 700)};
		float weight[3];
		int t = garment_locate(&garment, 3, p, weight);
		CHECK(t >= 0 && garment.triangle_piece[t] == 3);
		if (t < 0)
			continue;
		struct v2 q = {0};
		for (int k = 0; k < 3; k++)
			q = v2_add(q,
				   v2_scale(garment.rest_m[garment.triangle[t].v[k]], weight[k]));
		CHECK_NEAR(1000.0f * q.x, p.x, 0.01);
		CHECK_NEAR(1000.0f * q.y, p.y, 0.01);
	}
	float weight[3];
	CHECK(garment_locate(&garment, 0, (struct v2){-5, 300}, weight) >= 0);
	CHECK_NEAR(weight[0] + weight[1] + weight[2], 1, 1e-6);
	CHECK(garment_locate(&garment, 0, (struct v2){-80, 300}, weight) < 0);
	CHECK(garment_locate(&garment, 1, (struct v2){100, 300}, weight) < 0);
}

int main(void)
{
	static unsigned char memory[8 << 20];
	struct arena arena;
	arena_init(&arena, memory, sizeof memory);
	garment_init(&garment, &arena);
	job = garment_job_init(&arena);
	arena_seal(&arena);
	test_tube();
	test_quota_changes_nothing();
	test_dart();
	test_cone();
	test_narrow();
	test_refusals();
	test_locate();
	return test_end();
}
