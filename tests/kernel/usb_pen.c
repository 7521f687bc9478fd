/* A pen tablet on the USB: device 0 of a tape, through raw-gadget on the dummy host controller.
 *
 *   usb_pen TAPE [--string INDEX HEX]... [--mute-until INDEX]
 *
 * Plugged in from the start to the end of this program. It plays the tape when a line comes on
 * stdin; --string gives what a string descriptor answers beside those of every device;
 * --mute-until: not before the host has asked for that string, as tablets do that have to be
 * switched to their own protocol. Prints each of those strings when it is asked for, and
 * how long that was after the host had configured us. */
#include "play.h"

#include <errno.h>
#include <fcntl.h>
#include <linux/hid.h>
#include <linux/usb/ch9.h>
#include <linux/usb/raw_gadget.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/ioctl.h>
#include <unistd.h>

enum { STRINGS_MAX = 8, STRING_BYTES_MAX = 254, PACKET_MAX = 4096, REPORT_PACKET = 64 };
enum { STRING_LANGUAGES, STRING_MAKER, STRING_PRODUCT, STRING_SERIAL };

struct answer {
	int index, size;
	uint8_t bytes[STRING_BYTES_MAX];
};

struct pen {
	int fd;
	struct tape tape;
	struct answer answer[STRINGS_MAX];
	int answer_count, mute_until; /* 0: speaks at once */
	int endpoint;                 /* -1: the host has not configured us yet */
	int64_t configured_us;

	pthread_mutex_t lock;
	pthread_cond_t changed;
	bool go, spoken_to;
};

/* raw-gadget's two structures with the bytes that follow them. */
union control {
	struct usb_raw_event event;
	uint8_t room[sizeof(struct usb_raw_event) + sizeof(struct usb_ctrlrequest)];
};

union packet {
	struct usb_raw_ep_io io;
	uint8_t room[sizeof(struct usb_raw_ep_io) + PACKET_MAX];
};

/* --- descriptors ------------------------------------------------------------------------------ */

struct __attribute__((packed)) hid_descriptor {
	uint8_t length, type;
	uint16_t version;
	uint8_t country, count, report_type;
	uint16_t report_size;
};

struct __attribute__((packed)) configuration {
	struct usb_config_descriptor config;
	struct usb_interface_descriptor interface;
	struct hid_descriptor hid;
	struct __attribute__((packed)) {
		uint8_t length, type, address, attributes;
		uint16_t packet;
		uint8_t interval;
	} endpoint;
};

static int device_descriptor(const struct pen *pen, uint8_t *to)
{
	const struct tape_device *told = &pen->tape.device[0];
	struct usb_device_descriptor device = {
		.bLength = USB_DT_DEVICE_SIZE,
		.bDescriptorType = USB_DT_DEVICE,
		.bcdUSB = 0x0200,
		.bMaxPacketSize0 = 64,
		.idVendor = (uint16_t)told->vendor,
		.idProduct = (uint16_t)told->product,
		.bcdDevice = 0x0100,
		.iManufacturer = STRING_MAKER,
		.iProduct = STRING_PRODUCT,
		.iSerialNumber = STRING_SERIAL,
		.bNumConfigurations = 1,
	};
	memcpy(to, &device, USB_DT_DEVICE_SIZE);
	return USB_DT_DEVICE_SIZE;
}

static int configuration_descriptor(const struct pen *pen, uint8_t *to)
{
	struct configuration all = {
		.config = {.bLength = USB_DT_CONFIG_SIZE,
			   .bDescriptorType = USB_DT_CONFIG,
			   .wTotalLength = sizeof all,
			   .bNumInterfaces = 1,
			   .bConfigurationValue = 1,
			   .bmAttributes = USB_CONFIG_ATT_ONE,
			   .bMaxPower = 50},
		.interface = {.bLength = USB_DT_INTERFACE_SIZE,
			      .bDescriptorType = USB_DT_INTERFACE,
			      .bNumEndpoints = 1,
			      .bInterfaceClass = USB_CLASS_HID},
		.hid = {.length = sizeof(struct hid_descriptor),
			.type = HID_DT_HID,
			.version = 0x0111,
			.count = 1,
			.report_type = HID_DT_REPORT,
			.report_size = (uint16_t)pen->tape.device[0].descriptor_size},
		.endpoint = {USB_DT_ENDPOINT_SIZE, USB_DT_ENDPOINT, USB_DIR_IN | 1,
			     USB_ENDPOINT_XFER_INT, REPORT_PACKET, 4},
	};
	memcpy(to, &all, sizeof all);
	return (int)sizeof all;
}

