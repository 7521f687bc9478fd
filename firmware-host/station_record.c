/* A visit's tape: what the station read, with the frames that it used it in, so that a replay comes
 * to the same journal and the same state.
 *
 * A tape says once how the pens lie and what each device is, and where a visit's devices change it
 * ends: up to there it is exact. */
#include "station.h"

#include <errno.h>
#include <stdio.h>
#include <unistd.h>

static struct tape_recorder *made(struct station *station)
{
	return &station->tape_made;
}

void station_record_begin(struct station *station, const char *journal_path)
{
	static const struct tape_recorder none;
	int stem = (int)(strlen(journal_path) - strlen(".kitsuke"));
	*made(station) = none;
	station->tape_path[0] = 0;
	if (station->record)
		snprintf(station->tape_path, sizeof station->tape_path, "%.*s.hid", stem,
			 journal_path);
}

/* The file is begun with the first report: until then nothing depends on how the pens lie. */
static bool tape_begun(struct station *station)
{
	const struct kiosk *kiosk = station->kiosk;
	struct tape head = {.width_px = station->width,
			    .height_px = station->height,
			    .budget_units = kiosk->session.budget_units,
			    .mount = kiosk->pen.mapping.mount};
	if (made(station)->out)
		return true;
	FILE *out = station->tape_path[0] ? fopen(station->tape_path, "we") : NULL;
	if (out)
		recorder_begin(made(station), out, &head);
	else if (station->tape_path[0])
		fprintf(stderr, "kitsuke: %.300s: %s; this visit is not recorded\n",
			station->tape_path, strerror(errno));
	if (!out)
		station->tape_path[0] = 0;
	station->tape_mount = head.mount;
	return out;
}

/* What this device is; the desktop's own are known. */
static void told_read(struct station *station, int device, struct tape_device *told)
{
	static const struct tape_device desktop = {.used = true, .name = "the desktop's"};
	bool mouse = device == LIVE_MOUSE;
	if (device < LIVE_MOUSE) {
		live_device(station->live, device, told);
		return;
	}
	*told = desktop;
	told->descriptor_size = mouse ? mouse_descriptor_size : buttons_descriptor_size;
	memcpy(told->descriptor, mouse ? mouse_descriptor : buttons_descriptor,
	       (size_t)told->descriptor_size);
}

static bool same_mount(const struct pen_mount *a, const struct pen_mount *b)
{
	return a->degrees == b->degrees && a->display == b->display &&
	       a->panel_width == b->panel_width && a->panel_height == b->panel_height &&
	       a->rotation == b->rotation && a->cross_count == b->cross_count &&
	       !memcmp(a->cross, b->cross, (size_t)a->cross_count * sizeof *a->cross);
}

/* Is everything that reports in this frame what the tape says it is? */
static bool same_as_told(struct station *station)
{
	struct tape_device told;
	unsigned asked = 0;
	for (int i = 0; i < station->reports->count; i++) {
		int device = station->reports->report[i].device;
		if (asked >> device & 1)
			continue;
		asked |= 1u << device;
		told_read(station, device, &told);
		if (!recorder_device(made(station), device, &told))
			return false;
	}
	return same_mount(&station->tape_mount, &station->kiosk->pen.mapping.mount);
}

void station_record_frame(struct station *station, unsigned unplugged)
{
	const struct frame_reports *reports = station->reports;
	int64_t begin_us = tape_frame_us(station->kiosk->frame);
	if (!station->tape_path[0] || (!made(station)->out && !reports->count))
		return;
	if (!tape_begun(station))
		return;
	if (!same_as_told(station)) {
		station_say(
			"another tablet came or the screen changed; the visit's tape ends here");
		station_record_end(station);
		return;
	}
	for (int i = 0; i < reports->count; i++)
		recorder_report(made(station), &reports->report[i]);
	for (int device = 0; device < PEN_DEVICES_MAX; device++)
		if (unplugged >> device & 1)
			recorder_unplug(made(station), device, begin_us);
	/* a power cut costs a second of it */
	if (station->kiosk->frame % FRAME_RATE_HZ == 0)
		fflush(made(station)->out);
}

void station_record_end(struct station *station)
{
	FILE *out = made(station)->out;
	if (out) {
		recorder_end(made(station), station->kiosk->frame,
			     session_hash(&station->kiosk->session));
		bool failed = ferror(out) != 0;
		failed |= fclose(out) != 0;
		if (failed)
			fprintf(stderr, "kitsuke: %.300s: %s; it is no whole visit\n",
				station->tape_path, strerror(errno));
	}
	made(station)->out = NULL;
	station->tape_path[0] = 0;
}
