/* Where are the corners of a trembling line? Every way to cut the loop into runs is judged by how
 * well a cubic explains each run, plus a price a run; dynamic programming finds the cheapest (the
 * segmented least squares of Bellman 1961). A corner is where two runs are much cheaper than one.
 *
 * Sums are in double: only + - * /, so the bits agree everywhere, and the normal equations of a
 * cubic need the digits. */
#include "pattern_private.h"

enum { NODES_MAX = 200, RUN_NODES_MIN = 3 };

/* The price of a run: a hand's slow wobble, in proportion to the drawing, what eight more
 * coefficients win from pure noise, and the bevel that a fast pen makes of a corner. */
#define WOBBLE_SHARE (1.0f / 900.0f) /* of the outline's length */
#define WOBBLE_SPAN (1.0f / 16.0f)
#define NOISE_PRICE 18.0f
#define BEVEL_PRICE 0.1f /* reports this far apart cut corners off */
#define CURVE_PRICE 2.0  /* of a straight run: it has twice the coefficients */

/* Running sums of a weighted cubic fit in t = distance / scale from the run's start. */
struct sums {
	double power[7]; /* sum w t^k */
	double x[4], y[4], squared;
};

static void sums_add(struct sums *sums, double t, double x, double y, double weight)
{
	double power = weight;
	for (int k = 0; k < 7; k++) {
		sums->power[k] += power;
		if (k < 4) {
			sums->x[k] += power * x;
			sums->y[k] += power * y;
		}
		power *= t;
	}
	sums->squared += weight * (x * x + y * y);
}

/* Solves the 4 x 4 normal equations by L D L^T for u = t / span; a direction that the samples don't
 * determine gets the coefficient 0. rest[k] is what a polynomial of degree k leaves of the squares.
 */
static void sums_solve(const struct sums *sums, double span, double x[4], double y[4],
		       double rest[4])
{
	double scale[7] = {1.0};
	for (int k = 1; k < 7; k++)
		scale[k] = scale[k - 1] / span;
	double lower[4][4], pivot[4];
	double left = sums->squared;
	for (int i = 0; i < 4; i++) {
		x[i] = sums->x[i] * scale[i];
		y[i] = sums->y[i] * scale[i];
		for (int k = 0; k <= i; k++) {
			double a = sums->power[i + k] * scale[i + k];
			for (int m = 0; m < k; m++)
				a -= lower[i][m] * lower[k][m] * pivot[m];
			if (k == i)
				pivot[i] = a > 1e-9 * sums->power[0] ? a : 0.0;
			else
				lower[i][k] = pivot[k] > 0.0 ? a / pivot[k] : 0.0;
		}
		for (int m = 0; m < i; m++) {
			x[i] -= lower[i][m] * x[m];
			y[i] -= lower[i][m] * y[m];
		}
		if (pivot[i] > 0.0)
			left -= (x[i] * x[i] + y[i] * y[i]) / pivot[i];
		rest[i] = left > 0.0 ? left : 0.0;
	}
	for (int i = 3; i >= 0; i--) {
		x[i] = pivot[i] > 0.0 ? x[i] / pivot[i] : 0.0;
		y[i] = pivot[i] > 0.0 ? y[i] / pivot[i] : 0.0;
		for (int m = i + 1; m < 4; m++) {
			x[i] -= lower[m][i] * x[m];
			y[i] -= lower[m][i] * y[m];
		}
	}
}

static int wrap_index(const struct trace *trace, int i)
{
	return i >= trace->count ? i - trace->count : i;
}

/* Adds sample i of a run that starts at `first`; its weight is the stretch it stands for. */
static void sums_sample(struct sums *sums, const struct trace *trace, int first, int i)
{
	int at = wrap_index(trace, i), before = at > 0 ? at - 1 : trace->count - 1;
	float ahead = trace->s_mm[at + 1] - trace->s_mm[at];
	float behind = trace->s_mm[before + 1] - trace->s_mm[before];
	struct v2 origin = trace->smooth_mm[wrap_index(trace, first)];
	struct v2 p = v2_sub(trace->raw_mm[at], origin);
	double t = (double)trace_distance_mm(trace, first, i) / (double)trace->s_mm[trace->count];
	sums_add(sums, t, (double)p.x, (double)p.y, 0.5 * (double)(ahead + behind));
}

