/* Makers' protocols: which tablet gets which (all identifiers that OpenTabletDriver knows, all
 * recorded string answers), what a set-up makes of faults, and reports byte by byte. The tables of
 * the documents come out with VERBOSE=1. */
#include "pen_setup.h"
#include "table.h"
#include "test.h"

#define DATA "../shared/data/hid/"

static bool verbose;

/* --- descriptors in the shapes that families have ----------------------------------------------
 */

struct shape_bytes {
	int size;
	uint8_t bytes[256];
};

static void put(struct shape_bytes *shape, const char *hex)
{
	shape->size += table_hex(hex, shape->bytes + shape->size,
				 sizeof shape->bytes - (size_t)shape->size);
}

/* An application with one opaque input report and, where out is given, an output report. */
static void put_opaque(struct shape_bytes *shape, int page, int usage, int id, int in, int out)
{
	char hex[160];
	snprintf(hex, sizeof hex, "06%02x%02x 09%02x a101 85%02x 0901 150026ff00 7508 95%02x 8102",
		 page & 0xff, page >> 8, usage, id, in - 1);
	put(shape, hex);
	snprintf(hex, sizeof hex, "0902 95%02x 9102", out - 1);
	if (out > 1)
		put(shape, hex);
	put(shape, "c0");
}

/* Report 7 and report 9 of the first UC-Logic tablets: a pen and an absolute mouse. */
static void put_uclogic_1(struct shape_bytes *shape)
{
	put(shape, "050d 0902 a101 8507 0920 a100 0942 0944 0945 1500 2501 7501 9503 8102 9503 8103"
		   "0932 9501 8102 9501 8103 0501 0930 0931 7510 9502 26007d 8102 050d 0930 26ff07"
		   "9501 8102 c0c0");
	put(shape, "0501 0902 a101 8509 0901 a100 0509 1901 2903 1500 2501 7501 9503 8102 9505 8103"
		   "0501 0930 0931 7510 9502 26ff7f 8102 050d 0930 26ff07 9501 8102 c0c0");
}

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

/* --- set-up through a transport that misbehaves ------------------------------------------------
 */

struct fake {
	int silent, refused; /* so many transfers come to nothing, then all works */
	int error;
	bool short_answers, long_answers, stalls_all;
	int strings, outputs, features, last_output_size;
	uint8_t mode[2], output[64];
	uint8_t block[18];
	int stop_after; /* 0: never */
};

static int fault_now(struct fake *fake)
{
	if (fake->stalls_all)
		return fake->error;
	if (fake->silent-- > 0)
		return -PEN_SETUP_TIMEOUT;
	return fake->refused-- > 0 ? -PEN_SETUP_REFUSED : 0;
}

static int fake_string(void *context, int index, uint8_t *bytes, int capacity)
{
	struct fake *fake = context;
	int fault = fault_now(fake);
	fake->strings++;
	if (fault || fake->stalls_all)
		return fault;
	if (fake->long_answers) {
		memset(bytes, 0xff, (size_t)capacity);
		return 4 * capacity; /* a transport that lies */
	}
	if (index != 200)
		return -PEN_SETUP_REFUSED;
	int size = fake->short_answers ? 5 : 18;
	memcpy(bytes, fake->block, (size_t)size);
	return size;
}

static int fake_output(void *context, const uint8_t *bytes, int size)
{
	struct fake *fake = context;
	int fault = fault_now(fake);
	fake->outputs++;
	if (fault)
		return fault;
	memcpy(fake->output, bytes, (size_t)size);
	fake->last_output_size = size;
	return fake->short_answers ? size - 1 : size;
}

static int fake_feature(void *context, const uint8_t *bytes, int size)
{
	struct fake *fake = context;
	int fault = fault_now(fake);
	if (fault)
		return fault;
	if (++fake->features >= 2) /* takes it the second time */
		memcpy(fake->mode, bytes, (size_t)size);
	return size;
}

static int fake_feature_get(void *context, uint8_t *bytes, int size)
{
	struct fake *fake = context;
	memcpy(bytes, fake->mode, (size_t)size);
	return size;
}

static bool fake_stopped(void *context)
{
	const struct fake *fake = context;
	return fake->stop_after && fake->strings >= fake->stop_after;
}

