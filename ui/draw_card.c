/* The card: the figure in its room on the left, on the right paper with the pattern and the code.
 */
#include "draw_card.h"

#include "draw_qr.h"
#include "draw_text.h"

#include <stdio.h>

/* Lengths are dots of the whole card; everything is scaled at once. */
enum {
	FOLD = 852, /* where the room ends and the paper begins */
	MARGIN = 60,
	PATTERN_TOP = 186,
	PATTERN_HEIGHT = 372,
	QR_SIDE = 500,
	QR_TOP = CARD_HEIGHT - MARGIN - QR_SIDE,
	QR_LEFT = CARD_WIDTH - MARGIN - QR_SIDE,
	DOTS_PER_10_MM = 118,
};

struct press {
	cairo_t *cr;
	struct type *type;
	const struct card *card;
	/* the sheet on the card */
	double scale, left, top; /* dots a mm; of the sheet's low x and high y */
	struct v2 low_mm, high_mm;
};

/* ---- the room ---- */

static void paint_room(const struct press *press)
{
	cairo_t *cr = press->cr;
	cairo_pattern_t *light = cairo_pattern_create_radial(0.5 * FOLD, 400.0, 60.0, 0.5 * FOLD,
							     520.0, 900.0);
	cairo_pattern_add_color_stop_rgb(light, 0.0, 0.965, 0.944, 0.906);
	cairo_pattern_add_color_stop_rgb(light, 1.0, 0.775, 0.733, 0.661);
	cairo_rectangle(cr, 0.0, 0.0, FOLD, CARD_HEIGHT);
	cairo_set_source(cr, light);
	cairo_fill(cr);
	cairo_pattern_destroy(light);
}

static void paint_portrait(const struct press *press, int which, double x, double y, double scale)
{
	cairo_t *cr = press->cr;
	unsigned char *pixels = press->card->portrait[which];
	if (!pixels)
		return;
	cairo_surface_t *surface = cairo_image_surface_create_for_data(
		pixels, CAIRO_FORMAT_ARGB32, PORTRAIT_WIDTH, PORTRAIT_HEIGHT, PORTRAIT_WIDTH * 4);
	cairo_save(cr);
	cairo_rectangle(cr, 0.0, 0.0, FOLD, CARD_HEIGHT);
	cairo_clip(cr);
	cairo_translate(cr, x, y);
	cairo_scale(cr, scale, scale);
	cairo_set_source_surface(cr, surface, -0.5 * PORTRAIT_WIDTH, -(double)PORTRAIT_HEIGHT);
	cairo_pattern_set_filter(cairo_get_source(cr), CAIRO_FILTER_GOOD);
	cairo_paint(cr);
	cairo_restore(cr);
	cairo_surface_destroy(surface);
}

/* ---- the paper ---- */

static void paint_paper(const struct press *press)
{
	cairo_t *cr = press->cr;
	cairo_rectangle(cr, FOLD, 0.0, CARD_WIDTH - FOLD, CARD_HEIGHT);
	ink(cr, LOOK_PAPER, 1.0);
	cairo_fill(cr);
	cairo_set_line_width(cr, 1.5);
	for (double x = FOLD + 0.5 * DOTS_PER_10_MM; x < CARD_WIDTH; x += 0.5 * DOTS_PER_10_MM) {
		cairo_move_to(cr, x, 0.0);
		cairo_line_to(cr, x, CARD_HEIGHT);
	}
	for (double y = 0.5 * DOTS_PER_10_MM; y < CARD_HEIGHT; y += 0.5 * DOTS_PER_10_MM) {
		cairo_move_to(cr, FOLD, y);
		cairo_line_to(cr, CARD_WIDTH, y);
	}
	ink(cr, LOOK_GRID, 0.6);
	cairo_stroke(cr);
	cairo_rectangle(cr, FOLD, 0.0, 3.0, CARD_HEIGHT);
	ink(cr, LOOK_ROOM_DARK, 1.0);
	cairo_fill(cr);
}

static void paint_words(const struct press *press, const char *text, double x, double y,
			double size, bool bold, uint32_t colour, double width_max)
{
	struct style style = {size, bold, colour, ALIGN_LEFT, width_max};
	draw_text(press->cr, press->type, text, x, y, &style);
}

