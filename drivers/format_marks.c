#include "format_marks.h"

#include "journal.h"

#include <jansson.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

enum {
	FAULT_BYTES = 200,
	LINE_BYTES_MAX = 1000,
	WORDS_MAX = 64,
	WAY_POINTS_MAX = 4 * OUTLINE_POINTS_MAX, /* a line before its points are spread evenly */
};

#define POINT_STEP_MM 15.0f
#define STOP_MAX 9.0f
#define COORDINATE_MM 10000.0f
#define RIM_MM 1.0f /* the other rim lies farther */

/* ---- places ---- */

static void copy_name(char name[NAME_BYTES_MAX], const char *from)
{
	memset(name, 0, NAME_BYTES_MAX);
	memcpy(name, from, (size_t)int_min((int)strlen(from), NAME_BYTES_MAX - 1));
}

static void read_names(struct garment_places *places, int piece, const json_t *instance)
{
	json_t *outline = json_object_get(instance, "outline"), *list;
	const char *index;
	json_object_foreach(json_object_get(instance, "named_vertices"), index, list)
	{
		char *end;
		const json_t *pair = json_array_get(outline, (size_t)strtoul(index, &end, 10));
		const json_t *x = json_array_get(pair, 0), *y = json_array_get(pair, 1);
		if (end == index || *end || !json_is_number(x) || !json_is_number(y))
			continue;
		for (size_t i = 0; i < json_array_size(list); i++) {
			const char *name = json_string_value(json_array_get(list, i));
			if (!name || !*name || places->count == PLACES_MAX)
				continue;
			struct garment_place *place = &places->place[places->count++];
			place->piece = piece;
			copy_name(place->name, name);
			place->point_mm = (struct v2){(float)json_number_value(x),
						      0.0f - (float)json_number_value(y)};
		}
	}
}

void format_places_read(struct garment_places *places, const char *text, size_t size)
{
	memset(places, 0, sizeof *places);
	json_error_t error;
	json_t *root = json_loadb(text, size, 0, &error);
	const json_t *instances = json_object_get(root, "instances");
	for (size_t p = 0; p < json_array_size(instances) && p < PIECES_MAX; p++)
		read_names(places, (int)p, json_array_get(instances, p));
	json_decref(root);
}

/* ---- a line of the file ---- */

struct reader {
	const struct pattern *pattern;
	const struct garment_places *places;
	struct design_marks *marks;
	int line;
	int word_count, at; /* the words of the line, and the next one */
	char *word[WORDS_MAX];
	const struct piece *piece;
	int piece_index;
	int way_count; /* the line in one piece as it is written */
	struct v2 way_mm[WAY_POINTS_MAX];
	float before_mm; /* length of the parts in other pieces */
	char *fault;
};

__attribute__((format(printf, 2, 3))) static bool fail(struct reader *reader, const char *format,
						       ...)
{
	va_list arguments;
	int size = snprintf(reader->fault, FAULT_BYTES, "line %d: ", reader->line);
	va_start(arguments, format);
	vsnprintf(reader->fault + size, (size_t)(FAULT_BYTES - size), format, arguments);
	va_end(arguments);
	return false;
}

static const char *peek(const struct reader *reader)
{
	return reader->at < reader->word_count ? reader->word[reader->at] : "";
}

static bool take(struct reader *reader, const char *word)
{
	bool is = strcmp(peek(reader), word) == 0;
	reader->at += is;
	return is;
}

/* ---- places on a piece ---- */

/* @X,Y: in mm, y up */
static bool find_coordinates(struct reader *reader, const char *word, size_t size,
			     struct v2 *point_mm)
{
	const char *at = word + 1, *end = word + size;
	bool read = number_read(&at, end, &point_mm->x) && at < end && *at++ == ',' &&
		    number_read(&at, end, &point_mm->y) && at == end;
	if (read && float_abs(point_mm->x) <= COORDINATE_MM &&
	    float_abs(point_mm->y) <= COORDINATE_MM)
		return true;
	return fail(reader, "\"%.60s\" is not @X,Y within 10 m", word);
}

