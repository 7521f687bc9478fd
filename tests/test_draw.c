/* The picture: where things are drawn, in which colours, and that a frame depends on nothing but
 * what it shows. Colours are judged by their relations, not by exact values: drivers differ in the
 * last bits. */
#include "display.h"
#include "draw_private.h"
#include "scene.h"
#include "leaks.h"
#include "test.h"

enum { WIDTH = 640, HEIGHT = 360 };

struct stage {
	struct scene *scene;
	struct display *display;
	struct draw *draw;
	struct ui ui;
	uint8_t rgba[WIDTH * HEIGHT * 4];
};

struct colour {
	int red, green, blue;
};

static void show(struct stage *stage)
{
	draw_frame(stage->draw, &stage->ui, &stage->scene->session);
	display_read(stage->display, stage->rgba);
	CHECK(glGetError() == GL_NO_ERROR);
}

static struct colour colour_at(const struct stage *stage, struct v2 px)
{
	int x = int_clamp((int)px.x, 0, WIDTH - 1), y = int_clamp((int)px.y, 0, HEIGHT - 1);
	const uint8_t *p = stage->rgba + (y * WIDTH + x) * 4;
	return (struct colour){p[0], p[1], p[2]};
}

static struct v2 project(const struct stage *stage, struct v3 point_m)
{
	struct v2 px = {0};
	float depth_m;
	CHECK(view_project(&stage->ui.view, point_m, &px, &depth_m));
	return px;
}

/* A body point that is seen from the front, at a height and to a side. */
static struct v3 body_point(const struct stage *stage, float x, float y)
{
	struct body_hit hit = {0};
	CHECK(body_ray(&stage->scene->session.body, (struct v3){x, y, 2.0f},
		       (struct v3){0.0f, 0.0f, -1.0f}, &hit));
	return hit.point_m;
}

static int distance(struct colour a, struct colour b)
{
	int red = a.red - b.red, green = a.green - b.green, blue = a.blue - b.blue;
	return red * red + green * green + blue * blue;
}

/* GL's matrices against the camera that picks (view.c), for points all over, near and far. */
static void camera_agrees_with_view(struct stage *stage)
{
	struct camera camera;
	struct scatter scatter = {77};
	for (int i = 0; i < 200; i++) {
		float c[3];
		for (int k = 0; k < 3; k++)
			c[k] = (float)scatter_below(&scatter, 2000) / 1000.0f - 1.0f;
		struct v3 point_m = {c[0], c[1] + 0.9f, c[2]};
		struct v2 px;
		float depth_m, clip[4];
		view_look(&stage->ui.view, (float)i);
		camera_make(&camera, &stage->ui.view, &stage->scene->session.body);
		camera_clip(&camera, point_m, 0.0f, clip);
		CHECK(view_project(&stage->ui.view, point_m, &px, &depth_m));
		const struct rect *pane = &stage->ui.view.pane;
		float x = (float)pane->x + (clip[0] / clip[3] + 1.0f) * 0.5f * (float)pane->w;
		float y = (float)pane->y + (1.0f - clip[1] / clip[3]) * 0.5f * (float)pane->h;
		CHECK_NEAR(x, px.x, 0.02);
		CHECK_NEAR(y, px.y, 0.02);
		CHECK_NEAR(clip[3], depth_m, 1e-4);
		CHECK(clip[2] > -clip[3] && clip[2] < clip[3]);
	}
	view_look(&stage->ui.view, 0.0f);
}

static void reordering_loses_nothing(struct stage *stage)
{
	const struct body *body = &stage->scene->session.body;
	struct mesh_order *order = &stage->draw->order;
	static bool seen[BODY_TRIANGLES_MAX], used[BODY_VERTICES_MAX];
	mesh_order(order, body->position_m, body->vertex_count, body->triangle,
		   body->triangle_count);
	for (int t = 0; t < body->triangle_count; t++)
		seen[order->triangle[t]] = true;
	for (int v = 0; v < body->vertex_count; v++)
		used[order->rank[v]] = true;
	for (int t = 0; t < body->triangle_count; t++)
		CHECK(seen[t]);
	for (int v = 0; v < body->vertex_count; v++)
		CHECK(used[v]);
	CHECK(!used[body->vertex_count]);
}

