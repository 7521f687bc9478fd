#include "hand.h"

#include <stdlib.h>

enum { PEN_DEVICE = 0, BUTTON_DEVICE = 1 };

/* XP-Pen Deco L (28bd:0935), pen interface: 254 x 152.4 mm, 200 lines a millimetre, 8191 levels. */
static const uint8_t deco_l_descriptor[] = {
	0x05, 0x0d, 0x09, 0x01, 0xa1, 0x01, 0x85, 0x02, 0x09, 0x20, 0xa1, 0x00, 0x09, 0x42, 0x09,
	0x44, 0x09, 0x46, 0x75, 0x01, 0x95, 0x03, 0x14, 0x25, 0x01, 0x81, 0x02, 0x95, 0x02, 0x81,
	0x03, 0x09, 0x32, 0x95, 0x01, 0x81, 0x02, 0x95, 0x02, 0x81, 0x03, 0x75, 0x10, 0x95, 0x01,
	0x35, 0x00, 0xa4, 0x05, 0x01, 0x09, 0x30, 0x65, 0x13, 0x55, 0x0d, 0x27, 0x70, 0xc6, 0x00,
	0x00, 0x47, 0x10, 0x27, 0x00, 0x00, 0x81, 0x02, 0x09, 0x31, 0x27, 0x10, 0x77, 0x00, 0x00,
	0x47, 0x70, 0x17, 0x00, 0x00, 0x81, 0x02, 0xb4, 0x09, 0x30, 0x45, 0x00, 0x27, 0xff, 0x1f,
	0x00, 0x00, 0x75, 0x0d, 0x95, 0x01, 0x81, 0x02, 0x75, 0x01, 0x95, 0x03, 0x81, 0x01, 0x09,
	0x3d, 0x35, 0xc3, 0x45, 0x3c, 0x15, 0xc3, 0x25, 0x3c, 0x75, 0x08, 0x95, 0x01, 0x81, 0x02,
	0x09, 0x3e, 0x35, 0xc3, 0x45, 0x3c, 0x15, 0xc3, 0x25, 0x3c, 0x81, 0x02, 0xc0, 0xc0, 0x05,
	0x01, 0x09, 0x07, 0xa1, 0x01, 0x85, 0xf7, 0x05, 0x0d, 0x09, 0x39, 0xa0, 0x75, 0x01, 0x95,
	0x08, 0x81, 0x01, 0x05, 0x09, 0x19, 0x01, 0x2a, 0x08, 0x00, 0x95, 0x0a, 0x14, 0x25, 0x01,
	0x81, 0x02, 0x95, 0x46, 0x81, 0x01, 0xc0, 0xc0,
};

/* ---- the tape's head ---- */

static void write_device(struct hand *hand, int index, const char *name, int vendor, int product,
			 const uint8_t *descriptor, int size)
{
	static struct tape_device device;
	static char line[TAPE_LINE_MAX];
	memset(&device, 0, sizeof device);
	device.used = true;
	snprintf(device.name, sizeof device.name, "%s", name);
	device.bus = 3;
	device.vendor = vendor;
	device.product = product;
	device.descriptor_size = size;
	memcpy(device.descriptor, descriptor, (size_t)size);
	int length;
	for (int part = 0; (length = tape_write_device(line, index, &device, part)) > 0; part++)
		fwrite(line, 1, (size_t)length, hand->tape);
	pen_describe(&hand->kiosk->pen, index, descriptor, size);
}

void hand_begin(struct hand *hand, struct kiosk *kiosk, FILE *tape, int interval_us, uint32_t seed)
{
	struct pen_layout layout[PEN_REPORTS_MAX];
	char reason[160];
	int width_px = kiosk->pen.mapping.width_px, height_px = kiosk->pen.mapping.height_px;
	memset(hand, 0, sizeof *hand);
	hand->kiosk = kiosk;
	hand->tape = tape;
	hand->interval_us = interval_us;
	hand->selected = -1;
	hand->random.state = seed * 2654435761u | 1u;
	hand->at_px = (struct v2){(float)width_px * 0.6f, (float)height_px * 0.9f};
	fprintf(tape, "# kitsuke-tape 1\n# board %d %d\n# budget %ld\n", width_px, height_px,
		kiosk->session.budget_units);
	write_device(hand, PEN_DEVICE, "XP-Pen Deco L Pen", 0x28bd, 0x0935, deco_l_descriptor,
		     COUNT_OF(deco_l_descriptor));
	write_device(hand, BUTTON_DEVICE, "kitsuke buttons", 0, 0, buttons_descriptor,
		     buttons_descriptor_size);
	MUST(pen_descriptor_read(deco_l_descriptor, COUNT_OF(deco_l_descriptor), layout, reason) >
	     0);
	hand->layout = layout[0];
}

