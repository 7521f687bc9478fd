#include "format_marks_guess.h"

#include <ctype.h>
#include <jansson.h>
#include <stdarg.h>
#include <stdio.h>

enum role { ROLE_NONE, ROLE_FRONT, ROLE_BACK, ROLE_SLEEVE, ROLE_HOOD, ROLE_BAND };

#define RIM_MM 0.5f /* from a rim into the cloth */

enum { TEXT_BYTES = 200, CHAIN_PIECES_MAX = 4, SIDE_RIGHT = -1, SIDE_LEFT = 1 };

/* Of a bodice block: neck pit and nape lie so far below the shoulder's inner end, as shares of the
 * way from the middle to the shoulder point. */
static const float pit_share = 0.26f, nape_share = 0.08f;
static const float shoulder_height = 0.7f; /* a shoulder seam lies above this share of its piece */
static const float near_mm = 3.0f;         /* a centre line ends at a seam so near */

struct guess {
	const struct pattern *pattern;
	enum role role[PIECES_MAX];
	int side[PIECES_MAX]; /* 0: both or neither */
	int size;
	char *out;
};

__attribute__((format(printf, 2, 3))) static void put(struct guess *guess, const char *format, ...)
{
	va_list arguments;
	va_start(arguments, format);
	int room = GUESS_BYTES_MAX - guess->size;
	int size = vsnprintf(guess->out + guess->size, (size_t)room, format, arguments);
	va_end(arguments);
	guess->size += int_min(int_max(size, 0), room - 1);
}

static void put_point(struct guess *guess, struct v2 p)
{
	put(guess, " @%.2f,%.2f", (double)p.x, (double)p.y);
}

/* A piece's name as one word. */
static void put_name(struct guess *guess, int p)
{
	for (const char *at = guess->pattern->piece[p].name; *at; at++)
		put(guess, "%c", *at == ' ' ? '_' : *at);
}

/* ---- what the file says of a piece ---- */

/* Adds a string's words in small letters, up to what only explains them. */
static void add_words(char text[TEXT_BYTES], const json_t *string)
{
	const char *from = json_string_value(string);
	size_t size = strlen(text);
	if (!from)
		return;
	for (; *from && *from != ';' && *from != '(' && size < TEXT_BYTES - 2; from++)
		text[size++] = (char)tolower((unsigned char)*from);
	text[size++] = ' ';
	text[size] = '\0';
}

static bool says(const char *text, const char *const *word)
{
	for (; *word; word++)
		if (strstr(text, *word))
			return true;
	return false;
}

static enum role find_role(const char *text)
{
	static const char *const small[] = {"collar", "stand",       "facing",  "binding",
					    "pocket", "cuff",        "placket", "belt",
					    "lining", "undersleeve", NULL};
	static const struct {
		enum role role;
		const char *word[4];
	} roles[] = {
		{ROLE_BAND, {"waistband", "waist band", NULL}},
		{ROLE_HOOD, {"hood", NULL}},
		{ROLE_SLEEVE, {"sleeve", " arm ", NULL}},
		{ROLE_BACK, {"back", "yoke", "tail", NULL}},
		{ROLE_FRONT, {"front", NULL}},
	};
	if (says(text, small))
		return ROLE_NONE;
	for (int i = 0; i < COUNT_OF(roles); i++)
		if (says(text, roles[i].word))
			return roles[i].role;
	return ROLE_NONE;
}

static int find_side(const char *text, const char *id)
{
	size_t size = id ? strlen(id) : 0;
	if (size > 2 && id[size - 2] == '.' && (id[size - 1] == 'L' || id[size - 1] == 'R'))
		return id[size - 1] == 'L' ? SIDE_LEFT : SIDE_RIGHT;
	return (strstr(text, "left") != NULL) - (strstr(text, "right") != NULL);
}

