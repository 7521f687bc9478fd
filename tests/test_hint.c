/* Whatever a wrap finds out about a garment that is worn, the visitor is told in both languages,
 * the gravest of it first. */
#include "test.h"
#include "text.h"

#include <stdio.h>
#include <stdlib.h>

/* Every kind that wrap_diagnose is called with where a visitor dresses the figure by marks. */
static const char *const kinds[] = {
	"piece-unreached",  "marks-disagree", "directions-differ", "head-outside",
	"limb-outside",     "not-sewn",       "lengths-differ",    "no-partner",
	"mark-not-reached", "mark-ignored",   "marks-swapped",     "let_out",
	"gathered",
};

static void found(struct session *session, const char *kind, int mark)
{
	struct diagnoses *list = &session->wrap.diagnoses;
	struct diagnosis *item = &list->item[list->count++];
	*item = (struct diagnosis){.mark = {mark, 0}};
	snprintf(item->kind, sizeof item->kind, "%s", kind);
}

int main(void)
{
	struct session *session = calloc(1, sizeof *session);
	struct ui *ui = calloc(1, sizeof *ui);
	int mark[2];
	ui->step = STEP_DRESS;
	session->cloth.worn = true;
	CHECK(text_hint(ui, session, mark) == TEXT_HINT_WORN);
	for (int k = 0; k < COUNT_OF(kinds); k++) {
		session->wrap.diagnoses.count = 0;
		found(session, kinds[k], k + 1);
		CHECK(text_hint(ui, session, mark) != TEXT_HINT_WORN);
		CHECK(mark[0] == k + 1);
	}
	session->wrap.diagnoses.count = 0;
	found(session, "gathered", 1);
	found(session, "let_out", 2);
	found(session, "marks-disagree", 3);
	CHECK(text_hint(ui, session, mark) == TEXT_DISAGREE && mark[0] == 3);
	free(ui);
	free(session);
	return test_end();
}
