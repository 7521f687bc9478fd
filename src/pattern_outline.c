/* From runs to an outline: straight runs become lines that meet in corner points, the others Bezier
 * curves (least squares between fixed ends, after Schneider 1990). */
#include "pattern_cubic.h"
#include "pattern_private.h"

#define CORNER_COSINE 0.82f         /* 35 degrees: a smaller turn is a smooth joint */
#define LINES_CORNER_COSINE 0.9f    /* 26 degrees: the directions of lines are better known */
#define DOUBTFUL_CORNER_COSINE 0.9f /* 26 degrees, when tremor hides how smooth a joint is */
#define STRONG_TREMOR_MM2 25.0f
#define SMOOTH_EXCESS 1.6e-4f
#define STRAIGHT_SHARE 0.025f   /* bow of a straight run by its length */
#define CROSSING_SINE_MIN 0.35f /* flatter lines have no useful crossing */
#define CROSSING_SHARE 0.12f    /* of the shorter run: how far a crossing may lie from the ends */
#define CROSSING_MM 15.0f
#define CURVE_STEP_MM 8.0f

/* One run on its way to the outline. */
struct stretch {
	struct run run;
	bool straight;
	struct v2 through, along; /* the line through a straight run */
	bool corner;              /* at its start */
	struct v2 start;          /* joint point */
	struct v2 handle[2];      /* of a curve, relative to its ends */
};

struct path {
	bool closed;
	int count;
	struct stretch stretch[RUNS_MAX];
	struct v2 end; /* of an open path */
};

static struct v2 stretch_end(const struct path *path, int k)
{
	if (k + 1 < path->count)
		return path->stretch[k + 1].start;
	return path->closed ? path->stretch[0].start : path->end;
}

static struct stretch *stretch_before(struct path *path, int k)
{
	return &path->stretch[k > 0 ? k - 1 : path->count - 1];
}

static struct v2 raw_at(const struct trace *trace, int i)
{
	return trace->raw_mm[i >= trace->count ? i - trace->count : i];
}

/* The line of least squared distance through the inner nine tenths of a run: at its ends, samples
 * may belong to the neighbour. */
static void fit_line(struct stretch *stretch, const struct trace *trace)
{
	const struct run *run = &stretch->run;
	int margin = (run->last - run->first) / 20;
	int first = run->first + margin, last = run->last - margin;
	struct v2 origin = raw_at(trace, first), sum = {0};
	float count = (float)(last - first + 1);
	for (int i = first; i <= last; i++)
		sum = v2_add(sum, v2_sub(raw_at(trace, i), origin));
	struct v2 mean = v2_add(origin, v2_scale(sum, 1.0f / count));
	float xx = 0.0f, xy = 0.0f, yy = 0.0f;
	for (int i = first; i <= last; i++) {
		struct v2 d = v2_sub(raw_at(trace, i), mean);
		xx += d.x * d.x;
		xy += d.x * d.y;
		yy += d.y * d.y;
	}
	float larger = 0.5f * (xx + yy + sqrtf((xx - yy) * (xx - yy) + 4.0f * xy * xy));
	struct v2 along = xx >= yy ? (struct v2){larger - yy, xy} : (struct v2){xy, larger - xx};
	struct v2 chord = v2_sub(run_point(run, 1.0f), run_point(run, 0.0f));
	along = v2_normalize(along);
	stretch->along = v2_dot(along, chord) < 0.0f ? v2_scale(along, -1.0f) : along;
	stretch->through = mean;
}

/* How far a fitted cubic bends from its chord. */
static float bow_mm(const struct run *run)
{
	struct v2 a = run_point(run, 0.0f), b = run_point(run, 1.0f);
	struct v2 along = v2_normalize(v2_sub(b, a));
	float bow = 0.0f;
	for (int k = 1; k < 8; k++) {
		struct v2 p = v2_sub(run_point(run, 0.125f * (float)k), a);
		bow = float_max(bow, float_abs(v2_cross(along, p)));
	}
	return bow;
}

