/* The quality figures on cloth whose figures are known: a sheet over a box, tubes round a limb. */
#include "measure_private.h"
#include "shapes.h"
#include "test.h"

static struct body body;
static struct garment garment;
static struct cloth cloth;
static struct measure measure;
static struct measure_scratch *scratch;
static struct shape shape;
static struct v3 position_m[GARMENT_VERTICES_MAX];
static uint8_t placed[GARMENT_VERTICES_MAX];

/* ---- linking numbers ---- */

enum { CURVE = 200 };

/* On a torus about the Y axis with radii 1 and 0.4: `round` times round the axis while `through`
 * times round the tube. */
static void torus_curve(struct v3 curve[CURVE], int round, int through, float tube)
{
	for (int i = 0; i < CURVE; i++) {
		float t = 2.0f * PI_F * (float)i / (float)CURVE;
		float flat = 1.0f + tube * angle_cos((float)through * t);
		curve[i] = (struct v3){flat * angle_sin((float)round * t),
				       tube * angle_sin((float)through * t),
				       flat * angle_cos((float)round * t)};
	}
}

static void test_linking(void)
{
	static struct v3 core[CURVE], knot[CURVE];
	struct v3 axis[4] = {
		{0.0f, -9.0f, 0.0f}, {0.0f, 9.0f, 0.0f}, {30.0f, 9.0f, 0.0f}, {30.0f, -9.0f, 0.0f}};
	torus_curve(core, 1, 0, 0.0f);
	for (int round = 1; round <= 3; round++)
		for (int through = -3; through <= 3; through++) {
			torus_curve(knot, round, through, 0.4f);
			float with_axis = measure_linking(knot, CURVE, axis, 4);
			float with_core = measure_linking(knot, CURVE, core, CURVE);
			CHECK_NEAR(float_abs(with_axis), round, 0.002);
			CHECK_NEAR(float_abs(with_core), through < 0 ? -through : through, 0.002);
			CHECK_NEAR(measure_linking(axis, 4, knot, CURVE), with_axis, 0.002);
		}
	torus_curve(knot, 1, 2, 0.4f);
	float forward = measure_linking(knot, CURVE, core, CURVE);
	torus_curve(knot, 1, -2, 0.4f);
	CHECK_NEAR(measure_linking(knot, CURVE, core, CURVE), -forward, 0.002);
	for (int i = 0; i < CURVE; i++)
		knot[i].x += 3.0f; /* beside one another */
	CHECK_NEAR(measure_linking(knot, CURVE, core, CURVE), 0.0, 0.002);
}

/* ---- triangles ---- */

static void test_triangles(void)
{
	static const struct {
		struct v3 a[3], b[3];
		bool cross;
	} cases[] = {
		/* upright through the middle; beside; above; the edge of one only; parallel */
		{{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}},
		 {{.5f, .5f, -1}, {.5f, .5f, 1}, {.6f, .5f, 1}},
		 true},
		{{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}},
		 {{1.5f, 1.5f, -1}, {1.5f, 1.5f, 1}, {2, 2, 1}},
		 false},
		{{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}},
		 {{.5f, .5f, .1f}, {.5f, .5f, 1}, {.6f, .5f, 1}},
		 false},
		{{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}},
		 {{-1, -1, -1}, {5, 5, -1}, {.9f, .9f, .2f}},
		 true},
		{{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}},
		 {{0, 0, 1e-6f}, {2, 0, 1e-6f}, {0, 2, 1e-6f}},
		 false},
		{{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}},
		 {{.5f, .5f, -1e-6f}, {.5f, .6f, 1e-6f}, {.6f, .5f, 1}},
		 true},
	};
	for (int i = 0; i < COUNT_OF(cases); i++) {
		CHECK(measure_triangles_cross(cases[i].a, cases[i].b) == cases[i].cross);
		CHECK(measure_triangles_cross(cases[i].b, cases[i].a) == cases[i].cross);
	}
}

/* ---- cloth of our own making ---- */

enum { COLUMNS = 20, ROWS = 8 };
static const float pitch_m = 0.02f;

