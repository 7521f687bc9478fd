/* See tape_recorder.h. */
#include "tape_recorder.h"

static void line_write(struct tape_recorder *r, int length)
{
	fwrite(r->line, 1, (size_t)length, r->out);
}

void recorder_begin(struct tape_recorder *r, FILE *out, const struct tape *head)
{
	*r = (struct tape_recorder){.out = out, .device = -1};
	for (int part = 0, length; (length = tape_write_head(r->line, head, part)) > 0; part++)
		line_write(r, length);
}

static bool same_device(const struct tape_device *a, const struct tape_device *b)
{
	return a->speaks.family == b->speaks.family && a->speaks.x_maximum == b->speaks.x_maximum &&
	       a->speaks.y_maximum == b->speaks.y_maximum &&
	       a->speaks.pressure_maximum == b->speaks.pressure_maximum &&
	       a->display == b->display && a->descriptor_size == b->descriptor_size &&
	       !memcmp(a->descriptor, b->descriptor, (size_t)a->descriptor_size);
}

bool recorder_device(struct tape_recorder *r, int device, const struct tape_device *told)
{
	struct tape_device *declared = &r->declared[device];
	r->left_out[device] = declared->used && !same_device(declared, told);
	if (declared->used)
		return !r->left_out[device];
	*declared = *told;
	declared->used = true;
	for (int part = 0, length; (length = tape_write_device(r->line, device, told, part)) > 0;
	     part++)
		line_write(r, length);
	r->device = device;
	return true;
}

static int64_t time_next(struct tape_recorder *r, int64_t time_us)
{
	return r->last_us = time_us > r->last_us ? time_us : r->last_us;
}

void recorder_report(struct tape_recorder *r, const struct raw_report *report)
{
	if (r->left_out[report->device] || !r->declared[report->device].used)
		return;
	if (r->device != report->device)
		line_write(r, tape_write_select(r->line, report->device));
	r->device = report->device;
	line_write(r, tape_write_event(r->line, time_next(r, report->time_us), report->size,
				       report->bytes));
	r->events++;
}

void recorder_unplug(struct tape_recorder *r, int device, int64_t time_us)
{
	if (!r->left_out[device] && r->declared[device].used)
		line_write(r, tape_write_unplug(r->line, time_next(r, time_us), device));
}

void recorder_end(struct tape_recorder *r, int frames, uint64_t hash)
{
	line_write(r, tape_write_end(r->line, frames, hash));
}
