/* The operator's page in the visitors' own look: cards on paper, keys on the bar. */
#include "draw_service.h"

#include "draw_painted.h"

#include <stdio.h>
#include <stdlib.h>

enum { TEXT_PX = 20, HEAD_PX = 25, LINE_PX = 31, PAD_PX = 20, KEY_COLUMN_PX = 150 };

struct service_sheet {
	struct painted painted;
	int seen; /* page->changed as drawn; -1: nothing yet */
};

struct painter {
	cairo_t *cr;
	struct type *type;
	const struct service_page *page;
	double u;
};

static const struct phrase card_name[SERVICE_CARDS] = {
	{"ペン", "Pens"}, {"ボタン", "Buttons"}, {"画面", "Display"},
	{"記録", "Log"},  {"計算", "Solver"},    {"体験", "Visits"},
};

static const struct phrase check_name[SERVICE_CHECKS] = {
	{"画面", "Display"}, {"ペン", "Pen"},    {"ボタン", "Buttons"},
	{"保存", "Storage"}, {"計算", "Solver"},
};

static const struct phrase key_name[SERVICE_KEYS] = {
	[SERVICE_KEY_LEAVE] = {"もどる", "Leave"},
	[SERVICE_KEY_CALIBRATE] = {"位置合わせ", "Calibrate the pen"},
	[SERVICE_KEY_LANGUAGE] = {"ことば", "Language"},
	[SERVICE_KEY_IDLE] = {"待ち時間", "Idle time"},
	[SERVICE_KEY_TURN] = {"タブレットの向き", "Tablet lies"},
	[SERVICE_KEY_NEW] = {"はじめから", "New visit"},
	[SERVICE_KEY_ACCEPT] = {"保存する", "Keep it"},
	[SERVICE_KEY_REPEAT] = {"やり直す", "Once more"},
};

static uint32_t level_colour(enum service_level level)
{
	static const uint32_t colour[] = {LOOK_INK, 0x00734f, 0x8a5a00, 0xb33c00};
	return colour[level];
}

/* Colour and form together: nobody needs to tell green from red. */
static void draw_level(const struct painter *p, enum service_level level, double x, double y,
		       double r)
{
	static const uint32_t fill[] = {LOOK_GRID_50, LOOK_RELAX, 0xe69f00, LOOK_WRAP};
	cairo_t *cr = p->cr;
	cairo_new_path(cr);
	if (level == SERVICE_AMBER) {
		cairo_move_to(cr, x, y - r);
		cairo_line_to(cr, x + r, y + 0.8 * r);
		cairo_line_to(cr, x - r, y + 0.8 * r);
		cairo_close_path(cr);
	} else {
		disc(cr, x, y, r);
	}
	ink(cr, fill[level], 1.0);
	cairo_fill(cr);
	cairo_set_line_width(cr, 0.22 * r);
	cairo_set_line_cap(cr, CAIRO_LINE_CAP_ROUND);
	cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
	ink(cr, level == SERVICE_AMBER ? LOOK_INK : LOOK_PAPER, 1.0);
	if (level == SERVICE_GREEN) {
		cairo_move_to(cr, x - 0.42 * r, y + 0.05 * r);
		cairo_line_to(cr, x - 0.1 * r, y + 0.38 * r);
		cairo_line_to(cr, x + 0.45 * r, y - 0.35 * r);
	} else if (level == SERVICE_AMBER) {
		cairo_move_to(cr, x, y - 0.3 * r);
		cairo_line_to(cr, x, y + 0.2 * r);
		cairo_move_to(cr, x, y + 0.52 * r);
		cairo_line_to(cr, x, y + 0.52 * r);
	} else if (level == SERVICE_RED) {
		cairo_move_to(cr, x - 0.35 * r, y - 0.35 * r);
		cairo_line_to(cr, x + 0.35 * r, y + 0.35 * r);
		cairo_move_to(cr, x + 0.35 * r, y - 0.35 * r);
		cairo_line_to(cr, x - 0.35 * r, y + 0.35 * r);
	}
	cairo_stroke(cr);
}

/* Japanese bold and English beside it, or one of them alone. */
static void draw_heading(const struct painter *p, const struct phrase *phrase, double x, double y,
			 double size, uint32_t colour, uint32_t colour_english)
{
	enum language language = p->page->language;
	struct style bold = {size, true, colour, ALIGN_LEFT, 0.0};
	struct style plain = {0.8 * size, false, colour_english, ALIGN_LEFT, 0.0};
	if (language == LANGUAGE_ENGLISH) {
		draw_text(p->cr, p->type, phrase->english, x, y, &bold);
		return;
	}
	double width = draw_text(p->cr, p->type, phrase->japanese, x, y, &bold);
	if (language == LANGUAGE_BOTH)
		draw_text(p->cr, p->type, phrase->english, x + width + 0.5 * size, y, &plain);
}

