/* The right pane. Three pictures of the same size lie over one another:
 *
 *   paper   grid and ruler; drawn again when the scale changes
 *   still   paper, pieces, seams, marks and the stroke being drawn, which only ever grows
 *   out     still, and what follows the pen: ring, highlighted edge, piece being moved
 *
 * The layer is `out`. A moving pen costs the rectangle it has left and the one it is in.
 */
#include "draw_layer.h"
#include "draw_piece.h"
#include "tool.h"

#include <stdio.h>
#include <stdlib.h>

struct canvas {
	cairo_surface_t *surface;
	cairo_t *cr;
};

struct sheet {
	struct layer layer;
	struct type *type;
	struct cloth_paint *paint;
	double unit;
	struct canvas paper, still, out;
	uint64_t paper_hash, still_hash, live_hash;
	int ink_count;         /* samples of the stroke already drawn */
	struct rect ink_area;  /* what the stroke covers; screen pixels */
	struct rect live_area; /* what follows the pen covers */
};

/* ---- rectangles, in screen pixels ---- */

static struct rect join(struct rect a, struct rect b)
{
	if (a.w <= 0)
		return b;
	if (b.w <= 0)
		return a;
	int right = int_max(a.x + a.w, b.x + b.w), bottom = int_max(a.y + a.h, b.y + b.h);
	int x = int_min(a.x, b.x), y = int_min(a.y, b.y);
	return (struct rect){x, y, right - x, bottom - y};
}

static struct rect within(struct rect a, struct rect outer)
{
	int x = int_max(a.x, outer.x), y = int_max(a.y, outer.y);
	int right = int_min(a.x + a.w, outer.x + outer.w);
	int bottom = int_min(a.y + a.h, outer.y + outer.h);
	return (struct rect){x, y, int_max(right - x, 0), int_max(bottom - y, 0)};
}

static struct rect around(struct v2 a, struct v2 b, double margin)
{
	double x = (double)float_min(a.x, b.x) - margin, y = (double)float_min(a.y, b.y) - margin;
	double right = (double)float_max(a.x, b.x) + margin;
	double bottom = (double)float_max(a.y, b.y) + margin;
	return (struct rect){(int)x - 1, (int)y - 1, (int)(right - x) + 3, (int)(bottom - y) + 3};
}

static void clip_to(cairo_t *cr, struct rect area)
{
	cairo_save(cr);
	cairo_rectangle(cr, area.x, area.y, area.w, area.h);
	cairo_clip(cr);
}

static void add_damage(struct sheet *sheet, struct rect area)
{
	struct layer *layer = &sheet->layer;
	struct rect rect = within(area, layer->area);
	if (rect.w <= 0 || rect.h <= 0)
		return;
	rect.x -= layer->area.x;
	rect.y -= layer->area.y;
	int last = LAYER_DAMAGE_MAX - 1;
	if (layer->damage_count > last)
		layer->damage[last] = join(layer->damage[last], rect);
	else
		layer->damage[layer->damage_count++] = rect;
}

/* ---- paper ---- */

/* Squares of 10 mm, or of the next round size that does not blur into grey. */
static double grid_mm(const struct sheet *sheet, const struct view *view)
{
	static const double size[] = {10, 20, 50, 100, 200, 500, 1000};
	int i = 0;
	while (i < COUNT_OF(size) - 1 &&
	       size[i] * (double)view->sheet_px_per_mm < 9.0 * sheet->unit)
		i++;
	return size[i];
}

