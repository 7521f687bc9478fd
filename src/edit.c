#include "edit.h"

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
