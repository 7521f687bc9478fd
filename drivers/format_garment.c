#include "format_garment.h"

#include <jansson.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

enum {
	FAULT_BYTES = 200,
	FILE_POINTS_MAX = 20000, /* an outline before it is thinned */
	SHEET_WIDTH_MM = 2000,   /* pieces are laid out in rows of about this */
	SHEET_GAP_MM = 40,
};

#define THIN_MM 0.2f
#define SAME_MM 0.002f      /* points closer than this are one */
#define CORNER_COSINE 0.94f /* 20 degrees */
#define COORDINATE_MM 10000.0

/* One instance while it is read: every point of the file, before any is dropped. */
struct raw_piece {
	int count;
	struct v2 *point;
	int *edge_end; /* > 0: seams begin or end here */
	int *covered;  /* > 0: inside a seam */
	int *kept;     /* index in the piece, -1 dropped */
};

struct raw_run {
	int piece, first, last; /* counter-clockwise */
	int dir;
};

struct reader {
	struct pattern *pattern;
	json_t *instances;
	int piece_count;
	struct raw_piece raw[PIECES_MAX];
	int seam_count;
	struct raw_run side[SEAMS_MAX][2];
	char *fault;
};

__attribute__((format(printf, 2, 3))) static bool fail(struct reader *reader, const char *format,
						       ...)
{
	va_list arguments;
	va_start(arguments, format);
	vsnprintf(reader->fault, FAULT_BYTES, format, arguments);
	va_end(arguments);
	return false;
}

static bool read_point(struct reader *reader, int piece, int i, const json_t *pair)
{
	const char *id = reader->pattern->piece[piece].name;
	const json_t *x = json_array_get(pair, 0), *y = json_array_get(pair, 1);
	if (json_array_size(pair) != 2 || !json_is_number(x) || !json_is_number(y))
		return fail(reader, "instance \"%s\", outline[%d]: not a point; write [x, y] in mm",
			    id, i);
	double x_mm = json_number_value(x), y_mm = json_number_value(y);
	if (!(x_mm >= -COORDINATE_MM && x_mm <= COORDINATE_MM && y_mm >= -COORDINATE_MM &&
	      y_mm <= COORDINATE_MM))
		return fail(
			reader,
			"instance \"%s\", outline[%d]: farther than 10 m from the origin; are the "
			"units mm?",
			id, i);
	reader->raw[piece].point[i] = (struct v2){(float)x_mm, 0.0f - (float)y_mm};
	return true;
}

/* Copies an id, cut at a whole character (UTF-8) when it is too long. */
static void copy_name(char name[NAME_BYTES_MAX], const char *id)
{
	size_t length = strlen(id);
	if (length >= NAME_BYTES_MAX) {
		length = NAME_BYTES_MAX - 1;
		while (length > 0 && ((unsigned char)id[length] & 0xc0u) == 0x80u)
			length--;
	}
	memcpy(name, id, length);
	memset(name + length, 0, NAME_BYTES_MAX - length);
}

static int find_instance(const struct reader *reader, const char *id)
{
	for (int p = 0; p < reader->piece_count; p++) {
		const json_t *other = json_object_get(json_array_get(reader->instances, (size_t)p),
						      "id");
		if (strcmp(json_string_value(other), id) == 0)
			return p;
	}
	return -1;
}

