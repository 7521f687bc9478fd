/* What a hidraw node is: hidapi lists the nodes, the kernel gives driver and descriptor.
 *
 * The descriptor comes from sysfs, which anyone may read, so that a pen is known as one before it
 * is opened, and a keyboard is never opened at all. Where sysfs has none, HIDIOCGRDESC on a
 * descriptor of our own gives it (hidapi 0.13 cannot). Both are what the kernel's driver made of
 * it. */
#include "live.h"

#include <errno.h>
#include <fcntl.h>
#include <hidapi.h>
#include <linux/hidraw.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/ioctl.h>
#include <unistd.h>

static int file_read(const char *path, void *bytes, int capacity)
{
	int fd = open(path, O_RDONLY | O_CLOEXEC);
	if (fd < 0)
		return -1;
	ssize_t size = read(fd, bytes, (size_t)capacity);
	close(fd);
	return (int)size;
}

/* The name that stands behind a link's last slash. */
static void link_name(const char *path, char *name, size_t capacity)
{
	char target[256];
	ssize_t size = readlink(path, target, sizeof target - 1);
	target[size < 0 ? 0 : size] = 0;
	const char *slash = strrchr(target, '/');
	const char *last = slash ? slash + 1 : target;
	size = (ssize_t)strlen(last);
	if ((size_t)size < capacity)
		memcpy(name, last, (size_t)size + 1);
}

static void descriptor_ask(int fd, struct tape_device *told)
{
	struct hidraw_report_descriptor descriptor = {0};
	int size = 0;
	if (ioctl(fd, HIDIOCGRDESCSIZE, &size) < 0 || size < 1 || size > TAPE_DESCRIPTOR_MAX)
		return;
	descriptor.size = (unsigned)size;
	if (ioctl(fd, HIDIOCGRDESC, &descriptor) < 0)
		return;
	memcpy(told->descriptor, descriptor.value, (size_t)size);
	told->descriptor_size = size;
}

static int number_read(const char *base, const char *name, int radix)
{
	char path[160], text[16];
	snprintf(path, sizeof path, "/sys/class/hidraw/%s/device/%s", base, name);
	int size = file_read(path, text, sizeof text - 1);
	text[size < 0 ? 0 : size] = 0;
	return size > 0 ? (int)strtol(text, NULL, radix) : -1;
}

/* A HID device lies within its USB interface, and that within the USB device. */
static void usb_read(const char *base, struct live_node *node)
{
	node->interface = number_read(base, "../bInterfaceNumber", 16);
	node->usb_bus = int_max(0, number_read(base, "../../busnum", 10));
	node->usb_address = int_max(0, number_read(base, "../../devnum", 10));
}

/* The bus, and where on it. */
static void uevent_read(const char *base, struct live_node *node)
{
	char path[160], text[512], *line;
	unsigned bus;
	snprintf(path, sizeof path, "/sys/class/hidraw/%s/device/uevent", base);
	int size = file_read(path, text, sizeof text - 1);
	text[size < 0 ? 0 : size] = 0;
	line = strstr(text, "HID_ID=");
	if (line && sscanf(line + 7, "%4x", &bus) == 1)
		node->told.bus = (int)bus;
	line = strstr(text, "HID_PHYS=");
	int length = line ? (int)strcspn(line + 9, "\n") : 0;
	snprintf(node->place, sizeof node->place, "%.*s", length, line ? line + 9 : "");
	if (!node->place[0])
		snprintf(node->place, sizeof node->place, "%s", node->path);
}

struct pen_identity live_node_identity(const struct live_node *node)
{
	return (struct pen_identity){
		.bus = node->told.bus,
		.vendor = node->told.vendor,
		.product = node->told.product,
		.driver = node->driver,
		.descriptor = node->told.descriptor,
		.descriptor_size = node->told.descriptor_size,
	};
}

/* --- in words --------------------------------------------------------------------------------- */

static void text_pen(struct live_node *node)
{
	const struct pen_layout *l = &node->layout[0];
	char size[64] = "size not stated: set tablet_mm in the board file";
	if (l->width_mm > 0.0f)
		snprintf(size, sizeof size, "%.1f x %.1f mm", (double)l->width_mm,
			 (double)l->height_mm);
	snprintf(node->text, LIVE_TEXT_MAX, "pen: %d x %d units, %d levels of pressure, %s%s%s%s",
		 l->x.maximum - l->x.minimum, l->y.maximum - l->y.minimum,
		 l->pressure.size ? l->pressure.maximum - l->pressure.minimum + 1 : 0,
		 l->tilt_x.size ? "tilt, " : "", size,
		 l->absolute_mouse ? ", calls itself a mouse" : "",
		 !strcmp(node->driver, "wacom") || !strcmp(node->driver, "uclogic")
			 ? ", as the kernel driver bound to it presents it"
			 : "");
}

