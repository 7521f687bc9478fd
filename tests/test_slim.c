/* The slim body: what is thin, what stays, what no piece can be asked to touch; limbs' shapes. */
#include "body_slim.h"
#include "test.h"

static struct body body;
static struct slim_body slim_body;
static const struct body *const slim = &slim_body.body;
static struct limb_shape limb[PART_COUNT];

static int part_of(int v)
{
	return body.part[body.star[body.star_first[v]]];
}

/* Where the lower arm is round, a mitten begins at its end, on both sides alike. */
static void test_limbs(void)
{
	for (int part = PART_ARM_LEFT; part < PART_COUNT; part++) {
		CHECK(limb[part].wrist_m > 0.5f * limb[part].end_m);
		CHECK(limb[part].wrist_m < 0.9f * limb[part].end_m);
	}
	CHECK_NEAR(limb[PART_ARM_LEFT].wrist_m, limb[PART_ARM_RIGHT].wrist_m, 0.021);
	CHECK_NEAR(limb[PART_LEG_LEFT].end_m, limb[PART_LEG_RIGHT].end_m, 0.01);
	CHECK(limb[PART_TRUNK].end_m == 0.0f);
}

/* Nothing of a limb lies outside the hull of its sections. */
static void test_hull(void)
{
	int seen = 0;
	for (int v = 0; v < body.vertex_count; v++) {
		struct beside at;
		int part = part_of(v);
		struct v3 p_m = body.position_m[v];
		if (part == PART_TRUNK || !body_beside(&body, part, p_m, &at) || at.reach_m < 0.0f)
			continue;
		seen++;
		CHECK(v3_distance(p_m, at.axis_m) < limb_hull(&limb[part], &at, p_m) + 0.001f);
	}
	CHECK(seen > 1000);
	/* Beside a joint a point may lie along the bone: nothing is as wide as that. */
	struct beside along = {{0.0f, 1.0f, 0.0f}, {1.0f, 0.0f, 0.0f}, 0.1f};
	CHECK(limb_hull(&limb[PART_ARM_LEFT], &along, (struct v3){0.1f, 1.0f, 0.0f}) == 0.0f);
}

static void test_thin(void)
{
	int thin = 0, hidden = 0;
	float deepest_m = 0.0f;
	CHECK(body_slim_make(&slim_body, &body, limb, 0, NULL));
	for (int v = 0; v < body.vertex_count; v++) {
		struct beside at;
		int part = part_of(v);
		struct v3 p_m = body.position_m[v];
		float moved_m = v3_distance(p_m, slim->position_m[v]);
		if (part == PART_TRUNK) {
			/* It loses depth and nothing else. */
			CHECK(p_m.x == slim->position_m[v].x && p_m.y == slim->position_m[v].y);
			deepest_m = float_max(deepest_m, moved_m);
			continue;
		}
		body_beside(&body, part, p_m, &at);
		float left = v3_distance(slim->position_m[v], at.axis_m) /
			     float_max(v3_distance(p_m, at.axis_m), 1e-6f);
		CHECK(left < 1.001f);
		thin += left < 0.4f;
		if (part == PART_HEAD || at.reach_m <= limb[part].wrist_m)
			continue;
		hidden++;
		CHECK(slim->part[slim->star[slim->star_first[v]]] == PART_COUNT);
	}
	CHECK(thin > 1000 && hidden > 500 && deepest_m > 0.03f && deepest_m < 0.1f);
}

/* Who asks for all parts by name finds an arm where the hand was; who asks for anything, the hand.
 */
static void test_hidden(void)
{
	const struct bone *last = NULL;
	for (int b = 0; b < body.bone_count; b++)
		if (body.bone[b].part == PART_ARM_LEFT)
			last = &body.bone[b];
	struct body_hit named, any;
	body_nearest(slim, last->b_m, (1u << PART_COUNT) - 1, &named);
	body_nearest(slim, last->b_m, 0, &any);
	CHECK(slim->part[named.triangle] < PART_COUNT);
	CHECK(slim->part[any.triangle] == PART_COUNT);
}

/* Step by step it becomes the body, and the tree with it. */
static void test_grown(void)
{
	static const float share[] = {0.3f, 0.7f, 1.0f};
	for (int i = 0; i < COUNT_OF(share); i++) {
		body_slim_grow(&slim_body, &body, share[i]);
		for (int v = 0; v < body.vertex_count; v += 7) {
			struct body_hit hit;
			body_nearest(slim, slim->position_m[v], 0, &hit);
			CHECK(float_abs(hit.distance_m) < 1e-5f);
			if (share[i] == 1.0f)
				CHECK(v3_distance(slim->position_m[v], body.position_m[v]) < 1e-5f);
		}
	}
}

