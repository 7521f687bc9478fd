/* The threads that read tablets and search for them, and the queue between them and the frame loop;
 * see live.h.
 *
 * One thread polls all open tablets: hidraw keeps 64 reports (128 ms at 500 Hz) and drops the
 * newest when nobody reads, so reading waits for no frame and no search. Another searches: udev
 * tells of new nodes after its rules have set their permissions; where there is no udev, and for a
 * permission that is mended later, it looks again every second. */
#include "live_private.h"

#include <fcntl.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/eventfd.h>
#include <time.h>
#include <unistd.h>

enum { RESCAN_MS = 1000 };

int64_t live_clock_us(void)
{
	struct timespec now;
	clock_gettime(CLOCK_MONOTONIC, &now);
	return (int64_t)now.tv_sec * 1000000 + now.tv_nsec / 1000;
}

/* --- queue ------------------------------------------------------------------------------------ */

static void queue_add(struct live *live, int device, int64_t time_us, int size,
		      const uint8_t *bytes)
{
	int room = size > 0 ? QUEUE_MAX - QUEUE_RESERVE : QUEUE_MAX;
	if (live->count >= room) {
		live->lost++;
		return;
	}
	struct raw_report *report = &live->queue[(live->first + live->count++) % QUEUE_MAX];
	report->device = device;
	report->time_us = time_us;
	report->size = size;
	if (size > 0)
		memcpy(report->bytes, bytes, (size_t)size);
}

void live_push(struct live *live, int device, int64_t time_us, int size, const uint8_t *bytes)
{
	MUST(device >= 0 && device < PEN_DEVICES_MAX && size > 0 && size <= REPORT_BYTES_MAX);
	pthread_mutex_lock(&live->lock);
	queue_add(live, device, time_us, size, bytes);
	pthread_mutex_unlock(&live->lock);
}

void live_queue(struct live *live, int device, int size, const uint8_t *bytes)
{
	queue_add(live, device, live_clock_us() - live->start_us, size, bytes);
}

void live_plug(struct live *live, int device, const struct tape_device *told)
{
	MUST(device >= 0 && device < PEN_DEVICES_MAX);
	pthread_mutex_lock(&live->lock);
	live->told[device] = *told;
	live_queue(live, device, SIZE_PLUGGED, NULL);
	pthread_mutex_unlock(&live->lock);
}

void live_unplug(struct live *live, int device)
{
	pthread_mutex_lock(&live->lock);
	live_queue(live, device, SIZE_UNPLUGGED, NULL);
	pthread_mutex_unlock(&live->lock);
}

struct live_changes live_collect(struct live *live, struct frame_reports *reports)
{
	struct live_changes changes = {0};
	unsigned reported = 0;
	pthread_mutex_lock(&live->lock);
	for (; live->count; live->count--, live->first = (live->first + 1) % QUEUE_MAX) {
		const struct raw_report *next = &live->queue[live->first];
		unsigned bit = 1u << next->device;
		/* Plugged, reports, unplugged: a frame takes each device through that order once.
		 */
		if (changes.unplugged & bit || (next->size == SIZE_PLUGGED && reported & bit))
			break;
		if (next->size == SIZE_PLUGGED) {
			changes.plugged |= bit;
		} else if (next->size == SIZE_UNPLUGGED) {
			changes.unplugged |= bit;
		} else if (reports->count < FRAME_REPORTS_MAX) {
			reports->report[reports->count++] = *next;
			reported |= bit;
		} else {
			break;
		}
	}
	pthread_mutex_unlock(&live->lock);
	return changes;
}

void live_peek(struct live *live, struct frame_reports *reports)
{
	reports->count = 0;
	pthread_mutex_lock(&live->lock);
	for (int i = 0; i < live->count && reports->count < FRAME_REPORTS_MAX; i++) {
		const struct raw_report *next = &live->queue[(live->first + i) % QUEUE_MAX];
		if (next->size <= 0)
			break;
		reports->report[reports->count++] = *next;
	}
	pthread_mutex_unlock(&live->lock);
}

void live_device(struct live *live, int device, struct tape_device *told)
{
	MUST(device >= 0 && device < PEN_DEVICES_MAX);
	pthread_mutex_lock(&live->lock);
	*told = live->told[device];
	pthread_mutex_unlock(&live->lock);
}

void live_text(struct live *live, char text[LIVE_TEXT_MAX])
{
	pthread_mutex_lock(&live->lock);
	memcpy(text, live->text, LIVE_TEXT_MAX);
	pthread_mutex_unlock(&live->lock);
}

