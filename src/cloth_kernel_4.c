#define LANES 4
#include "cloth_kernel_lanes.h"

const struct kernel kernel_4 = KERNEL;
