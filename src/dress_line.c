/* A mark without the hand's tremor: local linear regression (Cleveland 1979, without the weights
 * for outliers). Unlike repeated averaging it does not pull in the ends. */
#include "dress_private.h"

static const float window_m = 0.08f;     /* to each side, */
static const float window_share = 0.25f; /* or this share of a short line */

static float line_length(const struct v3 *point, int count)
{
	float length = 0.0f;
	for (int i = 1; i < count; i++)
		length += v3_distance(point[i - 1], point[i]);
	return length;
}

void wrap_steady_line(const struct v3 *point, int count, float length_m, struct v3 *steady)
{
	float length = length_m > 0.0f ? length_m : line_length(point, count);
	float window = float_min(window_m, window_share * length);
	float reach = window / float_max(length, 1e-6f) * (float)(count - 1);
	for (int i = 0; i < count; i++) {
		float s0 = 0.0f, s1 = 0.0f, s2 = 0.0f;
		struct v3 p0 = {0.0f, 0.0f, 0.0f}, p1 = {0.0f, 0.0f, 0.0f};
		for (int j = 0; j < count; j++) {
			float d = (float)(j - i), u = d / float_max(reach, 1.5f);
			if (u <= -1.0f || u >= 1.0f)
				continue;
			float weight = (1.0f - u * u) * (1.0f - u * u);
			s0 += weight;
			s1 += weight * d;
			s2 += weight * d * d;
			p0 = v3_mad(p0, point[j], weight);
			p1 = v3_mad(p1, point[j], weight * d);
		}
		float det = s0 * s2 - s1 * s1;
		steady[i] = det > 1e-6f ? v3_scale(v3_sub(v3_scale(p0, s2), v3_scale(p1, s1)),
						   1.0f / det)
					: point[i];
	}
}