/* A flat grid of COLUMNS x ROWS squares; `closed` sews its last column to its first. */
static void make_grid(bool closed)
{
	garment.vertex_count = garment.triangle_count = garment.pair_count = 0;
	for (int c = 0; c <= COLUMNS; c++)
		for (int r = 0; r <= ROWS; r++) {
			int v = garment.vertex_count++;
			garment.rest_m[v] = (struct v2){(float)c * pitch_m, (float)r * pitch_m};
			garment.piece[v] = 0;
			garment.weld[v] = closed && c == COLUMNS ? r : v;
			placed[v] = 1;
			if (closed && c == COLUMNS)
				garment.pair[garment.pair_count++] = (struct seam_pair){r, v, 0};
		}
	for (int c = 0; c < COLUMNS; c++)
		for (int r = 0; r < ROWS; r++) {
			int a = c * (ROWS + 1) + r, b = a + ROWS + 1;
			garment.triangle[garment.triangle_count++] = (struct triangle){
				{a, b, b + 1}};
			garment.triangle[garment.triangle_count++] = (struct triangle){
				{a, b + 1, a + 1}};
		}
	memset(garment.triangle_piece, 0, GARMENT_TRIANGLES_MAX * sizeof(int));
	for (int p = 1; p <= PIECES_MAX; p++) {
		garment.piece_first[p] = garment.vertex_count;
		garment.piece_first_triangle[p] = garment.triangle_count;
	}
}

static void take_measure(bool welded)
{
	cloth_restore(&cloth, &garment, &body, position_m, placed, welded, true);
	measure_garment(&measure, &cloth, scratch);
}

/* Over a box whose top is at y = 0: `stretch` along the columns and across, `height` above it. */
static void lay_sheet(float along, float across, float height)
{
	for (int v = 0; v < garment.vertex_count; v++)
		position_m[v] = (struct v3){(garment.rest_m[v].x - 0.2f) * along, height,
					    (0.08f - garment.rest_m[v].y) * across};
}

static void make_box(void)
{
	shape_box(&shape, 1.0f, 0.5f, 1.0f);
	for (int v = 0; v < shape.vertex_count; v++)
		shape.position_m[v].y -= 0.5f;
	CHECK(!body_build(&body, shape.position_m, shape.vertex_count, shape.triangle,
			  shape.triangle_count));
}

static void test_sheet(void)
{
	make_box();
	make_grid(false);
	lay_sheet(1.0f, 1.0f, 0.01f);
	take_measure(false);
	CHECK(measure.vertices == garment.vertex_count);
	CHECK(measure.triangles == garment.triangle_count);
	CHECK(measure.vertices_inside == 0 && measure.midpoints_inside == 0);
	CHECK(measure.centres_inside == 0 && measure.edge_crossings_body == 0);
	CHECK(measure.penetration_mm_max == 0.0f);
	CHECK(measure.inverted_triangles == 0 && measure.self_intersections == 0);
	CHECK_NEAR(measure.strain_max, 0.0, 1e-5);
	CHECK(measure.loop_count == 1);
	CHECK_NEAR(measure.loop[0].length_m, 2.0f * pitch_m * (COLUMNS + ROWS), 1e-5);
	CHECK(measure.loop[0].vertex_count == 2 * (COLUMNS + ROWS));
	lay_sheet(1.1f, 0.95f, 0.01f);
	take_measure(false);
	CHECK_NEAR(measure.strain_p95, 0.1, 1e-5);
	CHECK_NEAR(measure.strain_max, 0.1, 1e-5);
	CHECK_NEAR(measure.compression_p95, 0.05, 1e-5);
	lay_sheet(1.0f, -1.0f, 0.01f); /* upside down */
	take_measure(false);
	CHECK(measure.inverted_triangles == garment.triangle_count);
	CHECK_NEAR(measure.strain_max, 0.0, 1e-5);
	lay_sheet(1.0f, -1.0f, 0.07f); /* as well, but away from the body */
	take_measure(false);
	CHECK(measure.inverted_triangles == 0);
	for (int v = 0; v < garment.vertex_count; v++) /* upright, leaning over by 10 degrees */
		position_m[v] = (struct v3){garment.rest_m[v].x, 0.01f + 0.1f * garment.rest_m[v].y,
					    0.0176f * garment.rest_m[v].y};
	take_measure(false);
	CHECK(measure.inverted_triangles == 0);
	for (int v = 0; v < garment.vertex_count; v++) /* by 45 degrees: over is over */
		position_m[v].z = position_m[v].y;
	take_measure(false);
	CHECK(measure.inverted_triangles == garment.triangle_count);
}