static struct pen_setup_result set_up(struct fake *fake, struct shape_bytes *shape, int vendor,
				      int product)
{
	static const uint8_t block[18] = {18, 3,    0x70, 0xc6, 0,    6, 0x7c,
					  0,  0xff, 0x1f, 0xd8, 0x13, 3};
	struct pen_transport transport = {fake,         fake_string,      fake_output,
					  fake_feature, fake_feature_get, fake_stopped};
	struct pen_identity identity = {3,          vendor, product, "hid-generic", shape->bytes,
					shape->size};
	struct pen_setup_result result = {0};
	struct pen_recipe recipe;
	char reason[160];
	memcpy(fake->block, block, sizeof block);
	CHECK(pen_identify(&identity, &recipe, reason));
	pen_setup(&identity, &recipe, &transport, &result);
	CHECK(result.done || result.reason[0]);
	CHECK(result.done || result.vendor.family == PEN_BY_DESCRIPTOR);
	CHECK(result.tries <= 5 * PEN_STEPS_MAX);
	return result;
}

static void check_setup_strings(void)
{
	struct shape_bytes shape = {0};
	put_opaque(&shape, 0xff00, 1, 8, 12, 0);
	struct fake fake = {0};
	struct pen_setup_result r = set_up(&fake, &shape, 0x256c, 0x6d);
	CHECK(r.done && r.vendor.family == PEN_UCLOGIC_2 && r.vendor.x_maximum == 50800);
	CHECK_NEAR(r.width_mm, 254.0, 0.01);
	CHECK(fake.strings == 3 && fake.outputs == 0); /* 201, 200, 202, and no more */
	r = set_up(&fake, &shape, 0x256c, 0x6d);
	CHECK(r.done); /* once more does no harm */

	fake = (struct fake){.silent = 2}; /* 201 comes the third time */
	CHECK(set_up(&fake, &shape, 0x256c, 0x6d).done && fake.strings == 5);
	fake = (struct fake){.silent = 5}; /* 201 never, 200 the third time */
	CHECK(set_up(&fake, &shape, 0x256c, 0x6d).done);
	fake = (struct fake){.stalls_all = true, .error = -PEN_SETUP_TIMEOUT};
	CHECK(!set_up(&fake, &shape, 0x256c, 0x6d).done && fake.strings == 15);
	fake = (struct fake){.stalls_all = true, .error = -PEN_SETUP_REFUSED};
	CHECK(!set_up(&fake, &shape, 0x256c, 0x6d).done && fake.strings == 5);
	fake = (struct fake){.stalls_all = true, .error = -PEN_SETUP_GONE};
	r = set_up(&fake, &shape, 0x256c, 0x6d);
	CHECK(!r.done && r.gone && fake.strings == 1);
	fake = (struct fake){.short_answers = true};
	CHECK(!set_up(&fake, &shape, 0x256c, 0x6d).done);
	fake = (struct fake){.long_answers = true};
	CHECK(!set_up(&fake, &shape, 0x256c, 0x6d).done);
	fake = (struct fake){.stop_after = 1};
	r = set_up(&fake, &shape, 0x256c, 0x6d);
	CHECK(!r.done && strstr(r.reason, "went away"));
	fake = (struct fake){.stalls_all = true, .error = 0}; /* nothing, and no error */
	CHECK(!set_up(&fake, &shape, 0x256c, 0x6d).done);
}

static void check_setup_bytes(void)
{
	struct shape_bytes ugee = {0}, wacom = {0};
	struct fake fake = {0};
	put_opaque(&ugee, 0xff0a, 1, 2, 12, 20);
	struct pen_setup_result r = set_up(&fake, &ugee, 0x28bd, 0x0937);
	CHECK(r.done && r.vendor.family == PEN_UGEE_2 && r.vendor.x_maximum == 31998);
	CHECK(fake.last_output_size == 20 && !memcmp(fake.output, "\x02\xb0\x04\x00", 4));
	fake = (struct fake){.short_answers = true};
	r = set_up(&fake, &ugee, 0x28bd, 0x0937);
	CHECK(!r.done && strstr(r.reason, "02 b0 04") && fake.outputs == 3);
	fake = (struct fake){.silent = 2};
	CHECK(set_up(&fake, &ugee, 0x28bd, 0x0937).done);
	CHECK(!set_up(&fake, &ugee, 0x28bd, 0x7777).done); /* nobody knows its ranges */

	put_opaque(&wacom, 0x0d, 1, 2, 10, 0);
	fake = (struct fake){0};
	r = set_up(&fake, &wacom, 0x056a, 0x00b8);
	CHECK(r.done && r.vendor.family == PEN_INTUOS && fake.features == 2);
	/* an old one that tells no mode is read all the same */
	fake = (struct fake){.stalls_all = true, .error = -PEN_SETUP_REFUSED};
	CHECK(set_up(&fake, &wacom, 0x056a, 0x00b8).done);
}

