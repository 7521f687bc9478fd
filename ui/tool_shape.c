/* The selected piece in its box: corners make it larger and smaller, sides wider and longer, the
 * grip above turns it. And ready shapes, drawn from corner to corner. While the pen is down the
 * sheet shows what would come of it; the edit is sent when it is lifted. */
#include "pattern_shape.h"
#include "tool.h"

static const float box_gap_mm = 6.0f;    /* of the screen: from the piece to its box */
static const float turn_gap_mm = 11.0f;  /* from the box to the grip above */
static const float grip_reach_mm = 4.5f; /* a grip is hit within this */
static const float side_min_mm = 34.0f;  /* shorter sides have no grip in their middle */
static const float size_min_mm = 30.0f;  /* of the sheet */
static const float turn_snap_rad = 0.06f;
static const float round_size_mm = 10.0f; /* ready shapes come in whole centimetres */

/* ---- the box ---- */

static void local_box(const struct piece *piece, struct v2 *low, struct v2 *high)
{
	*low = *high = piece->point_mm[0];
	for (int i = 1; i < piece->point_count; i++) {
		struct v2 p = piece->point_mm[i];
		*low = (struct v2){float_min(low->x, p.x), float_min(low->y, p.y)};
		*high = (struct v2){float_max(high->x, p.x), float_max(high->y, p.y)};
	}
}

/* A grip as a direction from the box's middle: -1, 0, 1 an axis. */
static struct v2 grip_way(enum grip grip, int which)
{
	static const struct v2 corner[4] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
	static const struct v2 side[4] = {{0, -1}, {1, 0}, {0, 1}, {-1, 0}};
	return grip == GRIP_SIZE ? corner[which] : grip == GRIP_WIDTH ? side[which] : side[2];
}

/* On the box: 0 the piece's own, more outside of it by so many millimetres of the sheet. */
static struct v2 box_point(const struct piece *piece, struct v2 way, float out_mm)
{
	struct v2 low, high;
	local_box(piece, &low, &high);
	struct v2 middle = v2_lerp(low, high, 0.5f), half = v2_scale(v2_sub(high, low), 0.5f);
	return (struct v2){middle.x + way.x * (half.x + out_mm),
			   middle.y + way.y * (half.y + out_mm)};
}

/* Between the tools and the swatches, below the hint: what lies beyond comes in as far as that. */
static struct v2 within_reach(const struct ui *ui, struct v2 px)
{
	const struct layout *layout = &ui->layout;
	const struct rect *tool = &layout->target[TARGET_TOOL_PENCIL];
	const struct rect *swatch = &layout->target[TARGET_SWATCH_0];
	const struct rect *left = layout->left_handed ? swatch : tool;
	const struct rect *right = layout->left_handed ? tool : swatch;
	float rim = tool_px(ui, grip_reach_mm);
	float low = (float)(left->x + left->w) + rim, high = (float)right->x - rim;
	float top = (float)(layout->hint.y + layout->hint.h) + rim;
	float bottom = (float)(layout->right.y + layout->right.h) - rim;
	return (struct v2){float_clamp(px.x, low, high), float_clamp(px.y, top, bottom)};
}

struct v2 grip_px(const struct ui *ui, const struct piece *piece, enum grip grip, int which)
{
	float out_mm = tool_sheet_mm(ui, grip == GRIP_TURN ? box_gap_mm + turn_gap_mm : box_gap_mm);
	struct v2 local = box_point(piece, grip_way(grip, which), out_mm);
	return within_reach(ui, view_sheet_px(&ui->view, piece_to_sheet(piece, local)));
}

bool grip_fits(const struct ui *ui, const struct piece *piece, int side)
{
	struct v2 low, high;
	local_box(piece, &low, &high);
	float length = side % 2 ? high.y - low.y : high.x - low.x;
	return length > tool_sheet_mm(ui, side_min_mm);
}

enum grip pick_grip(const struct ui *ui, const struct session *session, struct v2 position_px,
		    int *which)
{
	float best = tool_px(ui, grip_reach_mm);
	enum grip found = GRIP_NONE;
	if (ui->step != STEP_DRAW || ui->drawing != DRAW_PENCIL || !piece_used(session, ui->piece))
		return GRIP_NONE;
	const struct piece *piece = &session->document.pattern.piece[ui->piece];
	for (enum grip grip = GRIP_SIZE; grip <= GRIP_TURN; grip++)
		for (int k = 0; k < (grip == GRIP_TURN ? 1 : 4); k++) {
			float distance = v2_distance(grip_px(ui, piece, grip, k), position_px);
			if (distance >= best || (grip == GRIP_WIDTH && !grip_fits(ui, piece, k)))
				continue;
			best = distance;
			found = grip;
			*which = k;
		}
	return found;
}

