#include "draw_piece.h"

#include <stdio.h>
#include <stdlib.h>

static const struct v2 no_shift = {0.0f, 0.0f};

/* ---- woven cloth ---- */

struct cloth_paint {
	cairo_pattern_t *weave[SWATCHES][2]; /* outside, inside */
};

/* One repeat of a plain weave: two short threads, a shade darker; the reverse, seen from where the
 * weft floats, is a twill. Small enough to read as texture, too large to shimmer. */
static cairo_pattern_t *weave(uint32_t colour, bool inside, double unit)
{
	int size = (int)(6.0 * unit + 0.5) < 4 ? 4 : (int)(6.0 * unit + 0.5);
	double quarter = 0.25 * size;
	cairo_surface_t *tile = cairo_image_surface_create(CAIRO_FORMAT_RGB24, size, size);
	cairo_t *cr = cairo_create(tile);
	ink(cr, colour, 1.0);
	cairo_paint(cr);
	bool dark = (colour >> 8 & 255) < 0x60;
	ink(cr, colour_mix(colour, dark ? 0xffffff : 0x000000, inside ? 0.07 : 0.11), 1.0);
	cairo_set_line_width(cr, 0.2 * size);
	if (inside) {
		for (int i = -1; i <= 1; i++) {
			cairo_move_to(cr, (i - 0.25) * size, 1.25 * size);
			cairo_line_to(cr, (i + 1.25) * size, -0.25 * size);
		}
	} else {
		cairo_move_to(cr, 0.0, quarter);
		cairo_line_to(cr, 0.5 * size, quarter);
		cairo_move_to(cr, 0.5 * size, 3.0 * quarter);
		cairo_line_to(cr, size, 3.0 * quarter);
	}
	cairo_stroke(cr);
	cairo_destroy(cr);
	cairo_pattern_t *pattern = cairo_pattern_create_for_surface(tile);
	cairo_pattern_set_extend(pattern, CAIRO_EXTEND_REPEAT);
	cairo_pattern_set_filter(pattern, CAIRO_FILTER_NEAREST);
	cairo_surface_destroy(tile);
	return pattern;
}

struct cloth_paint *cloth_paint_open(double unit)
{
	struct cloth_paint *paint = calloc(1, sizeof *paint);
	for (int s = 0; paint && s < SWATCHES; s++) {
		paint->weave[s][0] = weave(look_outside[s], false, unit);
		paint->weave[s][1] = weave(look_inside[s], true, unit);
	}
	return paint;
}

void cloth_paint_close(struct cloth_paint *paint)
{
	if (!paint)
		return;
	for (int s = 0; s < SWATCHES; s++)
		for (int side = 0; side < 2; side++)
			cairo_pattern_destroy(paint->weave[s][side]);
	free(paint);
}

/* ---- geometry on the screen ---- */

static void path_outline(const struct easel *easel, const struct piece *piece, struct v2 shift_mm)
{
	cairo_new_path(easel->cr);
	for (int i = 0; i < piece->point_count; i++)
		line_to(easel->cr, local_px(easel, piece, piece->point_mm[i], shift_mm));
	cairo_close_path(easel->cr);
}

struct rect piece_area(const struct easel *easel, int piece, struct v2 shift_mm)
{
	struct v2 low, high;
	int margin = (int)(104.0 * easel->unit), words = (int)(150.0 * easel->unit);
	piece_bounds(piece_of(easel, piece), &low, &high);
	low = view_sheet_px(&easel->ui->view, v2_add(low, shift_mm));
	high = view_sheet_px(&easel->ui->view, v2_add(high, shift_mm));
	int aside = int_max(margin, words - (int)(0.5f * (high.x - low.x)));
	return (struct rect){(int)low.x - aside, (int)high.y - margin,
			     (int)(high.x - low.x) + 2 * aside, (int)(low.y - high.y) + 2 * margin};
}

/* ---- a piece ---- */

