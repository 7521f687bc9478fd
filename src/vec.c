#include "vec.h"

/* Reduces to [-pi/4, pi/4] and a quadrant. Two-part pi/2 (Cody and Waite) keeps the reduction exact
 * enough up to a hundred radians. */
static float reduce(float angle_rad, int *quadrant)
{
	float turns = angle_rad * (2.0f / PI_F);
	int n = (int)(turns + (turns >= 0.0f ? 0.5f : -0.5f));
	*quadrant = n & 3;
	float k = (float)n;
	return (angle_rad - k * 1.5703125f) - k * 4.83826794897e-4f;
}

static float sin_kernel(float x)
{
	float s = x * x;
	return x + x * s * (-0.16666654611f + s * (0.0083321608736f + s * -0.00019515295891f));
}

static float cos_kernel(float x)
{
	float s = x * x;
	return 1.0f - 0.5f * s +
	       s * s * (0.041666645683f + s * (-0.0013887316255f + s * 2.443315711e-5f));
}

float angle_sin(float angle_rad)
{
	int quadrant;
	float x = reduce(angle_rad, &quadrant);
	float value = quadrant & 1 ? cos_kernel(x) : sin_kernel(x);
	return quadrant & 2 ? -value : value;
}

float angle_cos(float angle_rad)
{
	int quadrant;
	float x = reduce(angle_rad, &quadrant);
	float value = quadrant & 1 ? sin_kernel(x) : cos_kernel(x);
	return quadrant == 1 || quadrant == 2 ? -value : value;
}

/* atan on [0, 1] after reducing by atan(x) = pi/4 + atan((x-1)/(x+1)) above tan(pi/8). */
static float atan_unit(float x)
{
	float offset = 0.0f;
	if (x > 0.4142135624f) {
		offset = 0.25f * PI_F;
		x = (x - 1.0f) / (x + 1.0f);
	}
	float s = x * x;
	return offset + x +
	       x * s *
		       (-0.333329491539f +
			s * (0.199777106478f + s * (-0.138776856032f + s * 0.0805374449538f)));
}

float angle_atan2(float y, float x)
{
	float ax = float_abs(x), ay = float_abs(y);
	if (ax == 0.0f && ay == 0.0f)
		return 0.0f;
	float angle = ay <= ax ? atan_unit(ay / ax) : 0.5f * PI_F - atan_unit(ax / ay);
	if (x < 0.0f)
		angle = PI_F - angle;
	return y < 0.0f ? -angle : angle;
}

float angle_acos(float cosine)
{
	float c = float_clamp(cosine, -1.0f, 1.0f);
	return angle_atan2(sqrtf(float_max(0.0f, 1.0f - c * c)), c);
}

struct v3 v3_turn(struct v3 v, struct v3 axis, float angle_rad)
{
	float s = angle_sin(angle_rad), c = angle_cos(angle_rad);
	struct v3 turned = v3_scale(v, c);
	turned = v3_mad(turned, v3_cross(axis, v), s);
	return v3_mad(turned, axis, v3_dot(axis, v) * (1.0f - c));
}
