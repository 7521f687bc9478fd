/* Real report descriptors, every field against what four independent decoders say. */
#include "pen.h"
#include "table.h"
#include "test.h"

#define DATA "../shared/data/hid/"

static struct table expected, descriptors, nonpen;

/* The descriptor with this hash as bytes; 0 when it is not in the table. */
static int descriptor_bytes(const struct table *table, int row, uint8_t bytes[DESCRIPTOR_BYTES_MAX])
{
	return table_hex(table_cell(table, row, "hex"), bytes, DESCRIPTOR_BYTES_MAX);
}

static int expected_int(int row, const char *column, int missing)
{
	const char *cell = table_cell(&expected, row, column);
	return *cell ? (int)strtol(cell, NULL, 0) : missing;
}

/* A field's first bit, as the table counts: without the id byte; -1 where there is none. */
static int bit_of(const struct pen_layout *layout, struct pen_field field)
{
	return field.size ? field.bit - (layout->report_id ? 8 : 0) : -1;
}

#define SAME(row, column, missing, value)                                                          \
	do {                                                                                       \
		int want = expected_int(row, column, missing), have = (value);                     \
		if (want != have) {                                                                \
			fprintf(stderr, "%s (id %s): %s is %d, expected %d\n",                     \
				table_cell(&expected, row, "name"),                                \
				table_cell(&expected, row, "report_id"), column, have, want);      \
			test_failures++;                                                           \
		}                                                                                  \
	} while (0)

static void compare_axes(int row, const struct pen_layout *l)
{
	SAME(row, "report_bits", 0, l->report_bits - (l->report_id ? 8 : 0));
	SAME(row, "x_bit", -1, bit_of(l, l->x));
	SAME(row, "x_size", 0, l->x.size);
	SAME(row, "min_x", 0, l->x.minimum);
	SAME(row, "max_x", 0, l->x.maximum);
	SAME(row, "y_bit", -1, bit_of(l, l->y));
	SAME(row, "y_size", 0, l->y.size);
	SAME(row, "min_y", 0, l->y.minimum);
	SAME(row, "max_y", 0, l->y.maximum);
	SAME(row, "pressure_bit", -1, bit_of(l, l->pressure));
	SAME(row, "pressure_size", 0, l->pressure.size);
	SAME(row, "min_pressure", 0, l->pressure.minimum);
	SAME(row, "max_pressure", 0, l->pressure.maximum);
	SAME(row, "tilt_x_bit", -1, bit_of(l, l->tilt_x));
	SAME(row, "tilt_x_size", 0, l->tilt_x.size);
	SAME(row, "tilt_min", 0, l->tilt_x.minimum);
	SAME(row, "tilt_max", 0, l->tilt_x.maximum);
	SAME(row, "twist_max", 0, l->twist.maximum);
}

static int secondary_tips;

static void compare_switches(int row, const struct pen_layout *l)
{
	if (l->absolute_mouse) { /* the table leaves the buttons of a mouse out */
		CHECK(l->tip.size == 1);
		return;
	}
	SAME(row, "tip_bit", -1, bit_of(l, l->tip));
	SAME(row, "inrange_bit", -1, bit_of(l, l->in_range));
	SAME(row, "invert_bit", -1, bit_of(l, l->invert));
	SAME(row, "eraser_bit", -1, bit_of(l, l->eraser));
	SAME(row, "barrel_bit", -1, bit_of(l, l->barrel));
	/* Where there is no Secondary Barrel Switch we take a Secondary Tip Switch; the table does
	 * not. */
	if (*table_cell(&expected, row, "barrel2_bit"))
		SAME(row, "barrel2_bit", -1, bit_of(l, l->barrel_2));
	else if (l->barrel_2.size)
		secondary_tips++;
	if (expected_int(row, "serial_bits", 0) <= 32)
		SAME(row, "serial_bits", 0, l->serial.size);
}

static int sizes_stated, sizes_doubted;