void hand_end(struct hand *hand)
{
	hand_leave(hand);
	hand_wait(hand, 0.1f);
	fprintf(hand->tape, "# frames %d\n", hand->kiosk->frame);
}

/* ---- time and reports ---- */

/* Runs the program up to the frame that the time now lies in. */
static void run_frames(struct hand *hand)
{
	int frame = (int)(hand->now_us * FRAME_RATE_HZ / 1000000);
	while (hand->kiosk->frame < frame) {
		kiosk_frame(hand->kiosk, &hand->reports, 0);
		hand->reports.count = 0;
	}
}

static void send(struct hand *hand, int device, const uint8_t *bytes, int size)
{
	static char line[TAPE_LINE_MAX];
	int length = tape_write_select(line, device);
	if (device != hand->selected)
		fwrite(line, 1, (size_t)length, hand->tape);
	hand->selected = device;
	length = tape_write_event(line, hand->now_us, size, bytes);
	fwrite(line, 1, (size_t)length, hand->tape);
	MUST(hand->reports.count < FRAME_REPORTS_MAX);
	struct raw_report *report = &hand->reports.report[hand->reports.count++];
	report->device = device;
	report->time_us = hand->now_us;
	report->size = size;
	memcpy(report->bytes, bytes, (size_t)size);
}

static void put_field(uint8_t *report, const struct pen_field *field, int value)
{
	for (int i = 0; i < field->size; i++) {
		int bit = field->bit + i;
		if ((unsigned)value >> i & 1)
			report[bit / 8] |= (uint8_t)(1 << bit % 8);
	}
}

static float noise(struct hand *hand)
{
	return (float)scatter_below(&hand->random, 20001) / 10000.0f - 1.0f;
}

/* Two detuned oscillations an axis, about a sixth of a millimetre, and a little white noise. */
static struct v2 tremor_mm(struct hand *hand)
{
	static const float rate_hz[4] = {8.3f, 10.1f, 8.9f, 10.7f};
	float wave[4];
	for (int i = 0; i < 4; i++) {
		float dt = (float)hand->interval_us * 1e-6f;
		hand->phase[i] += 2.0f * PI_F * rate_hz[i] * dt * (1.0f + 0.3f * noise(hand));
		if (hand->phase[i] > 2.0f * PI_F)
			hand->phase[i] -= 2.0f * PI_F;
		wave[i] = angle_sin(hand->phase[i]);
	}
	return (struct v2){0.09f * wave[0] + 0.06f * wave[1] + 0.02f * noise(hand),
			   0.08f * wave[2] + 0.06f * wave[3] + 0.02f * noise(hand)};
}

/* Where on the tablet the pen must be to be there on the screen (pen.h: struct pen_mapping). */
static struct v2 place_mm(const struct hand *hand)
{
	struct v2 screen = {(float)hand->kiosk->pen.mapping.width_px,
			    (float)hand->kiosk->pen.mapping.height_px};
	struct v2 tablet = {hand->layout.width_mm, hand->layout.height_mm};
	float scale = float_max(screen.x / tablet.x, screen.y / tablet.y);
	struct v2 from_centre = v2_sub(hand->at_px, v2_scale(screen, 0.5f));
	return v2_add(v2_scale(tablet, 0.5f), v2_scale(from_centre, 1.0f / scale));
}

/* One interval of the tablet: time passes, a report is sent when the pen is near. */
static void tick(struct hand *hand)
{
	hand->now_us += hand->interval_us;
	run_frames(hand);
	float goal = hand->touching ? 0.45f + 0.08f * hand->drift : 0.0f;
	hand->pressure += float_clamp(goal - hand->pressure, -0.12f, 0.08f);
	hand->drift = float_clamp(hand->drift + 0.05f * noise(hand), -1.0f, 1.0f);
	if (!hand->near)
		return;
	const struct pen_layout *layout = &hand->layout;
	uint8_t report[REPORT_BYTES_MAX] = {0};
	struct v2 tablet_mm = v2_add(place_mm(hand), tremor_mm(hand));
	int x = (int)(tablet_mm.x / layout->width_mm * (float)layout->x.maximum);
	int y = (int)(tablet_mm.y / layout->height_mm * (float)layout->y.maximum);
	int pressure = (int)(hand->pressure * (float)layout->pressure.maximum);
	report[0] = (uint8_t)layout->report_id;
	put_field(report, &layout->x, int_clamp(x, 0, layout->x.maximum));
	put_field(report, &layout->y, int_clamp(y, 0, layout->y.maximum));
	put_field(report, &layout->pressure, hand->touching || pressure > 80 ? pressure : 0);
	put_field(report, &layout->tip, pressure > 80);
	put_field(report, &layout->in_range, 1);
	put_field(report, &layout->tilt_x, 18 + (int)(6.0f * hand->drift));
	put_field(report, &layout->tilt_y, 31 - (int)(4.0f * hand->drift));
	send(hand, PEN_DEVICE, report, layout->report_bits / 8);
}

