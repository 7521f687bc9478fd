/* Any row of edits of shapes: taken or refused, the document stays sound, and what is refused has
 * changed nothing. */
#include "edits.h"
#include "journal.h"

#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static const char *const start[] = {
	"piece front 0 0 0 0 0 -200 -300 1 200 -300 1 200 300 1 120 320 0 0 330 0 -200 300 1",
	"piece back 0 1 500 0 0 -210 -300 1 190 -310 1 200 300 1 -200 300 1",
	"sew 0 1 1 3 0",
	"sew 0 3 1 1 1",
	"mark-cloth 1 0 0 100 0 -100",
};

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	static struct session *session;
	static struct arena arena;
	static struct edit edit;
	char fault[160];
	if (!session) {
		session = calloc(1, sizeof *session);
		void *memory = malloc(KIOSK_MEMORY_BYTES);
		MUST(session && memory);
		arena_init(&arena, memory, KIOSK_MEMORY_BYTES);
		session_init(session, &arena);
	}
	memset(&session->document, 0, sizeof session->document);
	for (int i = 0; i < COUNT_OF(start); i++) {
		MUST(journal_read(start[i], (int)strlen(start[i]), &edit, fault) == JOURNAL_EDIT);
		session_apply(session, &edit);
	}
	for (size_t at = 0; at + 8 <= size && at < 800; at += 8) {
		edit = edit_of_bytes(data + at);
		uint64_t before = session_hash(session);
		if (!session_apply(session, &edit))
			MUST(session_hash(session) == before);
		MUST(document_is_sound(&session->document));
	}
	return 0;
}
