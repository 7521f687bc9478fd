/* Plays a tape into the kernel: tablets through /dev/uhid, buttons through gpio-sim.
 *
 *   play TAPE [CHIP] [--speed N]
 *
 * A device comes with its first report, and waits until a program reads it; after that reports
 * come at the tape's pace, N times as fast. "# unplug" on the tape pulls the device out. How long
 * it takes until a device is read, and until its reader has let go of it, is printed. CHIP is the
 * gpio-sim chip's folder, in which line N is button N, low when pressed. */
#include "play.h"

#include "pen.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <linux/uhid.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

enum {
	READER_MS = 10000, /* somebody must read by then */
	SETTLED_MS =
		500, /* whoever only looks at a device, udev too, has closed it again by then */
};

struct player {
	struct tape tape;
	int fd[TAPE_DEVICES_MAX]; /* on /dev/uhid; -1: unplugged */
	char node[TAPE_DEVICES_MAX][64];
	char reader[32]; /* the process that reads them */
	const char *chip;
	uint8_t held;
	double speed;
	int64_t start_us; /* of the tape's time 0, on CLOCK_MONOTONIC */
};

/* --- a tablet --------------------------------------------------------------------------------- */

static void event_write(int fd, const struct uhid_event *event)
{
	if (write(fd, event, sizeof *event) != sizeof *event)
		play_fail("/dev/uhid");
}

/* Takes what the kernel tells a device; it asks for nothing that has to be answered. */
static void events_read(struct player *player, int device)
{
	struct uhid_event event;
	while (read(player->fd[device], &event, sizeof event) > 0) {
		if (event.type == UHID_GET_REPORT) {
			struct uhid_event answer = {.type = UHID_GET_REPORT_REPLY};
			answer.u.get_report_reply.id = event.u.get_report.id;
			answer.u.get_report_reply.err = EIO;
			event_write(player->fd[device], &answer);
		}
		if (event.type == UHID_SET_REPORT) {
			struct uhid_event answer = {.type = UHID_SET_REPORT_REPLY};
			answer.u.set_report_reply.id = event.u.set_report.id;
			event_write(player->fd[device], &answer);
		}
	}
}

/* The first line of a file that begins so. */
static bool line_read(const char *path, const char *begin, char *line, int size)
{
	FILE *file = fopen(path, "r");
	bool found = false;
	while (file && !found && fgets(line, size, file))
		found = !strncmp(line, begin, strlen(begin));
	if (file)
		fclose(file);
	line[found ? strcspn(line, "\n") : 0] = 0;
	return found;
}

/* Our device's node in /dev; false while there is none. */
static bool node_find(int device, char node[64])
{
	char path[320], line[256], phys[64];
	bool found = false;
	DIR *list = opendir("/sys/class/hidraw");
	snprintf(phys, sizeof phys, "HID_PHYS=kitsuke/input%d", device);
	for (struct dirent *entry; list && !found && (entry = readdir(list));) {
		snprintf(path, sizeof path, "/sys/class/hidraw/%s/device/uevent", entry->d_name);
		found = line_read(path, "HID_PHYS=", line, sizeof line) && !strcmp(line, phys);
		snprintf(node, 64, "/dev/%.40s", entry->d_name);
	}
	if (list)
		closedir(list);
	node[found ? strlen(node) : 0] = 0;
	return found;
}

/* A node that is gone is still one to who has it open: "/dev/hidraw0 (deleted)". */
static bool process_reads(const char *process, const char *node)
{
	char path[560], target[64];
	bool found = false;
	size_t length_of_node = strlen(node);
	snprintf(path, sizeof path, "/proc/%s/fd", process);
	DIR *list = opendir(path);
	for (struct dirent *entry; list && !found && (entry = readdir(list));) {
		snprintf(path, sizeof path, "/proc/%s/fd/%s", process, entry->d_name);
		ssize_t length = readlink(path, target, sizeof target - 1);
		target[length > 0 ? length : 0] = 0;
		found = !strncmp(target, node, length_of_node) &&
			(!target[length_of_node] || target[length_of_node] == ' ');
	}
	if (list)
		closedir(list);
	return found;
}

static bool is_read(const char *node, char reader[32])
{
	bool found = false;
	DIR *list = node[0] ? opendir("/proc") : NULL;
	for (struct dirent *entry; list && !found && (entry = readdir(list));) {
		found = entry->d_name[0] >= '1' && entry->d_name[0] <= '9' &&
			process_reads(entry->d_name, node);
		snprintf(reader, 32, "%.31s", entry->d_name);
	}
	if (list)
		closedir(list);
	return found;
}

/* Until it has been open for a while: a reader first looks what it is. */
static void reader_wait(struct player *player, int device)
{
	int64_t begin_us = play_clock_us(), since_us = begin_us;
	while (play_clock_us() - since_us < SETTLED_MS * 1000) {
		events_read(player, device);
		bool there = player->node[device][0] || node_find(device, player->node[device]);
		if (!there || !is_read(player->node[device], player->reader))
			since_us = play_clock_us();
		if (play_clock_us() - begin_us > READER_MS * 1000)
			play_complain("nobody reads device %d", device);
		play_sleep_until(play_clock_us() + 20000);
	}
	printf("device %d: read after %.1f ms\n", device, 1e-3 * (double)(since_us - begin_us));
}

