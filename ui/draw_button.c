/* How each button, the hint and the meter look; the look's drawing is at 1920 x 1080. */
#include "draw_button.h"

#include <stdio.h>

static struct rect inner(struct rect rect, int left, int right)
{
	return (struct rect){rect.x + left, rect.y, rect.w - left - right, rect.h};
}

static void fill_box(const struct brush *brush, struct rect rect, double radius, uint32_t colour,
		     double alpha)
{
	round_rect(brush->cr, rect, radius * brush->unit);
	ink(brush->cr, colour, alpha);
	cairo_fill(brush->cr);
}

static void draw_step(const struct brush *brush, struct rect rect, const struct face *face,
		      enum target target)
{
	double u = brush->unit, x = rect.x + 32.0 * u, y = rect.y + 0.5 * rect.h;
	uint32_t pill = face->on ? 0xf6f2ea : LOOK_NIGHT_RAISED;
	char number[4];
	if (!face->on && (face->hover || face->pressed))
		pill = colour_mix(pill, 0xffffff, face->pressed ? 0.2 : 0.1);
	fill_box(brush, rect, 30.0, pill, 1.0);
	disc(brush->cr, x, y, 19.0 * u);
	ink(brush->cr, face->on ? LOOK_WRAP : 0x5b7188, 1.0);
	cairo_fill(brush->cr);
	snprintf(number, sizeof number, "%d", (int)target - TARGET_STEP_DRAW + 1);
	struct style style = {24.0 * u, true, 0xffffff, ALIGN_CENTRE, 0.0};
	draw_text(brush->cr, brush->type, number, x, y + 8.6 * u, &style);
	struct label label = {25.0 * u, 18.0 * u, face->on ? LOOK_NIGHT : 0xdce4eb,
			      face->on ? LOOK_INK_GREY : 0xaebdcb, ALIGN_LEFT};
	draw_phrase(brush->cr, brush->type, &text_target[target], brush->language,
		    inner(rect, (int)(62.0 * u), (int)(16.0 * u)), &label);
}

static void draw_history(const struct brush *brush, struct rect rect, const struct face *face,
			 enum target target)
{
	double u = brush->unit, lift = face->pressed ? 0.22 : face->hover ? 0.1 : 0.0;
	uint32_t back = colour_mix(face->useful ? LOOK_NIGHT_RAISED : 0x263749, 0xffffff,
				   face->useful ? lift : 0.0);
	uint32_t text = face->useful ? 0xf6f2ea : 0x6f8091;
	fill_box(brush, rect, 14.0, back, 1.0);
	struct label label = {22.0 * u, 16.5 * u, text, face->useful ? 0xaebdcb : 0x5d6e7f,
			      ALIGN_CENTRE};
	draw_phrase(brush->cr, brush->type, &text_target[target], brush->language,
		    inner(rect, (int)(8.0 * u), (int)(8.0 * u)), &label);
}

static void draw_language(const struct brush *brush, struct rect rect, const struct face *face)
{
	static const char *const shown[] = {"日|EN", "日本語", "EN"};
	double u = brush->unit;
	fill_box(brush, rect, 14.0,
		 colour_mix(LOOK_NIGHT_RAISED, 0xffffff, face->hover || face->pressed ? 0.14 : 0.0),
		 1.0);
	struct style style = {23.0 * u, false, 0xf6f2ea, ALIGN_CENTRE, rect.w - 14.0 * u};
	draw_text(brush->cr, brush->type, shown[brush->language], rect.x + 0.5 * rect.w,
		  rect.y + 0.5 * rect.h + 8.5 * u, &style);
}

/* A right hand's thumb is on its left, seen from the back, and the other way round. */
static void draw_hand(const struct brush *brush, struct rect rect, const struct face *face)
{
	cairo_t *cr = brush->cr;
	fill_box(brush, rect, 14.0,
		 colour_mix(LOOK_NIGHT_RAISED, 0xffffff, face->hover || face->pressed ? 0.14 : 0.0),
		 1.0);
	ink(cr, 0xf6f2ea, 1.0);
	cairo_save(cr);
	cairo_translate(cr, rect.x + 0.5 * rect.w, rect.y + 0.5 * rect.h);
	cairo_scale(cr, face->on ? -1.0 : 1.0, 1.0);
	draw_icon(cr, ICON_HAND, 0.0, 0.0, 34.0 * brush->unit);
	cairo_restore(cr);
}

