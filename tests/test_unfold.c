/* Folds made on purpose open again under the everyday sweeps, without new strain and without
 * touching the body; creases that are wanted stay. */
#include "cloth.h"
#include "measure.h"
#include "shapes.h"
#include "test.h"

static struct body body;
static struct garment garment;
static struct cloth cloth;
static struct garment_job *job;
static struct pattern pattern;
static struct shape shape;
static struct measure measure;
static struct measure_scratch *scratch;

enum { ROWS = 48, SIDES = 64, SETTLE = 150 };

static const float post_high_m = 1.0f, over_m = 0.008f; /* the cloth's layers begin so far out */

/* A closed upright cylinder about the Y axis. */
static void build_post(float radius_m)
{
	shape.vertex_count = shape.triangle_count = 0;
	for (int r = 0; r < ROWS; r++)
		for (int s = 0; s < SIDES; s++) {
			float a = 2.0f * PI_F * (float)s / SIDES;
			shape_vertex(&shape, radius_m * angle_sin(a),
				     post_high_m * (float)r / (ROWS - 1), radius_m * angle_cos(a));
		}
	int low = shape_vertex(&shape, 0.0f, -0.02f, 0.0f);
	int high = shape_vertex(&shape, 0.0f, post_high_m + 0.02f, 0.0f);
	for (int s = 0; s < SIDES; s++) {
		int next = (s + 1) % SIDES, top = (ROWS - 1) * SIDES;
		for (int r = 0; r + 1 < ROWS; r++) {
			int a = r * SIDES + s, b = r * SIDES + next;
			shape_triangle(&shape, a, b, b + SIDES);
			shape_triangle(&shape, a, b + SIDES, a + SIDES);
		}
		shape_triangle(&shape, next, s, low);
		shape_triangle(&shape, top + s, top + next, high);
	}
	CHECK(!body_build(&body, shape.position_m, shape.vertex_count, shape.triangle,
			  shape.triangle_count));
}

static void add_rectangle(int index, float width_mm, float height_mm)
{
	struct piece *piece = &pattern.piece[index];
	*piece = (struct piece){.used = true, .point_count = 4, .name = "patch"};
	const struct v2 corner[4] = {
		{0.0f, 0.0f}, {width_mm, 0.0f}, {width_mm, height_mm}, {0.0f, height_mm}};
	for (int i = 0; i < 4; i++) {
		piece->point_mm[i] = corner[i];
		piece->corner[i] = true;
	}
}

static void mesh(int vertices)
{
	bool done = false;
	CHECK(!garment_start(job, &garment, &pattern, vertices));
	while (!done)
		garment_advance(job, 100000, &done);
	cloth_reset(&cloth, &garment, &body);
}

/* A tube round the post, sewn behind, or (open) a sheet before it. */
static void cut(float around_m, float high_m, bool open, int vertices)
{
	memset(&pattern, 0, sizeof pattern);
	add_rectangle(0, 1000.0f * around_m, 1000.0f * high_m);
	if (!open)
		pattern.seam[0] = (struct seam){.used = true, .a = {0, 1}, .b = {0, 3}};
	mesh(vertices);
}

/* Where cloth lies that is so far along the post, so high and so far out. */
static struct v3 place(float along_m, float high_m, float out_m)
{
	float a = along_m / out_m;
	return (struct v3){out_m * angle_sin(a), high_m, out_m * angle_cos(a)};
}

/* Lays every vertex where `fold` puts it: x along the cloth from its middle, y up, z its layer. */
static void lay(float out, float lift_m, struct v3 (*fold)(struct v2 p))
{
	float width = 0.0f, high = 0.0f;
	for (int v = 0; v < garment.vertex_count; v++) {
		width = float_max(width, garment.rest_m[v].x);
		high = float_max(high, garment.rest_m[v].y);
	}
	for (int v = 0; v < garment.vertex_count; v++) {
		struct v2 p = garment.rest_m[v];
		struct v3 q = fold((struct v2){p.x - 0.5f * width, p.y});
		cloth.position_m[v] = place(q.x, lift_m + q.y, out);
		cloth.position_m[v].x *= (out + q.z) / out;
		cloth.position_m[v].z *= (out + q.z) / out;
		cloth.previous_m[v] = cloth.position_m[v];
		cloth.placed[v] = 1;
	}
	cloth_weld(&cloth);
	for (int v = 0; v < garment.vertex_count; v++) {
		if (garment.rest_m[v].y < high - 1e-4f)
			continue;
		cloth.held[cloth.particle[v]] = 1;
		cloth.goal_m[cloth.particle[v]] = cloth.position_m[v];
	}
	cloth.worn = true;
}

