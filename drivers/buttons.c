/* Levels to masks, with a debounce of our own where the kernel has none. */
#include "buttons.h"

void buttons_begin(struct buttons_state *state, uint8_t level, int64_t debounce_us)
{
	*state = (struct buttons_state){
		.debounce_us = debounce_us, .level = level, .ignored = level};
	for (int i = 0; i < BUTTON_COUNT; i++)
		state->pressed_us[i] = -BUTTONS_LOCK_US;
}

void buttons_level(struct buttons_state *state, enum button button, bool pressed, int64_t time_us)
{
	uint8_t bit = (uint8_t)(1 << button);
	if (pressed == !!(state->level & bit))
		return;
	state->level ^= bit;
	state->edges[button]++;
	state->changed_us[button] = time_us;
}

/*                    press, 200 ms after the last
 *    RELEASED ------------------------------------------> HELD
 *     ^    ^                                               |  |
 *     |    |                  release                      |  |
 *     |    +-----------------------------------------------+  |
 *     |            release                     30 s           |
 *     +------------------------- IGNORED <--------------------+
 *                                   ^
 *                                   +--- held when the lines were opened
 */
static void button_settle(struct buttons_state *state, enum button button, int64_t now_us)
{
	uint8_t bit = (uint8_t)(1 << button);
	int64_t age_us = now_us - state->pressed_us[button];
	if (!(state->level & bit)) {
		state->held &= (uint8_t)~bit;
		state->ignored &= (uint8_t)~bit;
		state->stuck &= (uint8_t)~bit;
	} else if (state->held & bit && age_us >= BUTTONS_STUCK_US) {
		state->held &= (uint8_t)~bit;
		state->ignored |= bit;
		state->stuck |= bit;
	} else if (!((state->held | state->ignored) & bit) && age_us >= BUTTONS_LOCK_US) {
		state->held |= bit;
		state->presses[button]++;
		state->pressed_us[button] = now_us;
	}
}

bool buttons_settle(struct buttons_state *state, int64_t now_us)
{
	uint8_t before = state->held;
	for (int i = 0; i < BUTTON_COUNT; i++)
		if (now_us - state->changed_us[i] >= state->debounce_us)
			button_settle(state, (enum button)i, now_us);
	return state->held != before;
}

bool buttons_chord(struct buttons_state *state, int64_t now_us)
{
	bool all = state->held == (1 << BUTTON_COUNT) - 1;
	for (int i = 0; i < BUTTON_COUNT; i++)
		all &= now_us - state->pressed_us[i] >= BUTTONS_SERVICE_US;
	bool told = state->service;
	state->service = all;
	return all && !told;
}

bool buttons_gap(uint32_t *last, uint32_t number)
{
	bool gap = number != *last + 1;
	*last = number;
	return gap;
}

bool buttons_unsettled(const struct buttons_state *state)
{
	return state->held != (state->level & ~state->ignored);
}
