/* kitsuke devices: what is attached, what each thing is to us, and what is missing.
 * kitsuke devices --descriptor FILE: the pens in a report descriptor, as JSON. */
#include "commands.h"

#include "board_file.h"
#include "buttons.h"
#include "device_words.h"
#include "live.h"
#include "options.h"
#include "store.h"

#include <grp.h>
#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

static const char usage[] =
	"usage: kitsuke devices [--board FILE]\n"
	"       kitsuke devices --descriptor FILE   the pens in a binary report "
	"descriptor, as JSON\n";

/* --- descriptors ------------------------------------------------------------------------------ */

static json_t *field_json(const struct pen_field *field)
{
	if (!field->size)
		return json_null();
	return json_pack("{s:i, s:i, s:i, s:i, s:b}", "bit", field->bit, "size", field->size,
			 "minimum", field->minimum, "maximum", field->maximum, "signed",
			 field->is_signed);
}

/* Hundredths of a millimetre are finer than any tablet states. */
static json_t *mm_json(float mm)
{
	return mm > 0.0f ? json_real((double)(int)(mm * 100.0f + 0.5f) / 100.0) : json_null();
}

static json_t *layout_json(const struct pen_layout *l)
{
	const struct {
		const char *name;
		const struct pen_field *field;
	} fields[] = {
		{"x", &l->x},
		{"y", &l->y},
		{"pressure", &l->pressure},
		{"tilt_x", &l->tilt_x},
		{"tilt_y", &l->tilt_y},
		{"twist", &l->twist},
		{"tip", &l->tip},
		{"in_range", &l->in_range},
		{"invert", &l->invert},
		{"eraser", &l->eraser},
		{"barrel", &l->barrel},
		{"barrel_2", &l->barrel_2},
		{"serial", &l->serial},
	};
	json_t *object = json_pack("{s:i, s:i, s:i, s:b}", "report_id", l->report_id, "report_bits",
				   l->report_bits, "id_bits", l->report_id ? 8 : 0,
				   "absolute_mouse", l->absolute_mouse);
	for (int i = 0; i < COUNT_OF(fields); i++)
		json_object_set_new(object, fields[i].name, field_json(fields[i].field));
	json_object_set_new(object, "width_mm", mm_json(l->width_mm));
	json_object_set_new(object, "height_mm", mm_json(l->height_mm));
	json_object_set_new(object, "tilt_unit_deg",
			    l->tilt_x.size
				    ? json_real((double)l->tilt_unit_rad * 180.0 / (double)PI_F)
				    : json_null());
	return object;
}

static json_t *shape_json(const struct pen_shape *shape)
{
	json_t *reports = json_array();
	for (int i = 0; i < shape->count; i++) {
		const struct pen_shape_report *r = &shape->report[i];
		json_array_append_new(reports,
				      json_pack("{s:i, s:i, s:i, s:i, s:i, s:i}", "id", r->id,
						"usage_page", (int)(r->application >> 16), "usage",
						(int)(r->application & 0xffff), "input_bytes",
						r->input_bytes, "output_bytes", r->output_bytes,
						"feature_bytes", r->feature_bytes));
	}
	return reports;
}

/* Which maker's protocol a USB device with this descriptor would be asked to speak. */
static void protocol_json(json_t *object, const uint8_t *descriptor, int size)
{
	struct pen_identity identity = {
		.bus = 3, .driver = "", .descriptor = descriptor, .descriptor_size = size};
	struct pen_recipe recipe;
	struct pen_shape shape;
	char reason[160];
	bool speaks = pen_identify(&identity, &recipe, reason) &&
		      recipe.family != PEN_BY_DESCRIPTOR;
	pen_shape_read(&shape, descriptor, size);
	json_object_set_new(object, "protocol",
			    speaks ? json_string(pen_family_rule(recipe.family)->word)
				   : json_null());
	json_object_set_new(object, "protocol_reason", json_string(reason));
	json_object_set_new(object, "reports", shape_json(&shape));
}