/* ---- the draft ---- */

void shape_try(struct tool *tool, const struct edit *edit)
{
	struct shaping *shaping = &tool->ui->shaping;
	const struct document *document = &tool->session->document;
	shaping->edit = *edit;
	shaping->fault = document_shape(&shaping->draft, document, edit);
	shaping->changed = 0;
	for (int p = 0; p < PIECES_MAX; p++) {
		const struct piece *is = &shaping->draft.pattern.piece[p];
		if (memcmp(is, &document->pattern.piece[p], sizeof *is) != 0)
			shaping->changed |= (uint32_t)1 << p;
	}
	shaping->shows = true;
}

enum gesture shape_begin(struct tool *tool, enum grip grip, int which)
{
	struct shaping *shaping = &tool->ui->shaping;
	shaping->shows = false;
	shaping->grip = grip;
	shaping->which = which;
	shaping->fault = NULL;
	shaping->guide_count = 0;
	shaping->changed = 0;
	return GESTURE_SHAPE;
}

static struct v2 pen_mm(const struct ui *ui)
{
	return view_sheet_mm(&ui->view, ui->steady_px);
}

static struct v2 start_mm(const struct ui *ui)
{
	return view_sheet_mm(&ui->view, ui->start_px);
}

/* ---- larger and smaller ---- */

static float factor_of(float wanted_mm, float size_mm)
{
	float least = float_min(size_min_mm / float_max(size_mm, 1.0f), 1.0f);
	return float_clamp(wanted_mm / float_max(size_mm, 1.0f), least, 10.0f);
}

/* The opposite corner or side stays; a corner keeps the piece's proportions. */
static void resize(struct tool *tool)
{
	struct ui *ui = tool->ui;
	struct shaping *shaping = &ui->shaping;
	const struct piece *piece = &tool->session->document.pattern.piece[ui->piece];
	struct v2 way = grip_way(shaping->grip, shaping->which), factor = {1.0f, 1.0f};
	struct v2 held = box_point(piece, way, 0.0f);
	struct v2 about = box_point(piece, v2_scale(way, -1.0f), 0.0f);
	struct v2 pulled = v2_sub(piece_from_sheet(piece, pen_mm(ui)),
				  piece_from_sheet(piece, start_mm(ui)));
	struct v2 size = v2_sub(held, about), wanted = v2_add(size, pulled);
	if (shaping->grip == GRIP_SIZE) {
		float length = v2_length(size);
		factor.x = factor.y = factor_of(v2_dot(wanted, size) / float_max(length, 1.0f),
						length);
	} else if (way.x != 0.0f) {
		factor.x = factor_of(way.x * wanted.x, way.x * size.x);
	} else {
		factor.y = factor_of(way.y * wanted.y, way.y * size.y);
	}
	struct edit edit = {.kind = EDIT_SCALE, .i = {ui->piece}};
	edit.f[0] = factor.x;
	edit.f[1] = factor.y;
	edit.f[2] = about.x;
	edit.f[3] = about.y;
	shape_try(tool, &edit);
	struct v2 low, high;
	local_box(&shaping->draft.pattern.piece[ui->piece], &low, &high);
	shaping->size_mm = v2_sub(high, low);
}

/* ---- turning ---- */

float shape_snapped_turn(float turn_rad)
{
	float step = PI_F / 12.0f, steps = turn_rad / step;
	float whole = (float)(int)(steps + (steps < 0.0f ? -0.5f : 0.5f)) * step;
	return float_abs(whole - turn_rad) < turn_snap_rad ? whole : turn_rad;
}

static float wrapped(float angle_rad)
{
	return angle_atan2(angle_sin(angle_rad), angle_cos(angle_rad));
}

static float angle_from(struct v2 centre, struct v2 point)
{
	return angle_atan2(point.y - centre.y, point.x - centre.x);
}

