/* What people export is seldom quite a body: this mends what can be mended without guessing. */
#ifndef MESH_PREPARE_H
#define MESH_PREPARE_H

#include "mesh.h"

/* Millimetres and centimetres become metres, the feet come to y = 0, corners at the same place
 * become one where the surface is open, doubled triangles go, all triangles face outward. What was
 * done, or looks odd, stands in `note` (empty: nothing). Returns NULL or why this can't be a body,
 * with the remedy. Holes and other faults of the surface are left for body_build to name. */
const char *mesh_prepare(struct mesh *mesh, char note[200]);

#endif
