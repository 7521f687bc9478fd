#define LANES 8
#ifdef __x86_64__
#include "cloth_kernel_lanes.h"

const struct kernel kernel_8 = KERNEL;
#else
#include "cloth_kernel.h"
#endif
