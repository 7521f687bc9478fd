/* The 2D layers: what is drawn bit by bit, from damage to damage, is at every moment exactly what a
 * fresh drawing would be; nothing outside of the damage changes; a still scene costs nothing. */
#include "draw_layer.h"
#include "leaks.h"
#include "test.h"
#include "text.h"

#include <stdlib.h>

enum { WIDTH = 640, HEIGHT = 360 };

struct panes {
	struct ui *ui;
	struct session *session;
	struct sheet *sheet;
	struct chrome *chrome;
	unsigned char *before[2];
};

static void add_piece(struct session *session, int at, float x_mm, float y_mm)
{
	static const struct v2 outline[] = {
		{-150, -200}, {150, -200}, {160, 120}, {0, 200}, {-160, 120}};
	struct piece *piece = &session->document.pattern.piece[at];
	piece->used = true;
	piece->layer = at;
	piece->swatch = at;
	piece->position_mm = (struct v2){x_mm, y_mm};
	piece->point_count = COUNT_OF(outline);
	for (int i = 0; i < COUNT_OF(outline); i++) {
		piece->point_mm[i] = outline[i];
		piece->corner[i] = true;
	}
}

static void add_mark(struct session *session, int at, int piece)
{
	struct cloth_mark *mark = &session->document.marks.cloth[at];
	*mark = (struct cloth_mark){
		.used = true, .number = at + 1, .piece = piece, .point_count = 2};
	mark->point_mm[0] = (struct v2){20.0f * (float)at, 100};
	mark->point_mm[1] = (struct v2){20.0f * (float)at, -120};
}

static size_t bytes(const struct layer *layer)
{
	return (size_t)layer->stride * (size_t)layer->area.h;
}

static bool damaged(const struct layer *layer, int x, int y)
{
	for (int i = 0; i < layer->damage_count; i++) {
		struct rect r = layer->damage[i];
		if (x >= r.x && x < r.x + r.w && y >= r.y && y < r.y + r.h)
			return true;
	}
	return false;
}

static bool shown(const struct layer *layer, int x, int y)
{
	for (int i = 0; i < layer->patch_count; i++) {
		struct rect r = layer->patch[i].area;
		if (x >= r.x && x < r.x + r.w && y >= r.y && y < r.y + r.h)
			return true;
	}
	return false;
}

static long damage_area(const struct layer *layer)
{
	long area = 0;
	for (int i = 0; i < layer->damage_count; i++)
		area += (long)layer->damage[i].w * layer->damage[i].h;
	return area;
}

/* Pixels that changed without being in the damage, where the layer is shown. */
static int undeclared(const struct layer *layer, const unsigned char *before)
{
	int count = 0;
	for (int y = 0; y < layer->area.h; y++)
		for (int x = 0; x < layer->area.w; x++) {
			size_t at = (size_t)y * (size_t)layer->stride + 4 * (size_t)x;
			count += memcmp(before + at, layer->pixels + at, 3) != 0 &&
				 shown(layer, x, y) && !damaged(layer, x, y);
		}
	return count;
}

/* Cairo's edges under a clip may be a few shades off; a forgotten line is not. */
static bool differs(const unsigned char *a, const unsigned char *b)
{
	for (int k = 0; k < 3; k++)
		if (a[k] - b[k] > 16 || b[k] - a[k] > 16)
			return true;
	return false;
}

static int differing(const struct layer *a, const struct layer *b)
{
	int count = 0;
	for (int y = 0; y < a->area.h; y++)
		for (int x = 0; x < a->area.w; x++) {
			size_t at = (size_t)y * (size_t)a->stride + 4 * (size_t)x;
			count += shown(a, x, y) && differs(a->pixels + at, b->pixels + at);
		}
	return count;
}

