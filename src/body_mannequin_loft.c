#include "mannequin_loft.h"

enum {
	RING_SAMPLES = 96, /* of a ring's length; 6 mm on the widest */
	COLUMN_COSINE = 6,
	COLUMN_SINE = COLUMN_COSINE + SECTION_ORDER + 1,
};

#define UNIT 1e-4f /* metres and radians in a table's unit */

static struct v3 section_direction(const short *section, float cosine, float sine)
{
	float pitch = UNIT * section[3], roll = UNIT * section[4], cone = UNIT * section[5];
	float cp = angle_cos(pitch), sp = angle_sin(pitch);
	float cr = angle_cos(roll), sr = angle_sin(roll);
	float cc = angle_cos(cone), sc = angle_sin(cone);
	struct v3 front = {-sr * sp, cr * sp, cp}, left = {cr, sr, 0.0f};
	struct v3 axis = {-sr * cp, cr * cp, -sp};
	return v3_mad(v3_mad(v3_scale(front, cc * cosine), left, cc * sine), axis, sc);
}

static struct v3 section_point(const short *section, float angle_rad)
{
	float c1 = angle_cos(angle_rad), s1 = angle_sin(angle_rad), cm = 1.0f, sm = 0.0f;
	float radius = section[COLUMN_COSINE];
	struct v3 origin = {UNIT * section[0], UNIT * section[1], UNIT * section[2]};
	for (int m = 1; m <= SECTION_ORDER; m++) {
		float next = cm * c1 - sm * s1;
		sm = sm * c1 + cm * s1;
		cm = next;
		radius += section[COLUMN_COSINE + m] * cm + section[COLUMN_SINE + m - 1] * sm;
	}
	return v3_mad(origin, section_direction(section, c1, s1), UNIT * radius);
}

void loft_init(struct loft *loft, const short (*section)[SECTION_COLUMNS], int count, bool half)
{
	MUST(count >= 1 && count <= LOFT_ROWS_MAX);
	*loft = (struct loft){section, count, half, {0}};
	for (int i = 1; i < count; i++) {
		float sum = 0.0f;
		for (int k = 0; k < 16; k++) {
			float angle = PI_F * (half ? 1.0f : 2.0f) * ((float)k + 0.5f) / 16.0f;
			sum += v3_distance(section_point(section[i], angle),
					   section_point(section[i - 1], angle));
		}
		loft->start_m[i] = loft->start_m[i - 1] + sum / 16.0f;
	}
}

float loft_length(const struct loft *loft)
{
	return loft->start_m[loft->count - 1];
}

/* Cubic Hermite with the slopes of the neighbouring chords (Catmull and Rom 1974, uneven). */
struct v3 loft_point(const struct loft *loft, float along_m, float angle_rad)
{
	int last = loft->count - 1, i = 0;
	if (last == 0)
		return section_point(loft->section[0], angle_rad);
	while (i < last - 1 && loft->start_m[i + 1] <= along_m)
		i++;
	int before = int_max(i - 1, 0), after = int_min(i + 2, last);
	float h = loft->start_m[i + 1] - loft->start_m[i];
	float s = float_clamp((along_m - loft->start_m[i]) / h, 0.0f, 1.0f), r = 1.0f - s;
	struct v3 a = section_point(loft->section[i], angle_rad);
	struct v3 b = section_point(loft->section[i + 1], angle_rad);
	struct v3 a0 = before < i ? section_point(loft->section[before], angle_rad) : a;
	struct v3 b1 = after > i + 1 ? section_point(loft->section[after], angle_rad) : b;
	float ha = h / (loft->start_m[i + 1] - loft->start_m[before]);
	float hb = h / (loft->start_m[after] - loft->start_m[i]);
	struct v3 slope_a = v3_scale(v3_sub(b, a0), ha), slope_b = v3_scale(v3_sub(b1, a), hb);
	struct v3 p = v3_scale(a, (1.0f + 2.0f * s) * r * r);
	p = v3_mad(p, slope_a, s * r * r);
	p = v3_mad(p, b, s * s * (3.0f - 2.0f * s));
	return v3_mad(p, slope_b, -s * s * r);
}

int sheet_add(struct sheet *sheet, struct v3 position_m)
{
	MUST(sheet->vertex_count < sheet->vertices_max);
	sheet->position_m[sheet->vertex_count] = position_m;
	return sheet->vertex_count++;
}

static void sheet_add_triangle(struct sheet *sheet, int a, int b, int c)
{
	MUST(sheet->triangle_count < sheet->triangles_max);
	sheet->triangle[sheet->triangle_count++] = (struct triangle){{a, b, c}};
}

/* A line through points, to be divided by length. */
struct line {
	struct v3 point[RING_SAMPLES + 3];
	float length[RING_SAMPLES + 3]; /* up to each point */
	int count;
};