long live_lost(struct live *live)
{
	pthread_mutex_lock(&live->lock);
	long lost = live->lost;
	pthread_mutex_unlock(&live->lock);
	return lost;
}

/* --- the threads ------------------------------------------------------------------------------ */

/* Waits for the tablets, and for another one to be opened. False: to be stopped. */
static bool wait_and_read(struct live *live)
{
	struct pollfd fds[2 + LIVE_TABLETS_MAX];
	fds[0] = (struct pollfd){live->stop, POLLIN, 0};
	fds[1] = (struct pollfd){live->opened, POLLIN, 0};
	pthread_mutex_lock(&live->lock);
	for (int i = 0; i < LIVE_TABLETS_MAX; i++)
		fds[2 + i] = (struct pollfd){live->tablet[i].fd, POLLIN, 0};
	pthread_mutex_unlock(&live->lock);
	poll(fds, COUNT_OF(fds), -1);
	eventfd_t opened;
	if (fds[1].revents)
		eventfd_read(live->opened, &opened);
	for (int i = 0; i < LIVE_TABLETS_MAX; i++)
		if (fds[2 + i].revents)
			live_tablet_read(live, i);
	return !fds[0].revents;
}

static void *reader_main(void *argument)
{
	while (wait_and_read(argument))
		;
	return NULL;
}

/* Waits for udev, at most a second. False: to be stopped. */
static bool wait_for_nodes(struct live *live)
{
	struct pollfd fds[] = {
		{live->stop, POLLIN, 0},
		{live->monitor ? udev_monitor_get_fd(live->monitor) : -1, POLLIN, 0},
	};
	poll(fds, COUNT_OF(fds), RESCAN_MS);
	if (fds[1].revents)
		udev_device_unref(udev_monitor_receive_device(live->monitor));
	return !fds[0].revents;
}

static void *searcher_main(void *argument)
{
	do
		live_tablets_search(argument);
	while (wait_for_nodes(argument));
	return NULL;
}

static void monitor_open(struct live *live)
{
	live->udev = udev_new();
	live->monitor = live->udev ? udev_monitor_new_from_netlink(live->udev, "udev") : NULL;
	if (!live->monitor)
		return;
	udev_monitor_filter_add_match_subsystem_devtype(live->monitor, "hidraw", NULL);
	if (udev_monitor_enable_receiving(live->monitor) < 0) {
		udev_monitor_unref(live->monitor);
		live->monitor = NULL;
	}
}

static void live_free(struct live *live)
{
	live_setup_close(live->setup);
	for (int i = 0; i < LIVE_TABLETS_MAX; i++)
		if (live->tablet[i].fd >= 0 && live->tablet[i].own)
			close(live->tablet[i].fd);
	udev_monitor_unref(live->monitor);
	udev_unref(live->udev);
	if (live->stop >= 0)
		close(live->stop);
	if (live->opened >= 0)
		close(live->opened);
	pthread_mutex_destroy(&live->lock);
	free(live->nodes);
	free(live);
}

static void stop(struct live *live, int threads)
{
	eventfd_write(live->stop, 1);
	for (int i = 0; i < threads; i++)
		pthread_join(live->thread[i], NULL);
}

/* The reader and the searcher. False: the system has no threads left. */
static bool start(struct live *live)
{
	if (pthread_create(&live->thread[0], NULL, reader_main, live))
		return false;
	if (!pthread_create(&live->thread[1], NULL, searcher_main, live))
		return true;
	stop(live, 1);
	return false;
}

struct live *live_open(const struct board *board, int64_t start_us)
{
	struct live *live = calloc(1, sizeof *live);
	if (!live)
		return NULL;
	live->board = *board;
	live->start_us = start_us;
	live->stop = eventfd(0, EFD_CLOEXEC);
	live->opened = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
	pthread_mutex_init(&live->lock, NULL);
	for (int i = 0; i < LIVE_TABLETS_MAX; i++)
		live->tablet[i].fd = -1;
	snprintf(live->text, sizeof live->text, "looking for a tablet");
	live->nodes = calloc(LIVE_NODES_MAX, sizeof *live->nodes);
	live->setup = live_setup_open(live_tablet_set_up, live);
	monitor_open(live);
	if (!live->nodes || !live->setup || live->stop < 0 || live->opened < 0 || !start(live)) {
		live_free(live);
		return NULL;
	}
	return live;
}

void live_close(struct live *live)
{
	if (!live)
		return;
	stop(live, COUNT_OF(live->thread));
	live_free(live);
}
