/* Levels to masks, with a debounce of our own where the kernel has none. */
#include "buttons.h"

void buttons_begin(struct buttons_state *state, uint8_t level, int64_t debounce_us)
{
	*state = (struct buttons_state){
		.debounce_us = debounce_us, .level = level, .ignored = level};
}

void buttons_level(struct buttons_state *state, enum button button, bool pressed, int64_t time_us)
{
	uint8_t bit = (uint8_t)(1 << button);
	if (pressed == !!(state->level & bit))
		return;
	state->level ^= bit;
	state->changed_us[button] = time_us;
}

bool buttons_settle(struct buttons_state *state, int64_t now_us)
{
	uint8_t before = state->held;
	for (int i = 0; i < BUTTON_COUNT; i++) {
		uint8_t bit = (uint8_t)(1 << i);
		if (now_us - state->changed_us[i] < state->debounce_us)
			continue;
		state->ignored &= (uint8_t)(state->level & bit ? 0xff : ~bit);
		state->held &= (uint8_t)~bit;
		state->held |= state->level & bit & ~state->ignored;
	}
	return state->held != before;
}

bool buttons_unsettled(const struct buttons_state *state)
{
	return state->held != (state->level & ~state->ignored);
}
