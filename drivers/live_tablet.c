/* The tablets of live.h: opened, made to speak, read, and set up again when they relapse. */
#include "live_private.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <sys/eventfd.h>
#include <unistd.h>

enum {
	RENEW_AFTER_US = 100000, /* reports on their way when a tablet was set up are no relapse */
	RENEW_EVERY_US = 1000000,
	RENEWALS_MAX = 5, /* without a report of the protocol in between */

	/* No hand means more than 2000 places a second; what a stalled ring held comes at once. */
	REPORT_LEAST_US = 500,
	CREDIT_MAX_US = 256 * REPORT_LEAST_US,
};

/* --- tablets ---------------------------------------------------------------------------------- */

/* A tablet that comes back to its place gets its number back; else the first number that no
 * tablet has had, else any that is free. -1: all are in use. */
static int tablet_number(const struct live *live, const char *place)
{
	int unused = -1, idle = -1;
	for (int i = LIVE_TABLETS_MAX - 1; i >= 0; i--) {
		const struct tablet *tablet = &live->tablet[i];
		if (tablet->fd >= 0)
			continue;
		if (!strcmp(tablet->place, place))
			return i;
		idle = i;
		unused = tablet->place[0] ? unused : i;
	}
	return unused >= 0 ? unused : idle;
}

/* What its reports look like from now on, and that the frame loop be told. */
static void tablet_plug_locked(struct live *live, int device)
{
	struct tablet *tablet = &live->tablet[device];
	const struct tape_device *told = &live->told[device];
	char reason[160];
	int count = pen_descriptor_read(told->descriptor, told->descriptor_size, tablet->layout,
					reason);
	tablet->layout_count = pen_layouts_join(tablet->layout, count, &told->speaks);
	tablet->memory = (struct pen_memory){0};
	if (tablet->plugged)
		live_queue(live, device, SIZE_UNPLUGGED, NULL);
	tablet->plugged = tablet->layout_count > 0;
	if (tablet->plugged)
		live_queue(live, device, SIZE_PLUGGED, NULL);
}

static int usb_of(const struct live_node *node)
{
	return node->usb_address ? 1000 * node->usb_bus + node->usb_address : 0;
}

static int tablet_add(struct live *live, int fd, bool own, const struct live_node *node,
		      const struct pen_transport *transport)
{
	pthread_mutex_lock(&live->lock);
	int device = tablet_number(live, node->place);
	if (device >= 0) {
		struct tablet *tablet = &live->tablet[device];
		*tablet = (struct tablet){.fd = fd,
					  .own = own,
					  .sets_up = node->speaks,
					  .job = ++live->jobs,
					  .usb = usb_of(node)};
		memcpy(tablet->path, node->path, sizeof tablet->path);
		memcpy(tablet->place, node->place, sizeof tablet->place);
		live->told[device] = node->told;
		if (node->speaks)
			live_setup_start(live->setup, device, tablet->job, node, transport);
		else
			tablet_plug_locked(live, device);
	}
	pthread_mutex_unlock(&live->lock);
	eventfd_write(live->opened, 1);
	return device;
}

static void tablet_remove(struct live *live, int device)
{
	pthread_mutex_lock(&live->lock);
	struct tablet *tablet = &live->tablet[device];
	if (tablet->own)
		close(tablet->fd);
	tablet->fd = -1;
	tablet->job = 0;
	if (tablet->plugged)
		live_queue(live, device, SIZE_UNPLUGGED, NULL);
	tablet->plugged = false;
	pthread_mutex_unlock(&live->lock);
	live_setup_forget(live->setup, device);
}

/* --- makers' protocols ------------------------------------------------------------------------ */

static bool same_vendor(const struct pen_vendor *a, const struct pen_vendor *b)
{
	return a->family == b->family && a->x_maximum == b->x_maximum &&
	       a->y_maximum == b->y_maximum && a->pressure_maximum == b->pressure_maximum;
}

/* Set up, for the first time or again; or failed, and the descriptor alone must do. */
void live_tablet_set_up(void *context, int device, unsigned job,
			const struct pen_setup_result *result)
{
	struct live *live = context;
	pthread_mutex_lock(&live->lock);
	struct tablet *tablet = &live->tablet[device];
	struct tape_device *told = &live->told[device];
	if (tablet->fd < 0 || tablet->job != job) {
		pthread_mutex_unlock(&live->lock);
		return;
	}
	tablet->renew_at_us = live_clock_us() + RENEW_AFTER_US;
	bool changed = result->done && !same_vendor(&told->speaks, &result->vendor);
	if (result->done) {
		told->speaks = result->vendor;
		if (told->width_mm <= 0.0f && result->width_mm > 0.0f) {
			told->width_mm = result->width_mm;
			told->height_mm = result->height_mm;
		}
	}
	snprintf(tablet->reason, sizeof tablet->reason, "%s", result->done ? "" : result->reason);
	if (changed || !tablet->plugged)
		tablet_plug_locked(live, device);
	pthread_mutex_unlock(&live->lock);
}