static void draw_shadow(const struct easel *easel, const struct piece *piece, struct v2 shift_mm,
			bool raised)
{
	cairo_t *cr = easel->cr;
	double u = easel->unit, lift = raised ? 2.2 : 1.0;
	for (int i = 0; i < 3; i++) {
		cairo_save(cr);
		cairo_translate(cr, (1.5 + 2.0 * i) * lift * u, (2.5 + 2.6 * i) * lift * u);
		path_outline(easel, piece, shift_mm);
		cairo_restore(cr);
		cairo_set_source_rgba(cr, 0.24, 0.19, 0.12, 0.055);
		cairo_fill(cr);
	}
}

static void fill_cloth(const struct easel *easel, const struct piece *piece, struct v2 shift_mm)
{
	cairo_t *cr = easel->cr;
	struct v2 origin = local_px(easel, piece, no_shift, shift_mm);
	cairo_matrix_t matrix;
	cairo_pattern_t *pattern =
		easel->paint->weave[piece->swatch & (SWATCHES - 1)][piece->inside_up];
	cairo_matrix_init_translate(&matrix, -(double)(int)origin.x, -(double)(int)origin.y);
	cairo_pattern_set_matrix(pattern, &matrix);
	path_outline(easel, piece, shift_mm);
	cairo_set_source(cr, pattern);
	cairo_fill(cr);
}

static void stroke_outline(const struct easel *easel, const struct piece *piece, struct v2 shift_mm,
			   bool selected, bool refused)
{
	cairo_t *cr = easel->cr;
	double u = easel->unit;
	cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
	if (selected) {
		path_outline(easel, piece, shift_mm);
		cairo_set_line_width(cr, 13.0 * u);
		ink(cr, LOOK_HINT_RIM, 0.75);
		cairo_stroke(cr);
	}
	path_outline(easel, piece, shift_mm);
	cairo_set_line_width(cr, (refused ? 5.0 : 3.4) * u);
	ink(cr, refused ? LOOK_WRAP : LOOK_INK, 1.0);
	cairo_stroke(cr);
}

/* Where edges end: while sewing they are what the hand aims between. */
static void draw_corners(const struct easel *easel, const struct piece *piece, struct v2 shift_mm)
{
	cairo_t *cr = easel->cr;
	double u = easel->unit;
	for (int i = 0; i < piece->point_count; i++) {
		if (!piece->corner[i])
			continue;
		struct v2 at = local_px(easel, piece, piece->point_mm[i], shift_mm);
		disc(cr, (double)at.x, (double)at.y, 5.0 * u);
		ink(cr, 0xffffff, 1.0);
		cairo_fill_preserve(cr);
		cairo_set_line_width(cr, 2.4 * u);
		ink(cr, LOOK_INK, 1.0);
		cairo_stroke(cr);
	}
}

static bool has_partner(const struct session *session, int number)
{
	for (int m = 0; m < MARKS_MAX; m++)
		if (session->document.marks.body[m].used &&
		    session->document.marks.body[m].number == number)
			return true;
	return false;
}

static void draw_mark(const struct easel *easel, const struct cloth_mark *mark, struct v2 shift_mm)
{
	cairo_t *cr = easel->cr;
	double u = easel->unit, dash[4];
	const struct piece *piece = piece_of(easel, mark->piece);
	const struct mark_style *style = look_mark_style(mark->number);
	bool doubled = look_mark_doubled(mark->number), dashed = style->dash_px[0] > 0.0f;
	cairo_new_path(cr);
	for (int i = 0; i < mark->point_count; i++)
		line_to(cr, local_px(easel, piece, mark->point_mm[i], shift_mm));
	cairo_set_line_cap(cr, CAIRO_LINE_CAP_ROUND);
	cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
	cairo_set_line_width(cr, (doubled ? 12.5 : 9.5) * u);
	ink(cr, 0xffffff, 0.85);
	cairo_stroke_preserve(cr);
	for (int i = 0; i < 4; i++)
		dash[i] = (double)style->dash_px[i] * u;
	if (dashed)
		cairo_set_dash(cr, dash, 4, 0.0);
	cairo_set_line_width(cr, (doubled ? 8.0 : 5.0) * u);
	ink(cr, style->colour, 1.0);
	if (doubled) {
		cairo_stroke_preserve(cr);
		cairo_set_dash(cr, NULL, 0, 0.0);
		cairo_set_line_width(cr, 2.6 * u);
		ink(cr, 0xffffff, 1.0);
	}
	cairo_stroke(cr);
	cairo_set_dash(cr, NULL, 0, 0.0);
	struct v2 start = local_px(easel, piece, mark->point_mm[0], shift_mm);
	draw_number(cr, easel->type, mark->number, (double)start.x, (double)start.y, 17.0 * u,
		    has_partner(easel->session, mark->number));
}

