/* Wavefront OBJ: bodies in, bodies and garments out. Text; lengths are metres.
 *
 * Read are `v` and `f`; polygons become fans. Everything else (normals, texture, groups, materials,
 * and the files that those name) is passed over: only the shape is wanted. Source: the
 * Wavefront Advanced Visualizer file format description, appendix B1.
 */
#ifndef FORMAT_OBJ_H
#define FORMAT_OBJ_H

#include "mesh.h"

/* Any bytes are safe. False: fault says "line N: what; remedy", and there is nothing to free. */
bool format_obj_read(struct mesh *mesh, const char *text, size_t size, char fault[200]);

/* The same for a garment: every corner becomes a vertex of its own with texture_m (`vt`), and
 * groups
 * (`g`, `o`; at most PIECES_MAX) are kept with their triangles. */
bool format_obj_read_garment(struct mesh *mesh, const char *text, size_t size, char fault[200]);

/* The whole file as text from malloc, its length in *size; NULL: no memory. Groups become `g`,
 * with their vertices in front of their faces. */
char *format_obj_write(const struct mesh *mesh, const char *title, size_t *size);

#endif