/* A run is straight when its bow is small for its length, or no more than tremor makes. */
static bool is_straight(const struct run *run, const struct trace *trace)
{
	float spacing = trace->s_mm[trace->count] / (float)trace->count;
	float tremor = sqrtf(8.0f * trace->noise_mm2 * spacing / float_max(run->length_mm, 1.0f));
	return bow_mm(run) < STRAIGHT_SHARE * run->length_mm + 1.5f * tremor + 1.0f;
}

/* The line that a stretch follows at one of its ends. */
static void end_line(const struct stretch *stretch, bool at_last, struct v2 *through,
		     struct v2 *along)
{
	if (stretch->straight) {
		*through = stretch->through;
		*along = stretch->along;
		return;
	}
	float end = at_last ? 1.0f : 0.0f, inner = at_last ? 0.8f : 0.2f;
	*through = run_point(&stretch->run, end);
	struct v2 d = v2_sub(run_point(&stretch->run, end), run_point(&stretch->run, inner));
	*along = v2_normalize(at_last ? d : v2_scale(d, -1.0f));
}

/* The point where two neighbours meet: where their lines cross, if that is near; else half-way
 * between their ends. */
static struct v2 joint_point(const struct stretch *before, const struct stretch *after,
			     float tremor_mm)
{
	struct v2 a = run_point(&before->run, 1.0f), b = run_point(&after->run, 0.0f);
	struct v2 middle = v2_lerp(a, b, 0.5f);
	struct v2 p, d, q, e;
	end_line(before, true, &p, &d);
	end_line(after, false, &q, &e);
	float sine = v2_cross(d, e);
	if (!after->corner || float_abs(sine) < CROSSING_SINE_MIN)
		return middle;
	struct v2 crossing = v2_add(p, v2_scale(d, v2_cross(v2_sub(q, p), e) / sine));
	float near_mm = float_max(CROSSING_MM, CROSSING_SHARE * float_min(before->run.length_mm,
									  after->run.length_mm));
	near_mm += 2.0f * tremor_mm;
	return v2_distance(crossing, middle) <= near_mm ? crossing : middle;
}

/* How far to look on each side of a joint to tell its angle to a tenth of a radian: a line through
 * w mm of samples has a slope error of sqrt(12 variance spacing / w^3). */
static float angle_reach_mm(const struct trace *trace)
{
	float length = trace->s_mm[trace->count];
	float cube = 1200.0f * trace->noise_mm2 * length / (float)trace->count;
	float reach = float_max(15.0f, float_max(length / 40.0f, 2.0f * trace->spacing_mm));
	for (int k = 0; k < 32 && reach * reach * reach < 2.0f * cube; k++)
		reach *= 1.1f;
	return reach;
}

/* A joint is a corner when the line turns there and a single cubic can't follow it. A right angle
 * with arms of w / 2 leaves 6.5e-4 w^3 of a cubic fit; a quarter of that decides. Where tremor
 * hides the difference, the corner is believed. */
static bool curves_meet_in_corner(const struct run *before, const struct run *after,
				  const struct trace *trace)
{
	int joint = after->first;
	int reach = int_min(before->last - before->first, after->last - after->first) * 3 / 5 + 2;
	float spacing = trace->s_mm[trace->count] / (float)trace->count;
	reach = int_min(reach, (int)(angle_reach_mm(trace) / spacing) + 3);
	int base = joint >= reach ? joint - reach : joint - reach + trace->count;
	struct run back, on, across;
	run_fit(&back, trace, base, base + reach);
	run_fit(&on, trace, joint, joint + reach);
	run_fit(&across, trace, base, base + 2 * reach);
	float width = across.length_mm;
	float excess = across.cost_mm3 - back.cost_mm3 - on.cost_mm3;
	float enough = SMOOTH_EXCESS * width * width * width;
	bool decisive = enough > 12.0f * trace->noise_mm2 * spacing;
	if (decisive && excess < enough)
		return false;
	struct v2 in = v2_sub(run_point(&back, 1.0f), run_point(&back, 0.4f));
	struct v2 out = v2_sub(run_point(&on, 0.6f), run_point(&on, 0.0f));
	return v2_dot(v2_normalize(in), v2_normalize(out)) <
	       (decisive || trace->noise_mm2 < STRONG_TREMOR_MM2 ? CORNER_COSINE
								 : DOUBTFUL_CORNER_COSINE);
}

