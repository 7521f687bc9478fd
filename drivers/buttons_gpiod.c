/* The buttons' lines through libgpiod v2, found by name: chip numbers move between kernels.
 *
 * One line, one request: a line that is missing or taken leaves the others working. Edges are
 * logical, so a press is a rising edge with active-low lines too. A chip that went away answers
 * with ENODEV; its lines are looked for again until they are there, within a second of its return.
 */
#include "buttons.h"

#include <errno.h>
#include <gpiod.h>
#include <poll.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

enum { CHIPS_MAX = 16, EVENTS_MAX = 32, RESCAN_MS = 400, UNSETTLED_MS = 2 };

struct buttons {
	pthread_t thread;
	pthread_mutex_t lock;
	char text[LIVE_TEXT_MAX];
	int wake[2];
	struct board board;
	struct live *live;
	int64_t start_us;

	struct gpiod_line_request *request[BUTTON_COUNT]; /* NULL: not found */
	unsigned offset[BUTTON_COUNT];
	uint32_t number[BUTTON_COUNT]; /* of the last event */
	struct gpiod_edge_event_buffer *events;
	struct buttons_state state;
	uint8_t stuck_told;
	bool service;              /* asked for; under the lock */
	struct buttons_state look; /* the state as it was last; under the lock */
	int64_t searched_us;
	bool plugged;
};

static const char *button_names[BUTTON_COUNT] = {"wrap", "pin", "relax"};

/* --- one line --------------------------------------------------------------------------------- */

static struct gpiod_line_request *line_ask(struct gpiod_chip *chip, unsigned offset,
					   bool active_low, int64_t debounce_us)
{
	struct gpiod_line_settings *settings = gpiod_line_settings_new();
	struct gpiod_line_config *lines = gpiod_line_config_new();
	struct gpiod_request_config *config = gpiod_request_config_new();
	struct gpiod_line_request *request = NULL;
	if (settings && lines && config) {
		gpiod_line_settings_set_direction(settings, GPIOD_LINE_DIRECTION_INPUT);
		gpiod_line_settings_set_edge_detection(settings, GPIOD_LINE_EDGE_BOTH);
		gpiod_line_settings_set_active_low(settings, active_low);
		gpiod_line_settings_set_bias(settings, active_low ? GPIOD_LINE_BIAS_PULL_UP
								  : GPIOD_LINE_BIAS_PULL_DOWN);
		gpiod_line_settings_set_debounce_period_us(settings, (unsigned long)debounce_us);
		gpiod_line_config_add_line_settings(lines, &offset, 1, settings);
		gpiod_request_config_set_consumer(config, "kitsuke");
		request = gpiod_chip_request_lines(chip, config, lines);
	}
	int error = errno;
	gpiod_line_settings_free(settings);
	gpiod_line_config_free(lines);
	gpiod_request_config_free(config);
	errno = error;
	return request;
}

/* Requests the button's line on this chip. Lines with neither hardware debounce nor interrupts
 * answer ENXIO to a debounce period: then without it, and we debounce. False: errno says why. */
static bool line_open(struct buttons *b, enum button button, const struct buttons_chip *found)
{
	struct gpiod_chip *chip = gpiod_chip_open(found->path);
	if (!chip)
		return false;
	b->offset[button] = (unsigned)found->offset[button];
	b->number[button] = 0;
	bool low = b->board.button_active_low;
	b->request[button] = line_ask(chip, b->offset[button], low, BUTTONS_DEBOUNCE_US);
	if (!b->request[button] && (errno == ENXIO || errno == ENOTSUP || errno == EINVAL)) {
		b->request[button] = line_ask(chip, b->offset[button], low, 0);
		b->state.debounce_us = BUTTONS_DEBOUNCE_US;
	}
	int error = errno;
	gpiod_chip_close(chip);
	errno = error;
	return b->request[button];
}

static void line_close(struct buttons *b, enum button button)
{
	gpiod_line_request_release(b->request[button]);
	b->request[button] = NULL;
}

/* --- searching -------------------------------------------------------------------------------- */

static bool line_named(const struct buttons *b, enum button button)
{
	return b->board.button_line[button][0];
}

/* Adds what a button's search came to, in words. */
static void words_add(char text[LIVE_TEXT_MAX], const char *button, const char *line,
		      const char *words)
{
	size_t size = strlen(text);
	snprintf(text + size, LIVE_TEXT_MAX - size, "%s%s (line %.24s) %s", size ? "; " : "",
		 button, line, words);
}

/* The chip that has the line; NULL with the reason when none has, or more than one. */
static const struct buttons_chip *chip_with(const struct buttons_chip *chips, int count,
					    enum button button, const char **why)
{
	const struct buttons_chip *found = NULL;
	*why = "is on no GPIO chip; set its name in the board file";
	for (int i = 0; i < count; i++) {
		if (chips[i].offset[button] < 0)
			continue;
		if (found) {
			*why = "is on two GPIO chips; give it a name of its own";
			return NULL;
		}
		found = &chips[i];
	}
	return found;
}

