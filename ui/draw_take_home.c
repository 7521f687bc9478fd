/* The page with the finished card: the card itself, its code large enough for a phone, where it was
 * kept, and the way back. */
#include "draw_take_home.h"

#include "draw_card.h"
#include "draw_painted.h"
#include "draw_qr.h"

#include <stdio.h>
#include <stdlib.h>

struct take_home_sheet {
	struct painted painted;
	double unit;
	bool blank, shown; /* nothing is painted yet; it is on the screen, but for what changes */
	int pressed;
	enum language language;
	struct take_home_page seen; /* as drawn */
};

struct easel_home {
	cairo_t *cr;
	struct type *type;
	enum language language;
	double u;
	const struct take_home_page *page;
	const struct layout *layout;
	struct take_home_layout at;
};

static const struct phrase title = {"できあがり！", "Finished!"};
static const struct phrase making = {"カードを作っています…", "Making your card..."};
static const struct phrase no_card = {"カードを作れませんでした", "The card could not be made"};
static const struct phrase scan = {"スマホで読みとると、型紙がもらえます",
				   "Scan it with a phone: the pattern is in the code"};
static const struct phrase too_large = {"型紙が大きくて、QRには入りません",
					"The pattern is too large for a code: the files have it"};
static const struct phrase key_name[TAKE_HOME_KEYS] = {
	{"つづきで遊ぶ", "Back to playing"},
	{"おわる", "Done: next visitor"},
};

static const struct phrase station_words[KEPT_COUNT] = {
	[KEPT_NOT] = {"", ""},
	[KEPT_WRITING] = {"保存しています…", "Saving..."},
	[KEPT] = {"この台に保存しました", "Saved on this station"},
	[KEPT_FULL] = {"この台に空きがありません。係の人へ",
		       "This station is full: tell the staff"},
	[KEPT_READ_ONLY] = {"この台に保存できません。係の人へ",
			    "This station can't save: tell the staff"},
	[KEPT_PULLED] = {"この台に保存できません。係の人へ",
			 "This station can't save: tell the staff"},
	[KEPT_FAILED] = {"この台に保存できません。係の人へ",
			 "This station can't save: tell the staff"},
};

static const struct phrase stick_words[KEPT_COUNT] = {
	[KEPT_NOT] = {"USBメモリをさすと、持って帰れます",
		      "Plug in a USB stick to take it with you"},
	[KEPT_WRITING] = {"USBメモリに書いています。抜かないで",
			  "Writing to your USB stick: leave it in"},
	[KEPT] = {"USBメモリに保存しました。抜いてください", "Saved: take your USB stick with you"},
	[KEPT_FULL] = {"USBメモリに空きがありません。別のものを",
		       "Your USB stick is full: try another one"},
	[KEPT_READ_ONLY] = {"書きこめないUSBメモリです。別のものを",
			    "Your USB stick is read-only: try another one"},
	[KEPT_PULLED] = {"途中で抜けました。もう一度さしてください",
			 "The stick came out: plug it in again"},
	[KEPT_FAILED] = {"USBメモリに書けません。別のものを",
			 "Your USB stick can't be written: try another"},
};

static void say(const struct easel_home *e, const struct phrase *phrase, struct rect rect,
		double size, uint32_t colour, uint32_t second, enum align align)
{
	struct label label = {size * e->u, 0.76 * size * e->u, colour, second, align};
	draw_phrase(e->cr, e->type, phrase, e->language, rect, &label);
}

static void draw_ground(const struct easel_home *e)
{
	cairo_t *cr = e->cr;
	const struct layout *l = e->layout;
	ink(cr, colour_mix(LOOK_ROOM_LIGHT, LOOK_ROOM_DARK, 0.32), 1.0);
	cairo_paint(cr);
	cairo_rectangle(cr, l->bar.x, l->bar.y, l->bar.w, l->bar.h);
	ink(cr, LOOK_NIGHT, 1.0);
	cairo_fill(cr);
	cairo_rectangle(cr, l->bottom.x, l->bottom.y, l->bottom.w, l->bottom.h);
	ink(cr, LOOK_BAR, 1.0);
	cairo_fill(cr);
	struct rect words = {(int)(40.0 * e->u), l->bar.y, l->width / 2, l->bar.h};
	say(e, &title, words, 32.0, 0xf6f2ea, 0xb8c4cf, ALIGN_LEFT);
}

/* Strips of whole pixels beside and below the rectangle: nothing that a frame would feel. */
static void draw_shadow(const struct easel_home *e, struct rect r)
{
	for (int i = 6; i > 0; i--) {
		int side = (int)(0.7 * i * e->u + 0.5), below = (int)((1.8 * i + 2.0) * e->u + 0.5);
		int down = (int)(5.0 * e->u);
		cairo_rectangle(e->cr, r.x - side, r.y + down, side, r.h - down);
		cairo_rectangle(e->cr, r.x + r.w, r.y + down, side, r.h - down);
		cairo_rectangle(e->cr, r.x - side, r.y + r.h, r.w + 2 * side, below);
		ink(e->cr, 0x3d301f, 0.035);
		cairo_fill(e->cr);
	}
}

