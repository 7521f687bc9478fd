/* Any bytes as a code, as a card's picture, and as the content behind a sound checksum: refused
 * with words, or a pattern that is written and read again the same. */
#include "format_code.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static struct code_content content, again;
static uint8_t raw[CODE_RAW_MAX], raw_again[CODE_RAW_MAX];
static char text[CODE_TEXT_MAX];

static void writes_back(int per_mm)
{
	char fault[CODE_FAULT_BYTES];
	struct code_figures figures;
	size_t first = code_pack(&content, per_mm, raw, sizeof raw);
	MUST(first > 0 && code_unpack(&again, per_mm, raw, first, fault));
	size_t second = code_pack(&again, per_mm, raw_again, sizeof raw_again);
	MUST(first == second && !memcmp(raw, raw_again, first));
	int length = code_write(&content, text, sizeof text, &figures);
	MUST(length > 0 && code_read(&again, text, (size_t)length, fault));
	MUST(again.piece_count == content.piece_count && again.seam_count == content.seam_count);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	static const int per_mm[] = {10, 100, 1000};
	char fault[CODE_FAULT_BYTES] = "";
	size_t found;
	if (code_is_png(data, size) && !code_in_png(data, size, &found, fault))
		MUST(fault[0]);
	if (!code_read(&content, (const char *)data, size, fault))
		MUST(fault[0]);
	int kind = size ? data[0] % 3 : 0;
	if (size > 0 && code_unpack(&content, per_mm[kind], data + 1, size - 1, fault))
		writes_back(per_mm[kind]);
	else
		MUST(fault[0]);
	return 0;
}