static void node_words(struct live_node *node, const char *reason, int error)
{
	bool pen = node->layout_count || node->speaks;
	if (pen && error == EACCES)
		snprintf(node->text, LIVE_TEXT_MAX,
			 "pen, but permission denied; a udev rule must give this user's group %s",
			 node->path);
	else if (pen && !node->readable)
		snprintf(node->text, LIVE_TEXT_MAX, "pen, but it cannot be opened: %s",
			 strerror(error));
	else if (node->speaks)
		snprintf(node->text, LIVE_TEXT_MAX, "pen: %.150s%s", node->protocol,
			 node->usb_writable ? "" : ", but permission denied on its USB device");
	else if (node->layout_count)
		text_pen(node);
	else if (!node->told.descriptor_size)
		snprintf(node->text, LIVE_TEXT_MAX, "its report descriptor cannot be read: %s",
			 strerror(error));
	else
		snprintf(node->text, LIVE_TEXT_MAX, "no pen: %s", reason);
	if (!pen && !strcmp(node->driver, "wacom"))
		snprintf(node->text, LIVE_TEXT_MAX,
			 "no pen by its descriptor (kernel driver wacom): %s", reason);
}

/* --- nodes ------------------------------------------------------------------------------------ */

static void descriptor_read(struct live_node *node, char reason[160])
{
	struct pen_identity identity = live_node_identity(node);
	node->layout_count = pen_descriptor_read(node->told.descriptor, node->told.descriptor_size,
						 node->layout, reason);
	node->speaks = pen_identify(&identity, &node->recipe, node->protocol);
}

/* Strings are read from the USB device's own node. */
static bool usb_writable(const struct live_node *node)
{
	char path[64];
	snprintf(path, sizeof path, "/dev/bus/usb/%03d/%03d", node->usb_bus, node->usb_address);
	for (int i = 0; i < node->recipe.step_count; i++)
		if (node->recipe.step[i].kind == PEN_STEP_STRING)
			return access(path, R_OK | W_OK) == 0;
	return true;
}

static void node_inspect(struct live_node *node)
{
	char path[160], reason[160] = "";
	const char *base = strrchr(node->path, '/');
	base = base ? base + 1 : node->path;
	snprintf(path, sizeof path, "/sys/class/hidraw/%s/device/driver", base);
	link_name(path, node->driver, sizeof node->driver);
	uevent_read(base, node);
	usb_read(base, node);
	snprintf(path, sizeof path, "/sys/class/hidraw/%s/device/report_descriptor", base);
	node->told.descriptor_size = int_max(
		0, file_read(path, node->told.descriptor, TAPE_DESCRIPTOR_MAX));
	bool known = node->told.descriptor_size > 0;
	if (known)
		descriptor_read(node, reason);
	int error = 0;
	if (!known || node->layout_count || node->speaks) {
		int fd = open(node->path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
		error = fd < 0 ? errno : 0;
		node->readable = fd >= 0;
		if (fd >= 0 && !known)
			descriptor_ask(fd, &node->told);
		if (fd >= 0)
			close(fd);
	}
	if (!known && node->told.descriptor_size)
		descriptor_read(node, reason);
	node->usb_writable = node->speaks && usb_writable(node);
	node_words(node, reason, error);
}

/* wchar_t to UTF-8's printable ASCII: the name is for messages and tapes only. */
static void name_copy(char *name, size_t capacity, const wchar_t *maker, const wchar_t *product)
{
	bool both = maker && *maker && product && *product;
	const wchar_t *parts[] = {maker, both ? L" " : NULL, product};
	size_t at = 0;
	for (int i = 0; i < COUNT_OF(parts); i++)
		for (const wchar_t *c = parts[i]; c && *c && at + 1 < capacity; c++)
			name[at++] = *c >= 32 && *c < 127 ? (char)*c : '?';
	name[at] = 0;
}

static struct live_node *node_known(struct live_node *nodes, int count, const char *path)
{
	for (int i = 0; i < count; i++)
		if (!strcmp(nodes[i].path, path))
			return &nodes[i];
	return NULL;
}

int live_nodes_find(struct live_node *nodes, int capacity)
{
	int count = 0;
	struct hid_device_info *all = hid_enumerate(0, 0);
	for (struct hid_device_info *info = all; info && count < capacity; info = info->next) {
		/* hidapi lists a node once for each of its usages */
		if (!info->path || node_known(nodes, count, info->path))
			continue;
		struct live_node *node = &nodes[count++];
		*node = (struct live_node){.told.used = true,
					   .told.bus = 3,
					   .told.vendor = info->vendor_id,
					   .told.product = info->product_id};
		snprintf(node->path, sizeof node->path, "%s", info->path);
		name_copy(node->told.name, sizeof node->told.name, info->manufacturer_string,
			  info->product_string);
		node_inspect(node);
	}
	hid_free_enumeration(all);
	return count;
}