static bool is_corner(const struct stretch *before, const struct stretch *after,
		      const struct trace *trace)
{
	if (before->straight && after->straight)
		return v2_dot(before->along, after->along) < LINES_CORNER_COSINE;
	return curves_meet_in_corner(&before->run, &after->run, trace);
}

/* The joints are its ends. */
static void fit_curve(struct stretch *stretch, struct v2 end, const struct trace *trace)
{
	const struct run *run = &stretch->run;
	struct cubic_fit fit;
	cubic_fit_begin(&fit, stretch->start, end);
	for (int i = run->first; i <= run->last; i++) {
		float along_mm = trace_distance_mm(trace, run->first, i);
		cubic_fit_add(&fit, along_mm / run->length_mm, raw_at(trace, i));
	}
	cubic_fit_end(&fit, stretch->handle);
}

/* At a smooth joint both handles lie on one line. */
static void align_handles(struct stretch *before, struct stretch *after)
{
	struct v2 in = before->straight ? v2_scale(before->along, -1.0f) : before->handle[1];
	struct v2 out = after->straight ? after->along : after->handle[0];
	struct v2 along = v2_normalize(v2_sub(out, in));
	if (before->straight && !after->straight)
		along = before->along;
	if (after->straight && !before->straight)
		along = after->along;
	before->handle[1] = v2_scale(along, v2_dot(in, along));
	after->handle[0] = v2_scale(along, v2_dot(out, along));
}

/* Adds the points of stretch k, its end left to the next. False: there is no room. */
static bool draw_stretch(struct piece *piece, const struct path *path, int k, float step_mm)
{
	const struct stretch *stretch = &path->stretch[k];
	int steps = stretch->straight ? 1 : 3 + (int)(stretch->run.length_mm / step_mm);
	if (piece->point_count + steps > OUTLINE_POINTS_MAX)
		return false;
	struct v2 end = stretch_end(path, k);
	for (int i = 0; i < steps; i++) {
		float u = (float)i / (float)steps;
		piece->point_mm[piece->point_count] = cubic_at(stretch->start, end, stretch->handle,
							       u);
		piece->corner[piece->point_count] = i == 0 && stretch->corner;
		piece->point_count++;
	}
	return true;
}

/* A round piece has no corners, but edges are what gets sewn: its four extremes serve. */
static void corners_at_extremes(struct piece *piece)
{
	int extreme[4] = {0};
	for (int i = 1; i < piece->point_count; i++) {
		struct v2 p = piece->point_mm[i];
		if (p.y < piece->point_mm[extreme[0]].y)
			extreme[0] = i;
		if (p.x > piece->point_mm[extreme[1]].x)
			extreme[1] = i;
		if (p.y > piece->point_mm[extreme[2]].y)
			extreme[2] = i;
		if (p.x < piece->point_mm[extreme[3]].x)
			extreme[3] = i;
	}
	for (int k = 0; k < 4; k++)
		piece->corner[extreme[k]] = true;
}

/* From the first point to the one farthest from it. */
static float outline_reach(const struct piece *piece)
{
	float reach = 0.0f;
	for (int i = 1; i < piece->point_count; i++)
		reach = float_max(reach, v2_distance(piece->point_mm[i], piece->point_mm[0]));
	return reach;
}

