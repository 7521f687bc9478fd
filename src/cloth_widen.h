/* Pieces that are let out because the body is wider than they are cut. */
#ifndef CLOTH_WIDEN_H
#define CLOTH_WIDEN_H

#include "cloth.h"

/* The piece that the body stretches most, as a whole; -1: none by so much that it is to be let out.
 */
int cloth_narrow_piece(const struct cloth *cloth);

/* Lets out (cloth->piece_wide) what the body stretches now; the tables of the mesh are to be built
 * anew (cloth_build_on). */
void cloth_let_out(struct cloth *cloth);

/* A way on triangle t of the flat cloth, once its piece is let out. */
struct v2 cloth_widened(const struct cloth *cloth, int t, struct v2 way);

#endif
