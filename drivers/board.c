#include "board.h"

#include <stdio.h>

const struct board board_default = {
	.button_line = {"wrap", "pin", "relax"},
	.button_active_low = true,
	.idle_s = 180,
	.display_auto = true,
	.crosses_asked = 9,
};

const char board_text[] =
	"# Board file of kitsuke. A line is a key, = and a value; # begins a comment.\n"
	"# Every key may be left out: it then has the value that stands here.\n"
	"\n"
	"# Width and height of the display's picture in mm; auto: what the display says.\n"
	"display_mm = auto\n"
	"# How the picture is turned, degrees clockwise: 0, 90, 180 or 270.\n"
	"rotation = 0\n"
	"\n"
	"# The GPIO lines of the three buttons by name (gpioinfo lists them); none: no button.\n"
	"wrap = wrap\n"
	"pin = pin\n"
	"relax = relax\n"
	"# yes: a pressed button connects its line to ground, and the line is pulled up.\n"
	"active_low = yes\n"
	"\n"
	"# Work units that the solver may spend in a frame; auto: the program's own number.\n"
	"# `kitsuke calibrate FILE` measures it and writes it here.\n"
	"budget = auto\n"
	"# Threads that move the cloth, 1 to 8; auto: all processors but one for the picture, at\n"
	"# most 4. The cloth moves the same with any number; calibrate the budget anew.\n"
	"threads = auto\n"
	"# Processors for those beside the frame's own thread, like 5 6 7; any: the system "
	"chooses.\n"
	"thread_cpus = any\n"
	"# The station starts anew after so many seconds without a moving pen; 0: never. Of the "
	"last\n"
	"# 15 of them the screen asks whether somebody is there. 60 suits a busy floor.\n"
	"idle_s = 180\n"
	"# both: Japanese over English; ja; en. The visitor can change it on the screen.\n"
	"language = both\n"
	"# The station's name, as it stands on the cards that visitors take home; none.\n"
	"station = none\n"
	"# Digits, 4 to 8, that the service page asks for (all buttons held for five seconds); "
	"none.\n"
	"service_pin = none\n"
	"\n"
	"# Take only the tablet with these USB ids, like 256c:006d; any: the first pen found.\n"
	"tablet = any\n"
	"# Width and height of the tablet's active area in mm; auto: what the tablet says.\n"
	"tablet_mm = auto\n"
	"# How the tablet lies, degrees clockwise: 0, 90, 180 (for a left hand) or 270.\n"
	"tablet_rotation = 0\n"
	"# yes: the tablet is the display. Its pen then follows the picture's rotation.\n"
	"# auto: what libwacom's data says about the tablet's model.\n"
	"pen_display = auto\n"
	"# Crosses that were touched on a pen display, 4 to 25: for each of them where the pen "
	"was\n"
	"# seen and where the cross stands, x y x y in pixels of the display; none: as built.\n"
	"calibration = none\n"
	"# How many crosses the service page asks for: 4, 9, 16 or 25, in a square grid. Four are\n"
	"# quick; more leave less where the panel's edges bend the pen's field.\n"
	"calibration_crosses = 9\n";

struct reader {
	struct board *board;
	int line;
	char key[32], value[1024];
	unsigned seen; /* a bit a key */
	char *fault;
};

static bool fault(struct reader *r, const char *remedy)
{
	snprintf(r->fault, 200, "line %d: %s = %.60s; %.90s", r->line, r->key, r->value, remedy);
	return false;
}

/* --- values ----------------------------------------------------------------------------------- */

/* One number at *at, moved behind it and the blanks around. */
static bool number_cut(const char **at, float *number)
{
	float value = 0.0f, unit = 1.0f;
	int digits = 0;
	const char *c = *at;
	for (; *c >= '0' && *c <= '9' && digits < 7; c++, digits++)
		value = 10.0f * value + (float)(*c - '0');
	if (*c == '.' && digits)
		for (c++; *c >= '0' && *c <= '9' && digits < 7; c++, digits++) {
			unit /= 10.0f;
			value += unit * (float)(*c - '0');
		}
	if (!digits || (*c && *c != ' '))
		return false;
	while (*c == ' ')
		c++;
	*at = c;
	*number = value;
	return true;
}

static bool value_size_mm(struct reader *r, float *width_mm, float *height_mm)
{
	const char *at = r->value;
	if (!strcmp(at, "auto")) {
		*width_mm = *height_mm = 0.0f;
		return true;
	}
	float width, height;
	if (!number_cut(&at, &width) || !number_cut(&at, &height) || *at || width < 10.0f ||
	    height < 10.0f || width > 5000.0f || height > 5000.0f)
		return fault(r, "give width and height in mm, 10 to 5000, like 344 194, or auto");
	*width_mm = width;
	*height_mm = height;
	return true;
}