/* Turns the list so that it begins at a corner, and measures from the centroid. */
static void settle_outline(struct piece *piece)
{
	struct piece turned = *piece;
	int start = 0, count = piece->point_count;
	while (start < count - 1 && !piece->corner[start])
		start++;
	struct v2 origin = piece->point_mm[0], sum = {0};
	float area = 0.0f;
	for (int i = 1; i + 1 < count; i++) {
		struct v2 a = v2_sub(piece->point_mm[i], origin);
		struct v2 b = v2_sub(piece->point_mm[i + 1], origin);
		sum = v2_add(sum, v2_scale(v2_add(a, b), v2_cross(a, b) / 3.0f));
		area += v2_cross(a, b);
	}
	struct v2 centroid = origin;
	/* That of a line that crosses itself may lie anywhere. */
	if (area > 100.0f && v2_length(sum) < area * outline_reach(piece))
		centroid = v2_add(origin, v2_scale(sum, 1.0f / area));
	for (int i = 0; i < count; i++) {
		int at = (start + i) % count;
		turned.point_mm[i] = v2_sub(piece->point_mm[at], centroid);
		turned.corner[i] = piece->corner[at];
	}
	turned.position_mm = v2_add(piece->position_mm, centroid);
	*piece = turned;
}

/* Lines, corners, joints and curves of all runs. */
static void path_make(struct path *path, const struct runs *runs, const struct trace *trace)
{
	int inner = path->closed ? 0 : 1; /* joint 0 of an open path is given */
	path->count = runs->count;
	for (int k = 0; k < path->count; k++) {
		struct stretch *at = &path->stretch[k];
		at->run = runs->run[k];
		at->straight = is_straight(&at->run, trace);
		fit_line(at, trace);
	}
	for (int k = inner; k < path->count; k++)
		path->stretch[k].corner = is_corner(stretch_before(path, k), &path->stretch[k],
						    trace);
	for (int k = inner; k < path->count; k++)
		path->stretch[k].start = joint_point(stretch_before(path, k), &path->stretch[k],
						     sqrtf(trace->noise_mm2));
	for (int k = 0; k < path->count; k++)
		fit_curve(&path->stretch[k], stretch_end(path, k), trace);
	for (int k = inner; k < path->count; k++)
		if (!path->stretch[k].corner)
			align_handles(stretch_before(path, k), &path->stretch[k]);
}

static bool path_draw(struct piece *piece, const struct path *path, const struct trace *trace)
{
	float step = float_max(CURVE_STEP_MM, trace->s_mm[trace->count] / 240.0f);
	for (int k = 0; k < path->count; k++)
		if (!draw_stretch(piece, path, k, step))
			return false;
	return true;
}

bool outline_add(struct piece *piece, const struct runs *runs, const struct trace *trace,
		 struct v2 start, struct v2 end)
{
	struct path path = {.closed = false, .end = end};
	path.stretch[0].start = start;
	path.stretch[0].corner = true;
	path_make(&path, runs, trace);
	return path_draw(piece, &path, trace);
}

const char *piece_from_stroke(struct piece *piece, const struct v2 *stroke_mm, int count)
{
	struct trace trace;
	struct runs runs;
	struct path path = {.closed = true};
	struct piece made = *piece;
	const char *fault = trace_read(&trace, stroke_mm, count);
	if (fault)
		return fault;
	runs_find(&runs, &trace);
	path_make(&path, &runs, &trace);
	made.point_count = 0;
	made.inside_up = false;
	made.turn_rad = 0.0f;
	made.position_mm = (struct v2){0.0f, 0.0f};
	if (!path_draw(&made, &path, &trace))
		return "the outline is too intricate: draw it simpler";
	if (piece_edge_count(&made) == 0)
		corners_at_extremes(&made);
	settle_outline(&made);
	fault = piece_fault(&made);
	if (fault && outline_untangle(&made)) {
		settle_outline(&made);
		fault = piece_fault(&made);
	}
	if (!fault)
		*piece = made;
	return fault;
}
