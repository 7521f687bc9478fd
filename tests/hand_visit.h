/* What a visitor does, one thing at a time: draws a piece, sews, draws marks, pulls the worn
 * garment.
 *
 * Places on a piece are given in mm of the sketch that it was drawn from, as they lie on the sheet:
 * on a piece that was copied and turned over x points the same way as on the first. */
#ifndef HAND_VISIT_H
#define HAND_VISIT_H

#include "hand.h"

enum { FRONT = 0, BACK = 1, SKETCH_POINTS_MAX = 48 };

/* An outline, its points in the order in which they are drawn; the last run leads back to the
 * first. */
struct sketch {
	int count;
	struct v2 point_mm[SKETCH_POINTS_MAX];
};

/* The right half of a symmetric outline, from the top to the bottom, and the dip between its first
 * point and the mirror image of that: half an ellipse so deep. */
void sketch_make(struct sketch *sketch, const struct v2 *half_mm, int count, float dip_mm);

void visit_draw(struct hand *hand, const struct sketch *sketch, struct v2 centre_mm, float speed);
/* Copies the piece drawn last and turns the copy over: the back. */
void visit_copy(struct hand *hand);
/* Draws the dip of a piece anew. */
void visit_dip(struct hand *hand, const struct sketch *sketch, int piece, float half_width_mm,
	       float dip_mm, float speed);
/* Sews the edges of front and back that run nearest to a place, and to its mirror image. */
void visit_sew(struct hand *hand, const struct sketch *sketch, struct v2 middle_mm);
void visit_mark_cloth(struct hand *hand, const struct sketch *sketch, int piece, struct v2 from_mm,
		      struct v2 to_mm);
/* On the body as seen from the front (toward_z: 1) or from behind (-1), which the view must show.
 */
void visit_mark_body(struct hand *hand, struct v2 from_m, struct v2 to_m, float toward_z);

/* Presses WRAP, takes the pen away and waits until the garment lies. */
void visit_wrap(struct hand *hand);
void visit_rest(struct hand *hand, float seconds_max);

/* Where a place of the worn garment is. */
struct v3 visit_place(const struct hand *hand, const struct sketch *sketch, int piece,
		      struct v2 mm);
struct v2 visit_px(const struct hand *hand, struct v3 place_m);
/* Angle about the vertical axis, 0 in front, growing to the wearer's left, degrees. */
float visit_angle(struct v3 place_m);
/* The body's surface at an angle and height. */
struct v3 visit_round(const struct hand *hand, float degrees, float y_m);

/* One stroke of the pen through places in space, with a pause before it lifts. */
void visit_pull(struct hand *hand, const struct v3 *way_m, int count);
void visit_pull_by(struct hand *hand, struct v3 from_m, struct v2 by_px);
/* Round the body at a height, from an angle to another. */
void visit_pull_round(struct hand *hand, float y_m, float from_degrees, float to_degrees);
/* The pen hovers over a place and the real button is pressed. */
void visit_pin(struct hand *hand, struct v3 place_m);

void visit_say(const struct hand *hand, const char *what);

#endif
