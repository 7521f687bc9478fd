/* The crew of a host with threads (crew.h). They are made at start; afterwards nothing is allocated
 * and no system call is made while there is work, so that handing a frame's work on is cheap. */
#ifndef THREADS_H
#define THREADS_H

#include "crew.h"
#include "store.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdint.h>

enum { THREADS_MAX = 8, THREADS_ANY = -1 };

/* Parts of the present work that belong to one thread; the others help when they have done theirs.
 * One word: the work's number in the upper half, then the next part and the last one's end. */
struct threads_share {
	_Alignas(64) _Atomic uint64_t ticket;
};

struct threads_seat {
	struct threads *threads;
	int index; /* of its own share */
};

struct threads {
	struct crew crew;
	int count; /* the caller included */
	struct threads_share share[THREADS_MAX];
	_Atomic uint32_t work; /* its number */
	_Atomic(crew_task *) task;
	_Atomic(void *) context;
	atomic_int left; /* parts that are not done */
	atomic_int sleepers;
	bool ends;
	pthread_mutex_t mutex;
	pthread_cond_t begun, done;
	pthread_t thread[THREADS_MAX]; /* the first is not used: the caller is it */
	struct threads_seat seat[THREADS_MAX];
};

/* Starts count - 1 threads beside the caller, thread i bound to the processor cpu[i] (THREADS_ANY,
 * or cpu NULL: to none). False: fault says why, and none runs. */
bool threads_start(struct threads *threads, long count, const int *cpu, char fault[FAULT_BYTES]);
void threads_stop(struct threads *threads);

/* What the core takes; NULL for a single thread. */
struct crew *threads_crew(struct threads *threads);

#endif
