/* What the core can't ask for itself: how wide the processor is. */
#ifndef PROCESSOR_H
#define PROCESSOR_H

/* Lanes for cloth.lanes (cloth_kernel.h). */
static inline int processor_lanes(void)
{
#ifdef __x86_64__
	return __builtin_cpu_supports("avx2") ? 8 : 4;
#else
	return 4;
#endif
}

#endif