static bool value_int(struct reader *r, int least, int most, int *value)
{
	const char *at = r->value;
	float number;
	char remedy[80];
	bool whole = !strchr(at, '.') && number_cut(&at, &number) && !*at;
	if (!whole || number < (float)least || number > (float)most) {
		snprintf(remedy, sizeof remedy, "give a whole number from %d to %d", least, most);
		return fault(r, remedy);
	}
	*value = (int)number;
	return true;
}

static bool value_rotation(struct reader *r, int *degrees)
{
	static const char *words[] = {"0", "90", "180", "270"};
	for (int i = 0; i < COUNT_OF(words); i++)
		if (!strcmp(r->value, words[i])) {
			*degrees = 90 * i;
			return true;
		}
	return fault(r, "give 0, 90, 180 or 270");
}

static bool value_line(struct reader *r, enum button button)
{
	char *line = r->board->button_line[button];
	size_t size = strlen(r->value);
	if (!strcmp(r->value, "none"))
		size = 0;
	if (size >= BOARD_NAME_MAX)
		return fault(r, "a line's name has at most 63 characters");
	memcpy(line, r->value, size);
	line[size] = 0;
	return true;
}

static bool value_yes(struct reader *r, bool *value)
{
	*value = !strcmp(r->value, "yes");
	return *value || !strcmp(r->value, "no") || fault(r, "give yes or no");
}

static bool value_display(struct reader *r)
{
	r->board->display_auto = !strcmp(r->value, "auto");
	r->board->mount.display = !strcmp(r->value, "yes");
	return r->board->display_auto || r->board->mount.display || !strcmp(r->value, "no") ||
	       fault(r, "give auto, yes or no");
}

static bool value_budget(struct reader *r)
{
	int units = 0;
	if (strcmp(r->value, "auto") && !value_int(r, 1000, 9999999, &units))
		return false;
	r->board->budget_units = units;
	return true;
}

static bool value_threads(struct reader *r)
{
	int threads = 0;
	if (strcmp(r->value, "auto") && !value_int(r, 1, BOARD_THREADS_MAX, &threads))
		return false;
	r->board->threads = threads;
	return true;
}

static bool value_cpus(struct reader *r)
{
	const char *at = r->value;
	float number;
	r->board->thread_cpus = 0;
	while (strcmp(r->value, "any") && *at) {
		if (r->board->thread_cpus == BOARD_THREADS_MAX - 1 || !number_cut(&at, &number) ||
		    number > 1023.0f || number != (float)(int)number)
			return fault(r, "give processors' numbers, at most 7, like 5 6 7, or any");
		r->board->thread_cpu[r->board->thread_cpus++] = (int)number;
	}
	return true;
}

static const char *language_words[] = {"both", "ja", "en"};

static bool value_language(struct reader *r)
{
	for (int i = 0; i < COUNT_OF(language_words); i++)
		if (!strcmp(r->value, language_words[i])) {
			r->board->language = (enum board_language)i;
			return true;
		}
	return fault(r, "give both, ja or en");
}

/* Words of any script, without anything that is no letter's byte. */
static bool value_station(struct reader *r)
{
	size_t size = strcmp(r->value, "none") ? strlen(r->value) : 0;
	if (size >= BOARD_NAME_MAX)
		return fault(r, "give a name of at most 63 bytes, or none");
	for (size_t i = 0; i < size; i++)
		if ((unsigned char)r->value[i] < ' ' || r->value[i] == 0x7f)
			return fault(r, "give a name in one line of plain text (UTF-8), or none");
	memcpy(r->board->station, r->value, size);
	r->board->station[size] = 0;
	return true;
}

static bool value_service_pin(struct reader *r)
{
	size_t size = strcmp(r->value, "none") ? strlen(r->value) : 0;
	if ((size && (size < 4 || size > BOARD_PIN_MAX)) || strspn(r->value, "0123456789") < size)
		return fault(r, "give 4 to 8 digits, or none");
	memcpy(r->board->service_pin, r->value, size);
	r->board->service_pin[size] = 0;
	return true;
}

static bool value_tablet(struct reader *r)
{
	unsigned vendor = 0, product = 0;
	int end = 0;
	if (strcmp(r->value, "any") &&
	    (sscanf(r->value, "%4x:%4x%n", &vendor, &product, &end) != 2 || r->value[end] ||
	     strlen(r->value) != 9))
		return fault(r, "give vendor and product in hex, like 256c:006d, or any");
	r->board->tablet_vendor = (int)vendor;
	r->board->tablet_product = (int)product;
	return true;
}

