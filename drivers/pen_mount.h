/* How a tablet lies: turned under the hand, beside the screen, or being the screen itself. Whole
 * numbers, so that a tape can say the same as the board file did. */
#ifndef PEN_MOUNT_H
#define PEN_MOUNT_H

#include "plane_map.h"

/* A cross of the calibration, in hundredths of a pixel of the panel. */
struct pen_cross {
	int seen_x, seen_y;   /* where the pen was seen that touched it */
	int meant_x, meant_y; /* where it stands */
};

struct pen_mount {
	int degrees;  /* the tablet's turn, clockwise: 0, 90, 180 (a left hand's), 270 */
	bool display; /* the tablet is the screen */
	/* The panel, and the picture's turn on it, clockwise; 0 x 0: as the picture. */
	int panel_width, panel_height, rotation;
	int cross_count; /* 0, or 4 to 25; only of a pen display */
	struct pen_cross cross[PLANE_MAP_POINTS_MAX];
};

/* The map from where a pen is seen to where it is, on the panel; `worst_px` is the cross that it
 * misses most. The identity without crosses. False with a line in fault: see plane_map_find. */
bool pen_mount_calibrate(const struct pen_mount *mount, struct plane_map *map, float *rms_px,
			 float *worst_px, char fault[200]);

/* The map from panel px, calibrated or not, to px of a picture of this size. */
struct plane_map pen_mount_map(const struct pen_mount *mount, int width_px, int height_px,
			       bool calibrated);

#endif
