/* Fields out of a report, by its layout. Bits count from the lowest of byte 0, little endian (HID
 * 1.11, section 8). */
#include "pen.h"

/* Up to 32 bits from any bit on; the caller has made sure that they lie within the report. */
static int field_read(const struct pen_field *field, const uint8_t *bytes)
{
	uint64_t value = 0;
	int first = field->bit / 8, last = (field->bit + field->size - 1) / 8;
	for (int i = last; i >= first; i--) /* at most five bytes */
		value = value << 8 | bytes[i];
	value >>= field->bit % 8;
	uint64_t sign = UINT64_C(1) << (field->size - 1);
	value &= 2 * sign - 1;
	if (field->is_signed && value & sign)
		return (int)((int64_t)value - (int64_t)(2 * sign));
	return value > INT32_MAX ? INT32_MAX : (int)value;
}

static int value_or_zero(const struct pen_field *field, const uint8_t *bytes)
{
	return field->size ? field_read(field, bytes) : 0;
}

static void described_read(const struct pen_layout *layout, const uint8_t *bytes,
			   struct pen_fields *fields)
{
	*fields = (struct pen_fields){
		.x = field_read(&layout->x, bytes),
		.y = field_read(&layout->y, bytes),
		.pressure = value_or_zero(&layout->pressure, bytes),
		.tilt_x = value_or_zero(&layout->tilt_x, bytes),
		.tilt_y = value_or_zero(&layout->tilt_y, bytes),
		.twist = value_or_zero(&layout->twist, bytes),
		.tip = value_or_zero(&layout->tip, bytes) != 0,
		.in_range = value_or_zero(&layout->in_range, bytes) != 0,
		.invert = value_or_zero(&layout->invert, bytes) != 0,
		.eraser = value_or_zero(&layout->eraser, bytes) != 0,
		.barrel = value_or_zero(&layout->barrel, bytes) != 0,
		.barrel_2 = value_or_zero(&layout->barrel_2, bytes) != 0,
	};
}

const struct pen_layout *pen_report_read(const struct pen_layout *layout, int layout_count,
					 const uint8_t *bytes, int size, struct pen_memory *memory,
					 struct pen_fields *fields, bool *cut_off)
{
	*cut_off = false;
	for (int i = 0; i < layout_count; i++, layout++) {
		if (layout->vendor.family != PEN_BY_DESCRIPTOR) {
			*fields = (struct pen_fields){0};
			enum pen_decoded decoded = pen_family_rule(layout->vendor.family)
							   ->read(bytes, size, &layout->vendor,
								  memory, fields);
			*cut_off = decoded == PEN_CUT_OFF;
			if (decoded == PEN_DECODED)
				return layout;
			if (*cut_off)
				return NULL;
			continue;
		}
		if (size < 1 || (layout->report_id && layout->report_id != bytes[0]))
			continue;
		if (8 * size < layout->report_bits) {
			*cut_off = true;
			return NULL;
		}
		described_read(layout, bytes, fields);
		return layout;
	}
	return NULL;
}