static void grid_lines(cairo_t *cr, const struct view *view, double step_mm, uint32_t colour)
{
	struct rect pane = view->sheet_pane;
	struct v2 low = view_sheet_mm(view, (struct v2){(float)pane.x, (float)(pane.y + pane.h)});
	struct v2 high = view_sheet_mm(view, (struct v2){(float)(pane.x + pane.w), (float)pane.y});
	int first = (int)((double)low.x / step_mm) - 1, last = (int)((double)high.x / step_mm) + 1;
	for (int i = first; i <= last; i++) {
		struct v2 at = view_sheet_px(view, (struct v2){(float)(i * step_mm), 0.0f});
		cairo_rectangle(cr, (double)(int)at.x, pane.y, 1.0, pane.h);
	}
	first = (int)((double)low.y / step_mm) - 1;
	last = (int)((double)high.y / step_mm) + 1;
	for (int i = first; i <= last; i++) {
		struct v2 at = view_sheet_px(view, (struct v2){0.0f, (float)(i * step_mm)});
		cairo_rectangle(cr, pane.x, (double)(int)at.y, pane.w, 1.0);
	}
	ink(cr, colour, 1.0);
	cairo_fill(cr);
}

/* A hundred millimetres of cloth, or the next round length that can be read. */
static void draw_ruler(const struct sheet *sheet, cairo_t *cr, const struct view *view)
{
	static const int length_mm[] = {100, 200, 500, 1000, 2000};
	double u = sheet->unit, scale = (double)view->sheet_px_per_mm;
	int i = 0;
	while (i < COUNT_OF(length_mm) - 1 && length_mm[i] * scale < 44.0 * u)
		i++;
	struct rect pane = view->sheet_pane;
	double x = pane.x + 40.0 * u, y = pane.y + pane.h - 34.0 * u, w = length_mm[i] * scale;
	cairo_move_to(cr, x, y - 9.0 * u);
	cairo_line_to(cr, x, y + 9.0 * u);
	cairo_move_to(cr, x, y);
	cairo_line_to(cr, x + w, y);
	cairo_move_to(cr, x + w, y - 9.0 * u);
	cairo_line_to(cr, x + w, y + 9.0 * u);
	cairo_set_line_width(cr, 3.0 * u);
	ink(cr, LOOK_INK_GREY, 1.0);
	cairo_stroke(cr);
	char text[16];
	snprintf(text, sizeof text, "%d mm", length_mm[i]);
	struct style style = {19.0 * u, false, LOOK_INK_GREY, ALIGN_LEFT, 0.0};
	draw_text(cr, sheet->type, text, x + w + 12.0 * u, y + 7.0 * u, &style);
}

static void draw_paper(const struct sheet *sheet, const struct view *view)
{
	cairo_t *cr = sheet->paper.cr;
	struct rect pane = view->sheet_pane;
	double step_mm = grid_mm(sheet, view);
	ink(cr, LOOK_PAPER, 1.0);
	cairo_paint(cr);
	grid_lines(cr, view, step_mm, colour_mix(LOOK_GRID, LOOK_PAPER, 0.45));
	grid_lines(cr, view, 5.0 * step_mm, LOOK_GRID_50);
	draw_ruler(sheet, cr, view);
	cairo_rectangle(cr, pane.x, pane.y, 3.0 * sheet->unit, pane.h);
	ink(cr, 0xb9ae9a, 1.0);
	cairo_fill(cr);
}

static uint64_t view_hash(const struct view *view)
{
	struct hash hash;
	hash_init(&hash);
	hash_float(&hash, view->sheet_centre_mm.x);
	hash_float(&hash, view->sheet_centre_mm.y);
	hash_float(&hash, view->sheet_px_per_mm);
	return hash.value;
}

/* ---- still ---- */

static int moving_piece(const struct ui *ui)
{
	return ui->gesture == GESTURE_MOVE ? ui->piece : -1;
}

static void draw_still(const struct sheet *sheet, const struct easel *screen, struct rect area)
{
	struct easel easel = *screen;
	const struct pattern *pattern = &easel.session->document.pattern;
	easel.cr = sheet->still.cr;
	clip_to(easel.cr, area);
	cairo_set_source_surface(easel.cr, sheet->paper.surface, 0.0, 0.0);
	cairo_paint(easel.cr);
	uint32_t done = 0;
	for (int n = 0; n < PIECES_MAX; n++) {
		int lowest = -1;
		for (int p = 0; p < PIECES_MAX; p++)
			if (pattern->piece[p].used && !(done >> p & 1) &&
			    (lowest < 0 || pattern->piece[p].layer < pattern->piece[lowest].layer))
				lowest = p;
		if (lowest < 0)
			break;
		done |= (uint32_t)1 << lowest;
		if (lowest != moving_piece(easel.ui))
			draw_piece(&easel, lowest, (struct v2){0.0f, 0.0f}, false);
	}
	if (moving_piece(easel.ui) < 0)
		draw_seams(&easel);
	draw_pins(&easel);
	cairo_restore(easel.cr);
}