static void paint_head(const struct press *press)
{
	double x = FOLD + MARGIN, right = CARD_WIDTH - MARGIN;
	paint_words(press, "着付け", x, 112.0, 68.0, true, LOOK_INK, 0.0);
	paint_words(press, "kitsuke", x + 226.0, 110.0, 38.0, false, LOOK_INK_GREY, 0.0);
	struct style date = {34.0, false, LOOK_INK, ALIGN_CENTRE, 220.0};
	draw_text(press->cr, press->type, press->card->date, right - 110.0, 106.0, &date);
	cairo_rectangle(press->cr, x, 144.0, right - x, 4.0);
	ink(press->cr, LOOK_WRAP, 1.0);
	cairo_fill(press->cr);
}

/* ---- the pattern ---- */

static struct v2 on_card(const struct press *press, const struct piece *piece, struct v2 local_mm)
{
	struct v2 mm = piece_to_sheet(piece, local_mm);
	return (struct v2){(float)(press->left + (double)(mm.x - press->low_mm.x) * press->scale),
			   (float)(press->top + (double)(press->high_mm.y - mm.y) * press->scale)};
}

/* All pieces as they lie on the sheet, as large as fits. */
static bool lay_out(struct press *press)
{
	const struct pattern *pattern = press->card->pattern;
	struct v2 low = {1e9f, 1e9f}, high = {-1e9f, -1e9f};
	for (int p = 0; p < PIECES_MAX; p++)
		for (int i = 0; pattern->piece[p].used && i < pattern->piece[p].point_count; i++) {
			struct v2 at = piece_to_sheet(&pattern->piece[p],
						      pattern->piece[p].point_mm[i]);
			low = (struct v2){float_min(low.x, at.x), float_min(low.y, at.y)};
			high = (struct v2){float_max(high.x, at.x), float_max(high.y, at.y)};
		}
	if (low.x > high.x)
		return false;
	double room = CARD_WIDTH - FOLD - 2 * MARGIN;
	double wide = (double)float_max(high.x - low.x, 1.0f);
	double tall = (double)float_max(high.y - low.y, 1.0f);
	double by_width = room / wide, by_height = PATTERN_HEIGHT / tall;
	press->scale = by_width < by_height ? by_width : by_height;
	press->left = FOLD + MARGIN + 0.5 * (room - press->scale * wide);
	press->top = PATTERN_TOP + 0.5 * (PATTERN_HEIGHT - press->scale * tall);
	press->low_mm = low;
	press->high_mm = high;
	return true;
}

static void path_piece(const struct press *press, const struct piece *piece)
{
	cairo_new_path(press->cr);
	for (int i = 0; i < piece->point_count; i++)
		line_to(press->cr, on_card(press, piece, piece->point_mm[i]));
	cairo_close_path(press->cr);
}

static void paint_piece(const struct press *press, const struct piece *piece)
{
	cairo_t *cr = press->cr;
	uint32_t colour = (piece->inside_up ? look_inside
					    : look_outside)[piece->swatch & (SWATCHES - 1)];
	for (int i = 3; i > 0; i--) { /* a soft shadow */
		cairo_save(cr);
		cairo_translate(cr, 1.6 * i, 2.2 * i);
		path_piece(press, piece);
		cairo_restore(cr);
		cairo_set_source_rgba(cr, 0.24, 0.19, 0.12, 0.06);
		cairo_fill(cr);
	}
	path_piece(press, piece);
	ink(cr, colour, 1.0);
	cairo_fill_preserve(cr);
	cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
	cairo_set_line_width(cr, 3.2);
	ink(cr, LOOK_INK, 1.0);
	cairo_stroke(cr);
}

/* Stitches along an edge that is sewn, inside of it. */
static void paint_stitches(const struct press *press, struct edge_ref edge)
{
	static const double dash[] = {9.0, 7.0};
	const struct piece *piece = &press->card->pattern->piece[edge.piece];
	cairo_t *cr = press->cr;
	int at, last;
	piece_edge(piece, edge.edge, &at, &last);
	cairo_save(cr);
	path_piece(press, piece);
	cairo_clip(cr);
	move_to(cr, on_card(press, piece, piece->point_mm[at]));
	do {
		at = (at + 1) % piece->point_count;
		line_to(cr, on_card(press, piece, piece->point_mm[at]));
	} while (at != last);
	cairo_path_t *path = cairo_copy_path(cr);
	cairo_set_line_width(cr, 17.0); /* all but the inner rim is covered again */
	cairo_set_dash(cr, dash, 2, 0.0);
	ink(cr, 0xffffff, 0.85);
	cairo_stroke(cr);
	cairo_set_dash(cr, NULL, 0, 0.0);
	cairo_append_path(cr, path);
	cairo_set_line_width(cr, 11.0);
	ink(cr, (piece->inside_up ? look_inside : look_outside)[piece->swatch & (SWATCHES - 1)],
	    1.0);
	cairo_stroke_preserve(cr);
	cairo_set_line_width(cr, 3.2);
	ink(cr, LOOK_INK, 1.0);
	cairo_stroke(cr);
	cairo_path_destroy(path);
	cairo_restore(cr);
}

