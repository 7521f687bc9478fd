/* A thousand times plugged in, set up, used and pulled out in mid-stroke, a tablet of each kind:
 * every stroke ends, and what the program holds of the system, descriptors and memory, is what it
 * held before. A SEQPACKET socket stands for a hidraw node, a table of answers for the USB's
 * control endpoint; threads, queue and state are the real ones. */
#include "live.h"
#include "table.h"
#include "tape_learn.h"
#include "test.h"

#include <dirent.h>
#include <malloc.h>
#include <stdatomic.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

enum {
	CYCLES = 1000,
	WARM = 20,
	PATIENCE = 100000,
	SAMPLES = 40,
	SLACK_BYTES = 4096, /* the libraries' own; the least leak is 32 bytes a cycle */
};

static struct frame_reports reports;
static struct pen pen;

/* ---- what the program holds ---- */

struct held {
	int fds;
	size_t bytes;
};

static int fds_count(void)
{
	int count = 0;
	DIR *list = opendir("/proc/self/fd");
	while (list && readdir(list))
		count++;
	if (list)
		closedir(list);
	return count;
}

/* The least of several looks: the searching thread has something in its hands now and then. */
static struct held held_now(void)
{
	struct held held = {fds_count(), mallinfo2().uordblks};
	for (int i = 0; i < SAMPLES; i++) {
		nanosleep(&(struct timespec){0, 3000000}, NULL);
		int fds = fds_count();
		size_t bytes = mallinfo2().uordblks;
		held.fds = fds < held.fds ? fds : held.fds;
		held.bytes = bytes < held.bytes ? bytes : held.bytes;
	}
	return held;
}

/* ---- two tablets ---- */

/* A UC-Logic 2 tablet's strings. */
static int endpoint_string(void *context, int index, uint8_t *bytes, int capacity)
{
	static const uint8_t block[18] = {18, 3,    0x70, 0xc6, 0,    6, 0x7c,
					  0,  0xff, 0x1f, 0xd8, 0x13, 3};
	atomic_int *asked = context;
	atomic_fetch_add(asked, 1);
	if (index != 200)
		return -PEN_SETUP_REFUSED;
	CHECK(capacity >= 18);
	memcpy(bytes, block, sizeof block);
	return sizeof block;
}

static atomic_int asked;
static const struct pen_transport transport = {.context = &asked, .string_get = endpoint_string};

struct kind {
	const char *name, *descriptor, *hover, *touch;
	bool sets_up;
};

static const struct kind kinds[] = {
	{"generic",
	 "050d 0902 a101 850a 0920 a100 0942 0944 0945 1500 2501 7501 9503 8102 9503 8103 0932"
	 "9501 8102 9501 8103 0501 0930 0931 7510 9502 26ff7f 8102 050d 0930 26ff1f 9501 8102 c0c0",
	 "0a 40 0010 0010 0000", "0a 41 0010 0010 ff0f", false},
	{"vendor", "0600ff 0901 a101 8508 0901 150026ff00 7508 950b 8102 c0",
	 "08 80 7046 063c 0000 00 00 00 00", "08 81 7046 063c ff0f 00 00 00 00", true},
};

static void put(int fd, const char *hex)
{
	uint8_t bytes[64];
	int size = table_hex(hex, bytes, sizeof bytes);
	CHECK(write(fd, bytes, (size_t)size) == size);
}

/* ---- one life ---- */

struct times {
	double longest_ms, sum_ms;
};

static void times_add(struct times *times, int64_t begin_us)
{
	double ms = 1e-3 * (double)(live_clock_us() - begin_us);
	times->longest_ms = ms > times->longest_ms ? ms : times->longest_ms;
	times->sum_ms += ms;
}

