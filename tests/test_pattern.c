/* Pieces, their faults, and how a trembling hand's loop becomes an outline. */
#include "pattern.h"
#include "test.h"

#include <string.h>

enum { PATH_MAX_POINTS = 8192 };

/* A drawn line under construction: the shape, then the samples of a hand that follows it. */
static int path_count;
static struct v2 path[PATH_MAX_POINTS];
static int stroke_count;
static struct v2 stroke[STROKE_SAMPLES_MAX];

static void move_to(float x, float y)
{
	path[0] = (struct v2){x, y};
	path_count = 1;
}

static void line_to(float x, float y)
{
	struct v2 a = path[path_count - 1], b = {x, y};
	int steps = (int)v2_distance(a, b) + 1;
	for (int i = 1; i <= steps; i++)
		path[path_count++] = v2_lerp(a, b, (float)i / (float)steps);
}

static void curve_to(struct v2 b, struct v2 c, struct v2 d)
{
	struct v2 a = path[path_count - 1];
	for (int i = 1; i <= 300; i++) {
		float u = (float)i / 300.0f;
		struct v2 ab = v2_lerp(a, b, u), bc = v2_lerp(b, c, u), cd = v2_lerp(c, d, u);
		path[path_count++] = v2_lerp(v2_lerp(ab, bc, u), v2_lerp(bc, cd, u), u);
	}
}

/* Even noise of +-tremor_mm on samples every spacing_mm along the path. */
static void draw(float spacing_mm, float tremor_mm, uint32_t seed)
{
	struct scatter scatter = {seed * 2654435761u + 17u};
	float passed = 0.0f;
	stroke_count = 0;
	for (int i = 0; i < path_count; i++) {
		passed += i > 0 ? v2_distance(path[i - 1], path[i]) : spacing_mm;
		if (passed < spacing_mm)
			continue;
		passed -= spacing_mm;
		float x = (float)scatter_below(&scatter, 2001) / 1000.0f - 1.0f;
		float y = (float)scatter_below(&scatter, 2001) / 1000.0f - 1.0f;
		stroke[stroke_count++] = (struct v2){path[i].x + tremor_mm * x,
						     path[i].y + tremor_mm * y};
	}
}

static const struct v2 shirt_corner[] = {{-90, 300},  {90, 300},   {370, 235},   {330, 120},
					 {220, 150},  {240, -330}, {-240, -330}, {-220, 150},
					 {-330, 120}, {-370, 235}};

/* The front of a T-shirt, clockwise from its left neck point. */
static void shirt_path(void)
{
	move_to(-90, 300);
	curve_to((struct v2){-80, 220}, (struct v2){80, 220}, (struct v2){90, 300});
	for (int k = 2; k <= 10; k++)
		line_to(shirt_corner[k % 10].x, shirt_corner[k % 10].y);
}

static float distance_to_path(struct v2 p)
{
	float best = 1e30f;
	for (int i = 0; i < path_count; i++)
		best = float_min(best, v2_distance(p, path[i]));
	return best;
}

static float distance_to_outline(const struct piece *piece, struct v2 sheet)
{
	int edge;
	float fraction;
	return piece_nearest_edge(piece, piece_from_sheet(piece, sheet), &edge, &fraction);
}

/* Both ways: no part of the outline strays, no part of the drawing is lost. */
static float worst_distance(const struct piece *piece)
{
	float worst = 0.0f;
	for (int i = 0; i < piece->point_count; i++)
		worst = float_max(worst,
				  distance_to_path(piece_to_sheet(piece, piece->point_mm[i])));
	for (int i = 0; i < path_count; i += 5)
		worst = float_max(worst, distance_to_outline(piece, path[i]));
	return worst;
}

static void check_outline(const struct piece *piece)
{
	CHECK(!piece_fault(piece));
	CHECK(piece->corner[0]);
	CHECK(piece->point_count <= OUTLINE_POINTS_MAX);
	CHECK(piece_area_mm2(piece) > 0.0f);
}

static void test_shirt_by_a_trembling_hand(void)
{
	static const float tremor[] = {0, 5, 10, 20};
	for (int t = 0; t < COUNT_OF(tremor); t++)
		for (uint32_t seed = 1; seed <= 20; seed++) {
			struct piece piece = {0};
			shirt_path();
			draw(1.5f, tremor[t], seed);
			const char *fault = piece_from_stroke(&piece, stroke, stroke_count);
			CHECK(!fault);
			check_outline(&piece);
			int edges = piece_edge_count(&piece);
			float worst = worst_distance(&piece);
			if (edges != 10 || worst > 15.0f)
				fprintf(stderr, "tremor %.0f seed %u: %d edges, %.1f mm off\n",
					(double)tremor[t], seed, edges, (double)worst);
			CHECK(edges == 10);
			CHECK(worst <= 15.0f);
		}
}

