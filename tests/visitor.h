/* A visitor's hand for tests of the face: steady, or with every sample up to 2 mm off. The session
 * is the real one. */
#ifndef VISITOR_H
#define VISITOR_H

#include "session.h"
#include "test.h"
#include "tool.h"
#include "ui.h"

#include <stdlib.h>

enum { WIDTH = 1280, HEIGHT = 720, SAMPLE_US = 4000, SAMPLES_A_FRAME = 4 };

static const float tremor_mm = 2.0f;

struct hand {
	struct session *session;
	struct ui *ui;
	struct arena arena;
	struct edit_list sent; /* since the last `watch` */
	struct frame_input input;
	int64_t now_us;
	struct scatter scatter;
	bool trembles, eraser;
};

/* ---- the hand ---- */

static inline void frame(struct hand *hand)
{
	static struct edit_list edits;
	edits.count = 0;
	ui_update(hand->ui, &hand->input, hand->session, &edits);
	for (int i = 0; i < edits.count; i++) {
		if (hand->sent.count < FRAME_EDITS_MAX)
			hand->sent.item[hand->sent.count++] = edits.item[i];
		session_apply(hand->session, &edits.item[i]);
	}
	hand->input.sample_count = 0;
	hand->input.buttons_pressed = 0;
}

static inline void watch(struct hand *hand)
{
	hand->sent.count = 0;
}

static inline int sent(const struct hand *hand, enum edit_kind kind)
{
	int count = 0;
	for (int i = 0; i < hand->sent.count; i++)
		count += hand->sent.item[i].kind == kind;
	return count;
}

static inline const struct edit *last(const struct hand *hand, enum edit_kind kind)
{
	static const struct edit nothing = {.kind = EDIT_KIND_COUNT};
	for (int i = hand->sent.count - 1; i >= 0; i--)
		if (hand->sent.item[i].kind == kind)
			return &hand->sent.item[i];
	return &nothing;
}

/* A unit disc's point, evenly. */
static inline struct v2 scattered(struct scatter *scatter)
{
	for (int i = 0; i < 100; i++) {
		struct v2 p = {(float)scatter_below(scatter, 2001) * 0.001f - 1.0f,
			       (float)scatter_below(scatter, 2001) * 0.001f - 1.0f};
		if (v2_dot(p, p) <= 1.0f)
			return p;
	}
	return (struct v2){0, 0};
}

static inline void sample(struct hand *hand, enum pen_state state, struct v2 at)
{
	if (hand->trembles)
		at = v2_add(at, v2_scale(scattered(&hand->scatter), tool_px(hand->ui, tremor_mm)));
	hand->now_us += SAMPLE_US;
	hand->input.sample[hand->input.sample_count++] = (struct pen_sample){
		.state = state,
		.time_us = hand->now_us,
		.position_px = at,
		.pressure = state == PEN_TOUCH ? 0.5f : 0.0f,
		.eraser = hand->eraser,
	};
	if (hand->input.sample_count == SAMPLES_A_FRAME)
		frame(hand);
}

static inline void lift(struct hand *hand, struct v2 at)
{
	for (int i = 0; i < SAMPLES_A_FRAME; i++)
		sample(hand, PEN_HOVER, at);
	frame(hand);
	frame(hand);
}

/* At 160 mm/s of the screen, slower at both ends, as hands do. */
static inline void stroke(struct hand *hand, const struct v2 *corner, int count)
{
	float length = stroke_length(corner, count), along = 0.0f;
	int steps = (int)(length / tool_px(hand->ui, 160.0f) * 1e6f / (float)SAMPLE_US) + 24;
	float step = length / (float)(steps - 23);
	for (int i = 0; i < 12; i++)
		sample(hand, PEN_TOUCH, corner[0]);
	for (int k = 1; k < count; k++) {
		float edge = v2_distance(corner[k - 1], corner[k]);
		for (; along < edge; along += step)
			sample(hand, PEN_TOUCH,
			       v2_lerp(corner[k - 1], corner[k], edge > 0 ? along / edge : 0));
		along -= edge;
	}
	for (int i = 0; i < 12; i++)
		sample(hand, PEN_TOUCH, corner[count - 1]);
	lift(hand, corner[count - 1]);
}