/* Where its six edges and triangles go is known. */
static void test_pushed_vertex(void)
{
	int middle = COLUMNS / 2 * (ROWS + 1) + ROWS / 2;
	make_box();
	make_grid(false);
	lay_sheet(1.0f, 1.0f, 0.01f);
	position_m[middle].y = -0.005f; /* midpoints at +2.5 mm, centres at +5 */
	take_measure(false);
	CHECK(measure.vertices_inside == 1);
	CHECK_NEAR(measure.penetration_mm_max, 5.0, 1e-3);
	CHECK(measure.midpoints_inside == 0 && measure.centres_inside == 0);
	CHECK(measure.edge_crossings_body == 6);
	position_m[middle].y = -0.03f; /* midpoints at -10 mm, centres at -3.3 */
	take_measure(false);
	CHECK(measure.vertices_inside == 1);
	CHECK(measure.midpoints_inside == 6 && measure.centres_inside == 6);
	CHECK_NEAR(measure.penetration_mm_max, 30.0, 1e-3);
	CHECK(measure.edge_crossings_body == 6);
	position_m[middle].y = -0.00005f; /* touching is not inside */
	take_measure(false);
	CHECK(measure.vertices_inside == 0);
	placed[middle] = 0; /* cloth that was never laid is not measured */
	position_m[middle].y = -0.03f;
	take_measure(false);
	CHECK(measure.vertices_inside == 0 && measure.triangles == garment.triangle_count - 6);
	CHECK(measure.loop_count == 2 && measure.loop[1].vertex_count == 6);
}

/* One column stretched in twenty lies beyond the percentile, two do not. */
static void test_percentile(void)
{
	make_box();
	make_grid(false);
	lay_sheet(1.0f, 1.0f, 0.01f);
	for (int v = COLUMNS * (ROWS + 1); v < garment.vertex_count; v++)
		position_m[v].x += 0.01f; /* 1 column of 20: just 5 % */
	take_measure(false);
	CHECK_NEAR(measure.strain_p95, 0.0, 1e-4);
	CHECK_NEAR(measure.strain_max, 0.5, 1e-3);
	for (int v = (COLUMNS - 1) * (ROWS + 1); v < COLUMNS * (ROWS + 1); v++)
		position_m[v].x += 0.005f; /* 2 of 20 */
	take_measure(false);
	CHECK_NEAR(measure.strain_p95, 0.25, 1e-3);
}

/* A corner of the sheet is bent up, back, and down through the sheet. */
static void test_self(void)
{
	make_box();
	make_grid(false);
	lay_sheet(1.0f, 1.0f, 0.03f);
	int corner = garment.vertex_count - 1;
	for (int v = corner - ROWS; v < corner; v++)
		position_m[v].y = 0.06f;
	position_m[corner] = (struct v3){0.003f, 0.0f, 0.004f};
	take_measure(false);
	CHECK(measure.self_intersections > 0);
	int expected = 0;
	for (int a = 0; a < garment.triangle_count; a++)
		for (int b = a + 1; b < garment.triangle_count; b++) {
			struct v3 p[3], q[3];
			bool shared = false;
			for (int i = 0; i < 3; i++) {
				p[i] = position_m[garment.triangle[a].v[i]];
				q[i] = position_m[garment.triangle[b].v[i]];
				for (int k = 0; k < 3; k++)
					shared = shared || garment.triangle[a].v[i] ==
								   garment.triangle[b].v[k];
			}
			expected += !shared && measure_triangles_cross(p, q);
		}
	CHECK(measure.self_intersections == expected);
}

static void test_seam_gap(void)
{
	make_box();
	make_grid(true);
	lay_sheet(1.0f, 1.0f, 0.01f);
	take_measure(false);
	CHECK_NEAR(measure.seam_gap_mm_max, 1e3f * pitch_m * COLUMNS, 1e-2);
	take_measure(true);
	CHECK(measure.seam_gap_mm_max == 0.0f);
	CHECK(measure.vertices == garment.vertex_count - ROWS - 1);
	CHECK(measure.loop_count == 2);
}

/* ---- on a figure ---- */

/* The grid as a tube about a line. */
static void lay_tube(struct v3 centre_m, struct v3 axis, float radius_m)
{
	struct v3 along = v3_normalize(axis);
	struct v3 side = v3_normalize(v3_cross(along, (struct v3){0.3f, 0.2f, 1.0f}));
	struct v3 front = v3_cross(along, side);
	for (int v = 0; v < garment.vertex_count; v++) {
		float turn = 2.0f * PI_F * garment.rest_m[v].x / (pitch_m * COLUMNS);
		struct v3 p = v3_mad(centre_m, along, garment.rest_m[v].y - 0.5f * pitch_m * ROWS);
		p = v3_mad(p, side, radius_m * angle_cos(turn));
		position_m[v] = v3_mad(p, front, radius_m * angle_sin(turn));
	}
	take_measure(true);
}

