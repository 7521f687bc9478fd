/* The worn garment as files for other programs: OBJ and GLB. */
#ifndef GARMENT_FILE_H
#define GARMENT_FILE_H

#include "session.h"
#include "store.h"

/* Writes what lies on the body: metres, normals out, a group per piece, texture coordinates =
 * pattern coordinates in metres. Vertices are split at seams, where both sides stand at the same
 * place. Either path may be NULL. False: there is no garment, or the fault of the file. */
bool garment_write(const struct session *session, const char *obj_path, const char *glb_path,
		   char fault[FAULT_BYTES]);

#endif
