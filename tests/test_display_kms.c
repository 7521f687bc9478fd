/* The display's machine against every fault that a card can answer with (fake_card.h), on a clock
 * of its own: the way to a picture, modes, commits and flips. The promise: wherever a fault leaves
 * it, the picture is back 3 s after the fault has ended, no step waits longer than its bound, and
 * nothing is left behind. */
#include "kms_rig.h"

/* ---- the way to a picture ---- */

static void a_sound_card_shows_every_frame(void)
{
	struct rig rig;
	begin_lit(&rig);
	long flips = rig.kms.flips;
	run_ms(&rig, 1000);
	CHECK(rig.kms.flips - flips >= 58 && rig.kms.late == 0 && rig.kms.generation == 1);
	CHECK(mode_seen() == 0 && fake[0].modesets == 1);
	end(&rig, "nothing at all");
	CHECK(mode_seen() == -1);
}

static void no_card_then_one(void)
{
	struct rig rig;
	begin(&rig);
	fake[0].there = false;
	run_ms(&rig, 5000);
	CHECK(rig.kms.state == KMS_NO_CARD && strstr(rig.kms.reason, "/dev/dri"));
	fake[0].there = true;
	CHECK(back_ms(&rig) <= PROMISE_MS);
	end(&rig, "a card that came late");
}

static void cards_without_pictures_are_passed_by(void)
{
	struct rig rig;
	begin(&rig);
	fake[0].render_only = true;
	fake[1].there = true;
	fake_screen(&fake[1], 2, true, false);
	CHECK(back_ms(&rig) <= PROMISE_MS && rig.kms.card.number == 1);
	end(&rig, "a render-only card");
	begin(&rig);
	fake[0].no_atomic = true;
	run_ms(&rig, 3000);
	CHECK(rig.kms.state == KMS_NO_CARD && strstr(rig.kms.reason, "atomic"));
	end(&rig, "a card without atomic mode setting");
}

static void splash_screen_holds_the_card(void)
{
	struct rig rig;
	begin(&rig);
	fake[0].other_master = true;
	run_ms(&rig, 10000);
	CHECK(rig.kms.state == KMS_NO_MASTER && strstr(rig.kms.reason, "another program"));
	fake[0].other_master = false;
	CHECK(back_ms(&rig) <= PROMISE_MS);
	end(&rig, "a splash screen");
}

static void boot_without_a_screen(void)
{
	struct rig rig;
	for (int told = 0; told < 2; told++) {
		begin(&rig);
		fake_screen(&fake[0], 0, false, true);
		run_ms(&rig, 8000);
		CHECK(rig.kms.state == KMS_NO_DISPLAY && strstr(rig.kms.reason, "no screen"));
		fake_screen(&fake[0], 1, true, told);
		rig.kms.changed = told;
		CHECK(back_ms(&rig) <= PROMISE_MS);
		end(&rig, "a screen that came late");
	}
}

static void screen_on_the_other_card(void)
{
	struct rig rig;
	begin(&rig);
	fake_screen(&fake[0], 0, false, true);
	fake[1].there = true;
	run_ms(&rig, 3000);
	CHECK(rig.kms.state == KMS_NO_DISPLAY);
	fake_screen(&fake[1], 0, true, true);
	CHECK(back_ms(&rig) <= PROMISE_MS && rig.kms.card.number == 1);
	end(&rig, "a screen on the other card");
}

/* ---- modes ---- */

