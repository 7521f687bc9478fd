/* Makers' protocols, report by report and byte by byte. */
#include "pen_identify.h"
#include "table.h"
#include "test.h"

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
	check_words();
	check_reports();
	check_reports_wacom();
	check_random();
	return test_end();
}
