/* The look's tokens: every colour of the picture, once. 0xRRGGBB, sRGB. */
#ifndef LOOK_H
#define LOOK_H

#include "base.h"

enum look_colour {
	LOOK_PAPER = 0xfcfaf5,
	LOOK_GRID = 0xeae2d3,    /* 10 mm */
	LOOK_GRID_50 = 0xdcd2bf, /* 50 mm */
	LOOK_ROOM_LIGHT = 0xf1ebe0,
	LOOK_ROOM_DARK = 0xcfc5b4,
	LOOK_BAR = 0xefe8db,
	LOOK_INK = 0x2b2a28,
	LOOK_INK_GREY = 0x57534c,
	LOOK_NIGHT = 0x1f2e3d,
	LOOK_NIGHT_RAISED = 0x31455a,
	LOOK_HINT = 0xfff6d9,
	LOOK_HINT_RIM = 0xe2c36b,
	LOOK_WRAP = 0xd55e00,
	LOOK_PIN = 0xcc79a7,
	LOOK_RELAX = 0x009e73,
};

/* Cloth by piece.swatch: its outside, and its own reverse, warmer and lighter. */
enum { SWATCHES = 8 };

static const uint32_t look_outside[SWATCHES] = {
	0x7fb0bf, 0xd9a441, 0xb5544b, 0x5f7f4f, 0x39425c, 0xe8e2d4, 0x8a6a93, 0x3f3a36,
};

static const uint32_t look_inside[SWATCHES] = {
	0xe7c4b4, 0xf0dcae, 0xe6b9a6, 0xcfd0a8, 0xa8a2b0, 0xf3e6d2, 0xd9bccb, 0xa3968a,
};

/* Marks by number - 1: colour and dash go together, so that nobody needs to tell colours apart.
 * From number 6 on the same again with doubled lines. */
enum { MARK_STYLES = 5 };

struct mark_style {
	uint32_t colour;
	float dash_px[4]; /* on, off, on, off at 1080 lines; all 0: solid */
};

static const struct mark_style look_mark[MARK_STYLES] = {
	{0x0072b2, {0}},          {0xd55e00, {18, 10, 18, 10}},
	{0x009e73, {3, 9, 3, 9}}, {0xcc79a7, {18, 8, 3, 8}},
	{0x2b2a28, {0}},
};

static inline const struct mark_style *look_mark_style(int number)
{
	return &look_mark[(int_max(number, 1) - 1) % MARK_STYLES];
}

static inline bool look_mark_doubled(int number)
{
	return number > MARK_STYLES;
}

static inline float look_red(uint32_t colour)
{
	return (float)(colour >> 16 & 255) / 255.0f;
}

static inline float look_green(uint32_t colour)
{
	return (float)(colour >> 8 & 255) / 255.0f;
}

static inline float look_blue(uint32_t colour)
{
	return (float)(colour & 255) / 255.0f;
}

#endif
