/* How the cloth behaves in each stage of the wrap: tried on shirts, a skirt and trousers. */
#include "dress_private.h"

struct cloth_settings wrap_growing(void)
{
	struct cloth_settings set = cloth_settings_worn();
	set.shape_passes = 2;
	set.flatness = 0.2f;
	set.reach = 0.0f;
	set.momentum = 0.0f;
	set.gravity_m = 0.0f;
	set.friction = 0.2f;
	set.grip = 0.0f;
	set.filter_parts = true;
	set.faces = false;
	set.open = false;
	set.strain_bound = 0.0f;
	set.thickness_m = 0.0f; /* what lies over itself is still to come apart */
	set.seam_step_m = 0.0f;
	set.attract_m = 0.001f;
	return set;
}

struct cloth_settings wrap_closing(void)
{
	struct cloth_settings set = wrap_growing();
	set.flatness = 0.06f;
	set.momentum = 0.8f;
	set.seam_step_m = 0.003f;
	set.attract_m = 0.0f;
	return set;
}

struct cloth_settings wrap_filling(void)
{
	struct cloth_settings set = wrap_closing();
	set.momentum = 0.0f;
	set.friction = 0.0f;
	return set;
}

/* Cloth wider than the body lies on it in pleats. Blown up until it is taut round the air, it has
 * none; and then it settles in the few folds that its weight makes. */
struct cloth_settings wrap_unfolding(void)
{
	struct cloth_settings set = wrap_growing();
	set.momentum = 0.3f;
	set.friction = 0.0f;
	set.offset_m += 0.004f;
	set.inflate_m = 0.001f;
	set.filter_parts = false;
	set.open = true;
	return set;
}

struct cloth_settings wrap_settling(void)
{
	struct cloth_settings set = cloth_settings_worn();
	set.shape_passes = 2;
	return set;
}
