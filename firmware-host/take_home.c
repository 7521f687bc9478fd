#include "take_home.h"

#include "take_home_card.h"

#include <errno.h>
#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

enum { LOOK_MS = 400 }; /* between two looks for a stick */

struct take_home {
	struct take_home_order *order;
	pthread_t thread;
	atomic_bool closed, over;
	pthread_mutex_t mutex; /* of the page */
	struct take_home_page page;
	/* the thread's own */
	struct card_made made;
	unsigned char *preview;
	uint8_t *png;
	size_t png_size;
	char *journal;
	size_t journal_size;
	char png_name[96], journal_name[96];
};

/* ---- what the page says ---- */

static void tell(struct take_home *home, enum kept *place, enum kept kept)
{
	pthread_mutex_lock(&home->mutex);
	if (*place != kept)
		home->page.changed++;
	*place = kept;
	pthread_mutex_unlock(&home->mutex);
}

static void tell_ready(struct take_home *home, bool failed)
{
	pthread_mutex_lock(&home->mutex);
	home->page.failed = failed;
	home->page.ready = !failed;
	home->page.card = home->preview;
	home->page.qr = home->made.qr;
	home->page.qr_modules = home->made.card.qr_modules;
	snprintf(home->page.name, sizeof home->page.name, "%.63s", home->png_name);
	home->page.changed++;
	pthread_mutex_unlock(&home->mutex);
}

void take_home_look(struct take_home *home, struct take_home_page *page)
{
	pthread_mutex_lock(&home->mutex);
	*page = home->page;
	pthread_mutex_unlock(&home->mutex);
}

/* ---- making ---- */

/* Nothing that was kept before is written over: the wall's clock of a station may be wrong. */
static void choose_names(struct take_home *home)
{
	char path[PATH_BYTES_MAX], fault[FAULT_BYTES];
	const struct take_home_order *order = home->order;
	for (int i = 1; i < 1000; i++) {
		char number[16] = "";
		if (i > 1)
			snprintf(number, sizeof number, "-%d", i);
		snprintf(home->png_name, sizeof home->png_name, "card-%s%s.png", order->stem,
			 number);
		snprintf(home->journal_name, sizeof home->journal_name, "card-%s%s.kitsuke",
			 order->stem, number);
		if (!order->folder[0] ||
		    !store_join(path, sizeof path, order->folder, home->png_name, fault) ||
		    access(path, F_OK) != 0)
			return;
	}
}

/* The visit's own journal, to its last frame; what the code carries where there is none. */
static bool take_journal(struct take_home *home, char fault[FAULT_BYTES])
{
	const struct take_home_order *order = home->order;
	size_t size = 0, tail = strlen(order->tail);
	char *text = order->journal[0] ? store_read(order->journal, &size, fault) : NULL;
	char *longer = text ? realloc(text, size + tail + 1) : NULL;
	if (longer) {
		memcpy(longer + size, order->tail, tail + 1);
		home->journal = longer;
		home->journal_size = size + tail;
	} else {
		free(text);
		home->journal = content_journal(&order->content, &home->journal_size);
	}
	return home->journal;
}

static bool make(struct take_home *home, char fault[FAULT_BYTES])
{
	struct take_home_order *order = home->order;
	struct card *card = &home->made.card;
	if (!card_begin(&home->made, &order->content, fault))
		return false;
	for (int i = 0; i < PORTRAITS; i++)
		card->portrait[i] = order->portrait[i];
	snprintf(card->station, sizeof card->station, "%s", order->station);
	snprintf(card->date, sizeof card->date, "%s", order->date);
	snprintf(card->file, sizeof card->file, "%.63s", home->journal_name);
	home->preview = card_pixels(&home->made, order->preview_width, fault);
	return home->preview;
}

static void say(const char *what, const char *name)
{
	fprintf(stderr, "kitsuke: card: %s%s\n", what, name);
}