static void draw_view_button(const struct brush *brush, struct rect rect, const struct face *face,
			     enum target target)
{
	double u = brush->unit;
	uint32_t back = face->on ? LOOK_INK : 0xffffff;
	fill_box(brush, rect, 16.0, colour_mix(back, LOOK_BAR, face->pressed ? 0.3 : 0.0),
		 face->on || face->hover ? 1.0 : 0.85);
	struct label label = {24.0 * u, 18.0 * u, face->on ? 0xffffff : LOOK_INK,
			      face->on ? 0xdddddd : LOOK_INK_GREY, ALIGN_CENTRE};
	draw_phrase(brush->cr, brush->type, &text_target[target], brush->language,
		    inner(rect, (int)(6.0 * u), (int)(6.0 * u)), &label);
}

static void draw_swatch(const struct brush *brush, struct rect rect, const struct face *face,
			enum target target)
{
	cairo_t *cr = brush->cr;
	double u = brush->unit, inset = (face->on ? 7.0 : 4.0) * u;
	double x = rect.x + inset, y = rect.y + inset;
	double w = rect.w - 2.0 * inset, h = rect.h - 2.0 * inset;
	int index = (int)target - TARGET_SWATCH_0;
	if (face->on || face->hover) {
		fill_box(brush, rect, 15.0, face->on ? LOOK_INK : LOOK_ROOM_DARK, 1.0);
		round_box(cr, rect.x + 4.5 * u, rect.y + 4.5 * u, rect.w - 9.0 * u,
			  rect.h - 9.0 * u, 11.5 * u);
		ink(cr, LOOK_PAPER, 1.0);
		cairo_fill(cr);
	}
	cairo_save(cr);
	round_box(cr, x, y, w, h, 10.0 * u);
	cairo_clip(cr);
	ink(cr, look_outside[index], 1.0);
	cairo_paint(cr);
	/* The corner turned over: the cloth's own reverse. */
	cairo_move_to(cr, x + w, y + 0.5 * h);
	cairo_line_to(cr, x + w, y + h);
	cairo_line_to(cr, x + 0.5 * w, y + h);
	ink(cr, look_inside[index], 1.0);
	cairo_fill(cr);
	cairo_restore(cr);
	round_box(cr, x + 0.5 * u, y + 0.5 * u, w - u, h - u, 10.0 * u);
	cairo_set_line_width(cr, 1.5 * u);
	ink(cr, LOOK_INK, 0.28);
	cairo_stroke(cr);
}