void run_fit(struct run *run, const struct trace *trace, int first, int last)
{
	struct sums sums = {0};
	for (int i = first; i <= last; i++)
		sums_sample(&sums, trace, first, i);
	run->first = first;
	run->last = last;
	run->length_mm = trace_distance_mm(trace, first, last);
	double span = (double)run->length_mm / (double)trace->s_mm[trace->count];
	double x[4], y[4], rest[4];
	sums_solve(&sums, span > 1e-6 ? span : 1e-6, x, y, rest);
	run->cost_mm3 = (float)rest[3];
	run->line_cost_mm3 = (float)rest[1];
	struct v2 origin = trace->smooth_mm[wrap_index(trace, first)];
	for (int k = 0; k < 4; k++) {
		run->x[k] = (float)x[k] + (k == 0 ? origin.x : 0.0f);
		run->y[k] = (float)y[k] + (k == 0 ? origin.y : 0.0f);
	}
}

struct v2 run_point(const struct run *run, float u)
{
	const float *x = run->x, *y = run->y;
	return (struct v2){x[0] + u * (x[1] + u * (x[2] + u * x[3])),
			   y[0] + u * (y[1] + u * (y[2] + u * y[3]))};
}

double run_price_mm3(const struct trace *trace)
{
	float length = trace->s_mm[trace->count];
	float wobble = WOBBLE_SHARE * length;
	float spacing = length / (float)trace->count;
	return (double)(wobble * wobble * WOBBLE_SPAN * length +
			NOISE_PRICE * trace->noise_mm2 * spacing +
			BEVEL_PRICE * trace->spacing_mm * trace->spacing_mm * trace->spacing_mm);
}

/* The table of the dynamic program: the cheapest way to each node. */
struct division {
	int start, span; /* samples start .. start + span; a loop cut open: span = count */
	int nodes;
	double price;
	double best[NODES_MAX + 1];
	int from[NODES_MAX + 1], runs[NODES_MAX + 1];
};

static int node_sample(const struct division *division, int node)
{
	return division->start + node * division->span / division->nodes;
}

/* Tries one run from node i to every later node. */
static void extend_from(struct division *division, const struct trace *trace, int i)
{
	struct sums sums = {0};
	int shift = node_sample(division, i) >= trace->count ? trace->count : 0;
	int first = node_sample(division, i) - shift, at = first;
	for (int j = i + 1; j <= division->nodes; j++) {
		int last = node_sample(division, j) - shift;
		for (; at <= last; at++)
			sums_sample(&sums, trace, first, at);
		if (j - i < RUN_NODES_MIN)
			continue;
		double length = (double)trace_distance_mm(trace, first, last) /
				(double)trace->s_mm[trace->count];
		double x[4], y[4], rest[4];
		sums_solve(&sums, length > 1e-6 ? length : 1e-6, x, y, rest);
		double curve = rest[3] + CURVE_PRICE * division->price;
		double line = rest[1] + division->price;
		double cost = division->best[i] + (line < curve ? line : curve);
		if (cost < division->best[j]) {
			division->best[j] = cost;
			division->from[j] = i;
			division->runs[j] = division->runs[i] + 1;
		}
	}
}

/* The cheapest division. Returns the number of runs; cut[k] is where run k starts. */
static int divide(const struct trace *trace, int start, int span, int cut[RUNS_MAX])
{
	struct division division = {.start = start,
				    .span = span,
				    .nodes = int_min(NODES_MAX, span),
				    .price = run_price_mm3(trace)};
	for (int j = 1; j <= division.nodes; j++)
		division.best[j] = 1e300;
	for (int i = 0; i < division.nodes; i++)
		if (division.best[i] < 1e300 && division.runs[i] < RUNS_MAX)
			extend_from(&division, trace, i);
	int count = division.runs[division.nodes], node = division.nodes;
	MUST(count >= 1 && count <= RUNS_MAX);
	for (int k = count - 1; k >= 0; k--) {
		node = division.from[node];
		cut[k] = wrap_index(trace, node_sample(&division, node));
	}
	return count;
}