static void modes_are_tried_until_one_is_taken(void)
{
	struct rig rig;
	begin(&rig);
	fake[0].modes_refused = 1;
	CHECK(back_ms(&rig) <= PROMISE_MS && mode_seen() == 1);
	end(&rig, "a refused mode");
	begin(&rig);
	fake[0].modes_lied = 3;
	CHECK(back_ms(&rig) <= PROMISE_MS && mode_seen() == 2 && rig.kms.generation == 1);
	end(&rig, "modes that only TEST_ONLY took");
	begin(&rig);
	rig.kms.width = 800;
	rig.kms.height = 600;
	CHECK(back_ms(&rig) <= PROMISE_MS && mode_seen() == 3);
	end(&rig, "a wanted mode");
	begin(&rig);
	fake[0].mode_asked = 1 + 1;
	CHECK(back_ms(&rig) <= PROMISE_MS && mode_seen() == 1);
	end(&rig, "a mode on the kernel's command line");
	begin(&rig);
	fake[0].modes_refused = 15;
	run_ms(&rig, 5000);
	CHECK(rig.kms.state == KMS_MODESET && strstr(rig.kms.reason, "none of the screen's modes"));
	fake[0].modes_refused = 0;
	CHECK(back_ms(&rig) <= PROMISE_MS && mode_seen() == 0);
	end(&rig, "no mode at all");
}

static void a_flip_refused_takes_the_next_mode(void)
{
	static const int error[] = {-EINVAL, -ENOSPC, -ERANGE};
	struct rig rig;
	for (int i = 0; i < COUNT_OF(error); i++) {
		begin_lit(&rig);
		fake[0].fault = (struct fake_fault){FAKE_FLIP, error[i], 1};
		CHECK(back_ms(&rig) <= PROMISE_MS && mode_seen() == 1);
		end(&rig, "a refused flip");
	}
}

/* ---- commits that fail ---- */

static void busy_commits_wait_their_turn(void)
{
	struct rig rig;
	begin_lit(&rig);
	fake[0].fault = (struct fake_fault){FAKE_FLIP, -EBUSY, 10};
	CHECK(back_ms(&rig) <= 100 && rig.kms.late == 0 && rig.kms.generation == 1);
	fake[0].fault = (struct fake_fault){FAKE_ALL, -EBUSY, -1};
	run_ms(&rig, 1500);
	CHECK(rig.kms.late > 0);
	fake[0].fault.count = 0;
	CHECK(back_ms(&rig) <= PROMISE_MS);
	end(&rig, "EBUSY");
}

static void another_program_takes_the_card(void)
{
	struct rig rig;
	begin_lit(&rig);
	fake[0].other_master = true;
	run_ms(&rig, 5000);
	CHECK(rig.kms.state == KMS_NO_MASTER && fake[0].fds == 0);
	fake[0].other_master = false;
	CHECK(back_ms(&rig) <= PROMISE_MS && rig.kms.generation == 2);
	end(&rig, "EACCES");
}

static void card_is_taken_out(void)
{
	struct rig rig;
	begin_lit(&rig);
	fake[0].unplugged = true;
	fake[0].there = false;
	run_ms(&rig, 5000);
	CHECK(rig.kms.state == KMS_NO_CARD && fake[0].fds == 0);
	fake[1].there = true; /* it comes back under another number */
	fake_screen(&fake[1], 0, true, true);
	CHECK(back_ms(&rig) <= PROMISE_MS && rig.kms.card.number == 1);
	end(&rig, "ENODEV");
}

static void no_memory_on_the_card(void)
{
	struct rig rig;
	begin(&rig);
	fake[0].memory_full = true;
	run_ms(&rig, 2500);
	CHECK(rig.kms.state == KMS_MODESET);
	fake[0].memory_full = false;
	CHECK(back_ms(&rig) <= PROMISE_MS);
	fake[0].fault = (struct fake_fault){FAKE_FLIP, -ENOMEM, 20};
	CHECK(back_ms(&rig) <= PROMISE_MS);
	fake[0].no_objects = true;
	run_ms(&rig, 3000);
	CHECK(rig.kms.state == KMS_NO_DISPLAY);
	fake[0].no_objects = false;
	CHECK(back_ms(&rig) <= PROMISE_MS);
	end(&rig, "ENOMEM");
}

/* ---- flips that don't come ---- */

