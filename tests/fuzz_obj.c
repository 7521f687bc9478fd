/* Any bytes as an OBJ: refused with words, or a mesh whose indices all exist. */
#include "format_obj.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void read_garment(const char *text, size_t size)
{
	struct mesh mesh;
	char fault[200] = "";
	if (!format_obj_read_garment(&mesh, text, size, fault)) {
		MUST(fault[0]);
		return;
	}
	MUST(mesh.vertex_count == 3 * mesh.triangle_count && mesh.group_count <= PIECES_MAX);
	for (int g = 0; g < mesh.group_count; g++)
		MUST(mesh.group[g].triangle_first >= 0 && mesh.group[g].triangle_count >= 0 &&
		     mesh.group[g].triangle_first + mesh.group[g].triangle_count <=
			     mesh.triangle_count);
	mesh_free(&mesh);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	read_garment((const char *)data, size);
	struct mesh mesh;
	char fault[200] = "";
	if (!format_obj_read(&mesh, (const char *)data, size, fault)) {
		MUST(fault[0]);
		return 0;
	}
	for (int t = 0; t < mesh.triangle_count; t++)
		for (int k = 0; k < 3; k++)
			MUST(mesh.triangle[t].v[k] >= 0 &&
			     mesh.triangle[t].v[k] < mesh.vertex_count);
	mesh_free(&mesh);
	return 0;
}
