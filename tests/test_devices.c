/* The commands about devices, called like main calls them. */
#include "commands.h"
#include "device_words.h"
#include "pen.h"
#include "tape.h"
#include "test.h"

#include <jansson.h>
#include <unistd.h>

#define FOLDER "build/test_devices"

/* Runs a command with its output in a file; returns the exit status. */
static int run(int (*command)(int, char **), int argc, char **argv, const char *output)
{
	fflush(stdout);
	int kept_out = dup(1), kept_err = dup(2);
	FILE *out = fopen(output, "w+");
	if (!out)
		return -1;
	dup2(fileno(out), 1);
	dup2(fileno(out), 2);
	int status = command(argc, argv);
	fflush(stdout);
	fflush(stderr);
	dup2(kept_out, 1);
	dup2(kept_err, 2);
	close(kept_out);
	close(kept_err);
	fclose(out);
	return status;
}

static bool output_has(const char *path, const char *words)
{
	char text[8192];
	FILE *file = fopen(path, "r");
	size_t size = file ? fread(text, 1, sizeof text - 1, file) : 0;
	text[size] = 0;
	if (file)
		fclose(file);
	bool has = strstr(text, words) != NULL;
	if (!has)
		fprintf(stderr, "\"%s\" is not in: %s\n", words, text);
	return has;
}

static int descriptor_status(const void *bytes, size_t size)
{
	char *argv[] = {"devices", "--descriptor", FOLDER "/descriptor"};
	FILE *file = fopen(argv[2], "wb");
	CHECK(file && fwrite(bytes, 1, size, file) == size && fclose(file) == 0);
	return run(command_devices, 3, argv, FOLDER "/output");
}

static void check_descriptor(void)
{
	json_error_t error;
	CHECK(descriptor_status(mouse_descriptor, (size_t)mouse_descriptor_size) == STATUS_DONE);
	json_t *object = json_load_file(FOLDER "/output", 0, &error);
	json_t *pen = json_array_get(json_object_get(object, "pens"), 0);
	CHECK(json_array_size(json_object_get(object, "pens")) == 1);
	CHECK(json_integer_value(json_object_get(pen, "report_bits")) == 56);
	json_t *pressure = json_object_get(pen, "pressure");
	CHECK(json_integer_value(json_object_get(pressure, "bit")) == 40);
	CHECK(json_integer_value(json_object_get(pressure, "maximum")) == 4095);
	CHECK(json_is_null(json_object_get(pen, "width_mm")));
	CHECK(json_is_null(json_object_get(pen, "tilt_x")));
	json_decref(object);

	/* sound, and no pen */
	CHECK(descriptor_status(buttons_descriptor, (size_t)buttons_descriptor_size) ==
	      STATUS_DONE);
	object = json_load_file(FOLDER "/output", 0, &error);
	CHECK(json_array_size(json_object_get(object, "pens")) == 0);
	CHECK(strlen(json_string_value(json_object_get(object, "reason"))) > 10);
	json_decref(object);

	/* a maker's protocol by its shape */
	static const uint8_t vendor[] = {0x06, 0x00, 0xff, 0x09, 0x01, 0xa1, 0x01, 0x85,
					 0x08, 0x09, 0x01, 0x15, 0x00, 0x26, 0xff, 0x00,
					 0x75, 0x08, 0x95, 0x0b, 0x81, 0x02, 0xc0};
	CHECK(descriptor_status(vendor, sizeof vendor) == STATUS_DONE);
	object = json_load_file(FOLDER "/output", 0, &error);
	json_t *report = json_array_get(json_object_get(object, "reports"), 0);
	CHECK(!strcmp(json_string_value(json_object_get(object, "protocol")), "uclogic-2"));
	CHECK(json_integer_value(json_object_get(report, "input_bytes")) == 12);
	json_decref(object);

	/* cut off, empty, too long, absent */
	static const uint8_t zeros[DESCRIPTOR_BYTES_MAX + 1];
	CHECK(descriptor_status(mouse_descriptor, 20) == STATUS_INPUT);
	CHECK(output_has(FOLDER "/output", "descriptor: byte 20"));
	CHECK(descriptor_status("", 0) == STATUS_INPUT);
	CHECK(descriptor_status(zeros, sizeof zeros) == STATUS_INPUT);
	char *absent[] = {"devices", "--descriptor", FOLDER "/absent"};
	CHECK(run(command_devices, 3, absent, FOLDER "/output") == STATUS_INPUT);
	CHECK(output_has(FOLDER "/output", "absent"));
}