static void hash_pieces(struct hash *hash, const struct pattern *pattern)
{
	for (int p = 0; p < PIECES_MAX; p++) {
		const struct piece *piece = &pattern->piece[p];
		if (!piece->used)
			continue;
		hash_int(hash, p + (piece->inside_up << 5) + (piece->swatch << 6));
		hash_int(hash, piece->layer);
		hash_float(hash, piece->position_mm.x);
		hash_float(hash, piece->position_mm.y);
		hash_float(hash, piece->turn_rad);
		for (int i = 0; i < piece->point_count; i++) {
			hash_float(hash, piece->point_mm[i].x);
			hash_float(hash, piece->point_mm[i].y);
		}
	}
	for (int s = 0; s < SEAMS_MAX; s++) {
		const struct seam *seam = &pattern->seam[s];
		if (!seam->used)
			continue;
		hash_int(hash, s * 2 + seam->swapped);
		hash_int(hash, seam->a.piece * 1024 + seam->a.edge);
		hash_int(hash, seam->b.piece * 1024 + seam->b.edge);
	}
}

static uint64_t still_hash(const struct ui *ui, const struct session *session)
{
	const struct document *document = &session->document;
	struct hash hash;
	hash_init(&hash);
	hash_pieces(&hash, &document->pattern);
	for (int m = 0; m < MARKS_MAX; m++) {
		const struct cloth_mark *mark = &document->marks.cloth[m];
		if (document->marks.body[m].used)
			hash_int(&hash, -document->marks.body[m].number);
		if (!mark->used)
			continue;
		hash_int(&hash, mark->number * 32 + mark->piece);
		hash_int(&hash, mark->point_count);
		for (int i = 0; i < mark->point_count; i++) {
			hash_float(&hash, mark->point_mm[i].x);
			hash_float(&hash, mark->point_mm[i].y);
		}
	}
	for (int p = 0; p < PINS_MAX; p++)
		if (document->pin[p].used)
			hash_float(&hash, document->pin[p].point_mm.x);
	hash_int(&hash, (int)ui->step);
	hash_int(&hash, (int)ui->language);
	hash_int(&hash, ui->piece);
	hash_int(&hash, ui->seam);
	hash_int(&hash, moving_piece(ui));
	hash_u32(&hash, (uint32_t)view_hash(&ui->view));
	return hash.value;
}

/* ---- ink: the stroke in progress ---- */

static bool inks(const struct ui *ui)
{
	bool sheet = ui->gesture == GESTURE_PIECE || ui->gesture == GESTURE_OVERSKETCH ||
		     ui->gesture == GESTURE_MARK_CLOTH;
	return sheet && ui->stroke_count > 1;
}

/* The sample without its tremor: the mean of it and the few before, so that what is drawn stays. */
static struct v2 ink_point(const struct ui *ui, int i)
{
	struct v2 sum = {0.0f, 0.0f};
	int first = int_max(i - 4, 0);
	for (int k = first; k <= i; k++)
		sum = v2_add(sum, ui->stroke_px[k]);
	return v2_scale(sum, 1.0f / (float)(i - first + 1));
}

static int next_number(const struct session *session)
{
	int number = 1;
	for (int m = 0; m < MARKS_MAX; m++)
		for (int k = 0; k < MARKS_MAX; k++)
			number += session->document.marks.cloth[k].used &&
				  session->document.marks.cloth[k].number == number;
	return number;
}