/* The tools at the bottom left: pictogram over words when narrow, beside them when wide. */
static void draw_tool(const struct brush *brush, struct rect rect, const struct face *face,
		      enum target target)
{
	static const enum icon icon[TARGET_COUNT] = {
		[TARGET_COPY] = ICON_COPY,        [TARGET_TURN_OVER] = ICON_TURN_OVER,
		[TARGET_MIRROR] = ICON_MIRROR,    [TARGET_DELETE] = ICON_BIN,
		[TARGET_SWAP] = ICON_SWAP,        [TARGET_LASER] = ICON_LASER,
		[TARGET_ERASE] = ICON_ERASER,     [TARGET_TOOL_PENCIL] = ICON_PENCIL,
		[TARGET_FOLD] = ICON_FOLD,        [TARGET_TOOL_POINTS] = ICON_POINTS,
		[TARGET_EVEN] = ICON_EVEN,        [TARGET_TOOL_BOX] = ICON_BOX,
		[TARGET_TOOL_ROUND] = ICON_ROUND,
	};
	cairo_t *cr = brush->cr;
	double u = brush->unit, alpha = face->useful ? 1.0 : 0.36;
	uint32_t back = face->on ? LOOK_INK : 0xffffff;
	uint32_t front = face->on ? 0xffffff : LOOK_INK;
	bool wide = rect.w > 3 * rect.h / 2;
	fill_box(brush, rect, 18.0,
		 colour_mix(back, LOOK_INK_GREY, face->pressed && face->useful ? 0.18 : 0.0),
		 face->useful || face->on ? 1.0 : 0.5);
	if (face->hover && face->useful) {
		round_box(cr, rect.x + u, rect.y + u, rect.w - 2.0 * u, rect.h - 2.0 * u, 17.0 * u);
		cairo_set_line_width(cr, 2.0 * u);
		ink(cr, LOOK_HINT_RIM, 1.0);
		cairo_stroke(cr);
	}
	cairo_push_group(cr);
	ink(cr, target == TARGET_LASER && !face->on ? 0x0072b2 : front, 1.0);
	struct label label = {wide ? 25.0 * u : 19.0 * u, wide ? 18.0 * u : 15.0 * u, front,
			      face->on ? 0xdddddd : LOOK_INK_GREY,
			      wide ? ALIGN_LEFT : ALIGN_CENTRE};
	if (wide) {
		draw_icon(cr, icon[target], rect.x + 42.0 * u, rect.y + 0.5 * rect.h, 44.0 * u);
		draw_phrase(cr, brush->type, &text_target[target], brush->language,
			    inner(rect, (int)(76.0 * u), (int)(14.0 * u)), &label);
	} else {
		struct rect words = {rect.x + (int)(5.0 * u), rect.y + (int)(46.0 * u),
				     rect.w - (int)(10.0 * u), rect.h - (int)(48.0 * u)};
		draw_icon(cr, icon[target], rect.x + 0.5 * rect.w, rect.y + 28.0 * u, 31.0 * u);
		draw_phrase(cr, brush->type, &text_target[target], brush->language, words, &label);
	}
	cairo_pop_group_to_source(cr);
	cairo_paint_with_alpha(cr, alpha);
}

static void draw_zoom(const struct brush *brush, struct rect rect, const struct face *face,
		      enum target target)
{
	double u = brush->unit;
	fill_box(brush, rect, 16.0, colour_mix(0xffffff, LOOK_INK_GREY, face->pressed ? 0.18 : 0.0),
		 face->useful ? 0.95 : 0.5);
	ink(brush->cr, LOOK_INK, face->useful ? 1.0 : 0.36);
	draw_icon(brush->cr, target == TARGET_ZOOM_IN ? ICON_PLUS : ICON_MINUS,
		  rect.x + 0.5 * rect.w, rect.y + 0.5 * rect.h, 34.0 * u);
}

/* A twin of a real button: its cap's colour, bright when pressing it would do something now. */
static void draw_twin(const struct brush *brush, struct rect rect, const struct face *face,
		      enum target target)
{
	static const uint32_t cap[] = {LOOK_WRAP, LOOK_PIN, LOOK_RELAX};
	static const enum icon icon[] = {ICON_SHIRT, ICON_PIN, ICON_WAVES};
	cairo_t *cr = brush->cr;
	int which = (int)target - TARGET_WRAP;
	double u = brush->unit, x = rect.x + 62.0 * u, y = rect.y + 0.5 * rect.h;
	double pulse = (double)face->pulse / PULSE_FRAMES;
	uint32_t colour = face->useful ? cap[which] : colour_mix(cap[which], LOOK_BAR, 0.62);
	if (face->pulse > 0) { /* a ring that widens and fades, once */
		disc(cr, x, y, (62.0 - 8.0 * pulse) * u);
		ink(cr, cap[which], 0.55 * pulse);
		cairo_fill(cr);
	}
	disc(cr, x, y, 54.0 * u);
	ink(cr, 0xffffff, 1.0);
	cairo_fill_preserve(cr);
	cairo_set_line_width(cr, face->on ? 6.0 * u : 3.0 * u);
	ink(cr, face->on ? LOOK_INK : LOOK_ROOM_DARK, 1.0);
	cairo_stroke(cr);
	disc(cr, x, y, (face->pressed || face->on ? 42.0 : 45.0) * u);
	ink(cr, colour_mix(colour, 0x000000, face->pressed ? 0.14 : 0.0), 1.0);
	cairo_fill(cr);
	if (face->hover && face->useful) {
		disc(cr, x, y, 49.5 * u);
		cairo_set_line_width(cr, 3.0 * u);
		ink(cr, LOOK_HINT_RIM, 1.0);
		cairo_stroke(cr);
	}
	ink(cr, 0xffffff, 1.0);
	draw_icon(cr, icon[which], x, y, 50.0 * u);
	struct label label = {36.0 * u, 24.0 * u, face->useful ? LOOK_INK : 0x8a8478,
			      face->useful ? LOOK_INK_GREY : 0x9a9488, ALIGN_LEFT};
	draw_phrase(cr, brush->type, &text_target[target], brush->language,
		    inner(rect, (int)(134.0 * u), (int)(4.0 * u)), &label);
}

