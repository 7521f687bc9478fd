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

static void clip_to(cairo_t *cr, struct rect area)
{
	cairo_save(cr);
	cairo_rectangle(cr, area.x, area.y, area.w, area.h);
	cairo_clip(cr);
}

static void add_damage(struct sheet *sheet, struct rect area)
{
	struct layer *layer = &sheet->layer;
	struct rect rect = rect_within(area, layer->area);
	if (rect.w <= 0 || rect.h <= 0)
		return;
	rect.x -= layer->area.x;
	rect.y -= layer->area.y;
	int last = LAYER_DAMAGE_MAX - 1;
	if (layer->damage_count > last)
		layer->damage[last] = rect_join(layer->damage[last], rect);
	else
		layer->damage[layer->damage_count++] = rect;
}

/* ---- what was drawn, as a figure ---- */

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

uint32_t lifted_pieces(const struct ui *ui)
{
	if (ui->gesture == GESTURE_MOVE && ui->piece >= 0)
		return (uint32_t)1 << ui->piece;
	return ui->shaping.shows ? ui->shaping.changed : 0;
}

static void draw_still(const struct sheet *sheet, const struct easel *screen, struct rect area)
{
	struct easel easel = *screen;
	const struct pattern *pattern = &easel.session->document.pattern;
	easel.cr = sheet->still.cr;
	clip_to(easel.cr, area);
	cairo_set_source_surface(easel.cr, sheet->paper.surface, 0.0, 0.0);
	cairo_paint(easel.cr);
	uint32_t lifted = lifted_pieces(easel.ui);
	if (!lifted)
		draw_threads(&easel);
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
		if (!(lifted >> lowest & 1))
			draw_piece(&easel, lowest, (struct v2){0.0f, 0.0f}, false);
	}
	for (int p = 0; p < PIECES_MAX; p++)
		if (pattern->piece[p].used && !(lifted >> p & 1))
			draw_name(&easel, p, (struct v2){0.0f, 0.0f});
	draw_seams(&easel, false);
	draw_pins(&easel);
	if (!lifted)
		draw_grips(&easel);
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
		hash_int(hash, piece->symmetric);
		for (int i = 0; i < piece->point_count; i++) {
			hash_float(hash, piece->point_mm[i].x);
			hash_float(hash, piece->point_mm[i].y);
			hash_int(hash, piece->corner[i]);
		}
	}
	for (int s = 0; s < SEAMS_MAX; s++) {
		const struct seam *seam = &pattern->seam[s];
		if (!seam->used)
			continue;
		hash_int(hash, s * 4 + seam->swapped + 2 * seam->even);
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
	hash_int(&hash, (int)ui->drawing * 1024 + ui->corner);
	hash_u32(&hash, lifted_pieces(ui));
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

static void draw_ink(struct sheet *sheet, const struct ui *ui, const struct session *session)
{
	cairo_t *cr = sheet->still.cr;
	double u = sheet->unit;
	bool mark = ui->gesture == GESTURE_MARK_CLOTH;
	double width = (mark ? 5.0 : 3.0 + 1.6 * (double)ui->pen_pressure) * u;
	int first = int_max(sheet->ink_count - 1, 0);
	struct v2 last = ink_point(ui, first);
	struct rect fresh = rect_around(last, last, width);
	if (ui->stroke_count <= sheet->ink_count)
		return;
	clip_to(cr, sheet->layer.area);
	move_to(cr, last);
	for (int i = first + 1; i < ui->stroke_count; i++) {
		struct v2 next = ink_point(ui, i);
		line_to(cr, next);
		fresh = rect_join(fresh, rect_around(last, next, width));
		last = next;
	}
	cairo_set_line_width(cr, width);
	cairo_set_line_cap(cr, CAIRO_LINE_CAP_ROUND);
	cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
	ink(cr, mark ? look_mark_style(next_cloth_number(session))->colour : LOOK_INK, 1.0);
	cairo_stroke(cr);
	cairo_restore(cr);
	sheet->ink_count = ui->stroke_count;
	sheet->ink_area = rect_join(sheet->ink_area, fresh);
	add_damage(sheet, fresh);
}

static uint64_t live_hash(const struct ui *ui)
{
	struct hash hash;
	bool hover = pen_hovers(ui), drawn = ui->gesture != GESTURE_NONE;
	struct v2 pen = hover ? ui->pen_px : ui->steady_px;
	hash_init(&hash);
	hash_int(&hash, (int)ui->gesture);
	hash_int(&hash, ui->refused.shows ? ui->refused.frame : 0);
	hash_int(&hash, hover | ui->pin_mode << 1 | ui->erase << 2);
	hash_int(&hash, hover ? ui->hover_piece * 1024 + ui->hover_edge : 0);
	hash_float(&hash, hover || drawn ? pen.x : 0.0f);
	hash_float(&hash, hover || drawn ? pen.y : 0.0f);
	hash_int(&hash, hover ? (int)ui->hover_grip * 64 + ui->hover_which : 0);
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
		draw_paper(sheet->paper.cr, sheet->type, sheet->unit, &ui->view);
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
		easel.cr = sheet->out.cr;
		draw_live(&easel);
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