static bool read_instance(struct reader *reader, int p)
{
	const json_t *instance = json_array_get(reader->instances, (size_t)p);
	const json_t *id = json_object_get(instance, "id");
	const json_t *outline = json_object_get(instance, "outline");
	if (!json_is_string(id) || json_string_length(id) == 0)
		return fail(reader, "instances[%d]: has no \"id\"; give it a name", p);
	if (find_instance(reader, json_string_value(id)) >= 0)
		return fail(reader, "instances[%d]: the id \"%.60s\" is taken; rename one", p,
			    json_string_value(id));
	struct piece *piece = &reader->pattern->piece[p];
	*piece = (struct piece){.used = true, .layer = p};
	copy_name(piece->name, json_string_value(id));
	size_t count = json_array_size(outline);
	if (count < 3 || count > FILE_POINTS_MAX)
		return fail(reader, "instance \"%s\": \"outline\" must be a list of 3 to %d points",
			    piece->name, FILE_POINTS_MAX);
	struct raw_piece *raw = &reader->raw[p];
	raw->count = (int)count;
	raw->point = calloc(count, sizeof *raw->point);
	raw->edge_end = calloc(count, sizeof *raw->edge_end);
	raw->covered = calloc(count, sizeof *raw->covered);
	raw->kept = calloc(count, sizeof *raw->kept);
	reader->piece_count++;
	if (!raw->point || !raw->edge_end || !raw->covered || !raw->kept)
		return fail(reader, "instance \"%s\": out of memory", piece->name);
	for (int i = 0; i < raw->count; i++)
		if (!read_point(reader, p, i, json_array_get(outline, (size_t)i)))
			return false;
	return true;
}

static bool read_side(struct reader *reader, const char *seam, const char *name, const json_t *side,
		      struct raw_run *run)
{
	const json_t *instance = json_object_get(side, "instance");
	const json_t *start = json_object_get(side, "start"), *end = json_object_get(side, "end");
	const json_t *dir = json_object_get(side, "dir");
	if (!json_is_string(instance) || !json_is_integer(start) || !json_is_integer(end) ||
	    !json_is_integer(dir))
		return fail(reader, "seam \"%.40s\", side %s: needs instance, start, end and dir",
			    seam, name);
	run->piece = find_instance(reader, json_string_value(instance));
	if (run->piece < 0)
		return fail(reader, "seam \"%.40s\", side %s: there is no instance \"%.40s\"", seam,
			    name, json_string_value(instance));
	json_int_t count = reader->raw[run->piece].count, direction = json_integer_value(dir);
	json_int_t from = json_integer_value(start), to = json_integer_value(end);
	if (from < 0 || from >= count || to < 0 || to >= count || from == to)
		return fail(reader,
			    "seam \"%.40s\", side %s: start and end must be two of the outline's "
			    "points "
			    "0 to %d",
			    seam, name, (int)count - 1);
	if (direction != 1 && direction != -1)
		return fail(reader, "seam \"%.40s\", side %s: dir must be 1 or -1", seam, name);
	run->dir = (int)direction;
	run->first = (int)(direction > 0 ? from : to);
	run->last = (int)(direction > 0 ? to : from);
	return true;
}

/* Notes a run's ends, and that its inside is taken. */
static bool cover(struct reader *reader, const char *seam, const struct raw_run *run)
{
	struct raw_piece *raw = &reader->raw[run->piece];
	raw->edge_end[run->first]++;
	raw->edge_end[run->last]++;
	for (int i = run->first; i != run->last; i = (i + 1) % raw->count) {
		if (i != run->first && raw->covered[i])
			return fail(reader,
				    "seam \"%.40s\": its edge of \"%s\" is part of another seam",
				    seam, reader->pattern->piece[run->piece].name);
		if (i != run->first)
			raw->covered[i]++;
	}
	return true;
}

static bool read_seam(struct reader *reader, int index, const json_t *seam)
{
	char id[48];
	const json_t *name = json_object_get(seam, "id"), *kind = json_object_get(seam, "kind");
	if (json_is_string(name))
		snprintf(id, sizeof id, "%s", json_string_value(name));
	else
		snprintf(id, sizeof id, "%d", index);
	if (json_is_string(kind) && strcmp(json_string_value(kind), "closure") == 0)
		return true;
	if (reader->seam_count == SEAMS_MAX)
		return fail(reader, "seam \"%.40s\": more than %d seams; leave some out", id,
			    SEAMS_MAX);
	struct raw_run *side = reader->side[reader->seam_count++];
	return read_side(reader, id, "a", json_object_get(seam, "a"), &side[0]) &&
	       read_side(reader, id, "b", json_object_get(seam, "b"), &side[1]) &&
	       cover(reader, id, &side[0]) && cover(reader, id, &side[1]);
}

