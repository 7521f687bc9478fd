/* What the Linux kernel made of two recordings, event by event, against our fields. evemu lists
 * only what changed, in frames that end with SYN_REPORT. */
#include "pen.h"
#include "table.h"
#include "tape.h"
#include "test.h"

#define DATA "../shared/data/hid/"

struct seen {
	int x, y, pressure;
	bool near, touch, barrel;
};

static bool same(const struct seen *a, const struct seen *b)
{
	return a->x == b->x && a->y == b->y && a->pressure == b->pressure && a->near == b->near &&
	       a->touch == b->touch && a->barrel == b->barrel;
}

/* --- the kernel's side ------------------------------------------------------------------------ */

struct tools {
	bool pen, rubber;
};

static void kernel_event(struct seen *now, struct tools *tools, unsigned type, unsigned code,
			 int value)
{
	if (type == 3 && code == 0x00)
		now->x = value;
	if (type == 3 && code == 0x01)
		now->y = value;
	if (type == 3 && code == 0x18)
		now->pressure = value;
	if (type == 1 && code == 0x140)
		tools->pen = value;
	if (type == 1 && code == 0x141)
		tools->rubber = value;
	if (type == 1 && code == 0x14a)
		now->touch = value;
	if (type == 1 && code == 0x14b)
		now->barrel = value;
	now->near = tools->pen || tools->rubber;
}

/* The states after each frame that changed something; returns their number. */
static int kernel_states(const char *text, struct seen *states, int capacity)
{
	struct seen now = {0}, last = {0};
	struct tools tools = {0};
	int count = 0;
	for (const char *line = text; line && *line; line = strchr(line, '\n')) {
		unsigned type, code;
		int value;
		line += *line == '\n';
		if (sscanf(line, "E: %*s %x %x %d", &type, &code, &value) != 3)
			continue;
		if (type == 0 && code == 0 && !same(&now, &last) && count < capacity)
			states[count++] = last = now;
		kernel_event(&now, &tools, type, code, value);
	}
	return count;
}

/* --- ours ------------------------------------------------------------------------------------- */

static int own_states(const struct tape *tape, struct seen *states, int capacity)
{
	struct pen_layout layout[PEN_REPORTS_MAX];
	struct seen last = {0};
	struct pen_memory memory = {0};
	char reason[160];
	int count = 0;
	int layouts = pen_descriptor_read(tape->device[0].descriptor,
					  tape->device[0].descriptor_size, layout, reason);
	for (size_t i = 0; i < tape->event_count; i++) {
		const struct tape_event *event = &tape->event[i];
		struct pen_fields f;
		bool cut_off;
		if (!pen_report_read(layout, layouts, tape->bytes + event->offset, event->size,
				     &memory, &f, &cut_off))
			continue;
		struct seen now = {f.x, f.y, f.pressure, f.in_range, f.tip, f.barrel};
		if (!same(&now, &last) && count < capacity)
			states[count++] = last = now;
	}
	return count;
}

static void check_recording(const char *recording, const char *evemu)
{
	static struct seen kernel[4096], own[4096];
	static struct tape tape;
	char fault[200];
	size_t size;
	char *text = table_file(evemu, &size);
	int kernel_count = text ? kernel_states(text, kernel, COUNT_OF(kernel)) : 0;
	free(text);
	text = table_file(recording, &size);
	CHECK(text && tape_read(&tape, text, size, fault));
	int own_count = own_states(&tape, own, COUNT_OF(own));
	CHECK(kernel_count > 1000);
	CHECK(own_count == kernel_count);
	int different = 0;
	for (int i = 0; i < own_count && i < kernel_count; i++)
		if (!same(&own[i], &kernel[i]) && different++ == 0)
			fprintf(stderr,
				"state %d: x %d y %d p %d near %d touch %d barrel %d, the kernel "
				"says %d "
				"%d %d %d %d %d\n",
				i, own[i].x, own[i].y, own[i].pressure, own[i].near, own[i].touch,
				own[i].barrel, kernel[i].x, kernel[i].y, kernel[i].pressure,
				kernel[i].near, kernel[i].touch, kernel[i].barrel);
	CHECK(different == 0);
	tape_free(&tape);
	free(text);
}

int main(void)
{
	static const char *recordings[] = {
		DATA "bentiss-hid-devices/events/pen_touch/win8/n-trig_1b96_1000.hid",
		DATA "bentiss-hid-devices/events/pen_touch/win8/n-trig_1b96_0c01.hid",
	};
	static const char *evemus[] = {
		DATA "expected_evemu/n-trig_1b96_1000_1.ev",
		DATA "expected_evemu/n-trig_1b96_0c01_1.ev",
	};
	int checked = 0;
	for (int i = 0; i < COUNT_OF(recordings); i++) {
		FILE *file = fopen(recordings[i], "rb");
		if (!file)
			continue;
		fclose(file);
		check_recording(recordings[i], evemus[i]);
		checked++;
	}
	if (!checked) {
		printf("skip: no n-trig recording at " DATA "\n");
		return 77;
	}
	return test_end();
}