/* Pixels with two digits behind the point. */
static bool hundredths_cut(const char **at, int *hundredths)
{
	float number;
	if (!number_cut(at, &number) || number > 16384.0f)
		return false;
	*hundredths = (int)(100.0f * number + 0.5f);
	return true;
}

static bool value_calibration(struct reader *r)
{
	struct pen_mount *mount = &r->board->mount;
	struct plane_map map;
	char wrong[200];
	const char *at = strcmp(r->value, "none") ? r->value : "";
	mount->cross_count = 0;
	while (*at) {
		struct pen_cross cross;
		if (mount->cross_count == PLANE_MAP_POINTS_MAX ||
		    !hundredths_cut(&at, &cross.seen_x) || !hundredths_cut(&at, &cross.seen_y) ||
		    !hundredths_cut(&at, &cross.meant_x) || !hundredths_cut(&at, &cross.meant_y))
			return fault(r, "give four numbers for each of 4 to 25 crosses, or none");
		mount->cross[mount->cross_count++] = cross;
	}
	return pen_mount_calibrate(mount, &map, &r->board->calibration_rms_px,
				   &r->board->calibration_worst_px, wrong) ||
	       fault(r, wrong);
}

/* Grids from corner to corner: four crosses fix the map, which then leaves nothing to show. */
static bool value_crosses(struct reader *r)
{
	static const struct {
		const char *word;
		int crosses;
	} grid[] = {{"4", 4}, {"9", 9}, {"16", 16}, {"25", PLANE_MAP_POINTS_MAX}};
	for (int i = 0; i < COUNT_OF(grid); i++)
		if (!strcmp(r->value, grid[i].word)) {
			r->board->crosses_asked = grid[i].crosses;
			return true;
		}
	return fault(r, "give 4, 9, 16 or 25");
}

/* --- lines ------------------------------------------------------------------------------------ */

enum key {
	KEY_DISPLAY,
	KEY_ROTATION,
	KEY_WRAP,
	KEY_PIN,
	KEY_RELAX,
	KEY_ACTIVE_LOW,
	KEY_BUDGET,
	KEY_THREADS,
	KEY_CPUS,
	KEY_IDLE,
	KEY_LANGUAGE,
	KEY_STATION,
	KEY_SERVICE_PIN,
	KEY_TABLET,
	KEY_TABLET_MM,
	KEY_TABLET_ROTATION,
	KEY_PEN_DISPLAY,
	KEY_CALIBRATION,
	KEY_CROSSES,
	KEY_COUNT,
};

static const char *key_names[KEY_COUNT] = {
	"display_mm",
	"rotation",
	"wrap",
	"pin",
	"relax",
	"active_low",
	"budget",
	"threads",
	"thread_cpus",
	"idle_s",
	"language",
	"station",
	"service_pin",
	"tablet",
	"tablet_mm",
	"tablet_rotation",
	"pen_display",
	"calibration",
	"calibration_crosses",
};

static bool key_read(struct reader *r, enum key key)
{
	struct board *board = r->board;
	switch (key) {
	case KEY_DISPLAY:
		return value_size_mm(r, &board->display_width_mm, &board->display_height_mm);
	case KEY_ROTATION:
		return value_rotation(r, &board->rotation);
	case KEY_WRAP:
		return value_line(r, BUTTON_WRAP);
	case KEY_PIN:
		return value_line(r, BUTTON_PIN);
	case KEY_RELAX:
		return value_line(r, BUTTON_RELAX);
	case KEY_ACTIVE_LOW:
		return value_yes(r, &board->button_active_low);
	case KEY_BUDGET:
		return value_budget(r);
	case KEY_THREADS:
		return value_threads(r);
	case KEY_CPUS:
		return value_cpus(r);
	case KEY_IDLE:
		return value_int(r, 0, 86400, &board->idle_s);
	case KEY_LANGUAGE:
		return value_language(r);
	case KEY_STATION:
		return value_station(r);
	case KEY_SERVICE_PIN:
		return value_service_pin(r);
	case KEY_TABLET:
		return value_tablet(r);
	case KEY_TABLET_MM:
		return value_size_mm(r, &board->tablet_width_mm, &board->tablet_height_mm);
	case KEY_TABLET_ROTATION:
		return value_rotation(r, &board->mount.degrees);
	case KEY_PEN_DISPLAY:
		return value_display(r);
	case KEY_CALIBRATION:
		return value_calibration(r);
	case KEY_CROSSES:
		return value_crosses(r);
	case KEY_COUNT:
		break;
	}
	return false;
}

static bool blank(char c)
{
	return c == ' ' || c == '\t' || c == '\r';
}

/* The text from `at` to `end` without blanks around it; false when it does not fit or holds control
 * characters. */