static void draw_card(const struct easel_home *e)
{
	struct rect r = e->at.card;
	r.h = card_height(r.w);
	draw_shadow(e, r);
	if (!e->page->card) {
		cairo_rectangle(e->cr, r.x, r.y, r.w, r.h);
		ink(e->cr, LOOK_PAPER, 1.0);
		cairo_fill(e->cr);
		say(e, e->page->failed ? &no_card : &making, r, 44.0, LOOK_INK, LOOK_INK_GREY,
		    ALIGN_CENTRE);
		return;
	}
	cairo_surface_t *surface = cairo_image_surface_create_for_data(
		(unsigned char *)(uintptr_t)e->page->card, CAIRO_FORMAT_RGB24, r.w, r.h, r.w * 4);
	cairo_set_source_surface(e->cr, surface, r.x, r.y);
	cairo_rectangle(e->cr, r.x, r.y, r.w, r.h);
	cairo_fill(e->cr);
	cairo_surface_destroy(surface);
}

static void draw_code(const struct easel_home *e)
{
	struct rect r = e->at.qr;
	if (!e->page->ready)
		return;
	if (e->page->qr_modules == 0) {
		say(e, &too_large, r, 27.0, LOOK_INK, LOOK_INK_GREY, ALIGN_CENTRE);
		return;
	}
	draw_shadow(e, r);
	cairo_rectangle(e->cr, r.x, r.y, r.w, r.h);
	ink(e->cr, 0xffffff, 1.0);
	cairo_fill(e->cr);
	qr_paint(e->cr, e->page->qr, e->page->qr_modules, r.x, r.y, r.w);
	say(e, &scan, e->at.words, 29.0, LOOK_INK, LOOK_INK_GREY, ALIGN_CENTRE);
}

/* A sign for how it went: form and colour together. */
static void draw_sign(const struct easel_home *e, enum kept kept, double x, double y)
{
	cairo_t *cr = e->cr;
	double r = 24.0 * e->u;
	bool waits = kept == KEPT_NOT || kept == KEPT_WRITING;
	disc(cr, x, y, r);
	ink(cr, kept == KEPT ? LOOK_RELAX : waits ? LOOK_ROOM_DARK : LOOK_WRAP, 1.0);
	cairo_fill(cr);
	cairo_set_line_width(cr, 0.2 * r);
	cairo_set_line_cap(cr, CAIRO_LINE_CAP_ROUND);
	cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
	ink(cr, LOOK_PAPER, 1.0);
	if (kept == KEPT) {
		cairo_move_to(cr, x - 0.42 * r, y + 0.05 * r);
		cairo_line_to(cr, x - 0.1 * r, y + 0.38 * r);
		cairo_line_to(cr, x + 0.45 * r, y - 0.35 * r);
	} else if (waits) { /* downwards, into something */
		cairo_move_to(cr, x, y - 0.48 * r);
		cairo_line_to(cr, x, y + 0.2 * r);
		cairo_move_to(cr, x - 0.3 * r, y - 0.1 * r);
		cairo_line_to(cr, x, y + 0.2 * r);
		cairo_line_to(cr, x + 0.3 * r, y - 0.1 * r);
		cairo_move_to(cr, x - 0.4 * r, y + 0.5 * r);
		cairo_line_to(cr, x + 0.4 * r, y + 0.5 * r);
	} else {
		cairo_move_to(cr, x, y - 0.5 * r);
		cairo_line_to(cr, x, y + 0.1 * r);
		cairo_move_to(cr, x, y + 0.5 * r);
		cairo_line_to(cr, x, y + 0.5 * r);
	}
	cairo_stroke(cr);
}

static void draw_kept(const struct easel_home *e, struct rect r, enum kept kept,
		      const struct phrase words[KEPT_COUNT], bool named)
{
	double u = e->u;
	struct rect text = {r.x + (int)(82.0 * u), r.y + (int)(4.0 * u), r.w - (int)(96.0 * u),
			    r.h - (int)(8.0 * u)};
	if (!e->page->ready)
		return;
	round_rect(e->cr, r, 16.0 * u);
	ink(e->cr, LOOK_PAPER, 0.9);
	cairo_fill(e->cr);
	draw_sign(e, kept, r.x + 44.0 * u, r.y + 0.5 * r.h);
	if (named)
		text.h -= (int)(22.0 * u);
	say(e, &words[kept], text, 25.0, LOOK_INK, LOOK_INK_GREY, ALIGN_LEFT);
	struct style name = {16.0 * u, false, LOOK_INK_GREY, ALIGN_LEFT, text.w};
	if (named)
		draw_text(e->cr, e->type, e->page->name, text.x, r.y + r.h - 10.0 * u, &name);
}

