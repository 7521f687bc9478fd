/* Patterns as a code's text and back: every bundled journal, a full document, and texts that were
 * cut, changed or made up. `test_format_code JOURNAL...` prints figures of those. */
#include "scene.h"
#include "take_home_content.h"
#include "test.h"

#include <dirent.h>
#include <zlib.h>

enum { QR_25_M = 1451, QR_25_L = 1853 }; /* alphanumeric characters */

static struct code_content content, again;
static char text[CODE_TEXT_MAX];

static float far_apart(const struct v2 *a, const struct v2 *b, int count)
{
	float worst = 0.0f;
	for (int i = 0; i < count; i++)
		worst = float_max(worst, v2_distance(a[i], b[i]));
	return worst;
}

static bool same_piece(const struct piece *a, const struct piece *b, float mm)
{
	return a->swatch == b->swatch && a->inside_up == b->inside_up &&
	       a->worn_over == b->worn_over && a->point_count == b->point_count &&
	       !strcmp(a->name, b->name) && a->turn_rad == b->turn_rad &&
	       !memcmp(a->corner, b->corner, (size_t)a->point_count * sizeof a->corner[0]) &&
	       far_apart(&a->position_mm, &b->position_mm, 1) <= mm &&
	       far_apart(a->point_mm, b->point_mm, a->point_count) <= mm;
}

/* Equal but for a rounding of mm on the cloth and body_mm on the body. */
static bool same_content(const struct code_content *a, const struct code_content *b, float mm,
			 float body_mm)
{
	bool same = a->piece_count == b->piece_count && a->seam_count == b->seam_count &&
		    a->cloth_count == b->cloth_count && a->body_count == b->body_count &&
		    a->wrapped == b->wrapped && !strcmp(a->body, b->body) &&
		    !strcmp(a->fabric, b->fabric);
	for (int p = 0; same && p < a->piece_count; p++)
		same = same_piece(&a->pattern.piece[p], &b->pattern.piece[p], mm);
	for (int s = 0; same && s < a->seam_count; s++) {
		const struct seam *one = &a->pattern.seam[s], *other = &b->pattern.seam[s];
		same = one->swapped == other->swapped && one->a.piece == other->a.piece &&
		       one->a.edge == other->a.edge && one->b.piece == other->b.piece &&
		       one->b.edge == other->b.edge;
	}
	for (int m = 0; same && m < a->cloth_count; m++) {
		const struct cloth_mark *one = &a->marks.cloth[m], *other = &b->marks.cloth[m];
		same = one->number == other->number && one->piece == other->piece &&
		       one->point_count == other->point_count &&
		       far_apart(one->point_mm, other->point_mm, one->point_count) <= mm;
	}
	for (int m = 0; same && m < a->body_count; m++) {
		const struct body_mark *one = &a->marks.body[m], *other = &b->marks.body[m];
		same = one->number == other->number && one->point_count == other->point_count;
		for (int i = 0; same && i < one->point_count; i++)
			same = v3_distance(one->point_m[i], other->point_m[i]) <= 0.001f * body_mm;
	}
	return same;
}

static bool read_back(int length)
{
	char fault[CODE_FAULT_BYTES];
	bool read = code_read(&again, text, (size_t)length, fault);
	if (!read)
		fprintf(stderr, "%s\n", fault);
	return read;
}

/* What the importer writes is played, and gives the same document. */
static void journal_is_worn(const char *path, float mm)
{
	char fault[160], *line = NULL;
	size_t size, room = 0;
	char *journal = content_journal(&again, &size);
	struct scene *scene = scene_open();
	FILE *file = fmemopen(journal, size, "r");
	int refused = 0;
	bool wrapped = false;
	for (ssize_t got; (got = getline(&line, &room, file)) > 0 && !wrapped;) {
		enum journal_result result = journal_read(line, (int)got, &scene->edit, fault);
		CHECK(result != JOURNAL_FAULT);
		wrapped = result == JOURNAL_EDIT && scene->edit.kind == EDIT_WRAP;
		if (result == JOURNAL_EDIT && !wrapped)
			refused += !session_apply(&scene->session, &scene->edit);
	}
	static struct code_content played;
	content_take(&played, &scene->session.document, wrapped, "mannequin");
	bool same = same_content(&again, &played, 0.0f, 0.2f) &&
		    same_content(&content, &played, mm, 0.3f);
	if (refused || !same)
		fprintf(stderr, "%s: %d refused\n", path, refused);
	CHECK(refused == 0 && same);
	fclose(file);
	free(line);
	free(journal);
	scene_close(scene);
}

