/* Bars, buttons, hint, swatches: one picture as large as the screen, of which only the items that
 * look different from the last frame are drawn again. */
#include "draw_button.h"
#include "draw_painted.h"

#include <stdio.h>
#include <stdlib.h>

enum { CLEAR_FRAMES = FRAME_RATE_HZ };

struct chrome {
	struct painted painted;
	double unit;                /* pixels for a pixel at 1080 lines */
	uint64_t whole;             /* what the layout looked like; 0: nothing drawn yet */
	uint64_t drawn[ITEM_COUNT]; /* what each item looked like */
};

static bool looks_from(const struct view *view, enum target target)
{
	float s = angle_sin(0.5f * PI_F * (float)(target - TARGET_VIEW_FRONT));
	float c = angle_cos(0.5f * PI_F * (float)(target - TARGET_VIEW_FRONT));
	const struct m3 *turn = &view->turn;
	return turn->row[2].x * s + turn->row[2].z * c > 0.97f && turn->row[1].y > 0.97f;
}

static bool is_on(const struct ui *ui, const struct session *session, enum target target)
{
	if (target >= TARGET_STEP_DRAW && target <= TARGET_STEP_ADJUST)
		return (int)ui->step == (int)target - TARGET_STEP_DRAW;
	if (target >= TARGET_VIEW_FRONT && target <= TARGET_VIEW_BACK)
		return looks_from(&ui->view, target);
	if (target >= TARGET_SWATCH_0 && target <= TARGET_SWATCH_7)
		return ui->swatch == (int)target - TARGET_SWATCH_0;
	if (target >= TARGET_TOOL_PENCIL && target <= TARGET_TOOL_ROUND)
		return (int)ui->drawing == (int)target - TARGET_TOOL_PENCIL;
	const struct pattern *pattern = &session->document.pattern;
	switch (target) {
	case TARGET_FOLD:
		return ui->piece >= 0 && pattern->piece[ui->piece].used &&
		       pattern->piece[ui->piece].symmetric;
	case TARGET_EVEN:
		return ui->seam >= 0 && pattern->seam[ui->seam].used &&
		       pattern->seam[ui->seam].even;
	case TARGET_LASER:
		return ui->laser;
	case TARGET_ERASE:
		return ui->erase;
	case TARGET_PIN:
		return ui->pin_mode;
	case TARGET_RELAX:
		return ui->relax_held;
	case TARGET_HAND:
		return ui->left_handed;
	default:
		return false;
	}
}

static struct face face_of(const struct ui *ui, const struct session *session, int item)
{
	struct face face;
	memset(&face, 0, sizeof face);
	if (item < TARGET_COUNT) {
		enum target target = (enum target)item;
		int since = ui->frame - ui->pulse[target];
		face.useful = ui_useful(ui, session, target);
		face.hover = ui->hover_target == target;
		face.pressed = ui->gesture == GESTURE_TARGET && ui->pressed == target;
		face.on = is_on(ui, session, target);
		face.pulse = ui->pulse[target] && since < PULSE_FRAMES ? PULSE_FRAMES - since : 0;
		face.progress = face.pressed ? int_min(ui->hold_frames * 100 / CLEAR_FRAMES, 100)
					     : 0;
	} else if (item == ITEM_HINT) {
		face.notice = ui->notice != TEXT_NONE;
		face.text = face.notice ? (enum text)ui->notice : text_hint(ui, session, face.mark);
	} else if (item == ITEM_METER) {
		face.useful = session->cloth.worn;
		face.progress = (int)(100.0f * float_clamp(session->strain_left, 0.0f, 1.0f));
	}
	return face;
}

static uint64_t face_hash(const struct face *face)
{
	struct hash hash;
	hash_init(&hash);
	hash_int(&hash, face->useful | face->hover << 1 | face->pressed << 2 | face->on << 3 |
				face->notice << 4);
	hash_int(&hash, face->pulse);
	hash_int(&hash, face->progress);
	hash_int(&hash, (int)face->text);
	hash_int(&hash, face->mark[0] * 128 + face->mark[1]);
	return hash.value;
}

/* ---- the layer ---- */

static struct rect item_rect(const struct layout *layout, int item)
{
	if (item < TARGET_COUNT)
		return layout->target[item];
	if (item == ITEM_HINT)
		return layout->hint;
	if (item == ITEM_METER)
		return layout->meter;
	struct rect first = layout->target[TARGET_STEP_DRAW];
	return (struct rect){0, 0, int_max(first.x - layout_px(layout, 8), 0), layout->bar.h};
}

