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

/* All strips, then all cuts. */
static void run(struct cloth *cloth, crew_task *task, bool backwards)
{
	int strips = cloth->scratch->strip_count;
	for (int i = 0; i < 2; i++) {
		bool cuts = (i == 1) != backwards;
		struct pass pass = {cloth, backwards, cuts ? strips : 0};
		crew_run(cloth->crew, task, &pass, cuts ? strips - 1 : strips);
	}
}

long cloth_shape(struct cloth *cloth)
{
	const struct cloth_settings *set = &cloth->settings;
	const struct cloth_scratch *s = cloth->scratch;
	long units = (long)BATCH * set->shape_passes * s->shape_first[GROUPS_MAX];
	for (int pass = 0; pass < set->shape_passes; pass++)
		run(cloth, shape_group, (cloth->sweep + pass) & 1);
	if (set->flatness <= 0.0f)
		return units;
	run(cloth, bend_group, cloth->sweep & 1);
	return units + s->bend_count;
}
