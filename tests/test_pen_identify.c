/* Which tablet gets which maker's protocol: all identifiers that OpenTabletDriver knows, all
 * recorded string answers, and blocks of parameters that are damaged. The tables of the documents
 * come out with VERBOSE=1. */
#include "pen_setup.h"
#include "shape_bytes.h"
#include "test.h"

#define DATA "../shared/data/hid/"

static bool verbose;

/* --- every identifier ------------------------------------------------------------------------- */

static struct table models;

static long cell_int(const struct table *table, int row, const char *column, long missing)
{
	const char *cell = table_cell(table, row, column);
	return *cell ? strtol(cell, NULL, 0) : missing;
}

static bool begins(const char *text, const char *with)
{
	return !strncmp(text, with, strlen(with));
}

/* Some rows are the reports as Windows' own Wacom driver hands them out, with a byte before. */
static bool by_windows(int row)
{
	const char *parser = table_cell(&models, row, "parser");
	return begins(parser, "WacomDriver") || begins(parser, "Wacom64b") ||
	       (begins(parser, "SkipByte") && cell_int(&models, row, "max_pressure", 0) <= 511);
}

/* A Graphire or a Bamboo of its time, by the pressure's bits and the length. */
static bool graphire(int row)
{
	return cell_int(&models, row, "input_report_len", 0) - by_windows(row) <= 9 &&
	       cell_int(&models, row, "max_pressure", 0) <= 511;
}

/* The family that OpenTabletDriver's parser stands for; PEN_FAMILIES: none of ours. */
static enum pen_family family_of_parser(int row)
{
	static const struct {
		const char *parser;
		enum pen_family family;
	} known[] = {
		{"Giano", PEN_UCLOGIC_2},
		{"HuionTilt", PEN_UCLOGIC_2},
		{"Inspiroy", PEN_UCLOGIC_2},
		{"UCLogicV2", PEN_UCLOGIC_2},
		{"UCLogicTilt", PEN_UCLOGIC_2},
		{"UCLogic", PEN_UCLOGIC_2},
		{"XP_Pen", PEN_UGEE_2},
		{"XenceLabs", PEN_UGEE_2},
		{"Veikk", PEN_VEIKK},
		{"Acepen", PEN_VEIKK},
		{"Graphire", PEN_GRAPHIRE},
		{"BambooPad", PEN_FAMILIES},
		{"Bamboo", PEN_GRAPHIRE},
		{"IntuosV2", PEN_INTUOS_PRO_2},
		{"IntuosV3", PEN_INTUOS_PRO_3},
		{"IntuosReport", PEN_BAMBOO},
		{"Intuos", PEN_INTUOS},
		{"CintiqV1", PEN_INTUOS},
		{"PTU", PEN_PTU},
		{"PL", PEN_PL},
	};
	const char *parser = table_cell(&models, row, "parser");
	parser += begins(parser, "WacomDriver") ? strlen("WacomDriver") : 0;
	long in = cell_int(&models, row, "input_report_len", 0);
	bool first = in == 8 || in == 16;
	bool strings = *table_cell(&models, row, "init_strings");
	bool told = *table_cell(&models, row, "output_init_hex");
	if (begins(parser, "TabletReport") && strings)
		return first || in == 10 ? PEN_UCLOGIC_1 : PEN_UCLOGIC_2;
	if (begins(parser, "SkipByte"))
		return by_windows(row) ? PEN_GRAPHIRE : PEN_VEIKK;
	if (begins(parser, "Wacom64b"))
		return PEN_INTUOS;
	for (int i = 0; i < COUNT_OF(known); i++) {
		if (!begins(parser, known[i].parser))
			continue;
		if (known[i].family == PEN_UCLOGIC_2 && first)
			return PEN_UCLOGIC_1;
		if (known[i].family == PEN_UGEE_2 && !told)
			return PEN_UCLOGIC_1;
		/* what one parser reads there are two protocols for */
		if (known[i].family == PEN_BAMBOO && graphire(row))
			return PEN_GRAPHIRE;
		return known[i].family;
	}
	return PEN_FAMILIES;
}