static bool has_partner(const struct marks *marks, int number)
{
	for (int m = 0; m < MARKS_MAX; m++)
		if (marks->body[m].used && marks->body[m].number == number)
			return true;
	return false;
}

static void paint_mark(const struct press *press, const struct cloth_mark *mark)
{
	cairo_t *cr = press->cr;
	const struct piece *piece = &press->card->pattern->piece[mark->piece];
	const struct mark_style *style = look_mark_style(mark->number);
	double dash[4];
	for (int k = 0; k < 4; k++)
		dash[k] = 0.7 * (double)style->dash_px[k];
	for (int round = 0; round < 2; round++) { /* a white halo, then the line */
		cairo_new_path(cr);
		for (int i = 0; i < mark->point_count; i++)
			line_to(cr, on_card(press, piece, mark->point_mm[i]));
		cairo_set_line_cap(cr, CAIRO_LINE_CAP_ROUND);
		cairo_set_line_width(cr, round ? 5.0 : 10.0);
		cairo_set_dash(cr, dash, round && dash[0] > 0.0 ? 4 : 0, 0.0);
		ink(cr, round ? style->colour : 0xffffff, round ? 1.0 : 0.9);
		cairo_stroke(cr);
	}
	cairo_set_dash(cr, NULL, 0, 0.0);
	struct v2 start = on_card(press, piece, mark->point_mm[0]);
	draw_number(cr, press->type, mark->number, (double)start.x, (double)start.y, 14.0,
		    has_partner(press->card->marks, mark->number));
}

/* How large the pieces are: the longest of these that takes a fifth of the width at most. */
static void paint_measure(const struct press *press)
{
	static const struct {
		double mm;
		const char *words;
	} length[] = {{500.0, "50 cm"}, {200.0, "20 cm"}, {100.0, "10 cm"},
		      {50.0, "5 cm"},   {20.0, "2 cm"},   {10.0, "1 cm"}};
	cairo_t *cr = press->cr;
	double x = FOLD + MARGIN, y = PATTERN_TOP + PATTERN_HEIGHT + 35.0;
	int at = 0;
	while (at + 1 < COUNT_OF(length) && length[at].mm * press->scale > 200.0)
		at++;
	double wide = length[at].mm * press->scale;
	if (wide > 400.0)
		return;
	cairo_move_to(cr, x, y - 9.0);
	cairo_line_to(cr, x, y + 9.0);
	cairo_move_to(cr, x, y);
	cairo_line_to(cr, x + wide, y);
	cairo_move_to(cr, x + wide, y - 9.0);
	cairo_line_to(cr, x + wide, y + 9.0);
	cairo_set_line_width(cr, 3.0);
	ink(cr, LOOK_INK_GREY, 1.0);
	cairo_stroke(cr);
	struct style style = {24.0, false, LOOK_INK_GREY, ALIGN_LEFT, 0.0};
	draw_text(cr, press->type, length[at].words, x + wide + 14.0, y + 8.0, &style);
}

static void paint_pattern(struct press *press)
{
	const struct pattern *pattern = press->card->pattern;
	if (!lay_out(press))
		return;
	for (int p = 0; p < PIECES_MAX; p++)
		if (pattern->piece[p].used)
			paint_piece(press, &pattern->piece[p]);
	for (int s = 0; s < SEAMS_MAX; s++)
		if (pattern->seam[s].used) {
			paint_stitches(press, pattern->seam[s].a);
			paint_stitches(press, pattern->seam[s].b);
		}
	for (int m = 0; m < MARKS_MAX; m++)
		if (press->card->marks->cloth[m].used)
			paint_mark(press, &press->card->marks->cloth[m]);
	paint_measure(press);
}

/* ---- the code, and what it is ---- */

struct line {
	const char *text;
	double size, step;
	bool bold;
	uint32_t colour;
};

static void paint_lines(const struct press *press, const struct line *line, int count, double x,
			double y, double width)
{
	for (int i = 0; i < count; i++) {
		y += line[i].step;
		paint_words(press, line[i].text, x, y, line[i].size, line[i].bold, line[i].colour,
			    width);
	}
}

