/* From pen samples to a closed, evenly weighted trace with its tremor taken out. */
#include "pattern_private.h"

enum {
	LOOP_MM_MIN = 80, /* a shorter loop was a tap or a slip */
	LINE_MM_MIN = 15,
	SPARSE_DIVISOR = 300, /* of the path: longer gaps between samples are filled */
};

#define GAP_SHARE_MAX 0.25f /* of the line: a wider opening is no closed outline */
#define TAIL_SHARE 0.2f     /* of the line at each end may be an overlap */
#define TAIL_PRICE 0.15f    /* a millimetre of the line cut off, in millimetres of gap */

static float path_length(const struct v2 *point, int count)
{
	float length = 0.0f;
	for (int i = 1; i < count; i++)
		length += v2_distance(point[i - 1], point[i]);
	return length;
}

static int fill_steps(struct v2 a, struct v2 b, float gap)
{
	return 1 + (int)float_min(v2_distance(a, b) / gap, 64.0f);
}

/* Shell's sort: enough for a median. */
static void sort_floats(float *value, int count)
{
	for (int gap = count / 2; gap > 0; gap /= 2)
		for (int i = gap; i < count; i++)
			for (int k = i; k >= gap && value[k] < value[k - gap]; k -= gap) {
				float swap = value[k];
				value[k] = value[k - gap];
				value[k - gap] = swap;
			}
}

/* The variance of white noise from second differences: an axis has 6 times the variance, the
 * squared length of both is exponentially distributed with median 12 ln 2 = 8.3 times. A smooth
 * line has hardly any second difference; sharp places are too few to move a median. */
static float noise_variance(const struct v2 *stroke, int count)
{
	float squared[TRACE_SAMPLES_MAX];
	int taken = 0, skip = 1 + count / TRACE_SAMPLES_MAX;
	for (int i = 1; i + 1 < count; i += skip) {
		struct v2 second = v2_sub(v2_add(stroke[i - 1], stroke[i + 1]),
					  v2_scale(stroke[i], 2.0f));
		squared[taken++] = v2_dot(second, second);
	}
	sort_floats(squared, taken);
	return taken > 0 ? squared[taken / 2] / 8.3f : 0.0f;
}

/* Copies the stroke: gaps filled, then as many neighbours averaged as it takes to fit. Averaging
 * loses nothing: tremor is independent from sample to sample. */
static void load(struct trace *trace, const struct v2 *stroke, int count, float length)
{
	float variance = noise_variance(stroke, count);
	/* Tremor makes jumps, too; they are not gaps. */
	float gap = float_max(length / (float)SPARSE_DIVISOR, 6.0f * sqrtf(variance) + 0.1f);
	int total = 1;
	for (int i = 1; i < count; i++)
		total += fill_steps(stroke[i - 1], stroke[i], gap);
	int limit = TRACE_SAMPLES_MAX * 3 / 4; /* the rest is for closing the gap */
	int group = (total + limit - 1) / limit, members = 0;
	struct v2 sum = {0};
	trace->noise_mm2 = variance / (float)group;
	trace->count = 0;
	for (int i = 0; i < count; i++) {
		int steps = i > 0 ? fill_steps(stroke[i - 1], stroke[i], gap) : 1;
		for (int k = 1; k <= steps; k++) {
			float t = (float)k / (float)steps;
			struct v2 p = i > 0 ? v2_lerp(stroke[i - 1], stroke[i], t) : stroke[0];
			sum = v2_add(sum, p);
			if (++members < group)
				continue;
			trace->raw_mm[trace->count++] = v2_scale(sum, 1.0f / (float)group);
			sum = (struct v2){0};
			members = 0;
		}
	}
}

/* exp(-x) for x in 0 .. 4.5 or so, by a rational square: only a weight. */
static float bell(float x)
{
	float r = 1.0f / (1.0f + x * (0.25f + x * 0.03125f));
	r *= r;
	return r * r;
}

/* A bell-shaped average over neighbours; `wide` samples is its standard deviation. */
static void smooth_trace(struct trace *trace, float wide, bool closed)
{
	int reach = int_min((int)(3.0f * wide) + 1, trace->count / 2 - 1);
	for (int i = 0; i < trace->count; i++) {
		struct v2 sum = {0};
		float weights = 0.0f;
		/* At an open end the window shrinks from both sides, so that the end stays. */
		int here = closed ? reach : int_min(reach, int_min(i, trace->count - 1 - i));
		for (int k = -here; k <= here; k++) {
			int at = i + k;
			at = at < 0 ? at + trace->count : at;
			at = at >= trace->count ? at - trace->count : at;
			float weight = bell(0.5f * (float)(k * k) / (wide * wide));
			sum = v2_add(sum, v2_scale(trace->raw_mm[at], weight));
			weights += weight;
		}
		trace->smooth_mm[i] = v2_scale(sum, 1.0f / weights);
	}
}

/* How wide to smooth so that `rest_mm` of tremor remains: averaging with a bell of deviation g
 * divides the variance by 2 sqrt(pi) g. */
static float smoothing_width(float variance, float rest_mm)
{
	return float_clamp(variance / (3.545f * rest_mm * rest_mm), 0.8f, 24.0f);
}

static void measure_along(struct trace *trace)
{
	trace->s_mm[0] = 0.0f;
	for (int i = 0; i < trace->count; i++) {
		int next = i + 1 < trace->count ? i + 1 : 0;
		trace->s_mm[i + 1] = trace->s_mm[i] +
				     v2_distance(trace->smooth_mm[i], trace->smooth_mm[next]);
	}
}

