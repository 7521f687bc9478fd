/* The solver's sweep by itself: patches that hang, rest, close and turn back; the same bits again.
 */
#include "cloth.h"
#include "test.h"

static struct body body;
static struct garment garment;
static struct cloth cloth;
static struct garment_job *job;
static struct pattern pattern;

enum { RINGS = 24, SIDES = 48, PRICED_SWEEPS = 200 };

/* Of a sheet half in the air: 2 triangles, 3 edges, levels, contact; 10 today. */
#define UNITS_A_VERTEX_MAX 12.0f

/* A closed upright cylinder with domed ends: r = 0.15 m, y from 0 to 1 m, its axis at the origin.
 */
static void build_post(void)
{
	static struct v3 position[RINGS * SIDES + 2];
	static struct triangle triangle[2 * RINGS * SIDES];
	int vertices = 0, triangles = 0;
	for (int r = 0; r < RINGS; r++)
		for (int s = 0; s < SIDES; s++) {
			float y = (float)r / (float)(RINGS - 1), a = 2.0f * PI_F * (float)s / SIDES;
			float end = float_min(y, 1.0f - y);
			float radius = end < 0.001f ? 0.12f : 0.15f;
			position[vertices++] = (struct v3){radius * angle_sin(a), y,
							   radius * angle_cos(a)};
		}
	position[vertices++] = (struct v3){0.0f, -0.03f, 0.0f};
	position[vertices++] = (struct v3){0.0f, 1.03f, 0.0f};
	for (int s = 0; s < SIDES; s++) {
		int next = (s + 1) % SIDES, top = (RINGS - 1) * SIDES;
		for (int r = 0; r + 1 < RINGS; r++) {
			int a = r * SIDES + s, b = r * SIDES + next;
			triangle[triangles++] = (struct triangle){{a, b, b + SIDES}};
			triangle[triangles++] = (struct triangle){{a, b + SIDES, a + SIDES}};
		}
		triangle[triangles++] = (struct triangle){{next, s, vertices - 2}};
		triangle[triangles++] = (struct triangle){{top + s, top + next, vertices - 1}};
	}
	const char *fault = body_build(&body, position, vertices, triangle, triangles);
	if (fault)
		fprintf(stderr, "%s\n", fault);
	CHECK(!fault);
}

static void add_rectangle(int index, float width_mm, float height_mm)
{
	struct piece *piece = &pattern.piece[index];
	*piece = (struct piece){.used = true, .point_count = 4, .name = "patch"};
	const struct v2 corner[4] = {
		{0.0f, 0.0f}, {width_mm, 0.0f}, {width_mm, height_mm}, {0.0f, height_mm}};
	for (int i = 0; i < 4; i++) {
		piece->point_mm[i] = corner[i];
		piece->corner[i] = true;
	}
}

static void mesh(int vertices)
{
	bool done = false;
	const char *fault = garment_start(job, &garment, &pattern, vertices);
	CHECK(!fault);
	for (int i = 0; !fault && !done && i < 100000; i++)
		garment_advance(job, 100000, &done);
	CHECK(done);
	cloth_reset(&cloth, &garment, &body);
}

/* Lays the piece's rest shape flat in space: origin + x right + y up. */
static void lay(struct v3 origin, struct v3 right, struct v3 up)
{
	for (int v = 0; v < garment.vertex_count; v++) {
		struct v2 p = garment.rest_m[v];
		cloth.position_m[v] = v3_mad(v3_mad(origin, right, p.x), up, p.y);
		cloth.previous_m[v] = cloth.position_m[v];
		cloth.placed[v] = 1;
	}
}

static uint64_t cloth_hash(void)
{
	struct hash hash;
	hash_init(&hash);
	for (int v = 0; v < garment.vertex_count; v++) {
		hash_float(&hash, cloth.position_m[v].x);
		hash_float(&hash, cloth.position_m[v].y);
		hash_float(&hash, cloth.position_m[v].z);
	}
	return hash.value;
}

