#include "cloth_kernel.h"

const struct kernel *kernel_of(int lanes)
{
#ifdef __x86_64__
	if (lanes >= 8)
		return &kernel_8;
#endif
	return lanes >= 4 ? &kernel_4 : &kernel_1;
}
