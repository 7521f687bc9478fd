#define LANES 1
#include "cloth_kernel_lanes.h"

const struct kernel kernel_1 = KERNEL;
