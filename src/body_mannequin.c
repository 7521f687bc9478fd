/* The mannequin: half a body is laid as four lofts of measured sections, sewn together at hip,
 * crotch and shoulder, made smooth there, and mirrored. It is built in the body's own pools.
 *
 *   sections --loft--> rings --stitch--> half a sheet --fair--> --mirror--> body_build
 */
#include "body.h"
#include "mannequin_fair.h"
#include "mannequin_tables.h"

#define HEIGHT_M 1.70f

/* The edge length wanted along a loft: linear between two places. */
struct grain {
	float along_m[2], spacing_m[2];
};

struct maker {
	struct sheet sheet;
	struct fair fair;
	struct loft trunk, top, leg, crotch, arm;
	struct ring hip, chest, yoke; /* the lines along which the lofts meet */
	int front, back;              /* entries of `chest` where the arm begins */
};

static float grain_at(const struct grain *grain, float along_m)
{
	float t = (along_m - grain->along_m[0]) / (grain->along_m[1] - grain->along_m[0]);
	t = float_clamp(t, 0.0f, 1.0f);
	return grain->spacing_m[0] + (grain->spacing_m[1] - grain->spacing_m[0]) * t;
}

/* Rings from one place on a loft to another, each sewn to the one before; *ring is the one to
 * start from and becomes the last one laid. Rows are closer than columns, as in a net of
 * equilateral triangles. */
static void lay_strip(struct sheet *sheet, const struct loft *loft, const struct grain *grain,
		      float from_m, float to_m, bool include_to, struct ring *ring)
{
	float rows = 0.0f, left = to_m - from_m;
	for (int i = 0; i < 256; i++)
		rows += left / 256.0f /
			(0.9f * grain_at(grain, from_m + left * ((float)i + 0.5f) / 256.0f));
	int count = int_max((int)(rows + 0.5f), 1);
	float scale = rows / (float)count, along = from_m;
	for (int i = 1; i <= count; i++) {
		float step = 0.9f * scale * grain_at(grain, along);
		along += 0.9f * scale * grain_at(grain, along + 0.5f * step);
		if (i == count && !include_to)
			break;
		struct ring next;
		along = i == count ? to_m : along;
		ring_lay(sheet, loft, along, grain_at(grain, along), i % 2 ? 0.5f : 0.0f, &next);
		ring_stitch(sheet, ring, &next);
		*ring = next;
	}
}

static void lay_trunk(struct maker *maker)
{
	struct loft *loft = &maker->trunk;
	struct grain grain = {{0.0f, 1.0f}, {0.017f, 0.017f}};
	ring_lay(&maker->sheet, loft, 0.0f, grain.spacing_m[0], 0.0f, &maker->hip);
	maker->chest = maker->hip;
	lay_strip(&maker->sheet, loft, &grain, 0.0f, loft_length(loft), true, &maker->chest);
}

/* The leg's last ring: around the hip, then back to the front through the crotch. */
static void lay_crotch(struct maker *maker, struct ring *ring)
{
	struct ring seam;
	int n = maker->hip.count, end[2] = {maker->hip.vertex[n - 1], maker->hip.vertex[0]};
	const float angle[2] = {0.85f * PI_F, 0.15f * PI_F};
	ring_lay_arc(&maker->sheet, &maker->crotch, 0.0f, angle, end, 0.013f, &seam);
	*ring = maker->hip;
	ring->closed = true;
	for (int i = 1; i < seam.count - 1; i++) {
		maker->sheet.position_m[seam.vertex[i]].x = 0.0f;
		MUST(ring->count < RING_VERTICES_MAX);
		ring->vertex[ring->count++] = seam.vertex[i];
	}
}