static void read_roles(struct guess *guess, const char *text, size_t size)
{
	json_error_t error;
	json_t *root = json_loadb(text, size, 0, &error);
	const json_t *instances = json_object_get(root, "instances");
	for (size_t p = 0; p < json_array_size(instances) && p < PIECES_MAX; p++) {
		const json_t *instance = json_array_get(instances, p);
		const json_t *id = json_object_get(instance, "id");
		char words[TEXT_BYTES] = "";
		add_words(words, id);
		add_words(words, json_object_get(instance, "piece"));
		add_words(words, json_object_get(instance, "wear"));
		guess->role[p] = find_role(words);
		guess->side[p] = find_side(words, json_string_value(id));
	}
	json_decref(root);
}

/* ---- seams ---- */

static struct v2 edge_end(const struct guess *guess, struct edge_ref ref, bool last)
{
	return piece_edge_point(&guess->pattern->piece[ref.piece], ref.edge, last ? 1.0f : 0.0f);
}

/* The i-th side of all seams, and what it is sewn to. False: there are no more. */
static bool seam_side(const struct guess *guess, int i, struct edge_ref *own,
		      struct edge_ref *other)
{
	if (i >= 2 * SEAMS_MAX)
		return false;
	const struct seam *seam = &guess->pattern->seam[i / 2];
	*own = i & 1 ? seam->b : seam->a;
	*other = i & 1 ? seam->a : seam->b;
	if (!seam->used)
		own->piece = -1;
	return true;
}

static void bounds(const struct piece *piece, struct v2 *low, struct v2 *high)
{
	*low = *high = piece->point_mm[0];
	for (int i = 1; i < piece->point_count; i++) {
		low->x = float_min(low->x, piece->point_mm[i].x);
		low->y = float_min(low->y, piece->point_mm[i].y);
		high->x = float_max(high->x, piece->point_mm[i].x);
		high->y = float_max(high->y, piece->point_mm[i].y);
	}
}

static bool front_and_back(const struct guess *guess, int p, int q)
{
	enum role a = guess->role[p], b = guess->role[q];
	return (a == ROLE_FRONT && b == ROLE_BACK) || (a == ROLE_BACK && b == ROLE_FRONT);
}

/* The shoulder seam's end farthest from the middle line, as a distance; 0: no shoulder. */
static float shoulder_mm(const struct guess *guess, int p, float middle_x)
{
	struct edge_ref own, other;
	struct v2 low, high;
	float far_mm = 0.0f;
	bounds(&guess->pattern->piece[p], &low, &high);
	for (int i = 0; seam_side(guess, i, &own, &other); i++) {
		if (own.piece != p || !front_and_back(guess, p, other.piece))
			continue;
		struct v2 a = edge_end(guess, own, false), b = edge_end(guess, own, true);
		if (0.5f * (a.y + b.y) < low.y + shoulder_height * (high.y - low.y))
			continue;
		far_mm = float_max(far_mm,
				   float_max(float_abs(a.x - middle_x), float_abs(b.x - middle_x)));
	}
	return far_mm;
}

/* ---- centre lines ---- */

/* Where the wearer's middle runs on a piece: x 0, as patterns are drawn, unless the piece lies
 * elsewhere. */
static float middle_of(const struct guess *guess, int p)
{
	struct v2 low, high;
	bounds(&guess->pattern->piece[p], &low, &high);
	if (guess->side[p] == 0)
		return float_abs(low.x + high.x) < 0.1f * (high.x - low.x)
			       ? 0.0f
			       : 0.5f * (low.x + high.x);
	if (low.x - near_mm <= 0.0f && high.x + near_mm >= 0.0f)
		return float_clamp(0.0f, low.x + RIM_MM, high.x - RIM_MM);
	bool at_low = (guess->role[p] == ROLE_FRONT) == (guess->side[p] == SIDE_LEFT);
	return at_low ? low.x + RIM_MM : high.x - RIM_MM;
}