static bool find_name(struct reader *reader, const char *name, size_t size, struct v2 *point_mm)
{
	if (size > 0 && name[0] == '@')
		return find_coordinates(reader, name, size, point_mm);
	for (int i = 0; i < reader->places->count; i++) {
		const struct garment_place *place = &reader->places->place[i];
		if (place->piece != reader->piece_index || strlen(place->name) != size ||
		    memcmp(place->name, name, size) != 0)
			continue;
		*point_mm = place->point_mm;
		return true;
	}
	return fail(reader, "piece \"%s\" has no place \"%.*s\"; see its named_vertices",
		    reader->piece->name, (int)size > 40 ? 40 : (int)size, name);
}

/* NAME, NAME/NAME or NAME/NAME/SHARE, `size` bytes */
static bool find_between(struct reader *reader, const char *word, size_t size, struct v2 *point_mm)
{
	const char *end = word + size, *slash = memchr(word, '/', size);
	if (!slash)
		return find_name(reader, word, size, point_mm);
	const char *other = slash + 1, *second = memchr(other, '/', (size_t)(end - other));
	struct v2 to_mm;
	float share = 0.5f;
	if (!find_name(reader, word, (size_t)(slash - word), point_mm) ||
	    !find_name(reader, other, (size_t)((second ? second : end) - other), &to_mm))
		return false;
	const char *text = second ? second + 1 : end;
	if (second &&
	    (!number_read(&text, end, &share) || text != end || share < -1.0f || share > 2.0f))
		return fail(reader, "\"%.60s\": the share must be a number from -1 to 2", word);
	*point_mm = v2_lerp(*point_mm, to_mm, share);
	return true;
}

/* How far the outline is met straight on from a point; 0: nowhere. */
static float far_mm(const struct piece *piece, struct v2 from_mm, struct v2 way)
{
	float far = 0.0f;
	for (int i = 0; i < piece->point_count; i++) {
		struct v2 a = v2_sub(piece->point_mm[i], from_mm);
		struct v2 b = v2_sub(piece->point_mm[(i + 1) % piece->point_count], from_mm);
		float a_mm = v2_cross(way, a), b_mm = v2_cross(way, b);
		if ((a_mm < 0.0f) != (b_mm < 0.0f))
			far = float_max(far, v2_dot(way, v2_lerp(a, b, a_mm / (a_mm - b_mm))));
	}
	return far;
}

/* To the piece's far rim; along a rim, just beside it. */
static bool far_rim(struct reader *reader, struct v2 way, struct v2 *point_mm)
{
	struct v2 aside = {-0.5f * RIM_MM * way.y, 0.5f * RIM_MM * way.x};
	float far = far_mm(reader->piece, *point_mm, way);
	if (far <= RIM_MM)
		far = float_max(far_mm(reader->piece, v2_add(*point_mm, aside), way),
				far_mm(reader->piece, v2_sub(*point_mm, aside), way));
	*point_mm = v2_add(*point_mm, v2_scale(way, far));
	return far > RIM_MM ? true : fail(reader, "\"%.60s\": no cloth lies there", peek(reader));
}

/* BETWEEN or BETWEEN:WAY */
static bool find_place(struct reader *reader, const char *word, struct v2 *point_mm)
{
	static const struct {
		const char *name;
		struct v2 way;
	} ways[] = {{"up", {0.0f, 1.0f}},
		    {"down", {0.0f, -1.0f}},
		    {"left", {-1.0f, 0.0f}},
		    {"right", {1.0f, 0.0f}}};
	size_t size = strcspn(word, ":");
	if (!find_between(reader, word, size, point_mm))
		return false;
	for (int i = 0; word[size] && i < COUNT_OF(ways); i++)
		if (strcmp(word + size + 1, ways[i].name) == 0)
			return far_rim(reader, ways[i].way, point_mm);
	return word[size] ? fail(reader, "\"%.60s\": the way must be up, down, left or right", word)
			  : true;
}

static bool add_point(struct reader *reader, struct v2 point_mm)
{
	if (reader->way_count == WAY_POINTS_MAX)
		return fail(reader, "the line is too long; name fewer places");
	reader->way_mm[reader->way_count++] = point_mm;
	return true;
}

