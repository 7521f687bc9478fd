#include "jitter.h"

enum { SCATTER_STEPS = 2001 }; /* offsets come in thousandths of the reach */

void jitter_init(struct jitter *jitter, float reach_mm, uint32_t seed)
{
	jitter->reach_mm = reach_mm;
	jitter->scatter.state = seed * 2654435761u ^ 0x9e3779b9u;
	if (jitter->scatter.state == 0)
		jitter->scatter.state = 1;
}

static bool field_lies_within(const struct pen_field *field, const struct raw_report *report)
{
	return field->size > 0 && field->size <= 32 && field->bit >= 0 &&
	       field->bit + field->size <= 8 * report->size;
}

static int64_t field_read(const struct pen_field *field, const uint8_t *bytes)
{
	uint64_t value = 0;
	for (int i = 0; i < field->size; i++) {
		int bit = field->bit + i;
		value |= (uint64_t)(bytes[bit / 8] >> (bit % 8) & 1) << i;
	}
	if (field->is_signed && value >> (field->size - 1) & 1)
		return (int64_t)value - ((int64_t)1 << field->size);
	return (int64_t)value;
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
static void move(struct jitter *jitter, const struct pen_field *field, float size_mm,
		 struct raw_report *report)
{
	int range = field->maximum - field->minimum;
	int step = scatter_below(&jitter->scatter, SCATTER_STEPS) - SCATTER_STEPS / 2;
	if (!field_lies_within(field, report) || range <= 0)
		return;
	float share = jitter->reach_mm / (size_mm > 0.0f ? size_mm : 200.0f);
	float offset = share * (float)range * (float)step / (float)(SCATTER_STEPS / 2);
	int64_t value = field_read(field, report->bytes) + (int64_t)offset;
	value = value < field->minimum ? field->minimum : value;
	value = value > field->maximum ? field->maximum : value;
	field_write(field, report->bytes, value);
}

void jitter_frame(struct jitter *jitter, const struct pen *pen, struct frame_reports *reports)
{
	for (int r = 0; r < reports->count; r++) {
		struct raw_report *report = &reports->report[r];
		if (report->device < 0 || report->device >= PEN_DEVICES_MAX)
			continue;
		const struct pen_device *device = &pen->device[report->device];
		for (int l = 0; device->kind == DEVICE_PEN && l < device->layout_count; l++) {
			const struct pen_layout *layout = &device->layout[l];
			if (layout->report_id && layout->report_id != report->bytes[0])
				continue;
			move(jitter, &layout->x, layout->width_mm, report);
			move(jitter, &layout->y, layout->height_mm, report);
			break;
		}
	}
}
