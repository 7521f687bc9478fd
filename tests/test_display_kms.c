/* The display's machine against every fault that a card can answer with (fake_card.h), on a clock
 * of its own. The promise: wherever a fault leaves it, the picture is back 3 s after the fault has
 * ended, no step waits longer than its bound, and nothing is left behind. */
#include "fake_card.h"
#include "test.h"

#include <errno.h>

enum { BUFFERS = 4, PROMISE_MS = 3000, STEP_RUN_MS = 75, STEP_MAX_MS = 2000 };

struct buffer {
	uint32_t framebuffer;
	bool held;
};

/* A picture whose buffers are counted, in GL's place. */
struct rig {
	struct kms kms;
	bool open, lose; /* lose: the next frame finds its context lost */
	int refuse;      /* openings that fail */
	struct buffer *buffer;
	int64_t shown_us; /* when a frame was last seen */
	int64_t step_us;  /* the longest step */
	bool gone;
	int failures; /* of the test when this began */
};

static bool picture_open(void *of, const struct kms_card *card, char fault[200])
{
	struct rig *rig = of;
	CHECK(!rig->open && card->fd >= 0 && card->lit);
	if (rig->refuse) {
		rig->refuse--;
		snprintf(fault, 200, "no GL");
		return false;
	}
	rig->open = true;
	rig->buffer = calloc(BUFFERS, sizeof *rig->buffer);
	return true;
}

static void picture_close(void *of)
{
	struct rig *rig = of;
	CHECK(rig->open && rig->kms.card.fd >= 0);
	for (int i = 0; i < BUFFERS; i++) {
		CHECK(!rig->buffer[i].held);
		if (rig->buffer[i].framebuffer)
			fake_calls.remove_framebuffer(rig->kms.card.fd, rig->buffer[i].framebuffer);
	}
	free(rig->buffer);
	rig->buffer = NULL;
	rig->open = false;
}

/* What is drawn into must not be what is seen. */
static void *picture_take(void *of, uint32_t *framebuffer)
{
	struct rig *rig = of;
	const struct kms_card *card = &rig->kms.card;
	int i = 0;
	CHECK(rig->open);
	if (rig->lose) {
		rig->lose = false;
		return NULL;
	}
	while (i < BUFFERS && rig->buffer[i].held)
		i++;
	CHECK(i < BUFFERS);
	struct buffer *buffer = &rig->buffer[i];
	if (!buffer->framebuffer &&
	    fake_calls.add_framebuffer(card->fd, card->mode.hdisplay, card->mode.vdisplay, 1, 4, 0,
				       &buffer->framebuffer))
		return NULL;
	int mode;
	uint32_t seen = fake_seen(&fake[card->number], &mode);
	CHECK(seen != buffer->framebuffer);
	buffer->held = true;
	*framebuffer = buffer->framebuffer;
	return buffer;
}

static void picture_give(void *of, void *given)
{
	struct buffer *buffer = given;
	CHECK(((struct rig *)of)->open && buffer->held);
	buffer->held = false;
}

static const struct kms_picture picture = {picture_open, picture_close, picture_take, picture_give};

/* ---- running ---- */

static bool seen_now(const struct rig *rig)
{
	int mode = -1;
	for (int i = 0; i < FAKE_CARDS; i++) {
		uint32_t seen = fake_seen(&fake[i], &mode);
		for (int k = 0; rig->open && seen && k < BUFFERS; k++)
			if (rig->buffer[k].framebuffer == seen)
				return true;
	}
	return false;
}

static void frame(struct rig *rig)
{
	int64_t from_us = fake_us;
	bool ran = rig->kms.state == KMS_RUN, changed = rig->kms.changed;
	int generation = rig->kms.generation;
	long flips = rig->kms.flips;
	enum display_state state = kms_step(&rig->kms);
	rig->gone = state == DISPLAY_GONE;
	if (state == DISPLAY_READY)
		kms_show(&rig->kms);
	int64_t took_us = fake_us - from_us;
	rig->step_us = took_us > rig->step_us ? took_us : rig->step_us;
	if (ran && !changed && rig->kms.generation == generation && rig->kms.state == KMS_RUN)
		CHECK(took_us <= STEP_RUN_MS * 1000);
	if (rig->kms.flips > flips && seen_now(rig))
		rig->shown_us = fake_us;
	if (took_us < 16000)
		fake_us += 16000 - took_us;
}