static void put_shape(struct shape_bytes *shape, int row, enum pen_family family)
{
	int in = (int)cell_int(&models, row, "input_report_len", 10) - by_windows(row);
	int out = (int)cell_int(&models, row, "output_report_len", 0);
	in = in > 192 ? 64 : in;
	out = out > 192 ? 64 : out;
	put(shape, "0501 0902 a101 8501 0901 a100 0509 1901 2903 1500 2501 7501 9503 8102 9505 8103"
		   "0501 0930 0931 1581 257f 7508 9502 8106 c0c0");
	if (family == PEN_UCLOGIC_1)
		put_uclogic_1(shape);
	else if (family == PEN_UCLOGIC_2)
		put_opaque(shape, 0xff00, 1, 8, in, 0);
	else if (family == PEN_UGEE_2)
		put_opaque(shape, 0xff0a, 1, 2, in, out);
	else if (family == PEN_VEIKK)
		put_opaque(shape, 0xff0a, 1, 9, in < 9 ? 9 : in, out);
	else if (family == PEN_INTUOS_PRO_2)
		put_opaque(shape, 0xff0d, 1, 0x10, in, 0);
	else if (family == PEN_INTUOS_PRO_3)
		put_opaque(shape, 0xff0d, 1, 0x1f, in, 0);
	else
		put_opaque(shape, 0x0d, 1, 2, in, 0);
}

static void answer(struct pen_answers *answers, int index, int size, const uint8_t *bytes)
{
	answers->answer[answers->count].string_index = (uint8_t)index;
	answers->answer[answers->count].size = size;
	memcpy(answers->answer[answers->count++].bytes, bytes, (size_t)size);
}

static void answer_words(struct pen_answers *answers, int index, const char *words)
{
	uint8_t bytes[PEN_ANSWER_MAX] = {(uint8_t)(2 + 2 * strlen(words)), 3};
	for (size_t i = 0; words[i]; i++)
		bytes[2 + 2 * i] = (uint8_t)words[i];
	answer(answers, index, bytes[0], bytes);
}

/* Words that a row's pattern matches: the pattern without its signs, a date for \d{6}. */
static void pattern_words(const char *pattern, size_t length, char *words)
{
	for (size_t i = 0; i < length; i++) {
		if (begins(pattern + i, "\\d{")) {
			int digits = pattern[i + 3] - '0';
			memcpy(words, "170101", (size_t)digits);
			words += digits;
			i += 4;
		} else if (pattern[i] == '(') {
			size_t end = i;
			i += begins(pattern + i, "(?:") ? 2 : 0;
			while (pattern[end] != '|' && pattern[end] != ')')
				end++;
			for (i++; i < end; i++)
				*words++ = pattern[i];
			while (pattern[i] != ')')
				i++;
		} else if (!strchr("^$\\", pattern[i])) {
			*words++ = pattern[i];
		}
	}
	*words = 0;
}

static void answer_strings(struct pen_answers *answers, int row)
{
	const char *at = table_cell(&models, row, "device_strings");
	while (*at) {
		char words[128];
		char *equals;
		long index = strtol(at, &equals, 10);
		const char *pattern = equals + 1, *end = pattern;
		int open = 0;
		for (; *end && (*end != '|' || open); end++)
			open += *end == '(' ? 1 : *end == ')' ? -1 : 0;
		if (!strstr(pattern, "(?!") && !strstr(pattern, "x00")) {
			pattern_words(pattern, (size_t)(end - pattern), words);
			answer_words(answers, (int)index, words);
		}
		at = *end ? end + 1 : end;
	}
}

/* The block that a tablet with the row's ranges would have. */
static void answer_block(struct pen_answers *answers, int row, int index)
{
	long x = cell_int(&models, row, "max_x", 0), y = cell_int(&models, row, "max_y", 0);
	long p = cell_int(&models, row, "max_pressure", 0);
	double mm = strtod(table_cell(&models, row, "width_mm"), NULL);
	int lines = (int)((double)x / mm * 25.4 + 0.5);
	uint8_t first[12] = {
		12, 3, (uint8_t)x, (uint8_t)(x >> 8), (uint8_t)y,     (uint8_t)(y >> 8),
		3,  0, (uint8_t)p, (uint8_t)(p >> 8), (uint8_t)lines, (uint8_t)(lines >> 8)};
	uint8_t second[18] = {18,
			      3,
			      (uint8_t)x,
			      (uint8_t)(x >> 8),
			      (uint8_t)(x >> 16),
			      (uint8_t)y,
			      (uint8_t)(y >> 8),
			      (uint8_t)(y >> 16),
			      (uint8_t)p,
			      (uint8_t)(p >> 8),
			      (uint8_t)lines,
			      (uint8_t)(lines >> 8)};
	if (index == 200)
		answer(answers, index, sizeof second, second);
	else
		answer(answers, index, sizeof first, first);
}

