#include "service_page.h"

#include <stdarg.h>
#include <stdio.h>

enum {
	KEY_HEIGHT = 84, /* 21 mm on the real screen */
	MARGIN = 24,
	STRIP_TOP = 104,
	STRIP_HEIGHT = 112,
	CARDS_TOP = 232,
	CARDS_BOTTOM = 930,
	KEYS_TOP = 954,
	CROSS_MARGIN = 8, /* of a picture's side: one part in so many */
};

static const float still_px = 3.0f; /* a pen moves when it goes farther than this at 1080 lines */

/* A rectangle of the drawing of 1920 x 1080, stretched over the width there is. */
static struct rect place(const struct service_page *page, int x, int y, int w, int h)
{
	float u = page->unit, across = (float)page->width / 1920.0f;
	int left = (int)((float)x * across), right = (int)((float)(x + w) * across);
	return (struct rect){left, (int)((float)y * u), right - left, (int)((float)h * u)};
}

struct rect service_page_card(const struct service_page *page, enum service_card card)
{
	static const int x[3] = {MARGIN, 1040, 1476}, w[3] = {992, 412, 420};
	int column = (int)card % 3, row = (int)card / 3;
	int half = (CARDS_BOTTOM - CARDS_TOP - MARGIN / 2) / 2;
	return place(page, x[column], CARDS_TOP + row * (half + MARGIN / 2), w[column], half);
}

struct rect service_page_check(const struct service_page *page, enum service_check check)
{
	int w = (1920 - MARGIN) / SERVICE_CHECKS;
	return place(page, MARGIN + (int)check * w, STRIP_TOP, w - MARGIN, STRIP_HEIGHT);
}

static void keys_home(struct service_page *page)
{
	int w = (1920 - MARGIN) / 5;
	for (int i = SERVICE_KEY_CALIBRATE; i <= SERVICE_KEY_NEW; i++)
		page->key[i] = place(page, MARGIN + (i - SERVICE_KEY_CALIBRATE) * w, KEYS_TOP,
				     w - MARGIN, KEY_HEIGHT + 16);
}

/* A telephone's keys: 1 2 3 on top, 0 below in the middle. */
static void keys_pin(struct service_page *page)
{
	for (int digit = 0; digit <= 9; digit++) {
		int column = digit ? (digit - 1) % 3 : 1, row = digit ? (digit - 1) / 3 : 3;
		page->key[SERVICE_KEY_DIGIT_0 + digit] = place(page, 768 + 136 * column,
							       430 + 116 * row, 112, 100);
	}
	page->key[SERVICE_KEY_BACK] = place(page, 768 + 272, 430 + 348, 112, 100);
}

void service_page_show(struct service_page *page, enum service_view view)
{
	memset(page->key, 0, sizeof page->key);
	page->view = view;
	page->changed++;
	page->pressed = page->hover = SERVICE_KEY_NONE;
	page->touching = false;
	page->key[SERVICE_KEY_LEAVE] = place(page, 1640, 10, 256, 68);
	if (view == SERVICE_PIN)
		keys_pin(page);
	else if (view == SERVICE_HOME)
		keys_home(page);
	else if (view == SERVICE_CROSSES)
		page->cross = 0;
	else {
		page->key[SERVICE_KEY_REPEAT] = place(page, 600, 640, 340, 110);
		page->key[SERVICE_KEY_ACCEPT] = place(page, 980, 640, 340, 110);
	}
	page->dull[SERVICE_KEY_ACCEPT] = view == SERVICE_RESULT && !page->result_good;
}

/* Crosses in rows from corner to corner, read like a page. */
static void crosses_place(struct service_page *page, int side)
{
	page->cross_count = side * side;
	MUST(side >= 2 && page->cross_count <= SERVICE_CROSSES_MAX);
	for (int i = 0; i < page->cross_count; i++) {
		float fx = (float)(i % side) / (float)(side - 1);
		float fy = (float)(i / side) / (float)(side - 1);
		float inner = 1.0f - 2.0f / (float)CROSS_MARGIN;
		page->crosses[i].meant_px = (struct v2){
			(float)page->width * (1.0f / (float)CROSS_MARGIN + inner * fx),
			(float)page->height * (1.0f / (float)CROSS_MARGIN + inner * fy)};
	}
}

void service_page_open(struct service_page *page, int width, int height, enum language language,
		       const char *pin, int crosses_a_side)
{
	memset(page, 0, sizeof *page);
	page->width = width;
	page->height = height;
	page->unit = (float)height / 1080.0f;
	page->language = language;
	snprintf(page->pin, sizeof page->pin, "%s", pin);
	crosses_place(page, crosses_a_side);
	service_page_show(page, page->pin[0] ? SERVICE_PIN : SERVICE_HOME);
}

