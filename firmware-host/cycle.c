#include "cycle.h"

#include "limits.h"

/* A hand that holds still trembles less than this, and so does the noise of a pen that lies. */
static const float still_px = 6.0f;

static bool somebody(struct cycle *cycle, const struct frame_input *input, float px)
{
	bool moved = input->buttons_pressed != 0;
	for (int i = 0; i < input->sample_count; i++) {
		const struct pen_sample *sample = &input->sample[i];
		bool down = sample->state == PEN_TOUCH && cycle->pen != PEN_TOUCH;
		cycle->pen = sample->state;
		if (sample->state == PEN_AWAY)
			continue;
		if (!down && v2_distance(sample->position_px, cycle->still_px) < still_px * px)
			continue;
		cycle->still_px = sample->position_px;
		moved = true;
	}
	return moved;
}

static bool touched(const struct frame_input *input)
{
	bool touch = input->buttons_pressed != 0;
	for (int i = 0; i < input->sample_count; i++)
		touch |= input->sample[i].state == PEN_TOUCH;
	return touch;
}

bool cycle_frame(struct cycle *cycle, const struct frame_input *input, int idle_s, bool begun,
		 float px)
{
	bool there = somebody(cycle, input, px);
	int whole = idle_s * FRAME_RATE_HZ;
	int countdown = int_min(CYCLE_COUNTDOWN_S * FRAME_RATE_HZ, whole / 2);
	cycle->still = there ? 0 : cycle->still + 1;
	cycle->left_s = 0;
	if (cycle->state == CYCLE_ATTRACT) {
		if (touched(input))
			cycle->state = CYCLE_VISIT;
		return false;
	}
	cycle->state = CYCLE_VISIT;
	if (idle_s == 0 || cycle->still <= whole - countdown)
		return false;
	if (!begun) { /* nothing to throw away: no need to ask */
		cycle->state = CYCLE_ATTRACT;
		return false;
	}
	cycle->state = CYCLE_COUNTDOWN;
	cycle->left_s = (whole - cycle->still + FRAME_RATE_HZ) / FRAME_RATE_HZ;
	if (cycle->still <= whole)
		return false;
	*cycle = (struct cycle){.state = CYCLE_ATTRACT, .still_px = cycle->still_px};
	return true;
}
