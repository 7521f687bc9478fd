/* Where the sections of the mannequin are cut, on figures 1.70 m tall that stand as
 * measure_sections.c poses them. Metres and degrees. */
#ifndef MEASURE_RINGS_H
#define MEASURE_RINGS_H

enum ring_flag {
	FAR = 1,    /* the last hit counts, not the first: closes mouth, fingers and toes */
	CENTRE = 2, /* the origin is first moved to the section's centre of area */
	SOLE = 4,   /* rays that end just above the floor are drawn down to it */
};

/* Where a ring is cut. The axis is +Y, pitched about X (which lifts the front) and then rolled
 * about Z; rays leave at `cone` degrees above the plane across the axis. */
struct cut {
	double origin[3], pitch, roll, cone;
	double reach, x_low, x_high; /* metres; 0: no limit */
	int order, flags;
	double front_mm; /* added to the radius in front, fading to nothing behind */
};

/* From the hips to the armpits. */
static const struct cut TRUNK[] = {
	{{0, 0.835, 0.00}, 0, 0, 0, 0, 0, 0, 8, 0, 0},
	{{0, 0.860, 0.00}, 0, 0, 0, 0, 0, 0, 8, 0, 0},
	{{0, 0.885, 0.00}, 0, 0, 0, 0, 0, 0, 8, 0, 0},
	{{0, 0.910, 0.00}, 0, 0, 0, 0, 0, 0, 8, 0, 0},
	{{0, 0.945, 0.00}, 0, 0, 0, 0, 0, 0, 8, 0, 0},
	{{0, 0.985, 0.00}, 0, 0, 0, 0, 0, 0, 8, 0, 0},
	{{0, 1.020, 0.00}, 0, 0, 0, 0, 0, 0, 8, 0, 0},
	{{0, 1.055, 0.00}, 0, 0, 0, 0, 0, 0, 8, 0, 0},
	{{0, 1.090, 0.01}, 0, 0, 0, 0, 0, 0, 8, 0, 0},
	{{0, 1.125, 0.01}, 0, 0, 0, 0, 0, 0, 8, 0, 0},
	{{0, 1.160, 0.01}, 0, 0, 0, 0, 0, 0, 8, 0, 0},
	{{0, 1.195, 0.015}, 0, 0, 0, 0, 0, 0, 8, 0, 4},
	{{0, 1.225, 0.015}, 0, 0, 0, 0, 0, 0, 8, 0, 9},
	{{0, 1.255, 0.01}, 0, 2.5, 0, 0, 0, 0, 8, 0, 8},
	{{0, 1.286, 0.005}, 0, 4, 0, 0, 0, 0.152, 8, 0, 2},
};

/* The yoke over the shoulders, the neck and the head are one loft. */
static const struct cut TOP[] = {
	{{0, 1.280, 0.005}, 0, 2, 18, 0, 0, 0, 8, 0, 0},
	{{0, 1.290, 0.005}, 0, 0, 35, 0, 0, 0, 8, 0, 0},
	{{0, 1.310, 0.000}, 0, 0, 45, 0, 0, 0, 8, 0, 0},
	{{0, 1.335, -0.005}, 0, 0, 52, 0, 0, 0, 6, 0, 0},
	{{0, 1.375, -0.008}, 0, 0, 50, 0, 0, 0, 5, 0, 0},
	{{0, 1.425, -0.008}, -5, 0, 35, 0, 0, 0, 4, 0, 0},
	{{0, 1.465, -0.003}, -8, 0, 15, 0, 0, 0, 4, 0, 0},
	{{0, 1.500, 0.000}, -25, 0, 0, 0.13, 0, 0.054, 3, FAR, -4},
	{{0, 1.515, 0.005}, -20, 0, 0, 0.13, 0, 0.055, 3, FAR, -9},
	{{0, 1.535, 0.010}, -10, 0, 0, 0.13, 0, 0.060, 3, FAR, -9},
	{{0, 1.565, 0.015}, -5, 0, 0, 0.13, 0, 0.067, 3, FAR, -5},
	{{0, 1.600, 0.015}, 0, 0, 0, 0.13, 0, 0.073, 3, FAR, 0},
	{{0, 1.620, 0.015}, 0, 0, 10, 0.13, 0, 0.075, 3, FAR, 0},
	{{0, 1.620, 0.015}, 0, 0, 32, 0.13, 0, 0, 3, FAR, 0},
	{{0, 1.620, 0.015}, 0, 0, 52, 0.13, 0, 0, 3, FAR, 0},
	{{0, 1.620, 0.015}, 0, 0, 72, 0.13, 0, 0, 2, FAR, 0},
	{{0, 1.620, 0.015}, 0, 0, 90, 0.13, 0, 0, 0, FAR, 0},
};