/* Without the shape, vendor and product say nothing. */
static void check_shape_decides(void)
{
	struct pen_recipe recipe;
	char reason[160];
	struct pen_identity mouse = {3, 0x256c, 0x6d, "", mouse_descriptor, mouse_descriptor_size};
	CHECK(!pen_identify(&mouse, &recipe, reason) && reason[0]);
	struct shape_bytes shape = {0};
	put_opaque(&shape, 0xff00, 1, 8, 12, 0);
	struct pen_identity pen = {3, 0x256c, 0x6d, "uclogic", shape.bytes, shape.size};
	CHECK(!pen_identify(&pen, &recipe, reason) && strstr(reason, "uclogic"));
	pen.driver = "hid-generic";
	CHECK(pen_identify(&pen, &recipe, reason));
	pen.bus = 5;
	CHECK(!pen_identify(&pen, &recipe, reason) && strstr(reason, "USB"));
	pen.bus = 3;
	pen.descriptor_size--;
	CHECK(!pen_identify(&pen, &recipe, reason));
}

/* --- reports ---------------------------------------------------------------------------------- */

static struct pen_memory memory;

static enum pen_decoded decode(enum pen_family family, const char *hex, struct pen_fields *f)
{
	uint8_t bytes[256];
	struct pen_vendor vendor = {family, 120000, 70000, 8191};
	if (family == PEN_GRAPHIRE || family == PEN_PL)
		vendor.pressure_maximum = 511;
	*f = (struct pen_fields){0};
	int size = table_hex(hex, bytes, sizeof bytes);
	return pen_family_rule(family)->read(bytes, size, &vendor, &memory, f);
}

static void check_reports(void)
{
	struct pen_fields f;
	memory = (struct pen_memory){0};
	CHECK(decode(PEN_UCLOGIC_2, "08 83 70c6 067c ff1f 01 01 f6 ec", &f) == PEN_DECODED);
	CHECK(f.x == 0x1c670 && f.y == 0x17c06 && f.pressure == 8191 && f.tip && f.barrel);
	CHECK(f.tilt_x == -10 && f.tilt_y == 20 && f.in_range && !f.barrel_2);
	CHECK(decode(PEN_UCLOGIC_2, "08 00 70c6 067c 0000 00 00 00 00", &f) == PEN_DECODED);
	CHECK(!f.in_range && !f.tip);
	CHECK(decode(PEN_UCLOGIC_2, "08 e0 0101 0100 0000 00 00 00 00", &f) == PEN_FOREIGN);
	CHECK(decode(PEN_UCLOGIC_2, "08 f1 0101 0100 0000 00 00 00 00", &f) == PEN_FOREIGN);
	CHECK(decode(PEN_UCLOGIC_2, "08 81 70c6 067c ff1f 00 00", &f) == PEN_CUT_OFF);

	/* version 1: away the other way round, the right way round, and Ugee's */
	memory = (struct pen_memory){0};
	CHECK(decode(PEN_UCLOGIC_1, "07 80 7e19 883d 0000", &f) == PEN_DECODED && f.in_range);
	CHECK(decode(PEN_UCLOGIC_1, "07 81 d924 d133 ff07", &f) == PEN_DECODED && f.in_range);
	CHECK(f.tip && f.x == 0x24d9 && f.y == 0x33d1 && f.pressure == 2047);
	CHECK(decode(PEN_UCLOGIC_1, "07 c0 d924 d133 0000", &f) == PEN_DECODED && !f.in_range);
	CHECK(decode(PEN_UCLOGIC_1, "07 c1 3b27 9817 2e02", &f) == PEN_DECODED && f.in_range);
	CHECK(decode(PEN_UCLOGIC_1, "07 80 1028 0318 0000", &f) == PEN_DECODED && !f.in_range);
	CHECK(decode(PEN_UCLOGIC_1, "07 a1 6f29 be1e 9007 0305", &f) == PEN_DECODED && f.in_range);
	CHECK(f.tilt_x == 3 && f.tilt_y == 5);
	CHECK(decode(PEN_UCLOGIC_1, "07 c0 6f29 be1e 0000", &f) == PEN_DECODED && !f.in_range);
	CHECK(decode(PEN_UCLOGIC_1, "07 e0 0101 2000 0000", &f) == PEN_FOREIGN);

	CHECK(decode(PEN_UGEE_2, "02 a9 0100 0200 ff3f 05fb 01 01", &f) == PEN_DECODED);
	CHECK(f.x == 0x10001 && f.y == 0x10002 && f.pressure == 8191 && f.tilt_y == -5);
	CHECK(f.tip && f.eraser && f.in_range);
	CHECK(decode(PEN_UGEE_2, "02 c0 0100 0200 0000", &f) == PEN_DECODED && !f.in_range);
	CHECK(decode(PEN_UGEE_2, "02 f0 0100 0000 0000 0000", &f) == PEN_FOREIGN);

	CHECK(decode(PEN_VEIKK, "09 41 a1 010001 020001 ff1f 0afe", &f) == PEN_DECODED);
	CHECK(f.x == 0x10001 && f.y == 0x10002 && f.pressure == 8191 && f.tilt_y == -2);
	CHECK(decode(PEN_VEIKK, "09 41 a1 0100 0200 ff1f", &f) == PEN_DECODED && f.y == 2);
	CHECK(decode(PEN_VEIKK, "09 41 c0 0100 0200 0000", &f) == PEN_DECODED && !f.in_range);
	CHECK(decode(PEN_VEIKK, "09 42 01 0100 0200 0000", &f) == PEN_FOREIGN);
}

