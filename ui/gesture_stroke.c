/* A hand trembles by a millimetre or two, many times a second; what it means is the line between.
 */
#include "tool.h"

enum { SMOOTH_US = 45000, SMOOTH_SAMPLES_MAX = 16 };

/* Half the window in samples: 45 ms at the rate at which this contact's samples came. */
static int window_half(const struct ui *ui)
{
	int64_t duration_us = ui->last_us - ui->press_us;
	if (ui->stroke_count < 3 || duration_us <= 0)
		return 1;
	int64_t half = (int64_t)SMOOTH_US * (ui->stroke_count - 1) / duration_us;
	return half < 1 ? 1 : half > SMOOTH_SAMPLES_MAX ? SMOOTH_SAMPLES_MAX : (int)half;
}

/* Triangular weights: the mean of a mean. The window is cut at the ends, where pens are slow. */
int stroke_smooth(struct ui *ui)
{
	int half = window_half(ui);
	for (int i = 0; i < ui->stroke_count; i++) {
		struct v2 sum = {0.0f, 0.0f};
		float weight = 0.0f;
		for (int k = int_max(i - half, 0); k <= int_min(i + half, ui->stroke_count - 1);
		     k++) {
			float w = (float)(half + 1 - (k > i ? k - i : i - k));
			sum = v2_add(sum, v2_scale(ui->stroke_px[k], w));
			weight += w;
		}
		ui->smooth_px[i] = v2_scale(sum, 1.0f / weight);
	}
	return ui->stroke_count;
}

float stroke_length(const struct v2 *line, int count)
{
	float length = 0.0f;
	for (int i = 1; i < count; i++)
		length += v2_distance(line[i - 1], line[i]);
	return length;
}

int stroke_even(const struct v2 *in, int count, float spacing, struct v2 *out, int max)
{
	float length = stroke_length(in, count);
	if (count < 1)
		return 0;
	out[0] = in[0];
	if (!(length > 1e-6f))
		return 1;
	float wanted = length / spacing;
	int made = wanted < (float)(max - 1) ? int_max((int)wanted, 1) + 1 : max;
	float step = length / (float)(made - 1), along = 0.0f;
	int next = 1;
	for (int i = 1; i < count && next < made - 1; i++) {
		float piece = v2_distance(in[i - 1], in[i]);
		while (next < made - 1 && along + piece >= step * (float)next) {
			float t = piece > 0.0f ? (step * (float)next - along) / piece : 0.0f;
			out[next++] = v2_lerp(in[i - 1], in[i], float_clamp(t, 0.0f, 1.0f));
		}
		along += piece;
	}
	while (next < made) /* the last one, and any that rounding left over */
		out[next++] = in[count - 1];
	return made;
}

static float segment_distance(struct v2 a, struct v2 b, struct v2 point)
{
	struct v2 d = v2_sub(b, a);
	float square = v2_dot(d, d);
	float t = square > 0.0f ? v2_dot(v2_sub(point, a), d) / square : 0.0f;
	return v2_distance(point, v2_lerp(a, b, float_clamp(t, 0.0f, 1.0f)));
}

float stroke_distance(const struct v2 *line, int count, struct v2 point)
{
	float nearest = 1e9f;
	for (int i = 0; i < count; i++)
		nearest = float_min(nearest,
				    segment_distance(line[int_max(i - 1, 0)], line[i], point));
	return nearest;
}

int stroke_run(const bool *good, int count, int *first)
{
	int best = 0, start = 0;
	*first = 0;
	for (int i = 0; i <= count; i++) {
		if (i < count && good[i])
			continue;
		if (i - start > best) {
			best = i - start;
			*first = start;
		}
		start = i + 1;
	}
	return best;
}