static void draw_box(const struct painter *p, struct rect rect, uint32_t fill, uint32_t rim)
{
	round_rect(p->cr, rect, 14.0 * p->u);
	ink(p->cr, fill, 1.0);
	cairo_fill_preserve(p->cr);
	cairo_set_line_width(p->cr, p->u > 0.7 ? 1.5 * p->u : 1.0);
	ink(p->cr, rim, 1.0);
	cairo_stroke(p->cr);
}

/* In at most so many lines, broken between words; returns how many it took. The letters' mean width
 * is an estimate, and a line that is wider all the same is made smaller. */
static int draw_wrapped(const struct painter *p, const char *text, double x, double y, double w,
			int lines, const struct style *style)
{
	char line[SERVICE_VALUE_BYTES];
	struct style fitted = *style;
	int room = int_max((int)(w / (0.54 * style->size_px)), 8), used = 0;
	fitted.width_max = w;
	while (*text && used < lines) {
		int size = (int)strlen(text);
		bool last = used + 1 == lines;
		if (size > room && !last) {
			size = room;
			while (size > room / 2 && text[size] != ' ')
				size--;
		}
		snprintf(line, sizeof line, "%.*s", size, text);
		draw_text(p->cr, p->type, line, x, y + used * 1.25 * style->size_px, &fitted);
		text += size + (text[size] == ' ');
		used++;
	}
	return used;
}

static int draw_line(const struct painter *p, const struct service_line *line, double x, double y,
		     double w)
{
	struct style grey = {TEXT_PX * p->u, false, LOOK_INK_GREY, ALIGN_LEFT,
			     (KEY_COLUMN_PX - 12) * p->u};
	struct style value = {TEXT_PX * p->u, false, level_colour(line->level), ALIGN_LEFT, w};
	if (line->key[0] == '#') { /* a name: bold over the whole line */
		value.bold = true;
	} else if (line->key[0]) {
		draw_text(p->cr, p->type, line->key, x, y, &grey);
		x += KEY_COLUMN_PX * p->u;
		value.width_max -= KEY_COLUMN_PX * p->u;
	}
	return draw_wrapped(p, line->value, x, y, value.width_max, 2, &value);
}

static void draw_card(const struct painter *p, enum service_card card)
{
	const struct service_list *list = &p->page->card[card];
	struct rect rect = service_page_card(p->page, card);
	double u = p->u, x = rect.x + PAD_PX * u, y = rect.y + 40.0 * u;
	draw_box(p, rect, LOOK_PAPER, LOOK_GRID_50);
	draw_heading(p, &card_name[card], x, y, HEAD_PX * u, LOOK_INK, LOOK_INK_GREY);
	/* two tablets stand closer than one */
	double room = (rect.h - 62.0 * u) / int_max(list->count, 1);
	double pitch = room < LINE_PX * u ? room : LINE_PX * u;
	y += 6.0 * u;
	for (int i = 0; i < list->count; i++) {
		y += pitch;
		if (y > rect.y + rect.h - 4.0 * u)
			break;
		int lines = draw_line(p, &list->line[i], x, y, rect.w - 2.0 * PAD_PX * u);
		y += (lines - 1) * 1.25 * TEXT_PX * u;
	}
}

static void draw_check(const struct painter *p, enum service_check check)
{
	struct rect rect = service_page_check(p->page, check);
	double u = p->u;
	if ((int)check >= p->page->check.count)
		return;
	const struct service_line *line = &p->page->check.line[check];
	static const uint32_t rim[] = {LOOK_GRID_50, LOOK_RELAX, 0xe69f00, LOOK_WRAP};
	draw_box(p, rect, LOOK_PAPER, rim[line->level]);
	draw_level(p, line->level, rect.x + 36.0 * u, rect.y + 40.0 * u, 20.0 * u);
	draw_heading(p, &check_name[check], rect.x + 70.0 * u, rect.y + 48.0 * u, HEAD_PX * u,
		     LOOK_INK, LOOK_INK_GREY);
	double w = rect.w - 36.0 * u;
	struct style style = {TEXT_PX * u, false, level_colour(line->level), ALIGN_LEFT, w};
	bool small = (double)strlen(line->value) * 0.54 * style.size_px > w;
	style.size_px *= small ? 0.85 : 1.0;
	draw_wrapped(p, line->value, rect.x + 18.0 * u, rect.y + (small ? 82.0 : 92.0) * u, w, 2,
		     &style);
}