/* About the middle of its box. */
static void turn(struct tool *tool)
{
	struct ui *ui = tool->ui;
	struct shaping *shaping = &ui->shaping;
	const struct document *document = &tool->session->document;
	const struct piece *piece = &document->pattern.piece[ui->piece];
	struct v2 middle = box_point(piece, (struct v2){0.0f, 0.0f}, 0.0f);
	struct v2 centre = piece_to_sheet(piece, middle);
	float by = angle_from(centre, pen_mm(ui)) - angle_from(centre, start_mm(ui));
	shaping->draft = *document;
	struct piece *turned = &shaping->draft.pattern.piece[ui->piece];
	turned->turn_rad = shape_snapped_turn(wrapped(piece->turn_rad + by));
	struct v2 strayed = v2_sub(centre, piece_to_sheet(turned, middle));
	turned->position_mm = v2_add(turned->position_mm, strayed);
	shaping->edit = (struct edit){.kind = EDIT_PLACE, .i = {ui->piece, piece->inside_up}};
	shaping->edit.f[0] = turned->position_mm.x;
	shaping->edit.f[1] = turned->position_mm.y;
	shaping->edit.f[2] = shaping->turned_rad = turned->turn_rad;
	shaping->changed = (uint32_t)1 << ui->piece;
	shaping->shows = true;
}

/* ---- ready shapes ---- */

static float whole_size(float mm)
{
	int steps = (int)(float_abs(mm) / round_size_mm + 0.5f);
	return float_max((float)steps, 2.0f) * round_size_mm;
}

static void take_outline(struct edit *edit, const struct piece *piece)
{
	edit->point_count = piece->point_count;
	for (int i = 0; i < piece->point_count; i++) {
		edit->point[i] = (struct v3){piece->point_mm[i].x, piece->point_mm[i].y, 0.0f};
		edit->corner[i] = piece->corner[i];
	}
}

/* From where the pen came down to where it is, in whole centimetres. */
static void ready(struct tool *tool)
{
	struct ui *ui = tool->ui;
	struct shaping *shaping = &ui->shaping;
	struct v2 from = start_mm(ui), d = v2_sub(pen_mm(ui), from);
	struct v2 size = {whole_size(d.x), whole_size(d.y)};
	int at = pattern_free_piece(&tool->session->document.pattern);
	shaping->draft = tool->session->document;
	if (at < 0) {
		shaping->fault = "the pattern is full";
		return;
	}
	struct piece *piece = &shaping->draft.pattern.piece[at];
	memset(piece, 0, sizeof *piece);
	piece->used = true;
	piece->swatch = ui->swatch;
	piece->layer = 1 << 20;
	piece->position_mm = v2_add(from, (struct v2){(d.x < 0.0f ? -0.5f : 0.5f) * size.x,
						      (d.y < 0.0f ? -0.5f : 0.5f) * size.y});
	if (ui->drawing == DRAW_ROUND)
		piece_ellipse(piece, size);
	else
		piece_rectangle(piece, size);
	shaping->edit = (struct edit){.kind = EDIT_PIECE, .i = {ui->swatch}};
	shaping->edit.f[0] = piece->position_mm.x;
	shaping->edit.f[1] = piece->position_mm.y;
	take_outline(&shaping->edit, piece);
	shaping->size_mm = size;
	shaping->changed = (uint32_t)1 << at;
	shaping->shows = true;
}

/* ---- the gesture ---- */

void tool_shape_move(struct tool *tool)
{
	struct ui *ui = tool->ui;
	if (ui->shaping.grip == GRIP_READY)
		ready(tool);
	else if (!piece_used(tool->session, ui->piece))
		ui->shaping.shows = false;
	else if (ui->shaping.grip == GRIP_TURN)
		turn(tool);
	else if (ui->shaping.grip == GRIP_CORNER || ui->shaping.grip == GRIP_EDGE)
		tool_points_move(tool);
	else
		resize(tool);
}

void tool_shape_end(struct tool *tool)
{
	struct ui *ui = tool->ui;
	struct shaping *shaping = &ui->shaping;
	tool_shape_move(tool);
	if (shaping->fault) {
		tool_notice(tool, text_refusal(shaping->fault));
	} else if (shaping->shows) {
		struct edit *edit = edit_push(tool->edits, shaping->edit.kind);
		if (edit)
			*edit = shaping->edit;
		if (edit && shaping->grip == GRIP_READY) {
			tool_name_piece(tool, edit);
			ui->select_new = true;
			ui->drawing = DRAW_PENCIL; /* its grips are at hand */
		}
	}
	shaping->shows = false;
	shaping->fault = NULL;
	shaping->guide_count = 0;
}
