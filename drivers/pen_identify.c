/* Shapes of descriptors, and the recipes for them; see pen_identify.h. */
#include "pen_identify.h"
#include "pen_items.h"

#include <stdio.h>

enum {
	PAGE_UCLOGIC = 0xff00,
	PAGE_UGEE = 0xff0a, /* VEIKK's too */
	BUS_USB = 3,
	VENDOR_WACOM = 0x056a,
	VENDOR_UCLOGIC = 0x5543,
	PRODUCT_DECO_02 = 0x0803,
};

/* --- shapes ----------------------------------------------------------------------------------- */

static struct pen_shape_report *shape_report(struct pen_shape *shape, int id)
{
	for (int i = 0; i < shape->count; i++)
		if (shape->report[i].id == id)
			return &shape->report[i];
	if (shape->count == PEN_SHAPE_REPORTS_MAX)
		return NULL;
	shape->report[shape->count] = (struct pen_shape_report){.id = (uint8_t)id};
	return &shape->report[shape->count++];
}

static int bytes_of(uint32_t bits, bool ids_used)
{
	return bits ? (int)((bits + 7) / 8) + ids_used : 0;
}

void pen_shape_read(struct pen_shape *shape, const uint8_t *descriptor, int size)
{
	struct items items;
	enum items_event event = ITEMS_END;
	char reason[160];
	*shape = (struct pen_shape){0};
	if (size < 1 || size > DESCRIPTOR_BYTES_MAX)
		return;
	pen_items_init(&items, descriptor, size, reason);
	while ((event = pen_items_next(&items)) == ITEMS_INPUT) {
		struct pen_shape_report *report = shape_report(shape, items.global.report_id);
		if (report)
			report->application = items.application;
	}
	if (event == ITEMS_FAULT)
		shape->count = 0;
	for (int i = 0; i < 256 && event == ITEMS_END; i++) {
		bool declared = items.input_bits[i] || items.output_bits[i] ||
				items.feature_bits[i];
		struct pen_shape_report *report = declared ? shape_report(shape, i) : NULL;
		if (!report)
			continue;
		report->input_bytes = bytes_of(items.input_bits[i], items.ids_used);
		report->output_bytes = bytes_of(items.output_bits[i], items.ids_used);
		report->feature_bytes = bytes_of(items.feature_bits[i], items.ids_used);
	}
}

/* The input report with this id on this page (0: any) that has so many bytes; NULL: none. */
static const struct pen_shape_report *shape_find(const struct pen_shape *shape, int id,
						 uint32_t page, int least, int most)
{
	for (int i = 0; i < shape->count; i++) {
		const struct pen_shape_report *report = &shape->report[i];
		if (report->id == id && (!page || report->application >> 16 == page) &&
		    report->input_bytes >= least && report->input_bytes <= most)
			return report;
	}
	return NULL;
}

static bool shape_feature(const struct pen_shape *shape, int id, int bytes)
{
	for (int i = 0; i < shape->count; i++)
		if (shape->report[i].id == id && shape->report[i].feature_bytes == bytes)
			return true;
	return false;
}

/* --- models ----------------------------------------------------------------------------------- */

bool pen_model_is(const struct pen_model *model, const struct pen_identity *identity,
		  enum pen_family family)
{
	return model->vendor == identity->vendor && model->product == identity->product &&
	       model->family == family;
}

/* Some row of this tablet in a Wacom family. */
static enum pen_family wacom_family(const struct pen_identity *identity)
{
	for (int i = 0; i < pen_model_count; i++) {
		const struct pen_model *model = &pen_models[i];
		if (model->family >= PEN_PENPARTNER && model->family <= PEN_PTU &&
		    pen_model_is(model, identity, (enum pen_family)model->family))
			return (enum pen_family)model->family;
	}
	return PEN_BY_DESCRIPTOR;
}

/* --- recipes ---------------------------------------------------------------------------------- */

static void step_add(struct pen_recipe *recipe, struct pen_step step)
{
	if (recipe->step_count < PEN_STEPS_MAX)
		recipe->step[recipe->step_count++] = step;
}

