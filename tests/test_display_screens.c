/* The display's machine when screens come and go, with a word and without, when GL is lost, and in
 * storms of every fault at once: the promise of test_display_kms.c. */
#include "kms_rig.h"

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
