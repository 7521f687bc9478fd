/* What cloth is made of: how the solver's everyday settings change with the fabric. Ratios are to
 * cotton jersey of the weight of a T-shirt, which all settings are stated for. */
#ifndef FABRIC_H
#define FABRIC_H

#include "cloth.h"

struct fabric {
	const char *name;
	float stretch;     /* 0..1: ratio of the share of stretch taken back in a sweep */
	float shear;       /* 0..1: share of shear taken back; woven cloth gives along its bias */
	float bend;        /* ratio of stiffness against wrinkles */
	float weight;      /* ratio of weight: what gravity moves it by */
	float friction;    /* ratio of friction on the body */
	float thickness_m; /* layers and folds lie this far apart */
};

/* The fabrics by name: the first is what every garment is made of until said otherwise. -1:
 * unknown. */
const struct fabric *fabric_at(int index);
int fabric_named(const char *name);

/* The settings of a stage as this fabric takes them. */
struct cloth_settings fabric_settings(const struct cloth_settings *stage, int fabric);

#endif
