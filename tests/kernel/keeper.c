/* Stands for the service manager: starts a station, and feeds the machine's watchdog with its
 * words.
 *
 *   keeper SECONDS COMMAND...
 *
 * From the station's READY=1 on the watchdog bites when no WATCHDOG=1 has come for so many seconds.
 * Prints "ready"; ends with the station and its status, and the watchdog is at rest then. */
#include "play.h"

#include <errno.h>
#include <fcntl.h>
#include <linux/watchdog.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

static int socket_open(const char *path)
{
	struct sockaddr_un address = {.sun_family = AF_UNIX};
	snprintf(address.sun_path, sizeof address.sun_path, "%s", path);
	int fd = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
	unlink(path);
	if (fd < 0 || bind(fd, (struct sockaddr *)&address, sizeof address) < 0)
		play_fail(path);
	return fd;
}

static int watchdog_open(int seconds)
{
	int fd = open("/dev/watchdog", O_WRONLY | O_CLOEXEC);
	if (fd < 0 || ioctl(fd, WDIOC_SETTIMEOUT, &seconds) < 0)
		play_fail("/dev/watchdog");
	return fd;
}

/* V is the driver's word for a wanted end. */
static int finish(int watchdog, int status)
{
	if (watchdog >= 0 && write(watchdog, "V", 1) != 1)
		play_fail("/dev/watchdog");
	return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

static pid_t station;

static void pass_on(int number)
{
	kill(station, number);
}

int main(int argc, char **argv)
{
	if (argc < 3)
		play_complain("usage: keeper SECONDS COMMAND...");
	int seconds = atoi(argv[1]), words = socket_open("/run/notify"), watchdog = -1, status;
	char usec[32];
	snprintf(usec, sizeof usec, "%d000000", seconds);
	setenv("NOTIFY_SOCKET", "/run/notify", 1);
	setenv("WATCHDOG_USEC", usec, 1);
	station = fork();
	if (station == 0) {
		execv(argv[2], argv + 2);
		play_fail(argv[2]);
	}
	signal(SIGTERM, pass_on);
	while (waitpid(station, &status, WNOHANG) == 0) {
		struct pollfd ready = {words, POLLIN, 0};
		char line[256];
		ssize_t size = poll(&ready, 1, 50) == 1 ? recv(words, line, sizeof line - 1, 0) : 0;
		line[size > 0 ? size : 0] = 0;
		if (!strcmp(line, "READY=1")) {
			watchdog = watchdog_open(seconds);
			puts("ready");
			fflush(stdout);
		}
		if (!strcmp(line, "WATCHDOG=1") && watchdog >= 0)
			ioctl(watchdog, WDIOC_KEEPALIVE, 0);
	}
	return finish(watchdog, status);
}
