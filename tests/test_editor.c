/* The pattern editor, played by a hand: raw reports of a pen through the real parser and the whole
 * program. Every operation of steps 1 and 2, and what has come of it.
 *
 *   test_editor [TAPE]     writes the last hand's visit as a tape, to be looked at */
#include "hand_visit.h"
#include "pattern_shape.h"
#include "test.h"
#include "tool.h"

enum { WIDTH_PX = 1280, HEIGHT_PX = 720, INTERVAL_US = 10000, SEEDS = 3 };

static const float pull_px_s = 260.0f, draw_px_s = 420.0f;

static const struct ui *ui_of(const struct hand *hand)
{
	return &hand->kiosk->ui;
}

static const struct piece *piece_of(const struct hand *hand, int piece)
{
	return &hand->kiosk->session.document.pattern.piece[piece];
}

static struct v2 paper_px(const struct hand *hand, float x_mm, float y_mm)
{
	return view_sheet_px(&ui_of(hand)->view, (struct v2){x_mm, y_mm});
}

/* From one place of the screen to another, with a pause before the pen is lifted. */
static void pull(struct hand *hand, struct v2 from_px, struct v2 to_px)
{
	struct v2 path[2] = {from_px, to_px};
	hand_touch(hand, from_px);
	hand_follow(hand, path, 2, pull_px_s);
	hand_wait(hand, 0.25f);
	hand_lift(hand);
	hand_wait(hand, 0.1f);
}

static void pull_by(struct hand *hand, struct v2 from_px, float x_px, float y_px)
{
	pull(hand, from_px, v2_add(from_px, (struct v2){x_px, y_px}));
}

static struct v2 grip(const struct hand *hand, enum grip grip, int which)
{
	return grip_px(ui_of(hand), piece_of(hand, ui_of(hand)->piece), grip, which);
}

static struct v2 corner_px(const struct hand *hand, int piece, int corner)
{
	const struct piece *at = piece_of(hand, piece);
	return view_sheet_px(&ui_of(hand)->view, piece_to_sheet(at, piece_corner_mm(at, corner)));
}

static struct v2 edge_px(const struct hand *hand, int piece, int edge, float fraction)
{
	const struct piece *at = piece_of(hand, piece);
	return view_sheet_px(&ui_of(hand)->view,
			     piece_to_sheet(at, piece_edge_point(at, edge, fraction)));
}

static struct v2 box_size(const struct hand *hand, int piece)
{
	struct v2 low, high;
	piece_bounds(piece_of(hand, piece), &low, &high);
	return v2_sub(high, low);
}

/* Millimetres of the sheet for pixels of the screen. */
static float mm(const struct hand *hand, float px)
{
	return px / ui_of(hand)->view.sheet_px_per_mm;
}

/* ---- ready shapes and grips ---- */

static void check_box(struct hand *hand)
{
	hand_tap_target(hand, TARGET_TOOL_BOX);
	pull(hand, paper_px(hand, -560.0f, 420.0f), paper_px(hand, -260.0f, -60.0f));
	struct v2 size = box_size(hand, 0);
	CHECK(piece_of(hand, 0)->used && ui_of(hand)->piece == 0);
	CHECK_NEAR(size.x, 300, 10.1);
	CHECK_NEAR(size.y, 480, 10.1);
	CHECK(ui_of(hand)->drawing == DRAW_PENCIL); /* grips are at hand */
}

static void check_grips(struct hand *hand)
{
	struct v2 before = box_size(hand, 0);
	struct v2 still = corner_px(hand, 0, 3);
	pull_by(hand, grip(hand, GRIP_WIDTH, 1), 36.0f, 3.0f);
	struct v2 wide = box_size(hand, 0);
	CHECK_NEAR(wide.x, before.x + mm(hand, 36.0f), 6);
	CHECK_NEAR(wide.y, before.y, 0.1);
	CHECK(v2_distance(corner_px(hand, 0, 3), still) < 0.5f);
	pull_by(hand, grip(hand, GRIP_SIZE, 2), 20.0f, -28.0f);
	struct v2 large = box_size(hand, 0);
	CHECK(large.x > 1.08f * wide.x);
	CHECK_NEAR(large.x / large.y, wide.x / wide.y, 0.002);
	pull_by(hand, grip(hand, GRIP_TURN, 0), 60.0f, 22.0f);
	CHECK_NEAR(piece_of(hand, 0)->turn_rad, -PI_F / 6.0f, 1e-4); /* 30 degrees, snapped */
	hand_tap_target(hand, TARGET_UNDO);
	CHECK_NEAR(piece_of(hand, 0)->turn_rad, 0, 1e-6);
}

