/* Measures the mannequin's tables of cross-sections (src/mannequin_tables.h) on two figures.
 *
 *     measure_sections FEMALE.obj ANDROGYNOUS.obj > src/mannequin_tables.h
 *
 * The figures are MakeHuman's base body with the targets "universal female young, average muscle,
 * average weight" and without any target; both are CC0 and share one numbering of vertices, so that
 * 3 : 1 between them is a body too. It is scaled to 1.70 m, its legs are made a little longer and
 * brought together, and then every section is cut as a ring of 96 rays from a point inside, in a
 * plane or on a cone about an axis, and kept as the first harmonics of radius over angle. That
 * keeps girth, width, depth and shape, and drops face, ears, toes and fingers. */
#include "base.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
	VERTICES_MAX = 20000,
	TRIANGLES_MAX = 40000,
	RAYS = 96,
	ORDER_MAX = 8,
	ROWS_MAX = 32,
};

#define FEMALE_SHARE 0.75
#define RADIANS (3.14159265358979323846 / 180.0)

struct mesh {
	int vertex_count, triangle_count;
	double position[VERTICES_MAX][3];
	int triangle[TRIANGLES_MAX][3];
};

static void die(const char *file, const char *what)
{
	fprintf(stderr, "measure_sections: %s: %s\n", file, what);
	exit(1);
}

static void read_obj(struct mesh *mesh, const char *file)
{
	FILE *in = fopen(file, "r");
	char line[512];
	if (!in)
		die(file, "cannot be opened");
	while (fgets(line, sizeof line, in)) {
		if (line[0] == 'v' && line[1] == ' ') {
			double *p = mesh->position[mesh->vertex_count++];
			if (mesh->vertex_count == VERTICES_MAX ||
			    sscanf(line + 2, "%lf %lf %lf", p, p + 1, p + 2) != 3)
				die(file, "bad vertex or too many");
		} else if (line[0] == 'f' && line[1] == ' ') {
			int *t = mesh->triangle[mesh->triangle_count++];
			if (mesh->triangle_count == TRIANGLES_MAX ||
			    sscanf(line + 2, "%d %d %d", t, t + 1, t + 2) != 3)
				die(file, "bad triangle (three bare indices wanted) or too many");
			for (int k = 0; k < 3; k++)
				t[k]--;
		}
	}
	fclose(in);
}

/* Feet at 0, head at 1.70 m. */
static void scale_to_height(struct mesh *mesh)
{
	double low = 1e9, high = -1e9;
	for (int v = 0; v < mesh->vertex_count; v++) {
		low = fmin(low, mesh->position[v][1]);
		high = fmax(high, mesh->position[v][1]);
	}
	for (int v = 0; v < mesh->vertex_count; v++) {
		double *p = mesh->position[v], s = 1.70 / (high - low);
		p[0] *= s;
		p[1] = (p[1] - low) * s;
		p[2] *= s;
	}
}

static double smooth_step(double a, double b, double x)
{
	double t = fmin(fmax((x - a) / (b - a), 0.0), 1.0);
	return t * t * (3.0 - 2.0 * t);
}

static void mix(struct mesh *mesh, const struct mesh *other)
{
	if (mesh->vertex_count != other->vertex_count)
		die("figures", "do not share one numbering of vertices");
	for (int v = 0; v < mesh->vertex_count; v++)
		for (int k = 0; k < 3; k++)
			mesh->position[v][k] = FEMALE_SHARE * mesh->position[v][k] +
					       (1.0 - FEMALE_SHARE) * other->position[v][k];
}

/* Display figures stand closer and have longer and straighter legs than people. */
static void pose(struct mesh *mesh)
{
	const double hip_y = 0.86, stretch = 1.05, together = 0.100, calf = 0.012;
	for (int v = 0; v < mesh->vertex_count; v++) {
		double *p = mesh->position[v], below = fmax(hip_y - p[1], 0.0);
		if (fabs(p[0]) < 0.30) {
			double side = smooth_step(-0.02, 0.02, p[0]) * 2.0 - 1.0;
			double shin = (p[1] - 0.32) / 0.13;
			p[0] -= side * together * below * below / (hip_y * (below + 0.04));
			p[0] -= side * calf * exp(-shin * shin);
		}
		p[1] += (stretch - 1.0) * fmin(p[1], hip_y);
		p[2] += 0.075;
	}
	scale_to_height(mesh);
}

enum ring_flag {
	FAR = 1,    /* the last hit counts, not the first: closes mouth, fingers and toes */
	CENTRE = 2, /* the origin is first moved to the section's centre of area */
	SOLE = 4,   /* rays that end just above the floor are drawn down to it */
};

