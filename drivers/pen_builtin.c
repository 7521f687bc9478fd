/* The report descriptors of two devices of our own: the buttons and the desktop's mouse. */
#include "pen.h"

/* One byte: wrap, pin, relax, five bits of padding. hid-tools plays it as a keypad of three. */
const uint8_t buttons_descriptor[] = {
	0x05, 0x01, /* Usage Page (Generic Desktop) */
	0x09, 0x07, /* Usage (Keypad) */
	0xa1, 0x01, /* Collection (Application) */
	0x05, 0x09, /*   Usage Page (Button) */
	0x19, 0x01, /*   Usage Minimum (1) */
	0x29, 0x03, /*   Usage Maximum (3) */
	0x15, 0x00, /*   Logical Minimum (0) */
	0x25, 0x01, /*   Logical Maximum (1) */
	0x75, 0x01, /*   Report Size (1) */
	0x95, 0x03, /*   Report Count (3) */
	0x81, 0x02, /*   Input (Data, Variable, Absolute) */
	0x75, 0x05, /*   Report Size (5) */
	0x95, 0x01, /*   Report Count (1) */
	0x81, 0x03, /*   Input (Constant) */
	0xc0,       /* End Collection */
};
const int buttons_descriptor_size = sizeof buttons_descriptor;

/* Seven bytes, little endian, no report id. Byte 0: tip, barrel and in range in bits 0, 1, 2; bytes
 * 1 and 2: x; 3 and 4: y; 5 and 6: pressure, 0 to 4095. x and y are 0 to 32767 over the window; no
 * size in mm is stated, so the window's aspect holds (pen_state.c). */
const uint8_t mouse_descriptor[] = {
	0x05, 0x0d,       /* Usage Page (Digitizer) */
	0x09, 0x02,       /* Usage (Pen) */
	0xa1, 0x01,       /* Collection (Application) */
	0x09, 0x20,       /*   Usage (Stylus) */
	0xa1, 0x00,       /*   Collection (Physical) */
	0x09, 0x42,       /*     Usage (Tip Switch) */
	0x09, 0x44,       /*     Usage (Barrel Switch) */
	0x09, 0x32,       /*     Usage (In Range) */
	0x15, 0x00,       /*     Logical Minimum (0) */
	0x25, 0x01,       /*     Logical Maximum (1) */
	0x75, 0x01,       /*     Report Size (1) */
	0x95, 0x03,       /*     Report Count (3) */
	0x81, 0x02,       /*     Input (Data, Variable, Absolute) */
	0x95, 0x05,       /*     Report Count (5) */
	0x81, 0x03,       /*     Input (Constant) */
	0x05, 0x01,       /*     Usage Page (Generic Desktop) */
	0x26, 0xff, 0x7f, /*     Logical Maximum (32767) */
	0x75, 0x10,       /*     Report Size (16) */
	0x95, 0x01,       /*     Report Count (1) */
	0x09, 0x30,       /*     Usage (X) */
	0x81, 0x02,       /*     Input (Data, Variable, Absolute) */
	0x09, 0x31,       /*     Usage (Y) */
	0x81, 0x02,       /*     Input (Data, Variable, Absolute) */
	0x05, 0x0d,       /*     Usage Page (Digitizer) */
	0x09, 0x30,       /*     Usage (Tip Pressure) */
	0x26, 0xff, 0x0f, /*     Logical Maximum (4095) */
	0x81, 0x02,       /*     Input (Data, Variable, Absolute) */
	0xc0,             /*   End Collection */
	0xc0,             /* End Collection */
};
const int mouse_descriptor_size = sizeof mouse_descriptor;
