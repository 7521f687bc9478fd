/* A mark without the hand's tremor: robust local linear regression (Cleveland 1979), which unlike
 * repeated averaging does not pull in the ends; then a walk of equal steps along it, so that where
 * a hand waits or trembles on one spot the line has a direction. */
#include "dress_private.h"

enum { DOUBTS = 3 };

static const float window_m = 0.08f;     /* to each side, */
static const float window_share = 0.25f; /* or this share of a short line */
static const float wide_share = 0.5f;    /* the same of a straight line that trembles */
static const float tilt_rad = 0.05f;     /* the error that an end's direction may have */
static const float lag_m = 0.03f;        /* bends so short are the hand's, not the line's */
static const float hook_strays = 4.0f;   /* a point so far off, in means, is the pen's landing */
static const float straight_share = 0.95f, bent_share = 0.85f; /* of its length: from end to end */
static const float step_m = 0.015f;
static const float step_share = 1.0f / 12.0f; /* the same of a short line */

static float line_length(const struct v3 *point, int count)
{
	float length = 0.0f;
	for (int i = 1; i < count; i++)
		length += v3_distance(point[i - 1], point[i]);
	return length;
}

/* What the hand did of a deviation: across a body it goes where the surface goes. */
static struct v3 by_hand(struct v3 off, const struct v3 *normal, int i)
{
	return normal ? v3_mad(off, normal[i], -v3_dot(off, normal[i])) : off;
}

/* How far the hand strayed to each side, rms: from second differences over a short lag. */
static float stray(const struct v3 *point, const struct v3 *normal, int count, float length)
{
	int lag = int_max(1, (int)(lag_m / float_max(length, 1e-6f) * (float)(count - 1)));
	float sum = 0.0f;
	for (int i = lag; i + lag < count; i++) {
		struct v3 bend = v3_sub(v3_add(point[i - lag], point[i + lag]),
					v3_scale(point[i], 2.0f));
		bend = by_hand(bend, normal, i);
		sum += v3_dot(bend, bend);
	}
	/* Six variances on each of two axes. */
	return sqrtf(sum / (12.0f * (float)int_max(1, count - 2 * lag)));
}

/* The widest window, as a share of the length: only a line that is straight may take much of it. */
static float most_share(const struct v3 *point, int count, float length)
{
	float straight = v3_distance(point[0], point[count - 1]) / float_max(length, 1e-6f);
	float much = (straight - bent_share) / (straight_share - bent_share);
	return window_share + float_clamp(much, 0.0f, 1.0f) * (wide_share - window_share);
}

/* The window that brings the direction at an end within tilt_rad: a slope fitted to n points over a
 * width w strays by (stray / w) sqrt(12 / n). */
static float window_of(const struct v3 *point, const struct v3 *normal, int count, float length,
		       float most)
{
	float window = float_min(window_m, window_share * length);
	float cubed = stray(point, normal, count, length) / tilt_rad;
	cubed *= cubed * 12.0f * length / (float)count;
	while (window < most && window * window * window < cubed)
		window *= 1.1f;
	return float_min(window, most);
}

/* Local regression over the points nearer than `reach` of the index. */
static void regress(const struct v3 *point, const float *trust, int count, float reach,
		    struct v3 *steady)
{
	for (int i = 0; i < count; i++) {
		float s0 = 0.0f, s1 = 0.0f, s2 = 0.0f;
		struct v3 p0 = {0.0f, 0.0f, 0.0f}, p1 = {0.0f, 0.0f, 0.0f};
		for (int j = 0; j < count; j++) {
			float d = (float)(j - i), u = d / float_max(reach, 1.5f);
			if (u <= -1.0f || u >= 1.0f)
				continue;
			float weight = trust[j] * (1.0f - u * u) * (1.0f - u * u);
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

/* Bisquare weights of the distances from the line seen as one: the hooks of a pen that lands or
 * lifts weigh nothing. */
static void doubt(const struct v3 *point, const struct v3 *normal, const struct v3 *steady,
		  int count, float *trust)
{
	float mean = 0.0f;
	for (int i = 0; i < count; i++) {
		trust[i] = v3_length(by_hand(v3_sub(point[i], steady[i]), normal, i));
		mean += trust[i] / (float)count;
	}
	for (int i = 0; i < count; i++) {
		float off = trust[i] / float_max(hook_strays * mean, 1e-6f);
		trust[i] = off < 1.0f ? (1.0f - off * off) * (1.0f - off * off) : 0.0f;
	}
}

/* The widest window first: what it says of the whole line tells the tremor from the line. */
void wrap_steady_line(const struct v3 *point, const struct v3 *normal, int count, struct v3 *steady)
{
	float trust[MARK_POINTS_MAX];
	for (int i = 0; i < count; i++)
		trust[i] = 1.0f;
	regress(point, trust, count, window_share * (float)(count - 1), steady);
	float length = line_length(steady, count);
	float share = most_share(steady, count, length);
	float window = window_of(point, normal, count, length, share * length);
	for (int round = 0; round < DOUBTS; round++) {
		regress(point, trust, count, share * (float)(count - 1), steady);
		doubt(point, normal, steady, count, trust);
	}
	regress(point, trust, count, window / float_max(length, 1e-6f) * (float)(count - 1),
		steady);
}

void wrap_steady_normals(const struct v3 *normal, int count, float length_m, struct v3 *steady)
{
	float trust[MARK_POINTS_MAX];
	for (int i = 0; i < count; i++)
		trust[i] = 1.0f;
	float window = float_min(window_m / float_max(length_m, 1e-6f), window_share);
	regress(normal, trust, count, window * (float)(count - 1), steady);
}

/* How far along a -> b a line first leaves the ball round `from`; above 1: it does not. */
static float leaves_at(struct v3 from, float radius, struct v3 a, struct v3 b)
{
	struct v3 way = v3_sub(b, a), to = v3_sub(a, from);
	float aa = v3_dot(way, way), bb = v3_dot(way, to), cc = v3_dot(to, to) - radius * radius;
	if (v3_distance(from, b) < radius || aa < 1e-12f)
		return 2.0f;
	return float_clamp((sqrtf(float_max(bb * bb - aa * cc, 0.0f)) - bb) / aa, 0.0f, 1.0f);
}

int wrap_walk_line(const struct v3 *point, int count, struct v3 *walk)
{
	float length = line_length(point, count);
	float step = float_max(float_min(step_m, step_share * length),
			       length / (float)(MARK_POINTS_MAX - 2));
	int made = 0;
	walk[made++] = point[0];
	for (int i = 1; i < count; i++) {
		struct v3 at = point[i - 1];
		float t;
		while (made + 1 < MARK_POINTS_MAX &&
		       (t = leaves_at(walk[made - 1], step, at, point[i])) <= 1.0f) {
			at = v3_lerp(at, point[i], t);
			walk[made++] = at;
		}
	}
	/* The last step is as long as another, or up to half as long again. */
	if (made > 1 && v3_distance(walk[made - 1], point[count - 1]) < 0.5f * step)
		made--;
	walk[made++] = point[count - 1];
	return made;
}
