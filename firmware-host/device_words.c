/* See device_words.h. */
#include "device_words.h"

enum { BUS_OF_USB = 3 }; /* linux/input.h */

static bool driver_is(const struct live_node *node, const char *name)
{
	return !strcmp(node->driver, name);
}

static bool is_pen(const struct live_node *node)
{
	return node->layout_count || node->speaks;
}

static void what_words(FILE *out, const struct live_node *node, const struct device_model *model)
{
	fprintf(out, "      is          %s%s", model->display ? "a pen display: " : "", node->text);
	if (model->width_mm > 0.0f)
		fprintf(out, "; libwacom: %.0f x %.0f mm", (double)model->width_mm,
			(double)model->height_mm);
	fputc('\n', out);
}

static void steps_words(FILE *out, const struct pen_recipe *recipe)
{
	static const char *const what[] = {"string", "output", "feature"};
	for (int i = 0; i < recipe->step_count; i++) {
		const struct pen_step *step = &recipe->step[i];
		fprintf(out, "%s%s", i ? ", " : "", what[step->kind]);
		if (step->kind == PEN_STEP_STRING)
			fprintf(out, " %d", step->string_index);
		for (int b = 0; b < step->size; b++)
			fprintf(out, " %02x", step->bytes[b]);
		fputs(step->fallback ? " if need be" : "", out);
	}
}

static void path_words(FILE *out, const struct live_node *node)
{
	fputs("      path        ", out);
	if (node->speaks) {
		const struct pen_recipe *recipe = &node->recipe;
		fprintf(out, "%s, by the shape of its descriptor; it is asked for ",
			recipe->family == PEN_BY_DESCRIPTOR
				? "its report descriptor"
				: pen_family_rule(recipe->family)->name);
		steps_words(out, recipe);
		fputc('\n', out);
	} else if (node->layout_count) {
		fprintf(out,
			"its report descriptor (%d reports with a pen, the first has id %d); %s\n",
			node->layout_count, node->layout[0].report_id, node->protocol);
	} else {
		fprintf(out, "none; %s\n", node->protocol);
	}
}

static void permission_words(FILE *out, const struct live_node *node)
{
	if (!is_pen(node))
		return;
	fprintf(out, "      permission  %s %s", node->path,
		node->readable ? "can be read" : "CANNOT be read");
	if (node->speaks && node->usb_address)
		fprintf(out, ", /dev/bus/usb/%03d/%03d %s", node->usb_bus, node->usb_address,
			node->usb_writable ? "can be asked" : "CANNOT be asked");
	fputc('\n', out);
}

static void driver_words(FILE *out, const struct live_node *node)
{
	const char *effect = "";
	if (driver_is(node, "uclogic"))
		effect =
			", in the way of the maker's protocol: it has set the tablet up itself and "
			"presents it in its own way, which is read";
	else if (driver_is(node, "wacom"))
		effect = ", beside us: it keeps some tablets' first reports back and moves a "
			 "desktop's pointer";
	fprintf(out, "      driver      %s%s\n", node->driver[0] ? node->driver : "unknown",
		effect);
}

/* On another bus no parent has USB's attributes; the HID device's own name tells bus and product.
 */
static void mend_permission_bus(FILE *out, const struct live_node *node, const char *group)
{
	unsigned bus = (unsigned)node->told.bus;
	unsigned vendor = (unsigned)node->told.vendor, product = (unsigned)node->told.product;
	fprintf(out,
		"printf '%%s\n' 'SUBSYSTEM==\"hidraw\", KERNELS==\"%04X:%04X:%04X.*\", "
		"GROUP=\"%s\", MODE=\"0660\"' "
		"| sudo tee /etc/udev/rules.d/70-kitsuke-%04x-%04x.rules "
		"&& sudo udevadm control --reload && sudo udevadm trigger\n",
		bus, vendor, product, group, vendor, product);
}

/* One command: a rule for just this product, hidraw and USB. */
static void mend_permission(FILE *out, const struct live_node *node, const char *group)
{
	unsigned vendor = (unsigned)node->told.vendor, product = (unsigned)node->told.product;
	fprintf(out,
		"printf '%%s\\n' "
		"'SUBSYSTEM==\"hidraw\", ATTRS{idVendor}==\"%04x\", ATTRS{idProduct}==\"%04x\", "
		"GROUP=\"%s\", MODE=\"0660\"' "
		"'SUBSYSTEM==\"usb\", ATTR{idVendor}==\"%04x\", ATTR{idProduct}==\"%04x\", "
		"GROUP=\"%s\", MODE=\"0660\"' "
		"| sudo tee /etc/udev/rules.d/70-kitsuke-%04x-%04x.rules "
		"&& sudo udevadm control --reload && sudo udevadm trigger\n",
		vendor, product, group, vendor, product, group, vendor, product);
}

static void mend_driver(FILE *out, const char *module)
{
	fprintf(out,
		"echo 'install %s /bin/false' | sudo tee /etc/modprobe.d/kitsuke-%s.conf && sudo "
		"modprobe -r %s\n",
		module, module, module);
}

static void mend_words(FILE *out, const struct live_node *node, const char *group)
{
	if (!is_pen(node))
		return;
	fputs("      to mend     ", out);
	if (!node->readable && node->told.bus != BUS_OF_USB)
		mend_permission_bus(out, node, group);
	else if (!node->readable || (node->speaks && node->usb_address && !node->usb_writable))
		mend_permission(out, node, group);
	else if (driver_is(node, "uclogic"))
		mend_driver(out, "hid_uclogic");
	else if (driver_is(node, "wacom"))
		mend_driver(out, "wacom");
	else if (!node->speaks && node->layout[0].width_mm <= 0.0f)
		fputs("its size is not stated: write tablet_mm = WIDTH HEIGHT into the board file, "
		      "see kitsuke help board\n",
		      out);
	else
		fputs("nothing\n", out);
}

void device_words(FILE *out, const struct live_node *node, const struct device_model *model,
		  const char *group)
{
	fprintf(out, "  %s  %04x:%04x  %s", node->path, (unsigned)node->told.vendor,
		(unsigned)node->told.product, node->told.name);
	if (node->interface >= 0)
		fprintf(out, ", interface %d", node->interface);
	fputc('\n', out);
	what_words(out, node, model);
	path_words(out, node);
	permission_words(out, node);
	driver_words(out, node);
	mend_words(out, node, group);
}
