/* Marks: numbered lines on the cloth and on the body. Equal numbers are to meet (S6, S8). */
#ifndef MARK_H
#define MARK_H

#include "limits.h"
#include "vec.h"

enum { MARK_NUMBERS = 100 }; /* marks are numbered from 1 to 99 */

struct cloth_mark {
	bool used;
	int number; /* 1.. */
	int piece;  /* pattern.piece */
	int point_count;
	struct v2 point_mm[MARK_POINTS_MAX]; /* local to the piece */
};

struct body_mark {
	bool used;
	int number;
	int point_count;
	struct v3 point_m[MARK_POINTS_MAX]; /* on the surface */
	struct v3 normal[MARK_POINTS_MAX];  /* outward */
};

struct marks {
	struct cloth_mark cloth[MARKS_MAX];
	struct body_mark body[MARKS_MAX];
};

#endif
