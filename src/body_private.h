/* Shared between the body's own files only. */
#ifndef BODY_PRIVATE_H
#define BODY_PRIVATE_H

#include "body_parts.h"

struct body_scratch {
	struct v3 *centre_m; /* per triangle, while the tree is built */
	int *fill;           /* per vertex, while stars are built */
	struct parts_scratch *parts;
};

#endif
