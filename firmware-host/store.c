#include "store.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

static bool fail(char fault[FAULT_BYTES], const char *path, const char *what)
{
	snprintf(fault, FAULT_BYTES, "%.250s: %s", path, what);
	return false;
}

static bool fail_errno(char fault[FAULT_BYTES], const char *path, const char *verb)
{
	snprintf(fault, FAULT_BYTES, "%.250s: %s: %s", path, verb, strerror(errno));
	return false;
}

/* ---- reading ---- */

static bool read_all(int fd, char *bytes, size_t size, size_t *got)
{
	for (*got = 0; *got < size;) {
		ssize_t part = read(fd, bytes + *got, size - *got);
		if (part < 0 && errno == EINTR)
			continue;
		if (part < 0)
			return false;
		if (part == 0)
			break;
		*got += (size_t)part;
	}
	return true;
}

char *store_read(const char *path, size_t *size, char fault[FAULT_BYTES])
{
	char *bytes = NULL;
	struct stat status;
	int fd = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
	if (fd < 0) {
		fail_errno(fault, path, "can't be opened");
		return NULL;
	}
	if (fstat(fd, &status) != 0)
		fail_errno(fault, path, "can't be read");
	else if (!S_ISREG(status.st_mode))
		fail(fault, path, "is no regular file; name a file");
	else if (status.st_size > STORE_BYTES_MAX)
		fail(fault, path, "is longer than 256 MB; no file that kitsuke reads is");
	else if (!(bytes = malloc((size_t)status.st_size + 1)))
		fail(fault, path, "does not fit in memory");
	else if (!read_all(fd, bytes, (size_t)status.st_size, size)) {
		fail_errno(fault, path, "can't be read");
		free(bytes);
		bytes = NULL;
	} else {
		bytes[*size] = 0;
	}
	close(fd);
	return bytes;
}

/* ---- writing ---- */

static bool write_all(int fd, const char *bytes, size_t size)
{
	for (size_t done = 0; done < size;) {
		ssize_t part = write(fd, bytes + done, size - done);
		if (part < 0 && errno != EINTR)
			return false;
		done += part > 0 ? (size_t)part : 0;
	}
	return true;
}

static bool write_in_place(const char *path, const void *bytes, size_t size,
			   char fault[FAULT_BYTES])
{
	int fd = open(path, O_WRONLY | O_CLOEXEC);
	if (fd < 0)
		return fail_errno(fault, path, "can't be opened for writing");
	bool written = write_all(fd, bytes, size);
	if (!written)
		fail_errno(fault, path, "can't be written");
	close(fd);
	return written;
}

/* The name is only durable when its folder is. */
static void sync_folder(const char *path)
{
	char folder[PATH_BYTES_MAX];
	const char *name = store_name(path);
	int length = (int)(name - path);
	snprintf(folder, sizeof folder, "%.*s", length ? length : 1, length ? path : ".");
	int fd = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
	if (fd < 0)
		return;
	fsync(fd); /* some file systems can't; the rename itself has succeeded */
	close(fd);
}

bool store_write(const char *path, const void *bytes, size_t size, char fault[FAULT_BYTES])
{
	struct stat status;
	if (stat(path, &status) == 0 && !S_ISREG(status.st_mode)) {
		if (S_ISDIR(status.st_mode))
			return fail(fault, path, "is a folder; name a file in it");
		return write_in_place(path, bytes, size, fault);
	}
	char part[PATH_BYTES_MAX];
	if (snprintf(part, sizeof part, "%s.part-%ld", path, (long)getpid()) >= (int)sizeof part)
		return fail(fault, path, "is too long a name");
	int fd = open(part, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW, 0666);
	if (fd < 0)
		return fail_errno(fault, path, "can't be written");
	bool written = write_all(fd, bytes, size) && fsync(fd) == 0;
	int number = errno;
	if (!written)
		fail_errno(fault, path, "can't be written");
	close(fd);
	if (written && rename(part, path) != 0) {
		number = errno;
		written = fail_errno(fault, path, "can't be replaced");
	}
	if (!written)
		unlink(part);
	else
		sync_folder(path);
	errno = number;
	return written;
}

bool store_make_folder(const char *path, char fault[FAULT_BYTES])
{
	struct stat status;
	if (mkdir(path, 0777) == 0 ||
	    (errno == EEXIST && stat(path, &status) == 0 && S_ISDIR(status.st_mode)))
		return true;
	return fail_errno(fault, path, "can't be made a folder");
}

bool store_join(char *path, size_t path_size, const char *folder, const char *name,
		char fault[FAULT_BYTES])
{
	int length = snprintf(path, path_size, "%s/%s", folder, name);
	return length >= 0 && (size_t)length < path_size ? true
							 : fail(fault, name, "is too long a name");
}

const char *store_name(const char *path)
{
	const char *slash = strrchr(path, '/');
	return slash ? slash + 1 : path;
}
