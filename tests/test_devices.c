/* The commands about devices, called like main calls them. */
#include "commands.h"
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
	check_attached();
	check_record();
	return test_end();
}
