/* Edits of shapes out of any numbers, and what holds of a document whatever was done to it. */
#ifndef EDITS_H
#define EDITS_H

#include "pattern_shape.h"
#include "session.h"

/* Eight bytes choose an edit of a shape or of sewing, its piece and places; small numbers mostly,
 * so that they meet something. */
static inline struct edit edit_of_bytes(const uint8_t byte[8])
{
	static const enum edit_kind kind[] = {EDIT_SCALE, EDIT_POINT,  EDIT_BEND, EDIT_SPLIT,
					      EDIT_JOIN,  EDIT_FOLD,   EDIT_EVEN, EDIT_SEW,
					      EDIT_UNSEW, EDIT_MIRROR, EDIT_COPY, EDIT_DELETE,
					      EDIT_PLACE, EDIT_UNDO,   EDIT_REDO, EDIT_POINT};
	struct edit edit;
	memset(&edit, 0, sizeof edit);
	edit.kind = kind[byte[0] & 15];
	edit.i[0] = byte[1] % 5;
	edit.i[1] = byte[2] % 9;
	edit.i[2] = byte[3] % 5;
	edit.i[3] = byte[4] % 9;
	edit.i[4] = byte[5] & 1;
	for (int i = 0; i < 3; i++)
		edit.f[i] = 8.0f * (float)((int)byte[3 + i] - 128);
	edit.f[3] = (float)((int)byte[6] - 128);
	if (edit.kind == EDIT_SCALE)
		edit.f[0] = 0.02f * (float)byte[3], edit.f[1] = 0.02f * (float)byte[4];
	if (edit.kind == EDIT_SPLIT)
		edit.f[0] = (float)byte[3] / 255.0f;
	if (edit.kind == EDIT_FOLD)
		edit.i[1] = byte[2] % 4 != 0, edit.f[2] = 0.0245f * (float)byte[7];
	return edit;
}

/* Every piece can be cut, every seam joins two edges that are there, no edge is sewn twice. */
static inline bool document_is_sound(const struct document *document)
{
	const struct pattern *pattern = &document->pattern;
	bool sewn[PIECES_MAX][OUTLINE_POINTS_MAX] = {{false}};
	for (int p = 0; p < PIECES_MAX; p++)
		if (pattern->piece[p].used && piece_fault(&pattern->piece[p]))
			return false;
	for (int s = 0; s < SEAMS_MAX; s++) {
		const struct seam *seam = &pattern->seam[s];
		for (int side = 0; seam->used && side < 2; side++) {
			const struct edge_ref *edge = side ? &seam->b : &seam->a;
			const struct piece *piece = &pattern->piece[edge->piece];
			if (!piece->used || edge->edge < 0 ||
			    edge->edge >= piece_edge_count(piece) || sewn[edge->piece][edge->edge])
				return false;
			sewn[edge->piece][edge->edge] = true;
		}
	}
	return true;
}

#endif