static void run_ms(struct rig *rig, int ms)
{
	int64_t until_us = fake_us + (int64_t)ms * 1000;
	while (fake_us < until_us && !rig->gone)
		frame(rig);
}

/* The time until a new frame is seen; the promise and one more when there is none. */
static int back_ms(struct rig *rig)
{
	int64_t from_us = fake_us;
	while (!rig->gone && fake_us < from_us + (PROMISE_MS + 1) * 1000) {
		frame(rig);
		if (rig->shown_us > from_us)
			return (int)((rig->shown_us - from_us) / 1000);
	}
	return PROMISE_MS + 1;
}

static void begin(struct rig *rig)
{
	fake_begin();
	*rig = (struct rig){.failures = test_failures};
	kms_begin(&rig->kms, &fake_calls, &picture, rig);
}

static void begin_lit(struct rig *rig)
{
	begin(rig);
	run_ms(rig, 1000);
	CHECK(rig->kms.state == KMS_RUN && rig->kms.flips > 30);
}

static void end(struct rig *rig, const char *what)
{
	kms_end(&rig->kms);
	bool clean = fake_clean();
	CHECK(clean && rig->step_us <= (int64_t)STEP_MAX_MS * 1000);
	if (test_failures > rig->failures)
		fprintf(stderr, "  after %s; longest step %d ms\n", what,
			(int)(rig->step_us / 1000));
}

static int mode_seen(void)
{
	int mode = -1;
	return fake_seen(&fake[0], &mode) ? mode : -1;
}

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

/* ---- screens that come and go ---- */

static void screen_away(bool told, bool told_back, int connector, int modes_offset)
{
	struct rig rig;
	begin_lit(&rig);
	fake_screen(&fake[0], 0, false, true); /* the kernel notices; told: with an event */
	rig.kms.changed = told;
	run_ms(&rig, told ? 300 : 1000);
	CHECK(rig.kms.state == KMS_NO_DISPLAY && fake[0].framebuffers == 0);
	CHECK(!fake[0].crtc_active[0] && rig.kms.unplugged == 1);
	run_ms(&rig, 60000);
	fake[0].connector[connector].modes_offset = modes_offset;
	fake[0].connector[connector].mode_count = modes_offset ? 2 : 4;
	fake_screen(&fake[0], connector, true, told_back);
	rig.kms.changed = told_back;
	CHECK(back_ms(&rig) <= PROMISE_MS && rig.kms.generation == 2);
	CHECK(mode_seen() == modes_offset);
	end(&rig, "a screen that was away");
}

static void a_short_absence_sets_the_mode_again(void)
{
	struct rig rig;
	begin_lit(&rig);
	long modesets = fake[0].modesets;
	rig.kms.changed = true;
	run_ms(&rig, 300);
	CHECK(rig.kms.state == KMS_RUN && fake[0].modesets == modesets + 1);
	CHECK(rig.kms.generation == 1);
	end(&rig, "a short absence");
}

static void another_screen_at_once(void)
{
	struct rig rig;
	begin_lit(&rig);
	fake[0].connector[0].modes_offset = 4;
	fake[0].connector[0].mode_count = 2;
	run_ms(&rig, 1500);
	CHECK(rig.kms.generation == 2 && mode_seen() == 4);
	end(&rig, "another screen");
}

static void screens_come_and_go_a_thousand_times(void)
{
	struct rig rig;
	begin_lit(&rig);
	for (int i = 0; i < 1000; i++) {
		int connector = i % FAKE_CONNECTORS;
		for (int k = 0; k < FAKE_CONNECTORS; k++)
			fake_screen(&fake[0], k, false, true);
		rig.kms.changed = i & 1;
		run_ms(&rig, 600);
		CHECK(rig.kms.state == KMS_NO_DISPLAY);
		fake_screen(&fake[0], connector, true, i & 2);
		CHECK(back_ms(&rig) <= PROMISE_MS);
	}
	end(&rig, "a thousand absences");
}