/* May it be set up again? Only what spoke a protocol before can have fallen back from it. */
static bool renewal_due_locked(struct live *live, int device, int64_t now_us)
{
	struct tablet *tablet = &live->tablet[device];
	bool due = tablet->fd >= 0 && tablet->sets_up &&
		   live->told[device].speaks.family != PEN_BY_DESCRIPTOR &&
		   now_us >= tablet->renew_at_us && tablet->renewals < RENEWALS_MAX;
	if (due) {
		tablet->renew_at_us = now_us + RENEW_EVERY_US;
		tablet->renewals++;
	}
	return due;
}

/* This tablet's device sent what its default mode sends: whoever set it up does so again. A bit for
 * each such tablet. */
static unsigned relapsed_locked(struct live *live, int device)
{
	int64_t now_us = live_clock_us();
	int usb = live->tablet[device].usb;
	unsigned due = 0;
	for (int i = 0; i < LIVE_TABLETS_MAX; i++)
		if ((i == device || (usb && live->tablet[i].usb == usb)) &&
		    renewal_due_locked(live, i, now_us))
			due |= 1u << i;
	return due;
}

/* Whether a report is the protocol's, or the default mode's: of a layout that the descriptor tells,
 * or a mouse's where all tablets of the family begin as one. */
static unsigned mode_watch_locked(struct live *live, int device, const struct pen_layout *layout,
				  const uint8_t *bytes)
{
	struct tablet *tablet = &live->tablet[device];
	const struct pen_vendor *speaks = &live->told[device].speaks;
	uint8_t default_id = speaks->family != PEN_BY_DESCRIPTOR
				     ? pen_family_rule(speaks->family)->default_id
				     : 0;
	if (layout && layout->vendor.family != PEN_BY_DESCRIPTOR)
		tablet->renewals = 0;
	else if (layout || (default_id && bytes[0] == default_id))
		return relapsed_locked(live, device);
	return 0;
}

/* --- reading ---------------------------------------------------------------------------------- */

static unsigned switches(const struct pen_fields *f)
{
	return 1u | (unsigned)f->tip << 1 | (unsigned)f->in_range << 2 | (unsigned)f->invert << 3 |
	       (unsigned)f->eraser << 4 | (unsigned)f->barrel << 5;
}

/* A flood of places is thinned before the queue, so that none is late and no frame has more of it
 * than of a fast tablet. Whatever begins or ends something is kept. */
static bool report_wanted(struct tablet *tablet, const struct pen_fields *fields, int64_t now_us)
{
	unsigned touch = switches(fields);
	bool turn = touch != tablet->touch;
	int64_t credit_us = tablet->credit_us + now_us - tablet->credited_us;
	tablet->credit_us = credit_us < CREDIT_MAX_US ? credit_us : CREDIT_MAX_US;
	tablet->credited_us = now_us;
	tablet->touch = touch;
	if (!turn && tablet->credit_us < REPORT_LEAST_US)
		return false;
	tablet->credit_us -= turn ? 0 : REPORT_LEAST_US;
	return true;
}

/* Queues a pen's report. Returns the tablets to be set up again, a bit each. */
static unsigned report_take(struct live *live, int device, int size, const uint8_t *bytes)
{
	struct tablet *tablet = &live->tablet[device];
	struct pen_fields fields;
	bool cut_off;
	unsigned again = 0;
	pthread_mutex_lock(&live->lock);
	if (tablet->plugged) {
		const struct pen_layout *layout = pen_report_read(
			tablet->layout, tablet->layout_count, bytes, size, &tablet->memory, &fields,
			&cut_off);
		bool wanted = layout && report_wanted(tablet, &fields, live_clock_us());
		if (wanted)
			live_queue(live, device, size, bytes);
		live->lost += layout && !wanted;
		again = mode_watch_locked(live, device, layout, bytes);
	}
	pthread_mutex_unlock(&live->lock);
	return again;
}

/* Takes what one tablet has ready. Only reports with a pen are kept: the same node may be a
 * keyboard too, and what is typed is nobody's business. */
