/* Steps 1 to 3 and the buttons: what is drawn, redrawn, moved, sewn, marked and erased, by a steady
 * hand and by trembling ones. */
#include "pattern_shape.h"
#include "visitor.h"

static int redrawn; /* outlines, of all hands */

/* ---- step 1 ---- */

static void check_drawing(struct hand *hand)
{
	struct v2 low, high, new_low, new_high;
	watch(hand);
	draw_box(hand, -700, -300, 480, 620);
	CHECK(sent(hand, EDIT_PIECE) == 1 && hand->sent.count == 1);
	CHECK(hand->ui->piece == 0 && piece_at(hand, 0)->used);
	piece_bounds(piece_at(hand, 0), &low, &high);
	CHECK_NEAR(low.x, -700, 14);
	CHECK_NEAR(low.y, -300, 14);
	CHECK_NEAR(high.x, -220, 14);
	CHECK_NEAR(high.y, 320, 14);
	CHECK(piece_edge_count(piece_at(hand, 0)) == 4);

	/* A tap beside it lets go of it, a tap on it takes it, neither changes it. */
	watch(hand);
	tap(hand, paper(hand, 200, 0));
	CHECK(hand->ui->piece == -1);
	tap(hand, paper(hand, -460, 0));
	CHECK(hand->ui->piece == 0 && hand->sent.count == 0);

	/* Dragged from within it moves as far as the pen. */
	line(hand, paper(hand, -460, 0), paper(hand, -420, -100));
	CHECK(sent(hand, EDIT_PLACE) == 1 && hand->sent.count == 1);
	piece_bounds(piece_at(hand, 0), &new_low, &new_high);
	CHECK_NEAR(new_low.x - low.x, 40, 12);
	CHECK_NEAR(new_low.y - low.y, -100, 12);
}

/* A stretch of the outline redrawn from edge to edge: taken, or refused with a reason (the new line
 * may cross the old where a hand trembles at its ends); hardly ever refused. */
static void check_redrawing(struct hand *hand)
{
	struct v2 low, high, new_low, new_high;
	piece_bounds(piece_at(hand, 0), &low, &high);
	struct v2 bulge[4] = {paper(hand, high.x, 120), paper(hand, high.x + 90, 60),
			      paper(hand, high.x + 90, -60), paper(hand, high.x, -120)};
	watch(hand);
	stroke(hand, bulge, 4);
	if (hand->trembles && hand->sent.count == 0) {
		CHECK(hand->ui->notice == TEXT_CROSSES);
		return;
	}
	CHECK(sent(hand, EDIT_OUTLINE) == 1 && hand->sent.count == 1);
	piece_bounds(piece_at(hand, 0), &new_low, &new_high);
	CHECK_NEAR(new_high.x, high.x + 90, 25);
	redrawn++;
}

/* Among points the pen's other end takes a point away, not the piece. */
static void check_erasing_points(struct hand *hand)
{
	int edges = piece_edge_count(piece_at(hand, 0));
	press(hand, TARGET_TOOL_POINTS);
	watch(hand);
	hand->eraser = true;
	int corner = 0;
	for (int k = 1; k < edges; k++) { /* the lowest on the left */
		struct v2 a = piece_to_sheet(piece_at(hand, 0),
					     piece_corner_mm(piece_at(hand, 0), k));
		struct v2 b = piece_to_sheet(piece_at(hand, 0),
					     piece_corner_mm(piece_at(hand, 0), corner));
		corner = a.x + a.y < b.x + b.y ? k : corner;
	}
	struct v2 at = piece_to_sheet(piece_at(hand, 0),
				      piece_corner_mm(piece_at(hand, 0), corner));
	tap(hand, paper(hand, at.x, at.y));
	hand->eraser = false;
	CHECK(sent(hand, EDIT_JOIN) == 1 && sent(hand, EDIT_DELETE) == 0);
	CHECK(piece_edge_count(piece_at(hand, 0)) == edges - 1);
	press(hand, TARGET_UNDO);
	CHECK(piece_edge_count(piece_at(hand, 0)) == edges);
	press(hand, TARGET_TOOL_PENCIL);
}