/* ---- the folds ---- */

static float line_m, layer_m; /* where the fold is, and how far out its second layer lies */

static struct v3 flat(struct v2 p)
{
	return (struct v3){p.x, p.y, 0.0f};
}

/* Everything below the line lies turned up over the cloth above it. */
static struct v3 hem(struct v2 p)
{
	return p.y >= line_m ? (struct v3){p.x, p.y, 0.0f}
			     : (struct v3){p.x, 2.0f * line_m - p.y, layer_m};
}

/* Three layers between two lines. */
static struct v3 zigzag(struct v2 p)
{
	float deep = 0.05f;
	if (p.y >= line_m)
		return (struct v3){p.x, p.y, 0.0f};
	if (p.y >= line_m - deep)
		return (struct v3){p.x, 2.0f * line_m - p.y, layer_m};
	return (struct v3){p.x, p.y + 2.0f * deep, 2.0f * layer_m};
}

/* A disc of the cloth lies mirrored in its place. */
static struct v3 mirrored(struct v2 p)
{
	float x = p.x, y = p.y - line_m, inside = 0.05f * 0.05f - x * x - y * y;
	return (struct v3){inside > 0.0f ? -p.x : p.x, p.y, 0.0f};
}

/* All of the cloth below the line lies mirrored: right is left. */
static struct v3 inside_out(struct v2 p)
{
	return (struct v3){p.y < line_m ? -p.x : p.x, p.y, 0.0f};
}

/* ---- what is asked ---- */

/* Triangles whose outside looks at the post's axis. */
static int facing_in(void)
{
	int count = 0;
	for (int t = 0; t < garment.triangle_count; t++) {
		const int *v = cloth.triangle[t].v;
		const struct v3 *x = cloth.position_m;
		struct v3 out = v3_add(v3_add(x[v[0]], x[v[1]]), x[v[2]]);
		out.y = 0.0f;
		count += v3_dot(v3_cross(v3_sub(x[v[1]], x[v[0]]), v3_sub(x[v[2]], x[v[0]])), out) <
			 0.0f;
	}
	return count;
}

static float stretch_max(void)
{
	float most = 0.0f;
	for (int t = 0; t < garment.triangle_count; t++)
		most = float_max(most, cloth_stretch(&cloth, t));
	return most;
}

static int edges_through(void)
{
	int through = 0;
	struct body_hit hit;
	for (int t = 0; t < garment.triangle_count; t++)
		for (int k = 0; k < 3; k++)
			through += body_segment_hits(
				&body, cloth.position_m[cloth.triangle[t].v[k]],
				cloth.position_m[cloth.triangle[t].v[(k + 1) % 3]], &hit);
	return through;
}

/* ---- the cases ---- */

struct fold_case {
	const char *name;
	float post_m, around_m, high_m; /* the post's radius; the cloth, around 0: in front only */
	int vertices;
	struct v3 (*fold)(struct v2 p);
	float line_m, layer_m;
	int frames;   /* of ten sweeps, within which it has opened */
	bool relaxed; /* needs RELAX: a front that turns over slides all over the body */
};

