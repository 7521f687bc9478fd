/* The reading thread: a SEQPACKET socket stands for a hidraw node, for it keeps reports apart. */
#include "live.h"
#include "test.h"

#include <fcntl.h>
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
	CHECK(fds_open() == before);
	return test_end();
}