static void paint_code(const struct press *press)
{
	static const struct line words[] = {
		{"このQRに、", 38.0, 0.0, true, LOOK_INK},
		{"型紙がそのまま", 38.0, 54.0, true, LOOK_INK},
		{"入っています", 38.0, 54.0, true, LOOK_INK},
		{"The pattern itself", 28.0, 58.0, false, LOOK_INK_GREY},
		{"is in this code.", 28.0, 38.0, false, LOOK_INK_GREY},
		{"kitsuke import", 24.0, 54.0, true, LOOK_INK_GREY},
		{"でまた着せられます", 24.0, 34.0, false, LOOK_INK_GREY},
		{"puts it on again", 24.0, 34.0, false, LOOK_INK_GREY},
	};
	double side = QR_SIDE;
	const struct card *card = press->card;
	round_box(press->cr, QR_LEFT - 6.0, QR_TOP - 6.0, side + 12.0, side + 12.0, 22.0);
	ink(press->cr, 0xffffff, 1.0);
	cairo_fill_preserve(press->cr);
	cairo_set_line_width(press->cr, 2.0);
	ink(press->cr, LOOK_GRID_50, 1.0);
	cairo_stroke(press->cr);
	qr_paint(press->cr, card->qr, card->qr_modules, QR_LEFT, QR_TOP, side);
	paint_lines(press, words, COUNT_OF(words), FOLD + MARGIN, QR_TOP + 46.0,
		    QR_LEFT - FOLD - MARGIN - 30.0);
}

/* Too large for any code that a phone still reads: the files carry it. */
static void paint_no_code(const struct press *press)
{
	static const struct line words[] = {
		{"この型紙は大きくて、QRに入りません", 36.0, 0.0, true, LOOK_INK},
		{"This pattern is too large for a QR code", 28.0, 48.0, false, LOOK_INK_GREY},
		{"このPNGファイルと、となりのファイルに入っています", 28.0, 76.0, true, LOOK_INK},
		{"It is in this picture's file, and in the file beside it:", 26.0, 42.0, false,
		 LOOK_INK_GREY},
	};
	double width = CARD_WIDTH - FOLD - 2 * MARGIN;
	round_box(press->cr, FOLD + MARGIN, QR_TOP + 30.0, width, 340.0, 22.0);
	ink(press->cr, LOOK_HINT, 1.0);
	cairo_fill_preserve(press->cr);
	cairo_set_line_width(press->cr, 3.0);
	ink(press->cr, LOOK_HINT_RIM, 1.0);
	cairo_stroke(press->cr);
	paint_lines(press, words, COUNT_OF(words), FOLD + MARGIN + 30.0, QR_TOP + 96.0,
		    width - 60.0);
	paint_words(press, press->card->file, FOLD + MARGIN + 30.0, QR_TOP + 320.0, 30.0, true,
		    LOOK_INK, width - 60.0);
}

static void paint_card(struct press *press)
{
	double floor = CARD_HEIGHT - 20.0;
	paint_room(press);
	paint_portrait(press, 1, FOLD - 150.0, floor - 92.0, 0.42);
	paint_portrait(press, 0, 370.0, floor, 1.0);
	paint_paper(press);
	paint_head(press);
	paint_pattern(press);
	if (press->card->qr_modules > 0)
		paint_code(press);
	else
		paint_no_code(press);
	paint_words(press, press->card->station, FOLD + MARGIN, CARD_HEIGHT - MARGIN, 28.0, true,
		    LOOK_INK, QR_LEFT - FOLD - MARGIN - 30.0);
}

bool card_paint(const struct card *card, unsigned char *pixels, int width, char fault[200])
{
	struct press press = {.card = card, .type = type_open(fault)};
	if (!press.type)
		return false;
	cairo_surface_t *surface = cairo_image_surface_create_for_data(
		pixels, CAIRO_FORMAT_RGB24, width, card_height(width), width * 4);
	press.cr = cairo_create(surface);
	cairo_scale(press.cr, (double)width / CARD_WIDTH, (double)width / CARD_WIDTH);
	paint_card(&press);
	bool painted = cairo_status(press.cr) == CAIRO_STATUS_SUCCESS;
	if (!painted)
		snprintf(fault, 200, "no memory for a card of %d pixels", width);
	cairo_surface_flush(surface);
	cairo_destroy(press.cr);
	cairo_surface_destroy(surface);
	type_close(press.type);
	return painted;
}