static void draw_ink(struct sheet *sheet, const struct ui *ui, const struct session *session)
{
	cairo_t *cr = sheet->still.cr;
	double u = sheet->unit;
	bool mark = ui->gesture == GESTURE_MARK_CLOTH;
	double width = (mark ? 5.0 : 3.0 + 1.6 * (double)ui->pen_pressure) * u;
	int first = int_max(sheet->ink_count - 1, 0);
	struct v2 last = ink_point(ui, first);
	struct rect fresh = around(last, last, width);
	if (ui->stroke_count <= sheet->ink_count)
		return;
	clip_to(cr, sheet->layer.area);
	move_to(cr, last);
	for (int i = first + 1; i < ui->stroke_count; i++) {
		struct v2 next = ink_point(ui, i);
		line_to(cr, next);
		fresh = join(fresh, around(last, next, width));
		last = next;
	}
	cairo_set_line_width(cr, width);
	cairo_set_line_cap(cr, CAIRO_LINE_CAP_ROUND);
	cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
	ink(cr, mark ? look_mark_style(next_number(session))->colour : LOOK_INK, 1.0);
	cairo_stroke(cr);
	cairo_restore(cr);
	sheet->ink_count = ui->stroke_count;
	sheet->ink_area = join(sheet->ink_area, fresh);
	add_damage(sheet, fresh);
}

/* ---- what follows the pen ---- */

/* The start of an outline is where it wants to end. */
static void draw_start(const struct sheet *sheet, const struct ui *ui)
{
	cairo_t *cr = sheet->out.cr;
	double u = sheet->unit;
	float gap = v2_distance(ui->start_px, ui->steady_px);
	float length = ui->stroke_count > 40 ? gap : 1e9f;
	bool near = length < tool_px(ui, 12.0f);
	disc(cr, (double)ui->start_px.x, (double)ui->start_px.y, (near ? 15.0 : 10.0) * u);
	ink(cr, near ? LOOK_RELAX : 0xffffff, near ? 0.35 : 0.8);
	cairo_fill_preserve(cr);
	cairo_set_line_width(cr, 3.0 * u);
	ink(cr, near ? LOOK_RELAX : LOOK_INK_GREY, 1.0);
	cairo_stroke(cr);
}

static void draw_sewing(const struct easel *easel)
{
	const struct ui *ui = easel->ui;
	cairo_t *cr = easel->cr;
	double u = easel->unit, dash[2] = {9.0 * u, 8.0 * u};
	struct edge_ref from = {ui->sew_from.piece, ui->sew_from.edge};
	struct edge_ref to = {ui->sew_to.piece, ui->sew_to.edge};
	if (!piece_used(easel->session, from.piece))
		return;
	draw_edge_glow(easel, from, LOOK_HINT_RIM);
	if (piece_used(easel->session, to.piece)) {
		draw_edge_glow(easel, to, LOOK_HINT_RIM);
		draw_zip(easel, from, to, false, 1.0);
		return;
	}
	move_to(cr, ui->start_px);
	line_to(cr, ui->steady_px);
	cairo_set_line_cap(cr, CAIRO_LINE_CAP_ROUND);
	cairo_set_dash(cr, dash, 2, 0.0);
	cairo_set_line_width(cr, 4.0 * u);
	ink(cr, LOOK_INK, 1.0);
	cairo_stroke(cr);
	cairo_set_dash(cr, NULL, 0, 0.0);
}

/* The pen's ring: as large as what it would reach, in the colour of what it would do. */
static void draw_ring(const struct easel *easel)
{
	const struct ui *ui = easel->ui;
	cairo_t *cr = easel->cr;
	double u = easel->unit, x = (double)ui->pen_px.x, y = (double)ui->pen_px.y;
	uint32_t colour = LOOK_INK;
	if (ui->step == STEP_MARK && !ui->erase && !ui->eraser) {
		int number = next_number(easel->session);
		colour = look_mark_style(number)->colour;
		draw_number(cr, easel->type, number, x + 26.0 * u, y - 24.0 * u, 12.0 * u, true);
	} else if (ui->pin_mode) {
		colour = LOOK_PIN;
	}
	double radius = ui->step == STEP_DRAW && ui->hover_piece < 0 ? 5.0 * u : 12.0 * u;
	disc(cr, x, y, radius);
	cairo_set_line_width(cr, 5.0 * u);
	ink(cr, 0xffffff, 0.9);
	cairo_stroke(cr);
	disc(cr, x, y, radius);
	cairo_set_line_width(cr, 2.4 * u);
	ink(cr, colour, 1.0);
	cairo_stroke(cr);
}

