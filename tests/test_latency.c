/* From the tablet to the picture: nothing is lost while the frame loop stalls, a flood is thinned
 * to what a hand can mean, and what was read is on the screen two frames later at the latest.
 *
 * The kernel's ring is played by one in here: 64 places of which 63 hold a report, and the newest
 * is dropped when they are full. The linker sends the reader's read() to it (Makefile). Frames and
 * reports of the last part come in virtual time. */
#include "kiosk_late.h"
#include "live.h"
#include "tape_learn.h"
#include "test.h"

#include <errno.h>
#include <pthread.h>
#include <stdatomic.h>
#include <sys/eventfd.h>
#include <time.h>
#include <unistd.h>

enum { RING = 64, PATIENCE_MS = 20000, REPORT = 7 };

static struct frame_reports reports;
static struct kiosk kiosk;

/* ---- a hidraw node ---- */

static struct {
	int fd; /* counts what is in the ring */
	pthread_mutex_t lock;
	uint8_t report[RING][REPORT];
	int head, tail;
	bool held; /* nobody reads */
	long dropped;
} ring = {.fd = -1, .lock = PTHREAD_MUTEX_INITIALIZER};

ssize_t __real_read(int fd, void *bytes, size_t size);
ssize_t __wrap_read(int fd, void *bytes, size_t size);

ssize_t __wrap_read(int fd, void *bytes, size_t size)
{
	uint64_t one;
	if (fd != ring.fd)
		return __real_read(fd, bytes, size);
	pthread_mutex_lock(&ring.lock);
	ssize_t got = ring.held ? -1 : __real_read(fd, &one, sizeof one);
	if (got > 0) {
		memcpy(bytes, ring.report[ring.tail], REPORT);
		ring.tail = (ring.tail + 1) % RING;
	} else {
		errno = EAGAIN;
	}
	pthread_mutex_unlock(&ring.lock);
	return got > 0 ? REPORT : -1;
}

/* As drivers/hid/hidraw.c does it. */
static void ring_put(const uint8_t bytes[REPORT])
{
	uint64_t one = 1;
	pthread_mutex_lock(&ring.lock);
	if ((ring.head + 1) % RING == ring.tail) {
		ring.dropped++;
	} else {
		memcpy(ring.report[ring.head], bytes, REPORT);
		ring.head = (ring.head + 1) % RING;
		CHECK(write(ring.fd, &one, sizeof one) == sizeof one);
	}
	pthread_mutex_unlock(&ring.lock);
}

static void rest(void)
{
	nanosleep(&(struct timespec){0, 1000000}, NULL);
}

static bool ring_empty(void)
{
	pthread_mutex_lock(&ring.lock);
	bool empty = ring.head == ring.tail;
	pthread_mutex_unlock(&ring.lock);
	return empty;
}

static void ring_drained(void)
{
	for (int ms = 0; ms < PATIENCE_MS && !ring_empty(); ms++)
		rest();
	CHECK(ring_empty());
}

/* A report of the desktop's mouse as a pen: nothing is filtered, nothing in doubt. */
static void report_make(uint8_t bytes[REPORT], int flags, int x)
{
	const uint8_t made[REPORT] = {(uint8_t)flags, (uint8_t)x, (uint8_t)(x >> 8), 0, 0x40, 0, 8};
	memcpy(bytes, made, REPORT);
}

static int report_x(const struct raw_report *report)
{
	return report->bytes[1] | report->bytes[2] << 8;
}

static void pen_put(int flags, int x)
{
	uint8_t bytes[REPORT];
	report_make(bytes, flags, x);
	ring_put(bytes);
}

static struct tape_device mouse(void)
{
	struct tape_device told = {
		.used = true, .name = "a pen", .descriptor_size = mouse_descriptor_size};
	memcpy(told.descriptor, mouse_descriptor, (size_t)mouse_descriptor_size);
	return told;
}

