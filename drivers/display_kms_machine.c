/* The machine that keeps a picture on a screen.
 *
 *            a card shows     it lets us be    a screen is       a mode is lit,
 *            pictures         its master       connected         GL is there
 *    NO_CARD --------> NO_MASTER -----> NO_DISPLAY -----> MODESET -----> RUN <----> LOST
 *       ^ ^               ^                 ^                ^           | |  GL lost its
 *       | |               |                 |                |           | |  context; made anew
 *       | |               |                 |                +-----------+ |
 *       | |               |                 |   EINVAL, ENOSPC, ERANGE:  | |
 *       | |               |                 |   the next mode            | |
 *       | |               |                 +----------------------------+ |
 *       | |               |                     connector gone: dark first |
 *       | |               +------------------------------------------------+
 *       | |                                     EACCES, EPERM              |
 *       | +----------------------------------------------------------------+
 *       |                                       ENODEV, hang-up            |
 *       +-- the ladder, for a flip whose event is late (a second, or three frames):
 *             1. the same frame again, with the mode
 *             2. everything closed, the card opened anew
 *             3. when that has not brought one flip three times: BROKEN, and the host ends the
 *                program, which the system's service manager starts again
 *           EBUSY says that an older flip is under way: the frame waits for it, on the same clock.
 *
 * Nothing waits without an end. Below RUN every card is looked at when something happened to one,
 * and every second anyhow. In RUN a step waits for a flip two frames at most; when its event is
 * late the host goes on without pictures, and the clock of the ladder runs. No error ever says that
 * a screen has gone, so the connector is looked at twice a second.
 *
 * A screen that comes back is found within SEARCH_MS and lit within the card's own time for a mode:
 * the promise is 3 s from its return to the first picture.
 */
#include "display_kms.h"

#include <errno.h>
#include <stdio.h>

enum {
	SEARCH_MS = 1000,
	LOOK_MS = 500,
	FLIP_LATE_MS = 1000,
	FLIP_LATE_MORE_MS = 200, /* beside three frames */
	FAILED_MAX = 3,
	LOST_MAX = 3,
};

/* ---- letting go ---- */

static void buffers_give(struct kms *kms)
{
	if (kms->shown)
		kms->picture->give(kms->of, kms->shown);
	if (kms->next)
		kms->picture->give(kms->of, kms->next);
	kms->shown = kms->next = NULL;
	kms->asked = kms->again = false;
	kms->ticket[0].void_now = kms->ticket[1].void_now = true;
	kms->rung = 0;
}

static void picture_close(struct kms *kms)
{
	buffers_give(kms);
	if (kms->opened)
		kms->picture->close(kms->of);
	kms->opened = false;
}

/* Screen dark, then buffers, then what they were made from, then the mode. */
static void pull_down(struct kms *kms, enum kms_state state)
{
	kms_dark(&kms->card);
	picture_close(kms);
	kms_mode_drop(&kms->card);
	if (state < KMS_NO_DISPLAY)
		kms_card_close(&kms->card);
	kms->state = state;
	kms->due_ms = kms->calls->clock_ms();
}

static void reopen(struct kms *kms)
{
	kms->reopened++;
	pull_down(kms, KMS_NO_CARD);
	if (++kms->failed >= FAILED_MAX)
		kms->state = KMS_BROKEN;
}

/* What an error of the card means. */
static void refused(struct kms *kms, int error)
{
	snprintf(kms->reason, sizeof kms->reason, "%s: %s", kms->card.path, strerror(-error));
	if (error == -EACCES || error == -EPERM) {
		pull_down(kms, KMS_NO_MASTER);
	} else if (error == -ENODEV || error == -ENXIO) {
		pull_down(kms, KMS_NO_CARD);
	} else if (error == -EINVAL || error == -ENOSPC || error == -ERANGE) {
		kms_mode_refuse(&kms->card);
		pull_down(kms, KMS_MODESET);
	} else {
		reopen(kms);
	}
}

/* ---- the way to a picture ---- */