static void tablet_plug(struct player *player, int device)
{
	const struct tape_device *told = &player->tape.device[device];
	struct uhid_event event = {.type = UHID_CREATE2};
	struct uhid_create2_req *create = &event.u.create2;
	snprintf((char *)create->name, sizeof create->name, "%s", told->name);
	snprintf((char *)create->phys, sizeof create->phys, "kitsuke/input%d", device);
	create->rd_size = (uint16_t)told->descriptor_size;
	create->bus = (uint16_t)told->bus;
	create->vendor = (uint32_t)told->vendor;
	create->product = (uint32_t)told->product;
	memcpy(create->rd_data, told->descriptor, (size_t)told->descriptor_size);
	player->fd[device] = open("/dev/uhid", O_RDWR | O_NONBLOCK | O_CLOEXEC);
	if (player->fd[device] < 0)
		play_fail("/dev/uhid");
	player->node[device][0] = 0;
	event_write(player->fd[device], &event);
	int64_t begin_us = play_clock_us();
	reader_wait(player, device);
	player->start_us += play_clock_us() - begin_us;
}

static void tablet_unplug(struct player *player, int device)
{
	struct uhid_event event = {.type = UHID_DESTROY};
	int64_t begin_us = play_clock_us();
	event_write(player->fd[device], &event);
	close(player->fd[device]);
	player->fd[device] = -1;
	while (process_reads(player->reader, player->node[device]) &&
	       play_clock_us() - begin_us < READER_MS * 1000)
		play_sleep_until(play_clock_us() + 500);
	printf("device %d: let go after %.1f ms\n", device,
	       1e-3 * (double)(play_clock_us() - begin_us));
	player->start_us += play_clock_us() - begin_us;
}

static void tablet_send(struct player *player, int device, const uint8_t *bytes, int size)
{
	struct uhid_event event = {.type = UHID_INPUT2};
	if (player->fd[device] < 0)
		tablet_plug(player, device);
	event.u.input2.size = (uint16_t)size;
	memcpy(event.u.input2.data, bytes, (size_t)size);
	event_write(player->fd[device], &event);
	events_read(player, device);
}

/* --- buttons ---------------------------------------------------------------------------------- */

static void button_pull(const struct player *player, int button, bool pressed)
{
	char path[256];
	snprintf(path, sizeof path, "%s/sim_gpio%d/pull", player->chip, button);
	const char *pull = pressed ? "pull-down" : "pull-up";
	int fd = open(path, O_WRONLY | O_CLOEXEC);
	if (fd < 0 || write(fd, pull, strlen(pull)) < 0)
		play_fail(path);
	close(fd);
}

static void buttons_send(struct player *player, uint8_t held)
{
	for (int button = 0; button < BUTTON_COUNT; button++)
		if ((held ^ player->held) >> button & 1)
			button_pull(player, button, held >> button & 1);
	player->held = held;
}

static bool is_buttons(const struct tape_device *told)
{
	return told->descriptor_size == buttons_descriptor_size &&
	       !memcmp(told->descriptor, buttons_descriptor, (size_t)buttons_descriptor_size);
}

/* --- the tape --------------------------------------------------------------------------------- */

static void event_play(struct player *player, const struct tape_event *event)
{
	const uint8_t *bytes = player->tape.bytes + event->offset;
	if (event->size == 0 && player->fd[event->device] >= 0)
		tablet_unplug(player, event->device);
	else if (event->size && !is_buttons(&player->tape.device[event->device]))
		tablet_send(player, event->device, bytes, event->size);
	else if (event->size && player->chip)
		buttons_send(player, bytes[0]);
}

int main(int argc, char **argv)
{
	static struct player player;
	player.speed = 1.0;
	if (argc < 2)
		play_complain("usage: play TAPE [CHIP] [--speed N]");
	for (int i = 2; i < argc; i++)
		if (!strcmp(argv[i], "--speed") && i + 1 < argc)
			player.speed = atof(argv[++i]);
		else
			player.chip = argv[i];
	play_tape_load(&player.tape, argv[1]);
	for (int i = 0; i < TAPE_DEVICES_MAX; i++)
		player.fd[i] = -1;
	player.start_us = play_clock_us();
	if (player.tape.event_count)
		player.start_us -= (int64_t)((double)player.tape.event[0].time_us / player.speed);
	for (size_t i = 0; i < player.tape.event_count; i++) {
		const struct tape_event *event = &player.tape.event[i];
		play_sleep_until(player.start_us +
				 (int64_t)((double)event->time_us / player.speed));
		event_play(&player, event);
	}
	play_sleep_until(play_clock_us() + 300000);
	tape_free(&player.tape);
	return 0;
}
