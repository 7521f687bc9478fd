/* See tape_learn.h. */
#include "tape_learn.h"
#include "pen_identify.h"

struct pen_vendor tape_speaks(const struct tape_device *told, float *width_mm, float *height_mm)
{
	static const struct pen_answers none;
	struct pen_identity identity = {
		.bus = told->bus,
		.vendor = told->vendor,
		.product = told->product,
		.descriptor = told->descriptor,
		.descriptor_size = told->descriptor_size,
	};
	struct pen_vendor speaks = {PEN_BY_DESCRIPTOR, 0, 0, 0};
	struct pen_recipe recipe;
	char reason[160];
	*width_mm = *height_mm = 0.0f;
	if (pen_identify(&identity, &recipe, reason))
		pen_identify_end(&identity, &recipe, &none, &speaks, width_mm, height_mm, reason);
	return speaks;
}

void tape_learn(struct pen *pen, int device, const struct tape_device *told)
{
	struct pen_vendor speaks = told->speaks;
	float width_mm = told->width_mm, height_mm = told->height_mm, width, height;
	pen_describe(pen, device, told->descriptor, told->descriptor_size);
	if (speaks.family == PEN_BY_DESCRIPTOR) {
		speaks = tape_speaks(told, &width, &height);
		width_mm = width_mm > 0.0f ? width_mm : width;
		height_mm = height_mm > 0.0f ? height_mm : height;
	}
	pen_vendor_set(pen, device, &speaks);
	pen_resize(pen, device, width_mm, height_mm);
}
