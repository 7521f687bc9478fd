/* Reports of VEIKK and Acepen: report 9, byte 1 says what about (0x41 the pen, 0x42 buttons, 0x43
 * the touch pad), byte 2 has the flags. Newer tablets send 13 bytes with coordinates of 24 bits,
 * older ones 9 or 11 with 16 bits. */
#include "pen.h"

enum pen_decoded pen_veikk_read(const uint8_t *bytes, int size, const struct pen_vendor *vendor,
				struct pen_memory *memory, struct pen_fields *fields)
{
	if (size < 2 || bytes[0] != 9 || bytes[1] != 0x41)
		return size == 1 && bytes[0] == 9 ? PEN_CUT_OFF : PEN_FOREIGN;
	if (size < 9)
		return PEN_CUT_OFF;
	(void)vendor;
	(void)memory;
	bool wide = size >= 13;
	fields->in_range = bytes[2] & 0x20;
	fields->tip = bytes[2] & 0x01;
	fields->barrel = bytes[2] & 0x02;
	fields->barrel_2 = bytes[2] & 0x04;
	fields->x = wide ? pen_le24(bytes + 3) : pen_le16(bytes + 3);
	fields->y = wide ? pen_le24(bytes + 6) : pen_le16(bytes + 5);
	fields->pressure = pen_le16(bytes + (wide ? 9 : 7));
	if (size >= 11) {
		fields->tilt_x = (int8_t)bytes[wide ? 11 : 9];
		fields->tilt_y = (int8_t)bytes[wide ? 12 : 10];
	}
	return PEN_DECODED;
}
