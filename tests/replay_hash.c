/* Plays tapes through the pure part of the program and prints each one's state hash: what must be
 * the same on every processor, compiler, optimisation level and number of threads. Needs no
 * package.
 *
 *   replay_hash THREADS TAPE...
 */
#include "kiosk.h"
#include "tape_learn.h"
#include "threads.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

static struct threads threads;

static char *read_file(const char *path, size_t *size)
{
	FILE *file = fopen(path, "rb");
	if (!file)
		return NULL;
	size_t capacity = (size_t)1 << 26;
	char *text = malloc(capacity);
	*size = text ? fread(text, 1, capacity, file) : 0;
	fclose(file);
	return text;
}

static bool play(struct kiosk *kiosk, void *memory, const char *path)
{
	static struct tape tape;
	char fault[200];
	size_t size, cursor = 0;
	char *text = read_file(path, &size);
	if (!text || !tape_read(&tape, text, size, fault)) {
		fprintf(stderr, "%s: %s\n", path, text ? fault : "can't be read");
		return false;
	}
	kiosk_init(kiosk, memory, tape.width_px, tape.height_px);
	kiosk->session.cloth.crew = threads_crew(&threads);
	const char *wrong = body_build_mannequin(&kiosk->session.body);
	MUST(!wrong);
	body_find_parts(&kiosk->session.body);
	if (tape.budget_units > 0)
		kiosk->session.budget_units = tape.budget_units;
	pen_mount(&kiosk->pen, &tape.mount);
	for (int d = 0; d < TAPE_DEVICES_MAX; d++)
		if (tape.device[d].used)
			tape_learn(&kiosk->pen, d, &tape.device[d]);
	for (int frame = 0; frame < tape.frame_count; frame++) {
		struct frame_reports reports;
		unsigned unplugged = tape_frame(&tape, frame, &cursor, &reports);
		kiosk_frame(kiosk, &reports, unplugged);
	}
	printf("%016" PRIx64 " %s\n", session_hash(&kiosk->session), path);
	tape_free(&tape);
	free(text);
	return true;
}

int main(int argc, char **argv)
{
	struct kiosk *kiosk = malloc(sizeof *kiosk);
	void *memory = malloc(KIOSK_MEMORY_BYTES);
	MUST(kiosk && memory);
	char fault[FAULT_BYTES] = "usage: replay_hash THREADS TAPE...";
	int count = argc > 2 ? atoi(argv[1]) : 0;
	if (count < 1 || count > THREADS_MAX || !threads_start(&threads, count, NULL, fault)) {
		fprintf(stderr, "%s\n", fault);
		return EXIT_FAILURE;
	}
	bool fine = true;
	for (int i = 2; i < argc; i++)
		fine &= play(kiosk, memory, argv[i]);
	threads_stop(&threads);
	free(memory);
	free(kiosk);
	return fine ? EXIT_SUCCESS : EXIT_FAILURE;
}