static void lay_leg(struct maker *maker)
{
	struct sheet *sheet = &maker->sheet;
	struct loft *loft = &maker->leg;
	struct grain grain = {{0.15f, 0.50f}, {0.010f, 0.017f}};
	struct ring ring, crotch;
	float first = 0.008f, length = loft_length(loft);
	int tip = sheet_add(sheet, loft_point(loft, 0.0f, 0.0f));
	ring_lay(sheet, loft, first, 0.009f, 0.0f, &ring);
	ring_close(sheet, &ring, tip, false);
	lay_strip(sheet, loft, &grain, first, length, false, &ring);
	lay_crotch(maker, &crotch);
	ring_stitch(sheet, &ring, &crotch);
}

/* Where the chest's last ring meets the arm: front and back of the armpit. */
static void find_armpit(struct maker *maker)
{
	const struct v3 *p = maker->sheet.position_m;
	struct v3 front = loft_point(&maker->arm, 0.0f, PI_F * 60.0f / 180.0f);
	struct v3 back = loft_point(&maker->arm, 0.0f, PI_F * 125.0f / 180.0f);
	const int *vertex = maker->chest.vertex;
	for (int i = 1; i < maker->chest.count; i++) {
		if (v3_distance(p[vertex[i]], front) < v3_distance(p[vertex[maker->front]], front))
			maker->front = i;
		if (v3_distance(p[vertex[i]], back) < v3_distance(p[vertex[maker->back]], back))
			maker->back = i;
	}
	MUST(maker->front > 0 && maker->front + 2 <= maker->back &&
	     maker->back < maker->chest.count - 1);
}

/* The armhole: down one side of the trunk, up over the shoulder. The yoke's first ring takes the
 * rest of the chest and the same way over the shoulder. */
static void lay_armhole(struct maker *maker, struct ring *armhole)
{
	struct ring over, *chest = &maker->chest, *yoke = &maker->yoke;
	int end[2] = {chest->vertex[maker->back], chest->vertex[maker->front]};
	const float angle[2] = {PI_F * 150.0f / 180.0f, PI_F * 395.0f / 180.0f};
	ring_lay_arc(&maker->sheet, &maker->arm, 0.0f, angle, end, 0.013f, &over);
	*armhole = (struct ring){.closed = true};
	*yoke = (struct ring){.closed = false};
	for (int i = maker->front; i < maker->back; i++)
		armhole->vertex[armhole->count++] = chest->vertex[i];
	for (int i = 0; i < over.count - 1; i++)
		armhole->vertex[armhole->count++] = over.vertex[i];
	for (int i = 0; i < maker->front; i++)
		yoke->vertex[yoke->count++] = chest->vertex[i];
	for (int i = over.count - 1; i >= 0; i--)
		yoke->vertex[yoke->count++] = over.vertex[i];
	for (int i = maker->back + 1; i < chest->count; i++)
		yoke->vertex[yoke->count++] = chest->vertex[i];
}

static void lay_arm(struct maker *maker)
{
	struct sheet *sheet = &maker->sheet;
	struct loft *loft = &maker->arm;
	struct grain grain = {{0.10f, 0.38f}, {0.0135f, 0.0078f}};
	struct ring ring;
	float last = loft_length(loft) - 0.006f;
	find_armpit(maker);
	lay_armhole(maker, &ring);
	lay_strip(sheet, loft, &grain, 0.006f, last, true, &ring);
	int tip = sheet_add(sheet, loft_point(loft, loft_length(loft), 0.0f));
	ring_close(sheet, &ring, tip, true);
}

static void lay_top(struct maker *maker)
{
	struct sheet *sheet = &maker->sheet;
	struct loft *loft = &maker->top;
	struct grain grain = {{0.03f, 0.12f}, {0.015f, 0.0125f}};
	struct ring ring = maker->yoke, first;
	float last = loft_length(loft) - 0.010f;
	ring_lay(sheet, loft, 0.0f, grain.spacing_m[0], 0.0f, &first);
	ring_stitch(sheet, &ring, &first);
	lay_strip(sheet, loft, &grain, 0.0f, last, true, &first);
	struct v3 crown = loft_point(loft, loft_length(loft), 0.0f);
	crown.x = 0.0f;
	int tip = sheet_add(sheet, crown);
	ring_close(sheet, &first, tip, true);
}

