/* Reports of UC-Logic's protocols: version 1 (report 7), version 2 (report 8, by Huion and Gaomon),
 * and Ugee's version 2 (report 2, by XP-Pen, Parblo and Xencelabs).
 *
 * All have flags in byte 1, then x, y and pressure in 16 bits each, low byte first; later ones have
 * the high bytes of x and y, and tilt, behind them. Their buttons and wheels come as reports with
 * the same id and flags from 0xe0 or 0xf0 on.
 */
#include "pen.h"

enum {
	TIP = 0x01,
	BARREL = 0x02,
	BARREL_2 = 0x04,
	ERASER = 0x08, /* Ugee 2 */
	NEAR_UGEE = 0x20,
	AWAY = 0x40,  /* version 1: set while the pen is away, the other way round than usual */
	VALID = 0x80, /* and the high bits decide what a report is about: */
	ABOUT = 0xe0,
	ABOUT_PEN_UGEE = VALID | NEAR_UGEE,
	ABOUT_BUTTONS = 0xe0,
};

static void read_common(const uint8_t *bytes, struct pen_fields *f)
{
	f->x = pen_le16(bytes + 2);
	f->y = pen_le16(bytes + 4);
	f->pressure = pen_le16(bytes + 6);
	f->tip = bytes[1] & TIP;
	f->barrel = bytes[1] & BARREL;
	f->barrel_2 = bytes[1] & BARREL_2;
}

/* Firmware of Ugee's and XP-Pen's has a bit of its own for "near" and sends 0xc0 or 0x80 at the
 * end. All other firmware has one bit, set while the pen is away; on some (XP-Pen Artist 10S) it is
 * set while it is near. A tip that touches tells which, for it cannot touch from away. */
static bool near_1(uint8_t flags, struct pen_memory *memory)
{
	if ((flags & ABOUT) == ABOUT_PEN_UGEE) {
		memory->ugee = true;
		return true;
	}
	if (memory->ugee)
		return false;
	if (flags & TIP)
		memory->upright = flags & AWAY;
	return memory->upright == !!(flags & AWAY);
}

enum pen_decoded pen_uclogic_1_read(const uint8_t *bytes, int size, const struct pen_vendor *vendor,
				    struct pen_memory *memory, struct pen_fields *fields)
{
	if (size < 1 || bytes[0] != 7)
		return PEN_FOREIGN;
	if (size < 8)
		return PEN_CUT_OFF;
	if (!(bytes[1] & VALID) || (bytes[1] & ABOUT) == ABOUT_BUTTONS)
		return PEN_FOREIGN;
	(void)vendor;
	read_common(bytes, fields);
	fields->in_range = near_1(bytes[1], memory);
	if (size >= 10) {
		fields->tilt_x = (int8_t)bytes[8];
		fields->tilt_y = (int8_t)bytes[9];
	}
	return PEN_DECODED;
}

/* The third byte of a coordinate, as far as the tablet's own range needs it. */
static int high_byte(uint8_t byte, int maximum)
{
	return byte << 16 & pen_bits_of(maximum) & ~0xffff;
}

enum pen_decoded pen_uclogic_2_read(const uint8_t *bytes, int size, const struct pen_vendor *vendor,
				    struct pen_memory *memory, struct pen_fields *fields)
{
	if (size < 1 || bytes[0] != 8)
		return PEN_FOREIGN;
	if (size < 12)
		return PEN_CUT_OFF;
	/* 0 in the high half: the pen leaves, on tablets that tell so */
	bool near = bytes[1] & VALID, leaves = !(bytes[1] & 0xf0);
	if ((bytes[1] & ABOUT) == ABOUT_BUTTONS || (!near && !leaves))
		return PEN_FOREIGN;
	(void)memory;
	read_common(bytes, fields);
	fields->in_range = near;
	fields->x |= high_byte(bytes[8], vendor->x_maximum);
	fields->y |= high_byte(bytes[9], vendor->y_maximum);
	fields->tilt_x = (int8_t)bytes[10];
	fields->tilt_y = -(int8_t)bytes[11];
	return PEN_DECODED;
}

/* Bits of the pressure's high byte are flags where the pressure does not need them; pens with 16384
 * levels have the topmost bit in byte 13 of reports that are long enough. */
static int pressure_ugee(const uint8_t *bytes, int size, int maximum)
{
	int bits = pen_bits_of(maximum), pressure = pen_le16(bytes + 6);
	if (size >= 14 && bits >= 0x3fff)
		pressure |= (bytes[13] & 1) << 13;
	return pressure & bits;
}

enum pen_decoded pen_ugee_2_read(const uint8_t *bytes, int size, const struct pen_vendor *vendor,
				 struct pen_memory *memory, struct pen_fields *fields)
{
	if (size < 1 || bytes[0] != 2)
		return PEN_FOREIGN;
	if (size < 8)
		return PEN_CUT_OFF;
	/* bit 4: buttons, wheels, the battery */
	if (!(bytes[1] & VALID) || bytes[1] & 0x10 || (bytes[1] & ABOUT) == ABOUT_BUTTONS)
		return PEN_FOREIGN;
	(void)memory;
	read_common(bytes, fields);
	fields->pressure = pressure_ugee(bytes, size, vendor->pressure_maximum);
	fields->in_range = bytes[1] & NEAR_UGEE;
	fields->invert = bytes[1] & ERASER;
	fields->eraser = fields->invert && fields->tip;
	if (size >= 10) {
		fields->tilt_x = (int8_t)bytes[8];
		fields->tilt_y = (int8_t)bytes[9];
	}
	if (size >= 12) {
		fields->x |= high_byte(bytes[10], vendor->x_maximum);
		fields->y |= high_byte(bytes[11], vendor->y_maximum);
	}
	return PEN_DECODED;
}