/* The table has what the unit and the physical range say, lies included. */
static void compare_size(int row, const struct pen_layout *l)
{
	int unit = expected_int(row, "unit", 0);
	float width = strtof(table_cell(&expected, row, "width_mm"), NULL);
	float height = strtof(table_cell(&expected, row, "height_mm"), NULL);
	if (l->width_mm <= 0.0f) {
		CHECK(l->height_mm <= 0.0f);
		sizes_doubted++;
		/* A size in cm or inches is doubted only where it cannot be true. */
		float finest = (float)l->x.maximum / width;
		CHECK((unit != 0x11 && unit != 0x13) || width < 50.0f || height < 30.0f ||
		      width > 900.0f || finest > 400.0f);
		return;
	}
	sizes_stated++;
	CHECK(unit == 0x11 || unit == 0x13);
	CHECK_NEAR(l->width_mm, width, 0.006);
	CHECK_NEAR(l->height_mm, height, 0.006);
}

static void compare_row(int row)
{
	static uint8_t bytes[DESCRIPTOR_BYTES_MAX];
	struct pen_layout layout[PEN_REPORTS_MAX];
	char reason[160];
	int at = table_find(&descriptors, "sha1", table_cell(&expected, row, "descriptor_sha1"));
	CHECK(at >= 0);
	int size = at < 0 ? 0 : descriptor_bytes(&descriptors, at, bytes);
	int count = pen_descriptor_read(bytes, size, layout, reason);
	int id = expected_int(row, "report_id", 0);
	for (int i = 0; i < count; i++) {
		if (layout[i].report_id != id)
			continue;
		bool mouse = !strcmp(table_cell(&expected, row, "kind"), "absmouse");
		CHECK(layout[i].absolute_mouse == mouse);
		compare_axes(row, &layout[i]);
		compare_switches(row, &layout[i]);
		compare_size(row, &layout[i]);
		return;
	}
	fprintf(stderr, "%s: no pen in report %d: %s\n", table_cell(&expected, row, "name"), id,
		reason);
	test_failures++;
}

/* Every layout found must stand in the table: nothing is taken for a pen that is none. */
static void check_no_more_than_expected(int at)
{
	static uint8_t bytes[DESCRIPTOR_BYTES_MAX];
	struct pen_layout layout[PEN_REPORTS_MAX];
	char reason[160];
	int count = pen_descriptor_read(bytes, descriptor_bytes(&descriptors, at, bytes), layout,
					reason);
	for (int i = 0; i < count; i++) {
		bool known = false;
		for (int row = 0; row < expected.rows; row++)
			known |= expected_int(row, "report_id", 0) == layout[i].report_id &&
				 !strcmp(table_cell(&expected, row, "descriptor_sha1"),
					 table_cell(&descriptors, at, "sha1"));
		if (!known) {
			fprintf(stderr, "%s: report %d is no pen\n",
				table_cell(&descriptors, at, "sha1"), layout[i].report_id);
			test_failures++;
		}
	}
}

static void check_nonpen(int row)
{
	static uint8_t bytes[DESCRIPTOR_BYTES_MAX];
	struct pen_layout layout[PEN_REPORTS_MAX];
	char reason[160] = "";
	int size = descriptor_bytes(&nonpen, row, bytes);
	int count = pen_descriptor_read(bytes, size, layout, reason);
	if (count || !*reason) {
		fprintf(stderr, "%s: report %d taken for a pen\n", table_cell(&nonpen, row, "file"),
			layout[0].report_id);
		test_failures++;
	}
}

/* --- what no shipped tablet has -------------------------------------------------------------- */

static int read_count(const uint8_t *bytes, int size, char reason[160])
{
	struct pen_layout layout[PEN_REPORTS_MAX];
	return pen_descriptor_read(bytes, size, layout, reason);
}