static int round_trip(const char *path)
{
	struct code_figures figures;
	struct scene *scene = scene_open();
	CHECK(scene_play(scene, path) >= 0);
	content_take(&content, &scene->session.document, true, "mannequin");
	scene_close(scene);
	int length = code_write(&content, text, sizeof text, &figures);
	CHECK(length > 0 && read_back(length));
	float mm = 0.71f / (float)figures.per_mm; /* half a step along both axes */
	CHECK(same_content(&content, &again, mm, 0.87f / (float)figures.per_mm));
	bool whole = true;
	for (int p = 0; p < content.piece_count; p++)
		whole &= same_piece(&content.pattern.piece[p], &again.pattern.piece[p], 0.0f);
	printf("%-40s %2d pieces %5d bytes, packed %5d, %5d characters, 1/%d mm%s\n", path,
	       content.piece_count, figures.raw_bytes, figures.packed_bytes, length, figures.per_mm,
	       whole ? ", outlines to the bit" : "");
	journal_is_worn(path, mm);
	return length;
}

static void bundled_journals_fit(void)
{
	DIR *folder = opendir("tests/journals");
	char path[300];
	int count = 0;
	CHECK(folder);
	for (struct dirent *entry; folder && (entry = readdir(folder));) {
		if (!strstr(entry->d_name, ".kitsuke"))
			continue;
		snprintf(path, sizeof path, "tests/journals/%s", entry->d_name);
		int length = round_trip(path);
		CHECK(length <= QR_25_L);
		count++;
	}
	closedir(folder);
	CHECK(count >= 10);
}

/* Hand-written outlines in whole tenths come back to the bit. */
static void tenths_are_exact(void)
{
	static const struct v2 corner_mm[4] = {
		{-250.1f, -3.7f}, {249.9f, 0.3f}, {3.3f, 410.7f}, {-99.9f, 200.2f}};
	struct code_figures figures;
	memset(&content, 0, sizeof content);
	content.piece_count = 1;
	struct piece *piece = &content.pattern.piece[0];
	*piece = (struct piece){.used = true, .point_count = 4, .turn_rad = 0.3f};
	for (int i = 0; i < 4; i++) {
		piece->point_mm[i] = corner_mm[i];
		piece->corner[i] = true;
	}
	int length = code_write(&content, text, sizeof text, &figures);
	CHECK(length > 0 && figures.exact && figures.per_mm == 10 && read_back(length));
	CHECK(same_content(&content, &again, 0.0f, 0.0f));
	piece->point_mm[2].x = 3.333f;
	CHECK(code_write(&content, text, sizeof text, &figures) && !figures.exact);
	/* an outline that tenths would tie in a knot is kept finer */
	piece->point_mm[3] = (struct v2){3.34f, 410.72f};
	CHECK(code_write(&content, text, sizeof text, &figures) && figures.per_mm > 10);
}

/* Cut at every byte, each byte changed to others: never another pattern. */
static void damage_is_found(int length)
{
	static char bad[CODE_TEXT_MAX];
	char fault[CODE_FAULT_BYTES];
	int wrong = 0;
	for (int cut = 0; cut < length; cut++)
		wrong += code_read(&again, text, (size_t)cut, fault) || !fault[0];
	CHECK(wrong == 0);
	for (int i = 0; i < length; i++)
		for (int byte = 0; byte < 256; byte++) {
			if (byte == (unsigned char)text[i])
				continue;
			if (byte >= 128 && byte % 16)
				continue; /* none of them means anything */
			memcpy(bad, text, (size_t)length);
			bad[i] = (char)byte;
			wrong += code_read(&again, bad, (size_t)length, fault) || !fault[0];
		}
	CHECK(wrong == 0);
	memcpy(bad, text, 40); /* a message's line ends do no harm */
	memcpy(bad + 40, "\r\n", 2);
	memcpy(bad + 42, text + 40, (size_t)length - 40);
	memcpy(bad + length + 2, " \n", 2);
	CHECK(code_read(&again, bad, (size_t)length + 4, fault));
	CHECK(same_content(&content, &again, 0.71f, 0.87f));
}

