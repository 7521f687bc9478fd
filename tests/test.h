/* A dozen lines of test support: CHECK prints and counts, test_end makes the exit status. */
#ifndef TEST_H
#define TEST_H

#include <stdio.h>
#include <stdlib.h>

static int test_failures;

#define CHECK(condition)                                                                           \
	do {                                                                                       \
		if (!(condition)) {                                                                \
			fprintf(stderr, "%s:%d: %s\n", __FILE__, __LINE__, #condition);            \
			test_failures++;                                                           \
		}                                                                                  \
	} while (0)

#define CHECK_NEAR(a, b, tolerance)                                                                \
	do {                                                                                       \
		double check_a = (double)(a), check_b = (double)(b);                               \
		double check_d = check_a > check_b ? check_a - check_b : check_b - check_a;        \
		if (!(check_d <= (double)(tolerance))) {                                           \
			fprintf(stderr, "%s:%d: %s = %.9g, expected %s = %.9g\n", __FILE__,        \
				__LINE__, #a, check_a, #b, check_b);                               \
			test_failures++;                                                           \
		}                                                                                  \
	} while (0)

static inline int test_end(void)
{
	return test_failures ? EXIT_FAILURE : EXIT_SUCCESS;
}

#endif