static void draw_key(const struct painter *p, enum service_key key)
{
	const struct service_page *page = p->page;
	struct rect rect = page->key[key];
	bool dark = key == SERVICE_KEY_LEAVE || key == SERVICE_KEY_ACCEPT;
	bool pressed = page->pressed == key, hover = page->hover == key;
	double u = p->u;
	uint32_t fill = dark ? LOOK_NIGHT_RAISED : LOOK_PAPER;
	fill = pressed ? colour_mix(fill, LOOK_HINT_RIM, 0.6) : fill;
	fill = page->dull[key] ? LOOK_BAR : fill;
	draw_box(p, rect, fill, hover ? LOOK_INK : (dark ? LOOK_NIGHT_RAISED : LOOK_GRID_50));
	uint32_t colour = page->dull[key] ? 0x8a857c : (dark && !pressed ? LOOK_PAPER : LOOK_INK);
	if (key >= SERVICE_KEY_DIGIT_0 && key <= SERVICE_KEY_DIGIT_9) {
		char digit[2] = {(char)('0' + (int)key - SERVICE_KEY_DIGIT_0), 0};
		struct style style = {42.0 * u, true, colour, ALIGN_CENTRE, 0.0};
		draw_text(p->cr, p->type, digit, rect.x + 0.5 * rect.w,
			  rect.y + 0.5 * rect.h + 15.0 * u, &style);
		return;
	}
	if (key == SERVICE_KEY_BACK) {
		ink(p->cr, colour, 1.0);
		draw_icon(p->cr, ICON_UNDO, rect.x + 0.5 * rect.w, rect.y + 0.5 * rect.h, 46.0 * u);
		return;
	}
	struct rect text = rect;
	if (page->value[key][0]) { /* what is set stands on the right */
		text.w = (int)(0.56 * rect.w);
		struct style style = {24.0 * u, true, colour, ALIGN_CENTRE, 0.40 * rect.w};
		draw_text(p->cr, p->type, page->value[key], rect.x + 0.77 * rect.w,
			  rect.y + 0.5 * rect.h + 9.0 * u, &style);
	}
	text.x += (int)(14.0 * u);
	text.w -= (int)(28.0 * u);
	struct label label = {26.0 * u, 19.0 * u, colour, colour, ALIGN_CENTRE};
	draw_phrase(p->cr, p->type, &key_name[key], page->language, text, &label);
}

static void draw_home(const struct painter *p)
{
	for (int i = 0; i < SERVICE_CARDS; i++)
		draw_card(p, (enum service_card)i);
	for (int i = 0; i < SERVICE_CHECKS; i++)
		draw_check(p, (enum service_check)i);
}

static void centred(const struct painter *p, const struct phrase *phrase, double y, double size)
{
	struct rect rect = {0, (int)(y * p->u), p->page->width, (int)(2.4 * size * p->u)};
	struct label label = {size * p->u, 0.72 * size * p->u, LOOK_INK, LOOK_INK_GREY,
			      ALIGN_CENTRE};
	draw_phrase(p->cr, p->type, phrase, p->page->language, rect, &label);
}

static void draw_pin(const struct painter *p)
{
	static const struct phrase ask = {"暗証番号を入れてください", "Type the PIN"};
	static const struct phrase wrong = {"番号が違います。もう一度",
					    "That is another number. Try again"};
	int whole = (int)strlen(p->page->pin), typed = (int)strlen(p->page->typed);
	double u = p->u, step = 52.0 * u;
	centred(p, p->page->pin_wrong ? &wrong : &ask, 180.0, 40.0);
	for (int i = 0; i < whole; i++) {
		double x = 0.5 * p->page->width + (i - 0.5 * (whole - 1)) * step;
		disc(p->cr, x, 356.0 * u, 14.0 * u);
		ink(p->cr, LOOK_INK, 1.0);
		if (i < typed)
			cairo_fill_preserve(p->cr);
		cairo_set_line_width(p->cr, 2.5 * u);
		cairo_stroke(p->cr);
	}
}

static void draw_cross(const struct painter *p, struct v2 px, uint32_t colour, double arm)
{
	double x = (double)px.x, y = (double)px.y;
	cairo_move_to(p->cr, x - arm, y);
	cairo_line_to(p->cr, x + arm, y);
	cairo_move_to(p->cr, x, y - arm);
	cairo_line_to(p->cr, x, y + arm);
	ink(p->cr, colour, 1.0);
	cairo_set_line_width(p->cr, 2.0 * p->u);
	cairo_stroke(p->cr);
}

