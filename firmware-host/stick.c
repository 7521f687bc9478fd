#include "stick.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

const struct stick_places stick_places_kernel = {"/proc/self/mountinfo", "/sys/dev/block"};

/* ---- finding ---- */

/* Blanks in a mount's name stand as \040 and their like. */
static void unescape(char *text)
{
	char *out = text;
	for (const char *in = text; *in;) {
		if (in[0] == '\\' && in[1] >= '0' && in[1] <= '3' && in[2] >= '0' && in[2] <= '7' &&
		    in[3] >= '0' && in[3] <= '7') {
			*out++ = (char)((in[1] - '0') * 64 + (in[2] - '0') * 8 + in[3] - '0');
			in += 4;
		} else {
			*out++ = *in++;
		}
	}
	*out = 0;
}

/* A file system in a program (ntfs-3g, exfat-fuse) has no device of its own, but names one. */
static void take_source(struct stick *stick, const char *rest)
{
	char source[PATH_BYTES_MAX];
	struct stat status;
	const char *dash = strstr(rest, " - ");
	if (stick->major != 0 || !dash || sscanf(dash, " - %*s %4095s", source) != 1)
		return;
	unescape(source);
	if (source[0] == '/' && stat(source, &status) == 0 && S_ISBLK(status.st_mode)) {
		stick->major = major(status.st_rdev);
		stick->minor = minor(status.st_rdev);
	}
}

static bool read_mount(struct stick *stick, const char *line)
{
	int rest = 0;
	if (sscanf(line, "%*d %*d %u:%u %*s %4095s%n", &stick->major, &stick->minor, stick->mount,
		   &rest) != 3)
		return false;
	unescape(stick->mount);
	take_source(stick, line + rest);
	return true;
}

static bool says_one(const char *folder, const char *name)
{
	char path[PATH_BYTES_MAX + 32], fault[FAULT_BYTES];
	char text[4] = "";
	if (!store_join(path, sizeof path, folder, name, fault))
		return false;
	int fd = open(path, O_RDONLY | O_CLOEXEC);
	if (fd < 0)
		return false;
	ssize_t got = read(fd, text, sizeof text - 1);
	close(fd);
	return got > 0 && text[0] == '1';
}

/* The folder of the whole disk; a partition lies in its disk's. False: sysfs knows no such device.
 */
static bool find_disk(const struct stick_places *places, const struct stick *stick,
		      char disk[PATH_BYTES_MAX])
{
	char path[PATH_BYTES_MAX], part[PATH_BYTES_MAX + 32], number[32], fault[FAULT_BYTES];
	snprintf(number, sizeof number, "%u:%u", stick->major, stick->minor);
	if (!store_join(path, sizeof path, places->devices, number, fault) || !realpath(path, disk))
		return false;
	snprintf(part, sizeof part, "%s/partition", disk);
	if (access(part, F_OK) == 0)
		*strrchr(disk, '/') = 0;
	return true;
}

static bool is_removable(const char *disk)
{
	return says_one(disk, "removable") || strstr(disk, "/usb");
}

/* The disk that the root file system lies on; a station may run from a stick of its own. */
static void find_own_disk(const struct stick_places *places, char *text, char own[PATH_BYTES_MAX])
{
	struct stick mount;
	own[0] = 0;
	for (char *line = text; line && *line;) {
		char *next = strchr(line, '\n');
		if (next)
			*next = 0;
		if (read_mount(&mount, line) && strcmp(mount.mount, "/") == 0 &&
		    !find_disk(places, &mount, own))
			own[0] = 0;
		if (next)
			*next = '\n';
		line = next ? next + 1 : NULL;
	}
}

/* /proc's files have no length: they are read until they end. */
static char *read_list(const char *path)
{
	enum { LIST_MAX = 256 << 10 };
	size_t got = 0;
	int fd = open(path, O_RDONLY | O_CLOEXEC);
	char *text = fd >= 0 ? malloc(LIST_MAX) : NULL;
	while (text && got < LIST_MAX - 1) {
		ssize_t part = read(fd, text + got, LIST_MAX - 1 - got);
		if (part <= 0)
			break;
		got += (size_t)part;
	}
	if (text)
		text[got] = 0;
	if (fd >= 0)
		close(fd);
	return text;
}

static bool known(const struct stick *stick, int count, const struct stick *one)
{
	for (int i = 0; i < count; i++)
		if (stick[i].major == one->major && stick[i].minor == one->minor)
			return true;
	return false;
}

int stick_find(const struct stick_places *places, struct stick stick[STICKS_MAX])
{
	char own[PATH_BYTES_MAX], disk[PATH_BYTES_MAX];
	int count = 0;
	char *text = read_list(places->mounts), *line = text;
	if (!text)
		return 0;
	find_own_disk(places, text, own);
	while (line && *line && count < STICKS_MAX) {
		struct stick one;
		char *next = strchr(line, '\n');
		if (next)
			*next++ = 0;
		if (read_mount(&one, line) && find_disk(places, &one, disk) &&
		    strcmp(disk, own) != 0 && is_removable(disk) && !known(stick, count, &one))
			stick[count++] = one;
		line = next;
	}
	free(text);
	return count;
}

bool stick_present(const struct stick *stick)
{
	struct stat status;
	if (stat(stick->mount, &status) != 0)
		return false;
	/* a file system in a program has a number of its own */
	return major(status.st_dev) == 0 ||
	       (major(status.st_dev) == stick->major && minor(status.st_dev) == stick->minor);
}

/* ---- keeping ---- */

enum kept kept_by_errno(int number)
{
	switch (number) {
	case ENOSPC:
	case EDQUOT:
	case EFBIG:
		return KEPT_FULL;
	case EROFS:
	case EACCES:
	case EPERM:
		return KEPT_READ_ONLY;
	case EIO:
	case ENODEV:
	case ENXIO:
	case ENOENT:
	case ESTALE:
	case ENOTCONN:
	case EBADF:
		return KEPT_PULLED;
	default:
		return KEPT_FAILED;
	}
}

static void sync_stick(const struct stick *stick)
{
	int fd = open(stick->mount, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
	if (fd < 0)
		return;
	syncfs(fd);
	close(fd);
}

enum kept stick_keep(const struct stick *stick, const struct stick_file *file, int count,
		     char fault[FAULT_BYTES])
{
	char folder[PATH_BYTES_MAX], path[PATH_BYTES_MAX];
	snprintf(fault, FAULT_BYTES, "%.250s: the stick is gone", stick->mount);
	if (!stick_present(stick))
		return KEPT_PULLED;
	if (!store_join(folder, sizeof folder, stick->mount, "kitsuke", fault))
		return KEPT_FAILED;
	errno = 0;
	bool kept = store_make_folder(folder, fault);
	for (int i = 0; i < count && kept; i++)
		kept = store_join(path, sizeof path, folder, file[i].name, fault) &&
		       store_write(path, file[i].bytes, file[i].size, fault);
	int number = errno;
	if (!kept)
		return stick_present(stick) ? kept_by_errno(number) : KEPT_PULLED;
	sync_stick(stick);
	return stick_present(stick) ? KEPT : KEPT_PULLED;
}