static float turn_cosine(struct v2 before, struct v2 at, struct v2 after)
{
	return v2_dot(v2_normalize(v2_sub(at, before)), v2_normalize(v2_sub(after, at)));
}

static float distance_to_segment(struct v2 a, struct v2 b, struct v2 p)
{
	struct v2 d = v2_sub(b, a);
	float squared = v2_dot(d, d);
	float t = squared > 0.0f ? float_clamp(v2_dot(v2_sub(p, a), d) / squared, 0.0f, 1.0f)
				 : 0.0f;
	return v2_distance(p, v2_lerp(a, b, t));
}

/* Which points are corners: into edge_end as well. */
static void find_corners(struct raw_piece *raw)
{
	int corners = 0;
	for (int i = 0; i < raw->count; i++) {
		struct v2 before = raw->point[(i + raw->count - 1) % raw->count];
		struct v2 after = raw->point[(i + 1) % raw->count];
		bool turns = turn_cosine(before, raw->point[i], after) < CORNER_COSINE;
		if (turns && !raw->covered[i])
			raw->edge_end[i]++;
		corners += raw->edge_end[i] > 0;
	}
	if (corners == 0)
		raw->edge_end[0]++;
}

/* May the points between two kept ones go? */
static bool spans(const struct raw_piece *raw, int from, int to, float tolerance)
{
	for (int i = from + 1; i < to; i++)
		if (raw->edge_end[i % raw->count] ||
		    distance_to_segment(raw->point[from % raw->count], raw->point[to % raw->count],
					raw->point[i % raw->count]) > tolerance)
			return false;
	return true;
}

/* Drops points that say nothing, beginning at a corner. `tolerance` 0 drops doubles only. */
static int thin(struct raw_piece *raw, float tolerance)
{
	int start = 0, count = 0;
	while (start < raw->count - 1 && !raw->edge_end[start])
		start++;
	for (int i = 0; i < raw->count; i++)
		raw->kept[i] = -1;
	for (int i = start; i < start + raw->count;) {
		raw->kept[i % raw->count] = count++;
		int next = i + 1, limit = int_min(i + 64, start + raw->count);
		for (int k = i + 2; k <= limit && spans(raw, i, k, tolerance); k++)
			next = k;
		i = next;
	}
	return count;
}

/* The piece's outline: in the file's order, doubles dropped, thinned when it must be. */
static bool make_outline(struct reader *reader, int p)
{
	struct raw_piece *raw = &reader->raw[p];
	struct piece *piece = &reader->pattern->piece[p];
	find_corners(raw);
	int count = thin(raw, SAME_MM);
	if (count > OUTLINE_POINTS_MAX)
		count = thin(raw, THIN_MM);
	if (count > OUTLINE_POINTS_MAX)
		return fail(
			reader,
			"instance \"%s\": its outline needs %d points, %d are allowed; simplify it",
			piece->name, count, OUTLINE_POINTS_MAX);
	piece->point_count = count;
	for (int i = 0; i < raw->count; i++) {
		if (raw->kept[i] < 0)
			continue;
		piece->point_mm[raw->kept[i]] = raw->point[i];
		piece->corner[raw->kept[i]] = raw->edge_end[i] > 0;
	}
	const char *reason = piece_fault(piece);
	return reason ? fail(reader, "instance \"%s\": %s", piece->name, reason) : true;
}

/* The edge that starts at a raw point; -1 when the run is more than one edge. */
static int edge_of_run(const struct reader *reader, const struct raw_run *run)
{
	const struct raw_piece *raw = &reader->raw[run->piece];
	const struct piece *piece = &reader->pattern->piece[run->piece];
	int edge = -1, first, last;
	for (int i = 0; i <= raw->kept[run->first]; i++)
		edge += piece->corner[i];
	piece_edge(piece, edge, &first, &last);
	return first == raw->kept[run->first] && last == raw->kept[run->last] ? edge : -1;
}

