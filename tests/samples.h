/* What holds for all pen samples, whatever came in: they are on the screen and finite. */
#ifndef SAMPLES_H
#define SAMPLES_H

#include "input.h"

static inline void samples_check(const struct frame_input *input, int width_px, int height_px)
{
	MUST(input->sample_count >= 0 && input->sample_count <= FRAME_SAMPLES_MAX);
	for (int i = 0; i < input->sample_count; i++) {
		const struct pen_sample *s = &input->sample[i];
		MUST(s->position_px.x >= 0.0f && s->position_px.x < (float)width_px);
		MUST(s->position_px.y >= 0.0f && s->position_px.y < (float)height_px);
		MUST(s->pressure >= 0.0f && s->pressure <= 1.0f);
		MUST(float_abs(s->tilt_rad.x) < 1.6f && float_abs(s->tilt_rad.y) < 1.6f);
		MUST(s->state == PEN_TOUCH || s->pressure <= 0.0f);
	}
}

#endif
