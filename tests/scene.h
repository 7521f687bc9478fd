/* A visit for tests and benchmarks of the picture: the mannequin, and a journal played on it. */
#ifndef SCENE_H
#define SCENE_H

#include "journal.h"
#include "session.h"

#include <stdio.h>
#include <stdlib.h>

struct scene {
	struct session session;
	struct edit edit;
	struct arena arena;
	void *memory;
};

enum { SCENE_BYTES = 256 << 20, SCENE_WRAP_FRAMES_MAX = 2000 };

/* Nobody stands there. Stops the program when there is no memory. */
static inline struct scene *scene_open_empty(void)
{
	struct scene *scene = calloc(1, sizeof *scene);
	void *memory = malloc(SCENE_BYTES);
	MUST(scene && memory);
	scene->memory = memory;
	arena_init(&scene->arena, memory, SCENE_BYTES);
	session_init(&scene->session, &scene->arena);
	return scene;
}

static inline struct scene *scene_open(void)
{
	struct scene *scene = scene_open_empty();
	MUST(!body_build_mannequin(&scene->session.body));
	body_find_parts(&scene->session.body);
	return scene;
}

static inline bool scene_edit(struct scene *scene, enum edit_kind kind)
{
	scene->edit.kind = kind;
	return session_apply(&scene->session, &scene->edit);
}

/* An edit as the journal's line says it. */
static inline bool scene_line(struct scene *scene, const char *line)
{
	char fault[160];
	MUST(journal_read(line, (int)strlen(line), &scene->edit, fault) == JOURNAL_EDIT);
	return session_apply(&scene->session, &scene->edit);
}

/* The document's pieces as cloth of so many vertices that lies nowhere yet. */
static inline void scene_mesh(struct scene *scene, int vertices)
{
	struct session *session = &scene->session;
	bool done = false;
	MUST(!garment_start(session->mesher, &session->garment, &session->document.pattern,
			    vertices));
	while (!done)
		garment_advance(session->mesher, 100000, &done);
	cloth_reset(&session->cloth, &session->garment, &session->body);
}

/* Applies a journal up to its first WRAP. Returns the lines refused, -1 when it can't be read. */
static inline int scene_play(struct scene *scene, const char *path)
{
	static char line[JOURNAL_LINE_MAX];
	char fault[160];
	int refused = 0;
	FILE *file = fopen(path, "r");
	if (!file)
		return -1;
	while (fgets(line, sizeof line, file)) {
		enum journal_result result = journal_read(line, (int)strlen(line), &scene->edit,
							  fault);
		if (result == JOURNAL_EDIT && scene->edit.kind == EDIT_WRAP)
			break;
		if (result == JOURNAL_FAULT ||
		    (result == JOURNAL_EDIT && !session_apply(&scene->session, &scene->edit)))
			refused++;
	}
	fclose(file);
	return refused;
}

/* Wraps, and advances until the garment is on. */
static inline bool scene_wrap(struct scene *scene)
{
	if (!scene_edit(scene, EDIT_WRAP))
		return false;
	for (int i = 0; i < SCENE_WRAP_FRAMES_MAX && scene->session.job != JOB_NONE; i++)
		session_advance(&scene->session);
	return scene->session.cloth.worn;
}

static inline void scene_close(struct scene *scene)
{
	free(scene->memory);
	free(scene);
}

#endif
