/* See kiosk_late.h. */
#include "kiosk_late.h"

void kiosk_late_show(struct kiosk_late *late, struct kiosk *kiosk,
		     const struct frame_reports *reports)
{
	struct ui *ui = &kiosk->ui;
	late->stroke_count = ui->stroke_count;
	late->pen_px = ui->pen_px;
	if (!reports->count)
		return;
	late->pen = kiosk->pen;
	late->input.sample_count = 0;
	pen_read(&late->pen, reports, reports->report[reports->count - 1].time_us, &late->input);
	for (int i = 0; i < late->input.sample_count; i++) {
		const struct pen_sample *sample = &late->input.sample[i];
		if (sample->state != ui->pen_state || sample->state == PEN_AWAY)
			break;
		ui->pen_px = sample->position_px;
		if (ui->stroke_count > 0 && ui->stroke_count < STROKE_SAMPLES_MAX)
			ui->stroke_px[ui->stroke_count++] = sample->position_px;
	}
}

void kiosk_late_hide(const struct kiosk_late *late, struct kiosk *kiosk)
{
	kiosk->ui.stroke_count = late->stroke_count;
	kiosk->ui.pen_px = late->pen_px;
}
