/* Where everything is, in whole pixels, so that a touch means the same on every machine.
 *
 *   +--------------------------- bar: steps, undo, redo, language, hand
 * ---------------------------+ | left: figure, view buttons        | right: sheet, hint, swatches |
 *   +--------- bottom: the step's tools | the three twins | start over, finish
 * ----------------------------+
 *
 * Numbers are those of the look's drawing at 1920 x 1080. Positions across scale with the width,
 * sizes with the smaller of width and height, so that other shapes of screen only gain air.
 */
#include "ui.h"

enum { LOOK_WIDTH = 1920, LOOK_HEIGHT = 1080, SCREEN_WIDTH_MM = 476 };

int layout_px(const struct layout *layout, int px_at_1080)
{
	int64_t by_width = (int64_t)layout->width * LOOK_HEIGHT;
	int64_t by_height = (int64_t)layout->height * LOOK_WIDTH;
	int64_t unit = by_width < by_height ? by_width : by_height;
	int64_t scaled = px_at_1080 * unit + (int64_t)LOOK_WIDTH * LOOK_HEIGHT / 2;
	return (int)(scaled / ((int64_t)LOOK_WIDTH * LOOK_HEIGHT));
}

static int across(const struct layout *layout, int x)
{
	return (x * layout->width + LOOK_WIDTH / 2) / LOOK_WIDTH;
}

/* A rectangle whose left edge scales with the width and whose top hangs from `top`. */
static struct rect box(const struct layout *layout, int top, int x, int dy, int w, int h)
{
	return (struct rect){across(layout, x), top + layout_px(layout, dy), layout_px(layout, w),
			     layout_px(layout, h)};
}

static void mirror_within(struct rect *rect, struct rect outer)
{
	if (rect->w > 0)
		rect->x = outer.x + outer.w - (rect->x - outer.x) - rect->w;
}

static void make_panes(struct layout *l)
{
	int bar = layout_px(l, 84), bottom = layout_px(l, 148), split = across(l, 1040);
	int middle = l->height - bar - bottom;
	l->bar = (struct rect){0, 0, l->width, bar};
	l->left = (struct rect){0, bar, split, middle};
	l->right = (struct rect){split, bar, l->width - split, middle};
	l->bottom = (struct rect){0, l->height - bottom, l->width, bottom};
	l->hint = box(l, bar, 1080, 18, 660, 76);
}

static void make_bar(struct layout *l)
{
	for (int i = 0; i < STEP_COUNT; i++)
		l->target[TARGET_STEP_DRAW + i] = box(l, 0, 300 + 210 * i, 12, 196, 60);
	l->target[TARGET_UNDO] = box(l, 0, 1400, 12, 138, 60);
	l->target[TARGET_REDO] = box(l, 0, 1550, 12, 138, 60);
	l->target[TARGET_LANGUAGE] = box(l, 0, 1716, 12, 84, 60);
	l->target[TARGET_HAND] = box(l, 0, 1812, 12, 84, 60);
}

static void make_panes_tools(struct layout *l)
{
	for (int i = 0; i < 3; i++)
		l->target[TARGET_VIEW_FRONT + i] = box(l, l->left.y, 34, 30 + 84 * i, 92, 68);
	if (l->step == STEP_DRAW)
		for (int i = 0; i <= TARGET_SWATCH_7 - TARGET_SWATCH_0; i++)
			l->target[TARGET_SWATCH_0 + i] = box(l, l->right.y, 1840, 28 + 70 * i, 58,
							     58);
}

/* What works on the sheet, in a column at its inner side; how near it is seen, below. */
static void make_sheet_tools(struct layout *l)
{
	int tools = l->step == STEP_DRAW ? 5 : 0;
	for (int i = 0; i < tools; i++)
		l->target[TARGET_TOOL_PENCIL + i] = box(l, l->right.y, 1056, 110 + 104 * i, 92, 96);
	if (l->step == STEP_SEW)
		l->target[TARGET_EVEN] = box(l, l->right.y, 1056, 110, 92, 96);
	for (int i = 0; i < 2 && l->step <= STEP_MARK; i++)
		l->target[TARGET_ZOOM_OUT + i] = box(l, l->right.y, 1768 + 70 * i, 774, 62, 62);
}

static void make_bottom(struct layout *l)
{
	int top = l->bottom.y;
	for (int i = 0; i < 3; i++)
		l->target[TARGET_WRAP + i] = box(l, top, 528 + 366 * i, 12, 350, 124);
	l->target[TARGET_CLEAR] = box(l, top, 1614, 24, 96, 100);
	l->target[TARGET_FINISH] = box(l, top, 1720, 20, 176, 108);
	switch (l->step) {
	case STEP_DRAW:
		for (int i = 0; i < 4; i++)
			l->target[TARGET_COPY + i] = box(l, top, 34 + 112 * i, 24, 102, 100);
		break;
	case STEP_SEW:
		l->target[TARGET_SWAP] = box(l, top, 34, 24, 204, 100);
		l->target[TARGET_DELETE] = box(l, top, 254, 24, 204, 100);
		break;
	case STEP_MARK:
		l->target[TARGET_LASER] = box(l, top, 34, 24, 204, 100);
		l->target[TARGET_ERASE] = box(l, top, 254, 24, 204, 100);
		break;
	case STEP_DRESS:
	case STEP_ADJUST:
		l->meter = box(l, top, 34, 24, 424, 100);
		break;
	case STEP_COUNT:
		break;
	}
}

/* The twins stay: they lie in the order of the real buttons, which do not move either. */
static void change_sides(struct layout *l)
{
	for (int i = 0; i < 3; i++)
		mirror_within(&l->target[TARGET_VIEW_FRONT + i], l->left);
	for (int i = TARGET_SWATCH_0; i <= TARGET_SWATCH_7; i++)
		mirror_within(&l->target[i], l->right);
	for (int i = TARGET_TOOL_PENCIL; i <= TARGET_ZOOM_IN; i++)
		mirror_within(&l->target[i], l->right);
	mirror_within(&l->hint, l->right);
}

void layout_make(struct layout *layout, int width, int height, enum step step, bool left_handed)
{
	MUST(width >= 320 && width <= 16384 && height >= 180 && height <= 16384);
	MUST(step < STEP_COUNT);
	memset(layout, 0, sizeof *layout);
	layout->width = width;
	layout->height = height;
	layout->step = step;
	layout->left_handed = left_handed;
	layout->mm_per_px = (float)SCREEN_WIDTH_MM / (float)width;
	make_panes(layout);
	make_bar(layout);
	make_panes_tools(layout);
	make_sheet_tools(layout);
	make_bottom(layout);
	if (left_handed)
		change_sides(layout);
}

enum target layout_hit(const struct layout *layout, struct v2 position_px)
{
	for (int i = TARGET_NONE + 1; i < TARGET_COUNT; i++)
		if (layout->target[i].w > 0 && rect_holds(layout->target[i], position_px))
			return (enum target)i;
	return TARGET_NONE;
}