static void smooth(struct maker *maker)
{
	static const struct fair_spot spot[] = {
		{{0.158f, 1.295f, -0.015f}, 0.080f, 180}, /* armpit */
		{{0.205f, 1.340f, -0.010f}, 0.080f, 30},  /* deltoid */
		{{0.315f, 1.170f, -0.015f}, 0.070f, 20},  /* elbow */
		{{0.000f, 1.440f, -0.020f}, 0.100f, 25},  /* neck */
		{{0.000f, 1.480f, 0.048f}, 0.050f, 15},   /* throat */
		{{0.000f, 0.815f, 0.015f}, 0.120f, 300},  /* crotch */
		{{0.120f, 0.825f, 0.000f}, 0.140f, 30},   /* hip line */
		{{0.100f, 0.088f, 0.035f}, 0.050f, 40},   /* instep */
		{{0.100f, 0.015f, -0.030f}, 0.060f, 12},  /* heel */
		{{0.200f, 0.850f, 0.000f}, 9.0f, 10},     /* everywhere */
	};
	for (int i = 0; i < COUNT_OF(spot); i++)
		fair_bend(&maker->sheet, &maker->fair, &spot[i]);
	fair_slide(&maker->sheet, &maker->fair, 12);
}

/* Feet at 0 with flat soles, head at HEIGHT_M. */
static void stand(struct sheet *sheet)
{
	struct v3 *p = sheet->position_m;
	float low = p[0].y, high = p[0].y;
	for (int v = 1; v < sheet->vertex_count; v++) {
		low = float_min(low, p[v].y);
		high = float_max(high, p[v].y);
	}
	low += 0.003f;
	for (int v = 0; v < sheet->vertex_count; v++) {
		float scale = HEIGHT_M / (high - low);
		p[v].x *= scale;
		p[v].y = p[v].y <= low ? 0.0f : (p[v].y - low) * scale;
		p[v].z *= scale;
	}
}

static void mirror(struct sheet *sheet, int *image)
{
	int vertices = sheet->vertex_count, triangles = sheet->triangle_count;
	for (int v = 0; v < vertices; v++) {
		struct v3 p = sheet->position_m[v];
		image[v] = p.x == 0.0f ? v : sheet_add(sheet, (struct v3){-p.x, p.y, p.z});
	}
	MUST(2 * triangles <= sheet->triangles_max);
	for (int t = 0; t < triangles; t++) {
		const int *v = sheet->triangle[t].v;
		sheet->triangle[sheet->triangle_count++] = (struct triangle){
			{image[v[0]], image[v[2]], image[v[1]]}};
	}
}

const char *body_build_mannequin(struct body *body)
{
	struct maker maker = {
		.sheet = {body->position_m, body->triangle, 0, 0, BODY_VERTICES_MAX,
			  BODY_TRIANGLES_MAX},
		.fair = {body->normal, body->face_normal, body->star_first, body->star,
			 body->neighbour, 0, 0},
	};
	loft_init(&maker.trunk, TRUNK, COUNT_OF(TRUNK), true);
	loft_init(&maker.top, TOP, COUNT_OF(TOP), true);
	loft_init(&maker.leg, LEG, COUNT_OF(LEG), false);
	loft_init(&maker.arm, ARM, COUNT_OF(ARM), false);
	loft_init(&maker.crotch, CROTCH, COUNT_OF(CROTCH), true);
	lay_trunk(&maker);
	lay_leg(&maker);
	lay_arm(&maker);
	lay_top(&maker);
	smooth(&maker);
	stand(&maker.sheet);
	mirror(&maker.sheet, body->star_first);
	return body_build(body, body->position_m, maker.sheet.vertex_count, body->triangle,
			  maker.sheet.triangle_count);
}