/* The highest and the lowest point of a piece on a vertical line. */
static bool cross_at(const struct piece *piece, float x, struct v2 *top, struct v2 *bottom)
{
	*top = (struct v2){x, -1e9f};
	*bottom = (struct v2){x, 1e9f};
	for (int i = 0; i < piece->point_count; i++) {
		struct v2 a = piece->point_mm[i];
		struct v2 b = piece->point_mm[(i + 1) % piece->point_count];
		if ((a.x <= x) == (b.x <= x))
			continue;
		float y = v2_lerp(a, b, (x - a.x) / (b.x - a.x)).y;
		top->y = float_max(top->y, y);
		bottom->y = float_min(bottom->y, y);
	}
	return top->y > bottom->y;
}

/* The same; where the line is a rim itself, a little to the cloth's side of it. */
static bool cross_piece(const struct piece *piece, float x, struct v2 *top, struct v2 *bottom)
{
	bool crossed = false;
	struct v2 high, low;
	static const float aside_mm[] = {0.0f, -RIM_MM, RIM_MM};
	for (int i = 0; i < COUNT_OF(aside_mm); i++)
		if (cross_at(piece, x + aside_mm[i], &high, &low) &&
		    (!crossed || high.y - low.y > top->y - bottom->y + near_mm)) {
			*top = high;
			*bottom = low;
			crossed = true;
		}
	return crossed;
}

/* Where along an edge a point lies; at a corner it lies on both. */
static bool on_edge(const struct guess *guess, struct edge_ref ref, struct v2 at, float *share)
{
	int edge;
	for (int last = 0; last < 2; last++) {
		*share = (float)last;
		if (v2_distance(edge_end(guess, ref, last), at) < near_mm)
			return true;
	}
	return piece_nearest_edge(&guess->pattern->piece[ref.piece], at, &edge, share) < near_mm &&
	       edge == ref.edge;
}

/* The other side of a seam on which a point lies, in a piece of some role. False: it is on none. */
static bool across_seam(const struct guess *guess, int p, struct v2 at, enum role role, int *piece,
			struct v2 *there)
{
	struct edge_ref own, other;
	for (int i = 0; seam_side(guess, i, &own, &other); i++) {
		float share;
		if (own.piece != p || other.piece == p || guess->role[other.piece] != role ||
		    !on_edge(guess, own, at, &share))
			continue;
		if (!guess->pattern->seam[i / 2].swapped)
			share = 1.0f - share;
		*piece = other.piece;
		*there = piece_edge_point(&guess->pattern->piece[other.piece], other.edge, share);
		return true;
	}
	return false;
}

/* From a point down the middle of a piece, and on through pieces sewn below it. */
static void put_centre(struct guess *guess, int p, struct v2 start)
{
	const struct pattern *pattern = guess->pattern;
	struct v2 top, bottom = start;
	for (int links = 0; links < CHAIN_PIECES_MAX; links++) {
		int next;
		struct v2 there;
		if (!cross_piece(&pattern->piece[p], bottom.x, &top, &bottom))
			break;
		put(guess, "%s", links ? " + " : "");
		put_name(guess, p);
		put_point(guess, start);
		put_point(guess, bottom);
		if (!across_seam(guess, p, bottom, guess->role[p], &next, &there))
			break;
		p = next;
		start = bottom = there;
		struct v2 low, high;
		bounds(&pattern->piece[p], &low, &high);
		bottom.x = float_clamp(there.x, low.x + RIM_MM, high.x - RIM_MM);
	}
}

static const char *centre_name(const struct guess *guess, int p)
{
	return guess->role[p] == ROLE_FRONT ? "front-centre" : "back-centre";
}

/* ---- garments ---- */

/* From the neck pit's or the nape's height down. */
static void guess_top(struct guess *guess, int p, float shoulder)
{
	struct v2 low, high;
	bounds(&guess->pattern->piece[p], &low, &high);
	float share = guess->role[p] == ROLE_FRONT ? pit_share : nape_share;
	put_centre(guess, p, (struct v2){middle_of(guess, p), high.y - share * shoulder});
	put(guess, " on %s\n", centre_name(guess, p));
}

