/* Reports of Wacom's smaller and older tablets: eight to ten bytes with report id 2, x and y in
 * bytes 2 to 5 with the low byte first, but for the oldest. */
#include "pen.h"

/* "Near, but I do not know where": both coordinates outside of their ranges. */
static void nowhere(struct pen_fields *fields)
{
	fields->x = fields->y = -1;
}

static enum pen_decoded length_check(const uint8_t *bytes, int size, uint8_t id, int needed)
{
	if (size < 1 || bytes[0] != id)
		return PEN_FOREIGN;
	return size < needed ? PEN_CUT_OFF : PEN_DECODED;
}

/* Report 1 tells when the pen leaves, report 2 comes only while it is near. */
enum pen_decoded pen_penpartner_read(const uint8_t *bytes, int size,
				     const struct pen_vendor *vendor, struct pen_memory *memory,
				     struct pen_fields *fields)
{
	if (size < 1 || (bytes[0] != 1 && bytes[0] != 2))
		return PEN_FOREIGN;
	if (size < 7)
		return PEN_CUT_OFF;
	(void)vendor;
	(void)memory;
	int pressure = (int8_t)bytes[6];
	fields->in_range = bytes[0] == 2 || bytes[5] & 0x80;
	fields->x = pen_le16(bytes + 1);
	fields->y = pen_le16(bytes + 3);
	fields->pressure = int_max(0, pressure + 127);
	fields->invert = bytes[0] == 1 && bytes[5] & 0x20;
	fields->tip = bytes[0] == 1 ? pressure > -127 : pressure > -80 && !(bytes[5] & 0x20);
	fields->eraser = fields->invert && fields->tip;
	fields->barrel = bytes[5] & 0x40;
	return PEN_DECODED;
}

/* The high bits of byte 7 are buttons, which come without a pen too. */
enum pen_decoded pen_graphire_read(const uint8_t *bytes, int size, const struct pen_vendor *vendor,
				   struct pen_memory *memory, struct pen_fields *fields)
{
	enum { PEN, ERASER };
	enum pen_decoded fits = length_check(bytes, size, 2, 8);
	if (fits != PEN_DECODED)
		return fits;
	int tool = bytes[1] >> 5 & 3;
	bool near = bytes[1] & 0x80, was_near = memory->near;
	memory->near = near && tool <= ERASER;
	if (!memory->near && !was_near)
		return PEN_FOREIGN;
	fields->in_range = memory->near;
	fields->x = pen_le16(bytes + 2);
	fields->y = pen_le16(bytes + 4);
	fields->pressure = (bytes[6] | (bytes[7] & 3) << 8) & pen_bits_of(vendor->pressure_maximum);
	fields->tip = bytes[1] & 0x01;
	fields->barrel = bytes[1] & 0x02;
	fields->barrel_2 = bytes[1] & 0x04;
	fields->invert = tool == ERASER;
	fields->eraser = fields->invert && fields->tip;
	return PEN_DECODED;
}

/* Longer reports with id 2 are touch. */
enum pen_decoded pen_bamboo_read(const uint8_t *bytes, int size, const struct pen_vendor *vendor,
				 struct pen_memory *memory, struct pen_fields *fields)
{
	enum { READY = 0x20, PLACED = 0x40, NEAR = 0x80 };
	enum pen_decoded fits = length_check(bytes, size, 2, 9);
	if (fits != PEN_DECODED || size > 10)
		return fits == PEN_CUT_OFF ? fits : PEN_FOREIGN;
	(void)vendor;
	(void)memory;
	fields->in_range = bytes[1] & NEAR;
	if (!(bytes[1] & PLACED)) {
		nowhere(fields);
		return PEN_DECODED;
	}
	fields->x = pen_le16(bytes + 2);
	fields->y = pen_le16(bytes + 4);
	fields->invert = bytes[1] & 0x08;
	if (!(bytes[1] & READY))
		return PEN_DECODED;
	fields->pressure = pen_le16(bytes + 6);
	fields->tip = bytes[1] & 0x01;
	fields->barrel = bytes[1] & 0x02;
	fields->barrel_2 = bytes[1] & 0x04;
	fields->eraser = fields->invert && fields->tip;
	return PEN_DECODED;
}

