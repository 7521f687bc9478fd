#include "edit.h"
#include "pattern.h"

const char *const edit_word[EDIT_KIND_COUNT] = {
#define X(kind, word, form) word,
	EDIT_TABLE(X)
#undef X
};

const char *const edit_form[EDIT_KIND_COUNT] = {
#define X(kind, word, form) form,
	EDIT_TABLE(X)
#undef X
};

struct edit *edit_push(struct edit_list *list, enum edit_kind kind)
{
	if (list->count == FRAME_EDITS_MAX)
		return NULL;
	struct edit *edit = &list->item[list->count++];
	memset(edit, 0, sizeof *edit);
	edit->kind = kind;
	return edit;
}

void edit_draw_piece(struct edit *edit, const struct piece *piece)
{
	memset(edit, 0, sizeof *edit);
	edit->kind = EDIT_PIECE;
	memcpy(edit->name, piece->name, NAME_BYTES_MAX);
	edit->i[0] = piece->swatch;
	edit->i[1] = piece->inside_up;
	edit->f[0] = piece->position_mm.x;
	edit->f[1] = piece->position_mm.y;
	edit->f[2] = piece->turn_rad;
	edit->point_count = piece->point_count;
	for (int i = 0; i < piece->point_count; i++) {
		edit->point[i] = (struct v3){piece->point_mm[i].x, piece->point_mm[i].y, 0.0f};
		edit->corner[i] = piece->corner[i];
	}
}
