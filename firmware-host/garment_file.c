#include "garment_file.h"

#include "format_glb.h"
#include "format_obj.h"

#include <stdio.h>
#include <stdlib.h>

static const char title[] = "kitsuke";

/* Group names are one printable word each, and no two alike: piece 3 called "" is "piece-3", a
 * second "sleeve" is "sleeve-2". */
static void name_group(struct mesh *mesh, int g, const char *piece_name, int piece)
{
	char word[NAME_BYTES_MAX - 4] = "";
	for (int i = 0; piece_name[i] && i < COUNT_OF(word) - 1; i++) {
		unsigned char c = (unsigned char)piece_name[i];
		word[i] = c <= ' ' || c == 0x7f ? '_' : piece_name[i];
	}
	if (!word[0])
		snprintf(word, sizeof word, "piece-%d", piece);
	char *name = mesh->group[g].name;
	snprintf(name, NAME_BYTES_MAX, "%s", word);
	for (int other = 0, again = 2; other < g; other++)
		if (strcmp(mesh->group[other].name, name) == 0) {
			snprintf(name, NAME_BYTES_MAX, "%s-%d", word, again++);
			other = -1;
		}
}

void garment_groups(struct mesh *mesh, const struct session *session)
{
	const struct garment *garment = &session->garment;
	for (int p = 0; p < PIECES_MAX; p++) {
		int first = garment->piece_first[p], end = garment->piece_first[p + 1];
		int from = garment->piece_first_triangle[p];
		if (end == first)
			continue;
		name_group(mesh, mesh->group_count, session->document.pattern.piece[p].name, p);
		struct mesh_group *group = &mesh->group[mesh->group_count++];
		group->vertex_first = first;
		group->vertex_count = end - first;
		group->triangle_first = from;
		group->triangle_count = garment->piece_first_triangle[p + 1] - from;
	}
}

/* Readers want unit normals everywhere, in crumpled corners too. */
static void mend_normals(struct mesh *mesh)
{
	for (int v = 0; v < mesh->vertex_count; v++) {
		mesh->normal[v] = v3_normalize(mesh->normal[v]);
		if (v3_dot(mesh->normal[v], mesh->normal[v]) < 0.5f)
			mesh->normal[v] = (struct v3){0.0f, 1.0f, 0.0f};
	}
}

static bool make_mesh(struct mesh *mesh, const struct session *session)
{
	const struct garment *garment = &session->garment;
	const struct cloth *cloth = &session->cloth;
	if (!mesh_take(mesh, garment->vertex_count, garment->triangle_count, true))
		return false;
	cloth_normals(cloth, mesh->normal);
	mend_normals(mesh);
	for (int v = 0; v < garment->vertex_count; v++) {
		mesh->position_m[v] = cloth->position_m[cloth->particle[v]];
		mesh->texture_m[v] = garment->rest_m[v];
	}
	memcpy(mesh->triangle, garment->triangle,
	       (size_t)garment->triangle_count * sizeof *mesh->triangle);
	garment_groups(mesh, session);
	return true;
}

static bool write_file(void *bytes, size_t size, const char *path, char fault[FAULT_BYTES])
{
	if (!bytes) {
		snprintf(fault, FAULT_BYTES, "%.250s: not enough memory to write it", path);
		return false;
	}
	bool written = store_write(path, bytes, size, fault);
	free(bytes);
	return written;
}

bool garment_write(const struct session *session, const char *obj_path, const char *glb_path,
		   char fault[FAULT_BYTES])
{
	struct mesh mesh;
	size_t size = 0;
	if (!session->cloth.worn) {
		snprintf(fault, FAULT_BYTES, "there is no garment on the body to be written; %s",
			 "a finished wrap puts one there");
		return false;
	}
	if (!make_mesh(&mesh, session)) {
		snprintf(fault, FAULT_BYTES, "not enough memory to write the garment");
		return false;
	}
	bool written = true;
	if (obj_path) {
		char *text = format_obj_write(&mesh, title, &size);
		written = write_file(text, size, obj_path, fault);
	}
	if (written && glb_path) {
		uint8_t *bytes = format_glb_write(&mesh, title, &size);
		written = write_file(bytes, size, glb_path, fault);
	}
	mesh_free(&mesh);
	return written;
}