/* The mannequin stands where the camera says, brighter towards the key on the upper left. */
static void body_is_lit(struct stage *stage)
{
	show(stage);
	struct v2 chest = project(stage, body_point(stage, 0.0f, 1.25f));
	struct v2 beside = project(stage, (struct v3){0.9f, 1.25f, 0.0f});
	struct colour body = colour_at(stage, chest), room = colour_at(stage, beside);
	CHECK(distance(body, room) > 200);
	CHECK(body.red > body.green && body.green > body.blue && body.red > 120);
	CHECK(room.red > 180 && room.red > room.blue);
	struct colour left = colour_at(stage, project(stage, body_point(stage, -0.05f, 1.58f)));
	struct colour right = colour_at(stage, project(stage, body_point(stage, 0.06f, 1.58f)));
	CHECK(left.red > right.red);
	struct colour paper = colour_at(stage, (struct v2){WIDTH - 8.0f, HEIGHT * 0.6f});
	CHECK(paper.red > 220 && paper.green > 210);
}

/* Swatch 0 is blue: the cloth is bluer than red; swatch 2 is red. Its colour comes from the
 * document, not from when the garment was made. */
static void cloth_has_its_colour(struct stage *stage)
{
	struct piece *piece = stage->scene->session.document.pattern.piece;
	stage->ui.step = STEP_ADJUST; /* no marks in the way */
	show(stage);
	struct v2 belly = project(stage, body_point(stage, -0.05f, 1.05f));
	struct colour blue = colour_at(stage, belly);
	CHECK(blue.blue > blue.red + 10);
	piece[0].swatch = piece[1].swatch = 2;
	show(stage);
	struct colour red = colour_at(stage, belly);
	CHECK(red.red > red.blue + 20);
	piece[0].swatch = piece[1].swatch = 0;
	show(stage);
	CHECK(distance(colour_at(stage, belly), blue) == 0);
}

static bool colour_near(const struct stage *stage, struct v2 px, uint32_t colour)
{
	struct colour wanted = {(int)(colour >> 16 & 255), (int)(colour >> 8 & 255),
				(int)(colour & 255)};
	for (int y = -3; y <= 3; y++)
		for (int x = -3; x <= 3; x++)
			if (distance(
				    colour_at(stage, (struct v2){px.x + (float)x, px.y + (float)y}),
				    wanted) < 1500)
				return true;
	return false;
}

/* The mark on the worn front shows in its colour in step 4, and not in step 5. */
static void marks_show_when_they_matter(struct stage *stage)
{
	struct v3 middle_m = body_point(stage, 0.0f, 1.12f);
	stage->ui.step = STEP_DRESS;
	show(stage);
	CHECK(colour_near(stage, project(stage, middle_m), look_mark_style(1)->colour));
	stage->ui.step = STEP_ADJUST;
	show(stage);
	CHECK(!colour_near(stage, project(stage, middle_m), look_mark_style(1)->colour));
}

static void pins_have_heads(struct stage *stage)
{
	struct pin *pin = stage->scene->session.document.pin;
	stage->ui.step = STEP_ADJUST;
	show(stage);
	static uint8_t before[sizeof stage->rgba];
	memcpy(before, stage->rgba, sizeof before);
	pin[0] = (struct pin){.used = true, .piece = 0, .point_mm = {0.0f, -400.0f}};
	show(stage);
	int changed = 0, purple = 0;
	for (int i = 0; i < WIDTH * HEIGHT; i++) {
		const uint8_t *p = stage->rgba + 4 * i;
		if (i % WIDTH < stage->ui.view.pane.w && memcmp(p, before + 4 * i, 3)) {
			changed++;
			purple += p[0] > p[1] + 30 && p[2] > p[1] + 10;
		}
	}
	CHECK(changed > 20 && changed < 1500);
	CHECK(purple > 10);
	pin[0].used = false;
}

static uint64_t picture_hash(const struct stage *stage)
{
	struct hash hash;
	hash_init(&hash);
	for (int i = 0; i < WIDTH * HEIGHT; i++) {
		const uint8_t *p = stage->rgba + 4 * i;
		hash_u32(&hash, (uint32_t)(p[0] << 16 | p[1] << 8 | p[2]));
	}
	return hash.value;
}

/* The same state gives the same pixels: at once, after other things were shown, and from a renderer
 * that has just been opened. */