/* From the top of its cap to the middle of its lower end. */
static void guess_sleeve(struct guess *guess, int p)
{
	const struct piece *piece = &guess->pattern->piece[p];
	struct v2 low, high, top = piece->point_mm[0], end[2] = {{1e9f, 0.0f}, {-1e9f, 0.0f}};
	bounds(piece, &low, &high);
	for (int i = 0; i < piece->point_count; i++) {
		struct v2 at = piece->point_mm[i];
		top = at.y > top.y ? at : top;
		if (at.y > low.y + 0.1f * (high.y - low.y))
			continue;
		end[0] = at.x < end[0].x ? at : end[0];
		end[1] = at.x > end[1].x ? at : end[1];
	}
	if (guess->side[p] == 0 || v2_distance(end[0], end[1]) < near_mm)
		return;
	put_name(guess, p);
	put_point(guess, top);
	put_point(guess, v2_lerp(end[0], end[1], 0.5f));
	put(guess, " on arm-%s-top\n", guess->side[p] == SIDE_LEFT ? "left" : "right");
}

/* Two edges of a leg meet at the fork: one sewn to the other leg, one between front and back. */
static bool find_fork(const struct guess *guess, int p, struct edge_ref *rise,
		      struct edge_ref *inseam, struct v2 *fork)
{
	struct edge_ref own, other, own2, other2;
	for (int i = 0; seam_side(guess, i, &own, &other); i++) {
		if (own.piece != p || guess->role[other.piece] != guess->role[p] ||
		    guess->side[other.piece] != -guess->side[p])
			continue;
		for (int k = 0; seam_side(guess, k, &own2, &other2); k++) {
			if (own2.piece != p || !front_and_back(guess, p, other2.piece))
				continue;
			for (int ends = 0; ends < 4; ends++) {
				*fork = edge_end(guess, own, ends & 1);
				*rise = own;
				*inseam = own2;
				if (v2_distance(*fork, edge_end(guess, own2, ends & 2)) < near_mm)
					return true;
			}
		}
	}
	return false;
}

/* The end of an edge that is not the fork. */
static struct v2 far_end(const struct guess *guess, struct edge_ref edge, struct v2 fork)
{
	struct v2 a = edge_end(guess, edge, false), b = edge_end(guess, edge, true);
	return v2_distance(a, fork) > v2_distance(b, fork) ? a : b;
}

/* Up the seat seam, down the inside of the leg, down its outside from the fork's height. */
static bool guess_leg(struct guess *guess, int p)
{
	const struct piece *piece = &guess->pattern->piece[p];
	const char *side = guess->side[p] == SIDE_LEFT ? "left" : "right";
	struct edge_ref rise, inseam;
	struct v2 fork, low, high;
	if (guess->side[p] == 0 || !find_fork(guess, p, &rise, &inseam, &fork))
		return false;
	bounds(piece, &low, &high);
	bool outer_high = high.x - fork.x > fork.x - low.x;
	put_name(guess, p);
	put_point(guess, fork);
	put(guess, " ..");
	put_point(guess, far_end(guess, rise, fork));
	put(guess, " on %s 2 0\n", centre_name(guess, p));
	put_name(guess, p);
	put_point(guess, fork);
	put(guess, " ..");
	put_point(guess, far_end(guess, inseam, fork));
	put(guess, " on leg-%s-inner\n", side);
	put_name(guess, p);
	put_point(guess, fork);
	put(guess, ":%s", outer_high ? "right" : "left");
	put(guess, " .. @%.2f,%.2f on leg-%s-outer 0.2 2\n", (double)(outer_high ? high.x : low.x),
	    (double)low.y, side);
	return true;
}