enum pen_decoded pen_dtu_read(const uint8_t *bytes, int size, const struct pen_vendor *vendor,
			      struct pen_memory *memory, struct pen_fields *fields)
{
	enum pen_decoded fits = length_check(bytes, size, 2, 8);
	if (fits != PEN_DECODED)
		return fits;
	(void)vendor;
	(void)memory;
	fields->in_range = bytes[1] & 0x20;
	fields->x = pen_le16(bytes + 2);
	fields->y = pen_le16(bytes + 4);
	fields->pressure = (bytes[7] & 1) << 8 | bytes[6];
	fields->tip = bytes[1] & 0x05;
	fields->barrel = bytes[1] & 0x02;
	fields->barrel_2 = bytes[1] & 0x10;
	fields->invert = bytes[1] & 0x0c;
	fields->eraser = fields->invert && fields->tip;
	return PEN_DECODED;
}

/* Its pen has no switch in the tip: 10 levels of pressure are a touch. */
enum pen_decoded pen_dtus_read(const uint8_t *bytes, int size, const struct pen_vendor *vendor,
			       struct pen_memory *memory, struct pen_fields *fields)
{
	enum pen_decoded fits = length_check(bytes, size, 0x11, 7);
	if (fits != PEN_DECODED)
		return fits;
	(void)vendor;
	(void)memory;
	fields->in_range = bytes[1] & 0x80;
	fields->x = pen_be16(bytes + 3);
	fields->y = pen_be16(bytes + 5);
	fields->pressure = (bytes[1] & 3) << 8 | bytes[2];
	fields->tip = fields->pressure > 10;
	fields->barrel = bytes[1] & 0x20;
	fields->barrel_2 = bytes[1] & 0x40;
	return PEN_DECODED;
}

/* Seven bits a byte; the pressure is signed, its lowest bits stand among the flags. */
enum pen_decoded pen_pl_read(const uint8_t *bytes, int size, const struct pen_vendor *vendor,
			     struct pen_memory *memory, struct pen_fields *fields)
{
	enum pen_decoded fits = length_check(bytes, size, 2, 8);
	if (fits != PEN_DECODED)
		return fits;
	(void)memory;
	int pressure = (int8_t)(uint8_t)(bytes[7] << 1 | (bytes[4] >> 2 & 1));
	if (vendor->pressure_maximum > 255)
		pressure = 2 * pressure + (bytes[4] >> 6 & 1);
	fields->in_range = bytes[1] & 0x40;
	fields->x = bytes[3] | bytes[2] << 7 | (bytes[1] & 3) << 14;
	fields->y = bytes[6] | bytes[5] << 7 | (bytes[4] & 3) << 14;
	fields->pressure = int_max(0, pressure + (vendor->pressure_maximum + 1) / 2);
	fields->tip = bytes[4] & 0x08;
	fields->barrel = bytes[4] & 0x10;
	fields->barrel_2 = bytes[4] & 0x20;
	return PEN_DECODED;
}

enum pen_decoded pen_ptu_read(const uint8_t *bytes, int size, const struct pen_vendor *vendor,
			      struct pen_memory *memory, struct pen_fields *fields)
{
	enum pen_decoded fits = length_check(bytes, size, 2, 8);
	if (fits != PEN_DECODED)
		return fits;
	(void)vendor;
	(void)memory;
	fields->invert = bytes[1] & 0x04;
	fields->in_range = bytes[1] & 0x20;
	fields->x = pen_le16(bytes + 2);
	fields->y = pen_le16(bytes + 4);
	fields->pressure = pen_le16(bytes + 6);
	fields->tip = bytes[1] & (fields->invert ? 0x08 : 0x01);
	fields->eraser = fields->invert && fields->tip;
	fields->barrel = bytes[1] & 0x02;
	fields->barrel_2 = bytes[1] & 0x10;
	return PEN_DECODED;
}
