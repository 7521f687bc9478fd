/* The visitor's card at the station: two frames draw the figure for it, a thread does the rest, and
 * the page shows how far it is.
 *
 *   FINISH -> page open -> front drawn -> back drawn -> take_home.c's thread -> page closed, over
 */
#include "station.h"

#include "card_file.h"
#include "draw_card.h"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum {
	FETCH_FRAMES = 3, /* after a portrait was drawn the GPU has it done */
	BLIND_FRAMES = 30 /* without a display the card goes without its figure */
};

static void drop_portraits(struct station_card *card)
{
	for (int i = 0; i < PORTRAITS; i++) {
		free(card->portrait[i]);
		card->portrait[i] = NULL;
	}
}

/* Frames that the journal does not say yet. */
static void take_tail(const struct kiosk *kiosk, char *tail, size_t size)
{
	static char line[JOURNAL_LINE_MAX];
	struct edit *step = calloc(1, sizeof *step);
	if (step && kiosk->steps > 0) {
		step->kind = EDIT_STEP;
		step->i[0] = kiosk->steps;
		journal_write(step, line);
		snprintf(tail, size, "%.*s", (int)size - 1, line);
	}
	free(step);
}

static void start(struct station *station)
{
	struct station_card *card = &station->card;
	const struct kiosk *kiosk = station->kiosk;
	const struct session *session = &kiosk->session;
	struct take_home_layout layout;
	char fault[FAULT_BYTES];
	struct tm parts;
	time_t now = time(NULL);
	struct take_home_order *order = calloc(1, sizeof *order);
	card->phase = CARD_MAKING;
	card->page.failed = true;
	card->page.changed++;
	if (!order)
		return;
	content_take(&order->content, &session->document,
		     session->cloth.worn || session->job != JOB_NONE,
		     station->body ? store_name(station->body) : "mannequin");
	memcpy(order->portrait, card->portrait, sizeof order->portrait);
	memset(card->portrait, 0, sizeof card->portrait);
	snprintf(order->folder, sizeof order->folder, "%s", station->folder);
	if (station->journal >= 0)
		snprintf(order->journal, sizeof order->journal, "%s", station->journal_path);
	take_tail(kiosk, order->tail, sizeof order->tail);
	snprintf(order->station, sizeof order->station, "%s", station->board.station);
	card_date(order->date, sizeof order->date);
	localtime_r(&now, &parts);
	strftime(order->stem, sizeof order->stem, "%Y%m%d-%H%M%S", &parts);
	take_home_layout(&layout, &kiosk->ui.layout);
	order->preview_width = layout.card.w;
	order->places = station->sticks ? station->sticks : &stick_places_kernel;
	card->home = take_home_start(order, fault);
	if (!card->home)
		station_say(fault);
	card->page.failed = !card->home;
}

/* A card whose page is closed is still kept to its end; the next one waits for that. */
static void clear_away(struct station_card *card, bool wait)
{
	if (!card->home)
		return;
	take_home_close(card->home);
	if (!wait && !take_home_over(card->home))
		return;
	take_home_free(card->home);
	card->home = NULL;
}

bool station_run_card(struct station *station)
{
	struct station_card *card = &station->card;
	const struct ui *ui = &station->kiosk->ui;
	if (!ui->take_home.open) {
		card->phase = CARD_NONE;
		clear_away(card, false);
		drop_portraits(card);
		return ui->take_home.leave;
	}
	card->frames++;
	if (card->phase == CARD_NONE) {
		clear_away(card, false);
		card->page = (struct take_home_page){.changed = card->page.changed + 1};
		card->phase = card->home ? CARD_NONE : CARD_FRONT;
		card->frames = 0;
	} else if (card->phase == CARD_READY ||
		   (card->phase < CARD_READY && card->frames > BLIND_FRAMES)) {
		start(station);
	} else if (card->home) {
		int changed = card->page.changed;
		struct take_home_page page;
		take_home_look(card->home, &page);
		if (page.changed != card->seen) {
			card->page = page;
			card->page.changed = changed + 1;
		}
		card->seen = page.changed;
	}
	return ui->take_home.leave;
}

/* The figure is drawn where nobody sees it, below the page, a view a frame. */
static void draw_figure(struct station *station)
{
	struct station_card *card = &station->card;
	bool back = card->phase >= CARD_BACK;
	if (card->phase == CARD_FRONT || card->phase == CARD_BACK) {
		if (draw_portrait(station->draw, &station->kiosk->session,
				  PORTRAIT_AZIMUTH + (back ? PI_F : 0.0f))) {
			card->phase++;
			card->drawn = card->frames;
		} else {
			card->phase = CARD_READY;
		}
		return;
	}
	if ((card->phase != CARD_FRONT_DRAWN && card->phase != CARD_BACK_DRAWN) ||
	    card->frames < card->drawn + FETCH_FRAMES)
		return;
	card->portrait[back] = draw_portrait_fetch(station->draw);
	card->phase++;
	if (card->phase == CARD_READY)
		draw_portrait_end(station->draw);
}

bool station_draw_card(struct station *station)
{
	const struct ui *ui = &station->kiosk->ui;
	if (!ui->take_home.open) {
		draw_portrait_end(station->draw);
		draw_take_home_end(station->draw);
		return false;
	}
	draw_figure(station);
	draw_take_home(station->draw, ui, &station->card.page);
	return true;
}

void station_close_card(struct station *station)
{
	clear_away(&station->card, true);
	drop_portraits(&station->card);
}
