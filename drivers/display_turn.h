/* A picture of its own size between drawing and the panel: turned, and as large as fits. */
#ifndef DISPLAY_TURN_H
#define DISPLAY_TURN_H

#include "plane_map.h"

#include <GLES3/gl3.h>

struct turn {
	GLuint framebuffer, colour, depth; /* 0: not there */
	GLuint program, corners;
	GLint place;
	bool exact; /* a pixel is a pixel */
	int width, height, panel_width, panel_height;
	struct plane_map map; /* picture to panel */
};

/* For the context that is current. False: GL refuses. */
bool turn_open(struct turn *turn, int width, int height, int degrees, int panel_width,
	       int panel_height);

/* Draws into the picture from here on. */
void turn_begin(const struct turn *turn);

/* The picture goes onto the panel, a framebuffer of the caller's, which stays bound. */
void turn_show(const struct turn *turn, GLuint panel);

/* Gives GL's objects back, in the context that they were made in. */
void turn_close(struct turn *turn);

/* A framebuffer with colour and depth; false: GL refuses the size. */
bool turn_target(GLuint *framebuffer, GLuint *colour, GLuint *depth, int width, int height);

#endif