static float deepest_m(void)
{
	float deepest = 1.0f;
	struct body_hit hit;
	for (int t = 0; t < garment.triangle_count; t++) {
		const int *v = cloth.triangle[t].v;
		const struct v3 *x = cloth.position_m;
		struct v3 centre = v3_scale(v3_add(v3_add(x[v[0]], x[v[1]]), x[v[2]]), 1.0f / 3.0f);
		body_nearest(&body, centre, 0, &hit);
		deepest = float_min(deepest, hit.distance_m);
		for (int k = 0; k < 3; k++) {
			body_nearest(&body, x[v[k]], 0, &hit);
			deepest = float_min(deepest, hit.distance_m);
			body_nearest(&body, v3_lerp(x[v[k]], x[v[(k + 1) % 3]], 0.5f), 0, &hit);
			deepest = float_min(deepest, hit.distance_m);
		}
	}
	return deepest;
}

/* One sheet held at its upper corners, far from the body, hangs and hardly stretches. */
static void test_hanging_patch(void)
{
	memset(&pattern, 0, sizeof pattern);
	add_rectangle(0, 300.0f, 300.0f);
	mesh(400);
	lay((struct v3){1.0f, 0.5f, 0.0f}, (struct v3){1.0f, 0.0f, 0.0f},
	    (struct v3){0.0f, 0.0f, 1.0f});
	float top = 0.5f;
	for (int v = 0; v < garment.vertex_count; v++)
		if (garment.rest_m[v].y > 0.299f) {
			cloth.held[v] = 1;
			cloth.goal_m[v] = cloth.position_m[v];
		}
	CHECK(cloth_strain_mean(&cloth) < 1e-4f);
	for (int sweep = 0; sweep < 3000; sweep++)
		cloth_sweep(&cloth);
	float low = top;
	for (int v = 0; v < garment.vertex_count; v++)
		low = float_min(low, cloth.position_m[v].y);
	CHECK_NEAR(low, top - 0.3f, 0.01f);
	CHECK(cloth_strain_mean(&cloth) < 0.01f);
}

/* All the weight of a sheet hangs by the single triangles at two pins; `most` bounds how far any
 * triangle stretches. */
static void test_hangs_from_pins(float width_mm, float height_mm, int vertices, float most)
{
	memset(&pattern, 0, sizeof pattern);
	add_rectangle(0, width_mm, height_mm);
	mesh(vertices);
	lay((struct v3){1.0f, 0.5f, 0.0f}, (struct v3){1.0f, 0.0f, 0.0f},
	    (struct v3){0.0f, 1.0f, 0.0f});
	float right_m = 1e-3f * width_mm, top_m = 1e-3f * height_mm, nearly = 0.999f;
	int pins = 0;
	for (int v = 0; v < garment.vertex_count; v++) {
		struct v2 p = garment.rest_m[v];
		bool is_right = p.x > nearly * right_m;
		if (p.y < nearly * top_m || (!is_right && p.x > (1.0f - nearly) * right_m))
			continue;
		cloth.held[v] = 2;
		cloth.goal_m[v] = cloth.position_m[v];
		cloth.goal_m[v].x += is_right ? -0.01f : 0.01f;
		pins++;
	}
	CHECK(pins == 2);
	for (int sweep = 0; sweep < 3000; sweep++)
		cloth_sweep(&cloth);
	float stretch = 0.0f;
	for (int t = 0; t < garment.triangle_count; t++)
		stretch = float_max(stretch, cloth_stretch(&cloth, t));
	printf("%d vertices hanging from two pins: a triangle stretches by at most %.3f\n",
	       garment.vertex_count, (double)stretch);
	CHECK(stretch < most);
}