static void check_buttons_of_pieces(struct hand *hand)
{
	struct v2 low, high, low2, high2;
	watch(hand);
	press(hand, TARGET_COPY);
	CHECK(sent(hand, EDIT_COPY) == 1 && hand->ui->piece == 1);
	piece_bounds(piece_at(hand, 0), &low, &high);
	piece_bounds(piece_at(hand, 1), &low2, &high2);
	CHECK(low2.x > high.x || high2.x < low.x || low2.y > high.y || high2.y < low.y);
	CHECK(rect_holds(hand->ui->layout.right, view_sheet_px(&hand->ui->view, low2)));
	CHECK(rect_holds(hand->ui->layout.right, view_sheet_px(&hand->ui->view, high2)));

	press(hand, TARGET_TURN_OVER);
	CHECK(sent(hand, EDIT_PLACE) == 1 && piece_at(hand, 1)->inside_up);
	piece_bounds(piece_at(hand, 1), &low, &high);
	CHECK_NEAR(low.x, low2.x, 0.1);
	CHECK_NEAR(high.x, high2.x, 0.1);

	press(hand, (enum target)(TARGET_SWATCH_0 + 3));
	CHECK(piece_at(hand, 1)->swatch == 3 && piece_at(hand, 0)->swatch == 0);
	press(hand, TARGET_MIRROR);
	CHECK(sent(hand, EDIT_MIRROR) == 1);
	press(hand, TARGET_DELETE);
	CHECK(sent(hand, EDIT_DELETE) == 1 && hand->ui->piece == -1 && !piece_at(hand, 1)->used);
	watch(hand);
	press(hand, TARGET_DELETE);
	CHECK(hand->sent.count == 0 && hand->ui->notice == TEXT_NO_PIECE);
	press(hand, TARGET_UNDO);
	CHECK(sent(hand, EDIT_UNDO) == 1 && piece_at(hand, 1)->used);
	press(hand, TARGET_REDO);
	CHECK(sent(hand, EDIT_REDO) == 1 && !piece_at(hand, 1)->used);

	/* A scribble is no piece, and says why. */
	watch(hand);
	line(hand, paper(hand, 300, 300), paper(hand, 330, 290));
	CHECK(hand->sent.count == 0 && hand->ui->notice != TEXT_NONE);
}

/* ---- step 2 ---- */

/* The middle of the edge whose middle lies farthest to one side of a piece, on the screen. */
static struct v2 edge_towards(const struct hand *hand, int piece, struct v2 way, int *edge)
{
	float best = -1e9f;
	struct v2 at = {0, 0};
	for (int e = 0; e < piece_edge_count(piece_at(hand, piece)); e++) {
		struct v2 p = piece_to_sheet(piece_at(hand, piece),
					     piece_edge_point(piece_at(hand, piece), e, 0.5f));
		if (v2_dot(p, way) <= best)
			continue;
		best = v2_dot(p, way);
		at = view_sheet_px(&hand->ui->view, p);
		*edge = e;
	}
	return at;
}

static void check_sewing(struct hand *hand)
{
	int right, left;
	draw_box(hand, 100, -350, 480, 620);
	CHECK(hand->ui->piece == 1);
	press(hand, TARGET_STEP_SEW);
	CHECK(hand->ui->step == STEP_SEW);
	watch(hand);
	struct v2 to = edge_towards(hand, 1, (struct v2){-1, 0}, &left);
	struct v2 from = edge_towards(hand, 0, (struct v2){1, 0}, &right);
	line(hand, from, to);
	const struct edit *sew = last(hand, EDIT_SEW);
	CHECK(hand->sent.count == 1 && sew->i[0] == 0 && sew->i[1] == right && sew->i[2] == 1 &&
	      sew->i[3] == left && sew->i[4] == 0);
	CHECK(hand->ui->seam == 0);

	press(hand, TARGET_SWAP);
	CHECK(hand->session->document.pattern.seam[0].swapped && hand->ui->seam == 0);
	tap(hand, paper(hand, 340, 0));
	CHECK(hand->ui->seam == -1);
	tap(hand, seam_badge_px(hand->ui, &hand->session->document.pattern,
				&hand->session->document.pattern.seam[0], 1));
	CHECK(hand->ui->seam == 0);

	/* Sewn anew, the old seam goes. */
	watch(hand);
	int top;
	line(hand, from, edge_towards(hand, 1, (struct v2){0, 1}, &top));
	CHECK(sent(hand, EDIT_UNSEW) == 1 && sent(hand, EDIT_SEW) == 1);
	CHECK(hand->session->document.pattern.seam[0].b.edge == top);
	press(hand, TARGET_DELETE);
	CHECK(!hand->session->document.pattern.seam[0].used);

	watch(hand);
	line(hand, from, paper(hand, 340, 0));
	CHECK(hand->sent.count == 0 && hand->ui->notice == TEXT_SELF_SEAM);

	/* The left pane turns the figure, and nothing else. */
	struct v3 axis = hand->ui->view.turn.row[2];
	struct v2 room = middle(hand->ui->layout.left);
	line(hand, room, v2_add(room, (struct v2){120, 10}));
	CHECK(hand->sent.count == 0 && v3_distance(axis, hand->ui->view.turn.row[2]) > 0.1f);
	press(hand, TARGET_VIEW_FRONT);
	CHECK(v3_distance(axis, hand->ui->view.turn.row[2]) < 1e-6f);
}

