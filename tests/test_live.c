/* The reading thread: a SEQPACKET socket stands for a hidraw node, for it keeps reports apart. */
#include "live_private.h"
#include "table.h"
#include "test.h"

#include <fcntl.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

static struct frame_reports reports;

static struct tape_device mouse(void)
{
	struct tape_device told = {
		.used = true, .name = "a pen", .descriptor_size = mouse_descriptor_size};
	memcpy(told.descriptor, mouse_descriptor, (size_t)mouse_descriptor_size);
	return told;
}

/* Collects until something came, at most two seconds. */
static struct live_changes collect(struct live *live)
{
	struct live_changes changes = {0};
	reports.count = 0;
	for (int i = 0; i < 400 && !reports.count && !changes.plugged && !changes.unplugged; i++) {
		nanosleep(&(struct timespec){0, 5000000}, NULL);
		changes = live_collect(live, &reports);
	}
	return changes;
}

static void put(int fd, uint8_t first, int size)
{
	uint8_t bytes[64] = {first};
	CHECK(write(fd, bytes, (size_t)size) == size);
}

static void check_one_life(struct live *live)
{
	int fds[2];
	struct tape_device told = mouse(), back;
	CHECK(socketpair(AF_UNIX, SOCK_SEQPACKET, 0, fds) == 0);
	CHECK(live_attach(live, fds[0], "port 1", &told) == 0);
	struct live_changes changes = collect(live);
	CHECK(changes.plugged == 1 && changes.unplugged == 0);
	live_device(live, 0, &back);
	CHECK(!strcmp(back.name, "a pen") && back.descriptor_size == mouse_descriptor_size);

	put(fds[1], 0x04, 7);
	changes = collect(live);
	CHECK(reports.count == 1 && reports.report[0].bytes[0] == 4 && reports.report[0].size == 7);
	int64_t age_us = live_clock_us() - reports.report[0].time_us;
	CHECK(age_us >= 0 && age_us < 3000000);

	put(fds[1], 0x05, 3); /* too short for a pen's report: dropped */
	put(fds[1], 0x06, 7);
	collect(live);
	CHECK(reports.count == 1 && reports.report[0].bytes[0] == 6);

	close(fds[1]);
	changes = collect(live);
	CHECK(changes.unplugged == 1);
	close(fds[0]);
}

/* --- tablets that must be set up ---------------------------------------------------------------
 */

/* A UC-Logic 2 tablet's control endpoint, as it answers and as it does not. */
struct endpoint {
	atomic_int asked, slow_ms;
	atomic_bool refuses;
};

static int endpoint_string(void *context, int index, uint8_t *bytes, int capacity)
{
	static const uint8_t block[18] = {18, 3,    0x70, 0xc6, 0,    6, 0x7c,
					  0,  0xff, 0x1f, 0xd8, 0x13, 3};
	struct endpoint *endpoint = context;
	atomic_fetch_add(&endpoint->asked, 1);
	int slow_ms = atomic_load(&endpoint->slow_ms);
	nanosleep(&(struct timespec){slow_ms / 1000, slow_ms % 1000 * 1000000}, NULL);
	if (atomic_load(&endpoint->refuses) || index != 200)
		return -PEN_SETUP_REFUSED;
	CHECK(capacity >= 18);
	memcpy(bytes, block, sizeof block);
	return sizeof block;
}

static struct tape_device of_hex(const char *hex)
{
	struct tape_device told = {.used = true, .name = "a tablet", .bus = 3, .vendor = 0x256c};
	told.descriptor_size = table_hex(hex, told.descriptor, sizeof told.descriptor);
	return told;
}

static const char vendor_hex[] = "0600ff 0901 a101 8508 0901 150026ff00 7508 950b 8102 c0";
static const char default_hex[] =
	"050d 0902 a101 850a 0920 a100 0942 0944 0945 1500 2501 7501 9503 8102 9503 8103 0932"
	"9501 8102 9501 8103 0501 0930 0931 7510 9502 26ff7f 8102 050d 0930 26ff1f 9501 8102 c0c0";

static void bytes_put(int fd, const char *hex)
{
	uint8_t bytes[64];
	int size = table_hex(hex, bytes, sizeof bytes);
	CHECK(write(fd, bytes, (size_t)size) == size);
}