static void check_reports_wacom(void)
{
	struct pen_fields f;
	memory = (struct pen_memory){0};
	CHECK(decode(PEN_INTUOS, "02 e0 1000 2000 00 4040 03", &f) ==
	      PEN_FOREIGN); /* no tool yet */
	CHECK(decode(PEN_INTUOS, "02 c2 8041 2345 67 81 00 00", &f) == PEN_DECODED);
	CHECK(f.in_range && f.x < 0 && memory.tool == 0x10804);
	CHECK(decode(PEN_INTUOS, "02 e1 1000 2000 ff e0 c0 03", &f) == PEN_DECODED);
	CHECK(f.x == 0x2001 && f.y == 0x4001 && f.pressure == (255 << 3 | 6 | 1) && f.tip);
	CHECK(f.tilt_x == 1 && f.tilt_y == 0 && !f.eraser);
	CHECK(decode(PEN_INTUOS, "02 20 0000 0000 00 00 00 00", &f) == PEN_DECODED && f.x < 0);
	CHECK(decode(PEN_INTUOS, "02 80 0000 0000 00 00 00 00", &f) == PEN_DECODED && !f.in_range);
	CHECK(decode(PEN_INTUOS, "02 c2 00a1 2345 67 80 00 00", &f) ==
	      PEN_DECODED); /* 00a: eraser */
	CHECK(decode(PEN_INTUOS, "02 e1 1000 2000 ff e0 c0 03", &f) == PEN_DECODED && f.eraser);
	CHECK(decode(PEN_INTUOS, "02 c2 0071 2345 67 80 00 00", &f) == PEN_FOREIGN); /* a mouse */
	memory = (struct pen_memory){0};
	for (int i = 0; i < 9; i++)
		CHECK(decode(PEN_INTUOS, "02 e0 1000 2000 00 4040 03", &f) == PEN_FOREIGN);
	CHECK(decode(PEN_INTUOS, "02 e0 1000 2000 00 4040 03", &f) == PEN_DECODED);

	CHECK(decode(PEN_BAMBOO, "02 e1 1000 2000 ff03 05", &f) == PEN_DECODED);
	CHECK(f.x == 16 && f.y == 32 && f.pressure == 1023 && f.tip && f.in_range);
	CHECK(decode(PEN_BAMBOO, "02 80 1000 2000 0000 05", &f) == PEN_DECODED && f.x < 0);
	CHECK(decode(PEN_BAMBOO, "02 00 0000 0000 0000 00", &f) == PEN_DECODED && !f.in_range);
	memory = (struct pen_memory){0};
	CHECK(decode(PEN_GRAPHIRE, "02 00 0000 0000 00 40", &f) == PEN_FOREIGN); /* buttons */
	CHECK(decode(PEN_GRAPHIRE, "02 a1 1000 2000 ff 01", &f) == PEN_DECODED && f.eraser);
	CHECK(f.pressure == 511 && f.x == 16 && f.in_range);
	CHECK(decode(PEN_GRAPHIRE, "02 00 0000 0000 00 00", &f) == PEN_DECODED && !f.in_range);
	CHECK(decode(PEN_DTUS, "11 81 f4 1000 2000", &f) == PEN_DECODED);
	CHECK(f.x == 0x1000 && f.y == 0x2000 && f.pressure == 0x1f4 && f.tip);
	CHECK(decode(PEN_DTU, "02 21 1000 2000 ff 01", &f) == PEN_DECODED && f.pressure == 511);
	CHECK(decode(PEN_PL, "02 41 01 02 0a 03 04 00", &f) == PEN_DECODED && f.tip);
	CHECK(f.x == (2 | 1 << 7 | 1 << 14) && f.y == (4 | 3 << 7 | 2 << 14) && f.pressure == 256);
	CHECK(decode(PEN_PTU, "02 21 1000 2000 ff01", &f) == PEN_DECODED && f.pressure == 511);
	CHECK(decode(PEN_PENPARTNER, "01 1000 2000 80 00", &f) == PEN_DECODED);
	CHECK(f.x == 16 && f.pressure == 127 && f.in_range);
	CHECK(decode(PEN_INTUOS_PRO_2, "10 21 010001 020001 ff1f 05fb", &f) == PEN_DECODED);
	CHECK(f.x == 0x10001 && f.y == 0x10002 && f.pressure == 8191 && f.tilt_x == 5);
	CHECK(decode(PEN_INTUOS_PRO_3, "1e 00 41 010001 020001 ff1f e803 18fc", &f) == PEN_DECODED);
	CHECK(f.x == 0x10001 && f.pressure == 8191 && f.tilt_x == 10 && f.tilt_y == -10);
	CHECK(decode(PEN_INTUOS_PRO_3, "1f 01 41 0100 0200 ff1f 05 00 fb", &f) == PEN_DECODED);
	CHECK(f.x == 1 && f.tilt_x == 5 && f.tilt_y == -5);
}

