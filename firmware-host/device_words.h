/* What a hidraw node is to a set-up engineer, in lines. */
#ifndef DEVICE_WORDS_H
#define DEVICE_WORDS_H

#include "live.h"

#include <stdio.h>

/* What libwacom knows of it; width_mm 0: nothing. */
struct device_model {
	float width_mm, height_mm;
	bool display;
};

/* What it is, which path it takes and why, permissions, the kernel's driver, and the one command
 * that mends what is in the way. group: of the user who runs the station. */
void device_words(FILE *out, const struct live_node *node, const struct device_model *model,
		  const char *group);

#endif