static bool asked_more(struct endpoint *endpoint, int than)
{
	for (int i = 0; i < 400 && atomic_load(&endpoint->asked) <= than; i++)
		nanosleep(&(struct timespec){0, 5000000}, NULL);
	return atomic_load(&endpoint->asked) > than;
}

static void pair_open(int fds[2])
{
	CHECK(socketpair(AF_UNIX, SOCK_SEQPACKET, 0, fds) == 0);
}

static void check_set_up(struct live *live)
{
	static struct endpoint endpoint;
	static const struct pen_transport transport = {.context = &endpoint,
						       .string_get = endpoint_string};
	struct tape_device told = of_hex(vendor_hex), other = of_hex(default_hex), back;
	int vendor[2], pen[2];
	pair_open(vendor);
	pair_open(pen);
	CHECK(live_attach_setup(live, pen[0], "port 5 pen", 7, &other, &transport) == 0);
	CHECK(collect(live).plugged == 1); /* its descriptor tells all: at once */
	CHECK(live_attach_setup(live, vendor[0], "port 5 vendor", 7, &told, &transport) == 1);
	CHECK(collect(live).plugged == 2);
	live_device(live, 1, &back);
	CHECK(back.speaks.family == PEN_UCLOGIC_2 && back.speaks.y_maximum == 31750);
	CHECK_NEAR(back.width_mm, 254.0, 0.01);
	CHECK(atomic_load(&endpoint.asked) == 3);

	bytes_put(vendor[1], "08 81 70c6 067c ff1f 00 00 00 00");
	bytes_put(vendor[1], "08 e0 0101 0100 0000 00 00 00 00"); /* buttons are no pen */
	collect(live);
	CHECK(reports.count == 1 && reports.report[0].device == 1);

	/* back in its default mode: the other interface speaks, and it is set up again */
	nanosleep(&(struct timespec){0, 150000000}, NULL);
	bytes_put(pen[1], "0a c0 0010 0010 0000 ");
	collect(live);
	CHECK(reports.count == 1 && reports.report[0].device == 0);
	CHECK(asked_more(&endpoint, 3));
	nanosleep(&(struct timespec){0, 50000000}, NULL);
	reports.count = 0;
	struct live_changes none = live_collect(live, &reports);
	CHECK(!none.plugged && !none.unplugged); /* the same as before: nothing to learn */

	/* a second relapse within the second is not yet answered */
	int asked = atomic_load(&endpoint.asked);
	bytes_put(pen[1], "0a c0 0010 0010 0000 ");
	collect(live);
	nanosleep(&(struct timespec){0, 100000000}, NULL);
	CHECK(atomic_load(&endpoint.asked) == asked);
	close(vendor[1]);
	CHECK(collect(live).unplugged == 2);
	close(pen[1]);
	CHECK(collect(live).unplugged == 1);
	close(vendor[0]);
	close(pen[0]);
}

/* A tablet that takes its time, and goes away meanwhile, keeps nobody waiting. */
static void check_slow(struct live *live)
{
	static struct endpoint endpoint;
	static const struct pen_transport transport = {.context = &endpoint,
						       .string_get = endpoint_string};
	struct tape_device slow = of_hex(vendor_hex), quick = mouse();
	int vendor[2], pen[2];
	atomic_store(&endpoint.slow_ms, 400);
	pair_open(vendor);
	pair_open(pen);
	int slow_one = live_attach_setup(live, vendor[0], "port 6", 8, &slow, &transport);
	CHECK(asked_more(&endpoint, 0));
	int64_t before_us = live_clock_us();
	int quick_one = live_attach(live, pen[0], "port 7", &quick);
	CHECK(collect(live).plugged == 1u << quick_one);
	put(pen[1], 0x04, 7);
	collect(live);
	CHECK(reports.count == 1 && reports.report[0].device == quick_one);
	CHECK(live_clock_us() - before_us < 390000 || atomic_load(&endpoint.asked) == 1);
	close(vendor[1]); /* gone before it was ever plugged in: no word about it */
	nanosleep(&(struct timespec){0, 600000000}, NULL);
	reports.count = 0;
	struct live_changes changes = live_collect(live, &reports);
	CHECK(!(changes.plugged >> slow_one & 1) && !(changes.unplugged >> slow_one & 1));
	close(pen[1]);
	CHECK(collect(live).unplugged == 1u << quick_one);
	close(vendor[0]);
	close(pen[0]);
}

