/* Our own trigonometry against the C library's, and the identities that rotations must keep. */
#include "vec.h"
#include "test.h"

static void test_angles(void)
{
	for (int i = -4000; i <= 4000; i++) {
		float angle = (float)i * 0.025f;
		CHECK_NEAR(angle_sin(angle), sin((double)angle), 3e-6);
		CHECK_NEAR(angle_cos(angle), cos((double)angle), 3e-6);
	}
	for (int i = -628; i < 628; i++) {
		double angle = 0.005 * i;
		float y = (float)(3.0 * sin(angle)), x = (float)(3.0 * cos(angle));
		CHECK_NEAR(angle_atan2(y, x), atan2((double)y, (double)x), 1e-6);
	}
	CHECK(angle_atan2(0.0f, 0.0f) == 0.0f);
	CHECK_NEAR(angle_atan2(0.0f, -1.0f), PI_F, 1e-6);
	for (int i = -100; i <= 100; i++)
		CHECK_NEAR(angle_acos((float)i / 100.0f), acos(i / 100.0), 3e-5);
	CHECK(angle_acos(2.0f) == 0.0f);
}

static void test_turn(void)
{
	struct v3 axis = v3_normalize((struct v3){1.0f, -2.0f, 0.5f});
	struct v3 v = {0.3f, 0.7f, -1.1f}, turned = v;
	for (int i = 0; i < 12; i++)
		turned = v3_turn(turned, axis, PI_F / 6.0f);
	CHECK_NEAR(v3_distance(v, turned), 0.0, 2e-5);
	CHECK_NEAR(v3_length(v3_turn(v, axis, 1.0f)), v3_length(v), 1e-6);
	struct v3 x = v3_turn((struct v3){1, 0, 0}, (struct v3){0, 0, 1}, PI_F / 2.0f);
	CHECK_NEAR(x.y, 1.0, 1e-6); /* right-hand rule */
}

static void test_products(void)
{
	struct v3 a = {1.0f, 2.0f, 3.0f}, b = {-2.0f, 0.5f, 4.0f}, c = v3_cross(a, b);
	CHECK_NEAR(v3_dot(a, c), 0.0, 1e-5);
	CHECK_NEAR(v3_dot(b, c), 0.0, 1e-5);
	CHECK(v2_cross((struct v2){1, 0}, (struct v2){0, 1}) > 0.0f);
	CHECK(v3_length(v3_normalize((struct v3){0, 0, 0})) == 0.0f);
	struct m3 m = {{{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}}};
	struct v3 back = m3_apply_transposed(&m, m3_apply(&m, a));
	CHECK_NEAR(v3_distance(a, back), 0.0, 1e-6);
}

int main(void)
{
	test_angles();
	test_turn();
	test_products();
	return test_end();
}
