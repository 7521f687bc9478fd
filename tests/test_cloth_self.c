/* Cloth against cloth: sheets that lie on one another, a fold, sheets that start tangled. */
#include "cloth_self.h"
#include "measure.h"
#include "shapes.h"
#include "test.h"

static struct body body;
static struct garment garment;
static struct cloth cloth;
static struct garment_job *job;
static struct pattern pattern;
static struct measure_scratch *scratch;
static struct shape shape;

/* A board, its upper side at y = 0. */
static void build_board(void)
{
	shape_box(&shape, 0.5f, 0.05f, 0.5f);
	for (int v = 0; v < shape.vertex_count; v++)
		shape.position_m[v].y -= 0.05f;
	CHECK(!body_build(&body, shape.position_m, shape.vertex_count, shape.triangle,
			  shape.triangle_count));
}

static void add_rectangle(int index, float width_mm, float height_mm)
{
	const struct v2 corner[4] = {
		{0.0f, 0.0f}, {width_mm, 0.0f}, {width_mm, height_mm}, {0.0f, height_mm}};
	struct piece *piece = &pattern.piece[index];
	*piece = (struct piece){.used = true, .point_count = 4, .name = "sheet"};
	for (int i = 0; i < 4; i++) {
		piece->point_mm[i] = corner[i];
		piece->corner[i] = true;
	}
}

/* `layered`: every piece is a garment over the one before; else all are one garment. */
static void mesh(int pieces, int vertices, bool layered)
{
	bool done = false;
	memset(&pattern, 0, sizeof pattern);
	for (int p = 0; p < pieces; p++)
		add_rectangle(p, 200.0f - 20.0f * (float)p, 240.0f - 20.0f * (float)p);
	CHECK(!garment_start(job, &garment, &pattern, vertices));
	while (!done)
		garment_advance(job, 100000, &done);
	for (int p = 0; !layered && p < pieces; p++)
		garment.layer[p] = 0;
	cloth_reset(&cloth, &garment, &body);
}

/* Lays a vertex with its outside up: `slope` metres higher for each metre along the piece. */
static void lay(int v, float height_m, float slope)
{
	struct v2 p = garment.rest_m[v];
	float along = 1.0f / sqrtf(1.0f + slope * slope) * (p.y - 0.1f);
	cloth.position_m[v] = (struct v3){along, height_m + slope * along,
					  p.x - 0.1f + 0.01f * (float)garment.piece[v]};
	cloth.placed[v] = 1;
}

static void run(int sweeps, float thickness_m)
{
	cloth_weld(&cloth);
	cloth.settings.thickness_m = thickness_m;
	for (int i = 0; i < sweeps; i++)
		cloth_sweep(&cloth);
	long units = 0;
	for (int round = 0; round < 2; round++)
		cloth_clean(&cloth, 0, 1, &units);
}

static int crossings(void)
{
	struct measure measure;
	measure_garment(&measure, &cloth, scratch);
	CHECK(measure.vertices_inside == 0);
	return measure.self_intersections;
}

static float mean_height_m(int piece)
{
	float sum = 0.0f;
	for (int v = garment.piece_first[piece]; v < garment.piece_first[piece + 1]; v++)
		sum += cloth.position_m[v].y;
	return sum / (float)(garment.piece_first[piece + 1] - garment.piece_first[piece]);
}

/* Three sheets fall on a board and lie there in their order, a thickness apart. */
static void test_pile(float thickness_m)
{
	mesh(3, 600, false);
	for (int v = 0; v < garment.vertex_count; v++)
		lay(v, 0.008f + 0.006f * (float)garment.piece[v], 0.0f);
	run(600, thickness_m);
	if (thickness_m > 0.0f) {
		CHECK(crossings() == 0);
		CHECK_NEAR(mean_height_m(1) - mean_height_m(0), thickness_m, 0.0005f);
		CHECK_NEAR(mean_height_m(2) - mean_height_m(1), thickness_m, 0.0005f);
	} else { /* else they would lie in one */
		CHECK_NEAR(mean_height_m(2), mean_height_m(0), 0.0005f);
	}
}

/* A sheet pierces another along a line that ends at both rims; its larger part comes to lie on top,
 * and all of it follows; but of two garments the upper one does, however it lies. */
static void test_tangled(float low_share, bool layered)
{
	float slope = 0.12f;
	mesh(2, 500, layered);
	for (int v = 0; v < garment.vertex_count; v++)
		if (garment.piece[v] == 0)
			lay(v, 0.02f, 0.0f);
		else
			lay(v, 0.02f - (0.22f * low_share - 0.1f) * slope, slope);
	CHECK(crossings() > 20);
	run(900, 0.002f);
	CHECK(crossings() == 0);
	CHECK((mean_height_m(1) > mean_height_m(0)) == (layered || low_share < 0.5f));
}

/* A sheet folded in half does not open into itself and does not flatten through itself. */
static void test_fold(void)
{
	mesh(1, 600, false);
	for (int v = 0; v < garment.vertex_count; v++) {
		lay(v, 0.006f, 0.0f);
		struct v3 *p = &cloth.position_m[v];
		if (p->x > 0.0f)
			*p = (struct v3){-p->x, 0.012f, p->z};
	}
	run(900, 0.002f);
	CHECK(crossings() == 0);
}

static uint64_t hash(void)
{
	struct hash sum;
	hash_init(&sum);
	for (int v = 0; v < garment.vertex_count; v++) {
		hash_float(&sum, cloth.position_m[v].x);
		hash_float(&sum, cloth.position_m[v].y);
		hash_float(&sum, cloth.position_m[v].z);
	}
	return sum.value;
}

static void test_same_bits(void)
{
	test_tangled(0.3f, false);
	uint64_t first = hash();
	test_tangled(0.3f, false);
	CHECK(hash() == first);
}

int main(void)
{
	static unsigned char memory[128 << 20];
	struct arena arena;
	arena_init(&arena, memory, sizeof memory);
	body_init(&body, &arena);
	garment_init(&garment, &arena);
	job = garment_job_init(&arena);
	cloth_init(&cloth, &arena);
	scratch = measure_init(&arena);
	build_board();
	test_pile(0.002f);
	test_pile(0.0f);
	test_tangled(0.3f, false);
	test_tangled(0.7f, false);
	test_tangled(0.7f, true);
	test_fold();
	test_same_bits();
	return test_end();
}