/* What is to stay whole does, and nothing else. */
static void test_whole(void)
{
	int moved[2] = {0};
	CHECK(body_slim_make(&slim_body, &body, limb, 1u << PART_HEAD, NULL));
	for (int v = 0; v < body.vertex_count; v++)
		moved[part_of(v) == PART_HEAD] += v3_distance(slim->position_m[v],
							      body.position_m[v]) > 0.0f;
	CHECK(moved[1] == 0 && moved[0] > 1000);
}

/* Whole legs reach over the middle between them and keep their outer sides. */
static void test_joined(void)
{
	unsigned legs = 1u << PART_LEG_LEFT | 1u << PART_LEG_RIGHT;
	int inner = 0, outer = 0;
	CHECK(body_slim_make(&slim_body, &body, limb, legs, NULL));
	for (int v = 0; v < body.vertex_count; v++) {
		struct beside at;
		struct v3 p_m = body.position_m[v];
		int part = part_of(v);
		if (part < PART_LEG_LEFT || !body_beside(&body, part, p_m, &at) ||
		    at.reach_m < 0.2f)
			continue;
		float side = part == PART_LEG_LEFT ? 1.0f : -1.0f;
		float out = side * v3_normalize(v3_sub(p_m, at.axis_m)).x;
		if (out > 0.0f)
			outer += v3_distance(slim->position_m[v], p_m) > 1e-6f;
		if (out > -0.9f)
			continue;
		inner++;
		CHECK(side * slim->position_m[v].x < 0.01f);
	}
	CHECK(inner > 50 && outer == 0);
}

/* An arm that points elsewhere is straight there, as long as it was, and takes along what lies on
 * it; grown, it is the arm itself again. */
static void test_turned(void)
{
	struct v3 toward[PART_COUNT] = {0}, out = {1.0f, 0.0f, 0.0f};
	toward[PART_ARM_LEFT] = out;
	CHECK(body_slim_make(&slim_body, &body, limb, 0, toward));
	for (int b = 0; b < body.bone_count; b++) {
		const struct bone *full = &body.bone[b], *bone = &slim->bone[b];
		struct v3 way = v3_sub(bone->b_m, bone->a_m);
		CHECK_NEAR(v3_length(way), v3_distance(full->a_m, full->b_m), 1e-5);
		if (full->part == PART_ARM_LEFT)
			CHECK(v3_dot(v3_normalize(way), out) > 0.9999f);
		else
			CHECK(v3_distance(bone->a_m, full->a_m) == 0.0f);
	}
	int carried = 0;
	for (int t = 0; t < body.triangle_count; t++) {
		const int *v = body.triangle[t].v;
		struct beside at;
		if (body.part[t] != PART_ARM_LEFT ||
		    !body_beside(slim, PART_ARM_LEFT, slim->position_m[v[0]], &at) ||
		    at.reach_m < 0.1f)
			continue;
		struct v3 to_m = body_slim_carry(&slim_body, &body, t, at.axis_m, 1.0f), near_m;
		near_m = body_nearest_bone(&body, 1u << PART_ARM_LEFT, to_m);
		CHECK(v3_distance(to_m, near_m) < 0.02f);
		carried++;
	}
	CHECK(carried > 100);
	body_slim_grow(&slim_body, &body, 1.0f);
	for (int v = 0; v < body.vertex_count; v++)
		CHECK(v3_distance(slim->position_m[v], body.position_m[v]) < 1e-5f);
}

/* A body without bones has nothing to draw in. */
static void test_boneless(void)
{
	body.bone_count = 0;
	CHECK(!body_slim_make(&slim_body, &body, limb, 0, NULL));
}

int main(void)
{
	enum { BYTES = 128 << 20 };
	struct arena arena;
	void *memory = malloc(BYTES);
	arena_init(&arena, memory, BYTES);
	body_init(&body, &arena);
	body_slim_init(&slim_body, &arena);
	CHECK(!body_build_mannequin(&body) && body_find_parts(&body));
	body_measure_limbs(&body, limb);
	test_limbs();
	test_hull();
	test_thin();
	test_hidden();
	test_grown();
	test_whole();
	test_joined();
	test_turned();
	test_boneless();
	free(memory);
	return test_end();
}
