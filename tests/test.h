/* A few lines of test support: CHECK prints and counts, test_end makes the exit status. */
#ifndef TEST_H
#define TEST_H

#include <stdio.h>
#include <stdlib.h>

enum { TEST_FOLDER_BYTES = 80 }; /* a socket's path has room for 108, its name included */

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

/* A folder of this run's own, which the test removes. */
static inline void test_folder(char folder[TEST_FOLDER_BYTES])
{
	const char *base = getenv("TMPDIR");
	int size = snprintf(folder, TEST_FOLDER_BYTES, "%s/kitsuke-XXXXXX",
			    base && *base ? base : "/tmp");
	if (size < TEST_FOLDER_BYTES && mkdtemp(folder))
		return;
	perror(folder);
	exit(EXIT_FAILURE);
}

static inline int test_end(void)
{
	return test_failures ? EXIT_FAILURE : EXIT_SUCCESS;
}

#endif
