/* See live_setup.h. Strings go through libusb, by control transfers to the device, for which no
 * interface is claimed and no kernel driver detached; reports go through the hidraw node. */
#include "live_setup.h"

#include <errno.h>
#include <fcntl.h>
#include <libusb.h>
#include <linux/hidraw.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/ioctl.h>
#include <time.h>
#include <unistd.h>

enum { TRANSFER_MS = 100, RETRIES_MAX = 4, RETRY_FIRST_MS = 1000, LANGUAGE_ENGLISH = 0x0409 };

struct job {
	bool used, due;
	unsigned number;
	int failures;
	int64_t due_us;
	const struct pen_transport *transport;
	struct live_node node;
};

struct live_setup {
	pthread_t thread;
	pthread_mutex_t lock; /* for all below */
	pthread_cond_t changed;
	bool stop;
	struct job job[LIVE_TABLETS_MAX];
	int running; /* the device whose job runs, -1 */
	unsigned running_job;

	live_setup_done *done; /* these are the thread's */
	void *context;
	struct live_node node;
	libusb_context *usb;
};

/* --- the bus ---------------------------------------------------------------------------------- */

struct bus {
	struct live_setup *setup;
	int hidraw, usb; /* file descriptors */
	libusb_device_handle *handle;
};

static int moved_errno(ssize_t moved)
{
	if (moved >= 0)
		return (int)moved;
	if (errno == ENODEV || errno == ESHUTDOWN)
		return -PEN_SETUP_GONE;
	return errno == ETIMEDOUT ? -PEN_SETUP_TIMEOUT : -PEN_SETUP_REFUSED;
}

static int bus_string(void *context, int index, uint8_t *bytes, int capacity)
{
	struct bus *bus = context;
	int moved = libusb_control_transfer(
		bus->handle, LIBUSB_ENDPOINT_IN, LIBUSB_REQUEST_GET_DESCRIPTOR,
		(uint16_t)(LIBUSB_DT_STRING << 8 | index), LANGUAGE_ENGLISH, bytes,
		(uint16_t)capacity, TRANSFER_MS);
	if (moved == LIBUSB_ERROR_TIMEOUT)
		return -PEN_SETUP_TIMEOUT;
	if (moved == LIBUSB_ERROR_NO_DEVICE)
		return -PEN_SETUP_GONE;
	return moved < 0 ? -PEN_SETUP_REFUSED : moved;
}

static int bus_output(void *context, const uint8_t *bytes, int size)
{
	struct bus *bus = context;
	return moved_errno(write(bus->hidraw, bytes, (size_t)size));
}

static int bus_feature(void *context, const uint8_t *bytes, int size)
{
	struct bus *bus = context;
	uint8_t copy[16];
	memcpy(copy, bytes, (size_t)size);
	return moved_errno(ioctl(bus->hidraw, HIDIOCSFEATURE((unsigned)size), copy));
}

static int bus_feature_get(void *context, uint8_t *bytes, int size)
{
	struct bus *bus = context;
	return moved_errno(ioctl(bus->hidraw, HIDIOCGFEATURE((unsigned)size), bytes));
}

/* The job that runs was forgotten, or everything ends. */
static bool setup_stopped(struct live_setup *setup)
{
	pthread_mutex_lock(&setup->lock);
	const struct job *job = &setup->job[setup->running];
	bool stopped = setup->stop || !job->used || job->number != setup->running_job;
	pthread_mutex_unlock(&setup->lock);
	return stopped;
}

static bool bus_stopped(void *context)
{
	return setup_stopped(((struct bus *)context)->setup);
}

/* Strings need the USB device's node, reports the hidraw node; neither is opened without need. */
static bool steps_needed(const struct pen_recipe *recipe, bool strings)
{
	for (int i = 0; i < recipe->step_count; i++)
		if ((recipe->step[i].kind == PEN_STEP_STRING) == strings)
			return true;
	return false;
}

static bool bus_refused(const char *path, char reason[160])
{
	snprintf(reason, 160, "%.60s: %.40s%s", path, strerror(errno),
		 errno == EACCES ? "; a udev rule must give this user's group write access" : "");
	return false;
}

static bool bus_open(struct bus *bus, const struct live_node *node, char reason[160])
{
	if (steps_needed(&node->recipe, false)) {
		bus->hidraw = open(node->path, O_RDWR | O_NONBLOCK | O_CLOEXEC);
		if (bus->hidraw < 0)
			return bus_refused(node->path, reason);
	}
	if (!steps_needed(&node->recipe, true))
		return true;
	char path[64];
	snprintf(path, sizeof path, "/dev/bus/usb/%03d/%03d", node->usb_bus, node->usb_address);
	bus->usb = open(path, O_RDWR | O_CLOEXEC);
	if (bus->usb < 0)
		return bus_refused(path, reason);
	/* the device is given by its node: libusb need not look for others, nor watch for them */
	libusb_set_option(NULL, LIBUSB_OPTION_NO_DEVICE_DISCOVERY);
	int wrong = bus->setup->usb ? 0 : libusb_init(&bus->setup->usb);
	wrong = wrong ? wrong
		      : libusb_wrap_sys_device(bus->setup->usb, (intptr_t)bus->usb, &bus->handle);
	if (wrong)
		snprintf(reason, 160, "%.60s: libusb: %.60s", path, libusb_error_name(wrong));
	return !wrong;
}

static void bus_close(struct bus *bus)
{
	if (bus->handle)
		libusb_close(bus->handle);
	if (bus->usb >= 0)
		close(bus->usb);
	if (bus->hidraw >= 0)
		close(bus->hidraw);
}

