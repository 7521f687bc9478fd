/* Inside the reading of a freehand loop: the trace, its runs, the outline.
 *
 *   stroke --trace_read--> trace --runs_find--> runs --path_make, path_draw--> piece
 */
#ifndef PATTERN_PRIVATE_H
#define PATTERN_PRIVATE_H

#include "pattern.h"

enum {
	TRACE_SAMPLES_MAX = 1024,
	RUNS_MAX = 48, /* between corners and smooth joints */
};

/* A line, sampled, closed unless said otherwise. `raw` is what the hand did (averaged over a few
 * reports when there are more than TRACE_SAMPLES_MAX), `smooth` the same without its tremor; s_mm
 * measures along it. */
struct trace {
	bool open; /* an open line: its last sample does not lead to its first */
	int count;
	struct v2 raw_mm[TRACE_SAMPLES_MAX];
	struct v2 smooth_mm[TRACE_SAMPLES_MAX];
	float s_mm[TRACE_SAMPLES_MAX + 1]; /* s_mm[count]: all round */
	float spacing_mm;                  /* from one report of the pen to the next */
	float noise_mm2;                   /* variance of raw about the true line, an axis */
};

/* A stretch of the trace as a cubic in u = 0 .. 1 along it: x = sum x[k] u^k. */
struct run {
	int first, last; /* samples; last > first, both taken modulo trace.count */
	float length_mm;
	float cost_mm3;      /* squared distance, integrated along the run */
	float line_cost_mm3; /* the same for a straight run */
	float x[4], y[4];
};

struct runs {
	int count;
	struct run run[RUNS_MAX];
};

/* NULL, or why the stroke is no outline. Counter-clockwise afterwards. */
const char *trace_read(struct trace *trace, const struct v2 *stroke_mm, int count);

/* The same for a line that need not come back; it keeps its direction. */
const char *trace_read_open(struct trace *trace, const struct v2 *stroke_mm, int count);

void trace_reverse(struct trace *trace);

/* Distance along the trace from sample a to sample b (>= a), which may pass the end. */
float trace_distance_mm(const struct trace *trace, int a, int b);

/* A least-squares cubic for the samples first .. last. */
void run_fit(struct run *run, const struct trace *trace, int first, int last);
/* What dividing a run in two must win to be worth while. */
double run_price_mm3(const struct trace *trace);
struct v2 run_point(const struct run *run, float u);

/* The division into runs that explains the trace best for a fixed price a run. */
void runs_find(struct runs *runs, const struct trace *trace);
void runs_find_open(struct runs *runs, const struct trace *trace);

/* Adds the points of an open trace to an outline: from `start`, a corner, up to but without `end`.
 * False: there is no room. */
bool outline_add(struct piece *piece, const struct runs *runs, const struct trace *trace,
		 struct v2 start, struct v2 end);

/* Cuts off small loops. False: there is a large one, or nothing would be left; the piece is as it
 * was. */
bool outline_untangle(struct piece *piece);

#endif