/* A sheet dropped on the post's top stays there, outside it everywhere, and comes to rest. */
static void test_drape_rests(void)
{
	memset(&pattern, 0, sizeof pattern);
	add_rectangle(0, 500.0f, 500.0f);
	mesh(900);
	lay((struct v3){-0.25f, 1.06f, 0.25f}, (struct v3){1.0f, 0.0f, 0.0f},
	    (struct v3){0.0f, 0.0f, -1.0f});
	for (int sweep = 0; sweep < 6000; sweep++)
		cloth_sweep(&cloth);
	static struct v3 before[GARMENT_VERTICES_MAX];
	memcpy(before, cloth.position_m, sizeof before);
	for (int sweep = 0; sweep < 10; sweep++)
		cloth_sweep(&cloth);
	float moved = 0.0f, low = 2.0f;
	for (int v = 0; v < garment.vertex_count; v++) {
		moved += v3_distance(before[v], cloth.position_m[v]);
		low = float_min(low, cloth.position_m[v].y);
	}
	CHECK(low > 0.7f && low < 1.0f);
	CHECK(moved / (float)garment.vertex_count < 0.05e-3f);
	CHECK(deepest_m() > 0.0f);
	CHECK(cloth_strain_mean(&cloth) < 0.02f);
}

/* Units that a vertex costs in a sweep, while a sheet falls on the post. */
static float units_a_vertex(int vertices)
{
	long units = 0;
	memset(&pattern, 0, sizeof pattern);
	add_rectangle(0, 500.0f, 500.0f);
	mesh(vertices);
	lay((struct v3){-0.25f, 1.06f, 0.25f}, (struct v3){1.0f, 0.0f, 0.0f},
	    (struct v3){0.0f, 0.0f, -1.0f});
	cloth_sweep(&cloth); /* looks everything up */
	for (int sweep = 0; sweep < PRICED_SWEEPS; sweep++)
		units += cloth_sweep(&cloth);
	return (float)units / (float)(PRICED_SWEEPS * garment.vertex_count);
}

/* A sweep's work is in proportion to the mesh, so that twice the cloth costs twice as much and no
 * more. Counted, not timed. */
static void test_price(void)
{
	float least = 1e9f, most = 0.0f;
	for (int vertices = 400; vertices <= 6400; vertices *= 4) {
		float units = units_a_vertex(vertices);
		least = float_min(least, units);
		most = float_max(most, units);
	}
	CHECK(most < 1.5f * least);
	CHECK(most < UNITS_A_VERTEX_MAX);
	if (test_failures > 0)
		fprintf(stderr, "a vertex and sweep cost %.1f to %.1f units\n", (double)least,
			(double)most);
}

/* Two sheets sewn along an edge: the gap closes, the weld makes one vertex of each pair, and the
 * joined edge bends like any other. */
static void test_seam_closes(void)
{
	memset(&pattern, 0, sizeof pattern);
	add_rectangle(0, 200.0f, 200.0f);
	add_rectangle(1, 200.0f, 200.0f);
	pattern.seam[0] = (struct seam){.used = true, .a = {0, 1}, .b = {1, 3}};
	mesh(400);
	lay((struct v3){1.0f, 0.5f, 0.0f}, (struct v3){1.0f, 0.0f, 0.0f},
	    (struct v3){0.0f, 1.0f, 0.0f});
	for (int v = garment.piece_first[1]; v < garment.piece_first[2]; v++)
		cloth.position_m[v].x += 0.3f;
	memcpy(cloth.previous_m, cloth.position_m,
	       (size_t)garment.vertex_count * sizeof(struct v3));
	cloth.settings.gravity_m = 0.0f;
	cloth.settings.seam_step_m = 0.002f;
	int flats = cloth.flat_count;
	for (int sweep = 0; sweep < 200; sweep++)
		cloth_sweep(&cloth);
	for (int i = 0; i < garment.pair_count; i++)
		CHECK(v3_distance(cloth.position_m[garment.pair[i].a],
				  cloth.position_m[garment.pair[i].b]) < 0.003f);
	cloth_weld(&cloth);
	CHECK(cloth.flat_count == flats + garment.pair_count - 1);
	for (int sweep = 0; sweep < 20; sweep++)
		cloth_sweep(&cloth);
	cloth_finish(&cloth);
	for (int i = 0; i < garment.pair_count; i++)
		CHECK(v3_distance(cloth.position_m[garment.pair[i].a],
				  cloth.position_m[garment.pair[i].b]) == 0.0f);
	CHECK(cloth_strain_mean(&cloth) < 0.01f);
}

