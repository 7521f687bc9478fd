#include "threads_board.h"

#include <unistd.h>

enum { AUTO_MAX = 4 }; /* what is done by one thread alone leaves little for more */

bool threads_start_board(struct threads *threads, const struct board *board,
			 char fault[FAULT_BYTES])
{
	int cpu[THREADS_MAX] = {0};
	int count = int_clamp((int)sysconf(_SC_NPROCESSORS_ONLN) - 1, 1, AUTO_MAX);
	if (board->thread_cpus > 0)
		count = 1 + board->thread_cpus;
	if (board->threads > 0)
		count = board->threads;
	for (int i = 1; i < count; i++)
		cpu[i] = i <= board->thread_cpus ? board->thread_cpu[i - 1] : THREADS_ANY;
	return threads_start(threads, count, cpu, fault);
}
