/* Making a tablet speak its maker's protocol: the steps of a recipe through a transport that tests
 * can put in the place of a USB bus. */
#ifndef PEN_SETUP_H
#define PEN_SETUP_H

#include "pen_identify.h"

/* Each call returns the number of bytes that went over, or a negative number: -PEN_SETUP_TIMEOUT
 * when nothing came within the transport's own time-out, -PEN_SETUP_GONE when the device is gone,
 * anything else for a refusal. */
enum { PEN_SETUP_REFUSED = 1, PEN_SETUP_TIMEOUT, PEN_SETUP_GONE };

struct pen_transport {
	void *context;
	int (*string_get)(void *context, int index, uint8_t *bytes, int capacity);
	int (*output_send)(void *context, const uint8_t *bytes, int size);
	int (*feature_send)(void *context, const uint8_t *bytes, int size);
	int (*feature_get)(void *context, uint8_t *bytes, int size); /* bytes[0]: the report's id */
	bool (*stopped)(void *context);                              /* may be NULL */
};

struct pen_setup_result {
	bool done, gone;
	struct pen_vendor vendor;
	float width_mm, height_mm;
	int tries;        /* of transfers, repeated ones included */
	char reason[160]; /* not done: why */
};

/* Tries each step at most three times, a feature five times until it reads back. */
void pen_setup(const struct pen_identity *identity, const struct pen_recipe *recipe,
	       const struct pen_transport *transport, struct pen_setup_result *result);

#endif
