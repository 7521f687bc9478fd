/* Button levels to masks: our own debounce, the kernel's, and what is held from the start. */
#include "buttons.h"
#include "test.h"

static struct buttons_state state;

/* The mask after a settle at this moment; 0xff where nothing changed. */
static int settled(int64_t now_us)
{
	return buttons_settle(&state, now_us) ? state.held : 0xff;
}

static void check_kernel_debounce(void)
{
	buttons_begin(&state, 0, 0);
	CHECK(settled(1000) == 0xff && !buttons_unsettled(&state));
	buttons_level(&state, BUTTON_PIN, true, 2000);
	CHECK(settled(2000) == 1 << BUTTON_PIN);
	buttons_level(&state, BUTTON_WRAP, true, 3000);
	CHECK(settled(3000) == (1 << BUTTON_PIN | 1 << BUTTON_WRAP));
	buttons_level(&state, BUTTON_PIN, false, 3000);
	CHECK(settled(3000) == 1 << BUTTON_WRAP);
}

static void check_own_debounce(void)
{
	buttons_begin(&state, 0, BUTTONS_DEBOUNCE_US);
	for (int i = 0; i < 7; i++) { /* bounces for 6 ms, and stays pressed */
		buttons_level(&state, BUTTON_WRAP, i % 2 == 0, 100000 + 1000 * i);
		CHECK(settled(100000 + 1000 * i) == 0xff);
	}
	CHECK(buttons_unsettled(&state));
	CHECK(settled(106000 + BUTTONS_DEBOUNCE_US - 1) == 0xff);
	CHECK(settled(106000 + BUTTONS_DEBOUNCE_US) == 1 << BUTTON_WRAP);
	CHECK(!buttons_unsettled(&state));
	/* a spike of 3 ms is none */
	buttons_level(&state, BUTTON_RELAX, true, 200000);
	buttons_level(&state, BUTTON_RELAX, false, 203000);
	CHECK(settled(300000) == 0xff && !buttons_unsettled(&state));
}

static void check_held_from_start(void)
{
	buttons_begin(&state, 1 << BUTTON_RELAX, 0);
	CHECK(settled(1000) == 0xff && !buttons_unsettled(&state));
	buttons_level(&state, BUTTON_WRAP, true, 2000);
	CHECK(settled(2000) == 1 << BUTTON_WRAP);
	buttons_level(&state, BUTTON_RELAX, false, 3000);
	CHECK(settled(3000) == 0xff);
	buttons_level(&state, BUTTON_RELAX, true, 4000);
	CHECK(settled(4000) == (1 << BUTTON_WRAP | 1 << BUTTON_RELAX));
}

/* A child's fist: twenty presses a second are five. */
static void check_hammered(void)
{
	int presses = 0;
	buttons_begin(&state, 0, 0);
	for (int i = 0; i < 40; i++) {
		int64_t now_us = 25000 * i;
		buttons_level(&state, BUTTON_WRAP, i % 2 == 0, now_us);
		presses += settled(now_us) == 1 << BUTTON_WRAP;
	}
	CHECK(presses == 5);
	/* who goes on holding is heard when the lock ends */
	buttons_begin(&state, 0, 0);
	buttons_level(&state, BUTTON_WRAP, true, 0);
	CHECK(settled(0) == 1);
	buttons_level(&state, BUTTON_WRAP, false, 50000);
	CHECK(settled(50000) == 0);
	buttons_level(&state, BUTTON_WRAP, true, 100000);
	CHECK(settled(100000) == 0xff && buttons_unsettled(&state));
	CHECK(settled(BUTTONS_LOCK_US - 1) == 0xff && settled(BUTTONS_LOCK_US) == 1);
	/* another button has a lock of its own */
	buttons_level(&state, BUTTON_PIN, true, BUTTONS_LOCK_US + 1);
	CHECK(settled(BUTTONS_LOCK_US + 1) == 3);
}

static void check_stuck(void)
{
	buttons_begin(&state, 0, 0);
	buttons_level(&state, BUTTON_PIN, true, 1000);
	CHECK(settled(1000) == 1 << BUTTON_PIN);
	CHECK(settled(1000 + BUTTONS_STUCK_US - 1) == 0xff && !state.stuck);
	CHECK(settled(1000 + BUTTONS_STUCK_US) == 0 && state.stuck == 1 << BUTTON_PIN);
	CHECK(!buttons_unsettled(&state) && settled(2 * (int64_t)BUTTONS_STUCK_US) == 0xff);
	buttons_level(&state, BUTTON_WRAP, true, 2 * (int64_t)BUTTONS_STUCK_US);
	CHECK(settled(2 * (int64_t)BUTTONS_STUCK_US) == 1 << BUTTON_WRAP);
	buttons_level(&state, BUTTON_PIN, false, 61000000);
	CHECK(settled(61000000) == 0xff && !state.stuck);
	buttons_level(&state, BUTTON_PIN, true, 62000000);
	CHECK(settled(62000000) == (1 << BUTTON_PIN | 1 << BUTTON_WRAP));
}

static void check_service(void)
{
	buttons_begin(&state, 0, 0);
	for (int i = 0; i < BUTTON_COUNT; i++)
		buttons_level(&state, (enum button)i, true, 1000000 * i);
	settled(0);
	settled(1000000);
	settled(2000000);
	CHECK(!buttons_chord(&state, 2000000 + BUTTONS_SERVICE_US - 1));
	CHECK(buttons_chord(&state, 2000000 + BUTTONS_SERVICE_US));
	CHECK(!buttons_chord(&state, 2000001 + BUTTONS_SERVICE_US)); /* once */
	buttons_level(&state, BUTTON_PIN, false, 8000000);
	settled(8000000);
	CHECK(!buttons_chord(&state, 30000000));
}

static void check_gaps(void)
{
	uint32_t last = 0;
	CHECK(!buttons_gap(&last, 1) && !buttons_gap(&last, 2));
	CHECK(buttons_gap(&last, 5) && !buttons_gap(&last, 6));
	last = UINT32_MAX;
	CHECK(!buttons_gap(&last, 0));
}

/* Lines that are nowhere leave a text, not a failure. */
static void check_absent(void)
{
	struct board board = board_default;
	char text[LIVE_TEXT_MAX];
	snprintf(board.button_line[0], BOARD_NAME_MAX, "no line has this name");
	struct live *live = live_open(&board, 0);
	struct buttons *buttons = buttons_open(&board, live, 0);
	CHECK(live && buttons);
	if (buttons)
		buttons_text(buttons, text);
	CHECK(buttons && !strncmp(text, "buttons", 7));
	buttons_close(buttons);
	for (int i = 0; i < BUTTON_COUNT; i++)
		board.button_line[i][0] = 0;
	CHECK(!buttons_open(&board, live, 0));
	live_close(live);
}

int main(void)
{
	check_kernel_debounce();
	check_own_debounce();
	check_held_from_start();
	check_hammered();
	check_stuck();
	check_service();
	check_gaps();
	check_absent();
	return test_end();
}
