#include "character.h"

#include "format_bones.h"
#include "format_obj.h"
#include "mesh_prepare.h"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

static bool build_from_mesh(struct body *body, struct mesh *mesh, const char *path,
			    char note[FAULT_BYTES], char fault[FAULT_BYTES])
{
	char mended[200];
	const char *wrong = mesh_prepare(mesh, mended);
	if (!wrong)
		wrong = body_build(body, mesh->position_m, mesh->vertex_count, mesh->triangle,
				   mesh->triangle_count);
	if (wrong) {
		snprintf(fault, FAULT_BYTES, "%.250s: %s", path, wrong);
		return false;
	}
	if (mended[0])
		snprintf(note, FAULT_BYTES, "%.250s: %s", path, mended);
	return true;
}

static bool build_from_file(struct body *body, const char *path, char note[FAULT_BYTES],
			    char fault[FAULT_BYTES])
{
	size_t size;
	struct mesh mesh;
	char wrong[200];
	char *text = store_read(path, &size, fault);
	if (!text)
		return false;
	bool read = format_obj_read(&mesh, text, size, wrong);
	free(text);
	if (!read) {
		snprintf(fault, FAULT_BYTES, "%.250s: %s", path, wrong);
		return false;
	}
	bool built = build_from_mesh(body, &mesh, path, note, fault);
	mesh_free(&mesh);
	return built;
}

bool character_read_bones(struct body *body, const char *path, char fault[FAULT_BYTES])
{
	size_t size;
	char wrong[200];
	struct bone_list bones;
	char *text = store_read(path, &size, fault);
	if (!text)
		return false;
	bool read = format_bones_read(&bones, text, size, wrong);
	free(text);
	if (!read) {
		snprintf(fault, FAULT_BYTES, "%.250s: %s", path, wrong);
		return false;
	}
	int at;
	const char *refusal = body_give_bones(body, &bones, &at);
	if (refusal)
		snprintf(fault, FAULT_BYTES, "%.250s: line %d: %s", path, bones.line[at], refusal);
	return !refusal;
}

bool character_write_bones(const struct body *body, const char *path, char fault[FAULT_BYTES])
{
	size_t size;
	struct bone_list bones = {.count = body->bone_count};
	memcpy(bones.bone, body->bone, sizeof bones.bone);
	if (bones.count == 0) {
		snprintf(fault, FAULT_BYTES, "%.250s: the body has no bones to write", path);
		return false;
	}
	char *text = format_bones_write(&bones, &size);
	if (!text) {
		snprintf(fault, FAULT_BYTES, "%.250s: not enough memory to write it", path);
		return false;
	}
	bool written = store_write(path, text, size, fault);
	free(text);
	return written;
}

/* BODY.obj has its bones in BODY.bones. False: there is no such file. */
static bool bones_beside(const char *body_path, char path[PATH_BYTES_MAX])
{
	const char *dot = strrchr(store_name(body_path), '.');
	int stem = dot ? (int)(dot - body_path) : (int)strlen(body_path);
	return snprintf(path, PATH_BYTES_MAX, "%.*s.bones", stem, body_path) < PATH_BYTES_MAX &&
	       access(path, F_OK) == 0;
}

bool character_load(struct body *body, const char *name, const char *folder, char note[FAULT_BYTES],
		    char fault[FAULT_BYTES])
{
	char path[PATH_BYTES_MAX], bones[PATH_BYTES_MAX];
	note[0] = 0;
	if (strcmp(name, CHARACTER_MANNEQUIN) == 0) {
		const char *wrong = body_build_mannequin(body);
		MUST(!wrong); /* our own tables make a sound body */
		MUST(body_find_parts(body));
		return true;
	}
	if (!store_join(path, sizeof path, strchr(name, '/') || !folder ? "." : folder, name,
			fault))
		return false;
	if (strchr(name, '/'))
		snprintf(path, sizeof path, "%s", name);
	if (!build_from_file(body, path, note, fault))
		return false;
	if (bones_beside(path, bones))
		return character_read_bones(body, bones, fault);
	if (!body_find_parts(body) && !note[0])
		snprintf(note, FAULT_BYTES, "%.250s: no head, arms and legs found: %s", name,
			 "all of it counts as trunk, and there are no bones");
	return true;
}

bool character_write_obj(const struct body *body, const char *path, char fault[FAULT_BYTES])
{
	size_t size;
	struct mesh mesh = {.vertex_count = body->vertex_count,
			    .position_m = body->position_m,
			    .triangle_count = body->triangle_count,
			    .triangle = body->triangle};
	char *text = format_obj_write(&mesh, "the body that kitsuke dressed", &size);
	if (!text) {
		snprintf(fault, FAULT_BYTES, "%.250s: not enough memory to write it", path);
		return false;
	}
	bool written = store_write(path, text, size, fault);
	free(text);
	return written;
}
