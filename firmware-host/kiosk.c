#include "kiosk.h"
#include "processor.h"

enum { JOURNAL_FRAME_MAX = (FRAME_EDITS_MAX + 4) * JOURNAL_LINE_MAX };

void kiosk_init(struct kiosk *kiosk, void *memory, int width_px, int height_px)
{
	memset(kiosk, 0, sizeof *kiosk);
	arena_init(&kiosk->arena, memory, KIOSK_MEMORY_BYTES);
	kiosk->journal = ARENA_ARRAY(&kiosk->arena, char, JOURNAL_FRAME_MAX);
	pen_init(&kiosk->pen, width_px, height_px);
	session_init(&kiosk->session, &kiosk->arena);
	kiosk->session.cloth.lanes = processor_lanes();
	ui_init(&kiosk->ui, width_px, height_px);
	arena_seal(&kiosk->arena);
}

static void journal_append(struct kiosk *kiosk, const struct edit *edit)
{
	int size = journal_write(edit, kiosk->journal_line);
	MUST(kiosk->journal_size + size <= JOURNAL_FRAME_MAX);
	memcpy(kiosk->journal + kiosk->journal_size, kiosk->journal_line, (size_t)size);
	kiosk->journal_size += size;
}

static void journal_steps(struct kiosk *kiosk)
{
	if (kiosk->steps == 0)
		return;
	struct edit step = {.kind = EDIT_STEP, .i = {kiosk->steps}};
	kiosk->steps = 0;
	journal_append(kiosk, &step);
}

void kiosk_body_named(struct kiosk *kiosk, const char *name)
{
	struct edit body = {.kind = EDIT_BODY};
	size_t size = strlen(name);
	memcpy(body.name, name, size < NAME_BYTES_MAX ? size : NAME_BYTES_MAX - 1);
	journal_append(kiosk, &body);
	struct edit budget = {.kind = EDIT_BUDGET, .i = {(int)kiosk->session.budget_units}};
	journal_append(kiosk, &budget);
}

void kiosk_listen(struct kiosk *kiosk, const struct frame_reports *reports, unsigned unplugged)
{
	int64_t now_us = (int64_t)(kiosk->frame + 1) * 1000000 / FRAME_RATE_HZ;
	kiosk->input = (struct frame_input){0};
	pen_read(&kiosk->pen, reports, now_us, &kiosk->input);
	for (int device = 0; device < PEN_DEVICES_MAX; device++)
		if (unplugged >> device & 1)
			pen_unplugged(&kiosk->pen, device, &kiosk->input);
}

void kiosk_face(struct kiosk *kiosk)
{
	kiosk->edits.count = 0;
	ui_update(&kiosk->ui, &kiosk->input, &kiosk->session, &kiosk->edits);
}

/* Refused edits are written too: refusing is part of what happened. */
void kiosk_apply(struct kiosk *kiosk)
{
	if (kiosk->frame > 0)
		kiosk->journal_size = 0;
	for (int i = 0; i < kiosk->edits.count; i++) {
		journal_steps(kiosk);
		journal_append(kiosk, &kiosk->edits.item[i]);
		session_apply(&kiosk->session, &kiosk->edits.item[i]);
	}
}

void kiosk_advance(struct kiosk *kiosk)
{
	session_advance(&kiosk->session);
	kiosk->steps++;
	kiosk->frame++;
}

void kiosk_frame(struct kiosk *kiosk, const struct frame_reports *reports, unsigned unplugged)
{
	kiosk_listen(kiosk, reports, unplugged); /* bytes -> samples */
	kiosk_face(kiosk);                       /* samples -> edits */
	kiosk_apply(kiosk);                      /* edits -> document, journal */
	kiosk_advance(kiosk);                    /* jobs, then solver */
}

void kiosk_finish(struct kiosk *kiosk)
{
	kiosk->journal_size = 0;
	journal_steps(kiosk);
}
