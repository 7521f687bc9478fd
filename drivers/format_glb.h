/* glTF 2.0 in its binary form (GLB): garments out. Source: Khronos glTF 2.0 specification, sections
 * 3 and 4. */
#ifndef FORMAT_GLB_H
#define FORMAT_GLB_H

#include "mesh.h"

/* The whole file from malloc, its length in *size; NULL: no memory. The mesh needs normals, texture
 * coordinates and groups: each group becomes a primitive with a material of its name. TEXCOORD_0
 * are pattern coordinates in metres, y up, as in the OBJ (glTF's own image axis points down). */
uint8_t *format_glb_write(const struct mesh *mesh, const char *title, size_t *size);

#endif