static struct live *open_live(void)
{
	struct board nothing = board_default;
	nothing.tablet_vendor = 0xffff; /* leave this machine's own tablets alone */
	struct live *live = live_open(&nothing, 0);
	MUST(live);
	return live;
}

static void ring_plug(struct live *live)
{
	struct tape_device told = mouse();
	ring.fd = eventfd(0, EFD_SEMAPHORE | EFD_NONBLOCK | EFD_CLOEXEC);
	ring.dropped = 0;
	ring.head = ring.tail = 0;
	MUST(ring.fd >= 0);
	CHECK(live_attach(live, ring.fd, "port 1", &told) == 0);
	reports.count = 0;
	CHECK(live_collect(live, &reports).plugged == 1);
}

/* What was collected: in order, and never more in a frame than fits. */
struct collected {
	int count, frames, turns; /* turns: the first one, and where the switches change */
	int last_x, flags;
};

static void collect(struct live *live, struct collected *c)
{
	reports.count = 0;
	live_collect(live, &reports);
	c->frames += reports.count > 0;
	c->count += reports.count;
	CHECK(reports.count <= FRAME_REPORTS_MAX);
	for (int i = 0; i < reports.count; i++) {
		const struct raw_report *report = &reports.report[i];
		CHECK(report_x(report) > c->last_x);
		c->turns += report->bytes[0] != c->flags;
		c->flags = report->bytes[0];
		c->last_x = report_x(report);
	}
}

static void collect_to(struct live *live, int last_x, struct collected *c)
{
	for (int ms = 0; ms < PATIENCE_MS && c->last_x != last_x; ms++) {
		collect(live, c);
		if (!reports.count)
			rest();
	}
	CHECK(c->last_x == last_x);
}

/* ---- a stall ---- */

/* 250 ms at 500 Hz come while the frame loop stands still. */
static void check_stall(void)
{
	struct live *live = open_live();
	struct collected c = {.last_x = -1};
	int x = 0;
	ring_plug(live);
	while (x < 125) {
		for (int i = 0; i < RING - 1 && x < 125; i++)
			pen_put(5, x++);
		ring_drained(); /* by the reader alone */
	}
	collect_to(live, 124, &c);
	CHECK(c.count == 125 && c.frames <= 3 && ring.dropped == 0 && live_lost(live) == 0);

	/* the ring itself is as small as the kernel's */
	pthread_mutex_lock(&ring.lock);
	ring.held = true;
	pthread_mutex_unlock(&ring.lock);
	for (int i = 0; i < 70; i++)
		pen_put(5, 200 + i);
	CHECK(ring.dropped == 7);
	live_close(live);
	close(ring.fd);
	ring.held = false;
	ring.fd = -1;
}

/* ---- a flood ---- */

/* As fast as they can be read, with contacts in between: every change of contact comes through, and
 * of the rest no more than a hand can mean. */
static void check_flood(void)
{
	enum { FLOOD = 20000, CONTACT = 500, RUNS = FLOOD / CONTACT };
	struct live *live = open_live();
	struct collected c = {.last_x = -1};
	int x = 0;
	ring_plug(live);
	int64_t begin_us = live_clock_us();
	while (x < FLOOD) {
		for (int i = 0; i < RING - 1 && x < FLOOD; i++, x++)
			pen_put(x / CONTACT % 2 && x < FLOOD - 1 ? 5 : 4, x);
		ring_drained();
		collect(live, &c);
	}
	collect_to(live, FLOOD - 1, &c);
	int64_t most = 256 + (live_clock_us() - begin_us) / 500 + c.turns;
	printf("of a flood of %d reports %d are kept, with all %d turns\n", FLOOD, c.count,
	       c.turns);
	CHECK(ring.dropped == 0 && c.turns == RUNS + 1);
	CHECK(c.count <= most && live_lost(live) == FLOOD - c.count);
	live_close(live);
	close(ring.fd);
	ring.fd = -1;
}

/* ---- late sampling ---- */

enum {
	T_US = 16667,
	DRAW_US = 3000,
	REPORT_US = 2000,
	REPORTS = 2000,
	FRAMES = 200,
};

