#include "jitter.h"

enum { SCATTER_STEPS = 2001 }; /* offsets come in thousandths of the reach */

void jitter_init(struct jitter *jitter, float reach_mm, uint32_t seed)
{
	jitter->reach_mm = reach_mm;
	jitter->scatter.state = seed * 2654435761u ^ 0x9e3779b9u;
	if (jitter->scatter.state == 0)
		jitter->scatter.state = 1;
}

static void field_write(const struct pen_field *field, uint8_t *bytes, int64_t value)
{
	for (int i = 0; i < field->size; i++) {
		int bit = field->bit + i;
		uint8_t mask = (uint8_t)(1u << (bit % 8));
		bytes[bit / 8] = (uint8_t)((bytes[bit / 8] & ~mask) |
					   ((value >> i & 1) ? mask : 0));
	}
}

/* A tablet that does not say how large it is counts as 200 mm. */
static void move(struct jitter *jitter, const struct pen_field *field, float size_mm, int value,
		 uint8_t *bytes)
{
	int64_t range = (int64_t)field->maximum - field->minimum;
	int step = scatter_below(&jitter->scatter, SCATTER_STEPS) - SCATTER_STEPS / 2;
	float share = jitter->reach_mm / (size_mm > 0.0f ? size_mm : 200.0f);
	float offset = share * (float)range * (float)step / (float)(SCATTER_STEPS / 2);
	int64_t moved = value + (int64_t)offset;
	moved = moved < field->minimum ? field->minimum : moved;
	moved = moved > field->maximum ? field->maximum : moved;
	field_write(field, bytes, moved);
}

void jitter_frame(struct jitter *jitter, const struct pen *pen, struct frame_reports *reports)
{
	for (int r = 0; r < reports->count; r++) {
		struct raw_report *report = &reports->report[r];
		struct pen_fields fields;
		struct pen_memory memory = {0};
		bool cut_off;
		if (report->device < 0 || report->device >= PEN_DEVICES_MAX)
			continue;
		const struct pen_device *device = &pen->device[report->device];
		const struct pen_layout *layout = device->kind != DEVICE_PEN
							  ? NULL
							  : pen_report_read(device->layout,
									    device->layout_count,
									    report->bytes,
									    report->size, &memory,
									    &fields, &cut_off);
		/* a maker's protocol is only read, never written */
		if (!layout || layout->vendor.family != PEN_BY_DESCRIPTOR)
			continue;
		move(jitter, &layout->x, layout->width_mm, fields.x, report->bytes);
		move(jitter, &layout->y, layout->height_mm, fields.y, report->bytes);
	}
}
