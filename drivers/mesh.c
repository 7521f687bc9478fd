#include "mesh.h"

#include <stdlib.h>

bool mesh_take(struct mesh *mesh, int vertex_count, int triangle_count, bool with_texture)
{
	MUST(vertex_count > 0 && vertex_count <= MESH_VERTICES_MAX);
	MUST(triangle_count > 0 && triangle_count <= MESH_TRIANGLES_MAX);
	memset(mesh, 0, sizeof *mesh);
	mesh->vertex_count = vertex_count;
	mesh->triangle_count = triangle_count;
	size_t vertices = (size_t)vertex_count;
	mesh->position_m = calloc(vertices, sizeof *mesh->position_m);
	mesh->triangle = calloc((size_t)triangle_count, sizeof *mesh->triangle);
	bool taken = mesh->position_m && mesh->triangle;
	if (with_texture) {
		mesh->normal = calloc(vertices, sizeof *mesh->normal);
		mesh->texture_m = calloc(vertices, sizeof *mesh->texture_m);
		taken = taken && mesh->normal && mesh->texture_m;
	}
	if (!taken)
		mesh_free(mesh);
	return taken;
}

void mesh_free(struct mesh *mesh)
{
	free(mesh->position_m);
	free(mesh->normal);
	free(mesh->texture_m);
	free(mesh->triangle);
	memset(mesh, 0, sizeof *mesh);
}