/* The end of run k: the next cut, after it. */
static int run_end(const struct trace *trace, const int *cut, int count, int k)
{
	int end = cut[k + 1 < count ? k + 1 : 0];
	return end > cut[k] ? end : end + trace->count;
}

/* How much the line turns at cut k: the cosine between the thirds on either side of it. */
static float turn_cosine(const struct trace *trace, const int *cut, int count, int k)
{
	struct run before, after;
	int previous = k > 0 ? k - 1 : count - 1;
	run_fit(&before, trace, cut[previous], run_end(trace, cut, count, previous));
	run_fit(&after, trace, cut[k], run_end(trace, cut, count, k));
	struct v2 in = v2_sub(run_point(&before, 1.0f), run_point(&before, 0.67f));
	struct v2 out = v2_sub(run_point(&after, 0.33f), run_point(&after, 0.0f));
	return v2_dot(v2_normalize(in), v2_normalize(out));
}

/* What a run costs with its price, as a line or as a curve. */
static float run_score(const struct run *run, float price)
{
	return float_min(run->line_cost_mm3, run->cost_mm3 + ((float)CURVE_PRICE - 1.0f) * price);
}

/* Of the samples near `middle`, the one where runs first .. it .. end cost least together. */
static int best_cut(const struct trace *trace, int first, int middle, int end)
{
	int reach = 2 * (trace->count / NODES_MAX + 1), best_at = middle;
	float best = 1e30f, price = (float)run_price_mm3(trace);
	for (int at = int_max(middle - reach, first + 3); at <= int_min(middle + reach, end - 3);
	     at++) {
		struct run before, after;
		int base = wrap_index(trace, at);
		run_fit(&before, trace, first, at);
		run_fit(&after, trace, base, base + end - at);
		float score = run_score(&before, price) + run_score(&after, price);
		if (score < best) {
			best = score;
			best_at = at;
		}
	}
	return best_at;
}

static void refine_loop(const struct trace *trace, int *cut, int count)
{
	for (int k = 0; k < count && count > 1; k++) {
		int previous = k > 0 ? k - 1 : count - 1;
		int middle = run_end(trace, cut, count, previous);
		int end = run_end(trace, cut, count, k) - cut[k] + middle;
		cut[k] = wrap_index(trace, best_cut(trace, cut[previous], middle, end));
	}
}

void runs_find(struct runs *runs, const struct trace *trace)
{
	int cut[RUNS_MAX];
	int count = divide(trace, 0, trace->count, cut);
	/* Where the pen came down need not be a corner: cut the loop open at its sharpest. */
	int sharpest = 0;
	float least = 2.0f;
	for (int k = 0; k < count; k++) {
		float cosine = turn_cosine(trace, cut, count, k);
		if (cosine < least) {
			least = cosine;
			sharpest = k;
		}
	}
	count = divide(trace, cut[sharpest], trace->count, cut);
	refine_loop(trace, cut, count);
	runs->count = count;
	for (int k = 0; k < count; k++)
		run_fit(&runs->run[k], trace, cut[k], run_end(trace, cut, count, k));
}

void runs_find_open(struct runs *runs, const struct trace *trace)
{
	int cut[RUNS_MAX + 1], last = trace->count - 1;
	int count = divide(trace, 0, last, cut);
	cut[count] = last;
	for (int k = 1; k < count; k++)
		cut[k] = best_cut(trace, cut[k - 1], cut[k], cut[k + 1]);
	runs->count = count;
	for (int k = 0; k < count; k++)
		run_fit(&runs->run[k], trace, cut[k], cut[k + 1]);
}
