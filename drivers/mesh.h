/* A triangle mesh as files hold it: what the readers and writers of OBJ and GLB share. */
#ifndef MESH_H
#define MESH_H

#include "limits.h"
#include "triangle.h"
#include "vec.h"

enum {
	MESH_VERTICES_MAX = 4000000, /* of a file; what fits a body is body_build's word */
	MESH_TRIANGLES_MAX = 8000000,
};

/* A run of vertices and triangles that belong together: a piece of cloth. */
struct mesh_group {
	char name[NAME_BYTES_MAX]; /* printable, without blanks, unlike the others */
	int vertex_first, vertex_count;
	int triangle_first, triangle_count;
};

struct mesh {
	int vertex_count;
	struct v3 *position_m;
	struct v3 *normal;    /* unit, outward; NULL: none */
	struct v2 *texture_m; /* pattern coordinates, y up; NULL: none */
	int triangle_count;
	struct triangle *triangle;
	int group_count; /* 0: one unnamed whole */
	struct mesh_group group[PIECES_MAX];
};

/* Memory from malloc: files are read and written outside the frame loop. False: there is none. */
bool mesh_take(struct mesh *mesh, int vertex_count, int triangle_count, bool with_texture);
void mesh_free(struct mesh *mesh);

#endif
