/* The station's face towards its machine: the display and what is drawn for it, how the pens lie on
 * it, and what the operator is told. */
#include "station.h"

#include <stdio.h>

enum {
	WINDOW_WIDTH = 1280,
	WINDOW_HEIGHT = 720,
	DARK_WIDTH = 1920, /* of the picture while no screen says its size */
	DARK_HEIGHT = 1080,
	ATTRACT_FRAMES = 24 * FRAME_RATE_HZ,
	REDRAW_FRAMES = 2 * FRAME_RATE_HZ, /* between tries to make GL's objects anew */
};

void station_say(const char *line)
{
	fprintf(stderr, "kitsuke: %s\n", line);
	desk_log(line);
}

/* KMS when a display is free for us, else a window where there is a desktop session. A card that a
 * splash screen still holds is waited for. */
bool station_choose_display(struct station *station)
{
	char why_not[200];
	bool taken;
	station->kind = DISPLAY_KMS;
	if (display_kms_free(&taken, why_not) || (taken && !display_session()))
		return true;
	station->kind = DISPLAY_WINDOW;
	station->width = WINDOW_WIDTH;
	station->height = WINDOW_HEIGHT;
	if (display_session())
		return true;
	snprintf(station->fault, FAULT_BYTES,
		 "no display (%s) and no desktop session; a recorded visit can be played: "
		 "kitsuke replay TAPE --out DIR",
		 why_not);
	return false;
}

/* Why there is no picture, when that has changed. */
static void tell_dark(struct station *station)
{
	const char *reason = display_reason(station->display);
	if (strcmp(station->dark, reason) == 0)
		return;
	snprintf(station->dark, sizeof station->dark, "%s", reason);
	char line[240];
	snprintf(line, sizeof line, "%s%s", reason[0] ? "no picture: " : "the picture is back",
		 reason);
	station_say(line);
}

/* GL's objects anew from what the processor has, when there is a new context. */
static bool follow_context(struct station *station, char fault[200])
{
	int generation = display_generation(station->display);
	if (station->draw && generation == station->generation)
		return true;
	draw_close(station->draw);
	station->generation = generation;
	station->draw = draw_open(station->width, station->height, fault);
	if (station->draw)
		draw_bones(station->draw, station->bones);
	return station->draw;
}

/* The picture keeps the size of the first screen: what is worn and drawn is at home in it, and
 * other screens show it as large as it fits. */
bool station_open_display(struct station *station)
{
	char fault[200];
	int width = station->width, height = station->height, degrees = station->board.rotation;
	station->display = display_open(station->kind, &width, &height, fault);
	if (station->display) {
		width = width ? width : DARK_WIDTH;
		height = height ? height : DARK_HEIGHT;
		station->width = degrees % 180 ? height : width;
		station->height = degrees % 180 ? width : height;
		display_turn(station->display, station->width, station->height, degrees);
	}
	if (station->display && display_ready(station->display) == DISPLAY_READY &&
	    !follow_context(station, fault)) {
		display_close(station->display);
		station->display = NULL;
	}
	if (station->display)
		tell_dark(station);
	else
		snprintf(station->fault, FAULT_BYTES, "%s", fault);
	return station->display;
}

void station_close_display(struct station *station)
{
	draw_close(station->draw);
	if (station->display)
		display_close(station->display);
	station->draw = NULL;
	station->display = NULL;
}

/* Pens on a display, and the mouse on a window, follow the picture's turn; tablets lie as they are
 * said to. */
void station_mount_pens(struct station *station)
{
	struct pen_mount mount = station->board.mount;
	int degrees = station->board.rotation;
	mount.rotation = degrees;
	display_size(station->display, &mount.panel_width, &mount.panel_height);
	if (mount.panel_width == 0) {
		mount.panel_width = degrees % 180 ? station->height : station->width;
		mount.panel_height = degrees % 180 ? station->width : station->height;
	}
	station->mounted = station->generation;
	pen_mount(&station->kiosk->pen, &mount);
}

/* What the pen has done since the frame's reports were read. */
static void read_late(struct station *station)
{
	struct frame_reports *reports = station->reports;
	reports->count = 0;
	if (station->live)
		live_peek(station->live, reports);
	live_stamp(reports, station->kiosk->frame, station->collected_us,
		   live_clock_us() - station->opened_us);
	kiosk_late_show(&station->late, station->kiosk, reports);
}

/* While it waits for a visitor the figure turns, in the picture only: once round in 24 s. */
static void draw_visit(struct station *station)
{
	struct ui *ui = &station->kiosk->ui;
	struct view view = ui->view;
	if (station->cycle.state == CYCLE_ATTRACT)
		view_look(&ui->view, 2.0f * PI_F * (float)(station->kiosk->frame % ATTRACT_FRAMES) /
					     (float)ATTRACT_FRAMES);
	draw_frame(station->draw, ui, &station->kiosk->session);
	ui->view = view;
}

static void draw_picture(struct station *station)
{
	struct kiosk *kiosk = station->kiosk;
	char fault[200];
	if (station->desk->open && draw_service(station->draw, &station->desk->page, fault))
		return;
	draw_service_end(station->draw);
	if (!station_draw_card(station)) {
		read_late(station);
		draw_visit(station);
		kiosk_late_hide(&station->late, kiosk);
	}
	if (station->cycle.state == CYCLE_VISIT)
		draw_notice_end(station->draw);
	else if (!draw_notice(station->draw, kiosk->ui.language, station->cycle.left_s,
			      int_min(CYCLE_COUNTDOWN_S, station->board.idle_s / 2), fault))
		station_say(fault);
}

/* Without a display the visit goes on unseen. False: the display has failed for good. */
bool station_show(struct station *station)
{
	struct kiosk *kiosk = station->kiosk;
	char fault[200];
	enum display_state state = display_ready(station->display);
	tell_dark(station);
	if (state == DISPLAY_GONE) {
		snprintf(station->fault, FAULT_BYTES, "%s", display_reason(station->display));
		return false;
	}
	if (state == DISPLAY_DARK || kiosk->frame < station->redraw)
		return true;
	if (follow_context(station, fault)) {
		if (station->mounted != station->generation)
			station_mount_pens(station);
		draw_picture(station);
		station->desk->late += !display_present(station->display);
	} else {
		station_say(fault);
		station->redraw = kiosk->frame + REDRAW_FRAMES;
	}
	return true;
}

/* The operator held all buttons: everything that the machine knows about itself. */
void station_tell_service(struct station *station)
{
	char text[LIVE_TEXT_MAX];
	const struct pen *pen = &station->kiosk->pen;
	const char *reason = display_reason(station->display);
	fprintf(stderr, "kitsuke: service: display: %s\n", reason[0] ? reason : "a picture");
	live_text(station->live, text);
	station_say(text);
	buttons_text(station->buttons, text);
	station_say(text);
	for (int i = 0; i < PEN_DEVICES_MAX; i++) {
		const struct pen_device *d = &pen->device[i];
		if (d->kind == DEVICE_PEN)
			fprintf(stderr,
				"kitsuke: service: pen %d: %ld reports cut off, %ld contacts too "
				"short, %ld joined%s\n",
				i, d->dropped, d->chatter, d->merged,
				d->nib[0].offset ? "; its nib is worn: replace it" : "");
	}
}