/* --- jobs ------------------------------------------------------------------------------------- */

static void job_run(struct live_setup *setup, const struct pen_transport *transport,
		    struct pen_setup_result *result)
{
	const struct live_node *node = &setup->node;
	struct pen_identity identity = live_node_identity(node);
	struct bus bus = {.setup = setup, .hidraw = -1, .usb = -1};
	struct pen_transport by_bus = {&bus,        bus_string,      bus_output,
				       bus_feature, bus_feature_get, bus_stopped};
	*result = (struct pen_setup_result){0};
	if (transport)
		pen_setup(&identity, &node->recipe, transport, result);
	else if (bus_open(&bus, node, result->reason))
		pen_setup(&identity, &node->recipe, &by_bus, result);
	bus_close(&bus);
}

/* The job that is due next; the time until then in *wait_us. NULL: none is due yet. */
static struct job *job_next(struct live_setup *setup, int64_t *wait_us)
{
	struct job *next = NULL;
	for (int i = 0; i < LIVE_TABLETS_MAX; i++) {
		struct job *job = &setup->job[i];
		if (job->used && job->due && (!next || job->due_us < next->due_us))
			next = job;
	}
	*wait_us = next ? next->due_us - live_clock_us() : INT64_C(60000000);
	return next && *wait_us <= 0 ? next : NULL;
}

static void wait_changed(struct live_setup *setup, int64_t wait_us)
{
	struct timespec until;
	clock_gettime(CLOCK_MONOTONIC, &until);
	int64_t ns = until.tv_nsec + wait_us % 1000000 * 1000;
	until.tv_sec += (time_t)(wait_us / 1000000 + ns / 1000000000);
	until.tv_nsec = (long)(ns % 1000000000);
	pthread_cond_timedwait(&setup->changed, &setup->lock, &until);
}

static void job_after(struct job *job, const struct pen_setup_result *result)
{
	job->failures = result->done ? 0 : job->failures + 1;
	if (result->done || job->due || job->failures > RETRIES_MAX)
		return; /* done, asked for again meanwhile, or given up */
	job->due = true;
	job->due_us = live_clock_us() + (INT64_C(1000) * RETRY_FIRST_MS << (job->failures - 1));
}

static void *thread_main(void *argument)
{
	struct live_setup *setup = argument;
	pthread_mutex_lock(&setup->lock);
	while (!setup->stop) {
		int64_t wait_us;
		struct job *job = job_next(setup, &wait_us);
		if (!job) {
			wait_changed(setup, wait_us);
			continue;
		}
		int device = (int)(job - setup->job);
		unsigned number = job->number;
		const struct pen_transport *transport = job->transport;
		struct pen_setup_result result;
		job->due = false;
		setup->node = job->node;
		setup->running = device;
		setup->running_job = number;
		pthread_mutex_unlock(&setup->lock);
		job_run(setup, transport, &result);
		bool stopped = setup_stopped(setup);
		if (!stopped)
			setup->done(setup->context, device, number, &result);
		pthread_mutex_lock(&setup->lock);
		if (job->used && job->number == number)
			job_after(job, &result);
	}
	pthread_mutex_unlock(&setup->lock);
	return NULL;
}

/* --- asked from outside ----------------------------------------------------------------------- */

void live_setup_start(struct live_setup *setup, int device, unsigned job,
		      const struct live_node *node, const struct pen_transport *transport)
{
	pthread_mutex_lock(&setup->lock);
	setup->job[device] = (struct job){.used = true,
					  .due = true,
					  .number = job,
					  .due_us = live_clock_us(),
					  .transport = transport,
					  .node = *node};
	pthread_cond_signal(&setup->changed);
	pthread_mutex_unlock(&setup->lock);
}

void live_setup_again(struct live_setup *setup, int device)
{
	pthread_mutex_lock(&setup->lock);
	struct job *job = &setup->job[device];
	job->due = job->used;
	job->due_us = live_clock_us();
	job->failures = 0;
	pthread_cond_signal(&setup->changed);
	pthread_mutex_unlock(&setup->lock);
}

void live_setup_forget(struct live_setup *setup, int device)
{
	pthread_mutex_lock(&setup->lock);
	setup->job[device].used = false;
	pthread_mutex_unlock(&setup->lock);
}

struct live_setup *live_setup_open(live_setup_done *done, void *context)
{
	struct live_setup *setup = calloc(1, sizeof *setup);
	pthread_condattr_t monotonic;
	if (!setup)
		return NULL;
	setup->done = done;
	setup->context = context;
	pthread_mutex_init(&setup->lock, NULL);
	pthread_condattr_init(&monotonic);
	pthread_condattr_setclock(&monotonic, CLOCK_MONOTONIC);
	pthread_cond_init(&setup->changed, &monotonic);
	pthread_condattr_destroy(&monotonic);
	if (pthread_create(&setup->thread, NULL, thread_main, setup)) {
		pthread_cond_destroy(&setup->changed);
		pthread_mutex_destroy(&setup->lock);
		free(setup);
		return NULL;
	}
	return setup;
}

void live_setup_close(struct live_setup *setup)
{
	if (!setup)
		return;
	pthread_mutex_lock(&setup->lock);
	setup->stop = true;
	pthread_cond_signal(&setup->changed);
	pthread_mutex_unlock(&setup->lock);
	pthread_join(setup->thread, NULL);
	if (setup->usb)
		libusb_exit(setup->usb);
	pthread_cond_destroy(&setup->changed);
	pthread_mutex_destroy(&setup->lock);
	free(setup);
}