static void one_lost_event(void)
{
	struct rig rig;
	begin_lit(&rig);
	fake[0].events_lost = 1;
	CHECK(back_ms(&rig) <= PROMISE_MS);
	CHECK(rig.kms.late == 1 && rig.kms.reopened == 0 && rig.kms.generation == 1);
	run_ms(&rig, 500);
	fake[0].events_lost = 1; /* the ladder begins at its foot again */
	CHECK(back_ms(&rig) <= PROMISE_MS);
	CHECK(rig.kms.late == 2 && rig.kms.reopened == 0 && rig.kms.generation == 1);
	fake[0].event_late_ms = 100;
	frame(&rig);
	CHECK(rig.kms.next);
	fake_us += 5000000; /* we were stopped, the flip was not late */
	CHECK(back_ms(&rig) <= 100 && rig.kms.late == 2);
	end(&rig, "a lost event");
}

static void two_lost_events_reopen_the_card(void)
{
	struct rig rig;
	begin_lit(&rig);
	fake[0].events_lost = 2;
	CHECK(back_ms(&rig) <= PROMISE_MS);
	CHECK(rig.kms.late == 2 && rig.kms.reopened == 1 && rig.kms.generation == 2);
	run_ms(&rig, 500);
	CHECK(rig.kms.failed == 0 && rig.kms.rung == 0);
	end(&rig, "two lost events");
}

static void no_event_ever(void)
{
	struct rig rig;
	begin_lit(&rig);
	fake[0].events_lost = -1;
	run_ms(&rig, 20000);
	CHECK(rig.gone && rig.kms.state == KMS_BROKEN && rig.kms.reopened == 3);
	CHECK(strstr(rig.kms.reason, "no flip") && fake_clean());
	end(&rig, "flips that never come");
}

/* The event of the late flip arrives after the frame was asked for again: it isn't that one's. */
static void late_events_are_told_from_new_ones(void)
{
	struct rig rig;
	begin_lit(&rig);
	fake[0].event_late_ms = 1100;
	CHECK(back_ms(&rig) <= PROMISE_MS);
	CHECK(rig.kms.late == 1 && rig.kms.reopened == 0);
	long flips = rig.kms.flips;
	run_ms(&rig, 1000);
	CHECK(rig.kms.flips - flips >= 58);
	fake[0].events_lost = 1; /* and when the card lets the second commit in before the event */
	fake[0].stale_event = true;
	CHECK(back_ms(&rig) <= PROMISE_MS);
	run_ms(&rig, 500);
	CHECK(rig.kms.late == 2 && rig.kms.reopened == 0);
	fake[0].event_late_ms = 400;
	CHECK(back_ms(&rig) <= 600 && rig.kms.late == 2);
	end(&rig, "a late event");
}

static void a_pipe_hangs(void)
{
	struct rig rig;
	begin_lit(&rig);
	fake[0].hung = true;
	run_ms(&rig, 1500);
	CHECK(rig.kms.late == 1 && rig.kms.state == KMS_RUN);
	fake[0].hung = false;
	CHECK(back_ms(&rig) <= PROMISE_MS && rig.kms.reopened == 0);
	fake[0].hung = true;
	run_ms(&rig, 2500);
	CHECK(rig.kms.reopened == 1);
	fake[0].hung = false;
	CHECK(back_ms(&rig) <= PROMISE_MS);
	kms_end(&rig.kms);
	CHECK(fake_clean());
}

int main(void)
{
	a_sound_card_shows_every_frame();
	no_card_then_one();
	cards_without_pictures_are_passed_by();
	splash_screen_holds_the_card();
	boot_without_a_screen();
	screen_on_the_other_card();
	modes_are_tried_until_one_is_taken();
	a_flip_refused_takes_the_next_mode();
	busy_commits_wait_their_turn();
	another_program_takes_the_card();
	card_is_taken_out();
	no_memory_on_the_card();
	one_lost_event();
	two_lost_events_reopen_the_card();
	no_event_ever();
	late_events_are_told_from_new_ones();
	a_pipe_hangs();
	return test_end();
}
