/* A queue of samples whose contact is in doubt; the machine is drawn in pen_settle.h. */
#include "pen_settle.h"

#include "pen_filter.h"

enum { CONTACT_REPORTS = 16 }; /* 15 ms at 1000 reports a second */

#define FIRM 0.15f /* of the pressure: a hand that lifts has less */

/* A full frame keeps its newest state: the last sample is the one that later frames build on. */
static void give(struct pen *pen, int device, const struct pen_sample *sample,
		 struct frame_input *input)
{
	if (input->sample_count == FRAME_SAMPLES_MAX)
		input->sample_count--;
	input->sample[input->sample_count++] = *sample;
	pen->device[device].last = *sample;
	pen->device[device].state = sample->state;
	if (sample->state == PEN_TOUCH)
		pen->touching = device;
	else if (pen->touching == device)
		pen->touching = -1;
}

/* Gives what waits: as it came, or all of it as `state`. */
static void queue_give(struct pen *pen, int device, bool as_it_came, enum pen_state state,
		       struct frame_input *input)
{
	struct pen_device *d = &pen->device[device];
	float pressure = d->last.pressure;
	for (int i = 0; i < d->waiting_count; i++) {
		struct pen_sample sample = d->waiting[i];
		if (!as_it_came && sample.state != state) {
			sample.state = state;
			sample.pressure = state == PEN_TOUCH ? pressure : 0.0f;
		}
		give(pen, device, &sample, input);
	}
	d->waiting_count = 0;
	d->doubt = PEN_SURE;
}

static void queue_add(struct pen *pen, int device, const struct pen_sample *sample,
		      struct frame_input *input)
{
	struct pen_device *d = &pen->device[device];
	if (d->waiting_count == PEN_WAITING_MAX)
		queue_give(pen, device, true, PEN_AWAY, input);
	if (d->doubt == PEN_SURE)
		give(pen, device, sample, input);
	else
		d->waiting[d->waiting_count++] = *sample;
}

static void doubt_begin(struct pen *pen, int device, enum pen_doubt doubt,
			const struct pen_sample *sample, struct frame_input *input)
{
	struct pen_device *d = &pen->device[device];
	d->doubt = doubt;
	d->doubt_us = sample->time_us;
	pen->touching = device;
	queue_add(pen, device, sample, input);
}

static bool doubtful(const struct pen *pen, const struct pen_device *d, bool touch)
{
	bool down = d->state == PEN_TOUCH;
	if (touch == down || d->desktop)
		return false;
	return touch ? pen->contact_least_us > 0 : pen->merge_us > 0 && d->last.pressure >= FIRM;
}

void pen_settle(struct pen *pen, int device, const struct pen_sample *sample, struct v2 mm,
		struct frame_input *input)
{
	struct pen_device *d = &pen->device[device];
	bool touch = sample->state == PEN_TOUCH;
	pen_settle_time(pen, device, sample->time_us, input);
	if (d->doubt == PEN_BEGUN && d->waiting_count >= CONTACT_REPORTS)
		queue_give(pen, device, true, PEN_AWAY, input);
	if (d->doubt == PEN_BEGUN && !touch) {
		d->chatter++;
		queue_give(pen, device, false, PEN_HOVER, input);
	} else if (d->doubt == PEN_LIFTED && touch) {
		bool same = !pen_jump(d->lifted_mm, mm, sample->time_us - d->doubt_us);
		d->merged += same;
		queue_give(pen, device, !same, PEN_TOUCH, input);
	}
	if (d->doubt != PEN_SURE) {
		queue_add(pen, device, sample, input);
	} else if (doubtful(pen, d, touch)) {
		doubt_begin(pen, device, touch ? PEN_BEGUN : PEN_LIFTED, sample, input);
	} else {
		give(pen, device, sample, input);
	}
	if (touch)
		d->lifted_mm = mm;
}

void pen_settle_time(struct pen *pen, int device, int64_t now_us, struct frame_input *input)
{
	struct pen_device *d = &pen->device[device];
	int64_t most_us = d->doubt == PEN_BEGUN ? pen->contact_least_us : pen->merge_us;
	if (d->doubt != PEN_SURE && now_us - d->doubt_us >= most_us)
		queue_give(pen, device, true, PEN_AWAY, input);
}

void pen_settle_end(struct pen *pen, int device, struct frame_input *input)
{
	queue_give(pen, device, true, PEN_AWAY, input);
}