static int right, refused, wrong, not_ours;

static void check_model(int row, bool blocks)
{
	struct shape_bytes shape = {0};
	struct pen_answers answers = {0};
	struct pen_identity identity = {
		.bus = 3,
		.vendor = (int)strtol(table_cell(&models, row, "vid"), NULL, 16),
		.product = (int)strtol(table_cell(&models, row, "pid"), NULL, 16),
		.driver = "hid-generic",
		.descriptor = shape.bytes,
	};
	struct pen_recipe recipe;
	struct pen_vendor vendor = {PEN_BY_DESCRIPTOR, 0, 0, 0};
	float width_mm = 0.0f, height_mm = 0.0f;
	char reason[160] = "";
	enum pen_family family = family_of_parser(row);
	put_shape(&shape, row, family);
	identity.descriptor_size = shape.size;
	CHECK(pen_descriptor_sound(shape.bytes, shape.size));
	answer_strings(&answers, row);
	if (family == PEN_UCLOGIC_2)
		answer_block(&answers, row, 200);
	else if (family == PEN_UCLOGIC_1 || (family == PEN_UGEE_2 && blocks))
		answer_block(&answers, row, 100);
	bool known = pen_identify(&identity, &recipe, reason) &&
		     pen_identify_end(&identity, &recipe, &answers, &vendor, &width_mm, &height_mm,
				      reason);
	bool same = vendor.x_maximum == cell_int(&models, row, "max_x", 0) &&
		    vendor.y_maximum == cell_int(&models, row, "max_y", 0) &&
		    vendor.pressure_maximum == cell_int(&models, row, "max_pressure", 0);
	double mm = strtod(table_cell(&models, row, "width_mm"), NULL);
	bool sized = (double)width_mm > mm - 3.0 && (double)width_mm < mm + 3.0;
	const char *verdict = !known                    ? "refused"
			      : family != vendor.family ? "WRONG family"
			      : !same                   ? "WRONG ranges"
			      : !sized                  ? "WRONG size"
							: "right";
	if (!known) {
		refused++;
		not_ours += family == PEN_FAMILIES;
		CHECK(*reason && vendor.family == PEN_BY_DESCRIPTOR);
	} else if (*verdict == 'W') {
		wrong++;
	} else {
		right++;
	}
	if (verbose || *verdict == 'W')
		printf("%s:%s %s, %s bytes: %s%s%s (%d x %d, %d; %.1f x %.1f mm) %s\n",
		       table_cell(&models, row, "vid"), table_cell(&models, row, "pid"),
		       table_cell(&models, row, "name"),
		       table_cell(&models, row, "input_report_len"), verdict, known ? ", " : "",
		       known ? pen_family_rule(vendor.family)->word : "", vendor.x_maximum,
		       vendor.y_maximum, vendor.pressure_maximum, (double)width_mm,
		       (double)height_mm, known ? "" : reason);
}

static void check_models(bool blocks)
{
	right = refused = wrong = not_ours = 0;
	for (int row = 0; row < models.rows; row++)
		check_model(row, blocks);
	printf("identifiers, %s parameter blocks of XP-Pen: %d of %d right, %d wrong, %d refused "
	       "(%d of other protocols)\n",
	       blocks ? "with" : "without", right, models.rows, wrong, refused, not_ours);
	CHECK(wrong == 0 && right >= (blocks ? 464 : 458));
}

/* --- recorded answers ------------------------------------------------------------------------- */

static struct table probes;

