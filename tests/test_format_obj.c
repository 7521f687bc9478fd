/* OBJ in and out: what counts as a vertex and a face, what is refused and with which words. */
#include "format_obj.h"
#include "test.h"

struct obj_case {
	const char *text;
	int vertices, triangles; /* 0: refused */
	const char *fault;       /* a part of it */
};

#define TETRA "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"

static const struct obj_case cases[] = {
	{TETRA "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n", 4, 4, NULL},
	{TETRA "f -4 -2 -3\n", 4, 1, NULL},
	{TETRA "f 1 2 3 4", 4, 2, NULL},
	{TETRA "f 1/1/1 2//3 3/7\n", 4, 1, NULL},
	{"f 1 2 3\n" TETRA, 4, 1, NULL},
	{"\xef\xbb\xbf# c\r\nv\t0 0 0\r\nv 1 0 \\\r\n0\r\nv 0 1 0 1.0 # w\r\nf 1 2 \\\r\n 3\r\n", 3,
	 1, NULL},
	{"v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r", 3, 1, NULL},
	{"# a path C:\\\n" TETRA "f 1 2 3\n", 4, 1, NULL},
	{TETRA "mtllib ../../etc/passwd\nvn 0 0 1\nusemtl x\ns off\nf 1 2 3\n", 4, 1, NULL},
	{TETRA "f 1 1 2 3\n", 4, 1, NULL}, /* a doubled corner costs its flat triangle only */
	{"", 0, 0, "empty"},
	{"# nothing\n", 0, 0, "0 vertices"},
	{TETRA, 0, 0, "0 triangles"},
	{TETRA "f 1 1 2\n", 0, 0, "0 triangles"},
	{TETRA "f 1 2 5\n", 0, 0, "line 5: a face names a vertex"},
	{TETRA "\n\nf 1 2 -5\n", 0, 0, "line 7: a face names a vertex"},
	{TETRA "f 0 1 2\n", 0, 0, "line 5: a face names vertex 0"},
	{TETRA "f 99999999999999999999999 1 2\n", 0, 0, "line 5: a face names a vertex"},
	{TETRA "f 1 2\n", 0, 0, "line 5: a face needs at least three"},
	{TETRA "f 1 2 x\n", 0, 0, "line 5: a face needs whole numbers"},
	{TETRA "f 1 2 3.5\n", 0, 0, "line 5: a face needs whole numbers"},
	{"v 0 0\nf 1 1 1\n", 0, 0, "line 1: a vertex needs three"},
	{"v nan 0 0\n", 0, 0, "line 1: a vertex needs three"},
	{"v 0 1e400 0\n", 0, 0, "line 1: a vertex needs three"},
	{"v 0,5 1,5 2,5\n", 0, 0, "commas"},
	{"\xff\xfev\0", 0, 0, "UTF-16"},
	{"glTF\2\0\0\0", 0, 0, "GLB"},
};

static void test_cases(void)
{
	for (int i = 0; i < COUNT_OF(cases); i++) {
		struct mesh mesh;
		char fault[200] = "";
		bool read = format_obj_read(&mesh, cases[i].text, strlen(cases[i].text), fault);
		bool right = read ? mesh.vertex_count == cases[i].vertices &&
					     mesh.triangle_count == cases[i].triangles
				  : cases[i].fault && strstr(fault, cases[i].fault);
		if (!right)
			fprintf(stderr, "case %d: %d vertices, %d triangles, \"%s\"\n", i,
				read ? mesh.vertex_count : 0, read ? mesh.triangle_count : 0,
				fault);
		CHECK(right);
		if (read)
			mesh_free(&mesh);
	}
}

/* Two pieces: what is written reads back to the same bits, and the groups stand in the text. */
static void test_round_trip(void)
{
	struct mesh mesh, back;
	CHECK(mesh_take(&mesh, 6, 2, true));
	for (int v = 0; v < 6; v++) {
		mesh.position_m[v] = (struct v3){0.1f * (float)v, 1.0f / (float)(v + 3), -1e-7f};
		mesh.normal[v] = (struct v3){0.0f, 0.0f, 1.0f};
		mesh.texture_m[v] = (struct v2){0.25f, -0.125f};
	}
	mesh.triangle[0] = (struct triangle){{0, 1, 2}};
	mesh.triangle[1] = (struct triangle){{3, 5, 4}};
	mesh.group_count = 2;
	mesh.group[0] = (struct mesh_group){"front", 0, 3, 0, 1};
	mesh.group[1] = (struct mesh_group){"back", 3, 3, 1, 1};
	size_t size = 0;
	char fault[200];
	char *text = format_obj_write(&mesh, "a test", &size);
	CHECK(text && strlen(text) == size);
	CHECK(strstr(text, "g front\nv 0 ") && strstr(text, "g back\nv "));
	CHECK(strstr(text, "f 4/4/4 6/6/6 5/5/5\n") && strstr(text, "vt 0.25 -0.125\n"));
	CHECK(format_obj_read(&back, text, size, fault));
	CHECK(back.vertex_count == 6 && back.triangle_count == 2);
	CHECK(memcmp(back.position_m, mesh.position_m, 6 * sizeof(struct v3)) == 0);
	CHECK(memcmp(back.triangle, mesh.triangle, 2 * sizeof(struct triangle)) == 0);
	mesh_free(&mesh);
	mesh_free(&back);
	free(text);
}

int main(void)
{
	test_cases();
	test_round_trip();
	return test_end();
}
