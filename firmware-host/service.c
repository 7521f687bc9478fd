#include "service.h"

#include <stddef.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

/* A name that begins with @ stands for Linux's abstract ones, which begin with a zero. */
static int socket_open(const char *name)
{
	struct sockaddr_un address = {.sun_family = AF_UNIX};
	size_t length = strlen(name);
	if ((name[0] != '/' && name[0] != '@') || length < 2 || length >= sizeof address.sun_path)
		return -1;
	memcpy(address.sun_path, name, length);
	if (name[0] == '@')
		address.sun_path[0] = 0;
	int fd = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
	if (fd >= 0 && connect(fd, (struct sockaddr *)&address,
			       (socklen_t)(offsetof(struct sockaddr_un, sun_path) + length)) < 0) {
		close(fd);
		fd = -1;
	}
	return fd;
}

static int64_t number_of(const char *variable)
{
	const char *text = getenv(variable);
	char *end = NULL;
	long long number = text ? strtoll(text, &end, 10) : 0;
	return text && end != text && !*end && number > 0 ? number : 0;
}

/* A manager that is busy misses a word: the next one comes in time. */
static void say(const struct service *service, const char *line)
{
	if (service->socket >= 0)
		(void)!send(service->socket, line, strlen(line), MSG_NOSIGNAL);
}

void service_open(struct service *service)
{
	const char *name = getenv("NOTIFY_SOCKET");
	int64_t whose = number_of("WATCHDOG_PID");
	*service = (struct service){.socket = name ? socket_open(name) : -1};
	if (service->socket >= 0 && (!whose || whose == getpid()))
		service->period_us = number_of("WATCHDOG_USEC") / 2;
	unsetenv("NOTIFY_SOCKET");
	unsetenv("WATCHDOG_USEC");
	unsetenv("WATCHDOG_PID");
}

void service_frame(struct service *service, int64_t now_us)
{
	if (!service->ready)
		say(service, "READY=1");
	bool due = !service->ready || now_us - service->said_us >= service->period_us;
	service->ready = true;
	if (!service->period_us || !due)
		return;
	say(service, "WATCHDOG=1");
	service->said_us = now_us;
}

void service_close(struct service *service)
{
	say(service, "STOPPING=1");
	if (service->socket >= 0)
		close(service->socket);
	service->socket = -1;
}
