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
	int seen, pressed; /* page->changed, the key and language as drawn; -1: nothing yet */
	enum language language;
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
	cairo_pattern_t *light = cairo_pattern_create_linear(0.0, l->bar.h, 0.0, l->bottom.y);
	cairo_pattern_add_color_stop_rgb(light, 0.0, 0.945, 0.922, 0.878);
	cairo_pattern_add_color_stop_rgb(light, 1.0, 0.855, 0.822, 0.762);
	cairo_set_source(cr, light);
	cairo_paint(cr);
	cairo_pattern_destroy(light);
	cairo_rectangle(cr, l->bar.x, l->bar.y, l->bar.w, l->bar.h);
	ink(cr, LOOK_NIGHT, 1.0);
	cairo_fill(cr);
	cairo_rectangle(cr, l->bottom.x, l->bottom.y, l->bottom.w, l->bottom.h);
	ink(cr, LOOK_BAR, 1.0);
	cairo_fill(cr);
	struct rect words = {(int)(40.0 * e->u), l->bar.y, l->width / 2, l->bar.h};
	say(e, &title, words, 32.0, 0xf6f2ea, 0xb8c4cf, ALIGN_LEFT);
}

static void draw_shadow(const struct easel_home *e, struct rect r)
{
	for (int i = 8; i > 0; i--) {
		round_box(e->cr, r.x - 0.6 * i * e->u, r.y + (3.0 - 0.6 * i) * e->u,
			  r.w + 1.2 * i * e->u, r.h + (1.6 * i + 3.0) * e->u, 6.0 * e->u);
		ink(e->cr, 0x3d301f, 0.028);
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
	round_rect(e->cr, r, 16.0 * e->u);
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

const struct layer *take_home_sheet_update(struct take_home_sheet *sheet, const struct ui *ui,
					   const struct take_home_page *page)
{
	struct painted *painted = &sheet->painted;
	painted->layer.damage_count = 0;
	if (sheet->seen == page->changed && sheet->pressed == ui->take_home.pressed &&
	    sheet->language == ui->language)
		return &painted->layer;
	struct easel_home e = {.cr = painted->cr,
			       .type = painted->type,
			       .language = ui->language,
			       .u = sheet->unit,
			       .page = page,
			       .layout = &ui->layout};
	take_home_layout(&e.at, &ui->layout);
	draw_ground(&e);
	draw_card(&e);
	draw_code(&e);
	draw_kept(&e, e.at.station, page->station, station_words, page->station == KEPT);
	draw_kept(&e, e.at.stick, page->stick, stick_words, false);
	for (int key = 0; key < TAKE_HOME_KEYS; key++)
		draw_key(&e, (enum take_home_key)key, ui->take_home.pressed == key);
	sheet->seen = page->changed;
	sheet->pressed = ui->take_home.pressed;
	sheet->language = ui->language;
	painted_damage(painted);
	return &painted->layer;
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
	sheet->seen = -1;
	if (painted_open(&sheet->painted, (struct rect){0, 0, width, height}, true, fault))
		return sheet;
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