static void test_shirt_corners(void)
{
	struct piece piece = {0};
	shirt_path();
	draw(2.0f, 0.0f, 1);
	CHECK(!piece_from_stroke(&piece, stroke, stroke_count));
	for (int k = 0; k < COUNT_OF(shirt_corner); k++) {
		float best = 1e30f;
		for (int i = 0; i < piece.point_count; i++)
			if (piece.corner[i])
				best = float_min(
					best, v2_distance(piece_to_sheet(&piece, piece.point_mm[i]),
							  shirt_corner[k]));
		CHECK(best < 3.0f);
	}
	/* Straight runs are straight: nine of ten edges need only their corners. */
	int straight = 0;
	for (int k = 0; k < piece_edge_count(&piece); k++) {
		int first, last;
		piece_edge(&piece, k, &first, &last);
		straight += (first + 1) % piece.point_count == last;
	}
	CHECK(straight == 9);
}

static void square_path(float overlap)
{
	move_to(0, 0);
	line_to(300, 0);
	line_to(300, 200);
	line_to(0, 200);
	line_to(0, -overlap);
}

static void test_closing(void)
{
	/* An overlap, a meeting, a gap of 90 mm: a rectangle each time. */
	for (int overlap = 60; overlap >= -90; overlap -= 30) {
		struct piece piece = {0};
		square_path((float)overlap);
		draw(2.0f, 1.0f, 5);
		CHECK(!piece_from_stroke(&piece, stroke, stroke_count));
		check_outline(&piece);
		CHECK(piece_edge_count(&piece) == 4);
		CHECK_NEAR(piece_area_mm2(&piece), 60000, 1500);
		CHECK_NEAR(piece.position_mm.x, 150, 3);
		CHECK_NEAR(piece.position_mm.y, 100, 3);
	}
}

static void test_round(void)
{
	struct piece piece = {0};
	path_count = 0;
	for (int i = 0; i <= 720; i++) {
		float angle = PI_F * (float)i / 360.0f;
		path[path_count++] = (struct v2){200 * angle_cos(angle), 120 * angle_sin(angle)};
	}
	draw(2.0f, 0.5f, 1);
	CHECK(!piece_from_stroke(&piece, stroke, stroke_count));
	check_outline(&piece);
	CHECK(piece_edge_count(&piece) == 4);
	CHECK(worst_distance(&piece) < 4.0f);
}

/* A mouse that moves fast leaves few samples. */
static void test_sparse(void)
{
	struct piece piece = {0};
	square_path(0);
	draw(40.0f, 0.0f, 1);
	CHECK(!piece_from_stroke(&piece, stroke, stroke_count));
	CHECK(piece_edge_count(&piece) == 4);
	CHECK_NEAR(piece_area_mm2(&piece), 60000, 3000);
}

static void test_refused_strokes(void)
{
	struct piece piece = {.point_count = 7};
	move_to(0, 0);
	line_to(10, 0);
	line_to(10, 10);
	line_to(0, 10);
	line_to(0, 0);
	draw(1.0f, 0.0f, 1);
	CHECK(piece_from_stroke(&piece, stroke, stroke_count)); /* tiny */
	move_to(0, 0);
	line_to(500, 10);
	draw(2.0f, 0.0f, 1);
	CHECK(piece_from_stroke(&piece, stroke, stroke_count)); /* open */
	move_to(0, 0);
	line_to(300, 300);
	line_to(300, 0);
	line_to(0, 300);
	line_to(0, 0);
	draw(2.0f, 0.0f, 1);
	CHECK(piece_from_stroke(&piece, stroke, stroke_count)); /* an eight */
	CHECK(piece_from_stroke(&piece, stroke, 0));
	stroke[9].x = NAN;
	CHECK(piece_from_stroke(&piece, stroke, stroke_count));
	for (int i = 0; i < STROKE_SAMPLES_MAX; i++)
		stroke[i] = (struct v2){1, 1};
	CHECK(piece_from_stroke(&piece, stroke, STROKE_SAMPLES_MAX));
	CHECK(piece.point_count == 7); /* a refused stroke changes nothing */
}