static bool hovers(const struct ui *ui)
{
	return ui->pen_state == PEN_HOVER && ui->hover_target == TARGET_NONE &&
	       rect_holds(ui->layout.right, ui->pen_px);
}

/* What draw_live will cover. */
static struct rect live_extent(const struct easel *easel)
{
	const struct ui *ui = easel->ui;
	const struct v2 none = {0.0f, 0.0f};
	double u = easel->unit;
	struct rect area = {0, 0, 0, 0};
	if (hovers(ui))
		area = around(ui->pen_px, ui->pen_px, 48.0 * u);
	if (hovers(ui) && ui->hover_edge >= 0 && piece_used(easel->session, ui->hover_piece))
		area = join(area, piece_area(easel, ui->hover_piece, none));
	if (ui->gesture == GESTURE_PIECE)
		area = join(area, around(ui->start_px, ui->start_px, 20.0 * u));
	if (ui->gesture == GESTURE_MOVE && piece_used(easel->session, ui->piece))
		area = join(area, piece_area(easel, ui->piece, ui->move_mm));
	if (ui->gesture == GESTURE_SEW && piece_used(easel->session, ui->sew_from.piece)) {
		area = join(area, piece_area(easel, ui->sew_from.piece, none));
		area = join(area, around(ui->start_px, ui->steady_px, 8.0 * u));
		if (piece_used(easel->session, ui->sew_to.piece))
			area = join(area, piece_area(easel, ui->sew_to.piece, none));
	}
	return within(area, ui->layout.right);
}

static void draw_live(const struct sheet *sheet, const struct easel *screen)
{
	struct easel easel = *screen;
	const struct ui *ui = easel.ui;
	easel.cr = sheet->out.cr;
	if (ui->gesture == GESTURE_MOVE && piece_used(easel.session, ui->piece))
		draw_piece(&easel, ui->piece, ui->move_mm, true);
	if (ui->gesture == GESTURE_SEW)
		draw_sewing(&easel);
	if (ui->gesture == GESTURE_PIECE)
		draw_start(sheet, ui);
	if (!hovers(ui))
		return;
	if (ui->hover_edge >= 0 && piece_used(easel.session, ui->hover_piece))
		draw_edge_glow(&easel, (struct edge_ref){ui->hover_piece, ui->hover_edge},
			       LOOK_HINT_RIM);
	draw_ring(&easel);
}

static uint64_t live_hash(const struct ui *ui)
{
	struct hash hash;
	bool hover = hovers(ui), drawn = ui->gesture != GESTURE_NONE;
	struct v2 pen = hover ? ui->pen_px : ui->steady_px;
	hash_init(&hash);
	hash_int(&hash, (int)ui->gesture);
	hash_int(&hash, hover | ui->pin_mode << 1 | ui->erase << 2);
	hash_int(&hash, hover ? ui->hover_piece * 1024 + ui->hover_edge : 0);
	hash_float(&hash, hover || drawn ? pen.x : 0.0f);
	hash_float(&hash, hover || drawn ? pen.y : 0.0f);
	return hash.value;
}

/* ---- the layer ---- */

static void copy_still(const struct sheet *sheet, struct rect area)
{
	cairo_t *cr = sheet->out.cr;
	clip_to(cr, area);
	cairo_set_source_surface(cr, sheet->still.surface, 0.0, 0.0);
	cairo_paint(cr);
	cairo_restore(cr);
}