/* ---- points ---- */

static void check_points(struct hand *hand)
{
	hand_tap_target(hand, TARGET_TOOL_POINTS);
	struct v2 before = corner_px(hand, 0, 2);
	pull_by(hand, before, -26.0f, -20.0f);
	struct v2 by = v2_sub(corner_px(hand, 0, 2), before);
	CHECK(v2_distance(by, (struct v2){-26.0f, -20.0f}) < 3.0f);
	CHECK(piece_of(hand, 0)->point_count == 4 && ui_of(hand)->corner == 2);
	struct v2 middle = edge_px(hand, 0, 2, 0.5f);
	pull_by(hand, middle, 4.0f, 24.0f);
	CHECK_NEAR(edge_px(hand, 0, 2, 0.5f).y, middle.y + 24.0f, 3);
	CHECK(piece_of(hand, 0)->point_count > 8 && piece_edge_count(piece_of(hand, 0)) == 4);
	hand_tap(hand, edge_px(hand, 0, 1, 0.55f));
	hand_wait(hand, 0.2f);
	CHECK(piece_edge_count(piece_of(hand, 0)) == 5 && ui_of(hand)->corner == 2);
	before = corner_px(hand, 0, 2);
	pull_by(hand, before, -22.0f, 3.0f);
	CHECK_NEAR(corner_px(hand, 0, 2).x, before.x - 22.0f, 3);
	hand_tap_target(hand, TARGET_DELETE);
	hand_wait(hand, 0.2f);
	CHECK(piece_edge_count(piece_of(hand, 0)) == 4 && piece_of(hand, 0)->used);
	hand_tap_target(hand, TARGET_UNDO);
	hand_wait(hand, 0.2f);
	CHECK(piece_edge_count(piece_of(hand, 0)) == 5);
}

/* A corner pulled nearly below another is put exactly there. */
static void check_snapping(struct hand *hand)
{
	struct v2 at = corner_px(hand, 0, 1), over = corner_px(hand, 0, 0);
	pull(hand, at, (struct v2){at.x + 20.0f, over.y + 3.0f});
	CHECK_NEAR(piece_corner_mm(piece_of(hand, 0), 1).y, piece_corner_mm(piece_of(hand, 0), 0).y,
		   0.01);
	hand_tap_target(hand, TARGET_UNDO);
	hand_wait(hand, 0.2f);
}

static void check_symmetry(struct hand *hand)
{
	hand_tap_target(hand, TARGET_FOLD);
	hand_wait(hand, 0.2f);
	const struct piece *piece = piece_of(hand, 0);
	CHECK(piece->symmetric);
	int other = piece_other_corner(piece, 0);
	CHECK(other > 0);
	struct v2 before = piece_corner_mm(piece, 0);
	pull_by(hand, corner_px(hand, 0, 0), -18.0f, 14.0f);
	struct v2 after = piece_corner_mm(piece, 0);
	CHECK(v2_distance(before, after) > mm(hand, 15.0f));
	CHECK(piece_other_corner(piece, 0) == other);
	CHECK(v2_distance(piece_reflect(piece, after), piece_corner_mm(piece, other)) < 0.01f);
	/* A line right across it is its new axis. */
	hand_tap_target(hand, TARGET_TOOL_PENCIL);
	hand_wait(hand, 0.2f);
	struct v2 low, high;
	piece_bounds(piece, &low, &high);
	float y = low.y + 0.3f * (high.y - low.y); /* between grips */
	struct v2 line[2] = {paper_px(hand, high.x + 60.0f, y), paper_px(hand, low.x - 50.0f, y)};
	CHECK_NEAR(piece->axis_rad, 0.5f * PI_F, 1e-4);
	hand_stroke(hand, line, 2, draw_px_s);
	hand_wait(hand, 0.3f);
	CHECK(piece->symmetric && float_abs(angle_sin(piece->axis_rad)) < 0.01f);
	hand_tap_target(hand, TARGET_UNDO);
	hand_wait(hand, 0.2f);
	CHECK_NEAR(piece->axis_rad, 0.5f * PI_F, 1e-4);
}

