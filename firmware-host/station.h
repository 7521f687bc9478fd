/* The station's state; station.c runs it, station_show.c shows it. */
#ifndef STATION_H
#define STATION_H

#include "board.h"
#include "buttons.h"
#include "display.h"
#include "draw.h"
#include "kiosk_late.h"
#include "live.h"
#include "desk.h"
#include "service.h"
#include "store.h"
#include "take_home.h"
#include "tape_recorder.h"
#include "threads.h"

enum station_card_phase {
	CARD_NONE, /* the page is closed, or waits for the card before this one */
	CARD_FRONT,
	CARD_FRONT_DRAWN,
	CARD_BACK,
	CARD_BACK_DRAWN,
	CARD_READY,
	CARD_MAKING,
};

/* The card to take home, while its page is open. */
struct station_card {
	enum station_card_phase phase;
	int frames, drawn; /* since the page was opened; at which a portrait was drawn */
	int seen;          /* home's page as shown */
	unsigned char *portrait[2];
	struct take_home *home; /* NULL: no thread works */
	struct take_home_page page;
};

struct station {
	const char *board_path, *body, *journals, *tape, *out;
	bool bones;  /* drawn over the figure, for the operator */
	bool record; /* each visit's tape, beside its journal */
	struct board board;
	enum display_kind kind;
	struct display *display;
	struct draw *draw;
	int generation; /* of the GL context that draw was made in */
	int mounted;    /* generation that the pens were told of */
	int width, height;
	void *memory;
	struct threads threads;
	struct kiosk *kiosk;
	struct frame_reports *reports;
	struct kiosk_late late;
	struct live *live;
	struct buttons *buttons;
	struct service service;
	struct cycle cycle;
	struct desk *desk; /* the operator's page */
	struct board base; /* as the board file says, without what was set on the page */
	char folder[PATH_BYTES_MAX / 2]; /* of journals, and of what was set */
	int64_t start_us; /* of frame 0, on CLOCK_MONOTONIC; moves on with every late frame */
	unsigned plugged; /* in this frame, a bit a device */
	int64_t opened_us;
	int64_t collected_us; /* of the last frame's reports */
	int journal;          /* file, -1: none */
	char journal_path[PATH_BYTES_MAX];
	char tape_path[PATH_BYTES_MAX]; /* "" none */
	struct station_card card;
	const struct stick_places *sticks; /* NULL: the kernel's */
	struct tape_recorder tape_made;
	struct pen_mount tape_mount; /* how the pens lie, as it stands on the tape */
	int redraw;                  /* frame from which on drawing may be tried again */
	char dark[200];              /* why there is no picture, as told last */
	char fault[FAULT_BYTES];
};

/* A line to the log. */
void station_say(const char *line);

/* KMS or a window; false with station->fault when neither can be. */
bool station_choose_display(struct station *station);
bool station_open_display(struct station *station);
void station_close_display(struct station *station);

/* Tells the pens where the picture lies. */
void station_mount_pens(struct station *station);

/* Draws a frame and shows it; without a display the visit goes on unseen. False: the display has
 * failed for good. */
bool station_show(struct station *station);

/* The visit's tape: begun with the visit, a frame's reports as they are handed to the kiosk, ended
 * with the visit or by what a tape can't say. */
void station_record_begin(struct station *station, const char *journal_path);
void station_record_frame(struct station *station, unsigned unplugged);
void station_record_end(struct station *station);

/* The frame that is being shown: the visit stands still while the operator's page is open. */
static inline int station_frame(const struct station *station)
{
	return station->kiosk->frame + station->desk->frames;
}

/* What was set on the operator's page in earlier days. A fault in it is said, and it is left out.
 */
void station_read_settings(struct station *station);

/* Asks for the page: the next frame ends every stroke, and then it opens. */
bool station_wants_desk(struct station *station);
void station_open_desk(struct station *station);

/* Writes down on the page what there is to be said now. */
void station_show_page(struct station *station);

/* A frame of the page. True: a visit must begin anew. */
bool station_run_desk(struct station *station, unsigned unplugged);

/* A frame of the card to take home. True: the visitor has done, the next one may come. */
bool station_run_card(struct station *station);

/* Its page in place of a frame. False: it is closed. */
bool station_draw_card(struct station *station);

/* Waits until a card that is being written is. */
void station_close_card(struct station *station);

/* Tells the operator everything that the machine knows about itself. */
void station_tell_service(struct station *station);

#endif
