#include "threads.h"

#include <sched.h>
#include <signal.h>
#include <stdio.h>
#include <unistd.h>

enum {
	SPINS = 2000, /* some 50 us: longer than most of what a sweep does alone */
	STACK_BYTES = 512 << 10,
};

static void pause_briefly(void)
{
#if defined __x86_64__
	__builtin_ia32_pause();
#elif defined __aarch64__
	__asm__ volatile("yield");
#endif
}

/* ---- work ---- */

static uint64_t ticket_of(uint32_t work, int next, int end)
{
	return (uint64_t)work << 32 | (uint64_t)next << 16 | (uint64_t)end;
}

/* Takes a part of a share and does it; false when none is left. That the ticket has not changed
 * meanwhile says that task and context are still those of its work. */
static bool do_part(struct threads *threads, struct threads_share *share)
{
	uint64_t ticket = atomic_load_explicit(&share->ticket, memory_order_acquire);
	crew_task *task;
	void *context;
	do {
		if ((ticket >> 16 & 0xffff) == (ticket & 0xffff))
			return false;
		task = atomic_load_explicit(&threads->task, memory_order_relaxed);
		context = atomic_load_explicit(&threads->context, memory_order_relaxed);
	} while (!atomic_compare_exchange_weak_explicit(&share->ticket, &ticket, ticket + 0x10000,
							memory_order_acq_rel,
							memory_order_acquire));
	task(context, (int)(ticket >> 16 & 0xffff));
	if (atomic_fetch_sub_explicit(&threads->left, 1, memory_order_acq_rel) > 1)
		return true;
	pthread_mutex_lock(&threads->mutex);
	pthread_cond_signal(&threads->done);
	pthread_mutex_unlock(&threads->mutex);
	return true;
}

/* First its own share, which lay in this processor's cache the last time too. */
static void do_parts(struct threads *threads, int index)
{
	for (int i = 0; i < threads->count; i++)
		while (do_part(threads, &threads->share[(index + i) % threads->count]))
			continue;
}

/* ---- the caller ---- */

static void begin(struct threads *threads, crew_task *task, void *context, int parts)
{
	uint32_t work = atomic_load_explicit(&threads->work, memory_order_relaxed) + 1;
	atomic_store_explicit(&threads->task, task, memory_order_relaxed);
	atomic_store_explicit(&threads->context, context, memory_order_relaxed);
	atomic_store_explicit(&threads->left, parts, memory_order_relaxed);
	for (int i = 0; i < threads->count; i++)
		atomic_store_explicit(&threads->share[i].ticket,
				      ticket_of(work, i * parts / threads->count,
						(i + 1) * parts / threads->count),
				      memory_order_release);
	atomic_store(&threads->work, work);
	if (atomic_load(&threads->sleepers) == 0)
		return;
	pthread_mutex_lock(&threads->mutex);
	pthread_cond_broadcast(&threads->begun);
	pthread_mutex_unlock(&threads->mutex);
}

static void wait_until_done(struct threads *threads)
{
	for (int spin = 0; spin < SPINS; spin++) {
		if (atomic_load_explicit(&threads->left, memory_order_acquire) == 0)
			return;
		pause_briefly();
	}
	pthread_mutex_lock(&threads->mutex);
	while (atomic_load_explicit(&threads->left, memory_order_acquire) > 0)
		pthread_cond_wait(&threads->done, &threads->mutex);
	pthread_mutex_unlock(&threads->mutex);
}

/* A thread that sleeps or was sent away holds nobody up: others do its share. */
static void run(struct crew *crew, crew_task *task, void *context, int parts)
{
	struct threads *threads = (struct threads *)crew;
	begin(threads, task, context, parts);
	do_parts(threads, 0);
	wait_until_done(threads);
}

/* ---- the others ---- */

/* Returns at new work, or at the end. */
static bool wait_for_work(struct threads *threads, uint32_t seen)
{
	for (int spin = 0; spin < SPINS; spin++) {
		if (atomic_load_explicit(&threads->work, memory_order_acquire) != seen)
			return true;
		pause_briefly();
	}
	pthread_mutex_lock(&threads->mutex);
	atomic_fetch_add(&threads->sleepers, 1);
	while (!threads->ends && atomic_load(&threads->work) == seen)
		pthread_cond_wait(&threads->begun, &threads->mutex);
	atomic_fetch_sub(&threads->sleepers, 1);
	bool ends = threads->ends;
	pthread_mutex_unlock(&threads->mutex);
	return !ends;
}

static void *live(void *argument)
{
	const struct threads_seat *seat = argument;
	struct threads *threads = seat->threads;
	uint32_t seen = 0;
	while (wait_for_work(threads, seen)) {
		seen = atomic_load_explicit(&threads->work, memory_order_acquire);
		do_parts(threads, seat->index);
	}
	return NULL;
}

/* ---- from start to end ---- */

static void stop(struct threads *threads, int count)
{
	pthread_mutex_lock(&threads->mutex);
	threads->ends = true;
	pthread_cond_broadcast(&threads->begun);
	pthread_mutex_unlock(&threads->mutex);
	for (int i = 1; i < count; i++)
		pthread_join(threads->thread[i], NULL);
	pthread_cond_destroy(&threads->done);
	pthread_cond_destroy(&threads->begun);
	pthread_mutex_destroy(&threads->mutex);
	threads->count = 0;
}

static int start_one(struct threads *threads, int index, int cpu)
{
	pthread_attr_t attributes;
	cpu_set_t set;
	threads->seat[index] = (struct threads_seat){threads, index};
	int error = pthread_attr_init(&attributes);
	if (!error)
		error = pthread_attr_setstacksize(&attributes, STACK_BYTES);
	if (!error && cpu >= 0) {
		CPU_ZERO(&set);
		CPU_SET((size_t)cpu, &set);
		error = pthread_attr_setaffinity_np(&attributes, sizeof set, &set);
	}
	if (!error)
		error = pthread_create(&threads->thread[index], &attributes, live,
				       &threads->seat[index]);
	pthread_attr_destroy(&attributes);
	return error;
}

bool threads_start(struct threads *threads, long count, const int *cpu, char fault[FAULT_BYTES])
{
	sigset_t all, before;
	int error = 0;
	memset(threads, 0, sizeof *threads);
	if (count < 1 || count > THREADS_MAX) {
		snprintf(fault, FAULT_BYTES, "%ld threads; 1 to %d can be had", count, THREADS_MAX);
		return false;
	}
	threads->crew.run = run;
	threads->count = (int)count;
	pthread_mutex_init(&threads->mutex, NULL);
	pthread_cond_init(&threads->begun, NULL);
	pthread_cond_init(&threads->done, NULL);
	/* signals are the main thread's */
	sigfillset(&all);
	pthread_sigmask(SIG_BLOCK, &all, &before);
	int started = 1;
	while (started < count && !error) {
		error = start_one(threads, started, cpu ? cpu[started] : THREADS_ANY);
		started += !error;
	}
	pthread_sigmask(SIG_SETMASK, &before, NULL);
	if (!error)
		return true;
	snprintf(fault, FAULT_BYTES, "thread %d of %ld does not start: %s", started + 1, count,
		 strerror(error));
	stop(threads, started);
	return false;
}

void threads_stop(struct threads *threads)
{
	if (threads->count > 0)
		stop(threads, threads->count);
}

struct crew *threads_crew(struct threads *threads)
{
	return threads->count > 1 ? &threads->crew : NULL;
}