/* Moved nearly in line with another piece, it comes to lie in line. */
static void check_moving(struct hand *hand)
{
	struct v2 low, high, low_2, high_2;
	piece_bounds(piece_of(hand, 0), &low, &high);
	piece_bounds(piece_of(hand, 1), &low_2, &high_2);
	struct v2 from = v2_lerp(low_2, high_2, 0.4f);
	struct v2 to = v2_add(from, (struct v2){low.x - low_2.x + 5.0f, -30.0f});
	pull(hand, paper_px(hand, from.x, from.y), paper_px(hand, to.x, to.y));
	piece_bounds(piece_of(hand, 0), &low, &high);
	piece_bounds(piece_of(hand, 1), &low_2, &high_2);
	CHECK_NEAR(low.x, low_2.x, 0.05);
	hand_tap_target(hand, TARGET_UNDO);
	hand_wait(hand, 0.2f);
}

/* ---- seams ---- */

/* A copy is sewn to it; an edge is pulled while both are kept equally long. */
static void check_even(struct hand *hand)
{
	hand_tap_target(hand, TARGET_COPY);
	hand_wait(hand, 0.2f);
	check_moving(hand);
	hand_tap_target(hand, TARGET_STEP_SEW);
	hand_wait(hand, 0.1f);
	pull(hand, edge_px(hand, 0, 0, 0.5f), edge_px(hand, 1, 0, 0.5f));
	hand_tap_target(hand, TARGET_STEP_DRAW);
	hand_wait(hand, 0.1f);
	hand_tap_target(hand, TARGET_TOOL_POINTS);
	hand_tap(hand, edge_px(hand, 1, 1, 0.5f)); /* a point that makes one edge longer */
	hand_wait(hand, 0.2f);
	hand_tap_target(hand, TARGET_UNDO);
	pull_by(hand, corner_px(hand, 1, 1), 3.0f, 22.0f);
	hand_tap_target(hand, TARGET_STEP_SEW);
	hand_wait(hand, 0.1f);
	hand_wait(hand, 0.4f);
	int mark[2];
	CHECK(text_hint(ui_of(hand), &hand->kiosk->session, mark) == TEXT_HINT_SEW_EASED);
	hand_tap_target(hand, TARGET_EVEN);
	hand_wait(hand, 0.5f);
	CHECK(text_hint(ui_of(hand), &hand->kiosk->session, mark) == TEXT_HINT_SEW_EVEN);
	CHECK_NEAR(piece_edge_length_mm(piece_of(hand, 0), 0),
		   piece_edge_length_mm(piece_of(hand, 1), 0), 0.1);
	const struct seam *seam = &hand->kiosk->session.document.pattern.seam[0];
	CHECK(seam->used && seam->even);
	hand_tap_target(hand, TARGET_STEP_DRAW);
	hand_wait(hand, 0.1f);
	hand_tap_target(hand, TARGET_TOOL_POINTS);
	float before = piece_edge_length_mm(piece_of(hand, 1), 0);
	pull_by(hand, corner_px(hand, 1, 0), -16.0f, 10.0f);
	float after = piece_edge_length_mm(piece_of(hand, 1), 0);
	CHECK(float_abs(after - before) > 4.0f);
	CHECK_NEAR(piece_edge_length_mm(piece_of(hand, 0), 0), after, 0.1);
}

/* ---- the paper ---- */