static void string_add(struct pen_recipe *recipe, int index, bool fallback)
{
	for (int i = 0; i < recipe->step_count; i++)
		if (recipe->step[i].kind == PEN_STEP_STRING &&
		    recipe->step[i].string_index == index)
			return;
	step_add(recipe, (struct pen_step){.kind = PEN_STEP_STRING,
					   .fallback = fallback,
					   .string_index = (uint8_t)index});
}

static void bytes_add(struct pen_recipe *recipe, enum pen_step_kind kind, bool wanted, int size,
		      const uint8_t *bytes)
{
	struct pen_step step = {.kind = kind, .wanted = wanted, .size = (uint8_t)size};
	memcpy(step.bytes, bytes, (size_t)size);
	step_add(recipe, step);
}

/* Reading these strings in this order is what Windows' driver does; it switches the tablet. */
static void recipe_uclogic(struct pen_recipe *recipe, const struct pen_shape_report *report,
			   bool second)
{
	recipe->family = second ? PEN_UCLOGIC_2 : PEN_UCLOGIC_1;
	recipe->report_bytes = report->input_bytes;
	string_add(recipe, 201, false);
	string_add(recipe, 200, false);
	string_add(recipe, 202, false);
	string_add(recipe, 100, second);
	string_add(recipe, 123, second);
}

static void strings_of_models(struct pen_recipe *recipe, const struct pen_identity *identity)
{
	for (int i = 0; i < pen_model_count; i++)
		if (pen_models[i].string_index &&
		    pen_model_is(&pen_models[i], identity, recipe->family))
			string_add(recipe, pen_models[i].string_index, false);
}

static void recipe_ugee(struct pen_recipe *recipe, const struct pen_identity *identity,
			const struct pen_shape_report *report)
{
	static const uint8_t older[] = {2, 0xb0, 2}, newer[] = {2, 0xb0, 4};
	bool old = report->input_bytes < 10 || identity->product == PRODUCT_DECO_02;
	recipe->family = PEN_UGEE_2;
	recipe->report_bytes = report->input_bytes;
	recipe->output_bytes = report->output_bytes ? report->output_bytes : 10;
	bytes_add(recipe, PEN_STEP_OUTPUT, true, 3, old ? older : newer);
	string_add(recipe, 100, false);
	strings_of_models(recipe, identity);
}

static void recipe_veikk(struct pen_recipe *recipe, const struct pen_identity *identity,
			 const struct pen_shape_report *report)
{
	static const uint8_t acepen[] = {9, 0x0a, 0xe1, 0x4a, 0, 0, 0x6c, 0x3d, 0};
	static const uint8_t pen[] = {9, 1, 4}, buttons[] = {9, 2, 2}, pad[] = {9, 3, 2};
	recipe->family = PEN_VEIKK;
	recipe->report_bytes = report->input_bytes;
	recipe->output_bytes = report->output_bytes ? report->output_bytes : 9;
	if (identity->vendor == VENDOR_UCLOGIC)
		bytes_add(recipe, PEN_STEP_OUTPUT, true, 9, acepen);
	bytes_add(recipe, PEN_STEP_OUTPUT, true, 3, pen);
	bytes_add(recipe, PEN_STEP_OUTPUT, false, 3, buttons);
	if (identity->vendor != VENDOR_UCLOGIC)
		bytes_add(recipe, PEN_STEP_OUTPUT, false, 3, pad);
	strings_of_models(recipe, identity);
}

/* The report in which a Wacom family has its pen, if this descriptor has it. */
static const struct pen_shape_report *wacom_report(const struct pen_shape *shape,
						   enum pen_family family)
{
	const struct pen_shape_report *report = NULL;
	switch (family) {
	case PEN_PENPARTNER:
	case PEN_GRAPHIRE:
	case PEN_DTU:
	case PEN_PL:
	case PEN_PTU:
		return shape_find(shape, 2, 0, 7, 12);
	case PEN_BAMBOO:
		return shape_find(shape, 2, 0, 9, 12);
	case PEN_INTUOS:
		report = shape_find(shape, 2, 0, 10, 16);
		return report ? report : shape_find(shape, 0x10, 0, 10, 16);
	case PEN_INTUOS_PRO_2:
		return shape_find(shape, 0x10, 0, 12, 192);
	case PEN_INTUOS_PRO_3:
		report = shape_find(shape, 0x1e, 0, 15, 192);
		return report ? report : shape_find(shape, 0x1f, 0, 12, 192);
	case PEN_DTUS:
		return shape_find(shape, 0x11, 0, 7, 16);
	default:
		return NULL;
	}
}

