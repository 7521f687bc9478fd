/* An OBJ file as it stands: v, vt, g, and faces of three corners (larger ones as fans). */
#include "drape.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void quit(const char *path, const char *why)
{
	fprintf(stderr, "drape: %s: %s\n", path, why);
	exit(1);
}

/* Room for one more in an array that grows by doubling. */
static void *grown(void *array, int count, size_t size)
{
	if (count & (count - 1))
		return array;
	array = realloc(array, size * (size_t)(count ? 2 * count : 1));
	if (!array)
		quit("memory", "is full");
	return array;
}

static void add_triangle(struct drape_mesh *mesh, const int corner[3], const int flat[3])
{
	int n = mesh->triangle_count++;
	mesh->corner = grown(mesh->corner, n, sizeof *mesh->corner);
	mesh->flat = grown(mesh->flat, n, sizeof *mesh->flat);
	mesh->group = grown(mesh->group, n, sizeof *mesh->group);
	memcpy(mesh->corner[n], corner, sizeof *mesh->corner);
	memcpy(mesh->flat[n], flat, sizeof *mesh->flat);
	mesh->group[n] = mesh->group_count;
}

static void read_face(struct drape_mesh *mesh, char *line, const char *path)
{
	int corner[3] = {0, 0, 0}, flat[3] = {-1, -1, -1}, count = 0;
	char *rest = line + 1;
	for (char *word; (word = strtok_r(rest, " \t\r\n", &rest)) != NULL; count++) {
		char *slash = strchr(word, '/');
		int at = count < 2 ? count : 2;
		if (count > 2) {
			corner[1] = corner[2];
			flat[1] = flat[2];
		}
		corner[at] = atoi(word) - 1;
		flat[at] = slash && slash[1] != '/' ? atoi(slash + 1) - 1 : -1;
		if (corner[at] < 0 || corner[at] >= mesh->vertex_count ||
		    flat[at] >= mesh->texture_count)
			quit(path, "a face names a vertex that is not there");
		if (count >= 2)
			add_triangle(mesh, corner, flat);
	}
}

void drape_load(struct drape_mesh *mesh, const char *path)
{
	char line[1024];
	FILE *file = fopen(path, "r");
	if (!file)
		quit(path, "can't be opened");
	while (fgets(line, sizeof line, file)) {
		struct point p = {0, 0, 0};
		if (sscanf(line, "v %lf %lf %lf", &p.x, &p.y, &p.z) == 3) {
			mesh->vertex = grown(mesh->vertex, mesh->vertex_count,
					     sizeof *mesh->vertex);
			mesh->vertex[mesh->vertex_count++] = p;
		} else if (sscanf(line, "vt %lf %lf", &p.x, &p.y) == 2) {
			mesh->texture = grown(mesh->texture, mesh->texture_count,
					      sizeof *mesh->texture);
			mesh->texture[mesh->texture_count][0] = p.x;
			mesh->texture[mesh->texture_count++][1] = p.y;
		} else if (line[0] == 'g') {
			mesh->group_count++;
		} else if (line[0] == 'f') {
			read_face(mesh, line, path);
		}
	}
	fclose(file);
	if (mesh->triangle_count == 0)
		quit(path, "holds no triangles");
}