static const struct bone *bone_of(enum body_part part, int which)
{
	for (int b = 0; b < body.bone_count; b++)
		if (body.bone[b].part == part && which-- == 0)
			return &body.bone[b];
	return NULL;
}

/* The parts that both rims of the tube link, as a bit set; ~0: the rims differ, or a number is
 * neither 0 nor +-1. */
static unsigned linked(void)
{
	unsigned set[2] = {0, 0};
	CHECK(measure.loop_count == 2);
	for (int l = 0; l < 2; l++)
		for (int part = 0; part < PART_COUNT; part++) {
			int n = measure.loop[l].linking[part];
			if (n < -1 || n > 1)
				return ~0u;
			set[l] |= (unsigned)(n != 0) << part;
		}
	return set[0] == set[1] ? set[0] : ~0u;
}

static unsigned tube_round(enum body_part part, int which, float radius_m)
{
	const struct bone *bone = bone_of(part, which);
	lay_tube(v3_lerp(bone->a_m, bone->b_m, 0.5f), v3_sub(bone->b_m, bone->a_m), radius_m);
	return linked();
}

static void test_figure(void)
{
	enum {
		TRUNK = 1 << PART_TRUNK,
		HEAD = 1 << PART_HEAD,
		ARMS = 1 << PART_ARM_LEFT | 1 << PART_ARM_RIGHT,
		LEGS = 1 << PART_LEG_LEFT | 1 << PART_LEG_RIGHT,
	};
	CHECK(!body_build_mannequin(&body));
	CHECK(body_find_parts(&body));
	make_grid(true);
	CHECK(tube_round(PART_ARM_LEFT, 1, 0.08f) == 1u << PART_ARM_LEFT);
	CHECK(measure.arms_in_sleeves == 1 && measure.legs_in_legs == 0);
	CHECK(!measure.head_through_collar);
	CHECK(measure.vertices_inside == 0 && measure.inverted_triangles == 0);
	CHECK(tube_round(PART_ARM_RIGHT, 1, 0.08f) == 1u << PART_ARM_RIGHT);
	CHECK(measure.arms_in_sleeves == 1);
	CHECK(tube_round(PART_LEG_RIGHT, 1, 0.09f) == 1u << PART_LEG_RIGHT);
	CHECK(measure.legs_in_legs == 1 && measure.arms_in_sleeves == 0);
	CHECK(tube_round(PART_HEAD, 0, 0.12f) == (TRUNK | HEAD | LEGS));
	CHECK(measure.head_through_collar && measure.arms_in_sleeves == 0);
	CHECK(tube_round(PART_TRUNK, 0, 0.24f) == (TRUNK | HEAD | ARMS | LEGS));
	CHECK(!measure.head_through_collar && measure.legs_in_legs == 0);

	/* beside the arm; round both ankles; sunk into the arm */
	const struct bone *arm = bone_of(PART_ARM_LEFT, 1);
	struct v3 axis = v3_sub(arm->b_m, arm->a_m);
	struct v3 beside = v3_lerp(arm->a_m, arm->b_m, 0.5f);
	beside.z += 0.2f;
	lay_tube(beside, axis, 0.08f);
	CHECK(linked() == 0);
	CHECK(measure.arms_in_sleeves == 0);
	lay_tube((struct v3){0.0f, 0.25f, 0.0f}, (struct v3){0.0f, 1.0f, 0.0f}, 0.24f);
	CHECK(linked() == (TRUNK | HEAD | ARMS | LEGS));
	CHECK(measure.legs_in_legs == 0);
	CHECK(tube_round(PART_ARM_LEFT, 1, 0.01f) == 1u << PART_ARM_LEFT);
	CHECK(measure.vertices_inside == measure.vertices);
	CHECK(measure.edge_crossings_body == 0);
	CHECK(measure.penetration_mm_max > 5.0f && measure.penetration_mm_max < 40.0f);
}