static bool word_copy(char *word, size_t capacity, const char *at, const char *end)
{
	while (at < end && blank(*at))
		at++;
	while (end > at && blank(end[-1]))
		end--;
	size_t size = (size_t)(end - at);
	if (size >= capacity)
		return false;
	memcpy(word, at, size);
	word[size] = 0;
	for (size_t i = 0; i < size; i++)
		if ((unsigned char)word[i] < 0x20 || word[i] == 0x7f)
			return false;
	return true;
}

static bool line_read(struct reader *r, const char *at, const char *end)
{
	const char *comment = memchr(at, '#', (size_t)(end - at));
	end = comment ? comment : end;
	while (at < end && blank(*at))
		at++;
	if (at == end)
		return true;
	const char *equals = memchr(at, '=', (size_t)(end - at));
	if (!equals || !word_copy(r->key, sizeof r->key, at, equals) ||
	    !word_copy(r->value, sizeof r->value, equals + 1, end) || !r->value[0]) {
		snprintf(r->fault, 200, "line %d: a line reads like key = value", r->line);
		return false;
	}
	for (int i = 0; i < KEY_COUNT; i++) {
		if (strcmp(r->key, key_names[i]))
			continue;
		if (r->seen >> i & 1)
			return fault(r, "this key stands above already; leave one of them");
		r->seen |= 1u << i;
		return key_read(r, (enum key)i);
	}
	return fault(r, "unknown key; `kitsuke help board` lists them");
}

/* Two buttons on one line are a mistake in wiring or in writing. */
static bool lines_differ(struct reader *r)
{
	for (int i = 0; i < BUTTON_COUNT; i++)
		for (int k = 0; k < i; k++)
			if (r->board->button_line[i][0] &&
			    !strcmp(r->board->button_line[i], r->board->button_line[k])) {
				snprintf(r->fault, 200,
					 "line %d: %s and %s have the same GPIO line; give each "
					 "its own",
					 r->line, key_names[KEY_WRAP + k], key_names[KEY_WRAP + i]);
				return false;
			}
	return true;
}

bool board_read_over(struct board *board, const char *text, size_t size, char fault_text[200])
{
	struct board before = *board;
	struct reader r = {.board = board, .fault = fault_text};
	fault_text[0] = 0;
	bool sound = size <= BOARD_TEXT_MAX;
	if (!sound)
		snprintf(fault_text, 200, "line 1: a board file has at most 64 KiB; is this one?");
	const char *at = text, *end = text + size;
	while (sound && at < end) {
		const char *newline = memchr(at, '\n', (size_t)(end - at));
		const char *stop = newline ? newline : end;
		r.line++;
		sound = line_read(&r, at, stop);
		at = newline ? newline + 1 : end;
	}
	sound = sound && lines_differ(&r);
	if (!sound)
		*board = before;
	return sound;
}

bool board_read(struct board *board, const char *text, size_t size, char fault_text[200])
{
	*board = board_default;
	return board_read_over(board, text, size, fault_text);
}

/* ---- what the operator sets ---- */

static bool same_crosses(const struct pen_mount *a, const struct pen_mount *b)
{
	return a->cross_count == b->cross_count &&
	       !memcmp(a->cross, b->cross, (size_t)a->cross_count * sizeof a->cross[0]);
}

static int pixels_write(char *text, int hundredths)
{
	return snprintf(text, 16, " %d.%02d", hundredths / 100, hundredths % 100);
}

static int crosses_write(char *text, const struct pen_mount *mount)
{
	int at = sprintf(text, "calibration =%s", mount->cross_count ? "" : " none");
	for (int i = 0; i < mount->cross_count; i++) {
		const struct pen_cross *cross = &mount->cross[i];
		at += pixels_write(text + at, cross->seen_x);
		at += pixels_write(text + at, cross->seen_y);
		at += pixels_write(text + at, cross->meant_x);
		at += pixels_write(text + at, cross->meant_y);
	}
	return at + sprintf(text + at, "\n");
}

int board_write_over(const struct board *base, const struct board *now, char text[BOARD_OVER_MAX])
{
	int at = sprintf(text, "# Set on the service page; what stands here lies over the board "
			       "file.\n");
	if (now->language != base->language)
		at += sprintf(text + at, "language = %s\n", language_words[now->language]);
	if (now->idle_s != base->idle_s)
		at += sprintf(text + at, "idle_s = %d\n", now->idle_s);
	if (now->mount.degrees != base->mount.degrees)
		at += sprintf(text + at, "tablet_rotation = %d\n", now->mount.degrees);
	if (!same_crosses(&now->mount, &base->mount))
		at += crosses_write(text + at, &now->mount);
	return at;
}
