/* Bones of a body as text, a bone a line, from the trunk outward; metres in the body's coordinates
 * (+Y up, facing +Z, the wearer's left is +X):
 *
 *   kitsuke-bones 1
 *   # a comment
 *   spine      0 0.86 0   0 1.22 0.03
 *   neck       0 1.44 -0.02   0 1.5 0.01   0.05
 *   arm-left   0.2 1.32 -0.02   0.34 1.13 0
 *
 * The words are spine, neck, head, arm-left, arm-right, leg-left, leg-right, girdle (collar-bones
 * and hips); then x y z of both ends and, if it is known, the mean distance to the surface. Lines
 * of different words may come in any order, those of one word from the trunk outward. */
#ifndef FORMAT_BONES_H
#define FORMAT_BONES_H

#include "bone.h"

#define BONES_HEADER "kitsuke-bones 1\n"

/* False: fault says "line N: what; remedy". Any bytes are safe. Radii that are not given are 0. */
bool format_bones_read(struct bone_list *bones, const char *text, size_t size, char fault[200]);

/* The whole file as text from malloc, its length in *size; NULL: no memory. */
char *format_bones_write(const struct bone_list *bones, size_t *size);

#endif
