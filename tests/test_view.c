/* The camera: ray and projection undo each other, the trackball keeps a rotation and turns the way
 * the pen goes, the sheet's scale undoes itself. */
#include "test.h"
#include "ui.h"

static void check_rotation(const struct m3 *m)
{
	for (int r = 0; r < 3; r++)
		for (int c = 0; c < 3; c++)
			CHECK_NEAR(v3_dot(m->row[r], m->row[c]), r == c ? 1.0f : 0.0f, 2e-6);
	CHECK_NEAR(v3_dot(v3_cross(m->row[0], m->row[1]), m->row[2]), 1.0f, 4e-6);
}

static void check_inverse(const struct view *view)
{
	struct rect pane = view->pane;
	for (int i = 0; i < 64; i++) {
		struct v2 px = {(float)pane.x + (float)((i % 8) * pane.w) / 7.0f,
				(float)pane.y + (float)((i / 8) * pane.h) / 7.0f};
		for (float t = 0.5f; t < 9.0f; t *= 2.0f) {
			struct v3 origin, direction;
			struct v2 back;
			float depth;
			view_ray(view, px, &origin, &direction);
			CHECK_NEAR(v3_length(direction), 1.0f, 1e-6);
			CHECK(view_project(view, v3_mad(origin, direction, t), &back, &depth));
			CHECK(v2_distance(px, back) < 0.01f);
			CHECK(depth > 0.9f * t && depth <= t * 1.000001f);
			CHECK(!view_project(view, v3_mad(origin, direction, -t), &back, &depth));
		}
	}
}

/* The whole figure, from soles to crown and from hand to hand, is in the picture. */
static void check_framing(int width, int height)
{
	static const struct v3 end[] = {
		{0, 0, 0.15f}, {0, 1.72f, 0}, {0.6f, 0.9f, 0}, {-0.6f, 0.9f, 0}};
	struct layout layout;
	struct view view;
	layout_make(&layout, width, height, STEP_DRAW, false);
	view_init(&view, &layout);
	for (int k = 0; k < 4; k++) {
		view_look(&view, (float)k * 0.5f * PI_F);
		check_rotation(&view.turn);
		for (int i = 0; i < COUNT_OF(end); i++) {
			struct v2 px;
			float depth;
			CHECK(view_project(&view, end[i], &px, &depth));
			CHECK(rect_holds(view.pane, px));
		}
	}
	check_inverse(&view);
}

static void check_trackball(void)
{
	struct layout layout;
	struct view view;
	struct v2 before, after;
	float depth;
	layout_make(&layout, 1280, 720, STEP_DRAW, false);
	view_init(&view, &layout);
	struct v2 middle = {(float)view.pane.x + 0.5f * (float)view.pane.w,
			    (float)view.pane.y + 0.5f * (float)view.pane.h};

	/* A point on the front of the figure follows the pen. */
	struct v3 nose = v3_add(view.centre_m, (struct v3){0, 0, 0.1f});
	CHECK(view_project(&view, nose, &before, &depth));
	view_trackball(&view, middle, v2_add(middle, (struct v2){40, 0}));
	CHECK(view_project(&view, nose, &after, &depth));
	CHECK(after.x > before.x + 3.0f && float_abs(after.y - before.y) < 0.1f);
	view_trackball(&view, middle, v2_add(middle, (struct v2){0, -40}));
	CHECK(view_project(&view, nose, &before, &depth));
	CHECK(before.y < after.y - 3.0f);

	/* There and back again is where it was; a pen that stands still turns nothing. */
	view_look(&view, 0.3f);
	struct m3 old = view.turn;
	struct v2 to = v2_add(middle, (struct v2){120, 77});
	view_trackball(&view, middle, to);
	view_trackball(&view, to, middle);
	view_trackball(&view, to, to);
	for (int r = 0; r < 3; r++)
		CHECK(v3_distance(old.row[r], view.turn.row[r]) < 1e-4f);

	/* A day of visitors leaves a rotation. */
	struct scatter scatter = {7};
	struct v2 last = middle;
	for (int i = 0; i < 200000; i++) {
		struct v2 next = {(float)scatter_below(&scatter, view.pane.w),
				  (float)scatter_below(&scatter, layout.height)};
		view_trackball(&view, last, next);
		last = next;
	}
	check_rotation(&view.turn);
	check_inverse(&view);
}

static void check_sheet(void)
{
	struct layout layout;
	struct view view;
	layout_make(&layout, 1280, 720, STEP_DRAW, false);
	view_init(&view, &layout);
	float scale = view.sheet_px_per_mm;
	struct v2 mm = {-321.5f, 444.25f}, px = view_sheet_px(&view, mm);
	CHECK(v2_distance(view_sheet_mm(&view, px), mm) < 0.01f);
	CHECK(view_sheet_px(&view, (struct v2){0, 100}).y <
	      view_sheet_px(&view, (struct v2){0, 0}).y);

	view_sheet_show(&view, (struct v2){-300, -300}, (struct v2){300, 300});
	CHECK_NEAR(view.sheet_px_per_mm, scale, 0);
	view_sheet_show(&view, (struct v2){-300, -300}, (struct v2){2000, 300});
	CHECK(view.sheet_px_per_mm < scale);
	CHECK(rect_holds(view.sheet_pane, view_sheet_px(&view, (struct v2){1999, 299})));
	CHECK(rect_holds(view.sheet_pane, view_sheet_px(&view, mm)));
}

int main(void)
{
	check_framing(1280, 720);
	check_framing(1920, 1080);
	check_framing(800, 480);
	check_framing(640, 360);
	check_trackball();
	check_sheet();
	return test_end();
}