/* Pieces drawn here are named by number; one that shows its reverse may say so. */
static void name_text(const struct easel *easel, int p, bool say_side, char *text, size_t size)
{
	const struct piece *piece = piece_of(easel, p);
	const struct phrase *cloth = &text_phrase[TEXT_CLOTH],
			    *inside = &text_phrase[TEXT_INSIDE_UP];
	enum language language = easel->ui->language;
	bool named = piece->name[0] && strncmp(piece->name, "piece-", 6) != 0;
	const char *ja = language == LANGUAGE_ENGLISH ? "" : cloth->japanese;
	const char *en = language == LANGUAGE_JAPANESE ? "" : cloth->english;
	const char *gap = language == LANGUAGE_BOTH ? " " : "";
	char side[64] = "";
	if (say_side && language == LANGUAGE_BOTH)
		snprintf(side, sizeof side, "（%s %s）", inside->japanese, inside->english);
	else if (say_side)
		snprintf(side, sizeof side, "（%s）",
			 language == LANGUAGE_JAPANESE ? inside->japanese : inside->english);
	if (named)
		snprintf(text, size, "%.*s%s", NAME_BYTES_MAX, piece->name, side);
	else
		snprintf(text, size, "%s%s%s %d%s", ja, gap, en, p + 1, side);
}

/* Room for words, at a guess that errs on the wide side: Japanese fills its square. */
static float words_width(const char *text, float size_px)
{
	float width = 0.0f;
	for (; *text; text++) {
		unsigned char byte = (unsigned char)*text;
		width += byte >= 0xe0 ? 1.0f : byte < 0x80 ? 0.6f : 0.0f;
	}
	return width * size_px;
}

struct words_place {
	bool inside;  /* all of it on its own piece */
	bool crowded; /* some of it on another piece */
};

/* A line of words as a row of places. */
static struct words_place words_place(const struct easel *easel, int p, struct v2 centre_px,
				      float width_px, struct v2 shift_mm)
{
	enum { PLACES = 7 };
	struct words_place found = {true, false};
	for (int i = 0; i < PLACES; i++) {
		float t = (float)i / (float)(PLACES - 1) - 0.5f;
		struct v2 at_px = {centre_px.x + t * width_px, centre_px.y};
		struct v2 at_mm = view_sheet_mm(&easel->ui->view, at_px);
		for (int q = 0; q < PIECES_MAX; q++) {
			const struct piece *piece = piece_of(easel, q);
			if (!piece->used)
				continue;
			struct v2 place = q == p ? v2_sub(at_mm, shift_mm) : at_mm;
			bool over = piece_contains(piece, piece_from_sheet(piece, place));
			found.inside = found.inside && (q != p || over);
			found.crowded = found.crowded || (q != p && over);
		}
	}
	return found;
}

static bool boxed(const struct easel *easel, int p)
{
	const struct ui *ui = easel->ui;
	return ui->step == STEP_DRAW && ui->drawing == DRAW_PENCIL && ui->piece == p &&
	       ui->gesture != GESTURE_MOVE && ui->gesture != GESTURE_PIECE;
}