/* Where a ring is cut. The axis is +Y, pitched about X (which lifts the front) and then rolled
 * about Z; rays leave at `cone` degrees above the plane across the axis. */
struct ring {
	double origin[3], pitch, roll, cone;
	double reach, x_low, x_high; /* metres; 0: no limit */
	int order, flags;
	double front_mm; /* added to the radius in front, fading to nothing behind */
};

struct frame {
	double e[3][3]; /* angle 0, angle 90 degrees, axis */
};

/* What the generator gets: see src/mannequin_tables.h */
struct row {
	double origin[3], pitch, roll, cone;
	double cosine[ORDER_MAX + 1], sine[ORDER_MAX + 1];
};

static struct frame frame_of(double pitch, double roll)
{
	double cp = cos(pitch * RADIANS), sp = sin(pitch * RADIANS);
	double cr = cos(roll * RADIANS), sr = sin(roll * RADIANS);
	return (struct frame){{{-sr * sp, cr * sp, cp}, {cr, sr, 0.0}, {-sr * cp, cr * cp, -sp}}};
}

static void ray_direction(const struct ring *ring, double angle, double out[3])
{
	struct frame f = frame_of(ring->pitch, ring->roll);
	double cc = cos(ring->cone * RADIANS), sc = sin(ring->cone * RADIANS);
	for (int k = 0; k < 3; k++)
		out[k] = cc * (cos(angle) * f.e[0][k] + sin(angle) * f.e[1][k]) + sc * f.e[2][k];
}

static void cross(const double a[3], const double b[3], double out[3])
{
	out[0] = a[1] * b[2] - a[2] * b[1];
	out[1] = a[2] * b[0] - a[0] * b[2];
	out[2] = a[0] * b[1] - a[1] * b[0];
}

