/* Any text as marks of a garment with a few places; any bytes as a garment's places, and, where
 * they are a garment, marks guessed for it. */
#include "format_garment.h"
#include "format_marks.h"
#include "format_marks_guess.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void guess(const char *text, size_t size)
{
	static struct pattern pattern;
	static struct garment_places places;
	static struct design_marks marks;
	static char out[GUESS_BYTES_MAX];
	char fault[200];
	if (!format_garment_read(&pattern, text, size, fault))
		return;
	int length = format_marks_guess(out, &pattern, text, size);
	MUST(length >= 0 && length < GUESS_BYTES_MAX && out[length] == '\0');
	if (length > 0)
		format_marks_read(&marks, &pattern, &places, out, (size_t)length, fault);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	static struct pattern pattern;
	static struct garment_places places, any;
	static struct design_marks marks;
	static const struct v2 corner[4] = {
		{0.0f, 0.0f}, {300.0f, 0.0f}, {300.0f, 500.0f}, {0.0f, 500.0f}};
	char fault[200];
	if (!pattern.piece[0].used) {
		struct piece *piece = &pattern.piece[0];
		piece->used = true;
		memcpy(piece->name, "front", 6);
		piece->point_count = places.count = 4;
		for (int i = 0; i < 4; i++) {
			piece->point_mm[i] = places.place[i].point_mm = corner[i];
			piece->corner[i] = true;
			places.place[i].name[0] = (char)('a' + i);
		}
	}
	format_places_read(&any, (const char *)data, size);
	guess((const char *)data, size);
	MUST(any.count >= 0 && any.count <= PLACES_MAX);
	if (!format_marks_read(&marks, &pattern, &places, (const char *)data, size, fault)) {
		MUST(!strncmp(fault, "line ", 5));
		return 0;
	}
	MUST(marks.pin_count >= 0 && marks.pin_count <= PINS_MAX);
	for (int m = 0; m < marks.count; m++) {
		const struct design_mark *mark = &marks.mark[m];
		MUST(mark->point_count >= 2 && mark->point_count <= MARK_POINTS_MAX);
		MUST(memchr(mark->landmark, 0, NAME_BYTES_MAX));
		for (int i = 0; i < mark->point_count; i++)
			MUST(float_abs(mark->point_mm[i].x) < 1e6f &&
			     float_abs(mark->point_mm[i].y) < 1e6f);
	}
	return 0;
}
