/* How long a report of the pen takes on this side of the USB, and what a flood of them costs.
 *
 *   decode      one report to its fields (pen_report_read), by a descriptor and by makers'
 * protocols sample      one report to its sample: the same, contact, filter, mapping (pen_read)
 *   wake        from the write into the node until the reader's thread has queued it: what the
 *               system's scheduler makes of it; a SEQPACKET socket stands for hidraw
 *   read        the reader's own work on it: poll, read, decode, queue, in processor time
 *   stroke      from the queue to the point of the stroke: live_collect, pen, face
 *   processing  read and stroke of the same report; waiting, for the processor and for the frame,
 * is not in it frame       kiosk_frame and what comes before it, of a stroke at 0, 500 and 8000
 * reports a second, at 60 Hz
 */
#include "kiosk.h"
#include "live.h"
#include "tape_learn.h"

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

enum {
	TIMES_MAX = 20000,
	ROUNDS = 4000,
	FLOOD_FRAMES = 240,
};

struct series {
	int count;
	double us[TIMES_MAX];
};

static struct kiosk kiosk;
static struct frame_reports reports;
static struct series series, reader, stroke, whole;

static double clock_us(clockid_t clock)
{
	struct timespec now;
	clock_gettime(clock, &now);
	return (double)now.tv_sec * 1e6 + (double)now.tv_nsec * 1e-3;
}

static void series_add(struct series *s, double us)
{
	if (s->count < TIMES_MAX)
		s->us[s->count++] = us;
}

static int by_size(const void *a, const void *b)
{
	double x = *(const double *)a, y = *(const double *)b;
	return x < y ? -1 : x > y;
}

static void series_print(const char *name, struct series *s)
{
	qsort(s->us, (size_t)s->count, sizeof *s->us, by_size);
	printf("%-28s %8.3f %8.3f %8.3f %8.1f  us, p50 p90 p99 max of %d\n", name,
	       s->us[s->count / 2], s->us[s->count * 9 / 10], s->us[s->count * 99 / 100],
	       s->us[s->count - 1], s->count);
	s->count = 0;
}

/* ---- a pen ---- */

/* The bundled tape's pen: 16 bit positions, 13 of pressure, tilt. */
static struct tape bundled;

static void tape_load(void)
{
	static char text[1 << 20];
	char fault[200];
	FILE *file = fopen("tests/tapes/tshirt.hid", "rb");
	size_t size = file ? fread(text, 1, sizeof text, file) : 0;
	MUST(size && size < sizeof text && tape_read(&bundled, text, size, fault));
	fclose(file);
}

/* A stroke round a circle of the sheet, slowly. */
static void pen_report(int i, uint8_t bytes[10])
{
	float angle = 0.002f * (float)i;
	int x = (int)(38000.0f + 5000.0f * angle_cos(angle));
	int y = (int)(15000.0f + 5000.0f * angle_sin(angle));
	const uint8_t made[10] = {
		2, 0x21, (uint8_t)x, (uint8_t)(x >> 8), (uint8_t)y, (uint8_t)(y >> 8), 0, 8, 0, 0};
	memcpy(bytes, made, sizeof made);
}

/* ---- decoding ---- */

static void bench_decode(void)
{
	static const struct pen_vendor huion = {PEN_UCLOGIC_2, 50800, 31750, 8191},
				       wacom = {PEN_INTUOS, 44704, 27940, 2047};
	static const uint8_t huion_report[12] = {8,    0x81, 0x70, 0x46, 6,    0x3c,
						 0xff, 0xf,  0,    0,    0xf6, 0xa},
			     wacom_report[10] = {2,    0xe1, 0x20, 0x11, 0x30,
						 0x22, 0x80, 0x40, 0x40, 4};
	struct pen_layout layout[3][PEN_REPORTS_MAX];
	int count[3];
	char reason[160];
	const struct tape_device *pen = &bundled.device[0];
	static const char *const name[] = {"decode, by descriptor", "decode, uclogic-2",
					   "decode, intuos"};
	count[0] = pen_descriptor_read(pen->descriptor, pen->descriptor_size, layout[0], reason);
	count[1] = pen_layouts_join(layout[1], 0, &huion);
	count[2] = pen_layouts_join(layout[2], 0, &wacom);
	for (int k = 0; k < 3; k++) {
		struct pen_memory memory = {.tool = 0x802}; /* a Wacom pen that came */
		struct pen_fields fields;
		bool cut_off;
		long decoded = 0;
		uint8_t bytes[12];
		for (int i = 0; i < TIMES_MAX; i++) {
			pen_report(i, bytes);
			if (k > 0)
				memcpy(bytes, k == 1 ? huion_report : wacom_report,
				       k == 1 ? 12 : 10);
			bytes[3] = (uint8_t)(bytes[3] ^ (i & 7));
			double begin_us = clock_us(CLOCK_MONOTONIC);
			decoded += pen_report_read(layout[k], count[k], bytes, k == 1 ? 12 : 10,
						   &memory, &fields, &cut_off) != NULL;
			series_add(&series, clock_us(CLOCK_MONOTONIC) - begin_us);
		}
		MUST(decoded == TIMES_MAX);
		series_print(name[k], &series);
	}
}

static void visit_begin(void)
{
	static void *memory;
	memory = memory ? memory : malloc(KIOSK_MEMORY_BYTES);
	MUST(memory);
	kiosk_init(&kiosk, memory, 1280, 720);
	MUST(!body_build_mannequin(&kiosk.session.body));
	tape_learn(&kiosk.pen, 0, &bundled.device[0]);
}