static int text_descriptor(const char *text, uint8_t *to)
{
	int size = 2;
	for (; *text && size < STRING_BYTES_MAX; text++) {
		to[size++] = (uint8_t)*text;
		to[size++] = 0;
	}
	to[0] = (uint8_t)size;
	to[1] = USB_DT_STRING;
	return size;
}

static void asked(struct pen *pen, int index)
{
	printf("asked for string %d, %.0f ms after it was configured\n", index,
	       1e-3 * (double)(play_clock_us() - pen->configured_us));
	fflush(stdout);
	pthread_mutex_lock(&pen->lock);
	pen->spoken_to |= index == pen->mute_until;
	pthread_cond_broadcast(&pen->changed);
	pthread_mutex_unlock(&pen->lock);
}

static int string_descriptor(struct pen *pen, int index, uint8_t *to)
{
	static const uint8_t english[] = {4, USB_DT_STRING, 0x09, 0x04};
	for (int i = 0; i < pen->answer_count; i++)
		if (pen->answer[i].index == index) {
			memcpy(to, pen->answer[i].bytes, (size_t)pen->answer[i].size);
			asked(pen, index);
			return pen->answer[i].size;
		}
	switch (index) {
	case STRING_LANGUAGES:
		memcpy(to, english, sizeof english);
		return sizeof english;
	case STRING_MAKER:
		return text_descriptor("Kernel bench", to);
	case STRING_PRODUCT:
		return text_descriptor(pen->tape.device[0].name, to);
	case STRING_SERIAL:
		return text_descriptor("1", to);
	default:
		return -1;
	}
}

/* --- control transfers ------------------------------------------------------------------------ */

static void configure(struct pen *pen)
{
	struct usb_endpoint_descriptor in = {.bLength = USB_DT_ENDPOINT_SIZE,
					     .bDescriptorType = USB_DT_ENDPOINT,
					     .bEndpointAddress = USB_DIR_IN | 1,
					     .bmAttributes = USB_ENDPOINT_XFER_INT,
					     .wMaxPacketSize = REPORT_PACKET,
					     .bInterval = 4};
	int endpoint = ioctl(pen->fd, USB_RAW_IOCTL_EP_ENABLE, &in);
	if (endpoint < 0 || ioctl(pen->fd, USB_RAW_IOCTL_VBUS_DRAW, 50) < 0 ||
	    ioctl(pen->fd, USB_RAW_IOCTL_CONFIGURE, 0) < 0)
		play_fail("raw-gadget: configuring");
	pthread_mutex_lock(&pen->lock);
	pen->endpoint = endpoint;
	pen->configured_us = play_clock_us();
	pthread_cond_broadcast(&pen->changed);
	pthread_mutex_unlock(&pen->lock);
}

static int descriptor(struct pen *pen, const struct usb_ctrlrequest *request, uint8_t *to)
{
	const struct tape_device *told = &pen->tape.device[0];
	switch (request->wValue >> 8) {
	case USB_DT_DEVICE:
		return device_descriptor(pen, to);
	case USB_DT_CONFIG:
		return configuration_descriptor(pen, to);
	case USB_DT_STRING:
		return string_descriptor(pen, request->wValue & 255, to);
	case HID_DT_REPORT:
		memcpy(to, told->descriptor, (size_t)told->descriptor_size);
		return told->descriptor_size;
	default:
		return -1;
	}
}

/* The size of the answer; -1: refused. */
static int control_answer(struct pen *pen, const struct usb_ctrlrequest *request, uint8_t *to)
{
	bool standard = (request->bRequestType & USB_TYPE_MASK) == USB_TYPE_STANDARD;
	bool class = (request->bRequestType & USB_TYPE_MASK) == USB_TYPE_CLASS;
	if (standard && request->bRequest == USB_REQ_GET_DESCRIPTOR)
		return descriptor(pen, request, to);
	if (standard && request->bRequest == USB_REQ_SET_CONFIGURATION) {
		configure(pen);
		return 0;
	}
	if (standard && request->bRequest == USB_REQ_SET_INTERFACE)
		return 0;
	/* SET_IDLE, SET_PROTOCOL, SET_REPORT: taken, without effect */
	return class && !(request->bRequestType & USB_DIR_IN) ? request->wLength : -1;
}

static void control_take(struct pen *pen, const struct usb_ctrlrequest *request)
{
	static union packet packet;
	int size = control_answer(pen, request, packet.room + sizeof packet.io);
	packet.io = (struct usb_raw_ep_io){
		.length = (uint32_t)(size < request->wLength ? size : request->wLength)};
	int result = 0;
	if (size < 0)
		result = ioctl(pen->fd, USB_RAW_IOCTL_EP0_STALL, 0);
	else if (request->bRequestType & USB_DIR_IN)
		result = ioctl(pen->fd, USB_RAW_IOCTL_EP0_WRITE, &packet);
	else
		result = ioctl(pen->fd, USB_RAW_IOCTL_EP0_READ, &packet);
	if (result < 0 && errno != EBUSY && errno != ESHUTDOWN && errno != EINTR)
		play_fail("raw-gadget: answering");
}

