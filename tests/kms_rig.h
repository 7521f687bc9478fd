/* The display's machine on simulated cards, on a clock of its own, with a picture whose buffers are
 * counted; for tests. */
#ifndef KMS_RIG_H
#define KMS_RIG_H

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

static inline bool picture_open(void *of, const struct kms_card *card, char fault[200])
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

static inline void picture_close(void *of)
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
static inline void *picture_take(void *of, uint32_t *framebuffer)
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

static inline void picture_give(void *of, void *given)
{
	struct buffer *buffer = given;
	CHECK(((struct rig *)of)->open && buffer->held);
	buffer->held = false;
}

static const struct kms_picture picture = {picture_open, picture_close, picture_take, picture_give};

/* ---- running ---- */

static inline bool seen_now(const struct rig *rig)
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

static inline void frame(struct rig *rig)
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

static inline void run_ms(struct rig *rig, int ms)
{
	int64_t until_us = fake_us + (int64_t)ms * 1000;
	while (fake_us < until_us && !rig->gone)
		frame(rig);
}

/* The time until a new frame is seen; the promise and one more when there is none. */
static inline int back_ms(struct rig *rig)
{
	int64_t from_us = fake_us;
	while (!rig->gone && fake_us < from_us + (PROMISE_MS + 1) * 1000) {
		frame(rig);
		if (rig->shown_us > from_us)
			return (int)((rig->shown_us - from_us) / 1000);
	}
	return PROMISE_MS + 1;
}

static inline void begin(struct rig *rig)
{
	fake_begin();
	*rig = (struct rig){.failures = test_failures};
	kms_begin(&rig->kms, &fake_calls, &picture, rig);
}

static inline void begin_lit(struct rig *rig)
{
	begin(rig);
	run_ms(rig, 1000);
	CHECK(rig->kms.state == KMS_RUN && rig->kms.flips > 30);
}

static inline void end(struct rig *rig, const char *what)
{
	kms_end(&rig->kms);
	bool clean = fake_clean();
	CHECK(clean && rig->step_us <= (int64_t)STEP_MAX_MS * 1000);
	if (test_failures > rig->failures)
		fprintf(stderr, "  after %s; longest step %d ms\n", what,
			(int)(rig->step_us / 1000));
}

static inline int mode_seen(void)
{
	int mode = -1;
	return fake_seen(&fake[0], &mode) ? mode : -1;
}

#endif
