/* After start our code allocates nothing and touches no new page: the bundled tape through
 * kiosk_frame and draw_frame with every call of ours to the heap counted, then its beginning once
 * more with the page faults counted. The linker sends those calls here (Makefile, --wrap);
 * Mesa, cairo and Pango keep their own. */
#include "kiosk.h"
#include "leaks.h"
#include "snapshot.h"
#include "tape.h"
#include "resident.h"
#include "test.h"

#include <sys/resource.h>

enum {
	PICTURE_EVERY = 60,  /* frames */
	AGAIN_FRAMES = 1600, /* drawn, wrapped, pulled at */
	FAULTS_MAX = 16,     /* code that the system took away for others comes back so */
	SKIPPED = 77,
};

static const char tape_path[] = "tests/tapes/tshirt.hid";
/* Ours to the heap. Volatile, because a compiler knows that malloc changes no variable. */
static volatile long calls;

/* ---- where the linker sends them ---- */

#define COUNTED(result, name, parameters, arguments)                                               \
	result __real_##name parameters;                                                           \
	result __wrap_##name parameters;                                                           \
	result __wrap_##name parameters                                                            \
	{                                                                                          \
		calls++;                                                                           \
		return __real_##name arguments;                                                    \
	}

COUNTED(void *, malloc, (size_t size), (size))
COUNTED(void *, calloc, (size_t count, size_t size), (count, size))
COUNTED(void *, realloc, (void *old, size_t size), (old, size))
COUNTED(void *, aligned_alloc, (size_t alignment, size_t size), (alignment, size))
COUNTED(int, posix_memalign, (void **out, size_t alignment, size_t size), (out, alignment, size))
COUNTED(char *, strdup, (const char *text), (text))
COUNTED(char *, strndup, (const char *text, size_t size), (text, size))

static bool calls_are_counted(void)
{
	long before = calls;
	void *volatile block = malloc(1);
	free(block);
	return calls == before + 1;
}

/* ---- the visit ---- */

struct visit {
	struct kiosk kiosk;
	struct tape tape;
	struct snapshot snapshot;
	struct frame_reports reports;
	char fault[FAULT_BYTES];
	bool pictures;
};

static struct visit visit;

static bool begin(void *memory)
{
	struct kiosk *kiosk = &visit.kiosk;
	kiosk_init(kiosk, memory, visit.tape.width_px, visit.tape.height_px);
	if (body_build_mannequin(&kiosk->session.body))
		return false;
	body_find_parts(&kiosk->session.body);
	kiosk->session.budget_units = visit.tape.budget_units;
	for (int d = 0; d < TAPE_DEVICES_MAX; d++)
		if (visit.tape.device[d].used)
			pen_describe(&kiosk->pen, d, visit.tape.device[d].descriptor,
				     visit.tape.device[d].descriptor_size);
	return true;
}

static bool start(void *memory)
{
	char wrong[200];
	size_t size;
	char *text = store_read(tape_path, &size, visit.fault);
	bool read = text && tape_read(&visit.tape, text, size, wrong);
	free(text);
	if (!read || !begin(memory))
		return false;
	visit.pictures = snapshot_open(&visit.snapshot, visit.tape.width_px, visit.tape.height_px,
				       visit.fault);
	return true;
}

/* The calls of one frame, or of one picture, must be none. */
static void expect_none(const char *what, int frame, long before)
{
	long made = calls - before;
	if (made > 0)
		fprintf(stderr, "%s of frame %d allocates %ld times\n", what, frame, made);
	CHECK(made == 0);
}

static void picture(int frame)
{
	long before = calls;
	draw_frame(visit.snapshot.draw, &visit.kiosk.ui, &visit.kiosk.session);
	expect_none("draw_frame", frame, before);
	before = calls;
	display_present(visit.snapshot.display);
	expect_none("display_present", frame, before);
}

static void play(void)
{
	size_t cursor = 0;
	for (int frame = 0; frame < visit.tape.frame_count; frame++) {
		unsigned unplugged = tape_frame(&visit.tape, frame, &cursor, &visit.reports);
		long before = calls;
		kiosk_frame(&visit.kiosk, &visit.reports, unplugged);
		expect_none("kiosk_frame", frame, before);
		if (visit.pictures && frame % PICTURE_EVERY == 0)
			picture(frame);
	}
}

static long faults(void)
{
	struct rusage usage;
	getrusage(RUSAGE_SELF, &usage);
	return usage.ru_minflt + usage.ru_majflt;
}

/* What the first visit has touched is all there is. */
static void play_again(void *memory)
{
	size_t cursor = 0;
	long made = 0;
	CHECK(begin(memory));
	for (int frame = 0; frame < int_min(AGAIN_FRAMES, visit.tape.frame_count); frame++) {
		unsigned unplugged = tape_frame(&visit.tape, frame, &cursor, &visit.reports);
		long before = faults();
		kiosk_frame(&visit.kiosk, &visit.reports, unplugged);
		made += faults() - before;
	}
	if (made > FAULTS_MAX)
		fprintf(stderr, "a visit like the last touches %ld new pages\n", made);
	CHECK(made <= FAULTS_MAX);
	CHECK(visit.kiosk.session.cloth.worn);
}

int main(void)
{
	if (!calls_are_counted()) {
		printf("skip: this linker or sanitizer keeps malloc's calls to itself\n");
		return SKIPPED;
	}
	resident_begin();
	void *memory = malloc(KIOSK_MEMORY_BYTES);
	CHECK(memory && start(memory));
	if (test_failures == 0) {
		play();
		CHECK(visit.kiosk.session.cloth.worn);
		play_again(memory);
	}
	if (!visit.pictures)
		printf("without pictures: %s\n", visit.fault);
	snapshot_close(&visit.snapshot);
	tape_free(&visit.tape);
	free(memory);
	return test_end();
}