static void keep_here(struct take_home *home)
{
	char path[PATH_BYTES_MAX], fault[FAULT_BYTES];
	const char *folder = home->order->folder;
	if (!folder[0])
		return;
	tell(home, &home->page.station, KEPT_WRITING);
	errno = 0;
	bool kept = store_make_folder(folder, fault) &&
		    store_join(path, sizeof path, folder, home->journal_name, fault) &&
		    store_write(path, home->journal, home->journal_size, fault) &&
		    store_join(path, sizeof path, folder, home->png_name, fault) &&
		    store_write(path, home->png, home->png_size, fault);
	enum kept how = kept ? KEPT : kept_by_errno(errno);
	say(kept ? "kept as " : "", kept ? path : fault);
	tell(home, &home->page.station, how);
}

static void keep_on(struct take_home *home, const struct stick *stick)
{
	char fault[FAULT_BYTES];
	const struct stick_file file[] = {{home->journal_name, home->journal, home->journal_size},
					  {home->png_name, home->png, home->png_size}};
	tell(home, &home->page.stick, KEPT_WRITING);
	enum kept kept = stick_keep(stick, file, COUNT_OF(file), fault);
	say(kept == KEPT ? "kept on the stick at " : "", kept == KEPT ? stick->mount : fault);
	tell(home, &home->page.stick, kept);
}

/* Sticks that are there, and those that come while the page is open; one that was tried waits until
 * all have gone. */
static void keep_on_sticks(struct take_home *home)
{
	static const struct timespec rest = {0, LOOK_MS * 1000000L};
	static struct stick stick[STICKS_MAX]; /* one card is made at a time */
	bool tried = false;
	do {
		int count = stick_find(home->order->places, stick);
		for (int i = 0; i < count && !tried; i++)
			keep_on(home, &stick[i]);
		tried = count > 0;
		if (!atomic_load(&home->closed))
			nanosleep(&rest, NULL);
	} while (!atomic_load(&home->closed));
}

static void *work(void *argument)
{
	struct take_home *home = argument;
	char fault[FAULT_BYTES] = "";
	choose_names(home);
	bool made = make(home, fault);
	if (made)
		tell_ready(home, false);
	if (made && take_journal(home, fault))
		home->png = card_png(&home->made, &home->png_size, fault);
	if (home->png) {
		keep_here(home);
		keep_on_sticks(home);
	} else {
		say("not made: ", fault);
		tell_ready(home, true);
	}
	atomic_store(&home->over, true);
	return NULL;
}

/* ---- from outside ---- */

static void order_free(struct take_home_order *order)
{
	for (int i = 0; i < COUNT_OF(order->portrait); i++)
		free(order->portrait[i]);
	free(order);
}

struct take_home *take_home_start(struct take_home_order *order, char fault[FAULT_BYTES])
{
	struct take_home *home = calloc(1, sizeof *home);
	snprintf(fault, FAULT_BYTES, "not enough memory for a card");
	if (!home) {
		order_free(order);
		return NULL;
	}
	home->order = order;
	pthread_mutex_init(&home->mutex, NULL);
	sigset_t all, before;
	sigfillset(&all);
	pthread_sigmask(SIG_BLOCK, &all, &before); /* signals are the frame loop's */
	int error = pthread_create(&home->thread, NULL, work, home);
	pthread_sigmask(SIG_SETMASK, &before, NULL);
	if (error == 0)
		return home;
	snprintf(fault, FAULT_BYTES, "no thread for a card: %s", strerror(error));
	pthread_mutex_destroy(&home->mutex);
	order_free(order);
	free(home);
	return NULL;
}

void take_home_close(struct take_home *home)
{
	atomic_store(&home->closed, true);
}

bool take_home_over(struct take_home *home)
{
	return atomic_load(&home->over);
}

void take_home_free(struct take_home *home)
{
	if (!home)
		return;
	take_home_close(home);
	pthread_join(home->thread, NULL);
	pthread_mutex_destroy(&home->mutex);
	card_end(&home->made);
	free(home->preview);
	free(home->png);
	free(home->journal);
	order_free(home->order);
	free(home);
}