/* Collects until something came, or patience ends. */
static struct live_changes collect(struct live *live)
{
	struct live_changes changes = {0};
	reports.count = 0;
	for (int i = 0; i < PATIENCE && !reports.count && !changes.plugged && !changes.unplugged;
	     i++) {
		changes = live_collect(live, &reports);
		if (!reports.count && !changes.plugged && !changes.unplugged)
			nanosleep(&(struct timespec){0, 100000}, NULL);
	}
	return changes;
}

/* Three reports of a stroke, through the pen; the last state that the frame loop hears. */
static enum pen_state stroke(struct live *live, const struct kind *kind, int device, int fd)
{
	struct frame_input input = {0};
	put(fd, kind->hover);
	for (int i = 0; i < 16; i++)
		put(fd, kind->touch);
	for (int got = 0; got < 17; got += reports.count) {
		collect(live);
		for (int i = 0; i < reports.count; i++)
			reports.report[i].time_us = (got + i) * INT64_C(2000);
		if (!reports.count)
			break;
		pen_read(&pen, &reports, reports.report[reports.count - 1].time_us, &input);
	}
	return pen.device[device].state;
}

static void life(struct live *live, const struct kind *kind, struct times *up, struct times *down)
{
	struct tape_device told = {.used = true, .name = "a tablet", .bus = 3, .vendor = 0x256c};
	struct frame_input input = {0};
	int fds[2];
	told.descriptor_size = table_hex(kind->descriptor, told.descriptor, sizeof told.descriptor);
	CHECK(socketpair(AF_UNIX, SOCK_SEQPACKET, 0, fds) == 0);
	int64_t begin_us = live_clock_us();
	int device = kind->sets_up
			     ? live_attach_setup(live, fds[0], kind->name, 7, &told, &transport)
			     : live_attach(live, fds[0], kind->name, &told);
	CHECK(device >= 0 && collect(live).plugged == 1u << device);
	times_add(up, begin_us);
	live_device(live, device, &told);
	CHECK(kind->sets_up == (told.speaks.family == PEN_UCLOGIC_2));
	tape_learn(&pen, device, &told);
	CHECK(stroke(live, kind, device, fds[1]) == PEN_TOUCH);
	CHECK(pen.touching == device);
	begin_us = live_clock_us();
	close(fds[1]);
	CHECK(collect(live).unplugged == 1u << device);
	times_add(down, begin_us);
	pen_unplugged(&pen, device, &input);
	CHECK(input.sample_count > 0 && input.sample[input.sample_count - 1].state == PEN_AWAY &&
	      pen.touching == -1);
	close(fds[0]);
}

int main(void)
{
	mallopt(M_ARENA_MAX, 1); /* mallinfo2 sees one arena only */
	struct board nothing = board_default;
	nothing.tablet_vendor = 0xffff; /* leave this machine's own tablets alone */
	struct times up[2] = {0}, down[2] = {0}, first[2] = {0};
	struct held before = {0}, after;
	pen_init(&pen, 1280, 720);
	struct live *live = live_open(&nothing, 0);
	MUST(live);
	for (int i = -WARM; i < CYCLES; i++) {
		if (i == 0)
			before = held_now();
		for (int k = 0; k < 2; k++)
			life(live, &kinds[k], i < 0 ? &first[k] : &up[k],
			     i < 0 ? &first[k] : &down[k]);
	}
	after = held_now();
	printf("%d cycles: %d descriptors before and %d after, %zu bytes and %zu\n", CYCLES,
	       before.fds, after.fds, before.bytes, after.bytes);
	CHECK(after.fds == before.fds && after.bytes < before.bytes + SLACK_BYTES);
	for (int k = 0; k < 2; k++)
		printf("%s: ms until usable %.2f, at most %.2f; from the hang-up to the frame loop "
		       "%.2f, at most %.2f\n",
		       kinds[k].name, up[k].sum_ms / CYCLES, up[k].longest_ms,
		       down[k].sum_ms / CYCLES, down[k].longest_ms);
	CHECK(atomic_load(&asked) >= CYCLES);
	live_close(live);
	return test_end();
}