/* ---- GL ---- */

static void context_lost(void)
{
	struct rig rig;
	begin_lit(&rig);
	rig.lose = true;
	CHECK(back_ms(&rig) <= 500 && rig.kms.generation == 2 && rig.kms.reopened == 0);
	rig.lose = true;
	rig.refuse = 2;
	CHECK(back_ms(&rig) <= PROMISE_MS && rig.kms.generation == 3 && rig.kms.reopened == 0);
	rig.lose = true;
	rig.refuse = 100;
	run_ms(&rig, 20000);
	CHECK(rig.gone && strstr(rig.kms.reason, "no GL") && rig.kms.reopened == 3);
	end(&rig, "a lost context");
}

/* ---- all of it ---- */

static uint32_t random_state = 1;

static int random_below(int limit)
{
	random_state = random_state * 1664525u + 1013904223u;
	return (int)((random_state >> 8) % (uint32_t)limit);
}

static void something_happens(struct rig *rig)
{
	static const int errors[] = {-EBUSY,  -EACCES, -EINVAL, -ENOSPC, -ENODEV,
				     -ENOMEM, -EINTR,  -EIO,    -ERANGE};
	struct fake_card *card = &fake[random_below(FAKE_CARDS)];
	bool told = random_below(2);
	switch (random_below(12)) {
	case 0:
	case 1:
		card->fault = (struct fake_fault){1u + (unsigned)random_below(15),
						  errors[random_below(COUNT_OF(errors))],
						  1 + random_below(20)};
		break;
	case 2:
		card->events_lost = 1 + random_below(2);
		break;
	case 3:
		card->event_late_ms = random_below(1500);
		break;
	case 4:
	case 5:
		fake_screen(card, random_below(FAKE_CONNECTORS), random_below(2), told);
		rig->kms.changed |= told;
		break;
	case 6:
		card->other_master ^= 1;
		break;
	case 7:
		card->there ^= 1;
		card->unplugged = !card->there;
		break;
	case 8:
		card->modes_refused = (unsigned)random_below(16);
		card->modes_lied = (unsigned)random_below(16);
		break;
	case 9:
		rig->lose = true;
		rig->refuse = random_below(3);
		break;
	case 10:
		card->memory_full ^= 1;
		break;
	default:
		card->no_objects ^= 1;
	}
}

/* Everything is sound again; what the kernel knows about screens may still be wrong. */
static void calm(struct rig *rig)
{
	for (int i = 0; i < FAKE_CARDS; i++) {
		struct fake_card *card = &fake[i];
		card->there = i == 0;
		card->unplugged = i != 0;
		card->fault.count = card->events_lost = card->event_late_ms = 0;
		card->modes_refused = card->modes_lied = 0;
		card->other_master = card->memory_full = card->no_objects = false;
		fake_screen(card, 0, true, true);
	}
	rig->lose = false;
	rig->refuse = 0;
	rig->kms.changed = true;
}

/* However the faults fall together: the picture comes back in time, or the machine has given up as
 * the ladder says. */
static void storms(void)
{
	struct rig rig;
	int worst_ms = 0;
	for (int storm = 0; storm < 400; storm++) {
		begin_lit(&rig);
		for (int i = 0; i < 20 && !rig.gone; i++) {
			something_happens(&rig);
			run_ms(&rig, random_below(900));
		}
		if (!rig.gone) {
			calm(&rig);
			int ms = back_ms(&rig);
			worst_ms = int_max(worst_ms, ms);
			CHECK(ms <= PROMISE_MS);
			if (ms > PROMISE_MS)
				printf("storm %d: state %d, %s\n", storm, rig.kms.state,
				       rig.kms.reason);
		}
		end(&rig, "a storm");
	}
	printf("storms: picture back after %d ms at most\n", worst_ms);
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
	for (int i = 0; i < 4; i++)
		screen_away(i & 1, i & 2, 0, 0);
	screen_away(true, true, 2, 0);
	screen_away(false, false, 1, 4);
	a_short_absence_sets_the_mode_again();
	another_screen_at_once();
	screens_come_and_go_a_thousand_times();
	context_lost();
	storms();
	return test_end();
}