static int nearest_point(const struct piece *piece, struct v2 point_mm)
{
	int best = 0;
	for (int i = 1; i < piece->point_count; i++)
		if (v2_distance(piece->point_mm[i], point_mm) <
		    v2_distance(piece->point_mm[best], point_mm))
			best = i;
	return best;
}

/* Length of the outline from one point to another, `step` 1 with or -1 against its direction. */
static float outline_mm(const struct piece *piece, int from, int to, int step)
{
	float length_mm = 0.0f;
	for (int i = from; i != to;) {
		int next = (i + step + piece->point_count) % piece->point_count;
		length_mm += v2_distance(piece->point_mm[i], piece->point_mm[next]);
		i = next;
	}
	return length_mm;
}

static bool follow_outline(struct reader *reader, struct v2 to_mm)
{
	const struct piece *piece = reader->piece;
	int count = piece->point_count;
	int from = nearest_point(piece, reader->way_mm[reader->way_count - 1]);
	int to = nearest_point(piece, to_mm);
	int step = outline_mm(piece, from, to, 1) <= outline_mm(piece, from, to, -1) ? 1 : -1;
	for (int i = from; i != to; i = (i + step + count) % count)
		if (i != from && !add_point(reader, piece->point_mm[i]))
			return false;
	return add_point(reader, to_mm);
}

static bool read_place(struct reader *reader)
{
	struct v2 point_mm;
	bool follows = take(reader, "..");
	if (follows && reader->way_count == 0)
		return fail(reader, "the line must begin at a named place");
	if (!find_place(reader, peek(reader), &point_mm))
		return false;
	reader->at++;
	return follows ? follow_outline(reader, point_mm) : add_point(reader, point_mm);
}

/* ---- marks ---- */

static float way_mm(const struct reader *reader)
{
	float length_mm = 0.0f;
	for (int i = 1; i < reader->way_count; i++)
		length_mm += v2_distance(reader->way_mm[i - 1], reader->way_mm[i]);
	return length_mm;
}

static struct v2 way_point(const struct reader *reader, float along_mm)
{
	const struct v2 *way = reader->way_mm;
	int i = 0;
	for (; i + 2 < reader->way_count && along_mm > v2_distance(way[i], way[i + 1]); i++)
		along_mm -= v2_distance(way[i], way[i + 1]);
	float step_mm = float_max(v2_distance(way[i], way[i + 1]), 1e-3f);
	return v2_lerp(way[i], way[i + 1], along_mm / step_mm);
}

/* The way in one piece as a mark; behind a + it is drawn out at its start by what lies in other
 * pieces. */
static bool add_mark(struct reader *reader)
{
	float length_mm = way_mm(reader);
	if (reader->way_count < 2 || length_mm < 2.0f * RIM_MM)
		return fail(reader, "a mark needs two places apart");
	if (reader->marks->count == MARKS_MAX)
		return fail(reader, "more than %d marks; leave some out", MARKS_MAX);
	struct design_mark *mark = &reader->marks->mark[reader->marks->count++];
	float whole_mm = reader->before_mm + length_mm;
	mark->piece = reader->piece_index;
	mark->point_count = int_min(2 + (int)(whole_mm / POINT_STEP_MM), MARK_POINTS_MAX);
	for (int i = 0; i < mark->point_count; i++) {
		float share = (float)i / (float)(mark->point_count - 1);
		mark->point_mm[i] = way_point(reader, share * whole_mm - reader->before_mm);
	}
	reader->before_mm = whole_mm;
	return true;
}

/* In a word a blank of the name is written _. */
static bool names(const char *word, const char *name)
{
	for (; *name && (*word == *name || (*word == '_' && *name == ' ')); name++)
		word++;
	return *word == *name;
}

static bool read_piece(struct reader *reader)
{
	reader->piece_index = -1;
	for (int p = 0; p < PIECES_MAX; p++)
		if (reader->pattern->piece[p].used &&
		    names(peek(reader), reader->pattern->piece[p].name))
			reader->piece_index = p;
	if (reader->piece_index < 0)
		return fail(reader, "there is no piece \"%.40s\"", peek(reader));
	reader->piece = &reader->pattern->piece[reader->piece_index];
	reader->way_count = 0;
	reader->at++;
	return true;
}