static uint8_t levels_read(struct buttons *b)
{
	uint8_t level = 0;
	for (int i = 0; i < BUTTON_COUNT; i++)
		if (b->request[i] && gpiod_line_request_get_value(b->request[i], b->offset[i]) ==
					     GPIOD_LINE_VALUE_ACTIVE)
			level |= (uint8_t)(1 << i);
	return level;
}

static void device_plug(struct buttons *b)
{
	struct tape_device told = {.used = true,
				   .name = "kitsuke buttons",
				   .bus = 0x19, /* BUS_HOST */
				   .descriptor_size = buttons_descriptor_size};
	memcpy(told.descriptor, buttons_descriptor, (size_t)buttons_descriptor_size);
	live_plug(b->live, LIVE_BUTTONS, &told);
	b->plugged = true;
}

static void text_set(struct buttons *b, const char *text)
{
	pthread_mutex_lock(&b->lock);
	snprintf(b->text, sizeof b->text, "%s", text);
	pthread_mutex_unlock(&b->lock);
}

/* Opens the lines that are not open yet. What is found pressed waits for its release. */
static void lines_search(struct buttons *b)
{
	struct buttons_chip chips[CHIPS_MAX];
	char text[LIVE_TEXT_MAX] = "";
	int refused, count = buttons_chips_find(&b->board, chips, CHIPS_MAX, &refused);
	int opened = 0, missing = 0;
	for (int i = 0; i < BUTTON_COUNT; i++) {
		const char *why;
		if (!line_named(b, (enum button)i) || b->request[i])
			continue;
		const struct buttons_chip *chip = chip_with(chips, count, (enum button)i, &why);
		bool open = chip && line_open(b, (enum button)i, chip);
		opened += open;
		missing += !open;
		if (!open)
			words_add(text, button_names[i], b->board.button_line[i],
				  chip ? strerror(errno) : why);
	}
	if (opened) {
		uint8_t level = levels_read(b), fresh = (uint8_t)(level & ~b->state.held);
		b->state.level = level;
		b->state.ignored |= fresh;
	}
	if (opened && !b->plugged)
		device_plug(b);
	if (!count)
		snprintf(text, sizeof text,
			 refused ? "buttons: no permission for the GPIO chips; a "
				   "udev rule must give this user's group /dev/gpiochip*"
				 : "buttons: this machine has no GPIO chip");
	text_set(b, missing ? text : "buttons: all lines found");
	b->searched_us = live_clock_us();
}

/* --- events ----------------------------------------------------------------------------------- */

static bool lines_missing(const struct buttons *b)
{
	for (int i = 0; i < BUTTON_COUNT; i++)
		if (line_named(b, (enum button)i) && !b->request[i])
			return true;
	return false;
}

/* The chip is gone: its buttons count as released, and the device goes with the last of them. */
static void line_lost(struct buttons *b, enum button button)
{
	int open = 0;
	line_close(b, button);
	buttons_level(&b->state, button, false, 0);
	for (int i = 0; i < BUTTON_COUNT; i++)
		open += b->request[i] != NULL;
	if (!open && b->plugged) {
		live_unplug(b->live, LIVE_BUTTONS);
		b->plugged = false;
		buttons_begin(&b->state, 0, b->state.debounce_us);
	}
}

static void line_read(struct buttons *b, enum button button)
{
	int count = gpiod_line_request_read_edge_events(b->request[button], b->events, EVENTS_MAX);
	if (count < 0) {
		line_lost(b, button);
		return;
	}
	bool gap = false;
	for (int i = 0; i < count; i++) {
		struct gpiod_edge_event *event = gpiod_edge_event_buffer_get_event(
			b->events, (unsigned long)i);
		gap |= buttons_gap(&b->number[button],
				   (uint32_t)gpiod_edge_event_get_line_seqno(event));
		int64_t time_us = (int64_t)(gpiod_edge_event_get_timestamp_ns(event) / 1000);
		buttons_level(&b->state, button,
			      gpiod_edge_event_get_event_type(event) ==
				      GPIOD_EDGE_EVENT_RISING_EDGE,
			      time_us);
		/* A press and its release in one batch are both told. */
		if (b->state.debounce_us == 0 && buttons_settle(&b->state, time_us))
			live_push(b->live, LIVE_BUTTONS, time_us - b->start_us, 1, &b->state.held);
	}
	/* The kernel drops the oldest edges of a full buffer: the level has the last word. */
	enum gpiod_line_value value = gpiod_line_request_get_value(b->request[button],
								   b->offset[button]);
	if (gap && value != GPIOD_LINE_VALUE_ERROR)
		buttons_level(&b->state, button, value == GPIOD_LINE_VALUE_ACTIVE, live_clock_us());
}