static void check_round(struct hand *hand)
{
	hand_tap_target(hand, TARGET_TOOL_ROUND);
	pull(hand, paper_px(hand, 100.0f, -260.0f), paper_px(hand, 330.0f, -500.0f));
	CHECK(piece_of(hand, 2)->used && piece_edge_count(piece_of(hand, 2)) == 4);
	float scale = ui_of(hand)->view.sheet_px_per_mm;
	hand_tap_target(hand, TARGET_ZOOM_IN);
	hand_wait(hand, 0.3f);
	hand_tap_target(hand, TARGET_ZOOM_IN);
	hand_wait(hand, 0.5f);
	CHECK(ui_of(hand)->view.sheet_px_per_mm > 2.0f * scale);
	hand_tap_target(hand, TARGET_TOOL_POINTS);
	pull_by(hand, edge_px(hand, 2, 0, 0.5f), 30.0f, 20.0f);
	struct v2 at = corner_px(hand, 2, 1);
	pull_by(hand, v2_add(at, (struct v2){90.0f, -40.0f}), -60.0f, 30.0f); /* the paper */
	CHECK(v2_distance(corner_px(hand, 2, 1), v2_add(at, (struct v2){-60.0f, 30.0f})) < 4.0f);
	hand_tap(hand, corner_px(hand, 2, 1));
	hand_wait(hand, 0.3f);
	hand_tap_target(hand, TARGET_DELETE);
	hand_wait(hand, 0.3f);
	CHECK(piece_edge_count(piece_of(hand, 2)) == 3);
	hand_tap_target(hand, TARGET_ZOOM_OUT);
	hand_wait(hand, 0.3f);
	CHECK_NEAR(ui_of(hand)->view.sheet_px_per_mm, scale, 1e-6);
}

/* ---- what is not taken ---- */

/* Says why in words, and shows where, until the pen comes down again. */
static void check_refused(struct hand *hand)
{
	const struct refused *refused = &ui_of(hand)->refused;
	struct v2 eight[5] = {paper_px(hand, 0.0f, 560.0f), paper_px(hand, 360.0f, 160.0f),
			      paper_px(hand, 360.0f, 560.0f), paper_px(hand, 0.0f, 160.0f),
			      paper_px(hand, 0.0f, 560.0f)};
	hand_tap_target(hand, TARGET_TOOL_PENCIL);
	hand_stroke(hand, eight, 5, draw_px_s);
	hand_wait(hand, 0.4f);
	CHECK(refused->shows && refused->fault == FAULT_CROSSES);
	CHECK(ui_of(hand)->notice == TEXT_CROSSES);
	CHECK(v2_distance(refused->at_mm[0], (struct v2){180.0f, 360.0f}) < 25.0f);
	hand_wait(hand, 0.5f);
	hand_stroke(hand, eight, 3, draw_px_s);
	hand_wait(hand, 0.4f);
	CHECK(refused->shows && refused->fault == FAULT_OPEN);
	CHECK(v2_distance(refused->at_mm[1], (struct v2){360.0f, 560.0f}) < 25.0f);
	hand_wait(hand, 0.5f);
	struct v2 small[3] = {eight[0], v2_add(eight[0], (struct v2){10.5f, 0.0f}), eight[0]};
	hand_stroke(hand, small, 3, draw_px_s);
	hand_wait(hand, 0.4f);
	CHECK(refused->shows && refused->fault == FAULT_SMALL);
	hand_wait(hand, 0.5f);
	hand_tap_target(hand, TARGET_TOOL_POINTS);
	CHECK(!refused->shows);
}

static void play(struct kiosk *kiosk, struct hand *hand, void *memory, const char *path,
		 uint32_t seed)
{
	FILE *tape = fopen(path, "wb");
	int failures = test_failures;
	MUST(tape);
	kiosk_init(kiosk, memory, WIDTH_PX, HEIGHT_PX);
	MUST(!body_build_mannequin(&kiosk->session.body));
	hand_begin(hand, kiosk, tape, INTERVAL_US, seed);
	hand_wait(hand, 0.3f);
	check_box(hand);
	check_grips(hand);
	check_points(hand);
	check_snapping(hand);
	check_symmetry(hand);
	check_even(hand);
	check_round(hand);
	check_refused(hand);
	hand_leave(hand);
	hand_end(hand);
	CHECK(fclose(tape) == 0);
	if (test_failures > failures)
		fprintf(stderr, "with the hand of seed %u\n", (unsigned)seed);
}

int main(int argc, char **argv)
{
	struct kiosk *kiosk = malloc(sizeof *kiosk);
	struct hand *hand = malloc(sizeof *hand);
	void *memory = malloc(KIOSK_MEMORY_BYTES);
	MUST(kiosk && hand && memory);
	for (uint32_t seed = 1; seed <= SEEDS; seed++)
		play(kiosk, hand, memory, argc > 1 ? argv[1] : "/dev/null", seed);
	free(memory);
	free(hand);
	free(kiosk);
	return test_end();
}
