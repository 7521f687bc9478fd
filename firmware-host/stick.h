/* USB sticks that somebody has mounted: found in the kernel's list of mounts, and known as
 * removable by what sysfs says of their device. */
#ifndef STICK_H
#define STICK_H

#include "store.h"
#include "take_home_page.h"

enum { STICKS_MAX = 4 };

/* Where to look; tests have places of their own. */
struct stick_places {
	const char *mounts;  /* as /proc/self/mountinfo */
	const char *devices; /* as /sys/dev/block: MAJOR:MINOR leads to a device's folder */
};

extern const struct stick_places stick_places_kernel;

struct stick {
	char mount[PATH_BYTES_MAX];
	unsigned major, minor;
};

/* Sticks with a file system that is mounted, but for the disk that the system itself runs from.
 * Returns their count. */
int stick_find(const struct stick_places *places, struct stick stick[STICKS_MAX]);

/* Is it still there, and not only the folder where it was? */
bool stick_present(const struct stick *stick);

/* Two files into the folder kitsuke/ of the stick: each is written beside its name, synced and
 * renamed, and then the whole stick is. What was there before stays as it was on any fault. */
struct stick_file {
	const char *name;
	const void *bytes;
	size_t size;
};
enum kept stick_keep(const struct stick *stick, const struct stick_file *file, int count,
		     char fault[FAULT_BYTES]);

/* What an errno of storing means for whoever waits for it. */
enum kept kept_by_errno(int number);

#endif