static void draw_clear(const struct brush *brush, struct rect rect, const struct face *face)
{
	cairo_t *cr = brush->cr;
	double u = brush->unit, alpha = face->useful ? 1.0 : 0.36;
	fill_box(brush, rect, 18.0, 0xffffff, face->useful ? 1.0 : 0.5);
	cairo_save(cr);
	round_rect(cr, rect, 18.0 * u);
	cairo_clip(cr);
	cairo_rectangle(cr, rect.x, rect.y, 0.01 * face->progress * rect.w, rect.h);
	ink(cr, LOOK_HINT_RIM, 1.0);
	cairo_fill(cr);
	cairo_restore(cr);
	cairo_push_group(cr);
	ink(cr, LOOK_INK, 1.0);
	draw_icon(cr, ICON_AGAIN, rect.x + 0.5 * rect.w, rect.y + 28.0 * u, 30.0 * u);
	struct rect words = {rect.x + (int)(5.0 * u), rect.y + (int)(46.0 * u),
			     rect.w - (int)(10.0 * u), rect.h - (int)(48.0 * u)};
	struct label label = {17.0 * u, 14.0 * u, LOOK_INK, LOOK_INK_GREY, ALIGN_CENTRE};
	draw_phrase(cr, brush->type, &text_target[TARGET_CLEAR], brush->language, words, &label);
	cairo_pop_group_to_source(cr);
	cairo_paint_with_alpha(cr, alpha);
}

/* The way home: dark, so that it is no fourth twin. */
static void draw_finish(const struct brush *brush, struct rect rect, const struct face *face)
{
	double u = brush->unit;
	uint32_t ground = colour_mix(LOOK_NIGHT, 0x000000, face->pressed ? 0.3 : 0.0);
	fill_box(brush, rect, 18.0, face->useful ? ground : colour_mix(LOOK_NIGHT, LOOK_BAR, 0.62),
		 1.0);
	struct label label = {27.0 * u, 20.0 * u, 0xffffff, face->useful ? 0xb8c4cf : 0xffffff,
			      ALIGN_CENTRE};
	draw_phrase(brush->cr, brush->type, &text_target[TARGET_FINISH], brush->language,
		    inner(rect, (int)(12.0 * u), (int)(12.0 * u)), &label);
	if (!face->hover || !face->useful)
		return;
	round_rect(brush->cr, rect, 18.0 * u);
	cairo_set_line_width(brush->cr, 4.0 * u);
	ink(brush->cr, LOOK_HINT_RIM, 1.0);
	cairo_stroke(brush->cr);
}

static void draw_hint(const struct brush *brush, struct rect rect, const struct face *face)
{
	cairo_t *cr = brush->cr;
	double u = brush->unit;
	uint32_t rim = face->notice ? LOOK_WRAP : LOOK_HINT_RIM;
	round_box(cr, rect.x + 1.5 * u, rect.y + 1.5 * u, rect.w - 3.0 * u, rect.h - 3.0 * u,
		  20.0 * u);
	ink(cr, LOOK_HINT, 0.97);
	cairo_fill_preserve(cr);
	cairo_set_line_width(cr, face->notice ? 3.5 * u : 2.5 * u);
	ink(cr, rim, 1.0);
	cairo_stroke(cr);
	struct label label = {25.0 * u, 20.0 * u, LOOK_INK, LOOK_INK_GREY, ALIGN_LEFT};
	int numbers = 0;
	for (int k = 1; k >= 0; k--) /* the marks that it is about, at the right */
		if (face->mark[k] > 0)
			draw_number(cr, brush->type, face->mark[k],
				    rect.x + rect.w - (36.0 + 46.0 * numbers++) * u,
				    rect.y + 0.5 * rect.h, 17.0 * u, true);
	draw_phrase(cr, brush->type, &text_phrase[face->text], brush->language,
		    inner(rect, (int)(28.0 * u), (int)((24.0 + 46.0 * numbers) * u)), &label);
}