/* The tablet as its interface 0 would be: with both generations' reports. */
static void check_probe(int row, int counts[3])
{
	struct shape_bytes shape = {0};
	struct pen_answers answers = {0};
	uint8_t bytes[PEN_ANSWER_MAX];
	struct pen_recipe recipe;
	struct pen_vendor vendor;
	float width_mm, height_mm;
	char reason[160] = "";
	put_opaque(&shape, 0xff00, 1, 8, 12, 0);
	put_uclogic_1(&shape);
	struct pen_identity identity = {3, 0x256c, 0x6d, "", shape.bytes, shape.size};
	if (*table_cell(&probes, row, "fw201"))
		answer_words(&answers, 201, table_cell(&probes, row, "fw201"));
	int size = table_hex(table_cell(&probes, row, "v1_hex"), bytes, sizeof bytes);
	bool cut = size < cell_int(&probes, row, "v1_len", 0); /* the table keeps 32 bytes */
	if (size && !cut)
		answer(&answers, 100, size, bytes);
	size = table_hex(table_cell(&probes, row, "v2_hex"), bytes, sizeof bytes);
	if (size)
		answer(&answers, 200, size, bytes);
	bool known = pen_identify(&identity, &recipe, reason) &&
		     pen_identify_end(&identity, &recipe, &answers, &vendor, &width_mm, &height_mm,
				      reason);
	bool between = !strcmp(table_cell(&probes, row, "fw201"), "HUION_T153_160607");
	bool second = cell_int(&probes, row, "v2_len", 0) >= 18 && !between &&
		      cell_int(&probes, row, "v2_text", 1) == 0;
	bool first = cell_int(&probes, row, "v1_len", 0) >= 12 &&
		     cell_int(&probes, row, "v1_max_x", 0) > 1000;
	counts[known ? vendor.family == PEN_UCLOGIC_2 : 2]++;
	if (verbose)
		printf("%s: %s %d x %d, %d: %.1f x %.1f mm %s\n", table_cell(&probes, row, "file"),
		       known ? pen_family_rule(vendor.family)->word : "refused",
		       known ? vendor.x_maximum : 0, known ? vendor.y_maximum : 0,
		       known ? vendor.pressure_maximum : 0, (double)width_mm, (double)height_mm,
		       known ? "" : reason);
	CHECK(known == (first || second));
	if (!known)
		return;
	CHECK((vendor.family == PEN_UCLOGIC_2) == second);
	CHECK(vendor.x_maximum == cell_int(&probes, row, second ? "v2_max_x" : "v1_max_x", 0));
	CHECK(vendor.y_maximum == cell_int(&probes, row, second ? "v2_max_y" : "v1_max_y", 0));
	CHECK(vendor.pressure_maximum ==
	      cell_int(&probes, row, second ? "v2_max_pressure" : "v1_max_pressure", 0));
}

static void check_probes(void)
{
	int counts[3] = {0};
	for (int row = 0; row < probes.rows; row++)
		check_probe(row, counts);
	printf("recorded answers: %d of %d by string 100, %d by string 200, %d refused\n",
	       counts[0], probes.rows, counts[1], counts[2]);
}

/* Blocks cut, prolonged and with every byte changed: a block or a reason, and sane ranges. */
static void check_blocks(void)
{
	static const uint8_t second[18] = {18, 3,    0x70, 0xc6, 0,    6, 0x7c,
					   0,  0xff, 0x1f, 0xd8, 0x13, 3};
	struct pen_block block;
	char reason[160];
	CHECK(pen_block_2_read(second, 18, &block, reason) && block.x_maximum == 50800);
	for (int size = 0; size < 18; size++)
		CHECK(!pen_block_2_read(second, size, &block, reason) && reason[0]);
	for (int at = 0; at < 18; at++)
		for (int value = 0; value < 256; value++) {
			uint8_t bytes[18];
			memcpy(bytes, second, sizeof bytes);
			bytes[at] = (uint8_t)value;
			if (pen_block_2_read(bytes, 18, &block, reason))
				CHECK(block.lines_per_inch > 0 && block.x_maximum < 1 << 24);
			if (pen_block_1_read(bytes, 18, &block, reason))
				CHECK(block.x_maximum < 1 << 16);
		}
	/* a tablet's name, as one answers to any string it does not know */
	uint8_t name[PEN_ANSWER_MAX];
	int length = table_hex("0e03 5400 6100 6200 6c00 6500 7400", name, sizeof name);
	CHECK(!pen_block_1_read(name, length, &block, reason) && strstr(reason, "text"));
	uint8_t wrong_type[18];
	memcpy(wrong_type, second, sizeof wrong_type);
	wrong_type[1] = 0x0e;
	CHECK(!pen_block_2_read(wrong_type, 18, &block, reason) && strstr(reason, "type 14"));
}

int main(void)
{
	verbose = getenv("VERBOSE") != NULL;
	check_blocks();
	if (!table_read(&models, DATA "vendor_models.csv", ',') ||
	    !table_read(&probes, DATA "uclogic_probe.csv", ',')) {
		printf("skip: no tables at " DATA "\n");
		return test_failures ? EXIT_FAILURE : 77;
	}
	check_models(true);
	check_models(false);
	check_probes();
	return test_end();
}
