/* What a service manager hears of the station: sd_notify's protocol, lines in a datagram.
 *
 *   NOTIFY_SOCKET   where to; without it nobody listens
 *   WATCHDOG_USEC   how long the manager waits for a word before it takes the station for dead
 *   WATCHDOG_PID    whose words it waits for; without it ours
 */
#ifndef SERVICE_H
#define SERVICE_H

#include "base.h"

struct service {
	int socket;        /* -1: nobody listens */
	int64_t period_us; /* between words; 0: nobody waits for them */
	int64_t said_us;   /* the last word, on CLOCK_MONOTONIC */
	bool ready;
};

/* Reads the environment, and takes these names out of it: they are for this process only. */
void service_open(struct service *service);

/* To be called after each frame: says once that the station is ready, and then in half of the
 * manager's time that it lives. Who calls it has collected reports, moved the cloth and shown the
 * picture, or knows that there is no display; a thread of its own would tell less. */
void service_frame(struct service *service, int64_t now_us);

/* Says that the end is wanted. */
void service_close(struct service *service);

#endif