/* A patch before the post with a corner folded over so that its outside faces the post. */
static void test_fold_turns_back(void)
{
	memset(&pattern, 0, sizeof pattern);
	long units = 0;
	add_rectangle(0, 200.0f, 200.0f);
	mesh(400);
	lay((struct v3){-0.1f, 0.4f, 0.156f}, (struct v3){1.0f, 0.0f, 0.0f},
	    (struct v3){0.0f, 1.0f, 0.0f});
	for (int v = 0; v < garment.vertex_count; v++) {
		float beyond = garment.rest_m[v].x - 0.16f;
		if (beyond > 0.0f) {
			cloth.position_m[v].x -= 2.0f * beyond;
			cloth.position_m[v].z += 0.006f;
		}
		cloth.previous_m[v] = cloth.position_m[v];
	}
	cloth_sweep(&cloth);
	CHECK(cloth_unfold(&cloth, 0, 1, &units) > 0);
	int left = 1;
	for (int round = 0; round < 12 && left > 0; round++) {
		for (int sweep = 0; sweep < 30; sweep++)
			cloth_sweep(&cloth);
		left = cloth_unfold(&cloth, 0, 1, &units);
	}
	CHECK(left == 0);
}

/* Restoring a state gives back its positions; from there equal sweeps give equal bits. */
static void test_restore_repeats(void)
{
	memset(&pattern, 0, sizeof pattern);
	add_rectangle(0, 400.0f, 400.0f);
	mesh(500);
	lay((struct v3){-0.2f, 1.05f, 0.2f}, (struct v3){1.0f, 0.0f, 0.0f},
	    (struct v3){0.0f, 0.0f, -1.0f});
	for (int sweep = 0; sweep < 100; sweep++)
		cloth_sweep(&cloth);
	static struct v3 kept[GARMENT_VERTICES_MAX];
	static uint8_t placed[GARMENT_VERTICES_MAX];
	memcpy(kept, cloth.position_m, sizeof kept);
	memcpy(placed, cloth.placed, sizeof placed);
	uint64_t hash[2];
	for (int run = 0; run < 2; run++) {
		cloth_restore(&cloth, &garment, &body, kept, placed, false, true);
		CHECK(memcmp(kept, cloth.position_m, (size_t)garment.vertex_count * sizeof *kept) ==
		      0);
		for (int sweep = 0; sweep < 200; sweep++)
			cloth_sweep(&cloth);
		hash[run] = cloth_hash();
	}
	CHECK(hash[0] == hash[1]);
}

/* A sheet crumpled into a ball, some triangles collapsed, and let go: every form of the kernels
 * moves it by the same bits. */
static void test_lanes_agree(void)
{
	static const int forms[] = {1, 4, 8};
	static struct v3 ball[GARMENT_VERTICES_MAX];
	static uint8_t placed[GARMENT_VERTICES_MAX];
	struct scatter scatter = {4711u};
	uint64_t hash[COUNT_OF(forms)];
	memset(&pattern, 0, sizeof pattern);
	add_rectangle(0, 300.0f, 400.0f);
	mesh(700);
	for (int v = 0; v < garment.vertex_count; v++)
		ball[v] = (struct v3){1.0f + 0.0002f * (float)scatter_below(&scatter, 700),
				      0.5f + 0.0002f * (float)scatter_below(&scatter, 700),
				      0.0002f * (float)scatter_below(&scatter, 3)};
	memset(placed, 1, sizeof placed);
	for (int f = 0; f < COUNT_OF(forms); f++) {
		cloth_restore(&cloth, &garment, &body, ball, placed, false, true);
		cloth.lanes = forms[f];
#ifdef __x86_64__
		if (forms[f] == 8 && !__builtin_cpu_supports("avx2"))
			cloth.lanes = 4;
#endif
		cloth.settings.shear = 0.6f;
		for (int sweep = 0; sweep < 40; sweep++)
			cloth_sweep(&cloth);
		hash[f] = cloth_hash();
	}
	CHECK(memcmp(ball, cloth.position_m, sizeof *ball) != 0);
	CHECK(hash[0] == hash[1]);
	CHECK(hash[0] == hash[2]);
	cloth.lanes = 4;
}