/* One frame of both layers. `fresh`: also compare with layers that were never drawn before. */
static void frame(struct panes *panes, bool fresh)
{
	char fault[200];
	const struct layer *sheet = sheet_update(panes->sheet, panes->ui, panes->session);
	const struct layer *chrome = chrome_update(panes->chrome, panes->ui, panes->session);
	CHECK(undeclared(sheet, panes->before[0]) == 0);
	CHECK(undeclared(chrome, panes->before[1]) == 0);
	memcpy(panes->before[0], sheet->pixels, bytes(sheet));
	memcpy(panes->before[1], chrome->pixels, bytes(chrome));
	if (!fresh)
		return;
	struct sheet *new_sheet = sheet_open(WIDTH, HEIGHT, fault);
	struct chrome *new_chrome = chrome_open(WIDTH, HEIGHT, fault);
	CHECK(differing(sheet, sheet_update(new_sheet, panes->ui, panes->session)) == 0);
	CHECK(differing(chrome, chrome_update(new_chrome, panes->ui, panes->session)) == 0);
	sheet_close(new_sheet);
	chrome_close(new_chrome);
}

static struct v2 on_sheet(const struct panes *panes, float x_mm, float y_mm)
{
	return view_sheet_px(&panes->ui->view, (struct v2){x_mm, y_mm});
}

static void check_quiet(struct panes *panes)
{
	frame(panes, true);
	CHECK(sheet_update(panes->sheet, panes->ui, panes->session)->damage_count == 0);
	CHECK(chrome_update(panes->chrome, panes->ui, panes->session)->damage_count == 0);
}

static void check_steps(struct panes *panes)
{
	for (int step = 0; step < STEP_COUNT; step++)
		for (int language = 0; language <= LANGUAGE_ENGLISH; language++) {
			ui_step(panes->ui, (enum step)step);
			panes->ui->language = (enum language)language;
			frame(panes, language == step % 3);
		}
	panes->ui->left_handed = true;
	ui_step(panes->ui, STEP_DRAW);
	frame(panes, true);
	panes->ui->left_handed = false;
	panes->ui->language = LANGUAGE_BOTH;
	ui_step(panes->ui, STEP_DRAW);
	frame(panes, true);
}

/* A button under the pen, and nothing else, is drawn again. */
static void check_hover(struct panes *panes)
{
	panes->ui->hover_target = TARGET_UNDO;
	panes->session->undo_count = 1;
	const struct layer *layer = chrome_update(panes->chrome, panes->ui, panes->session);
	CHECK(layer->damage_count == 1);
	CHECK(memcmp(&layer->damage[0], &panes->ui->layout.target[TARGET_UNDO],
		     sizeof layer->damage[0]) == 0);
	CHECK(undeclared(layer, panes->before[1]) == 0);
	memcpy(panes->before[1], layer->pixels, bytes(layer));
	frame(panes, true);
	panes->ui->hover_target = TARGET_NONE;
	frame(panes, false);

	panes->ui->pen_state = PEN_HOVER;
	for (int i = 0; i < 20; i++) {
		panes->ui->pen_px = on_sheet(panes, -700.0f + 60.0f * (float)i, 15.0f * (float)i);
		frame(panes, i % 7 == 0);
	}
	layer = sheet_update(panes->sheet, panes->ui, panes->session);
	CHECK(layer->damage_count == 0);
	panes->ui->pen_px.x += 1.0f;
	layer = sheet_update(panes->sheet, panes->ui, panes->session);
	CHECK(layer->damage_count > 0 && damage_area(layer) < 80 * 80);
	panes->ui->pen_state = PEN_AWAY;
	frame(panes, true);
}

/* Ink grows by its newest bit, and leaves nothing behind when the stroke came to nothing. */
static void check_ink(struct panes *panes)
{
	struct ui *ui = panes->ui;
	ui->pen_state = PEN_TOUCH;
	ui->gesture = GESTURE_PIECE;
	ui->start_px = ui->stroke_px[0] = on_sheet(panes, -500, 200);
	ui->stroke_count = 1;
	long most = 0;
	for (int i = 1; i < 120; i++) {
		float angle = (float)i * 0.05f;
		ui->stroke_px[i] = on_sheet(panes, -300.0f - 200.0f * angle_cos(angle),
					    200.0f + 200.0f * angle_sin(angle));
		ui->steady_px = ui->stroke_px[i];
		ui->stroke_count = i + 1;
		const struct layer *layer = sheet_update(panes->sheet, ui, panes->session);
		CHECK(undeclared(layer, panes->before[0]) == 0);
		memcpy(panes->before[0], layer->pixels, bytes(layer));
		if (i > 2)
			most = most > damage_area(layer) ? most : damage_area(layer);
	}
	CHECK(most < 60 * 60);
	ui->gesture = GESTURE_NONE;
	ui->stroke_count = 0;
	ui->pen_state = PEN_AWAY;
	frame(panes, true);
}

