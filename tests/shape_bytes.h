/* Report descriptors in the shapes that makers' protocols have, for tests. */
#ifndef SHAPE_BYTES_H
#define SHAPE_BYTES_H

#include "table.h"

#include <stdio.h>

struct shape_bytes {
	int size;
	uint8_t bytes[256];
};

static inline void put(struct shape_bytes *shape, const char *hex)
{
	shape->size += table_hex(hex, shape->bytes + shape->size,
				 sizeof shape->bytes - (size_t)shape->size);
}

/* An application with one opaque input report and, where out is given, an output report. */
static inline void put_opaque(struct shape_bytes *shape, int page, int usage, int id, int in,
			      int out)
{
	char hex[160];
	snprintf(hex, sizeof hex, "06%02x%02x 09%02x a101 85%02x 0901 150026ff00 7508 95%02x 8102",
		 page & 0xff, page >> 8, usage, id, in - 1);
	put(shape, hex);
	snprintf(hex, sizeof hex, "0902 95%02x 9102", out - 1);
	if (out > 1)
		put(shape, hex);
	put(shape, "c0");
}

/* Report 7 and report 9 of the first UC-Logic tablets: a pen and an absolute mouse. */
static inline void put_uclogic_1(struct shape_bytes *shape)
{
	put(shape, "050d 0902 a101 8507 0920 a100 0942 0944 0945 1500 2501 7501 9503 8102 9503 8103"
		   "0932 9501 8102 9501 8103 0501 0930 0931 7510 9502 26007d 8102 050d 0930 26ff07"
		   "9501 8102 c0c0");
	put(shape, "0501 0902 a101 8509 0901 a100 0509 1901 2903 1500 2501 7501 9503 8102 9505 8103"
		   "0501 0930 0931 7510 9502 26ff7f 8102 050d 0930 26ff07 9501 8102 c0c0");
}

#endif