/* Looks at the card that we have, and at all others; keeps the one that leads farthest. */
static void search(struct kms *kms)
{
	char line[200];
	enum kms_state best = KMS_NO_CARD;
	snprintf(kms->reason, sizeof kms->reason,
		 "no /dev/dri/card*: the kernel has no display driver for this machine");
	if (kms->card.fd >= 0)
		best = kms_card_examine(&kms->card, kms->reason);
	for (int i = 0; i < KMS_CARDS_MAX && best < KMS_MODESET; i++) {
		struct kms_card other;
		line[0] = 0;
		bool ours = kms->card.fd >= 0 && kms->card.number == i;
		bool open = !ours && kms_card_open(&other, kms->calls, i, line);
		enum kms_state state = open ? kms_card_examine(&other, line) : KMS_NO_CARD;
		if (open && state > best) {
			kms_card_close(&kms->card);
			kms->card = other;
			best = state;
			memcpy(kms->reason, line, sizeof line);
		} else if (open) {
			kms_card_close(&other);
		}
		if (line[0] && best == KMS_NO_CARD && !strstr(line, "render-only"))
			memcpy(kms->reason, line, sizeof line);
	}
	if (best < KMS_NO_DISPLAY) /* mastery is asked for by opening anew */
		kms_card_close(&kms->card);
	kms->state = best;
}

/* GL is to be made anew; when that has brought no flip three times, so is the rest. */
static void picture_lost(struct kms *kms, int pause_ms)
{
	kms->state = KMS_LOST;
	kms->due_ms = kms->calls->clock_ms() + pause_ms;
	if (++kms->lost > LOST_MAX) {
		kms->lost = 0;
		reopen(kms);
	}
}

static void picture_open(struct kms *kms)
{
	if (kms->picture->open(kms->of, &kms->card, kms->reason)) {
		kms->opened = true;
		kms->generation++;
		kms->reason[0] = 0;
		kms->state = KMS_RUN;
		kms->due_ms = kms->calls->clock_ms() + LOOK_MS;
		return;
	}
	picture_lost(kms, SEARCH_MS);
}

static void light(struct kms *kms)
{
	int result = kms_mode_light(&kms->card, kms->width, kms->height);
	if (result == 0) {
		picture_open(kms);
		return;
	}
	snprintf(kms->reason, sizeof kms->reason,
		 "%s accepts none of the screen's modes (%s): try another cable or screen",
		 kms->card.path, strerror(-result));
	kms_mode_forgive(&kms->card);
	if (result == -EACCES || result == -EPERM || result == -ENODEV)
		refused(kms, result);
	kms->due_ms = kms->calls->clock_ms() + SEARCH_MS;
}

static void climb(struct kms *kms)
{
	int64_t now_ms = kms->calls->clock_ms();
	if (!kms->changed && now_ms < kms->due_ms)
		return;
	kms->changed = false;
	kms->due_ms = now_ms + SEARCH_MS;
	if (kms->state == KMS_LOST) {
		picture_open(kms);
		return;
	}
	search(kms);
	if (kms->state == KMS_MODESET)
		light(kms);
}

/* ---- flips ---- */

static int frame_ms(const struct kms *kms)
{
	int hz = (int)kms->card.mode.vrefresh;
	return hz > 0 ? int_clamp(1000 / hz, 1, 100) : 17;
}

static void deadline_set(struct kms *kms)
{
	int late_ms = int_max(FLIP_LATE_MS, 3 * frame_ms(kms) + FLIP_LATE_MORE_MS);
	kms->deadline_ms = kms->calls->clock_ms() + late_ms;
}

/* Each commit has a ticket of its own, so that a late event of the one before isn't taken for its
 * own. */
static void flip_ask(struct kms *kms)
{
	struct kms_ticket *ticket = &kms->ticket[!kms->ticket_now];
	kms->ticket[kms->ticket_now].void_now = true;
	*ticket = (struct kms_ticket){.kms = kms};
	int result = kms_flip(&kms->card, kms->framebuffer, kms->again, ticket);
	kms->asked = result == 0;
	if (result == 0) {
		kms->again = false;
		kms->ticket_now = !kms->ticket_now;
	} else if (result != -EBUSY && result != -EAGAIN && result != -EINTR && result != -ENOMEM) {
		refused(kms, result);
	}
}

