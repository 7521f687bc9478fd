/* Bodies of the shared test data, for tests. */
#ifndef READ_BODY_H
#define READ_BODY_H

#include "body.h"
#include "format_obj.h"

#include <stdio.h>
#include <stdlib.h>

/* Builds ../shared/data/bodies/NAME.obj; false: the file is not there or is no body. */
static inline bool read_body(struct body *body, const char *name)
{
	char path[200], fault[200];
	struct mesh mesh;
	snprintf(path, sizeof path, "../shared/data/bodies/%s.obj", name);
	FILE *file = fopen(path, "rb");
	if (!file)
		return false;
	static char text[4 << 20];
	size_t size = fread(text, 1, sizeof text, file);
	fclose(file);
	if (!format_obj_read(&mesh, text, size, fault))
		return false;
	const char *wrong = body_build(body, mesh.position_m, mesh.vertex_count, mesh.triangle,
				       mesh.triangle_count);
	mesh_free(&mesh);
	return !wrong;
}

#endif