/* One node's lines. */
static const char *words_of(const struct live_node *node)
{
	static char text[4096];
	struct device_model none = {0};
	FILE *out = fmemopen(text, sizeof text, "w");
	device_words(out, node, &none, "kiosk");
	fclose(out);
	return text;
}

static void has(const char *text, const char *words)
{
	if (!strstr(text, words)) {
		fprintf(stderr, "\"%s\" is not in: %s\n", words, text);
		test_failures++;
	}
}

static void check_words(void)
{
	struct live_node node = {.path = "/dev/hidraw3",
				 .driver = "hid-generic",
				 .interface = 1,
				 .usb_bus = 1,
				 .usb_address = 4,
				 .readable = true,
				 .usb_writable = true,
				 .text = "pen",
				 .told = {.name = "A Tablet",
					  .bus = 3,
					  .vendor = 0x256c,
					  .product = 0x6d,
					  .descriptor_size = mouse_descriptor_size}};
	memcpy(node.told.descriptor, mouse_descriptor, (size_t)mouse_descriptor_size);
	char reason[160];
	node.layout_count = pen_descriptor_read(mouse_descriptor, mouse_descriptor_size,
						node.layout, reason);
	has(words_of(&node), "256c:006d  A Tablet, interface 1");
	has(words_of(&node), "its report descriptor (1 reports");
	has(words_of(&node), "/dev/hidraw3 can be read");
	has(words_of(&node), "tablet_mm");
	node.layout[0].width_mm = 200.0f;
	has(words_of(&node), "to mend     nothing");
	node.readable = false;
	has(words_of(&node), "CANNOT be read");
	has(words_of(&node), "GROUP=\"kiosk\"");
	has(words_of(&node), "/etc/udev/rules.d/70-kitsuke-256c-006d.rules");
	node.readable = true;
	strcpy(node.driver, "uclogic");
	has(words_of(&node), "in the way of the maker's protocol");
	has(words_of(&node), "/etc/modprobe.d/kitsuke-hid_uclogic.conf");
	strcpy(node.driver, "hid-generic");
	node.speaks = true;
	node.recipe = (struct pen_recipe){
		.family = PEN_UGEE_2,
		.step_count = 2,
		.step = {{PEN_STEP_OUTPUT, false, true, 0, 3, {2, 0xb0, 4}},
			 {PEN_STEP_STRING, true, false, 100, 0, {0}}}};
	has(words_of(&node), "Ugee 2 (XP-Pen, Parblo), by the shape");
	has(words_of(&node), "output 02 b0 04, string 100 if need be");
	has(words_of(&node), "/dev/bus/usb/001/004 can be asked");
	node.usb_writable = false;
	has(words_of(&node), "CANNOT be asked");
	has(words_of(&node), "SUBSYSTEM==\"usb\", ATTR{idVendor}==\"256c\"");
	node.readable = false;
	node.told.bus = 0x18; /* a pen display's I2C: its parents have no idVendor */
	has(words_of(&node), "KERNELS==\"0018:256C:");
	node.speaks = false;
	node.layout_count = 0;
	snprintf(node.protocol, sizeof node.protocol, "no known protocol has such reports");
	has(words_of(&node), "none; no known protocol");
	CHECK(!strstr(words_of(&node), "to mend"));
}

/* libwacom's data: sizes in whole inches, and what is a display. */
static void check_model(int product, float width_mm, bool is_display)
{
	struct live_node node = {.told = {.vendor = 0x056a, .product = product}};
	float width = 0.0f, height = 0.0f;
	bool display = !is_display;
	CHECK(live_model_find(&node, &width, &height, &display));
	CHECK_NEAR(width, width_mm, 26.0);
	CHECK(height > 0.0f && height < width && display == is_display);
}

static void check_models(void)
{
	struct live_node nobody = {.told = {.name = "no such tablet", .vendor = 0x1234}};
	float width, height;
	bool display;
	check_model(0x0027, 223.5f, false); /* Intuos5 touch M */
	check_model(0x0350, 345.6f, true);  /* Cintiq Pro 16 */
	CHECK(!live_model_find(&nobody, &width, &height, &display));
}