/* Any bytes of any length: no read behind the report (the sanitizers look), fields in bounds. */
static void check_random(void)
{
	uint32_t state = 1;
	struct pen_fields f;
	for (int family = PEN_BY_DESCRIPTOR + 1; family < PEN_FAMILIES; family++) {
		struct pen_vendor vendor = {(enum pen_family)family, 50800, 31750, 8191};
		const struct pen_family_rule *rule = pen_family_rule(vendor.family);
		static const uint8_t ids[] = {1, 2, 7, 8, 9, 0x10, 0x11, 0x1e, 0x1f};
		memory = (struct pen_memory){0};
		for (int i = 0; i < 20000; i++) {
			uint8_t bytes[20];
			for (int k = 0; k < COUNT_OF(bytes); k++) {
				state = state * 1664525u + 1013904223u;
				bytes[k] = (uint8_t)(state >> 24);
			}
			int size = (int)(state >> 8) % 21;
			bytes[0] = ids[i % COUNT_OF(ids)];
			uint8_t *exact = malloc((size_t)size + 1);
			memcpy(exact, bytes, (size_t)size);
			f = (struct pen_fields){0};
			enum pen_decoded decoded = rule->read(exact, size, &vendor, &memory, &f);
			CHECK(decoded != PEN_DECODED || (f.x >= -1 && f.x < 1 << 24));
			CHECK(f.pressure >= 0 && f.pressure < 1 << 16);
			free(exact);
		}
	}
}

static void check_words(void)
{
	for (int i = PEN_BY_DESCRIPTOR + 1; i < PEN_FAMILIES; i++) {
		const char *word = pen_family_rule((enum pen_family)i)->word;
		CHECK((int)pen_family_named(word, strlen(word)) == i);
	}
	CHECK(pen_family_named("nothing", 7) == PEN_FAMILIES);
	for (int i = 0; i < pen_model_count; i++) {
		const struct pen_model *m = &pen_models[i];
		struct pen_vendor vendor = {(enum pen_family)m->family, m->x_maximum, m->y_maximum,
					    m->pressure_maximum};
		CHECK(pen_vendor_sound(&vendor) && m->width_dmm > 300 && m->height_dmm > 200);
		CHECK(!m->string_index == !m->words);
	}
}

int main(void)
{
	verbose = getenv("VERBOSE") != NULL;
	check_words();
	check_blocks();
	check_setup_strings();
	check_setup_bytes();
	check_shape_decides();
	check_reports();
	check_reports_wacom();
	check_random();
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