/* What cannot be set up is read by its descriptor, and tried again a second later. */
static void check_refused(struct live *live)
{
	static const char both_hex[] =
		"050d 0902 a101 8507 0920 a100 0942 0944 0945 1500 2501 7501 9503 8102 9503 8103"
		"0932 9501 8102 9501 8103 0501 0930 0931 7510 9502 26007d 8102 050d 0930 26ff07"
		"9501 8102 c0c0 0501 0902 a101 8509 0901 a100 0509 1901 2903 1500 2501 7501 9503"
		"8102 9505 8103 0501 0930 0931 7510 9502 26ff7f 8102 050d 0930 26ff07 9501 8102 "
		"c0c0";
	static struct endpoint endpoint;
	static const struct pen_transport transport = {.context = &endpoint,
						       .string_get = endpoint_string};
	struct tape_device told = of_hex(both_hex), back;
	int pen[2];
	atomic_store(&endpoint.refuses, true);
	pair_open(pen);
	int device = live_attach_setup(live, pen[0], "port 8", 9, &told, &transport);
	CHECK(collect(live).plugged == 1u << device);
	live_device(live, device, &back);
	CHECK(back.speaks.family == PEN_BY_DESCRIPTOR);
	bytes_put(pen[1], "09 01 0010 0010 ff07");
	collect(live);
	CHECK(reports.count == 1 && reports.report[0].bytes[0] == 9);
	atomic_store(&endpoint.refuses, false);
	struct live_changes changes = collect(live); /* out, and in again as what it is now */
	CHECK(changes.unplugged == 1u << device);
	changes = changes.plugged ? changes : collect(live);
	CHECK(changes.plugged == 1u << device);
	live_device(live, device, &back);
	CHECK(back.speaks.family == PEN_UCLOGIC_1 && back.speaks.x_maximum == 50800);
	close(pen[1]);
	CHECK(collect(live).unplugged == 1u << device);
	close(pen[0]);
}

/* A place gets its number back, another one gets another. */
static void check_numbers(struct live *live)
{
	int first[2], second[2];
	struct tape_device told = mouse();
	CHECK(socketpair(AF_UNIX, SOCK_SEQPACKET, 0, first) == 0);
	CHECK(socketpair(AF_UNIX, SOCK_SEQPACKET, 0, second) == 0);
	CHECK(live_attach(live, second[0], "port 2", &told) == 1);
	CHECK(live_attach(live, first[0], "port 1", &told) == 0);
	unsigned plugged = collect(live).plugged;
	plugged |= plugged == 3 ? 0 : collect(live).plugged;
	CHECK(plugged == 3);
	close(first[1]);
	close(second[1]);
	unsigned unplugged = collect(live).unplugged;
	unplugged |= unplugged == 3 ? 0 : collect(live).unplugged;
	CHECK(unplugged == 3);
	close(first[0]);
	close(second[0]);
}

/* A frame takes each device through plugged, reports, unplugged once; the rest waits. */
static void check_order(struct live *live)
{
	struct tape_device told = mouse();
	uint8_t byte = 1;
	live_plug(live, LIVE_BUTTONS, &told);
	live_push(live, LIVE_BUTTONS, 10, 1, &byte);
	live_unplug(live, LIVE_BUTTONS);
	live_plug(live, LIVE_BUTTONS, &told);
	live_push(live, LIVE_BUTTONS, 20, 1, &byte);
	struct live_changes changes = collect(live);
	CHECK(changes.plugged == 1 << LIVE_BUTTONS && changes.unplugged == 1 << LIVE_BUTTONS);
	CHECK(reports.count == 1 && reports.report[0].time_us == 10);
	changes = collect(live);
	CHECK(changes.plugged == 1 << LIVE_BUTTONS && changes.unplugged == 0);
	CHECK(reports.count == 1 && reports.report[0].time_us == 20);
}

