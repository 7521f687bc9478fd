/* A triangle of a mesh: the one shape that files, bodies and garments share. */
#ifndef TRIANGLE_H
#define TRIANGLE_H

struct triangle {
	int v[3]; /* vertices, counter-clockwise seen from the outside */
};

#endif