/* ---- step 3 ---- */

static void check_cloth_marks(struct hand *hand)
{
	struct v2 a = {-430, 100}, b = {-430, -250};
	press(hand, TARGET_STEP_MARK);
	watch(hand);
	line(hand, paper(hand, a.x, a.y), paper(hand, b.x, b.y));
	const struct edit *mark = last(hand, EDIT_MARK_CLOTH);
	CHECK(hand->sent.count == 1 && mark->i[0] == 1 && mark->i[1] == 0);
	CHECK(mark->point_count >= 20 && mark->point_count <= MARK_POINTS_MAX);
	struct v2 local_a = piece_from_sheet(piece_at(hand, 0), a);
	struct v2 local_b = piece_from_sheet(piece_at(hand, 0), b);
	/* 2 mm on the screen are 16 mm of cloth. */
	CHECK(straying(mark, local_a, local_b) < (hand->trembles ? 9.0f : 0.5f));
	struct v2 first = {mark->point[0].x, mark->point[0].y};
	CHECK(v2_distance(first, local_a) < (hand->trembles ? 12.0f : 6.0f));

	/* The next one has the next number; what leaves the cloth is cut off. */
	line(hand, paper(hand, 340, 100), paper(hand, 340, -700));
	mark = last(hand, EDIT_MARK_CLOTH);
	CHECK(mark->i[0] == 2 && mark->i[1] == 1);
	for (int i = 0; i < mark->point_count; i++)
		CHECK(piece_contains(piece_at(hand, 1),
				     (struct v2){mark->point[i].x, mark->point[i].y}));

	watch(hand);
	line(hand, paper(hand, -100, 600), paper(hand, 300, 600));
	CHECK(hand->sent.count == 0 && hand->ui->notice == TEXT_OFF_CLOTH);
}

static void check_laser_on_stack(struct hand *hand)
{
	struct edit place = {.kind = EDIT_PLACE, .i = {1, 0}};
	struct v2 home = piece_at(hand, 1)->position_mm;
	place.f[0] = piece_at(hand, 0)->position_mm.x;
	place.f[1] = piece_at(hand, 0)->position_mm.y;
	CHECK(session_apply(hand->session, &place));
	press(hand, TARGET_LASER);
	watch(hand);
	line(hand, paper(hand, -500, 50), paper(hand, -500, -200));
	CHECK(sent(hand, EDIT_MARK_CLOTH) == 2);
	CHECK(hand->sent.item[0].i[0] == 3 && hand->sent.item[0].i[1] == 1);
	CHECK(hand->sent.item[1].i[0] == 4 && hand->sent.item[1].i[1] == 0);
	press(hand, TARGET_LASER);
	place.f[0] = home.x;
	place.f[1] = home.y;
	CHECK(session_apply(hand->session, &place));
}

static void check_body_marks(struct hand *hand)
{
	struct v2 from = figure(hand, (struct v3){0, 1.3f, 0.1f});
	struct v2 to = figure(hand, (struct v3){0, 1.0f, 0.1f});
	watch(hand);
	line(hand, from, to);
	const struct edit *mark = last(hand, EDIT_MARK_BODY);
	CHECK(hand->sent.count == 1 && mark->i[0] == 1 && mark->point_count >= 20);
	for (int i = 0; i < mark->point_count; i++) {
		struct body_hit hit;
		body_nearest(&hand->session->body, mark->point[i], 0, &hit);
		CHECK(float_abs(hit.distance_m) < 0.004f && mark->point[i].z > 0.0f);
		CHECK(float_abs(mark->point[i].x) < (hand->trembles ? 0.012f : 0.002f));
	}

	press(hand, TARGET_LASER);
	watch(hand);
	line(hand, v2_add(from, (struct v2){14, 0}), v2_add(to, (struct v2){14, 0}));
	CHECK(sent(hand, EDIT_MARK_BODY) == 2);
	CHECK(hand->sent.item[0].i[0] == 2 && hand->sent.item[1].i[0] == 3);
	CHECK(hand->sent.item[0].point[9].z > hand->sent.item[1].point[9].z + 0.05f);
	press(hand, TARGET_LASER);

	/* Beside the body the figure turns. */
	watch(hand);
	struct v3 axis = hand->ui->view.turn.row[2];
	struct v2 room = {(float)hand->ui->layout.left.w - 60.0f, 400.0f};
	line(hand, room, v2_add(room, (struct v2){0, 80}));
	CHECK(hand->sent.count == 0 && v3_distance(axis, hand->ui->view.turn.row[2]) > 0.05f);
	press(hand, TARGET_VIEW_FRONT);
}