static void line_add(struct line *line, struct v3 point)
{
	int n = line->count++;
	line->point[n] = point;
	line->length[n] = n ? line->length[n - 1] + v3_distance(point, line->point[n - 1]) : 0.0f;
}

static struct v3 line_at(const struct line *line, float length)
{
	int i = 0;
	while (i < line->count - 2 && line->length[i + 1] < length)
		i++;
	float step = line->length[i + 1] - line->length[i];
	float t = step > 0.0f ? (length - line->length[i]) / step : 0.0f;
	return v3_lerp(line->point[i], line->point[i + 1], float_clamp(t, 0.0f, 1.0f));
}

static int line_parts(const struct line *line, float spacing_m, int least)
{
	float parts = line->length[line->count - 1] / spacing_m + 0.5f;
	return int_clamp((int)parts, least, RING_VERTICES_MAX - 1);
}

void ring_lay(struct sheet *sheet, const struct loft *loft, float along_m, float spacing_m,
	      float phase, struct ring *ring)
{
	struct line line = {.count = 0};
	float turn = PI_F * (loft->half ? 1.0f : 2.0f) / RING_SAMPLES;
	for (int i = 0; i <= RING_SAMPLES; i++)
		line_add(&line, loft_point(loft, along_m, turn * (float)i));
	int parts = line_parts(&line, spacing_m, loft->half ? 3 : 6);
	float step = line.length[RING_SAMPLES] / (float)parts;
	ring->closed = !loft->half;
	ring->count = ring->closed ? parts : parts + 1;
	for (int i = 0; i < ring->count; i++) {
		struct v3 p = line_at(&line, step * ((float)i + (ring->closed ? phase : 0.0f)));
		if (!ring->closed && (i == 0 || i == parts))
			p.x = 0.0f;
		ring->vertex[i] = sheet_add(sheet, p);
	}
}

void ring_lay_arc(struct sheet *sheet, const struct loft *loft, float along_m, const float angle[2],
		  const int end[2], float spacing_m, struct ring *ring)
{
	struct line line = {.count = 0};
	line_add(&line, sheet->position_m[end[0]]);
	for (int i = 0; i <= RING_SAMPLES; i++) {
		float t = (float)i / RING_SAMPLES;
		line_add(&line, loft_point(loft, along_m, angle[0] + (angle[1] - angle[0]) * t));
	}
	line_add(&line, sheet->position_m[end[1]]);
	int parts = line_parts(&line, spacing_m, 2);
	float step = line.length[line.count - 1] / (float)parts;
	*ring = (struct ring){.count = parts + 1};
	for (int i = 1; i < parts; i++)
		ring->vertex[i] = sheet_add(sheet, line_at(&line, step * (float)i));
	ring->vertex[0] = end[0];
	ring->vertex[parts] = end[1];
}

static struct v3 ring_point(const struct sheet *sheet, const struct ring *ring, int i)
{
	return sheet->position_m[ring->vertex[i % ring->count]];
}

/* Walks both rings at once and takes the shorter diagonal each time. */
void ring_stitch(struct sheet *sheet, const struct ring *lower, const struct ring *upper)
{
	MUST(lower->closed == upper->closed);
	int steps_lower = lower->closed ? lower->count : lower->count - 1;
	int steps_upper = upper->closed ? upper->count : upper->count - 1;
	int first = 0, i = 0, j = 0;
	for (int k = 1; lower->closed && k < upper->count; k++) {
		struct v3 from = ring_point(sheet, lower, 0);
		if (v3_distance(ring_point(sheet, upper, k), from) <
		    v3_distance(ring_point(sheet, upper, first), from))
			first = k;
	}
	while (i < steps_lower || j < steps_upper) {
		int a = lower->vertex[i % lower->count], a1 = lower->vertex[(i + 1) % lower->count];
		int b = upper->vertex[(first + j) % upper->count];
		int b1 = upper->vertex[(first + j + 1) % upper->count];
		const struct v3 *p = sheet->position_m;
		bool advance_lower = j == steps_upper;
		if (i < steps_lower && j < steps_upper)
			advance_lower = v3_distance(p[a1], p[b]) < v3_distance(p[a], p[b1]);
		if (advance_lower) {
			sheet_add_triangle(sheet, a, a1, b);
			i++;
		} else {
			sheet_add_triangle(sheet, a, b1, b);
			j++;
		}
	}
}

void ring_close(struct sheet *sheet, const struct ring *ring, int tip, bool beyond)
{
	int steps = ring->closed ? ring->count : ring->count - 1;
	for (int i = 0; i < steps; i++) {
		int a = ring->vertex[i], b = ring->vertex[(i + 1) % ring->count];
		sheet_add_triangle(sheet, beyond ? a : b, beyond ? b : a, tip);
	}
}