static bool make_seams(struct reader *reader)
{
	for (int s = 0; s < reader->seam_count; s++) {
		const struct raw_run *a = &reader->side[s][0], *b = &reader->side[s][1];
		int edge_a = edge_of_run(reader, a), edge_b = edge_of_run(reader, b);
		if (edge_a < 0 || edge_b < 0)
			return fail(reader,
				    "seam %d: another seam ends inside its edge; split it there",
				    s);
		/* Walked both counter-clockwise, edges of one surface meet start to end. */
		reader->pattern->seam[s] = (struct seam){.used = true,
							 .swapped = a->dir == b->dir,
							 .a = {a->piece, edge_a},
							 .b = {b->piece, edge_b}};
	}
	return true;
}

/* Rows of pieces, side by side, about the middle of the sheet's upper edge. */
static void lay_out(struct reader *reader)
{
	float x = 0.0f, y = 0.0f, row_height = 0.0f;
	for (int p = 0; p < reader->piece_count; p++) {
		struct piece *piece = &reader->pattern->piece[p];
		struct v2 low = piece->point_mm[0], high = low;
		for (int i = 1; i < piece->point_count; i++) {
			low.x = float_min(low.x, piece->point_mm[i].x);
			low.y = float_min(low.y, piece->point_mm[i].y);
			high.x = float_max(high.x, piece->point_mm[i].x);
			high.y = float_max(high.y, piece->point_mm[i].y);
		}
		if (x > 0.0f && x + high.x - low.x > (float)SHEET_WIDTH_MM) {
			x = 0.0f;
			y -= row_height + (float)SHEET_GAP_MM;
			row_height = 0.0f;
		}
		piece->position_mm = (struct v2){x - low.x, y - high.y};
		x += high.x - low.x + (float)SHEET_GAP_MM;
		row_height = float_max(row_height, high.y - low.y);
	}
}

static bool read_root(struct reader *reader, const json_t *root)
{
	const json_t *format = json_object_get(root, "format");
	const json_t *units = json_object_get(root, "units");
	const json_t *seams = json_object_get(root, "seams");
	reader->instances = json_object_get(root, "instances");
	if (!json_is_string(format) || strcmp(json_string_value(format), "garment-seams/1") != 0)
		return fail(reader,
			    "\"format\" is not \"garment-seams/1\"; is this a garment file?");
	if (!json_is_string(units) || strcmp(json_string_value(units), "mm") != 0)
		return fail(reader, "\"units\" is not \"mm\"; convert the file");
	size_t count = json_array_size(reader->instances);
	if (count < 1 || count > PIECES_MAX)
		return fail(reader, "\"instances\" must be a list of 1 to %d pieces", PIECES_MAX);
	if (seams && !json_is_array(seams))
		return fail(reader, "\"seams\" must be a list");
	for (int p = 0; p < (int)count; p++)
		if (!read_instance(reader, p))
			return false;
	for (size_t s = 0; s < json_array_size(seams); s++)
		if (!read_seam(reader, (int)s, json_array_get(seams, s)))
			return false;
	for (int p = 0; p < reader->piece_count; p++)
		if (!make_outline(reader, p))
			return false;
	lay_out(reader);
	return make_seams(reader);
}

bool format_garment_read(struct pattern *pattern, const char *text, size_t size, char fault[200])
{
	struct reader reader = {.pattern = pattern, .fault = fault};
	memset(pattern, 0, sizeof *pattern);
	fault[0] = '\0';
	json_error_t error;
	json_t *root = json_loadb(text, size, JSON_REJECT_DUPLICATES, &error);
	if (!root)
		return fail(&reader, "line %d, column %d: %.100s; this is not JSON", error.line,
			    error.column, error.text);
	bool read = read_root(&reader, root);
	for (int p = 0; p < PIECES_MAX; p++) {
		free(reader.raw[p].point);
		free(reader.raw[p].edge_end);
		free(reader.raw[p].covered);
		free(reader.raw[p].kept);
	}
	json_decref(root);
	if (!read)
		memset(pattern, 0, sizeof *pattern);
	return read;
}