/* A code is for years: one that was printed on a card is read as long as there is a kitsuke. */
static void old_codes_are_read(void)
{
	static const char poncho[] =
		"KITSUKE1:*70 ZUU6V1VCE8C0Y9YSPZL5T5WUSVH6IEUJE.HP*N$LG.6PF:PRSMU8IUP4Z"
		"N6RXKQ4R7XJVGPB549DCLXR$3J6WH043ACMF8CY7CUH917QJ6WIABWLDMYSHJPI.489RY8"
		"6N84TH1GI1NI2EM4::O.EOU1KR+N*I2:AJ$4KB$O2EC5EJ+67YHIAHEUD7+QIUYP48M8G6"
		"OZSL/OW$G.HI:-G443VK057V**4JOC4C3 KR+A3OC34YUA1DJLBYM0.";
	char fault[CODE_FAULT_BYTES];
	struct scene *scene = scene_open();
	CHECK(scene_play(scene, "tests/journals/poncho.kitsuke") >= 0);
	content_take(&content, &scene->session.document, true, "mannequin");
	scene_close(scene);
	CHECK(code_read(&again, poncho, strlen(poncho), fault));
	CHECK(same_content(&content, &again, 0.0f, 0.1f));
}

/* ---- made up with a sound checksum ---- */

static int wrap_up(const uint8_t *raw, size_t size)
{
	static uint8_t bytes[4096];
	static const char alphabet[] = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZ $%*+-./:";
	z_stream stream = {.next_in = (Bytef *)(uintptr_t)raw,
			   .avail_in = (uInt)size,
			   .next_out = bytes + 5,
			   .avail_out = sizeof bytes - 5};
	deflateInit2(&stream, 9, Z_DEFLATED, -15, 9, Z_DEFAULT_STRATEGY);
	CHECK(deflate(&stream, Z_FINISH) == Z_STREAM_END);
	size_t packed = sizeof bytes - stream.avail_out;
	deflateEnd(&stream);
	bytes[0] = 1;
	uLong sum = crc32(crc32(0, bytes, 1), bytes + 5, (uInt)(packed - 5));
	for (int i = 0; i < 4; i++)
		bytes[1 + i] = (uint8_t)(sum >> (24 - 8 * i));
	int at = sprintf(text, "KITSUKE1:");
	for (size_t i = 0; i < packed; i += 2) {
		unsigned value = i + 1 < packed ? bytes[i] * 256u + bytes[i + 1] : bytes[i];
		text[at++] = alphabet[value % 45];
		text[at++] = alphabet[value / 45 % 45];
		if (i + 1 < packed)
			text[at++] = alphabet[value / 2025];
	}
	text[at++] = '.';
	return at;
}

static void lies_are_refused(void)
{
	static uint8_t raw[1 << 20];
	static const uint8_t many[] = {0, 0, 0, 25}, seam[] = {0, 0, 0, 0, 1, 0, 0, 0, 0},
			     mark[] = {0, 0, 0, 0, 0, 1, 1, 0, 2},
			     rest[] = {0, 0, 0, 0, 0, 0, 0, 9}, name[] = {0, 1, ' ', 0, 0, 0, 0, 0};
	char fault[CODE_FAULT_BYTES];
	int length = wrap_up(raw, sizeof raw); /* a bomb: a thousand times its size */
	CHECK(!code_read(&again, text, (size_t)length, fault) && strstr(fault, "unfolds"));
	length = wrap_up(many, sizeof many);
	CHECK(!code_read(&again, text, (size_t)length, fault) && strstr(fault, "count of pieces"));
	length = wrap_up(seam, sizeof seam);
	CHECK(!code_read(&again, text, (size_t)length, fault) && strstr(fault, "piece in seam"));
	length = wrap_up(mark, sizeof mark);
	CHECK(!code_read(&again, text, (size_t)length, fault) && strstr(fault, "under mark"));
	length = wrap_up(rest, sizeof rest);
	CHECK(!code_read(&again, text, (size_t)length, fault) && strstr(fault, "left over"));
	length = wrap_up(name, sizeof name);
	CHECK(!code_read(&again, text, (size_t)length, fault) && strstr(fault, "name has"));
	length = wrap_up(rest, 7);
	CHECK(code_read(&again, text, (size_t)length, fault) && again.piece_count == 0);
}

int main(int argc, char **argv)
{
	for (int i = 1; i < argc; i++)
		round_trip(argv[i]);
	if (argc > 1)
		return test_end();
	bundled_journals_fit();
	tenths_are_exact();
	damage_is_found(round_trip("tests/journals/tshirt.kitsuke"));
	lies_are_refused();
	old_codes_are_read();
	return test_end();
}
