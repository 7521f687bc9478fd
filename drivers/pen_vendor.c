/* The table of makers' protocols; see pen_vendor.h. */
#include "pen.h"

static const struct pen_family_rule rules[PEN_FAMILIES] = {
	[PEN_UCLOGIC_1] = {"uclogic-1", "UC-Logic 1", 60, 60, false, 9, pen_uclogic_1_read},
	[PEN_UCLOGIC_2] = {"uclogic-2", "UC-Logic 2 (Huion, Gaomon)", 60, 60, true, 0,
			   pen_uclogic_2_read},
	[PEN_UGEE_2] = {"ugee-2", "Ugee 2 (XP-Pen, Parblo)", 60, 60, false, 0, pen_ugee_2_read},
	[PEN_PENPARTNER] = {"penpartner", "Wacom PenPartner", 0, 0, true, 0, pen_penpartner_read},
	[PEN_GRAPHIRE] = {"graphire", "Wacom Graphire", 0, 0, false, 1, pen_graphire_read},
	[PEN_BAMBOO] = {"bamboo", "Wacom Bamboo", 0, 0, false, 1, pen_bamboo_read},
	[PEN_INTUOS] = {"intuos", "Wacom Intuos", 64, 64, false, 1, pen_intuos_read},
	[PEN_INTUOS_PRO_2] = {"intuos-pro-2", "Wacom Intuos Pro 2", 64, 64, false, 1,
			      pen_intuos_pro_2_read},
	[PEN_INTUOS_PRO_3] = {"intuos-pro-3", "Wacom Intuos Pro 3", 64, 64, false, 1,
			      pen_intuos_pro_3_read},
	[PEN_DTU] = {"dtu", "Wacom DTU", 0, 0, false, 1, pen_dtu_read},
	[PEN_DTUS] = {"dtus", "Wacom DTU-1031", 0, 0, false, 1, pen_dtus_read},
	[PEN_PL] = {"pl", "Wacom PL", 0, 0, false, 1, pen_pl_read},
	[PEN_PTU] = {"ptu", "Wacom PTU", 0, 0, false, 1, pen_ptu_read},
	[PEN_VEIKK] = {"veikk", "VEIKK", 60, 60, false, 0, pen_veikk_read},
};

const struct pen_family_rule *pen_family_rule(enum pen_family family)
{
	MUST(family > PEN_BY_DESCRIPTOR && family < PEN_FAMILIES);
	return &rules[family];
}

enum pen_family pen_family_named(const char *word, size_t size)
{
	for (int i = PEN_BY_DESCRIPTOR + 1; i < PEN_FAMILIES; i++)
		if (strlen(rules[i].word) == size && !memcmp(rules[i].word, word, size))
			return (enum pen_family)i;
	return PEN_FAMILIES;
}

bool pen_vendor_sound(const struct pen_vendor *vendor)
{
	return vendor->family > PEN_BY_DESCRIPTOR && vendor->family < PEN_FAMILIES &&
	       vendor->x_maximum >= 100 && vendor->x_maximum < 1 << 24 &&
	       vendor->y_maximum >= 100 && vendor->y_maximum < 1 << 24 &&
	       vendor->pressure_maximum >= 15 && vendor->pressure_maximum < 1 << 16;
}

void pen_vendor_layout(const struct pen_vendor *vendor, struct pen_layout *layout)
{
	const struct pen_family_rule *rule = pen_family_rule(vendor->family);
	*layout = (struct pen_layout){
		.vendor = *vendor,
		.leaves_silently = rule->leaves_silently,
		.x = {.size = 32, .maximum = vendor->x_maximum},
		.y = {.size = 32, .maximum = vendor->y_maximum},
		.pressure = {.size = 16, .maximum = vendor->pressure_maximum},
		.tip = {.size = 1, .maximum = 1},
		.in_range = {.size = 1, .maximum = 1},
		.barrel = {.size = 1, .maximum = 1},
		.barrel_2 = {.size = 1, .maximum = 1},
	};
	if (!rule->tilt_degrees)
		return;
	layout->tilt_x = layout->tilt_y = (struct pen_field){
		.size = 8,
		.is_signed = true,
		.minimum = -rule->tilt_maximum,
		.maximum = rule->tilt_maximum,
	};
	layout->tilt_unit_rad = (float)rule->tilt_degrees / (float)rule->tilt_maximum * PI_F /
				180.0f;
}