/* Under the piece, where paper is free; on its cloth above the hem otherwise. */
void draw_name(const struct easel *easel, int p, struct v2 shift_mm)
{
	const struct piece *piece = piece_of(easel, p);
	float u = (float)easel->unit, size = 22.0f * u;
	char text[160];
	struct v2 low, high;
	name_text(easel, p, piece->inside_up, text, sizeof text);
	piece_bounds(piece, &low, &high);
	struct v2 hem = view_sheet_px(
		&easel->ui->view, v2_add((struct v2){0.5f * (low.x + high.x), low.y}, shift_mm));
	struct rect pane = easel->ui->view.sheet_pane;
	float lowest = (float)(pane.y + pane.h) - 13.0f * u;
	float under = boxed(easel, p) ? 64.0f : 26.0f; /* or its grips' frame */
	struct v2 below = {hem.x, float_min(hem.y + under * u, lowest)};
	struct v2 above = {hem.x, hem.y - 24.0f * u};
	float width = words_width(text, size);
	struct style style = {(double)size, false, LOOK_INK_GREY, ALIGN_CENTRE, 0.0};
	bool free = below.y - hem.y > 16.0f * u &&
		    !words_place(easel, p, below, width, shift_mm).crowded;
	struct v2 at = below;
	bool inside = words_place(easel, p, above, width, shift_mm).inside;
	if (!free && !inside) { /* the reverse shows which side it is, too */
		name_text(easel, p, false, text, sizeof text);
		width = words_width(text, size);
		inside = words_place(easel, p, above, width, shift_mm).inside;
	}
	if (!free && inside) {
		uint32_t cloth = (piece->inside_up ? look_inside
						   : look_outside)[piece->swatch & (SWATCHES - 1)];
		style.colour = (cloth >> 8 & 255) < 0x70 ? 0xf6f2ea : LOOK_INK;
		at = above;
	}
	draw_text(easel->cr, easel->type, text, (double)at.x, (double)(at.y + 8.0f * u), &style);
}

void draw_piece(const struct easel *easel, int p, struct v2 shift_mm, bool raised)
{
	const struct piece *piece = piece_of(easel, p);
	const struct shaping *shaping = &easel->ui->shaping;
	bool selected = easel->ui->piece == p && easel->ui->step == STEP_DRAW;
	bool refused = shaping->shows && shaping->fault && (shaping->changed >> p & 1);
	draw_shadow(easel, piece, shift_mm, raised);
	fill_cloth(easel, piece, shift_mm);
	stroke_outline(easel, piece, shift_mm, selected, refused);
	if (easel->ui->step == STEP_SEW || (selected && easel->ui->drawing == DRAW_PENCIL))
		draw_corners(easel, piece, shift_mm);
	if (piece->symmetric && easel->ui->step == STEP_DRAW && easel->ui->gesture != GESTURE_MOVE)
		draw_axis(easel, p);
	for (int m = 0; m < MARKS_MAX; m++) {
		const struct cloth_mark *mark =
			&shown_document(easel->ui, easel->session)->marks.cloth[m];
		if (mark->used && mark->piece == p && mark->point_count > 0)
			draw_mark(easel, mark, shift_mm);
	}
}

void draw_pins(const struct easel *easel)
{
	cairo_t *cr = easel->cr;
	double u = easel->unit;
	for (int p = 0; p < PINS_MAX; p++) {
		const struct pin *pin = &easel->session->document.pin[p];
		if (!pin->used || !piece_used(easel->session, pin->piece))
			continue;
		struct v2 at = local_px(easel, piece_of(easel, pin->piece), pin->point_mm,
					no_shift);
		cairo_move_to(cr, (double)at.x, (double)at.y);
		cairo_rel_line_to(cr, 0.0, -14.0 * u);
		cairo_set_line_width(cr, 3.0 * u);
		ink(cr, 0x7d4463, 1.0);
		cairo_stroke(cr);
		disc(cr, (double)at.x, (double)at.y - 20.0 * u, 11.0 * u);
		ink(cr, LOOK_PIN, 1.0);
		cairo_fill_preserve(cr);
		cairo_set_line_width(cr, 3.0 * u);
		ink(cr, 0xffffff, 1.0);
		cairo_stroke(cr);
	}
}
