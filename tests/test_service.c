/* What a service manager hears: ready once, then a word in half of its time, in the end stopping.
 */
#include "service.h"
#include "test.h"

#include <stddef.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

static int manager_open(const char *name)
{
	struct sockaddr_un address = {.sun_family = AF_UNIX};
	size_t length = strlen(name);
	memcpy(address.sun_path, name, length);
	if (name[0] == '@')
		address.sun_path[0] = 0;
	int fd = socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK, 0);
	CHECK(bind(fd, (struct sockaddr *)&address,
		   (socklen_t)(offsetof(struct sockaddr_un, sun_path) + length)) == 0);
	setenv("NOTIFY_SOCKET", name, 1);
	return fd;
}

/* The next word is this one; NULL: there is none. */
static bool hears(int manager, const char *word)
{
	char line[64];
	ssize_t size = recv(manager, line, sizeof line - 1, 0);
	line[size > 0 ? size : 0] = 0;
	return word ? !strcmp(line, word) : size < 0;
}

static void check_words(const char *name)
{
	struct service service;
	int manager = manager_open(name);
	setenv("WATCHDOG_USEC", "3000000", 1);
	service_open(&service);
	CHECK(!getenv("NOTIFY_SOCKET") && !getenv("WATCHDOG_USEC"));
	CHECK(hears(manager, NULL));
	service_frame(&service, 5000000);
	CHECK(hears(manager, "READY=1") && hears(manager, "WATCHDOG=1") && hears(manager, NULL));
	service_frame(&service, 6499999);
	CHECK(hears(manager, NULL));
	service_frame(&service, 6500000);
	CHECK(hears(manager, "WATCHDOG=1") && hears(manager, NULL));
	service_close(&service);
	CHECK(hears(manager, "STOPPING=1"));
	close(manager);
}

/* Another process's watchdog, or a number that is none: ready, and no word more. */
static void check_not_waited_for(const char *name, const char *usec, const char *pid)
{
	struct service service;
	int manager = manager_open(name);
	setenv("WATCHDOG_USEC", usec, 1);
	if (pid)
		setenv("WATCHDOG_PID", pid, 1);
	service_open(&service);
	service_frame(&service, 1);
	service_frame(&service, INT64_C(1) << 40);
	CHECK(hears(manager, "READY=1") && hears(manager, NULL));
	service_close(&service);
	close(manager);
}

static void check_nobody(const char *name)
{
	struct service service;
	setenv("NOTIFY_SOCKET", name, 1);
	setenv("WATCHDOG_USEC", "1000", 1);
	service_open(&service);
	service_frame(&service, 1);
	CHECK(service.socket == -1 && !service.period_us);
	service_close(&service);
}

int main(void)
{
	char folder[TEST_FOLDER_BYTES], path[TEST_FOLDER_BYTES + 16], abstract[64];
	char long_name[200];
	test_folder(folder);
	snprintf(path, sizeof path, "%s/notify", folder);
	snprintf(abstract, sizeof abstract, "@kitsuke-test-%d", (int)getpid());
	check_words(path);
	unlink(path);
	check_words(abstract);
	check_not_waited_for(abstract, "1000", "1");
	check_not_waited_for(abstract, "soon", NULL);
	memset(long_name, 'a', sizeof long_name - 1);
	long_name[0] = '/';
	long_name[sizeof long_name - 1] = 0;
	check_nobody("");
	check_nobody("relative");
	check_nobody(path);
	check_nobody(long_name);
	rmdir(folder);
	return test_end();
}