static bool has_mark(const struct hand *hand, int side, int number)
{
	const struct marks *marks = &hand->session->document.marks;
	for (int m = 0; m < MARKS_MAX; m++)
		if (side == 0 ? marks->cloth[m].used && marks->cloth[m].number == number
			      : marks->body[m].used && marks->body[m].number == number)
			return true;
	return false;
}

static void check_erasing(struct hand *hand)
{
	press(hand, TARGET_ERASE);
	CHECK(hand->ui->erase);
	watch(hand);
	tap(hand, paper(hand, 340, -100)); /* on the line of 2 */
	CHECK(sent(hand, EDIT_UNMARK) == 1 && !has_mark(hand, 0, 2));
	tap(hand, figure(hand, hand->session->document.marks.body[1].point_m[0])); /* on number 2 */
	CHECK(!has_mark(hand, 1, 2) && has_mark(hand, 1, 1) && has_mark(hand, 1, 3));
	watch(hand);
	tap(hand, paper(hand, -100, 600));
	CHECK(hand->sent.count == 0);
	press(hand, TARGET_ERASE);
	hand->eraser = true; /* the other end of the pen: a stroke takes what it crosses */
	line(hand, paper(hand, -560, -100), paper(hand, -465, -100));
	hand->eraser = false;
	CHECK(!has_mark(hand, 0, 4) && has_mark(hand, 0, 1) && has_mark(hand, 0, 3));
	line(hand, paper(hand, 340, 100), paper(hand, 340, -200));
	CHECK(has_mark(hand, 0, 2)); /* the lowest free number is used again */
}

/* ---- buttons ---- */

static void check_twins(struct hand *hand)
{
	watch(hand);
	press(hand, TARGET_RELAX);
	CHECK(hand->sent.count == 0 && hand->ui->notice == TEXT_NOT_WORN);
	hand->ui->language = LANGUAGE_BOTH;
	press(hand, TARGET_LANGUAGE);
	CHECK(hand->ui->language == LANGUAGE_JAPANESE);
	press(hand, TARGET_HAND);
	CHECK(hand->ui->left_handed);
	press(hand, TARGET_HAND);

	/* CLEAR wants a second. */
	watch(hand);
	press(hand, TARGET_CLEAR);
	CHECK(hand->sent.count == 0);
	CHECK(ui_useful(hand->ui, hand->session, TARGET_WRAP));
	press(hand, TARGET_STEP_DRAW);
	CHECK(hand->ui->step == STEP_DRAW);
}

static void check_clear(struct hand *hand)
{
	struct v2 at = middle(hand->ui->layout.target[TARGET_CLEAR]);
	watch(hand);
	for (int i = 0; i < 300; i++)
		sample(hand, PEN_TOUCH, at);
	lift(hand, at);
	CHECK(sent(hand, EDIT_CLEAR) == 1 && hand->ui->step == STEP_DRAW && hand->ui->piece == -1);
	CHECK(!ui_useful(hand->ui, hand->session, TARGET_CLEAR));
	watch(hand);
	push_button(hand, BUTTON_WRAP, false);
	frame(hand);
	CHECK(hand->sent.count == 0 && hand->ui->notice == TEXT_NO_PAIR);
	CHECK(hand->ui->step == STEP_DRAW);
}

static float length_m(const struct edit *edit)
{
	float length = 0.0f;
	for (int i = 1; i < edit->point_count; i++)
		length += v3_distance(edit->point[i - 1], edit->point[i]);
	return length;
}

/* Down the very middle, where a symmetric mesh has its edges and a ray may fall between two
 * triangles, on both sides of the body. */
static void check_middle(struct hand *hand)
{
	press(hand, TARGET_STEP_MARK);
	press(hand, TARGET_LASER);
	watch(hand);
	line(hand, figure(hand, (struct v3){0, 1.36f, 0.1f}),
	     figure(hand, (struct v3){0, 0.95f, 0.1f}));
	CHECK(sent(hand, EDIT_MARK_BODY) == 2);
	CHECK_NEAR(length_m(&hand->sent.item[0]), 0.42f, 0.06f);
	CHECK_NEAR(length_m(&hand->sent.item[1]), 0.43f, 0.06f);
	press(hand, TARGET_LASER);
}

static void visit(struct hand *hand)
{
	check_drawing(hand);
	check_redrawing(hand);
	check_erasing_points(hand);
	check_buttons_of_pieces(hand);
	check_sewing(hand);
	check_cloth_marks(hand);
	check_laser_on_stack(hand);
	check_body_marks(hand);
	check_erasing(hand);
	check_twins(hand);
	check_clear(hand);
	check_middle(hand);
	check_clear(hand);
}

int main(void)
{
	visits(visit);
	CHECK(redrawn >= 6);
	return test_end();
}
