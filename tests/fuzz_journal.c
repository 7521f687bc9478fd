/* Any bytes as a journal line: refused with words, or an edit that is written and read back alike.
 */
#include "journal.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	static struct edit edit, back;
	static char line[JOURNAL_LINE_MAX], again[JOURNAL_LINE_MAX];
	char fault[160] = "";
	if (size > JOURNAL_LINE_MAX)
		return 0;
	enum journal_result result = journal_read((const char *)data, (int)size, &edit, fault);
	MUST((result == JOURNAL_FAULT) == (fault[0] != 0));
	if (result != JOURNAL_EDIT)
		return 0;
	int length = journal_write(&edit, line);
	MUST(journal_read(line, length, &back, fault) == JOURNAL_EDIT);
	MUST(journal_write(&back, again) == length && memcmp(line, again, (size_t)length) == 0);
	return 0;
}
