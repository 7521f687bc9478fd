/* Bodies as people export them: what is mended, what is refused, and that a sound one stays as it
 * is. Each case spoils a cube of 1.6 m, corner by corner. */
#include "mesh_prepare.h"
#include "test.h"

static const int cube_face[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6},
				     {0, 1, 4}, {1, 5, 4}, {2, 6, 3}, {3, 6, 7},
				     {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};

/* Corners at (+-0.8, 0 or 1.6, +-0.8), triangles outward. */
static void make_cube(struct mesh *mesh)
{
	CHECK(mesh_take(mesh, 8, 12, false));
	for (int v = 0; v < 8; v++)
		mesh->position_m[v] = (struct v3){v & 1 ? 0.8f : -0.8f, v & 2 ? 1.6f : 0.0f,
						  v & 4 ? 0.8f : -0.8f};
	for (int t = 0; t < 12; t++)
		memcpy(mesh->triangle[t].v, cube_face[t], sizeof cube_face[t]);
}

static float volume_m3(const struct mesh *mesh)
{
	float volume = 0.0f;
	for (int t = 0; t < mesh->triangle_count; t++) {
		const int *v = mesh->triangle[t].v;
		volume += v3_dot(mesh->position_m[v[0]],
				 v3_cross(mesh->position_m[v[1]], mesh->position_m[v[2]])) /
			  6.0f;
	}
	return volume;
}

/* Every edge has two triangles, which run along it in opposite directions. */
static bool closed_and_consistent(const struct mesh *mesh)
{
	for (int t = 0; t < mesh->triangle_count; t++)
		for (int k = 0; k < 3; k++) {
			int a = mesh->triangle[t].v[k], b = mesh->triangle[t].v[(k + 1) % 3];
			int same = 0, opposite = 0;
			for (int i = 0; i < 3 * mesh->triangle_count; i++) {
				int c = mesh->triangle[i / 3].v[i % 3];
				int d = mesh->triangle[i / 3].v[(i % 3 + 1) % 3];
				same += a == c && b == d;
				opposite += a == d && b == c;
			}
			if (same != 1 || opposite != 1)
				return false;
		}
	return true;
}

static void check_cube(struct mesh *mesh, const char *expected_note)
{
	char note[200];
	const char *fault = mesh_prepare(mesh, note);
	CHECK(!fault);
	CHECK(expected_note ? strstr(note, expected_note) != NULL : note[0] == 0);
	CHECK(mesh->vertex_count == 8 && mesh->triangle_count == 12);
	CHECK(closed_and_consistent(mesh));
	CHECK_NEAR(volume_m3(mesh), 1.6 * 1.6 * 1.6, 1e-4);
	float floor_m = 1.0f;
	for (int v = 0; v < mesh->vertex_count; v++)
		floor_m = float_min(floor_m, mesh->position_m[v].y);
	CHECK_NEAR(floor_m, 0.0, 1e-5);
	mesh_free(mesh);
}

static void flip(struct triangle *triangle)
{
	int v = triangle->v[0];
	triangle->v[0] = triangle->v[1];
	triangle->v[1] = v;
}

static void test_sound(void)
{
	struct mesh mesh;
	make_cube(&mesh);
	check_cube(&mesh, NULL);
}

static void test_orientation(void)
{
	struct mesh mesh;
	make_cube(&mesh);
	for (int t = 0; t < 12; t++)
		flip(&mesh.triangle[t]);
	check_cube(&mesh, "face outward");
	for (int mask = 1; mask < 4096; mask = mask * 3 + 1) {
		make_cube(&mesh);
		for (int t = 0; t < 12; t++)
			if (mask >> t & 1)
				flip(&mesh.triangle[t]);
		check_cube(&mesh, "face outward");
	}
}

static void test_soup(void)
{
	struct mesh mesh, cube;
	make_cube(&cube);
	CHECK(mesh_take(&mesh, 36, 12, false));
	for (int i = 0; i < 36; i++) {
		mesh.position_m[i] = cube.position_m[cube.triangle[i / 3].v[i % 3]];
		mesh.triangle[i / 3].v[i % 3] = i;
	}
	check_cube(&mesh, "joined");
	mesh_free(&cube);
}

static void test_doubled(void)
{
	struct mesh mesh, cube;
	make_cube(&cube);
	CHECK(mesh_take(&mesh, 9, 15, false));
	memcpy(mesh.position_m, cube.position_m, 8 * sizeof(struct v3));
	mesh.position_m[8] = cube.position_m[0]; /* a vertex that nobody uses */
	memcpy(mesh.triangle, cube.triangle, 12 * sizeof(struct triangle));
	mesh.triangle[12] = cube.triangle[3];
	mesh.triangle[13] = (struct triangle){
		{cube.triangle[5].v[1], cube.triangle[5].v[2], cube.triangle[5].v[0]}};
	mesh.triangle[14] = (struct triangle){{1, 1, 2}};
	check_cube(&mesh, "left out");
	mesh_free(&cube);
}

struct size_case {
	float scale;
	struct v3 shift; /* in scaled units */
	const char *note, *fault;
};

static void test_sizes(void)
{
	static const struct size_case cases[] = {
		{100.0f, {0, 0, 0}, "centimetres", NULL},
		{1000.0f, {0, 0, 0}, "millimetres", NULL},
		{1.0f, {5.0f, 0.3f, 0.0f}, "origin", NULL},
		{1.0f, {0.1f, 0.0f, 0.1f}, NULL, NULL},
		{10.0f, {0, 0, 0}, NULL, "metres"},
		{1e-30f, {0, 0, 0}, NULL, "metres"},
		{1e30f, {0, 0, 0}, NULL, "metres"},
		{1.0f, {1e7f, 0.0f, 0.0f}, NULL, "origin"},
	};
	for (int i = 0; i < COUNT_OF(cases); i++) {
		struct mesh mesh;
		char note[200];
		make_cube(&mesh);
		for (int v = 0; v < 8; v++)
			mesh.position_m[v] = v3_add(v3_scale(mesh.position_m[v], cases[i].scale),
						    cases[i].shift);
		if (!cases[i].fault) {
			check_cube(&mesh, cases[i].note);
			continue;
		}
		const char *fault = mesh_prepare(&mesh, note);
		CHECK(fault && strstr(fault, cases[i].fault));
		mesh_free(&mesh);
	}
}

int main(void)
{
	test_sound();
	test_orientation();
	test_soup();
	test_doubled();
	test_sizes();
	return test_end();
}
