/* What the program does when it finds a promise of its own broken: says where, and stops. */
#include "base.h"

#include <stdio.h>
#include <stdlib.h>

void must_fail(const char *condition, const char *file, int line)
{
	fprintf(stderr, "kitsuke: %s:%d: broken promise: %s\n", file, line, condition);
	abort();
}