static void frames_depend_on_nothing_else(struct stage *stage)
{
	char fault[200];
	stage->ui.step = STEP_DRESS;
	show(stage);
	uint64_t first = picture_hash(stage);
	show(stage);
	CHECK(picture_hash(stage) == first);
	stage->ui.step = STEP_MARK;
	view_look(&stage->ui.view, 2.0f);
	show(stage);
	CHECK(picture_hash(stage) != first);
	stage->ui.step = STEP_DRESS;
	view_look(&stage->ui.view, 0.0f);
	show(stage);
	CHECK(picture_hash(stage) == first);
	draw_close(stage->draw);
	stage->draw = draw_open(WIDTH, HEIGHT, fault);
	CHECK(stage->draw);
	show(stage);
	CHECK(picture_hash(stage) == first);
}

/* A window's own buffers count their rows the other way round; the picture is the same. SDL's
 * offscreen driver stands in for a desktop. */
static void window_shows_the_same(struct stage *stage)
{
	char fault[200];
	int width = WIDTH, height = HEIGHT, differ = 0;
	static uint8_t memory[sizeof stage->rgba];
	show(stage);
	memcpy(memory, stage->rgba, sizeof memory);
	draw_close(stage->draw);
	display_close(stage->display);
	setenv("SDL_VIDEODRIVER", "offscreen", 1);
	stage->display = display_open(DISPLAY_WINDOW, &width, &height, fault);
	if (!stage->display) {
		fprintf(stderr, "window not tested: %s\n", fault);
		stage->display = display_open(DISPLAY_HEADLESS, &width, &height, fault);
	}
	stage->draw = draw_open(WIDTH, HEIGHT, fault);
	CHECK(stage->draw);
	for (int i = 0; i < 2; i++) {
		show(stage);
		display_present(stage->display);
	}
	for (int i = 0; i < WIDTH * HEIGHT; i++)
		for (int k = 0; k < 3; k++)
			if (int_max(memory[4 * i + k], stage->rgba[4 * i + k]) -
				    int_min(memory[4 * i + k], stage->rgba[4 * i + k]) >
			    24) {
				differ++;
				break;
			}
	CHECK(differ < WIDTH * HEIGHT / 500);
}

/* More lines than fit are dropped, and the frame goes on. */
static void full_is_an_answer(struct stage *stage)
{
	struct stroke stroke = {0, 1.0f, 1.0f, DASH_SOLID, 1.0f};
	struct v3 a_m = {0}, b_m = {0.1f, 0.0f, 0.0f};
	ribbons_begin(stage->draw);
	for (int i = 0; i < RIBBON_VERTICES_MAX; i++)
		ribbons_segment(stage->draw, a_m, b_m, 0.0f, &stroke);
	CHECK(stage->draw->ribbons.count == RIBBON_VERTICES_MAX);
	sprites_begin(stage->draw);
	for (int i = 0; i < SPRITES_MAX + 9; i++)
		sprite_pin(stage->draw, a_m);
	CHECK(stage->draw->sprites.count == SPRITES_MAX);
	ribbons_draw(stage->draw, 0.0f);
	sprites_draw(stage->draw, false);
	show(stage);
}

int main(void)
{
	static struct stage stage;
	char fault[200];
	int width = WIDTH, height = HEIGHT;
	stage.display = display_open(DISPLAY_HEADLESS, &width, &height, fault);
	if (!stage.display) {
		printf("no EGL here: %s\n", fault);
		return 77;
	}
	stage.scene = scene_open();
	stage.draw = draw_open(WIDTH, HEIGHT, fault);
	CHECK(stage.draw);
	if (!stage.draw)
		return fprintf(stderr, "%s\n", fault), test_end();
	ui_init(&stage.ui, WIDTH, HEIGHT);
	stage.ui.pen_state = PEN_AWAY;
	camera_agrees_with_view(&stage);
	reordering_loses_nothing(&stage);
	body_is_lit(&stage);
	CHECK(scene_play(stage.scene, "tests/journals/tshirt.kitsuke") == 0);
	CHECK(scene_wrap(stage.scene));
	cloth_has_its_colour(&stage);
	marks_show_when_they_matter(&stage);
	pins_have_heads(&stage);
	frames_depend_on_nothing_else(&stage);
	window_shows_the_same(&stage);
	full_is_an_answer(&stage);
	draw_close(stage.draw);
	display_close(stage.display);
	scene_close(stage.scene);
	return test_end();
}