void hand_wait(struct hand *hand, float seconds)
{
	for (int i = 0; i < (int)(seconds * 1e6f) / hand->interval_us; i++)
		tick(hand);
}

void hand_leave(struct hand *hand)
{
	if (!hand->near)
		return;
	hand->near = false;
	uint8_t report[REPORT_BYTES_MAX] = {0};
	report[0] = (uint8_t)hand->layout.report_id;
	hand->now_us += hand->interval_us;
	run_frames(hand);
	send(hand, PEN_DEVICE, report, hand->layout.report_bits / 8);
}

/* ---- motion ---- */

/* How far along the path the nearest bend of more than 35 degrees lies. */
static float bend_distance(const struct v2 *path_px, const float *along, int count, float s)
{
	float nearest = 1e9f;
	for (int i = 1; i + 1 < count; i++) {
		struct v2 before = v2_normalize(v2_sub(path_px[i], path_px[i - 1]));
		struct v2 after = v2_normalize(v2_sub(path_px[i + 1], path_px[i]));
		if (v2_dot(before, after) < 0.82f)
			nearest = float_min(nearest, float_abs(along[i] - s));
	}
	return nearest;
}

/* The pace of a hand: from slow to full within 30 pixels after the start, before the end and round
 * bends. */
static float pace(float distance_px)
{
	return float_clamp(0.25f + 0.75f * distance_px / 30.0f, 0.25f, 1.0f);
}

void hand_follow(struct hand *hand, const struct v2 *path_px, int count, float speed)
{
	static float along[HAND_PATH_MAX];
	MUST(count >= 2 && count <= HAND_PATH_MAX);
	along[0] = 0.0f;
	for (int i = 1; i < count; i++)
		along[i] = along[i - 1] + v2_distance(path_px[i - 1], path_px[i]);
	float length = along[count - 1], s = 0.0f;
	for (int at = 1; s < length;) {
		float step = speed * (float)hand->interval_us * 1e-6f;
		float ends = float_min(s, length - s);
		s += step * float_min(pace(ends), pace(bend_distance(path_px, along, count, s)));
		s = float_min(s, length);
		while (at < count - 1 && along[at] < s)
			at++;
		float run = float_max(along[at] - along[at - 1], 1e-6f);
		hand->at_px = v2_lerp(path_px[at - 1], path_px[at],
				      float_clamp((s - along[at - 1]) / run, 0.0f, 1.0f));
		tick(hand);
	}
}

void hand_move(struct hand *hand, struct v2 to_px)
{
	hand->near = true;
	struct v2 path[2] = {hand->at_px, to_px};
	hand_follow(hand, path, 2, 1500.0f);
}

void hand_touch(struct hand *hand, struct v2 at_px)
{
	hand_move(hand, at_px);
	hand->touching = true;
	hand_wait(hand, 0.05f);
}

void hand_lift(struct hand *hand)
{
	hand->touching = false;
	hand_wait(hand, 0.06f);
}

void hand_stroke(struct hand *hand, const struct v2 *path_px, int count, float speed)
{
	hand_touch(hand, path_px[0]);
	hand_follow(hand, path_px, count, speed);
	hand_lift(hand);
}

void hand_tap(struct hand *hand, struct v2 at_px)
{
	hand_touch(hand, at_px);
	hand_wait(hand, 0.06f);
	hand_lift(hand);
}

void hand_tap_target(struct hand *hand, enum target target)
{
	const struct rect *rect = &hand->kiosk->ui.layout.target[target];
	if (rect->w == 0) {
		fprintf(stderr, "hand: target %d is not on the screen in step %d\n", target,
			hand->kiosk->ui.step);
		exit(EXIT_FAILURE);
	}
	hand_tap(hand, (struct v2){(float)rect->x + 0.5f * (float)rect->w + 3.0f * noise(hand),
				   (float)rect->y + 0.5f * (float)rect->h + 3.0f * noise(hand)});
}

void hand_button_down(struct hand *hand, enum button button, bool down)
{
	hand->held = (uint8_t)(down ? hand->held | 1 << button : hand->held & ~(1 << button));
	hand->now_us += 1000;
	run_frames(hand);
	send(hand, BUTTON_DEVICE, &hand->held, 1);
	hand_wait(hand, 0.03f);
}

void hand_button(struct hand *hand, enum button button, float seconds)
{
	hand_button_down(hand, button, true);
	hand_wait(hand, seconds);
	hand_button_down(hand, button, false);
}