/* Brings `still` up to date and says what of it changed. */
static void update_still(struct sheet *sheet, const struct easel *easel)
{
	const struct ui *ui = easel->ui;
	uint64_t paper = view_hash(&ui->view), still = still_hash(ui, easel->session);
	if (paper != sheet->paper_hash)
		draw_paper(sheet, &ui->view);
	if (still != sheet->still_hash) {
		draw_still(sheet, easel, sheet->layer.area);
		add_damage(sheet, sheet->layer.area);
	} else if (sheet->ink_count > 0 && !inks(ui)) {
		draw_still(sheet, easel, sheet->ink_area);
		add_damage(sheet, sheet->ink_area);
	}
	if (still != sheet->still_hash || !inks(ui)) {
		sheet->ink_count = 0;
		sheet->ink_area = (struct rect){0, 0, 0, 0};
	}
	sheet->paper_hash = paper;
	sheet->still_hash = still;
	if (inks(ui))
		draw_ink(sheet, ui, easel->session);
}

const struct layer *sheet_update(struct sheet *sheet, const struct ui *ui,
				 const struct session *session)
{
	struct easel easel = {NULL, sheet->type, sheet->paint, ui, session, sheet->unit};
	struct layer *layer = &sheet->layer;
	uint64_t live = live_hash(ui);
	layer->damage_count = 0;
	update_still(sheet, &easel);
	if (live != sheet->live_hash) {
		add_damage(sheet, sheet->live_area);
		sheet->live_area = live_extent(&easel);
		add_damage(sheet, sheet->live_area);
	}
	sheet->live_hash = live;
	if (layer->damage_count == 0)
		return layer;
	for (int i = 0; i < layer->damage_count; i++) {
		struct rect area = layer->damage[i];
		area.x += layer->area.x;
		area.y += layer->area.y;
		copy_still(sheet, area);
		clip_to(sheet->out.cr, area);
		draw_live(sheet, &easel);
		cairo_restore(sheet->out.cr);
	}
	cairo_surface_flush(sheet->out.surface);
	return layer;
}

/* All drawing is in screen pixels; the canvas holds the pane's part of the screen (its device
 * offset also counts when it is a source). */
static bool canvas_open(struct canvas *canvas, struct rect area)
{
	canvas->surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, area.w, area.h);
	cairo_surface_set_device_offset(canvas->surface, -area.x, -area.y);
	canvas->cr = cairo_create(canvas->surface);
	return cairo_status(canvas->cr) == CAIRO_STATUS_SUCCESS;
}

static void canvas_close(struct canvas *canvas)
{
	if (canvas->cr)
		cairo_destroy(canvas->cr);
	if (canvas->surface)
		cairo_surface_destroy(canvas->surface);
}

struct sheet *sheet_open(int width, int height, char fault[200])
{
	struct layout layout;
	struct sheet *sheet = calloc(1, sizeof *sheet);
	layout_make(&layout, width, height, STEP_DRAW, false);
	if (!sheet) {
		snprintf(fault, 200, "no memory for the sheet");
		return NULL;
	}
	sheet->unit = (double)layout_px(&layout, 1000) / 1000.0;
	sheet->layer.area = layout.right;
	sheet->type = type_open(fault);
	if (!sheet->type) {
		sheet_close(sheet);
		return NULL;
	}
	sheet->paint = cloth_paint_open(sheet->unit);
	if (!sheet->paint || !canvas_open(&sheet->paper, layout.right) ||
	    !canvas_open(&sheet->still, layout.right) || !canvas_open(&sheet->out, layout.right)) {
		snprintf(fault, 200, "no memory for the sheet (%d x %d)", layout.right.w,
			 layout.right.h);
		sheet_close(sheet);
		return NULL;
	}
	sheet->layer.pixels = cairo_image_surface_get_data(sheet->out.surface);
	sheet->layer.stride = cairo_image_surface_get_stride(sheet->out.surface);
	sheet->layer.patch[0] = (struct patch){{0, 0, layout.right.w, layout.right.h}, true};
	sheet->layer.patch_count = 1;
	return sheet;
}

void sheet_close(struct sheet *sheet)
{
	if (!sheet)
		return;
	canvas_close(&sheet->paper);
	canvas_close(&sheet->still);
	canvas_close(&sheet->out);
	cloth_paint_close(sheet->paint);
	type_close(sheet->type);
	free(sheet);
}
