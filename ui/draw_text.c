#include "draw_text.h"

#include <pango/pangocairo.h>

#include <stdio.h>
#include <stdlib.h>

static const char family[] = "BIZ UDPGothic";

struct type {
	PangoContext *context;
	PangoLayout *layout;
	PangoFontDescription *description[2]; /* regular, bold */
};

/* Pango replaces a missing family in silence; a station without Japanese letters must say so. */
static bool family_exists(PangoContext *context)
{
	PangoFontFamily **families;
	int count;
	bool found = false;
	pango_context_list_families(context, &families, &count);
	for (int i = 0; i < count; i++)
		found |= strcmp(pango_font_family_get_name(families[i]), family) == 0;
	g_free(families);
	return found;
}

struct type *type_open(char fault[200])
{
	struct type *type = calloc(1, sizeof *type);
	if (!type) {
		snprintf(fault, 200, "no memory for the typeface");
		return NULL;
	}
	type->context = pango_font_map_create_context(pango_cairo_font_map_get_default());
	if (!family_exists(type->context)) {
		snprintf(fault, 200,
			 "the typeface %s is missing; install fonts-morisawa-bizud-gothic", family);
		type_close(type);
		return NULL;
	}
	cairo_font_options_t *options = cairo_font_options_create();
	cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
	cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_SLIGHT);
	cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
	pango_cairo_context_set_font_options(type->context, options);
	cairo_font_options_destroy(options);
	type->layout = pango_layout_new(type->context);
	pango_layout_set_single_paragraph_mode(type->layout, TRUE);
	for (int i = 0; i < 2; i++) {
		type->description[i] = pango_font_description_new();
		pango_font_description_set_family_static(type->description[i], family);
		pango_font_description_set_weight(type->description[i],
						  i ? PANGO_WEIGHT_BOLD : PANGO_WEIGHT_NORMAL);
	}
	return type;
}

void type_close(struct type *type)
{
	if (!type)
		return;
	for (int i = 0; i < 2; i++)
		if (type->description[i])
			pango_font_description_free(type->description[i]);
	if (type->layout)
		g_object_unref(type->layout);
	g_object_unref(type->context);
	free(type);
}

/* Sets the text and returns its width in pixels. */
static double set_text(struct type *type, const char *text, double size_px, bool bold)
{
	int width;
	PangoFontDescription *description = type->description[bold];
	pango_font_description_set_absolute_size(description, size_px * PANGO_SCALE);
	pango_layout_set_font_description(type->layout, description);
	pango_layout_set_text(type->layout, text, -1);
	pango_layout_get_size(type->layout, &width, NULL);
	return (double)width / PANGO_SCALE;
}

double draw_text(cairo_t *cr, struct type *type, const char *text, double x, double y,
		 const struct style *style)
{
	double width = set_text(type, text, style->size_px, style->bold);
	if (style->width_max > 0.0 && width > style->width_max)
		width = set_text(type, text, style->size_px * style->width_max / width,
				 style->bold);
	double left = style->align == ALIGN_CENTRE ? x - 0.5 * width : x;
	double baseline = (double)pango_layout_get_baseline(type->layout) / PANGO_SCALE;
	ink(cr, style->colour, 1.0);
	cairo_move_to(cr, left, y - baseline);
	pango_cairo_show_layout(cr, type->layout);
	return width;
}

void draw_phrase(cairo_t *cr, struct type *type, const struct phrase *phrase,
		 enum language language, struct rect rect, const struct label *label)
{
	double x = label->align == ALIGN_CENTRE ? rect.x + 0.5 * rect.w : rect.x;
	double middle = rect.y + 0.5 * rect.h;
	struct style japanese = {label->japanese_px, true, label->colour, label->align, rect.w};
	struct style english = {label->english_px, false, label->colour_english, label->align,
				rect.w};
	if (language == LANGUAGE_BOTH) {
		double gap = 0.5 * label->english_px;
		double height = 0.8 * label->japanese_px + gap + 0.72 * label->english_px;
		double top = middle - 0.5 * height;
		draw_text(cr, type, phrase->japanese, x, top + 0.8 * label->japanese_px, &japanese);
		draw_text(cr, type, phrase->english, x, top + height, &english);
		return;
	}
	const char *text = language == LANGUAGE_JAPANESE ? phrase->japanese : phrase->english;
	draw_text(cr, type, text, x, middle + 0.36 * label->japanese_px, &japanese);
}

