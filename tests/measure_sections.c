/* Measures the mannequin's tables of cross-sections (src/mannequin_tables.h) on two figures.
 *
 *     measure_sections FEMALE.obj ANDROGYNOUS.obj > src/mannequin_tables.h
 *
 * The figures are MakeHuman's base.obj, group "body" (github.com/makehumancommunity/makehuman at
 * a8bc2d54, CC0), as triangles in metres, +Y up, facing +Z: one with the targets african-, asian-
 * and caucasian-female-young at a third each and
 * universal-female-young-averagemuscle-averageweight, one without targets. They share one numbering
 * of vertices, so that 3 : 1 between them is a body too. It is scaled to 1.70 m, its legs are made
 * longer, straighter and brought together, and then every section is cut as a ring of 96 rays from
 * a point inside, in a plane or on a cone about an axis, and kept as the first harmonics of radius
 * over angle. That keeps girth, width, depth and shape, and drops face, ears, toes and fingers.
 * Drawn by hand are the mitten, up to 9 mm more bust and up to 9 mm less chin (measure_rings.h). */
#include "mannequin_loft.h"
#include "measure_rings.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
	VERTICES_MAX = 20000,
	TRIANGLES_MAX = 40000,
	RAYS = 96,
	ROWS_MAX = 32,
};

#define FEMALE_SHARE 0.75
#define EDGE_MAX 0.06 /* of the figures' triangles */
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

struct frame {
	double e[3][3]; /* angle 0, angle 90 degrees, axis */
};

/* What the generator gets: see src/mannequin_tables.h */
struct row {
	double origin[3], pitch, roll, cone;
	double cosine[SECTION_ORDER + 1], sine[SECTION_ORDER + 1];
};

static struct frame frame_of(double pitch, double roll)
{
	double cp = cos(pitch * RADIANS), sp = sin(pitch * RADIANS);
	double cr = cos(roll * RADIANS), sr = sin(roll * RADIANS);
	return (struct frame){{{-sr * sp, cr * sp, cp}, {cr, sr, 0.0}, {-sr * cp, cr * cp, -sp}}};
}

static void ray_direction(const struct cut *cut, double angle, double out[3])
{
	struct frame f = frame_of(cut->pitch, cut->roll);
	double cc = cos(cut->cone * RADIANS), sc = sin(cut->cone * RADIANS);
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

static bool near(const double a[3], const double b[3], double reach)
{
	double d[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
	return dot(d, d) < reach * reach;
}

static double cast(const struct mesh *mesh, const struct cut *cut, const double d[3])
{
	double reach = cut->reach > 0.0 ? cut->reach : 0.30;
	double hit = cut->flags & FAR ? -1.0 : 1e9;
	for (int t = 0; t < mesh->triangle_count; t++) {
		const int *v = mesh->triangle[t];
		if (!near(mesh->position[v[0]], cut->origin, reach + EDGE_MAX))
			continue;
		double s = ray_triangle(cut->origin, d, mesh->position[v[0]], mesh->position[v[1]],
					mesh->position[v[2]]);
		if (s > 0.005 && s < reach)
			hit = cut->flags & FAR ? fmax(hit, s) : fmin(hit, s);
	}
	return hit > 0.0 && hit < 1e9 ? hit : reach;
}

static double limit(const struct cut *cut, const double d[3], double s)
{
	double x = cut->origin[0] + s * d[0];
	if (cut->x_low > 0.0 && x < cut->x_low && d[0] < 0.0)
		s = (cut->x_low - cut->origin[0]) / d[0];
	if (cut->x_high > 0.0 && fabs(x) > cut->x_high)
		s = (cut->x_high - cut->origin[0] * (d[0] < 0.0 ? -1.0 : 1.0)) / fabs(d[0]);
	if (cut->flags & SOLE && d[1] < 0.0 && cut->origin[1] + s * d[1] < 0.022)
		s = fmin(s + 0.008, -cut->origin[1] / d[1]);
	return s;
}

static void measure_radii(const struct mesh *mesh, const struct cut *cut, double radius[RAYS])
{
	for (int i = 0; i < RAYS; i++) {
		double d[3];
		ray_direction(cut, 360.0 * RADIANS * i / RAYS, d);
		double front = (1.0 + cos(360.0 * RADIANS * i / RAYS)) / 2.0;
		radius[i] = limit(cut, d, cast(mesh, cut, d)) +
			    cut->front_mm / 1000.0 * front * front;
	}
}

static void centre(struct cut *cut, const double radius[RAYS])
{
	double area = 0.0, moment[2] = {0};
	struct frame f = frame_of(cut->pitch, cut->roll);
	for (int i = 0; i < RAYS; i++) {
		double a = 360.0 * RADIANS * i / RAYS, r = radius[i];
		area += r * r / 2.0;
		moment[0] += r * r * r / 3.0 * cos(a);
		moment[1] += r * r * r / 3.0 * sin(a);
	}
	for (int k = 0; k < 3; k++)
		cut->origin[k] += (moment[0] * f.e[0][k] + moment[1] * f.e[1][k]) / area;
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

static struct row measure(const struct mesh *mesh, struct cut cut, bool symmetric)
{
	double radius[RAYS];
	struct row row = {0};
	for (int i = 0; i < (cut.flags & CENTRE ? 3 : 1); i++) {
		measure_radii(mesh, &cut, radius);
		if (cut.flags & CENTRE && i < 2)
			centre(&cut, radius);
	}
	for (int i = RAYS / 2 + 1; symmetric && i < RAYS; i++)
		radius[i] = radius[RAYS - i];
	memcpy(row.origin, cut.origin, sizeof row.origin);
	row.pitch = cut.pitch;
	row.roll = cut.roll;
	row.cone = cut.cone;
	harmonics(&row, radius, cut.order, symmetric);
	return row;
}

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
	struct cut cut = {{0}, 0, 0, 0, spec->reach, 0, 0, spec->order, spec->flags, 0};
	aim(&row, direction);
	along(from, direction, spec->along_mm, cut.origin);
	cut.pitch = row.pitch;
	cut.roll = row.roll;
	return measure(mesh, cut, false);
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
	harmonics(&row, radius, hand->cone == 90 ? 0 : SECTION_ORDER, false);
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
		for (int m = 0; m <= SECTION_ORDER; m++)
			printf(", %ld", lround(r->cosine[m] * 1e4));
		for (int m = 1; m <= SECTION_ORDER; m++)
			printf(", %ld", lround(r->sine[m] * 1e4));
		printf("},\n");
	}
	printf("};\n");
}

static void print_part(const struct mesh *mesh, const char *name, const char *what,
		       const struct cut *cut, size_t count, bool symmetric)
{
	struct row row[ROWS_MAX];
	for (size_t i = 0; i < count; i++)
		row[i] = measure(mesh, cut[i], symmetric);
	print_rows(name, what, row, (int)count);
}

static void print_tables(const struct mesh *mesh)
{
	struct row arm[ROWS_MAX];
	printf("/* Made by tests/measure_sections.c from two CC0 figures; how is said there. What "
	       "the\n"
	       " * columns are is said in mannequin_loft.h. */\n"
	       "#ifndef MANNEQUIN_TABLES_H\n#define MANNEQUIN_TABLES_H\n\n"
	       "#include \"mannequin_loft.h\"\n\n/* clang-format off */\n");
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