static const struct fold_case cases[] = {
	{"cuff turned up", 0.05f, 0.40f, 0.25f, 500, hem, 0.04f, 0.003f, 30, false},
	{"cuff folded flat", 0.05f, 0.40f, 0.25f, 500, hem, 0.04f, 0.0f, 30, false},
	{"cuff turned in", 0.05f, 0.40f, 0.25f, 500, hem, 0.04f, -0.003f, 30, false},
	{"hem turned up", 0.15f, 1.05f, 0.4f, 900, hem, 0.04f, 0.003f, 30, false},
	{"hem folded flat", 0.15f, 1.05f, 0.4f, 900, hem, 0.04f, 0.0f, 30, false},
	{"hem turned in", 0.15f, 1.05f, 0.4f, 900, hem, 0.04f, -0.003f, 30, false},
	{"pleat upwards", 0.15f, 0.0f, 0.4f, 900, zigzag, 0.2f, 0.002f, 240, false},
	{"pleat flat", 0.15f, 0.0f, 0.4f, 900, zigzag, 0.2f, 0.0f, 240, false},
	{"pleat inwards", 0.15f, 0.0f, 0.4f, 900, zigzag, 0.2f, -0.002f, 240, false},
	{"patch mirrored", 0.15f, 0.0f, 0.4f, 900, mirrored, 0.2f, 0.0f, 60, false},
	{"front turned up", 0.15f, 0.0f, 0.4f, 900, hem, 0.2f, 0.004f, 60, false},
	{"piece inside out", 0.15f, 0.0f, 0.4f, 900, inside_out, 0.35f, 0.0f, 400, true},
};

static void dress(const struct fold_case *c, struct v3 (*fold)(struct v2 p))
{
	build_post(c->post_m);
	cut(c->around_m > 0.0f ? c->around_m : 0.3f, c->high_m, c->around_m == 0.0f, c->vertices);
	line_m = c->line_m;
	layer_m = c->layer_m;
	lay(c->around_m > 0.0f ? c->around_m / (2.0f * PI_F) : c->post_m + over_m, 0.4f, fold);
}

static void frame(void)
{
	for (int sweep = 0; sweep < 10; sweep++)
		cloth_sweep(&cloth);
}

/* Lies without a fold what lay so in the case before? */
static bool same_flat(const struct fold_case *c)
{
	return c > cases && c->post_m == c[-1].post_m && c->around_m == c[-1].around_m &&
	       c->high_m == c[-1].high_m && c->vertices == c[-1].vertices;
}

/* *stretch: of the same cloth without a fold, as far as it is known from the case before. */
static void test_opens(const struct fold_case *c, struct cloth_settings settings, float *stretch)
{
	int frames = 0, through = 0, failures = test_failures;
	if (*stretch == 0.0f || !same_flat(c)) {
		dress(c, flat);
		cloth.settings = settings;
		for (int i = 0; i < SETTLE; i++)
			frame();
		*stretch = stretch_max();
	}
	dress(c, c->fold);
	cloth.settings = settings;
	int first = facing_in();
	through = edges_through();
	while (frames < c->frames && (facing_in() > 0 || frames == 0)) {
		frame();
		CHECK(edges_through() <= through);
		frames++;
	}
	for (int i = 0; i < SETTLE; i++)
		frame();
	CHECK(first > 60);
	CHECK(frames < c->frames);
	CHECK(facing_in() == 0);
	CHECK(edges_through() == 0);
	CHECK(stretch_max() < *stretch + 0.03f);
	measure_garment(&measure, &cloth, scratch);
	CHECK(measure.self_intersections == 0);
	if (test_failures > failures)
		fprintf(stderr, "%s: %d of %d face in after %d frames; stretch %.3f, flat %.3f\n",
			c->name, facing_in(), first, frames, (double)stretch_max(),
			(double)*stretch);
}

/* A crease that is wanted stays. */
static void test_crease_stays(void)
{
	dress(&cases[0], hem);
	memset(cloth.creased, 1, (size_t)garment.vertex_count);
	int first = facing_in();
	cloth.settings = cloth_settings_relax();
	for (int i = 0; i < SETTLE; i++)
		frame();
	CHECK(first > 60 && facing_in() > first / 2);
}

int main(void)
{
	static unsigned char memory[192u << 20];
	struct arena arena;
	float worn = 0.0f, relaxed = 0.0f;
	arena_init(&arena, memory, sizeof memory);
	body_init(&body, &arena);
	garment_init(&garment, &arena);
	job = garment_job_init(&arena);
	cloth_init(&cloth, &arena);
	scratch = measure_init(&arena);
	for (int c = 0; c < COUNT_OF(cases); c++) {
		if (!cases[c].relaxed)
			test_opens(&cases[c], cloth_settings_worn(), &worn);
		test_opens(&cases[c], cloth_settings_relax(), &relaxed);
	}
	test_crease_stays();
	return test_end();
}