static void check_own_descriptors(void)
{
	struct pen_layout layout[PEN_REPORTS_MAX];
	char reason[160];
	CHECK(pen_descriptor_read(mouse_descriptor, mouse_descriptor_size, layout, reason) == 1);
	CHECK(layout[0].report_id == 0 && layout[0].report_bits == 56);
	CHECK(layout[0].tip.bit == 0 && layout[0].barrel.bit == 1 && layout[0].in_range.bit == 2);
	CHECK(layout[0].x.bit == 8 && layout[0].y.bit == 24 && layout[0].pressure.bit == 40);
	CHECK(layout[0].x.maximum == 32767 && layout[0].pressure.maximum == 4095);
	CHECK(read_count(buttons_descriptor, buttons_descriptor_size, reason) == 0);
}

static void check_hostile(void)
{
	static const struct {
		const char *hex, *reason;
	} cases[] = {
		{"", "1 to 4096 bytes"},
		{"a4a4a4a4a4", "nested Push"},
		{"b4", "Pop without Push"},
		{"c0", "End Collection"},
		{"a101", "not closed"},
		{"8500", "report id"},
		{"860001", "report id"},
		{"760101", "256 bits"},
		{"960130", "12288 fields"},
		{"1900 2affff", "12288 usages"},
		{"1905 2901", "ends before it begins"},
		{"a900", "delimiters"},
		{"fe", "long item"},
		{"fe0510 00", "long item"},
		{"27ffff", "cut off"},
		{"050d0902a101 7520960030 8102 8102 c0", "16 KiB"},
	};
	for (int i = 0; i < COUNT_OF(cases); i++) {
		uint8_t bytes[DESCRIPTOR_BYTES_MAX];
		char reason[160] = "";
		int size = table_hex(cases[i].hex, bytes, sizeof bytes);
		CHECK(read_count(bytes, size, reason) == 0);
		if (!strstr(reason, cases[i].reason)) {
			fprintf(stderr, "%s: \"%s\" does not say \"%s\"\n", cases[i].hex, reason,
				cases[i].reason);
			test_failures++;
		}
	}
	static uint8_t deep[2 * 40];
	char reason[160];
	for (int i = 0; i < COUNT_OF(deep); i++)
		deep[i] = i % 2 ? 1 : 0xa1;
	CHECK(read_count(deep, sizeof deep, reason) == 0 && strstr(reason, "32 deep"));
	CHECK(read_count(deep, DESCRIPTOR_BYTES_MAX + 1, reason) == 0);
}

/* A long item, a delimited set of usages, Push and Pop, a usage that brings its page, and a maximum
 * that looks negative. */
static void check_rare_items(void)
{
	static const char *hex = "050d 0902 a101 0920 a100 fe02aa1122"
				 "0942 a901 0932 0934 a900 0944 1500 2501 7501 9503 8102 9505 8103"
				 "a4 7510 9501 26409c 0b30000100 8102 0501 26a861 0931 8102 b4"
				 "9508 8103 c0 c0";
	uint8_t bytes[DESCRIPTOR_BYTES_MAX];
	struct pen_layout layout[PEN_REPORTS_MAX];
	char reason[160];
	int size = table_hex(hex, bytes, sizeof bytes);
	CHECK(pen_descriptor_read(bytes, size, layout, reason) == 1);
	CHECK(layout[0].x.maximum == 40000 && layout[0].y.maximum == 25000);
	CHECK(layout[0].in_range.bit == 1 && layout[0].barrel.bit == 2);
	CHECK(layout[0].report_bits == 48); /* after Pop eight fields are eight bits again */
}

/* A finger's position in the same report is not the pen's. */
static void check_mixed(void)
{
	static const char *hex =
		"050d 0901 a101 8503 0922 a102 0501 7510 9502 26ff0f 0930 0931 8102 c0"
		"050d 0920 a100 0942 7508 9501 2501 8102 0501 7510 9502 26ff0f"
		"0930 0931 8102 c0 c0";
	uint8_t bytes[DESCRIPTOR_BYTES_MAX];
	struct pen_layout layout[PEN_REPORTS_MAX];
	char reason[160];
	int size = table_hex(hex, bytes, sizeof bytes);
	CHECK(pen_descriptor_read(bytes, size, layout, reason) == 1);
	CHECK(layout[0].tip.bit == 40 && layout[0].x.bit == 48 && layout[0].report_bits == 80);
	CHECK(pen_descriptor_sound(bytes, size) && !pen_descriptor_sound(bytes, size - 1));
}