static void check_moving(struct panes *panes)
{
	struct ui *ui = panes->ui;
	ui->pen_state = PEN_TOUCH;
	ui->gesture = GESTURE_MOVE;
	ui->piece = 0;
	for (int i = 0; i < 10; i++) {
		ui->move_mm = (struct v2){20.0f * (float)i, -9.0f * (float)i};
		ui->steady_px = on_sheet(panes, ui->move_mm.x, ui->move_mm.y);
		frame(panes, i % 3 == 0);
	}
	ui->gesture = GESTURE_NONE;
	ui->pen_state = PEN_AWAY;
	panes->session->document.pattern.piece[0].position_mm.x += 180.0f;
	ui->move_mm = (struct v2){0, 0};
	frame(panes, true);
}

static void check_sewing(struct panes *panes)
{
	struct ui *ui = panes->ui;
	ui_step(ui, STEP_SEW);
	ui->gesture = GESTURE_SEW;
	ui->pen_state = PEN_TOUCH;
	ui->sew_from.piece = 0;
	ui->sew_from.edge = 1;
	ui->start_px = on_sheet(panes, -100, 0);
	for (int i = 0; i < 8; i++) {
		ui->steady_px = on_sheet(panes, -100.0f + 70.0f * (float)i, 10.0f * (float)i);
		ui->sew_to.piece = i > 5 ? 1 : -1;
		ui->sew_to.edge = 3;
		frame(panes, i > 4);
	}
	ui->gesture = GESTURE_NONE;
	ui->sew_from.piece = ui->sew_to.piece = -1;
	ui->pen_state = PEN_AWAY;
	panes->session->document.pattern.seam[0] = (struct seam){
		true, false, {0, 1}, {1, 3}, false};
	ui->seam = 0;
	frame(panes, true);
}

/* Every word is there, in both languages. */
static void check_words(void)
{
	for (int i = 1; i < TEXT_COUNT; i++)
		CHECK(text_phrase[i].japanese && text_phrase[i].japanese[0] &&
		      text_phrase[i].english && text_phrase[i].english[0]);
	for (int i = 1; i < TARGET_SWATCH_0; i++)
		CHECK(text_target[i].japanese && text_target[i].english);
	CHECK(text_refusal("the outline crosses or touches itself") == TEXT_CROSSES);
	CHECK(text_refusal("the piece is smaller than a square centimetre") == TEXT_SMALL);
	CHECK(text_refusal("something never heard of") == TEXT_AGAIN);
}

int main(void)
{
	struct panes panes = {
		calloc(1, sizeof *panes.ui), calloc(1, sizeof *panes.session), 0, 0, {0}};
	char fault[200] = "";
	ui_init(panes.ui, WIDTH, HEIGHT);
	panes.sheet = sheet_open(WIDTH, HEIGHT, fault);
	panes.chrome = chrome_open(WIDTH, HEIGHT, fault);
	if (!panes.sheet || !panes.chrome) {
		printf("%s\n", fault);
		return 77;
	}
	panes.before[0] = calloc(WIDTH * HEIGHT, 4);
	panes.before[1] = calloc(WIDTH * HEIGHT, 4);
	add_piece(panes.session, 0, -400, 100);
	add_piece(panes.session, 1, 200, 50);
	add_mark(panes.session, 0, 0);
	add_mark(panes.session, 1, 1);
	panes.ui->piece = 1;
	panes.ui->frame = 1000;

	check_quiet(&panes);
	check_steps(&panes);
	check_hover(&panes);
	check_ink(&panes);
	check_moving(&panes);
	check_sewing(&panes);
	check_words();

	sheet_close(panes.sheet);
	chrome_close(panes.chrome);
	free(panes.before[0]);
	free(panes.before[1]);
	free(panes.ui);
	free(panes.session);
	return test_end();
}
