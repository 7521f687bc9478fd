/* Any text as bones: in order, of known parts and finite; what is written reads back the same. */
#include "format_bones.h"

#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* -0 may become 0. */
static bool same(const struct bone *a, const struct bone *b)
{
	return a->part == b->part && v3_distance(a->a_m, b->a_m) == 0.0f &&
	       v3_distance(a->b_m, b->b_m) == 0.0f && a->radius_m == b->radius_m;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	struct bone_list bones, again;
	char fault[200];
	if (!format_bones_read(&bones, (const char *)data, size, fault)) {
		MUST(!strncmp(fault, "line ", 5));
		return 0;
	}
	MUST(bones.count >= 1 && bones.count <= BODY_BONES_MAX);
	for (int b = 0; b < bones.count; b++) {
		MUST(bones.bone[b].part >= 0 && bones.bone[b].part < PART_COUNT);
		MUST(v3_length(bones.bone[b].a_m) < 200.0f && bones.bone[b].radius_m >= 0.0f);
	}
	char *text = format_bones_write(&bones, &size);
	MUST(text && format_bones_read(&again, text, size, fault));
	MUST(again.count == bones.count);
	for (int b = 0; b < bones.count; b++)
		MUST(same(&again.bone[b], &bones.bone[b]));
	free(text);
	return 0;
}