/* Does the descriptor itself say where in this report the pen is? */
static bool described(const struct pen_identity *identity, int id)
{
	struct pen_layout layout[PEN_REPORTS_MAX];
	char reason[160];
	int count = pen_descriptor_read(identity->descriptor, identity->descriptor_size, layout,
					reason);
	for (int i = 0; i < count; i++)
		if (layout[i].report_id == id)
			return true;
	return false;
}

/* Out of the mouse mode that all start in. Newer tablets' descriptors tell all about report 16 or
 * 30, and which model it is need not be known. */
static bool recipe_wacom(struct pen_recipe *recipe, const struct pen_identity *identity,
			 const struct pen_shape *shape)
{
	static const uint8_t mode[] = {2, 2};
	enum pen_family family = wacom_family(identity);
	const struct pen_shape_report *report = wacom_report(shape, family);
	bool wacom = identity->vendor == VENDOR_WACOM;
	bool told = report ? described(identity, report->id)
			   : wacom && (described(identity, 0x10) || described(identity, 0x1e));
	if (told && (!wacom || !shape_feature(shape, 2, sizeof mode)))
		return false;
	if (!report && !told)
		return false;
	recipe->family = told ? PEN_BY_DESCRIPTOR : family;
	recipe->report_bytes = report ? report->input_bytes : 0;
	bytes_add(recipe, PEN_STEP_FEATURE, false, sizeof mode, mode);
	return true;
}

static bool recipe_by_shape(struct pen_recipe *recipe, const struct pen_identity *identity)
{
	struct pen_shape shape;
	const struct pen_shape_report *report;
	pen_shape_read(&shape, identity->descriptor, identity->descriptor_size);
	if ((report = shape_find(&shape, 8, PAGE_UCLOGIC, 12, 64)) != NULL) {
		recipe_uclogic(recipe, report, true);
	} else if ((report = shape_find(&shape, 2, PAGE_UGEE, 8, 64)) != NULL) {
		recipe_ugee(recipe, identity, report);
	} else if ((report = shape_find(&shape, 9, PAGE_UGEE, 9, 64)) != NULL) {
		recipe_veikk(recipe, identity, report);
	} else if (shape_find(&shape, 9, PAGE_DESKTOP, 8, 8) &&
		   (report = shape_find(&shape, 7, PAGE_DIGITIZER, 8, 12)) != NULL) {
		recipe_uclogic(recipe, report, false);
	} else {
		return recipe_wacom(recipe, identity, &shape);
	}
	return true;
}

bool pen_identify(const struct pen_identity *identity, struct pen_recipe *recipe, char reason[160])
{
	*recipe = (struct pen_recipe){0};
	if (identity->bus != BUS_USB) {
		snprintf(reason, 160, "makers' protocols are spoken by USB only");
		return false;
	}
	if (identity->driver && !strcmp(identity->driver, "uclogic")) {
		snprintf(reason, 160,
			 "the kernel driver uclogic has set it up, its descriptor tells "
			 "what it sends");
		return false;
	}
	if (recipe_by_shape(recipe, identity)) {
		snprintf(reason, 160, "%s",
			 recipe->family == PEN_BY_DESCRIPTOR
				 ? "its descriptor tells all once its mode is set"
				 : pen_family_rule(recipe->family)->name);
		return true;
	}
	if (identity->vendor == VENDOR_WACOM)
		snprintf(reason, 160,
			 "no known protocol has such reports, or the model %04x:%04x is "
			 "unknown",
			 (unsigned)identity->vendor, (unsigned)identity->product);
	else
		snprintf(reason, 160, "no known protocol has such reports");
	return false;
}