static void flip_done(int fd, unsigned sequence, unsigned seconds, unsigned micros, unsigned crtc,
		      void *data)
{
	struct kms_ticket *ticket = data;
	struct kms *kms = ticket->kms;
	(void)fd, (void)sequence, (void)seconds, (void)micros, (void)crtc;
	if (ticket->void_now || !kms->asked)
		return;
	if (kms->shown)
		kms->picture->give(kms->of, kms->shown);
	kms->shown = kms->next;
	kms->next = NULL;
	kms->asked = false;
	kms->rung = kms->failed = kms->lost = 0;
	kms->flips++;
}

static void ladder(struct kms *kms)
{
	kms->late++;
	if (kms->rung++ > 0) {
		snprintf(kms->reason, sizeof kms->reason, "%s: no flip comes to an end",
			 kms->card.path);
		reopen(kms);
		return;
	}
	kms->again = true;
	deadline_set(kms);
	flip_ask(kms);
}

/* One wait, and what came of it. */
static void event_read(struct kms *kms, int limit_ms)
{
	drmEventContext events = {.version = 3, .page_flip_handler2 = flip_done};
	int result = kms->calls->wait(kms->card.fd, limit_ms);
	if (result > 0)
		result = kms->calls->handle_event(kms->card.fd, &events) ? -ENODEV : 0;
	if (result < 0)
		refused(kms, -ENODEV);
}

/* Waits for the event that is due, or to be let in by the kernel, two frames at most. A flip is
 * late when it hasn't come by now, not when nobody has looked for so long. */
static void flip_wait(struct kms *kms)
{
	int64_t now_ms = kms->calls->clock_ms(), until_ms = now_ms + 2 * frame_ms(kms);
	while (kms->state == KMS_RUN && kms->next && now_ms < until_ms) {
		bool late = now_ms >= kms->deadline_ms;
		if (!kms->asked && !late)
			flip_ask(kms);
		if (kms->state == KMS_RUN)
			event_read(kms, late ? 0 : kms->asked ? (int)(until_ms - now_ms) : 2);
		if (late && kms->state == KMS_RUN && kms->next) {
			ladder(kms);
			return;
		}
		now_ms = kms->calls->clock_ms();
	}
}

/* ---- running ---- */

/* The same screen after something happened may have been away for a moment: its mode is set again
 * with the next frame. */
static void look(struct kms *kms)
{
	int64_t now_ms = kms->calls->clock_ms();
	if (!kms->changed && now_ms < kms->due_ms)
		return;
	bool changed = kms->changed;
	kms->due_ms = now_ms + LOOK_MS;
	kms->again |= changed;
	kms->changed = false;
	if (kms_card_connected(&kms->card, changed))
		return;
	snprintf(kms->reason, sizeof kms->reason, "%s: the screen is gone", kms->card.path);
	kms->unplugged++;
	kms_mode_forgive(&kms->card);
	pull_down(kms, KMS_NO_DISPLAY);
}

enum display_state kms_step(struct kms *kms)
{
	if (kms->state == KMS_RUN)
		look(kms);
	if (kms->state == KMS_RUN)
		flip_wait(kms);
	if (kms->state < KMS_RUN)
		climb(kms);
	if (kms->state == KMS_BROKEN)
		return DISPLAY_GONE;
	return kms->state == KMS_RUN && !kms->next ? DISPLAY_READY : DISPLAY_DARK;
}

/* The screen is black while GL is made anew: what it showed goes with the old context. */
static void context_lost(struct kms *kms)
{
	snprintf(kms->reason, sizeof kms->reason, "%s: the GPU lost its context", kms->card.path);
	kms_black(&kms->card);
	picture_close(kms);
	picture_lost(kms, 0);
}

bool kms_show(struct kms *kms)
{
	MUST(kms->state == KMS_RUN && !kms->next);
	kms->next = kms->picture->take(kms->of, &kms->framebuffer);
	if (!kms->next) {
		context_lost(kms);
		return false;
	}
	long flips = kms->flips;
	deadline_set(kms);
	flip_ask(kms);
	if (kms->state == KMS_RUN)
		flip_wait(kms);
	return kms->flips > flips;
}

void kms_begin(struct kms *kms, const struct kms_calls *calls, const struct kms_picture *picture,
	       void *of)
{
	*kms = (struct kms){.calls = calls, .picture = picture, .of = of, .card.fd = -1};
	kms->card.calls = calls;
}

void kms_end(struct kms *kms)
{
	pull_down(kms, KMS_NO_CARD);
}