/* A render loop that stalls loses nothing for two seconds, and then the newest. */
static void check_flood(struct live *live)
{
	long lost = live_lost(live);
	for (int i = 0; i < 3000; i++) {
		uint8_t byte = (uint8_t)(i & 7);
		live_push(live, LIVE_BUTTONS, i, 1, &byte);
	}
	int taken = 0;
	for (;;) {
		reports.count = 0;
		live_collect(live, &reports);
		for (int i = 0; i < reports.count; i++)
			CHECK(reports.report[i].time_us == taken + i);
		taken += reports.count;
		CHECK(reports.count <= FRAME_REPORTS_MAX);
		if (!reports.count)
			break;
	}
	CHECK(taken >= 1000 && live_lost(live) - lost == 3000 - taken);
}

/* Tablets without the threads that read and search: the test does what they do. */
static struct live *live_by_hand(void)
{
	struct live *live = calloc(1, sizeof *live);
	if (!live)
		return NULL;
	pthread_mutex_init(&live->lock, NULL);
	for (int i = 0; i < LIVE_TABLETS_MAX; i++)
		live->tablet[i].fd = -1;
	live->opened = eventfd(0, EFD_CLOEXEC);
	live->setup = live_setup_open(live_tablet_set_up, live);
	return live;
}

static void by_hand_free(struct live *live)
{
	live_setup_close(live->setup);
	close(live->opened);
	pthread_mutex_destroy(&live->lock);
	free(live);
}

/* The hang-up behind a full ring: the wake-up that finds it takes the ring's 63 reports and the end
 * of the stroke, and the next frame has all of it. No timer, no second wake-up, no frame between:
 * from the hang-up to the stroke's end there is nothing to wait for but the frame itself. */
static void check_hang_up(void)
{
	enum { RING = 63 };
	int fds[2];
	struct tape_device told = mouse();
	struct live *live = live_by_hand();
	CHECK(live != NULL);
	if (!live)
		return;
	pair_open(fds);
	CHECK(live_attach(live, fds[0], "port 9", &told) == 0);
	reports.count = 0;
	CHECK(live_collect(live, &reports).plugged == 1);
	for (int i = 0; i < RING; i++)
		put(fds[1], 0x05, 7);
	close(fds[1]);
	live_tablet_read(live, 0);
	CHECK(live->tablet[0].fd == -1);
	struct live_changes changes = live_collect(live, &reports);
	CHECK(changes.unplugged == 1 && reports.count == RING);
	CHECK(reports.report[RING - 1].bytes[0] == 0x05);

	static struct pen pen;
	static struct frame_input input;
	pen_init(&pen, 1920, 1080);
	tape_learn(&pen, 0, &told);
	for (int i = 0; i < RING; i++) {
		reports.report[i].time_us = 2000 * i; /* as a pen at 500 Hz sends them */
		reports.report[i].bytes[6] = 8;
	}
	pen_read(&pen, &reports, 2000 * RING, &input);
	CHECK(pen.touching == 0);
	pen_unplugged(&pen, 0, &input);
	CHECK(pen.touching == -1 && input.sample[input.sample_count - 1].state == PEN_AWAY);
	close(fds[0]);
	by_hand_free(live);
}

static int fds_open(void)
{
	int count = 0;
	for (int fd = 0; fd < 256; fd++)
		count += fcntl(fd, F_GETFD) >= 0;
	return count;
}

int main(void)
{
	char text[LIVE_TEXT_MAX];
	struct board nothing = board_default;
	nothing.tablet_vendor = 0xffff; /* leave this machine's own tablets alone */
	int before = fds_open();
	for (int i = 0; i < 3; i++) {
		struct live *live = live_open(&nothing, 0);
		CHECK(live != NULL);
		if (!live)
			return test_end();
		check_one_life(live);
		check_numbers(live);
		check_order(live);
		check_flood(live);
		live_text(live, text);
		CHECK(text[0] != 0);
		live_close(live);
	}
	static void (*const checks[])(struct live *) = {check_set_up, check_slow, check_refused};
	for (int i = 0; i < COUNT_OF(checks); i++) {
		struct live *live = live_open(&nothing, 0);
		CHECK(live != NULL);
		if (live)
			checks[i](live);
		live_close(live);
	}
	check_hang_up();
	CHECK(fds_open() == before);
	return test_end();
}
