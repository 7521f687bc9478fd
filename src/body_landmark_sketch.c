/* From a drawn line to a landmark: even points on the surface, and stops. */
#include "body_landmark_private.h"

void sketch_begin(struct landmark_scratch *s)
{
	s->sketch.count = 0;
	s->sketch.stop_count = 0;
}

void sketch_add(struct landmark_scratch *s, struct v3 point_m)
{
	MUST(s->sketch.count < COUNT_OF(s->sketch.point_m));
	s->sketch.point_m[s->sketch.count++] = point_m;
}

void sketch_stop(struct landmark_scratch *s)
{
	MUST(s->sketch.stop_count < LANDMARK_STOPS_MAX && s->sketch.count > 0);
	s->sketch.stop[s->sketch.stop_count++] = s->sketch.count - 1;
}

void sketch_section(struct landmark_scratch *s, int from, int to)
{
	int step = from <= to ? 1 : -1;
	if (s->sketch.count == 0) {
		sketch_add(s, s->section.point_m[from]);
		sketch_stop(s);
		from = from == to ? from : from + step;
	}
	for (int i = from; i != to + step; i += step)
		sketch_add(s, s->section.point_m[i]);
	sketch_stop(s);
}

static void put(const struct body *body, struct landmark_line *line, struct v3 point_m)
{
	struct body_hit hit;
	body_nearest(body, point_m, 0, &hit);
	line->point_m[line->count] = hit.point_m;
	line->normal[line->count++] = hit.normal;
}

void sketch_keep(struct landmark_scratch *s, enum landmark landmark)
{
	const struct sketch *sketch = &s->sketch;
	struct landmark_line *line = &s->body->landmark[landmark];
	float whole_m = 0.0f, along_m = 0.0f;
	memset(line, 0, sizeof *line);
	for (int i = 1; i < sketch->count; i++)
		whole_m += v3_distance(sketch->point_m[i - 1], sketch->point_m[i]);
	if (sketch->count < 2 || !(whole_m > 0.001f))
		return;
	float step_m = whole_m / (float)(MARK_POINTS_MAX - 1);
	for (int i = 0; i + 1 < sketch->count; i++) {
		struct v3 a = sketch->point_m[i], b = sketch->point_m[i + 1];
		float length_m = v3_distance(a, b);
		for (int k = 0; k < sketch->stop_count; k++)
			if (sketch->stop[k] == i)
				line->stop_m[k] = along_m;
		while (line->count < MARK_POINTS_MAX - 1 && length_m > 0.0f &&
		       (float)line->count * step_m <= along_m + length_m)
			put(s->body, line,
			    v3_lerp(a, b, ((float)line->count * step_m - along_m) / length_m));
		along_m += length_m;
	}
	put(s->body, line, sketch->point_m[sketch->count - 1]);
	line->stop_count = sketch->stop_count;
	line->stop_m[sketch->stop_count - 1] = along_m;
}

void sketch_keep_round(struct landmark_scratch *s, enum landmark landmark,
		       const struct frame *frame)
{
	sketch_begin(s);
	sketch_section(s, 0, s->section.count - 1);
	sketch_add(s, s->section.point_m[0]);
	s->sketch.stop[1] = s->sketch.count - 1;
	sketch_keep(s, landmark);
	s->body->landmark[landmark].closed = true;
	s->body->landmark[landmark].girth_m = section_girth(s, frame);
}