static double dot(const double a[3], const double b[3])
{
	return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Distance along the ray to the triangle, or -1 (Moeller and Trumbore 1997). */
static double ray_triangle(const double o[3], const double d[3], const double a[3],
			   const double b[3], const double c[3])
{
	double ab[3], ac[3], ao[3], p[3], q[3];
	for (int k = 0; k < 3; k++) {
		ab[k] = b[k] - a[k];
		ac[k] = c[k] - a[k];
		ao[k] = o[k] - a[k];
	}
	cross(d, ac, p);
	double det = dot(ab, p), u = dot(ao, p);
	if (fabs(det) < 1e-14)
		return -1.0;
	u /= det;
	cross(ao, ab, q);
	double v = dot(d, q) / det;
	if (u < -1e-9 || v < -1e-9 || u + v > 1.0 + 1e-9)
		return -1.0;
	return dot(ac, q) / det;
}

static double cast(const struct mesh *mesh, const struct ring *ring, const double d[3])
{
	double reach = ring->reach > 0.0 ? ring->reach : 0.30;
	double hit = ring->flags & FAR ? -1.0 : 1e9;
	for (int t = 0; t < mesh->triangle_count; t++) {
		const int *v = mesh->triangle[t];
		double s = ray_triangle(ring->origin, d, mesh->position[v[0]], mesh->position[v[1]],
					mesh->position[v[2]]);
		if (s > 0.005 && s < reach)
			hit = ring->flags & FAR ? fmax(hit, s) : fmin(hit, s);
	}
	return hit > 0.0 && hit < 1e9 ? hit : reach;
}

static double limit(const struct ring *ring, const double d[3], double s)
{
	double x = ring->origin[0] + s * d[0];
	if (ring->x_low > 0.0 && x < ring->x_low && d[0] < 0.0)
		s = (ring->x_low - ring->origin[0]) / d[0];
	if (ring->x_high > 0.0 && fabs(x) > ring->x_high)
		s = (ring->x_high - ring->origin[0] * (d[0] < 0.0 ? -1.0 : 1.0)) / fabs(d[0]);
	if (ring->flags & SOLE && d[1] < 0.0 && ring->origin[1] + s * d[1] < 0.022)
		s = fmin(s + 0.008, -ring->origin[1] / d[1]);
	return s;
}

static void measure_radii(const struct mesh *mesh, const struct ring *ring, double radius[RAYS])
{
	for (int i = 0; i < RAYS; i++) {
		double d[3];
		ray_direction(ring, 360.0 * RADIANS * i / RAYS, d);
		double front = (1.0 + cos(360.0 * RADIANS * i / RAYS)) / 2.0;
		radius[i] = limit(ring, d, cast(mesh, ring, d)) +
			    ring->front_mm / 1000.0 * front * front;
	}
}

static void centre(struct ring *ring, const double radius[RAYS])
{
	double area = 0.0, moment[2] = {0};
	struct frame f = frame_of(ring->pitch, ring->roll);
	for (int i = 0; i < RAYS; i++) {
		double a = 360.0 * RADIANS * i / RAYS, r = radius[i];
		area += r * r / 2.0;
		moment[0] += r * r * r / 3.0 * cos(a);
		moment[1] += r * r * r / 3.0 * sin(a);
	}
	for (int k = 0; k < 3; k++)
		ring->origin[k] += (moment[0] * f.e[0][k] + moment[1] * f.e[1][k]) / area;
}

/* The first harmonics of the radius (the rays are evenly spread, so least squares is a sum). */
static void harmonics(struct row *row, const double radius[RAYS], int order, bool symmetric)
{
	for (int m = 0; m <= order; m++) {
		for (int i = 0; i < RAYS; i++) {
			double a = 360.0 * RADIANS * i / RAYS * m, w = (m ? 2.0 : 1.0) / RAYS;
			row->cosine[m] += w * radius[i] * cos(a);
			row->sine[m] += symmetric ? 0.0 : w * radius[i] * sin(a);
		}
	}
}

static struct row measure(const struct mesh *mesh, struct ring ring, bool symmetric)
{
	double radius[RAYS];
	struct row row = {0};
	for (int i = 0; i < (ring.flags & CENTRE ? 3 : 1); i++) {
		measure_radii(mesh, &ring, radius);
		if (ring.flags & CENTRE && i < 2)
			centre(&ring, radius);
	}
	for (int i = RAYS / 2 + 1; symmetric && i < RAYS; i++)
		radius[i] = radius[RAYS - i];
	memcpy(row.origin, ring.origin, sizeof row.origin);
	row.pitch = ring.pitch;
	row.roll = ring.roll;
	row.cone = ring.cone;
	harmonics(&row, radius, ring.order, symmetric);
	return row;
}

static const struct ring TRUNK[] = {
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
static const struct ring TOP[] = {
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
static const struct ring LEG[] = {
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
static const struct ring CROTCH[] = {
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

static void aim(struct row *row, const double direction[3])
{
	row->pitch = -asin(direction[2] / sqrt(dot(direction, direction))) / RADIANS;
	row->roll = atan2(-direction[0], direction[1]) / RADIANS;
}

static void along(const double from[3], const double direction[3], double mm, double out[3])
{
	double length = sqrt(dot(direction, direction));
	for (int k = 0; k < 3; k++)
		out[k] = from[k] + direction[k] * mm / 1000.0 / length;
}

static struct row measure_arm(const struct mesh *mesh, const struct arm_ring *spec,
			      const double from[3], const double direction[3])
{
	struct row row = {0};
	struct ring ring = {{0}, 0, 0, 0, spec->reach, 0, 0, spec->order, spec->flags, 0};
	aim(&row, direction);
	along(from, direction, spec->along_mm, ring.origin);
	ring.pitch = row.pitch;
	ring.roll = row.roll;
	return measure(mesh, ring, false);
}

/* A rectangle with half circles at both ends. */
static double stadium(double half_width, double half_thickness, double angle)
{
	double straight = half_width - half_thickness, c = fabs(cos(angle)), s = fabs(sin(angle));
	if (straight <= 0.0)
		return half_thickness;
	if (half_thickness * c <= straight * s)
		return half_thickness / s;
	return straight * c + sqrt(half_thickness * half_thickness - straight * straight * s * s);
}

static struct row draw_hand(const struct hand_ring *hand, const double wrist[3])
{
	struct row row = {0};
	double radius[RAYS];
	aim(&row, HAND_LAID);
	struct frame f = frame_of(row.pitch, row.roll);
	along(wrist, HAND_LAID, hand->along_mm, row.origin);
	for (int k = 0; k < 3; k++)
		row.origin[k] += f.e[1][k] * hand->curl_mm / 1000.0;
	for (int i = 0; i < RAYS; i++) {
		double a = 360.0 * RADIANS * i / RAYS, away = a > M_PI ? a - 2.0 * M_PI : a;
		double thumb = (away - 0.45) / 0.34;
		radius[i] = (stadium(hand->half_width_mm, hand->half_thickness_mm, a) +
			     hand->thumb_mm * exp(-thumb * thumb)) /
			    1000.0;
	}
	row.cone = hand->cone;
	harmonics(&row, radius, hand->cone == 90 ? 0 : ORDER_MAX, false);
	return row;
}

static int measure_arms(const struct mesh *mesh, struct row row[ROWS_MAX])
{
	int n = 0;
	double elbow[3], wrist[3];
	along(SHOULDER, UPPER_ARM, UPPER_ARM_MM, elbow);
	along(elbow, FOREARM_LAID, WRIST_MM, wrist);
	for (size_t i = 0; i < sizeof UPPER_RINGS / sizeof *UPPER_RINGS; i++)
		row[n++] = measure_arm(mesh, &UPPER_RINGS[i], SHOULDER, UPPER_ARM);
	for (size_t i = 0; i < sizeof FORE_RINGS / sizeof *FORE_RINGS; i++) {
		row[n] = measure_arm(mesh, &FORE_RINGS[i], ELBOW, FOREARM);
		along(elbow, FOREARM_LAID, FORE_RINGS[i].along_mm, row[n].origin);
		aim(&row[n++], FOREARM_LAID);
	}
	for (size_t i = 0; i < sizeof HAND / sizeof *HAND; i++)
		row[n++] = draw_hand(&HAND[i], wrist);
	return n;
}

/* Tenths of millimetres and of milliradians. */
static void print_rows(const char *name, const char *what, const struct row *row, int count)
{
	printf("\n/* %s */\nstatic const short %s[][SECTION_COLUMNS] = {\n", what, name);
	for (int i = 0; i < count; i++) {
		const struct row *r = &row[i];
		printf("\t{%ld, %ld, %ld, %ld, %ld, %ld", lround(r->origin[0] * 1e4),
		       lround(r->origin[1] * 1e4), lround(r->origin[2] * 1e4),
		       lround(r->pitch * RADIANS * 1e4), lround(r->roll * RADIANS * 1e4),
		       lround(r->cone * RADIANS * 1e4));
		for (int m = 0; m <= ORDER_MAX; m++)
			printf(", %ld", lround(r->cosine[m] * 1e4));
		for (int m = 1; m <= ORDER_MAX; m++)
			printf(", %ld", lround(r->sine[m] * 1e4));
		printf("},\n");
	}
	printf("};\n");
}

static void print_part(const struct mesh *mesh, const char *name, const char *what,
		       const struct ring *ring, size_t count, bool symmetric)
{
	struct row row[ROWS_MAX];
	for (size_t i = 0; i < count; i++)
		row[i] = measure(mesh, ring[i], symmetric);
	print_rows(name, what, row, (int)count);
}

static void print_tables(const struct mesh *mesh)
{
	struct row arm[ROWS_MAX];
	printf("/* Made by tests/measure_sections.c from two CC0 figures; how is said there. */\n"
	       "#ifndef MANNEQUIN_TABLES_H\n#define MANNEQUIN_TABLES_H\n\n"
	       "/* A section is a ring of points about an origin: at the angle a, the point lies "
	       "at the\n"
	       " * distance sum(cosine[m] cos(m a) + sine[m] sin(m a)) in the direction that a and "
	       "the\n"
	       " * cone's angle give in a frame whose axis is +Y, pitched about X and then rolled "
	       "about\n"
	       " * Z. The angle runs from the front (+Z) to the wearer's left (+X).\n"
	       " * Columns: origin x y z, pitch, roll, cone, cosine[0 .. %d], sine[1 .. %d];\n"
	       " * 0.1 mm and 0.1 mrad. */\n"
	       "enum { SECTION_ORDER = %d, SECTION_COLUMNS = %d };\n"
	       "\n/* clang-format off */\n",
	       ORDER_MAX, ORDER_MAX, ORDER_MAX, 7 + 2 * ORDER_MAX);
#define PART(name, what, ring, symmetric)                                                          \
	print_part(mesh, name, what, ring, sizeof(ring) / sizeof *(ring), symmetric)
	PART("TRUNK", "From the hips to the armpits; symmetric.", TRUNK, true);
	PART("TOP", "Yoke over the shoulders, neck, head; symmetric.", TOP, true);
	PART("LEG", "The left leg from the toes up to the line of a leotard.", LEG, false);
	PART("CROTCH", "The seam between the legs in the plane x = 0, front to back.", CROTCH,
	     true);
	print_rows("ARM", "The left arm from the armhole to the finger tips.", arm,
		   measure_arms(mesh, arm));
	printf("/* clang-format on */\n\n#endif\n");
}

int main(int argc, char **argv)
{
	static struct mesh body, other;
	if (argc != 3) {
		fprintf(stderr, "usage: measure_sections FEMALE.obj ANDROGYNOUS.obj\n");
		return 2;
	}
	read_obj(&body, argv[1]);
	read_obj(&other, argv[2]);
	scale_to_height(&body);
	scale_to_height(&other);
	mix(&body, &other);
	pose(&body);
	print_tables(&body);
	return 0;
}
