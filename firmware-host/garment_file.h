/* The worn garment as files for other programs: OBJ and GLB. */
#ifndef GARMENT_FILE_H
#define GARMENT_FILE_H

#include "mesh.h"
#include "session.h"
#include "store.h"

/* The groups of the file, a piece each: names, and runs of the garment's vertices and triangles. */
void garment_groups(struct mesh *mesh, const struct session *session);

/* Writes what lies on the body: metres, normals out, a group per piece, texture coordinates =
 * pattern coordinates in metres. Vertices are split at seams, where both sides stand at the same
 * place. Either path may be NULL. False: there is no garment, or the fault of the file. */
bool garment_write(const struct session *session, const char *obj_path, const char *glb_path,
		   char fault[FAULT_BYTES]);

#endif