/* How far the cloth is stretched: calm green, then amber, then the colour of a warning. */
static void draw_meter(const struct brush *brush, struct rect rect, const struct face *face)
{
	cairo_t *cr = brush->cr;
	double u = brush->unit, share = 0.01 * face->progress;
	double x = rect.x, y = rect.y + 66.0 * u, w = rect.w, h = 18.0 * u;
	uint32_t colour = share < 0.5 ? colour_mix(LOOK_RELAX, LOOK_HINT_RIM, 2.0 * share)
				      : colour_mix(LOOK_HINT_RIM, LOOK_WRAP, 2.0 * share - 1.0);
	struct rect words = {rect.x, rect.y, rect.w, (int)(60.0 * u)};
	struct label label = {22.0 * u, 17.0 * u, face->useful ? LOOK_INK : 0x8a8478,
			      face->useful ? LOOK_INK_GREY : 0x9a9488, ALIGN_LEFT};
	draw_phrase(cr, brush->type, &text_phrase[TEXT_STRAIN], brush->language, words, &label);
	round_box(cr, x, y, w, h, 0.5 * h);
	ink(cr, 0xffffff, face->useful ? 1.0 : 0.5);
	cairo_fill(cr);
	if (!face->useful)
		return;
	round_box(cr, x, y, h + (w - h) * share, h, 0.5 * h);
	ink(cr, colour, 1.0);
	cairo_fill(cr);
}

static void draw_title(const struct brush *brush)
{
	double u = brush->unit;
	struct style japanese = {38.0 * u, true, 0xf6f2ea, ALIGN_LEFT, 130.0 * u};
	struct style english = {24.0 * u, false, 0xb8c4cf, ALIGN_LEFT, 100.0 * u};
	draw_text(brush->cr, brush->type, text_phrase[TEXT_TITLE].japanese, 34.0 * u, 55.0 * u,
		  &japanese);
	draw_text(brush->cr, brush->type, text_phrase[TEXT_TITLE].english, 164.0 * u, 54.0 * u,
		  &english);
}

void draw_button(const struct brush *brush, struct rect rect, const struct face *face, int item)
{
	enum target target = (enum target)item;
	if (item == ITEM_TITLE)
		draw_title(brush);
	else if (item == ITEM_HINT)
		draw_hint(brush, rect, face);
	else if (item == ITEM_METER)
		draw_meter(brush, rect, face);
	else if (target <= TARGET_STEP_ADJUST)
		draw_step(brush, rect, face, target);
	else if (target <= TARGET_REDO)
		draw_history(brush, rect, face, target);
	else if (target == TARGET_LANGUAGE)
		draw_language(brush, rect, face);
	else if (target == TARGET_HAND)
		draw_hand(brush, rect, face);
	else if (target == TARGET_FINISH)
		draw_finish(brush, rect, face);
	else if (target == TARGET_CLEAR)
		draw_clear(brush, rect, face);
	else if (target <= TARGET_VIEW_BACK)
		draw_view_button(brush, rect, face, target);
	else if (target <= TARGET_ERASE)
		draw_tool(brush, rect, face, target);
	else if (target >= TARGET_ZOOM_OUT)
		draw_zoom(brush, rect, face, target);
	else if (target >= TARGET_TOOL_PENCIL)
		draw_tool(brush, rect, face, target);
	else if (target <= TARGET_RELAX)
		draw_twin(brush, rect, face, target);
	else
		draw_swatch(brush, rect, face, target);
}
