/* The bundled T-shirt in other proportions, and what a wrap says of it. */
#ifndef SHIRT_H
#define SHIRT_H

#include "scene.h"
#include "test.h"

/* Plays the bundled T-shirt up to its WRAP, so much wider and longer. */
static inline struct scene *shirt_of(float wide, float tall)
{
	static char line[JOURNAL_LINE_MAX];
	struct scene *scene = scene_open();
	char fault[160];
	FILE *file = fopen("tests/journals/tshirt.kitsuke", "r");
	MUST(file);
	while (fgets(line, sizeof line, file)) {
		struct edit *edit = &scene->edit;
		if (journal_read(line, (int)strlen(line), edit, fault) != JOURNAL_EDIT)
			continue;
		if (edit->kind == EDIT_WRAP)
			break;
		for (int i = 0; edit->kind == EDIT_PIECE && i < edit->point_count; i++) {
			edit->point[i].x *= wide;
			edit->point[i].y *= tall;
		}
		CHECK(session_apply(&scene->session, edit));
	}
	fclose(file);
	return scene;
}

static inline int count_diagnoses(const struct wrap *wrap, const char *kind)
{
	int count = 0;
	for (int i = 0; i < wrap->diagnoses.count; i++)
		count += strcmp(wrap->diagnoses.item[i].kind, kind) == 0;
	return count;
}

#endif
