#include "take_home_page.h"

#include "text.h"

/* Of the look's drawing; what is across scales with the width. */
static struct rect place(const struct layout *layout, int x, int y, int w, int h)
{
	return (struct rect){x * layout->width / 1920, layout->bar.h + layout_px(layout, y - 84),
			     layout_px(layout, w), layout_px(layout, h)};
}

void take_home_layout(struct take_home_layout *out, const struct layout *layout)
{
	int bottom = layout->bottom.y, high = layout_px(layout, 108);
	out->card = place(layout, 40, 110, 1178, 796);
	out->qr = place(layout, 1308, 110, 500, 500);
	out->words = place(layout, 1258, 622, 622, 78);
	out->station = place(layout, 1258, 716, 622, 92);
	out->stick = place(layout, 1258, 822, 622, 92);
	out->key[TAKE_HOME_BACK] = (struct rect){40 * layout->width / 1920,
						 bottom + layout_px(layout, 20),
						 layout_px(layout, 560), high};
	out->key[TAKE_HOME_LEAVE] = (struct rect){1308 * layout->width / 1920,
						  bottom + layout_px(layout, 20),
						  layout_px(layout, 572), high};
}

void take_home_open(struct ui *ui)
{
	ui->take_home.open = true;
	ui->take_home.count++;
	ui->take_home.pressed = -1;
	ui->take_home.down = false;
	ui->notice = TEXT_NONE;
}

static int key_at(const struct ui *ui, struct v2 position_px)
{
	struct take_home_layout layout;
	take_home_layout(&layout, &ui->layout);
	for (int k = 0; k < TAKE_HOME_KEYS; k++)
		if (rect_holds(layout.key[k], position_px))
			return k;
	return -1;
}

void take_home_update(struct ui *ui, const struct frame_input *input)
{
	bool back = input->buttons_pressed != 0;
	for (int i = 0; i < input->sample_count; i++) {
		const struct pen_sample *sample = &input->sample[i];
		bool touch = sample->state == PEN_TOUCH;
		if (touch)
			ui->pen_px = sample->position_px;
		if (touch && !ui->take_home.down)
			ui->take_home.pressed = key_at(ui, ui->pen_px);
		if (!touch && ui->take_home.down && ui->take_home.pressed >= 0 &&
		    key_at(ui, ui->pen_px) == ui->take_home.pressed) {
			back |= ui->take_home.pressed == TAKE_HOME_BACK;
			ui->take_home.leave |= ui->take_home.pressed == TAKE_HOME_LEAVE;
		}
		if (!touch)
			ui->take_home.pressed = -1;
		ui->take_home.down = touch;
		ui->pen_state = sample->state;
		ui->pen_px = sample->position_px;
	}
	if (back)
		ui->take_home.open = false;
}