/* --- the thread ------------------------------------------------------------------------------- */

/* What only the operator needs to know. */
static void tell_service(struct buttons *b, int64_t now_us)
{
	pthread_mutex_lock(&b->lock);
	b->look = b->state;
	pthread_mutex_unlock(&b->lock);
	if (buttons_chord(&b->state, now_us)) {
		pthread_mutex_lock(&b->lock);
		b->service = true;
		pthread_mutex_unlock(&b->lock);
	}
	if (b->state.stuck == b->stuck_told)
		return;
	b->stuck_told = b->state.stuck;
	char text[LIVE_TEXT_MAX] = "";
	for (int i = 0; i < BUTTON_COUNT; i++)
		if (b->state.stuck >> i & 1)
			words_add(text, button_names[i], b->board.button_line[i],
				  "is held down for good: free it or look at its wiring");
	text_set(b, text[0] ? text : "buttons: all lines found");
}

static bool wait_and_read(struct buttons *b)
{
	struct pollfd fds[1 + BUTTON_COUNT] = {{b->wake[0], POLLIN, 0}};
	for (int i = 0; i < BUTTON_COUNT; i++)
		fds[1 + i] = (struct pollfd){
			b->request[i] ? gpiod_line_request_get_fd(b->request[i]) : -1, POLLIN, 0};
	poll(fds, COUNT_OF(fds), buttons_unsettled(&b->state) ? UNSETTLED_MS : RESCAN_MS);
	if (fds[0].revents)
		return false;
	for (int i = 0; i < BUTTON_COUNT; i++) {
		if (fds[1 + i].revents & (POLLERR | POLLHUP | POLLNVAL))
			line_lost(b, (enum button)i);
		else if (fds[1 + i].revents)
			line_read(b, (enum button)i);
	}
	int64_t now_us = live_clock_us();
	if (b->plugged && buttons_settle(&b->state, now_us))
		live_push(b->live, LIVE_BUTTONS, now_us - b->start_us, 1, &b->state.held);
	tell_service(b, now_us);
	return true;
}

static void *thread_main(void *argument)
{
	struct buttons *b = argument;
	lines_search(b);
	while (wait_and_read(b)) {
		int64_t age_us = live_clock_us() - b->searched_us;
		if (lines_missing(b) && age_us >= RESCAN_MS * INT64_C(1000))
			lines_search(b);
	}
	return NULL;
}

static void buttons_free(struct buttons *b)
{
	for (int i = 0; i < BUTTON_COUNT; i++)
		if (b->request[i])
			line_close(b, (enum button)i);
	gpiod_edge_event_buffer_free(b->events);
	if (b->wake[0] >= 0) {
		close(b->wake[0]);
		close(b->wake[1]);
	}
	pthread_mutex_destroy(&b->lock);
	free(b);
}

struct buttons *buttons_open(const struct board *board, struct live *live, int64_t start_us)
{
	bool named = false;
	for (int i = 0; i < BUTTON_COUNT; i++)
		named |= board->button_line[i][0] != 0;
	struct buttons *b = named ? calloc(1, sizeof *b) : NULL;
	if (!b)
		return NULL;
	b->board = *board;
	b->live = live;
	b->start_us = start_us;
	b->wake[0] = b->wake[1] = -1;
	pthread_mutex_init(&b->lock, NULL);
	snprintf(b->text, sizeof b->text, "buttons: looking for their lines");
	b->events = gpiod_edge_event_buffer_new(EVENTS_MAX);
	if (!b->events || pipe(b->wake) < 0 || pthread_create(&b->thread, NULL, thread_main, b)) {
		buttons_free(b);
		return NULL;
	}
	return b;
}

void buttons_close(struct buttons *buttons)
{
	if (!buttons)
		return;
	if (write(buttons->wake[1], "q", 1) == 1)
		pthread_join(buttons->thread, NULL);
	buttons_free(buttons);
}

bool buttons_service(struct buttons *buttons)
{
	pthread_mutex_lock(&buttons->lock);
	bool asked = buttons->service;
	buttons->service = false;
	pthread_mutex_unlock(&buttons->lock);
	return asked;
}

void buttons_look(struct buttons *buttons, struct buttons_state *state)
{
	pthread_mutex_lock(&buttons->lock);
	*state = buttons->look;
	pthread_mutex_unlock(&buttons->lock);
}

void buttons_text(struct buttons *buttons, char text[LIVE_TEXT_MAX])
{
	pthread_mutex_lock(&buttons->lock);
	memcpy(text, buttons->text, LIVE_TEXT_MAX);
	pthread_mutex_unlock(&buttons->lock);
}