static void test_ray(void)
{
	memset(&pattern, 0, sizeof pattern);
	add_rectangle(0, 200.0f, 200.0f);
	mesh(200);
	lay((struct v3){1.0f, 0.5f, 0.0f}, (struct v3){1.0f, 0.0f, 0.0f},
	    (struct v3){0.0f, 1.0f, 0.0f});
	float distance, weight[3];
	struct v3 from = {1.07f, 0.61f, 1.0f}, ahead = {0.0f, 0.0f, -2.0f};
	int t = cloth_ray(&cloth, from, ahead, &distance, weight);
	CHECK(t >= 0);
	CHECK_NEAR(distance, 0.5f, 1e-5f);
	struct v3 hit = {0.0f, 0.0f, 0.0f};
	for (int k = 0; t >= 0 && k < 3; k++)
		hit = v3_mad(hit, cloth.position_m[cloth.triangle[t].v[k]], weight[k]);
	CHECK(v3_distance(hit, (struct v3){1.07f, 0.61f, 0.0f}) < 1e-5f);
	CHECK(cloth_ray(&cloth, from, (struct v3){0.0f, 0.0f, 1.0f}, &distance, weight) < 0);
	static struct v3 normal[GARMENT_VERTICES_MAX];
	cloth_normals(&cloth, normal);
	CHECK_NEAR(normal[0].z, 1.0f, 1e-5f);
}

/* A thin limb: the post, a tenth as wide, with a bone. */
static void build_limb(void)
{
	struct bone_list bones = {.count = 1};
	int at;
	bones.bone[0] = (struct bone){
		PART_ARM_LEFT, {0.0f, 0.05f, 0.0f}, {0.0f, 0.95f, 0.0f}, 0.0f};
	for (int v = 0; v < body.vertex_count; v++) {
		body.position_m[v].x *= 0.1f;
		body.position_m[v].z *= 0.1f;
	}
	CHECK(!body_build(&body, body.position_m, body.vertex_count, body.triangle,
			  body.triangle_count));
	CHECK(!body_give_bones(&body, &bones, &at));
}

static int edges_through(void)
{
	int through = 0;
	struct body_hit hit;
	for (int t = 0; t < garment.triangle_count; t++)
		for (int k = 0; k < 3; k++)
			through += body_segment_hits(
				&body, cloth.position_m[cloth.triangle[t].v[k]],
				cloth.position_m[cloth.triangle[t].v[(k + 1) % 3]], &hit);
	return through;
}

/* A coarse sheet that begins half-way through a limb comes out of it on one side: its ends, left
 * and right of the limb, do not know which. */
static void test_leaves_limb(void)
{
	build_limb();
	memset(&pattern, 0, sizeof pattern);
	add_rectangle(0, 200.0f, 200.0f);
	mesh(24);
	lay((struct v3){-0.09f, 0.4f, 0.0008f}, (struct v3){1.0f, 0.0f, 0.0f},
	    (struct v3){0.0f, 1.0f, 0.0f});
	cloth.settings.gravity_m = 0.0f;
	CHECK(edges_through() > 5);
	for (int sweep = 0; sweep < 200; sweep++)
		cloth_sweep(&cloth);
	CHECK(edges_through() == 0);
}

int main(void)
{
	static unsigned char memory[192u << 20];
	struct arena arena;
	arena_init(&arena, memory, sizeof memory);
	body_init(&body, &arena);
	garment_init(&garment, &arena);
	job = garment_job_init(&arena);
	cloth_init(&cloth, &arena);
	build_post();
	test_hanging_patch();
	test_hangs_from_pins(100.0f, 50.0f, 60, 0.2f);
	test_hangs_from_pins(240.0f, 300.0f, 1500, 0.2f);
	test_hangs_from_pins(400.0f, 600.0f, 3000, 0.2f);
	test_drape_rests();
	test_price();
	test_seam_closes();
	test_fold_turns_back();
	test_restore_repeats();
	test_lanes_agree();
	test_ray();
	test_leaves_limb();
	return test_end();
}