/* The bar's colour where a bar is, nothing where a pane is. */
static void draw_ground(const struct chrome *chrome, const struct layout *layout)
{
	cairo_t *cr = chrome->painted.cr;
	painted_clear(&chrome->painted);
	cairo_rectangle(cr, layout->bar.x, layout->bar.y, layout->bar.w, layout->bar.h);
	ink(cr, LOOK_NIGHT, 1.0);
	cairo_fill(cr);
	cairo_rectangle(cr, layout->bottom.x, layout->bottom.y, layout->bottom.w, layout->bottom.h);
	ink(cr, LOOK_BAR, 1.0);
	cairo_fill(cr);
	int line = int_max(layout_px(layout, 2), 1);
	cairo_rectangle(cr, layout->bottom.x, layout->bottom.y, layout->bottom.w, line);
	ink(cr, LOOK_ROOM_DARK, 1.0);
	cairo_fill(cr);
}

static void draw_item(const struct chrome *chrome, const struct ui *ui, int item,
		      const struct face *face)
{
	cairo_t *cr = chrome->painted.cr;
	struct brush brush = {cr, chrome->painted.type, ui->language, chrome->unit};
	struct rect rect = item_rect(&ui->layout, item);
	cairo_save(cr);
	cairo_rectangle(cr, rect.x, rect.y, rect.w, rect.h);
	cairo_clip(cr);
	draw_ground(chrome, &ui->layout);
	draw_button(&brush, rect, face, item);
	cairo_restore(cr);
}

static void add_damage(struct layer *layer, struct rect rect)
{
	if (rect.w <= 0 || rect.h <= 0)
		return;
	if (layer->damage_count == LAYER_DAMAGE_MAX)
		layer->damage[LAYER_DAMAGE_MAX - 1] = rect_join(layer->damage[LAYER_DAMAGE_MAX - 1],
								rect);
	else
		layer->damage[layer->damage_count++] = rect;
}

static void add_patch(struct layer *layer, struct rect rect, bool opaque)
{
	if (rect.w > 0)
		layer->patch[layer->patch_count++] = (struct patch){rect, opaque};
}

static void make_patches(struct layer *layer, const struct layout *layout)
{
	struct rect views = {0, 0, 0, 0}, swatches = views, tools = views, zooms = views;
	for (int i = TARGET_VIEW_FRONT; i <= TARGET_VIEW_BACK; i++)
		views = rect_join(views, layout->target[i]);
	for (int i = TARGET_SWATCH_0; i <= TARGET_SWATCH_7; i++)
		swatches = rect_join(swatches, layout->target[i]);
	for (int i = TARGET_TOOL_PENCIL; i <= TARGET_EVEN; i++)
		tools = rect_join(tools, layout->target[i]);
	for (int i = TARGET_ZOOM_OUT; i <= TARGET_ZOOM_IN; i++)
		zooms = rect_join(zooms, layout->target[i]);
	layer->patch_count = 0;
	add_patch(layer, layout->bar, true);
	add_patch(layer, layout->bottom, true);
	add_patch(layer, views, false);
	add_patch(layer, layout->hint, false);
	add_patch(layer, swatches, false);
	add_patch(layer, tools, false);
	add_patch(layer, zooms, false);
}

static uint64_t layout_hash(const struct ui *ui)
{
	struct hash hash;
	hash_init(&hash);
	hash_int(&hash, (int)ui->step);
	hash_int(&hash, (int)ui->language);
	hash_int(&hash, ui->left_handed);
	return hash.value;
}

const struct layer *chrome_update(struct chrome *chrome, const struct ui *ui,
				  const struct session *session)
{
	struct layer *layer = &chrome->painted.layer;
	uint64_t whole = layout_hash(ui);
	bool all = whole != chrome->whole;
	layer->damage_count = 0;
	if (all) {
		draw_ground(chrome, &ui->layout);
		make_patches(layer, &ui->layout);
		for (int i = 0; i < layer->patch_count; i++)
			add_damage(layer, layer->patch[i].area);
	}
	chrome->whole = whole;
	for (int item = TARGET_NONE + 1; item < ITEM_COUNT; item++) {
		struct rect rect = item_rect(&ui->layout, item);
		struct face face = face_of(ui, session, item);
		uint64_t hash = face_hash(&face);
		if (rect.w == 0 || (!all && hash == chrome->drawn[item]))
			continue;
		draw_item(chrome, ui, item, &face);
		chrome->drawn[item] = hash;
		if (!all)
			add_damage(layer, rect);
	}
	cairo_surface_flush(chrome->painted.surface);
	return layer;
}

struct chrome *chrome_open(int width, int height, char fault[200])
{
	struct chrome *chrome = calloc(1, sizeof *chrome);
	struct layout layout;
	if (!chrome) {
		snprintf(fault, 200, "no memory for the bars");
		return NULL;
	}
	layout_make(&layout, width, height, STEP_DRAW, false);
	chrome->unit = (double)layout_px(&layout, 1000) / 1000.0;
	if (!painted_open(&chrome->painted, (struct rect){0, 0, width, height}, false, fault)) {
		free(chrome);
		return NULL;
	}
	return chrome;
}

void chrome_close(struct chrome *chrome)
{
	if (!chrome)
		return;
	painted_close(&chrome->painted);
	free(chrome);
}
