/* Steps 4 and 5: the worn garment is dragged, pinned, relaxed and marked, by a steady hand and by
 * trembling ones. */
#include "visitor.h"

/* ---- steps 4 and 5, on a sheet of cloth that hangs before the chest ---- */

static void wear_sheet(struct hand *hand)
{
	enum { SIDE = 9 };
	struct session *session = hand->session;
	struct garment *garment = &session->garment;
	struct cloth *cloth = &session->cloth;
	garment->vertex_count = SIDE * SIDE;
	garment->triangle_count = 0;
	garment->pair_count = 0;
	for (int i = 0; i < SIDE * SIDE; i++) {
		garment->rest_m[i] = (struct v2){0.02f * (float)(i % SIDE),
						 0.04f * (float)(i / SIDE)};
		garment->piece[i] = 0;
		garment->weld[i] = i;
	}
	for (int y = 0; y + 1 < SIDE; y++)
		for (int x = 0; x + 1 < SIDE; x++) {
			int a = y * SIDE + x, t = garment->triangle_count;
			garment->triangle[t] = (struct triangle){{a, a + 1, a + SIDE}};
			garment->triangle[t + 1] = (struct triangle){
				{a + 1, a + SIDE + 1, a + SIDE}};
			garment->triangle_piece[t] = garment->triangle_piece[t + 1] = 0;
			garment->triangle_count += 2;
		}
	for (int p = 0; p <= PIECES_MAX; p++) {
		garment->piece_first[p] = p == 0 ? 0 : garment->vertex_count;
		garment->piece_first_triangle[p] = p == 0 ? 0 : garment->triangle_count;
	}
	garment->edge_m = 0.04f;
	cloth_reset(cloth, garment, &session->body);
	for (int i = 0; i < SIDE * SIDE; i++) {
		struct body_hit hit;
		struct v3 far = {garment->rest_m[i].x - 0.08f, 1.0f + garment->rest_m[i].y, 0.4f};
		CHECK(body_ray(&session->body, far, (struct v3){0, 0, -1}, &hit));
		cloth->position_m[i] = v3_mad(hit.point_m, hit.normal, 0.006f);
		cloth->previous_m[i] = cloth->position_m[i];
		cloth->placed[i] = 1;
	}
	cloth->worn = true;
}

static void check_adjusting(struct hand *hand)
{
	struct session *session = hand->session;
	draw_box(hand, -700, -300, 320, 400);
	wear_sheet(hand);
	frame(hand);
	struct v3 grip = session->cloth.position_m[40];
	struct v2 from = figure(hand, grip);
	press(hand, TARGET_STEP_DRESS);
	watch(hand);
	tap(hand, from); /* without pin mode a tap does nothing */
	CHECK(hand->sent.count == 0);
	line(hand, from, v2_add(from, (struct v2){0, -60}));
	const struct edit *grab = last(hand, EDIT_GRAB);
	CHECK(sent(hand, EDIT_GRAB) == 1 && hand->ui->step == STEP_ADJUST);
	CHECK(grab->i[0] == 0);
	CHECK_NEAR(grab->f[0], 80, hand->trembles ? 16 : 4);
	CHECK_NEAR(grab->f[1], 160, hand->trembles ? 16 : 4);
	CHECK(sent(hand, EDIT_DRAG) > 5);
	CHECK(session->drag_target_m.y > grip.y + 0.05f);
	CHECK(!session->drag.active);

	watch(hand);
	wear_sheet(hand);
	tap(hand, from);
	CHECK(hand->sent.count == 0);
	press(hand, TARGET_PIN);
	CHECK(hand->ui->pin_mode);
	tap(hand, from);
	CHECK(sent(hand, EDIT_PIN) == 1 && session->document.pin[0].used);
	tap(hand, from);
	CHECK(sent(hand, EDIT_UNPIN) == 1 && !session->document.pin[0].used);
	press(hand, TARGET_PIN);
	CHECK(!hand->ui->pin_mode);

	/* The real button pins what the pen points at, and is pin mode while it is held. */
	watch(hand);
	lift(hand, from);
	push_button(hand, BUTTON_PIN, true);
	CHECK(sent(hand, EDIT_PIN) == 1 && hand->ui->pin_mode);
	hand->input.buttons_held = 0;
	frame(hand);
	CHECK(!hand->ui->pin_mode);

	/* RELAX lasts as long as it is held, by the button or by the twin. */
	watch(hand);
	push_button(hand, BUTTON_RELAX, true);
	frame(hand);
	CHECK(session->relaxing && sent(hand, EDIT_RELAX) == 1);
	hand->input.buttons_held = 0;
	frame(hand);
	CHECK(!session->relaxing && sent(hand, EDIT_RELAX) == 2);
	press(hand, TARGET_RELAX);
	CHECK(!session->relaxing && sent(hand, EDIT_RELAX) == 4);
}

/* A line on the worn cloth belongs to the cloth (S9); the other end of the pen takes it off. */
static void check_worn_mark(struct hand *hand)
{
	struct session *session = hand->session;
	wear_sheet(hand);
	ui_step(hand->ui, STEP_MARK);
	watch(hand);
	struct v2 from = figure(hand, session->cloth.position_m[20]);
	struct v2 to = figure(hand, session->cloth.position_m[56]);
	line(hand, from, to);
	const struct edit *mark = last(hand, EDIT_MARK_CLOTH);
	CHECK(hand->sent.count == 1 && mark->i[1] == 0 && mark->point_count >= 10);
	CHECK(straying(mark, (struct v2){40, 80}, (struct v2){40, 240}) <
	      (hand->trembles ? 12.0f : 3.0f));
	hand->eraser = true;
	tap(hand, figure(hand, session->cloth.position_m[38]));
	hand->eraser = false;
	CHECK(sent(hand, EDIT_UNMARK) == 1);
}

static void visit(struct hand *hand)
{
	struct edit clear = {.kind = EDIT_CLEAR};
	check_adjusting(hand);
	check_worn_mark(hand);
	session_apply(hand->session, &clear);
}

int main(void)
{
	visits(visit);
	return test_end();
}