void stroke_dashed(cairo_t *cr, const double *dash, int count)
{
	cairo_set_dash(cr, dash, count, 0.0);
	cairo_stroke(cr);
	cairo_set_dash(cr, NULL, 0, 0.0);
}

void round_box(cairo_t *cr, double x, double y, double w, double h, double radius)
{
	static const double quarter = 1.5707963267948966;
	cairo_new_sub_path(cr);
	cairo_arc(cr, x + w - radius, y + radius, radius, -quarter, 0.0);
	cairo_arc(cr, x + w - radius, y + h - radius, radius, 0.0, quarter);
	cairo_arc(cr, x + radius, y + h - radius, radius, quarter, 2.0 * quarter);
	cairo_arc(cr, x + radius, y + radius, radius, 2.0 * quarter, 3.0 * quarter);
	cairo_close_path(cr);
}

void round_rect(cairo_t *cr, struct rect rect, double radius)
{
	round_box(cr, rect.x, rect.y, rect.w, rect.h, radius);
}

uint32_t colour_mix(uint32_t a, uint32_t b, double t)
{
	uint32_t mixed = 0;
	for (int shift = 0; shift <= 16; shift += 8) {
		double from = (double)(a >> shift & 255), to = (double)(b >> shift & 255);
		mixed |= (uint32_t)(from + (to - from) * t + 0.5) << shift;
	}
	return mixed;
}

void draw_number(cairo_t *cr, struct type *type, int number, double x, double y, double radius_px,
		 bool paired)
{
	char text[12];
	const struct mark_style *mark = look_mark_style(number);
	struct style style = {1.35 * radius_px, true, 0xffffff, ALIGN_CENTRE, 1.6 * radius_px};
	snprintf(text, sizeof text, "%d", number);
	disc(cr, x, y, radius_px * 1.18);
	ink(cr, 0xffffff, 1.0);
	cairo_fill(cr);
	disc(cr, x, y, radius_px);
	ink(cr, mark->colour, 1.0);
	cairo_fill(cr);
	if (!paired) { /* waits for its partner on the other side */
		double dash[2] = {0.35 * radius_px, 0.35 * radius_px};
		cairo_set_line_width(cr, 0.16 * radius_px);
		disc(cr, x, y, radius_px * 1.45);
		stroke_dashed(cr, dash, 2);
	}
	draw_text(cr, type, text, x, y + 0.5 * radius_px, &style);
}

struct rect rect_join(struct rect a, struct rect b)
{
	if (a.w <= 0)
		return b;
	if (b.w <= 0)
		return a;
	int right = int_max(a.x + a.w, b.x + b.w), bottom = int_max(a.y + a.h, b.y + b.h);
	int x = int_min(a.x, b.x), y = int_min(a.y, b.y);
	return (struct rect){x, y, right - x, bottom - y};
}

struct rect rect_within(struct rect a, struct rect outer)
{
	int x = int_max(a.x, outer.x), y = int_max(a.y, outer.y);
	int right = int_min(a.x + a.w, outer.x + outer.w);
	int bottom = int_min(a.y + a.h, outer.y + outer.h);
	return (struct rect){x, y, int_max(right - x, 0), int_max(bottom - y, 0)};
}

struct rect rect_around(struct v2 a, struct v2 b, double margin)
{
	double x = (double)float_min(a.x, b.x) - margin, y = (double)float_min(a.y, b.y) - margin;
	double right = (double)float_max(a.x, b.x) + margin;
	double bottom = (double)float_max(a.y, b.y) + margin;
	return (struct rect){(int)x - 1, (int)y - 1, (int)(right - x) + 3, (int)(bottom - y) + 3};
}
