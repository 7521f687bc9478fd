/* Triangles and edges towards their rest shapes, strip by strip (cloth_order.c). */
#include "cloth_private.h"

/* A pass of one kernel over all its constraints; backwards: the last first. */
struct pass {
	struct cloth *cloth;
	bool backwards;
	int first_group;
};

static void shape_group(void *context, int part)
{
	const struct pass *pass = context;
	const struct cloth *cloth = pass->cloth;
	const struct cloth_settings *set = &cloth->settings;
	struct cloth_scratch *s = cloth->scratch;
	const int *first = &s->shape_first[pass->first_group + part];
	kernel_of(cloth->lanes)
		->shape(s->place, s->shape + first[0],
			set->shear < 1.0f ? s->grain + first[0] : NULL, first[1] - first[0],
			set->shape, set->shear, pass->backwards);
}

static void bend_group(void *context, int part)
{
	const struct pass *pass = context;
	const struct cloth *cloth = pass->cloth;
	struct cloth_scratch *s = cloth->scratch;
	const int *first = &s->bends_first[pass->first_group + part];
	kernel_of(cloth->lanes)
		->flatten(s->place, s->bends + first[0], s->any_firm ? s->firm + first[0] : NULL,
			  first[1] - first[0], cloth->settings.flatness, pass->backwards);
}

/* ---- the order ----
 *
 * A pass over all constraints is a phase for the strips and one for the cuts. With threads a phase
 * is done when all its groups are. One thread alone runs ahead instead: a group is done as soon as
 * those that share its particles have been in the phase before, so that a strip's constraints are
 * still near the processor when the next phase wants them. */

enum { PHASES_MAX = 12 };

struct phase {
	crew_task *task;
	bool cuts, backwards;
	int groups, done;
};

/* Returns how many phases there are then; a single strip has no cuts. */
static int add_pass(struct phase *phase, int count, crew_task *task, int strips, bool backwards)
{
	for (int i = 0; i < 2; i++) {
		bool cuts = (i == 1) != backwards;
		int groups = cuts ? strips - 1 : strips;
		if (groups > 0)
			phase[count++] = (struct phase){task, cuts, backwards, groups, 0};
	}
	return count;
}

/* A cut lies between its strip and the next one. */
static bool is_next(const struct phase *phase, int at)
{
	const struct phase *now = &phase[at], *before = now - 1;
	if (now->done == now->groups)
		return false;
	if (at == 0)
		return true;
	int needed = now->done + 1 + (now->cuts && !before->cuts);
	return before->done >= int_min(needed, before->groups);
}

static void run_ahead(struct cloth *cloth, struct phase *phase, int count)
{
	for (int at = count - 1; at >= 0;) {
		struct phase *now = &phase[at];
		if (!is_next(phase, at)) {
			at--;
			continue;
		}
		struct pass pass = {cloth, now->backwards,
				    now->cuts ? cloth->scratch->strip_count : 0};
		now->task(&pass, now->done++);
		at = count - 1;
	}
}

static void run_abreast(struct cloth *cloth, const struct phase *phase, int count)
{
	for (int at = 0; at < count; at++) {
		struct pass pass = {cloth, phase[at].backwards,
				    phase[at].cuts ? cloth->scratch->strip_count : 0};
		crew_run(cloth->crew, phase[at].task, &pass, phase[at].groups);
	}
}

long cloth_shape(struct cloth *cloth)
{
	const struct cloth_settings *set = &cloth->settings;
	const struct cloth_scratch *s = cloth->scratch;
	struct phase phase[PHASES_MAX];
	int count = 0;
	MUST(2 * (set->shape_passes + 1) <= PHASES_MAX);
	for (int pass = 0; pass < set->shape_passes; pass++)
		count = add_pass(phase, count, shape_group, s->strip_count,
				 (cloth->sweep + pass) & 1);
	if (set->flatness > 0.0f)
		count = add_pass(phase, count, bend_group, s->strip_count, cloth->sweep & 1);
	if (cloth->crew)
		run_abreast(cloth, phase, count);
	else
		run_ahead(cloth, phase, count);
	return (long)BATCH * set->shape_passes * s->shape_first[GROUPS_MAX] +
	       (set->flatness > 0.0f ? s->bend_count : 0);
}