/* From the toes through heel and ankle up to the line of a leotard. */
static const struct cut LEG[] = {
	{{0.090, 0.020, 0.100}, 90, 0, -90, 0.042, 0, 0, 0, FAR | SOLE, 0},
	{{0.090, 0.020, 0.100}, 90, 0, -60, 0.045, 0, 0, 2, FAR | SOLE, 0},
	{{0.092, 0.020, 0.100}, 90, 0, -28, 0.05, 0, 0, 5, FAR | SOLE, 0},
	{{0.094, 0.021, 0.095}, 90, 0, 0, 0.06, 0, 0, 5, FAR | SOLE, 0},
	{{0.096, 0.023, 0.072}, 90, 0, 0, 0.06, 0, 0, 6, FAR | SOLE, 0},
	{{0.098, 0.028, 0.045}, 90, 0, 0, 0.08, 0, 0, 6, FAR | SOLE, 0},
	{{0.099, 0.0374, 0.0352}, 82, 0, 0, 0.10, 0, 0, 6, FAR | SOLE, 0},
	{{0.099, 0.0424, 0.0177}, 64, 0, 0, 0.10, 0, 0, 6, SOLE, 0},
	{{0.099, 0.0515, 0.0006}, 46, 0, 0, 0.10, 0, 0, 6, SOLE, 0},
	{{0.099, 0.067, -0.006}, 33, 0, 0, 0.10, 0, 0, 6, 0, 0},
	{{0.100, 0.0867, -0.007}, 20, 0, 0, 0.10, 0, 0, 6, 0, 0},
	{{0.102, 0.110, -0.008}, 8, 0, 0, 0.10, 0, 0, 6, 0, 0},
	{{0.099, 0.140, -0.004}, 0, 0, 0, 0.10, 0, 0, 5, CENTRE, 0},
	{{0.100, 0.185, 0.000}, 0, 0, 0, 0.10, 0, 0, 5, CENTRE, 0},
	{{0.100, 0.235, 0.000}, 0, 0, 0, 0.10, 0, 0, 5, CENTRE, 0},
	{{0.100, 0.285, 0.000}, 0, 0, 0, 0.10, 0, 0, 5, CENTRE, 0},
	{{0.100, 0.335, 0.000}, 0, 0, 0, 0.10, 0, 0, 5, CENTRE, 0},
	{{0.100, 0.385, 0.000}, 0, 0, 0, 0.10, 0, 0, 5, CENTRE, 0},
	{{0.100, 0.430, 0.000}, 0, 0, 0, 0.10, 0, 0, 5, CENTRE, 0},
	{{0.100, 0.495, 0.000}, 0, 0, 0, 0.10, 0, 0, 5, CENTRE, 0},
	{{0.100, 0.560, 0.000}, 0, 0, 0, 0.12, 0, 0, 5, CENTRE, 0},
	{{0.100, 0.620, 0.000}, 0, 0, 0, 0.12, 0, 0, 5, CENTRE, 0},
	{{0.095, 0.680, 0.000}, 0, 0, 0, 0.14, 0, 0, 5, CENTRE, 0},
	{{0.095, 0.735, 0.000}, 0, 0, 0, 0.14, 0, 0, 5, CENTRE, 0},
	{{0.095, 0.775, 0.000}, 0, 3, 0, 0.16, 0.006, 0, 6, CENTRE, 0},
	{{0.092, 0.800, 0.000}, 0, 6, 0, 0.16, 0.004, 0, 6, 0, 0},
	{{0.090, 0.821, 0.000}, 0, 9, 0, 0.16, 0.002, 0, 6, 0, 0},
};

/* The seam between the legs, in the plane x = 0: from front (angle 0) to back (180 degrees). */
static const struct cut CROTCH[] = {
	{{0, 0.835, 0.00}, 0, -90, 0, 0.12, 0, 0, 6, 0, 0},
};

/* The arm is measured along its own bent axis and laid along a nearly straight one. */
static const double SHOULDER[3] = {0.185, 1.3245, -0.017}, UPPER_ARM[3] = {0.645, -0.764, 0.005};
static const double ELBOW[3] = {0.313, 1.180, -0.015}, FOREARM[3] = {0.555, -0.565, 0.610};
static const double FOREARM_LAID[3] = {0.575, -0.800, 0.170}, HAND_LAID[3] = {0.540, -0.825, 0.165};

enum { UPPER_ARM_MM = 200, WRIST_MM = 211 };

struct arm_ring {
	double along_mm, reach; /* from shoulder or elbow */
	int order, flags;
};

static const struct arm_ring UPPER_RINGS[] = {
	{0, 0.052, 6, 0},       {20, 0.056, 6, 0},      {45, 0.07, 5, CENTRE},
	{75, 0.07, 5, CENTRE},  {105, 0.07, 5, CENTRE}, {135, 0.07, 4, CENTRE},
	{165, 0.07, 4, CENTRE},
};
static const struct arm_ring FORE_RINGS[] = {
	{50, 0.07, 4, CENTRE},  {80, 0.07, 4, CENTRE},  {110, 0.07, 4, CENTRE},
	{145, 0.07, 4, CENTRE}, {178, 0.07, 4, CENTRE}, {205, 0.07, 4, CENTRE},
};

/* The hand is drawn, not measured: a mitten with the girth and length of the figures' hands. Half
 * width (front to back), half thickness, the thumb's height above the outline, the curl towards
 * the palm, and the cone of the last rings, which close the tip. */
struct hand_ring {
	double along_mm, half_width_mm, half_thickness_mm, thumb_mm, curl_mm, cone;
};

static const struct hand_ring HAND[] = {
	{28, 25.0, 18.0, 1, 0, 0},    {48, 28.5, 15.5, 6, 0, 0},    {66, 31.5, 14.0, 11, 1, 0},
	{82, 33.0, 13.0, 12, 2, 0},   {94, 33.5, 12.5, 8, 3.5, 0},  {106, 33.5, 12.0, 1, 5, 0},
	{122, 32.0, 11.3, 0, 7.5, 0}, {140, 29.0, 10.3, 0, 11, 0},  {158, 23.0, 9.0, 0, 15, 0},
	{163, 19.5, 9.5, 0, 16, 30},  {163, 14.5, 10.5, 0, 16, 62}, {163, 11.5, 11.5, 0, 16, 90},
};

#endif