/* Where the line meets itself: the sample near its start and the one near its end that belong
 * together, so that overlapping tails fall away. Returns the gap between them. */
static float find_closure(const struct trace *trace, int *from, int *to)
{
	float length = trace->s_mm[trace->count - 1], best = 1e30f, gap = 0.0f;
	for (int i = 0; i < trace->count && trace->s_mm[i] <= TAIL_SHARE * length; i++) {
		for (int k = trace->count - 1; k > i; k--) {
			float tail = length - trace->s_mm[k];
			if (tail > TAIL_SHARE * length)
				break;
			float distance = v2_distance(trace->smooth_mm[i], trace->smooth_mm[k]);
			float cost = distance + TAIL_PRICE * (trace->s_mm[i] + tail);
			if (cost < best) {
				best = cost;
				gap = distance;
				*from = i;
				*to = k;
			}
		}
	}
	return gap;
}

/* Keeps samples from .. to and bridges what is open by a straight line. */
static void close_trace(struct trace *trace, int from, int to, float gap)
{
	int kept = to - from + 1;
	float spacing = (trace->s_mm[to] - trace->s_mm[from]) / (float)kept;
	struct v2 end = trace->smooth_mm[to], start = trace->smooth_mm[from];
	memmove(trace->raw_mm, trace->raw_mm + from, (size_t)kept * sizeof *trace->raw_mm);
	trace->count = kept;
	int bridge = (int)float_min(gap / float_max(spacing, 0.01f),
				    (float)(TRACE_SAMPLES_MAX - kept));
	for (int k = 1; k < bridge; k++)
		trace->raw_mm[trace->count++] = v2_lerp(end, start, (float)k / (float)bridge);
}

static float smooth_area(const struct trace *trace)
{
	float twice = 0.0f;
	struct v2 origin = trace->smooth_mm[0];
	for (int i = 1; i + 1 < trace->count; i++)
		twice += v2_cross(v2_sub(trace->smooth_mm[i], origin),
				  v2_sub(trace->smooth_mm[i + 1], origin));
	return 0.5f * twice;
}

static void reverse_points(struct v2 *point, int count)
{
	for (int i = 0, k = count - 1; i < k; i++, k--) {
		struct v2 swap = point[i];
		point[i] = point[k];
		point[k] = swap;
	}
}

void trace_reverse(struct trace *trace)
{
	reverse_points(trace->raw_mm, trace->count);
	reverse_points(trace->smooth_mm, trace->count);
	measure_along(trace);
}

static bool all_finite(const struct v2 *point, int count)
{
	for (int i = 0; i < count; i++)
		if (!(float_abs(point[i].x) < 9000.0f && float_abs(point[i].y) < 9000.0f))
			return false;
	return true;
}

static const char *check_stroke(const struct v2 *stroke_mm, int count)
{
	if (count < 8)
		return "too short: draw the whole line in one go";
	if (!all_finite(stroke_mm, count))
		return "the line leaves the sheet";
	return NULL;
}

const char *trace_read_open(struct trace *trace, const struct v2 *stroke_mm, int count)
{
	const char *fault = check_stroke(stroke_mm, count);
	if (fault)
		return fault;
	load(trace, stroke_mm, count, path_length(stroke_mm, count));
	if (trace->count < 8)
		return "too short: draw a longer line";
	smooth_trace(trace, smoothing_width(trace->noise_mm2, 2.0f), false);
	trace->open = true;
	measure_along(trace);
	trace->spacing_mm = trace->s_mm[trace->count] / (float)count;
	return trace->s_mm[trace->count] >= (float)LINE_MM_MIN ? NULL
							       : "too short: draw a longer line";
}

const char *trace_read(struct trace *trace, const struct v2 *stroke_mm, int count)
{
	const char *fault = check_stroke(stroke_mm, count);
	if (fault)
		return fault;
	float length = path_length(stroke_mm, count);
	if (length < (float)LOOP_MM_MIN)
		return "too small: draw the outline larger";
	load(trace, stroke_mm, count, length);
	if (trace->count < 8)
		return "too short: draw the whole line in one go";
	trace->open = false;
	smooth_trace(trace, smoothing_width(trace->noise_mm2, 3.0f), false);
	measure_along(trace);
	int from = 0, to = trace->count - 1;
	float gap = find_closure(trace, &from, &to);
	float kept = trace->s_mm[to] - trace->s_mm[from];
	trace->spacing_mm = trace->s_mm[trace->count - 1] / (float)count;
	if (gap > GAP_SHARE_MAX * kept)
		return "the line is open: end it where it began";
	if (kept < (float)LOOP_MM_MIN)
		return "too small: draw the outline larger";
	close_trace(trace, from, to, gap);
	float rest_mm = float_clamp(kept / 1000.0f, 0.5f, 3.0f);
	smooth_trace(trace, smoothing_width(trace->noise_mm2, rest_mm), true);
	measure_along(trace);
	if (smooth_area(trace) < 0.0f)
		trace_reverse(trace);
	return NULL;
}

float trace_distance_mm(const struct trace *trace, int a, int b)
{
	float length = trace->s_mm[trace->count];
	float from = a >= trace->count ? trace->s_mm[a - trace->count] + length : trace->s_mm[a];
	float to = b >= trace->count ? trace->s_mm[b - trace->count] + length : trace->s_mm[b];
	return to - from;
}