/* The cross that is asked for has a ring; those taken before are small and done. */
static void draw_crosses(const struct painter *p)
{
	static const struct phrase ask = {"十字の真ん中をペンで軽くたたく",
					  "Tap the middle of the cross with the pen"};
	const struct service_page *page = p->page;
	char count[32];
	struct style style = {30.0 * p->u, false, LOOK_INK_GREY, ALIGN_CENTRE, 0.0};
	centred(p, &ask, 300.0, 36.0);
	snprintf(count, sizeof count, "%d / %d", int_min(page->cross + 1, page->cross_count),
		 page->cross_count);
	draw_text(p->cr, p->type, count, 0.5 * page->width, 440.0 * p->u, &style);
	for (int i = 0; i < page->cross && i < page->cross_count; i++)
		draw_cross(p, page->crosses[i].meant_px, LOOK_RELAX, 9.0 * p->u);
	if (page->cross >= page->cross_count)
		return;
	struct v2 at = page->crosses[page->cross].meant_px;
	disc(p->cr, (double)at.x, (double)at.y, 34.0 * p->u);
	ink(p->cr, LOOK_HINT, 1.0);
	cairo_fill_preserve(p->cr);
	ink(p->cr, LOOK_WRAP, 1.0);
	cairo_set_line_width(p->cr, 3.0 * p->u);
	cairo_stroke(p->cr);
	draw_cross(p, at, LOOK_INK, 26.0 * p->u);
}

static void draw_result(const struct painter *p)
{
	static const struct phrase good = {"ペンの位置が合いました", "The pen meets the picture"};
	static const struct phrase bad = {"うまく合いませんでした", "These touches do not fit"};
	struct style style = {27.0 * p->u, false, LOOK_INK, ALIGN_CENTRE, 0.8 * p->page->width};
	centred(p, p->page->result_good ? &good : &bad, 290.0, 42.0);
	draw_text(p->cr, p->type, p->page->result, 0.5 * p->page->width, 470.0 * p->u, &style);
	for (int i = 0; i < p->page->cross_count; i++) {
		draw_cross(p, p->page->crosses[i].meant_px, LOOK_GRID_50, 20.0 * p->u);
		disc(p->cr, (double)p->page->crosses[i].seen_px.x,
		     (double)p->page->crosses[i].seen_px.y, 5.0 * p->u);
		ink(p->cr, LOOK_WRAP, 1.0);
		cairo_fill(p->cr);
	}
}

static void draw_page(const struct painter *p)
{
	static const struct phrase title = {"点検", "Service"};
	cairo_t *cr = p->cr;
	double u = p->u;
	bool home = p->page->view == SERVICE_HOME;
	ink(cr, home ? LOOK_BAR : LOOK_PAPER, 1.0);
	cairo_paint(cr);
	cairo_rectangle(cr, 0.0, 0.0, p->page->width, 88.0 * u);
	ink(cr, LOOK_NIGHT, 1.0);
	cairo_fill(cr);
	draw_heading(p, &title, 32.0 * u, 57.0 * u, 34.0 * u, LOOK_PAPER, LOOK_GRID_50);
	if (home)
		draw_home(p);
	else if (p->page->view == SERVICE_PIN)
		draw_pin(p);
	else if (p->page->view == SERVICE_CROSSES)
		draw_crosses(p);
	else
		draw_result(p);
	for (int i = 1; i < SERVICE_KEYS; i++)
		if (p->page->key[i].w > 0)
			draw_key(p, (enum service_key)i);
}

const struct layer *service_sheet_update(struct service_sheet *sheet,
					 const struct service_page *page)
{
	struct painted *painted = &sheet->painted;
	struct painter painter = {painted->cr, painted->type, page, (double)page->unit};
	painted->layer.damage_count = 0;
	if (sheet->seen != page->changed) {
		draw_page(&painter);
		painted_damage(painted);
	}
	sheet->seen = page->changed;
	return &painted->layer;
}

struct service_sheet *service_sheet_open(int width, int height, char fault[200])
{
	struct service_sheet *sheet = calloc(1, sizeof *sheet);
	if (!sheet) {
		snprintf(fault, 200, "no memory for the service page");
		return NULL;
	}
	sheet->seen = -1;
	if (!painted_open(&sheet->painted, (struct rect){0, 0, width, height}, true, fault)) {
		free(sheet);
		return NULL;
	}
	return sheet;
}

void service_sheet_close(struct service_sheet *sheet)
{
	if (!sheet)
		return;
	painted_close(&sheet->painted);
	free(sheet);
}