static void draw_key(const struct easel_home *e, enum take_home_key key, bool pressed)
{
	struct rect r = e->at.key[key];
	uint32_t fill = key == TAKE_HOME_LEAVE ? LOOK_NIGHT : LOOK_WRAP;
	round_rect(e->cr, r, 20.0 * e->u);
	ink(e->cr, colour_mix(fill, 0x000000, pressed ? 0.2 : 0.0), 1.0);
	cairo_fill(e->cr);
	say(e, &key_name[key], r, 36.0, 0xffffff, 0xf1ebe0, ALIGN_CENTRE);
}

static void draw_all(const struct easel_home *e, int pressed)
{
	draw_ground(e);
	draw_card(e);
	draw_code(e);
	draw_kept(e, e->at.station, e->page->station, station_words, e->page->station == KEPT);
	draw_kept(e, e->at.stick, e->page->stick, stick_words, false);
	for (int key = 0; key < TAKE_HOME_KEYS; key++)
		draw_key(e, (enum take_home_key)key, pressed == key);
}

static void add_damage(struct layer *layer, struct rect rect, int margin)
{
	struct rect all = {0, 0, layer->area.w, layer->area.h};
	rect = (struct rect){rect.x - margin, rect.y - margin, rect.w + 2 * margin,
			     rect.h + 2 * margin};
	layer->damage[layer->damage_count++] = rect_within(rect, all);
}

/* What looks different from what is drawn. */
static void find_damage(struct take_home_sheet *sheet, const struct easel_home *e, int pressed)
{
	struct layer *layer = &sheet->painted.layer;
	const struct take_home_page *now = e->page, *seen = &sheet->seen;
	int shadow = (int)(24.0 * e->u);
	bool made = now->ready != seen->ready || now->failed != seen->failed ||
		    now->card != seen->card;
	layer->damage_count = 0;
	if (sheet->blank || sheet->language != e->language) {
		add_damage(layer, layer->area, 0);
		return;
	}
	if (made) {
		add_damage(layer, e->at.card, shadow);
		add_damage(layer, e->at.qr, shadow);
		add_damage(layer, e->at.words, 0);
	}
	if (made || now->station != seen->station)
		add_damage(layer, e->at.station, 0);
	if (made || now->stick != seen->stick)
		add_damage(layer, e->at.stick, 0);
	for (int key = 0; key < TAKE_HOME_KEYS; key++)
		if ((pressed == key) != (sheet->pressed == key))
			add_damage(layer, e->at.key[key], 0);
}

static void paint(struct take_home_sheet *sheet, const struct layout *layout,
		  enum language language, int pressed, const struct take_home_page *page)
{
	struct painted *painted = &sheet->painted;
	struct layer *layer = &painted->layer;
	struct easel_home e = {.cr = painted->cr,
			       .type = painted->type,
			       .language = language,
			       .u = sheet->unit,
			       .page = page,
			       .layout = layout};
	take_home_layout(&e.at, layout);
	find_damage(sheet, &e, pressed);
	if (layer->damage_count > 0) {
		cairo_save(e.cr);
		for (int i = 0; i < layer->damage_count; i++) {
			const struct rect *r = &layer->damage[i];
			cairo_rectangle(e.cr, r->x, r->y, r->w, r->h);
		}
		cairo_clip(e.cr);
		draw_all(&e, pressed);
		cairo_restore(e.cr);
		cairo_surface_flush(painted->surface);
	}
	sheet->blank = false;
	sheet->seen = *page;
	sheet->pressed = pressed;
	sheet->language = language;
}

const struct layer *take_home_sheet_update(struct take_home_sheet *sheet, const struct ui *ui,
					   const struct take_home_page *page)
{
	struct layer *layer = &sheet->painted.layer;
	paint(sheet, &ui->layout, ui->language, ui->take_home.pressed, page);
	if (!sheet->shown)
		painted_damage(&sheet->painted);
	sheet->shown = true;
	return layer;
}

void take_home_sheet_again(struct take_home_sheet *sheet)
{
	sheet->shown = false;
}

struct take_home_sheet *take_home_sheet_open(int width, int height, char fault[200])
{
	struct take_home_sheet *sheet = calloc(1, sizeof *sheet);
	struct layout layout;
	if (!sheet) {
		snprintf(fault, 200, "no memory for the card's page");
		return NULL;
	}
	layout_make(&layout, width, height, STEP_DRAW, false);
	sheet->unit = (double)layout_px(&layout, 1000) / 1000.0;
	sheet->blank = true;
	if (painted_open(&sheet->painted, (struct rect){0, 0, width, height}, true, fault)) {
		static const struct take_home_page nothing;
		paint(sheet, &layout, LANGUAGE_BOTH, -1, &nothing);
		return sheet;
	}
	free(sheet);
	return NULL;
}

void take_home_sheet_close(struct take_home_sheet *sheet)
{
	if (!sheet)
		return;
	painted_close(&sheet->painted);
	free(sheet);
}