/* PIECE PLACE PLACE ... */
static bool read_part(struct reader *reader)
{
	if (!read_piece(reader))
		return false;
	while (reader->at < reader->word_count && strcmp(peek(reader), "+") != 0 &&
	       strcmp(peek(reader), "on") != 0)
		if (!read_place(reader))
			return false;
	return add_mark(reader);
}

static bool read_stop(struct reader *reader, float *stop)
{
	const char *text = peek(reader), *end = text + strlen(text);
	if (!number_read(&text, end, stop) || text != end || *stop < 0.0f || *stop > STOP_MAX)
		return fail(reader, "\"%.40s\" is not a stop of the landmark, like 1 or 0.5",
			    peek(reader));
	reader->at++;
	return true;
}

static bool read_pin(struct reader *reader)
{
	struct design_marks *marks = reader->marks;
	if (!read_piece(reader) || !read_place(reader))
		return false;
	if (reader->at < reader->word_count)
		return fail(reader, "a pin is PIECE PLACE and nothing else");
	if (marks->pin_count == PINS_MAX)
		return fail(reader, "more than %d pins; leave some out", PINS_MAX);
	marks->pin[marks->pin_count++] = (struct design_pin){reader->piece_index,
							     reader->way_mm[0]};
	return true;
}

static bool read_mark(struct reader *reader)
{
	int first = reader->marks->count;
	float from = 0.0f, to = 0.0f;
	reader->before_mm = 0.0f;
	do {
		if (!read_part(reader))
			return false;
	} while (take(reader, "+"));
	if (!take(reader, "on") || reader->at == reader->word_count)
		return fail(reader, "the landmark is missing; end the line with `on LANDMARK`");
	const char *landmark = reader->word[reader->at++];
	bool part = reader->at < reader->word_count;
	if (part && !(read_stop(reader, &from) && read_stop(reader, &to)))
		return false;
	if (reader->at < reader->word_count || (part && from == to))
		return fail(reader, "behind the landmark stand FROM and TO, or nothing");
	for (int m = first; m < reader->marks->count; m++) {
		copy_name(reader->marks->mark[m].landmark, landmark);
		reader->marks->mark[m].from = from;
		reader->marks->mark[m].to = to;
	}
	return true;
}

static bool read_line(struct reader *reader)
{
	return take(reader, "pin") ? read_pin(reader) : read_mark(reader);
}

/* Cuts a line into words; none in a comment. False: too many. */
static bool cut_words(struct reader *reader, char *line)
{
	reader->word_count = reader->at = 0;
	char *rest = line;
	for (char *word; (word = strtok_r(rest, " \t\r", &rest)) != NULL;) {
		if (reader->word_count == 0 && word[0] == '#')
			return true;
		if (reader->word_count == WORDS_MAX)
			return fail(reader, "more than %d words; leave some out", WORDS_MAX);
		reader->word[reader->word_count++] = word;
	}
	return true;
}

bool format_marks_read(struct design_marks *marks, const struct pattern *pattern,
		       const struct garment_places *places, const char *text, size_t size,
		       char fault[200])
{
	struct reader reader = {
		.pattern = pattern, .places = places, .marks = marks, .fault = fault};
	char line[LINE_BYTES_MAX];
	memset(marks, 0, sizeof *marks);
	fault[0] = '\0';
	for (const char *at = text, *end = text + size, *stop; at < end; at = stop + (stop < end)) {
		stop = memchr(at, '\n', (size_t)(end - at));
		stop = stop ? stop : end;
		size_t length = (size_t)(stop - at);
		reader.line++;
		if (length >= sizeof line)
			return fail(&reader, "longer than %d bytes", LINE_BYTES_MAX - 1);
		memcpy(line, at, length);
		line[length] = '\0';
		if (!cut_words(&reader, line) || (reader.word_count > 0 && !read_line(&reader)))
			return false;
	}
	if (marks->count == 0)
		return fail(&reader, "no marks; a line is PIECE PLACE PLACE on LANDMARK");
	return true;
}