static enum service_key key_at(const struct service_page *page, struct v2 px)
{
	for (int i = 1; i < SERVICE_KEYS; i++)
		if (page->key[i].w > 0 && !page->dull[i] && rect_holds(page->key[i], px))
			return (enum service_key)i;
	return SERVICE_KEY_NONE;
}

/* A digit at a time; the whole PIN opens the page, a wrong one begins anew. */
static void pin_type(struct service_page *page, enum service_key key)
{
	size_t size = strlen(page->typed), whole = strlen(page->pin);
	page->pin_wrong = false;
	if (key == SERVICE_KEY_BACK && size > 0)
		page->typed[size - 1] = 0;
	if (key == SERVICE_KEY_BACK || size >= whole)
		return;
	page->typed[size] = (char)('0' + (int)key - SERVICE_KEY_DIGIT_0);
	page->typed[size + 1] = 0;
	if (size + 1 < whole)
		return;
	page->pin_wrong = strcmp(page->typed, page->pin) != 0;
	memset(page->typed, 0, sizeof page->typed);
	if (!page->pin_wrong)
		service_page_show(page, SERVICE_HOME);
}

/* What a key does on the page itself; the rest is the host's. */
static enum service_key key_do(struct service_page *page, enum service_key key)
{
	page->changed++;
	if (key >= SERVICE_KEY_DIGIT_0 && key <= SERVICE_KEY_BACK) {
		pin_type(page, key);
		return SERVICE_KEY_NONE;
	}
	if (key == SERVICE_KEY_CALIBRATE || key == SERVICE_KEY_REPEAT) {
		service_page_show(page, SERVICE_CROSSES);
		return key == SERVICE_KEY_CALIBRATE ? key : SERVICE_KEY_NONE;
	}
	if (key == SERVICE_KEY_LEAVE && page->view >= SERVICE_CROSSES) {
		service_page_show(page, SERVICE_HOME);
		return SERVICE_KEY_CALIBRATE; /* the calibration is over: the pens lie as before */
	}
	return key;
}

/* The mean of a touch is the cross; a touch on the way out is none. */
static enum service_key cross_take(struct service_page *page)
{
	if (page->sum_count == 0 || page->cross >= page->cross_count)
		return SERVICE_KEY_NONE;
	page->crosses[page->cross++].seen_px = v2_scale(page->sum_px,
							1.0f / (float)page->sum_count);
	page->changed++;
	return page->cross == page->cross_count ? SERVICE_KEY_REPEAT : SERVICE_KEY_NONE;
}

static void pen_moved(struct service_page *page, struct v2 px)
{
	page->pen_px = px;
	if (v2_distance(px, page->still_px) < still_px * page->unit)
		return;
	page->still_px = px;
	page->silent = 0;
}

static enum service_key sample_take(struct service_page *page, const struct pen_sample *sample)
{
	bool touch = sample->state == PEN_TOUCH;
	enum service_key result = SERVICE_KEY_NONE;
	enum service_key at = sample->state == PEN_AWAY ? SERVICE_KEY_NONE
							: key_at(page, sample->position_px);
	if (sample->state != PEN_AWAY)
		pen_moved(page, sample->position_px);
	page->changed += at != page->hover;
	page->hover = at;
	if (touch && !page->touching) {
		page->pressed = at;
		page->sum_px = (struct v2){0};
		page->sum_count = 0;
		page->silent = 0;
		page->changed++;
	}
	if (touch && page->pressed == SERVICE_KEY_NONE) {
		page->sum_px = v2_add(page->sum_px, sample->position_px);
		page->sum_count++;
	}
	if (!touch && page->touching) {
		/* where it was lifted: some pens leave without a last position of their own */
		if (page->pressed && page->pressed == key_at(page, page->pen_px))
			result = key_do(page, page->pressed);
		else if (page->view == SERVICE_CROSSES && !page->pressed)
			result = cross_take(page);
		page->pressed = SERVICE_KEY_NONE;
		page->changed++;
	}
	page->touching = touch;
	return result;
}

enum service_key service_page_update(struct service_page *page, const struct frame_input *input)
{
	enum service_key result = SERVICE_KEY_NONE;
	page->silent++;
	for (int i = 0; i < input->sample_count && result == SERVICE_KEY_NONE; i++)
		result = sample_take(page, &input->sample[i]);
	return result;
}

void service_list_add(struct service_list *list, enum service_level level, const char *key,
		      const char *format, ...)
{
	if (list->count == SERVICE_LINES_MAX)
		return;
	struct service_line *line = &list->line[list->count++];
	va_list arguments;
	line->level = level;
	snprintf(line->key, sizeof line->key, "%s", key);
	va_start(arguments, format);
	vsnprintf(line->value, sizeof line->value, format, arguments);
	va_end(arguments);
}