static void bench_sample(void)
{
	visit_begin();
	for (int i = 0; i < TIMES_MAX; i++) {
		struct frame_input input = {0};
		reports.count = 1;
		reports.report[0] = (struct raw_report){0, (int64_t)i * 2000, 10, {0}};
		pen_report(i, reports.report[0].bytes);
		double begin_us = clock_us(CLOCK_MONOTONIC);
		pen_read(&kiosk.pen, &reports, (int64_t)i * 2000, &input);
		series_add(&series, clock_us(CLOCK_MONOTONIC) - begin_us);
	}
	series_print("sample", &series);
}

/* ---- the reader's thread ---- */

static struct live *open_live(int fds[2])
{
	struct board nothing = board_default;
	nothing.tablet_vendor = 0xffff; /* leave this machine's own tablets alone */
	struct live *live = live_open(&nothing, 0);
	MUST(live && !socketpair(AF_UNIX, SOCK_SEQPACKET, 0, fds));
	MUST(live_attach(live, fds[0], "port 1", &bundled.device[0]) == 0);
	return live;
}

static void close_live(struct live *live, int fds[2])
{
	live_close(live);
	close(fds[0]);
	close(fds[1]);
}

/* What the other threads have worked. */
static double others_us(void)
{
	return clock_us(CLOCK_PROCESS_CPUTIME_ID) - clock_us(CLOCK_THREAD_CPUTIME_ID);
}

static void bench_way(void)
{
	int fds[2];
	struct live *live = open_live(fds);
	visit_begin();
	for (int i = 0; i < ROUNDS; i++) {
		uint8_t bytes[10];
		pen_report(i, bytes);
		nanosleep(&(struct timespec){0, 1000000}, NULL);
		double worked_us = others_us(), begin_us = clock_us(CLOCK_MONOTONIC);
		MUST(write(fds[1], bytes, sizeof bytes) == sizeof bytes);
		nanosleep(&(struct timespec){0, 500000}, NULL);
		worked_us = others_us() - worked_us;
		double collect_us = clock_us(CLOCK_MONOTONIC);
		reports.count = 0;
		live_collect(live, &reports);
		double wake_us = reports.count ? (double)reports.report[0].time_us - begin_us : 0.0;
		kiosk_listen(&kiosk, &reports, 0);
		kiosk_face(&kiosk);
		double stroke_us = clock_us(CLOCK_MONOTONIC) - collect_us;
		kiosk_apply(&kiosk);
		kiosk.frame++;
		if (reports.count != 1)
			continue;
		series_add(&series, wake_us > 0.0 ? wake_us : 0.0);
		series_add(&reader, worked_us);
		series_add(&stroke, stroke_us);
		series_add(&whole, worked_us + stroke_us);
	}
	series_print("wake", &series);
	series_print("read", &reader);
	series_print("stroke", &stroke);
	series_print("processing", &whole);
	close_live(live, fds);
}

/* ---- floods ---- */

static struct {
	int fd, rate_hz;
	volatile bool stop;
} source;

static void *source_main(void *argument)
{
	struct timespec next;
	(void)argument;
	clock_gettime(CLOCK_MONOTONIC, &next);
	for (int i = 0; !source.stop; i++) {
		uint8_t bytes[10];
		pen_report(i * 500 / source.rate_hz, bytes);
		next.tv_nsec += 1000000000 / source.rate_hz;
		next.tv_sec += next.tv_nsec / 1000000000;
		next.tv_nsec %= 1000000000;
		clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &next, NULL);
		(void)!send(source.fd, bytes, sizeof bytes, MSG_DONTWAIT);
	}
	return NULL;
}

static void bench_flood(int rate_hz)
{
	char name[40];
	int fds[2];
	long taken = 0;
	pthread_t thread;
	struct live *live = open_live(fds);
	visit_begin();
	source.fd = fds[1];
	source.rate_hz = rate_hz;
	source.stop = false;
	MUST(!rate_hz || !pthread_create(&thread, NULL, source_main, NULL));
	int64_t before_us = live_clock_us();
	for (int i = 0; i < FLOOD_FRAMES; i++) {
		nanosleep(&(struct timespec){0, 1000000000 / FRAME_RATE_HZ}, NULL);
		double begin_us = clock_us(CLOCK_THREAD_CPUTIME_ID);
		int64_t now_us = live_clock_us();
		reports.count = 0;
		live_collect(live, &reports);
		live_stamp(&reports, kiosk.frame, before_us, now_us);
		before_us = now_us;
		taken += reports.count;
		kiosk_frame(&kiosk, &reports, 0);
		series_add(&series, clock_us(CLOCK_THREAD_CPUTIME_ID) - begin_us);
	}
	source.stop = true;
	if (rate_hz)
		pthread_join(thread, NULL);
	snprintf(name, sizeof name, "frame, %d Hz", rate_hz);
	series_print(name, &series);
	printf("%-28s %8.1f reports a frame\n", "", (double)taken / FLOOD_FRAMES);
	close_live(live, fds);
}

int main(void)
{
	setvbuf(stdout, NULL, _IOLBF, 0);
	tape_load();
	printf("latency, wall time; frames in the thread's own processor time\n");
	bench_decode();
	bench_sample();
	bench_way();
	bench_flood(0);
	bench_flood(500);
	bench_flood(8000);
	return 0;
}