/* What the standard allows and no tablet at hand does: y before x, axes of 20 and 24 bits that
 * begin within a byte, sizes by exponents of a nibble or a whole byte, one report told in two
 * collections, a pen among a keyboard and a mouse, angles of a kind that is not read. */
static void check_unusual(void)
{
	static const struct {
		const char *hex;
		int id, x_bit, y_bit, x_size, x_maximum, pressure_bit, report_bits;
		float width_mm;
	} cases[] = {
		{"050d 0902 a101 0920 a100 0942 0944 0945 093c 0932 1500 2501 7501 9505 8102 9503"
		 "8103 0501 0931 0930 7518 9502 27a0860100 3500 46a00f 550e 6511 8102 050d 0930"
		 "7510 9501 26ff1f 8102 c0 c0",
		 0, 32, 8, 24, 100000, 56, 72, 400.0f},
		{"050d 0902 a101 8501 0920 a100 0942 0932 0944 0945 1500 2501 7501 9504 8102 0501"
		 "0930 0931 7514 9502 27ffff0f00 8102 050d 0930 750c 9501 26ff0f 8102 c0 c0",
		 1, 12, 32, 20, 1048575, 52, 64, 0.0f},
		{"050d 0902 a101 0942 1500 2501 7501 9501 8102 9507 8103 0501 0930 7510 9501 55fe"
		 "6511 3500 46ac1a 26ac1a 8102 0931 468810 268810 8102 c0",
		 0, 8, 24, 16, 6828, 0, 40, 682.8f},
		{"050d 0902 a101 8502 0920 a100 0942 0932 1500 2501 7501 9502 8102 9506 8103 c0 c0"
		 "050d 0902 a101 8502 0920 a100 0501 0930 0931 7510 9502 26ff7f 8102 c0 c0",
		 2, 16, 32, 16, 32767, 0, 48, 0.0f},
		{"0501 0906 a101 8501 0507 19e0 29e7 1500 2501 7501 9508 8102 c0 0501 0902 a101"
		 "8502 0901 a100 0509 1901 2903 9503 8102 9505 8103 0501 0930 0931 1581 257f 7508"
		 "9502 8106 c0 c0 050d 0902 a101 8503 0920 a100 0942 1500 2501 7501 9501 8102 9507"
		 "8103 0501 0930 0931 7510 9502 26ff7f 8102 c0 c0",
		 3, 16, 32, 16, 32767, 0, 48, 0.0f},
		{"050d 0902 a101 8505 0920 a100 0942 1500 2501 7501 9501 8102 9507 8103 0501 0930"
		 "0931 7510 9502 26ff7f 8102 050d 0930 093f 0940 9503 8102 c0 c0",
		 5, 16, 32, 16, 32767, 48, 96, 0.0f},
	};
	for (int i = 0; i < COUNT_OF(cases); i++) {
		uint8_t bytes[DESCRIPTOR_BYTES_MAX];
		struct pen_layout layout[PEN_REPORTS_MAX];
		char reason[160];
		int size = table_hex(cases[i].hex, bytes, sizeof bytes);
		CHECK(pen_descriptor_read(bytes, size, layout, reason) == 1);
		CHECK(layout[0].report_id == cases[i].id && layout[0].tip.size == 1);
		CHECK(layout[0].x.bit == cases[i].x_bit && layout[0].y.bit == cases[i].y_bit);
		CHECK(layout[0].x.size == cases[i].x_size);
		CHECK(layout[0].x.maximum == cases[i].x_maximum);
		CHECK(layout[0].pressure.bit == cases[i].pressure_bit);
		CHECK(layout[0].report_bits == cases[i].report_bits);
		CHECK(!layout[0].tilt_x.size);
		CHECK_NEAR(layout[0].width_mm, cases[i].width_mm, 0.01);
	}
}