static void *control_main(void *argument)
{
	struct pen *pen = argument;
	for (;;) {
		union control control = {.event.length = sizeof(struct usb_ctrlrequest)};
		struct usb_ctrlrequest request;
		if (ioctl(pen->fd, USB_RAW_IOCTL_EVENT_FETCH, &control) < 0)
			play_fail("raw-gadget: the next event");
		memcpy(&request, control.room + sizeof control.event, sizeof request);
		if (control.event.type == USB_RAW_EVENT_CONTROL)
			control_take(pen, &request);
	}
	return NULL;
}

/* --- the tape --------------------------------------------------------------------------------- */

static void *go_main(void *argument)
{
	struct pen *pen = argument;
	while (getchar() != '\n')
		;
	pthread_mutex_lock(&pen->lock);
	pen->go = true;
	pthread_cond_broadcast(&pen->changed);
	pthread_mutex_unlock(&pen->lock);
	return NULL;
}

static void report_send(const struct pen *pen, const struct tape_event *event)
{
	static union packet packet;
	packet.io = (struct usb_raw_ep_io){.ep = (uint16_t)pen->endpoint,
					   .length = (uint32_t)event->size};
	memcpy(packet.room + sizeof packet.io, pen->tape.bytes + event->offset,
	       (size_t)event->size);
	if (ioctl(pen->fd, USB_RAW_IOCTL_EP_WRITE, &packet) < 0)
		play_fail("raw-gadget: a report");
}

static void tape_play(struct pen *pen)
{
	pthread_mutex_lock(&pen->lock);
	while (pen->endpoint < 0 || !pen->go || (pen->mute_until && !pen->spoken_to))
		pthread_cond_wait(&pen->changed, &pen->lock);
	pthread_mutex_unlock(&pen->lock);
	int64_t start_us = play_clock_us();
	for (size_t i = 0; i < pen->tape.event_count; i++) {
		const struct tape_event *event = &pen->tape.event[i];
		if (event->device != 0 || !event->size)
			continue;
		play_sleep_until(start_us + event->time_us - pen->tape.event[0].time_us);
		report_send(pen, event);
	}
	puts("played");
	fflush(stdout);
	play_sleep_until(play_clock_us() + 300000);
}

static void plug(struct pen *pen)
{
	struct usb_raw_init init = {
		.driver_name = "dummy_udc", .device_name = "dummy_udc.0", .speed = USB_SPEED_HIGH};
	pen->fd = open("/dev/raw-gadget", O_RDWR | O_CLOEXEC);
	if (pen->fd < 0 || ioctl(pen->fd, USB_RAW_IOCTL_INIT, &init) < 0 ||
	    ioctl(pen->fd, USB_RAW_IOCTL_RUN, 0) < 0)
		play_fail("/dev/raw-gadget");
}

static void answer_add(struct pen *pen, const char *index, const char *hex)
{
	if (pen->answer_count == STRINGS_MAX)
		play_complain("at most %d strings", STRINGS_MAX);
	struct answer *answer = &pen->answer[pen->answer_count++];
	unsigned byte;
	answer->index = atoi(index);
	for (; answer->size < STRING_BYTES_MAX && sscanf(hex, "%2x", &byte) == 1; hex += 2)
		answer->bytes[answer->size++] = (uint8_t)byte;
}

int main(int argc, char **argv)
{
	static struct pen pen = {.endpoint = -1};
	pthread_t control, go;
	if (argc < 2)
		play_complain("usage: usb_pen TAPE [--string INDEX HEX]... [--mute-until INDEX]");
	play_tape_load(&pen.tape, argv[1]);
	for (int i = 2; i < argc; i++)
		if (!strcmp(argv[i], "--string") && i + 2 < argc) {
			answer_add(&pen, argv[i + 1], argv[i + 2]);
			i += 2;
		} else if (!strcmp(argv[i], "--mute-until") && i + 1 < argc) {
			pen.mute_until = atoi(argv[++i]);
		}
	pthread_mutex_init(&pen.lock, NULL);
	pthread_cond_init(&pen.changed, NULL);
	plug(&pen);
	if (pthread_create(&control, NULL, control_main, &pen) ||
	    pthread_create(&go, NULL, go_main, &pen))
		play_complain("no thread");
	tape_play(&pen);
	return 0;
}