static int64_t read_us[REPORTS], shown_us[REPORTS];
static int on_ring, on_screen; /* reports */

static void read_until(struct live *live, int64_t now_us)
{
	uint8_t bytes[REPORT];
	for (; on_ring < REPORTS && (int64_t)on_ring * REPORT_US + 777 <= now_us; on_ring++) {
		report_make(bytes, 5, 8000 + on_ring);
		read_us[on_ring] = (int64_t)on_ring * REPORT_US + 777;
		live_push(live, 0, read_us[on_ring], REPORT, bytes);
	}
}

/* The picture of a frame: the stroke has a sample for each report. */
static void picture(int64_t flip_us)
{
	for (; on_screen < kiosk.ui.stroke_count; on_screen++)
		shown_us[on_screen] = flip_us;
}

/* One frame of the station: begun by the last flip, kiosk_frame takes work_us. */
static int64_t station_frame(struct live *live, int64_t now_us, int64_t *before_us, int64_t work_us,
			     bool late)
{
	static struct kiosk_late shown;
	reports.count = 0;
	read_until(live, now_us);
	live_collect(live, &reports);
	live_stamp(&reports, kiosk.frame, *before_us, now_us);
	*before_us = now_us;
	kiosk_frame(&kiosk, &reports, 0);
	now_us += work_us;
	read_until(live, now_us);
	reports.count = 0;
	if (late)
		live_peek(live, &reports);
	live_stamp(&reports, kiosk.frame, *before_us, now_us);
	uint64_t hash = session_hash(&kiosk.session);
	struct v2 pen_px = kiosk.ui.pen_px;
	int count = kiosk.ui.stroke_count;
	kiosk_late_show(&shown, &kiosk, &reports);
	CHECK(kiosk.ui.stroke_count == count + reports.count || count == 0);
	int64_t flip_us = ((now_us + DRAW_US) / T_US + 1) * T_US;
	picture(flip_us);
	kiosk_late_hide(&shown, &kiosk);
	CHECK(kiosk.ui.stroke_count == count && kiosk.ui.pen_px.x == pen_px.x);
	CHECK(session_hash(&kiosk.session) == hash);
	return flip_us;
}

/* The longest and the mean way from the reader to the screen, in frames. */
static float way(bool late, float *mean)
{
	struct live *live = open_live();
	struct tape_device told = mouse();
	void *memory = malloc(KIOSK_MEMORY_BYTES);
	int64_t now_us = T_US, before_us = 0, longest_us = 0, sum_us = 0;
	MUST(memory);
	kiosk_init(&kiosk, memory, 1280, 720);
	MUST(!body_build_mannequin(&kiosk.session.body));
	tape_learn(&kiosk.pen, 0, &told);
	on_ring = on_screen = 0;
	for (int i = 0; i < FRAMES; i++) /* 2 to 12 ms of work */
		now_us = station_frame(live, now_us, &before_us, 2000 + i * 37 % 10000, late);
	CHECK(on_screen > 1000);
	for (int i = 0; i < on_screen; i++) {
		longest_us = shown_us[i] - read_us[i] > longest_us ? shown_us[i] - read_us[i]
								   : longest_us;
		sum_us += shown_us[i] - read_us[i];
	}
	*mean = (float)(sum_us / on_screen) / (float)T_US;
	live_close(live);
	free(memory);
	return (float)longest_us / (float)T_US;
}

static void check_late(void)
{
	float mean, mean_late;
	float longest = way(false, &mean), longest_late = way(true, &mean_late);
	printf("from the reader to the screen, frames: at most %.2f, mean %.2f; read again before "
	       "drawing: at most %.2f, mean %.2f\n",
	       (double)longest, (double)mean, (double)longest_late, (double)mean_late);
	CHECK(longest <= 2.0f && longest_late <= longest);
	CHECK(mean_late < mean - 0.3f);
}

int main(void)
{
	check_stall();
	check_flood();
	check_late();
	return test_end();
}