/* The seam between both halves, from the nape over the crown. */
static void guess_hood(struct guess *guess, int p)
{
	struct edge_ref own, other, own2, other2;
	for (int i = 0; seam_side(guess, i, &own, &other); i++) {
		if (own.piece != p || guess->role[other.piece] != ROLE_HOOD || other.piece == p)
			continue;
		struct v2 nape = edge_end(guess, own, false);
		for (int k = 0; seam_side(guess, k, &own2, &other2); k++)
			if (own2.piece == p && guess->role[other2.piece] == ROLE_BACK)
				nape = far_end(guess, own,
					       far_end(guess, own, edge_end(guess, own2, true)));
		put_name(guess, p);
		put_point(guess, nape);
		put(guess, " ..");
		put_point(guess, far_end(guess, own, nape));
		put(guess, " on head-centre 2 0\n");
		return;
	}
}

/* Across the waistband from its upper edge to the seam that a point lies on, if there is one. */
static void put_band(struct guess *guess, int p, struct v2 at)
{
	struct v2 there, low, high;
	int band;
	if (!across_seam(guess, p, at, ROLE_BAND, &band, &there))
		return;
	bounds(&guess->pattern->piece[band], &low, &high);
	bool upright = high.y - low.y > high.x - low.x;
	const char *way = upright ? (high.x - there.x > there.x - low.x ? "right" : "left")
				  : (high.y - there.y > there.y - low.y ? "up" : "down");
	put_name(guess, band);
	put_point(guess, there);
	put(guess, ":%s", way);
	put_point(guess, there);
	put(guess, " + ");
}

/* From the waist to below the hips, at the middle and, in front, along the side seams. */
static void guess_skirt(struct guess *guess, int p)
{
	float middle_x = middle_of(guess, p);
	struct edge_ref own, other;
	struct v2 top, bottom;
	if (!cross_piece(&guess->pattern->piece[p], middle_x, &top, &bottom))
		return;
	put_band(guess, p, top);
	put_centre(guess, p, top);
	put(guess, " on %s 1 1.7\n", centre_name(guess, p));
	for (int i = 0; guess->role[p] == ROLE_FRONT && seam_side(guess, i, &own, &other); i++) {
		if (own.piece != p || guess->role[other.piece] != ROLE_BACK)
			continue;
		struct v2 a = edge_end(guess, own, false), b = edge_end(guess, own, true);
		struct v2 high = a.y > b.y ? a : b, low = a.y > b.y ? b : a;
		put_band(guess, p, high);
		put_name(guess, p);
		put_point(guess, high);
		put(guess, " ..");
		put_point(guess, low);
		put(guess, " on side-%s 1 2\n", high.x > middle_x ? "left" : "right");
	}
}

int format_marks_guess(char out[GUESS_BYTES_MAX], const struct pattern *pattern, const char *text,
		       size_t size)
{
	struct guess guess = {.pattern = pattern, .out = out};
	bool top = false;
	out[0] = '\0';
	read_roles(&guess, text, size);
	for (int p = 0; p < PIECES_MAX; p++)
		top = top || guess.role[p] == ROLE_SLEEVE ||
		      (pattern->piece[p].used && shoulder_mm(&guess, p, 0.0f) > 0.0f);
	for (int p = 0; p < PIECES_MAX; p++) {
		if (!pattern->piece[p].used)
			continue;
		bool body = guess.role[p] == ROLE_FRONT || guess.role[p] == ROLE_BACK;
		float shoulder = body ? shoulder_mm(&guess, p, middle_of(&guess, p)) : 0.0f;
		if (shoulder > 0.0f)
			guess_top(&guess, p, shoulder);
		else if (body && !guess_leg(&guess, p) && !top)
			guess_skirt(&guess, p);
		else if (guess.role[p] == ROLE_SLEEVE)
			guess_sleeve(&guess, p);
		else if (guess.role[p] == ROLE_HOOD)
			guess_hood(&guess, p);
	}
	return guess.size;
}