/* A layout's fields lie within its report, whatever the descriptor said. */
static void check_sane(const uint8_t *bytes, int size)
{
	struct pen_layout layout[PEN_REPORTS_MAX];
	char reason[160] = "";
	int count = pen_descriptor_read(bytes, size, layout, reason);
	bool sane = count >= 0 && count <= PEN_REPORTS_MAX && (count || reason[0]);
	for (int i = 0; i < count; i++) {
		const struct pen_layout *l = &layout[i];
		sane &= l->report_bits <= 8 * REPORT_BYTES_MAX && l->x.maximum > l->x.minimum;
		sane &= l->x.bit + l->x.size <= l->report_bits;
		sane &= l->y.bit + l->y.size <= l->report_bits;
		sane &= l->pressure.bit + l->pressure.size <= l->report_bits;
	}
	if (!sane) {
		fprintf(stderr, "%d bytes of a damaged descriptor: %d layouts\n", size, count);
		test_failures++;
	}
}

static long damaged;

/* Each real descriptor cut at every byte, and every byte set to eight values: read or refused,
 * never trusted half. */
static void check_damage(const struct table *table, int at)
{
	static const uint8_t values[8] = {0x00, 0x01, 0x7f, 0x80, 0xff, 0xa1, 0xc0, 0xfe};
	static uint8_t bytes[DESCRIPTOR_BYTES_MAX];
	int size = descriptor_bytes(table, at, bytes);
	for (int i = 1; i < size; i++)
		check_sane(bytes, i);
	for (int i = 0; i < size; i++) {
		uint8_t kept = bytes[i];
		for (int v = 0; v < COUNT_OF(values); v++) {
			bytes[i] = values[v];
			check_sane(bytes, size);
		}
		bytes[i] = kept;
	}
	damaged += 9L * size - 1;
}

/* What the documents state. */
static void print_table(void)
{
	int refused = 0, wrong = test_failures;
	for (int row = 0; row < nonpen.rows; row++) {
		static uint8_t bytes[DESCRIPTOR_BYTES_MAX];
		char reason[160];
		refused += !read_count(bytes, descriptor_bytes(&nonpen, row, bytes), reason);
	}
	printf("descriptors: %d of %d rows of pens right, %d wrong; %d of %d others refused; %ld "
	       "damaged ones read or refused\n",
	       wrong ? 0 : expected.rows, expected.rows, wrong, refused, nonpen.rows, damaged);
}

int main(void)
{
	check_own_descriptors();
	check_hostile();
	check_rare_items();
	check_mixed();
	check_unusual();
	if (!table_read(&expected, DATA "expected.csv", ',') ||
	    !table_read(&descriptors, DATA "descriptors.tsv", '\t') ||
	    !table_read(&nonpen, DATA "descriptors_nonpen.tsv", '\t')) {
		printf("skip: no recorded descriptors at " DATA "\n");
		return test_failures ? EXIT_FAILURE : 77;
	}
	CHECK(expected.rows > 300 && nonpen.rows > 200);
	for (int row = 0; row < expected.rows; row++)
		compare_row(row);
	for (int row = 0; row < descriptors.rows; row++)
		check_no_more_than_expected(row);
	for (int row = 0; row < nonpen.rows; row++)
		check_nonpen(row);
	for (int row = 0; row < descriptors.rows; row++)
		check_damage(&descriptors, row);
	for (int row = 0; row < nonpen.rows; row++)
		check_damage(&nonpen, row);
	print_table();
	CHECK(secondary_tips > 0 && secondary_tips < 20);
	CHECK(sizes_stated > 250 && sizes_doubted > 20);
	return test_end();
}
