#include "desk.h"

#include "tape.h"

#include <stdio.h>
#include <stdlib.h>

static char log_line[DESK_LOG_LINES][DESK_LOG_BYTES];
static int log_count;

void desk_log(const char *line)
{
	snprintf(log_line[log_count++ % DESK_LOG_LINES], DESK_LOG_BYTES, "%s", line);
}

const char *desk_log_line(int index)
{
	int kept = int_min(log_count, DESK_LOG_LINES);
	return index < kept ? log_line[(log_count - kept + index) % DESK_LOG_LINES] : NULL;
}

static int by_time(const void *a, const void *b)
{
	int64_t left = *(const int64_t *)a, right = *(const int64_t *)b;
	return (left > right) - (left < right);
}

float desk_time_ms(const struct desk *desk, float share)
{
	int64_t sorted[DESK_TIMES];
	int count = int_min(desk->time_count, DESK_TIMES);
	if (count == 0)
		return 0.0f;
	memcpy(sorted, desk->time_us, (size_t)count * sizeof *sorted);
	qsort(sorted, (size_t)count, sizeof *sorted, by_time);
	return (float)sorted[(int)(share * (float)(count - 1))] / 1000.0f;
}

/* ---- pens ---- */

static void watch_report(struct desk *desk, const struct raw_report *report)
{
	struct desk_watch *watch = &desk->watch[report->device];
	const struct pen_device *d = &desk->pen.device[report->device];
	bool cut_off;
	watch->last = *report;
	watch->reports++;
	watch->layout = d->kind == DEVICE_PEN
				? pen_report_read(d->layout, d->layout_count, report->bytes,
						  report->size, &watch->memory, &watch->fields,
						  &cut_off)
				: NULL;
}

void desk_listen(struct desk *desk, const struct frame_reports *reports)
{
	int64_t now_us = (int64_t)(desk->frames + 1) * 1000000 / FRAME_RATE_HZ;
	for (int i = 0; i < reports->count; i++)
		if (reports->report[i].device >= 0 && reports->report[i].device < PEN_DEVICES_MAX)
			watch_report(desk, &reports->report[i]);
	for (int i = 0; i < PEN_DEVICES_MAX && desk->frames % FRAME_RATE_HZ == 0; i++) {
		desk->watch[i].rate_hz = desk->watch[i].reports;
		desk->watch[i].reports = 0;
	}
	memset(&desk->input, 0, sizeof desk->input);
	pen_read(&desk->pen, reports, now_us, &desk->input);
}

static void hex(char *text, size_t capacity, const struct raw_report *report)
{
	size_t at = 0;
	text[0] = 0;
	for (int i = 0; i < report->size && at + 4 < capacity; i++)
		at += (size_t)snprintf(text + at, capacity - at, "%02x ", report->bytes[i]);
}

static void show_path(struct service_list *card, const struct pen_device *d)
{
	const struct pen_layout *layout = &d->layout[0];
	enum pen_family family = layout->vendor.family;
	if (family == PEN_BY_DESCRIPTOR)
		service_list_add(card, SERVICE_PLAIN, "protocol",
				 "its report descriptor: it describes %d report%s with a pen",
				 d->layout_count, d->layout_count == 1 ? "" : "s");
	else
		service_list_add(card, SERVICE_PLAIN, "protocol",
				 "%s: the maker's, by the descriptor's shape and its answers",
				 pen_family_rule(family)->name);
}

static void show_fields(struct service_list *card, const struct desk_watch *watch)
{
	const struct pen_fields *f = &watch->fields;
	char bytes[SERVICE_VALUE_BYTES];
	hex(bytes, 3 * 24, &watch->last);
	service_list_add(card, SERVICE_PLAIN, "last report", "%s",
			 watch->last.size ? bytes : "none since this page was opened");
	if (watch->layout)
		service_list_add(card, SERVICE_PLAIN, "decoded",
				 "x %d   y %d   pressure %d   tip %s   tilt %d, %d%s%s%s", f->x,
				 f->y, f->pressure, f->tip ? "down" : "up", f->tilt_x, f->tilt_y,
				 f->invert || f->eraser ? "   eraser" : "",
				 f->barrel ? "   side switch" : "",
				 watch->layout->in_range.size && !f->in_range ? "   away" : "");
	else if (watch->last.size)
		service_list_add(card, SERVICE_PLAIN, "decoded", "no pen's report");
}

static void show_pen(struct desk *desk, int device, const struct tape_device *told)
{
	static const char *const state[] = {"away", "hovers", "touches"};
	struct service_list *card = &desk->page.card[SERVICE_CARD_PENS];
	const struct pen_device *d = &desk->pen.device[device];
	const struct desk_watch *watch = &desk->watch[device];
	bool worn = d->nib[0].offset > 0;
	service_list_add(card, SERVICE_PLAIN, "#", "%.90s   %04x:%04x", told->name, told->vendor,
			 told->product);
	show_path(card, d);
	show_fields(card, watch);
	service_list_add(card, worn ? SERVICE_AMBER : SERVICE_PLAIN, "rate",
			 "%d reports/s   cut off %ld   %s   nib offset %d%s", watch->rate_hz,
			 d->dropped, state[d->heard.state], d->nib[0].offset,
			 worn ? ": replace the nib" : "");
}

void desk_show_pens(struct desk *desk, const struct tape_device *const told[PEN_DEVICES_MAX])
{
	struct service_list *card = &desk->page.card[SERVICE_CARD_PENS];
	card->count = 0;
	for (int i = 0; i < PEN_DEVICES_MAX; i++)
		if (told[i] && desk->pen.device[i].kind == DEVICE_PEN)
			show_pen(desk, i, told[i]);
}

/* ---- calibration ---- */

static int hundredths(float px)
{
	return (int)(100.0f * float_clamp(px, 0.0f, 16383.0f) + 0.5f);
}

void desk_calibrate(struct desk *desk, const struct pen_mount *mount, float mm_per_px)
{
	struct service_page *page = &desk->page;
	struct plane_map found, shown = plane_map_identity;
	struct pen_mount *tried = &desk->tried;
	float rms_px, worst_px;
	char fault[200];
	*tried = *mount;
	if (mount->panel_width)
		shown = plane_map_fit(
			(struct v2){(float)page->width, (float)page->height}, mount->rotation,
			(struct v2){(float)mount->panel_width, (float)mount->panel_height});
	tried->cross_count = page->cross_count;
	for (int i = 0; i < page->cross_count; i++) {
		struct v2 seen = plane_map_apply(&shown, page->crosses[i].seen_px);
		struct v2 meant = plane_map_apply(&shown, page->crosses[i].meant_px);
		tried->cross[i] = (struct pen_cross){hundredths(seen.x), hundredths(seen.y),
						     hundredths(meant.x), hundredths(meant.y)};
	}
	page->result_good = pen_mount_calibrate(tried, &found, &rms_px, &worst_px, fault);
	if (page->result_good)
		snprintf(page->result, sizeof page->result,
			 "%d crosses; what remains: %.2f mm, at most %.2f mm", page->cross_count,
			 (double)(rms_px * mm_per_px), (double)(worst_px * mm_per_px));
	else
		snprintf(page->result, sizeof page->result, "%.190s", fault);
}
