/* The steps of a recipe, one after the other; see pen_setup.h. */
#include "pen_setup.h"

#include <stdio.h>

enum { TRIES = 3, FEATURE_TRIES = 5, OUTPUT_BYTES_MAX = 64 };

struct setup {
	const struct pen_identity *identity;
	const struct pen_recipe *recipe;
	const struct pen_transport *transport;
	struct pen_setup_result *result;
	struct pen_answers answers;
};

static bool stopped(const struct setup *s)
{
	return s->result->gone ||
	       (s->transport->stopped && s->transport->stopped(s->transport->context));
}

static int note(struct setup *s, int moved)
{
	s->result->tries++;
	s->result->gone |= moved == -PEN_SETUP_GONE;
	return moved;
}

static bool complete(struct setup *s)
{
	struct pen_vendor vendor;
	float width_mm, height_mm;
	char reason[160];
	return pen_identify_end(s->identity, s->recipe, &s->answers, &vendor, &width_mm, &height_mm,
				reason);
}

/* A refusal is an answer: the tablet has no such string. Only silence is asked again. What is
 * longer than its own head says is kept as it came; whoever reads it decides. */
static void step_string(struct setup *s, const struct pen_step *step)
{
	MUST(s->answers.count < PEN_STEPS_MAX);
	uint8_t *bytes = s->answers.answer[s->answers.count].bytes;
	int moved = -PEN_SETUP_TIMEOUT;
	for (int i = 0; i < TRIES && moved == -PEN_SETUP_TIMEOUT && !stopped(s); i++)
		moved = note(s, s->transport->string_get(s->transport->context, step->string_index,
							 bytes, PEN_ANSWER_MAX));
	if (moved < 1 || moved > PEN_ANSWER_MAX)
		return;
	s->answers.answer[s->answers.count].string_index = step->string_index;
	s->answers.answer[s->answers.count].size = moved;
	s->answers.count++;
}

static bool step_output(struct setup *s, const struct pen_step *step)
{
	uint8_t bytes[OUTPUT_BYTES_MAX] = {0};
	int size = int_clamp(s->recipe->output_bytes, step->size, OUTPUT_BYTES_MAX);
	memcpy(bytes, step->bytes, step->size);
	for (int i = 0; i < TRIES && !stopped(s); i++)
		if (note(s, s->transport->output_send(s->transport->context, bytes, size)) == size)
			return true;
	return false;
}

/* Done when it reads back: some tablets take it only the second time. */
static bool step_feature(struct setup *s, const struct pen_step *step)
{
	for (int i = 0; i < FEATURE_TRIES && !stopped(s); i++) {
		uint8_t back[9] = {step->bytes[0]};
		int sent = note(s, s->transport->feature_send(s->transport->context, step->bytes,
							      step->size));
		if (sent != step->size || stopped(s))
			continue;
		int got = note(s,
			       s->transport->feature_get(s->transport->context, back, step->size));
		if (got >= step->size && !memcmp(back, step->bytes, step->size))
			return true;
	}
	return false;
}

static bool step_take(struct setup *s, const struct pen_step *step)
{
	static const char *const what[] = {"string", "output report", "feature report"};
	bool done = true;
	if (step->fallback && complete(s))
		return true;
	if (step->kind == PEN_STEP_STRING)
		step_string(s, step);
	else if (step->kind == PEN_STEP_OUTPUT)
		done = step_output(s, step);
	else
		done = step_feature(s, step);
	if (!done && step->wanted)
		snprintf(s->result->reason, sizeof s->result->reason,
			 "it does not take the %s %02x %02x %02x that makes it speak",
			 what[step->kind], step->bytes[0], step->bytes[1], step->bytes[2]);
	return done || !step->wanted;
}

void pen_setup(const struct pen_identity *identity, const struct pen_recipe *recipe,
	       const struct pen_transport *transport, struct pen_setup_result *result)
{
	struct setup s = {identity, recipe, transport, result, {0}};
	*result = (struct pen_setup_result){0};
	bool going = true;
	for (int i = 0; i < recipe->step_count && going && !stopped(&s); i++)
		going = step_take(&s, &recipe->step[i]);
	if (stopped(&s)) {
		snprintf(result->reason, sizeof result->reason, "it went away meanwhile");
		return;
	}
	result->done = going &&
		       pen_identify_end(identity, recipe, &s.answers, &result->vendor,
					&result->width_mm, &result->height_mm, result->reason);
}
