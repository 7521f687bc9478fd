/* A second opinion on a drape, from its files alone: the garment's OBJ, whose texture coordinates
 * are the flat pattern in metres, and the body's. Shares no code with the program that it judges.
 */
#ifndef DRAPE_H
#define DRAPE_H

#include <stdbool.h>

struct point {
	double x, y, z;
};

struct drape_mesh {
	int vertex_count, texture_count, triangle_count, group_count;
	struct point *vertex;
	double (*texture)[2];
	int (*corner)[3]; /* vertices of a triangle */
	int (*flat)[3];   /* its texture coordinates; -1: none */
	int *group;       /* its "g" line's number */
};

struct drape_figures {
	int vertices_inside, midpoints_inside, centres_inside; /* deeper than `deep` */
	double penetration_mm_max;
	int edge_crossings;
	double strain_p95, strain_max;
	int components; /* of the garment, vertices at one place taken as one */
};

static inline struct point point_sub(struct point a, struct point b)
{
	return (struct point){a.x - b.x, a.y - b.y, a.z - b.z};
}

static inline double point_dot(struct point a, struct point b)
{
	return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline struct point point_cross(struct point a, struct point b)
{
	return (struct point){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static inline struct point point_mix(struct point a, struct point b, double t)
{
	return (struct point){a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t, a.z + (b.z - a.z) * t};
}

/* Ends the program with a message when the file can't be read. */
void drape_load(struct drape_mesh *mesh, const char *path);

/* Deeper than this is inside, metres. */
#define DRAPE_DEEP_M 5e-4

void drape_measure(struct drape_figures *figures, const struct drape_mesh *garment,
		   const struct drape_mesh *body);

/* Front, side and back beside one another, as PNG; the cloth's inside is red. */
bool drape_picture(const char *path, const struct drape_mesh *garment,
		   const struct drape_mesh *body);

#endif