static void check_attached(void)
{
	char *plain[] = {"devices"}, *wrong[] = {"devices", "what"};
	char *board[] = {"devices", "--board", FOLDER "/board"};
	CHECK(run(command_devices, 1, plain, FOLDER "/output") == STATUS_DONE);
	CHECK(output_has(FOLDER "/output", "tablets:\n  "));
	CHECK(output_has(FOLDER "/output", "buttons:\n  "));
	CHECK(run(command_devices, 2, wrong, FOLDER "/output") == STATUS_USAGE);
	FILE *file = fopen(board[2], "w");
	CHECK(file && fputs("rotation = 1\n", file) >= 0 && fclose(file) == 0);
	CHECK(run(command_devices, 3, board, FOLDER "/output") == STATUS_INPUT);
	CHECK(output_has(FOLDER "/output", "line 1: rotation = 1"));
}

static int samples_status(const char *tape, const char *descriptor)
{
	char *argv[] = {"replay", "--samples", FOLDER "/tape.hid", "--descriptor",
			FOLDER "/descriptor"};
	FILE *file = fopen(argv[2], "w");
	CHECK(file && fputs(tape, file) >= 0 && fclose(file) == 0);
	if (descriptor) {
		file = fopen(argv[4], "wb");
		CHECK(file && fputs(descriptor, file) >= 0 && fclose(file) == 0);
	}
	return run(command_replay, descriptor ? 5 : 3, argv, FOLDER "/output");
}

/* A maker's protocol on a tape of ours, on another program's by its ids, and on a dump that tells
 * nothing but its reports. */
static void check_samples(void)
{
	static const char vendor[] =
		"# kitsuke-tape 1\n# board 1000 500\n# vendor 0 uclogic-2 1000 500 8191\n"
		"# tablet 0 200.0 100.0\nD: 0\nR: 2 05 0d\nN: pen\nI: 3 256c 006d\n"
		"E: 0.0 12 08 81 f4 01 fa 00 ff 1f 00 00 00 00\n";
	static const char wacom[] =
		"# 027:0 -> 056A:00D4\nD:0\nR: 21 05 0d 09 01 a1 01 85 02 09 01 15 00 25 7f 75 08 "
		"95 08 81 02 c0\nN: CTL-460\nI: 3 056A 00D4\n"
		"E: 0.0 9 02 e1 00 10 00 10 ff 03 05\n";
	static const char dump[] =
		"001:004:000:STREAM 1536019347.135589\n 08 80 70 C6 06 7C 00 00 00 00 00 00\n\n"
		"001:004:000:STREAM 1536019347.139589\n 08 81 70 46 06 3C FF 1F 00 00 00 00\n";
	CHECK(samples_status(vendor, NULL) == STATUS_DONE);
	CHECK(output_has(FOLDER "/output", "\"touch\", \"x_px\": 500.000, \"y_px\": 250.000"));
	CHECK(samples_status(wacom, NULL) == STATUS_DONE);
	CHECK(output_has(FOLDER "/output", "\"touch\""));
	CHECK(samples_status(dump, NULL) == STATUS_DONE);
	CHECK(output_has(FOLDER "/output", "look like UC-Logic 2 (Huion, Gaomon) with 50800 x"));
	CHECK(output_has(FOLDER "/output", "\"hover\""));
	CHECK(output_has(FOLDER "/output", "\"touch\""));
	CHECK(samples_status(dump, "no descriptor") == STATUS_INPUT);
	CHECK(output_has(FOLDER "/output", "no sound report descriptor"));
}

static void check_record(void)
{
	char *nothing[] = {"record"};
	char *nowhere[] = {"record", "--out", FOLDER "/no/tape"};
	CHECK(run(command_record, 1, nothing, FOLDER "/output") == STATUS_USAGE);
	CHECK(run(command_record, 3, nowhere, FOLDER "/output") == STATUS_MACHINE);
	/* A second with a board whose tablet is never there: nothing comes, and that is told. */
	char *idle[] = {"record", "--out",   FOLDER "/tape", "--seconds",
			"1",      "--board", FOLDER "/idle"};
	FILE *file = fopen(FOLDER "/idle", "w");
	CHECK(file &&
	      fputs("tablet = ffff:fffe\nwrap = none\npin = none\nrelax = none\n", file) >= 0 &&
	      fclose(file) == 0);
	CHECK(run(command_record, 7, idle, FOLDER "/output") == STATUS_MACHINE);
	CHECK(output_has(FOLDER "/output", "nothing came"));
	CHECK(output_has(FOLDER "/tape", "# kitsuke-tape 1\n"));
}

int main(void)
{
	if (system("mkdir -p " FOLDER) != 0)
		return EXIT_FAILURE;
	check_descriptor();
	check_words();
	check_models();
	check_attached();
	check_samples();
	check_record();
	return test_end();
}