void live_tablet_read(struct live *live, int device)
{
	struct tablet *tablet = &live->tablet[device];
	for (int i = 0; i < 64; i++) {
		uint8_t bytes[REPORT_BYTES_MAX];
		ssize_t size = read(tablet->fd, bytes, sizeof bytes);
		if (size < 0 && (errno == EAGAIN || errno == EINTR))
			return;
		if (size <= 0) {
			tablet_remove(live, device);
			return;
		}
		unsigned again = report_take(live, device, (int)size, bytes);
		for (int k = 0; k < LIVE_TABLETS_MAX; k++)
			if (again >> k & 1)
				live_setup_again(live->setup, k);
	}
}

static int attach(struct live *live, int fd, struct live_node *node, const char *place,
		  const struct tape_device *told, const struct pen_transport *transport)
{
	int flags = fcntl(fd, F_GETFL);
	fcntl(fd, F_SETFL, flags | O_NONBLOCK);
	node->told = *told;
	snprintf(node->path, sizeof node->path, "%s", place);
	snprintf(node->place, sizeof node->place, "%s", place);
	return tablet_add(live, fd, false, node, transport);
}

int live_attach(struct live *live, int fd, const char *place, const struct tape_device *told)
{
	struct live_node node = {.interface = -1};
	return attach(live, fd, &node, place, told, NULL);
}

int live_attach_setup(struct live *live, int fd, const char *place, int usb,
		      const struct tape_device *told, const struct pen_transport *transport)
{
	struct live_node node = {.interface = -1, .usb_address = usb, .told = *told};
	struct pen_identity identity = live_node_identity(&node);
	node.speaks = pen_identify(&identity, &node.recipe, node.protocol);
	return attach(live, fd, &node, place, told, transport);
}

/* --- searching -------------------------------------------------------------------------------- */

static bool node_wanted(const struct live *live, const struct live_node *node)
{
	const struct board *board = &live->board;
	bool any = !board->tablet_vendor && !board->tablet_product;
	return (node->layout_count || node->speaks) &&
	       (any || (node->told.vendor == board->tablet_vendor &&
			node->told.product == board->tablet_product));
}

/* Is it open already? Where its set-up failed, the node's text says why. */
static bool node_open(struct live *live, struct live_node *node)
{
	bool found = false;
	pthread_mutex_lock(&live->lock);
	for (int i = 0; i < LIVE_TABLETS_MAX; i++) {
		const struct tablet *tablet = &live->tablet[i];
		if (tablet->fd < 0 || strcmp(tablet->path, node->path))
			continue;
		found = true;
		if (tablet->reason[0])
			snprintf(node->text, sizeof node->text, "pen, but not set up: %s",
				 tablet->reason);
	}
	pthread_mutex_unlock(&live->lock);
	return found;
}

static void text_set(struct live *live, const char *name, const char *text)
{
	pthread_mutex_lock(&live->lock);
	snprintf(live->text, sizeof live->text, "%.80s%s%.150s", name, *name ? ": " : "", text);
	pthread_mutex_unlock(&live->lock);
}

/* What libwacom's data adds: a size where neither the board nor the tablet tells one, and whether
 * it is the display, unless the board says. */
static void model_find(struct live *live, struct live_node *node)
{
	bool automatic = live->board.display_auto;
	bool sized = node->told.width_mm > 0.0f || node->speaks || !node->layout_count ||
		     node->layout[0].width_mm > 0.0f;
	if (sized && !automatic)
		return;
	const struct live_model *model = live_model_remembered(&live->models, node);
	node->told.display = automatic && model->known && model->display;
	if (!sized && model->known) {
		node->told.width_mm = model->width_mm;
		node->told.height_mm = model->height_mm;
	}
}

void live_tablets_search(struct live *live)
{
	int count = live_nodes_find(live->nodes, LIVE_NODES_MAX);
	const struct live_node *told = NULL;
	for (int i = 0; i < count; i++) {
		struct live_node *node = &live->nodes[i];
		if (!node_wanted(live, node))
			continue;
		told = told && told->readable ? told : node;
		if (!node->readable || node_open(live, node))
			continue;
		int fd = open(node->path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
		node->told.width_mm = live->board.tablet_width_mm;
		node->told.height_mm = live->board.tablet_height_mm;
		model_find(live, node);
		if (fd >= 0 && tablet_add(live, fd, true, node, NULL) < 0)
			close(fd);
	}
	if (told)
		text_set(live, told->told.name, told->text);
	else
		text_set(live, "",
			 count ? "no pen tablet among the HID devices; `kitsuke devices` "
				 "tells why"
			       : "no HID device is attached");
}
