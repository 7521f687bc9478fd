#include "fabric.h"

/* Ratios of weight and bending as between fabrics of 140 (jersey), 90 (silk), 400 (denim), 280
 * (wool) and 700 (leather) grams a square metre; what the kernels can hold bounds them: more than 4
 * times the weight would show as stretch, shares end at most_share. */
static const struct fabric fabrics[] = {
	{"jersey", 1.0f, 1.0f, 1.0f, 1.0f, 1.0f, 0.002f},
	{"silk", 1.0f, 0.25f, 0.2f, 0.7f, 0.4f, 0.0015f},
	{"denim", 1.0f, 0.9f, 8.0f, 2.0f, 1.5f, 0.003f},
	{"wool", 0.8f, 0.4f, 3.0f, 1.5f, 2.0f, 0.004f},
	{"leather", 1.0f, 1.0f, 25.0f, 2.5f, 2.0f, 0.004f},
	{"elastic", 0.13f, 0.5f, 1.0f, 1.2f, 1.5f, 0.002f},
};

static const float most_share = 0.6f; /* of bending taken back in a sweep; more would tremble */

const struct fabric *fabric_at(int index)
{
	return &fabrics[int_clamp(index, 0, COUNT_OF(fabrics) - 1)];
}

int fabric_named(const char *name)
{
	for (int f = 0; f < COUNT_OF(fabrics); f++)
		if (strlen(name) == strlen(fabrics[f].name) &&
		    memcmp(name, fabrics[f].name, strlen(name)) == 0)
			return f;
	return -1;
}

struct cloth_settings fabric_settings(const struct cloth_settings *stage, int index)
{
	const struct fabric *fabric = fabric_at(index);
	struct cloth_settings set = *stage;
	set.shape *= fabric->stretch;
	set.reach *= fabric->stretch;
	set.strain_bound /= fabric->stretch;
	set.shear *= fabric->shear;
	set.flatness = float_min(set.flatness * fabric->bend, float_max(set.flatness, most_share));
	set.gravity_m *= fabric->weight;
	set.friction = float_min(set.friction * fabric->friction, 1.0f);
	set.grip *= fabric->friction;
	if (set.thickness_m > 0.0f)
		set.thickness_m = fabric->thickness_m;
	return set;
}