/* Small loops where the pen turned are no reason to refuse a piece; they are cut off. */
static void test_curls(void)
{
	struct piece piece = {0};
	int taken = 0;
	move_to(0, 0);
	line_to(400, 0);
	line_to(430, -10);
	line_to(425, -35);
	line_to(400, -30);
	line_to(405, 20);
	line_to(400, 600);
	line_to(370, 622);
	line_to(360, 590);
	line_to(410, 596);
	line_to(0, 600);
	line_to(0, 0);
	for (uint32_t seed = 1; seed <= 10; seed++) {
		draw(2.0f, 2.0f, seed);
		if (piece_from_stroke(&piece, stroke, stroke_count))
			continue;
		taken++;
		check_outline(&piece);
		CHECK_NEAR(piece_area_mm2(&piece), 400 * 600, 6000);
	}
	CHECK(taken == 10);
}

static struct piece rectangle(void)
{
	struct piece piece = {.used = true, .point_count = 4};
	static const struct v2 point[] = {{-200, -300}, {200, -300}, {200, 300}, {-200, 300}};
	memcpy(piece.point_mm, point, sizeof point);
	for (int i = 0; i < 4; i++)
		piece.corner[i] = true;
	return piece;
}

/* A neckline redrawn by a hand that dwells and trembles where it begins and ends: the little
 * knots that it leaves there are no reason to refuse the line. */
static void test_oversketch_by_a_trembling_hand(void)
{
	int taken = 0;
	for (uint32_t seed = 1; seed <= 40; seed++) {
		struct piece piece = rectangle();
		move_to(-200, 300);
		for (int i = 0; i < 12; i++)
			line_to(-200 + (i % 2 ? 7.0f : -7.0f), 300 + (i % 3 ? 6.0f : -6.0f));
		curve_to((struct v2){-100, 180}, (struct v2){100, 180}, (struct v2){190, 286});
		for (int i = 0; i < 12; i++)
			line_to(190 + (i % 2 ? 7.0f : -7.0f), 286 + (i % 3 ? 9.0f : -9.0f));
		draw(2.0f, 7.0f, seed);
		if (piece_oversketch(&piece, stroke, stroke_count))
			continue;
		taken++;
		check_outline(&piece);
		CHECK_NEAR(piece_area_mm2(&piece), 213000, 9000);
	}
	CHECK(taken >= 36);
}

static void test_oversketch_edge(void)
{
	/* The top is redrawn as a neck line from corner to corner, from the right and the left. */
	for (int way = 0; way < 2; way++)
		for (int mirrored = 0; mirrored < 2; mirrored++) {
			struct piece piece = rectangle();
			piece.inside_up = mirrored;
			piece.position_mm = (struct v2){1000, 500};
			piece.turn_rad = 0.3f;
			move_to(-205, 292);
			curve_to((struct v2){-100, 150}, (struct v2){100, 150},
				 (struct v2){205, 292});
			draw(2.0f, 2.0f, 1);
			for (int i = 0; i < stroke_count; i++)
				stroke[i] = piece_to_sheet(&piece, stroke[i]);
			for (int i = 0, k = stroke_count - 1; way == 1 && i < k; i++, k--) {
				struct v2 swap = stroke[i];
				stroke[i] = stroke[k];
				stroke[k] = swap;
			}
			const char *fault = piece_oversketch(&piece, stroke, stroke_count);
			CHECK(!fault);
			check_outline(&piece);
			CHECK(piece_edge_count(&piece) == 4);
			CHECK(piece.point_mm[0].x == -200.0f && piece.point_mm[0].y == -300.0f);
			struct v2 middle = piece_edge_point(&piece, 2, 0.5f);
			CHECK_NEAR(middle.x, 0, 4);
			CHECK_NEAR(middle.y, 185.5f, 5);
			CHECK_NEAR(piece_edge_length_mm(&piece, 0), 400, 1e-3);
		}
}

static void test_oversketch_bulge(void)
{
	/* A box on the right side: four new corners. */
	struct piece piece = rectangle();
	move_to(198, -100);
	line_to(300, -100);
	line_to(300, 100);
	line_to(205, 100);
	draw(2.0f, 1.0f, 3);
	CHECK(!piece_oversketch(&piece, stroke, stroke_count));
	check_outline(&piece);
	CHECK(piece_edge_count(&piece) == 8);
	CHECK_NEAR(piece_area_mm2(&piece), 400 * 600 + 100 * 200, 800);
	/* From nowhere to nowhere. */
	piece = rectangle();
	move_to(-60, 0);
	line_to(60, 0);
	draw(2.0f, 0.0f, 1);
	CHECK(piece_oversketch(&piece, stroke, stroke_count));
	CHECK(piece.point_count == 4);
}

