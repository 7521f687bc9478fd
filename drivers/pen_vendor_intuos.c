/* Reports of Wacom's Intuos and Cintiq in three generations.
 *
 * The first (Intuos 1 to 5, Intuos Pro, Cintiq; report 2 or 16) names the tool once as it comes
 * near, and then tells by byte 1 what a report has:
 *
 *   110000xx  a tool comes near: its kind and serial number
 *   0010000x  it is near, but not located
 *   1x1ttttx  position, and by type t: 0 to 3 pressure and tilt, 5 rotation, 10 an airbrush's
 *             wheel, the others what mice have
 *   1000000x  it leaves
 */
#include "pen.h"

enum {
	TOOL_ASSUMED_REPORTS = 10, /* 50 ms at 200 Hz */
	TOUCH_PRESSURE = 10,       /* the tip has no switch */
};

static void nowhere(struct pen_fields *fields)
{
	fields->x = fields->y = -1;
}

/* The tool's kind, 20 bits; 0 for none. */
static uint32_t tool_named(const uint8_t *bytes)
{
	return (uint32_t)bytes[2] << 4 | bytes[3] >> 4 | (uint32_t)(bytes[7] & 0x0f) << 16 |
	       (uint32_t)(bytes[8] & 0xf0) << 8;
}

static bool tool_is_mouse(uint32_t tool)
{
	static const uint16_t mice[] = {0x006, 0x007, 0x017, 0x094, 0x096, 0x097, 0x09c, 0x806};
	for (int i = 0; i < COUNT_OF(mice); i++)
		if (tool == mice[i])
			return true;
	return false;
}

/* All erasers' kinds have this bit, and no pen's has. */
static bool tool_is_eraser(uint32_t tool)
{
	return tool & 0x8;
}

static void remember_pressure(const uint8_t *bytes, struct pen_memory *memory)
{
	memory->pressure = bytes[6] << 3 | (bytes[7] & 0xc0) >> 5 | (bytes[1] & 1);
	memory->tilt_x = ((bytes[7] << 1 & 0x7e) | bytes[8] >> 7) - 64;
	memory->tilt_y = (bytes[8] & 0x7f) - 64;
	memory->barrel = bytes[1] & 0x02;
	memory->barrel_2 = bytes[1] & 0x04;
}

static void forget(struct pen_memory *memory)
{
	*memory = (struct pen_memory){0};
}

static enum pen_decoded position_read(const uint8_t *bytes, struct pen_memory *memory,
				      struct pen_fields *fields)
{
	enum { ROTATION = 5, AIRBRUSH = 10 };
	int type = bytes[1] >> 1 & 15;
	bool pen = type <= 3, extra = type == ROTATION || type == AIRBRUSH;
	/* A pen that lay on the tablet when we came was named before; after a while it is taken as
	 * one. */
	if (!memory->tool && ++memory->reports_unknown < TOOL_ASSUMED_REPORTS)
		return PEN_FOREIGN;
	if (tool_is_mouse(memory->tool) || (!pen && !extra))
		return PEN_FOREIGN;
	if (pen)
		remember_pressure(bytes, memory);
	fields->in_range = true;
	fields->x = pen_be16(bytes + 2) << 1 | (bytes[9] >> 1 & 1);
	fields->y = pen_be16(bytes + 4) << 1 | (bytes[9] & 1);
	fields->pressure = memory->pressure;
	fields->tilt_x = memory->tilt_x;
	fields->tilt_y = memory->tilt_y;
	fields->barrel = memory->barrel;
	fields->barrel_2 = memory->barrel_2;
	fields->tip = memory->pressure > TOUCH_PRESSURE;
	fields->invert = tool_is_eraser(memory->tool);
	fields->eraser = fields->invert && fields->tip;
	return PEN_DECODED;
}

enum pen_decoded pen_intuos_read(const uint8_t *bytes, int size, const struct pen_vendor *vendor,
				 struct pen_memory *memory, struct pen_fields *fields)
{
	if (size < 1 || (bytes[0] != 0x02 && bytes[0] != 0x10) || size > 16)
		return PEN_FOREIGN;
	if (size < 10)
		return PEN_CUT_OFF;
	(void)vendor;
	if ((bytes[1] & 0xfc) == 0xc0) {
		forget(memory);
		memory->tool = tool_named(bytes);
		fields->in_range = !tool_is_mouse(memory->tool);
		nowhere(fields);
		return fields->in_range ? PEN_DECODED : PEN_FOREIGN;
	}
	if ((bytes[1] & 0xfe) == 0x80) {
		forget(memory);
		return PEN_DECODED;
	}
	if ((bytes[1] & 0xfe) == 0x20) {
		memory->pressure = 0;
		fields->in_range = !tool_is_mouse(memory->tool);
		nowhere(fields);
		return fields->in_range ? PEN_DECODED : PEN_FOREIGN;
	}
	return bytes[1] & 0x20 ? position_read(bytes, memory, fields) : PEN_FOREIGN;
}

/* Report 16, where the descriptor does not tell what is in it. */
enum pen_decoded pen_intuos_pro_2_read(const uint8_t *bytes, int size,
				       const struct pen_vendor *vendor, struct pen_memory *memory,
				       struct pen_fields *fields)
{
	if (size < 1 || bytes[0] != 0x10)
		return PEN_FOREIGN;
	if (size < 12)
		return PEN_CUT_OFF;
	(void)vendor;
	(void)memory;
	fields->in_range = bytes[1] & 0x20;
	fields->tip = bytes[1] & 0x01;
	fields->barrel = bytes[1] & 0x02;
	fields->barrel_2 = bytes[1] & 0x04;
	fields->invert = bytes[1] & 0x10;
	fields->eraser = fields->invert && fields->tip;
	fields->x = pen_le24(bytes + 2);
	fields->y = pen_le24(bytes + 5);
	fields->pressure = pen_le16(bytes + 8);
	fields->tilt_x = (int8_t)bytes[10];
	fields->tilt_y = (int8_t)bytes[11];
	return PEN_DECODED;
}

/* Reports 30 (24 bits) and 31 (16 bits). Tilt is in degrees, 30 has hundredths of them. */
enum pen_decoded pen_intuos_pro_3_read(const uint8_t *bytes, int size,
				       const struct pen_vendor *vendor, struct pen_memory *memory,
				       struct pen_fields *fields)
{
	bool wide = size > 0 && bytes[0] == 0x1e;
	if (size < 1 || (!wide && bytes[0] != 0x1f))
		return PEN_FOREIGN;
	if (size < (wide ? 15 : 12))
		return PEN_CUT_OFF;
	if (!wide && bytes[1] != 0x01)
		return PEN_FOREIGN;
	(void)vendor;
	(void)memory;
	fields->in_range = bytes[2] & 0x40;
	fields->tip = bytes[2] & 0x01;
	fields->barrel = bytes[2] & 0x02;
	fields->barrel_2 = bytes[2] & 0x04;
	fields->invert = bytes[2] & 0x20;
	fields->eraser = fields->invert && fields->tip;
	fields->x = wide ? pen_le24(bytes + 3) : pen_le16(bytes + 3);
	fields->y = wide ? pen_le24(bytes + 6) : pen_le16(bytes + 5);
	fields->pressure = pen_le16(bytes + (wide ? 9 : 7));
	fields->tilt_x = wide ? (int16_t)pen_le16(bytes + 11) / 100 : (int8_t)bytes[9];
	fields->tilt_y = wide ? (int16_t)pen_le16(bytes + 13) / 100 : (int8_t)bytes[11];
	return PEN_DECODED;
}
