/* Threads that the host lends. The core knows none: it cuts work into parts that touch nothing of
 * one another's, and whoever does which part when, the bits are the same. */
#ifndef CREW_H
#define CREW_H

#include "base.h"

typedef void crew_task(void *context, int part);

struct crew {
	/* Does the parts 0 to parts - 1 in any order, some at the same time; all are done when it
	 * returns. Never called from within a task. */
	void (*run)(struct crew *crew, crew_task *task, void *context, int parts);
};

/* Crew NULL: the parts are done here, one after the other. */
static inline void crew_run(struct crew *crew, crew_task *task, void *context, int parts)
{
	if (crew && parts > 1) {
		crew->run(crew, task, context, parts);
		return;
	}
	for (int part = 0; part < parts; part++)
		task(context, part);
}

/* Loops whose rounds touch nothing of one another's are handed out in parts of so many rounds. */
enum { LOOP_ROUNDS = 512 };

static inline int loop_parts(int rounds)
{
	return (rounds + LOOP_ROUNDS - 1) / LOOP_ROUNDS;
}

struct loop_part {
	int first, count;
};

static inline struct loop_part loop_part(int rounds, int part)
{
	int first = part * LOOP_ROUNDS;
	return (struct loop_part){first, int_min(rounds - first, LOOP_ROUNDS)};
}

#endif