static void test_sheet(void)
{
	struct piece piece = rectangle();
	piece.inside_up = true;
	piece.position_mm = (struct v2){10, 20};
	piece.turn_rad = 0.5f * PI_F;
	struct v2 p = piece_to_sheet(&piece, (struct v2){-200, -300});
	CHECK_NEAR(p.x, 310, 1e-3);
	CHECK_NEAR(p.y, 220, 1e-3);
	struct v2 q = piece_from_sheet(&piece, p);
	CHECK_NEAR(q.x, -200, 1e-3);
	CHECK_NEAR(q.y, -300, 1e-3);
}

static void test_edges(void)
{
	struct piece piece = rectangle();
	piece.corner[0] = piece.corner[2] = false;
	CHECK(piece_edge_count(&piece) == 2);
	int first, last;
	piece_edge(&piece, 1, &first, &last);
	CHECK(first == 3 && last == 1);
	CHECK_NEAR(piece_edge_length_mm(&piece, 1), 1000, 1e-3);
	struct v2 p = piece_edge_point(&piece, 1, 0.8f);
	CHECK_NEAR(p.x, 0, 1e-3);
	CHECK_NEAR(p.y, -300, 1e-3);
	int edge;
	float fraction;
	CHECK_NEAR(piece_nearest_edge(&piece, (struct v2){-210, 100}, &edge, &fraction), 10, 1e-3);
	CHECK(edge == 1);
	CHECK_NEAR(fraction, 0.2, 1e-5);
	/* One corner: the edge is the whole outline. */
	piece.corner[3] = false;
	piece_edge(&piece, 0, &first, &last);
	CHECK(first == 1 && last == 1);
	CHECK_NEAR(piece_edge_length_mm(&piece, 0), 2000, 1e-3);
	CHECK(piece_contains(&piece, (struct v2){199, -299}));
	CHECK(!piece_contains(&piece, (struct v2){201, 0}));
}

static void test_pick(void)
{
	static struct pattern pattern;
	pattern.piece[2] = pattern.piece[5] = rectangle();
	pattern.piece[2].layer = 3;
	pattern.piece[5].layer = 7;
	CHECK(pattern_pick(&pattern, (struct v2){0, 0}, 0) == 5);
	CHECK(pattern_pick(&pattern, (struct v2){0, 0}, 1u << 5) == 2);
	CHECK(pattern_pick(&pattern, (struct v2){900, 0}, 0) == -1);
}

static void test_faults(void)
{
	struct piece piece = rectangle();
	CHECK(!piece_fault(&piece));
	piece.point_mm[2] = (struct v2){-300, -400};
	CHECK(piece_fault(&piece)); /* crosses */
	piece = rectangle();
	piece.point_mm[2] = (struct v2){-200, -300};
	CHECK(piece_fault(&piece)); /* touches */
	piece = rectangle();
	piece.point_mm[1] = piece.point_mm[0];
	CHECK(piece_fault(&piece));
	piece = rectangle();
	piece.point_mm[1].x = NAN;
	CHECK(piece_fault(&piece));
	piece = rectangle();
	piece.point_mm[1].x = 20000.0f;
	CHECK(piece_fault(&piece));
	piece = rectangle();
	struct v2 swap = piece.point_mm[1];
	piece.point_mm[1] = piece.point_mm[3];
	piece.point_mm[3] = swap;
	CHECK(piece_fault(&piece)); /* clockwise */
	piece = rectangle();
	memset(piece.corner, 0, sizeof piece.corner);
	CHECK(piece_fault(&piece));
	piece = rectangle();
	for (int i = 0; i < 4; i++)
		piece.point_mm[i] = v2_scale(piece.point_mm[i], 0.015f);
	CHECK(piece_fault(&piece)); /* 6 x 9 mm */
}

int main(void)
{
	test_sheet();
	test_edges();
	test_pick();
	test_faults();
	test_shirt_by_a_trembling_hand();
	test_shirt_corners();
	test_closing();
	test_round();
	test_sparse();
	test_refused_strokes();
	test_curls();
	test_oversketch_edge();
	test_oversketch_bulge();
	test_oversketch_by_a_trembling_hand();
	return test_end();
}