/* Every chain is closed far away and passes through the part's own bones. */
static void test_chains(void)
{
	struct v3 chain[CHAIN_MAX];
	CHECK(!body_build_mannequin(&body));
	CHECK(measure_chain(&body, PART_HEAD, chain) == 0); /* no bones yet */
	CHECK(body_find_parts(&body));
	for (int part = 0; part < PART_COUNT; part++) {
		int count = measure_chain(&body, (enum body_part)part, chain);
		int own = 0, far = 0;
		CHECK(count > 6 && count <= CHAIN_MAX);
		for (int i = 0; i < count; i++) {
			far += v3_length(chain[i]) > 5.0f;
			for (int b = 0; b < body.bone_count; b++)
				own += (int)body.bone[b].part == part &&
				       v3_distance(body.bone[b].b_m, chain[i]) < 1e-6f;
		}
		CHECK(far == 3);
		bool leg = part == PART_LEG_LEFT || part == PART_LEG_RIGHT;
		CHECK(leg || v3_distance(chain[count - 3], body.bone[0].a_m) < 1e-6f);
		CHECK(own >= 2);
	}
}

/* A tube of known girth round a post of known girth, at rest, stretched, aslant, beside it. */
static void test_girth(void)
{
	const struct girth *girth = &measure.girth[PART_ARM_LEFT];
	const struct v3 up = {0.0f, 1.0f, 0.0f}, middle = {0.0f, 0.0f, 0.0f};
	shape_box(&shape, 0.05f, 0.5f, 0.03f);
	CHECK(!body_build(&body, shape.position_m, shape.vertex_count, shape.triangle,
			  shape.triangle_count));
	body.bone_count = 1;
	body.bone[0] = (struct bone){PART_ARM_LEFT, {0.0f, -0.4f, 0.0f}, {0.0f, 0.4f, 0.0f}, 0.04f};
	make_grid(true);
	lay_tube(middle, up, 0.065f);
	CHECK_NEAR(girth->cloth_m, pitch_m * COLUMNS, 1e-3);
	CHECK_NEAR(girth->body_m, 2.0f * (0.1f + 0.06f), 1e-3);
	CHECK(float_abs(girth->at_m.y) < 0.5f * pitch_m * ROWS);
	lay_tube(middle, up, 0.13f);
	CHECK_NEAR(girth->cloth_m, pitch_m * COLUMNS, 1e-3);
	CHECK_NEAR(girth->body_m, 2.0f * (0.1f + 0.06f), 1e-3);
	for (int part = 0; part < PART_COUNT; part++)
		CHECK(part == PART_ARM_LEFT || measure.girth[part].body_m == 0.0f);
	/* leaning by 1 in 2: the rims' own planes are tightest, where the post is 0.06 * 1.118 deep
	 */
	lay_tube(middle, (struct v3){0.0f, 1.0f, 0.5f}, 0.1f);
	CHECK_NEAR(girth->cloth_m / girth->body_m, 0.4 / (2.0 * (0.1 + 0.06708)), 0.002);
	lay_tube((struct v3){0.05f, 0.0f, 0.0f}, up, 0.065f); /* half of the post is outside */
	CHECK(girth->body_m == 0.0f);
	lay_tube((struct v3){0.3f, 0.0f, 0.0f}, up, 0.065f);
	CHECK(girth->body_m == 0.0f);
	make_grid(false); /* not sewn */
	lay_tube(middle, up, 0.065f);
	CHECK(girth->body_m == 0.0f);
}

static void test_nothing(void)
{
	cloth_reset(&cloth, NULL, &body);
	measure_garment(&measure, &cloth, scratch);
	CHECK(measure.vertices == 0 && measure.triangles == 0 && measure.loop_count == 0);
	make_grid(false);
	cloth_reset(&cloth, &garment, &body); /* meshed, nothing laid */
	measure_garment(&measure, &cloth, scratch);
	CHECK(measure.vertices == 0 && measure.triangles == 0 && measure.strain_max == 0.0f);
}

int main(void)
{
	enum { BYTES = 80 << 20 };
	struct arena arena;
	void *memory = malloc(BYTES);
	arena_init(&arena, memory, BYTES);
	body_init(&body, &arena);
	garment_init(&garment, &arena);
	cloth_init(&cloth, &arena);
	scratch = measure_init(&arena);
	arena_seal(&arena);
	test_linking();
	test_triangles();
	test_sheet();
	test_pushed_vertex();
	test_percentile();
	test_self();
	test_seam_gap();
	test_chains();
	test_figure();
	test_girth();
	test_nothing();
	free(memory);
	return test_end();
}
