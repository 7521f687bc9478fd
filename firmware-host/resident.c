#include "resident.h"

#include <errno.h>
#include <malloc.h>
#include <stdio.h>
#include <sys/mman.h>
#include <sys/resource.h>

enum { STACK_BYTES = 512 << 10 }; /* deeper than any of our calls, Mesa's included */

static void touch_stack(void)
{
	volatile unsigned char stack[STACK_BYTES];
	for (int i = 0; i < STACK_BYTES; i += 4096)
		stack[i] = 0;
	(void)stack;
}

/* What libraries free and take again in each frame would else be unmapped and faulted in anew. */
void resident_begin(void)
{
	mallopt(M_MMAP_MAX, 0);
	mallopt(M_TRIM_THRESHOLD, -1);
	touch_stack();
}

bool resident_lock(char fault[FAULT_BYTES])
{
	struct rlimit limit;
	if (mlockall(MCL_CURRENT) == 0)
		return true;
	int error = errno;
	getrlimit(RLIMIT_MEMLOCK, &limit);
	snprintf(fault, FAULT_BYTES,
		 "memory is not locked (%s; this user may lock %llu MB): where memory is short a "
		 "frame may wait for the disk. A unit allows it with LimitMEMLOCK=infinity, a "
		 "shell with ulimit -l",
		 strerror(error), (unsigned long long)limit.rlim_cur >> 20);
	return false;
}