static int descriptor_print(const char *path)
{
	struct pen_layout layout[PEN_REPORTS_MAX];
	char fault[FAULT_BYTES], reason[160];
	size_t size;
	char *bytes = store_read(path, &size, fault);
	if (!bytes) {
		fprintf(stderr, "kitsuke devices: %s\n", fault);
		return STATUS_INPUT;
	}
	int bounded = size > DESCRIPTOR_BYTES_MAX ? DESCRIPTOR_BYTES_MAX + 1 : (int)size;
	int count = pen_descriptor_read((const uint8_t *)bytes, bounded, layout, reason);
	bool sound = pen_descriptor_sound((const uint8_t *)bytes, bounded);
	if (!sound) {
		free(bytes);
		fprintf(stderr,
			"kitsuke devices: %s: %s; a binary HID report descriptor is needed\n", path,
			reason);
		return STATUS_INPUT;
	}
	json_t *pens = json_array();
	for (int i = 0; i < count; i++)
		json_array_append_new(pens, layout_json(&layout[i]));
	json_t *object = json_pack("{s:s, s:s, s:o}", "bits_count_from",
				   "the start of the report, id byte included", "reason", reason,
				   "pens", pens);
	protocol_json(object, (const uint8_t *)bytes, bounded);
	free(bytes);
	json_dumpf(object, stdout, JSON_INDENT(2) | JSON_REAL_PRECISION(7));
	putchar('\n');
	json_decref(object);
	return STATUS_DONE;
}

/* --- what is attached ------------------------------------------------------------------------- */

static void tablets_print(void)
{
	struct live_node *nodes = calloc(LIVE_NODES_MAX, sizeof *nodes);
	int count = nodes ? live_nodes_find(nodes, LIVE_NODES_MAX) : 0;
	const struct group *group = getgrgid(getgid());
	printf("tablets:\n");
	for (int i = 0; i < count; i++) {
		const struct live_node *node = &nodes[i];
		struct device_model model = {0};
		if (node->layout_count || node->speaks)
			live_model_find(node, &model.width_mm, &model.height_mm, &model.display);
		device_words(stdout, node, &model, group ? group->gr_name : "input");
	}
	if (!count)
		printf("  none: no HID device is attached, or the kernel has no hidraw\n");
	free(nodes);
}

static void line_print(const struct board *board, enum button button, const char *name,
		       const struct buttons_chip *chips, int count)
{
	const char *line = board->button_line[button];
	int found = 0;
	if (!line[0]) {
		printf("  %s: the board file names no line\n", name);
		return;
	}
	for (int i = 0; i < count; i++) {
		if (chips[i].offset[button] < 0)
			continue;
		printf("  %s: line \"%s\" on %s (%s), offset %d%s\n", name, line, chips[i].path,
		       chips[i].label, chips[i].offset[button],
		       found++ ? "; twice, so not used: give it a name of its own" : "");
	}
	if (!found)
		printf("  %s: no chip has a line \"%s\"; set its name in the board file\n", name,
		       line);
}

static void buttons_print(const struct board *board)
{
	static struct buttons_chip chips[16];
	static const char *names[BUTTON_COUNT] = {"wrap", "pin", "relax"};
	int refused, count = buttons_chips_find(board, chips, COUNT_OF(chips), &refused);
	printf("buttons:\n");
	for (int i = 0; i < count; i++)
		printf("  %s  %s (%s), %d lines\n", chips[i].path, chips[i].name, chips[i].label,
		       chips[i].line_count);
	if (refused)
		printf("  %d GPIO chips: permission denied; a udev rule must give this user's "
		       "group "
		       "/dev/gpiochip*\n",
		       refused);
	if (!count && !refused)
		printf("  none: this machine has no GPIO chip\n");
	for (int i = 0; count && i < BUTTON_COUNT; i++)
		line_print(board, (enum button)i, names[i], chips, count);
}

int command_devices(int argc, char **argv)
{
	const char *files[OPTION_FILES_MAX], *descriptor = NULL, *board_path = NULL;
	const struct option_value known[] = {
		{.name = "--descriptor", .text = &descriptor},
		{.name = "--board", .text = &board_path},
		{0},
	};
	struct board board = board_default;
	char fault[FAULT_BYTES];
	int file_count;
	if (!options_read(argc, argv, known, files, &file_count) || file_count) {
		fputs(usage, stderr);
		return STATUS_USAGE;
	}
	if (descriptor)
		return descriptor_print(descriptor);
	if (board_path && !board_load(&board, board_path, fault)) {
		fprintf(stderr, "kitsuke devices: %s\n", fault);
		return STATUS_INPUT;
	}
	tablets_print();
	buttons_print(&board);
	return STATUS_DONE;
}
