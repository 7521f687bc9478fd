/* Any bytes as a report descriptor: layouts whose fields lie within their reports, or a reason. */
#include "pen.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void field_check(const struct pen_layout *layout, struct pen_field field)
{
	MUST(field.size >= 0 && field.size <= 32);
	MUST(field.size == 0 || (field.bit >= 0 && field.bit + field.size <= layout->report_bits));
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	struct pen_layout layout[PEN_REPORTS_MAX];
	char reason[160];
	int bytes = size > 2 * DESCRIPTOR_BYTES_MAX ? 2 * DESCRIPTOR_BYTES_MAX : (int)size;
	int count = pen_descriptor_read(data, bytes, layout, reason);
	MUST(count >= 0 && count <= PEN_REPORTS_MAX && (count > 0 || reason[0]));
	for (int i = 0; i < count; i++) {
		const struct pen_layout *l = &layout[i];
		MUST(l->report_bits <= 8 * REPORT_BYTES_MAX);
		const struct pen_field fields[] = {l->x,      l->y,      l->pressure, l->tilt_x,
						   l->tilt_y, l->twist,  l->tip,      l->in_range,
						   l->invert, l->eraser, l->barrel,   l->barrel_2,
						   l->serial};
		for (int f = 0; f < COUNT_OF(fields); f++)
			field_check(l, fields[f]);
	}
	return 0;
}