static inline void line(struct hand *hand, struct v2 from, struct v2 to)
{
	struct v2 corner[2] = {from, to};
	stroke(hand, corner, 2);
}

static inline void tap(struct hand *hand, struct v2 at)
{
	for (int i = 0; i < 22; i++)
		sample(hand, PEN_TOUCH, at);
	lift(hand, at);
}

static inline struct v2 middle(struct rect rect)
{
	return (struct v2){(float)rect.x + 0.5f * (float)rect.w,
			   (float)rect.y + 0.5f * (float)rect.h};
}

static inline void press(struct hand *hand, enum target target)
{
	CHECK(hand->ui->layout.target[target].w > 0);
	tap(hand, middle(hand->ui->layout.target[target]));
}

static inline struct v2 paper(const struct hand *hand, float x_mm, float y_mm)
{
	return view_sheet_px(&hand->ui->view, (struct v2){x_mm, y_mm});
}

static inline struct v2 figure(const struct hand *hand, struct v3 point_m)
{
	struct v2 px = {0, 0};
	float depth;
	CHECK(view_project(&hand->ui->view, point_m, &px, &depth));
	return px;
}

static inline const struct piece *piece_at(const struct hand *hand, int piece)
{
	return &hand->session->document.pattern.piece[piece];
}

static inline void draw_box(struct hand *hand, float x_mm, float y_mm, float w_mm, float h_mm)
{
	struct v2 corner[6] = {paper(hand, x_mm + 0.4f * w_mm, y_mm),
			       paper(hand, x_mm + w_mm, y_mm),
			       paper(hand, x_mm + w_mm, y_mm + h_mm),
			       paper(hand, x_mm, y_mm + h_mm),
			       paper(hand, x_mm, y_mm),
			       paper(hand, x_mm + 0.38f * w_mm, y_mm)};
	stroke(hand, corner, 6);
}

/* A press of a real button for one frame. */
static inline void push_button(struct hand *hand, enum button button, bool hold)
{
	hand->input.buttons_pressed = (uint8_t)(1u << button);
	hand->input.buttons_held = hold ? hand->input.buttons_pressed : 0;
	frame(hand);
}

/* How far a mark's points lie off the segment a b, at most. */
static inline float straying(const struct edit *edit, struct v2 a, struct v2 b)
{
	struct v2 segment[2] = {a, b};
	float worst = 0.0f;
	for (int i = 0; i < edit->point_count; i++)
		worst = float_max(worst,
				  stroke_distance(segment, 2,
						  (struct v2){edit->point[i].x, edit->point[i].y}));
	return worst;
}

/* Calls `visit` once with a steady hand and six times with a trembling one. */
static inline void visits(void (*visit)(struct hand *hand))
{
	struct hand *hand = calloc(1, sizeof *hand);
	void *memory = malloc(KIOSK_MEMORY_BYTES);
	hand->ui = calloc(1, sizeof *hand->ui);
	hand->session = calloc(1, sizeof *hand->session);
	arena_init(&hand->arena, memory, KIOSK_MEMORY_BYTES);
	session_init(hand->session, &hand->arena);
	CHECK(!body_build_mannequin(&hand->session->body));
	for (unsigned seed = 0; seed <= 6; seed++) {
		int failures = test_failures;
		ui_init(hand->ui, WIDTH, HEIGHT);
		hand->trembles = seed > 0;
		hand->scatter.state = seed * 2654435761u + 1u;
		visit(hand);
		if (test_failures > failures)
			fprintf(stderr, "with the hand of seed %u\n", seed);
	}
	free(memory);
	free(hand->session);
	free(hand->ui);
	free(hand);
}

#endif
